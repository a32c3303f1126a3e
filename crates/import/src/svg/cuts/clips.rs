//! `ClipTable`, the regions to which clip paths and viewports cut what is drawn, in metres.

use std::collections::BTreeMap;

use crate::planar::Ring;
use motion_lab_core::geometry::{Aabb, Point2, Segment, cross};

/// One shape of a clip path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClipShape {
    /// Closed lines.
    pub rings: Vec<Vec<Point2>>,
    pub even_odd: bool,
    /// Whether it is what lies outside its lines.
    is_inverted: bool,
    /// The regions that cut the shape itself.
    pub clips: Vec<usize>,
    /// Which way its border leads around it, 1 or -1, if it is one convex polygon.
    turn: Option<f64>,
}

/// What lies in any of its shapes, and in all of the regions that cut it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ClipRegion {
    pub shapes: Vec<ClipShape>,
    pub clips: Vec<usize>,
    /// The number of points of its lines and of those that cut it; found when it is added.
    pub size: usize,
}

/// Regions by index. A region is cut by earlier ones only.
#[derive(Default)]
pub(crate) struct ClipTable {
    regions: Vec<ClipRegion>,
}

/// Points may lie this far outside a region and count as in it, metres: coordinates are rounded to half of it.
const AT_BORDER: f64 = 2e-6;

/// Largest number of regions that cut one shape.
const MAX_LAYERS: usize = 500;

/// Whether two boxes have a point in common, or nearly.
pub(crate) fn meet(one: &Aabb, other: &Aabb) -> bool {
    !one.grown(AT_BORDER).is_apart(other)
}

impl ClipTable {
    /// Adds a region and returns its index.
    pub fn add(&mut self, mut region: ClipRegion) -> usize {
        let nested = region.clips.iter().chain(region.shapes.iter().flat_map(|shape| &shape.clips));
        let own: usize = region.shapes.iter().flat_map(|shape| &shape.rings).map(Vec::len).sum();
        region.size = nested.map(|i| self.size(*i)).fold(1 + own, usize::saturating_add);
        self.regions.push(region);
        self.regions.len() - 1
    }

    /// The number of points of a region's lines, for bounds on the work.
    pub fn size(&self, index: usize) -> usize {
        self.regions[index].size
    }

    /// Whether a region plainly holds all of these points and what they surround. `false` is inconclusive.
    pub fn holds(&self, index: usize, points: &[Point2]) -> bool {
        let region = &self.regions[index];
        let Some(extent) = Aabb::around(points) else { return true };
        let is_in = |shape: &ClipShape| {
            shape.clips.iter().all(|clip| self.holds(*clip, points))
                && (shape.holds_convex(points) || shape.surrounds(&extent))
        };
        region.shapes.iter().any(is_in) && region.clips.iter().all(|clip| self.holds(*clip, points))
    }

    /// Whether a point lies in a region.
    fn contains(&self, index: usize, p: Point2) -> bool {
        let region = &self.regions[index];
        let in_shape = |shape: &ClipShape| {
            let winding = shape.rings.iter().map(|ring| winding(ring, p)).sum();
            shape.is_in(winding) && shape.clips.iter().all(|clip| self.contains(*clip, p))
        };
        region.clips.iter().all(|clip| self.contains(*clip, p)) && region.shapes.iter().any(in_shape)
    }

    /// Adds the lines of a region to `rings`, each shape as a layer of its own. `None` for too many layers.
    pub fn layer(&self, index: usize, layers: &mut ClipLayers, rings: &mut Vec<Ring>) -> Option<()> {
        let region = &self.regions[index];
        for (i, shape) in region.shapes.iter().enumerate() {
            layers.of.entry((index, i)).or_insert(layers.next);
            let layer = layers.next;
            layers.next += 1;
            rings.extend(shape.rings.iter().map(|points| Ring { layer, points: points.clone() }));
            shape.clips.iter().try_for_each(|clip| self.layer(*clip, layers, rings))?;
        }
        region.clips.iter().try_for_each(|clip| self.layer(*clip, layers, rings))?;
        (layers.next <= MAX_LAYERS).then_some(())
    }

    /// Whether a place with these winding numbers lies in a region.
    pub fn is_inside(&self, index: usize, layers: &ClipLayers, windings: &[i32]) -> bool {
        let region = &self.regions[index];
        let in_shape = |(i, shape): (usize, &ClipShape)| {
            let winding = layers.of.get(&(index, i)).and_then(|layer| windings.get(*layer)).copied().unwrap_or(0);
            shape.is_in(winding) && shape.clips.iter().all(|clip| self.is_inside(*clip, layers, windings))
        };
        region.clips.iter().all(|clip| self.is_inside(*clip, layers, windings))
            && region.shapes.iter().enumerate().any(in_shape)
    }

