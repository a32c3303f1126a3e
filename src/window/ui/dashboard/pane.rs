//! A pane of the dashboard: a world with its robots on paper, and what is done there with the pointer.

use std::sync::Arc;

use bevy_egui::egui::{
    CursorIcon, Id, Label, Pos2, Rect, Response, RichText, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
    WidgetType, pos2, vec2,
};

use super::doors;
use super::hand::bodies::{self, robot_at};
use super::hand::{drive, handles, pad};
use super::twins::twin_items;
use super::words::words_in;
use crate::window::ui::cspace::put_at::is_placeable;
use crate::window::ui::paint::camera::Camera;
use crate::window::ui::paint::magnifier::{BUTTONS, magnified, magnifier};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::paint::touch::touched;
use crate::window::ui::paint::{canvas, frame};
use crate::window::ui::{Cockpit, CockpitRobot, Command, Grasp, Look, Notice, UiState};
use motion_lab_core::collision::{Collision, Scene, footprint_distance};
use motion_lab_core::geometry::{Footprint, Part, Pose2, Shape, Vector2};
use motion_lab_core::picture::{Drawing, Fit, Item, Picture, Role, ScanDrawing, fan_scan, pick, places, scan_id};
use motion_lab_sim::anatomy::touching_items;
use motion_lab_sim::atlas::{self, Atlas};
use motion_lab_sim::simulation::SensorView;

/// Rows of text kept free under a pane for each robot, so that panes do not jump when a trailer is put on.
const ROWS: f32 = 8.0;

/// Height kept free for words under a pane on a narrow screen, where they scroll, points: the picture comes first.
pub const NARROW_TEXT: f32 = 64.0;

/// Distance within which the pointer points at a drawn thing, points.
const REACH: f64 = 4.0;

/// Share of a magnified paper's sides that a driven robot keeps off.
const MARGIN: f32 = 0.25;

/// Height of the text under the paper of a pane of `robots` robots, points. More than three count as three.
pub fn text_height(ui: &Ui, robots: usize) -> f32 {
    let row = ui.text_style_height(&TextStyle::Monospace) + 4.0;
    16.0 + row * ROWS * robots.clamp(1, 3) as f32
}

/// Shows one cockpit: its paper, and name, space, readout and counts under it.
pub fn pane(ui: &mut Ui, cockpit: &Cockpit, rect: Rect, look: &Look, state: &mut UiState, commands: &mut Vec<Command>) {
    let text = if look.narrow { NARROW_TEXT } else { text_height(ui, cockpit.robots.len()) };
    let height = (rect.height() - text).max(60.0);
    let sheet = canvas::proportioned(&cockpit.world, Rect::from_min_size(rect.min, vec2(rect.width(), height)));
    let fit = paper(ui, cockpit, sheet, Vec::new(), look, state, commands);
    let below = Rect::from_min_max(pos2(rect.left(), sheet.bottom() + 6.0), rect.max);
    words_in(ui, below, cockpit, &fit, look, state, commands);
}

