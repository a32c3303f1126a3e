//! Draws robots, their traces and their sensors' scans, as items.

mod arm;
mod car;
mod frame;
mod gait;
mod rover;

use super::outline::polygon_of;
use super::world::Thing;
use super::{Drawing, Fill, Glyph, Item, Line, Role};
use crate::geometry::{Footprint, Part, Point2, Pose2, Shape, Vector2};
use crate::num;
use crate::robots::AnyRobot;
use crate::sensors::{FanSensor, RangeSensor};

pub use gait::Gait;

/// A robot to be drawn.
#[derive(Clone, Debug)]
pub struct RobotDrawing<'a> {
    /// Its unique name.
    pub name: &'a str,
    /// Its footprint.
    pub footprint: &'a Footprint,
    /// Its heading, radians, if the footprint does not show it (a disc).
    pub heading: Option<f64>,
    /// The robot with its own sizes, if it is one of the lab's: it is drawn with wheels and all. Any other is drawn by
    /// its footprint.
    pub model: Option<AnyRobot>,
    /// How its wheels stand.
    pub gait: Gait,
    /// Whether it is drawn in contact.
    pub in_contact: bool,
}

/// The items of a footprint alone: its parts in one role, filled at this opacity, with a thin edge.
pub fn footprint(id: &str, name: &str, footprint: &Footprint, role: Role, opacity: f64) -> Vec<Item> {
    let parts = footprint.parts().iter().enumerate();
    parts.map(|(i, part)| part_item(format!("{id}/{i}"), name, part, role, opacity)).collect()
}

fn part_item(id: String, name: &str, part: &Part, role: Role, opacity: f64) -> Item {
    let placed = part.placed();
    let edge = Line::solid(1.0);
    let drawing = match placed.core() {
        [centre] => Drawing::Disc { centre: *centre, radius: placed.radius() },
        [a, b] if placed.radius() == 0.0 => {
            let line = Line::solid(3.0).at_opacity(num::greater(opacity, 0.5));
            return Item::new(id, name, role, Drawing::segment(*a, *b)).stroked(line);
        }
        [a, b] => Drawing::Capsule { a: *a, b: *b, radius: placed.radius() },
        _ => Drawing::Polygon(polygon_of(placed)),
    };
    Item::new(id, name, role, drawing).filled(Fill::Tint(opacity)).stroked(edge)
}

/// The items of a robot, in the goal's colour while in contact.
///
/// The footprint, which is what counts, has a thin edge; what is drawn in it is filled at 85 %. A disc has a nose, one
/// of the lab's rovers wheels as well; a car rounded corners, a windscreen, wheels and with a trailer a drawbar; an arm
/// a base plate, joints and a gripper.
pub fn robot(drawing: &RobotDrawing<'_>) -> Vec<Item> {
    let role = if drawing.in_contact { Role::Goal } else { Role::Robot };
    let RobotDrawing { name, footprint: covered, heading, model, gait, .. } = drawing;
    let id = Thing::Robot(name).to_string();
    let parts = covered.parts();
    let item = |part: &str, role, drawn| Item::new(format!("{id}/{part}"), *name, role, drawn);
    let is_car = matches!(model, Some(AnyRobot::Hitch(_)));
    let mut items: Vec<Item> = arm::plate(&id, name, covered).into_iter().collect();
    items.extend(footprint(&id, name, covered, role, if is_car { 0.2 } else { 0.85 }));
    if let ([part], Some(heading)) = (parts, *heading) {
        let (centre, radius) = (part.pose().position(), part.placed().radius());
        if let Some(AnyRobot::Rusty(rover)) = model {
            let pose = Pose2 { x: centre.x, y: centre.y, theta: heading };
            items.extend(rover::wheels(&id, name, rover, &pose, gait));
        }
        let nose = Drawing::Nose { centre, radius, heading };
        items.push(item("heading", Role::Paper, nose).filled(Fill::Tint(0.9)));
    }
    if let Some(AnyRobot::Hitch(car)) = model {
        items.extend(car::bodies(&id, name, covered, role));
        items.extend(car::marks(&id, name, car, covered, role, gait));
    }
    if let Some((pose, Shape::Rectangle { min, max })) = parts.first().map(|p| (p.pose(), p.shape())) {
        let chevron = Drawing::Polyline(chevron(pose, *min, *max).to_vec());
        items.push(item("heading", Role::Paper, chevron).stroked(Line::solid(1.5)));
        if parts.len() > 1 {
            let mark = Drawing::Mark { at: pose.position(), glyph: Glyph::Ring, radius_px: 2.5 };
            items.push(item("hitch", role, mark));
        }
    }
    items.extend(arm::marks(&id, name, covered, role));
    items
}

/// The corners of the pointer on a disc: the tip ahead, then left and right behind. They lie inside the disc, so that
/// a heading scales with its robot and is in the world where the robot is.
pub fn nose(centre: Point2, radius: f64, heading: f64) -> [Point2; 3] {
    let (s, c) = num::sin_cos(heading);
    let (ahead, left) = (Vector2::new(c, s) * radius, Vector2::new(-s, c) * radius);
    [centre + ahead * 0.9, centre - ahead * 0.5 + left * 0.6, centre - ahead * 0.5 - left * 0.6]
}

/// A chevron near the front of a rectangle, pointing along its x axis.
pub fn chevron(pose: &Pose2, min: Point2, max: Point2) -> [Point2; 3] {
    let half = 0.28 * (max.y - min.y);
    let middle = 0.5 * (max.y + min.y);
    let tip = max.x - 0.12 * (max.x - min.x);
    [(tip - half, middle + half), (tip, middle), (tip - half, middle - half)]
        .map(|(x, y)| pose.transform(Point2::new(x, y)))
}

