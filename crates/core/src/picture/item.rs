//! `Item`, one thing on a picture: its name, its role, its geometry, its fill and its stroke.

use super::{Role, ScreenPoint};
use crate::geometry::{Aabb, Point2, Vector2};

/// One thing on a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The stable id, unique in its picture, as a path: `obstacle/the post`, `robot/Rusty/0`.
    pub id: String,
    /// Its name, for readers who do not see it.
    pub name: String,
    /// What it stands for.
    pub role: Role,
    /// Where it is, metres.
    pub drawing: Drawing,
    /// How its inside is filled.
    pub fill: Fill,
    /// How its edge or line is stroked; `None` for no line.
    pub line: Option<Line>,
}

/// The geometry of an item: metres, x right, y up. A size whose name ends in `_px` is in pixels on the screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawing {
    /// An open line through these points.
    Polyline(Vec<Point2>),
    /// A convex polygon.
    Polygon(Vec<Point2>),
    /// A union of convex polygons: filled one by one, stroked along the outlines alone.
    Region {
        /// The convex pieces.
        pieces: Vec<Vec<Point2>>,
        /// The lines around their union.
        outline: Vec<Vec<Point2>>,
    },
    /// A disc, or a ring when it is not filled.
    Disc {
        /// Centre.
        centre: Point2,
        /// Radius.
        radius: f64,
    },
    /// All points within `radius` of a segment.
    Capsule {
        /// First end of the core.
        a: Point2,
        /// Second end of the core.
        b: Point2,
        /// Radius.
        radius: f64,
    },
    /// Rays from one point to each of these.
    Rays {
        /// Where they start.
        from: Point2,
        /// Where they end.
        ends: Vec<Point2>,
    },
    /// An arrow of at least `min_px`.
    Arrow {
        /// Where it starts.
        from: Point2,
        /// The vector from there to its tip.
        along: Vector2,
        /// Its least length on the screen.
        min_px: f64,
    },
    /// A pointer on a disc, inside it: a triangle with its tip near the edge ahead.
    Nose {
        /// The disc's centre.
        centre: Point2,
        /// The disc's radius.
        radius: f64,
        /// Which way it points, radians.
        heading: f64,
    },
    /// A mark that keeps its size.
    Mark {
        /// Its centre.
        at: Point2,
        /// Its form.
        glyph: Glyph,
        /// Its radius on the screen.
        radius_px: f64,
    },
    /// Words.
    Label {
        /// What they name.
        at: Point2,
        /// The words.
        text: String,
        /// On which side of the point they stand.
        anchor: Anchor,
        /// In which face.
        face: Face,
        /// Height of the face on the screen.
        size_px: f64,
        /// Whether they stand on a small plate of paper.
        plate: bool,
    },
}

impl Drawing {
    /// A box around it in metres. Sizes in pixels count as nothing: a mark and a label are the point where they are.
    /// `None` for a drawing without points.
    pub fn bounds(&self) -> Option<Aabb> {
        match self {
            Drawing::Polyline(points) | Drawing::Polygon(points) => Aabb::around(points),
            Drawing::Region { pieces, outline } => {
                pieces.iter().chain(outline).filter_map(|points| Aabb::around(points)).reduce(|a, b| a.merged(&b))
            }
            Drawing::Disc { centre, radius } | Drawing::Nose { centre, radius, .. } => {
                Aabb::around(&[*centre]).map(|b| b.grown(*radius))
            }
            Drawing::Capsule { a, b, radius } => Aabb::around(&[*a, *b]).map(|b| b.grown(*radius)),
            Drawing::Rays { from, ends } => {
                Aabb::around(&[*from]).into_iter().chain(Aabb::around(ends)).reduce(|a, b| a.merged(&b))
            }
            Drawing::Arrow { from, along, .. } => Aabb::around(&[*from, *from + *along]),
            Drawing::Mark { at, .. } | Drawing::Label { at, .. } => Aabb::around(&[*at]),
        }
    }
}

/// How the inside of an item is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// Not at all.
    None,
    /// With the role's colour at this opacity.
    Tint(f64),
    /// With a light tint and a fine hatch: obstacles.
    Hatch,
    /// With dots: unknown space.
    Dots,
}

/// A stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Its width on the screen.
    pub width_px: f64,
    /// Its opacity.
    pub opacity: f64,
    /// Its pattern.
    pub dash: Dash,
}

impl Line {
    /// A full, opaque line of this width.
    pub const fn solid(width_px: f64) -> Self {
        Line { width_px, opacity: 1.0, dash: Dash::Solid }
    }

    /// The same line at this opacity.
    #[must_use]
    pub const fn at_opacity(self, opacity: f64) -> Self {
        Line { opacity, ..self }
    }

    /// The same line in this pattern.
    #[must_use]
    pub const fn dashed(self, dash: Dash) -> Self {
        Line { dash, ..self }
    }
}

/// The pattern of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Dashes of 6 px, gaps of 4.
    Dashed,
    /// Dots of 1.5 px, gaps of 3.5.
    Dotted,
}

impl Dash {
    /// The lengths of stroke and gap on the screen; `None` when unbroken.
    pub const fn pattern_px(self) -> Option<(f64, f64)> {
        match self {
            Dash::Solid => None,
            Dash::Dashed => Some((6.0, 4.0)),
            Dash::Dotted => Some((1.5, 3.5)),
        }
    }
}

/// The form of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glyph {
    /// A filled dot.
    Dot,
    /// A ring, paper inside.
    Ring,
    /// A diagonal cross.
    Cross,
    /// A dot to be dragged.
    Handle,
}

/// On which side of its point a label stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Centred on the point.
    Centre,
    /// Right of the point.
    Right,
    /// Left of the point.
    Left,
    /// Above the point.
    Above,
    /// Below the point.
    Below,
}

/// Distance of a line's baseline below its middle, as a fraction of the letters' size.
pub(super) const MIDDLE: f64 = 0.35;

impl Anchor {
    /// The middle of the label's side that faces the point `at`, a gap of 6 pixels away from it; for
    /// [`Centre`](Self::Centre) the point itself.
    pub(super) fn moved(self, [x, y]: ScreenPoint) -> ScreenPoint {
        const GAP: f64 = 6.0;
        match self {
            Anchor::Centre => [x, y],
            Anchor::Right => [x + GAP, y],
            Anchor::Left => [x - GAP, y],
            Anchor::Above => [x, y - GAP],
            Anchor::Below => [x, y + GAP],
        }
    }
}

/// The two faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Words.
    Sans,
    /// Figures and types.
    Mono,
}

impl Drawing {
    /// The segment from `a` to `b`.
    pub fn segment(a: Point2, b: Point2) -> Self {
        Drawing::Polyline(vec![a, b])
    }
}

impl Item {
    /// The item without fill or line.
    pub fn new(id: impl Into<String>, name: impl Into<String>, role: Role, drawing: Drawing) -> Self {
        Item { id: id.into(), name: name.into(), role, drawing, fill: Fill::None, line: None }
    }

    /// The same item with this fill.
    #[must_use]
    pub fn filled(self, fill: Fill) -> Self {
        Item { fill, ..self }
    }

    /// The same item with this stroke.
    #[must_use]
    pub fn stroked(self, line: Line) -> Self {
        Item { line: Some(line), ..self }
    }
}
