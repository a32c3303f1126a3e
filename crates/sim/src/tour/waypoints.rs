//! `Waypoints`, Rusty's tour: round and round a line painted on the floor.

use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::{self, wrap};
use motion_lab_core::robots::{Rusty, RustyCmd};
use motion_lab_core::worlds::World;

/// The name of the painted mark whose points a Rusty pursues, one after the other, when nobody drives it.
pub const TOUR_MARK: &str = "tour";

/// A waypoint counts as reached within this distance, metres.
pub const ARRIVAL_RADIUS: f64 = 0.12;

/// Turn rate per radian of heading error, per second.
const STEERING_GAIN: f64 = 4.0;

/// Beyond this heading error, radians, Rusty turns on the spot.
const TURN_ON_THE_SPOT: f64 = 0.6;

/// A loop of waypoints. It does not depend on the seed: only the wheels' slip is random.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waypoints {
    points: Vec<Point2>,
}

impl Waypoints {
    /// The loop through these points, in metres.
    pub fn new(points: Vec<Point2>) -> Self {
        Waypoints { points }
    }

    /// The loop along the world's mark named [`TOUR_MARK`]; without such a mark it has no waypoints, and Rusty does not
    /// move. A mark that ends where it begins is a loop painted closed, and its last point is left out.
    pub fn of_world(world: &World) -> Self {
        let mut points = world.marks.iter().find(|m| m.name == TOUR_MARK).map_or_else(Vec::new, |m| m.points.clone());
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        Waypoints { points }
    }

    /// The waypoints.
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    /// The command at the pose `q` on the way to waypoint number `next`, and the number of the waypoint to pursue after
    /// it.
    ///
    /// Steering uses the true pose: proportional to the heading error, slower the larger it is, and on the spot beyond
    /// 0.6 rad, so that Rusty leaves each waypoint along the straight line to the next.
    pub fn pursue(&self, robot: &Rusty, q: &Pose2, next: usize) -> (RustyCmd, usize) {
        let Some(&goal) = self.points.get(next) else { return (RustyCmd::default(), 0) };
        let arrived = |p: Point2| num::hypot(p.x - q.x, p.y - q.y) <= ARRIVAL_RADIUS;
        let next = if arrived(goal) { (next + 1) % self.points.len() } else { next };
        let goal = self.points[next];
        if arrived(goal) {
            return (RustyCmd::default(), next); // a loop of one point, or of points closer than the radius
        }
        let error = wrap(num::atan2(goal.y - q.y, goal.x - q.x) - q.theta);
        let v = if error.abs() > TURN_ON_THE_SPOT { 0.0 } else { robot.max_speed * num::cos(error) };
        (robot.limited(&RustyCmd { v, omega: STEERING_GAIN * error }), next)
    }

    /// The number of the waypoint at which to resume the loop from `position`: the nearest that `reachable` allows, or
    /// the nearest of all if it allows none. Ties go to the lowest number.
    pub fn resume(&self, position: Point2, reachable: impl Fn(Point2) -> bool) -> usize {
        let nearest = |allowed: &dyn Fn(Point2) -> bool| {
            let mut best: Option<(f64, usize)> = None;
            for (i, p) in self.points.iter().enumerate() {
                let d = num::hypot(p.x - position.x, p.y - position.y);
                if best.is_none_or(|(least, _)| d < least) && allowed(*p) {
                    best = Some((d, i));
                }
            }
            best.map(|(_, i)| i)
        };
        nearest(&reachable).or_else(|| nearest(&|_| true)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::robots::{Drivable, Motion, RUSTY};

    fn square() -> Waypoints {
        Waypoints::new([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point2::new(x, y)).to_vec())
    }

    #[test]
    fn a_loop_is_driven_close_to_its_lines() {
        let tour = square();
        let (mut q, mut next, mut laps) = (Pose2::new(0.0, 0.0, 1.0), 0, 0);
        for _ in 0..1000 {
            let (u, after) = tour.pursue(&RUSTY, &q, next);
            laps += usize::from(after < next);
            next = after;
            assert!(u.v.abs() <= RUSTY.max_speed && u.omega.abs() <= RUSTY.max_turn_rate);
            q = RUSTY.drive(&q, &u, 0.05).unwrap().at(1.0);
            let outside = [-q.x, q.x - 2.0, -q.y, q.y - 2.0].into_iter().fold(f64::NEG_INFINITY, num::greater);
            assert!(outside.abs() < ARRIVAL_RADIUS + 0.02, "{q} leaves the square's border");
        }
        assert!(laps >= 2, "8 m a lap at 0.6 m/s: 50 s are more than two laps, got {laps}");
    }

    #[test]
    fn without_waypoints_there_is_no_motion() {
        let none = Waypoints::default();
        assert_eq!(none.pursue(&RUSTY, &Pose2::IDENTITY, 3), (RustyCmd::default(), 0));
        let one = Waypoints::new(vec![Point2::new(0.01, 0.0)]);
        assert_eq!(one.pursue(&RUSTY, &Pose2::IDENTITY, 0), (RustyCmd::default(), 0));
        assert_eq!(none.resume(Point2::origin(), |_| true), 0);
    }

    #[test]
    fn the_loop_is_resumed_at_the_nearest_waypoint_that_can_be_reached() {
        let tour = square();
        assert_eq!(tour.resume(Point2::new(1.8, 0.1), |_| true), 1);
        assert_eq!(tour.resume(Point2::new(1.8, 0.1), |p| p.y > 1.0), 2);
        assert_eq!(tour.resume(Point2::new(1.0, 0.0), |_| true), 0, "the lowest on a tie");
        assert_eq!(tour.resume(Point2::new(1.8, 0.1), |_| false), 1);
    }
}
