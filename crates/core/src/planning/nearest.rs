//! `Nearest`, the nearest of many configurations.

use std::f64::consts::TAU;
use std::ops::Range;

use super::Metric;
use crate::configuration::{Chart, Coordinates, gap};
use crate::num::{greater, lesser, sqrt};

/// The number of configurations that are kept in a plain list before they become a tree.
const LIST: usize = 64;

/// Subtrees of at most this many configurations are looked through one by one.
const LEAF: usize = 8;

/// A configuration found near another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// The number that it was added under.
    pub number: usize,
    /// Its distance by the metric.
    pub distance: f64,
}

/// Configurations among which the nearest are found, exactly, angles the short way round. Ties go to the lowest number.
///
/// New configurations join a list. A full list becomes a k-d tree (Bentley, 1975), and trees of the same size become
/// one (the logarithmic method of Bentley and Saxe, 1980), so no order of adding makes them slow.
#[derive(Clone, Debug)]
pub struct Nearest {
    metric: Metric,
    trees: Vec<PointTree>,
    list: Vec<Point>,
}

#[derive(Clone, Debug)]
struct Point {
    at: Coordinates,
    number: usize,
}

/// A balanced tree without pointers: the point in the middle of a range parts those before it from those after it, by
/// one coordinate.
#[derive(Clone, Debug)]
struct PointTree {
    points: Vec<Point>,
    /// The coordinate by which the point of the same number parts its range.
    axes: Vec<usize>,
    corners: [Coordinates; 2],
}

impl Nearest {
    /// No configurations yet, in the space of the metric.
    pub fn new(metric: Metric) -> Self {
        Nearest { metric, trees: Vec::new(), list: Vec::new() }
    }

    /// The number of configurations.
    pub fn len(&self) -> usize {
        self.list.len() + self.trees.iter().map(|tree| tree.points.len()).sum::<usize>()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Adds a configuration of the metric's space under a number.
    pub fn add<C: Chart>(&mut self, q: &C, number: usize) {
        self.list.push(Point { at: q.in_chart().coordinates(), number });
        if self.list.len() < LIST {
            return;
        }
        let mut points = std::mem::take(&mut self.list);
        while let Some(tree) = self.trees.pop_if(|tree| tree.points.len() <= points.len()) {
            points.extend(tree.points);
        }
        self.trees.push(PointTree::new(points, &self.metric));
    }

    /// The nearest; `None` when there are none.
    pub fn nearest<C: Chart>(&self, q: &C) -> Option<Neighbour> {
        self.find(q, NearestSoFar::of(1, f64::INFINITY)).pop()
    }

    /// The `count` nearest, the nearest first; fewer when there are fewer.
    pub fn nearest_few<C: Chart>(&self, q: &C, count: usize) -> Vec<Neighbour> {
        self.find(q, NearestSoFar::of(count, f64::INFINITY))
    }

    /// All within a distance, that distance included, the nearest first.
    pub fn within<C: Chart>(&self, q: &C, distance: f64) -> Vec<Neighbour> {
        self.find(q, NearestSoFar::of(usize::MAX, distance))
    }

    fn find<C: Chart>(&self, q: &C, mut found: NearestSoFar) -> Vec<Neighbour> {
        let at = q.in_chart().coordinates();
        found.look_through(&self.list, &self.metric, &at);
        for tree in &self.trees {
            tree.visit(0..tree.points.len(), tree.corners.clone(), &self.metric, &at, &mut found);
        }
        found.best.into_iter().map(|(squared, number)| Neighbour { number, distance: sqrt(squared) }).collect()
    }
}

/// The best so far, the nearest first, ties by number.
struct NearestSoFar {
    most: usize,
    within: f64,
    best: Vec<(f64, usize)>,
}

impl NearestSoFar {
    fn of(most: usize, within: f64) -> Self {
        NearestSoFar { most, within, best: Vec::new() }
    }

    /// Offers these points, one after the other.
    fn look_through(&mut self, points: &[Point], metric: &Metric, at: &[f64]) {
        for point in points {
            let most = self.best.get(self.most.wrapping_sub(1)).map_or(f64::INFINITY, |last| last.0);
            let squared = metric.squared_or_more(at, &point.at, most);
            if squared <= most {
                self.offer(squared, point.number);
            }
        }
    }

