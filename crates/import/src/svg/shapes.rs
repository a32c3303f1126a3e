//! The lines that a shape's element draws, in the element's own units.

use roxmltree::Node;
use svgtypes::{PathParser, PathSegment, PointsParser};

use super::check::{NUMBERS, at, attribute};
use super::lengths::{Along, LengthScale};
use crate::ImportError;
use crate::error::wrong_value;
use crate::planar::{CurvedPart, EllipticArc, PathPiece, arc_between};
use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num::lesser;

/// The parts of a shape. Also returns what is wrong with its numbers, if its line is drawn only up to there.
///
/// # Errors
/// [`ImportError`] for numbers that are malformed or not finite.
pub(crate) fn parts(node: Node, scale: &LengthScale) -> Result<(Vec<CurvedPart>, bool), ImportError> {
    let length = |name: &str, along: Along| match attribute(node, name).filter(|text| text.trim() != "auto") {
        None => Ok(None),
        Some(text) => match scale.length(text, along).filter(|x| x.is_finite()) {
            Some(x) => Ok(Some(x)),
            None => Err(at(node, wrong_value(format!("{name} = {text}"), "a length"))),
        },
    };
    let x = |name: &str| length(name, Along::X).map(Option::unwrap_or_default);
    let y = |name: &str| length(name, Along::Y).map(Option::unwrap_or_default);
    let whole = |part: Option<CurvedPart>| Ok((part.into_iter().collect(), false));
    match node.tag_name().name() {
        "line" => {
            let mut part = CurvedPart::new(Point2::new(x("x1")?, y("y1")?));
            part.pieces.push(PathPiece::Line(Point2::new(x("x2")?, y("y2")?)));
            whole(Some(part))
        }
        "rect" => {
            let (least, size) = (Point2::new(x("x")?, y("y")?), Vector2::new(x("width")?, y("height")?));
            whole(rectangle(least, size, [length("rx", Along::X)?, length("ry", Along::Y)?]))
        }
        "circle" => {
            let r = length("r", Along::Both)?.unwrap_or(0.0);
            whole(ellipse(Point2::new(x("cx")?, y("cy")?), r, r))
        }
        "ellipse" => {
            let (rx, ry) = (length("rx", Along::X)?, length("ry", Along::Y)?);
            let (rx, ry) = (rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
            whole(ellipse(Point2::new(x("cx")?, y("cy")?), rx, ry))
        }
        name @ ("polyline" | "polygon") => points_part(node, name == "polygon"),
        _ => path_of(node),
    }
}

/// `None` if it has no area.
pub(crate) fn ellipse(center: Point2, rx: f64, ry: f64) -> Option<CurvedPart> {
    let arc = EllipticArc::whole(center, Vector2::new(rx, 0.0), Vector2::new(0.0, ry));
    let start = arc.point(0.0);
    let pieces = vec![PathPiece::Arc(arc, start)];
    (rx > 0.0 && ry > 0.0).then_some(CurvedPart { start, pieces, closed: true })
}

/// A rectangle with rounded corners; `None` if it has no area.
pub(crate) fn rectangle(least: Point2, size: Vector2, radii: [Option<f64>; 2]) -> Option<CurvedPart> {
    if !(size.x > 0.0 && size.y > 0.0) {
        return None;
    }
    let rx = lesser(radii[0].or(radii[1]).unwrap_or(0.0), size.x / 2.0);
    let ry = lesser(radii[1].or(radii[0]).unwrap_or(0.0), size.y / 2.0);
    let (x, y, w, h) = (least.x, least.y, size.x, size.y);
    let at = |dx: f64, dy: f64| Point2::new(x + dx, y + dy);
    if !(rx > 0.0 && ry > 0.0) {
        return Some(CurvedPart::ring(&[at(0.0, 0.0), at(w, 0.0), at(w, h), at(0.0, h)]));
    }
    let mut part = CurvedPart { closed: true, ..CurvedPart::new(at(rx, 0.0)) };
    let corners = [
        (at(w - rx, 0.0), at(w - rx, ry), -90.0, at(w, ry)),
        (at(w, h - ry), at(w - rx, h - ry), 0.0, at(w - rx, h)),
        (at(rx, h), at(rx, h - ry), 90.0, at(0.0, h - ry)),
        (at(0.0, ry), at(rx, ry), 180.0, at(rx, 0.0)),
    ];
    for (before, center, from, end) in corners {
        let arc = EllipticArc::quarter(center, Vector2::new(rx, 0.0), Vector2::new(0.0, ry), from);
        part.pieces.extend([PathPiece::Line(before), PathPiece::Arc(arc, end)]);
    }
    Some(part)
}

fn points_part(node: Node, closed: bool) -> Result<(Vec<CurvedPart>, bool), ImportError> {
    let text = attribute(node, "points").unwrap_or_default();
    let points: Vec<Point2> = PointsParser::from(text).map(|(x, y)| Point2::new(x, y)).collect();
    check_finite(node, "points", points.iter().flat_map(|p| [p.x, p.y]))?;
    let whole = text.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty()).count();
    // numbers may also follow one another by their signs, so this is a lower bound of their count
    let cut = whole > 2 * points.len();
    let part = CurvedPart { closed, ..CurvedPart::ring(&points) };
    Ok((if points.len() > 1 { vec![part] } else { Vec::new() }, cut))
}

fn check_finite(node: Node, name: &str, numbers: impl IntoIterator<Item = f64>) -> Result<(), ImportError> {
    if numbers.into_iter().all(f64::is_finite) {
        return Ok(());
    }
    let text = attribute(node, name).unwrap_or_default();
    Err(at(node, wrong_value(format!("{name} = {text}"), NUMBERS)))
}

