//! What is round after all transforms is a disc; other curves keep within the tolerance at any size.

use super::{drawn, import};
use motion_lab_core::geometry::{Point2, Shape};
use motion_lab_core::num;
use motion_lab_import::{SvgOptions, svg};

/// A drawing of 100 x 100 units, whose origin is in the middle and whose y points up as the world's.
fn large(inside: &str, tolerance: f64) -> Vec<(Point2, Shape)> {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'><g transform='matrix(1 0 0 -1 50 50)'>{inside}\
         </g></svg>"
    );
    let world = svg("d.svg", &text, "d", SvgOptions { tolerance, ..SvgOptions::default() }).unwrap().world;
    let pieces = world.obstacles[0].pieces.iter();
    pieces.map(|(pose, shape)| (Point2::new(pose.x - 50.0, pose.y - 50.0), shape.clone())).collect()
}

/// Four Bezier curves that draw programs write for a circle about the origin.
fn bezier_circle(r: f64) -> String {
    let k = 0.552_284_749_831 * r;
    format!(
        "<path d='M{r} 0C{r} {k} {k} {r} 0 {r}C{} {r} {} {k} {} 0C{} {} {} {} 0 {}C{k} {} {r} {} {r} 0z'/>",
        -k, -r, -r, -r, -k, -k, -r, -r, -r, -k
    )
}

#[test]
fn circles_by_any_way_are_discs() {
    let [r, half] = [20.0, 14.142_135_623_730_951];
    for shape in [
        format!("<circle r='{r}'/>"),
        format!("<ellipse rx='{r}' ry='{r}' transform='rotate(33)'/>"),
        "<ellipse rx='40' ry='10' transform='scale(.5 2)'/>".to_owned(),
        "<circle r='1' transform='rotate(30) scale(20 -20) rotate(20)'/>".to_owned(),
        // a circle squeezed along a diagonal, and the ellipse stretched back
        format!(
            "<g transform='rotate(45) scale(2 1) rotate(-45)'>\
                 <ellipse rx='10' ry='{r}' transform='rotate(45)'/></g>"
        ),
        "<rect x='-20' y='-20' width='40' height='40' rx='20'/>".to_owned(),
        "<path d='M-20 0A20 20 0 1 0 20 0A20 20 0 1 0 -20 0z'/>".to_owned(),
        "<path d='M0 20a20 20 0 0 1 0-40 20 20 0 0 1 0 40'/>".to_owned(),
        format!("<path d='M{half} {half}A20 20 0 1 1 {half} -{half}A20 20 0 0 1 {half} {half}z'/>"),
        "<symbol id='s' viewBox='0 0 2 2'><circle cx='1' cy='1' r='1'/></symbol>\
         <use href='#s' x='-20' y='-20' width='40' height='40'/>"
            .to_owned(),
    ] {
        let found = large(&shape, 1e-3);
        assert!(matches!(found[..], [(_, Shape::Disc { radius })] if (radius - r).abs() < 2e-6), "{shape}: {found:?}");
        assert!(found[0].0.coords.norm() < 2e-6, "{shape}: {found:?}");
    }
}

#[test]
fn four_curves_are_a_disc_where_they_are_round_enough() {
    // they lie up to 2.7e-4 of the radius outside the circle through their ends
    for (r, is_disc) in [(0.5, true), (2.0, true), (6.0, true), (12.0, false), (20.0, false)] {
        for turn in ["", "transform='rotate(10)'"] {
            let found = large(&format!("<g {turn}>{}</g>", bezier_circle(r)), 1e-3);
            let disc = matches!(found[..], [(_, Shape::Disc { radius })] if (radius - r).abs() < 3e-4 * r);
            assert_eq!(disc, is_disc, "{r} {turn}");
        }
    }
}

#[test]
fn what_is_nearly_round_is_no_disc() {
    for shape in [
        "<ellipse rx='20' ry='19.99'/>",
        "<path d='M20 0A20 20 0 0 1 -20 0z'/>",
        "<path d='M20 0A20 20 0 1 1 0 -20z'/>",
        "<path d='M20 0A20 20 0 1 1 19 -6.244998z'/>",
        "<rect x='-20' y='-20' width='40' height='40' rx='19.9'/>",
        "<rect x='-20' y='-20' width='40' height='41' rx='20'/>",
        "<circle r='20' transform='skewX(1)'/>",
    ] {
        let found = large(shape, 1e-3);
        assert!(!found.iter().any(|(_, shape)| matches!(shape, Shape::Disc { .. })), "{shape}");
    }
}

#[test]
fn an_ellipse_of_any_size_keeps_within_the_tolerance() {
    for (rx, ry) in [(20.0, 10.0), (40.0, 0.5), (0.2, 0.1)] {
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let found = large(&format!("<ellipse rx='{rx}' ry='{ry}'/>"), tolerance);
            let [(_, Shape::Polygon(polygon))] = &found[..] else { panic!("{found:?}") };
            let corners: Vec<Point2> = polygon.vertices().iter().map(|p| Point2::new(p.x - 50.0, p.y - 50.0)).collect();
            // to first order, the distance from the ellipse f = 1 is (f - 1) / |grad f|
            let off = |p: Point2| {
                let f = (p.x / rx) * (p.x / rx) + (p.y / ry) * (p.y / ry) - 1.0;
                f / (2.0 * num::hypot(p.x / (rx * rx), p.y / (ry * ry)))
            };
            let n = corners.len();
            let worst =
                (0..n).map(|i| off(nalgebra::center(&corners[i], &corners[(i + 1) % n])).abs()).fold(0.0, num::greater);
            assert!(corners.iter().all(|p| off(*p).abs() < 3e-6), "{rx} {ry} {tolerance}");
            // points closer than a millimetre are left out
            assert!(worst < num::greater(tolerance, 1e-5) * 1.05, "{worst} for {rx} {ry} {tolerance}");
            assert!(worst > tolerance / 50.0 || rx < 1.0, "{worst} for {rx} {ry} {tolerance}: too fine");
        }
    }
}

#[test]
fn flags_of_arcs_may_follow_one_another_without_blanks() {
    for arc in ["A5 5 0 0 1 13 5", "A5 5 0 0113 5", "a5 5 0 0110 0", "a5,5,0,01,10,0", "A5 5 0 0,1,13,5"] {
        let world = drawn(&format!("<path id='arc' fill='none' stroke='red' d='M3 5{arc}'/>")).world;
        let points: Vec<Point2> = world.obstacle("arc").unwrap().placed().map(|piece| piece.core()[0]).collect();
        assert!(points.len() > 20 && points.iter().all(|p| ((p - Point2::new(8.0, 5.0)).norm() - 5.0).abs() < 2e-6));
        // from the left end over the top
        assert!(points.iter().all(|p| p.y >= 5.0), "{arc}");
    }
    let large = import(
        "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100' viewBox='0 0 200000 100000'>
         <path id='packed' fill='none' stroke='#000' d='M100000 50000A5000 5000 0 01110000 50000'/></svg>",
    );
    let points: Vec<Point2> = large.world.obstacle("packed").unwrap().placed().map(|piece| piece.core()[0]).collect();
    assert!(points.iter().all(|p| ((p - Point2::new(105.0, 50.0)).norm() - 5.0).abs() < 2e-6));
}
