//! The canvas: paints a picture with egui's painter, in screen points.

use std::sync::Arc;

use bevy_egui::egui::{
    Align2, Color32, FontFamily, FontId, Id, LayerId, Mesh, Order, Painter, Pos2, Rect, Shape, Stroke, Vec2,
    epaint::{ClippedShape, PathShape, Primitive as Primitive2},
    pos2,
};

use super::coarse::coarse;
use crate::window::ui::Look;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::picture::{
    Anchor, Dash, Face, Fit, Item, Line, Picture, Primitive, Role, ScreenPoint, ScreenRect, Theme, resolve,
};

/// Free room between a picture and its frame, points.
pub const MARGIN: f32 = 8.0;

/// How a picture lies in a rectangle of the screen.
pub fn fit(picture: &Picture, rect: Rect) -> Fit {
    Fit::new(&picture.bounds, screen_rect(rect), f64::from(MARGIN))
}

/// The part of `room`, from its upper left corner on, that has the picture's proportions.
pub fn proportioned(picture: &Picture, room: Rect) -> Rect {
    let Aabb { min, max } = picture.bounds;
    let own = Vec2::new((max.x - min.x) as f32, (max.y - min.y) as f32);
    let inner = (room.size() - Vec2::splat(2.0 * MARGIN)).max(Vec2::splat(1.0));
    let scale = (inner.x / own.x).min(inner.y / own.y);
    let size = if scale.is_finite() { own * scale } else { inner };
    Rect::from_min_size(room.min, size + Vec2::splat(2.0 * MARGIN))
}

/// Paints the picture's items, the first below all others.
pub fn paint(painter: &Painter, picture: &Picture, fit: &Fit, look: &Look) {
    for primitive in picture.items.iter().flat_map(|item| resolve(item, fit)) {
        paint_primitive(painter, &primitive, look);
    }
}

/// As [`paint`], for still pictures: horizontal and vertical edges move to the pixels, by half a pixel at most, so that
/// all are equally crisp.
pub fn paint_still(painter: &Painter, picture: &Picture, fit: &Fit, look: &Look) {
    let scale = f64::from(painter.pixels_per_point());
    for mut primitive in picture.items.iter().flat_map(|item| resolve(item, fit)) {
        match &mut primitive {
            Primitive::Area { corners, role, opacity } => {
                corners.extend(corners.first().copied());
                snap(corners, scale, 0.0);
                corners.pop();
                if let Some(rect) = level(corners) {
                    // its edges lie on the pixels, where a fade would have no pixel
                    let mut mesh = Mesh::default();
                    mesh.add_colored_rect(rect, look.tint(*role, *opacity));
                    painter.add(mesh);
                    continue;
                }
            }
            Primitive::Lines { lines, line, .. } => {
                // a line that is an odd number of pixels wide is centred on the middle of a pixel
                let odd = ((line.width_px * scale).floor() % 2.0) * 0.5;
                lines.iter_mut().for_each(|points| snap(points, scale, odd));
            }
            _ => {}
        }
        paint_primitive(painter, &primitive, look);
    }
}

/// Moves the horizontal and vertical segments of a line to the pixel grid, shifted by `offset` pixels.
fn snap(points: &mut [ScreenPoint], scale: f64, offset: f64) {
    for axis in [0, 1] {
        let snapped = |v: f64| ((v * scale - offset).round() + offset) / scale;
        let aligned: Vec<bool> = points.windows(2).map(|w| (w[0][axis] - w[1][axis]).abs() < 1e-6).collect();
        for (i, point) in points.iter_mut().enumerate() {
            let beside = [i.checked_sub(1), Some(i)];
            if beside.into_iter().flatten().any(|edge| aligned.get(edge) == Some(&true)) {
                point[axis] = snapped(point[axis]);
            }
        }
        // the two ends of a closed line are one corner
        if let [first, .., last] = points
            && (first[axis] - last[axis]).abs() < 1.0
            && (first[1 - axis] - last[1 - axis]).abs() < 1.0
        {
            let end = if aligned.first() == Some(&true) { first[axis] } else { last[axis] };
            (first[axis], last[axis]) = (end, end);
        }
    }
}

