//! A frame's input, given to egui in the order in which it came.

use bevy::ecs::message::MessageCursor;
use bevy::input::keyboard::{Key, KeyboardFocusLost, KeyboardInput};
use bevy::input::mouse::MouseWheel;
use bevy::prelude::*;
use bevy::window::WindowEvent;
use bevy_egui::input::{
    write_keyboard_input_messages_system, write_modifiers_keys_state_system, write_mouse_wheel_messages_system,
    write_pointer_moved_and_button_messages_system,
};
use bevy_egui::{EguiGlobalSettings, EguiInputSet};

/// Gives keys, clicks and the wheel the modifiers that were held as they came.
///
/// bevy_egui gives them those that are held as the frame ends. A chord that is let go within a frame would lose its
/// own: Ctrl+C would be a C. So its systems run once for each part of a frame in which the modifiers stay as they are.
pub struct InputOrderPlugin;

impl Plugin for InputOrderPlugin {
    fn build(&self, app: &mut App) {
        let in_parts = give_in_parts.after(EguiInputSet::InitReading).before(EguiInputSet::FocusContext);
        app.add_systems(PreUpdate, in_parts);
        enable(app.world_mut(), false);
    }
}

/// Switches the systems on or off that the parts of a frame are given to.
fn enable(world: &mut World, is_on: bool) {
    let own = &mut world.resource_mut::<EguiGlobalSettings>().into_inner().input_system_settings;
    own.run_write_modifiers_keys_state_system = is_on;
    own.run_write_window_pointer_moved_messages = is_on;
    own.run_write_pointer_button_messages = is_on;
    own.run_write_mouse_wheel_messages_system = is_on;
    own.run_write_keyboard_input_messages_system = is_on;
}

/// What came while the modifiers stayed as they are.
#[derive(Default)]
struct InputPart {
    events: Messages<WindowEvent>,
    keys: Messages<KeyboardInput>,
    wheels: Messages<MouseWheel>,
    losses: Messages<KeyboardFocusLost>,
}

impl InputPart {
    fn take(&mut self, event: WindowEvent) {
        match event {
            WindowEvent::KeyboardInput(key) => _ = self.keys.write(key),
            WindowEvent::MouseWheel(wheel) => _ = self.wheels.write(wheel),
            WindowEvent::KeyboardFocusLost(loss) => _ = self.losses.write(loss),
            other => _ = self.events.write(other),
        }
    }

    fn is_empty(&self) -> bool {
        self.events.is_empty() && self.keys.is_empty() && self.wheels.is_empty() && self.losses.is_empty()
    }

    /// Puts the part in the place of the frame's messages, or these back in theirs.
    fn swap(&mut self, world: &mut World) {
        swap(world, &mut self.events);
        swap(world, &mut self.keys);
        swap(world, &mut self.wheels);
        swap(world, &mut self.losses);
    }

    /// Gives egui the part, and empties it.
    fn give(&mut self, world: &mut World) -> Result {
        if self.is_empty() {
            return Ok(());
        }
        self.swap(world);
        world.run_system_cached(write_modifiers_keys_state_system)?;
        world.run_system_cached(write_pointer_moved_and_button_messages_system)?;
        world.run_system_cached(write_mouse_wheel_messages_system)?;
        world.run_system_cached(write_keyboard_input_messages_system)?;
        self.swap(world);
        self.events.clear();
        self.keys.clear();
        self.wheels.clear();
        self.losses.clear();
        Ok(())
    }
}

fn swap<M: Message>(world: &mut World, messages: &mut Messages<M>) {
    std::mem::swap(&mut *world.resource_mut::<Messages<M>>(), messages);
}

/// Whether the modifiers may be others from this event on.
fn changes_modifiers(event: &WindowEvent) -> bool {
    match event {
        WindowEvent::KeyboardFocusLost(_) => true,
        WindowEvent::KeyboardInput(key) => {
            matches!(key.logical_key, Key::Shift | Key::Control | Key::Alt | Key::Super | Key::Meta)
        }
        _ => false,
    }
}

/// Gives egui what came since the last frame, part by part.
fn give_in_parts(world: &mut World, mut read: Local<MessageCursor<WindowEvent>>, mut part: Local<InputPart>) -> Result {
    let came: Vec<WindowEvent> = read.read(world.resource::<Messages<WindowEvent>>()).cloned().collect();
    enable(world, true);
    for event in came {
        if changes_modifiers(&event) {
            part.give(world)?;
        }
        part.take(event);
    }
    part.give(world)?;
    enable(world, false);
    Ok(())
}
