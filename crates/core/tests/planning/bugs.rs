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
