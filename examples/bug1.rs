//! Bug1 (Lumelsky and Stepanov, 1987) in the Apartment, with the exact and with a noisy range sensor, over 100 seeds.
//!
//! `cargo run --example bug1`
//!
//! Bug1 heads for the goal. When it meets an obstacle it goes all the way round, remembers where the boundary comes
//! nearest to the goal, returns there by the shorter way, and leaves for the goal. If the goal still lies behind the
//! obstacle there, the goal cannot be reached. Bug1's guarantee (it reaches every reachable goal) rests on finding that
//! leave point.
//!
//! Here Rusty, a disc, knows its position exactly and sees walls by its range sensor alone. It keeps [`KEEP`] metres
//! from the nearest reading, with the wall at its right hand. So "the obstacle" is everything that has no gap wider
//! than twice that.
//!
//! A leave point is *misjudged* in three cases: it lies more than [`TOLERANCE`] farther from the goal than the nearest
//! place of the same round by exact nearest points; the sensor then shows the goal behind the obstacle, although every
//! start here has a way to its goal; or the round is never closed. With the exact sensor that never happens. With the
//! noisy one the nearest reading is wrong in range by centimetres, and so in bearing by tens of degrees. A place seems
//! nearer to the goal than it is, or a free way seems blocked, and the guarantee is gone. A real robot keeps a belief
//! about its own place and the walls' instead, over many readings.
//!
//! [`TOLERANCE`]: motion_lab::planning::LeavePoint::TOLERANCE
//!
//! The walk itself is the library's [`Bug1Walk`]; the window shows it as the planner *Bug1 by its sensor*.
#![allow(clippy::print_stdout, dead_code)]

use motion_lab::collision::{Checker, DiscChecker, Scene};
use motion_lab::plans::{Bug1Walk, WalkEnd};
use motion_lab::prelude::*;
use motion_lab::sensors::BeamModel;

/// Distance that Rusty's centre keeps from the boundary it follows, metres.
pub const KEEP: f64 = Bug1Walk::KEEP;
/// A cheap sensor.
pub const NOISE: BeamModel = Bug1Walk::NOISE;

/// The result of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Whether it reached the goal.
    pub reached: bool,
    /// The length of its path, metres.
    pub length: f64,
    /// Number of rounds about obstacles.
    pub rounds: u32,
    /// Number of misjudged leave points.
    pub misjudged: u32,
    /// Number of steps that a wall stopped.
    pub bumps: u32,
}

/// Runs Bug1 from `start` to `goal`.
pub fn bug1(world: &DiscChecker, start: Point2, goal: Point2, noise: Option<&(BeamModel, Stream)>) -> Outcome {
    let mut walk = Bug1Walk::new(world, [start, goal], noise.cloned());
    let end = loop {
        if let Some(end) = walk.step() {
            break end;
        }
    };
    let misjudged = walk.leave_points().iter().filter(|point| point.is_misjudged()).count();
    Outcome {
        reached: end == WalkEnd::Reached,
        length: walk.length(),
        rounds: walk.rounds() as u32,
        misjudged: misjudged as u32,
        bumps: walk.bumps(),
    }
}

/// The start and the goal of a seed: two places of the Apartment, well away from all obstacles.
pub fn task(world: &DiscChecker, seed: Seed) -> (Point2, Point2) {
    let mut places = Stream::new(seed, "bug1/places");
    let bounds = world.scene().bounds();
    let mut place = || loop {
        let q = world.robot().sample(bounds.min, bounds.max, &mut places);
        if world.distance(&q) + world.robot().radius > 2.0 * KEEP {
            return q.0;
        }
    };
    (place(), place())
}

/// The outcomes of seeds 0 to 99, with the exact and with the noisy sensor.
pub fn outcomes() -> Vec<[Outcome; 2]> {
    use rayon::prelude::*;
    let world = Checker::new(Scene::apartment(), RustyDisc::default());
    let run = |seed: u64| {
        let (start, goal) = task(&world, Seed(seed));
        let noise = (NOISE, Stream::new(Seed(seed), "bug1/beam"));
        [None, Some(&noise)].map(|noise| bug1(&world, start, goal, noise))
    };
    (0..100_u64).into_par_iter().map(run).collect()
}

/// The table of these outcomes, a row for each sensor.
pub fn table(all: &[[Outcome; 2]]) -> String {
    let mut text = String::from("sensor  reached  mean way  rounds  misjudged leave points  stopped steps\n");
    for (i, sensor) in ["exact", "noisy"].into_iter().enumerate() {
        let sum = |of: fn(&Outcome) -> u32| all.iter().map(|o| of(&o[i])).sum::<u32>();
        let reached = sum(|o| u32::from(o.reached));
        let way = all.iter().filter(|o| o[i].reached).map(|o| o[i].length).sum::<f64>() / f64::from(reached);
        let (rounds, misjudged, bumps) = (sum(|o| o.rounds), sum(|o| o.misjudged), sum(|o| o.bumps));
        let of_all = format!("{reached}/{}", all.len());
        text += &format!("{sensor:6} {of_all:>8} {way:7.1} m {rounds:7} {misjudged:23} {bumps:14}\n");
    }
    text
}

fn main() {
    print!("{}", table(&outcomes()));
}
