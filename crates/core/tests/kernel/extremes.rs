//! Pairs of shapes at the limits: from a millimetre to ten kilometres, and nearly collinear.

use std::f64::consts::PI;

use motion_lab_core::collision::Collision;
use motion_lab_core::geometry::{Placed, Point2, Pose2, Shape, largest_coordinate};
use motion_lab_core::num::{cos, exp, ln, sin, ulp};
use motion_lab_core::random::{Seed, Stream};

use oracle::exact::{ExactPair, lies_on};
use oracle::fixtures::{
    Body, KINDS, Kind, convex_corners, count_from_env, footprint_of, placed, random_kind, scene_of,
};

/// A random number between two, every magnitude equally likely.
fn log_uniform(s: &mut Stream, low: f64, high: f64) -> f64 {
    exp(s.uniform(ln(low), ln(high)))
}

/// A shape of any size from 2 mm to a few kilometres, turned and placed anywhere.
fn wild_body(s: &mut Stream, kind: Kind) -> Body {
    let mut coordinate = || log_uniform(s, 1e-3, 5e3) * if s.unit() < 0.5 { 1.0 } else { -1.0 };
    let (x, y) = (coordinate(), coordinate());
    let pose = Pose2::new(x, y, s.uniform(-PI, PI));
    let (length, radius) = (log_uniform(s, 2e-3, 3e3), log_uniform(s, 2e-3, 3e3));
    let o = Point2::origin();
    let shape = match kind {
        Kind::Disc => Shape::try_disc(radius),
        Kind::Segment => Shape::try_segment(o, Point2::new(length, radius)),
        Kind::Capsule => Shape::try_capsule(o, Point2::new(length, 0.0), radius),
        Kind::Rectangle => Shape::try_rectangle(Point2::new(-length, -radius), Point2::new(length, radius)),
        Kind::Polygon => {
            // corners too near one another are refused, so the size grows
            let mut size = length;
            loop {
                match Shape::try_polygon(&convex_corners(s, size)) {
                    Err(_) => size *= 2.0,
                    made => break made,
                }
            }
        }
    };
    (pose, shape.unwrap())
}

/// Checks the four answers of a pair and the places of its witness against exact arithmetic. Returns whether it is in
/// contact.
fn check(body: &Body, obstacle: &Body) -> bool {
    let contact = check_distance(body, obstacle);
    let (part, piece) = (placed(body), placed(obstacle));
    let w = scene_of(std::slice::from_ref(obstacle)).witness(&footprint_of(std::slice::from_ref(body))).unwrap();
    // the tolerance covers two coordinates, each rounded at the size of the whole, of a point and of the line that it
    // lies on
    let tolerance = 32.0 * ulp(largest_coordinate([&part, &piece]));
    let on_both = lies_on(w.on_robot, &part, tolerance) && lies_on(w.on_obstacle, &piece, tolerance);
    assert!(on_both, "{w:?}: {body:?} against {obstacle:?}");
    contact
}

/// Checks the four answers of a pair against exact arithmetic. Returns whether it is in contact.
fn check_distance(body: &Body, obstacle: &Body) -> bool {
    let (part, piece) = (placed(body), placed(obstacle));
    let (scene, footprint) = (scene_of(std::slice::from_ref(obstacle)), footprint_of(std::slice::from_ref(body)));
    let dist = scene.distance(&footprint);
    let m = largest_coordinate([&part, &piece]);
    let exact = ExactPair::new(&part, &piece);
    let at = || format!("{body:?} against {obstacle:?}: {dist}");
    if exact.contact() {
        assert_eq!(dist, 0.0, "in contact: {}", at());
    } else if part.radius() + piece.radius() == 0.0 || exact.apart_by_more_than(8.0 * ulp(m)) {
        assert!(dist > 0.0, "apart: {}", at());
    }
    assert!(exact.distance_is(dist, 16.0 * ulp(m)), "off by more than 16 ulp({m}): {}", at());
    assert_eq!(scene.intersects(&footprint), dist == 0.0, "{}", at());
    assert_eq!(scene.swept(&footprint, &footprint), dist == 0.0, "{}", at());
    let w = scene.witness(&footprint).unwrap();
    assert_eq!(w.dist, dist, "{}", at());
    assert!(((w.on_robot - w.on_obstacle).norm() - dist).abs() <= 16.0 * ulp(m), "{w:?}: {}", at());
    exact.contact()
}

#[test]
fn pairs_from_a_millimetre_to_kilometres_keep_every_promise() {
    let mut s = Stream::new(Seed(101), "tests/wild");
    let n = count_from_env("MOTION_LAB_PAIRS", 100_000) / 20;
    let mut contacts = 0;
    for i in 0..n {
        let (p, q) = (KINDS[i as usize % 5], KINDS[i as usize / 5 % 5]);
        let (body, obstacle) = (wild_body(&mut s, p), wild_body(&mut s, q));
        contacts += u64::from(check(&body, &obstacle));
    }
    assert!(contacts > n / 10 && contacts < n - n / 10, "one-sided: {contacts} contacts of {n}");
}

/// `x` moved by a few units in its last place.
fn nudged(s: &mut Stream, x: f64) -> f64 {
    x + (s.below(9) as f64 - 4.0) * ulp(x)
}

