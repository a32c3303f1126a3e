//! Robots on wheels, dragged by their bodies: towed, or with Alt put elsewhere.

use bevy_egui::egui::{CursorIcon, Id, Pos2, Rect, Response, Sense, Ui, Vec2, WidgetInfo, WidgetType, pos2};

use super::held_tow::Gripped;
use super::tow;
use crate::window::ui::cspace::put_at::{footprint_to_come, is_placeable, put_at, robots_in_the_way, to_come};
use crate::window::ui::dashboard::doors;
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::touch::{pinched, touched};
use crate::window::ui::{Cockpit, CockpitRobot, Command, FrameColours, LinkedState, Notice, UiState};
use motion_lab_core::collision::footprint_distance;
use motion_lab_core::geometry::{Footprint, Point2, Vector2};
use motion_lab_core::num::lesser;
use motion_lab_core::picture::{self, Anchor, Drawing, Face, Fill, Fit, Item, Picture, RobotDrawing, Role, footprint};
use motion_lab_sim::anatomy::touching_items;
use motion_lab_sim::simulation::TransportCommand;

/// Side of the area that takes the pointer, points: at least this, and the shorter side of the body.
const BODY_TARGET: f32 = 28.0;

/// What is said of a robot that the pointer puts elsewhere: its wheels do not turn.
const PUT: &str = "put, not driven";

/// What a robot is taken by.
const BODY: &str = "its body";

/// The robot of a cockpit that is nearest to a point, at most `reach` metres away.
pub fn robot_at(cockpit: &Cockpit, at: Point2, reach: f64) -> Option<&CockpitRobot> {
    let point = Footprint::disc(at, 1e-9);
    let far = |robot: &CockpitRobot| footprint_distance(&point, &robot.footprint);
    let near = cockpit.robots.iter().map(|robot| (far(robot), robot)).filter(|(far, _)| *far <= reach);
    near.min_by(|(one, _), (other, _)| one.total_cmp(other)).map(|(_, robot)| robot)
}

/// What is said of a robot that is pointed at.
pub fn hover_words(robot: &CockpitRobot) -> String {
    if tow::is_towable(robot) {
        format!("Click to drive {}, drag to tow it, Alt-drag to put it elsewhere", robot.name)
    } else {
        format!("Click to drive {}; drag its body to put it elsewhere", robot.name)
    }
}

/// Whether a drag that begins now puts a robot elsewhere: with Alt, or with Ctrl, because some window managers move the
/// window by Alt.
fn is_to_put(ui: &Ui, robot: &CockpitRobot) -> bool {
    !tow::is_towable(robot) || ui.input(|i| i.modifiers.alt || i.modifiers.command)
}

