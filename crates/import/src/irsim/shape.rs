//! The shapes of IR-SIM's objects.

use super::context::{IrContext, IrRoom, unsupported};
use super::random_polygon::RandomPolygon;
use crate::yaml::{Fields, YamlNode};
use crate::{ImportError, ImportProblem};
use motion_lab_core::geometry::{Aabb, Point2, Pose2};
use motion_lab_core::num::{greater, hypot};
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::{OutlineError, ShapeText, WorldProblem, Xy, convex_pieces};

/// How often a random polygon is drawn that no world could hold, such as one with an edge that is too short.
const MAX_DRAWS: usize = 20;

/// A shape in its object's frame.
#[derive(Clone)]
pub(crate) enum IrShape {
    Circle {
        centre: Point2,
        radius: f64,
    },
    Rectangle {
        length: f64,
        width: f64,
        wheelbase: Option<f64>,
    },
    Polygon(Vec<Point2>),
    Line(Vec<Point2>),
    /// A circle whose radius is drawn from this range.
    RandomCircle {
        centre: Point2,
        radius: [f64; 2],
    },
    RandomPolygon(RandomPolygon),
    /// All of several shapes, each at its pose.
    Compound(Vec<(Pose2, IrShape)>),
}

impl IrShape {
    /// IR-SIM's shape of an object that says none.
    pub const USUAL: IrShape = IrShape::Circle { centre: Point2::new(0.0, 0.0), radius: 1.0 };

    /// Reads a shape. Errors name it `item`.
    pub fn read(item: &str, node: &YamlNode) -> Result<IrShape, ImportError> {
        let mut fields = node.fields(item)?;
        let name = fields.need("name")?;
        let is_random = flag(item, "random_shape", &mut fields)?;
        let (shape, known) = match name.text(item)?.to_ascii_lowercase().as_str() {
            "circle" => (circle(item, &mut fields, is_random)?, "name, radius, center, random_shape and radius_range"),
            "rectangle" => (rectangle(item, &mut fields)?, "name, length, width and wheelbase"),
            "polygon" => (polygon(item, &mut fields, is_random)?, "name, vertices, random_shape and its ranges"),
            "linestring" => (line(item, &mut fields, is_random, node)?, "name and vertices"),
            "compound" => (compound(item, &mut fields)?, "name and parts"),
            "map" => return Err(unsupported(node, item, "a map")),
            _ => return Err(name.wrong(&format!("{item}.name"), "circle, rectangle, polygon, linestring or compound")),
        };
        fields.finish(known)?;
        Ok(shape)
    }

