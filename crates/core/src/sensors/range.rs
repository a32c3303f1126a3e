//! The directions of a range sensor's rays.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use crate::num;
use crate::worlds::{FanSensor, RangeSensor};

impl RangeSensor {
    /// The direction of ray `k` in the sensor's frame: bearing 2 pi k / n, with exact zeros and ones at the quarter
    /// turns and equal components at the eighths.
    pub fn direction(&self, k: u32) -> (f64, f64) {
        let (n, k) = (u64::from(self.n_rays), 4 * u64::from(k));
        let (quarters, rest) = (k / n, k % n);
        // the first half of a quarter turn, mirrored in the diagonal for the second
        let octant = |rest: u64| num::sin_cos(FRAC_PI_2 * (rest as f64 / n as f64));
        let (s, c) = match (2 * rest).cmp(&n) {
            _ if rest == 0 => (0.0, 1.0),
            Ordering::Less => octant(rest),
            Ordering::Equal => (FRAC_1_SQRT_2, FRAC_1_SQRT_2),
            Ordering::Greater => {
                let (s, c) = octant(n - rest);
                (c, s)
            }
        };
        match quarters % 4 {
            0 => (c, s),
            1 => (-s, c),
            2 => (-c, -s),
            _ => (s, -c),
        }
    }
}

