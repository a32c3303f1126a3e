//! Driving the armed robot with the arrow keys.

use bevy_egui::egui::{InputState, Key, Modifiers, Ui};

use super::{Command, Dashboard, UiState};
use crate::run::RobotInput;
use crate::simulation::RobotCommand;

/// A key asks for all of a channel.
const FULL: i16 = 128;

/// The channels that the arrow keys held down ask for: up and down, left and right.
fn channels(input: &InputState) -> (i16, i16) {
    let axis = |plus, minus| FULL * (i16::from(input.key_down(plus)) - i16::from(input.key_down(minus)));
    (axis(Key::ArrowUp, Key::ArrowDown), axis(Key::ArrowLeft, Key::ArrowRight))
}

/// Lets the arrow keys drive the armed robot, and Esc let go of it. Returns whether one is armed: then the arrow keys are its.
///
/// Arming is no input: the robot goes on with its tour until the first key.
pub fn drive(ui: &Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) -> bool {
    let robots = || model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
    let Some(robot) = state.armed.take().filter(|name| robots().any(|r| r.drivable && r.name == *name)) else {
        state.held = (0, 0);
        return false;
    };
    let elsewhere = ui.memory(|m| m.focused().is_some());
    let lets_go = ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    let wanted = if lets_go || elsewhere { (0, 0) } else { ui.input(channels) };
    if wanted != state.held {
        state.held = wanted;
        let input = RobotInput::Drive(wanted.0, wanted.1);
        commands.push(Command::Robot(RobotCommand { robot: robot.clone(), input }));
    }
    if !lets_go {
        state.armed = Some(robot);
    }
    state.armed.is_some()
}