    /// The stretches of a line that lie in a region or on its border, each a chain of points; a closed line that lies
    /// in it all comes back with its first point at its end. `allowance` counts the points that may still be compared;
    /// `None` if it does not suffice.
    pub fn cut_line(&self, index: usize, points: &[Point2], allowance: &mut usize) -> Option<Vec<Vec<Point2>>> {
        let mut chains: Vec<Vec<Point2>> = Vec::new();
        let mut lines = Vec::new();
        self.border(index, &mut lines);
        let on_border = |p: Point2| lines.iter().any(|[c, d]| is_on(Segment::new(*c, *d), p));
        for ends in points.windows(2) {
            let [a, b] = [ends[0], ends[1]];
            let mut stops: Vec<f64> = lines.iter().filter_map(|line| meeting([a, b], *line)).collect();
            stops.extend([0.0, 1.0]);
            stops.sort_by(|s, t| s.partial_cmp(t).unwrap_or(std::cmp::Ordering::Equal));
            *allowance = allowance.checked_sub(stops.len().saturating_mul(self.size(index)))?;
            let at = |t: f64| if t == 1.0 { b } else { a + (b - a) * t };
            for span in stops.windows(2).filter(|span| span[0] < span[1]) {
                let middle = at(0.5 * (span[0] + span[1]));
                if !self.contains(index, middle) && !on_border(middle) {
                    continue;
                }
                match chains.last_mut() {
                    Some(chain) if chain.last() == Some(&at(span[0])) => chain.push(at(span[1])),
                    _ => chains.push(vec![at(span[0]), at(span[1])]),
                }
            }
        }
        Some(chains)
    }

    fn border(&self, index: usize, lines: &mut Vec<[Point2; 2]>) {
        let region = &self.regions[index];
        for ring in region.shapes.iter().flat_map(|shape| &shape.rings) {
            lines.extend(edges(ring));
        }
        let nested = region.clips.iter().chain(region.shapes.iter().flat_map(|shape| &shape.clips));
        nested.for_each(|clip| self.border(*clip, lines));
    }
}

/// Which layer holds the lines of a region's shape.
#[derive(Default)]
pub(crate) struct ClipLayers {
    of: BTreeMap<(usize, usize), usize>,
    next: usize,
}

impl ClipLayers {
    /// The layer 0 is taken.
    pub fn above_first() -> Self {
        ClipLayers { of: BTreeMap::new(), next: 1 }
    }
}

impl ClipShape {
    pub fn new(rings: Vec<Vec<Point2>>, even_odd: bool, clips: Vec<usize>) -> Self {
        let turn = if let [ring] = &rings[..] { convex_turn(ring) } else { None };
        ClipShape { rings, even_odd, is_inverted: false, clips, turn }
    }

    /// What lies outside the shape's lines, and in the regions that cut it.
    pub fn inverted(self) -> Self {
        ClipShape { is_inverted: !self.is_inverted, turn: None, ..self }
    }

    /// All that lies in a region.
    pub fn of_region(region: usize) -> Self {
        ClipShape::new(Vec::new(), false, vec![region]).inverted()
    }

    /// Whether a place with this winding number is inside, but for the regions that cut the shape.
    fn is_in(&self, winding: i32) -> bool {
        is_in(winding, self.even_odd) != self.is_inverted
    }

    /// Whether the shape is one convex polygon and holds these points.
    fn holds_convex(&self, points: &[Point2]) -> bool {
        let Some(turn) = self.turn else { return false };
        let on_side = |[a, b]: [Point2; 2]| {
            let slack = AT_BORDER * (b - a).norm();
            points.iter().all(|p| turn * cross(b - a, p - a) >= -slack)
        };
        self.rings.iter().flat_map(|ring| edges(ring)).all(on_side)
    }

    /// Whether a box lies inside, and no line passes through it.
    fn surrounds(&self, extent: &Aabb) -> bool {
        let free = |ends: [Point2; 2]| Aabb::around(&ends).is_some_and(|edge| !meet(&edge, extent));
        let center = extent.centre();
        self.rings.iter().flat_map(|ring| edges(ring)).all(free)
            && self.is_in(self.rings.iter().map(|ring| winding(ring, center)).sum())
    }
}

/// Whether a place with this winding number is inside.
pub(crate) fn is_in(winding: i32, even_odd: bool) -> bool {
    if even_odd { winding % 2 != 0 } else { winding != 0 }
}

fn is_on(edge: Segment, p: Point2) -> bool {
    (edge.closest_point(p) - p).norm() <= AT_BORDER
}

fn edges(ring: &[Point2]) -> impl Iterator<Item = [Point2; 2]> {
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]])
}

/// How often a closed line leads around a point.
fn winding(ring: &[Point2], p: Point2) -> i32 {
    let pass = |[a, b]: [Point2; 2]| match (a.y <= p.y, b.y <= p.y) {
        (true, false) if cross(b - a, p - a) > 0.0 => 1,
        (false, true) if cross(b - a, p - a) < 0.0 => -1,
        _ => 0,
    };
    edges(ring).map(pass).sum()
}

/// Which way the border of a convex polygon leads around it: 1 or -1; `None` for any other line.
fn convex_turn(ring: &[Point2]) -> Option<f64> {
    let n = ring.len();
    let turn = |i: usize| cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]);
    let is_upward = |i: usize| {
        let (a, b) = (ring[i % n], ring[(i + 1) % n]);
        (b.y, b.x) > (a.y, a.x)
    };
    // what only turns one way leads around once if its edges turn from downward to upward once
    let is_once = (0..n).filter(|&i| !is_upward(i) && is_upward(i + 1)).count() == 1;
    let turns = |sign: f64| (0..n).all(|i| sign * turn(i) >= 0.0) && (0..n).any(|i| sign * turn(i) > 0.0);
    [1.0, -1.0].into_iter().find(|sign| is_once && turns(*sign))
}

/// The place on the segment `a` `b`, from 0 to 1, at which it meets another segment; `None` if they are parallel or
/// apart.
fn meeting([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Option<f64> {
    let det = cross(b - a, d - c);
    let (t, u) = (cross(c - a, d - c) / det, cross(c - a, b - a) / det);
    let within = |x: f64| (0.0..=1.0).contains(&x);
    (det != 0.0 && within(t) && within(u)).then_some(t)
}
