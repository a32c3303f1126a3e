//! `cell_length_bound`, a length that no path of an arm or a car undercuts.

use crate::collision::Problem;
use crate::configuration::Configuration as _;
use crate::cspace::{CellMap, Slice};
use crate::num::{greater, lesser, ulp};
use crate::robots::AnyRobot;

use super::lengths::CellLengths;
use super::norm::{CellNorm, LengthMeasure};
use super::states::CellStates;

/// The level of the finest cells of a plane: a 256th of its sides.
const FINEST_OF_PLANE: u32 = 8;

/// The same of a space of three dimensions: a 64th.
const FINEST_OF_SPACE: u32 = 6;

/// How often the norm is fitted to the way that was shortest by the one before.
const ROUNDS: u32 = 4;

/// The share of a length that is taken off for rounding.
const ROUNDING: f64 = 1e-9;

/// How many units in the last place of the greatest coordinate are taken off too: places of cells are rounded.
const PLACE_ULPS: f64 = 64.0;

/// The greatest radius that a car's least is taken for, metres: one that can't steer has none.
const MAX_RADIUS: f64 = 1e6;

/// A length that no path undercuts: of an arm of two or three links in radians, by all of its joints, of a car the
/// metres that its rear axle drives; infinity where cells prove that there is no path. `None` for another robot, and
/// where a region around the goal may be reached.
///
/// The cells of the configuration space that are not proven blocked are all that a path can pass. A polyhedral norm is
/// laid over them that is nowhere longer than a path is. By such a norm the shortest way from corner to corner of cells
/// leads along their edges and the diagonals of one plane, so that a search of a graph finds its length; several norms
/// are tried, and the longest counts. In the open it is some per cent below the length of a shortest path, more where
/// that turns often. Of a car it counts that it turns on no circle smaller than its least, not that it can't move
/// sideways: one that has to may drive several times as far. Its trailer is left out.
///
/// By `reach` a path's end may be off the goal in each coordinate, metres and radians; what is left out, is negative or
/// is no number counts as 0.
///
/// ```
/// use motion_lab_core::planning::cell_length_bound;
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::robots::AnyRobot;
/// let at = |turns: [f64; 2]| AnyRobot::of_kind("reach", &turns).unwrap();
/// let ((arm, start), (_, goal)) = (at([2.0, 0.0]), at([3.1, 0.0]));
/// let problem = Problem::try_new(Checker::new(Scene::workbench(), arm), start, goal, Seed(2005))?;
/// assert!(cell_length_bound(&problem, &[]).unwrap() > 1.5); // the post is in the way, straight it would be 1.1
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cell_length_bound(problem: &Problem<AnyRobot>, reach: &[f64]) -> Option<f64> {
    if problem.region().is_some() {
        return None;
    }
    let checker = problem.checker();
    let measure = match checker.robot() {
        AnyRobot::Hitch(car) => LengthMeasure::Driven(lesser(car.tightest(), MAX_RADIUS)),
        AnyRobot::Reach(_) | AnyRobot::Reach3(_) => LengthMeasure::Joints,
        _ => return None,
    };
    if let Some(space) = Slice::space(checker) {
        return Some(bound(CellMap::new(space, FINEST_OF_SPACE), measure, problem, reach));
    }
    let plane = Slice::through(checker, &problem.start()).ok()?;
    Some(bound(CellMap::new(plane, FINEST_OF_PLANE), measure, problem, reach))
}

fn bound<const N: usize>(
    mut map: CellMap<N>,
    measure: LengthMeasure,
    problem: &Problem<AnyRobot>,
    reach: &[f64],
) -> f64 {
    map.refine(u32::MAX);
    let cells = CellStates::of(&map, map.finest());
    let lengths = CellLengths::new(&cells);
    let ends = [problem.start(), problem.goal()].map(|q| map.slice().point(&q.in_chart()));
    let reach = std::array::from_fn(|i| reach.get(i).copied().unwrap_or(0.0));
    let straight = lengths.straight(ends);
    let planes = match measure {
        LengthMeasure::Joints if N > 2 => &[[1, 2], [0, 2], [0, 1]][..],
        _ => &[[0, 1]],
    };
    let slice = map.slice();
    let greatest = slice.min().into_iter().chain(slice.max()).map(f64::abs).fold(1.0, greater);
    let longer = match measure {
        LengthMeasure::Joints => 1.0,
        LengthMeasure::Driven(radius) => greater(radius, 1.0),
    };
    let rounding = PLACE_ULPS * ulp(greatest) * longer;
    let mut longest = 0.0;
    for plane in planes {
        let mut along = straight;
        for _ in 0..ROUNDS {
            if along.iter().all(|change| *change == 0.0) {
                break;
            }
            let norm = CellNorm::for_path(measure, *plane, cells.steps, along);
            let Some((length, changes)) = lengths.bound(&norm, ends, reach) else { return f64::INFINITY };
            longest = greater(length * (1.0 - ROUNDING) - rounding, longest);
            along = std::array::from_fn(|i| 0.5 * (along[i] + changes[i]));
        }
    }
    longest
}
