//! A world as canonical text, and its hash.

use std::f64::consts::TAU;
use std::fmt::{self, Write};

use xxhash_rust::xxh3::xxh3_128;

use super::sizes::sizes_text;
use crate::geometry::{Point2, Pose2, Shape};
use crate::worlds::{BeamModel, Obstacle, ObstacleKind, ResidentSensor, SourceShape, WORLD_VERSION, World};

impl World {
    /// Prints the world as a world file: one item a line, every number with the shortest digits that read back as the
    /// same bits.
    ///
    /// Reading the text gives an equal world, which prints as the same text. This holds for every world that
    /// [`parse`](Self::parse) made. In a world assembled by hand, a piece that the format cannot express, such as a
    /// turned box, becomes the hull of its placed vertices, and a wall whose pieces do not form a chain becomes a solid
    /// obstacle.
    pub fn to_ron(&self) -> String {
        let mut text = String::new();
        // writing to a String never fails
        let _ = self.write_ron(&mut text);
        text
    }

    /// The xxh3-128 hash of [`to_ron`](Self::to_ron). It depends on the world's content, not on the comments or blanks
    /// of its file.
    pub fn content_hash(&self) -> u128 {
        xxh3_128(self.to_ron().as_bytes())
    }

    fn write_ron(&self, out: &mut String) -> fmt::Result {
        let (min, max) = (PrintedXy(self.bounds.min), PrintedXy(self.bounds.max));
        writeln!(out, "World(\n    version: {WORLD_VERSION},\n    name: {},", Quoted(&self.name))?;
        writeln!(out, "    bounds: (min: {min}, max: {max}),")?;
        let (mut walls, mut solids) = (Vec::new(), Vec::new());
        for obstacle in &self.obstacles {
            let name = Quoted(&obstacle.name);
            match chain(obstacle) {
                Some(points) => walls.push(format!("name: {name}, points: {}", PrintedPoints(&points))),
                None => solids.push(format!("name: {name}, shape: {}", shape_text(obstacle))),
            }
        }
        let doors = self.doors.iter().map(|d| {
            let (name, hinge, end) = (Quoted(&d.name), PrintedXy(d.a), PrintedXy(d.b));
            format!("name: {name}, hinge: {hinge}, end: {end}, open: {}", d.open)
        });
        let routes = self.routes.iter().map(|r| {
            let (name, points) = (Quoted(&r.name), PrintedPoints(&r.points));
            format!("name: {name}, points: {points}, radius: {:?}, speed: {:?}", r.radius, r.speed)
        });
        let places = self.places.iter().map(|p| {
            let Pose2 { x, y, theta } = p.pose;
            format!("name: {}, pose: (x: {x:?}, y: {y:?}, theta: {theta:?})", Quoted(&p.name))
        });
        let marks =
            self.marks.iter().map(|m| format!("name: {}, points: {}", Quoted(&m.name), PrintedPoints(&m.points)));
        let robots = self.robots.iter().map(|r| {
            let head = format!("name: {}, kind: {}, start: {:?}", Quoted(&r.name), Quoted(&r.kind), r.start);
            let noise = r.sensor.map_or(String::new(), |noise| format!(", sensor: {}", noise_text(&noise)));
            let sensors: Vec<String> = r.sensors.iter().map(sensor_text).collect();
            let sensors =
                if sensors.is_empty() { String::new() } else { format!(", sensors: [{}]", sensors.join(", ")) };
            let route = r.route.as_ref().map_or(String::new(), |name| format!(", route: {}", Quoted(name)));
            format!("{head}{}{noise}{sensors}{route}", sizes_text(r.sizes.as_ref()))
        });
        write_list(out, "walls", walls)?;
        write_list(out, "obstacles", solids)?;
        // a world without doors or routes keeps the text and the hash that it had before there were any
        if !self.doors.is_empty() {
            write_list(out, "doors", doors)?;
        }
        if !self.routes.is_empty() {
            write_list(out, "routes", routes)?;
        }
        write_list(out, "places", places)?;
        write_list(out, "marks", marks)?;
        write_list(out, "robots", robots)?;
        out.write_str(")\n")
    }
}

