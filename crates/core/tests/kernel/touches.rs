//! Exact touches of every pair of shape kinds, and the same pairs one lattice step apart.

use motion_lab_core::collision::Collision;
use motion_lab_core::geometry::Footprint;
use motion_lab_core::num::ulp;
use motion_lab_core::random::{Seed, Stream};

use oracle::exact::{ExactPair, lies_on};
use oracle::fixtures::{KINDS, Kind, LatticeShape, footprint_of, lattice_shape, placed, scene_of};

/// A pair that touches, and a step of the first shape that separates it.
struct Touch {
    what: &'static str,
    a: LatticeShape,
    b: LatticeShape,
    away: [i32; 2],
}

fn disc(center: [i32; 2], radius: i32) -> LatticeShape {
    LatticeShape { kind: Kind::Disc, points: vec![center], radius }
}
fn segment(a: [i32; 2], b: [i32; 2]) -> LatticeShape {
    LatticeShape { kind: Kind::Segment, points: vec![a, b], radius: 0 }
}
fn capsule(a: [i32; 2], b: [i32; 2], radius: i32) -> LatticeShape {
    LatticeShape { kind: Kind::Capsule, points: vec![a, b], radius }
}
fn rectangle(a: [i32; 2], b: [i32; 2]) -> LatticeShape {
    LatticeShape { kind: Kind::Rectangle, points: vec![a, b], radius: 0 }
}
fn polygon(points: &[[i32; 2]]) -> LatticeShape {
    LatticeShape { kind: Kind::Polygon, points: points.to_vec(), radius: 0 }
}

/// Every unordered pair of kinds, in each way that the two can touch. Slanted contacts lie on the line 3x + 4y = 25,
/// whose distance from the origin is exactly 5, at (3, 4).
fn touches() -> Vec<Touch> {
    let slanted = || polygon(&[[7, 1], [9, 9], [-1, 7]]);
    let pointed = || polygon(&[[3, 4], [9, 5], [6, 9]]);
    let t = |what, a, b, away| Touch { what, a, b, away };
    vec![
        t("tangent discs, 3-4-5", disc([0, 0], 2), disc([3, 4], 3), [-1, 0]),
        t("disc on a segment", disc([0, 5], 5), segment([-3, 0], [7, 0]), [0, 1]),
        t("disc on a slanted segment", disc([0, 0], 5), segment([7, 1], [-1, 7]), [-1, 0]),
        t("disc on a segment's end, 3-4-5", disc([0, 0], 5), segment([3, 4], [10, 4]), [-1, 0]),
        t("disc on a capsule's side", disc([0, 0], 2), capsule([5, -3], [5, 8], 3), [-1, 0]),
        t("disc on a capsule's end, 3-4-5", disc([0, 0], 2), capsule([3, 4], [9, 4], 3), [-1, 0]),
        t("disc on a rectangle's side", disc([0, 0], 3), rectangle([3, -2], [5, 2]), [-1, 0]),
        t("disc on a rectangle's corner, 3-4-5", disc([0, 0], 5), rectangle([3, 4], [9, 7]), [-1, 0]),
        t("disc on a polygon's corner, 3-4-5", disc([0, 0], 5), pointed(), [-1, 0]),
        t("disc on a polygon's slanted side", disc([0, 0], 5), slanted(), [-1, 0]),
        t("two segments in a T", segment([0, 0], [4, 0]), segment([2, 0], [2, 5]), [0, -1]),
        t("two segments in a slanted T", segment([0, 0], [6, 3]), segment([4, 2], [1, 7]), [0, -1]),
        t("collinear overlapping segments", segment([0, 0], [4, 0]), segment([2, 0], [7, 0]), [0, -1]),
        t("slanted collinear overlapping segments", segment([0, 0], [6, 3]), segment([2, 1], [8, 4]), [0, -1]),
        t("a segment within a collinear one", segment([0, 0], [9, 3]), segment([3, 1], [6, 2]), [-1, 0]),
        t("the same segment twice", segment([0, 0], [5, 3]), segment([0, 0], [5, 3]), [0, 1]),
        t("segments sharing an end", segment([0, 0], [3, 1]), segment([3, 1], [5, 7]), [-1, 0]),
        t("collinear segments end to end", segment([0, 0], [4, 2]), segment([4, 2], [6, 3]), [-2, -1]),
        t("segment on a capsule's end", segment([0, 0], [0, 9]), capsule([3, 4], [8, 4], 3), [-1, 0]),
        t("slanted segment on a capsule's end", segment([7, 1], [-1, 7]), capsule([0, 0], [-3, -4], 5), [1, 0]),
        t("segment along a capsule", segment([0, 0], [9, 0]), capsule([2, 3], [7, 3], 3), [0, -1]),
        t("segment on a rectangle's corner", segment([0, 4], [4, 0]), rectangle([2, 2], [5, 6]), [-1, 0]),
        t("segment along a rectangle's side", segment([0, 2], [9, 2]), rectangle([2, 2], [5, 6]), [0, -1]),
        t("segment's end on a rectangle's side", segment([0, 0], [2, 3]), rectangle([2, 1], [5, 6]), [-1, 0]),
        t("segment's end on a polygon's corner", segment([0, 0], [3, 1]), polygon(&[[3, 1], [7, 0], [6, 4]]), [-1, 0]),
        t("segment along a polygon's slanted side", segment([3, 4], [11, -2]), slanted(), [-1, 0]),
        t("capsule's end on a capsule's side", capsule([5, 3], [9, 3], 3), capsule([0, 0], [0, 6], 2), [1, 0]),
        t("capsules end to end, 3-4-5", capsule([-5, 0], [0, 0], 2), capsule([3, 4], [3, 9], 3), [-1, 0]),
        t("parallel capsules", capsule([0, 0], [6, 0], 1), capsule([2, 3], [9, 3], 2), [0, -1]),
        t("capsule on a rectangle's corner, 3-4-5", capsule([-4, -1], [0, 0], 5), rectangle([3, 4], [9, 7]), [-1, 0]),
        t("capsule along a rectangle's side", capsule([0, -3], [0, 3], 2), rectangle([2, -1], [5, 1]), [-1, 0]),
        t("capsule's end on a polygon's slanted side", capsule([0, 0], [-3, -4], 5), slanted(), [-1, 0]),
        t("capsule's end on a polygon's corner, 3-4-5", capsule([0, 0], [-2, -1], 5), pointed(), [-1, 0]),
        t("rectangles corner to corner", rectangle([0, 0], [2, 2]), rectangle([2, 2], [4, 5]), [-1, 0]),
        t("rectangles side to side", rectangle([0, 0], [2, 3]), rectangle([2, 1], [5, 7]), [-1, 0]),
        t("rectangle's corner on a polygon's slanted side", rectangle([0, 0], [3, 4]), slanted(), [-1, 0]),
        t("rectangle's side on a polygon's", rectangle([0, 0], [4, 2]), polygon(&[[1, 2], [6, 2], [3, 6]]), [0, -1]),
        t("polygons corner to corner", polygon(&[[0, 0], [3, 1], [1, 3]]), polygon(&[[3, 1], [7, 0], [6, 4]]), [-1, 0]),
        t("polygon's corner on a slanted side", polygon(&[[0, 0], [3, 4], [-5, 2]]), slanted(), [-1, 0]),
        t("polygons along a slanted side", polygon(&[[0, 0], [11, -2], [3, 4]]), slanted(), [-1, 0]),
    ]
}

