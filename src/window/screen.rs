//! `ScreenPlugin`, egui on the window.

use bevy::asset::AssetEventSystems;
use bevy::prelude::*;
use bevy_egui::{EguiGlobalSettings, EguiPlugin, EguiPostUpdateSet};

use super::input_order::InputOrderPlugin;
use super::modifiers::ModifiersPlugin;

/// egui on the window: what is drawn in a frame is shown whole in that frame, and keys mean what was pressed.
pub struct ScreenPlugin;

impl Plugin for ScreenPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(EguiPlugin::default());
        app.world_mut().resource_mut::<EguiGlobalSettings>().auto_create_primary_context = false;
        app.add_plugins((ModifiersPlugin, InputOrderPlugin));
        // A letter that is drawn for the first time comes into the texture with the frame. The renderer learns of that
        // by the texture's event. Sent a frame later, it would leave the letter out of a number until then.
        app.configure_sets(PostUpdate, EguiPostUpdateSet::PostProcessOutput.before(AssetEventSystems));
    }
}

#[cfg(test)]
mod tests {
    use bevy::asset::AssetPlugin;
    use bevy::input::keyboard::{Key, KeyCode, KeyboardFocusLost, KeyboardInput};
    use bevy::input::mouse::{MouseButtonInput, MouseScrollUnit, MouseWheel};
    use bevy::input::{ButtonState, InputPlugin, touch::TouchPhase};
    use bevy::window::{CursorMoved, PrimaryWindow, WindowEvent};
    use bevy_egui::egui::{self, Modifiers};
    use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext};

    use super::*;

    /// What is drawn in a frame, and the events that egui gets in it.
    #[derive(Resource, Default)]
    struct Page {
        text: String,
        events: Vec<egui::Event>,
    }

    fn draw(mut contexts: Query<&mut EguiContext>, mut page: ResMut<Page>) {
        let ctx = contexts.single_mut().unwrap().get_mut().clone();
        page.events = ctx.input(|i| i.events.clone());
        let layer = egui::LayerId::background();
        ctx.layer_painter(layer).text(
            egui::pos2(8.0, 8.0),
            egui::Align2::LEFT_TOP,
            &page.text,
            egui::FontId::proportional(20.0),
            ctx.global_style().visuals.text_color(),
        );
    }

    /// A window with egui, and nobody to draw it.
    fn app() -> App {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, AssetPlugin::default(), InputPlugin, WindowPlugin::default()))
            .add_plugins((bevy::image::ImagePlugin::default(), bevy::a11y::AccessibilityPlugin))
            .init_asset::<bevy::shader::Shader>()
            .init_resource::<Page>()
            .add_plugins(ScreenPlugin)
            .add_systems(Startup, |mut commands: Commands| _ = commands.spawn((Camera2d, PrimaryEguiContext)))
            .add_systems(EguiPrimaryContextPass, draw);
        (0..3).for_each(|_| app.update());
        app
    }

    /// The events that egui gets of what came in one frame.
    fn frame_of(app: &mut App, came: Vec<WindowEvent>) -> Vec<egui::Event> {
        for event in came {
            match event.clone() {
                WindowEvent::KeyboardInput(key) => _ = app.world_mut().write_message(key),
                WindowEvent::MouseWheel(wheel) => _ = app.world_mut().write_message(wheel),
                WindowEvent::MouseButtonInput(button) => _ = app.world_mut().write_message(button),
                WindowEvent::CursorMoved(moved) => _ = app.world_mut().write_message(moved),
                WindowEvent::KeyboardFocusLost(loss) => _ = app.world_mut().write_message(loss),
                other => panic!("{other:?}"),
            }
            app.world_mut().write_message(event);
        }
        app.update();
        app.world().resource::<Page>().events.clone()
    }

    fn window(app: &mut App) -> Entity {
        app.world_mut().query_filtered::<Entity, With<PrimaryWindow>>().single(app.world()).unwrap()
    }

    fn key(window: Entity, logical_key: Key, key_code: KeyCode, pressed: bool) -> WindowEvent {
        let state = if pressed { ButtonState::Pressed } else { ButtonState::Released };
        WindowEvent::KeyboardInput(KeyboardInput { logical_key, key_code, state, text: None, repeat: false, window })
    }

    /// A key that is pressed and let go.
    fn stroke(window: Entity, letter: &str, code: KeyCode) -> [WindowEvent; 2] {
        [true, false].map(|pressed| key(window, Key::Character(letter.into()), code, pressed))
    }

    fn control(window: Entity, pressed: bool) -> WindowEvent {
        key(window, Key::Control, KeyCode::ControlLeft, pressed)
    }

    fn shift(window: Entity, pressed: bool) -> WindowEvent {
        key(window, Key::Shift, KeyCode::ShiftLeft, pressed)
    }

    /// The keys pressed, in order, with their modifiers.
    fn pressed(events: &[egui::Event]) -> Vec<(egui::Key, Modifiers)> {
        let of = |event: &egui::Event| match event {
            egui::Event::Key { key, modifiers, pressed: true, .. } => Some((*key, *modifiers)),
            _ => None,
        };
        events.iter().filter_map(of).collect()
    }

    fn typed(events: &[egui::Event]) -> Vec<&str> {
        events.iter().filter_map(|e| if let egui::Event::Text(text) = e { Some(&text[..]) } else { None }).collect()
    }

    const CTRL: Modifiers = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };

    #[test]
    #[cfg(not(target_os = "macos"))]
    fn a_chord_within_a_frame_keeps_its_modifier_and_types_nothing() {
        let mut app = app();
        let window = window(&mut app);
        let mut came = vec![control(window, true)];
        came.extend(stroke(window, "c", KeyCode::KeyC));
        came.push(control(window, false));
        // and a letter that comes after it in the same frame is a letter
        came.extend(stroke(window, "n", KeyCode::KeyN));
        let events = frame_of(&mut app, came);
        assert_eq!(pressed(&events), [(egui::Key::C, CTRL), (egui::Key::N, Modifiers::NONE)]);
        assert_eq!(typed(&events), ["n"]);
        assert_eq!(events.iter().filter(|event| **event == egui::Event::Copy).count(), 1);
        assert!(frame_of(&mut app, vec![]).is_empty(), "the frame after has nothing of it");
    }

    #[test]
    #[cfg(not(target_os = "macos"))]
    fn a_key_before_a_chord_is_no_part_of_it_and_one_key_may_be_in_two_chords() {
        let mut app = app();
        let window = window(&mut app);
        let mut came: Vec<_> = stroke(window, "z", KeyCode::KeyZ).into();
        came.push(control(window, true));
        came.extend(stroke(window, "z", KeyCode::KeyZ));
        came.push(shift(window, true));
        came.extend(stroke(window, "Z", KeyCode::KeyZ));
        came.push(control(window, false));
        let events = frame_of(&mut app, came);
        let both = CTRL.plus(Modifiers::SHIFT);
        assert_eq!(pressed(&events).iter().map(|(_, held)| *held).collect::<Vec<_>>(), [Modifiers::NONE, CTRL, both]);
        // what is held stays held in the next frame, until the window loses the keys
        let events = frame_of(&mut app, stroke(window, "A", KeyCode::KeyA).into());
        assert_eq!(pressed(&events), [(egui::Key::A, Modifiers::SHIFT)]);
        let mut came = vec![WindowEvent::KeyboardFocusLost(KeyboardFocusLost)];
        came.extend(stroke(window, "a", KeyCode::KeyA));
        assert_eq!(pressed(&frame_of(&mut app, came)), [(egui::Key::A, Modifiers::NONE)]);
    }

    #[test]
    #[cfg(not(target_os = "macos"))]
    fn the_wheel_and_a_click_keep_the_modifier_that_is_let_go_in_their_frame() {
        let mut app = app();
        let window = window(&mut app);
        let wheel = || {
            let (unit, phase) = (MouseScrollUnit::Line, TouchPhase::Moved);
            WindowEvent::MouseWheel(MouseWheel { unit, x: 0.0, y: 1.0, window, phase })
        };
        let button =
            |state| WindowEvent::MouseButtonInput(MouseButtonInput { button: MouseButton::Left, state, window });
        let moved = CursorMoved { window, position: Vec2::new(30.0, 40.0), delta: None };
        let came = vec![
            WindowEvent::CursorMoved(moved),
            control(window, true),
            wheel(),
            control(window, false),
            shift(window, true),
            button(ButtonState::Pressed),
            button(ButtonState::Released),
            shift(window, false),
            wheel(),
        ];
        let events = frame_of(&mut app, came);
        let held = |event: &egui::Event| match event {
            egui::Event::MouseWheel { modifiers, .. } => Some(("wheel", *modifiers)),
            egui::Event::PointerButton { modifiers, pos, .. } => {
                assert_eq!(*pos, egui::pos2(30.0, 40.0));
                Some(("button", *modifiers))
            }
            _ => None,
        };
        let (plain, shift) = (Modifiers::NONE, Modifiers::SHIFT);
        let expected = [("wheel", CTRL), ("button", shift), ("button", shift), ("wheel", plain)];
        assert_eq!(events.iter().filter_map(held).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_letter_is_in_the_texture_in_the_frame_that_draws_it_first() {
        let mut app = app();
        let mut read = app.world().resource::<Messages<AssetEvent<Image>>>().get_cursor();
        let mut changed = |app: &App| {
            let events = read.read(app.world().resource::<Messages<AssetEvent<Image>>>());
            events.filter(|e| matches!(e, AssetEvent::Added { .. } | AssetEvent::Modified { .. })).count()
        };
        changed(&app);
        app.update();
        assert_eq!(changed(&app), 0, "nothing new is drawn");
        for text in ["tick 0", "tick 30", "tick 30"] {
            let is_new = app.world().resource::<Page>().text != text;
            app.world_mut().resource_mut::<Page>().text = text.to_owned();
            app.update();
            assert_eq!(changed(&app) > 0, is_new, "{text}");
        }
    }
}
