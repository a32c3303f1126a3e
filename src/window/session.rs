//! The session without its window: what a view shows of the run, and what its commands do.

mod pending;

use std::sync::Arc;

use bevy::app::{RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy::prelude::*;
use bevy::time::TimeSystems;

use super::background::{self, Background};
use super::crowd_views::{CrowdViews, crowd, update_crowds};
use super::error::SessionError;
use super::lab_systems::LabSystems;
use super::pace::{Pace, begin_ticks, end_ticks, limit, measure, play_flat_out};
use super::put_robot::put_robot;
use super::why;
use crate::window::ui::{
    Cockpit, CockpitRobot, Command, Dashboard, Interface, Notice, SessionCommand, ShownDashboard, blend,
};
use motion_lab_core::configuration::{HitchCfg, RobotKind, Sizes};
use motion_lab_core::geometry::{Footprint, Pose2, Segment};
use motion_lab_core::picture::{Picture, world as picture_of};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::World as WorldModel;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::plans::Planners;
use motion_lab_sim::run::{DT, Recipe};
use motion_lab_sim::simulation::{
    CommandRefused, Happening, History, HistoryPlugin, PendingInput, Playback, RobotKinds, RobotView, Roster,
    RunCommand, RunConfig, SensorRefused, SimulationPlugin, StandingWorld, Transport, Undo, checkpoint, sensors_of,
    settle, start_recipe, start_run, undoes, view_of,
};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
use pending::{Said, scene_of};

/// Farthest that a part moves from tick to tick, metres. A part that moved farther was put there.
const MAX_DRIVEN: f64 = 0.5;

/// The simulation with all that a view needs of it. Drawing, windows and dialogs are left to other plugins.
pub struct SessionPlugin;

impl Plugin for SessionPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins((SimulationPlugin, HistoryPlugin))
            .init_resource::<Interface>()
            .init_resource::<Planners>()
            .init_resource::<Worlds>()
            .init_resource::<CrowdViews>()
            .init_resource::<Background>()
            .init_resource::<Pace>()
            .insert_resource(ShownDashboard(Dashboard {
                cockpits: Vec::new(),
                seed: BOOK_SEED,
                tick: 0,
                frontier: 0,
                speed: 1.0,
                playing: false,
                looping: false,
                behind: None,
                next_contact: None,
                has_contact: false,
                can_undo: false,
                can_redo: false,
            }))
            .add_systems(Startup, start)
            .add_systems(First, limit.before(TimeSystems))
            .add_systems(RunFixedMainLoop, begin_ticks.in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop))
            .add_systems(RunFixedMainLoop, end_ticks.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop))
            .add_systems(
                Update,
                (background::go_on, play_flat_out, measure, note_refusals, gather.in_set(LabSystems::Read)).chain(),
            );
    }
}

/// The run's worlds as they stand.
#[derive(Resource, Default)]
struct Worlds(Vec<DrawnWorld>);

/// A world with its picture and its names.
struct DrawnWorld {
    standing: Arc<WorldModel>,
    picture: Arc<Picture>,
    atlas: Arc<Atlas>,
    robots: u32,
}

impl DrawnWorld {
    fn of(standing: &Arc<WorldModel>) -> Self {
        // the run's robots move, so only still things are named
        let still = WorldModel { robots: vec![], ..WorldModel::clone(standing) };
        let (picture, atlas) = (Arc::new(picture_of(standing)), Arc::new(Atlas::new(still)));
        DrawnWorld { standing: Arc::clone(standing), picture, atlas, robots: standing.robots.len() as u32 }
    }
}

/// Draws those worlds again whose obstacles or doors have changed.
fn draw_worlds(world: &mut World) {
    let entities = world.get_resource::<Roster>().map_or(&[][..], Roster::worlds);
    let standing: Vec<Arc<WorldModel>> =
        entities.iter().filter_map(|&e| Some(Arc::clone(&world.get::<StandingWorld>(e)?.0))).collect();
    let mut drawn = world.resource_mut::<Worlds>();
    drawn.0.truncate(standing.len());
    for (i, standing) in standing.iter().enumerate() {
        match drawn.0.get_mut(i) {
            Some(old) if Arc::ptr_eq(&old.standing, standing) => {}
            Some(old) => *old = DrawnWorld::of(standing),
            None => drawn.0.push(DrawnWorld::of(standing)),
        }
    }
}