/// As [`paint_still`], into `rect`, with a mesh kept from frame to frame.
///
/// The picture is resolved and tessellated again only when the picture, the look or the scale changes, or when the view
/// leaves what the mesh covers: the view and half as much again on each side.
pub fn paint_kept(painter: &Painter, picture: &Arc<Picture>, rect: Rect, fit: &Fit, look: &Look) {
    let ctx = painter.ctx();
    // the rounded corners and dots of a mesh lie in the font's texture
    let atlas = ctx.fonts(|f| f.font_image_size());
    let key = (fit.px_per_metre().to_bits(), look.key(), ctx.pixels_per_point().to_bits(), atlas);
    let id = Id::new(("kept", &picture.name, rect.min.x as i32, rect.min.y as i32));
    let origin = pos(&fit.screen_from_world(Point2::origin()));
    let kept: Option<Kept> = ctx.data(|d| d.get_temp(id));
    let serves = |k: &Kept| {
        k.key == key && Arc::ptr_eq(&k.picture, picture) && k.covers.contains_rect(rect.translate(k.origin - origin))
    };
    let mut kept = kept.filter(serves).unwrap_or_else(|| {
        let covers = rect.expand2(0.5 * rect.size());
        let mut aside = painter.clone().with_layer_id(LayerId::new(Order::Background, id));
        // beyond what the painter shows, too
        aside.set_clip_rect(covers);
        // lines and marks reach a few points farther than what they show
        let covered = fit.shown_in(screen_rect(covers)).grown(16.0 / fit.px_per_metre());
        let is_near = |item: &&Item| item.drawing.bounds().is_none_or(|b| !b.is_apart(&covered));
        let items: Vec<Item> = picture.items.iter().filter(is_near).cloned().map(|item| coarse(item, fit)).collect();
        let near = Picture::new(&picture.name, picture.bounds).with(items);
        paint_still(&aside, &near, fit, look);
        let shapes = ctx.graphics_mut(|layers| layers.get_mut(aside.layer_id()).map(std::mem::take));
        let shapes: Vec<ClippedShape> = shapes.iter().flat_map(|list| list.all_entries().cloned()).collect();
        let mut mesh = Mesh::default();
        for primitive in ctx.tessellate(shapes, ctx.pixels_per_point()) {
            if let Primitive2::Mesh(piece) = primitive.primitive {
                mesh.append(piece);
            }
        }
        Kept { key, picture: Arc::clone(picture), covers, origin, mesh: Arc::new(mesh) }
    });
    let moved = origin - kept.origin;
    if moved != Vec2::ZERO {
        // the vertices are moved in place: only this frame's shapes and the kept mesh hold them
        Arc::make_mut(&mut kept.mesh).translate(moved);
        (kept.covers, kept.origin) = (kept.covers.translate(moved), origin);
    }
    painter.add(Shape::Mesh(Arc::clone(&kept.mesh)));
    ctx.data_mut(|d| d.insert_temp(id, kept));
}

/// The rectangle with these four corners in order, if its sides are level and upright.
fn level(corners: &[ScreenPoint]) -> Option<Rect> {
    let [a, b, c, d] = corners else { return None };
    let is_level = (a[1] == b[1] && b[0] == c[0] && c[1] == d[1] && d[0] == a[0])
        || (a[0] == b[0] && b[1] == c[1] && c[0] == d[0] && d[1] == a[1]);
    is_level.then(|| Rect::from_two_pos(pos(a), pos(c)))
}

fn screen_rect(rect: Rect) -> ScreenRect {
    let (min, size) = (rect.min, rect.size());
    ScreenRect { min: [f64::from(min.x), f64::from(min.y)], size: [f64::from(size.x), f64::from(size.y)] }
}

/// What a kept mesh depends on beside its picture and its place: the scale, how it looks, the pixels of a point, and
/// the texture it refers to.
type KeptKey = (u64, (Theme, Option<Role>, u32), u32, [usize; 2]);

