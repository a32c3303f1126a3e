//! The chapter's exercises 1 to 3, worked. (Exercise 5 is the example `redundancy_walk`, exercise 6 the example
//! `bug1`.)

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::num::{cos, sin, wrap};
use motion_lab_core::prelude::*;

use oracle::fixtures::PLANE;

fn arm(l1: f64, l2: f64) -> Reach<2> {
    Reach { base: Point2::new(0.5, -0.25), lengths: [l1, l2], link_radius: 0.0 }
}

/// Exercise 1: inverse kinematics for links of any lengths, and the meaning of exactly one `None`.
///
/// With `d` the distance from base to tip, the triangle of the two links and `d` gives `cos theta2 = (d^2 - L1^2 -
/// L2^2) / (2 L1 L2)`. Strictly between `|L1 - L2|` and `L1 + L2` that cosine has two angles of opposite sign: two
/// solutions, mirror images in the line from base to tip. At either end it is 1 or -1, the two angles coincide (0 or
/// pi), the arm is straight or folded: exactly one solution, so exactly one `None`. Beyond, no triangle exists.
mod exercise_1 {
    use super::*;

    const LENGTHS: [(f64, f64); 4] = [(1.0, 1.0), (0.7, 0.4), (0.4, 0.7), (2.0, 0.05)];

    #[test]
    fn two_solutions_inside_the_annulus_are_mirror_images() {
        let mut s = Stream::new(Seed(1), "exercise 1");
        for (l1, l2) in LENGTHS {
            let arm = arm(l1, l2);
            for _ in 0..500 {
                let margin = 1e-6 * (l1 + l2);
                let d = s.uniform((l1 - l2).abs() + margin, l1 + l2 - margin);
                let bearing = s.uniform(-PI, PI);
                let tip = arm.base + Vector2::new(cos(bearing), sin(bearing)) * d;
                let [Some(down), Some(up)] = arm.ik(tip) else { panic!("two solutions at {tip} for {l1}, {l2}") };
                assert!(down.th2() > 0.0 && (down.th2() + up.th2()).abs() < 1e-12, "one elbow each way");
                let law = (d * d - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
                assert!((cos(down.th2()) - law).abs() < 1e-9 / l2, "the law of cosines: {} {law}", cos(down.th2()));
                // the first links lie to both sides of the bearing, at the same angle
                assert!(wrap(down.th1() - bearing + up.th1() - bearing).abs() < 1e-9);
                for q in [down, up] {
                    let (x, y) = (l1 * cos(q.th1()), l1 * sin(q.th1()));
                    let reached = (x + l2 * cos(q.th1() + q.th2()), y + l2 * sin(q.th1() + q.th2()));
                    let missed = (reached.0 - (tip.x - arm.base.x)).abs() + (reached.1 - (tip.y - arm.base.y)).abs();
                    assert!(missed < 1e-9, "{q} misses {tip} by {missed}");
                }
            }
        }
    }

    #[test]
    fn exactly_one_none_says_that_the_arm_is_straight_or_folded() {
        for (l1, l2) in LENGTHS {
            let arm = arm(l1, l2);
            for k in 0..24 {
                let bearing = TAU * f64::from(k) / 24.0;
                let at = |d: f64| arm.base + Vector2::new(cos(bearing), sin(bearing)) * d;
                let [Some(straight), None] = arm.ik(at(l1 + l2)) else { panic!("one solution on the outer circle") };
                assert_eq!(straight.th2(), 0.0);
                assert!(wrap(straight.th1() - bearing).abs() < 1e-9);
                let inner = (l1 - l2).abs();
                let [Some(folded), None] = arm.ik(at(inner)) else { panic!("one solution on the inner circle") };
                assert_eq!(folded.th2(), PI);
                // the longer link points at the tip, or away from it when it is the second
                let heading = if l1 >= l2 { bearing } else { bearing + PI };
                assert!(inner == 0.0 || wrap(folded.th1() - heading).abs() < 1e-9);
                // a hair to one side there are two solutions, to the other none
                let hair = 1e-9;
                assert!(matches!(arm.ik(at(l1 + l2 - hair)), [Some(_), Some(_)]));
                assert_eq!(arm.ik(at(l1 + l2 + hair)), [None, None]);
                assert!(matches!(arm.ik(at(inner + hair)), [Some(_), Some(_)]));
                assert!(inner == 0.0 || arm.ik(at(inner - hair)) == [None, None]);
            }
        }
    }
}

/// Exercise 2: the footprint of the car with its trailer as two rectangles with explicit poses.
///
/// The rear axle is at `(x, y)`. The chassis heads `theta` and reaches from `-rear_overhang` to `length -
/// rear_overhang` along it, half the width to each side. The hitch is on the rear axle; the trailer's axle is `d_h`
/// behind it, at `(x - d_h cos psi, y - d_h sin psi)`, heading `psi`; its box reaches from `-rear_overhang` to
/// `front_overhang` about that.
mod exercise_2 {
    use super::*;

