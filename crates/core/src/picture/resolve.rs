//! Turns items in metres into lines and areas in pixels, which every medium draws stroke for stroke.

use super::hatch::{dots, hatch};
use super::outline::polygon_of;
use super::robot::nose;
use super::{Anchor, Drawing, Face, Fill, Fit, Glyph, Item, Line, Role, ScreenPoint};
use crate::geometry::{Point2, Pose2, Shape};
use crate::num;

/// The opacity of the tint under a hatch, and under dots.
pub(super) const TINT: f64 = 0.12;

/// The opacity of the lines of a hatch: an obstacle's stand out from the tint by 3:1.
pub(super) const HATCH_OPACITY: f64 = 0.7;

/// One stroke, area or word on the screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    /// A filled convex polygon.
    Area {
        /// Its corners.
        corners: Vec<ScreenPoint>,
        /// What it stands for.
        role: Role,
        /// Its opacity.
        opacity: f64,
    },
    /// Filled discs of one size.
    Dots {
        /// Their centres.
        centres: Vec<ScreenPoint>,
        /// Their radius.
        radius: f64,
        /// What they stand for.
        role: Role,
        /// Their opacity.
        opacity: f64,
    },
    /// A circle's line.
    Circle {
        /// Its centre.
        centre: ScreenPoint,
        /// Its radius.
        radius: f64,
        /// What it stands for.
        role: Role,
        /// Its line.
        line: Line,
    },
    /// Lines of one kind. One that ends where it starts is closed.
    Lines {
        /// The points of each.
        lines: Vec<Vec<ScreenPoint>>,
        /// What they stand for.
        role: Role,
        /// Their kind.
        line: Line,
    },
    /// Words.
    Text {
        /// The middle of the side that faces what they name, already moved off it.
        at: ScreenPoint,
        /// The side of the named point on which they stand.
        anchor: Anchor,
        /// The words.
        text: String,
        /// The face.
        face: Face,
        /// Height of the face.
        size: f64,
        /// What they stand for.
        role: Role,
        /// Whether they stand on a plate of paper.
        plate: bool,
    },
}

/// The primitives of an item, lowest first. A primitive that is not finite is left out.
pub fn resolve(item: &Item, fit: &Fit) -> Vec<Primitive> {
    let mut out = Vec::new();
    let px = |p: &Point2| fit.screen_from_world(*p);
    let closed = |mut corners: Vec<ScreenPoint>| {
        corners.extend(corners.first().copied());
        corners
    };
    let Item { role, fill, line, .. } = item;
    match &item.drawing {
        Drawing::Polyline(points) => stroke(&mut out, *role, *line, vec![points.iter().map(px).collect()]),
        Drawing::Polygon(points) => {
            let corners: Vec<_> = points.iter().map(px).collect();
            area(&mut out, *role, *fill, &corners);
            stroke(&mut out, *role, *line, vec![closed(corners)]);
        }
        Drawing::Region { pieces, outline } => {
            let pieces: Vec<Vec<ScreenPoint>> = pieces.iter().map(|piece| piece.iter().map(px).collect()).collect();
            areas(&mut out, *role, *fill, &pieces);
            stroke(&mut out, *role, *line, outline.iter().map(|l| l.iter().map(px).collect()).collect());
        }
        Drawing::Disc { centre, radius } => {
            let (centre, radius) = (px(centre), radius * fit.px_per_metre());
            match fill {
                Fill::None => {}
                Fill::Tint(opacity) => {
                    out.push(Primitive::Dots { centres: vec![centre], radius, role: *role, opacity: *opacity });
                }
                _ => area(&mut out, *role, *fill, &circle(centre, radius)),
            }
            out.extend(line.map(|line| Primitive::Circle { centre, radius, role: *role, line }));
        }
        Drawing::Capsule { a, b, radius } => {
            let placed = Shape::Capsule { a: *a, b: *b, radius: *radius }.place(&Pose2::IDENTITY);
            let corners: Vec<_> = polygon_of(&placed).iter().map(px).collect();
            area(&mut out, *role, *fill, &corners);
            stroke(&mut out, *role, *line, vec![closed(corners)]);
        }
        Drawing::Rays { from, ends } => {
            stroke(&mut out, *role, *line, ends.iter().map(|end| vec![px(from), px(end)]).collect());
            if let Fill::Tint(opacity) = *fill {
                out.push(Primitive::Dots {
                    centres: ends.iter().map(px).collect(),
                    radius: 1.25,
                    role: *role,
                    opacity,
                });
            }
        }
        Drawing::Arrow { from, along, min_px } => {
            let from = px(from);
            let length = num::hypot(along.x, along.y) * fit.px_per_metre();
            let unit = [along.x * fit.px_per_metre() / length, -along.y * fit.px_per_metre() / length];
            let length = num::greater(length, *min_px);
            let point = |ahead: f64, left: f64| {
                [from[0] + unit[0] * ahead + unit[1] * left, from[1] + unit[1] * ahead - unit[0] * left]
            };
            let (tip, barb) = (point(length, 0.0), 0.35 * num::lesser(length, 12.0));
            let head = vec![point(length - barb, barb), tip, point(length - barb, -barb)];
            stroke(&mut out, *role, *line, vec![vec![from, tip], head]);
        }
        Drawing::Nose { centre, radius, heading } => {
            let corners: Vec<_> = nose(*centre, *radius, *heading).iter().map(px).collect();
            area(&mut out, *role, *fill, &corners);
        }
        Drawing::Mark { at, glyph, radius_px } => mark(&mut out, *role, px(at), *glyph, *radius_px),
        Drawing::Label { at, text, anchor, face, size_px, plate } => out.push(Primitive::Text {
            at: anchor.moved(px(at)),
            anchor: *anchor,
            text: text.clone(),
            face: *face,
            size: *size_px,
            role: *role,
            plate: *plate,
        }),
    }
    out.retain(is_finite);
    out
}

