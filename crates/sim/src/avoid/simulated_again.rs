//! The run as it is simulated again: without sensors, one world of it alone.

use std::sync::Arc;

use bevy::app::App;

use crate::recording::{Recorder, RunError};
use crate::run::{Recipe, Script};
use crate::tour::TourConfig;

/// What adds further kinds of robots to an app, as a [`RobotPlugin`](crate::simulation::RobotPlugin).
pub type AddKinds = Arc<dyn Fn(&mut App) + Send + Sync>;

/// A recorder with further kinds of robots.
pub(super) fn recorder(recipe: &Recipe, add: Option<&AddKinds>) -> Result<Recorder, RunError> {
    let added = |app: &mut App| {
        if let Some(add) = add {
            add(app);
        }
    };
    Recorder::of_with_robots(recipe, added)
}

/// The run of one world of it. What happens in a world is the same whichever others there are.
pub(super) fn alone(recipe: Recipe, world: &str) -> Recipe {
    let mut config = TourConfig::clone(&recipe.config);
    config.worlds.retain(|other| other.name == world);
    let Script { mut events, mut changes, .. } = recipe.script;
    let robots: Vec<&str> = config.robot_names().collect();
    events.retain(|event| robots.contains(&event.robot.as_str()));
    changes.retain(|change| change.world == world);
    Recipe { script: Script::new(events, changes), config: Arc::new(config), ..recipe }
}

/// The same run without its sensors, which move no robot and take most of its time.
pub(super) fn without_sensors(recipe: &Recipe) -> Recipe {
    let mut config = TourConfig { sensor: None, ..TourConfig::clone(&recipe.config) };
    for robot in config.worlds.iter_mut().flat_map(|world| &mut world.robots) {
        robot.sensors.clear();
    }
    Recipe { config: config.into(), ..recipe.clone() }
}