    fn offer(&mut self, squared: f64, number: usize) {
        // NaN is near nothing
        if self.is_out_of_reach(squared) || squared.is_nan() {
            return;
        }
        let place = self.best.partition_point(|known| *known < (squared, number));
        if place < self.most {
            self.best.truncate(self.most - 1);
            self.best.insert(place, (squared, number));
        }
    }

    /// Whether no point at this squared distance or farther can still be among the best. A point exactly as far as the
    /// last of them can be, if its number is lower.
    fn is_out_of_reach(&self, squared: f64) -> bool {
        let is_full = self.best.len() >= self.most;
        sqrt(squared) > self.within || (is_full && self.best.last().is_none_or(|last| squared > last.0))
    }
}

impl PointTree {
    fn new(mut points: Vec<Point>, metric: &Metric) -> Self {
        let mut axes = vec![0; points.len()];
        let corners = corners_of(&points);
        part(&mut points, &mut axes, metric);
        PointTree { points, axes, corners }
    }

    /// Offers every point of a range that could be among the best; `corners` bound them.
    fn visit(
        &self,
        range: Range<usize>,
        corners: [Coordinates; 2],
        metric: &Metric,
        at: &[f64],
        found: &mut NearestSoFar,
    ) {
        if found.is_out_of_reach(least(metric, at, &corners)) {
            return;
        }
        if range.len() <= LEAF {
            found.look_through(&self.points[range], metric, at);
            return;
        }
        let middle = usize::midpoint(range.start, range.end);
        let (point, axis) = (&self.points[middle], self.axes[middle]);
        let (mut before, mut after) = (corners.clone(), corners);
        before[1][axis] = point.at[axis];
        after[0][axis] = point.at[axis];
        found.offer(metric.squared(at, &point.at), point.number);
        let halves = [(range.start..middle, before), (middle + 1..range.end, after)];
        let nearer_first = least(metric, at, &halves[0].1) <= least(metric, at, &halves[1].1);
        let [a, b] = halves;
        for (range, corners) in if nearer_first { [a, b] } else { [b, a] } {
            self.visit(range, corners, metric, at, found);
        }
    }
}

/// Orders the points as a tree: by the coordinate in which they are spread widest, the middle one in its place.
fn part(points: &mut [Point], axes: &mut [usize], metric: &Metric) {
    if points.len() <= LEAF {
        return;
    }
    let [low, high] = corners_of(points);
    let spread = |i: usize| metric.axes()[i].weight * (high[i] - low[i]);
    let axis = (1..metric.axes().len()).fold(0, |widest, i| if spread(i) > spread(widest) { i } else { widest });
    let middle = points.len() / 2;
    let by = |p: &Point, q: &Point| p.at[axis].total_cmp(&q.at[axis]).then(p.number.cmp(&q.number));
    points.select_nth_unstable_by(middle, by);
    axes[middle] = axis;
    let (before, rest) = points.split_at_mut(middle);
    let (axes_before, axes_rest) = axes.split_at_mut(middle);
    part(before, axes_before, metric);
    part(&mut rest[1..], &mut axes_rest[1..], metric);
}

/// The least and the greatest coordinates of some points.
fn corners_of(points: &[Point]) -> [Coordinates; 2] {
    let mut corners = [points[0].at.clone(), points[0].at.clone()];
    for point in points {
        for (i, c) in point.at.iter().enumerate() {
            corners[0][i] = lesser(*c, corners[0][i]);
            corners[1][i] = greater(*c, corners[1][i]);
        }
    }
    corners
}

/// The least squared distance from a point to a box. No point of the box has a smaller one, not even by rounding: each
/// operation is monotonic, and they are done in the metric's order.
fn least(metric: &Metric, at: &[f64], [low, high]: &[Coordinates; 2]) -> f64 {
    let mut sum = 0.0;
    for (i, axis) in metric.axes().iter().enumerate() {
        let x = at[i];
        let apart = if x >= low[i] && x <= high[i] {
            0.0
        } else if !axis.is_angle {
            lesser(gap(x, low[i], false), gap(x, high[i], false))
        } else if x < low[i] {
            // straight up to the box, or down across pi
            lesser(low[i] - x, TAU - (high[i] - x))
        } else {
            lesser(x - high[i], TAU - (x - low[i]))
        };
        let d = axis.weight * apart;
        sum += d * d;
    }
    sum
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::configuration::{HitchCfg, Tn};
    use crate::geometry::Pose2;
    use crate::random::{Seed, Stream};

    /// The distance written out: the root of the weighted squares, angles by the shorter of the two ways round.
    fn by_hand(a: &[f64], b: &[f64], weights: &[f64], angles: &[bool]) -> f64 {
        let square = |i: usize| {
            let straight = (a[i] - b[i]).abs();
            let d = if angles[i] && straight > PI { 2.0 * PI - straight } else { straight };
            weights[i] * weights[i] * d * d
        };
        (0..a.len()).map(square).sum::<f64>().sqrt()
    }

    /// Compares with looking through all, for points that `draw` makes.
    fn compare<C: Chart>(seed: u64, weights: &[f64], angles: &[bool], mut draw: impl FnMut(&mut Stream) -> C) -> usize {
        let mut s = Stream::new(Seed(seed), "nearest");
        let like = draw(&mut s);
        let mut all: Vec<C> = Vec::new();
        let mut near = Nearest::new(Metric::try_weighted(&like, weights).unwrap());
        let mut across = 0;
        for i in 0..1500 {
            let q = draw(&mut s);
            near.add(&q, i);
            all.push(q);
            if i % 7 > 0 {
                continue;
            }
            let q = draw(&mut s);
            let far = |i: usize| by_hand(&all[i].coordinates(), &q.coordinates(), weights, angles);
            let mut sorted: Vec<usize> = (0..all.len()).collect();
            sorted.sort_by(|&i, &j| far(i).total_cmp(&far(j)));
            let found = near.nearest_few(&q, 9);
            assert_eq!(found.len(), sorted.len().min(9));
            for (k, neighbour) in found.iter().enumerate() {
                assert!((neighbour.distance - far(sorted[k])).abs() < 1e-14, "{q}: {k}");
                assert!((far(neighbour.number) - neighbour.distance).abs() < 1e-14);
                let same_as_last = k > 0 && neighbour.distance == found[k - 1].distance;
                assert!(!same_as_last || neighbour.number > found[k - 1].number, "ties go by number");
                let (a, b) = (all[neighbour.number].coordinates(), q.coordinates());
                across += usize::from((0..angles.len()).any(|i| angles[i] && (a[i] - b[i]).abs() > PI));
            }
            assert_eq!(near.nearest(&q), Some(found[0]));
            assert!(near.nearest_few(&q, 0).is_empty());
            let within = near.within(&q, found[found.len() / 2].distance);
            let count = (0..all.len()).filter(|&i| far(i) < found[found.len() / 2].distance - 1e-12).count();
            assert!(within.len() > count && within.iter().all(|n| n.distance <= found[found.len() / 2].distance));
        }
        assert_eq!(near.len(), 1500);
        across
    }

    #[test]
    fn they_are_those_of_looking_through_all_across_pi_too() {
        let angle = |s: &mut Stream| s.uniform(-PI, PI);
        let across = compare(1, &[1.0, 0.5, 2.0], &[true; 3], |s| Tn([angle(s), angle(s), angle(s)]));
        assert!(across > 100, "{across}");
        let across = compare(2, &[1.0, 1.0, 0.3, 0.8], &[false, false, true, true], |s| HitchCfg {
            body: Pose2::new(s.uniform(-5.0, 5.0), s.uniform(-5.0, 5.0), angle(s)),
            trailer: Some(angle(s)),
        });
        assert!(across > 100, "{across}");
        // on a lattice, where most distances are ties
        compare(3, &[1.0, 1.0], &[true; 2], |s| Tn([0.25, 0.25].map(|h| h * s.below(24) as f64 - 3.0)));
    }

    #[test]
    fn a_sorted_order_and_equal_points_are_found_too() {
        let mut near = Nearest::new(Metric::unit(&Tn([0.0])));
        assert!(near.is_empty() && near.nearest(&Tn([1.0])).is_none());
        for i in 0..5000 {
            near.add(&Tn([f64::from(i / 2) * 1e-3]), i as usize);
        }
        assert_eq!(near.nearest(&Tn([0.5001])).map(|n| n.number), Some(1000), "the lower of two equal ones");
        assert_eq!(near.within(&Tn([0.5]), 0.0).len(), 2);
        // the greatest is 2.499, and across pi -2.5 is nearer to it than to 0
        assert_eq!(near.nearest(&Tn([-2.5])).map(|n| n.number), Some(4998));
    }
}
