//! Filled shapes are solid inside their ink, by the fill rule.

use super::{area, drawn, extent, lies_in};
use crate::{assert_prints_as_itself, is_hit};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Footprint, Point2, Shape};
use motion_lab_core::num;
use motion_lab_core::worlds::ObstacleKind;

/// Checks the area of a path's solid, and places inside and outside its ink, in the drawing's own y.
#[track_caller]
fn check(path: &str, expected: f64, inside: &[(f64, f64)], outside: &[(f64, f64)]) {
    let world = drawn(&format!("<path id='ink' {path}/>")).world;
    assert_eq!(world.obstacle("ink").unwrap().kind, ObstacleKind::Solid, "{path}");
    assert!((area(&world, "ink") - expected).abs() < 1e-9, "{path}: {}", area(&world, "ink"));
    for (x, y) in inside {
        assert!(is_hit(&world, *x, 10.0 - y), "({x}, {y}) in {path}");
    }
    for (x, y) in outside {
        assert!(!is_hit(&world, *x, 10.0 - y), "({x}, {y}) in {path}");
    }
    assert_prints_as_itself(&world);
}

#[test]
fn holes_stay_open_and_walls_around_them_are_solid() {
    // an outer square of 8, a hole of 6, an island of 2: 64 - 36 + 4
    let nested = "M1 1h8v8h-8zm1 1h6v6h-6zm2 2h2v2h-2z";
    let (ink, free) = ([(1.5, 5.0), (8.5, 1.5), (5.0, 5.0)], [(2.5, 5.0), (7.0, 7.0), (0.5, 5.0), (9.5, 5.0)]);
    check(&format!("fill-rule='evenodd' d='{nested}'"), 32.0, &ink, &free);
    // all in one direction, the rule of non-zero winding leaves no hole
    check(&format!("d='{nested}'"), 64.0, &[(2.5, 5.0), (7.0, 7.0)], &[(0.5, 5.0)]);
    // the hole the other way round
    let turned = "M1 1h8v8h-8zM2 2v6h6v-6z";
    check(&format!("d='{turned}'"), 28.0, &[(1.5, 5.0), (8.5, 8.5)], &[(5.0, 5.0), (7.9, 7.9)]);
    // walls of 0.3 around two rooms: 8 x 4 - 2 (3.55 x 3.4)
    let rooms = "d='M1 1H9V5H1ZM1.3 1.3V4.7H4.85V1.3ZM5.15 1.3V4.7H8.7V1.3Z'";
    check(rooms, 7.86, &[(1.15, 3.0), (5.0, 3.0), (8.85, 1.1)], &[(3.0, 3.0), (7.0, 3.0), (4.8, 1.4)]);
}

#[test]
fn parts_that_cross_are_one_solid() {
    // two squares of 4 that share one of 2
    let squares = "M1 1h4v4h-4zM3 3h4v4h-4z";
    check(&format!("d='{squares}'"), 28.0, &[(4.0, 4.0), (2.0, 2.0), (6.0, 6.0)], &[(2.0, 6.0), (6.0, 2.0)]);
    check(&format!("fill-rule='evenodd' d='{squares}'"), 24.0, &[(2.0, 2.0)], &[(4.0, 4.0), (2.0, 6.0)]);
    // in opposite directions they cancel where they overlap
    check("d='M1 1h4v4h-4zM3 3v4h4v-4z'", 24.0, &[(2.0, 2.0)], &[(4.0, 4.0)]);
    // a bow-tie: two triangles of 4 x 4 / 4
    check("d='M1 1L5 5V1L1 5z'", 8.0, &[(1.5, 3.0), (4.5, 3.0)], &[(3.0, 1.5), (3.0, 4.5)]);
    // a pentagram's middle is inside by one rule only
    let star: Vec<String> = (0..5)
        .map(|k| num::sin_cos(f64::from(k) * 0.8 * std::f64::consts::PI))
        .map(|(s, c)| format!("{} {}", 5.0 + 4.0 * s, 5.0 - 4.0 * c))
        .collect();
    let star = star.join("L");
    for (rule, hit) in [("nonzero", true), ("evenodd", false)] {
        let world = drawn(&format!("<path id='ink' fill-rule='{rule}' d='M{star}z'/>")).world;
        assert!(is_hit(&world, 5.0, 5.0) == hit && is_hit(&world, 5.0, 8.5) && !is_hit(&world, 5.0, 2.5), "{rule}");
    }
    // parts that touch in a corner, along a side, and a part drawn twice
    check("d='M1 1h2v2h-2zM3 3h2v2h-2z'", 8.0, &[(2.0, 2.0), (4.0, 4.0)], &[(2.0, 4.0)]);
    check("d='M1 1h2v2h-2zM3 1h2v2h-2z'", 8.0, &[(2.0, 2.0), (3.0, 2.0), (4.0, 2.0)], &[(6.0, 2.0)]);
    check("d='M1 1h2v2h-2zM1 1h2v2h-2z'", 4.0, &[(2.0, 2.0)], &[(4.0, 2.0)]);
}

