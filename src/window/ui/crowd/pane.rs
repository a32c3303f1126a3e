//! The pane of a crowd: its world over the whole pane, a list of its robots beside it, and words for who is picked.

use std::sync::Arc;

use bevy_egui::egui::{
    Align, Id, Layout, Rect, RichText, ScrollArea, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, UiBuilder,
    WidgetInfo, WidgetType, pos2,
};

use super::heat::Heat;
use super::list::list;
use super::robots::robots;
use super::values::{CrowdRobot, CrowdView};
use crate::window::ui::dashboard::hand::{drive, handles};
use crate::window::ui::dashboard::in_hand::{Free, in_hand, in_reach, take_in_hand};
use crate::window::ui::dashboard::pane::{door_clicked, pending_input, point_out};
use crate::window::ui::dashboard::values::thousands;
use crate::window::ui::dashboard::words::{by_whom, robot_words};
use crate::window::ui::dashboard::{doors, pane};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::camera::Camera;
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::magnifier::{BUTTONS, magnified, magnifier};
use crate::window::ui::paint::scale_bar::scale_bar;
use crate::window::ui::paint::touch::touched;
use crate::window::ui::{Cockpit, Command, FrameColours, UiState};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::picture::{Anchor, Drawing, Face, Fit, Item, Picture, Role};
use motion_lab_sim::simulation::{History, TickMark};

/// Width of the list, points.
const LIST: f32 = 264.0;

/// Width from which on the list stands beside the paper, points.
const BESIDE: f32 = 640.0;

/// Height of the row under the paper, points.
const FOOT: f32 = 26.0;

/// Distance from a robot within which a click picks it, points: with a mouse, and for a finger.
const REACH: f64 = 8.0;
const TOUCH: f64 = 22.0;

/// Largest number of robots in view that carry their names.
const MAX_NAMED: usize = 80;

/// What the pane shows.
pub struct CrowdPane<'a> {
    /// The world, with the robot that is picked.
    pub cockpit: &'a Cockpit,
    /// All its robots.
    pub crowd: &'a CrowdView,
    /// The run's past.
    pub history: &'a History,
    /// The tick that is shown.
    pub tick: u64,
}

/// Shows the pane in `rect`.
pub fn crowd_pane(
    ui: &mut Ui,
    shown: &CrowdPane,
    rect: Rect,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let (paper, words) = if rect.width() >= BESIDE {
        let (left, right) = rect.split_left_right_at_x(rect.right() - LIST);
        (left.with_max_x(left.right() - 20.0), right)
    } else {
        rect.split_top_bottom_at_y(rect.top() + 0.55 * rect.height())
    };
    let (paper, foot) = paper.split_top_bottom_at_y(paper.bottom() - FOOT);
    let fit = world(ui, shown, paper, look, state, commands);
    let mut row = ui.new_child(UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center)));
    row.spacing_mut().interact_size.y = FOOT - 6.0;
    row.label(RichText::new(shown.cockpit.heading()).color(look.colour(Role::Text)));
    if !look.narrow {
        heat_link(&mut row, shown, look, state);
    }
    row.with_layout(Layout::right_to_left(Align::Center), |ui| scale_bar(ui, fit.px_per_metre(), look));
    let mut ui = ui.new_child(UiBuilder::new().max_rect(words).layout(Layout::top_down(Align::Min)));
    let is_picked = !shown.cockpit.robots.is_empty();
    if rect.width() < BESIDE {
        ScrollArea::vertical().id_salt("words").show(&mut ui, |ui| {
            picked(ui, shown, paper, look, state, commands);
            if look.narrow {
                ui.horizontal(|ui| heat_link(ui, shown, look, state));
            }
            doors::row(ui, shown.cockpit, commands);
            list(ui, shown.crowd, 0.9 * words.height(), look, state, commands);
        });
        return;
    }
    let room = if is_picked { 0.5 * words.height() } else { 0.0 };
    doors::row(&mut ui, shown.cockpit, commands);
    let height = words.bottom() - ui.cursor().top() - room;
    list(&mut ui, shown.crowd, height, look, state, commands);
    if is_picked {
        ui.add_space(8.0);
        ScrollArea::vertical().id_salt("picked").show(&mut ui, |ui| picked(ui, shown, paper, look, state, commands));
    }
}

