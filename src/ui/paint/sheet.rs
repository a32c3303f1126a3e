//! A sheet: one picture on a paper that the pointer can act on.

use bevy_egui::egui::{Rect, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo, WidgetType};

use super::{canvas, frame};
use crate::geometry::Point2;
use crate::picture::{Fit, Picture, Role, pick};
use crate::ui::{Look, UiState};

/// Distance within which the pointer points at a drawn thing, points.
const REACH: f64 = 4.0;

/// A sheet as shown in this frame.
pub struct Sheet {
    /// The pointer's actions on the paper.
    pub response: Response,
    /// The rectangle of the paper.
    pub paper: Rect,
    /// The fit of the picture into it.
    pub fit: Fit,
}

impl Sheet {
    /// The point of the picture's plane where the pointer is held down; `None` where it is not, or is off the paper.
    pub fn held(&self) -> Option<Point2> {
        self.at(self.response.interact_pointer_pos()?)
    }

    fn at(&self, pos: bevy_egui::egui::Pos2) -> Option<Point2> {
        self.paper.contains(pos).then(|| self.fit.world_from_screen([f64::from(pos.x), f64::from(pos.y)]))
    }
}

/// Splits the room into a widget's paper and the panel beside it, `width` points wide. On a narrow screen the panel is
/// under the paper.
pub fn split(room: Rect, narrow: bool, width: f32) -> (Rect, Rect) {
    if narrow {
        let (paper, rest) = room.split_top_bottom_at_y(room.top() + (0.5 * room.height()).min(room.width()));
        (paper, rest.with_min_y(rest.top() + 8.0))
    } else {
        let (paper, rest) = room.split_left_right_at_x(room.right() - width - 20.0);
        (paper, rest.with_min_x(rest.left() + 20.0))
    }
}

/// Shows `still`, which is kept from frame to frame, and `moving` over it. Pointing at a drawn thing lights its role.
///
/// `spoken` describes both for screen readers.
pub fn sheet(
    ui: &mut Ui,
    paper: Rect,
    spoken: String,
    still: &std::sync::Arc<Picture>,
    moving: &Picture,
    look: &Look,
    state: &mut UiState,
) -> Sheet {
    let response = ui.allocate_rect(paper, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &spoken));
    let fit = canvas::fit(still, paper);
    let painter = ui.painter_at(paper.expand(1.0));
    canvas::paint_kept(&painter, still, paper, &fit, look);
    canvas::paint(&ui.painter_at(paper), moving, &fit, look);
    let role = if response.has_focus() { Role::Focus } else { Role::Hairline };
    painter.rect_stroke(paper, 0.0, Stroke::new(1.0, look.colour(role)), StrokeKind::Inside);
    if let Some(at) =
        response.hover_pos().filter(|_| response.hovered() && !response.dragged() && frame::rests(&response))
    {
        let at = [f64::from(at.x), f64::from(at.y)];
        let item = pick(moving, &fit, at, REACH).or_else(|| pick(still, &fit, at, REACH));
        state.pointed =
            item.map(|i| i.role).filter(|r| !matches!(r, Role::Muted | Role::Paper | Role::Text)).or(state.pointed);
    }
    Sheet { response, paper, fit }
}
