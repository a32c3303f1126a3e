//! The canvas: paints a picture with egui's painter, in screen points.

use std::sync::Arc;

use bevy_egui::egui::{
    Align2, Color32, FontFamily, FontId, Id, LayerId, Mesh, Order, Painter, Pos2, Rect, Shape, Stroke, Vec2,
    epaint::{ClippedShape, PathShape, Primitive as Primitive2},
    pos2,
};

use super::coarse::coarse;
use crate::window::ui::FrameColours;
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
pub fn paint(painter: &Painter, picture: &Picture, fit: &Fit, look: &FrameColours) {
    for primitive in picture.items.iter().flat_map(|item| resolve(item, fit)) {
        paint_primitive(painter, &primitive, look);
    }
}

/// As [`paint`], for still pictures: horizontal and vertical edges move to the pixels, by half a pixel at most, so that
/// all are equally crisp.
pub fn paint_still(painter: &Painter, picture: &Picture, fit: &Fit, look: &FrameColours) {
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
pub fn paint_cached(painter: &Painter, picture: &Arc<Picture>, rect: Rect, fit: &Fit, look: &FrameColours) {
    let ctx = painter.ctx();
    // the rounded corners and dots of a mesh lie in the font's texture
    let atlas = ctx.fonts(|f| f.font_image_size());
    let key = (fit.px_per_metre().to_bits(), look.key(), ctx.pixels_per_point().to_bits(), atlas);
    let id = Id::new(("kept", &picture.name, rect.min.x as i32, rect.min.y as i32));
    let origin = pos(&fit.screen_from_world(Point2::origin()));
    let kept: Option<CachedShapes> = ctx.data(|d| d.get_temp(id));
    let serves = |k: &CachedShapes| {
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
        CachedShapes { key, picture: Arc::clone(picture), covers, origin, mesh: Arc::new(mesh) }
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
type CacheKey = (u64, (Theme, Option<Role>, u32), u32, [usize; 2]);

#[derive(Clone)]
struct CachedShapes {
    key: CacheKey,
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

fn paint_primitive(painter: &Painter, primitive: &Primitive, look: &FrameColours) {
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

fn stroke(role: Role, line: &Line, look: &FrameColours) -> Stroke {
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
mod tests;
