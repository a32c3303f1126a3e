//! A robot of one's own, added without touching the library: a car that pulls two trailers, on tour in the Lot.
//!
//! `cargo run --example custom_robot`
//!
//! Four things make a robot: its configurations (`Configuration`), its footprint and how fast its parts can move
//! (`Robot`, all that planners and the checker need), its controls (`Drivable`), and its tour (`SimulatedRobot`).
//! Worlds, logs and scripts then name it by a kind that begins with `x-`.
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::f64::consts::PI;
use std::fmt;

use motion_lab::configuration::{ChartMismatch, Coordinates, InputKind, Kinds, RobotKind, Space};
use motion_lab::geometry::Tangent2;
use motion_lab::num::{atan2, cos, hypot, in_range, sin, sin_cos, tan, wrap};
use motion_lab::prelude::*;
use motion_lab::recording::{Run, final_lines_with, verify_with_robots};
use motion_lab::robots::{ConfigurationError, PartRates, Rates, TICK, check_drive_rates, check_rates};
use motion_lab::run::Log;
use motion_lab::simulation::{App, Extra, RobotPlugin, SimulatedRobot};
use motion_lab::tour::TourConfig;
use motion_lab::worlds::{Resident, World};

/// The configuration of a train: the pose of the car's rear axle, and each trailer's heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainCfg {
    /// The car.
    pub body: Pose2,
    /// The trailers' headings, radians, the front one first.
    pub psi: [f64; 2],
}

impl fmt::Display for TrainCfg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let p = f.precision().unwrap_or(3);
        let TrainCfg { body, psi: [a, b] } = self;
        write!(f, "TrainCfg {{ body: {body:.p$}, psi1: {a:.p$}, psi2: {b:.p$} }}")
    }
}

impl Configuration for TrainCfg {
    fn is_finite(&self) -> bool {
        self.body.is_finite() && self.psi.iter().all(|psi| psi.is_finite())
    }

    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch> {
        let mut d = self.body.difference(&to.body)?;
        d.extend([0, 1].map(|i| wrap(to.psi[i] - self.psi[i])));
        Ok(d)
    }

    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch> {
        let turn = |i: usize| wrap(self.psi[i] + s * wrap(to.psi[i] - self.psi[i]));
        // the ends are exact, bit for bit
        let psi = [0, 1].map(|i| {
            if s >= 1.0 {
                to.psi[i]
            } else if s == 0.0 {
                self.psi[i]
            } else {
                turn(i)
            }
        });
        Ok(TrainCfg { body: self.body.interpolate(&to.body, s)?, psi })
    }

    fn in_chart(&self) -> Self {
        TrainCfg { body: self.body.in_chart(), psi: self.psi.map(in_range) }
    }

    fn coordinates(&self) -> Coordinates {
        let mut all = self.body.coordinates();
        all.extend(self.psi);
        all
    }

    fn coordinate_names(&self) -> Vec<String> {
        ["x", "y", "theta", "psi1", "psi2"].map(String::from).to_vec()
    }

    fn from_coordinates(coordinates: &[f64]) -> Option<Self> {
        let &[x, y, theta, psi1, psi2] = coordinates else { return None };
        Some(TrainCfg { body: Pose2 { x, y, theta }, psi: [psi1, psi2] })
    }
}

/// A car with two trailers. A trailer's hitch is the middle of the axle before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Train {
    /// The distance from the car's rear axle to its front axle, metres.
    pub wheelbase: f64,
    /// Largest steering angle, radians.
    pub max_steer: f64,
    /// Speed on tour, metres per second.
    pub speed: f64,
    /// The distance from each hitch to the trailer's axle, metres.
    pub draw_bar: f64,
    /// The width of car and trailers, metres.
    pub width: f64,
    /// The overhang of each beyond its axles, metres.
    pub overhang: f64,
}

/// A train that goes round the Lot's pillars.
pub const TRAIN: Train = Train { wheelbase: 1.2, max_steer: 0.6, speed: 1.0, draw_bar: 1.0, width: 0.6, overhang: 0.3 };

impl Train {
    /// Each part's frame, and its box in it: the car from its rear axle, a trailer from its hitch.
    fn parts(&self, q: &TrainCfg) -> [(Pose2, Point2, Point2); 3] {
        let corner = |x: f64, side: f64| Point2::new(x, side * 0.5 * self.width);
        let first = Pose2 { theta: q.psi[0], ..q.body };
        let axle = first.transform(Point2::new(-self.draw_bar, 0.0));
        let second = Pose2 { x: axle.x, y: axle.y, theta: q.psi[1] };
        let trailer = (corner(-self.draw_bar - self.overhang, -1.0), corner(-self.draw_bar + self.overhang, 1.0));
        let car = (corner(-self.overhang, -1.0), corner(self.wheelbase + self.overhang, 1.0));
        [(q.body, car.0, car.1), (first, trailer.0, trailer.1), (second, trailer.0, trailer.1)]
    }

