//! The widget: the workspace and the configuration space side by side, with what the planner grows in both.

use std::sync::Arc;

use bevy_egui::egui::{Align2, Rect, ScrollArea, TextStyle, Ui, UiBuilder, Vec2, pos2, vec2};

use super::controls::controls;
use super::panel::{choices, ends, outcome, panel, path_buttons};
use super::race::table;
use super::state::PlanState;
use crate::window::ui::keys::SessionAction;
use crate::window::ui::paint::canvas::{self, MARGIN};
use crate::window::ui::paint::sheet::{ScreenSheet, sheet, two_columns};
use crate::window::ui::{Command, Dashboard, FrameColours, Notice, SessionCommand, UiState};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::cspace::Slice;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::wrap;
use motion_lab_core::picture::{Picture, Role, readout};
use motion_lab_sim::manifest::Widget;

/// Width of the panel beside the papers, points.
const SIDE: f32 = 240.0;

/// Height from which on what came of the plan has room under the papers, points.
const OUTCOME: f32 = 110.0;

/// The names of the two ends.
const END: [&str; 2] = ["start", "goal"];

/// Height kept free under the papers of a narrow screen, points.
const UNDER: f32 = 180.0;

/// Largest number of cells judged in a frame.
const CELLS: u32 = 1500;

/// Carries out the action of a key while the widget is in front. Save and open act on paths.
pub fn act(action: SessionAction, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    match action {
        SessionAction::Save if state.plan.lengths().is_none() => {
            let text = "there is no path to save: the planner here has found none";
            state.say(Notice { text: text.to_owned(), is_error: true });
        }
        SessionAction::Save => commands.push(Command::Session(SessionCommand::SavePath)),
        SessionAction::Open => commands.push(Command::Session(SessionCommand::OpenPath)),
        action => crate::window::ui::menu::act(action, model, state, commands),
    }
}

/// Shows the widget.
pub fn plan_view(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let narrow = look.narrow;
    let words = Widget::Plan.text();
    if !look.low {
        crate::window::ui::menu::head(ui, words, model, look, state, commands);
    }
    if state.plan.playing {
        state.plan.play(f64::from(ui.input(|i| i.stable_dt)));
        ui.ctx().request_repaint();
    }
    let room = ui.available_rect_before_wrap();
    let bar = ui.spacing().interact_size.y + 12.0;
    let line = ui.text_style_height(&TextStyle::Small) + 4.0;
    let (papers, beside) = if look.low {
        room.split_top_bottom_at_y(room.top() + 0.68 * room.height())
    } else if narrow {
        // the papers as they are larger, and the rest under them
        let above = (0.5 * (room.height() - UNDER)).min(room.width()).max(120.0);
        let beside = (0.5 * (room.width() - 8.0)).min(room.height() - UNDER);
        room.split_top_bottom_at_y(room.top() + if above >= beside { 2.0 * above + 8.0 } else { beside + line })
    } else {
        let (left, beside) = room.split_left_right_at_x(room.right() - SIDE - 20.0);
        (left.with_max_y(left.bottom() - bar), beside.with_min_x(beside.left() + 20.0))
    };
    let cells = state.plan.cells(CELLS).map(|(cells, more)| {
        if more {
            ui.ctx().request_repaint();
        }
        (Arc::clone(cells.picture()), cells.map().slice().clone())
    });
    let aspects = [Some(&**state.plan.backdrop()), cells.as_ref().map(|(still, _)| &**still)].map(aspect);
    let inner = papers.with_max_y(papers.bottom() - line);
    let [left, right] = if look.low { beside_one_another(inner, aspects) } else { larger(inner, aspects) };
    workspace(ui, left, look, &mut state.plan);
    if let Some((still, slice)) = cells {
        space(ui, right, (&still, &slice), look, &mut state.plan);
    }
    let seen = left.union(right.with_max_y(right.bottom() + line));
    if narrow {
        let under = if look.low { seen.bottom() } else { beside.top() } + 6.0;
        ui.scope_builder(UiBuilder::new().max_rect(beside.with_min_y(under)), |ui| {
            ScrollArea::vertical().id_salt("plan").auto_shrink(false).show(ui, |ui| {
                if look.low {
                    crate::window::ui::menu::head(ui, words, model, look, state, commands);
                }
                ui.horizontal_wrapped(|ui| controls(ui, look, &mut state.plan));
                panel(ui, model, look, state, commands);
                crate::window::ui::menu::foot(ui, words, look, state);
            });
        });
    } else {
        let under = Rect::from_min_max(pos2(room.left(), seen.bottom() + 10.0), pos2(papers.right(), room.bottom()));
        let is_roomy = under.height() >= bar + OUTCOME;
        ui.scope_builder(UiBuilder::new().max_rect(under), |ui| {
            ui.horizontal(|ui| controls(ui, look, &mut state.plan));
            if is_roomy {
                ui.add_space(8.0);
                let scroll = ScrollArea::vertical().id_salt("outcome").auto_shrink(false);
                scroll.show(ui, |ui| {
                    two_columns(ui, 0.5 * (under.width() - 20.0), |ui, i| match i {
                        0 => {
                            table(ui, look, &mut state.plan);
                            outcome(ui, look, &state.plan);
                        }
                        _ => path_buttons(ui, model, look, &mut state.plan, commands),
                    });
                });
            }
        });
        ui.scope_builder(UiBuilder::new().max_rect(beside), |ui| {
            ScrollArea::vertical().id_salt("plan").auto_shrink(false).show(ui, |ui| {
                if is_roomy {
                    choices(ui, model, state);
                    ui.add_space(4.0);
                    ends(ui, state, true);
                } else {
                    panel(ui, model, look, state, commands);
                }
            });
        });
    }
}