fn path_of(node: Node) -> Result<(Vec<CurvedPart>, bool), ImportError> {
    let text = attribute(node, "d").unwrap_or_default();
    path_parts(text).ok_or_else(|| at(node, wrong_value(format!("d = {text}"), NUMBERS)))
}

/// The parts of a path. As in a browser, it is drawn up to its first mistake; also returns whether there is one. `None`
/// for numbers that are not finite.
pub(crate) fn path_parts(text: &str) -> Option<(Vec<CurvedPart>, bool)> {
    let mut pen =
        PathPen { parts: Vec::new(), here: Point2::origin(), start: Point2::origin(), control: MirroredControl::None };
    for segment in PathParser::from(text) {
        let Ok(segment) = segment else { return Some((pen.finish(), true)) };
        if !numbers_of(&segment).into_iter().all(f64::is_finite) {
            return None;
        }
        pen.draw(segment);
    }
    Some((pen.finish(), false))
}

fn numbers_of(segment: &PathSegment) -> Vec<f64> {
    use PathSegment::*;
    match *segment {
        MoveTo { x, y, .. } | LineTo { x, y, .. } | SmoothQuadratic { x, y, .. } => vec![x, y],
        HorizontalLineTo { x, .. } => vec![x],
        VerticalLineTo { y, .. } => vec![y],
        CurveTo { x1, y1, x2, y2, x, y, .. } => vec![x1, y1, x2, y2, x, y],
        SmoothCurveTo { x2, y2, x, y, .. } => vec![x2, y2, x, y],
        Quadratic { x1, y1, x, y, .. } => vec![x1, y1, x, y],
        EllipticalArc { rx, ry, x, y, .. } => vec![rx, ry, x, y],
        ClosePath { .. } => vec![],
    }
}

/// The control point that a smooth curve mirrors.
#[derive(Clone, Copy)]
enum MirroredControl {
    None,
    Cubic(Point2),
    Quadratic(Point2),
}

/// A path while it is drawn.
struct PathPen {
    parts: Vec<CurvedPart>,
    here: Point2,
    start: Point2,
    control: MirroredControl,
}

impl PathPen {
    fn draw(&mut self, segment: PathSegment) {
        use PathSegment::*;
        let here = self.here;
        let origin = |abs: bool| if abs { Vector2::zeros() } else { here.coords };
        let place = |abs: bool, x: f64, y: f64| Point2::new(x, y) + origin(abs);
        let mirrored = |control: Point2| here + (here - control);
        let control = std::mem::replace(&mut self.control, MirroredControl::None);
        match segment {
            MoveTo { abs, x, y } => {
                (self.here, self.start) = (place(abs, x, y), place(abs, x, y));
                self.parts.push(CurvedPart::new(self.start));
            }
            LineTo { abs, x, y } => self.piece(PathPiece::Line(place(abs, x, y))),
            HorizontalLineTo { abs, x } => self.piece(PathPiece::Line(Point2::new(x + origin(abs).x, here.y))),
            VerticalLineTo { abs, y } => self.piece(PathPiece::Line(Point2::new(here.x, y + origin(abs).y))),
            CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.cubic(place(abs, x1, y1), place(abs, x2, y2), place(abs, x, y));
            }
            SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = if let MirroredControl::Cubic(p) = control { mirrored(p) } else { here };
                self.cubic(first, place(abs, x2, y2), place(abs, x, y));
            }
            Quadratic { abs, x1, y1, x, y } => self.quadratic(place(abs, x1, y1), place(abs, x, y)),
            SmoothQuadratic { abs, x, y } => {
                let middle = if let MirroredControl::Quadratic(p) = control { mirrored(p) } else { here };
                self.quadratic(middle, place(abs, x, y));
            }
            EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let end = place(abs, x, y);
                let arc = arc_between([here, end], Vector2::new(rx, ry), x_axis_rotation, [large_arc, sweep]);
                self.piece(arc.map_or(PathPiece::Line(end), |arc| PathPiece::Arc(arc, end)));
            }
            ClosePath { .. } => {
                if let Some(part) = self.parts.last_mut() {
                    part.closed = true;
                }
                self.here = self.start;
            }
        }
    }

    fn cubic(&mut self, a: Point2, b: Point2, end: Point2) {
        self.piece(PathPiece::Cubic(a, b, end));
        self.control = MirroredControl::Cubic(b);
    }

    /// The same curve as a cubic.
    fn quadratic(&mut self, middle: Point2, end: Point2) {
        let toward = |from: Point2| from + (middle - from) * (2.0 / 3.0);
        self.piece(PathPiece::Cubic(toward(self.here), toward(end), end));
        self.control = MirroredControl::Quadratic(middle);
    }

    /// Adds a piece; after a closed part, to a new one that begins at its first point.
    fn piece(&mut self, piece: PathPiece) {
        if self.parts.last().is_none_or(|part| part.closed) {
            self.parts.push(CurvedPart::new(self.start));
        }
        self.here = match piece {
            PathPiece::Line(end) | PathPiece::Cubic(_, _, end) | PathPiece::Arc(_, end) => end,
        };
        if let Some(part) = self.parts.last_mut() {
            part.pieces.push(piece);
        }
    }

    fn finish(mut self) -> Vec<CurvedPart> {
        self.parts.retain(|part| !part.pieces.is_empty());
        self.parts
    }
}
