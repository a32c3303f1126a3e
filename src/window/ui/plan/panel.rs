//! The panel beside the papers: what is planned, by whom, and what came of it.

use std::sync::Arc;

use bevy_egui::egui::{ComboBox, DragValue, Label, RichText, Slider, Ui, WidgetInfo};

use super::blockers::what_to_move;
use super::race::{table, who_races};
use super::racer::PlanStage;
use super::state::PlanState;
use crate::window::ui::anatomy::view::{chooser, exact};
use crate::window::ui::number::{NumberInput, TypedKind};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::fold::fold;
use crate::window::ui::paint::frame::headline;
use crate::window::ui::paint::plate::refusal;
use crate::window::ui::{Command, Dashboard, FrameColours, SessionCommand, UiState};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, HitchCfg};
use motion_lab_core::picture::{Role, in_signs};
use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::World;
use motion_lab_sim::capture::{bounded, judged_words, proven, unit, within_best};
use motion_lab_sim::plans::{PathLengths, PlannerName, TUBE};

/// Width of a chooser, points.
const WIDTH: f32 = 180.0;

/// Where a world is that is not the book's own.
const IN_ATLAS: &str = ", in the atlas";
const IN_RUN: &str = ", in the run";
const CHANGED: &str = ", changed";

/// The most residents of a world to choose from.
const MAX_RESIDENTS: usize = 20;

/// Shows the panel: what is planned and by whom, and what came of it.
pub fn panel(ui: &mut Ui, model: &Dashboard, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    table(ui, look, &mut state.plan);
    choices(ui, model, state);
    ui.add_space(4.0);
    outcome(ui, look, &state.plan);
    ui.add_space(4.0);
    path_buttons(ui, model, look, &mut state.plan, commands);
    ui.add_space(4.0);
    ends(ui, state, false);
}

/// Shows what is planned, and by whom.
pub fn choices(ui: &mut Ui, model: &Dashboard, state: &mut UiState) {
    task_choice(ui, model, state);
    let plan = &mut state.plan;
    planner_choice(ui, plan);
    who_races(ui, plan);
    if let AnyRobot::Rusty(_) = plan.task().robot {
        let words = format!("Its radius has {TUBE} m to spare: played, it keeps within that of its path.");
        ui.label(RichText::new(words).small());
    }
    sensor_choice(ui, plan);
    seed(ui, plan);
}

/// Shows what came of it.
pub fn outcome(ui: &mut Ui, look: &FrameColours, plan: &PlanState) {
    result(ui, look, plan);
    leave_points(ui, plan);
}

/// Shows what can be done with the path, and where there is none what to move.
pub fn path_buttons(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    plan: &mut PlanState,
    commands: &mut Vec<Command>,
) {
    what_to_move(ui, look, model, plan, commands);
    let has_path = matches!(plan.stage(), PlanStage::Solved);
    ui.horizontal_wrapped(|ui| {
        let play = LabButton::new("Play it").enabled(has_path).show(ui, look);
        if play.on_hover_text("A new run in which the robot drives the path").clicked() {
            commands.push(Command::Session(SessionCommand::PlayPath));
        }
        if LabButton::new("Save path").enabled(has_path).show(ui, look).clicked() {
            commands.push(Command::Session(SessionCommand::SavePath));
        }
        let open = LabButton::new("Open path").show(ui, look);
        if open.on_hover_text("A path, a tree or a roadmap of any planner, as JSON").clicked() {
            commands.push(Command::Session(SessionCommand::OpenPath));
        }
        if let Some(command) = plan.command()
            && LabButton::new("Copy as command").show(ui, look).clicked()
        {
            ui.ctx().copy_text(command);
        }
    });
    ui.checkbox(&mut plan.over_drive, "show in Drive");
}

/// Shows the coordinates of start and goal, which fold away.
pub fn ends(ui: &mut Ui, state: &mut UiState, is_open: bool) {
    for (end, name) in ["Start", "Goal"].into_iter().enumerate() {
        fold(ui, name, is_open, |ui| coordinates(ui, state, end));
    }
}

