//! `World`, a checked world: what is meant, as opposed to what is written in a file.

use super::{BeamModel, OutlineError, convex_pieces};
use crate::geometry::{ConvexPolygon, Placed, Point2, Pose2, Shape};

/// An axis-parallel box: the part of the plane a world shows. It is not an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the least coordinates, metres.
    pub min: Point2,
    /// The corner with the greatest coordinates, metres.
    pub max: Point2,
}

/// Whether an obstacle is a thin wall or a solid thing; both collide alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObstacleKind {
    /// Segments.
    Wall,
    /// Discs, boxes, polygons.
    Solid,
}

/// A named obstacle: one or more closed convex pieces in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// The unique name.
    pub name: String,
    /// Wall or solid.
    pub kind: ObstacleKind,
    /// The pieces, each with the pose of its frame: a polyline's segments, a concave polygon's convex pieces, a disc.
    pub pieces: Vec<(Pose2, Shape)>,
    /// The concave polygons among them as they were written, in order. Queries see the pieces alone.
    pub outlines: Vec<Outline>,
}

/// A concave polygon of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// The number of the first of the convex pieces it was cut into.
    pub first: usize,
    /// How many there are.
    pub pieces: usize,
    /// Its vertices as they were written.
    pub points: Vec<Point2>,
}

/// A shape of an obstacle as it was written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Written<'a> {
    /// A concave polygon.
    Outline(&'a [Point2]),
    /// Anything else.
    Piece(&'a (Pose2, Shape)),
}

/// A named place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The unique name.
    pub name: String,
    /// Where it is, and which way it faces.
    pub pose: Pose2,
}

/// A painted mark: drawn, never collided with.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The unique name.
    pub name: String,
    /// The polyline's points.
    pub points: Vec<Point2>,
}

/// A robot that lives in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Resident {
    /// The robot's unique name.
    pub name: String,
    /// Its kind: `rusty`, `reach`, `reach3`, `hitch`, or the name a program registered.
    pub kind: String,
    /// Where it starts: its configuration's chart coordinates. Hitch starts with a trailer when there are four.
    pub start: Vec<f64>,
    /// The noise of its range sensor; `None` for an exact one, or none.
    pub sensor: Option<BeamModel>,
}

/// A checked world.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The world's name.
    pub name: String,
    /// The part of the plane it shows.
    pub bounds: Bounds,
    /// The obstacles in file order: walls first, then solids, as written.
    pub obstacles: Vec<Obstacle>,
    /// The places in file order.
    pub places: Vec<Place>,
    /// The painted marks in file order.
    pub marks: Vec<Mark>,
    /// The resident robots in file order.
    pub robots: Vec<Resident>,
}

impl Resident {
    /// The robot of this name and kind at this start, its sensor exact.
    pub fn new(name: impl Into<String>, kind: impl Into<String>, start: impl Into<Vec<f64>>) -> Self {
        Resident { name: name.into(), kind: kind.into(), start: start.into(), sensor: None }
    }
}

impl Obstacle {
    /// The obstacle of these pieces.
    pub fn new(name: impl Into<String>, kind: ObstacleKind, pieces: Vec<(Pose2, Shape)>) -> Self {
        Obstacle { name: name.into(), kind, pieces, outlines: Vec::new() }
    }

    /// Adds a polygon, convex or not, cut into convex pieces.
    ///
    /// # Errors
    /// [`OutlineError`] when the points are the outline of none.
    pub fn add_polygon(&mut self, points: &[Point2]) -> Result<(), OutlineError> {
        let cut = convex_pieces(points)?;
        if cut.len() > 1 {
            self.outlines.push(Outline { first: self.pieces.len(), pieces: cut.len(), points: points.to_vec() });
        }
        self.pieces.extend(cut.into_iter().map(|p| (Pose2::IDENTITY, Shape::Polygon(p))));
        Ok(())
    }

    /// The shapes as they were written, in order: the outline of each concave polygon, or else a piece.
    pub fn written(&self) -> Vec<Written<'_>> {
        let mut written = Vec::new();
        let mut at = 0;
        while let Some(piece) = self.pieces.get(at) {
            match self.outlines.iter().find(|outline| outline.first == at && self.is_own(outline)) {
                Some(outline) => {
                    written.push(Written::Outline(&outline.points));
                    at += outline.pieces;
                }
                None => {
                    written.push(Written::Piece(piece));
                    at += 1;
                }
            }
        }
        written
    }

    /// Whether an outline is still that of its pieces: in an obstacle put together by hand it need not be.
    fn is_own(&self, outline: &Outline) -> bool {
        let Some(own) = self.pieces.get(outline.first..outline.first.saturating_add(outline.pieces)) else {
            return false;
        };
        let cut = convex_pieces(&outline.points).unwrap_or_default();
        let same = |((pose, shape), piece): (&(Pose2, Shape), &ConvexPolygon)| {
            *pose == Pose2::IDENTITY && matches!(shape, Shape::Polygon(own) if own == piece)
        };
        outline.pieces > 1 && cut.len() == own.len() && own.iter().zip(&cut).all(same)
    }

    /// The pieces placed in the world, in order.
    pub fn placed(&self) -> impl Iterator<Item = Placed> + '_ {
        self.pieces.iter().map(|(pose, shape)| shape.place(pose))
    }
}

impl World {
    /// The place of this name.
    pub fn place(&self, name: &str) -> Option<&Place> {
        self.places.iter().find(|place| place.name == name)
    }

    /// The obstacle of this name.
    pub fn obstacle(&self, name: &str) -> Option<&Obstacle> {
        self.obstacles.iter().find(|obstacle| obstacle.name == name)
    }
}
