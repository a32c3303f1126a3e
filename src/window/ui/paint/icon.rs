//! `Icon`, the drawn signs on buttons. Each button says its name on hover and to screen readers.

use bevy_egui::egui::{Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2};

use motion_lab_sim::manifest::Widget;

/// A sign on a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// A triangle that points ahead.
    Play,
    Pause,
    /// A triangle that points back to a bar.
    ToStart,
    /// A bar, and a triangle that points back.
    Back,
    /// A bar, and a triangle that points ahead.
    Step,
    /// A triangle that points ahead to a cross.
    NextContact,
    /// A closed way with an arrow.
    Loop,
    /// A way back to its beginning.
    Reset,
    Die,
    Undo,
    Redo,
    /// A round robot with a nose.
    Rover,
    /// The nearest points of a robot and an obstacle.
    Witness,
    /// A point in a square with a region that is blocked.
    Space,
    /// The plan of two rooms.
    Rooms,
    /// A way round an obstacle.
    Way,
}

impl Icon {
    /// The sign of a widget.
    pub const fn of(widget: Widget) -> Icon {
        match widget {
            Widget::Dashboard => Icon::Rover,
            Widget::Anatomy => Icon::Witness,
            Widget::Cspace => Icon::Space,
            Widget::Atlas => Icon::Rooms,
            Widget::Plan => Icon::Way,
        }
    }
}

/// Half the height of a sign, points.
const HALF: f32 = 6.0;

impl Icon {
    /// Paints the sign in the middle of `rect`.
    pub fn paint(self, painter: &Painter, rect: Rect, stroke: Stroke) {
        let c = rect.center();
        let at = |x: f32, y: f32| pos2(c.x + x * HALF, c.y + y * HALF);
        let bar = |x: f32| painter.line_segment([at(x, -1.0), at(x, 1.0)], stroke);
        // the point and the middle of the base of a triangle
        let triangle = |tip: f32, base: f32| {
            let corners = vec![at(tip, 0.0), at(base, 1.0), at(base, -1.0)];
            painter.add(Shape::convex_polygon(corners, stroke.color, Stroke::NONE));
        };
        match self {
            Icon::Play => triangle(1.1, -0.7),
            Icon::Pause => {
                for x in [-0.45, 0.45] {
                    painter.line_segment([at(x, -0.9), at(x, 0.9)], Stroke::new(2.5, stroke.color));
                }
            }
            Icon::ToStart => {
                bar(-1.1);
                triangle(-1.0, 0.3);
                triangle(0.0, 1.3);
            }
            Icon::Back => {
                triangle(-1.1, 0.4);
                bar(1.0);
            }
            Icon::Step => {
                bar(-1.0);
                triangle(1.1, -0.4);
            }
            Icon::NextContact => {
                triangle(0.1, -1.3);
                painter.line_segment([at(0.4, -0.6), at(1.6, 0.6)], stroke);
                painter.line_segment([at(0.4, 0.6), at(1.6, -0.6)], stroke);
            }
            Icon::Loop => {
                turn(painter, c, [-2.4, 0.5], stroke);
                turn(painter, c, [0.75, 3.65], stroke);
            }
            Icon::Reset => turn(painter, c, [4.2, -0.6], stroke),
            Icon::Die => {
                let half = vec2(HALF, HALF);
                painter.rect_stroke(Rect::from_min_max(c - half, c + half), 2.0, stroke, StrokeKind::Middle);
                for (x, y) in [(-0.5, -0.5), (0.0, 0.0), (0.5, 0.5)] {
                    painter.circle_filled(at(x, y), 1.2, stroke.color);
                }
            }
            Icon::Rover => {
                painter.circle_stroke(c, 1.15 * HALF, stroke);
                let nose = [(-0.5, -0.6), (0.95, 0.0), (-0.5, 0.6)].map(|(x, y)| at(x, y));
                painter.add(Shape::convex_polygon(nose.to_vec(), stroke.color, Stroke::NONE));
            }
            Icon::Witness => {
                painter.line_segment([at(1.3, -1.2), at(1.3, 1.2)], Stroke::new(2.0 * stroke.width, stroke.color));
                painter.circle_stroke(at(-1.0, 0.0), 0.4 * HALF, stroke);
                painter.line_segment([at(-0.6, 0.0), at(1.3, 0.0)], stroke);
            }
            Icon::Space => {
                let square = Rect::from_center_size(c, Vec2::splat(2.3 * HALF));
                painter.rect_stroke(square, 0.0, stroke, StrokeKind::Middle);
                let blocked = [(-1.15, 0.1), (-0.3, 0.4), (0.1, 1.15), (-1.15, 1.15)].map(|(x, y)| at(x, y));
                painter.add(Shape::convex_polygon(blocked.to_vec(), stroke.color, Stroke::NONE));
                painter.circle_filled(at(0.4, -0.4), 2.0, stroke.color);
            }
            Icon::Rooms => {
                let walls = [(-1.4, -1.1), (1.4, -1.1), (1.4, 1.1), (-1.4, 1.1), (-1.4, -1.1)].map(|(x, y)| at(x, y));
                painter.add(Shape::line(walls.to_vec(), stroke));
                painter.line_segment([at(0.1, -1.1), at(0.1, 0.2)], stroke);
                painter.line_segment([at(0.1, 0.2), at(0.7, 0.2)], stroke);
            }
            Icon::Way => {
                let way = [(-1.3, 0.9), (-0.7, -0.9), (0.6, -1.0), (1.3, 0.7)].map(|(x, y)| at(x, y));
                painter.add(Shape::line(way.to_vec(), stroke));
                way.into_iter().for_each(|corner| _ = painter.circle_filled(corner, 2.0, stroke.color));
                let post = Rect::from_center_size(at(0.0, 0.6), Vec2::splat(0.8 * HALF));
                painter.rect_stroke(post, 0.0, stroke, StrokeKind::Middle);
            }
            Icon::Undo => turn(painter, c, [0.9, -2.7], stroke),
            Icon::Redo => turn(painter, c, [2.2, 5.8], stroke),
        }
    }
}

/// Paints an arc about `centre` from one angle to another, radians clockwise from the right, with an arrowhead at its
/// end.
fn turn(painter: &Painter, centre: Pos2, [from, to]: [f32; 2], stroke: Stroke) {
    const PIECES: u16 = 16;
    let on = |angle: f32| centre + HALF * Vec2::angled(angle);
    let angle = |k: u16| from + (to - from) * f32::from(k) / f32::from(PIECES);
    painter.line((0..=PIECES).map(|k| on(angle(k))).collect(), stroke);
    let ahead = (to - from).signum() * Vec2::angled(to).rot90();
    let (end, out) = (on(to), Vec2::angled(to));
    let head = vec![end + 3.6 * ahead, end + 3.0 * out, end - 3.0 * out];
    painter.add(Shape::convex_polygon(head, stroke.color, Stroke::NONE));
}
