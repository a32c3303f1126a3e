//! Samples beyond the uniform ones of a [`Problem`]: toward the goal, and near a configuration.

use std::f64::consts::PI;

use super::Metric;
use crate::collision::Problem;
use crate::configuration::{Chart, Coordinates};
use crate::num::lesser;
use crate::random::Stream;
use crate::robots::Robot;

/// Samples of the box around a ball that are drawn before the centre is taken instead. In four dimensions three of ten
/// lie in the ball.
const TRIES: u32 = 64;

/// The goal with the probability `bias`, otherwise a configuration drawn uniformly from the space; not necessarily
/// free. The one number that decides is drawn first.
pub fn sample_toward_goal<R: Robot>(problem: &mut Problem<R>, bias: f64) -> R::Configuration {
    if problem.stream().unit() < bias { problem.goal() } else { problem.sample() }
}

/// A configuration drawn uniformly from those within `radius` of `centre` by the metric; not necessarily free.
/// Coordinates of weight 0 are the centre's.
pub fn sample_near<C: Chart>(stream: &mut Stream, centre: &C, radius: f64, metric: &Metric) -> C {
    let half = |i: usize| {
        let axis = metric.axes()[i];
        let widest = if axis.is_angle { PI } else { f64::MAX };
        if axis.weight > 0.0 { lesser(radius / axis.weight, widest) } else { 0.0 }
    };
    let count = metric.axes().len();
    let origin: Coordinates = (0..count).map(|_| 0.0).collect();
    for _ in 0..TRIES {
        let tangent: Coordinates = (0..count).map(|i| half(i) * stream.uniform(-1.0, 1.0)).collect();
        if metric.squared(&origin, &tangent) <= radius * radius {
            return centre.exp(&tangent).unwrap_or(*centre);
        }
    }
    *centre
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{ChainChecker, Scene};
    use crate::configuration::T2;
    use crate::geometry::Pose2;
    use crate::random::Seed;
    use crate::robots::Reach;

    #[test]
    fn near_samples_fill_the_ball_evenly_and_stay_in_it() {
        let (centre, weights) = (Pose2::new(3.0, -1.0, 3.0), [1.0, 2.0, 0.5]);
        let metric = Metric::try_weighted(&centre, &weights).unwrap();
        let mut s = Stream::new(Seed(4), "near");
        let (mut inner, mut above, mut across) = (0, 0, 0);
        for _ in 0..4000 {
            let q = sample_near(&mut s, &centre, 0.5, &metric);
            let d = metric.distance(&centre, &q);
            assert!(d <= 0.5 + 1e-12, "{q}");
            inner += u32::from(d <= 0.25);
            above += u32::from(q.y > -1.0);
            across += u32::from(q.theta < 0.0);
        }
        // a ball of half the radius has an eighth of the volume: 500, give or take 5 sigma of 20.9
        assert!((396..604).contains(&inner), "{inner}");
        assert!((1842..2158).contains(&above), "{above}");
        assert!(across > 500, "the ball reaches across pi: {across}");
        let still = sample_near(&mut s, &centre, 0.5, &Metric::try_weighted(&centre, &[1.0, 0.0, 1.0]).unwrap());
        assert_eq!(still.y, -1.0);
    }

    #[test]
    fn the_goal_is_drawn_as_often_as_asked() {
        let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
        let goal = T2::new(3.1, 0.0);
        let mut problem = Problem::try_new(checker, T2::new(2.0, 0.0), goal, Seed(3)).unwrap();
        let count = (0..4000).filter(|_| sample_toward_goal(&mut problem, 0.25) == goal).count();
        // 1000, give or take 5 sigma of 27.4
        assert!((863..1137).contains(&count), "{count}");
    }
}
