//! `PlayStage`, where a path is played, and what comes of it.

use super::error::PlayError;
use crate::run::Script;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;

/// Where a path is played: a robot of a world, in a run of this seed.
#[derive(Clone, Copy, Debug)]
pub struct PlayStage<'a> {
    /// The world.
    pub world: &'a World,
    /// The robot's name. It lives alone in its world: what others do is not known to a path.
    pub robot: &'a str,
    /// The seed of the run, which decides how a rover's wheels slip.
    pub seed: Seed,
    /// How far the robot may stray from its path, metres: no point of it is ever farther from where it is on the path.
    /// A rover's centre, from the path of its centre.
    pub tube: f64,
}

impl<'a> PlayStage<'a> {
    /// The stage of a robot, with a tube of 5 cm.
    pub fn new(world: &'a World, robot: &'a str, seed: Seed) -> Self {
        PlayStage { world, robot, seed, tube: 0.05 }
    }
}

/// A script that plays a path, and what is proven of it.
///
/// In a run of the stage's seed with the world the robot goes along the path from tick 1 on and stands at its end from
/// tick [`ticks`](Self::ticks) on. Each of its ticks' motions was proven free, and goes as far as the simulator lets it
/// go: the run has no contact.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayedPath {
    /// The script.
    pub script: Script,
    /// The tick after which the robot stands at the path's end.
    pub ticks: u64,
    /// How far the robot strays from the path, at most, metres; never more than the stage's tube. 0 where the run is
    /// the path, bit for bit.
    pub strayed: f64,
    /// How far any point of the robot is from its place at the path's end, at most, metres; a rover's centre.
    pub missed: f64,
    /// The clearance proven along the run, metres; infinity in an empty scene.
    pub clearance: f64,
}

/// A path that a robot of the simulator can be driven along.
pub trait PlayablePath {
    /// The script that plays it.
    ///
    /// # Errors
    /// [`PlayError`]: whatever keeps the run from being the path within the stage's tube, without a contact.
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError>;
}

impl Script {
    /// The script that drives a robot along a path, made by simulating it: an arm by a target in every tick, a car by
    /// its channels, a rover by a follower that corrects its slip in a run of the stage's seed. A robot that does not
    /// start where the path does is put there first, by a teleport.
    ///
    /// # Errors
    /// [`PlayError`]: a path that can't be played is refused here, not by the run.
    ///
    /// ```
    /// use motion_lab_core::planning::LinePath;
    /// use motion_lab_core::prelude::*;
    /// use motion_lab_sim::recording::Run;
    /// use motion_lab_sim::run::Script;
    /// use motion_lab_sim::simulation::PlayStage;
    /// use motion_lab_sim::tour::TourConfig;
    ///
    /// let world = World::workbench();
    /// let checker = Checker::new(Scene::of_world(&world), Reach::<2>::workbench());
    /// let path = LinePath::through(&checker, &[T2::new(-0.5, 0.3), T2::new(-0.2, -0.4)])?;
    /// let played = Script::of_path(&path, &PlayStage::new(&world, "Reach", Seed(7)))?;
    /// assert!(played.strayed < 1e-5 && played.clearance > 0.0);
    /// let config = TourConfig { worlds: vec![world], ticks: played.ticks, sensor: None };
    /// let log = Run::record(config, (Seed(7), played.script))?;
    /// assert_eq!(log.frame(log.ticks()).map(|frame| frame.robots[0].contacts), Some(0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_path(path: &(impl PlayablePath + ?Sized), stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        path.play(stage)
    }
}