/// A sensor, without what is as if left out.
fn sensor_text(sensor: &ResidentSensor) -> String {
    let ResidentSensor { name, rays, mount, noise } = sensor;
    let (n_rays, range) = (rays.sensor.n_rays, rays.sensor.max_range);
    let mut text = format!("name: {}, rays: {n_rays}, range: {range:?}", Quoted(name));
    if rays.field_of_view != TAU {
        text += &format!(", field_of_view: {:?}", rays.field_of_view);
    }
    if *mount != Pose2::IDENTITY {
        text += &format!(", mount: (x: {:?}, y: {:?}, theta: {:?})", mount.x, mount.y, mount.theta);
    }
    if let Some(noise) = noise {
        text += &format!(", noise: {}", noise_text(noise));
    }
    format!("({text})")
}

fn noise_text(noise: &BeamModel) -> String {
    let fields: Vec<String> = noise.named().iter().map(|(name, value)| format!("{name}: {value:?}")).collect();
    format!("({})", fields.join(", "))
}

fn write_list(out: &mut String, list: &str, items: impl IntoIterator<Item = String>) -> fmt::Result {
    writeln!(out, "    {list}: [")?;
    for item in items {
        writeln!(out, "        ({item}),")?;
    }
    out.write_str("    ],\n")
}

/// Joins the segments of a wall into one polyline; `None` if they do not form a chain.
fn chain(obstacle: &Obstacle) -> Option<Vec<Point2>> {
    if obstacle.kind != ObstacleKind::Wall {
        return None;
    }
    let mut points: Vec<Point2> = Vec::with_capacity(obstacle.pieces.len() + 1);
    for (pose, shape) in &obstacle.pieces {
        match shape {
            Shape::Segment { a, b } if *pose == Pose2::IDENTITY && points.last().is_none_or(|last| last == a) => {
                if points.is_empty() {
                    points.push(*a);
                }
                points.push(*b);
            }
            _ => return None,
        }
    }
    (points.len() >= 2).then_some(points)
}

fn shape_text(obstacle: &Obstacle) -> String {
    let text = |written: &SourceShape<'_>| match written {
        SourceShape::Outline(points) => format!("Polygon({})", PrintedPoints(points)),
        SourceShape::Piece((pose, shape)) => piece_text(pose, shape),
    };
    match &obstacle.written()[..] {
        [one] => text(one),
        several => format!("Union([{}])", several.iter().map(text).collect::<Vec<_>>().join(", ")),
    }
}

fn piece_text(pose: &Pose2, shape: &Shape) -> String {
    let at_origin = *pose == Pose2::IDENTITY;
    match shape {
        Shape::Disc { radius } => format!("Disc(center: {}, radius: {radius:?})", PrintedXy(pose.position())),
        Shape::Rectangle { min, max } if at_origin => {
            format!("Box(min: {}, max: {})", PrintedXy(*min), PrintedXy(*max))
        }
        Shape::Polygon(polygon) if at_origin => format!("Polygon({})", PrintedPoints(polygon.vertices())),
        _ => {
            let placed = shape.place(pose);
            format!("Rounded(points: {}, radius: {:?})", PrintedPoints(placed.core()), placed.radius())
        }
    }
}

/// A point as `(x, y)`. `{:?}` of an `f64` prints the shortest digits that read back as the same bits.
struct PrintedXy(Point2);

impl fmt::Display for PrintedXy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({:?}, {:?})", self.0.x, self.0.y)
    }
}

struct PrintedPoints<'a>(&'a [Point2]);

impl fmt::Display for PrintedPoints<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('[')?;
        for (i, p) in self.0.iter().enumerate() {
            write!(f, "{}{}", if i == 0 { "" } else { ", " }, PrintedXy(*p))?;
        }
        f.write_char(']')
    }
}

/// A name as RON text. Names have no control characters, so quotes and backslashes are all that needs escaping.
struct Quoted<'a>(&'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{}\"", self.0.replace('\\', "\\\\").replace('"', "\\\""))
    }
}
