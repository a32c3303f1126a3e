//! A sheet: one picture on a paper that the pointer can act on.

use bevy_egui::egui::{
    Align, Id, Layout, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType,
    pos2, vec2,
};

use super::canvas;
use super::scale_bar::bar_at;
use crate::window::ui::FrameColours;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::{Fit, Picture, Role, pick};

/// A sheet as shown in this frame.
pub struct ScreenSheet {
    /// The pointer's actions on the paper.
    pub response: Response,
    /// The rectangle of the paper.
    pub paper: Rect,
    /// The fit of the picture into it.
    pub fit: Fit,
}

impl ScreenSheet {
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

impl ScreenSheet {
    /// The role of the part of a picture that the pointer is on; `None` where it is on none, or off the paper.
    pub fn pointed_at(&self, picture: &Picture) -> Option<Role> {
        let at = self.response.hover_pos()?;
        pick(picture, &self.fit, [f64::from(at.x), f64::from(at.y)], 3.0).map(|item| item.role)
    }
}

/// Share of the height for the paper where its panel is under it.
const ABOVE: f32 = 0.6;

/// Height of the margin under a picture, and width of the one left of it, from which a scale bar with its plate fits
/// into it, points.
const UNDER: f32 = 22.0;
const LEFT: f32 = 140.0;

/// Width of the panel beside a paper in a low room, at least, points.
const MIN_BESIDE: f32 = 200.0;

/// Largest share of the width that the chart takes beside the panel.
const CHART_BESIDE: f32 = 0.5;

/// Side of a chart that is worth its room, at least, points.
const LEAST_CHART: f32 = 150.0;

/// Width from which on the chart lies beside the panel, points.
const WIDE: f32 = 600.0;

/// Splits the room into a widget's paper, on which `still` is shown, and the panel beside it, `width` points wide. On a
/// narrow screen and in a room that is taller than wide the panel is under the paper.
pub fn split(still: &Picture, room: Rect, look: &FrameColours, width: f32) -> (Rect, Rect) {
    if look.low {
        let paper = canvas::proportioned(still, room.with_max_x(room.right() - MIN_BESIDE - 12.0));
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

/// Splits the room beside the workspace into that of its chart, where it has one, and that of the panel. `still` is the
/// chart, once it is known, and `above` the largest share of the height that it takes where it lies above the panel. In
/// a low room it lies under the workspace, whose `paper` leaves room there.
pub fn split_chart(
    paper: Rect,
    beside: Rect,
    still: Option<&Picture>,
    above: f32,
    look: &FrameColours,
) -> (Option<Rect>, Rect) {
    if look.low {
        let under = Rect::from_min_max(paper.left_bottom() + vec2(0.0, 8.0), pos2(paper.right(), beside.bottom()));
        let square = Rect::from_min_size(under.min, Vec2::splat(under.size().min_elem()));
        let chart = still.map_or(square, |still| canvas::proportioned(still, under));
        return (Some(chart).filter(|_| under.height() >= LEAST_CHART), beside);
    }
    let is_beside = beside.width() >= WIDE;
    let most = if is_beside {
        vec2(CHART_BESIDE * beside.width(), beside.height())
    } else {
        vec2(beside.width(), above * beside.height())
    };
    let square = Rect::from_min_size(beside.min, Vec2::splat(most.min_elem()));
    let chart = still.map_or(square, |still| canvas::proportioned(still, Rect::from_min_size(beside.min, most)));
    if look.narrow || most.min_elem() < LEAST_CHART {
        return (None, beside);
    }
    if is_beside {
        return (Some(chart), beside.with_min_x(chart.right() + 20.0));
    }
    let middle = chart.translate(vec2(0.5 * (beside.width() - chart.width()), 0.0));
    (Some(middle), beside.with_min_y(chart.bottom() + 8.0))
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

/// Shows what `add` shows in a room at least `least` points high, and as high as it ever was at this width: what stands
/// under it stays under the pointer as words come and go. `of` names the room.
pub fn steady<R>(ui: &mut Ui, of: &str, least: f32, add: impl FnOnce(&mut Ui) -> R) -> R {
    let (id, width) = (Id::new(("steady room", of)), ui.available_width() as u32);
    let known: Option<(u32, f32)> = ui.data(|data| data.get_temp(id));
    let least = known.filter(|(of, _)| *of == width).map_or(least, |(_, height)| height.max(least));
    let shown = ui.scope(|ui| {
        ui.set_min_height(least);
        add(ui)
    });
    ui.data_mut(|data| data.insert_temp(id, (width, shown.response.rect.height())));
    shown.inner
}

/// Where the lower left end of a sheet's scale bar lies: in the margin of the picture; where that has no room for it,
/// within the picture, off the wall at its edge.
fn bar_corner(still: &Picture, paper: Rect, fit: &Fit) -> Pos2 {
    let [left, foot] = fit.screen_from_world(still.bounds.min).map(|v| v as f32);
    let has_room = paper.bottom() - foot >= UNDER || left - paper.left() >= LEFT;
    let corner = if has_room { paper.left_bottom() } else { pos2(left, foot) };
    corner + vec2(10.0, -8.0)
}

/// Shows `still`, which is kept from frame to frame, and `moving` over it, with a scale.
///
/// `spoken` describes both for screen readers.
pub fn sheet(
    ui: &mut Ui,
    paper: Rect,
    spoken: String,
    still: &std::sync::Arc<Picture>,
    moving: &Picture,
    look: &FrameColours,
) -> ScreenSheet {
    let on = unscaled_sheet(ui, paper, spoken, still, moving, look);
    if still.in_metres {
        bar_at(ui, &ui.painter_at(paper), bar_corner(still, paper, &on.fit), on.fit.px_per_metre(), look);
    }
    on
}

/// As [`sheet`], for one beside another of the same world: without a scale.
pub fn unscaled_sheet(
    ui: &mut Ui,
    paper: Rect,
    spoken: String,
    still: &std::sync::Arc<Picture>,
    moving: &Picture,
    look: &FrameColours,
) -> ScreenSheet {
    let response = ui.allocate_rect(paper, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &spoken));
    let fit = canvas::fit(still, paper);
    let painter = ui.painter_at(paper.expand(1.0));
    canvas::paint_cached(&painter, still, paper, &fit, look);
    canvas::paint(&ui.painter_at(paper), moving, &fit, look);
    let role = if response.has_focus() { Role::Focus } else { Role::Hairline };
    painter.rect_stroke(paper, 0.0, Stroke::new(1.0, look.colour(role)), StrokeKind::Inside);
    ScreenSheet { response, paper, fit }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use bevy_egui::egui::{Context, RawInput, Shape};

    use super::*;
    use motion_lab_core::geometry::Aabb;
    use motion_lab_core::picture::Theme;

    #[test]
    fn the_plate_of_the_scale_lies_on_no_wall_at_the_edge() {
        let bounds = Aabb::new(Point2::new(-1.0, -2.0), Point2::new(11.0, 6.0));
        let still = Arc::new(Picture::new("Yard", bounds));
        let look = FrameColours::from(Theme::Light);
        // as high as the picture, a little higher, much higher, a little wider, and much wider
        for size in [[616.0, 416.0], [616.0, 430.0], [616.0, 600.0], [750.0, 416.0], [900.0, 416.0]] {
            let paper = Rect::from_min_size(pos2(20.0, 30.0), size.into());
            let mut output = Context::default().run_ui(RawInput::default(), |ui| {
                let none = Picture::new("nothing", bounds);
                sheet(ui, paper, "a yard".to_owned(), &still, &none, &look);
            });
            output.textures_delta.clear();
            let fill = look.tint(Role::Paper, 0.85);
            let plate = output.shapes.iter().find_map(|clipped| match &clipped.shape {
                Shape::Rect(rect) if rect.fill == fill => Some(rect.rect),
                _ => None,
            });
            let plate = plate.expect("a plate");
            let fit = canvas::fit(&still, paper);
            let corner = |p| fit.screen_from_world(p).map(|v| v as f32);
            let world = Rect::from_two_pos(corner(bounds.min).into(), corner(bounds.max).into());
            // a wall is two points wide
            let is_off = world.shrink(1.0).contains_rect(plate) || !world.expand(1.0).intersects(plate);
            assert!(is_off && paper.contains_rect(plate), "{size:?}: {plate} and {world}");
        }
    }

    #[test]
    fn what_stands_under_words_that_come_and_go_stays() {
        let context = Context::default();
        let under = |rows: usize, width: f32| {
            let mut top = 0.0;
            let mut output = context.run_ui(RawInput::default(), |ui| {
                ui.set_max_width(width);
                steady(ui, "verdict", 20.0, |ui| (0..rows).for_each(|_| _ = ui.label("words")));
                top = ui.cursor().top();
            });
            output.textures_delta.clear();
            top
        };
        let (none, four) = (under(0, 300.0), under(4, 300.0));
        assert!(four > none + 20.0, "four rows are higher than the least room: {none} {four}");
        assert_eq!([under(1, 300.0), under(0, 300.0)], [four; 2]);
        assert_eq!(under(0, 200.0), none, "another width has another room");
    }
}
