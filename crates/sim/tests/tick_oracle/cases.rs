//! Random worlds, robots in them, and random scripts for the robots.

use std::f64::consts::TAU;

use motion_lab_core::geometry::{Placed, Point2, Vertices};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::{Event, RobotInput, RobotState, Script};
use motion_lab_sim::tour::TourConfig;

use super::meetings::clearance;
use super::robots::{Kind, shapes, wrap};
use crate::simulator::{event, quantized, script};
use oracle::fixtures::convex_corners;

pub const SENSOR: RangeSensor = RangeSensor { n_rays: 7, max_range: 1.5 };

/// A robot of the run.
#[derive(Clone, Debug)]
pub struct Resident {
    pub name: String,
    pub kind: Kind,
    /// The number of the arena it lives in.
    pub arena: usize,
    pub start: Vec<f64>,
}

/// A walled square with obstacles of every kind, as shapes and as the text of a world file.
#[derive(Clone, Debug)]
pub struct Arena {
    half: f64,
    pub obstacles: Vec<Placed>,
    /// The place of an arm's base, where neither obstacles nor robots on wheels are put.
    kept_free: Vec<Placed>,
    /// Lists of the world file.
    walls: String,
    solids: String,
    /// The waypoints of a touring Rusty.
    pub tour: Vec<Point2>,
}

/// Everything that determines a run.
#[derive(Clone, Debug)]
pub struct Case {
    pub seed: Seed,
    pub arenas: Vec<Arena>,
    /// By id.
    pub residents: Vec<Resident>,
    pub ticks: u64,
    pub script: Script,
}

fn xy(p: &Point2) -> String {
    format!("({:?}, {:?})", p.x, p.y)
}

fn list(points: &[Point2]) -> String {
    format!("[{}]", points.iter().map(xy).collect::<Vec<_>>().join(", "))
}

fn placed(corners: &[Point2], radius: f64) -> Placed {
    Placed::new(Vertices::from_slice(corners), radius)
}

impl Arena {
    /// An arena of this half-width with six obstacles of about this size, for an arm or without one.
    fn random(draws: &mut Stream, half: f64, size: f64, for_arm: bool) -> Self {
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Point2::new(x, y));
        let obstacles = (0..4).map(|i| placed(&[corners[i], corners[(i + 1) % 4]], 0.0)).collect();
        let walls = format!("(name: \"the wall\", points: {}, closed: true), ", list(&corners));
        let kept_free = if for_arm { shapes(Kind::Rusty, &[0.0, 0.0]) } else { Vec::new() };
        let mut arena = Arena { half, obstacles, kept_free, walls, solids: String::new(), tour: Vec::new() };
        for number in 0..6 {
            let (mut thing, mut text) = arena.random_thing(draws, size, number);
            while clearance(std::slice::from_ref(&thing), &arena.kept_free) < 0.1 {
                (thing, text) = arena.random_thing(draws, size, number);
            }
            arena.obstacles.push(thing);
            if number == 0 {
                arena.walls += &format!("(name: \"the screen\", points: {text})");
            } else {
                arena.solids += &format!("(name: \"thing {number}\", shape: {text}), ");
            }
        }
        if draws.below(4) > 0 {
            arena.tour = (0..4).map(|_| arena.random_point(draws)).collect();
        }
        arena
    }

    fn random_point(&self, draws: &mut Stream) -> Point2 {
        Point2::new(draws.uniform(-self.half, self.half), draws.uniform(-self.half, self.half))
    }

    /// The shape of an obstacle and its text; for a screen, the text of its points.
    fn random_thing(&self, draws: &mut Stream, size: f64, number: u32) -> (Placed, String) {
        let at = self.random_point(draws);
        let mut near = |scale: f64| {
            let (x, y) = (draws.uniform(0.3, 1.0), draws.uniform(0.3, 1.0));
            Point2::new(at.x + scale * size * x, at.y + scale * size * y)
        };
        let (a, b) = (near(-1.0), near(1.0));
        let round = 0.3 * size;
        let corners: Vec<Point2> = convex_corners(draws, size).iter().map(|p| at + p.coords).collect();
        match number {
            0 => (placed(&[a, b], 0.0), list(&[a, b])),
            1 => {
                let corners = [a, Point2::new(b.x, a.y), b, Point2::new(a.x, b.y)];
                (placed(&corners, 0.0), format!("Box(min: {}, max: {})", xy(&a), xy(&b)))
            }
            2 => (placed(&[at], round), format!("Disc(center: {}, radius: {round:?})", xy(&at))),
            3 => (placed(&corners, 0.0), format!("Polygon({})", list(&corners))),
            4 => (placed(&[a, b], round), format!("Rounded(points: {}, radius: {round:?})", list(&[a, b]))),
            _ => (placed(&corners, round), format!("Rounded(points: {}, radius: {round:?})", list(&corners))),
        }
    }

    /// The world file, with the robots of this arena.
    fn text(&self, number: usize, residents: &[Resident]) -> String {
        let Arena { half, walls, solids, tour, .. } = self;
        let robot = |a: &Resident| format!("(name: {:?}, kind: {:?}, start: {:?}), ", a.name, a.kind.name(), a.start);
        let robots: String = residents.iter().filter(|a| a.arena == number).map(robot).collect();
        let marks = if tour.is_empty() { String::new() } else { format!("(name: \"tour\", points: {})", list(tour)) };
        format!(
            "World(version: 1, name: \"arena {number}\", bounds: (min: (-{half:?}, -{half:?}), max: ({half:?}, {half:?})), \
             walls: [{walls}], obstacles: [{solids}], marks: [{marks}], robots: [{robots}])"
        )
    }
}

