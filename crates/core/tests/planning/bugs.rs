//! Bug1 and Bug2 where their authors say that they leave an obstacle.

use super::*;

/// From one side of a wall to the other: the wall stands on x = 0 from y = -0.5 to 0.8.
fn round_a_wall() -> Problem<RustyDisc> {
    Problem::try_new(room(&[[0.0, -0.5, 0.0, 0.8]]), R2::new(-1.0, 0.0), R2::new(1.0, 0.0), Seed(1)).unwrap()
}

/// How near a path's corners come to a place, metres.
fn nearest(corners: &[R2], x: f64, y: f64) -> f64 {
    corners.iter().map(|q| (q.0 - Point2::new(x, y)).norm()).fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

/// Radius and kept clearance are 10 and 5 cm, so the bugs walk 15 cm from the wall, in steps of 2.5 cm.
const STEP: f64 = 0.026;

#[test]
fn bug2_leaves_on_the_line_to_the_goal() {
    let path = solve(&mut Bug2::try_new(&round_a_wall()).unwrap(), &Bounds::default()).unwrap();
    let corners = path.corners();
    // with the wall at its right hand it goes over the upper end, though the lower is nearer, and down to the line
    assert!(nearest(&corners, 0.0, 0.95) < STEP && nearest(&corners, 0.0, -0.65) > 0.4);
    assert!(nearest(&corners, 0.15, 0.0) < STEP, "{}", nearest(&corners, 0.15, 0.0));
    // from there on straight
    let left = corners.iter().filter(|q| q.0.x > 0.2).map(|q| q.0.y.abs()).fold(0.0, |m, y| if y > m { y } else { m });
    assert!(left < STEP, "{left} m off the line");
}

#[test]
fn bug1_goes_all_round_and_leaves_where_it_was_nearest() {
    let path = solve(&mut Bug1::try_new(&round_a_wall()).unwrap(), &Bounds::default()).unwrap();
    let corners = path.corners();
    for (x, y) in [(-0.15, 0.0), (0.0, 0.95), (0.15, 0.0), (0.0, -0.65)] {
        assert!(nearest(&corners, x, y) < STEP, "({x}, {y}): {}", nearest(&corners, x, y));
    }
    // once round is 2 * 1.3 m and the two ends' half circles; it walks that, a part of it back, at most half, and the
    // way on which it comes to its clearance, 16 steps
    let round = 2.6 + std::f64::consts::TAU * 0.15;
    let length = corners.windows(2).map(|ends| (ends[1].0 - ends[0].0).norm()).sum::<f64>();
    assert!(length > 1.7 + 0.95 * round && length < 2.2 + 1.5 * round, "{length} m, {round} m round");
}

/// A room with walls and boxes drawn from a seed, and two places in it at which a disc half as large again is free.
fn clutter(seed: u64) -> Problem<RustyDisc> {
    let mut s = Stream::new(Seed(seed), "clutter");
    let mut walls = Vec::new();
    for _ in 0..10 {
        let (x, y) = (s.uniform(-1.9, 1.9), s.uniform(-1.9, 1.9));
        walls.push([x, y, x + s.uniform(-1.2, 1.2), y + s.uniform(-1.2, 1.2)]);
    }
    let checker = room(&walls);
    let mut place = || loop {
        let q = R2::new(s.uniform(-1.9, 1.9), s.uniform(-1.9, 1.9));
        if checker.distance(&q) > 0.07 && q.0.x.abs() < 1.85 && q.0.y.abs() < 1.85 {
            return q;
        }
    };
    let (start, goal) = (place(), place());
    Problem::try_new(checker, start, goal, Seed(seed)).unwrap()
}

/// Whether a disc that keeps 6 cm from everything, a little more than the bugs, gets from start to goal, by a grid of
/// 2 cm.
fn has_way(problem: &Problem<RustyDisc>) -> bool {
    let larger = Checker::new(problem.checker().shared_scene(), RustyDisc::try_new(0.16).unwrap());
    let Ok(larger) = Problem::try_new(larger, problem.start(), problem.goal(), Seed(1)) else { return false };
    let path = solve(&mut GridSearch::of(larger, 0.02, true), &Bounds::default());
    // the sides of the room count as walls for the bugs, which keep 5 cm from them
    path.is_ok_and(|path| path.corners().iter().all(|q| q.0.x.abs() < 1.94 && q.0.y.abs() < 1.94))
}

#[test]
fn bugs_find_a_way_wherever_there_is_one_for_the_clearance_that_they_keep() {
    let (mut ways, mut rounds) = (0, 0);
    for seed in 0..count_from_env(PLANS, 60) {
        let problem = clutter(seed);
        let bug1 = solve(&mut Bug1::try_new(&problem).unwrap(), &Bounds::default());
        let bug2 = solve(&mut Bug2::try_new(&problem).unwrap(), &Bounds::default());
        assert!(bug2.is_ok() || bug1.is_err(), "seed {seed}: bug1 finds a way, and bug2 none");
        if !has_way(&problem) {
            continue;
        }
        ways += 1;
        for (name, path) in [("bug1", bug1), ("bug2", bug2)] {
            assert!(path.is_ok(), "{name} at seed {seed}: {}", path.unwrap_err());
        }
        rounds += u32::from(!problem.checker().edge_free(&problem.start(), &problem.goal()));
    }
    assert!(ways > 40 && rounds > 15, "{ways} {rounds}");
}

/// At this seed both come round by another way than the one on which they came to the boundary.
const NOT_BACK: u64 = 284;

#[test]
fn a_round_is_closed_that_does_not_come_back_to_where_it_began() {
    let problem = clutter(NOT_BACK);
    assert!(has_way(&problem));
    let mut bugs: [Box<dyn Planner<RustyDisc>>; 2] =
        [Box::new(Bug1::try_new(&problem).unwrap()), Box::new(Bug2::try_new(&problem).unwrap())];
    for bug in &mut bugs {
        solved(bug.as_mut(), NOT_BACK, |corners| disc_clearance(problem.checker().scene(), 0.1, corners));
    }
}

/// At this seed Bug2's steps go past the place to leave from; before, it said that there was no path.
const GOES_PAST: u64 = 651;

#[test]
fn bug2_that_went_past_a_place_to_leave_from_leaves_where_it_was_nearest() {
    let problem = across_the_apartment(GOES_PAST);
    let path = solved(&mut Bug2::try_new(&problem).unwrap(), GOES_PAST, |corners| {
        disc_clearance(problem.checker().scene(), 0.11, corners)
    });
    assert!(path.legs().len() > 100);
}

/// A wall across the room with a gap of this width for a disc of 20 cm, and a place on either side of it, not in line
/// with the gap.
fn through_a_gap(width: f64) -> Problem<RustyDisc> {
    let half = 0.5 * width;
    let checker = room(&[[0.0, -2.5, 0.0, 0.4 - half], [0.0, 0.4 + half, 0.0, 2.5]]);
    Problem::try_new(checker, R2::new(-1.0, -0.5), R2::new(1.0, -0.5), Seed(1)).unwrap()
}

#[test]
fn bugs_pass_a_gap_for_which_they_keep_less_than_they_like() {
    // with half the radius kept on either side a gap has to be 30 cm wide, with a sixteenth 21.25 cm
    for width in [0.31, 0.29, 0.24, 0.22, 0.214] {
        let problem = through_a_gap(width);
        let mut bugs: [Box<dyn Planner<RustyDisc>>; 2] =
            [Box::new(Bug1::try_new(&problem).unwrap()), Box::new(Bug2::try_new(&problem).unwrap())];
        for bug in &mut bugs {
            let path = solved(bug.as_mut(), 1, |corners| disc_clearance(problem.checker().scene(), 0.1, corners));
            let room = 0.5 * (width - 0.2);
            assert!(path.clearance() <= room && path.clearance() > 0.0, "{} {width}", bug.name());
        }
    }
    let problem = through_a_gap(0.21);
    let none = solve(&mut Bug2::try_new(&problem).unwrap(), &Bounds::default()).unwrap_err();
    assert_eq!(none, NoPath::Enclosed { kept: 0.00625 });
    assert!(solve(&mut VisibilityGraph::new(problem), &Bounds::default()).is_ok(), "there is a way all the same");
}
