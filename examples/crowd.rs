//! A hundred robots from code: rovers, cars, cars with trailers and arms in four walled squares, for a minute.
//!
//! `cargo run --release --example crowd`
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;

use motion_lab::configuration::RobotKind;
use motion_lab::geometry::Aabb;
use motion_lab::prelude::*;
use motion_lab::recording::Run;
use motion_lab::run::Log;
use motion_lab::tour::{TOUR_MARK, TourConfig};
use motion_lab::worlds::{Mark, Obstacle, ObstacleKind, Resident};

/// The squares.
const SQUARES: u32 = 4;

/// Robots in a row of a square, and rows.
const ROW: u32 = 5;

/// The distance between neighbours at their starts, metres.
const APART: f64 = 6.0;

/// Half the side of the square, metres.
const HALF: f64 = 0.5 * ROW as f64 * APART;

/// The middle of place number `i`, row by row from the south-west.
fn place(i: u32) -> Point2 {
    let along = |k: u32| (f64::from(k) + 0.5) * APART - HALF;
    Point2::new(along(i % ROW), along(i / ROW))
}

/// Resident number `i` of a square: an arm in the middle, where its base is, and around it rovers and cars.
fn resident(square: u32, i: u32, draws: &mut Stream) -> Resident {
    let (at, theta) = (place(i), draws.uniform(-3.0, 3.0));
    let (kind, start) = match i % 4 {
        _ if i == ROW * ROW / 2 => (RobotKind::REACH3, vec![theta, 0.5, 0.5]),
        0 | 1 => (RobotKind::RUSTY, vec![at.x, at.y, theta]),
        2 => (RobotKind::HITCH, vec![at.x, at.y, theta]),
        _ => (RobotKind::HITCH, vec![at.x, at.y, theta, theta]),
    };
    Resident::new(format!("{} {}", kind.name, square * ROW * ROW + i + 1), kind.name, start)
}

/// A square with four walls, four pillars, and twenty-five robots.
pub fn world(square: u32, seed: Seed) -> World {
    let corners = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)].map(|(x, y)| Point2::new(x, y));
    let side = |i: usize| (Pose2::IDENTITY, Shape::Segment { a: corners[i], b: corners[(i + 1) % 4] });
    let mut obstacles = vec![Obstacle::new("the wall", ObstacleKind::Wall, (0..4).map(side).collect())];
    for i in 0..4 {
        let [x, y] = [i % 2, i / 2].map(|k| f64::from(2 * k - 1) * APART);
        let at = Point2::new(1.5 * x, 1.5 * y);
        let pillar = (Pose2::new(at.x, at.y, 0.0), Shape::Disc { radius: 0.5 });
        obstacles.push(Obstacle::new(format!("pillar {}", i + 1), ObstacleKind::Solid, vec![pillar]));
    }
    // the line that rovers follow
    let round = [(-8.0, -10.0), (10.0, -8.0), (8.0, 10.0), (-10.0, 8.0)].map(|(x, y)| Point2::new(x, y));
    let tour = Mark { name: TOUR_MARK.into(), points: round.to_vec() };
    let mut draws = Stream::new(seed, &format!("crowd/{square}"));
    World {
        name: format!("square {}", square + 1),
        bounds: Aabb { min: corners[0], max: corners[2] },
        obstacles,
        doors: vec![],
        routes: vec![],
        places: Vec::new(),
        marks: vec![tour],
        robots: (0..ROW * ROW).map(|i| resident(square, i, &mut draws)).collect(),
    }
}

/// The recorded run of this many ticks.
pub fn record(seed: Seed, ticks: u64) -> Result<Log, Box<dyn Error>> {
    let worlds = (0..SQUARES).map(|square| world(square, seed)).collect();
    Ok(Run::record(TourConfig { worlds, ticks, sensor: None }, seed)?)
}

/// The program's output for a run of this many ticks.
pub fn report(ticks: u64) -> Result<String, Box<dyn Error>> {
    let log = record(motion_lab::tour::BOOK_SEED, ticks)?;
    let last = log.frames().last().ok_or("no ticks")?;
    let mut lines = vec![format!("{} robots, {} s", last.robots.len(), ticks / 20)];
    let [disc, car, arm] = [RobotKind::RUSTY, RobotKind::HITCH, RobotKind::REACH3].map(|kind| kind.name);
    for (what, kind, coordinates) in
        [("rovers", disc, 3), ("cars", car, 3), ("with trailers", car, 4), ("arms", arm, 3)]
    {
        let residents = log.recipe.config.worlds.iter().flat_map(|w| &w.robots).zip(&last.robots);
        let contacts =
            residents.filter(|(r, _)| r.kind == kind && r.start.len() == coordinates).map(|(_, s)| s.contacts);
        let (count, sum) = contacts.fold((0, 0), |(count, sum), contacts| (count + 1, sum + contacts));
        lines.push(format!("{count:2} {what:13} {sum:3} contacts"));
    }
    lines.push(format!("digest {}\n", log.digest().ok_or("no digest")?));
    Ok(lines.join("\n"))
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report(1200)?);
    Ok(())
}