/// Checks every answer for a pair in contact, or apart.
fn check(what: &str, robot: &LatticeShape, obstacle: &LatticeShape, unit: f64, contact: bool) {
    let (part, piece) = (robot.body(unit), obstacle.body(unit));
    let scene = scene_of(std::slice::from_ref(&piece));
    let footprint = footprint_of(std::slice::from_ref(&part));
    let (part, piece) = (placed(&part), placed(&piece));
    let at = format!("{what}: {robot:?} against {obstacle:?} in units of {unit}");
    assert_eq!(ExactPair::new(&part, &piece).contact(), contact, "the table is wrong: {at}");
    assert_eq!(scene.intersects(&footprint), contact, "intersects: {at}");
    assert_eq!(scene.distance(&footprint) == 0.0, contact, "distance {}: {at}", scene.distance(&footprint));
    assert_eq!(scene.swept(&footprint, &footprint), contact, "swept on the spot: {at}");
    let w = scene.witness(&footprint).expect("the scene is not empty");
    assert_eq!(w.dist == 0.0, contact, "witness {w:?}: {at}");
    assert_eq!(w.on_robot == w.on_obstacle, contact, "witness {w:?}: {at}");
    let tolerance = 16.0 * ulp(16.0 * unit + 1.0);
    assert!(lies_on(w.on_robot, &part, tolerance) && lies_on(w.on_obstacle, &piece, tolerance), "{w:?}: {at}");
}

/// The eight symmetries of the lattice: quarter turns, and a mirror.
fn symmetries() -> Vec<fn([i32; 2]) -> [i32; 2]> {
    vec![
        |[x, y]| [x, y],
        |[x, y]| [-y, x],
        |[x, y]| [-x, -y],
        |[x, y]| [y, -x],
        |[x, y]| [-x, y],
        |[x, y]| [y, x],
        |[x, y]| [x, -y],
        |[x, y]| [-y, -x],
    ]
}