#[derive(Clone)]
struct Kept {
    key: KeptKey,
    picture: Arc<Picture>,
    /// The part of the screen that the mesh covers.
    covers: Rect,
    /// Where the world's origin lies on the screen.
    origin: Pos2,
    mesh: Arc<Mesh>,
}

/// Distance below which two points count as one, screen points. egui has no direction for a line between such points
/// and gives corners that are no numbers.
const SAME: f32 = 1e-2;

fn same(a: Pos2, b: Pos2) -> bool {
    (a - b).length() < SAME
}

/// Whether a line through these points turns so far back at the second, by more than 151 degrees, that the mitre of its
/// corner would be a spike. Straight back, egui has no direction for the corner at all.
fn turns_back(a: Pos2, b: Pos2, c: Pos2) -> bool {
    ((b - a).normalized() + (c - b).normalized()).length() < 0.5
}

/// The points without those that repeat the one before.
fn distinct(points: &[ScreenPoint]) -> Vec<Pos2> {
    let mut path: Vec<Pos2> = points.iter().map(pos).collect();
    path.dedup_by(|b, a| same(*a, *b));
    path
}

fn pos(p: &ScreenPoint) -> Pos2 {
    pos2(p[0] as f32, p[1] as f32)
}

fn paint_primitive(painter: &Painter, primitive: &Primitive, look: &Look) {
    match primitive {
        Primitive::Area { corners, role, opacity } => {
            let mut corners = distinct(corners);
            if corners.len() > 1 && same(corners[0], corners[corners.len() - 1]) {
                corners.pop();
            }
            if corners.len() > 2 {
                painter.add(Shape::convex_polygon(corners, look.tint(*role, *opacity), Stroke::NONE));
            }
        }
        Primitive::Dots { centres, radius, role, opacity } => {
            let colour = look.tint(*role, *opacity);
            painter.extend(centres.iter().map(|c| Shape::circle_filled(pos(c), *radius as f32, colour)));
        }
        Primitive::Circle { centre, radius, role, line } => {
            painter.circle_stroke(pos(centre), *radius as f32, stroke(*role, line, look));
        }
        Primitive::Lines { lines, role, line } => {
            for points in lines {
                paint_line(painter, points, stroke(*role, line, look), line.dash);
            }
        }
        Primitive::Text { at, anchor, text, face, size, role, plate } => {
            let family = match face {
                Face::Sans => FontFamily::Proportional,
                Face::Mono => FontFamily::Monospace,
            };
            let galley = painter.layout_no_wrap(text.clone(), FontId::new(*size as f32, family), look.colour(*role));
            let align = match anchor {
                Anchor::Centre => Align2::CENTER_CENTER,
                Anchor::Right => Align2::LEFT_CENTER,
                Anchor::Left => Align2::RIGHT_CENTER,
                Anchor::Above => Align2::CENTER_BOTTOM,
                Anchor::Below => Align2::CENTER_TOP,
            };
            let mut rect = align.anchor_size(pos(at), galley.size());
            if *plate {
                // the name of what is on the paper stays on it
                let paper = painter.clip_rect();
                if paper.contains(pos(at)) {
                    rect = rect.translate(way_into(paper.shrink(4.0), rect));
                }
                painter.rect_filled(rect.expand2([3.0, 1.0].into()), 0.0, look.tint(Role::Paper, 0.85));
            }
            painter.galley(rect.min, galley, Color32::PLACEHOLDER);
        }
    }
}

/// The way by which `rect` comes to lie in `room`; where it is larger, its upper left corner.
fn way_into(room: Rect, rect: Rect) -> Vec2 {
    (room.max - rect.max).min(Vec2::ZERO).max(room.min - rect.min)
}

fn stroke(role: Role, line: &Line, look: &Look) -> Stroke {
    Stroke::new(line.width_px as f32, look.tint(role, line.opacity))
}

