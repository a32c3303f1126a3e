//! The chart of the atlas: the robot that a click places as a point of its configuration space, which is proven anew
//! while the world around it is edited.

use bevy_egui::egui::{Rect, Ui};

use super::atlas_space::AtlasSpace;
use super::state::Mode;
use crate::window::ui::cspace::chart::meant;
use crate::window::ui::paint::sheet::{split_chart, unscaled_sheet};
use crate::window::ui::{AtlasState, FrameColours};
use motion_lab_core::cspace::{Overlay, overlay_items};
use motion_lab_core::picture::Picture;

impl AtlasState {
    /// The configuration space of the robot that a click places, as it was shown last.
    pub fn space(&self) -> Option<&AtlasSpace> {
        self.space.as_ref()
    }
}

/// Largest share of the height for the chart above the panel, where the editor needs room.
const ABOVE: f32 = 0.32;

/// Splits the room beside the world into that of the chart and that of the panel, and judges more of the chart.
pub fn split(ui: &Ui, [paper, beside]: [Rect; 2], look: &FrameColours, atlas: &mut AtlasState) -> (Option<Rect>, Rect) {
    atlas.space = AtlasSpace::of(atlas.space.take(), atlas.shown(), atlas.robot, &atlas.still);
    let Some(more) = atlas.space.as_mut().map(AtlasSpace::refine) else { return (None, beside) };
    if more {
        ui.ctx().request_repaint();
    }
    split_chart(paper, beside, atlas.space().map(|space| &**space.cells().picture()), ABOVE, look)
}

/// Shows the chart. Where a click puts robots, the point can be dragged: the robot goes there when it is
/// let go, if it is free. Returns whether it was put somewhere.
pub fn chart(ui: &mut Ui, paper: Rect, look: &FrameColours, atlas: &mut AtlasState) -> bool {
    let index = atlas.robot;
    let Some((space, robot)) = atlas.space().zip(atlas.shown().robots().get(index)) else { return false };
    let (cells, still) = (space.cells(), space.cells().picture());
    let is_put = atlas.mode == Mode::Put;
    let solutions = atlas.wanted.filter(|_| is_put).into_iter().collect();
    let overlay = Overlay { now: Some(robot.q), solutions, ..Overlay::default() };
    let moving = Picture::new("configuration", still.bounds).with(overlay_items(cells.map().slice(), &overlay));
    let spoken = format!("configuration space of {}. It is the point {}", robot.name, robot.q);
    let on = unscaled_sheet(ui, paper, spoken, still, &moving, look);
    let Some((q, _)) = meant(ui, &on, cells).filter(|_| is_put) else { return false };
    let done = on.response.clicked() || on.response.drag_stopped();
    atlas.ask_for(q, done);
    done && atlas.refusal().is_none()
}