    /// The corners of a rectangle about the point (x, y), by the rotation matrix.
    fn corners([x, y]: [f64; 2], heading: f64, [back, front]: [f64; 2], half: f64) -> [[f64; 2]; 4] {
        let (c, s) = (cos(heading), sin(heading));
        [(back, -half), (front, -half), (front, half), (back, half)]
            .map(|(u, v)| [x + c * u - s * v, y + s * u + c * v])
    }

    fn assert_is(part: &Part, expected: [[f64; 2]; 4]) {
        let found = part.placed().core();
        assert_eq!(found.len(), 4);
        for [x, y] in expected {
            let near = found.iter().any(|p| (p.x - x).abs() < 1e-12 && (p.y - y).abs() < 1e-12);
            assert!(near, "no corner at ({x}, {y}) among {found:?}");
        }
    }

    #[test]
    fn two_rectangles_with_explicit_poses() {
        let towing = HITCH.with_trailer();
        let (body, box_, hitch_len) = (HITCH.body, HITCH.trailer_body, towing.hitch_len.unwrap());
        let mut s = Stream::new(Seed(2), "exercise 2");
        for _ in 0..500 {
            let [x, y] = [s.uniform(-9.0, 9.0), s.uniform(-9.0, 9.0)];
            let [theta, psi] = [s.uniform(-PI, PI), s.uniform(-PI, PI)];
            let q = HitchCfg { body: Pose2::new(x, y, theta), trailer: Some(psi) };
            let chassis =
                corners([x, y], theta, [-body.rear_overhang, body.length - body.rear_overhang], 0.5 * body.width);
            let axle = [x - hitch_len * cos(psi), y - hitch_len * sin(psi)];
            let trailer = corners(axle, psi, [-box_.rear_overhang, box_.front_overhang], 0.5 * box_.width);
            let footprint = towing.footprint(&q);
            assert_eq!(footprint.parts().len(), 2);
            assert_is(&footprint.parts()[0], chassis);
            assert_is(&footprint.parts()[1], trailer);
            let alone = HITCH.footprint(&HitchCfg { trailer: None, ..q });
            assert_eq!(alone.parts(), &footprint.parts()[..1], "without the trailer the chassis is the same");
        }
    }
}

/// Exercise 3: the witness of the arm and a square of side 0.2 about (1, 1), as the elbow opens beyond a right angle.
///
/// At `(0, pi/2)` the second link runs up through the square, and the distance is 0. At `(0, pi/2 + beta)` it leaves
/// `(1, 0)` along `(-sin beta, cos beta)`. The distance of the corner `(0.9, 0.9)` from that line is `|(-0.1, 0.9) x
/// (-sin beta, cos beta)| = 0.9 sin beta - 0.1 cos beta`: 0.170434537 at beta = 0.3. It is positive from `tan beta =
/// 1/9` on. The foot of the perpendicular lies `0.9 cos beta + 0.1 sin beta` along the link, which is less than its
/// length 1 for every beta beyond that (the greatest value is sqrt(0.82)), and the corner stays the nearest.
mod exercise_3 {
    use super::*;

    fn square() -> Scene {
        let square = Shape::try_rectangle(Point2::new(0.9, 0.9), Point2::new(1.1, 1.1)).unwrap();
        Scene::empty(PLANE).with_obstacle("the square", square)
    }

    // the numbers at beta = 0 and 0.3 are `exercise_3_predicts_a_witness` in chapter.rs

