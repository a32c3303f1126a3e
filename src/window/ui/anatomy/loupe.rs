//! The loupe: the surroundings of the nearest points enlarged, in a corner of the workspace, while they are too close
//! together to be told apart. A frame shows where it looks.

use bevy_egui::egui::{Pos2, Rect, Stroke, StrokeKind, Ui, Vec2, pos2};

use crate::window::ui::FrameColours;
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::sheet::ScreenSheet;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::Role;
use motion_lab_core::robots::Robot;
use motion_lab_sim::anatomy::Anatomy;

/// Side of the loupe, points, and its distance from the edges of the paper.
const SIDE: f32 = 168.0;
const OFF: f32 = 8.0;

/// Largest share of the paper's shorter side that it may take.
const SHARE: f32 = 0.4;

/// Distance of the nearest points on the screen from which on nothing needs to be enlarged, points.
const CLOSE: f64 = 30.0;

/// Shows the loupe over the workspace.
pub fn loupe(ui: &Ui, on: &ScreenSheet, anatomy: &Anatomy, look: &FrameColours) {
    let dist = anatomy.nearest().first().map(|pair| pair.witness.dist);
    if !dist.is_some_and(|dist| dist * on.fit.px_per_metre() < CLOSE) {
        return;
    }
    let Some(close) = anatomy.close_up() else { return };
    let footprint = anatomy.checker().robot().footprint(&anatomy.q());
    let at = |p: Point2| Pos2::from(on.fit.screen_from_world(p).map(|v| v as f32));
    let taken: Vec<Rect> = footprint
        .parts()
        .iter()
        .map(|part| part.placed().bounds())
        .map(|bounds| Rect::from_two_pos(at(bounds.min), at(bounds.max)))
        .collect();
    let side = SIDE.min(SHARE * on.paper.width().min(on.paper.height()));
    let Some(rect) = free_corner(on.paper.shrink(OFF), side, &taken) else { return };
    let line = Stroke::new(1.0, look.colour(Role::Muted));
    let there = Rect::from_two_pos(at(close.bounds.min), at(close.bounds.max));
    ui.painter_at(on.paper).rect_stroke(there, 0.0, line, StrokeKind::Outside);
    let painter = ui.painter_at(rect.expand(1.0));
    painter.rect_filled(rect, 0.0, look.colour(Role::Paper));
    canvas::paint(&ui.painter_at(rect), &close, &canvas::fit(&close, rect), look);
    painter.rect_stroke(rect, 0.0, line, StrokeKind::Inside);
}

/// The first corner of a room, that of the scale bar aside, where a square of this side covers nothing that is taken.
fn free_corner(room: Rect, side: f32, taken: &[Rect]) -> Option<Rect> {
    let (right, bottom) = (room.right() - side, room.bottom() - side);
    let corners = [pos2(right, bottom), pos2(right, room.top()), room.min];
    let squares = corners.map(|corner| Rect::from_min_size(corner, Vec2::splat(side)));
    squares.into_iter().find(|square| taken.iter().all(|taken| !taken.intersects(*square)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loupe_covers_nothing_of_the_robot() {
        let room = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 300.0));
        let at = |taken: &[[f32; 4]]| {
            let taken: Vec<Rect> =
                taken.iter().map(|[l, t, r, b]| Rect::from_min_max(pos2(*l, *t), pos2(*r, *b))).collect();
            free_corner(room, 100.0, &taken).map(|rect| (rect.left(), rect.top()))
        };
        let (low_right, high_right, high_left) = ([350.0, 250.0, 360.0, 260.0], [310.0, 0.0, 320.0, 9.0], [0.0; 4]);
        assert_eq!(at(&[]), Some((300.0, 200.0)));
        assert_eq!(at(&[low_right]), Some((300.0, 0.0)));
        assert_eq!(at(&[low_right, high_right]), Some((0.0, 0.0)));
        assert_eq!(at(&[low_right, high_right, high_left]), None);
        assert_eq!(at(&[[299.0, 10.0, 299.5, 290.0]]), Some((300.0, 200.0)), "beside it");
    }
}
