//! The lab in a window: the simulation's plugin, a camera, and egui painting what is in front.

mod rest;
mod window;

use std::sync::Arc;

use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::window::{RequestRedraw, WindowResolution};
use bevy::winit::{UpdateMode, WinitSettings};
use bevy_egui::{EguiContexts, EguiGlobalSettings, EguiPlugin, EguiPrimaryContextPass, PrimaryEguiContext, egui};

pub use window::{WindowError, run_window};

use crate::picture::{Picture, world as picture_of};
use crate::simulation::{
    Playback, RobotCommand, RobotView, RunConfig, SimulationPlugin, Transport, TransportCommand, start_run, view,
};
use crate::tour::{BOOK_SEED, TourConfig};
use crate::ui::{self, Cockpit, CockpitRobot, Command, Dashboard, UiState, blend};

/// Between two ticks no robot moves farther than this, metres; what does was put there.
const LEAP: f64 = 0.5;

/// The lab in a window: the three worlds touring from the book's seed. A run already started in the app is kept.
pub fn windowed_app() -> App {
    let window = Window {
        title: "Motion Lab".into(),
        resolution: WindowResolution::new(1280, 800),
        fit_canvas_to_parent: true,
        prevent_default_event_handling: false,
        ..default()
    };
    // the graphics layers tell at length what `run_window` says in one line
    let filter = "wgpu_hal=off,wgpu_core=off,naga=off".into();
    let log = LogPlugin { level: Level::ERROR, filter, ..default() };
    let mut app = App::new();
    app.add_plugins((
        DefaultPlugins.set(WindowPlugin { primary_window: Some(window), ..default() }).set(log),
        EguiPlugin::default(),
        SimulationPlugin,
        rest::RestPlugin,
    ))
    .insert_resource(EguiGlobalSettings { auto_create_primary_context: false, ..default() })
    .init_resource::<Interface>()
    .init_resource::<Worlds>()
    .insert_resource(Shown(Dashboard {
        cockpits: Vec::new(),
        seed: BOOK_SEED,
        tick: 0,
        frontier: 0,
        speed: 1.0,
        playing: false,
    }))
    .add_systems(Startup, (add_camera, start))
    .add_systems(Update, (gather, wake).chain())
    .add_systems(EguiPrimaryContextPass, show);
    app
}

/// What the window remembers that is no part of a run.
#[derive(Resource, Default)]
struct Interface(UiState);

/// The pictures of the run's worlds.
#[derive(Resource, Default)]
struct Worlds(Vec<Arc<Picture>>);

/// What is in front in this frame.
#[derive(Resource)]
struct Shown(Dashboard);

/// Egui's painter smooths its own edges: multisampling would only cost.
fn add_camera(mut commands: Commands) {
    commands.spawn((Camera2d, PrimaryEguiContext, Msaa::Off));
}

fn start(world: &mut World) -> Result {
    if !world.contains_resource::<RunConfig>() {
        start_run(world, TourConfig::default(), BOOK_SEED)?;
        world.resource_mut::<Transport>().playback = Playback::Playing;
    }
    Ok(())
}

/// Takes what the window shows from the simulation. This is the one place where the two meet.
fn gather(world: &mut World) {
    if world.is_resource_changed::<RunConfig>() {
        let pictures = world.resource::<RunConfig>().0.worlds.iter().map(|w| Arc::new(picture_of(w))).collect();
        world.insert_resource(Worlds(pictures));
    }
    let transport = *world.resource::<Transport>();
    let playing = transport.playback == Playback::Playing;
    // while it plays the view is one tick behind and moves smoothly; paused, it shows the tick itself
    let between = if playing { world.resource::<Time<Fixed>>().overstep_fraction_f64() } else { 1.0 };
    let robots = view(world);
    let cockpits = world.resource::<Worlds>().0.iter().zip(0..).map(|(picture, number)| Cockpit {
        world: Arc::clone(picture),
        robots: robots.iter().filter(|r| r.world == number).map(|r| shown(r, between)).collect(),
    });
    let Transport { seed, tick, frontier, speed, .. } = transport;
    let dashboard = Dashboard { cockpits: cockpits.collect(), seed, tick, frontier, speed, playing };
    world.insert_resource(Shown(dashboard));
}

fn shown(robot: &RobotView, between: f64) -> CockpitRobot {
    CockpitRobot {
        name: robot.name.clone(),
        readout: robot.configuration.clone(),
        footprint: blend(&robot.previous_footprint, &robot.footprint, between, LEAP),
        // a disc does not show which way it faces; its third coordinate does
        heading: (robot.footprint.parts().len() == 1).then(|| robot.coordinates.get(2).copied()).flatten(),
        flash: robot.flash > 0,
        contacts: robot.contacts,
        manual: robot.manual,
        // an arm is moved by its joints
        drivable: robot.tip.is_none(),
        trailer: (robot.kind == "hitch").then_some(robot.coordinates.len() == 4),
    }
}

/// While it plays, frames follow one another; paused, the window sleeps until something happens.
fn wake(shown: Res<Shown>, mut settings: ResMut<WinitSettings>) {
    let idle = std::time::Duration::from_secs(1);
    let mode = if shown.0.playing { UpdateMode::Continuous } else { UpdateMode::reactive(idle) };
    if settings.focused_mode != mode {
        *settings = WinitSettings { focused_mode: mode, unfocused_mode: mode };
    }
}

fn show(
    mut contexts: EguiContexts,
    shown: Res<Shown>,
    mut interface: ResMut<Interface>,
    mut clear: ResMut<ClearColor>,
    mut transport: MessageWriter<TransportCommand>,
    mut robots: MessageWriter<RobotCommand>,
    mut redraw: MessageWriter<RequestRedraw>,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let builder = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(ctx.viewport_rect());
    let mut root = egui::Ui::new(ctx.clone(), "lab".into(), builder);
    let mut commands = Vec::new();
    ui::dashboard(&mut root, &shown.0, &mut interface.0, &mut commands);
    clear.0 = interface.0.theme.clear_colour();
    for command in commands {
        match command {
            Command::Transport(command) => drop(transport.write(command)),
            Command::Robot(command) => drop(robots.write(command)),
        }
        redraw.write(RequestRedraw);
    }
    Ok(())
}