fn area(out: &mut Vec<Primitive>, role: Role, fill: Fill, corners: &[ScreenPoint]) {
    areas(out, role, fill, &[corners.to_vec()]);
}

/// Adds areas of one fill: first all areas, then their hatch or dots.
fn areas(out: &mut Vec<Primitive>, role: Role, fill: Fill, pieces: &[Vec<ScreenPoint>]) {
    let opacity = match fill {
        Fill::None => return,
        Fill::Tint(opacity) => opacity,
        Fill::Hatch | Fill::Dots => TINT,
    };
    out.extend(pieces.iter().map(|corners| Primitive::Area { corners: corners.clone(), role, opacity }));
    match fill {
        Fill::Hatch => {
            stroke(out, role, Some(Line::solid(1.0).at_opacity(HATCH_OPACITY)), hatch(pieces));
        }
        Fill::Dots => {
            let centres = pieces.iter().flat_map(|p| dots(p)).collect();
            out.push(Primitive::Dots { centres, radius: 0.9, role, opacity: 0.8 });
        }
        _ => {}
    }
}

fn stroke(out: &mut Vec<Primitive>, role: Role, line: Option<Line>, mut lines: Vec<Vec<ScreenPoint>>) {
    lines.retain(|l| l.len() > 1);
    if let Some(line) = line.filter(|_| !lines.is_empty()) {
        out.push(Primitive::Lines { lines, role, line });
    }
}

fn mark(out: &mut Vec<Primitive>, role: Role, at: ScreenPoint, glyph: Glyph, radius: f64) {
    let dot = |role, radius| Primitive::Dots { centres: vec![at], radius, role, opacity: 1.0 };
    let ring = |role, radius, width| Primitive::Circle { centre: at, radius, role, line: Line::solid(width) };
    match glyph {
        Glyph::Dot => out.push(dot(role, radius)),
        Glyph::Ring => out.extend([dot(Role::Paper, radius), ring(role, radius, 1.5)]),
        Glyph::Cross => {
            let point = |x: f64, y: f64| [at[0] + radius * x, at[1] + radius * y];
            let lines = vec![vec![point(-1.0, -1.0), point(1.0, 1.0)], vec![point(-1.0, 1.0), point(1.0, -1.0)]];
            // with a paper edge, so that it is legible on a line of any colour
            out.push(Primitive::Lines { lines: lines.clone(), role: Role::Paper, line: Line::solid(4.0) });
            out.push(Primitive::Lines { lines, role, line: Line::solid(2.0) });
        }
        Glyph::Handle => out.extend([dot(role, radius), ring(Role::Paper, radius, 1.5)]),
    }
}

