//! The curves against a search for roots over all words, and against lengths by hand.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

use super::*;
use crate::geometry::Pose2;
use crate::num::{cos, greater, hypot, lesser, sin, sqrt, wrap};
use crate::random::{Seed, Stream};

/// How the length of a piece of a word is found.
#[derive(Clone, Copy, PartialEq)]
enum Length {
    First,
    Second,
    Quarter,
    /// Whatever the goal's heading asks for.
    Last,
}

/// A word: for each piece its curvature, its gear, and how its length is found.
type Word = Vec<(f64, f64, Length)>;

/// The words of Dubins's theorem, as his paper lists them: CSC and CCC.
fn dubins_words() -> Vec<Word> {
    let mut words = Vec::new();
    for a in [1.0, -1.0] {
        for c in [1.0, -1.0] {
            words.push(vec![(a, 1.0, Length::First), (0.0, 1.0, Length::Second), (c, 1.0, Length::Last)]);
        }
        words.push(vec![(a, 1.0, Length::First), (-a, 1.0, Length::Second), (a, 1.0, Length::Last)]);
    }
    words
}

/// The nine families of Reeds and Shepp's theorem, each with both turns and both gears, as their paper lists them.
fn reeds_shepp_words() -> Vec<Word> {
    use Length::{First, Last, Quarter, Second};
    let mut words = Vec::new();
    for (a, g) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        words.push(vec![(a, g, First), (-a, -g, Second), (a, g, Last)]); // C|C|C
        words.push(vec![(a, g, First), (-a, -g, Second), (a, -g, Last)]); // C|CC
        words.push(vec![(a, g, First), (-a, g, Second), (a, -g, Last)]); // CC|C
        words.push(vec![(a, g, First), (-a, g, Second), (a, -g, Second), (-a, -g, Last)]); // CCu|CuC
        words.push(vec![(a, g, First), (-a, -g, Second), (a, -g, Second), (-a, g, Last)]); // C|CuCu|C
        for c in [1.0, -1.0] {
            words.push(vec![(a, g, First), (0.0, g, Second), (c, g, Last)]); // CSC
            words.push(vec![(a, g, First), (-a, -g, Quarter), (0.0, -g, Second), (c, -g, Last)]); // C|C90SC
            words.push(vec![(a, g, First), (0.0, g, Second), (c, g, Quarter), (-c, -g, Last)]); // CSC90|C
        }
        let turns = [(a, g, First), (-a, -g, Quarter), (0.0, -g, Second), (a, -g, Quarter), (-a, g, Last)];
        words.push(turns.to_vec()); // C|C90SC90|C
    }
    words
}

/// Drives a word with these two lengths, and a last arc up to the goal's heading: by how much it misses the goal's
/// place, and how long it is.
fn drive(word: &Word, goal: &Pose2, first: f64, second: f64) -> ([f64; 2], f64) {
    let (mut x, mut y, mut heading, mut total) = (0.0, 0.0, 0.0, 0.0);
    for &(curvature, gear, length) in word {
        let length = match length {
            Length::First => first,
            Length::Second => second,
            Length::Quarter => FRAC_PI_2,
            Length::Last => {
                let turn = wrap((goal.theta - heading) * curvature * gear);
                // a whole turn less rounding is none
                if turn < -1e-9 { turn + TAU } else { greater(turn, 0.0) }
            }
        };
        let signed = gear * length;
        if curvature == 0.0 {
            x += signed * cos(heading);
            y += signed * sin(heading);
        } else {
            let next = heading + curvature * signed;
            x += (sin(next) - sin(heading)) / curvature;
            y -= (cos(next) - cos(heading)) / curvature;
            heading = next;
        }
        total += length;
    }
    ([x - goal.x, y - goal.y], total)
}

