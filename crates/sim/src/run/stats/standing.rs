//! `StandingScenes`, the worlds of a run as they stand at its frames, for what has no simulator.

use std::collections::BTreeSet;

use crate::run::{Frame, ObstacleState, ObstacleStates, Script};
use crate::tour::TourConfig;
use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::worlds::{Obstacle, World};

/// The scenes of a run's worlds, at the last frame that it has seen.
pub(super) struct StandingScenes {
    worlds: Vec<World>,
    /// The obstacles that the script adds to each world, in its order.
    added: Vec<Vec<Obstacle>>,
    /// The obstacles that are not as at the start, for which the scenes are made.
    states: ObstacleStates,
    scenes: Vec<Scene>,
}

impl StandingScenes {
    /// The worlds at the start of a run.
    pub(super) fn new(config: &TourConfig, script: &Script) -> Self {
        let worlds = config.worlds.clone();
        let added = |world: &World| {
            let changes = script.changes.iter().filter(|change| change.world == world.name);
            changes.filter_map(|change| change.change.added()?.ok()).collect()
        };
        let added = worlds.iter().map(added).collect();
        let scenes = worlds.iter().map(Scene::of_world).collect();
        StandingScenes { worlds, added, states: ObstacleStates::new(), scenes }
    }

    /// Goes on to a frame.
    pub(super) fn follow(&mut self, frame: &Frame) {
        let since = frame.obstacles.since(&self.states);
        let changed: BTreeSet<u32> = since.iter().map(|difference| difference.key.0).collect();
        for number in changed {
            let at = number as usize;
            if let (Some(world), Some(added), Some(scene)) =
                (self.worlds.get(at), self.added.get(at), self.scenes.get_mut(at))
            {
                let state = |obstacle: usize| frame.obstacles.get((number, obstacle as u32));
                *scene = Scene::of_world(&standing(world, added, state));
            }
        }
        self.states.clone_from(&frame.obstacles);
    }

    /// The scene of the world with this number.
    pub(super) fn scene(&self, world: usize) -> Option<&Scene> {
        self.scenes.get(world)
    }
}

/// The world with its obstacles in the states that `state` has by their numbers: those of the file, then those added;
/// its doors open or closed. What has no state is as at the start: an obstacle of the file there, an added one not.
fn standing<'a>(world: &World, added: &[Obstacle], state: impl Fn(usize) -> Option<&'a ObstacleState>) -> World {
    let mut model = World { obstacles: Vec::new(), ..world.clone() };
    for (number, obstacle) in world.obstacles.iter().enumerate() {
        match state(number) {
            None => model.obstacles.push(obstacle.clone()),
            Some(state) if state.present => model.obstacles.push(moved(obstacle, &state.pose)),
            Some(_) => {}
        }
    }
    let doors = world.obstacles.len();
    for (i, door) in model.doors.iter_mut().enumerate() {
        if let Some(state) = state(doors + i) {
            door.open = !state.present;
        }
    }
    for (i, obstacle) in added.iter().enumerate() {
        if let Some(state) = state(doors + world.doors.len() + i).filter(|state| state.present) {
            model.obstacles.push(moved(obstacle, &state.pose));
        }
    }
    model
}

/// The obstacle after a rigid motion.
fn moved(obstacle: &Obstacle, pose: &Pose2) -> Obstacle {
    if *pose == Pose2::IDENTITY {
        return obstacle.clone();
    }
    let pieces = obstacle.pieces.iter().map(|(frame, shape)| (pose.compose(frame), shape.clone())).collect();
    Obstacle::new(&obstacle.name, obstacle.kind, pieces)
}
