//! Handles: dots on an arm that are dragged, nudged by the arrow keys, or set by numbers.

use std::ops::RangeInclusive;

use bevy_egui::egui::{
    CursorIcon, DragValue, Id, Painter, Rect, RichText, Sense, Slider, Stroke, Ui, Vec2, WidgetInfo, WidgetType, pos2,
};

use super::arm::{dragged, handle_name, joints, turned};
use crate::window::ui::cspace::put_at::to_come;
use crate::window::ui::number::{NumberInput, TypedKind};
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::touch::pinched;
use crate::window::ui::{CockpitRobot, Command, FrameColours, Grasp, UiState, keys};
use motion_lab_core::configuration::Tn;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::wrap;
use motion_lab_core::picture::{Dash, Drawing, Fit, Item, Line, Picture, Role, footprint, in_signs};
use motion_lab_core::robots::{AnyRobot, Reach};
use motion_lab_sim::run::{Quantized, RobotInput};
use motion_lab_sim::simulation::{RobotCommand, TransportCommand};

/// Diameter of a handle, points.
const DOT: f32 = 10.0;
/// Diameter of the area that takes a mouse, points. For a fingertip it is as large as any other control.
const HANDLE_TARGET: f32 = 28.0;
/// Radius of the ring about the pointer's wish, metres.
const WISH_RADIUS: f64 = 0.05;
/// How far an arrow key turns a joint, radians.
const NUDGE: f64 = 0.02;

/// The sign of a joint's angle, counted from 0, as the pictures have it.
fn joint_sign(joint: usize) -> String {
    in_signs(&format!("th{}", joint + 1))
}

/// Asks for these joint angles by the end of the next tick.
fn move_to(robot: &CockpitRobot, to: &[f64], commands: &mut Vec<Command>) {
    let target: Option<Vec<Quantized>> = to.iter().map(|angle| Quantized::try_new(*angle)).collect();
    if let Some(target) = target.filter(|_| *to != to_come(robot)[..]) {
        commands.push(Command::from(RobotCommand { robot: robot.name.clone(), input: RobotInput::MoveTo(target) }));
    }
}

fn checkpoint(commands: &mut Vec<Command>) {
    commands.push(Command::from(TransportCommand::Checkpoint));
}

/// Shows the handles of an arm over its paper; while the arm is on its way to a target, also the arm there.
pub fn handles(
    ui: &mut Ui,
    robot: &CockpitRobot,
    paper: Rect,
    fit: &Fit,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let going = turned(&robot.footprint, to_come(robot));
    let shown = if robot.target.is_some() { &going } else { &robot.footprint };
    let points = joints(shown);
    let painter = ui.painter_at(paper);
    if robot.target.is_some() {
        let ghost = footprint("target", "where the arm is going", &going, Role::Robot, 0.3);
        canvas::paint(&painter, &over(ghost), fit, look);
    }
    let on = HandlePaper { painter, fit };
    for link in 0..points.len().saturating_sub(1) {
        let id = handle_id(robot, link);
        match &state.focus.grasp {
            Some(Grasp::Take(arm)) if *arm == robot.name && link == 0 => ui.memory_mut(|m| m.request_focus(id)),
            Some(Grasp::Leave) => ui.memory_mut(|m| m.surrender_focus(id)),
            _ => {}
        }
        if handle(ui, robot, link, &points, &on, look, commands) {
            state.focus.nudged = Some(robot.name.clone());
            state.hand.last_held = Some(robot.name.clone());
        }
    }
}

fn handle_id(robot: &CockpitRobot, link: usize) -> Id {
    Id::new((&robot.name, "handle", link))
}

/// Whether a handle of this arm has the focus.
pub fn have_focus(ui: &Ui, robot: &CockpitRobot) -> bool {
    robot.is_arm && (0..robot.coordinates.len()).any(|link| ui.memory(|m| m.has_focus(handle_id(robot, link))))
}

fn over(items: Vec<Item>) -> Picture {
    let anywhere = motion_lab_core::geometry::Aabb { min: Point2::origin(), max: Point2::new(1.0, 1.0) };
    Picture::new("handles", anywhere).with(items)
}

