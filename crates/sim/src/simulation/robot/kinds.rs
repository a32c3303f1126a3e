//! The lab's three robots as kinds of the simulation.

use crate::simulation::{Extra, SimulatedRobot};
use crate::tour::{Reversing, RouteTour, Sinusoids, Step, Touring, Tracking, Waypoints};
use motion_lab_core::collision::{Collision, MarchOptions, march};
use motion_lab_core::configuration::{HitchCfg, Sizes, Tn};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::{atan2, lesser, wrap};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{
    AnyRobot, CarCmd, EncoderCounts, Hitch, Reach, Robot, Rusty, RustyCmd, WheelSlip, WheelTurns,
};
use motion_lab_core::worlds::World;

/// How short a way Rusty takes back to its route, per metre.
const ROVER_STIFFNESS: f64 = 4.0;

/// Rusty's own state: the accumulated turns of the left and the right wheel, radians, and the number of the waypoint it
/// pursues.
impl SimulatedRobot for Rusty {
    type Tour = Touring<Waypoints>;

    fn tour(&self, _seed: Seed, _name: &str, world: &World, _start: &Pose2) -> Self::Tour {
        Waypoints::of_world(world).into()
    }

    fn route_tour(&self, route: &RouteTour, start: &Pose2) -> Option<Self::Tour> {
        route.suits(self.max_speed).then(|| Touring::Route(route.starting_at(start.position())))
    }

    fn touring(&self, tour: &Self::Tour, tick: u64, dt: f64, q: &Pose2, extra: &mut Extra) -> RustyCmd {
        let tour = match tour {
            Touring::Own(tour) => tour,
            Touring::Route(route) => {
                let Tracking { v, omega } = route.track(q, Step::of_tick(tick, dt), ROVER_STIFFNESS);
                return self.limited(&RustyCmd { v, omega });
            }
        };
        let (command, next) = tour.pursue(self, q, extra[2] as usize);
        extra[2] = next as f64;
        command
    }

    fn resume(&self, tour: &Self::Tour, q: &Pose2, obstacles: &dyn Collision, extra: &mut Extra) {
        let Touring::Own(tour) = tour else { return };
        let reachable = |p: Point2| {
            let goal = Pose2 { x: p.x, y: p.y, theta: q.theta };
            self.edge(q, &goal).is_ok_and(|line| march(obstacles, &line, MarchOptions::default(), None).is_free())
        };
        extra[2] = tour.resume(q.position(), reachable) as f64;
    }

    fn driven(&self, [speed, turn]: [f64; 2]) -> Option<RustyCmd> {
        Some(RustyCmd { v: speed * self.max_speed, omega: turn * self.max_turn_rate })
    }

    fn configuration_at(&self, _now: &Pose2, coordinates: &[f64]) -> Option<Pose2> {
        let &[x, y, theta] = coordinates else { return None };
        Some(Pose2::new(x, y, theta))
    }

    fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        Rusty::with_sizes(self, sizes)
    }

    fn sizes(&self) -> Option<Sizes> {
        Some(Rusty::sizes(self))
    }

    fn lab_model(&self) -> Option<AnyRobot> {
        Some(AnyRobot::Rusty(*self))
    }

    fn initial_extra(&self) -> Extra {
        Extra::from_slice(&[0.0; 3])
    }

    fn actuate(&self, commanded: &RustyCmd, dt: f64, draws: &mut Stream, extra: &mut Extra) -> RustyCmd {
        let turns = self.wheel_turns(commanded, dt);
        extra[0] += turns.left;
        extra[1] += turns.right;
        let mut factor = || 1.0 + self.max_slip * draws.uniform(-1.0, 1.0);
        let slip = WheelSlip { left: factor(), right: factor() };
        self.command_of(&turns, &slip, dt)
    }

    fn sensor_pose(&self, q: &Pose2) -> Option<Pose2> {
        Some(*q)
    }

    fn encoders(&self, extra: &Extra) -> Option<EncoderCounts> {
        Some(self.counts(&WheelTurns { left: extra[0], right: extra[1] }))
    }

    fn odometer(&self, extra: &Extra) -> Option<f64> {
        self.encoders(extra).map(|counts| self.travelled(&counts))
    }
}

/// An arm has no state of its own, no drive channels, and is not held: its motion is scripted or dragged.
impl<const N: usize> SimulatedRobot for Reach<N> {
    type Tour = Sinusoids<N>;

    const HELD: bool = false;

    fn tour(&self, seed: Seed, name: &str, _world: &World, start: &Tn<N>) -> Sinusoids<N> {
        Sinusoids::new(seed, name, *start)
    }