/// Lets the pointer drag a cockpit's robots on wheels. A drag tows the robot; with Alt it puts the robot elsewhere, by
/// the next tick, and shows where. While such a place waits, it can be dragged as well as the body. A robot that would
/// overlap or touch something there stays where it is, and what is in its way is drawn as in contact. The same is drawn
/// for a refused drag of the robot's point or heading.
/// A click on a door beside a body opens or closes the door. Returns the robot that the pointer is pressed on, and
/// whether it was clicked.
pub fn bodies<'a>(
    ui: &mut Ui,
    cockpit: &'a Cockpit,
    paper: Rect,
    fit: &Fit,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) -> Option<(&'a CockpitRobot, bool)> {
    let mut pressed = None;
    let was_pinched = pinched(ui);
    // where its point or its heading was dragged to in the last frame
    let by_point = state.linked.refused.take();
    if by_point.is_some() {
        // nothing else would take it away once the drag is over
        ui.ctx().request_repaint();
    }
    for robot in cockpit.robots.iter().filter(|robot| is_placeable(robot)) {
        let there = footprint_to_come(robot);
        let mut over: Vec<Item> = Vec::new();
        let mut refused = by_point.as_ref().filter(|(of, _)| *of == robot.name).map(|(_, there)| there.clone());
        let mut grips = vec![Grip { of: BODY, from: to_come(robot), footprint: &there }];
        if robot.target.is_some() {
            over.extend(ghost(robot, &there));
            // where both lie over one another, the place to come is in front
            grips.insert(0, Grip { of: "where it still is", from: &robot.coordinates, footprint: &robot.footprint });
        }
        let mut is_put = robot.target.is_some();
        for grip in grips {
            let Some(response) = grip.show(ui, robot, paper, fit) else { continue };
            let at = response.interact_pointer_pos().or(response.hover_pos());
            // a door that is nearer than the body is in front of it
            let door = at.and_then(|at| {
                let point = Footprint::disc(world_at(fit, at), 1e-9);
                let off = footprint_distance(&point, grip.footprint) * fit.px_per_metre();
                let reach = lesser(doors::reach(touched(ui)), off);
                doors::door_at(cockpit, fit, [at.x, at.y].map(f64::from), reach).filter(|_| off > 0.0)
            });
            if let Some(door) = door.filter(|_| response.clicked()) {
                doors::toggle(&cockpit.world.name, [door], commands);
            } else if response.clicked() || response.is_pointer_button_down_on() {
                pressed = Some((robot, response.clicked()));
            }
            if response.is_pointer_button_down_on() && ui.input(|i| i.pointer.any_pressed()) {
                grip.press(ui, robot, &response, fit);
            }
            if response.drag_started() && !was_pinched {
                grip.take(ui, robot, &response, fit, state, commands);
            }
            if !was_pinched && let Some(to) = grip.put_to(ui, &response, fit) {
                refused = put_at(cockpit, robot, to, &state.linked, commands);
                is_put = true;
                ui.data_mut(|data| data.insert_temp(response.id.with("refused"), refused.clone()));
            } else if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged() && !was_pinched) {
                over.extend(tow::pull(ui, robot, world_at(fit, at), state));
            }
            if response.drag_stopped() {
                // what it towed is let go in the next frame
                ui.ctx().request_repaint();
                ui.data_mut(|data| data.remove::<Option<Vector2>>(response.id));
                let last: Option<Option<Footprint>> = ui.data_mut(|data| data.remove_temp(response.id.with("refused")));
                if let Some(text) = last.flatten().and_then(|there| why_not(cockpit, robot, &there, &state.linked)) {
                    state.say(Notice { text, is_error: false });
                }
            }
            let at_rest = (CursorIcon::Grab, hover_words(robot));
            let (cursor, words) = door.map_or(at_rest, |door| (CursorIcon::PointingHand, doors::words(door)));
            let cursor = if response.dragged() { CursorIcon::Grabbing } else { cursor };
            response.on_hover_cursor(cursor).on_hover_text(words);
        }
        if let Some(refused) = &refused {
            over.extend(footprint("refused", "where it can't be", refused, Role::Goal, 0.2));
            over.extend(touching_items(&state.linked.scene_of(&cockpit.atlas), refused));
            over.extend(robots_in_the_way(cockpit, robot, refused).flat_map(named));
        } else if is_put {
            over.extend(label("put", PUT, &there));
        }
        if !over.is_empty() {
            let over = Picture::new("bodies", cockpit.world.bounds).with(over);
            canvas::paint(&ui.painter_at(paper), &over, fit, look);
        }
    }
    pressed
}

/// What of a robot is taken by the pointer: its body where it is to be with the next tick, or where it still is.
struct Grip<'a> {
    of: &'a str,
    from: &'a [f64],
    footprint: &'a Footprint,
}

impl Grip<'_> {
    /// The area that takes the pointer; `None` off the paper.
    fn show(&self, ui: &mut Ui, robot: &CockpitRobot, paper: Rect, fit: &Fit) -> Option<Response> {
        // the arrow keys drive: no key goes to the body
        let id = Id::new((&robot.name, self.of));
        let pointer = ui.input(|i| i.pointer.latest_pos());
        let response = ui.interact(hit(self.footprint, paper, fit, pointer)?, id, Sense::CLICK | Sense::DRAG);
        let words = format!("{}: {}, to be dragged", robot.name, self.of);
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &words));
        Some(response)
    }

    /// Notes what a press grips: a drag is known as one only after some points, and the robot may go on meanwhile.
    fn press(&self, ui: &Ui, robot: &CockpitRobot, response: &Response, fit: &Fit) {
        let Some(at) = response.interact_pointer_pos() else { return };
        let gripped = tow::gripped(robot, self.from, world_at(fit, at));
        ui.data_mut(|data| data.insert_temp(response.id.with("gripped"), gripped));
    }

    /// Begins a drag: takes the robot in hand to tow it, or notes how far its reference point is from where it was
    /// pressed.
    fn take(
        &self,
        ui: &Ui,
        robot: &CockpitRobot,
        response: &Response,
        fit: &Fit,
        state: &mut UiState,
        commands: &mut Vec<Command>,
    ) {
        let pressed = ui.input(|i| i.pointer.press_origin()).or(response.interact_pointer_pos());
        let (&[x, y, ..], Some(pressed)) = (self.from, pressed) else { return };
        let pressed = world_at(fit, pressed);
        // where it is still, it will not be with the next tick: that was put, and may be put anew
        let off = (self.of != BODY || is_to_put(ui, robot)).then(|| Point2::new(x, y) - pressed);
        ui.data_mut(|data| data.insert_temp(response.id, off));
        if off.is_some() {
            commands.push(Command::from(TransportCommand::Checkpoint));
            return;
        }
        let gripped: Option<Option<Gripped>> = ui.data(|data| data.get_temp(response.id.with("gripped")));
        if let Some(gripped) = gripped.flatten().or_else(|| tow::gripped(robot, self.from, pressed)) {
            tow::take(robot, gripped, state, commands);
        }
    }

    /// Where a drag puts the robot's reference point; `None` where it does not.
    fn put_to(&self, ui: &Ui, response: &Response, fit: &Fit) -> Option<Point2> {
        let off: Option<Option<Vector2>> = ui.data(|data| data.get_temp(response.id));
        let at = response.interact_pointer_pos().filter(|_| response.dragged())?;
        Some(world_at(fit, at) + off.flatten()?)
    }
}

