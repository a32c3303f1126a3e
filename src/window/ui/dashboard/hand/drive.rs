//! Driving the robot in hand: with the arrow keys, the pad, or the pointer that tows it.

use bevy_egui::egui::{InputState, Key, Popup, Ui};

use crate::window::ui::keys::{DriveDirection, pushed};
use crate::window::ui::{Command, Dashboard, Notice, UiState};
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::{RobotCommand, TransportCommand};

/// Channel value of a key held down: the maximum.
const FULL: i16 = motion_lab_core::robots::CHANNEL_UNITS as i16;

/// Channel value of a key held down with Shift.
const FINE: i16 = FULL / 4;

/// The channels that the keys held down ask for: forward and backward, left and right.
fn channels(input: &InputState) -> (i16, i16) {
    let value = if input.modifiers.shift { FINE } else { FULL };
    pushed(input).fold((0, 0), |(ahead, left), push| match push {
        DriveDirection::Forward => (ahead + value, left),
        DriveDirection::Backward => (ahead - value, left),
        DriveDirection::Left => (ahead, left + value),
        DriveDirection::Right => (ahead, left - value),
    })
}

/// Drives the robot in hand by the arrow keys, by the pad while no arrow key is held, by a gamepad's stick, or by the
/// pointer that tows it.
///
/// Taking a robot in hand is no input: it goes on with its tour until the first key. A key pressed while the run is
/// paused starts it, so that the robot is seen to move. Everything between two rests is undone at once, and so is a
/// whole tow.
pub fn drive(ui: &Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let robots = || model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
    let Some(robot) = state.hand.armed.clone().filter(|name| robots().any(|r| r.drivable && r.name == *name)) else {
        (state.hand.armed, state.hand.tow) = (None, None);
        (state.hand.held, state.hand.pad) = ((0, 0), (0, 0));
        let is_asked = ui.input(|i| i.key_pressed(Key::ArrowUp) || i.key_pressed(Key::ArrowDown));
        let is_seen = robots().any(|r| r.drivable) && !(state.settings.plots && state.screen.is_narrow);
        if is_asked && is_seen && ui.memory(|m| m.focused().is_none()) && !Popup::is_any_open(ui.ctx()) {
            let text = "no robot is in hand: click its world, or press its number".to_owned();
            state.say(Notice { text, is_error: false });
        }
        return;
    };
    let elsewhere = ui.memory(|m| m.focused().is_some());
    let keys = if elsewhere { (0, 0) } else { ui.input(channels) };
    let tow = state.hand.tow.take().filter(|tow| tow.robot == robot);
    if tow.as_ref().is_some_and(|tow| tow.has_gone_back(model.tick)) {
        // the run that came back has inputs of its own: to let go would be one more
        state.hand.held = (0, 0);
        return;
    }
    state.hand.tow = tow.and_then(|tow| tow.go_on(model.tick));
    let towed = state.hand.tow.as_ref().map_or((0, 0), |tow| tow.channels);
    let by_hand = [keys, state.hand.pad, state.hand.stick, towed];
    let wanted = by_hand.into_iter().find(|channels| *channels != (0, 0)).unwrap_or_default();
    if wanted == state.hand.held {
        return;
    }
    if state.hand.held == (0, 0) {
        let has_driven = state.hand.tow.as_mut().is_some_and(|tow| std::mem::replace(&mut tow.has_driven, true));
        if !has_driven {
            commands.push(Command::from(TransportCommand::Checkpoint));
        }
        if !model.playing {
            commands.push(Command::from(TransportCommand::Play));
        }
    }
    hold(robot, wanted, state, commands);
}

/// Lets go of the robot in hand and sets its channels to 0, so that it does not drive on by itself.
pub fn let_go(state: &mut UiState, commands: &mut Vec<Command>) {
    (state.hand.pad, state.hand.tow) = ((0, 0), None);
    if let Some(robot) = state.hand.armed.take().filter(|_| state.hand.held != (0, 0)) {
        hold(robot, (0, 0), state, commands);
    }
}

fn hold(robot: String, channels: (i16, i16), state: &mut UiState, commands: &mut Vec<Command>) {
    state.hand.held = channels;
    let input = RobotInput::Drive(channels.0, channels.1);
    commands.push(Command::from(RobotCommand { robot, input }));
}
