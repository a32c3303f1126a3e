//! The widget: the workspace and the configuration space side by side, with what the planner grows in both.

use std::sync::Arc;

use bevy_egui::egui::{Align2, Rect, ScrollArea, TextStyle, Ui, UiBuilder, pos2, vec2};

use super::controls::{act as act_on_planner, controls};
use super::panel::panel;
use super::state::PlanState;
use crate::configuration::Configuration;
use crate::geometry::Point2;
use crate::manifest::Widget;
use crate::num::wrap;
use crate::picture::{Picture, Role};
use crate::ui::keys::Action;
use crate::ui::paint::canvas;
use crate::ui::paint::sheet::{Sheet, sheet, split};
use crate::ui::{Command, Dashboard, Look, Notice, SessionCommand, UiState, readout};

/// Width of the panel beside the papers, points.
const SIDE: f32 = 300.0;

/// Largest number of cells judged in a frame.
const CELLS: u32 = 1500;

/// Carries out the action of a key while the widget is in front. Save and open act on paths.
pub fn act(action: Action, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    match action {
        Action::Save if state.plan.lengths().is_none() => {
            let text = "there is no path to save: the planner here has found none";
            state.say(Notice { text: text.to_owned(), is_error: true });
        }
        Action::Save => commands.push(Command::Session(SessionCommand::SavePath)),
        Action::Open => commands.push(Command::Session(SessionCommand::OpenPath)),
        action if act_on_planner(action, &mut state.plan) => {}
        action => crate::ui::tools::act(action, model, state, commands),
    }
}

/// Shows the widget.
pub fn plan_view(ui: &mut Ui, model: &Dashboard, look: &Look, state: &mut UiState, commands: &mut Vec<Command>) {
    let narrow = look.narrow;
    crate::ui::tools::head(ui, Widget::Plan.text(), model, look, state, commands);
    if state.plan.playing {
        state.plan.play(f64::from(ui.input(|i| i.stable_dt)));
        ui.ctx().request_repaint();
    }
    let room = ui.available_rect_before_wrap();
    let bar = ui.spacing().interact_size.y + 12.0;
    let (papers, beside) = if narrow {
        // the papers one above the other, and the rest under them
        let side = (0.5 * (room.height() - 180.0)).min(room.width()).max(120.0);
        room.split_top_bottom_at_y(room.top() + 2.0 * side + 8.0)
    } else {
        let (left, beside) = split(room, false, SIDE);
        (left.with_max_y(left.bottom() - bar), beside)
    };
    let (left, right) = halves(papers, !narrow && is_larger_beside(&state.plan, papers));
    let seen = workspace(ui, left, look, &mut state.plan).union(space(ui, right, look, &mut state.plan));
    if narrow {
        ui.scope_builder(UiBuilder::new().max_rect(beside.with_min_y(beside.top() + 6.0)), |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                ui.horizontal_wrapped(|ui| controls(ui, look, &mut state.plan));
                panel(ui, look, state, commands);
            });
        });
    } else {
        let under = Rect::from_min_max(pos2(room.left(), seen.bottom() + 10.0), pos2(papers.right(), room.bottom()));
        ui.scope_builder(UiBuilder::new().max_rect(under), |ui| {
            ui.horizontal(|ui| controls(ui, look, &mut state.plan));
        });
        ui.scope_builder(UiBuilder::new().max_rect(beside), |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| panel(ui, look, state, commands));
        });
    }
}

/// The two halves of the room for the papers: `beside` one another, or one above the other.
fn halves(papers: Rect, beside: bool) -> (Rect, Rect) {
    let middle = papers.center();
    if beside {
        (papers.with_max_x(middle.x - 8.0), papers.with_min_x(middle.x + 8.0))
    } else {
        (papers.with_max_y(middle.y - 4.0), papers.with_min_y(middle.y + 4.0))
    }
}

/// Whether the world is larger where the papers lie beside one another.
fn is_larger_beside(plan: &PlanState, papers: Rect) -> bool {
    let [beside, above] =
        [true, false].map(|beside| canvas::proportioned(plan.backdrop(), halves(papers, beside).0).area());
    beside >= above
}

/// Shows the workspace, where start and goal can be dragged. Returns what it covers.
fn workspace(ui: &mut Ui, room: Rect, look: &Look, plan: &mut PlanState) -> Rect {
    let still = Arc::clone(plan.backdrop());
    let paper = canvas::proportioned(&still, room);
    let spoken = format!("workspace. {}", plan.described());
    let nothing = Picture::new("nothing", still.bounds);
    let on = sheet(ui, paper, spoken, &still, &nothing, look);
    canvas::paint_kept(&ui.painter_at(paper), &plan.over, paper, &on.fit, look);
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
    paper
}

/// Shows the configuration space, where both are points. Returns what it covers with the words under it.
fn space(ui: &mut Ui, room: Rect, look: &Look, plan: &mut PlanState) -> Rect {
    let Some((still, slice)) = plan.cells(CELLS).map(|(cells, more)| {
        if more {
            ui.ctx().request_repaint();
        }
        (Arc::clone(cells.picture()), cells.map().slice().clone())
    }) else {
        return Rect::from_min_size(room.min, vec2(0.0, 0.0));
    };
    let line = ui.text_style_height(&TextStyle::Small) + 4.0;
    let paper = canvas::proportioned(&still, room.with_max_y(room.bottom() - line));
    let spoken = format!("configuration space. {}", slice.described());
    let on = sheet(ui, paper, spoken, &still, &Picture::new("nothing", still.bounds), look);
    if let Some(over) = plan.over_cells() {
        canvas::paint_kept(&ui.painter_at(paper), &over, paper, &on.fit, look);
    }
    let font = TextStyle::Small.resolve(ui.style());
    let under = paper.left_bottom() + vec2(0.0, 3.0);
    ui.painter().text(under, Align2::LEFT_TOP, readout(&slice.described()), font, look.colour(Role::Muted));
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
    paper.with_max_y(paper.bottom() + line)
}

/// Which end is dragged, the start or the goal, and where to: that which was nearer where the pointer was pressed.
fn moved(on: &Sheet, places: [Point2; 2], plan: &mut PlanState) -> Option<(usize, Point2)> {
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
