//! The session without its window: what a view shows of the run, and what its commands do.

use std::sync::Arc;

use bevy::prelude::*;

use super::error::SessionError;
use super::pace::{Pace, measure, play_flat_out};
use crate::atlas::Atlas;
use crate::configuration::{Coordinates, HitchCfg, RobotKind, Sizes};
use crate::geometry::{Footprint, Pose2, Segment};
use crate::picture::{Picture, world as picture_of};
use crate::robots::{AnyRobot, Robot};
use crate::run::{Event, RobotInput};
use crate::simulation::{
    CommandRefused, History, HistoryPlugin, LatestFrame, PendingInput, Playback, RobotView, Roster, RunConfig,
    RunInput, SimulationPlugin, Transport, Undo, WorldScene, checkpoint, start_run, view,
};
use crate::tour::{BOOK_SEED, TourConfig};
use crate::ui::{Cockpit, CockpitRobot, Command, Dashboard, Notice, SessionCommand, UiState, Widget, blend};
use crate::worlds::World as WorldModel;

/// Farthest that a part moves from tick to tick, metres. A part that moved farther was put there.
const LEAP: f64 = 0.5;

/// The simulation with all that a view needs of it. Drawing, windows and dialogs are left to other plugins.
pub struct SessionPlugin;

impl Plugin for SessionPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins((SimulationPlugin, HistoryPlugin))
            .init_resource::<Interface>()
            .init_resource::<Worlds>()
            .init_resource::<Pace>()
            .insert_resource(Shown(Dashboard {
                cockpits: Vec::new(),
                seed: BOOK_SEED,
                tick: 0,
                frontier: 0,
                speed: 1.0,
                playing: false,
                looping: false,
                behind: None,
                next_contact: None,
                can_undo: false,
                can_redo: false,
            }))
            .add_systems(Startup, start)
            .add_systems(Update, (play_flat_out, measure, note_refusals, gather).chain());
    }
}

/// The state of the user interface. It is no part of a run.
#[derive(Resource, Default)]
pub struct Interface(pub UiState);

/// The pictures of the run's worlds, and the worlds with their names.
#[derive(Resource, Default)]
struct Worlds(Vec<(Arc<Picture>, Arc<Atlas>)>);

/// The values of the dashboard in this frame.
#[derive(Resource)]
pub struct Shown(pub Dashboard);

fn start(world: &mut World) -> Result {
    if !world.contains_resource::<RunConfig>() {
        start_run(world, TourConfig::default(), BOOK_SEED)?;
        world.resource_mut::<Transport>().playback = Playback::Playing;
    }
    Ok(())
}

/// Shows why a command was refused.
fn note_refusals(mut refused: MessageReader<CommandRefused>, mut interface: ResMut<Interface>) {
    for CommandRefused(error) in refused.read() {
        interface.0.notice = Some(Notice { text: error.to_string(), is_error: true });
    }
}

/// Reads the values that the window shows from the simulation. This is the one place where the two meet.
pub fn gather(world: &mut World) {
    if world.is_resource_changed::<RunConfig>() {
        // the run's robots move, so only still things are named
        let standing = |w: &WorldModel| Atlas::new(WorldModel { robots: vec![], ..w.clone() });
        let drawn = |w: &WorldModel| (Arc::new(picture_of(w)), Arc::new(standing(w)));
        let pictures = world.resource::<RunConfig>().0.worlds.iter().map(drawn).collect();
        world.insert_resource(Worlds(pictures));
    }
    let Transport { seed, tick, frontier, speed, looping, playback } = *world.resource::<Transport>();
    let playing = playback == Playback::Playing;
    // while it plays, the view is one tick behind and moves smoothly; paused or as fast as possible, it shows the tick
    let smooth = playing && speed.is_finite();
    let between = if smooth { world.resource::<Time<Fixed>>().overstep_fraction_f64() } else { 1.0 };
    let robots: Vec<(u32, CockpitRobot)> = view(world).iter().map(|r| (r.world, shown(world, r, between))).collect();
    let cockpits = world.resource::<Worlds>().0.iter().zip(0..).map(|((picture, atlas), number)| Cockpit {
        world: Arc::clone(picture),
        atlas: Arc::clone(atlas),
        robots: robots.iter().filter(|(w, _)| *w == number).map(|(_, r)| r.clone()).collect(),
    });
    let (undo, history) = (world.resource::<Undo>(), world.resource::<History>());
    let dashboard = Dashboard {
        cockpits: cockpits.collect(),
        seed,
        tick,
        frontier,
        speed,
        playing,
        looping,
        behind: world.resource::<Pace>().words(speed).filter(|_| playing),
        next_contact: history.next_contact(tick),
        can_undo: undo.can_undo(),
        can_redo: undo.can_redo(),
    };
    world.insert_resource(Shown(dashboard));
}

