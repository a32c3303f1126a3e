//! The check of motion bounds: it accepts the lab's robots, and refuses those whose bounds are wrong.

use motion_lab_core::collision::Certificate;
use motion_lab_core::geometry::{Aabb, Shape};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{
    AnyRobot, ConfigurationError, MotionBound, PartRates, RatesError, RatesUse, TICK, check_drive_rates, check_rates,
};

/// Edges of each robot.
const SAMPLES: u32 = 20_000;

#[track_caller]
fn attained(used: RatesUse) {
    let near_one = |x: f64| (0.98..=1.0 + 1e-5).contains(&x);
    assert!(near_one(used.speed) && near_one(used.acceleration), "{used:?}");
}

#[test]
fn the_bounds_of_the_labs_robots_hold_and_are_attained() {
    attained(check_rates(&Reach::<2>::workbench(), SAMPLES).unwrap());
    attained(check_rates(&Reach::<3>::redundant(), SAMPLES).unwrap());
    attained(check_rates(&HITCH, SAMPLES).unwrap());
    attained(check_rates(&HITCH.with_trailer(), SAMPLES).unwrap());
    let (any, _) = AnyRobot::of_kind("hitch", &[0.0; 4]).unwrap();
    attained(check_rates(&any, SAMPLES).unwrap());
    for disc in [check_rates(&RUSTY, SAMPLES).unwrap(), check_rates(&RustyDisc::default(), SAMPLES).unwrap()] {
        assert!((disc.speed - 1.0).abs() < 1e-5 && disc.acceleration == 0.0, "a straight line: {disc:?}");
    }
}

#[test]
fn the_bounds_of_drives_hold() {
    let rover = [(0.6, 2.5), (-0.6, 1.0), (0.3, 0.0)].map(|(v, omega)| RustyCmd { v, omega });
    let car = [(1.5, 0.6), (-1.5, 0.6), (1.5, -0.3), (-0.4, 0.0)].map(|(v, phi)| CarCmd { v, phi });
    for dt in [TICK, 2.0, 0.33] {
        let used = check_drive_rates(&RUSTY, &rover, dt, 4000).unwrap();
        assert!(used.speed > 0.98 && used.acceleration > 0.98, "{used:?}");
        // The bound adds the corner's turn about the rear axle to the axle's own. At a steering angle of 0.3 rad the
        // axle goes round at 8.082 m, and the corner, 3.2 m ahead and 0.85 m aside, at 9.487 m, not at 11.393 m.
        let used = check_drive_rates(&HITCH, &car, dt, 4000).unwrap();
        assert!((used.acceleration - 9.487 / 11.393).abs() < 1e-3, "{used:?}");
        let used = check_drive_rates(&HITCH.with_trailer(), &car, dt, 4000).unwrap();
        assert!(used.speed > 0.9, "{used:?}");
    }
    let joints = [None, Some(T2::new(1.0, -2.0))];
    assert!(check_drive_rates(&Reach::<2>::workbench(), &joints, TICK, 4000).unwrap().speed > 0.98);
    assert_eq!(check_drive_rates(&RUSTY, &[], TICK, 4000), Ok(RatesUse::default()), "nothing to check");
}

/// A robot whose bounds are wrong.
#[derive(Clone, Debug, PartialEq)]
struct Wrong<R> {
    robot: R,
    /// The part whose bounds are scaled, and the factors of its speed and acceleration.
    part: usize,
    speed: f64,
    acceleration: f64,
    /// The number of bounds dropped at the end.
    dropped: usize,
    /// By how much a disc grows for every metre in x.
    growth: f64,
}

impl<R: Robot> Wrong<R> {
    fn of(robot: R, part: usize, speed: f64, acceleration: f64) -> Self {
        Wrong { robot, part, speed, acceleration, dropped: 0, growth: 0.0 }
    }
}

impl<R: Robot> Robot for Wrong<R> {
    type Configuration = R::Configuration;

    fn check(&self, q: &R::Configuration) -> Result<(), ConfigurationError> {
        self.robot.check(q)
    }

    fn footprint(&self, q: &R::Configuration) -> Footprint {
        let right = self.robot.footprint(q);
        match right.parts() {
            [disc] if self.growth != 0.0 => {
                let radius = 5.0 + self.growth * q.coordinates()[0];
                Footprint::new([Part::new(*disc.pose(), Shape::Disc { radius })])
            }
            _ => right,
        }
    }

    fn edge_rates(&self, a: &R::Configuration, b: &R::Configuration) -> Result<PartRates, ConfigurationError> {
        let mut rates = self.robot.edge_rates(a, b)?;
        rates[self.part].speed *= self.speed;
        rates[self.part].acceleration *= self.acceleration;
        Ok(rates[..rates.len() - self.dropped].iter().copied().collect())
    }

    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> R::Configuration {
        self.robot.sample(min, max, stream)
    }
}