    /// The distance of a part's farthest point from the origin of its frame, metres.
    fn reach(&self, part: usize) -> f64 {
        let ahead = if part == 0 { self.wheelbase } else { self.draw_bar };
        hypot(ahead + self.overhang, 0.5 * self.width)
    }

    /// The rates of the three parts, when the rear axle moves at `origin` and heading `i` turns at `turns[i]`, which
    /// changes by up to `bends[i]`. A trailer's frame hangs on the axle before it, which adds that trailer's own
    /// turning.
    fn rates(&self, origin: Rates, turns: [f64; 3], bends: [f64; 3]) -> PartRates {
        let swing = |at: Rates, radius: f64, i: usize| Rates {
            speed: at.speed + radius * turns[i].abs(),
            acceleration: at.acceleration + radius * (turns[i] * turns[i] + bends[i]),
        };
        let axle = swing(origin, self.draw_bar, 1);
        let origins = [origin, origin, axle];
        (0..3).map(|i| swing(origins[i], self.reach(i), i)).collect()
    }
}

impl Robot for Train {
    type Configuration = TrainCfg;

    fn check(&self, q: &TrainCfg) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &TrainCfg) -> Footprint {
        Footprint::rects(self.parts(q))
    }

    fn edge_rates(&self, a: &TrainCfg, b: &TrainCfg) -> Result<PartRates, ConfigurationError> {
        let d = a.difference(b)?;
        let origin = Rates { speed: hypot(d[0], d[1]), acceleration: 0.0 };
        Ok(self.rates(origin, [d[2], d[3], d[4]], [0.0; 3]))
    }

    fn sample(&self, min: Point2, max: Point2, s: &mut Stream) -> TrainCfg {
        let (x, y) = (s.uniform(min.x, max.x), s.uniform(min.y, max.y));
        let mut angle = || wrap(s.uniform(-PI, PI));
        TrainCfg { body: Pose2 { x, y, theta: angle() }, psi: [angle(), angle()] }
    }
}

/// A train's motion under a constant control: the car on its arc, the trailers drawn along.
#[derive(Clone, Debug)]
pub struct TrainArc {
    train: Train,
    start: TrainCfg,
    ahead: f64,
    turn: f64,
    rates: PartRates,
}

impl TrainArc {
    /// The turn rates of the trailers per unit of `s`: each axle follows its hitch and does not slide sideways.
    fn slope(&self, s: f64, [psi1, psi2]: [f64; 2]) -> [f64; 2] {
        let off = self.start.body.theta + s * self.turn - psi1;
        let (first, rate) = (self.ahead * cos(off), 1.0 / self.train.draw_bar);
        [self.ahead * sin(off) * rate, first * sin(psi1 - psi2) * rate]
    }
}

impl Motion for TrainArc {
    type Configuration = TrainCfg;

    fn at(&self, s: f64) -> TrainCfg {
        if s == 0.0 {
            return self.start;
        }
        let body = self.start.body.boxplus(&Tangent2::new(s * self.ahead, 0.0, s * self.turn));
        let along = |psi: [f64; 2], k: [f64; 2], h: f64| [psi[0] + h * k[0], psi[1] + h * k[1]];
        let (h, mut psi) = (0.25 * s, self.start.psi);
        for i in 0..4 {
            let t = f64::from(i) * h; // four steps of Runge and Kutta's method
            let k1 = self.slope(t, psi);
            let k2 = self.slope(t + 0.5 * h, along(psi, k1, 0.5 * h));
            let k3 = self.slope(t + 0.5 * h, along(psi, k2, 0.5 * h));
            let k4 = self.slope(t + h, along(psi, k3, h));
            psi = [0, 1].map(|j| psi[j] + h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]));
        }
        TrainCfg { body, psi: psi.map(wrap) }
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        self.train.footprint(&self.at(s))
    }

    fn rates(&self, part: usize) -> Rates {
        self.rates[part]
    }
}

impl Drivable for Train {
    type Control = CarCmd;
    type Drive = TrainArc;

    fn drive(&self, q: &TrainCfg, u: &CarCmd, dt: f64) -> Result<TrainArc, ConfigurationError> {
        self.check(q)?;
        let ahead = u.v * dt;
        let turn = ahead * tan(u.phi.clamp(-self.max_steer, self.max_steer)) / self.wheelbase;
        if !(ahead.is_finite() && turn.is_finite()) {
            return Err(ConfigurationError::ControlNotFinite);
        }
        // no axle is faster than the one before it; one percent is added for the error of the numerical solution
        let origin = Rates { speed: ahead.abs(), acceleration: (ahead * turn).abs() };
        let spin = 1.01 * ahead.abs() / self.draw_bar;
        let first = 1.01 * spin * (turn.abs() + spin);
        let second = 1.01 * spin * (turn.abs() + spin + 2.0 * spin);
        let rates = self.rates(origin, [turn, spin, spin], [0.0, first, second]);
        Ok(TrainArc { train: *self, start: *q, ahead, turn, rates })
    }
}

