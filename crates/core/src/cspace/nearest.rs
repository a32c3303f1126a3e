//! Finds the nearest free configuration of a slice.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::{CellState, Slice};
use crate::configuration::AnyConfiguration;
use crate::num::lesser;

/// Cells with sides of at most this, metres or radians, are not cut further.
const FINEST: f64 = 5e-4;

/// Largest number of cells judged.
const BUDGET: u32 = 40_000;

/// A free configuration near a wanted one, and how much nearer another could be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestFree {
    /// The configuration; free by the exact query.
    pub q: AnyConfiguration,
    /// Its distance in the slice from the wanted configuration: radians for an arm, metres for other robots.
    pub distance: f64,
    /// Proven distance: every configuration of the slice nearer than this is in contact. A free configuration can thus
    /// be nearer than `q` by at most `distance - proven`. The search aims at less than two thousandths, and may end
    /// with more.
    pub proven: f64,
}

/// A cell in the queue. The nearest comes first; ties go to the cell that was added first.
struct Waiting {
    distance: f64,
    number: u32,
    centre: [f64; 2],
    half: [f64; 2],
}

impl Waiting {
    fn key(&self, other: &Self) -> Ordering {
        self.distance.total_cmp(&other.distance).then(self.number.cmp(&other.number))
    }
}
impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.key(other).is_eq()
    }
}
impl Eq for Waiting {}
impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key(other)
    }
}

