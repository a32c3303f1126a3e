//! `Feature`, the corner, edge or end on which a nearest point lies.

use std::fmt;

use motion_lab_core::geometry::{Placed, Point2, Segment};
use motion_lab_core::num::hypot;

/// Largest distance between two points that count as the same, metres: far above rounding.
const SAME: f64 = 1e-9;

/// The feature of a placed shape that a point of it lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feature {
    /// A corner of a polygon, or of a wall where two of its pieces meet.
    Corner(Point2),
    /// The end of a segment or capsule.
    End(Point2),
    /// An edge of a polygon, or the side of a segment or capsule, by its core's ends.
    Edge(Point2, Point2),
    /// The rim of a disc.
    Rim,
    /// The inside.
    Inside,
}

impl fmt::Display for Feature {
    /// In words: `corner (0.500, 1.000)`, `edge from (0.500, 1.000) to (1.000, 1.000)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = |p: &Point2| super::words::point(*p);
        match self {
            Feature::Corner(p) => write!(f, "corner {}", at(p)),
            Feature::End(p) => write!(f, "end {}", at(p)),
            Feature::Edge(a, b) => write!(f, "edge from {} to {}", at(a), at(b)),
            Feature::Rim => write!(f, "rim"),
            Feature::Inside => write!(f, "inside"),
        }
    }
}

/// Whether two points are the same but for rounding.
fn same(p: Point2, q: Point2) -> bool {
    hypot(p.x - q.x, p.y - q.y) <= SAME
}

/// The edges of a core: none of a point, one of a segment, all sides of a polygon.
pub(super) fn edges(core: &[Point2]) -> impl Iterator<Item = Segment> + '_ {
    let n = core.len();
    let sides = match n {
        0 | 1 => 0,
        2 => 1,
        _ => n,
    };
    (0..sides).map(move |i| Segment::new(core[i], core[(i + 1) % n]))
}

/// The feature of `shape` on which its point `p` lies. For a shape with a radius it is the nearest feature of the core.
pub(super) fn feature_of(shape: &Placed, p: Point2) -> Feature {
    let core = shape.core();
    if core.len() < 2 {
        return Feature::Rim;
    }
    let mut best: Option<(f64, Segment, Point2)> = None;
    for edge in edges(core) {
        let foot = edge.closest_point(p);
        let d = hypot(p.x - foot.x, p.y - foot.y);
        if best.is_none_or(|(least, ..)| d < least) {
            best = Some((d, edge, foot));
        }
    }
    match best {
        Some((d, edge, foot)) if d <= shape.radius() + SAME => {
            let vertex = [edge.a, edge.b].into_iter().find(|v| same(*v, foot));
            match vertex {
                Some(v) if core.len() == 2 => Feature::End(v),
                Some(v) => Feature::Corner(v),
                None => Feature::Edge(edge.a, edge.b),
            }
        }
        _ => Feature::Inside,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::{Pose2, Shape};

    #[test]
    fn points_lie_on_corners_edges_ends_and_rims() {
        let p = Point2::new;
        let square = Shape::try_rectangle(p(0.0, 0.0), p(2.0, 2.0)).unwrap().place(&Pose2::IDENTITY);
        assert_eq!(feature_of(&square, p(2.0, 2.0)), Feature::Corner(p(2.0, 2.0)));
        assert_eq!(feature_of(&square, p(2.0, 2.0 - 1e-12)), Feature::Corner(p(2.0, 2.0)), "but for rounding");
        assert_eq!(feature_of(&square, p(2.0, 1.9)), Feature::Edge(p(2.0, 0.0), p(2.0, 2.0)));
        assert_eq!(feature_of(&square, p(1.0, 1.0)), Feature::Inside);
        let link = Shape::try_capsule(p(0.0, 0.0), p(1.0, 0.0), 0.1).unwrap().place(&Pose2::IDENTITY);
        assert_eq!(feature_of(&link, p(1.1, 0.0)), Feature::End(p(1.0, 0.0)));
        assert_eq!(feature_of(&link, p(0.5, 0.1)), Feature::Edge(p(0.0, 0.0), p(1.0, 0.0)));
        let disc = Shape::try_disc(1.0).unwrap().place(&Pose2::IDENTITY);
        assert_eq!(feature_of(&disc, p(1.0, 0.0)), Feature::Rim);
    }

    #[test]
    fn they_are_said_in_words() {
        assert_eq!(Feature::Corner(Point2::new(0.5, -1.0)).to_string(), "corner (0.500, \u{2212}1.000)");
    }
}