#[test]
fn segments_and_polygons_all_but_collinear_are_told_apart_exactly() {
    let mut s = Stream::new(Seed(102), "tests/collinear");
    let n = count_from_env("MOTION_LAB_PAIRS", 100_000) / 10;
    let mut contacts = 0;
    for i in 0..n {
        // points on one line, each moved by some units in the last place
        let (x, y) = (s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0));
        let (dx, dy) = (s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0));
        let mut on_line = |t: f64| Point2::new(nudged(&mut s, x + t * dx), nudged(&mut s, y + t * dy));
        let (a, b, c, d) = (on_line(-1.0), on_line(0.4), on_line(-0.3), on_line(1.0));
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let apex = |p: Point2, q: Point2, h: f64| {
            Point2::new(0.5 * (p.x + q.x) - h * side * dy, 0.5 * (p.y + q.y) + h * side * dx)
        };
        let segment = |p, q| Shape::try_segment(p, q);
        let triangle = |p, q, h| Shape::try_polygon(&[p, q, apex(p, q, h)]);
        let (first, second) = match i / 2 % 3 {
            0 => (segment(a, b), segment(c, d)),
            1 => (triangle(a, b, 1.0), segment(c, d)),
            _ => (triangle(a, b, 1.0), triangle(c, d, -1.0)),
        };
        let (Ok(first), Ok(second)) = (first, second) else { continue };
        contacts += u64::from(check_distance(&(Pose2::IDENTITY, first), &(Pose2::IDENTITY, second)));
    }
    assert!(contacts > n / 5 && contacts < n - n / 5, "one-sided: {contacts} contacts of {n}");
}

#[test]
fn segments_that_cross_all_but_collinearly_have_a_witness_on_both() {
    // The weight of the crossing is a quotient of two rounding errors, so it does not tell where the segments cross.
    // The common point must still lie on both.
    let segment =
        |a: [f64; 2], b: [f64; 2]| -> Body { (Pose2::IDENTITY, Shape::try_segment(a.into(), b.into()).unwrap()) };
    let first = segment([-0.28749818896766205, 0.5906587658434498], [1.9283373598246625, -1.400967693790499]);
    let second = segment([0.8204195854285, -0.4051544639735244], [2.877981166449945, -2.2545218907764766]);
    assert!(check(&first, &second) && check(&second, &first));
    let mut s = Stream::new(Seed(105), "tests/slivers");
    for _ in 0..count_from_env("MOTION_LAB_PAIRS", 100_000) / 5 {
        let (x, y) = (s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0));
        let (dx, dy) = (s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0));
        let mut on_line = |t: f64| [nudged(&mut s, x + t * dx), nudged(&mut s, y + t * dy)];
        let ends = [on_line(-1.0), on_line(0.4), on_line(-0.3), on_line(1.0)];
        if (dx * dx + dy * dy).sqrt() > 0.1 {
            check(&segment(ends[0], ends[1]), &segment(ends[2], ends[3]));
        }
    }
}

#[test]
fn discs_and_capsules_all_but_tangent_err_only_to_contact_and_only_by_8_ulps() {
    let mut s = Stream::new(Seed(103), "tests/tangent");
    let mut undecided = 0;
    for _ in 0..count_from_env("MOTION_LAB_PAIRS", 100_000) / 10 {
        let (bearing, r, q) = (s.uniform(-PI, PI), s.uniform(0.01, 2.0), s.uniform(0.01, 2.0));
        let (x, y) = (s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0));
        let center =
            Point2::new(nudged(&mut s, x + (r + q) * cos(bearing)), nudged(&mut s, y + (r + q) * sin(bearing)));
        let disc: Body = (Pose2 { x, y, theta: 0.0 }, Shape::try_disc(r).unwrap());
        let pose = Pose2 { x: center.x, y: center.y, theta: 0.0 };
        let other = if random_kind(&mut s) == Kind::Disc {
            Shape::try_disc(q)
        } else {
            // a capsule whose side faces the disc
            let along = Point2::new(-sin(bearing) * 0.7, cos(bearing) * 0.7);
            Shape::try_capsule(Point2::new(-along.x, -along.y), along, q)
        };
        let other: Body = (pose, other.unwrap());
        let contact = check(&disc, &other);
        let said = scene_of(std::slice::from_ref(&other)).intersects(&footprint_of(std::slice::from_ref(&disc)));
        undecided += u64::from(contact != said);
    }
    assert_eq!(undecided, 0, "the squares of such numbers fit, so even these are decided exactly");
}

#[test]
fn a_placed_vertex_is_the_shape_to_the_last_bit() {
    // A segment's end placed by its frame is rounded once. A wall through exactly that rounded point is touched; a wall
    // an ulp beyond is not.
    let mut s = Stream::new(Seed(104), "tests/placed");
    for _ in 0..2000 {
        let pose = Pose2::new(s.uniform(-5.0, 5.0), s.uniform(-5.0, 5.0), s.uniform(-1.5, 1.5));
        let link: Body = (pose, Shape::try_segment(Point2::origin(), Point2::new(1.0, 0.0)).unwrap());
        let part: Placed = placed(&link);
        let tip = part.core()[1]; // ahead of the frame, so the greatest x
        let wall = |x: f64| -> Body {
            (Pose2::IDENTITY, Shape::try_segment(Point2::new(x, tip.y - 2.0), Point2::new(x, tip.y + 2.0)).unwrap())
        };
        assert!(check(&link, &wall(tip.x)));
        assert!(!check(&link, &wall(tip.x.next_up())), "{tip}");
    }
}
