//! `Region`, a part of the configuration space that one obstacle blocks.

use std::collections::VecDeque;

use super::Slice;
use crate::collision::ObstacleId;
use crate::geometry::Point2;
use crate::picture::{Anchor, Drawing, Face, Item, Role};
use crate::robots::Robot;

/// Samples along a side of the slice.
const SIDE: usize = 64;

/// Least number of samples of a region that is named: some hundredths of the slice.
const MIN_SAMPLES: usize = 40;

const MAX_REGIONS: usize = 8;

/// Least distance of two names, in samples: across, as a name is long, and up.
const APART: [usize; 2] = [12, 4];

/// A part of the configuration space that one obstacle alone blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The obstacle's name.
    pub name: String,
    /// A point of the slice well within it.
    pub at: [f64; 2],
    /// Its share of the slice, by samples.
    pub share: f64,
}

/// The largest regions of a slice that one obstacle alone blocks, the largest first. They are found by samples, and
/// nothing of them is proven. A region may go on over the edges of a torus.
pub fn regions(slice: &Slice) -> Vec<Region> {
    let blocked = samples(slice);
    let mut found: Vec<(usize, [usize; 2], ObstacleId)> = Vec::new();
    let mut is_seen = vec![false; SIDE * SIDE];
    for start in 0..SIDE * SIDE {
        let Some(obstacle) = blocked[start].filter(|_| !is_seen[start]) else { continue };
        let is_of = |cell: usize| blocked[cell] == Some(obstacle);
        let mut cells = vec![start];
        is_seen[start] = true;
        let mut next = 0;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            for beside in neighbours(cell, slice.wraps()).into_iter().flatten() {
                if is_of(beside) && !std::mem::replace(&mut is_seen[beside], true) {
                    cells.push(beside);
                }
            }
        }
        if cells.len() >= MIN_SAMPLES {
            let deepest = deepest(&cells, is_of, slice.wraps());
            found.push((cells.len(), [deepest % SIDE, deepest / SIDE], obstacle));
        }
    }
    found.sort_by_key(|(size, ..)| std::cmp::Reverse(*size));
    let mut regions: Vec<(Region, [usize; 2])> = Vec::new();
    for (size, at, obstacle) in found {
        let is_near = |other: &[usize; 2]| (0..2).all(|i| other[i].abs_diff(at[i]) < APART[i]);
        let Some(name) = slice.checker().scene().obstacle_name(obstacle) else { continue };
        if regions.len() < MAX_REGIONS && !regions.iter().any(|(_, other)| is_near(other)) {
            let share = size as f64 / (SIDE * SIDE) as f64;
            regions.push((Region { name: name.to_owned(), at: place(slice, at), share }, at));
        }
    }
    regions.into_iter().map(|(region, _)| region).collect()
}

/// The names of the regions, each where it is deep.
pub fn region_items(regions: &[Region]) -> Vec<Item> {
    let item = |(number, region): (usize, &Region)| {
        let (at, text) = (Point2::new(region.at[0], region.at[1]), region.name.clone());
        let drawing = Drawing::Label {
            at,
            text: text.clone(),
            anchor: Anchor::Centre,
            face: Face::Sans,
            size_px: 11.0,
            plate: true,
        };
        Item::new(format!("region/{number}"), text, Role::Text, drawing)
    };
    (1..).zip(regions).map(item).collect()
}

/// The middle of a sample's cell.
fn place(slice: &Slice, at: [usize; 2]) -> [f64; 2] {
    let (min, max) = (slice.min(), slice.max());
    [0, 1].map(|i| min[i] + (max[i] - min[i]) * ((at[i] as f64 + 0.5) / SIDE as f64))
}

/// The obstacle that alone blocks each sample, row after row; `None` where none does, or several do.
fn samples(slice: &Slice) -> Vec<Option<ObstacleId>> {
    let (robot, scene) = (slice.checker().robot(), slice.checker().scene());
    let blocked = |cell: usize| {
        let q = slice.at(place(slice, [cell % SIDE, cell / SIDE]));
        match scene.touched(&robot.footprint(&q))[..] {
            [obstacle] => Some(obstacle),
            _ => None,
        }
    };
    (0..SIDE * SIDE).map(blocked).collect()
}

/// The cells beside a cell: left, right, below, above. Beyond an edge of a torus lies the opposite one.
fn neighbours(cell: usize, wraps: bool) -> [Option<usize>; 4] {
    let (column, row) = (cell % SIDE, cell / SIDE);
    let down = |k: usize| if k > 0 { Some(k - 1) } else { wraps.then_some(SIDE - 1) };
    let up = |k: usize| if k + 1 < SIDE { Some(k + 1) } else { wraps.then_some(0) };
    let across = |column: Option<usize>| column.map(|column| row * SIDE + column);
    let along = |row: Option<usize>| row.map(|row| row * SIDE + column);
    [across(down(column)), across(up(column)), along(down(row)), along(up(row))]
}

