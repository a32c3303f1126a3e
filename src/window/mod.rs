//! The lab in a window: the session, a camera, and egui painting what is in front.

mod background;
mod captured;
mod crowd_views;
#[cfg(feature = "window")]
pub mod desktop;
mod error;
mod explained;
mod input_order;
mod lab_systems;
mod modifiers;
mod pace;
mod put_robot;
mod run_files;
mod screen;
mod session;
// two attributes, because the lints recognise only a bare `cfg(test)`
#[cfg(test)]
#[cfg(feature = "window")]
mod tests;
pub(crate) mod ui;
mod why;

use bevy::core_pipeline::Core2d;
use bevy::ecs::schedule::SingleThreadedExecutor;
use bevy::prelude::*;
use bevy::render::camera::CameraRenderGraph;
use bevy::window::{RequestRedraw, WindowFocused, WindowResizeConstraints, WindowResolution};
use bevy::winit::{UpdateMode, WinitSettings};
use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext, egui};

use background::Background;
pub use lab_systems::LabSystems;
use motion_lab_sim::simulation::History;
use session::{SessionPlugin, carry_out};
use ui::paint::style::ScreenTheme;
use ui::{Interface, SessionCommand, ShownDashboard};

/// What the page asks of the session.
#[cfg(all(target_family = "wasm", feature = "web"))]
pub(crate) mod for_page {
    pub(crate) use super::background::{seek_in_background, stop as stop_background};
    pub(crate) use super::captured::{captured, subject};
    pub(crate) use super::error::SessionError;
    pub(crate) use super::pace::limit;
    pub(crate) use super::run_files::{open_log, open_path_text, open_world_text, path_text, save, shown_run};
    pub(crate) use super::session::new_run;
    pub(crate) use super::ui::{Interface, ShownDashboard};
    pub(crate) use super::why::{explain, play_way_out};
    pub(crate) use super::windowed_app;
}

/// Whether the lab works in the background: it goes to another tick, or compares a log that was opened.
pub fn is_busy(world: &World) -> bool {
    world.get_resource::<Background>().is_some_and(Background::is_under_way)
}

/// Least width and height of the window, points.
const MIN_WINDOW: f32 = 360.0;

/// The lab in a window, with the tour of the three worlds from the book's seed. A run already under way is kept.
pub(crate) fn windowed_app(add_plugins: impl FnOnce(&mut App, WindowPlugin)) -> App {
    let window = Window {
        title: "Motion Lab".into(),
        resolution: WindowResolution::new(1280, 800),
        resize_constraints: WindowResizeConstraints { min_width: MIN_WINDOW, min_height: MIN_WINDOW, ..default() },
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
    let close_when_requested = cfg!(target_family = "wasm");
    let window = WindowPlugin { primary_window: Some(window), close_when_requested, ..default() };
    #[cfg(feature = "window")]
    desktop::add_settings(&mut app);
    add_plugins(&mut app, window);
    app.add_plugins((screen::ScreenPlugin, SessionPlugin))
        .add_message::<SessionCommand>()
        .add_systems(Startup, add_camera)
        .add_systems(Update, wake.after(session::gather))
        .add_systems(Update, let_go_of_tow)
        .add_systems(EguiPrimaryContextPass, show.in_set(LabSystems::LayOut));
    #[cfg(feature = "window")]
    desktop::add(&mut app);
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

/// Adds the camera, without multisampling: egui's painter smooths its own edges.
fn add_camera(mut commands: Commands) {
    commands.spawn((Camera2d, CameraRenderGraph::new(Core2d), PrimaryEguiContext, Msaa::Off));
}

/// Draws frame after frame while the run plays or work goes on.
/// Else the window sleeps until something happens, a second at most.
fn wake(shown: Res<ShownDashboard>, background: Res<Background>, mut settings: ResMut<WinitSettings>) {
    let idle = std::time::Duration::from_secs(1);
    let mode =
        if shown.0.playing || background.is_under_way() { UpdateMode::Continuous } else { UpdateMode::reactive(idle) };
    if settings.focused_mode != mode {
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
    }
}

/// Lets go of the robot that the pointer tows when the window loses the focus: the release may go to another window.
fn let_go_of_tow(mut changes: MessageReader<WindowFocused>, mut interface: ResMut<Interface>) {
    let losses = changes.read().filter(|change| !change.focused).count();
    if losses > 0 && interface.0.hand.tow.is_some() {
        interface.0.hand.tow = None;
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
        let (shown, history) = (world.resource::<ShownDashboard>(), world.resource::<History>());
        ui::lab(&mut root, &shown.0, history, &mut interface.0, &mut commands);
        let paper = interface.0.theme().clear_colour();
        world.resource_mut::<ClearColor>().0 = paper;
    });
    #[cfg(feature = "window")]
    desktop::dialogs::show(world, &ctx);
    if !commands.is_empty() {
        carry_out(world, commands);
        world.write_message(RequestRedraw);
    }
    Ok(())
}