    /// The name of an object of this shape, before its number.
    pub fn stem(&self, painted: bool) -> &'static str {
        match self {
            _ if painted => "mark",
            IrShape::Circle { .. } | IrShape::RandomCircle { .. } => "disc",
            IrShape::Rectangle { .. } => "box",
            IrShape::Polygon(_) | IrShape::RandomPolygon(_) => "polygon",
            IrShape::Line(_) => "wall",
            IrShape::Compound(_) => "compound",
        }
    }

    /// The number of its points, and so how much room it takes.
    pub fn points(&self) -> usize {
        match self {
            IrShape::Polygon(points) | IrShape::Line(points) => points.len(),
            IrShape::Compound(parts) => parts.iter().map(|(_, shape)| shape.points()).sum(),
            IrShape::RandomPolygon(polygon) => polygon.max_vertices(),
            _ => 4,
        }
    }

    /// The shape itself, drawn if it is random, out of the room that is left for that.
    pub fn drawn(&self, stream: &mut Stream, room: &mut IrRoom) -> Result<IrShape, ImportProblem> {
        match self {
            IrShape::RandomCircle { centre, radius: [least, most] } => {
                Ok(IrShape::Circle { centre: *centre, radius: stream.uniform(*least, *most) })
            }
            IrShape::RandomPolygon(polygon) => Ok(IrShape::Polygon(drawn_polygon(polygon, stream, room)?)),
            IrShape::Compound(parts) => {
                let part = |(pose, shape): &(Pose2, IrShape)| Ok((*pose, shape.drawn(stream, room)?));
                parts.iter().map(part).collect::<Result<_, _>>().map(IrShape::Compound)
            }
            other => Ok(other.clone()),
        }
    }

    /// Whether something of the shape is drawn at random.
    pub fn is_random(&self) -> bool {
        match self {
            IrShape::RandomCircle { .. } | IrShape::RandomPolygon(_) => true,
            IrShape::Compound(parts) => parts.iter().any(|(_, shape)| shape.is_random()),
            _ => false,
        }
    }

    /// The greatest distance of the shape from its frame's origin, metres.
    pub fn reach(&self) -> f64 {
        let far = |points: &[Point2]| points.iter().map(|p| hypot(p.x, p.y)).fold(0.0, greater);
        match self {
            IrShape::Circle { centre, radius } | IrShape::RandomCircle { centre, radius: [_, radius] } => {
                hypot(centre.x, centre.y) + radius
            }
            IrShape::Rectangle { length, width, wheelbase } => far(&rectangle_corners(*length, *width, *wheelbase)),
            IrShape::Polygon(points) | IrShape::Line(points) => far(points),
            IrShape::RandomPolygon(_) => 0.0,
            IrShape::Compound(parts) => {
                parts.iter().map(|(pose, shape)| hypot(pose.x, pose.y) + shape.reach()).fold(0.0, greater)
            }
        }
    }

    /// Whether the shape can be painted: its border is one chain of straight lines.
    pub fn is_line(&self) -> bool {
        !matches!(self, IrShape::Circle { .. } | IrShape::RandomCircle { .. } | IrShape::Compound(_))
    }

    /// Adds an object of this shape with its frame at `pose`; if `painted`, as a mark, which the shape must be fit for.
    pub fn put(&self, pose: &Pose2, painted: bool, name: String, scene: &mut IrContext) -> Result<(), WorldProblem> {
        let placed = |points: &[Point2]| points.iter().map(|p| place(pose, p)).collect::<Vec<Xy>>();
        let draft = &mut scene.draft;
        match self {
            IrShape::Rectangle { length, width, wheelbase } if painted => {
                draft.world.mark(name, placed(&rectangle_corners(*length, *width, *wheelbase)), true)
            }
            IrShape::Polygon(points) if painted => draft.world.mark(name, placed(points), true),
            IrShape::Line(points) if painted => draft.world.mark(name, placed(points), false),
            IrShape::Line(points) => draft.world.wall(name, placed(points), false),
            IrShape::Polygon(points) if is_crossed(points) => {
                draft.note(format!("{name}: its outline crosses itself; its bounding box stands for it, as in IR-SIM"));
                draft.world.solid(name, ShapeText::Polygon(placed(&bounding_box(points))))
            }
            _ => match self.solid(pose) {
                Some(shape) => draft.world.solid(name, shape),
                None => Ok(()),
            },
        }
    }

    /// The shape as a solid one, with its frame at `pose`; `None` for a line.
    fn solid(&self, pose: &Pose2) -> Option<ShapeText> {
        let placed = |points: &[Point2]| points.iter().map(|p| place(pose, p)).collect::<Vec<Xy>>();
        match self {
            IrShape::Circle { centre, radius } => {
                Some(ShapeText::Disc { center: place(pose, centre), radius: *radius })
            }
            IrShape::Rectangle { length, width, wheelbase } => {
                let points = placed(&rectangle_corners(*length, *width, *wheelbase));
                let is_straight = pose.theta == 0.0;
                Some(if is_straight {
                    ShapeText::Box { min: points[0], max: points[2] }
                } else {
                    ShapeText::Polygon(points)
                })
            }
            IrShape::Polygon(points) => Some(ShapeText::Polygon(placed(points))),
            IrShape::Compound(parts) => {
                let part = |(at, shape): &(Pose2, IrShape)| {
                    let origin = pose.transform(at.position());
                    shape.solid(&Pose2::new(origin.x, origin.y, pose.theta + at.theta))
                };
                Some(ShapeText::Union(parts.iter().filter_map(part).collect()))
            }
            IrShape::Line(_) | IrShape::RandomCircle { .. } | IrShape::RandomPolygon(_) => None,
        }
    }

    /// What the shape is, for notes.
    pub fn kind(&self) -> &'static str {
        match self {
            IrShape::Circle { .. } | IrShape::RandomCircle { .. } => "circle",
            IrShape::Rectangle { .. } => "rectangle",
            IrShape::Polygon(_) | IrShape::RandomPolygon(_) => "polygon",
            IrShape::Line(_) => "linestring",
            IrShape::Compound(_) => "compound",
        }
    }
}

/// The first polygon drawn that a world can hold; the last one if there is none.
fn drawn_polygon(
    polygon: &RandomPolygon,
    stream: &mut Stream,
    room: &mut IrRoom,
) -> Result<Vec<Point2>, ImportProblem> {
    let mut points = Vec::new();
    for _ in 0..MAX_DRAWS {
        points = polygon.draw(stream);
        // each edge is compared with those after it
        room.take_draw(points.len() * points.len() / 2)?;
        if convex_pieces(&points).is_ok() {
            break;
        }
    }
    Ok(points)
}

/// A point of a frame at `pose`. Without a rotation the coordinates are only added.
fn place(pose: &Pose2, p: &Point2) -> Xy {
    let placed = if pose.theta == 0.0 { p + pose.position().coords } else { pose.transform(*p) };
    (placed.x, placed.y)
}

/// The corners of a rectangle, counter-clockwise from the lower left. With a wheelbase the frame lies in the middle of
/// the rear axle, which is as far from the back as the front axle from the front.
fn rectangle_corners(length: f64, width: f64, wheelbase: Option<f64>) -> [Point2; 4] {
    let (x, y) = (0.5 * length, 0.5 * width);
    let (back, front) = match wheelbase {
        None => (-x, x),
        Some(wheelbase) => (-(length - wheelbase) / 2.0, length - (length - wheelbase) / 2.0),
    };
    [(back, -y), (front, -y), (front, y), (back, y)].map(|(x, y)| Point2::new(x, y))
}