fn world_at(fit: &Fit, at: Pos2) -> Point2 {
    fit.world_from_screen([at.x, at.y].map(f64::from))
}

/// Why a robot could not be dragged there: `Rusty stays where it is free: B's round table is in the way`.
fn why_not(cockpit: &Cockpit, robot: &CockpitRobot, there: &Footprint, linked: &LinkedState) -> Option<String> {
    let scene = linked.scene_of(&cockpit.atlas);
    let obstacle = scene.touched(there).first().and_then(|id| scene.obstacle_name(*id)).map(str::to_owned);
    let other = || robots_in_the_way(cockpit, robot, there).next().map(|robot| robot.name.clone());
    let what = obstacle.or_else(other)?;
    Some(format!("{} stays where it is free: {what} is in the way", robot.name))
}

/// A robot with its heading where it is put with the next tick.
fn ghost(robot: &CockpitRobot, there: &Footprint) -> Vec<Item> {
    let heading = to_come(robot).get(2).copied().filter(|_| robot.heading.is_some());
    let drawing = RobotDrawing {
        name: "where it is put",
        footprint: there,
        heading,
        model: None,
        gait: robot.gait,
        in_contact: false,
    };
    let fainter = |item: Item| if item.role == Role::Robot { item.filled(Fill::Tint(0.3)) } else { item };
    picture::robot(&drawing).into_iter().map(fainter).collect()
}

/// Marks a robot that is in the way of another, with its name.
fn named(robot: &CockpitRobot) -> Vec<Item> {
    let there = footprint_to_come(robot);
    let mut items = footprint(&format!("in the way/{}", robot.name), &robot.name, &there, Role::Goal, 0.0);
    items.extend(label(&format!("in the way/{}/name", robot.name), &robot.name, &there));
    items
}

/// These words above a footprint.
fn label(id: &str, words: &str, over: &Footprint) -> Option<Item> {
    let bounds = over.bounds()?;
    let drawing = Drawing::Label {
        at: Point2::new(bounds.centre().x, bounds.max.y),
        text: words.to_owned(),
        anchor: Anchor::Above,
        face: Face::Sans,
        size_px: 12.0,
        plate: true,
    };
    Some(Item::new(id, words, Role::Text, drawing))
}

/// The area that takes the pointer on the first part of a robot, all of it while the pointer is there; `None` if it is
/// off the paper.
fn hit(footprint: &Footprint, paper: Rect, fit: &Fit, pointer: Option<Pos2>) -> Option<Rect> {
    let part = footprint.parts().first()?;
    let body = part.placed().bounds();
    let [x, y] = fit.screen_from_world(body.centre());
    let size = [body.max.x - body.min.x, body.max.y - body.min.y].map(|side| (side * fit.px_per_metre()) as f32);
    let point = pointer.map(|at| Footprint::disc(world_at(fit, at), 1e-9));
    let is_on = point.is_some_and(|point| footprint_distance(&point, &Footprint::new([part.clone()])) == 0.0);
    let size = if is_on { Vec2::from(size) } else { Vec2::splat(size[0].min(size[1])) };
    let area = Rect::from_center_size(pos2(x as f32, y as f32), size.max(Vec2::splat(BODY_TARGET)));
    Some(area.intersect(paper)).filter(Rect::is_positive)
}
