//! Robots on wheels, dragged by their bodies.

use bevy_egui::egui::{CursorIcon, Id, Pos2, Rect, Sense, Ui, Vec2, WidgetInfo, WidgetType, pos2};

use crate::anatomy::touching_items;
use crate::collision::footprint_distance;
use crate::geometry::{Footprint, Point2, Vector2};
use crate::num::lesser;
use crate::picture::{Fit, Item, Picture, Role, footprint};
use crate::simulation::TransportCommand;
use crate::ui::cspace::put_at::{footprint_to_come, is_placeable, put_at, to_come};
use crate::ui::paint::canvas;
use crate::ui::{Cockpit, CockpitRobot, Command, Look, UiState};

/// Side of the area that takes the pointer, points: at least this, and the shorter side of the body.
const HIT: f32 = 28.0;

/// The robot of a cockpit that is nearest to a point, at most `reach` metres away.
pub fn robot_at(cockpit: &Cockpit, at: Point2, reach: f64) -> Option<&CockpitRobot> {
    let point = Footprint::disc(at, 1e-9);
    let far = |robot: &CockpitRobot| footprint_distance(&point, &robot.footprint);
    let near = cockpit.robots.iter().map(|robot| (far(robot), robot)).filter(|(far, _)| *far <= reach);
    near.min_by(|(one, _), (other, _)| one.total_cmp(other)).map(|(_, robot)| robot)
}

/// Lets the robots on wheels of a cockpit be dragged; one that would overlap something stays, and the obstacle in its
/// way is marked as a contact is. A place to come with the next tick is shown. Returns the robot that the pointer is
/// pressed on, and whether it was clicked.
pub fn bodies<'a>(
    ui: &mut Ui,
    cockpit: &'a Cockpit,
    paper: Rect,
    fit: &Fit,
    look: &Look,
    state: &UiState,
    commands: &mut Vec<Command>,
) -> Option<(&'a CockpitRobot, bool)> {
    let mut pressed = None;
    // two fingers magnify
    let is_pinched = ui.input(|i| i.multi_touch().is_some());
    let world_at = |at: Pos2| fit.world_from_screen([at.x, at.y].map(f64::from));
    for robot in cockpit.robots.iter().filter(|robot| is_placeable(robot)) {
        let there = footprint_to_come(robot);
        let mut over: Vec<Item> = Vec::new();
        if robot.target.is_some() {
            over.extend(footprint("target", "where it is put", &there, Role::Robot, 0.3));
        }
        if let Some(hit) = hit(&there, paper, fit) {
            // the arrow keys drive: no key goes to the body
            let id = Id::new((&robot.name, "body"));
            let response = ui.interact(hit, id, Sense::CLICK | Sense::DRAG);
            let words = format!("{}: its body, to be dragged", robot.name);
            response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &words));
            if response.clicked() || response.is_pointer_button_down_on() {
                pressed = Some((robot, response.clicked()));
            }
            let pointer = response.interact_pointer_pos().filter(|_| !is_pinched);
            if let ([x, y, ..], Some(at)) = (&to_come(robot)[..], pointer.map(world_at)) {
                if response.drag_started() {
                    commands.push(Command::from(TransportCommand::Checkpoint));
                    // a drag is known as one only after some points
                    let pressed = ui.input(|i| i.pointer.press_origin()).map_or(at, world_at);
                    ui.data_mut(|data| data.insert_temp(id, Point2::new(*x, *y) - pressed));
                }
                if response.dragged() {
                    let off: Vector2 = ui.data(|data| data.get_temp(id)).unwrap_or_default();
                    if let Some(refused) = put_at(cockpit, robot, at + off, &state.linked, commands) {
                        over.extend(footprint("refused", "where it can't be", &refused, Role::Goal, 0.2));
                        over.extend(touching_items(&state.linked.scene_of(&cockpit.atlas), &refused));
                    }
                }
            }
            let cursor = if response.dragged() { CursorIcon::Grabbing } else { CursorIcon::Grab };
            let words = format!("Click to drive {}, drag to move it", robot.name);
            response.on_hover_cursor(cursor).on_hover_text(words);
        }
        if !over.is_empty() {
            let over = Picture::new("bodies", cockpit.world.bounds).with(over);
            canvas::paint(&ui.painter_at(paper), &over, fit, look);
        }
    }
    pressed
}

/// The area that takes the pointer on the first part of a robot; `None` if it is off the paper.
fn hit(footprint: &Footprint, paper: Rect, fit: &Fit) -> Option<Rect> {
    let body = footprint.parts().first()?.placed().bounds();
    let [x, y] = fit.screen_from_world(body.centre());
    let side = lesser(body.max.x - body.min.x, body.max.y - body.min.y) * fit.px_per_metre();
    let square = Rect::from_center_size(pos2(x as f32, y as f32), Vec2::splat((side as f32).max(HIT)));
    Some(square.intersect(paper)).filter(Rect::is_positive)
}