#[test]
fn the_table_of_touches_has_every_pair_of_kinds() {
    for (i, p) in KINDS.into_iter().enumerate() {
        for &q in &KINDS[i..] {
            let has = |t: &Touch| (t.a.kind, t.b.kind) == (p, q) || (t.a.kind, t.b.kind) == (q, p);
            assert!(touches().iter().any(has), "no {p:?} touching a {q:?}");
        }
    }
}

#[test]
fn shapes_that_touch_are_in_contact_in_every_answer_and_a_step_apart_in_none() {
    for touch in touches() {
        for turn in symmetries() {
            for shift in [[0, 0], [17, -29]] {
                let place = |shape: &LatticeShape| shape.map(turn).shifted(shift);
                let (a, b, away) = (place(&touch.a), place(&touch.b), turn(touch.away));
                let back = [-away[0], -away[1]];
                for unit in [1.0 / 32.0, 1.0, 8.0] {
                    check(touch.what, &a, &b, unit, true);
                    check(touch.what, &b, &a, unit, true);
                    check(touch.what, &a.shifted(away), &b, unit, false);
                    check(touch.what, &b.shifted(back), &a, unit, false);
                }
            }
        }
    }
}

#[test]
fn a_sweep_that_ends_in_a_touch_hits_and_one_that_stays_a_step_away_does_not() {
    for touch in touches() {
        for turn in symmetries() {
            let (a, b, away) = (touch.a.map(turn), touch.b.map(turn), turn(touch.away));
            for unit in [1.0 / 32.0, 1.0] {
                let scene = scene_of(&[b.body(unit)]);
                let at = |steps: i32| -> Footprint {
                    footprint_of(&[a.shifted([steps * away[0], steps * away[1]]).body(unit)])
                };
                let what = touch.what;
                assert!(scene.swept(&at(0), &at(3)), "leaving a touch: {what}");
                assert!(scene.swept(&at(3), &at(0)), "arriving at a touch: {what}");
                assert!(!scene.swept(&at(1), &at(3)) && !scene.swept(&at(3), &at(1)), "a step away: {what}");
            }
        }
    }
}

#[test]
fn a_sweep_along_a_touch_hits_and_along_a_step_away_does_not() {
    // the shape slides past the obstacle from far on one side to far on the other, grazing it in the middle
    let slide = |a: &LatticeShape, along: [i32; 2], unit: f64| {
        let at = |k: i32| footprint_of(&[a.shifted([k * along[0], k * along[1]]).body(unit)]);
        (at(-8), at(8))
    };
    for turn in symmetries() {
        for unit in [1.0 / 32.0, 1.0] {
            // a disc of 5 along the direction (-4, 3) past the corner or side at (3, 4)
            let along = turn([-4, 3]);
            for obstacle in [polygon(&[[3, 4], [9, 5], [6, 9]]), segment([7, 1], [-1, 7]), segment([3, 4], [9, 12])] {
                let scene = scene_of(&[obstacle.map(turn).body(unit)]);
                for shape in [disc([0, 0], 5), capsule([0, 0], [-3, -4], 5), segment([3, 4], [0, 0])] {
                    let (from, to) = slide(&shape.map(turn), along, unit);
                    assert!(scene.swept(&from, &to), "{shape:?} past {obstacle:?}");
                    let (from, to) = slide(&shape.map(turn).shifted(turn([-1, 0])), along, unit);
                    assert!(!scene.swept(&from, &to), "{shape:?} a step from {obstacle:?}");
                }
            }
        }
    }
}

#[test]
fn random_tangent_pairs_of_every_kind_with_a_radius_are_in_contact() {
    let mut s = Stream::new(Seed(11), "tests/tangent");
    for p in KINDS {
        for q in KINDS {
            if ![p, q].iter().any(|k| matches!(k, Kind::Disc | Kind::Capsule)) {
                continue;
            }
            let mut found = 0;
            while found < 40 {
                let (a, b) = (lattice_shape(&mut s, p, 12), lattice_shape(&mut s, q, 12));
                let pair = ExactPair::new(&placed(&a.body(0.25)), &placed(&b.body(0.25)));
                if a.radius + b.radius > 0 && pair.tangent() {
                    check("tangent", &a, &b, 0.25, true);
                    found += 1;
                }
            }
        }
    }
}

#[test]
fn crossing_zero_thickness_links_are_at_distance_exactly_zero() {
    let mut s = Stream::new(Seed(12), "tests/crossing");
    let mut crossings = 0;
    while crossings < 5000 {
        let (a, b) = (lattice_shape(&mut s, Kind::Segment, 9), lattice_shape(&mut s, Kind::Segment, 9));
        // the arm's links are capsules of radius 0
        let link = LatticeShape { kind: Kind::Capsule, ..a };
        let contact = ExactPair::new(&placed(&link.body(0.125)), &placed(&b.body(0.125))).contact();
        check("link across a wall", &link, &b, 0.125, contact);
        crossings += usize::from(contact);
    }
}
