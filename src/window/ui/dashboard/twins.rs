//! The first thing offered beside a robot: another configuration at its position, an arm's other elbow or a car's other
//! heading, as a ghost. The arm goes there where the straight way is free.

use std::f64::consts::{PI, TAU};

use bevy_egui::egui::{Label, RichText, Ui};

use super::twin_state::{AskedTwin, ElbowFlip};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::{Cockpit, CockpitRobot, Command, Dashboard, FrameColours, LinkedState, UiState};
use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::configuration::{AnyConfiguration, Configuration, RobotKind};
use motion_lab_core::num::{greater, sin, wrap};
use motion_lab_core::picture::{Item, Role, footprint};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_sim::anatomy::{SweptMotion, both_configurations, contact_items, in_the_way, twin};
use motion_lab_sim::manifest::HintTask;
use motion_lab_sim::run::{DT, Quantized, RobotInput};
use motion_lab_sim::simulation::{RobotCommand, TransportCommand};

/// The greatest rate at which a joint turns on the way, radians per second: that of the arm's tour.
const RATE: f64 = 2.0;

/// Height of the button on a narrow screen, points.
const FINGERTIP: f32 = 44.0;

/// Least sine of the elbow's angle of an arm that teaches what its twin is.
const MIN_BEND: f64 = 0.5;

/// Difference of two angles that counts as none, radians: more than the rounding of inputs.
const SAME: f64 = 1e-4;

/// A robot of a cockpit as a model with its configuration, if it is one of the lab's that has a twin: an arm with two
/// links or a car.
fn modelled(robot: &CockpitRobot) -> Option<(AnyRobot, AnyConfiguration)> {
    let q = AnyRobot::of_kind(&robot.kind, &robot.coordinates)?.1;
    let is_one = matches!(q, AnyConfiguration::T2(_) | AnyConfiguration::Hitch(_));
    robot.model.filter(|_| is_one).map(|model| (model.fitted(&q), q))
}

/// The twin of a cockpit's robot, where it is shown: of an arm always, unless it is being moved by hand; of a car on
/// demand.
pub fn shown_twin(robot: &CockpitRobot, state: &UiState) -> Option<AnyConfiguration> {
    let asked = state.twin.as_ref().filter(|asked| asked.robot == robot.name);
    let (model, q) = modelled(robot)?;
    match asked {
        Some(AskedTwin { way: Some(way), .. }) => Some(way.sweep.to),
        None if !robot.is_arm || robot.target.is_some() => None,
        _ => twin(&model, &q),
    }
}

/// The twins of a cockpit's robots as ghosts, and where the way to one of them hits.
pub fn twin_items(cockpit: &Cockpit, state: &UiState) -> Vec<Item> {
    let mut items = Vec::new();
    // where robots share the room, none is offered
    if let [robot] = &cockpit.robots[..] {
        if let Some((q, (model, _))) = shown_twin(robot, state).zip(modelled(robot)) {
            let name = if robot.is_arm { "the other elbow" } else { "the other heading" };
            items.extend(footprint("twin", name, &model.footprint(&q), Role::Robot, 0.3));
        }
        if let Some(AskedTwin { robot: name, way: Some(way) }) = &state.twin
            && *name == robot.name
        {
            items.extend(contact_items(&way.checker, &way.sweep));
        }
    }
    items
}