/// A loop round the middle of a world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loop {
    middle: Point2,
    half: Vector2,
}

impl SimulatedRobot for Train {
    type Tour = Loop;

    /// The seed decides the width of the loop.
    fn tour(&self, seed: Seed, name: &str, world: &World, _start: &TrainCfg) -> Loop {
        let mut draws = Stream::new(seed, &format!("{name}/tour"));
        let size = world.bounds.max - world.bounds.min;
        let half = Vector2::new(size.x * draws.uniform(0.32, 0.38), size.y * draws.uniform(0.29, 0.33));
        Loop { middle: world.bounds.min + size * 0.5, half }
    }

    /// Steers towards a point a little ahead on the loop.
    fn touring(&self, tour: &Loop, _tick: u64, _dt: f64, q: &TrainCfg, _extra: &mut Extra) -> CarCmd {
        let from_middle = q.body.position() - tour.middle;
        let (s, c) = sin_cos(atan2(from_middle.y / tour.half.y, from_middle.x / tour.half.x) + 0.4);
        let carrot = tour.middle + Vector2::new(c * tour.half.x, s * tour.half.y) - q.body.position();
        CarCmd { v: self.speed, phi: 1.5 * wrap(atan2(carrot.y, carrot.x) - q.body.theta) }
    }

    fn driven(&self, [speed, steering]: [f64; 2]) -> Option<CarCmd> {
        Some(CarCmd { v: speed * self.speed, phi: steering * self.max_steer })
    }

    fn configuration_at(&self, _now: &TrainCfg, coordinates: &[f64]) -> Option<TrainCfg> {
        let q = TrainCfg::from_coordinates(coordinates)?;
        Some(TrainCfg { body: Pose2::new(q.body.x, q.body.y, q.body.theta), psi: q.psi.map(wrap) })
    }
}

/// What figures, plots and a window show of trains: names, spaces, and how a configuration prints.
pub static ABOUT: RobotKind = RobotKind {
    name: "x-train",
    title: "Train",
    home: None,
    usual: None,
    sizes: None,
    coordinates: &["x", "y", "theta", "psi1", "psi2"],
    lengths: 2,
    start: "five: x, y, theta, psi1, psi2",
    spaces: &[Space {
        coordinates: 5,
        formula: "q = (x, y, \u{3b8}, \u{3c8}_1, \u{3c8}_2) \u{2208} SE(2) \u{d7} T^2",
        words: "Position and heading of the car, and the heading of each trailer.",
    }],
    drives: true,
    takes: &[InputKind::Drive, InputKind::Teleport, InputKind::Release],
    senses: false,
    has_encoders: false,
    difference: |from, to| TrainCfg::from_coordinates(from)?.difference(&TrainCfg::from_coordinates(to)?).ok(),
    printed: |q| TrainCfg::from_coordinates(q).map(|q| q.to_string()),
};

/// Registers [`TRAIN`] as the kind `x-train`. A window of one's own takes it too:
/// `motion_lab::app::run_window_with(with_trains)`.
pub fn with_trains(app: &mut App) {
    app.add_plugins(RobotPlugin::new(ABOUT.name, TRAIN).described(&ABOUT));
}

/// A minute of a train in the Lot.
pub fn config() -> TourConfig {
    let mut lot = World::lot();
    lot.robots = vec![Resident::new("Train", ABOUT.name, [8.0, 1.9, 0.0, 0.0, 0.0])];
    TourConfig { worlds: vec![lot], ticks: 1200, sensor: None }
}

/// The recorded run, written as a log file and read back.
pub fn record(seed: Seed) -> Result<Log, Box<dyn Error>> {
    let mut file = Vec::new();
    Run::record_with_robots(config(), seed, with_trains)?.write_mcap(&mut file)?;
    Ok(Log::read_mcap(&file)?.log)
}

/// Checks the motion bounds above by sampling. The checker trusts them: one too small proves motions free that are not.
pub fn check_bounds() -> Result<(), Box<dyn Error>> {
    check_rates(&TRAIN, 20_000)?;
    let controls = [(3.0, 0.6), (-3.0, 0.6), (1.0, -0.2)].map(|(v, phi)| CarCmd { v, phi });
    check_drive_rates(&TRAIN, &controls, TICK, 20_000)?;
    Ok(())
}

/// The program's output.
pub fn report() -> Result<String, Box<dyn Error>> {
    check_bounds()?;
    let log = record(motion_lab::tour::BOOK_SEED)?;
    let verified = verify_with_robots(&log, with_trains, |_| {})?;
    let mut lines = final_lines_with(&log, &Kinds::default().with(ABOUT.name, &ABOUT));
    lines.push(format!("{} of {} ticks bit-identical in the replay\n", verified.identical, verified.recorded));
    Ok(lines.join("\n"))
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}