fn start(world: &mut World) -> Result {
    let (kinds, planners) = (world.resource::<RobotKinds>().known(), world.resource::<Planners>().clone());
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    ui.atlas.know(kinds);
    ui.plan.planners = planners;
    if !world.contains_resource::<RunConfig>() {
        start_run(world, TourConfig::default(), BOOK_SEED)?;
        world.resource_mut::<Transport>().playback = Playback::Playing;
    }
    Ok(())
}

/// Shows why a command was refused, or a sensor.
fn note_refusals(
    mut commands: MessageReader<CommandRefused>,
    mut sensors: MessageReader<SensorRefused>,
    mut interface: ResMut<Interface>,
) {
    let commands = commands.read().map(|CommandRefused(error)| error.to_string());
    for text in commands.chain(sensors.read().map(ToString::to_string)) {
        interface.0.say(Notice { text, is_error: true });
    }
}

/// Reads the values that the window shows from the simulation. This is the one place where the two meet.
pub fn gather(world: &mut World) {
    settle(world);
    draw_worlds(world);
    why::forget_if_other(world);
    let config = Arc::clone(world.resource::<RunConfig>().config());
    world.resource_mut::<Interface>().0.plan.see_run(&config);
    let transport = world.resource::<Transport>();
    let (seed, tick, frontier, speed, looping, playback) = (
        transport.seed(),
        transport.tick(),
        transport.frontier(),
        transport.speed,
        transport.looping,
        transport.playback,
    );
    let playing = playback == Playback::Playing;
    // while it plays, the view is one tick behind and moves smoothly; paused or as fast as possible, it shows the tick
    let smooth = playing && speed.is_finite();
    let between = if smooth { world.resource::<Time<Fixed>>().overstep_fraction_f64() } else { 1.0 };
    // the last frame's view lets go of its lists of robots, which the next ones are written into
    world.resource_mut::<ShownDashboard>().0.cockpits.clear();
    update_crowds(world);
    let mut first = 0;
    let mut cockpits = Vec::new();
    for (number, drawn) in world.resource::<Worlds>().0.iter().enumerate() {
        let ids = first..first + drawn.robots;
        first = ids.end;
        let crowd = crowd(world, number, between);
        let state = &world.resource::<Interface>().0.crowd;
        let picked = crowd.as_ref().and_then(|crowd| state.picked_in(crowd)).map(|p| p.id);
        let is_shown = |id: &u32| crowd.is_none() || picked == Some(*id);
        let robots =
            ids.filter(is_shown).filter_map(|id| view_of(world, id)).map(|robot| shown(world, &robot, between));
        let robots: Vec<CockpitRobot> = robots.collect();
        let waiting = pending::waits(world, &drawn.standing.name, &robots);
        let doors = pending::doors(world, &drawn.standing.name);
        let (picture, atlas) = (Arc::clone(&drawn.picture), Arc::clone(&drawn.atlas));
        let standing = Arc::clone(&drawn.standing);
        cockpits.push(Cockpit { world: picture, atlas, standing, robots, crowd, doors, waiting });
    }
    let (undo, history) = (world.resource::<Undo>(), world.resource::<History>());
    let dashboard = Dashboard {
        cockpits,
        seed,
        tick,
        frontier,
        speed,
        playing,
        looping,
        behind: world.resource::<Pace>().words(speed).filter(|_| playing),
        next_contact: history.next_contact(tick),
        has_contact: history.marks().iter().any(|mark| mark.what == Happening::Contact),
        can_undo: undoes(world),
        can_redo: undo.can_redo(),
    };
    world.insert_resource(ShownDashboard(dashboard));
}

