//! A bay of a warehouse: aisles with racks and rovers, cells with arms, and a road with cars. All lengths are metres.

use super::hall::solid_box;
use super::layout::{AISLES, INNER_HEIGHT, INNER_WIDTH, Layout, ROW_ARMS, TO_ROAD, point, share, tidy};
use super::settings::Warehouse;
use super::trailer::trailer_heading;
use crate::configuration::{ArmSizes, CarSizes, RobotKind, Sizes, TrailerSizes};
use crate::geometry::Point2;
use crate::random::Stream;
use crate::worlds::{Mark, Resident, Route, RoutePath, World};

/// Width and height of an aisle's route, metres.
const LOOP: [f64; 2] = [2.0, 10.4];
/// Gap between the routes of two neighbouring aisles, metres.
const LOOPS_APART: f64 = 0.6;
/// Gap between an aisle's route and its racks, and the radius of its corners, metres. The middle of a corner's arc is a
/// rack's corner.
const TO_RACK: f64 = 0.4;
/// Racks in a row, and the gap between two.
const RACKS: usize = 4;
const RACK_GAP: f64 = 0.1;
/// One rack in this many is missing.
const MISSING: u64 = 10;

/// Side of an arm's cell.
const CELL: f64 = 2.1;
/// Lengths of an arm's links, and their radius. Stretched out it stays 12 cm within its cell.
const LINKS: [f64; 2] = [0.5, 0.4];
const LINK_RADIUS: f64 = 0.03;
/// Width and height of a bin between two cells, and how far inside of the bay it stands.
const BIN: [f64; 2] = [0.3, 0.6];
const TO_BIN: f64 = 0.1;

/// Radius of a road's corners.
const ROAD_RADIUS: f64 = 2.4;

/// A tug of 1.8 m and its trailer.
const CAR: CarSizes = CarSizes {
    wheelbase: 1.2,
    length: 1.8,
    width: 0.9,
    rear_overhang: 0.3,
    max_steer: 0.6,
    trailer: TrailerSizes { hitch_len: 1.3, width: 0.8, front_overhang: 0.5, rear_overhang: 0.5, jackknife: None },
};

/// Adds bay number `bay` to the hall, and its robots after those who are there.
pub(super) fn furnish(world: &mut World, warehouse: &Warehouse, plan: &Layout, bay: usize) {
    let mut draws = Stream::new(warehouse.seed, &format!("warehouse/bay {bay}"));
    let (corner, crew) = (plan.corner(bay), plan.crew(bay));
    for aisle in 0..AISLES {
        let left = corner.x + aisle as f64 * (LOOP[0] + LOOPS_APART);
        let min = point(left, corner.y + 0.5 * (INNER_HEIGHT - LOOP[1]));
        let max = point(min.x + LOOP[0], min.y + LOOP[1]);
        racks(world, &mut draws, min, max);
        let name = format!("aisle {:04}", bay * AISLES + aisle + 1);
        // 0.30 to 0.45 m/s
        let speed = tidy(0.3 + 0.01 * draws.below(16) as f64);
        let route = clockwise(name, min, max, TO_RACK, speed);
        let rovers = share(crew.rovers, AISLES, aisle);
        spread(world, &mut draws, route, rovers, |name, path, s| {
            let pose = path.at(s);
            let start = [tidy(pose.x), tidy(pose.y), heading(pose.theta)];
            Resident::new(format!("rover {name}"), RobotKind::RUSTY.name, start)
        });
    }
    let (min, max) = (
        point(corner.x - TO_ROAD, corner.y - TO_ROAD),
        point(corner.x + INNER_WIDTH + TO_ROAD, corner.y + INNER_HEIGHT + TO_ROAD),
    );
    // 0.60 to 0.90 m/s
    let speed = tidy(0.6 + 0.01 * draws.below(31) as f64);
    let route = clockwise(format!("road {:04}", bay + 1), min, max, ROAD_RADIUS, speed);
    spread(world, &mut draws, route, crew.cars, |name, path, s| {
        let pose = path.at(s);
        let mut start = vec![tidy(pose.x), tidy(pose.y), heading(pose.theta)];
        if warehouse.trailers {
            start.push(heading(trailer_heading(path, s, CAR.trailer.hitch_len)));
        }
        Resident::new(format!("car {name}"), RobotKind::HITCH.name, start).with_sizes(Sizes::Car(CAR))
    });
    cells(world, &mut draws, bay, corner, crew.arms);
}

