//! A sheet: one picture on a paper that the pointer can act on.

use bevy_egui::egui::{
    Align, Layout, Rect, Response, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, WidgetType, vec2,
};

use super::canvas;
use super::scale_bar::bar_at;
use crate::geometry::Point2;
use crate::picture::{Fit, Picture, Role, pick};
use crate::ui::Look;

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
        let pos = self.response.interact_pointer_pos()?;
        self.held_anywhere().filter(|_| self.paper.contains(pos))
    }

    /// The point of the picture's plane where the pointer is held down since it was pressed on the paper, even where it
    /// has left the paper since; also where it was let go in this frame.
    pub fn held_anywhere(&self) -> Option<Point2> {
        let pos = self.response.interact_pointer_pos()?;
        Some(self.fit.world_from_screen([f64::from(pos.x), f64::from(pos.y)]))
    }
}

impl Sheet {
    /// The role of the part of a picture that the pointer is on; `None` where it is on none, or off the paper.
    pub fn pointed_at(&self, picture: &Picture) -> Option<Role> {
        let at = self.response.hover_pos()?;
        pick(picture, &self.fit, [f64::from(at.x), f64::from(at.y)], 3.0).map(|item| item.role)
    }
}

/// Share of the height for the paper where its panel is under it.
const ABOVE: f32 = 0.6;

/// Width of the panel beside a paper in a low room, at least, points.
const LEAST_BESIDE: f32 = 200.0;

/// Splits the room into a widget's paper, on which `still` is shown, and the panel beside it, `width` points wide. On a
/// narrow screen and in a room that is taller than wide the panel is under the paper.
pub fn split(still: &Picture, room: Rect, look: &Look, width: f32) -> (Rect, Rect) {
    if look.low {
        let paper = canvas::proportioned(still, room.with_max_x(room.right() - LEAST_BESIDE - 12.0));
        return (paper, room.with_min_x(paper.right() + 12.0));
    }
    if look.narrow {
        let (paper, rest) = room.split_top_bottom_at_y(room.top() + (0.5 * room.height()).min(room.width()));
        return (paper, rest.with_min_y(rest.top() + 8.0));
    }
    if room.height() > room.width() {
        // as wide as the room, and no higher than the picture
        let most = room.with_max_y(room.top() + ABOVE * room.height());
        let (paper, rest) = room.split_top_bottom_at_y(canvas::proportioned(still, most).bottom());
        return (paper, rest.with_min_y(rest.top() + 12.0));
    }
    let (paper, rest) = room.split_left_right_at_x(room.right() - width - 20.0);
    (paper, rest.with_min_x(rest.left() + 20.0))
}

/// Lays out two columns, the first of them `width` points wide; `add` is called for each.
pub fn two_columns(ui: &mut Ui, width: f32, mut add: impl FnMut(&mut Ui, usize)) {
    let room = ui.available_rect_before_wrap();
    let middle = room.left() + width;
    let mut used = Rect::from_min_size(room.min, vec2(room.width(), 0.0));
    for (i, column) in [room.with_max_x(middle), room.with_min_x(middle + 20.0)].into_iter().enumerate() {
        // a layout of its own: egui's columns justify their words
        let mut ui = ui.new_child(UiBuilder::new().max_rect(column).layout(Layout::top_down(Align::Min)));
        add(&mut ui, i);
        used = used.union(ui.min_rect());
    }
    ui.advance_cursor_after_rect(used);
}

/// Shows `still`, which is kept from frame to frame, and `moving` over it.
///
/// `spoken` describes both for screen readers.
pub fn sheet(
    ui: &mut Ui,
    paper: Rect,
    spoken: String,
    still: &std::sync::Arc<Picture>,
    moving: &Picture,
    look: &Look,
) -> Sheet {
    let response = ui.allocate_rect(paper, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &spoken));
    let fit = canvas::fit(still, paper);
    let painter = ui.painter_at(paper.expand(1.0));
    canvas::paint_kept(&painter, still, paper, &fit, look);
    canvas::paint(&ui.painter_at(paper), moving, &fit, look);
    if still.in_metres {
        bar_at(ui, &painter, paper.left_bottom() + vec2(10.0, -8.0), fit.px_per_metre(), look);
    }
    let role = if response.has_focus() { Role::Focus } else { Role::Hairline };
    painter.rect_stroke(paper, 0.0, Stroke::new(1.0, look.colour(role)), StrokeKind::Inside);
    Sheet { response, paper, fit }
}