impl FanSensor {
    /// The direction of ray `k` in the sensor's frame, at its [`bearing`](Self::bearing). Over a full turn it is that
    /// of the [`RangeSensor`].
    pub fn direction(&self, k: u32) -> (f64, f64) {
        if self.partial().is_none() {
            return self.sensor.direction(k);
        }
        let (s, c) = num::sin_cos(self.bearing(k));
        (c, s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Scene;
    use crate::geometry::{Point2, Pose2, Segment, Shape};
    use crate::random::{Seed, Stream};
    use crate::worlds::SensorError;

    fn wall() -> Scene {
        Scene::of_walls(&[Segment::new(Point2::new(3.0, 0.0), Point2::new(3.0, 3.0))])
    }

    /// A wall at exactly the range, also where the inverse of that is rounded.
    #[test]
    fn a_wall_at_any_range_counts_at_it_and_a_nanometre_beyond_does_not() {
        let mut draws = Stream::new(Seed(3), "walls");
        let given = [(1.1, -2.02, 1.72), (0.4, -0.88, 2.04), (3.9, -1.26, 1.63)];
        let drawn: Vec<(f64, f64, f64)> = (0..2000)
            .map(|_| (draws.uniform(0.1, 90.0), draws.uniform(-50.0, -0.1), draws.uniform(0.1, 50.0)))
            .collect();
        for (x, low, high) in given.into_iter().chain(drawn) {
            let scene = Scene::of_walls(&[Segment::new(Point2::new(x, low), Point2::new(x, high))]);
            let ahead = |max_range: f64| RangeSensor { n_rays: 1, max_range }.scan(&scene, Point2::origin())[0];
            let read = ahead(x);
            assert!((0.0..=1e-15).contains(&((x - read) / x)), "a wall from {low} to {high} at {x} reads {read}");
            assert_eq!(ahead(x - 1e-9), f64::INFINITY, "a wall from {low} to {high} at {x}");
        }
    }

    #[test]
    fn a_hit_at_exactly_the_range_counts_and_beyond_reads_infinity() {
        let at = |range: f64| RangeSensor { n_rays: 4, max_range: range }.scan(&wall(), Point2::new(2.0, 1.0));
        assert_eq!(at(1.0), [1.0, f64::INFINITY, f64::INFINITY, f64::INFINITY]);
        assert_eq!(at(1.0 - 1e-15)[0], f64::INFINITY);
    }

    #[test]
    fn rays_through_end_points_and_along_walls_hit() {
        let sensor = RangeSensor { n_rays: 8, max_range: 9.0 };
        let diagonal = sensor.scan(&wall(), Point2::new(4.0, 4.0)); // ray 5 points at (3, 3)
        assert!((diagonal[5] - 2.0_f64.sqrt()).abs() < 1e-15);
        let along = sensor.scan(&wall(), Point2::new(3.0, -1.0)); // ray 2 runs along the wall
        assert_eq!(along[2], 1.0);
        assert!(along.iter().enumerate().all(|(k, r)| k == 2 || r.is_infinite()));
    }

    #[test]
    fn inside_an_obstacle_every_range_is_zero() {
        let square = Shape::try_rectangle(Point2::new(0.0, 0.0), Point2::new(1.0, 1.0)).unwrap();
        let scene = wall().with_obstacle("box", square);
        let sensor = RangeSensor { n_rays: 7, max_range: 9.0 };
        for p in [Point2::new(0.5, 0.5), Point2::new(1.0, 0.5), Point2::new(3.0, 1.0)] {
            assert_eq!(sensor.scan(&scene, p), vec![0.0; 7]);
        }
        assert_eq!(sensor.scan(&scene, Point2::new(f64::NAN, 0.0)), vec![0.0; 7]);
    }

    #[test]
    fn discs_are_hit_at_their_near_side_and_turn_with_the_body() {
        let others = [Shape::Disc { radius: 0.5 }.place(&Pose2::new(0.0, 2.0, 0.0))];
        let sensor = RangeSensor { n_rays: 4, max_range: 9.0 };
        let empty = Scene::of_walls(&[]);
        let ahead = sensor.scan_from(&empty, &others, &Pose2::new(0.0, 0.0, FRAC_PI_2));
        assert!((ahead[0] - 1.5).abs() < 1e-15 && ahead[1..].iter().all(|r| r.is_infinite()), "{ahead:?}");
    }

    /// A wall one metre ahead: at bearing b it is 1 / cos b away. Both a straight and an acute angle by hand.
    #[test]
    fn a_fan_goes_from_the_right_border_of_its_field_of_view_to_the_left_one() {
        let scene = Scene::of_walls(&[Segment::new(Point2::new(1.0, -0.5), Point2::new(1.0, 9.0))]);
        let fan = |n_rays, wide| FanSensor { sensor: RangeSensor { n_rays, max_range: 4.0 }, field_of_view: wide };
        let near = |read: &[f64], expected: &[f64]| {
            let same = |(r, e): (&f64, &f64)| r == e || (r - e).abs() < 1e-15;
            assert!(read.len() == expected.len() && read.iter().zip(expected).all(same), "{read:?}, not {expected:?}");
        };
        let root = std::f64::consts::SQRT_2;
        // the wall does not reach down to bearing -45 degrees
        near(&fan(3, FRAC_PI_2).scan_from(&scene, &[], &Pose2::IDENTITY), &[f64::INFINITY, 1.0, root]);
        let third = 2.0 * FRAC_PI_2 / 3.0;
        near(&fan(2, 2.0 * third).scan_from(&scene, &[], &Pose2::IDENTITY), &[f64::INFINITY, 2.0]);
        near(&fan(1, 0.1).scan_from(&scene, &[], &Pose2::IDENTITY), &[1.0]);
        // turned to the left, only the right border still meets the wall
        near(&fan(2, FRAC_PI_2).scan_from(&scene, &[], &Pose2::new(0.0, 0.0, FRAC_PI_2)), &[root, f64::INFINITY]);
        let all = RangeSensor { n_rays: 7, max_range: 4.0 };
        let turn = FanSensor::from(all).scan_from(&scene, &[], &Pose2::IDENTITY);
        assert_eq!(turn, all.scan(&scene, Point2::origin()), "a full turn begins straight ahead");
    }

    #[test]
    fn a_field_of_view_has_limits() {
        let rays = RangeSensor { n_rays: 9, max_range: 4.0 };
        let full = 4.0 * FRAC_PI_2;
        for good in [1e-3, 1.0, full] {
            assert!(FanSensor::try_new(rays, good).is_ok(), "{good}");
        }
        for bad in [0.0, -1.0, 0.000_999, full + 1e-14, f64::NAN, f64::INFINITY] {
            let refused = FanSensor::try_new(rays, bad).unwrap_err();
            assert!(refused.to_string().starts_with("field of view"), "{refused}");
        }
        let without = RangeSensor { n_rays: 0, max_range: 4.0 };
        assert_eq!(FanSensor::try_new(without, 1.0), Err(SensorError::Rays(0)));
    }

    #[test]
    fn a_sensor_needs_rays_and_a_range() {
        assert!(RangeSensor::try_new(0, 1.0).is_err() && RangeSensor::try_new(100_001, 1.0).is_err());
        assert!(RangeSensor::try_new(1, f64::NAN).is_err() && RangeSensor::try_new(1, 0.0).is_err());
        assert!(RangeSensor::try_new(360, 4.0).is_ok());
    }
}
