//! Letting a paused window rest.

#[cfg(feature = "window")]
use std::time::Duration;

use bevy::prelude::*;
#[cfg(feature = "window")]
use bevy::window::WindowEvent;
#[cfg(feature = "window")]
use bevy::winit::{UpdateMode, WinitSettings};
#[cfg(feature = "window")]
use bevy_egui::EguiContext;
use bevy_egui::{EguiInput, EguiPreUpdateSet, egui};

#[cfg(feature = "window")]
use crate::window::ui::Interface;

/// Keeps egui from drawing again and again while nothing happens.
///
/// bevy_egui sends egui the modifier keys in every frame, and egui takes any event for a reason to draw.
pub struct RestPlugin;

impl Plugin for RestPlugin {
    fn build(&self, app: &mut App) {
        let between = forget_known_modifiers.after(EguiPreUpdateSet::ProcessInput).before(EguiPreUpdateSet::BeginPass);
        app.add_systems(PreUpdate, between);
        // on the web, the page says when somebody touches the lab
        #[cfg(feature = "window")]
        app.add_systems(Last, sleep);
    }
}

/// Number of frames, a second apart, after which a paused window that nobody touches sleeps longer. What is kept a few
/// seconds after a change is kept within them.
#[cfg(feature = "window")]
const FRAMES_TO_REST: u32 = 4;

/// The longest sleep.
#[cfg(feature = "window")]
const REST: Duration = Duration::from_secs(10);

/// Lets a paused window sleep longer once nothing has happened in some frames. A frame a second would keep the
/// processor busy where it draws.
#[cfg(feature = "window")]
fn sleep(
    mut settings: ResMut<WinitSettings>,
    mut events: MessageReader<WindowEvent>,
    mut contexts: Query<&mut EguiContext>,
    interface: Res<Interface>,
    mut frames: Local<u32>,
) {
    // a field's text cursor blinks, and work in a thread shows how far it is
    let has_focus = contexts.iter_mut().any(|mut ctx| ctx.get_mut().memory(|memory| memory.focused().is_some()));
    let is_touched = events.read().count() > 0 || has_focus || interface.0.working.is_some();
    let UpdateMode::Reactive { wait, .. } = settings.focused_mode else {
        *frames = 0;
        return;
    };
    *frames = if is_touched { 0 } else { frames.saturating_add(1) };
    if *frames >= FRAMES_TO_REST && wait < REST {
        let mode = UpdateMode::reactive(REST);
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
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
    #[cfg(feature = "window")]
    use bevy::window::WindowFocused;
    use bevy_egui::egui::{Event, Modifiers};

    use super::*;

    #[test]
    #[cfg(feature = "window")]
    fn a_paused_window_sleeps_longer_once_nobody_has_touched_it_for_some_frames() {
        let mode = |seconds| UpdateMode::reactive(Duration::from_secs(seconds));
        let mut app = App::new();
        let settings = WinitSettings { focused_mode: mode(1), unfocused_mode: mode(1) };
        app.insert_resource(settings).init_resource::<Interface>().add_message::<WindowEvent>();
        // as the lab's own system does before it in every frame
        app.add_systems(Update, move |mut settings: ResMut<WinitSettings>| {
            if !matches!(settings.focused_mode, UpdateMode::Continuous) {
                settings.focused_mode = mode(1);
            }
        });
        app.add_systems(Last, sleep);
        let sleeps = |app: &mut App| {
            app.update();
            app.world().resource::<WinitSettings>().focused_mode
        };
        let quiet: Vec<UpdateMode> = (0..6).map(|_| sleeps(&mut app)).collect();
        assert_eq!(quiet, [mode(1), mode(1), mode(1), mode(10), mode(10), mode(10)]);
        let touched = WindowFocused { window: Entity::PLACEHOLDER, focused: true };
        app.world_mut().write_message(WindowEvent::WindowFocused(touched));
        assert_eq!([sleeps(&mut app), sleeps(&mut app)], [mode(1), mode(1)]);
        app.world_mut().resource_mut::<Interface>().0.working = Some(crate::window::ui::Working::default());
        assert!((0..8).all(|_| sleeps(&mut app) == mode(1)), "work goes on");
        app.world_mut().resource_mut::<WinitSettings>().focused_mode = UpdateMode::Continuous;
        assert!((0..8).all(|_| sleeps(&mut app) == UpdateMode::Continuous), "it plays");
    }

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