fn paint_line(painter: &Painter, points: &[ScreenPoint], stroke: Stroke, dash: Dash) {
    let mut path = distinct(points);
    if path.len() < 2 {
        return;
    }
    if let Some((on, off)) = dash.pattern_px() {
        painter.extend(Shape::dashed_line(&path, stroke, on as f32, off as f32));
        return;
    }
    let turns = path.windows(3).any(|w| turns_back(w[0], w[1], w[2]));
    let closed = !turns && path.len() > 3 && same(path[0], path[path.len() - 1]);
    if closed {
        path.pop();
        painter.add(PathShape::closed_line(path, stroke));
        return;
    }
    // where the line turns back, a new one begins
    let mut from = 0;
    for i in 1..path.len().saturating_sub(1) {
        if turns_back(path[i - 1], path[i], path[i + 1]) {
            painter.line(path[from..=i].to_vec(), stroke);
            from = i;
        }
    }
    painter.line(path[from..].to_vec(), stroke);
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::{Context, RawInput};

    use super::*;
    use motion_lab_core::picture::{Drawing, Fill};

    /// The corners of the mesh that a picture is painted with, those in `rect`, to a hundredth of a point.
    fn painted(ctx: &Context, picture: &Arc<Picture>, rect: Rect, fit: &Fit) -> Vec<[i32; 2]> {
        let mut output = ctx.run_ui(RawInput::default(), |ui| {
            // as the widgets do, by a painter that shows the paper alone
            paint_kept(&ui.painter_at(rect), picture, rect, fit, &Look::from(Theme::Light));
        });
        output.textures_delta.clear();
        let meshes = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
            Shape::Mesh(mesh) => Some(Arc::clone(mesh)),
            _ => None,
        });
        let corners = meshes.flat_map(|mesh| mesh.vertices.iter().map(|v| v.pos).collect::<Vec<_>>());
        let in_view = corners.filter(|p| rect.contains(*p));
        let mut found: Vec<[i32; 2]> = in_view.map(|p| [p.x, p.y].map(|v| (100.0 * v).round() as i32)).collect();
        found.sort_unstable();
        found
    }

    #[test]
    fn a_kept_picture_is_where_a_new_one_would_be() {
        let p = Point2::new;
        let boxes = (0..40).map(|i| {
            let (x, y) = (f64::from(i % 8) * 10.0, f64::from(i / 8) * 10.0);
            let corners = vec![p(x, y), p(x + 4.0, y), p(x + 4.0, y + 3.0), p(x, y + 3.0)];
            Item::new(format!("{i}"), "a box", Role::Obstacle, Drawing::Polygon(corners)).filled(Fill::Tint(1.0))
        });
        let picture = Arc::new(Picture::new("Yard", Aabb::new(p(0.0, 0.0), p(80.0, 50.0))).with(boxes));
        let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(200.0, 100.0));
        let whole = fit(&picture, rect);
        let kept = Context::default();
        let mut seen = 0;
        // a step within what is kept, one out of it, and back; then larger, and another picture
        let views = [(40.0, 25.0, 4.0), (53.0, 22.0, 4.0), (70.0, 40.0, 4.0), (40.0, 25.0, 4.0), (40.0, 25.0, 6.0)];
        for (x, y, zoom) in views {
            let fit = whole.magnified(p(x, y), zoom).on_pixels(1.0);
            let now = painted(&kept, &picture, rect, &fit);
            assert_eq!(now, painted(&Context::default(), &picture, rect, &fit), "{x} {y} {zoom}");
            seen += now.len();
        }
        assert!(seen > 50, "{seen}");
    }

    #[test]
    fn a_paper_has_its_worlds_proportions() {
        let p = Point2::new;
        let picture = |w, h| Picture::new("a", Aabb::new(p(1.0, 2.0), p(1.0 + w, 2.0 + h)));
        let room = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(416.0, 216.0));
        // 400 by 200 points within the margin of 8: a square is as high as the room, a strip as wide
        assert_eq!(proportioned(&picture(5.0, 5.0), room).size(), Vec2::new(216.0, 216.0));
        assert_eq!(proportioned(&picture(8.0, 1.0), room).size(), Vec2::new(416.0, 66.0));
        assert_eq!(proportioned(&picture(8.0, 1.0), room).min, room.min);
        let tiny = proportioned(&picture(8.0, 1.0), Rect::from_min_size(pos2(0.0, 0.0), Vec2::splat(1.0)));
        assert!(tiny.width() > 0.0 && tiny.height() > 0.0, "{tiny:?}");
    }

    #[test]
    fn a_level_rectangle_is_four_corners_and_a_slanted_one_keeps_its_fade() {
        let p = Point2::new;
        let picture = |corners: Vec<Point2>| {
            let item = Item::new("a", "a", Role::Obstacle, Drawing::Polygon(corners)).filled(Fill::Tint(0.6));
            Arc::new(Picture::new("A", Aabb::new(p(0.0, 0.0), p(10.0, 10.0))).with([item]))
        };
        let rect = Rect::from_min_size(pos2(0.0, 0.0), Vec2::splat(116.0));
        let corners = |picture: &Arc<Picture>| {
            let mut all = painted(&Context::default(), picture, rect, &fit(picture, rect));
            all.dedup();
            all
        };
        // 10 m are 100 points within the margin of 8; upward on paper is downward on the screen
        let level = [p(1.0, 2.0), p(4.0, 2.0), p(4.0, 7.0), p(1.0, 7.0)];
        let found = [[1800, 3800], [1800, 8800], [4800, 3800], [4800, 8800]];
        for turned in 0..4 {
            let mut corners_of = level.to_vec();
            corners_of.rotate_left(turned);
            assert_eq!(corners(&picture(corners_of.clone())), found);
            corners_of.reverse();
            assert_eq!(corners(&picture(corners_of)), found);
        }
        let slanted = vec![p(1.0, 2.0), p(4.0, 2.5), p(4.0, 7.0), p(1.0, 7.0)];
        assert_eq!(corners(&picture(slanted)).len(), 8);
    }

    #[test]
    fn a_line_that_turns_back_has_no_spike() {
        let ctx = Context::default();
        for off in [0.0, 0.01, 0.1, 1.0, 3.0, 10.0] {
            let line = [[10.0, 50.0], [60.0, 50.0], [10.0, 50.0 + off]];
            let stroke = Stroke::new(2.0, Look::from(Theme::Light).colour(Role::Text));
            let mut output = ctx.run_ui(RawInput::default(), |ui| paint_line(ui.painter(), &line, stroke, Dash::Solid));
            output.textures_delta.clear();
            let drawn = ctx.tessellate(output.shapes, 1.0).into_iter().flat_map(|clipped| match clipped.primitive {
                bevy_egui::egui::epaint::Primitive::Mesh(mesh) => mesh.vertices,
                bevy_egui::egui::epaint::Primitive::Callback(_) => Vec::new(),
            });
            let farthest = drawn.map(|v| v.pos.x).fold(0.0, f32::max);
            // half the width and the feathering are 1.5 points, and a mitre may be some times as long
            assert!((60.0..75.0).contains(&farthest), "{off}: {farthest}");
        }
    }

    #[test]
    fn level_and_upright_edges_go_to_the_pixels_and_slanted_ones_stay() {
        let mut square = [[0.3, 0.4], [10.3, 0.4], [10.3, 10.4], [0.3, 10.4], [0.3, 0.4]];
        snap(&mut square, 1.0, 0.0);
        assert_eq!(square, [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]]);
        let mut upright = [[7.9, 0.4], [7.9, 5.2]];
        snap(&mut upright, 1.0, 0.5);
        assert_eq!(upright, [[7.5, 0.4], [7.5, 5.2]], "its ends stay");
        let slanted = [[0.3, 0.4], [5.2, 3.3], [9.1, 0.2]];
        let mut same = slanted;
        snap(&mut same, 2.0, 0.5);
        assert_eq!(same, slanted);
    }
}
