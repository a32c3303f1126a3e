//! `TickDigests`, what builds of the lab are compared by.

use std::sync::Arc;

use xxhash_rust::xxh3::{Xxh3, xxh3_128};

use super::{Recorder, RunError};
use crate::run::{Digest, Recipe, RunDigest};
use crate::simulation::RobotView;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::worlds::World;

/// The digests of a run, tick by tick from 0 on. Two builds that give the same computed the same bits.
///
/// Each covers the tick's frame, and of every robot what no frame holds: an arm's tip, the vertices of the footprint,
/// and the witness of the nearest obstacle in its world as it stands.
///
/// ```
/// use motion_lab_sim::recording::TickDigests;
/// use motion_lab_sim::run::Recipe;
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
/// let recipe = Recipe::new(TourConfig { ticks: 20, ..TourConfig::default() }, BOOK_SEED);
/// let (mut one, mut other) = (TickDigests::of(&recipe)?, TickDigests::of(&recipe)?);
/// assert!(one.by_ref().eq(&mut other) && one.next().is_none());
/// assert_eq!(one.digest(), other.digest());
/// # Ok::<(), motion_lab_sim::recording::RunError>(())
/// ```
pub struct TickDigests {
    run: Recorder,
    ticks: std::ops::RangeInclusive<u64>,
    scenes: Vec<(Arc<World>, Scene)>,
    frames: RunDigest,
    all: Xxh3,
    bytes: Vec<u8>,
}

impl TickDigests {
    /// The digests of a recipe's run.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot start.
    pub fn of(recipe: &Recipe) -> Result<Self, RunError> {
        let run = Recorder::of(recipe)?.without_keyframes();
        let frames = RunDigest::new(recipe, run.frame());
        let ticks = 0..=recipe.config.ticks;
        Ok(TickDigests { run, ticks, scenes: Vec::new(), frames, all: Xxh3::new(), bytes: Vec::new() })
    }

    /// The digest of the run up to the last tick given.
    pub fn run(&self) -> Digest {
        self.frames.digest()
    }

    /// The digest of all digests given so far.
    pub fn digest(&self) -> Digest {
        Digest(self.all.digest128())
    }

    /// The run itself, at the last tick given.
    pub fn recorder(&self) -> &Recorder {
        &self.run
    }

    /// Makes the scenes of worlds that have changed.
    fn look_at_worlds(&mut self) {
        let worlds = self.run.standing_worlds();
        self.scenes.truncate(worlds.len());
        for (i, world) in worlds.into_iter().enumerate() {
            match self.scenes.get_mut(i) {
                Some((seen, _)) if Arc::ptr_eq(seen, &world) => {}
                Some(place) => *place = with_scene(world),
                None => self.scenes.push(with_scene(world)),
            }
        }
    }
}

impl Iterator for TickDigests {
    type Item = Digest;

    fn next(&mut self) -> Option<Digest> {
        let tick = self.ticks.next()?;
        if tick > 0 {
            self.frames.tick(self.run.step());
        }
        self.look_at_worlds();
        self.bytes.clear();
        self.run.frame().encode(&mut self.bytes);
        for robot in self.run.view() {
            let scene = self.scenes.get(robot.world as usize).map(|(_, scene)| scene);
            let numbers = geometry(&robot, scene);
            self.bytes.extend(numbers.iter().flat_map(|x| x.to_bits().to_le_bytes()));
        }
        let digest = Digest(xxh3_128(&self.bytes));
        self.all.update(&digest.0.to_le_bytes());
        Some(digest)
    }
}

fn with_scene(world: Arc<World>) -> (Arc<World>, Scene) {
    let scene = Scene::of_world(&world);
    (world, scene)
}

/// What is computed of a robot and stands in no frame.
fn geometry(robot: &RobotView, scene: Option<&Scene>) -> Vec<f64> {
    let mut numbers: Vec<f64> = robot.tip.iter().flat_map(|p| [p.x, p.y]).collect();
    for part in robot.footprint.parts() {
        numbers.extend(part.placed().core().iter().flat_map(|p| [p.x, p.y]));
    }
    if let Some(w) = scene.and_then(|scene| scene.witness(&robot.footprint)) {
        numbers.extend([w.on_robot.x, w.on_robot.y, w.on_obstacle.x, w.on_obstacle.y, w.dist]);
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Run;
    use crate::run::{Script, WorldChange, WorldEvent};
    use crate::tour::{BOOK_SEED, TourConfig};

    fn recipe(script: Script) -> Recipe {
        let config = TourConfig { worlds: vec![World::apartment()], ticks: 8, sensor: None };
        Recipe::new(config, (BOOK_SEED, script))
    }

    #[test]
    fn the_run_s_digest_is_that_of_its_log() {
        let recipe = recipe(Script::empty());
        let mut digests = TickDigests::of(&recipe).unwrap();
        assert_eq!(digests.by_ref().count(), 9, "the start and eight ticks");
        let log = Run::record(recipe.config.clone(), recipe.seed).unwrap();
        assert_eq!(Some(digests.run()), log.digest());
    }

    #[test]
    fn a_closed_door_changes_the_witness_from_its_tick_on() {
        let witnesses = |changes: Vec<WorldEvent>| {
            let mut digests = TickDigests::of(&recipe(Script::new(Vec::new(), changes))).unwrap();
            let witness = |digests: &TickDigests| geometry(&digests.recorder().view()[0], Some(&digests.scenes[0].1));
            (0..=8).map(|_| (digests.next().unwrap(), witness(&digests))).collect::<Vec<_>>()
        };
        let [x, y] = [2.25, 6.25].map(|x| crate::run::Quantized::try_new(x).unwrap());
        let add = WorldChange::Add {
            name: "a post".into(),
            points: vec![(crate::run::Quantized(x.0 + (1 << 19)), y)],
            radius: crate::run::Quantized(1 << 16),
        };
        let open = witnesses(Vec::new());
        let post = witnesses(vec![WorldEvent { tick: 5, world: "Apartment".into(), change: add }]);
        let same: Vec<bool> = open.iter().zip(&post).map(|(a, b)| a == b).collect();
        assert_eq!(same, [true, true, true, true, true, false, false, false, false]);
        assert_ne!(open[5].1, post[5].1, "the post is nearer than the wall");
    }
}
