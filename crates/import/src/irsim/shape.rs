//! The shapes of IR-SIM's objects.

use crate::yaml::YamlNode;
use crate::{ImportError, WorldDraft};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::worlds::{ShapeText, WorldProblem, Xy};

/// A shape in its object's frame.
pub(crate) enum IrShape {
    Circle { center: Point2, radius: f64 },
    Rectangle { length: f64, width: f64 },
    Polygon(Vec<Point2>),
    Line(Vec<Point2>),
}

impl IrShape {
    /// Reads a shape. Errors name it `item`.
    pub fn read(item: &str, node: &YamlNode) -> Result<IrShape, ImportError> {
        let mut fields = node.fields(item)?;
        let name = fields.need("name")?;
        let (shape, known) = match name.text(item)? {
            "circle" => {
                let radius = fields.take("radius").map_or(Ok(0.2), |node| node.number(&format!("{item}.radius")))?;
                let center = fields.take("center").map(|n| point(&format!("{item}.center"), n)).transpose()?;
                (IrShape::Circle { center: center.unwrap_or_default(), radius }, "name, radius and center")
            }
            "rectangle" => {
                let mut side = |key: &'static str| fields.need(key)?.number(&format!("{item}.{key}"));
                let (length, width) = (side("length")?, side("width")?);
                (IrShape::Rectangle { length, width }, "name, length and width")
            }
            kind @ ("polygon" | "linestring") => {
                let at = format!("{item}.vertices");
                let vertices = fields.need("vertices")?.list(&at)?;
                let points = vertices.iter().map(|node| point(&at, node)).collect::<Result<_, _>>()?;
                (if kind == "polygon" { IrShape::Polygon(points) } else { IrShape::Line(points) }, "name and vertices")
            }
            _ => return Err(name.wrong(&format!("{item}.name"), "circle, rectangle, polygon or linestring")),
        };
        fields.finish(known)?;
        Ok(shape)
    }

    /// The name of an object of this shape, before its number.
    pub fn stem(&self, painted: bool) -> &'static str {
        match self {
            _ if painted => "mark",
            IrShape::Circle { .. } => "disc",
            IrShape::Rectangle { .. } => "box",
            IrShape::Polygon(_) => "polygon",
            IrShape::Line(_) => "wall",
        }
    }

    /// Adds an object of this shape with its frame at `pose`; if `painted`, as a mark. A painted circle is left out,
    /// with a note.
    pub fn put(&self, pose: &Pose2, painted: bool, name: String, draft: &mut WorldDraft) -> Result<(), WorldProblem> {
        let place = |p: &Point2| {
            // without a rotation the coordinates are only added
            let placed = if pose.theta == 0.0 { p + pose.position().coords } else { pose.transform(*p) };
            (placed.x, placed.y)
        };
        let corners = |length: f64, width: f64| {
            let (x, y) = (0.5 * length, 0.5 * width);
            [(-x, -y), (x, -y), (x, y), (-x, y)].map(|(x, y)| Point2::new(x, y))
        };
        let placed = |points: &[Point2]| points.iter().map(place).collect::<Vec<Xy>>();
        match self {
            IrShape::Circle { .. } if painted => {
                draft.note(format!("{name}, a circle that nothing collides with, is left out"));
                Ok(())
            }
            IrShape::Circle { center, radius } => {
                draft.world.solid(name, ShapeText::Disc { center: place(center), radius: *radius })
            }
            IrShape::Rectangle { length, width } if painted => {
                draft.world.mark(name, placed(&corners(*length, *width)), true)
            }
            IrShape::Rectangle { length, width } => {
                let points = placed(&corners(*length, *width));
                let shape = if pose.theta == 0.0 {
                    ShapeText::Box { min: points[0], max: points[2] }
                } else {
                    ShapeText::Polygon(points)
                };
                draft.world.solid(name, shape)
            }
            IrShape::Polygon(points) if painted => draft.world.mark(name, placed(points), true),
            IrShape::Polygon(points) => draft.world.solid(name, ShapeText::Polygon(placed(points))),
            IrShape::Line(points) if painted => draft.world.mark(name, placed(points), false),
            IrShape::Line(points) => draft.world.wall(name, placed(points), false),
        }
    }
}

fn point(item: &str, node: &YamlNode) -> Result<Point2, ImportError> {
    let numbers = node.numbers(item, 2..=2, "two numbers: x, y")?;
    Ok(Point2::new(numbers[0], numbers[1]))
}
