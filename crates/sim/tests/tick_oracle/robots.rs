//! The robots' footprints and their motions within a tick, by their equations. Only the robots' dimensions come from
//! the library.

use libm::{cos, sin, tan};
use motion_lab_core::geometry::{Placed, Point2};
use motion_lab_core::robots::{HITCH, RUSTY, Reach};

use oracle::short;

/// The number of Runge-Kutta steps from the start of a motion to a place on it.
const STEPS: u32 = 8;

static REACH: Reach<2> = Reach::<2>::workbench();
static REACH3: Reach<3> = Reach::<3>::redundant();

/// A kind of robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Rusty,
    Hitch,
    Reach,
    Reach3,
}

impl Kind {
    /// The name in world files.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Rusty => "rusty",
            Kind::Hitch => "hitch",
            Kind::Reach => "reach",
            Kind::Reach3 => "reach3",
        }
    }

    /// The lengths of an arm's links, metres; empty for a robot on wheels.
    pub fn links(self) -> &'static [f64] {
        match self {
            Kind::Rusty | Kind::Hitch => &[],
            Kind::Reach => &REACH.lengths,
            Kind::Reach3 => &REACH3.lengths,
        }
    }

    pub fn is_arm(self) -> bool {
        !self.links().is_empty()
    }
}

/// The angle in (-pi, pi].
pub fn wrap(angle: f64) -> f64 {
    short(0.0, angle)
}

/// The distance from the hitch to the trailer's axle, metres.
fn drawbar() -> f64 {
    HITCH.with_trailer().hitch_len.unwrap()
}

/// A rectangle seen from a point on its middle line, metres.
struct Rectangle {
    /// The near end, ahead of the point.
    from: f64,
    /// The far end, ahead of the point.
    to: f64,
    /// Half its width.
    half: f64,
}

/// The chassis, seen from the rear axle.
fn chassis() -> Rectangle {
    let body = HITCH.body;
    Rectangle { from: -body.rear_overhang, to: body.length - body.rear_overhang, half: 0.5 * body.width }
}

/// The trailer's box, seen from the hitch.
fn trailer() -> Rectangle {
    let (body, axle) = (HITCH.trailer_body, -drawbar());
    Rectangle { from: axle - body.rear_overhang, to: axle + body.front_overhang, half: 0.5 * body.width }
}

impl Rectangle {
    /// The distance of the farthest corner, metres.
    fn farthest(&self) -> f64 {
        let length = if self.from.abs() > self.to.abs() { self.from } else { self.to };
        (length * length + self.half * self.half).sqrt()
    }

    fn placed(&self, x: f64, y: f64, heading: f64) -> Placed {
        let Rectangle { from, to, half } = *self;
        let (s, c) = (sin(heading), cos(heading));
        let corner = |ahead: f64, left: f64| Point2::new(x + c * ahead - s * left, y + s * ahead + c * left);
        Placed::new([corner(from, -half), corner(to, -half), corner(to, half), corner(from, half)], 0.0)
    }
}

/// The parts of a robot's footprint.
pub fn shapes(kind: Kind, q: &[f64]) -> Vec<Placed> {
    match kind {
        Kind::Rusty => vec![Placed::new([Point2::new(q[0], q[1])], RUSTY.body_radius)],
        Kind::Hitch => {
            let mut parts = vec![chassis().placed(q[0], q[1], q[2])];
            parts.extend(q.get(3).map(|psi| trailer().placed(q[0], q[1], *psi)));
            parts
        }
        Kind::Reach | Kind::Reach3 => {
            let (mut heading, mut joint) = (0.0_f64, REACH.base);
            let link = |(angle, length): (&f64, &f64)| {
                heading += angle;
                let next = Point2::new(joint.x + length * cos(heading), joint.y + length * sin(heading));
                Placed::new([std::mem::replace(&mut joint, next), next], REACH.link_radius)
            };
            q.iter().zip(kind.links()).map(link).collect()
        }
    }
}

/// A robot's motion within one tick, over a parameter in [0, 1].
#[derive(Clone, Debug)]
pub enum Motion {
    /// At a constant speed and turn rate: metres ahead and radians to the left in the whole tick.
    Wheels { kind: Kind, start: Vec<f64>, ahead: f64, turn: f64 },
    /// Every joint at a constant rate: radians in the whole tick.
    Joints { kind: Kind, start: Vec<f64>, turns: Vec<f64> },
}

