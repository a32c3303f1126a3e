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
#![allow(clippy::print_stdout, dead_code)]

use motion_lab::collision::{Checker, Collision, DiscChecker, Scene};
use motion_lab::num::{greater, hypot, lesser};
use motion_lab::prelude::*;
use motion_lab::sensors::{BeamModel, RangeSensor};
use motion_lab::simulation::advance;

/// Distance that Rusty's centre keeps from the boundary it follows, metres.
pub const KEEP: f64 = 0.2;
/// Largest excess of a leave point's distance from the goal over the best, metres.
pub const TOLERANCE: f64 = 0.1;
/// The length of a step, metres.
const STEP: f64 = 0.06;
/// Distance from a place at which Rusty counts as back there, metres.
const BACK: f64 = 0.1;
/// Largest number of steps in a round; beyond it Rusty is lost. A round along all the walls of the Apartment takes
/// about 1,600.
const LOST: u64 = 5000;

const SENSOR: RangeSensor = RangeSensor { n_rays: 60, max_range: 4.0 };
/// A cheap sensor.
pub const NOISE: BeamModel =
    BeamModel { sigma_hit: 0.03, z_short: 0.02, lambda_short: 1.0, z_miss: 0.02, z_max: 0.01, z_rand: 0.01 };

/// The source of Rusty's knowledge of the nearest boundary point.
#[derive(Clone, Copy)]
enum Eyes<'a> {
    /// The exact nearest point, by which leave points are judged.
    Truth,
    /// Its sensor, exact or with noise from a stream.
    Sensor(Option<&'a (BeamModel, Stream)>),
}

/// Rusty on its way.
struct Bug<'a> {
    world: &'a DiscChecker,
    eyes: Eyes<'a>,
    goal: Point2,
    at: Point2,
    tick: u64,
    length: f64,
    bumps: u32,
    /// The boundary point last followed: a wall seen end-on catches no ray.
    followed: Option<Point2>,
}

/// The result of a round about an obstacle.
struct Round {
    /// Rusty's place where the boundary seemed nearest to the goal.
    leave: Point2,
    /// The distance gone round until then, and the length of the whole round, metres.
    until_leave: f64,
    length: f64,
}