/// Offers a robot's twin by a button, and says in place what came of it. Offers none to other robots.
pub fn offer(ui: &mut Ui, cockpit: &Cockpit, robot: &CockpitRobot, look: &FrameColours, state: &mut UiState) {
    let Some((fitted, q)) = modelled(robot) else { return };
    let other = twin(&fitted, &q);
    let asked = state.twin.as_ref().filter(|asked| asked.robot == robot.name);
    let is_asked = asked.is_some();
    let words = if robot.is_arm { "One tip, two elbows" } else { "One place, two headings" };
    // the way would begin where a waiting input takes the arm away from
    let waits = robot.is_arm && robot.target.is_some() && cockpit.waiting && !is_asked;
    let button = LabButton::new(words).enabled(other.is_some() && !waits);
    let button = if robot.is_arm { button } else { button.selected(is_asked) };
    let show = |ui: &mut Ui| {
        // among rows of words a fingertip finds a button of its own height
        ui.spacing_mut().interact_size.y = if look.narrow && !look.low { FINGERTIP } else { 0.0 };
        button.show(ui, look).clicked()
    };
    let clicked = ui.scope(show).inner;
    let way = asked.and_then(|asked| asked.way.as_ref());
    let said = match (way, other) {
        (Some(way), _) => {
            asked.and_then(AskedTwin::blocked).unwrap_or_else(|| format!("{}: it goes there", way.verdict()))
        }
        (None, _) if waits => "the drag waits for the next tick: step or play first".to_owned(),
        (None, None) => "straight or folded: no other arm has this tip".to_owned(),
        (None, Some(_)) if robot.is_arm => "the ghost has the same tip: send the arm there".to_owned(),
        (None, Some(other)) if is_asked => {
            let there = in_the_way(&state.linked.checker_of(&cockpit.atlas, &fitted), &other);
            let there = there.map_or_else(|| "free there too".to_owned(), |name| format!("there it overlaps {name}"));
            format!("{there}; its wheels can't turn it on the spot")
        }
        (None, Some(_)) => String::new(),
    };
    if !said.is_empty() {
        ui.add(Label::new(RichText::new(said).color(look.colour(Role::Muted))).wrap());
    }
    if clicked {
        let is_off = is_asked && !robot.is_arm;
        state.twin = (!is_off).then(|| AskedTwin { robot: robot.name.clone(), way: None });
        if !robot.is_arm {
            state.did.push(HintTask::TwoHeadings);
        }
    }
}

/// Puts the first arm with two links where it is free and so is the straight way to its other elbow, unless it stands
/// there and nothing moves it: where it is, else at the first such place of a coarse grid of its joint angles. Puts it
/// nowhere if there is none.
pub fn put_where_it_teaches(model: &Dashboard, linked: &LinkedState, commands: &mut Vec<Command>) {
    let mut arms = model.cockpits.iter().flat_map(|c| c.robots.iter().map(move |robot| (c, robot)));
    let Some((cockpit, robot)) = arms.find(|(_, robot)| robot.kind == RobotKind::REACH.name) else { return };
    let Some((fitted, now)) = modelled(robot) else { return };
    let checker = linked.checker_of(&cockpit.atlas, &fitted);
    let teaches = |q: &AnyConfiguration| {
        let way = twin(&fitted, q).and_then(|other| SweptMotion::new(&checker, q, &other).ok());
        // an elbow that is hardly bent has nearly no twin
        let is_bent = q.coordinates().last().is_some_and(|bend| sin(*bend).abs() >= MIN_BEND);
        is_bent && way.is_some_and(|way| matches!(way.verdict, EdgeVerdict::Free { .. }))
    };
    let is_still = !model.playing || robot.manual && !robot.along_path && model.tick == model.frontier;
    if is_still && robot.target.is_none() && teaches(&now) {
        return;
    }
    let steps = |count: u32| (0..count).map(move |k| (f64::from(k) + 0.5) * TAU / f64::from(count) - PI);
    let grid = steps(24).flat_map(|th1| [1.5, -1.5, 1.0, -1.0].map(|th2| now.with(0, th1).with(1, th2)));
    let Some(there) = std::iter::once(now).chain(grid).find(teaches) else { return };
    let to: Option<Vec<Quantized>> = there.coordinates().iter().map(|angle| Quantized::try_new(*angle)).collect();
    let input = |to| RobotCommand { robot: robot.name.clone(), input: RobotInput::Teleport(to) };
    commands.push(Command::from(TransportCommand::Checkpoint));
    commands.extend(to.map(|to| Command::from(input(to))));
    if !model.playing {
        commands.push(Command::from(TransportCommand::Step));
    }
}