/// A bound a percent too small is found, and the error says where: measured there again, the part does move more.
#[track_caller]
fn found<R: Robot>(robot: R, part: usize) {
    for bound in [MotionBound::Speed, MotionBound::Acceleration] {
        let (speed, acceleration) = if bound == MotionBound::Speed { (0.99, 1.0) } else { (1.0, 0.99) };
        let wrong = Wrong::of(robot.clone(), part, speed, acceleration);
        let error = check_rates(&wrong, SAMPLES).unwrap_err();
        let RatesError::Exceeded { bound: which, part: k, from, to, s, measured, claimed } = error else {
            panic!("{error}")
        };
        assert_eq!((which, k), (bound, part));
        assert!(measured > claimed && measured < 1.02 * claimed, "{measured} {claimed}");
        let rates = robot.edge_rates(&from, &to).unwrap()[part];
        let right = if bound == MotionBound::Speed { rates.speed } else { rates.acceleration };
        assert!((claimed - 0.99 * right).abs() < 1e-9 * right && measured <= right * (1.0 + 1e-6), "{right}");
        // a place nearby, by other differences
        let h = 1e-3;
        let edge = robot.edge(&from, &to).unwrap();
        let at = [s - h, s, s + h].map(|s| edge.footprint_at(s).parts()[part].placed().core().to_vec());
        let greatest = (0..at[0].len()).fold(0.0_f64, |most, v| {
            let change = match bound {
                MotionBound::Speed => (at[2][v] - at[0][v]).norm() / (2.0 * h),
                MotionBound::Acceleration => ((at[2][v] - at[1][v]) - (at[1][v] - at[0][v])).norm() / (h * h),
            };
            if change > most { change } else { most }
        });
        assert!((greatest - measured).abs() < 0.02 * measured, "{greatest} {measured}");
    }
}

#[test]
fn a_bound_one_percent_too_small_is_found_in_every_part() {
    for part in 0..2 {
        found(Reach::<2>::workbench(), part);
        found(HITCH.with_trailer(), part);
    }
    found(Reach::<3>::redundant(), 2);
    found(HITCH, 0);
    let disc = Wrong::of(RustyDisc::default(), 0, 0.99, 1.0);
    assert!(matches!(check_rates(&disc, 100), Err(RatesError::Exceeded { bound: MotionBound::Speed, part: 0, .. })));
}

#[test]
fn what_is_missing_not_finite_or_of_another_shape_is_refused() {
    let mut missing = Wrong::of(HITCH.with_trailer(), 0, 1.0, 1.0);
    missing.dropped = 1;
    let error = check_rates(&missing, SAMPLES).unwrap_err();
    assert!(matches!(error, RatesError::Parts { rates: 1, parts: 2, .. }), "{error}");
    for (speed, acceleration, which) in
        [(f64::NAN, 1.0, MotionBound::Speed), (1.0, f64::NAN, MotionBound::Acceleration)]
    {
        let error = check_rates(&Wrong::of(HITCH, 0, speed, acceleration), 10).unwrap_err();
        assert!(matches!(error, RatesError::Exceeded { bound, .. } if bound == which), "{error}");
    }
    let growing = Wrong { growth: 0.1, ..Wrong::of(RustyDisc::default(), 0, 1.0, 1.0) };
    let error = check_rates(&growing, 10).unwrap_err();
    assert!(matches!(error, RatesError::Footprint { .. }), "{error}");
    let mut bad = HITCH;
    bad.body.width = f64::NAN;
    assert!(matches!(check_rates(&bad, 10), Err(RatesError::Footprint { .. })));
    let controls = [CarCmd { v: f64::INFINITY, phi: 0.0 }];
    let error = check_drive_rates(&HITCH, &controls, TICK, 10).unwrap_err();
    assert!(matches!(error, RatesError::Refused { source: ConfigurationError::ControlNotFinite, .. }), "{error}");
    // an error names the part, the edge and the numbers
    let text = check_rates(&Wrong::of(Reach::<2>::choset(), 1, 0.5, 1.0), SAMPLES).unwrap_err().to_string();
    assert!(text.starts_with("part 1 from T2") && text.contains("its speed at 0.") && text.contains(" m, its bound "));
}

/// Asks all that may call an edge free about a robot whose part has an acceleration that is NaN.
fn never_free<R: Robot>(robot: R, scene: &Scene, part: usize, a: &R::Configuration, b: &R::Configuration) {
    assert!(Checker::new(scene.clone(), robot.clone()).edge(a, b).unwrap().is_free(), "with its own bounds it is free");
    let wrong = Checker::new(scene.clone(), Wrong::of(robot, part, 1.0, f64::NAN));
    let mut certificate = Certificate::new();
    let certified = wrong.edge_certified(a, b, &mut certificate).unwrap();
    let verdicts = [wrong.edge(a, b).unwrap(), certified];
    assert!(!verdicts.iter().any(EdgeVerdict::is_free) && !wrong.edge_free(a, b), "part {part}: {verdicts:?}");
    assert_eq!(certificate.steps(), [], "part {part}");
}

#[test]
fn a_motion_whose_acceleration_is_no_number_is_never_free() {
    let empty = Scene::empty(Aabb::new(Point2::origin(), Point2::origin()));
    let far = empty.clone().with_obstacle_at("post", Pose2::new(90.0, 0.0, 0.0), Shape::Disc { radius: 0.1 });
    for scene in [&empty, &far] {
        for part in 0..2 {
            never_free(Reach::<2>::workbench(), scene, part, &T2::new(0.1, 0.2), &T2::new(0.5, -0.3));
            let at = |x: f64, theta: f64| HitchCfg { body: Pose2::new(x, 1.0, theta), trailer: Some(theta) };
            never_free(HITCH.with_trailer(), scene, part, &at(0.0, 0.1), &at(1.0, 0.4));
        }
    }
}