impl Bug<'_> {
    /// The boundary point that seems nearest; `None` when nothing is in range.
    fn nearest(&mut self) -> Option<Point2> {
        let Eyes::Sensor(noise) = self.eyes else {
            return self.world.scene().witness(&Footprint::disc(self.at, 0.0)).map(|w| w.on_obstacle);
        };
        let mut ranges = SENSOR.scan(self.world.scene(), self.at);
        if let Some((model, stream)) = noise {
            ranges = model.apply(&SENSOR, &ranges, stream, self.tick);
        }
        let n = ranges.len();
        // the median of three neighbours, because a lone short return is no wall
        let median = |k: usize| {
            let (a, b, c) = (ranges[(k + n - 1) % n], ranges[k], ranges[(k + 1) % n]);
            greater(lesser(a, b), lesser(greater(a, b), c))
        };
        let seen = (0..n).fold((0, f64::INFINITY), |m, k| if median(k) < m.1 { (k, median(k)) } else { m });
        let (x, y) = SENSOR.direction(seen.0 as u32);
        let point = self.at + Vector2::new(x, y) * seen.1;
        match self.followed {
            Some(old) if seen.1 > 1.5 * KEEP && (old - self.at).norm() < 1.5 * KEEP => Some(old),
            _ => seen.1.is_finite().then_some(point),
        }
    }

    /// Takes a step in a direction, until a wall stops it.
    fn step(&mut self, direction: Vector2, length: f64) {
        let to = R2(self.at + direction * (length / hypot(direction.x, direction.y)));
        self.tick += 1;
        if let Ok(line) = self.world.robot().edge(&R2(self.at), &to) {
            let end = advance(self.world.scene(), &line);
            let to = motion_lab::robots::Motion::at(&line, end.until).0;
            self.length += (to - self.at).norm();
            self.bumps += u32::from(end.blocked);
            self.at = to;
        }
    }

    /// Whether something near lies in the way to the goal.
    fn is_blocked(&mut self) -> bool {
        let (at, goal) = (self.at, self.goal);
        self.nearest().is_some_and(|p| (p - at).norm() <= KEEP && (p - at).dot(&(goal - at)) > 0.0)
    }

    /// Heads for the goal. `true` at the goal, `false` when something is in the way, seen or touched.
    fn head_for_goal(&mut self) -> bool {
        self.followed = None;
        let bumps = self.bumps;
        while (self.goal - self.at).norm() > STEP {
            if self.bumps > bumps || self.is_blocked() {
                return false;
            }
            self.step(self.goal - self.at, STEP);
        }
        true
    }

    /// Takes a step along the wall, which is at the right hand when `side` is 1 and at the left when it is -1. Returns
    /// the wall's point.
    fn follow(&mut self, side: f64) -> Point2 {
        let wall = self.nearest().or(self.followed).unwrap_or(self.goal);
        self.followed = Some(wall);
        let away = wall - self.at;
        let distance = greater(hypot(away.x, away.y), 1e-6);
        let toward = away / distance;
        let along = Vector2::new(-toward.y, toward.x) * side;
        let correction = (8.0 * (distance - KEEP)).clamp(-1.0, 1.0);
        self.step(along + toward * correction, STEP);
        wall
    }

    /// Goes all the way round the obstacle; `None` when it never comes back.
    fn go_round(&mut self) -> Option<Round> {
        // the first steps bring it to the distance it keeps
        (0..5).for_each(|_| _ = self.follow(1.0));
        let (hit, start, last) = (self.at, self.length, self.tick + LOST);
        let (mut least, mut leave, mut until_leave) = (f64::INFINITY, hit, 0.0);
        let mut left = false;
        while self.tick < last {
            let from = self.at;
            let wall = self.follow(1.0);
            // Rusty's place beside that point of the wall, on this side of it, because a wall may be thin
            let apart = greater((from - wall).norm(), 1e-6);
            let seen = (wall + (from - wall) * (KEEP / apart) - self.goal).norm();
            if seen < least {
                (least, leave, until_leave) = (seen, from, self.length - start);
            }
            let home = (self.at - hit).norm();
            left = left || home > 3.0 * BACK;
            if left && home < BACK {
                return Some(Round { leave, until_leave, length: self.length - start });
            }
        }
        None
    }

    /// Returns to the leave point by the shorter way; `false` when it never gets there.
    fn return_to(&mut self, round: &Round) -> bool {
        let ahead = round.until_leave <= 0.5 * round.length;
        let (side, way) = if ahead { (1.0, round.until_leave) } else { (-1.0, round.length - round.until_leave) };
        let last = self.tick + (1.5 * way / STEP) as u64 + 50;
        while (self.at - round.leave).norm() > BACK {
            if self.tick >= last {
                return false;
            }
            self.follow(side);
        }
        // the rest of the way goes by Rusty's own position
        self.step(round.leave - self.at, greater((round.leave - self.at).norm(), 1e-9));
        true
    }
}

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
    let bug = |eyes, at| Bug { world, eyes, goal, at, tick: 0, length: 0.0, bumps: 0, followed: None };
    let mut rusty = bug(Eyes::Sensor(noise), start);
    let mut outcome = Outcome::default();
    while outcome.rounds < 20 {
        if rusty.head_for_goal() {
            outcome.reached = true;
            break;
        }
        outcome.rounds += 1;
        let truth = bug(Eyes::Truth, rusty.at).go_round();
        let left = rusty.go_round().filter(|round| rusty.return_to(round));
        let best = truth.map_or(0.0, |round| (round.leave - goal).norm());
        let good = left.is_some() && (rusty.at - goal).norm() <= best + TOLERANCE && !rusty.is_blocked();
        outcome.misjudged += u32::from(!good);
        if left.is_none() || rusty.is_blocked() {
            break; // lost, or the goal seems out of reach
        }
    }
    Outcome { length: rusty.length, bumps: rusty.bumps, ..outcome }
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