/// Whether an outline crosses itself. IR-SIM takes its bounding box then.
fn is_crossed(points: &[Point2]) -> bool {
    matches!(convex_pieces(points), Err(OutlineError::Crossing { .. }))
}

/// The corners of the box around some points, counter-clockwise from the lower left.
fn bounding_box(points: &[Point2]) -> [Point2; 4] {
    let Aabb { min, max } = Aabb::around(points).unwrap_or(Aabb::new(Point2::origin(), Point2::origin()));
    [min, Point2::new(max.x, min.y), max, Point2::new(min.x, max.y)]
}

fn flag(item: &str, key: &str, fields: &mut Fields) -> Result<bool, ImportError> {
    fields.take(key).map_or(Ok(false), |node| node.boolean(&format!("{item}.{key}")))
}

fn circle(item: &str, fields: &mut Fields, is_random: bool) -> Result<IrShape, ImportError> {
    let radius = fields.take("radius").map_or(Ok(0.2), |node| node.number(&format!("{item}.radius")))?;
    let centre = fields.take("center").map(|n| point(&format!("{item}.center"), n)).transpose()?;
    let wheelbase = fields.take("wheelbase").map(|n| n.number(&format!("{item}.wheelbase"))).transpose()?;
    let range = match fields.take("radius_range") {
        None => [0.1, 1.0],
        Some(node) => {
            let two = node.numbers(&format!("{item}.radius_range"), 2..=2, "two numbers: a range")?;
            [two[0], two[1]]
        }
    };
    let mut centre = centre.unwrap_or_default();
    centre.x += wheelbase.unwrap_or(0.0) / 2.0;
    Ok(if is_random { IrShape::RandomCircle { centre, radius: range } } else { IrShape::Circle { centre, radius } })
}

fn rectangle(item: &str, fields: &mut Fields) -> Result<IrShape, ImportError> {
    let mut side = |key: &str| fields.take(key).map(|node| node.number(&format!("{item}.{key}"))).transpose();
    let (length, width) = (side("length")?.unwrap_or(1.0), side("width")?.unwrap_or(1.0));
    Ok(IrShape::Rectangle { length, width, wheelbase: side("wheelbase")? })
}

fn polygon(item: &str, fields: &mut Fields, is_random: bool) -> Result<IrShape, ImportError> {
    let is_convex = flag(item, "is_convex", fields)?;
    if is_random {
        fields.take("vertices");
        return Ok(IrShape::RandomPolygon(RandomPolygon::take(item, fields, is_convex)?));
    }
    // the ranges of a polygon that is not random say nothing
    RandomPolygon::take(item, fields, is_convex)?;
    let Some(node) = fields.take("vertices").filter(|node| !node.is_null()) else {
        return Ok(IrShape::Polygon(bounding_box(&[Point2::new(-1.0, -1.0), Point2::new(1.0, 1.0)]).to_vec()));
    };
    let mut points = points(&format!("{item}.vertices"), node)?;
    // a ring may end where it began
    if points.len() > 3 && points.first() == points.last() {
        points.pop();
    }
    Ok(IrShape::Polygon(points))
}

fn line(item: &str, fields: &mut Fields, is_random: bool, node: &YamlNode) -> Result<IrShape, ImportError> {
    if is_random {
        return Err(unsupported(node, item, "a linestring at random"));
    }
    let at = format!("{item}.vertices");
    Ok(IrShape::Line(points(&at, fields.need("vertices")?)?))
}

fn compound(item: &str, fields: &mut Fields) -> Result<IrShape, ImportError> {
    let at = format!("{item}.parts");
    let nodes = fields.need("parts")?.list(&at)?;
    let part = |node: &YamlNode| {
        let mut inner = node.fields(&at)?;
        let pose = inner.take("pose").map(|node| node.numbers(&at, 3..=3, "three numbers: x, y, theta")).transpose()?;
        let pose = pose.map_or(Pose2::IDENTITY, |p| Pose2::new(p[0], p[1], p[2]));
        match IrShape::read(&at, &node.without("pose"))? {
            IrShape::Line(_) | IrShape::Compound(_) => Err(node.wrong(&at, "circles, rectangles and polygons")),
            shape => Ok((pose, shape)),
        }
    };
    nodes.iter().map(part).collect::<Result<_, _>>().map(IrShape::Compound)
}

fn points(item: &str, node: &YamlNode) -> Result<Vec<Point2>, ImportError> {
    node.list(item)?.iter().map(|node| point(item, node)).collect()
}

fn point(item: &str, node: &YamlNode) -> Result<Point2, ImportError> {
    let numbers = node.numbers(item, 2..=2, "two numbers: x, y")?;
    Ok(Point2::new(numbers[0], numbers[1]))
}
