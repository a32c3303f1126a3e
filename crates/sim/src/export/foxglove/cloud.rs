//! Worlds, robots, paths and scans as clouds of coloured points: what Rerun draws, which knows no scene entities.

use crate::simulation::{RobotView, SensorView};
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::num;
use motion_lab_core::picture::{Role, polygon_of};
use motion_lab_core::worlds::World;

use super::frames;
use super::message::{PackedElementField, PointCloud, Pose, Timestamp, numeric};
use super::paths::RunPath;
use super::scene::colour;

/// Bytes of a point: three floats, four colour channels.
const STRIDE: u32 = 16;
/// The distance of a world's points along its lines, metres.
const SPACING: f64 = 0.05;
/// The largest number of points between the corners of a world; of a larger one the points are farther apart.
const MAX_POINTS: f64 = 100_000.0;
/// The number of points between the corners of a robot's part.
const AROUND: f64 = 128.0;

/// Points that are being gathered, in one frame of reference.
#[derive(Default)]
struct Cloud(Vec<u8>);

impl Cloud {
    fn point(&mut self, p: Point2, role: Role) {
        for x in [p.x, p.y, 0.0] {
            self.0.extend((x as f32).to_le_bytes());
        }
        let colour = colour(role, 1.0);
        self.0.extend([colour.r, colour.g, colour.b, colour.a].map(|channel| (channel * 255.0).round() as u8));
    }

    /// The corners of a line and points between them, at most `spacing` apart.
    fn line(&mut self, corners: &[Point2], spacing: f64, role: Role) {
        for side in corners.windows(2) {
            let [a, b] = [side[0], side[1]];
            let steps = ((b - a).norm() / spacing).ceil();
            for k in 0..steps as u32 {
                self.point(a + (b - a) * (f64::from(k) / steps), role);
            }
        }
        corners.last().into_iter().for_each(|&p| self.point(p, role));
    }

    fn message(self, tick: u64, frame_id: String) -> PointCloud {
        let field = |(k, name): (u32, &str)| {
            let (offset, r#type) = if k < 3 { (4 * k, numeric::FLOAT32) } else { (9 + k, numeric::UINT8) };
            PackedElementField { name: name.to_owned(), offset, r#type }
        };
        PointCloud {
            timestamp: Some(Timestamp::of_tick(tick)),
            frame_id,
            pose: Some(Pose::raised(0.0)),
            point_stride: STRIDE,
            fields: (0..).zip(["x", "y", "z", "red", "green", "blue", "alpha"]).map(field).collect(),
            data: self.0,
        }
    }
}

/// A polygon's corners, the first again at the end; of a segment its ends.
fn closed(mut corners: Vec<Point2>) -> Vec<Point2> {
    if corners.len() > 2 {
        corners.extend(corners.first().copied());
    }
    corners
}

fn length(line: &[Point2]) -> f64 {
    line.windows(2).map(|side| (side[1] - side[0]).norm()).sum()
}

/// The marks of a world and the edges of its obstacles, walls and closed doors.
pub fn world(tick: u64, world: &World) -> PointCloud {
    let mut lines: Vec<(Vec<Point2>, Role)> =
        world.marks.iter().map(|mark| (mark.points.clone(), Role::Muted)).collect();
    let doors: Vec<_> = world.closed_doors().collect();
    let pieces = world.obstacles.iter().chain(&doors).flat_map(|obstacle| &obstacle.pieces);
    lines.extend(pieces.map(|(pose, shape)| (closed(polygon_of(&shape.place(pose))), Role::Obstacle)));
    let all: f64 = lines.iter().map(|(line, _)| length(line)).sum();
    let mut cloud = Cloud::default();
    for (line, role) in &lines {
        cloud.line(line, num::greater(SPACING, all / MAX_POINTS), *role);
    }
    cloud.message(tick, frames::of_world(world))
}

/// The shape and the colour of a robot's part; `None` without such a part. It is red while a contact flashes.
pub fn look(robot: &RobotView, part: usize) -> Option<(&Shape, Role)> {
    let role = if robot.flash > 0 { Role::Goal } else { Role::Robot };
    Some((robot.footprint.parts().get(part)?.shape(), role))
}

/// The edge of a robot's part in the part's frame; no point without such a part.
pub fn part(tick: u64, robot: &RobotView, part: usize) -> PointCloud {
    let mut cloud = Cloud::default();
    if let Some((shape, role)) = look(robot, part) {
        let edge = closed(polygon_of(&shape.place(&Pose2::IDENTITY)));
        cloud.line(&edge, length(&edge) / AROUND, role);
    }
    cloud.message(tick, frames::of_part(&robot.name, part))
}

/// The points of a robot's path in the whole run, in its world's frame.
pub fn path(path: &RunPath) -> PointCloud {
    let mut cloud = Cloud::default();
    path.points.iter().for_each(|&p| cloud.point(p, Role::Path));
    cloud.message(0, path.frame.clone())
}

/// Where the contacts of a robot began in the whole run, in its world's frame.
pub fn contacts(path: &RunPath) -> PointCloud {
    let mut cloud = Cloud::default();
    path.contacts.iter().for_each(|&p| cloud.point(p, Role::Goal));
    cloud.message(0, path.frame.clone())
}

/// What a sensor hits, in its world's frame: a point for each ray with a finite range.
pub fn scan(tick: u64, sensor: &SensorView, world: &World) -> PointCloud {
    let mut cloud = Cloud::default();
    for (ray, range) in sensor.ranges.iter().enumerate().filter(|(_, range)| range.is_finite()) {
        let (s, c) = num::sin_cos(sensor.rays.bearing(ray as u32));
        cloud.point(sensor.pose.transform(Point2::new(range * c, range * s)), Role::Sensor);
    }
    cloud.message(tick, frames::of_world(world))
}