/// A robot to plan for, where it starts, its world, and where that world is, in words.
type PlanChoice = (String, AnyRobot, AnyConfiguration, Arc<World>, &'static str);

/// The robots to plan for: residents of the built-in worlds, of the atlas's and of the run's as they are now, a car
/// with its trailer and without.
fn tasks(atlas: &World, model: &Dashboard) -> Vec<PlanChoice> {
    let books = World::built_in_names().into_iter().filter_map(World::built_in);
    let mut worlds: Vec<(Arc<World>, &str)> = books.map(|world| (Arc::new(world), "")).collect();
    let in_run = model.cockpits.iter().map(|cockpit| (Arc::clone(&cockpit.standing), IN_RUN));
    for (world, place) in in_run.chain([(Arc::new(atlas.clone()), IN_ATLAS)]) {
        if worlds.iter().all(|(other, _)| *other != world) {
            worlds.push((world, place));
        }
    }
    let mut choices = Vec::new();
    for (world, place) in worlds {
        for resident in world.robots.iter().take(MAX_RESIDENTS) {
            let Some((robot, q)) = AnyRobot::of_resident(resident) else { continue };
            choices.push((resident.name.clone(), robot, q, Arc::clone(&world), place));
            if let (AnyRobot::Hitch(car), AnyConfiguration::Hitch(at)) = (robot, q) {
                let (car, trailer) = match at.trailer {
                    None => (car.with_trailer(), Some(at.body.theta)),
                    Some(_) => (car.without_trailer(), None),
                };
                let q = AnyConfiguration::Hitch(HitchCfg { body: at.body, trailer });
                choices.push((resident.name.clone(), AnyRobot::Hitch(car), q, Arc::clone(&world), place));
            }
        }
    }
    choices
}

/// A choice in words: `Hitch with its trailer, Lot`; the atlas's world and the run's may have a book's name.
fn named(name: &str, robot: &AnyRobot, world: &World, place: &str) -> String {
    let trailer =
        if matches!(robot, AnyRobot::Hitch(car) if car.hitch_len.is_some()) { " with its trailer" } else { "" };
    format!("{name}{trailer}, {}{place}", world.name)
}

fn task_choice(ui: &mut Ui, model: &Dashboard, state: &mut UiState) {
    let present = state.plan.task();
    // asked in each frame, so worlds are compared by their addresses first
    let is_in_run = || model.cockpits.iter().any(|cockpit| Arc::ptr_eq(&cockpit.standing, &present.world));
    let place = match &*present.world {
        _ if state.plan.is_in_books_world() => "",
        _ if is_in_run() => IN_RUN,
        world if world == state.atlas.world() => IN_ATLAS,
        _ => CHANGED,
    };
    let shown = named(&present.name, &present.robot, &present.world, place);
    chooser(ui, "robot", ComboBox::from_id_salt("robot").width(WIDTH).truncate().selected_text(shown.as_str()), |ui| {
        for (name, robot, q, world, place) in tasks(state.atlas.world(), model) {
            let words = named(&name, &robot, &world, place);
            if ui.selectable_label(words == shown, words).clicked() {
                state.plan.show((&name, robot), world, q, None);
            }
        }
    });
}

/// A goal to begin with: the chapter's round the post, another room, bay 2; elsewhere a place of the world's, or the
/// start itself.
pub fn goal_for(robot: &AnyRobot, world: &World, start: AnyConfiguration) -> AnyConfiguration {
    use std::f64::consts::FRAC_PI_2;
    let at = |coordinates: &[f64]| start.with_coordinates(coordinates);
    let own = match (robot, &*world.name) {
        (AnyRobot::Rusty(_), "Apartment") => at(&[9.75, 6.25, 0.0]),
        (AnyRobot::Reach(_), "Workbench") => at(&[3.1, 0.0]),
        (AnyRobot::Hitch(car), "Lot") if car.hitch_len.is_some() => at(&[6.75, 7.0, -FRAC_PI_2, -FRAC_PI_2]),
        (AnyRobot::Hitch(_), "Lot") => at(&[6.75, 7.0, -FRAC_PI_2]),
        _ => None,
    };
    let scene = Scene::of_world(world);
    let is_free = |q: &AnyConfiguration| !scene.intersects(&robot.footprint(q)) && *q != start;
    let places = world.places.iter().map(|place| start.with(0, place.pose.x).with(1, place.pose.y));
    let turned = (1..8).map(|eighth| start.with(0, f64::from(eighth) * 0.5 * FRAC_PI_2));
    let others: Vec<_> = if start.is_angle(0) { turned.collect() } else { places.collect() };
    own.into_iter().chain(others).find(is_free).unwrap_or(start)
}

fn planner_choice(ui: &mut Ui, plan: &mut PlanState) {
    let robot = plan.task().robot;
    let suits: Vec<PlannerName> = plan.planners.all().filter(|name| name.suits(&robot).is_ok()).collect();
    let present = plan.planner();
    let list = ComboBox::from_id_salt("planner").width(WIDTH).height(320.0).selected_text(present.title());
    chooser(ui, "planner", list, |ui| {
        for name in suits {
            if ui.selectable_label(name == present, name.title()).on_hover_text(name.words()).clicked() {
                plan.set_planner(name);
            }
        }
    })
    .on_hover_text(present.words());
}

/// Shows whether the sensor lies, where the planner's robot walks by one.
fn sensor_choice(ui: &mut Ui, plan: &mut PlanState) {
    let mut lies = plan.sensor_lies();
    if plan.is_by_sensor() && ui.checkbox(&mut lies, "the sensor lies").changed() {
        plan.set_sensor_lies(lies);
    }
}

fn seed(ui: &mut Ui, plan: &mut PlanState) {
    ui.horizontal(|ui| {
        let label = ui.label("seed");
        let mut seed = plan.seed().0;
        if ui.add(DragValue::new(&mut seed).range(0..=u64::from(u32::MAX))).labelled_by(label.id).changed() {
            plan.set_seed(Seed(seed));
        }
    });
}

/// Shows what the planner has done, and its path or why there is none.
fn result(ui: &mut Ui, look: &FrameColours, plan: &PlanState) {
    let effort = plan.effort();
    let monospace = |text: String| RichText::new(text).monospace();
    // the table of a race has them
    if !matches!(plan.stage(), PlanStage::Read(..)) && !plan.is_race() {
        let rows = [
            format!("{:>5} iterations {:>5} samples", effort.iterations, effort.samples),
            format!("{:>5} edges asked {:>5} free", effort.edges, effort.free),
        ];
        // numbers stay with their words, however narrow the column; nothing is counted before it begins
        let has_begun = effort != Effort::default();
        rows.into_iter().for_each(|row| {
            ui.add_visible(has_begun, Label::new(monospace(row)).extend());
        });
    }
    match plan.stage() {
        PlanStage::Growing if effort.iterations == 0 => {}
        PlanStage::Growing => _ = ui.label("It grows."),
        PlanStage::Solved => {
            if let Some(PathLengths { length, clearance }) = plan.lengths().filter(|_| !plan.is_race()) {
                let (legs, unit) = (plan.drawn().legs(), unit(&plan.task().robot));
                headline(ui, &format!("path: {legs}, {length:.3} {unit}"), look.colour(Role::Text));
                ui.label(monospace(format!("clearance {} m, proven", proven(clearance))));
                if let Some(bound) = plan.length_bound() {
                    ui.label(monospace(bounded(bound, unit)));
                    if let Some(near) = within_best(length, bound) {
                        ui.label(monospace(near));
                    }
                }
            }
            if plan.racer().improves() {
                ui.label("Play on, and it improves its path.");
            }
        }
        PlanStage::Ended(undecided @ (NoPath::Undecided { .. } | NoPath::JoinedByCells { .. })) => {
            refusal(ui, &undecided.to_string().replacen("undecided", "Undecided", 1), look);
        }
        PlanStage::Ended(reason) => {
            refusal(ui, &format!("No path: {reason}"), look);
            if plan.drawn().barrier.is_some() {
                ui.label(RichText::new("Marked: the cells that part the two, and what is in the way.").small());
            }
        }
        PlanStage::Read(name, judged) => {
            let drawn = plan.drawn();
            ui.label(format!("{name}: {}, {} edges", drawn.legs(), drawn.edges.len()));
            let words = format!("{}.", judged_words(judged.as_ref()));
            match judged.as_ref().map(|judged| judged.proof.is_ok()) {
                Some(true) => headline(ui, &words, look.colour(Role::Text)),
                Some(false) => refusal(ui, &words, look),
                None => _ = ui.label(RichText::new(words).color(look.colour(Role::Muted))),
            }
        }
    }
}

/// Shows in words where the robot has left boundaries, a line for each round.
fn leave_points(ui: &mut Ui, plan: &PlanState) {
    let Some(sensed) = &plan.drawn().sensed else { return };
    for (i, point) in sensed.leave_points.iter().enumerate() {
        let words = RichText::new(format!("Round {}: {point}.", i + 1));
        ui.label(if point.is_too_far() { words.strong() } else { words });
    }
    if !sensed.leave_points.is_empty() {
        let words =
            "Dot: where it left. Ring: where the boundary truly comes nearest to the goal. Rays: what it reads.";
        ui.label(RichText::new(words).small());
    }
}

/// Shows the coordinates of an end as sliders.
fn coordinates(ui: &mut Ui, state: &mut UiState, end: usize) {
    let q = state.plan.end_at(end);
    let bounds = state.plan.task().world.bounds;
    ui.spacing_mut().slider_width = 130.0;
    for (i, (name, mut value)) in q.coordinate_names().into_iter().zip(q.coordinates()).enumerate() {
        let pi = std::f64::consts::PI;
        let [least, most] = match i {
            _ if q.is_angle(i) => [-pi, pi],
            0 => [bounds.min.x, bounds.max.x],
            _ => [bounds.min.y, bounds.max.y],
        };
        let typed = NumberInput::new(ui, least..=most, TypedKind::of(q.is_angle(i)));
        let response = ui.add(exact(Slider::new(&mut value, least..=most), 3, &typed).text(in_signs(&name)));
        let spoken = format!("{name} of the {}", ["start", "goal"][end.min(1)]);
        response.widget_info(|| WidgetInfo::slider(true, value, &spoken));
        if response.changed() {
            state.plan.end = end;
            state.plan.move_end(end, q.with(i, value));
        }
        state.refuse(typed.refused(&response));
    }
}