/// The paper that the handles lie on.
struct HandlePaper<'a> {
    painter: Painter,
    fit: &'a Fit,
}

/// Shows one handle, with its circle while it is held or pointed at. Returns whether it has the focus.
fn handle(
    ui: &mut Ui,
    robot: &CockpitRobot,
    link: usize,
    points: &[Point2],
    on: &HandlePaper,
    look: &FrameColours,
    commands: &mut Vec<Command>,
) -> bool {
    let (HandlePaper { painter, fit }, links) = (on, points.len() - 1);
    let name = handle_name(link, links);
    let [x, y] = fit.screen_from_world(points[link + 1]);
    let at = pos2(x as f32, y as f32);
    let size = if ui.spacing().interact_size.y > HANDLE_TARGET { ui.spacing().interact_size.y } else { HANDLE_TARGET };
    let id = handle_id(robot, link);
    // magnified, a joint may lie off the paper: keys still turn it
    let clip = painter.clip_rect();
    let hit = Rect::from_center_size(at, Vec2::splat(size)).intersect(clip);
    let hit = if hit.is_positive() { hit } else { Rect::from_min_size(at.max(clip.min).min(clip.max), Vec2::ZERO) };
    let response = ui.interact(hit, id, Sense::click_and_drag());
    let angle = to_come(robot).get(link).copied().unwrap_or_default();
    let label = format!("{}: {name}, {} in radians", robot.name, joint_sign(link));
    // as many digits as are shown: a screen reader says them all
    response.widget_info(|| WidgetInfo::slider(true, (angle * 1e4).round() / 1e4, &label));
    if response.drag_started() || response.clicked() {
        response.request_focus();
    }
    if response.drag_started() {
        checkpoint(commands);
    }
    if response.dragged()
        && !pinched(ui)
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let wish = fit.world_from_screen([f64::from(pointer.x), f64::from(pointer.y)]);
        let to = dragged(to_come(robot), points, link, wish);
        move_to(robot, &to, commands);
        let there = joints(&turned(&robot.footprint, &to));
        if let Some(&end) = there.get(link + 1) {
            canvas::paint(painter, &over(wished(end, wish)), fit, look);
        }
    }
    let focused = response.has_focus();
    if focused {
        nudge(ui, id, robot, link, commands);
    }
    let held = response.dragged() || response.has_focus();
    if held || response.hovered() {
        // where this handle can go: its joint alone turns
        let mut circles = vec![circle("its circle", points[link], (points[link + 1] - points[link]).norm())];
        if link + 1 < links {
            let last = points[links];
            circles.push(circle("the circle of the tip", points[link], (last - points[link]).norm()));
        }
        canvas::paint(painter, &over(circles), fit, look);
    }
    let grown = if held || response.hovered() { 1.35 } else { 1.0 };
    let role = if held { Role::Focus } else { Role::Robot };
    painter.circle(at, 0.5 * DOT * grown, look.colour(Role::Paper), Stroke::new(2.0, look.colour(role)));
    response.on_hover_cursor(if held { CursorIcon::Grabbing } else { CursorIcon::Grab });
    focused
}

/// The pointer's wish as a ghost: where it wants the handle, and how far that is from where the handle can go.
fn wished(end: Point2, wish: Point2) -> Vec<Item> {
    let line = Item::new("handle/wish", "the pointer's wish", Role::Path, Drawing::Polyline(vec![end, wish]))
        .stroked(Line::solid(1.0).dashed(Dash::Dashed));
    vec![line, circle("where the pointer is", wish, WISH_RADIUS)]
}

fn circle(name: &str, centre: Point2, radius: f64) -> Item {
    Item::new(format!("handle/{name}"), name, Role::Path, Drawing::Disc { centre, radius })
        .stroked(Line::solid(1.0).dashed(Dash::Dashed))
}