/// Shows the world and its robots. Dragging moves the view, the wheel and two fingers magnify it, a click picks.
fn world(
    ui: &mut Ui,
    shown: &CrowdPane,
    paper: Rect,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) -> Fit {
    let CrowdPane { cockpit, crowd, .. } = *shown;
    let bounds = cockpit.world.bounds;
    let whole = canvas::fit(&cockpit.world, paper);
    let response = ui.allocate_rect(paper, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, cockpit.described()));
    let mut camera = state.cameras.get(&cockpit.world.name).copied().unwrap_or_default();
    let (mut fit, moved) = magnified(ui, &response, &mut camera, &whole, &bounds, state.takes_wheel());
    state.crowd.follows &= !moved;
    let followed = cockpit.robots.first().filter(|_| state.crowd.follows);
    if let Some(part) = followed.and_then(|robot| robot.footprint.parts().first()) {
        camera.look_at(part.pose().position(), &bounds);
        fit = camera.fit(&whole, &bounds, f64::from(ui.pixels_per_point()));
    }
    let painter = ui.painter_at(paper);
    canvas::paint_cached(&painter, &cockpit.world, paper, &fit, look);
    if state.crowd.heat {
        painter.add(Shape::mesh(heat(ui, shown).squares(&fit, look).0));
    }
    let now = ui.input(|i| i.time);
    let picked = state.crowd.picked_in(crowd).map(|p| p.id);
    let role = |id: u32, robot: &CrowdRobot| {
        if picked == Some(id) {
            // it is drawn by itself
            return None;
        }
        if !robot.flash && state.flashes.is_empty() {
            return Some(Role::Robot);
        }
        let name = crowd.name(id)?;
        if !robot.flash && !state.flashes.contains_key(name) {
            return Some(Role::Robot);
        }
        if state.flash_lags(name, robot.flash) {
            ui.ctx().request_repaint_after_secs(0.34);
        }
        Some(if state.flash(name, robot.flash, now) { Role::Goal } else { Role::Robot })
    };
    let mesh = robots(crowd, paper, &fit, look, role);
    painter.add(Shape::mesh(mesh.0));
    let mut over = Picture::new(&cockpit.world.name, bounds);
    if state.settings.labels {
        over = over.with(names(crowd, paper, &fit));
    }
    let over = over.with(pane::robots(ui, cockpit, state));
    canvas::paint(&painter, &over, &fit, look);
    // a ring around who is picked, wide enough to be found where robots are dots
    for b in cockpit.robots.iter().filter_map(|robot| robot.footprint.bounds()) {
        let [x, y] = fit.screen_from_world(b.centre());
        let radius = (0.5 * (b.max - b.min).norm() * fit.px_per_metre()) as f32 + 4.0;
        painter.circle_stroke(pos2(x as f32, y as f32), radius.max(9.0), Stroke::new(2.0, look.colour(Role::Focus)));
    }
    point_out(&response, &over, cockpit, &fit);
    let armed =
        cockpit.robots.iter().find(|r| state.hand.armed.as_ref() == Some(&r.name) || handles::have_focus(ui, r));
    let role = if armed.is_some() || response.has_focus() { Role::Focus } else { Role::Hairline };
    let width = if armed.is_some() { 2.0 } else { 1.0 };
    painter.rect_stroke(paper, 0.0, Stroke::new(width, look.colour(role)), StrokeKind::Inside);
    if let Some(robot) = armed {
        in_hand(ui, robot, paper, Free { taken: BUTTONS, of: None }, look, state);
    }
    pending_input(ui, cockpit, paper, look);
    for robot in cockpit.robots.iter().filter(|r| r.is_arm) {
        handles::handles(ui, robot, paper, &fit, look, state, commands);
    }
    let touch = touched(ui);
    let at_door = door_clicked(&response, cockpit, &fit, touch, commands);
    if response.clicked() && response.interact_pointer_pos().is_none() {
        // by a key: there is no place that was clicked
        take_in_hand(cockpit, in_reach(cockpit), state, commands);
        response.surrender_focus();
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked() && !at_door) {
        let at = fit.world_from_screen([f64::from(at.x), f64::from(at.y)]);
        let near = crowd.nearest(at, if touch { TOUCH } else { REACH } / fit.px_per_metre());
        pick(shown, near, picked, state, commands);
        if near.is_none() && response.double_clicked() {
            camera = Camera::default();
        }
    }
    magnifier(ui, paper, true, &mut camera, &whole, &bounds, look);
    state.cameras.insert(cockpit.world.name.clone(), camera);
    fit
}

/// Picks the robot that was clicked; one that is picked already is taken in hand. A click on the floor lets go of it,
/// or picks nobody.
fn pick(shown: &CrowdPane, near: Option<u32>, picked: Option<u32>, state: &mut UiState, commands: &mut Vec<Command>) {
    if near.is_some() && near == picked {
        take_in_hand(shown.cockpit, in_reach(shown.cockpit), state, commands);
    } else if near.is_none() && state.hand.armed.is_some() {
        drive::let_go(state, commands);
    } else {
        drive::let_go(state, commands);
        state.crowd.pick(shown.crowd, near);
    }
}