/// Shows a cockpit's world with its robots over the items `under` them, and what is done there with the pointer.
/// Returns how it lies in `paper`.
pub fn paper(
    ui: &mut Ui,
    cockpit: &Cockpit,
    paper: Rect,
    under: Vec<Item>,
    look: &Look,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) -> Fit {
    let (whole, bounds) = (canvas::fit(&cockpit.world, paper), &cockpit.world.bounds);
    state.linked.see(&cockpit.atlas);
    let mut camera = state.cameras.get(&cockpit.world.name).copied().unwrap_or_default();
    // a paper that shows the whole world lets a finger scroll what it lies in
    let sense = if camera.zoom > 1.0 { Sense::click_and_drag() } else { Sense::click() };
    ui.allocate_rect(paper, Sense::hover());
    // the focus stays with the world where panes change places
    let response = ui.interact(paper, Id::new(("pane", &cockpit.world.name)), sense);
    let (fit, _) = magnified(ui, &response, &mut camera, &whole, bounds, state.takes_wheel());
    let fit = followed(cockpit, state, &mut camera, paper, &whole, ui.pixels_per_point()).unwrap_or(fit);
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, cockpit.described()));
    // a wall on the border of a world that is shown whole is a point wider than the paper
    let painter = ui.painter_at(if camera.zoom > 1.0 { paper } else { paper.expand(1.0) });
    canvas::paint_kept(&painter, &cockpit.world, paper, &fit, look);
    if let Some(plan) = state.plan.over_world(&cockpit.world.name) {
        canvas::paint_kept(&painter, plan, paper, &fit, look);
    }
    // under the letters of the doors
    let mut over = Picture::new(&cockpit.world.name, cockpit.world.bounds).with(doors::coming(cockpit));
    over = if state.settings.labels {
        over.with(names(ui, cockpit, &fit))
    } else {
        // a letter gives way to a robot in its door
        let is_free = |item: &Item| match item.drawing {
            Drawing::Label { at, .. } => robot_at(cockpit, at, 0.2).is_none(),
            _ => true,
        };
        over.with(doors::letters(cockpit).into_iter().filter(is_free).collect::<Vec<_>>())
    };
    let over = over.with(under).with(twin_items(cockpit, state)).with(robots(ui, cockpit, state));
    let over = over.with(touched_by(cockpit, state));
    canvas::paint(&painter, &over, &fit, look);
    let driven = chosen(cockpit, state);
    let armed = driven.filter(|r| state.armed.as_ref() == Some(&r.name) || handles::have_focus(ui, r));
    let role = if armed.is_some() || response.has_focus() { Role::Focus } else { Role::Hairline };
    let width = if armed.is_some() { 2.0 } else { 1.0 };
    painter.rect_stroke(paper, 0.0, Stroke::new(width, look.colour(role)), StrokeKind::Inside);
    // under the pad
    let body = bodies::bodies(ui, cockpit, paper, &fit, look, state, commands);
    if let Some((robot, _)) = body {
        state.last_held = Some(robot.name.clone());
    }
    if let Some(robot) = armed {
        let taken = if camera.zoom > 1.0 { BUTTONS } else { 0.0 };
        in_hand(ui, robot, paper, Free { taken, of: Some((cockpit, &fit)) }, look, state);
    }
    coming(ui, cockpit, paper, look);
    for robot in cockpit.robots.iter().filter(|r| r.is_arm) {
        handles::handles(ui, robot, paper, &fit, look, state, commands);
    }
    // a door is in front of the paper
    let at_door = door_clicked(&response, cockpit, &fit, touched(ui), commands);
    let reach = doors::reach(touched(ui));
    // pressed by a key, the paper has no pointer on it
    let pointer = if response.clicked() { response.interact_pointer_pos() } else { response.hover_pos() };
    let at = pointer.map(|at| fit.world_from_screen([at.x, at.y].map(f64::from)));
    let under = at.and_then(|at| robot_at(cockpit, at, reach / fit.px_per_metre()));
    let wanted = body.map(|(robot, _)| robot).or(under).or(driven);
    // with a mouse, Esc lets go; a finger has no Esc, so a second tap does
    let is_other = wanted.map(|robot| &robot.name) != armed.map(|robot| &robot.name);
    let is_clicked = body.is_some_and(|(_, is_clicked)| is_clicked) || response.clicked() && !at_door;
    if is_clicked && (is_other || touched(ui)) {
        take_in_hand(cockpit, wanted, state, commands);
        ui.ctx().request_repaint();
        // the arrow keys drive the robot from now on, also when Tab led here
        response.surrender_focus();
    }
    if response.double_clicked() && camera.zoom > 1.0 && !at_door {
        camera = Camera::default();
        // the first of the two clicks has taken it in hand
        drive::let_go(state, commands);
    }
    magnifier(ui, paper, camera.zoom > 1.0, &mut camera, &whole, bounds, look);
    state.cameras.insert(cockpit.world.name.clone(), camera);
    // one thing is said at the pointer at a time
    let is_named = !at_door && point_out(&response, &over, cockpit, &fit);
    let is_quiet = at_door || is_named || response.dragged() || body.is_some();
    if let Some(robot) = wanted.filter(|_| !is_quiet && (armed.is_none() || under.is_some() && is_other)) {
        let words = if robot.is_arm {
            format!("{} is moved by its joints: {}", robot.name, joints_to_drag(robot))
        } else if is_placeable(robot) {
            format!("Click to drive {}; drag its body to move it", robot.name)
        } else {
            format!("Click to drive {}", robot.name)
        };
        response.on_hover_text_at_pointer(words);
    }
    fit
}