/// Any configuration of a robot in an arena.
fn random_configuration(draws: &mut Stream, kind: Kind, towing: bool, half: f64) -> Vec<f64> {
    if kind.is_arm() {
        return kind.links().iter().map(|_| draws.uniform(-3.1, 3.1)).collect();
    }
    let mut q = vec![draws.uniform(-half, half), draws.uniform(-half, half), draws.uniform(-3.1, 3.1)];
    if kind == Kind::Hitch && towing {
        q.push(wrap(q[2] + draws.uniform(-0.8, 0.8)));
    }
    q
}

impl Case {
    /// Case number `number`: several robots of various kinds in one arena, and one alone in another.
    pub fn random(number: u64) -> Self {
        let mut draws = Stream::new(Seed(number), "tick oracle");
        let arm = [Kind::Reach, Kind::Reach3][(number / 3 % 2) as usize];
        let (half, size, mut crowd) = match number % 3 {
            0 => (0.9, 0.15, vec![Kind::Rusty; 8]),
            1 => (6.0, 0.7, vec![Kind::Hitch, Kind::Rusty, Kind::Hitch, Kind::Hitch, Kind::Rusty]),
            _ => (3.2, 0.4, vec![Kind::Rusty, arm, Kind::Rusty, Kind::Hitch, Kind::Rusty, Kind::Rusty]),
        };
        let by = number as usize % crowd.len();
        crowd.rotate_left(by); // an arm has a low id in one case and a high one in another
        let (alone, room) =
            [(Kind::Rusty, 1.0), (Kind::Hitch, 6.0), (arm, 1.9), (Kind::Hitch, 5.0)][(number % 4) as usize];
        let arenas = vec![
            Arena::random(&mut draws, half, size, crowd.contains(&arm)),
            Arena::random(&mut draws, room, 0.15 * room, alone.is_arm()),
        ];
        // in some cases a touring Hitch reaches its second leg
        let ticks = if number % 8 == 5 { 210 } else { 60 };
        let mut case = Case { seed: Seed(number), arenas, residents: Vec::new(), ticks, script: Script::empty() };
        for (kind, arena) in crowd.into_iter().map(|kind| (kind, 0)).chain([(alone, 1)]) {
            case.add(&mut draws, kind, arena);
        }
        case.script = case.random_script(&mut draws, number % 8 >= 4);
        case
    }

