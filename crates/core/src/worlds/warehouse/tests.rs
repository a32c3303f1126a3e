//! What a generated warehouse is; `crates/sim/tests/runs/warehouse.rs` runs one.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::layout::{Layout, share};
use super::trailer::trailer_heading;
use super::*;
use crate::configuration::RobotKind;
use crate::num;
use crate::random::Seed;
use crate::worlds::{Route, World};

fn warehouse(seed: u64, robots: usize, trailers: bool) -> World {
    Warehouse { seed: Seed(seed), robots, trailers }.world().unwrap()
}

#[test]
fn every_number_of_robots_gets_its_hall() {
    for robots in (10..400).chain([997, 1000, 1234]) {
        let world = warehouse(1, robots, false);
        let count = |kind: RobotKind| world.robots.iter().filter(|r| r.kind == kind.name).count();
        let (rovers, arms, cars) = (count(RobotKind::RUSTY), count(RobotKind::REACH), count(RobotKind::HITCH));
        assert_eq!(rovers + arms + cars, robots);
        let near = |count: usize, part: f64| (count as f64 - part * robots as f64).abs() <= 1.0;
        assert!(near(rovers, 0.8) && near(arms, 0.1) && near(cars, 0.1), "{robots}: {rovers}, {arms}, {cars}");
        for (id, robot) in world.robots.iter().enumerate() {
            assert!(robot.name.ends_with(&format!(" {id:05}")), "{} has the id {id}", robot.name);
            assert_eq!(robot.route.is_some(), robot.kind != RobotKind::REACH.name, "{}", robot.name);
        }
        // a route is no fuller than its cars and rovers are long
        let mut on: BTreeMap<&str, usize> = BTreeMap::new();
        world.robots.iter().filter_map(|r| r.route.as_deref()).for_each(|name| *on.entry(name).or_default() += 1);
        for route in &world.routes {
            let room = route.path().unwrap().length() / *on.get(route.name.as_str()).unwrap_or(&1) as f64;
            assert!(room >= if route.name.starts_with("road") { 6.0 } else { 1.4 }, "{robots}: {} {room}", route.name);
        }
    }
    for robots in [0, 9, 100_001, usize::MAX] {
        let refused = Warehouse { seed: Seed(1), robots, trailers: false }.world().unwrap_err();
        assert_eq!(refused.to_string(), format!("{robots} robots: a warehouse has 10 to 100000"));
    }
}

#[test]
fn it_is_what_its_file_says_and_a_function_of_its_numbers_alone() {
    let mut hashes = Vec::new();
    for (seed, robots, trailers) in [(1, 60, false), (2, 60, false), (1, 61, false), (1, 60, true)] {
        let world = warehouse(seed, robots, trailers);
        assert!(World::parse("warehouse.ron", &world.to_ron()).unwrap() == world);
        assert!(world == warehouse(seed, robots, trailers));
        hashes.push(world.content_hash());
    }
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), 4, "another seed, number or trailer is another world");
    // beyond its name: speeds, starts and racks are the seed's
    let (one, two) = (warehouse(1, 60, false), warehouse(2, 60, false));
    assert_ne!(one.routes, two.routes);
    assert_ne!(one.robots, two.robots);
}

/// The same bytes on every machine. The hash may change only with what is generated.
#[test]
fn the_bytes_are_the_same_everywhere() {
    assert_eq!(format!("{:032x}", warehouse(1, 1000, true).content_hash()), "2e665a2d69677bce0f3d2e51fa47fba4");
}

#[test]
fn the_largest_has_room_within_the_limits_of_world_files() {
    let plan = Layout::of(WAREHOUSE_ROBOTS[1]);
    assert_eq!((plan.bays, plan.columns * plan.rows), (1250, 1250));
    let hall = plan.hall();
    assert!(hall.max.x < 1000.0 && hall.max.y < 1000.0, "{hall:?}");
    for bays in 1..400 {
        let plan = Layout::of(80 * bays);
        assert!(plan.bays == bays && plan.columns * plan.rows >= bays);
        assert!(plan.columns * (plan.rows - 1) < bays, "no row is empty");
        let size = plan.hall().max;
        assert!(bays < 6 || (0.6..3.0).contains(&(size.x / size.y)), "{bays}: {size}");
    }
}

#[test]
fn shares_differ_by_at_most_one_and_add_up() {
    for (total, parts) in [(0, 3), (1, 3), (7, 3), (64, 4), (65, 4), (100_000, 1250)] {
        let shares: Vec<usize> = (0..parts).map(|i| share(total, parts, i)).collect();
        assert_eq!(shares.iter().sum::<usize>(), total);
        assert!(shares.iter().max().unwrap() - shares.iter().min().unwrap() <= 1, "{shares:?}");
    }
}

/// On a circle of radius R the trailer of a hitch of length d settles at the angle asin(d / R) inside of the car's
/// heading, and on a straight line it follows.
#[test]
fn a_trailer_points_where_it_settles() {
    let square = |radius| {
        let points = [(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)].map(|(x, y)| point(x, y)).to_vec();
        Route { name: "round".into(), points, radius, speed: 1.0 }.path().unwrap()
    };
    let circle = square(30.0);
    let behind = num::wrap(circle.at(10.0).theta - trailer_heading(&circle, 10.0, 3.0));
    assert!((num::sin(behind) - 0.1).abs() < 1e-6, "{behind}");
    let straight = square(2.0);
    assert!(num::wrap(trailer_heading(&straight, 50.0, 1.3)).abs() < 1e-6);
    // a quarter circle of radius R = d from straight: tan(beta/2 + pi/4) is no elementary end; between the two limits
    let turning = num::wrap(straight.at(56.0 + 0.25 * TAU).theta - trailer_heading(&straight, 56.0 + 0.25 * TAU, 1.3));
    assert!((0.2..0.75).contains(&turning), "{turning}");
}

fn point(x: f64, y: f64) -> crate::geometry::Point2 {
    crate::geometry::Point2::new(x, y)
}
