//! The chart of the configuration space of Query's robot: the other half of the pair with its workspace.

use std::sync::Arc;

use bevy_egui::egui::{Pos2, Rect, Ui};

use super::torus::torus;
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::sheet::{ScreenSheet, sheet, unscaled_sheet};
use crate::window::ui::{FrameColours, UiState};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::overlay_items;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::Picture;
use motion_lab_sim::lens::{SpaceCells, remember_in};
use motion_lab_sim::manifest::HintTask;

/// Radius of the robot's point with its ring, points.
const POINT: f64 = 6.0;

/// Where the names of the blocked regions are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChartNames {
    /// On the chart.
    Shown,
    /// In its description alone: a small chart has no room for them.
    Spoken,
}

/// Shows the configuration space in `paper`, and judges more of its cells: as a square, as a map, or as a torus where
/// that was chosen.
pub fn chart(ui: &mut Ui, paper: Rect, named: ChartNames, look: &FrameColours, state: &mut UiState) {
    if state.cspace.refine(&state.anatomy.anatomy) {
        ui.ctx().request_repaint();
    }
    if state.cspace.is_torus && state.cspace.cells.as_ref().is_some_and(|cells| cells.map().slice().wraps()) {
        torus(ui, paper, look, state);
    } else {
        space(ui, paper, named, look, state);
    }
}

/// Shows the square or the map, where the robot's point can be dragged.
fn space(ui: &mut Ui, paper: Rect, named: ChartNames, look: &FrameColours, state: &mut UiState) {
    let Some(cells) = &state.cspace.cells else { return };
    let anatomy = &state.anatomy.anatomy;
    let (slice, still) = (cells.map().slice().clone(), Arc::clone(cells.picture()));
    let overlay = anatomy.in_space(state.cspace.trace.clone());
    let fit = canvas::fit(&still, paper);
    let regions = match named {
        ChartNames::Shown => cells.names_off(Point2::from(slice.point(&anatomy.q())), &fit),
        ChartNames::Spoken => Vec::new(),
    };
    let moving = Picture::new(still.name.clone(), still.bounds).with(regions).with(overlay_items(&slice, &overlay));
    let names: Vec<&str> = cells.regions().iter().map(|region| region.name.as_str()).collect();
    let blocked = if names.is_empty() { String::new() } else { format!(". Blocked regions: {}", names.join(", ")) };
    let spoken = format!("configuration space. The robot is the point {}{blocked}", anatomy.q());
    let show = if named == ChartNames::Shown { sheet } else { unscaled_sheet };
    let on = show(ui, paper, spoken, &still, &moving, look);
    if let Some((q, is_over_edge)) = meant(ui, &on, cells) {
        // a point of the slice is a configuration of the robot
        if state.anatomy.anatomy.set_q(q).is_ok() {
            remember(state);
            state.did.push(HintTask::MovePoint);
            state.did.extend(is_over_edge.then_some(HintTask::OverEdge));
        }
    }
}

/// The configuration that the pointer means on a chart of these cells, while it is held or where it is let go, and
/// whether the way there led over an edge of a torus.
pub fn meant(ui: &Ui, on: &ScreenSheet, cells: &SpaceCells) -> Option<(AnyConfiguration, bool)> {
    // on a torus the way beyond an edge goes on at the opposite one, however far
    let held = if cells.map().slice().wraps() { on.held_anywhere() } else { on.held() };
    // who presses among the figures at the axes means no point, also once it is let go, when egui knows no more where
    let begun = on.response.id.with("pressed at");
    let pressed = ui.input(|i| i.pointer.press_origin());
    let pressed: Option<Pos2> = ui.data_mut(|data| match pressed {
        Some(at) => {
            data.insert_temp(begun, at);
            Some(at)
        }
        None => data.remove_temp(begun),
    });
    let from = pressed.map(|p| on.fit.world_from_screen([f64::from(p.x), f64::from(p.y)])).or(held);
    let is_on_chart = from.is_some_and(|p| cells.is_on_chart(p, POINT / on.fit.px_per_metre()));
    let is_held = on.response.dragged() || on.response.drag_stopped() || on.response.clicked();
    held.filter(|_| is_on_chart && is_held).map(|to| cells.configuration_at(to))
}

/// Remembers where the robot of Query and Space is now.
pub fn remember(state: &mut UiState) {
    remember_in(&mut state.cspace.trace, state.anatomy.anatomy.q());
}
