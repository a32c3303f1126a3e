//! A pane of the dashboard: a world with its robots on paper, and what is done there with the pointer.

use std::sync::Arc;

use bevy_egui::egui::{
    CursorIcon, Id, Label, Rect, Response, RichText, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
    WidgetType, pos2, vec2,
};

use super::doors;
use super::hand::bodies::{self, robot_at};
use super::hand::{drive, handles};
use super::in_hand::{Free, chosen, in_hand, joints_to_drag, take_in_hand};
use super::twins::twin_items;
use super::words::words_in;
use crate::window::ui::cspace::put_at::is_placeable;
use crate::window::ui::paint::camera::Camera;
use crate::window::ui::paint::magnifier::{BUTTONS, magnified, magnifier};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::paint::touch::touched;
use crate::window::ui::paint::{canvas, frame};
use crate::window::ui::{Cockpit, Command, FrameColours, UiState};
use motion_lab_core::geometry::Vector2;
use motion_lab_core::picture::{Drawing, Fit, Item, Picture, Role, ScanDrawing, fan_scan, pick, places, scan_id};
use motion_lab_sim::anatomy::{nearest_items, touching_items};
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
pub fn pane(
    ui: &mut Ui,
    cockpit: &Cockpit,
    rect: Rect,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
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
    look: &FrameColours,
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
    canvas::paint_cached(&painter, &cockpit.world, paper, &fit, look);
    if let Some(plan) = state.plan.over_world(&cockpit.world.name) {
        canvas::paint_cached(&painter, plan, paper, &fit, look);
    }
    // under the letters of the doors
    let mut over = Picture::new(&cockpit.world.name, cockpit.world.bounds).with(doors::pending_doors(cockpit));
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
    let armed = driven.filter(|r| state.hand.armed.as_ref() == Some(&r.name) || handles::have_focus(ui, r));
    let role = if armed.is_some() || response.has_focus() { Role::Focus } else { Role::Hairline };
    let width = if armed.is_some() { 2.0 } else { 1.0 };
    painter.rect_stroke(paper, 0.0, Stroke::new(width, look.colour(role)), StrokeKind::Inside);
    // under the pad
    let body = bodies::bodies(ui, cockpit, paper, &fit, look, state, commands);
    if let Some((robot, _)) = body {
        state.hand.last_held = Some(robot.name.clone());
    }
    if let Some(robot) = armed {
        let taken = if camera.zoom > 1.0 { BUTTONS } else { 0.0 };
        in_hand(ui, robot, paper, Free { taken, of: Some((cockpit, &fit)) }, look, state);
    }
    pending_input(ui, cockpit, paper, look);
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
            bodies::hover_words(robot)
        } else {
            format!("Click to drive {}", robot.name)
        };
        response.on_hover_text_at_pointer(words);
    }
    fit
}

/// Says on the paper that an input comes with the next tick: there it moves nothing when it comes.
pub fn pending_input(ui: &mut Ui, cockpit: &Cockpit, paper: Rect, look: &FrameColours) {
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
    // a view that went along would take the pointer's place along too, and a tow would never end
    // and a paper without room has no middle
    if camera.zoom <= 1.0 || !paper.is_positive() || state.hand.held == (0, 0) || state.hand.tow.is_some() {
        return None;
    }
    let robot = cockpit.robots.iter().find(|robot| state.hand.armed.as_ref() == Some(&robot.name))?;
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
    if state.settings.nearest {
        let scene = state.linked.scene_of(&cockpit.atlas);
        items.extend(cockpit.robots.iter().flat_map(|robot| nearest_items(&scene, &robot.footprint)));
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
        doors::toggle(&cockpit.world.name, [door], commands);
    }
    response.clone().on_hover_cursor(CursorIcon::PointingHand).on_hover_text_at_pointer(doors::words(door));
    true
}

/// The dots of the places and the name labels of everything, kept until the world or the scale changes.
fn names(ui: &Ui, cockpit: &Cockpit, fit: &Fit) -> Vec<Item> {
    let scale = fit.px_per_metre();
    let id = Id::new(("names", &cockpit.world.name));
    let kept: Option<CachedNames> = ui.data(|d| d.get_temp(id));
    let is_same = |k: &CachedNames| Arc::ptr_eq(&k.atlas, &cockpit.atlas) && k.scale.to_bits() == scale.to_bits();
    let kept = kept.filter(is_same).unwrap_or_else(|| {
        let dots = places(&cockpit.atlas.world().places).into_iter();
        let dots = dots.filter(|i| !matches!(i.drawing, Drawing::Label { .. }));
        let items = dots.chain(atlas::names(&cockpit.atlas, scale)).collect();
        let made = CachedNames { atlas: Arc::clone(&cockpit.atlas), scale, items };
        ui.data_mut(|d| d.insert_temp(id, made.clone()));
        made
    });
    kept.items
}

/// The names of a world at a scale, kept from frame to frame.
#[derive(Clone)]
struct CachedNames {
    atlas: Arc<Atlas>,
    scale: f64,
    items: Vec<Item>,
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
