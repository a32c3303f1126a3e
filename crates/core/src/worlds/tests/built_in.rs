//! Tests of what the three worlds must be (SPEC W1 to W3).

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::point_distance;
use crate::geometry::{Point2, Shape};
use crate::num::{self, wrap};
use crate::worlds::{ObstacleKind, World};

#[test]
fn all_three_are_built_in_under_their_names() {
    for name in World::built_in_names() {
        let world = World::built_in(name).unwrap();
        assert_eq!(world.name.to_lowercase(), name);
        assert_eq!(world.robots.len(), 1);
    }
    assert_eq!(World::built_in("attic"), None);
}

#[test]
fn an_unknown_name_is_answered_with_the_one_that_was_meant() {
    let refused = |name| World::named(name).unwrap_err().to_string();
    assert_eq!(refused("Apartmnt"), "no built-in world is named \"Apartmnt\"; did you mean \"apartment\"?");
    assert_eq!(refused("LOT"), "no built-in world is named \"LOT\"; did you mean \"lot\"?");
    assert_eq!(refused("attic"), "no built-in world is named \"attic\"; there are apartment, workbench, lot");
    assert_eq!(World::named("lot"), Ok(World::lot()));
}

/// Everything that collides, as sorted lists of bit patterns: segments and polygon edges with their ends in order,
/// discs.
fn features(world: &World, mirrored: bool) -> Vec<[u64; 5]> {
    let bits = |p: Point2| {
        let x = if mirrored { 12.0 - p.x } else { p.x };
        [x.to_bits(), p.y.to_bits()]
    };
    let mut features = Vec::new();
    for shape in world.obstacles.iter().flat_map(|o| o.placed()) {
        let core = shape.core();
        for (i, &a) in core.iter().enumerate() {
            let mut ends = [bits(a), bits(core[(i + 1) % core.len()])];
            ends.sort_unstable();
            features.push([ends[0][0], ends[0][1], ends[1][0], ends[1][1], shape.radius().to_bits()]);
        }
    }
    features.sort_unstable();
    features
}

#[test]
fn the_apartment_is_its_own_mirror_image_to_the_bit() {
    let world = World::apartment();
    assert_eq!(features(&world, false), features(&world, true));
    for (a, c) in
        [("room A", "room C"), ("inside A's door", "inside C's door"), ("outside A's door", "outside C's door")]
    {
        let (a, c) = (world.place(a).unwrap().pose, world.place(c).unwrap().pose);
        assert_eq!((12.0 - a.x, a.y), (c.x, c.y));
        // the mirrored heading, for those that don't point along the mirror
        assert!(
            a.theta == c.theta - PI
                || a.theta == -c.theta && a.theta.abs() == FRAC_PI_2
                || wrap(PI - a.theta) == c.theta
        );
    }
}

#[test]
fn the_apartment_has_its_corridor_and_doors() {
    let world = World::apartment();
    let walls: Vec<_> = world.obstacles.iter().filter(|o| o.kind == ObstacleKind::Wall).collect();
    // the walls of each side of the corridor, as sorted spans of x; the gaps between them are the doors
    let gaps = |y: f64| {
        let mut spans = Vec::new();
        for (_, shape) in walls.iter().flat_map(|w| &w.pieces) {
            if let Shape::Segment { a, b } = shape
                && a.y == y
                && b.y == y
            {
                spans.push((num::lesser(a.x, b.x), num::greater(a.x, b.x)));
            }
        }
        spans.sort_by(|p, q| p.0.total_cmp(&q.0));
        spans.windows(2).map(|w| w[1].0 - w[0].1).collect::<Vec<f64>>()
    };
    assert_eq!(gaps(4.75), [0.875; 3]);
    assert_eq!(gaps(3.25), [0.875; 2]);
    // the middle of the corridor is 0.75 m from either side, all along
    for x in 1..=11 {
        assert_eq!(point_distance(&world, Point2::new(f64::from(x), 4.0)), 0.75);
    }
}

