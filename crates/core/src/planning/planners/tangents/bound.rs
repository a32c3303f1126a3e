//! `length_bound`, a length that no path of a disc undercuts.

use crate::collision::Problem;
use crate::num::greater;
use crate::planning::planners::disc::{position, radius_of};
use crate::robots::Robot;

use super::rim::TOLERANCE;
use super::search::{TangentSearch, TangentStep};
use super::space::DiscSpace;

/// The share of a length that is taken off for rounding.
const ROUNDING: f64 = 1e-12;

/// A length that the centre of no path undercuts, metres, of a robot that is a disc; infinity where there is no path.
/// `None` for another robot, and where a region around the goal may be reached.
///
/// It is the length of a shortest path by tangents and arcs of a disc that is smaller by a nanometre or two, so it is
/// less than the shortest path's by rounding alone, on the worlds of the lab by less than 0.1 micrometres, unless a gap
/// is narrower than the disc by no more than that. Where there are more than a million lines to look at it is less. The
/// scene's bounds keep the centre in.
///
/// ```
/// use motion_lab_core::geometry::Aabb;
/// use motion_lab_core::planning::length_bound;
/// use motion_lab_core::prelude::*;
/// // a wall's end half a metre above the straight line between two points 2 m apart
/// let wall = Shape::Segment { a: Point2::new(0.0, -2.0), b: Point2::new(0.0, 0.5) };
/// let bounds = Aabb::new(Point2::new(-2.0, -2.0), Point2::new(2.0, 2.0));
/// let scene = Scene::empty(bounds).with_obstacle("wall", wall);
/// let checker = Checker::new(scene, RustyDisc::try_new(0.1)?);
/// let problem = Problem::try_new(checker, R2::new(-1.0, 0.0), R2::new(1.0, 0.0), Seed(1))?;
/// // two tangents, and an arc about the wall's end
/// assert!((length_bound(&problem).unwrap() - 2.3377).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn length_bound<R: Robot>(problem: &Problem<R>) -> Option<f64> {
    let radius = radius_of(&problem.checker().robot().footprint(&problem.start()))?;
    if problem.region().is_some() {
        return None;
    }
    let space = DiscSpace::new(problem.checker().scene(), radius - TOLERANCE);
    let mut search = TangentSearch::new(space, position(&problem.start()), position(&problem.goal()));
    loop {
        let least = match search.next() {
            TangentStep::Rim(_) => continue,
            TangentStep::Goal(_) | TangentStep::TooMany => search.bound(),
            TangentStep::Nothing => return Some(f64::INFINITY),
        };
        return Some(greater(least * (1.0 - ROUNDING), 0.0));
    }
}
