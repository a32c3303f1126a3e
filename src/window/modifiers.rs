//! The modifier keys, sent to egui only as they change.

use bevy::prelude::*;
use bevy_egui::{EguiInput, EguiPreUpdateSet, egui};

/// Keeps egui from drawing again and again while nothing happens.
///
/// bevy_egui sends egui the modifier keys in every frame, and egui takes any event for a reason to draw.
pub struct ModifiersPlugin;

impl Plugin for ModifiersPlugin {
    fn build(&self, app: &mut App) {
        let between = forget_known_modifiers.after(EguiPreUpdateSet::ProcessInput).before(EguiPreUpdateSet::BeginPass);
        app.add_systems(PreUpdate, between);
    }
}

fn forget_known_modifiers(mut inputs: Query<&mut EguiInput>, mut known: Local<egui::Modifiers>) {
    for mut input in &mut inputs {
        news_only(&mut input.events, &mut known);
    }
}

/// Drops the events that repeat the known state of the modifier keys.
fn news_only(events: &mut Vec<egui::Event>, known: &mut egui::Modifiers) {
    events.retain(|event| match event {
        egui::Event::ModifiersChanged(now) => std::mem::replace(known, *now) != *now,
        _ => true,
    });
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::{Event, Modifiers};

    use super::*;

    #[test]
    fn modifiers_are_news_only_when_they_change() {
        let mut known = Modifiers::NONE;
        let mut is_sent = |modifiers: Modifiers| {
            let mut events = vec![Event::ModifiersChanged(modifiers), Event::PointerGone];
            news_only(&mut events, &mut known);
            assert_eq!(events.last(), Some(&Event::PointerGone), "other events stay");
            events.len() == 2
        };
        let frames = [Modifiers::NONE, Modifiers::SHIFT, Modifiers::SHIFT, Modifiers::NONE, Modifiers::NONE];
        assert_eq!(frames.map(&mut is_sent), [false, true, false, true, false]);
    }
}