    /// Adds a robot at a random free configuration, if one is found.
    fn add(&mut self, draws: &mut Stream, kind: Kind, arena: usize) {
        let taken: Vec<Placed> = self.in_arena(arena).flat_map(|(_, a)| shapes(a.kind, &a.start)).collect();
        let Arena { half, obstacles, kept_free, .. } = &self.arenas[arena];
        for _ in 0..300 {
            let towing = draws.below(2) == 0;
            let start = random_configuration(draws, kind, towing, *half);
            let parts = shapes(kind, &start);
            let free = clearance(&parts, obstacles) > 0.01 && clearance(&parts, &taken) > 0.01;
            if free && (kind.is_arm() || clearance(&parts, kept_free) > 0.01) {
                self.residents.push(Resident { name: format!("robot {}", self.residents.len()), kind, arena, start });
                return;
            }
        }
    }

    /// The robots of an arena with their ids.
    pub fn in_arena(&self, arena: usize) -> impl Iterator<Item = (usize, &Resident)> {
        self.residents.iter().enumerate().filter(move |(_, a)| a.arena == arena)
    }

    /// Everything that a robot may not touch: the obstacles and the other robots of its arena.
    pub fn around(&self, robots: &[RobotState], id: usize) -> Vec<Placed> {
        let arena = self.residents[id].arena;
        let others = self.in_arena(arena).filter(|(other, _)| *other != id);
        let others = others.flat_map(|(other, a)| shapes(a.kind, &robots[other].configuration));
        self.arenas[arena].obstacles.iter().cloned().chain(others).collect()
    }

    /// Inputs at random ticks. With `alone_tours`, the robot that is alone in its arena gets none.
    fn random_script(&self, draws: &mut Stream, alone_tours: bool) -> Script {
        let mut events: Vec<Event> = Vec::new();
        for tick in 1..=self.ticks {
            for resident in self.residents.iter().filter(|a| !(alone_tours && a.arena == 1)) {
                let half = self.arenas[resident.arena].half;
                if tick == 1 && draws.below(4) > 0 {
                    events.push(event(tick, &resident.name, random_driving(draws, resident.kind)));
                } else if draws.below(10) == 0 {
                    events.push(event(tick, &resident.name, random_input(draws, resident.kind, half)));
                }
            }
        }
        script(events)
    }

    /// The configuration of the run.
    pub fn config(&self) -> TourConfig {
        let parse = |(number, arena): (usize, &Arena)| {
            let text = arena.text(number, &self.residents);
            World::parse("arena.ron", &text).unwrap_or_else(|error| panic!("{error}:\n{text}"))
        };
        let worlds = self.arenas.iter().enumerate().map(parse).collect();
        TourConfig { worlds, ticks: self.ticks, sensor: Some(SENSOR) }
    }
}

/// Channels for wheels, a target for an arm.
fn random_driving(draws: &mut Stream, kind: Kind) -> RobotInput {
    if kind.is_arm() {
        return RobotInput::MoveTo(quantized(&random_configuration(draws, kind, false, 0.0)));
    }
    let mut any = || draws.below(257) as i16 - 128;
    let (speed, steering, full) = (any(), any(), any());
    RobotInput::Drive(if full > 0 { 128 * speed.signum() } else { speed }, steering)
}

/// An input of any kind; the robot may have to refuse it.
fn random_input(draws: &mut Stream, kind: Kind, half: f64) -> RobotInput {
    // Hitch gets more of the one input that only it accepts
    let (roll, towing) = (draws.below(if kind == Kind::Hitch { 28 } else { 20 }), draws.below(2) == 0);
    let mut q = random_configuration(draws, kind, towing, half);
    if draws.below(4) == 0 {
        *q.last_mut().unwrap() += TAU;
    }
    match roll {
        0..=9 => random_driving(draws, kind),
        10..=13 => RobotInput::Teleport(quantized(&q)),
        14..=16 | 20.. => RobotInput::SetTrailer(towing),
        17 => RobotInput::Release,
        18 if kind.is_arm() => RobotInput::Drive(64, -64),
        18 => RobotInput::MoveTo(quantized(&q)),
        _ => RobotInput::Teleport(quantized(&q[1..])),
    }
}
