//! Samples beyond the uniform ones of a [`Problem`]: toward the goal, and near a configuration.

use std::f64::consts::{PI, TAU};

use super::Metric;
use crate::collision::Problem;
use crate::configuration::{Chart, Configuration, Coordinates};
use crate::num::{hypot, lesser, sin_cos, sqrt};
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

/// A configuration drawn uniformly from those through which a path may lead that is shorter than `length` by the
/// metric: the sum of its distances to start and goal is less. Not necessarily free. `None` where no sample was such a
/// one, as where the straight line is as long as that.
///
/// In the plane those are an ellipse, whose foci are start and goal, and it is drawn from that as far as it lies in the
/// space; in another space samples are drawn until one is such a one, at most 64.
pub fn sample_shorter<R: Robot<Configuration: Chart>>(
    problem: &mut Problem<R>,
    metric: &Metric,
    length: f64,
) -> Option<R::Configuration> {
    let (start, goal) = (problem.start().in_chart(), problem.goal().in_chart());
    let least = metric.distance(&start, &goal);
    if least >= length {
        return None;
    }
    let is_plane = metric.axes().len() == 2 && metric.axes().iter().all(|axis| !axis.is_angle && axis.weight == 1.0);
    (0..TRIES).find_map(|_| {
        let q = if is_plane { in_ellipse(problem.stream(), &start, &goal, length)? } else { problem.sample() };
        let bounds = problem.checker().scene().bounds();
        let is_inside = problem.checker().robot().position(&q).is_none_or(|at| bounds.contains(at));
        (is_inside && metric.distance(&start, &q) + metric.distance(&q, &goal) < length).then_some(q)
    })
}

/// A point drawn uniformly from the ellipse with these foci whose points have this sum of distances to them.
fn in_ellipse<C: Chart>(stream: &mut Stream, start: &C, goal: &C, length: f64) -> Option<C> {
    let way = start.log(goal).ok()?;
    let least = hypot(way[0], way[1]);
    let (cos_of, sin_of) = if least > 0.0 { (way[0] / least, way[1] / least) } else { (1.0, 0.0) };
    let (radius, (sin, cos)) = (sqrt(stream.unit()), sin_cos(TAU * stream.unit()));
    let along = 0.5 * length * radius * cos;
    let across = 0.5 * sqrt((length - least) * (length + least)) * radius * sin;
    let mut tangent = way.clone();
    tangent[0] = 0.5 * way[0] + along * cos_of - across * sin_of;
    tangent[1] = 0.5 * way[1] + along * sin_of + across * cos_of;
    start.exp(&tangent)
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
    use crate::collision::{ChainChecker, Checker, Scene};
    use crate::configuration::{R2, T2};
    use crate::geometry::{Aabb, Point2, Pose2};
    use crate::random::Seed;
    use crate::robots::{Reach, RustyDisc};

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

    /// The rover's ellipse with foci 3 m apart and a sum of distances of 5 m has half axes of 2.5 m and 2 m; a quarter
    /// of it lies within half of them, and the circle of 2 m about the middle holds 4/5 of it.
    #[test]
    fn samples_for_a_shorter_path_fill_an_ellipse_evenly() {
        let bounds = Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) };
        let checker = Checker::new(Scene::empty(bounds), RustyDisc::default());
        // 3 m apart: along (0.6, 0.8) from (1, 1)
        let (start, goal) = (R2::new(1.0, 1.0), R2::new(2.8, 3.4));
        let metric = Metric::unit(&start);
        let mut problem = Problem::try_new(checker, start, goal, Seed(5)).unwrap();
        let (mut inner, mut circle, mut left) = (0, 0, 0);
        for _ in 0..4000 {
            let q = sample_shorter(&mut problem, &metric, 5.0).unwrap();
            let (x, y) = (q.0.x - 1.9, q.0.y - 2.2);
            let (along, across) = (0.6 * x + 0.8 * y, 0.6 * y - 0.8 * x);
            let place = (along / 2.5) * (along / 2.5) + (across / 2.0) * (across / 2.0);
            assert!(place < 1.0, "{q}");
            inner += u32::from(place < 0.25);
            circle += u32::from(hypot(along, across) < 2.0);
            left += u32::from(across > 0.0);
        }
        // 1000, 3200 and 2000, give or take 5 sigma of 27.4, 25.3 and 31.6
        assert!((863..1137).contains(&inner) && (3074..3326).contains(&circle), "{inner} {circle}");
        assert!((1842..2158).contains(&left), "{left}");
        assert!(sample_shorter(&mut problem, &metric, 3.0).is_none(), "nothing is shorter than the straight line");
    }

    #[test]
    fn samples_for_a_shorter_path_of_an_arm_lie_near_its_ends() {
        let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
        let (start, goal) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
        let metric = Metric::unit(&start);
        let mut problem = Problem::try_new(checker, start, goal, Seed(3)).unwrap();
        let (mut drawn, mut between) = (0, 0);
        for _ in 0..200 {
            let Some(q) = sample_shorter(&mut problem, &metric, 4.0) else { continue };
            assert!(metric.distance(&start, &q) + metric.distance(&q, &goal) < 4.0, "{q}");
            drawn += 1;
            let is_apart = |end| metric.distance(end, &q) > 0.5;
            between += u32::from(is_apart(&start) && is_apart(&goal));
        }
        // nearly an ellipse of half axes 2 and 1.92: all but 13 in 100 lie outside the two circles about its foci
        assert!(drawn > 180 && between > 7 * drawn / 10, "{drawn} {between}");
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