/// The path that a robot took, as a line.
pub fn trace(id: &str, name: &str, points: &[Point2]) -> Item {
    Item::new(id, name, Role::Path, Drawing::Polyline(points.to_vec())).stroked(Line::solid(1.5).at_opacity(0.9))
}

/// The scan of a range sensor that sees all around. Ray k starts at `pose`, with bearing 2 pi k / n from its heading.
/// Ranges are in metres; rays whose range is not finite are left out. Rays are drawn at a quarter of the opacity, their
/// ends as dots.
pub fn scan(id: &str, name: &str, pose: &Pose2, ranges: &[f64]) -> Item {
    fan_scan(id, name, &ScanDrawing { pose: *pose, field_of_view: std::f64::consts::TAU, ranges })
}

/// The id of the item that shows a scan: of the sensor that a run gives to its rovers, which has the empty name, and of
/// any other.
pub fn scan_id(robot: &str, sensor: &str) -> String {
    if sensor.is_empty() { format!("scan/{robot}") } else { format!("scan/{robot}/{sensor}") }
}

/// A scan to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanDrawing<'a> {
    /// The sensor's pose in the world.
    pub pose: Pose2,
    /// The sensor's field of view, radians.
    pub field_of_view: f64,
    /// The range of each ray, metres.
    pub ranges: &'a [f64],
}

/// As [`scan`], of a sensor with any field of view.
pub fn fan_scan(id: &str, name: &str, drawing: &ScanDrawing<'_>) -> Item {
    let ScanDrawing { pose, field_of_view, ranges } = *drawing;
    let sensor = RangeSensor { n_rays: ranges.len() as u32, max_range: f64::INFINITY };
    let rays = FanSensor { sensor, field_of_view };
    let end = |(k, range): (usize, &f64)| {
        let (s, c) = num::sin_cos(pose.theta + rays.bearing(k as u32));
        range.is_finite().then(|| pose.position() + Vector2::new(c, s) * *range)
    };
    let ends = ranges.iter().enumerate().filter_map(end).collect();
    Item::new(id, name, Role::Sensor, Drawing::Rays { from: pose.position(), ends })
        .filled(Fill::Tint(0.9))
        .stroked(Line::solid(0.75).at_opacity(0.25))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::{HitchCfg, T2};
    use crate::robots::{HITCH, RUSTY, Reach, Robot};

    fn ids(drawing: &RobotDrawing<'_>) -> Vec<String> {
        robot(drawing).into_iter().map(|i| i.id).collect()
    }

    #[test]
    fn each_robot_shows_which_way_it_faces() {
        let rusty = Footprint::disc(Point2::new(1.0, 2.0), 0.11);
        let towing = HITCH.with_trailer().footprint(&HitchCfg { body: Pose2::IDENTITY, trailer: Some(0.0) });
        let arm = Reach::<2>::choset().footprint(&T2::new(0.3, 0.4));
        let show = |name, footprint, heading, model| {
            ids(&RobotDrawing { name, footprint, heading, model, gait: Gait::default(), in_contact: false })
        };
        // of a robot that the lab does not know
        assert_eq!(show("R", &rusty, Some(0.1), None), ["robot/R/0", "robot/R/heading"]);
        assert_eq!(show("H", &towing, None, None), ["robot/H/0", "robot/H/1", "robot/H/heading", "robot/H/hitch"]);
        let own = |kind: &str, all: &[&str]| {
            let found = match kind {
                "R" => show("R", &rusty, Some(0.1), Some(AnyRobot::Rusty(RUSTY))),
                "H" => show("H", &towing, None, Some(AnyRobot::Hitch(HITCH.with_trailer()))),
                _ => show("A", &arm, None, None),
            };
            for part in all {
                assert!(found.contains(&format!("robot/{kind}/{part}")), "{part} of {found:?}");
            }
        };
        own("R", &["0", "left wheel", "right wheel", "heading"]);
        own("H", &["0", "1", "body 0", "body 1", "windscreen", "left front wheel", "right trailer wheel", "drawbar"]);
        own("A", &["plate", "0", "1", "joint 1", "joint 2", "gripper", "tip"]);
    }

    #[test]
    fn contact_borrows_the_goals_colour() {
        let footprint = Footprint::disc(Point2::new(1.0, 2.0), 0.11);
        for (in_contact, role) in [(false, Role::Robot), (true, Role::Goal)] {
            let (gait, model) = (Gait::default(), None);
            let drawing =
                RobotDrawing { name: "R", footprint: &footprint, heading: Some(0.0), model, gait, in_contact };
            let roles: Vec<Role> = robot(&drawing).iter().map(|i| i.role).collect();
            assert_eq!(roles, [role, Role::Paper], "the body, and on it the heading");
        }
    }

    #[test]
    fn the_chevron_points_ahead_and_a_scan_leaves_out_what_it_did_not_hit() {
        let tip =
            chevron(&Pose2::new(0.0, 0.0, std::f64::consts::FRAC_PI_2), Point2::new(-1.0, -1.0), Point2::new(3.0, 1.0));
        assert!(tip[1].y > tip[0].y && tip[1].y > tip[2].y && tip[1].x.abs() < 1e-12);
        let item = scan("s", "s", &Pose2::new(1.0, 0.0, 0.0), &[2.0, f64::INFINITY, 1.0, 1.5]);
        let Drawing::Rays { ends, .. } = item.drawing else { panic!("rays") };
        assert_eq!(ends.len(), 3);
        assert_eq!(ends[0], Point2::new(3.0, 0.0));
        assert!((ends[1] - Point2::new(0.0, 0.0)).norm() < 1e-15, "ray 2 of 4 looks back");
    }
}