    fn touring(&self, tour: &Sinusoids<N>, tick: u64, dt: f64, q: &Tn<N>, _extra: &mut Extra) -> Option<Tn<N>> {
        Some(tour.follow(q, tick as f64 * dt, dt))
    }

    fn driven(&self, _channels: [f64; 2]) -> Option<Option<Tn<N>>> {
        None
    }

    fn toward(&self, _q: &Tn<N>, target: &Tn<N>) -> Option<Option<Tn<N>>> {
        Some(Some(*target))
    }

    fn configuration_at(&self, _now: &Tn<N>, coordinates: &[f64]) -> Option<Tn<N>> {
        coordinates.try_into().ok().map(|angles| Tn::wrapped(Tn(angles)))
    }

    /// At the tip, along the last link.
    fn mount_pose(&self, q: &Tn<N>) -> Pose2 {
        let tip = Reach::tip(self, q);
        Pose2 { x: tip.x, y: tip.y, theta: self.heading(q) }
    }

    fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        Reach::with_sizes(self, sizes)
    }

    fn sizes(&self) -> Option<Sizes> {
        Some(Reach::sizes(self))
    }

    fn lab_model(&self) -> Option<AnyRobot> {
        AnyRobot::arm(self)
    }

    fn tip(&self, q: &Tn<N>) -> Option<Point2> {
        Some(Reach::tip(self, q))
    }
}

/// The car has no state of its own. Its configuration decides whether it pulls the trailer, and `fitted` gives the
/// model for it.
impl SimulatedRobot for Hitch {
    type Tour = Touring<Reversing>;

    fn tour(&self, seed: Seed, name: &str, _world: &World, _start: &HitchCfg) -> Self::Tour {
        Reversing::new(seed, name, self).into()
    }

    fn route_tour(&self, route: &RouteTour, start: &HitchCfg) -> Option<Self::Tour> {
        route.suits(self.max_speed).then(|| Touring::Route(route.starting_at(start.body.position())))
    }

    /// On a route the car's rear axle tracks the reference; its way back to the line is as long as its wheelbase.
    fn touring(&self, tour: &Self::Tour, tick: u64, dt: f64, q: &HitchCfg, _extra: &mut Extra) -> CarCmd {
        match tour {
            Touring::Own(tour) => tour.command(self, tick, dt),
            Touring::Route(route) => {
                let Tracking { v, omega } = route.track(&q.body, Step::of_tick(tick, dt), 1.0 / self.wheelbase);
                let v = lesser(v, self.max_speed);
                let phi = if v > 0.0 { atan2(self.wheelbase * omega, v) } else { 0.0 };
                CarCmd { v, phi: phi.clamp(-self.max_steer, self.max_steer) }
            }
        }
    }

    fn driven(&self, [speed, steering]: [f64; 2]) -> Option<CarCmd> {
        Some(CarCmd { v: speed * self.max_speed, phi: steering * self.max_steer })
    }

    /// Three coordinates place the car, with its trailer, if it pulls one, straight behind. The fourth, the trailer's
    /// heading, fits only a car that pulls it.
    fn configuration_at(&self, now: &HitchCfg, coordinates: &[f64]) -> Option<HitchCfg> {
        let (&[x, y, theta], rest) = coordinates.split_first_chunk()?;
        let body = Pose2::new(x, y, theta);
        let trailer = match (now.trailer, rest) {
            (None, []) => None,
            (Some(_), []) => Some(body.theta),
            (Some(_), [psi]) => Some(wrap(*psi)),
            _ => return None,
        };
        Some(HitchCfg { body, trailer })
    }

    fn with_trailer_set(&self, q: &HitchCfg, on: bool) -> Option<HitchCfg> {
        let trailer = if on { Some(q.trailer.unwrap_or(q.body.theta)) } else { None };
        Some(HitchCfg { body: q.body, trailer })
    }

    /// The car's rear axle, with the car's heading.
    fn mount_pose(&self, q: &HitchCfg) -> Pose2 {
        q.body
    }

    fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        Hitch::with_sizes(self, sizes)
    }

    fn sizes(&self) -> Option<Sizes> {
        Some(Hitch::sizes(self))
    }

    fn lab_model(&self) -> Option<AnyRobot> {
        Some(AnyRobot::Hitch(*self))
    }

    fn fitted(&self, q: &HitchCfg) -> Hitch {
        if q.trailer.is_some() { self.with_trailer() } else { self.without_trailer() }
    }
}