/// The length of the shortest curve of these words to a goal for radius 1: Newton's method from a grid of starts.
fn shortest_by_search(words: &[Word], goal: &Pose2) -> f64 {
    let mut best = f64::INFINITY;
    for word in words {
        let has_line = word.iter().any(|piece| piece.0 == 0.0);
        let longest = if has_line { hypot(goal.x, goal.y) + 6.0 } else { TAU };
        for i in 0..10 {
            for j in 0..8 {
                let (mut t, mut u) = (TAU * (f64::from(i) + 0.3) / 10.0, longest * (f64::from(j) + 0.4) / 8.0);
                for _ in 0..24 {
                    let h = 1e-6;
                    let (miss, _) = drive(word, goal, t, u);
                    let ((dt, _), (du, _)) = (drive(word, goal, t + h, u), drive(word, goal, t, u + h));
                    let [a, c] = [(dt[0] - miss[0]) / h, (dt[1] - miss[1]) / h];
                    let [b, d] = [(du[0] - miss[0]) / h, (du[1] - miss[1]) / h];
                    let det = a * d - b * c;
                    if det.abs() < 1e-12 || miss[0].abs() + miss[1].abs() < 1e-12 {
                        break;
                    }
                    t -= ((d * miss[0] - b * miss[1]) / det).clamp(-0.5, 0.5);
                    u -= ((a * miss[1] - c * miss[0]) / det).clamp(-1.0, 1.0);
                }
                t -= TAU * (t / TAU + 1e-9).floor();
                let (miss, length) = drive(word, goal, t, u);
                if hypot(miss[0], miss[1]) < 1e-8 && t > -1e-7 && u > -1e-7 {
                    best = lesser(best, length);
                }
            }
        }
    }
    best
}

fn goals(name: &str, count: usize) -> Vec<Pose2> {
    let mut draws = Stream::new(Seed(25), name);
    (0..count)
        .map(|i| {
            // near goals need the words with many arcs
            let far = [0.5, 1.5, 4.0][i % 3];
            Pose2::new(draws.uniform(-far, far), draws.uniform(-far, far), draws.uniform(-PI, PI))
        })
        .collect()
}

/// Checks that a curve ends at its goal, by the oracle's own drive.
fn check_end(curve: &Curve, goal: &Pose2) {
    let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0);
    for piece in curve.pieces() {
        let turn = piece.turn.sign() * piece.length / curve.radius();
        if turn == 0.0 {
            x += piece.length * cos(heading);
            y += piece.length * sin(heading);
        } else {
            let radius = piece.length / turn;
            x += radius * (sin(heading + turn) - sin(heading));
            y -= radius * (cos(heading + turn) - cos(heading));
            heading += turn;
        }
    }
    let miss = hypot(x - goal.x, y - goal.y) + wrap(heading - goal.theta).abs();
    assert!(miss < 1e-7, "{curve:?} misses {goal} by {miss}");
}

#[test]
fn dubins_curves_are_the_shortest_of_all_words() {
    let words = dubins_words();
    for goal in goals("dubins", 120) {
        let curve = dubins(&Pose2::IDENTITY, &goal, 1.0).unwrap();
        check_end(&curve, &goal);
        let searched = shortest_by_search(&words, &goal);
        assert!((curve.length() - searched).abs() < 1e-6, "{goal:?}: {} but {searched} {curve:?}", curve.length());
        assert_eq!(curve.reversals(), 0);
    }
}

#[test]
fn reeds_and_shepps_curves_are_the_shortest_of_all_words() {
    let words = reeds_shepp_words();
    let (mut numbers, mut changes) = ([0; 6], [0; 4]);
    // five pieces are seldom the shortest
    let five = |goal: &Pose2| reeds_shepp(&Pose2::IDENTITY, goal, 1.0).is_some_and(|c| c.pieces().len() == 5);
    let seldom = goals("five pieces", 30_000).into_iter().filter(five).take(10);
    for goal in goals("reeds and shepp", 120).into_iter().chain(seldom) {
        let curve = reeds_shepp(&Pose2::IDENTITY, &goal, 1.0).unwrap();
        check_end(&curve, &goal);
        let searched = shortest_by_search(&words, &goal);
        assert!((curve.length() - searched).abs() < 1e-6, "{goal:?}: {} but {searched} {curve:?}", curve.length());
        numbers[curve.pieces().len()] += 1;
        changes[curve.reversals()] += 1;
    }
    assert!(numbers[3] > 10 && numbers[4] > 10 && numbers[5] == 10, "{numbers:?} of 3, 4 and 5 pieces");
    assert!(changes[1] > 10 && changes[2] > 10, "{changes:?} of 1 and 2 changes of gear");
}