fn shown(world: &World, robot: &RobotView, between: f64) -> CockpitRobot {
    let tick = world.resource::<Transport>().tick;
    let is_arm = robot.tip.is_some();
    let pose = match robot.coordinates[..] {
        [x, y, theta, ..] => Some(Pose2 { x, y, theta }),
        _ => None,
    };
    let scan = world.resource::<LatestFrame>().0.scans.iter().find(|s| s.robot == robot.id);
    let trail = world.resource::<History>().at(tick, robot.id);
    CockpitRobot {
        name: robot.name.clone(),
        kind: robot.kind.clone(),
        about: robot.about,
        model: robot.model,
        readout: robot.configuration.clone(),
        in_full: robot.configuration_in_full.clone(),
        coordinates: robot.coordinates.clone(),
        target: target(world, robot),
        footprint: blend(&robot.previous_footprint, &robot.footprint, between, LEAP),
        // a disc does not show which way it faces; its third coordinate does
        heading: pose.filter(|_| robot.footprint.parts().len() == 1 && !is_arm).map(|p| p.theta),
        flash: robot.flash > 0,
        contacts: robot.contacts,
        manual: robot.manual,
        // an arm is moved by its joints
        drivable: !is_arm,
        is_arm,
        trailer: (robot.kind == RobotKind::HITCH.name).then_some(robot.coordinates.len() == 4),
        sees: pose.and_then(|pose| Some((pose, scan?.ranges.clone()))),
        tip: robot.tip,
        reversals: trail.map_or(0, |t| t.reversals),
        no_room: pose
            .filter(|_| robot.kind == RobotKind::HITCH.name && robot.coordinates.len() == 3)
            .and_then(|p| no_room(world, robot, p)),
        waiting: waiting(world, robot),
    }
}

/// Whether the run is paused with an input to the robot due at the next tick, an arm's target apart.
fn waiting(world: &World, robot: &RobotView) -> bool {
    let Transport { tick, playback, .. } = *world.resource::<Transport>();
    let due = world.resource::<PendingInput>().due(tick + 1);
    let own = |e: &Event| e.robot == robot.name && !matches!(e.input, RobotInput::MoveTo(_));
    playback == Playback::Paused && due.iter().any(own)
}

/// The first obstacle that a trailer put on behind the car at `body`, or the bar between them, would overlap, in words.
fn no_room(world: &World, robot: &RobotView, body: Pose2) -> Option<String> {
    let inhabited = *world.resource::<Roster>().worlds().get(robot.world as usize)?;
    let scene = &world.get::<WorldScene>(inhabited)?.0;
    let Some(AnyRobot::Hitch(car)) = robot.model else { return None };
    let (car, q) = (car.with_trailer(), HitchCfg { body, trailer: Some(body.theta) });
    let bar = Segment::new(body.position(), car.trailer_axle(&q)?.position());
    let touched = [car.footprint(&q), Footprint::capsules([bar], 0.0)].map(|f| scene.touched(&f));
    let mut names: Vec<&str> = touched.iter().flatten().filter_map(|id| scene.obstacle_name(*id)).collect();
    names.dedup();
    names.first().map(|name| format!("would overlap {name}"))
}

/// The joint angles that an input asks of an arm by the next tick.
fn target(world: &World, robot: &RobotView) -> Option<Coordinates> {
    let due = world.resource::<PendingInput>().due(world.resource::<Transport>().tick + 1);
    due.iter().rev().filter(|e| e.robot == robot.name).find_map(|e| match &e.input {
        RobotInput::MoveTo(to) => Some(to.iter().map(|c| c.value()).collect()),
        _ => None,
    })
}

/// Carries out the commands of the widgets. Those that need a dialog are left to the window, as messages.
pub fn carry_out(world: &mut World, commands: Vec<Command>) {
    for command in commands {
        match command {
            Command::Run(command) => _ = world.write_message(command),
            Command::Session(SessionCommand::Links { robot, links }) => {
                if let Err(error) = change_links(world, &robot, links) {
                    let notice = Notice { text: error.to_string(), is_error: true };
                    world.resource_mut::<Interface>().0.notice = Some(notice);
                }
            }
            Command::Session(SessionCommand::RunWorld) => {
                let model = world.resource::<Interface>().0.atlas.world().clone();
                let seed = world.resource::<Transport>().seed;
                let config = TourConfig { worlds: vec![model], ..TourConfig::default() };
                let ran = new_run(world, config, seed);
                let ui = &mut world.resource_mut::<Interface>().into_inner().0;
                match ran {
                    Ok(()) => ui.widget = Widget::Dashboard,
                    Err(error) => ui.notice = Some(Notice { text: error.to_string(), is_error: true }),
                }
            }
            Command::Session(command) => _ = world.write_message(command),
        }
    }
}

/// A new run of the same seed in which the arm named `robot` has two or three links.
fn change_links(world: &mut World, robot: &str, links: usize) -> Result<(), SessionError> {
    let mut config = TourConfig::clone(&world.resource::<RunConfig>().0);
    let mut arms = config.worlds.iter_mut().flat_map(|w| &mut w.robots);
    let Some(arm) = arms.find(|r| r.name == robot) else { return Err(SessionError::NoRobot(robot.to_owned())) };
    arm.kind = if links == 3 { RobotKind::REACH3 } else { RobotKind::REACH }.name.into();
    // base and radius are its own still; the lengths are those of an arm of so many links
    if let (Some(Sizes::Arm(own)), Some(Sizes::Arm(other))) = (&mut arm.sizes, Sizes::of_kind(&arm.kind)) {
        own.lengths = other.lengths;
    }
    arm.start.resize(links, 0.5);
    let seed = world.resource::<Transport>().seed;
    new_run(world, config, seed)
}

/// Starts a new run in place of the present one, which an undo brings back. Playback, speed and looping stay.
pub fn new_run(world: &mut World, config: TourConfig, input: impl Into<RunInput>) -> Result<(), SessionError> {
    checkpoint(world);
    let Transport { playback, speed, looping, .. } = *world.resource::<Transport>();
    start_run(world, config, input)?;
    let mut transport = world.resource_mut::<Transport>();
    *transport = Transport { playback, speed, looping, ..*transport };
    Ok(())
}
