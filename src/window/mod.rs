//! The lab in a window: the session, a camera, and egui painting what is in front.

mod aside;
#[cfg(feature = "window")]
mod capture;
mod captured;
#[cfg(feature = "window")]
mod clipboard;
mod crowds;
#[cfg(feature = "window")]
mod dialogs;
mod error;
#[cfg(feature = "window")]
mod files;
#[cfg(feature = "window")]
mod frames;
#[cfg(feature = "window")]
mod kept;
mod pace;
mod put_robot;
mod rest;
mod runs;
mod session;
// two attributes, because the lints recognise only a bare `cfg(test)`
#[cfg(test)]
#[cfg(feature = "window")]
mod tests;
mod ui;
#[cfg(feature = "window")]
mod window;

use bevy::core_pipeline::Core2d;
use bevy::ecs::schedule::SingleThreadedExecutor;
use bevy::prelude::*;
use bevy::render::camera::CameraRenderGraph;
#[cfg(feature = "window")]
use bevy::window::WindowTheme;
use bevy::window::{RequestRedraw, WindowResizeConstraints, WindowResolution};
use bevy::winit::{UpdateMode, WinitSettings};
use bevy_egui::{EguiContext, EguiGlobalSettings, EguiPlugin, EguiPrimaryContextPass, PrimaryEguiContext, egui};

#[cfg(feature = "window")]
pub use frames::{FrameTimes, Pause};
pub(crate) use session::SessionPlugin;
#[cfg(feature = "window")]
pub use window::{Opened, WindowError, open_in_window, run_window, run_window_with};

use aside::Aside;
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use aside::{seek_aside, stop as stop_aside};
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use captured::{captured, subject};
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use error::SessionError;
use motion_lab_core::picture::Theme;
use motion_lab_sim::simulation::History;
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use pace::limit;
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use runs::{log_up_to, open_log, open_path_text, open_world_text, path_text, save, shown_run};
pub(crate) use session::Shown;
use session::carry_out;
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) use session::new_run;
pub(crate) use ui::Interface;
use ui::SessionCommand;
use ui::paint::style::ScreenTheme;

/// Least width and height of the window, points.
const LEAST: f32 = 360.0;

/// The lab in a window, with the tour of the three worlds from the book's seed. A run already under way is kept.
pub(crate) fn windowed_app(add_plugins: impl FnOnce(&mut App, WindowPlugin)) -> App {
    let window = Window {
        title: "Motion Lab".into(),
        resolution: WindowResolution::new(1280, 800),
        resize_constraints: WindowResizeConstraints { min_width: LEAST, min_height: LEAST, ..default() },
        fit_canvas_to_parent: true,
        // the page decides which keys and touches are its own
        prevent_default_event_handling: false,
        canvas: Some("#lab".into()),
        // a focused canvas would scroll the page around a frame to itself; the lab's own page gives it the focus
        focused: cfg!(not(target_family = "wasm")),
        ..default()
    };
    let mut app = App::new();
    // on the web a page closes without asking
    let close_when_requested = cfg!(not(feature = "window"));
    let window = WindowPlugin { primary_window: Some(window), close_when_requested, ..default() };
    #[cfg(feature = "window")]
    app.add_plugins(kept::settings::KeepSettingsPlugin);
    add_plugins(&mut app, window);
    app.add_plugins((EguiPlugin::default(), SessionPlugin, rest::RestPlugin))
        .insert_resource(EguiGlobalSettings { auto_create_primary_context: false, ..default() })
        .add_message::<SessionCommand>()
        .add_systems(Startup, add_camera)
        .add_systems(Update, wake.after(session::gather))
        .add_systems(EguiPrimaryContextPass, show);
    // on the web, the page sends the system's theme
    #[cfg(feature = "window")]
    app.add_systems(Update, system_theme)
        .init_resource::<dialogs::Dialogs>()
        .init_resource::<capture::Capturing>()
        .init_resource::<clipboard::Clipboard>()
        .add_plugins(kept::autosave::AutosavePlugin::default())
        .add_systems(Update, window::close)
        .add_systems(Update, (dialogs::ask, dialogs::dropped, capture::follow).chain().before(session::gather));
    stay_on_one_thread(&mut app);
    app
}

/// Runs the systems of a frame on one thread. They are small: handing them to other threads takes longer than they do,
/// and longest where a driver draws with the processor. The ticks of a crowd are divided among threads all the same.
fn stay_on_one_thread(app: &mut App) {
    for (_, schedule) in app.world_mut().resource_mut::<Schedules>().iter_mut() {
        schedule.set_executor(SingleThreadedExecutor::new());
    }
}

/// Adds Bevy's own plugins, with this one for the window.
#[cfg(feature = "window")]
fn add_default_plugins(app: &mut App, window: WindowPlugin) {
    app.add_plugins(DefaultPlugins.set(window).set(quiet_log()));
}

/// The log without the graphics layers, whose long messages `run_window` replaces by one line.
#[cfg(feature = "window")]
fn quiet_log() -> bevy::log::LogPlugin {
    let filter = "wgpu_hal=off,wgpu_core=off,naga=off".into();
    bevy::log::LogPlugin { level: bevy::log::Level::ERROR, filter, ..default() }
}

/// Adds the camera, without multisampling: egui's painter smooths its own edges.
fn add_camera(mut commands: Commands) {
    commands.spawn((Camera2d, CameraRenderGraph::new(Core2d), PrimaryEguiContext, Msaa::Off));
}

#[cfg(feature = "window")]
/// Follows the system from light to dark and back. The theme is light where the system does not say.
fn system_theme(windows: Query<&Window, Changed<Window>>, mut interface: ResMut<Interface>) {
    for window in &windows {
        let theme = match window.window_theme {
            Some(WindowTheme::Dark) => Theme::Dark,
            _ => Theme::Light,
        };
        if interface.0.system_theme != theme {
            interface.0.system_theme = theme;
        }
    }
}

/// Draws frame after frame while the run plays or work goes on.
/// Else the window sleeps until something happens, a second at most.
fn wake(shown: Res<Shown>, aside: Res<Aside>, mut settings: ResMut<WinitSettings>) {
    let idle = std::time::Duration::from_secs(1);
    let mode =
        if shown.0.playing || aside.is_under_way() { UpdateMode::Continuous } else { UpdateMode::reactive(idle) };
    if settings.focused_mode != mode {
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
    }
}

fn show(world: &mut World) -> Result {
    let mut contexts = world.query_filtered::<&mut EguiContext, With<PrimaryEguiContext>>();
    let ctx = contexts.single_mut(world)?.get_mut().clone();
    if ctx.cumulative_pass_nr() == 0 {
        ctx.set_fonts(ui::paint::style::fonts());
    }
    let builder = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(ctx.viewport_rect());
    let mut root = egui::Ui::new(ctx.clone(), "lab".into(), builder);
    let mut commands = Vec::new();
    world.resource_scope(|world, mut interface: Mut<Interface>| {
        let (shown, history) = (world.resource::<Shown>(), world.resource::<History>());
        ui::lab(&mut root, &shown.0, history, &mut interface.0, &mut commands);
        let paper = interface.0.theme().clear_colour();
        world.resource_mut::<ClearColor>().0 = paper;
    });
    #[cfg(feature = "window")]
    dialogs::show(world, &ctx);
    if !commands.is_empty() {
        carry_out(world, commands);
        world.write_message(RequestRedraw);
    }
    Ok(())
}