#[test]
fn lengths_by_hand() {
    let pose = Pose2::new;
    let root = sqrt(3.0);
    // where, by Dubins, by Reeds and Shepp; the radius is 1
    for (goal, ahead, both) in [
        (pose(4.0, 0.0, 0.0), 4.0, 4.0),
        // a half circle beside the start
        (pose(0.0, 2.0, PI), PI, PI),
        (pose(1.0, 1.0, FRAC_PI_2), FRAC_PI_2, FRAC_PI_2),
        (pose(1.0, -1.0, -FRAC_PI_2), FRAC_PI_2, FRAC_PI_2),
        // on the spot: three circles about the corners of an equilateral triangle; back, the arcs are the short ones
        (pose(0.0, 0.0, PI), FRAC_PI_3 + (TAU - FRAC_PI_3) + FRAC_PI_3, PI),
        // a lane changed: two arcs of 60 degrees, sideways by 2 (1 - cos 60), ahead by 2 sin 60
        (pose(root, 1.0, 0.0), 2.0 * FRAC_PI_3, 2.0 * FRAC_PI_3),
        // a straight line back is short only for Reeds and Shepp
        (pose(-3.0, 0.0, 0.0), f64::NAN, 3.0),
        (pose(-root, 1.0, 0.0), f64::NAN, 2.0 * FRAC_PI_3),
    ] {
        let by = |curve: Option<Curve>, expected: f64| {
            let curve = curve.unwrap();
            let ok = expected.is_nan() || (curve.length() - 2.5 * expected).abs() < 1e-8;
            assert!(ok, "{goal}: {} m, not {}", curve.length(), 2.5 * expected);
        };
        let far = Pose2::new(2.5 * goal.x, 2.5 * goal.y, goal.theta);
        by(dubins(&Pose2::IDENTITY, &far, 2.5), ahead);
        by(reeds_shepp(&Pose2::IDENTITY, &far, 2.5), both);
        // from elsewhere
        let from = pose(3.0, -1.0, 2.2);
        by(dubins(&from, &from.compose(&far), 2.5), ahead);
        by(reeds_shepp(&from, &from.compose(&far), 2.5), both);
    }
}

#[test]
fn mirrors_and_ways_back_are_as_long() {
    for goal in goals("symmetry", 600) {
        let curve = reeds_shepp(&Pose2::IDENTITY, &goal, 1.0).unwrap();
        let same = |from: &Pose2, to: &Pose2| {
            let other = reeds_shepp(from, to, 1.0).unwrap();
            assert!((other.length() - curve.length()).abs() < 1e-7, "{goal:?}: {curve:?} {other:?}");
        };
        same(&goal, &Pose2::IDENTITY);
        same(&Pose2::IDENTITY, &Pose2::new(goal.x, -goal.y, -goal.theta));
        same(&Pose2::IDENTITY, &Pose2::new(-goal.x, goal.y, -goal.theta));
        let ahead = dubins(&Pose2::IDENTITY, &goal, 1.0).unwrap();
        assert!(curve.length() <= ahead.length() + 1e-7);
        let mirrored = dubins(&Pose2::IDENTITY, &Pose2::new(goal.x, -goal.y, -goal.theta), 1.0).unwrap();
        assert!((mirrored.length() - ahead.length()).abs() < 1e-7, "{goal:?}: {ahead:?} {mirrored:?}");
    }
}

#[test]
fn places_along_a_curve_are_as_far_apart_as_it_drives() {
    let curve = reeds_shepp(&Pose2::IDENTITY, &Pose2::new(0.4, 1.1, 2.0), 1.0).unwrap();
    let mut before = Pose2::IDENTITY;
    let steps = 1000;
    for i in 1..=steps {
        let at = curve.at(&Pose2::IDENTITY, curve.length() * f64::from(i) / f64::from(steps));
        let step = hypot(at.x - before.x, at.y - before.y);
        assert!(step <= 1.001 * curve.length() / f64::from(steps), "{step} at {i}");
        before = at;
    }
    let missed = curve.end(&Pose2::IDENTITY).boxminus(&before);
    assert!(hypot(missed.dx, missed.dy) < 1e-12, "{missed:?}");
}

#[test]
fn what_is_no_number_or_no_radius_has_no_curve() {
    let (a, b) = (Pose2::IDENTITY, Pose2::new(1.0, 2.0, 0.3));
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(dubins(&a, &b, radius).is_none() && reeds_shepp(&a, &b, radius).is_none(), "{radius}");
    }
    let nowhere = Pose2 { x: f64::NAN, ..b };
    assert!(dubins(&a, &nowhere, 1.0).is_none() && reeds_shepp(&nowhere, &a, 1.0).is_none());
    assert_eq!(dubins(&b, &b, 1.0).unwrap().pieces(), []);
    assert_eq!(reeds_shepp(&b, &b, 1.0).unwrap().length(), 0.0);
}

#[test]
fn a_curve_from_a_pose_to_itself_has_the_length_zero_without_a_sign() {
    let here = Pose2::new(1.0, 2.0, 0.5);
    for curve in [dubins(&here, &here, 2.0), reeds_shepp(&here, &here, 2.0)].map(Option::unwrap) {
        assert_eq!((curve.length().to_bits(), curve.pieces().len()), (0.0_f64.to_bits(), 0));
    }
}