/// The width of a picture's drawing for each point of its height. One that is not there is a square.
fn aspect(picture: Option<&Picture>) -> f32 {
    let size = picture.map(|picture| picture.bounds.max - picture.bounds.min);
    size.map_or(1.0, |size| (size.x / size.y) as f32).clamp(0.05, 20.0)
}

/// Papers beside one another, equally high, for drawings of these aspects.
fn beside_one_another(room: Rect, [a, b]: [f32; 2]) -> [Rect; 2] {
    const GAP: f32 = 16.0;
    let height = (room.width() - GAP - 4.0 * MARGIN) / (a + b);
    let height = height.min(room.height() - 2.0 * MARGIN).max(1.0);
    let size = |aspect: f32| vec2(aspect * height, height) + Vec2::splat(2.0 * MARGIN);
    let left = Rect::from_min_size(room.min, size(a));
    [left, Rect::from_min_size(left.right_top() + vec2(GAP, 0.0), size(b))]
}

/// Papers one above the other, equally wide, in the middle of the room.
fn one_above_the_other(room: Rect, [a, b]: [f32; 2]) -> [Rect; 2] {
    const GAP: f32 = 8.0;
    let width = (room.height() - GAP - 4.0 * MARGIN) / (1.0 / a + 1.0 / b);
    let width = width.min(room.width() - 2.0 * MARGIN).max(1.0);
    let size = |aspect: f32| vec2(width, width / aspect) + Vec2::splat(2.0 * MARGIN);
    let left = room.center().x - 0.5 * width - MARGIN;
    let above = Rect::from_min_size(pos2(left, room.top()), size(a));
    [above, Rect::from_min_size(above.left_bottom() + vec2(0.0, GAP), size(b))]
}

/// The papers as they are larger, beside one another or one above the other.
fn larger(room: Rect, aspects: [f32; 2]) -> [Rect; 2] {
    let (beside, above) = (beside_one_another(room, aspects), one_above_the_other(room, aspects));
    let area = |papers: &[Rect; 2]| papers[0].area() + papers[1].area();
    if area(&beside) >= area(&above) { beside } else { above }
}

/// Shows the workspace, where start and goal can be dragged.
fn workspace(ui: &mut Ui, paper: Rect, look: &FrameColours, plan: &mut PlanState) {
    let still = Arc::clone(plan.backdrop());
    let spoken = format!("workspace. {}", plan.described());
    let nothing = Picture::new("nothing", still.bounds);
    let on = sheet(ui, paper, spoken, &still, &nothing, look);
    canvas::paint_cached(&ui.painter_at(paper), &plan.over, paper, &on.fit, look);
    let robot = plan.task().robot;
    let places = [0, 1].map(|end| robot.reference(&plan.end_at(end)));
    if let Some((end, to)) = moved(&on, places, plan) {
        let q = plan.end_at(end);
        let bends_down = q.coordinates().last().is_some_and(|angle| *angle >= 0.0);
        plan.move_end(end, robot.dragged(&q, to, bends_down));
    }
    if !plan.is_moved && !on.response.dragged() {
        on.response.on_hover_text_at_pointer("Drag the start or the goal");
    }
}

/// Shows the configuration space, where both are points, and under it what it is.
fn space(ui: &mut Ui, paper: Rect, (still, slice): (&Arc<Picture>, &Slice), look: &FrameColours, plan: &mut PlanState) {
    let spoken = format!("configuration space. {}", slice.described());
    let on = sheet(ui, paper, spoken, still, &Picture::new("nothing", still.bounds), look);
    if let Some(over) = plan.over_cells() {
        canvas::paint_cached(&ui.painter_at(paper), &over, paper, &on.fit, look);
    }
    let font = TextStyle::Small.resolve(ui.style());
    let under = paper.left_bottom() + vec2(0.0, 3.0);
    let mut words = readout(&slice.described());
    let other = 1 - plan.end.min(1);
    if !slice.holds(&plan.end_at(other)) {
        words += &format!(": that of the {}, the {} lies in another", END[1 - other], END[other]);
    }
    ui.painter().text(under, Align2::LEFT_TOP, words, font, look.colour(Role::Text));
    let places = [0, 1].map(|end| Point2::from(slice.point(&plan.end_at(end))));
    if let Some((end, to)) = moved(&on, places, plan) {
        let (min, max) = (slice.min(), slice.max());
        let p = if slice.wraps() {
            [wrap(to.x), wrap(to.y)]
        } else {
            [to.x.clamp(min[0], max[0]), to.y.clamp(min[1], max[1])]
        };
        // what the slice holds is the end's own
        let (q, there) = (plan.end_at(end), slice.at(p));
        let axes = slice.axes();
        let to = there.coordinates();
        plan.move_end(end, axes.into_iter().fold(q, |q, axis| q.with(axis, to[axis])));
    }
    if !plan.is_moved && !on.response.dragged() {
        on.response.on_hover_text_at_pointer("Drag a point: it is the start or the goal");
    }
}

/// Which end is dragged, the start or the goal, and where to: that which was nearer where the pointer was pressed.
fn moved(on: &ScreenSheet, places: [Point2; 2], plan: &mut PlanState) -> Option<(usize, Point2)> {
    let to = on.held().filter(|_| on.response.dragged() || on.response.clicked())?;
    if on.response.drag_started() || on.response.clicked() {
        // egui forgets where the pointer was pressed once it is let go
        let pressed = on.response.ctx.input(|i| i.pointer.press_origin());
        let origin = pressed.or(on.response.interact_pointer_pos())?;
        let from = on.fit.world_from_screen([f64::from(origin.x), f64::from(origin.y)]);
        let [start, goal] = places.map(|place| (place - from).norm());
        plan.end = usize::from(goal <= start);
    }
    Some((plan.end, to))
}