/// The names of the robots in view, where these are few.
fn names(crowd: &CrowdView, paper: Rect, fit: &Fit) -> Vec<Item> {
    let is_seen = |place: &usize| {
        crowd.spot(*place).is_some_and(|spot| {
            let [x, y] = fit.screen_from_world(spot.centre);
            paper.contains(pos2(x as f32, y as f32))
        })
    };
    let seen: Vec<usize> = (0..crowd.now.len()).filter(is_seen).take(MAX_NAMED + 1).collect();
    if seen.len() > MAX_NAMED {
        return Vec::new();
    }
    let label = |place: usize| {
        let (name, bounds) = (crowd.names.get(place)?, crowd.footprint(place)?.0.bounds()?);
        let at = Point2::new(bounds.centre().x, bounds.max.y);
        let (text, anchor, face) = (name.clone(), Anchor::Above, Face::Sans);
        let drawing = Drawing::Label { at, text, anchor, face, size_px: 11.0, plate: true };
        Some(Item::new(format!("name/{name}"), name.clone(), Role::Muted, drawing))
    };
    seen.into_iter().filter_map(label).collect()
}

/// The contacts of the crowd up to now, counted again after each tick.
fn heat(ui: &Ui, shown: &CrowdPane) -> Arc<Heat> {
    let (marks, crowd) = (shown.history.marks(), shown.crowd);
    let tick = marks.partition_point(|m| m.tick <= shown.tick);
    let last = tick.checked_sub(1).and_then(|i| marks.get(i)).copied();
    let key = (tick, last, shown.cockpit.world.bounds);
    let id = Id::new(("heat", crowd.first));
    let kept: Option<(HeatKey, Arc<Heat>)> = ui.data(|d| d.get_temp(id));
    if let Some((_, heat)) = kept.filter(|(k, _)| *k == key) {
        return heat;
    }
    let ids = crowd.first..crowd.first.saturating_add(crowd.names.len() as u32);
    let heat = Arc::new(Heat::of(marks, shown.tick, ids, &shown.cockpit.world.bounds));
    ui.data_mut(|d| d.insert_temp(id, (key, Arc::clone(&heat))));
    heat
}

/// What kept counts of contacts depend on: how many marks there are up to now, the last of them, and the world's box.
type HeatKey = (usize, Option<TickMark>, Aabb);

/// Shows how many contacts there were, and a link that shows where they began.
fn heat_link(ui: &mut Ui, shown: &CrowdPane, look: &FrameColours, state: &mut UiState) {
    let contacts = shown.crowd.contacts();
    let words = format!("contacts: {}", thousands(contacts));
    ui.label(RichText::new(words).monospace().color(look.colour(Role::Muted)));
    if contacts > 0 || state.crowd.heat {
        let words = if state.crowd.heat { "hide where" } else { "show where" };
        if ui.link(words).on_hover_text("The fuller a square, the more contacts began in it").clicked() {
            state.crowd.heat = !state.crowd.heat;
        }
    }
}

/// Shows who is picked: its name, buttons to follow and to drive it, its words.
fn picked(
    ui: &mut Ui,
    shown: &CrowdPane,
    paper: Rect,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    for robot in &shown.cockpit.robots {
        let name = RichText::new(by_whom(robot, robot.name.clone())).text_style(TextStyle::Body).strong();
        ui.label(name.color(look.colour(Role::Text)));
        ui.horizontal(|ui| {
            let follow = LabButton::new("Follow").selected(state.crowd.follows).show(ui, look);
            if follow.on_hover_text("Keep it in the middle").clicked() {
                state.crowd.follows = !state.crowd.follows;
                let camera = state.cameras.entry(shown.cockpit.world.name.clone()).or_default();
                camera.approach(f64::from(paper.width()), &canvas::fit(&shown.cockpit.world, paper));
            }
            if robot.drivable {
                let is_driven = state.hand.armed.as_ref() == Some(&robot.name) || handles::have_focus(ui, robot);
                let drive = LabButton::new("Drive").selected(is_driven).show(ui, look);
                if drive.on_hover_text("Drive it with the arrow keys").clicked() {
                    take_in_hand(shown.cockpit, in_reach(shown.cockpit), state, commands);
                }
            }
        });
        robot_words(ui, robot, look, state, commands);
    }
}