/// Says on the paper that an input comes with the next tick: there it moves nothing when it comes.
pub fn coming(ui: &mut Ui, cockpit: &Cockpit, paper: Rect, look: &Look) {
    if cockpit.waiting {
        let row = ui.text_style_height(&TextStyle::Small);
        let at = Rect::from_min_size(paper.left_bottom() + vec2(12.0, -row - 10.0), vec2(160.0, row));
        let words = RichText::new("comes with the next tick").small();
        ui.put(at, Label::new(words.background_color(look.theme.colour(Role::Paper))));
    }
}

/// Moves a magnified view along so that the robot that is being driven stays in its middle part. Returns how the world
/// lies then; `None` where nothing is driven or it is there.
fn followed(
    cockpit: &Cockpit,
    state: &UiState,
    camera: &mut Camera,
    paper: Rect,
    whole: &Fit,
    scale: f32,
) -> Option<Fit> {
    if camera.zoom <= 1.0 || state.held == (0, 0) {
        return None;
    }
    let robot = cockpit.robots.iter().find(|robot| state.armed.as_ref() == Some(&robot.name))?;
    let (bounds, scale) = (&cockpit.world.bounds, f64::from(scale));
    let [x, y] = camera.fit(whole, bounds, scale).screen_from_world(robot.footprint.bounds()?.centre());
    let middle = paper.shrink2(MARGIN * paper.size());
    let at = pos2(x as f32, y as f32);
    let off = at - at.clamp(middle.min, middle.max);
    if off == Vec2::ZERO {
        return None;
    }
    let metres = f64::from(off.x) / (camera.zoom * whole.px_per_metre());
    let up = f64::from(-off.y) / (camera.zoom * whole.px_per_metre());
    camera.look_at(camera.middle(bounds) + Vector2::new(metres, up), bounds);
    Some(camera.fit(whole, bounds, scale))
}

/// What the cockpit's robots touch in this tick.
fn touched_by(cockpit: &Cockpit, state: &UiState) -> Vec<Item> {
    let mut touching = cockpit.robots.iter().filter(|robot| state.is_red(robot)).peekable();
    if cockpit.crowd.is_some() || touching.peek().is_none() {
        return Vec::new();
    }
    let scene = state.linked.scene_of(&cockpit.atlas);
    touching.flat_map(|robot| touching_items(&scene, &robot.footprint)).collect()
}

/// The cockpit's robots one by one: their scans, their goals, and over them their bodies.
pub fn robots(ui: &Ui, cockpit: &Cockpit, state: &mut UiState) -> Vec<Item> {
    let mut items = Vec::new();
    if state.settings.scan {
        items.extend(cockpit.robots.iter().flat_map(|robot| {
            robot.sees.iter().map(move |sensor| {
                let SensorView { pose, rays, ranges, .. } = sensor;
                let drawing = ScanDrawing { pose: *pose, field_of_view: rays.field_of_view, ranges };
                fan_scan(&scan_id(&robot.name, &sensor.name), "scan", &drawing)
            })
        }));
    }
    for robot in &cockpit.robots {
        if let Some((_, goal)) = state.goal.as_ref().filter(|(name, _)| *name == robot.name) {
            items.extend(goal.items(&robot.footprint));
        }
    }
    let now = ui.input(|i| i.time);
    items.extend(cockpit.robots_picture(|robot| {
        let red = state.flash(&robot.name, robot.flash, now);
        if state.flash_lags(&robot.name, robot.flash) {
            ui.ctx().request_repaint_after_secs(0.34);
        }
        red
    }));
    items
}