fn circle(centre: ScreenPoint, radius: f64) -> Vec<ScreenPoint> {
    (0..64)
        .map(|k| {
            let (s, c) = num::sin_cos(f64::from(k) * std::f64::consts::PI / 32.0);
            [centre[0] + radius * c, centre[1] + radius * s]
        })
        .collect()
}

fn is_finite(primitive: &Primitive) -> bool {
    let point = |p: &ScreenPoint| p[0].is_finite() && p[1].is_finite();
    match primitive {
        Primitive::Area { corners, .. } => corners.iter().all(point),
        Primitive::Dots { centres, radius, .. } => radius.is_finite() && centres.iter().all(point),
        Primitive::Circle { centre, radius, .. } => radius.is_finite() && point(centre),
        Primitive::Lines { lines, .. } => lines.iter().flatten().all(point),
        Primitive::Text { at, .. } => point(at),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::Vector2;
    use crate::picture::ScreenRect;

    fn fit() -> Fit {
        let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(10.0, 10.0) };
        Fit::new(&bounds, ScreenRect { min: [0.0, 0.0], size: [100.0, 100.0] }, 0.0)
    }

    #[test]
    fn arrows_point_where_they_should_and_stay_visible() {
        let drawing = Drawing::Arrow { from: Point2::new(5.0, 5.0), along: Vector2::new(0.0, 0.1), min_px: 12.0 };
        let item = Item::new("a", "a", Role::Robot, drawing).stroked(Line::solid(1.0));
        let [Primitive::Lines { lines, .. }] = &resolve(&item, &fit())[..] else { panic!("one bundle of lines") };
        assert_eq!(lines[0], [[50.0, 50.0], [50.0, 38.0]], "0.1 m would be one pixel; up in the world is up");
        let (left, right) = (lines[1][0], lines[1][2]);
        assert!(left[0] < 50.0 && right[0] > 50.0 && left[1] == right[1], "the barbs are mirror images");
    }

    #[test]
    fn a_nose_points_ahead_and_stays_inside_its_disc() {
        let heading = std::f64::consts::FRAC_PI_2;
        for (radius, px) in [(1.0, 10.0), (0.1, 1.0)] {
            let drawing = Drawing::Nose { centre: Point2::new(5.0, 5.0), radius, heading };
            let item = Item::new("a", "a", Role::Robot, drawing).filled(Fill::Tint(1.0));
            let [Primitive::Area { corners, .. }] = &resolve(&item, &fit())[..] else { panic!("one triangle") };
            assert!(corners.iter().all(|c| num::hypot(c[0] - 50.0, c[1] - 50.0) < px), "at any scale");
            let [tip, left, right] = corners[..] else { panic!("three corners") };
            assert!((tip[0] - 50.0).abs() < 1e-9 && tip[1] < 50.0 - 0.8 * px, "up, near the edge");
            assert!((left[0] + right[0] - 100.0).abs() < 1e-9 && left[1] == right[1] && left[1] > 50.0, "symmetric");
        }
    }

    #[test]
    fn nothing_that_is_not_finite_reaches_a_medium() {
        let nan = Point2::new(f64::NAN, 1.0);
        let drawings = [
            Drawing::Polyline(vec![nan, nan]),
            Drawing::Polygon(vec![nan; 3]),
            Drawing::Disc { centre: nan, radius: 1.0 },
            Drawing::Capsule { a: nan, b: nan, radius: 1.0 },
            Drawing::Rays { from: nan, ends: vec![nan] },
            Drawing::Arrow { from: Point2::origin(), along: Vector2::zeros(), min_px: 1.0 },
            Drawing::Nose { centre: nan, radius: 1.0, heading: 0.0 },
            Drawing::Mark { at: nan, glyph: Glyph::Cross, radius_px: 1.0 },
        ];
        for drawing in drawings {
            for fill in [Fill::Tint(1.0), Fill::Hatch, Fill::Dots] {
                let item = Item::new("a", "a", Role::Robot, drawing.clone()).filled(fill).stroked(Line::solid(1.0));
                let shown = resolve(&item, &fit());
                let bare = |p: &Primitive| matches!(p, Primitive::Dots { centres, .. } if centres.is_empty());
                assert!(shown.iter().all(bare), "{drawing:?} {shown:?}");
            }
        }
    }
}
