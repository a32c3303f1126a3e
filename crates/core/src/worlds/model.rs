//! `World`, a checked world: what is meant, as opposed to what is written in a file.

use super::{BeamModel, OutlineError, ResidentSensor, Route, convex_pieces};
use crate::configuration::Sizes;
use crate::geometry::{Aabb, ConvexPolygon, Placed, Point2, Pose2, Shape};

/// The kind of an obstacle. Walls and solids collide alike.
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
    /// The pieces, each with the pose of its frame: the segments of a polyline, the convex pieces of a concave polygon,
    /// a disc.
    pub pieces: Vec<(Pose2, Shape)>,
    /// The outlines of the concave polygons, as written and in order. Queries use the pieces only.
    pub outlines: Vec<Outline>,
}

/// A concave polygon of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Index of the first convex piece cut from the polygon, among the obstacle's pieces.
    pub first: usize,
    /// Number of convex pieces.
    pub pieces: usize,
    /// The polygon's vertices, as written.
    pub points: Vec<Point2>,
}

/// A shape of an obstacle as it was written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SourceShape<'a> {
    /// A concave polygon.
    Outline(&'a [Point2]),
    /// Anything else.
    Piece(&'a (Pose2, Shape)),
}

/// A door: a segment that can be closed, which makes it a wall, or open, which makes it nothing.
///
/// A world file says how a run starts; inputs of the run open and close doors.
#[derive(Clone, Debug, PartialEq)]
pub struct Door {
    /// The unique name.
    pub name: String,
    /// The end at the hinge, metres.
    pub a: Point2,
    /// The other end, metres.
    pub b: Point2,
    /// Whether it is open at the start.
    pub open: bool,
}

/// A named place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The unique name.
    pub name: String,
    /// Position, metres, and heading, radians, in the world.
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

/// A resident robot of a world: its kind, its start and its sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Resident {
    /// The robot's unique name.
    pub name: String,
    /// Its kind: `rusty`, `reach`, `reach3`, `hitch`, or the name a program registered.
    pub kind: String,
    /// Chart coordinates of the configuration at the start. A `hitch` with four coordinates starts with its trailer.
    pub start: Vec<f64>,
    /// What it is like; `None` for what every robot of its kind is like.
    pub sizes: Option<Sizes>,
    /// The noise of the range sensor that the run gives it; `None` if that sensor is exact or the robot has none.
    pub sensor: Option<BeamModel>,
    /// Its own range sensors, in file order; they come on top of the run's.
    pub sensors: Vec<ResidentSensor>,
    /// The name of the route of its world that it follows when nobody drives it; `None` for its kind's own tour.
    pub route: Option<String>,
}

/// A checked world.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The world's name.
    pub name: String,
    /// The part of the plane it shows.
    pub bounds: Aabb,
    /// The obstacles in file order: walls first, then solids, as written.
    pub obstacles: Vec<Obstacle>,
    /// The doors in file order.
    pub doors: Vec<Door>,
    /// The routes in file order.
    pub routes: Vec<Route>,
    /// The places in file order.
    pub places: Vec<Place>,
    /// The painted marks in file order.
    pub marks: Vec<Mark>,
    /// The resident robots in file order.
    pub robots: Vec<Resident>,
}

impl Resident {
    /// Creates a resident of its kind's own sizes with an exact sensor. Nothing is checked.
    pub fn new(name: impl Into<String>, kind: impl Into<String>, start: impl Into<Vec<f64>>) -> Self {
        let (name, kind, start) = (name.into(), kind.into(), start.into());
        Resident { name, kind, start, sizes: None, sensor: None, sensors: Vec::new(), route: None }
    }

    /// The same resident with these sizes. Nothing is checked.
    #[must_use]
    pub fn with_sizes(self, sizes: Sizes) -> Self {
        Resident { sizes: Some(sizes), ..self }
    }

    /// The same resident on the route of this name. Nothing is checked.
    #[must_use]
    pub fn with_route(self, route: impl Into<String>) -> Self {
        Resident { route: Some(route.into()), ..self }
    }
}

impl Door {
    /// The wall that the door is when it is closed.
    pub fn leaf(&self) -> Obstacle {
        let segment = Shape::Segment { a: self.a, b: self.b };
        Obstacle::new(&self.name, ObstacleKind::Wall, vec![(Pose2::IDENTITY, segment)])
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
    /// [`OutlineError`] if the points are not the outline of a polygon that can be cut up.
    pub fn add_polygon(&mut self, points: &[Point2]) -> Result<(), OutlineError> {
        let cut = convex_pieces(points)?;
        if cut.len() > 1 {
            self.outlines.push(Outline { first: self.pieces.len(), pieces: cut.len(), points: points.to_vec() });
        }
        self.pieces.extend(cut.into_iter().map(|p| (Pose2::IDENTITY, Shape::Polygon(p))));
        Ok(())
    }

    /// Returns the shapes as written, in order: an outline for each concave polygon, a piece for every other shape.
    pub fn written(&self) -> Vec<SourceShape<'_>> {
        let mut written = Vec::new();
        let mut at = 0;
        while let Some(piece) = self.pieces.get(at) {
            match self.outlines.iter().find(|outline| outline.first == at && self.is_own(outline)) {
                Some(outline) => {
                    written.push(SourceShape::Outline(&outline.points));
                    at += outline.pieces;
                }
                None => {
                    written.push(SourceShape::Piece(piece));
                    at += 1;
                }
            }
        }
        written
    }

    /// Whether an outline still matches its pieces. In an obstacle assembled by hand it may not.
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
    /// A world without anything in it.
    pub fn empty(name: impl Into<String>, bounds: Aabb) -> Self {
        World {
            name: name.into(),
            bounds,
            obstacles: vec![],
            doors: vec![],
            routes: vec![],
            places: vec![],
            marks: vec![],
            robots: vec![],
        }
    }

    /// The place of this name.
    pub fn place(&self, name: &str) -> Option<&Place> {
        self.places.iter().find(|place| place.name == name)
    }

    /// The door of this name.
    pub fn door(&self, name: &str) -> Option<&Door> {
        self.doors.iter().find(|door| door.name == name)
    }

    /// The closed doors as walls, in file order.
    pub fn closed_doors(&self) -> impl Iterator<Item = Obstacle> + '_ {
        self.doors.iter().filter(|door| !door.open).map(Door::leaf)
    }

    /// Whether anything in the world has this name.
    pub fn has_name(&self, name: &str) -> bool {
        self.obstacle(name).is_some()
            || self.place(name).is_some()
            || self.door(name).is_some()
            || self.routes.iter().any(|route| route.name == name)
            || self.marks.iter().any(|mark| mark.name == name)
            || self.robots.iter().any(|robot| robot.name == name)
    }

    /// The obstacle of this name.
    pub fn obstacle(&self, name: &str) -> Option<&Obstacle> {
        self.obstacles.iter().find(|obstacle| obstacle.name == name)
    }
}
