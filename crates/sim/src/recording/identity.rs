//! Runs for comparing platforms: seeded, scripted driving whose digests cover frames, footprints and witnesses.

use xxhash_rust::xxh3::Xxh3;

use super::{Recorder, RunError};
use crate::run::{Digest, Event, Quantized, Recipe, RobotInput, RunDigest, Script};
use crate::tour::TourConfig;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{Coordinates, RobotKind};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::World;

/// Number of ticks in an identity run: 30 s.
const TICKS: u64 = 600;

/// Returns one line: the world, the seed, the digest of the run, and a second digest over every arm's tip, footprint's
/// vertices and witness.
///
/// The residents of `world` tour, and are driven by a script drawn from `seed`: channels, moves, teleports, trailer,
/// release. Two builds that print the same line computed the same bits.
///
/// # Errors
/// [`RunError`] when the run cannot start, which does not happen with a built-in world.
pub fn identity_line(world: &World, seed: Seed) -> Result<String, RunError> {
    let config = TourConfig { worlds: vec![world.clone()], ticks: TICKS, ..TourConfig::default() };
    let recipe = Recipe::new(config, (seed, driving(world, seed)));
    let scene = Scene::of_world(world);
    let mut recorder = Recorder::of(&recipe)?;
    let mut run = RunDigest::new(&recipe, recorder.frame());
    let mut geometry = Xxh3::new();
    for _ in 0..TICKS {
        run.tick(recorder.step());
        for robot in recorder.view() {
            let mut numbers: Vec<f64> = robot.tip.iter().flat_map(|p| [p.x, p.y]).collect();
            for part in robot.footprint.parts() {
                numbers.extend(part.placed().core().iter().flat_map(|p| [p.x, p.y]));
            }
            if let Some(w) = scene.witness(&robot.footprint) {
                numbers.extend([w.on_robot.x, w.on_robot.y, w.on_obstacle.x, w.on_obstacle.y, w.dist]);
            }
            for x in numbers {
                geometry.update(&x.to_bits().to_le_bytes());
            }
        }
    }
    Ok(format!("{} {seed} {} {}", world.name, run.digest(), Digest(geometry.digest128())))
}

/// A script for the residents of `world`: an input about every twenty ticks, of a kind the robot may take or refuse.
fn driving(world: &World, seed: Seed) -> Script {
    let mut events = Vec::new();
    let mut s = Stream::new(seed, "identity/script");
    let mut tick = 0;
    loop {
        tick += 1 + s.below(40);
        if tick > TICKS {
            return Script::new(events, vec![]);
        }
        for robot in &world.robots {
            let channel = |s: &mut Stream| s.below(257) as i16 - 128;
            let mut coordinates = || -> Vec<Quantized> {
                let (min, max) = (world.bounds.min, world.bounds.max);
                let mut q = Coordinates::from_slice(&robot.start);
                let plane = RobotKind::of(&robot.kind).is_some_and(|known| known.drives);
                for (k, x) in q.iter_mut().enumerate() {
                    *x = match k {
                        0 if plane => s.uniform(min.x, max.x),
                        1 if plane => s.uniform(min.y, max.y),
                        _ => s.uniform(-3.0, 3.0),
                    };
                }
                q.iter().filter_map(|x| Quantized::try_new(*x)).collect()
            };
            let moved = coordinates();
            let input = match s.below(8) {
                0..=3 => RobotInput::Drive(channel(&mut s), channel(&mut s)),
                4 => RobotInput::MoveTo(moved),
                5 => RobotInput::Teleport(moved),
                6 => RobotInput::SetTrailer(s.below(2) == 0),
                _ => RobotInput::Release,
            };
            events.push(Event { tick, robot: robot.name.clone(), input });
        }
    }
}