fn shown(world: &World, robot: &RobotView, between: f64) -> CockpitRobot {
    let tick = world.resource::<Transport>().tick();
    let is_arm = robot.tip.is_some();
    let pose = match robot.coordinates[..] {
        [x, y, theta, ..] => Some(Pose2 { x, y, theta }),
        _ => None,
    };
    let trail = world.resource::<History>().at(tick, robot.id);
    let playing = world.resource::<Transport>().playback == Playback::Playing;
    let target = pending::target(world, robot);
    // paused, a robot says where it will be, as its ghost and its fields do
    let next = target.as_ref().filter(|_| !playing).and_then(|to| pending::next(world, robot, to));
    let now = || Said {
        readout: robot.configuration.clone(),
        in_full: robot.configuration_in_full.clone(),
        tip: robot.tip,
        clearance: trail.map(|t| pending::clearance(world, robot, t.clearance)),
    };
    let Said { readout, in_full, tip, clearance } = next.unwrap_or_else(now);
    CockpitRobot {
        id: robot.id,
        name: robot.name.clone(),
        kind: robot.kind.clone(),
        about: robot.about,
        model: robot.model,
        readout,
        in_full,
        coordinates: robot.coordinates.clone(),
        target,
        footprint: blend(&robot.previous_footprint, &robot.footprint, between, MAX_DRIVEN),
        // a disc does not show which way it faces; its third coordinate does
        heading: pose.filter(|_| robot.footprint.parts().len() == 1 && !is_arm).map(|p| p.theta),
        gait: robot.gait(),
        // a flash is shown while the run plays; at rest, red is this very tick's contact
        flash: if playing { robot.flash > 0 } else { robot.in_contact },
        contacts: robot.contacts,
        clearance: clearance.filter(|clearance| clearance.metres.is_finite()),
        manual: robot.manual,
        along_path: robot.manual
            && world.resource::<Interface>().0.plan.plays_alone(&world.resource::<PendingInput>().script().events),
        // an arm is moved by its joints
        drivable: !is_arm,
        is_arm,
        trailer: (robot.kind == RobotKind::HITCH.name).then_some(robot.coordinates.len() == 4),
        sees: sensors_of(world, robot.id),
        tip,
        reversals: trail.map_or(0, |t| t.reversals),
        no_room: pose
            .filter(|_| robot.kind == RobotKind::HITCH.name && robot.coordinates.len() == 3)
            .and_then(|p| no_room(world, robot, p)),
        put: pending::put(world, robot),
        put_since_goal: pending::put_since_goal(world, robot),
    }
}

/// The first obstacle that a trailer put on behind the car at `body`, or the bar between them, would overlap, in words.
fn no_room(world: &World, robot: &RobotView, body: Pose2) -> Option<String> {
    let scene = scene_of(world, robot)?;
    let Some(AnyRobot::Hitch(car)) = robot.model else { return None };
    let (car, q) = (car.with_trailer(), HitchCfg { body, trailer: Some(body.theta) });
    let bar = Segment::new(body.position(), car.trailer_axle(&q)?.position());
    let touched = [car.footprint(&q), Footprint::capsules([bar], 0.0)].map(|f| scene.touched(&f));
    let mut names: Vec<&str> = touched.iter().flatten().filter_map(|id| scene.obstacle_name(*id)).collect();
    names.dedup();
    names.first().map(|name| format!("would overlap {name}"))
}

/// Carries out the commands of the widgets. Those that need a dialog are left to the window, as messages.
pub fn carry_out(world: &mut World, commands: Vec<Command>) {
    for command in commands {
        note_dropped(world, &command);
        match command {
            Command::Run(RunCommand::Transport(command)) if background::seek_in_background(world, &command) => {}
            Command::Run(command) => {
                // what else is asked of the run ends the work under way
                background::stop(world);
                world.write_message(command);
            }
            Command::Session(SessionCommand::Links { robot, links }) => {
                let notice = said_of(change_links(world, &robot, links));
                world.resource_mut::<Interface>().0.say(notice);
            }
            Command::Session(SessionCommand::PutRobot { world: of, robot, coordinates }) => {
                background::stop(world);
                let done = put_robot(world, &of, &robot, coordinates);
                let notice = match done {
                    Ok(()) => Notice { text: format!("{robot} is put there at the next tick"), is_error: false },
                    Err(error) => Notice { text: error.to_string(), is_error: true },
                };
                world.resource_mut::<Interface>().0.say(notice);
            }
            Command::Session(command @ (SessionCommand::RunWorld | SessionCommand::RunFromHere)) => {
                let atlas = &world.resource::<Interface>().0.atlas;
                let here = command == SessionCommand::RunFromHere;
                let model = if here { atlas.atlas().from_here() } else { atlas.world().clone() };
                let seed = world.resource::<Transport>().seed();
                let config = TourConfig { worlds: vec![model], ..TourConfig::default() };
                let ran = new_run(world, Recipe::new(config, seed));
                if ran.is_ok() {
                    world.resource_mut::<Transport>().playback = Playback::Playing;
                    world.resource_mut::<Interface>().0.widget = Widget::Dashboard;
                }
                world.resource_mut::<Interface>().0.say(said_of(ran));
            }
            Command::Session(SessionCommand::ThreeRobots) => {
                let seed = world.resource::<Transport>().seed();
                let notice = said_of(new_run(world, Recipe::new(TourConfig::default(), seed)));
                world.resource_mut::<Interface>().0.say(notice);
            }
            Command::Session(SessionCommand::PlayPath) => play_path(world),
            Command::Session(SessionCommand::Why) => why::ask(world),
            Command::Session(SessionCommand::PlayWayOut) => why::play_way_out(world),
            #[cfg(feature = "window")]
            Command::Session(command) => super::desktop::carry_out(world, command),
            #[cfg(not(feature = "window"))]
            Command::Session(command) => _ = world.write_message(command),
        }
    }
}