/// Whether the pointer is at a door. A click there opens or closes it.
pub fn door_clicked(
    response: &Response,
    cockpit: &Cockpit,
    fit: &Fit,
    touch: bool,
    commands: &mut Vec<Command>,
) -> bool {
    let Some(at) = response.interact_pointer_pos().or_else(|| response.hover_pos()) else { return false };
    let at = [f64::from(at.x), f64::from(at.y)];
    let Some(door) = doors::door_at(cockpit, fit, at, doors::reach(touch)) else { return false };
    if response.clicked() {
        doors::toggle(&cockpit.world.name, door, commands);
    }
    response.clone().on_hover_cursor(CursorIcon::PointingHand).on_hover_text_at_pointer(doors::words(door));
    true
}

/// The dots of the places and the name labels of everything, kept until the world or the scale changes.
fn names(ui: &Ui, cockpit: &Cockpit, fit: &Fit) -> Vec<Item> {
    let scale = fit.px_per_metre();
    let id = Id::new(("names", &cockpit.world.name));
    let kept: Option<KeptNames> = ui.data(|d| d.get_temp(id));
    let is_same = |k: &KeptNames| Arc::ptr_eq(&k.atlas, &cockpit.atlas) && k.scale.to_bits() == scale.to_bits();
    let kept = kept.filter(is_same).unwrap_or_else(|| {
        let dots = places(&cockpit.atlas.world().places).into_iter();
        let dots = dots.filter(|i| !matches!(i.drawing, Drawing::Label { .. }));
        let items = dots.chain(atlas::names(&cockpit.atlas, scale)).collect();
        let made = KeptNames { atlas: Arc::clone(&cockpit.atlas), scale, items };
        ui.data_mut(|d| d.insert_temp(id, made.clone()));
        made
    });
    kept.items
}

/// The names of a world at a scale, kept from frame to frame.
#[derive(Clone)]
struct KeptNames {
    atlas: Arc<Atlas>,
    scale: f64,
    items: Vec<Item>,
}

/// The robot of a pane that can be taken in hand: the first that is driven by channels, else the first arm.
pub fn in_reach(cockpit: &Cockpit) -> Option<&CockpitRobot> {
    let robots = || cockpit.robots.iter();
    robots().find(|r| r.drivable).or_else(|| robots().find(|r| r.is_arm))
}

/// The robot of a pane that is in hand, or was last; else the one that can be taken.
pub fn chosen<'a>(cockpit: &'a Cockpit, state: &UiState) -> Option<&'a CockpitRobot> {
    let named = |name: &Option<String>| cockpit.robots.iter().find(|robot| name.as_ref() == Some(&robot.name));
    [&state.armed, &state.nudged, &state.last_held].into_iter().find_map(named).or_else(|| in_reach(cockpit))
}

/// Takes a robot of a pane in hand, of an arm its first handle; lets go of it if it was in hand already. Says so where
/// there is none.
pub fn take_in_hand(cockpit: &Cockpit, robot: Option<&CockpitRobot>, state: &mut UiState, commands: &mut Vec<Command>) {
    let again = robot.is_some_and(|r| [&state.armed, &state.nudged].contains(&&Some(r.name.clone())));
    drive::let_go(state, commands);
    state.next_grasp = Some(Grasp::Leave);
    match robot {
        Some(_) if again => {}
        Some(robot) if robot.is_arm || robot.drivable => {
            state.last_held = Some(robot.name.clone());
            if robot.is_arm {
                state.next_grasp = Some(Grasp::Take(robot.name.clone()));
            } else {
                state.armed = Some(robot.name.clone());
            }
        }
        _ => {
            let text = format!("no robot of {} can be driven", cockpit.world.name);
            state.say(Notice { text, is_error: false });
        }
    }
}

/// What of an arm is dragged: `drag its elbow or tip`.
fn joints_to_drag(arm: &CockpitRobot) -> &'static str {
    if arm.coordinates.len() == 2 { "drag its elbow or tip" } else { "drag its joints or tip" }
}

/// What of a paper is free for words.
pub struct Free<'a> {
    /// Width that something else takes at the right, points.
    pub taken: f32,
    /// The cockpit and how its world lies on the paper, if words are to keep off its obstacles.
    pub of: Option<(&'a Cockpit, &'a Fit)>,
}

