//! The hall of a warehouse: its walls, the docks on the south side, pillars, and stores where no bay stands.

use std::f64::consts::FRAC_PI_2;

use super::layout::{INNER_HEIGHT, INNER_WIDTH, Layout, PITCH, point};
use super::settings::Warehouse;
use crate::geometry::{Aabb, Point2, Pose2, Shape};
use crate::worlds::{Obstacle, ObstacleKind, Place, World};

/// Width and depth of a dock, metres.
const DOCK: [f64; 2] = [3.2, 1.4];
/// Radius of a pillar, metres.
const PILLAR: f64 = 0.3;

pub(super) fn solid_box(name: String, min: Point2, max: Point2) -> Obstacle {
    Obstacle::new(name, ObstacleKind::Solid, vec![(Pose2::IDENTITY, Shape::Rectangle { min, max })])
}

/// The hall without its bays.
pub(super) fn hall(warehouse: &Warehouse, plan: &Layout) -> World {
    let bounds = plan.hall();
    let with = if warehouse.trailers { " with trailers" } else { "" };
    let name = format!("Warehouse of {}{with}, seed {}", warehouse.robots, warehouse.seed);
    let mut world = World::empty(name, bounds);
    world.obstacles.push(outer_wall(bounds));
    for column in 0..plan.columns {
        let left = plan.corner(column).x;
        for (half, at) in [0.25, 0.75].into_iter().enumerate() {
            let (number, x) = (2 * column + half + 1, left + at * INNER_WIDTH);
            let (min, max) = (point(x - 0.5 * DOCK[0], 0.0), point(x + 0.5 * DOCK[0], DOCK[1]));
            world.obstacles.push(solid_box(format!("dock {number:02}"), min, max));
            let front = point(x, DOCK[1] + 0.4);
            let pose = Pose2 { x: front.x, y: front.y, theta: -FRAC_PI_2 };
            world.places.push(Place { name: format!("at dock {number:02}"), pose });
        }
    }
    for store in plan.bays..plan.columns * plan.rows {
        let min = plan.corner(store);
        let max = point(min.x + INNER_WIDTH, min.y + INNER_HEIGHT);
        world.obstacles.push(solid_box(format!("store {}", store - plan.bays + 1), min, max));
    }
    let (origin, crossings) = (plan.corner(0), (plan.columns - 1) * (plan.rows - 1));
    for crossing in 0..crossings {
        let (column, row) = (crossing % (plan.columns - 1) + 1, crossing / (plan.columns - 1) + 1);
        let at = point(
            origin.x + column as f64 * PITCH[0] - 0.5 * (PITCH[0] - INNER_WIDTH),
            origin.y + row as f64 * PITCH[1] - 0.5 * (PITCH[1] - INNER_HEIGHT),
        );
        let piece = (Pose2 { x: at.x, y: at.y, theta: 0.0 }, Shape::Disc { radius: PILLAR });
        world.obstacles.push(Obstacle::new(format!("pillar {:04}", crossing + 1), ObstacleKind::Solid, vec![piece]));
    }
    world
}

fn outer_wall(Aabb { min, max }: Aabb) -> Obstacle {
    let corners = [min, Point2::new(max.x, min.y), max, Point2::new(min.x, max.y)];
    let side = |i: usize| (Pose2::IDENTITY, Shape::Segment { a: corners[i], b: corners[(i + 1) % 4] });
    Obstacle::new("the outer wall", ObstacleKind::Wall, (0..4).map(side).collect())
}