/// Says what an input drops that is given to a run at an earlier tick than it has reached.
fn note_dropped(world: &mut World, command: &Command) {
    let transport = world.resource::<Transport>();
    let (tick, frontier) = (transport.tick(), transport.frontier());
    let is_input = matches!(command, Command::Run(RunCommand::Robot(_) | RunCommand::World(_)));
    if is_input && tick < frontier {
        let text = format!("What came after {:.2} s is dropped. Undo brings it back.", tick as f64 * DT);
        world.resource_mut::<Interface>().0.say(Notice { text, is_error: false });
    }
}

/// What is said where a new run took the place of another, or could not.
fn said_of(ran: Result<(), SessionError>) -> Notice {
    match ran {
        Ok(()) => Notice { text: "A new run. Undo brings back the one before.".to_owned(), is_error: false },
        Err(error) => Notice { text: error.to_string(), is_error: true },
    }
}

/// Starts a run in which the plan's robot plays its path alone in its world, and shows it. Where it can't be played,
/// says why.
fn play_path(world: &mut World) {
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let Some((model, played)) = ui.plan.played() else { return };
    let played = match played {
        Ok(played) => played,
        Err(error) => {
            return ui.say(Notice { text: format!("the path can't be played: {error}"), is_error: true });
        }
    };
    let (seed, config) = (ui.plan.seed(), TourConfig { worlds: vec![model], sensor: None, ..TourConfig::default() });
    let inputs = played.script.events.clone();
    let ran = new_run(world, Recipe::new(config, (seed, played.script)));
    if ran.is_ok() {
        world.resource_mut::<Transport>().playback = Playback::Playing;
    }
    let config = Arc::clone(world.resource::<RunConfig>().config());
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    if ran.is_ok() {
        ui.plan.is_played_by(&config, inputs);
        ui.widget = Widget::Dashboard;
    }
    ui.say(said_of(ran));
}

/// A new run of the same seed in which the arm named `robot` has two or three links.
fn change_links(world: &mut World, robot: &str, links: usize) -> Result<(), SessionError> {
    let mut config = TourConfig::clone(world.resource::<RunConfig>().config());
    let mut arms = config.worlds.iter_mut().flat_map(|w| &mut w.robots);
    let Some(arm) = arms.find(|r| r.name == robot) else { return Err(SessionError::NoRobot(robot.to_owned())) };
    arm.kind = if links == 3 { RobotKind::REACH3 } else { RobotKind::REACH }.name.into();
    // base and radius are its own still; the lengths become those of the other kind
    if let (Some(Sizes::Arm(own)), Some(Sizes::Arm(other))) = (&mut arm.sizes, Sizes::of_kind(&arm.kind)) {
        own.lengths = other.lengths;
    }
    arm.start.resize(links, 0.5);
    let seed = world.resource::<Transport>().seed();
    new_run(world, Recipe::new(config, seed))
}

/// Starts a new run in place of the present one, which an undo brings back. Playback, speed and looping stay.
pub fn new_run(world: &mut World, recipe: Recipe) -> Result<(), SessionError> {
    background::stop(world);
    checkpoint(world);
    let transport = world.resource::<Transport>();
    let (playback, speed, looping) = (transport.playback, transport.speed, transport.looping);
    start_recipe(world, recipe)?;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed, transport.looping) = (playback, speed, looping);
    Ok(())
}