#[test]
fn parts_apart_are_boxes_and_discs_of_one_obstacle() {
    let world = drawn(
        "<path id='two tables' d='M1 1H3V2H1ZM6 3H8V5H6Z'/>\
         <path id='columns' d='M10 5a1 1 0 1 1 2 0a1 1 0 1 1 -2 0zM15 5a1 1 0 1 1 2 0a1 1 0 1 1 -2 0z'/>",
    )
    .world;
    let shapes = |name: &str| world.obstacle(name).unwrap().pieces.iter().map(|(_, s)| s.clone()).collect::<Vec<_>>();
    assert!(shapes("two tables").iter().all(|shape| matches!(shape, Shape::Rectangle { .. })));
    assert_eq!(shapes("two tables").len(), 2);
    assert_eq!(shapes("columns"), [Shape::Disc { radius: 1.0 }, Shape::Disc { radius: 1.0 }]);
    assert!(is_hit(&world, 2.0, 8.5) && is_hit(&world, 7.0, 6.0) && !is_hit(&world, 4.5, 7.5));
}

#[test]
fn a_ring_of_thousands_of_corners_is_solid() {
    // an annulus of radii 4 and 3, both borders of 2,000 corners
    let border = |radius: f64| {
        let n = 2_000;
        let corner = |k: i32| num::sin_cos(std::f64::consts::TAU * f64::from(k) / f64::from(n));
        (0..n)
            .map(corner)
            .map(|(s, c)| format!("{:.6} {:.6}", 5.0 + radius * c, 5.0 + radius * s))
            .collect::<Vec<_>>()
            .join("L")
    };
    let path = format!("<path id='ring' fill-rule='evenodd' d='M{}zM{}z'/>", border(4.0), border(3.0));
    let world = drawn(&path).world;
    // the area of a regular polygon of n corners is n r^2 sin(2 pi / n) / 2
    let expected = 1_000.0 * num::sin(std::f64::consts::TAU / 2_000.0) * (16.0 - 9.0);
    assert!((area(&world, "ring") - expected).abs() < 1e-4, "{} {expected}", area(&world, "ring"));
    let scene = Scene::of_world(&world);
    let is_hit = |x: f64, y: f64| scene.intersects(&Footprint::disc(Point2::new(x, y), 1e-3));
    for k in 0..100 {
        let (s, c) = num::sin_cos(0.063 * f64::from(k));
        assert!(is_hit(5.0 + 3.5 * c, 5.0 + 3.5 * s) && !is_hit(5.0 + 2.9 * c, 5.0 + 2.9 * s));
    }
}

#[test]
fn what_is_thinner_than_a_millimetre_is_a_wall_and_what_has_no_area_nothing() {
    let thin = drawn("<path id='strip' d='M1 1h5v.0004h-5z'/><rect x='9' y='9' width='1' height='1'/>").world;
    assert_eq!(thin.obstacle("strip").unwrap().kind, ObstacleKind::Wall);
    let hollow = "M1 1h5v5h-5zM1.0003 1.0003v4.9994h4.9994v-4.9994z";
    let frame = drawn(&format!("<path id='frame' fill-rule='evenodd' d='{hollow}'/>"));
    assert!(is_hit(&frame.world, 1.0, 7.0) && !is_hit(&frame.world, 3.0, 7.0));
    assert!(frame.notes[0].contains("thinner than a millimetre"), "{:?}", frame.notes);
    let nothing = drawn("<path id='line' d='M1 1h5'/><rect id='a' x='9' y='9' width='1' height='1'/>");
    assert!(nothing.world.obstacle("line").is_none());
    assert_eq!(nothing.notes, ["what is filled and has no area is left out"]);
    let stroked = drawn("<path id='line' d='M1 1h5' stroke='red'/>").world;
    assert_eq!(extent(&stroked, "line"), [1.0, 9.0, 6.0, 9.0]);
}

#[test]
fn lines_that_cross_without_end_are_left_as_outlines_in_time() {
    // 3,000 chords of a circle, of which most cross: millions of crossings
    let corner = |k: i32| num::sin_cos(2.4 * f64::from(k));
    let scribble: Vec<String> =
        (0..3_000).map(corner).map(|(s, c)| format!("{:.6} {:.6}", 5.0 + 4.0 * c, 5.0 + 4.0 * s)).collect();
    let drawn = drawn(&format!("<path id='scribble' d='M{}z'/>", scribble.join("L")));
    assert_eq!(drawn.world.obstacle("scribble").unwrap().kind, ObstacleKind::Wall);
    assert_eq!(drawn.notes, ["path \"scribble\" is drawn as its outline: its lines cross too often"]);
    assert!(drawn.world.obstacles.iter().flat_map(|o| o.placed()).all(|p| lies_in(&p.bounds(), [0.9, 0.9, 9.1, 9.1])));
}