impl Motion {
    /// Rusty's motion when its wheels cover these distances on the ground, metres.
    pub fn of_wheels(start: &[f64], left: f64, right: f64) -> Self {
        let (ahead, turn) = (0.5 * (left + right), (right - left) / RUSTY.track);
        Motion::Wheels { kind: Kind::Rusty, start: start.to_vec(), ahead, turn }
    }

    /// Hitch's motion over this distance, metres, at this steering angle.
    pub fn of_car(start: &[f64], ahead: f64, steering: f64) -> Self {
        let turn = ahead * tan(steering) / HITCH.wheelbase;
        Motion::Wheels { kind: Kind::Hitch, start: start.to_vec(), ahead, turn }
    }

    /// An arm's motion to these joint angles.
    pub fn of_joints(kind: Kind, start: &[f64], to: &[f64]) -> Self {
        let turns = start.iter().zip(to).map(|(a, b)| short(*a, *b)).collect();
        Motion::Joints { kind, start: start.to_vec(), turns }
    }

    /// Rusty's disc in a straight line to a point.
    pub fn of_line(start: &[f64], to: &Point2) -> Self {
        let (dx, dy) = (to.x - start[0], to.y - start[1]);
        let start = vec![start[0], start[1], libm::atan2(dy, dx)];
        Motion::Wheels { kind: Kind::Rusty, start, ahead: (dx * dx + dy * dy).sqrt(), turn: 0.0 }
    }

    /// The configuration at `s`.
    pub fn at(&self, s: f64) -> Vec<f64> {
        match self {
            Motion::Wheels { start, ahead, turn, .. } => driven(start, s * ahead, s * turn),
            Motion::Joints { start, turns, .. } => {
                start.iter().zip(turns).map(|(q, turn)| wrap(q + s * turn)).collect()
            }
        }
    }

    /// The parts of the footprint at `s`.
    pub fn shapes_at(&self, s: f64) -> Vec<Placed> {
        let (Motion::Wheels { kind, .. } | Motion::Joints { kind, .. }) = self;
        shapes(*kind, &self.at(s))
    }

    /// The greatest distance that a point of the footprint can move in the tick, metres.
    pub fn speed(&self) -> f64 {
        match self {
            Motion::Wheels { kind: Kind::Hitch, start, ahead, turn } => {
                let body = chassis().farthest() * turn.abs();
                let towed = if start.len() == 4 { trailer().farthest() * ahead.abs() / drawbar() } else { 0.0 };
                ahead.abs() + if towed > body { towed } else { body }
            }
            Motion::Wheels { ahead, .. } => ahead.abs(),
            Motion::Joints { kind, turns, .. } => {
                let mut rate = 0.0_f64;
                let of_link = |(turn, length): (&f64, &f64)| {
                    rate += turn;
                    length * rate.abs()
                };
                turns.iter().zip(kind.links()).map(of_link).sum()
            }
        }
    }

    /// The parameter at which a robot on wheels is as far from its start as `q` is.
    pub fn parameter_of(&self, q: &[f64]) -> f64 {
        let start = self.at(0.0);
        let moved = |p: &[f64]| (p[0] - start[0]) * (p[0] - start[0]) + (p[1] - start[1]) * (p[1] - start[1]);
        let (mut near, mut far) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (near + far);
            if moved(&self.at(middle)) < moved(q) {
                near = middle;
            } else {
                far = middle;
            }
        }
        far
    }
}

/// The configuration after a motion on wheels: x' = v cos theta, y' = v sin theta, theta' = omega, and of a trailer
/// psi' = (v / drawbar) sin(theta - psi), integrated together in small steps.
fn driven(start: &[f64], ahead: f64, turn: f64) -> Vec<f64> {
    let towing = start.len() == 4;
    let slope = |q: [f64; 4]| {
        let trailer = if towing { ahead / drawbar() * sin(q[2] - q[3]) } else { 0.0 };
        [ahead * cos(q[2]), ahead * sin(q[2]), turn, trailer]
    };
    let along = |q: [f64; 4], k: [f64; 4], h: f64| -> [f64; 4] { std::array::from_fn(|i| q[i] + h * k[i]) };
    let h = 1.0 / f64::from(STEPS);
    let mut q: [f64; 4] = std::array::from_fn(|i| start.get(i).copied().unwrap_or(0.0));
    for _ in 0..STEPS {
        let k1 = slope(q);
        let k2 = slope(along(q, k1, 0.5 * h));
        let k3 = slope(along(q, k2, 0.5 * h));
        let k4 = slope(along(q, k3, h));
        q = std::array::from_fn(|i| q[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    let end = [q[0], q[1], wrap(q[2]), wrap(q[3])];
    end[..start.len()].to_vec()
}
