//! `Rim`, a circle about a vertex of an obstacle, and the lines that touch two of them.

use std::f64::consts::TAU;

use crate::geometry::{Placed, Point2, Vector2};
use crate::num::{acos, atan2, hypot, lesser, sin_cos, sqrt, wrap};

/// How much nearer than a rim a line may come, metres: far above the rounding of a tangent within the largest
/// coordinates, so no line that touches a rim is blocked by it.
pub(super) const TOLERANCE: f64 = 1e-9;

/// A circle about a vertex of an obstacle on which the centre of a disc goes round it; of radius 0 the start and the
/// goal.
#[derive(Clone, Debug)]
pub(super) struct Rim {
    pub(super) centre: Point2,
    /// Metres.
    pub(super) radius: f64,
    /// For each obstacle with this vertex, the unit vectors along its sides from the vertex on.
    pub(super) sides: Vec<Vec<Vector2>>,
}

/// A straight way that touches two rims.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    pub(super) from: Point2,
    pub(super) to: Point2,
    /// The bearing of `from` about the first rim's centre, radians.
    pub(super) leaves: f64,
    /// The bearing of `to` about the second one's.
    pub(super) arrives: f64,
    /// Metres.
    pub(super) length: f64,
}

impl Rim {
    /// The start or the goal.
    pub(super) fn point(centre: Point2) -> Self {
        Rim { centre, radius: 0.0, sides: Vec::new() }
    }

    /// The rims about the vertices of an obstacle that is grown less the tolerance.
    pub(super) fn about(piece: &Placed) -> impl Iterator<Item = Self> + '_ {
        let core = piece.core();
        core.iter().enumerate().map(move |(i, &centre)| {
            let others = [core[(i + 1) % core.len()], core[(i + core.len() - 1) % core.len()]];
            let sides = others.into_iter().filter_map(|other| (other - centre).try_normalize(0.0)).collect();
            Rim { centre, radius: piece.radius() + TOLERANCE, sides: vec![sides] }
        })
    }

    /// The point at a bearing.
    pub(super) fn at(&self, bearing: f64) -> Point2 {
        let (sin, cos) = sin_cos(bearing);
        self.centre + Vector2::new(cos, sin) * self.radius
    }

    /// Whether a direction from the centre leads away from each obstacle with this vertex, or along its side. What lies
    /// hardly behind a side is as near to it as the tolerance allows.
    fn is_outward(&self, direction: Vector2) -> bool {
        let most = 1.1 * sqrt(2.0 * TOLERANCE / self.radius);
        self.sides.iter().flatten().all(|side| direction.dot(side) <= most)
    }

    /// The bearings at which the circle crosses the line through a point with this unit normal.
    pub(super) fn across(&self, at: Point2, normal: Vector2) -> [Option<f64>; 2] {
        self.bearings(normal, normal.dot(&(at - self.centre)) / self.radius)
    }

    /// The bearings at which it crosses a circle.
    pub(super) fn on_circle(&self, centre: Point2, radius: f64) -> [Option<f64>; 2] {
        let way = centre - self.centre;
        let apart = hypot(way.x, way.y);
        if apart == 0.0 {
            return [None, None];
        }
        let cosine = (apart * apart + (self.radius - radius) * (self.radius + radius)) / (2.0 * apart * self.radius);
        self.bearings(way, cosine)
    }

    /// The bearings at which the cosine of the angle to a direction is this.
    fn bearings(&self, direction: Vector2, cosine: f64) -> [Option<f64>; 2] {
        if cosine.abs() > 1.0 {
            return [None, None];
        }
        let (middle, half) = (atan2(direction.y, direction.x), acos(cosine));
        [Some(wrap(middle - half)), Some(wrap(middle + half))]
    }

    /// The way that leaves this rim, on which one turns left (1) or right (-1), and arrives on another; `None` where
    /// there is none, or an obstacle of one of the two rims is in its way.
    ///
    /// Going along `u` with the normal `n` to its left, one that turns left has the centre a radius along `n` from it.
    /// So the centres are `length u + (t' r' - t r) n` apart.
    pub(super) fn tangent(&self, turn: f64, to: &Rim, to_turn: f64) -> Option<Tangent> {
        let apart = to.centre - self.centre;
        let distance = hypot(apart.x, apart.y);
        let across = to_turn * to.radius - turn * self.radius;
        if distance < across.abs() {
            return None;
        }
        if distance == 0.0 {
            let (from, to) = (self.centre, to.centre);
            return (self.radius == 0.0).then_some(Tangent { from, to, leaves: 0.0, arrives: 0.0, length: 0.0 });
        }
        let length = sqrt((distance - across) * (distance + across));
        let (along, left) = (apart / distance, Vector2::new(-apart.y, apart.x) / distance);
        let normal = (left * length + along * across) / distance;
        let (out, on) = (normal * -turn, normal * -to_turn);
        let is_outward = (self.radius == 0.0 || self.is_outward(out)) && (to.radius == 0.0 || to.is_outward(on));
        is_outward.then(|| Tangent {
            from: self.centre + out * self.radius,
            to: to.centre + on * to.radius,
            leaves: atan2(out.y, out.x),
            arrives: atan2(on.y, on.x),
            length,
        })
    }
}

/// The angle from one bearing to another for one who turns left (1) or right (-1), within `[0, 2 pi)`.
pub(super) fn turned(turn: f64, from: f64, to: f64) -> f64 {
    let angle = wrap(turn * (to - from));
    if angle < 0.0 { angle + TAU } else { angle }
}

/// How far one may turn from a bearing until a blocked interval begins; 0 within one, infinity where there is none.
pub(super) fn free_turn(blocked: &[[f64; 2]], turn: f64, from: f64) -> f64 {
    let mut free = f64::INFINITY;
    for &[first, last] in blocked {
        let (near, far) = if turn > 0.0 { (first, last) } else { (last, first) };
        let (until, past) = (turned(turn, from, near), turned(turn, from, far));
        let is_within = last - first >= TAU || (past > 0.0 && past < until);
        free = lesser(free, if is_within { 0.0 } else { until });
    }
    free
}