/// Finds a free configuration of the slice, as near to `wanted` as it can prove; `wanted` itself if that is free.
/// `None` if the search met no free configuration. The slice may still have free gaps that are too narrow for it.
///
/// Cells of the slice are judged in order of distance. A cell proven blocked is dropped. In any other, the nearest
/// point and the centre are tested exactly, and unless the nearest point is free the cell is cut in four. The result
/// depends on the arguments only.
pub fn nearest_free(slice: &Slice, wanted: &AnyConfiguration) -> Option<NearestFree> {
    let target = slice.point(wanted);
    let (centre, half) = slice.whole();
    let mut waiting = BinaryHeap::new();
    let mut number = 0;
    let mut add = |waiting: &mut BinaryHeap<Reverse<Waiting>>, centre, half| {
        let (_, distance) = slice.nearest_in(target, centre, half);
        number += 1;
        waiting.push(Reverse(Waiting { distance, number, centre, half }));
    };
    add(&mut waiting, centre, half);
    let (mut best, mut unresolved): (Option<(f64, AnyConfiguration)>, f64) = (None, f64::INFINITY);
    for _ in 0..BUDGET {
        let Some(Reverse(Waiting { distance, centre, half, .. })) = waiting.pop() else { break };
        if best.is_some_and(|(d, _)| d <= distance) {
            unresolved = lesser(unresolved, distance);
            waiting.clear();
            break;
        }
        if slice.judge(centre, half) == CellState::Blocked {
            continue;
        }
        let (nearest, _) = slice.nearest_in(target, centre, half);
        for p in [nearest, centre] {
            let q = slice.at(p);
            let d = slice.distance(target, slice.point(&q));
            if best.is_none_or(|(least, _)| d < least) && slice.checker().is_free(&q) {
                best = Some((d, q));
            }
        }
        if best.is_some_and(|(d, _)| d <= distance) {
            unresolved = lesser(unresolved, distance);
            waiting.clear();
            break;
        }
        if half.iter().all(|h| 2.0 * h <= lesser(FINEST, slice.least_side())) {
            unresolved = lesser(unresolved, distance);
            continue;
        }
        let quarter = half.map(|h| 0.5 * h);
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            add(&mut waiting, [centre[0] + x * quarter[0], centre[1] + y * quarter[1]], quarter);
        }
    }
    // the budget may have ended the search: cells still in the queue are not proven
    let left = waiting.peek().map_or(f64::INFINITY, |Reverse(w)| w.distance);
    best.map(|(distance, q)| NearestFree { q, distance, proven: lesser(distance, lesser(unresolved, left)) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{Checker, Scene};
    use crate::configuration::Configuration;
    use crate::random::{Seed, Stream};
    use crate::robots::{AnyRobot, Robot};

    #[test]
    fn nothing_nearer_is_free_and_what_is_offered_is() {
        let mut s = Stream::new(Seed(21), "nearest free");
        let mut wide = 0;
        for (kind, start, scene) in [
            ("rusty", &[1.0, 1.0, 0.0][..], Scene::apartment()),
            ("reach", &[1.0, 1.0], Scene::workbench()),
            ("hitch", &[6.5, 2.5, 0.4], Scene::lot()),
        ] {
            let (robot, _) = AnyRobot::of_kind(kind, start).unwrap();
            let checker = Checker::new(scene, robot);
            let bounds = checker.scene().bounds();
            let mut found = 0;
            while found < 10 {
                let wanted = robot.sample(bounds.min, bounds.max, &mut s);
                if checker.is_free(&wanted) {
                    continue;
                }
                found += 1;
                let slice = Slice::through(&checker, &wanted).unwrap();
                let offer = nearest_free(&slice, &wanted).unwrap();
                assert!(checker.is_free(&offer.q), "{kind} {wanted}");
                assert!(slice.holds(&offer.q) && offer.proven <= offer.distance);
                wide += u32::from(offer.distance - offer.proven > 2e-3);
                for _ in 0..300 {
                    let (turn, far) = (s.uniform(-3.2, 3.2), offer.proven * s.unit());
                    let (sin, cos) = crate::num::sin_cos(turn);
                    let at = slice.point(&wanted);
                    let near = slice.at([at[0] + far * cos, at[1] + far * sin]);
                    let inside = |i: usize, v: f64| v >= slice.min()[i] && v <= slice.max()[i];
                    let p = slice.point(&near);
                    if inside(0, p[0]) && inside(1, p[1]) {
                        assert!(!checker.is_free(&near), "{kind} {wanted}: {near} is free and nearer");
                    }
                }
            }
        }
        // where a depth is 0 in contact (a wall's line through a corner), less is proven, and `proven` says so
        assert!(wide <= 1, "{wide} of 30 are not within 2e-3 of the nearest");
    }

    #[test]
    fn a_disc_at_a_wall_is_moved_straight_off_it() {
        let (robot, q) = AnyRobot::of_kind("rusty", &[3.02, 1.5, 0.7]).unwrap();
        let wall = crate::geometry::Shape::Segment { a: [3.0, 0.0].into(), b: [3.0, 3.0].into() };
        let bounds = crate::geometry::Aabb { min: [0.0, 0.0].into(), max: [6.0, 3.0].into() };
        let checker = Checker::new(Scene::empty(bounds).with_obstacle("the wall", wall), robot);
        let offer = nearest_free(&Slice::through(&checker, &q).unwrap(), &q).unwrap();
        assert!((offer.distance - 0.09).abs() < 1e-3, "a radius off the wall: {}", offer.distance);
        let c = offer.q.coordinates();
        assert!(c[0] > 3.11 && c[2] == 0.7, "its heading is kept");
        let free = q.with(0, 4.0);
        assert_eq!(nearest_free(&Slice::through(&checker, &free).unwrap(), &free).unwrap().distance, 0.0);
    }

    #[test]
    fn where_nothing_is_free_nothing_is_offered() {
        let (robot, q) = AnyRobot::of_kind("rusty", &[1.0, 1.0, 0.0]).unwrap();
        let bounds = crate::geometry::Aabb { min: [0.0, 0.0].into(), max: [2.0, 2.0].into() };
        let all = crate::geometry::Shape::Rectangle { min: [-1.0, -1.0].into(), max: [3.0, 3.0].into() };
        let checker = Checker::new(Scene::empty(bounds).with_obstacle("all", all), robot);
        assert_eq!(nearest_free(&Slice::through(&checker, &q).unwrap(), &q), None);
    }
}