    #[test]
    fn the_corner_is_the_witness_while_the_elbow_opens() {
        let checker = Checker::new(square(), Reach::<2>::choset());
        let first = 1.0_f64 / 9.0; // tan of the first free angle
        for k in 1..=40 {
            let beta = 0.03 * f64::from(k);
            let q = T2::new(0.0, FRAC_PI_2 + beta);
            let expected = 0.9 * sin(beta) - 0.1 * cos(beta);
            let free = sin(beta) / cos(beta) > first;
            assert_eq!(checker.is_free(&q), free, "beta = {beta}");
            if free {
                let w = checker.witness(&q).unwrap().unwrap();
                assert!((w.dist - expected).abs() < 1e-12, "beta = {beta}: {} is not {expected}", w.dist);
                let along = 0.9 * cos(beta) + 0.1 * sin(beta);
                let foot = Point2::new(1.0 - along * sin(beta), along * cos(beta));
                assert!((w.on_obstacle - Point2::new(0.9, 0.9)).norm() < 1e-12);
                assert!((w.on_robot - foot).norm() < 1e-12);
                assert_eq!(w.part, 1);
            }
        }
    }

    /// The jump. An arm with links of 0.5 and 1 m at `(0, pi/2 + beta)` has its second link beside the square's left
    /// edge, its tip at the height of the edge's middle. Leaning away from the square (beta above 0) the link is
    /// nearest to the corner `(0.9, 0.9)`, at the distance `(0.4, 0.9) x (-sin beta, cos beta)`; leaning toward it, its
    /// tip is nearest to the edge. At beta = 0 the two are parallel, every pair in between ties, and b* jumps by 0.1 m
    /// while the distance does not.
    #[test]
    fn the_witness_jumps_from_corner_to_edge_where_the_two_tie() {
        let checker = Checker::new(square(), Reach { lengths: [0.5, 1.0], ..Reach::<2>::choset() });
        let witness = |beta: f64| checker.witness(&T2::new(0.0, FRAC_PI_2 + beta)).unwrap().unwrap();
        for k in 1..40 {
            let beta = 0.01 * f64::from(k);
            let away = witness(beta);
            assert!((away.on_obstacle - Point2::new(0.9, 0.9)).norm() < 1e-12, "beta = {beta}");
            assert!((away.dist - (0.4 * cos(beta) + 0.9 * sin(beta))).abs() < 1e-12);
            let toward = witness(-beta);
            assert!((toward.on_obstacle - Point2::new(0.9, cos(beta))).norm() < 1e-12, "beta = {}", -beta);
            assert!((toward.dist - (0.4 - sin(beta))).abs() < 1e-12);
        }
        let (corner, edge, tie) = (witness(1e-9), witness(-1e-9), witness(0.0));
        assert!((edge.on_obstacle.y - corner.on_obstacle.y - 0.1).abs() < 1e-8, "b* jumps by a decimetre");
        assert!((edge.dist - corner.dist).abs() < 1e-8, "the distance does not");
        assert!((tie.dist - 0.4).abs() < 1e-12 && (0.9..=1.0 + 1e-12).contains(&tie.on_obstacle.y), "any pair will do");
    }

    /// Between such ties the witness moves without a jump: along an edge as the tip passes it, and to a stop at its
    /// corner.
    #[test]
    fn the_witness_slides_along_an_edge_and_stops_at_the_corner() {
        let checker = Checker::new(square(), Reach { lengths: [0.5, 0.9], ..Reach::<2>::choset() });
        let mut kinds = [0, 0];
        let mut last: Option<Point2> = None;
        for k in 0..=400 {
            // the tip passes below and left of the square as the whole arm turns
            let q = T2::new(0.2 + 0.003 * f64::from(k), 0.1);
            let w = checker.witness(&q).unwrap().unwrap();
            let (tip, b) = (checker.robot().tip(&q), w.on_obstacle);
            if w.dist == 0.0 {
                last = None;
                continue;
            }
            let is_corner = (b.x == 0.9 || b.x == 1.1) && (b.y == 0.9 || b.y == 1.1);
            kinds[usize::from(is_corner)] += 1;
            if !is_corner {
                assert!(b.y == 0.9 || b.x == 0.9 || b.x == 1.1 || b.y == 1.1, "on an edge: {b}");
                assert!((w.on_robot - tip).norm() < 1e-12, "only the tip is nearest to the inside of an edge");
            }
            if let Some(last) = last {
                assert!((b - last).norm() < 0.02, "from {last} to {b} at {q}");
            }
            last = Some(b);
        }
        assert!(kinds[0] > 10 && kinds[1] > 10, "edge {} times, corner {} times", kinds[0], kinds[1]);
    }
}