/// The cell of a region that is farthest from its border, by steps.
fn deepest(cells: &[usize], is_of: impl Fn(usize) -> bool, wraps: bool) -> usize {
    let is_border = |cell: &usize| neighbours(*cell, wraps).into_iter().any(|beside| !beside.is_some_and(&is_of));
    let mut depth = vec![usize::MAX; SIDE * SIDE];
    let mut waiting: VecDeque<usize> = cells.iter().copied().filter(is_border).collect();
    waiting.iter().for_each(|cell| depth[*cell] = 0);
    let mut last = cells.first().copied().unwrap_or_default();
    while let Some(cell) = waiting.pop_front() {
        last = cell;
        for beside in neighbours(cell, wraps).into_iter().flatten() {
            if is_of(beside) && depth[beside] == usize::MAX {
                depth[beside] = depth[cell] + 1;
                waiting.push_back(beside);
            }
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::collision::{Checker, Scene};
    use crate::geometry::Aabb;
    use crate::robots::AnyRobot;

    fn slice_of(kind: &str, q: &[f64], scene: Scene) -> Slice {
        let (robot, q) = AnyRobot::of_kind(kind, q).unwrap();
        Slice::through(&Checker::new(scene, robot), &q).unwrap()
    }

    #[test]
    fn each_obstacle_of_the_workbench_blocks_a_region_that_has_its_name() {
        let slice = slice_of("reach", &[0.8, 1.5], Scene::workbench());
        let found = regions(&slice);
        let scene = slice.checker().scene();
        for region in &found {
            let touched = scene.touched(&slice.checker().robot().footprint(&slice.at(region.at)));
            let names: Vec<_> = touched.iter().filter_map(|id| scene.obstacle_name(*id)).collect();
            assert_eq!(names, [region.name.as_str()], "{:?}", region.at);
        }
        for obstacle in ["the block", "the post", "the shelf"] {
            assert!(found.iter().any(|region| region.name.contains(obstacle)), "{obstacle}: {found:?}");
        }
        assert!(found.windows(2).all(|pair| pair[0].share >= pair[1].share), "the largest first");
        assert_eq!(region_items(&found).len(), found.len());
    }

    #[test]
    fn a_region_of_a_plane_is_the_obstacle_grown_and_named_in_its_middle() {
        let bounds = Aabb::new(Point2::new(0.0, 0.0), Point2::new(10.0, 10.0));
        let square = crate::geometry::Shape::Rectangle { min: Point2::new(2.0, 6.0), max: Point2::new(4.0, 8.0) };
        let speck = crate::geometry::Shape::Disc { radius: 0.1 };
        let at = crate::geometry::Pose2::new(8.0, 2.0, 0.0);
        let scene = Scene::empty(bounds).with_obstacle("square", square).with_obstacle_at("speck", at, speck);
        let found = regions(&slice_of("rusty", &[1.0, 1.0, 0.0], scene));
        assert_eq!(found.iter().map(|region| region.name.as_str()).collect::<Vec<_>>(), ["square"]);
        let Region { at: [x, y], share, .. } = found[0];
        assert!((x - 3.0).abs() < 0.4 && (y - 7.0).abs() < 0.4, "{x} {y}");
        // 2.22 m by 2.22 m less the corners, of a hundred square metres
        assert!((share - 0.049).abs() < 0.006, "{share}");
    }

    #[test]
    fn on_a_torus_a_region_goes_on_over_the_edges() {
        // an arm that lies on a block behind it does so on both sides of th1 = pi
        let slice = slice_of("reach", &[0.8, 1.5], Scene::workbench());
        assert_eq!(neighbours(0, true), [Some(SIDE - 1), Some(1), Some(SIDE * (SIDE - 1)), Some(SIDE)]);
        assert_eq!(neighbours(0, false), [None, Some(1), None, Some(SIDE)]);
        let last = SIDE * SIDE - 1;
        assert_eq!(
            neighbours(last, true),
            [Some(last - 1), Some(SIDE * (SIDE - 1)), Some(last - SIDE), Some(SIDE - 1)]
        );
        let [x, _] = place(&slice, [0, 0]);
        assert!((x + PI - PI / SIDE as f64).abs() < 1e-12);
        // a band of cells across the edge is one region, and its middle is on the edge
        let is_band = |cell: usize| !(5..SIDE - 6).contains(&(cell % SIDE));
        let cells: Vec<usize> = (0..SIDE * SIDE).filter(|cell| is_band(*cell)).collect();
        let middle = deepest(&cells, is_band, true) % SIDE;
        assert!([SIDE - 1, 0].contains(&middle), "{middle}");
        let at_the_left = deepest(&cells, is_band, false) % SIDE;
        assert!(at_the_left > 0 && at_the_left < SIDE - 1, "the edge is a border there: {at_the_left}");
    }
}