/// An angle cut to four decimals, whose text is short. Cut and not rounded, pi stays in range.
fn heading(theta: f64) -> f64 {
    (theta * 1e4).trunc() / 1e4 + 0.0
}

/// The clockwise route about a rectangle.
fn clockwise(name: String, min: Point2, max: Point2, radius: f64, speed: f64) -> Route {
    let points = vec![min, Point2::new(min.x, max.y), max, Point2::new(max.x, min.y)];
    Route { name, points, radius, speed }
}

/// Adds a route and `count` robots on it, evenly spread from a place that the seed chooses. `robot` makes one of its
/// number, the route's line and the arc length at which it starts.
fn spread(
    world: &mut World,
    draws: &mut Stream,
    route: Route,
    count: usize,
    robot: impl Fn(String, &RoutePath, f64) -> Resident,
) {
    let first = draws.unit();
    // a route of the plan is one: a test generates every kind of warehouse
    if let Ok(path) = route.path() {
        for i in 0..count {
            let s = path.length() * (first + i as f64) / count as f64;
            let number = format!("{:05}", world.robots.len());
            world.robots.push(robot(number, &path, s).with_route(&route.name));
        }
    }
    world.routes.push(route);
}

/// The racks within an aisle's route, one after the other; some are missing.
fn racks(world: &mut World, draws: &mut Stream, min: Point2, max: Point2) {
    let (low, high) = (min.y + TO_RACK, max.y - TO_RACK);
    let step = (high - low + RACK_GAP) / RACKS as f64;
    for i in 0..RACKS {
        // the racks at the ends are there in any case: the corners of the route go about them
        let missing = draws.below(MISSING) == 0 && i % (RACKS - 1) != 0;
        if !missing {
            let from = low + i as f64 * step;
            let name = format!("rack {:05}", world.obstacles.len());
            let rack = solid_box(name, point(min.x + TO_RACK, from), point(max.x - TO_RACK, from + step - RACK_GAP));
            world.obstacles.push(rack);
        }
    }
}

/// The two rows of cells of a bay, and its arms, evenly spread over them.
fn cells(world: &mut World, draws: &mut Stream, bay: usize, corner: Point2, arms: usize) {
    let all = 2 * ROW_ARMS;
    let pitch = INNER_WIDTH / ROW_ARMS as f64;
    for cell in 0..all {
        let (column, upper) = (cell % ROW_ARMS, cell / ROW_ARMS == 1);
        let y = if upper { INNER_HEIGHT - 0.5 * CELL } else { 0.5 * CELL };
        let base = point(corner.x + (column as f64 + 0.5) * pitch, corner.y + y);
        if column > 0 {
            let (x, low) = (base.x - 0.5 * pitch, if upper { INNER_HEIGHT - TO_BIN - BIN[1] } else { TO_BIN });
            let (min, max) =
                (point(x - 0.5 * BIN[0], corner.y + low), point(x + 0.5 * BIN[0], corner.y + low + BIN[1]));
            world.obstacles.push(solid_box(format!("bin {:05}", world.obstacles.len()), min, max));
        }
        let half = 0.5 * CELL;
        let points = [(-half, -half), (half, -half), (half, half), (-half, half), (-half, -half)];
        let points = points.map(|(x, y)| point(base.x + x, base.y + y)).to_vec();
        world.marks.push(Mark { name: format!("cell {:05}", bay * all + cell + 1), points });
        // drawn for an empty cell too
        let start = [(); 2].map(|()| heading(draws.uniform(-3.0, 3.0)));
        if share(arms, all, cell) > 0 {
            let sizes = Sizes::Arm(ArmSizes { base, lengths: LINKS.to_vec(), radius: LINK_RADIUS });
            let name = format!("arm {:05}", world.robots.len());
            world.robots.push(Resident::new(name, RobotKind::REACH.name, start).with_sizes(sizes));
        }
    }
}