/// Lets the arrow keys turn a focused handle's joint: left and up counter-clockwise; with Shift a tenth as far.
fn nudge(ui: &Ui, id: Id, robot: &CockpitRobot, link: usize, commands: &mut Vec<Command>) {
    keys::keep_arrows(ui, id);
    let (turns, lets_go) = ui.input(|i| (keys::turns(i), keys::leaves_handle(i)));
    if lets_go {
        ui.memory_mut(|m| m.surrender_focus(id));
    } else if turns != 0.0 {
        checkpoint(commands);
        let mut to = to_come(robot).clone();
        if let Some(angle) = to.get_mut(link) {
            *angle = wrap(*angle + turns * NUDGE);
        }
        move_to(robot, &to, commands);
    }
}

/// Shows the joint angles as numbers to type or drag; for an arm of three links also the slider that keeps its tip in
/// place.
pub fn numbers(
    ui: &mut Ui,
    robot: &CockpitRobot,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let mut to = to_come(robot).clone();
    let mut changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().button_padding = [4.0, 1.0].into();
        for (i, angle) in to.iter_mut().enumerate() {
            let label = ui.label(RichText::new(joint_sign(i)).color(look.colour(Role::Text)));
            let typed = NumberInput::new(ui, -3.2..=3.2, TypedKind::Heading);
            let field = DragValue::new(angle).speed(0.01).fixed_decimals(3).range(-3.2..=3.2);
            let field = field.custom_parser(|text| typed.read(text)).update_while_editing(false);
            let response = ui.add(field).labelled_by(label.id);
            response.widget_info(|| WidgetInfo {
                label: Some(format!("{}: {}", robot.name, joint_sign(i))),
                ..WidgetInfo::new(WidgetType::DragValue)
            });
            if response.drag_started() || response.gained_focus() {
                checkpoint(commands);
            }
            changed |= response.changed();
            state.refuse(typed.refused(&response));
        }
        ui.weak("rad");
    });
    if changed {
        to.iter_mut().for_each(|angle| *angle = wrap(*angle));
        move_to(robot, &to, commands);
    }
    if let [th1, th2, th3] = to[..] {
        null_space(ui, robot, Tn([th1, th2, th3]), commands);
    }
}

/// The range of the first joint's angle about `th1` for which the other two joints can keep the tip at `tip`, to a
/// hundredth of a radian.
fn reachable(arm: &Reach<3>, tip: Point2, th1: f64, side: usize) -> RangeInclusive<f64> {
    let end = |step: f64| {
        let way = (1..=314).map(|i| th1 + step * f64::from(i)).take_while(|th1| th1.abs() < std::f64::consts::PI);
        way.take_while(|th1| arm.with_tip_at(tip, *th1)[side].is_some()).last().unwrap_or(th1)
    };
    end(-0.01)..=end(0.01)
}

/// Shows a slider for the first joint that keeps the tip in place.
///
/// The other two joints follow by two-link inverse kinematics, on the elbow side where they are. The slider ends where
/// the tip would come out of reach.
fn null_space(ui: &mut Ui, robot: &CockpitRobot, q: Tn<3>, commands: &mut Vec<Command>) {
    let Some(AnyRobot::Reach3(arm)) = robot.model else { return };
    let id = Id::new((&robot.name, "null space"));
    // the tip is that of the walk's beginning, so that it does not drift with the rounding of the targets
    let walk: Option<(Point2, bool)> = ui.data(|d| d.get_temp(id));
    let (tip, up) = walk.filter(|(tip, _)| (arm.tip(&q) - tip).norm() < 1e-5).unwrap_or((arm.tip(&q), q.0[2] < 0.0));
    ui.horizontal(|ui| {
        let label = ui.label("tip kept:");
        let mut th1 = q.0[0];
        ui.spacing_mut().slider_width = (ui.available_width() - 10.0).clamp(60.0, 240.0);
        let range = reachable(&arm, tip, th1, usize::from(up));
        let slider = Slider::new(&mut th1, range).show_value(false);
        let response = ui.add(slider).labelled_by(label.id);
        if response.drag_started() || response.gained_focus() {
            checkpoint(commands);
        }
        if response.changed()
            && let Some(to) = arm.with_tip_at(tip, th1)[usize::from(up)]
        {
            ui.data_mut(|d| d.insert_temp(id, (tip, up)));
            move_to(robot, &to.0, commands);
        }
        response.on_hover_text("One tip, many configurations: the first joint walks, the tip stays.");
    });
}