/// What both configurations of the first robot of this kind teach, at the position where it is.
pub fn both_of(kind: RobotKind, model: &Dashboard, state: &UiState) -> Option<String> {
    let mut robots = model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
    let robot = robots.find(|robot| robot.kind == kind.name)?;
    if let Some(AskedTwin { way: Some(way), robot: name }) = &state.twin
        && *name == robot.name
    {
        return Some(format!("Two elbows have this tip, and {}.", way.verdict()));
    }
    let (fitted, q) = modelled(robot)?;
    let both = both_configurations(&fitted, &q)?;
    Some(if robot.is_arm {
        format!("One tip, two configurations: {both}. A tip does not say where the elbow is.")
    } else {
        format!("One place, two configurations: {both}. A place does not say which way the car faces.")
    })
}

/// Begins an arm's way to its other elbow if it was asked for, and sends the arm on along it, a target in each tick.
/// The way ends at the other elbow, or where somebody else moves the arm or time.
pub fn go_on(model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(AskedTwin { robot: name, way }) = &mut state.twin else { return };
    let Some((cockpit, robot)) = model.robot(name) else { return state.twin = None };
    let Some(way) = way else {
        if robot.is_arm {
            let begun = begin(cockpit, robot, model, &state.linked, commands);
            if begun.as_ref().is_some_and(|way| way.ticks == 0) {
                state.did.push(HintTask::TwoElbows);
            }
            state.twin = begun.map(|way| AskedTwin { robot: robot.name.clone(), way: Some(way) });
        }
        return;
    };
    let at = way.at().coordinates();
    let is_there = at.len() == robot.coordinates.len()
        && at.iter().zip(&robot.coordinates).all(|(a, b)| wrap(a - b).abs() <= SAME);
    let stands = is_there && model.tick >= way.due && way.ticks == 0 && robot.target.is_none();
    if model.tick + 1 == way.due || stands {
        // it waits for its tick, or stands where its way is blocked
    } else if !is_there || model.tick < way.due || way.ticks == 0 {
        state.twin = None;
    } else if way.done < way.ticks {
        way.done += 1;
        way.send(name, model.tick, commands);
    } else {
        if way.pauses {
            commands.push(Command::from(TransportCommand::Pause));
        } else if way.steps {
            commands.push(Command::from(TransportCommand::Play));
        }
        state.did.push(HintTask::TwoElbows);
        state.twin = None;
    }
}

/// Begins the straight motion of an arm to its other elbow. Where it is blocked the arm stays, so that what is said of
/// it stays true.
fn begin(
    cockpit: &Cockpit,
    robot: &CockpitRobot,
    model: &Dashboard,
    linked: &LinkedState,
    commands: &mut Vec<Command>,
) -> Option<ElbowFlip> {
    let (fitted, q) = modelled(robot)?;
    let checker = linked.checker_of(&cockpit.atlas, &fitted);
    let sweep = SweptMotion::new(&checker, &q, &twin(&fitted, &q)?).ok()?;
    let turns = q.coordinates().into_iter().zip(sweep.to.coordinates());
    let most = turns.map(|(from, to)| wrap(to - from).abs()).fold(0.0, |most, turn| greater(turn, most));
    let is_free = matches!(sweep.verdict, EdgeVerdict::Free { .. });
    let ticks = if is_free { (most / (RATE * DT)).ceil() as u32 } else { 0 };
    let steps = is_free && model.speed.is_infinite();
    let mut way = ElbowFlip { checker, sweep, done: ticks.min(1), ticks, due: 0, pauses: !model.playing, steps };
    // a refusal leaves the run as it is; only at its end, while it plays, is the arm told to stay
    if !is_free && (!model.playing || model.tick < model.frontier) {
        return Some(way);
    }
    commands.push(Command::from(TransportCommand::Checkpoint));
    way.send(&robot.name, model.tick, commands);
    if is_free && !model.playing && !steps {
        commands.push(Command::from(TransportCommand::Play));
    }
    Some(way)
}