/// Shows on the paper of the robot in hand how to drive it, and for a finger the pad.
pub fn in_hand(ui: &mut Ui, robot: &CockpitRobot, paper: Rect, free: Free, look: &Look, state: &mut UiState) {
    let Free { taken, of } = free;
    let sideways = robot.trailer.is_some() && state.held.0 == 0 && state.held.1 != 0;
    let touched = touched(ui);
    let words = if robot.is_arm {
        let finely = if touched { "" } else { "; arrows turn the joint, with Shift finely, Esc lets go" };
        format!("{}{finely}", joints_to_drag(robot))
    } else if sideways {
        "steering alone moves nothing: no input moves a car sideways".to_owned()
    } else if touched {
        "the pad drives, a tap beside it lets go".to_owned()
    } else {
        "arrows drive, Esc lets go".to_owned()
    };
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout(words, font, look.colour(Role::Text), paper.width() - 24.0 - taken);
    let size = galley.size() + vec2(8.0, 4.0);
    // it stays as long as it is free
    let id = Id::new((&robot.name, "hint"));
    let before = ui.data(|data| data.get_temp(id));
    let rect = of.and_then(|(cockpit, fit)| {
        free_place(&state.linked.scene_of(&cockpit.atlas), &cockpit.robots, fit, (paper, before), size)
    });
    rect.map(|rect| ui.data_mut(|data| data.insert_temp(id, rect.min)));
    let rect = rect.unwrap_or(Rect::from_min_size(paper.min + vec2(4.0, 6.0), size));
    // opaque and square: rounded corners of a tint leave dots
    ui.painter().rect_filled(rect, 0.0, look.theme.colour(Role::Paper));
    ui.painter().galley(rect.min + vec2(4.0, 2.0), galley, look.colour(Role::Text));
    if touched && robot.drivable {
        let place = state.pad_place.take().unwrap_or(pad::corner(paper));
        pad::pad(ui, &robot.name, place, look, state);
    }
}

/// The place of this size that begins at `before`, else the first along the upper edge of a paper, then along its lower
/// edge, where no obstacle and no robot is, nor the name of what one touches.
fn free_place(
    scene: &Scene,
    robots: &[CockpitRobot],
    fit: &Fit,
    (paper, before): (Rect, Option<Pos2>),
    size: Vec2,
) -> Option<Rect> {
    const STEP: f32 = 12.0;
    const NAME: f64 = 40.0;
    let away = NAME / fit.px_per_metre();
    let room = paper.shrink(STEP);
    let world = |at: Pos2| fit.world_from_screen([f64::from(at.x), f64::from(at.y)]);
    let columns = ((room.width() - size.x) / STEP).max(0.0) as u16;
    let rows = [room.top(), room.bottom() - size.y];
    let places = rows.into_iter().flat_map(|y| (0..=columns).map(move |k| pos2(room.left() + STEP * f32::from(k), y)));
    let before = before.filter(|at| room.contains_rect(Rect::from_min_size(*at, size)));
    before.into_iter().chain(places).map(|at| Rect::from_min_size(at, size)).find(|place| {
        let shape = Shape::Rectangle { min: world(place.left_bottom()), max: world(place.right_top()) };
        let place = Footprint::new([Part::new(Pose2::IDENTITY, shape)]);
        let is_off = |robot: &CockpitRobot| footprint_distance(&place, &robot.footprint) > away;
        robots.iter().all(is_off) && !scene.intersects(&place)
    })
}

/// Names the obstacle that is pointed at. Returns whether there is one.
pub fn point_out(response: &Response, over: &Picture, cockpit: &Cockpit, fit: &Fit) -> bool {
    let Some(at) = response.hover_pos().filter(|_| response.hovered() && frame::rests(response)) else { return false };
    let at = [f64::from(at.x), f64::from(at.y)];
    let item = pick(over, fit, at, REACH).or_else(|| pick(&cockpit.world, fit, at, REACH));
    let item = item.filter(|i| i.role == Role::Obstacle);
    if let Some(item) = item {
        response.clone().on_hover_text_at_pointer(item.name.as_str());
    }
    item.is_some()
}
