//! Letting a paused window sleep.

use std::time::Duration;

use bevy::prelude::*;
use bevy::window::WindowEvent;
use bevy::winit::{UpdateMode, WinitSettings};
use bevy_egui::EguiContext;

use crate::window::ui::Interface;

/// Number of frames, a second apart, after which a paused window that nobody touches sleeps longer. What is kept a few
/// seconds after a change is kept within them.
const FRAMES_TO_SLEEP: u32 = 4;

const LONGEST: Duration = Duration::from_secs(10);

/// Lets a paused window sleep longer once nothing has happened in some frames. A frame a second would keep the
/// processor busy where it draws.
pub fn sleep(
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
    if *frames >= FRAMES_TO_SLEEP && wait < LONGEST {
        let mode = UpdateMode::reactive(LONGEST);
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
    }
}

#[cfg(test)]
mod tests {
    use bevy::window::WindowFocused;

    use super::*;

    #[test]
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
}