#[test]
fn the_way_from_room_a_to_room_c_is_short_and_clear() {
    let world = World::apartment();
    let names =
        ["room A", "inside A's door", "outside A's door", "outside C's door", "C's door", "inside C's door", "room C"];
    let way: Vec<Point2> = names.iter().map(|n| world.place(n).unwrap().pose.position()).collect();
    let mut length = 0.0;
    for leg in way.windows(2) {
        for k in 0..=1000 {
            let p = leg[0] + (leg[1] - leg[0]) * (f64::from(k) / 1000.0);
            // Rusty's radius and room to steer
            assert!(point_distance(&world, p) > 0.11 + 0.25, "{p}");
        }
        length += (leg[1] - leg[0]).norm();
    }
    // there and back within a minute at 0.6 m/s, with a third of the time left for turning
    assert!(2.0 * length < 24.0, "{length}");
    let start = &world.robots[0];
    assert_eq!((start.kind.as_str(), &start.start[..2]), ("rusty", &[way[0].x, way[0].y][..]));
}

#[test]
fn every_place_of_the_apartment_is_clear_of_rusty() {
    let world = World::apartment();
    for place in &world.places {
        assert!(point_distance(&world, place.pose.position()) > 0.11 + 0.1, "{}", place.name);
    }
}

#[test]
fn the_workbench_is_as_the_book_has_it() {
    let world = World::workbench();
    let p = Point2::new;
    assert_eq!((world.bounds.min, world.bounds.max), (p(-2.4, -2.4), p(2.4, 2.4)));
    let rectangle = |name: &str| world.obstacle(name).unwrap().pieces[0].1.clone();
    assert_eq!(rectangle("the block"), Shape::Rectangle { min: p(0.5, 1.0), max: p(1.0, 1.5) });
    let Shape::Rectangle { max, .. } = rectangle("the post") else { panic!("a box") };
    assert!(max.x < 0.0, "in the left half");
    assert!(matches!(rectangle("the shelf"), Shape::Rectangle { max, .. } if max.y < 0.0));
    assert_eq!((world.robots[0].kind.as_str(), &world.robots[0].start[..]), ("reach", &[FRAC_PI_4, FRAC_PI_2][..]));
    // Link 1, a metre at the angle th1, passes through the post between two angles clear of it.
    let clearance = |th1: f64| {
        let (sin, cos) = num::sin_cos(th1);
        (0..=2000)
            .map(|k| f64::from(k) / 1000.0)
            .fold(f64::INFINITY, |d, r| num::lesser(d, point_distance(&world, p(r * cos, r * sin))))
    };
    assert!(clearance(2.0) > 0.03 && clearance(3.1) > 0.03 && clearance(2.55) == 0.0);
}

#[test]
fn the_bays_of_the_lot_hold_a_car_and_its_start_is_clear() {
    let world = World::lot();
    assert_eq!(world.marks.len(), 4);
    let car_clearance = |x: f64, y: f64, theta: f64, behind: f64| {
        // the chassis, 0.7 m behind its rear axle and 3.2 m ahead, 1.7 m wide, sampled
        let pose = crate::geometry::Pose2::new(x, y, theta);
        let mut least = f64::INFINITY;
        for i in 0..=80 {
            for j in 0..=20 {
                let (u, v) = (f64::from(i) / 80.0, f64::from(j) / 20.0);
                let corner = Point2::new(-behind + u * (3.2 + behind), -0.85 + v * 1.7);
                least = num::lesser(least, point_distance(&world, pose.transform(corner)));
            }
        }
        least
    };
    for (i, mark) in world.marks.iter().enumerate() {
        let (left, right) = (mark.points[0].x, mark.points[3].x);
        assert_eq!(right - left, 2.5);
        assert!((4.5..=5.0).contains(&(mark.points[1].y - mark.points[0].y)));
        let parked = world.place(&format!("parked in bay {}", i + 1)).unwrap().pose;
        assert_eq!(parked.x, 0.5 * (left + right));
        assert!(car_clearance(parked.x, parked.y, parked.theta, 0.7) > 0.3);
        assert!(parked.y - 3.2 > mark.points[0].y, "the nose is inside");
    }
    let [x, y, theta] = world.robots[0].start[..] else { panic!("x, y, theta") };
    assert!(car_clearance(x, y, theta, 0.7) > 1.0);
    assert!(car_clearance(x, y, theta, 2.8 + 2.0) > 1.0, "with a trailer and two metres to back up");
}
