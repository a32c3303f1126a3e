//! Holding: how far a tick's motion may go before it would touch something.

use motion_lab_core::collision::{Collision, UnkeptMargin, keeps};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::robots::{Beginning, Motion};

/// Least clearance at the end of a blocked motion that starts with at least this clearance, metres.
pub const MIN_CLEARANCE: f64 = 1e-5;

/// Clearance that a motion keeps when it starts with more than this, metres.
pub const MARGIN: f64 = 2e-5;

/// Clearance at which a blocked motion is held, metres, unless it starts with less.
pub const HOLD_CLEARANCE: f64 = 4e-5;

/// Largest part of a small clearance that one motion may use up, metres. It is enough for rounding, so that sliding
/// along a wall never sticks, and little enough that a clearance is not worn down.
const WEAR: f64 = 1e-10;

/// Clearance at which the bisection for the hold may stop, metres; well below 1e-4.
const HOLD_ENOUGH: f64 = 6e-5;

/// The part of a motion that a robot may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advance {
    /// The parameter at which the motion ends; the motion is free up to it.
    pub until: f64,
    /// Whether it was blocked.
    pub blocked: bool,
}

/// The clearance that a motion has to keep when it starts with the clearance `start`, metres. It is [`MARGIN`], or for
/// a nearer start just below `start`, so that the robot may leave and slide along. For a start above
/// [`MIN_CLEARANCE`] it is never below that.
///
/// A start nearer than that is possible only where a robot was put there; it too has to keep a
/// little less than its own clearance.
pub fn margin_from(start: f64) -> f64 {
    if start > MARGIN + WEAR {
        MARGIN
    } else if start >= MIN_CLEARANCE + 0.01 * WEAR {
        greater(MIN_CLEARANCE, start - WEAR)
    } else {
        start - lesser(WEAR, 0.5 * start)
    }
}

/// Returns how far `motion` may go in these surroundings.
///
/// A free motion goes all the way. A blocked motion is held at a clearance of [`HOLD_CLEARANCE`] or a little more (the
/// bisection's width), or at its start when that is nearer. A start in contact stays where it is. At its own limits,
/// such as the angle of a hitch, a robot is held as at an obstacle, but without a margin: within to the last bit.
pub fn advance(surroundings: &dyn Collision, motion: &impl Motion) -> Advance {
    let Some(leaving) = motion.leaves_limits() else { return advance_within(surroundings, motion) };
    let limit = leaving.within_until;
    let until = if limit > 0.0 { advance_within(surroundings, &Beginning { motion, until: limit }).until } else { 0.0 };
    Advance { until: until * limit, blocked: true }
}

/// As [`advance`], for a motion within its robot's own limits.
fn advance_within(surroundings: &dyn Collision, motion: &impl Motion) -> Advance {
    let Err(UnkeptMargin { start, until }) = keeps(surroundings, motion, MARGIN + 2.0 * WEAR, margin_from) else {
        return Advance { until: 1.0, blocked: false };
    };
    let clearance_at = |s: f64| surroundings.distance(&motion.footprint_at(s));
    let until = if start < HOLD_CLEARANCE { 0.0 } else { back_off(clearance_at, until) };
    Advance { until, blocked: true }
}

/// A parameter up to `free_until` at which the clearance is at least [`HOLD_CLEARANCE`], given that it is so at 0. The
/// search goes back in ever longer steps, then bisects.
fn back_off(clearance_at: impl Fn(f64) -> f64, free_until: f64) -> f64 {
    let far_enough = |s: f64| clearance_at(s) >= HOLD_CLEARANCE;
    if far_enough(free_until) {
        return free_until;
    }
    let (mut near, mut step) = (free_until, free_until / 4096.0);
    let mut far = loop {
        let s = free_until - step;
        if s <= 0.0 {
            break 0.0;
        }
        if far_enough(s) {
            break s;
        }
        near = s;
        step *= 2.0;
    };
    for _ in 0..64 {
        let middle = far + 0.5 * (near - far);
        if middle <= far || middle >= near || clearance_at(far) <= HOLD_ENOUGH {
            break;
        }
        if far_enough(middle) {
            far = middle;
        } else {
            near = middle;
        }
    }
    far
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use motion_lab_core::collision::{Scene, Surroundings};
    use motion_lab_core::configuration::HitchCfg;
    use motion_lab_core::geometry::{Point2, Pose2, Segment};
    use motion_lab_core::random::{Seed, Stream};
    use motion_lab_core::robots::{CarCmd, Drivable, HITCH, RUSTY, Robot, RustyCmd};

    /// A wall along the y axis.
    fn wall() -> Scene {
        Scene::of_walls(&[Segment::new(Point2::new(0.0, -60.0), Point2::new(0.0, 60.0))])
    }

    fn room() -> Scene {
        let corners =
            [(-4.0, -5.0), (6.0, -5.0), (6.0, 5.0), (-4.0, 5.0), (-4.0, -5.0)].map(|(x, y)| Point2::new(x, y));
        Scene::of_walls(&corners.windows(2).map(|w| Segment::new(w[0], w[1])).collect::<Vec<_>>())
    }

    #[test]
    fn rusty_stops_a_body_radius_from_the_wall() {
        let scene = wall();
        let mut q = Pose2::new(-1.0, 0.0, 0.0);
        let mut blocked = 0;
        for _ in 0..100 {
            let arc = RUSTY.drive(&q, &RustyCmd { v: 0.6, omega: 0.0 }, 0.05).unwrap();
            let a = advance(&scene, &arc);
            q = arc.at(a.until);
            blocked += usize::from(a.blocked);
        }
        let clearance = -q.x - RUSTY.body_radius;
        assert!((MIN_CLEARANCE..=1e-4).contains(&clearance), "{clearance}");
        // 0.89 m at 3 cm a tick: 29 free ticks, then held for good
        assert_eq!(blocked, 100 - 29);
    }

    #[test]
    fn from_every_held_pose_a_motion_away_is_free() {
        let scene = room();
        let mut draws = Stream::new(Seed(11), "held");
        let (mut held_rusty, mut held_car) = (0, 0);
        for i in 0..400 {
            let mut q = Pose2::new(draws.uniform(-3.0, 5.0), draws.uniform(-4.0, 4.0), draws.uniform(-PI, PI));
            let u = RustyCmd { v: draws.uniform(-0.6, 0.6), omega: draws.uniform(-0.2, 0.2) };
            for _ in 0..300 {
                let arc = RUSTY.drive(&q, &u, 0.05).unwrap();
                let a = advance(&scene, &arc);
                q = arc.at(a.until);
                if a.blocked {
                    held_rusty += 1;
                    let c = scene.distance(&RUSTY.footprint(&q));
                    assert!((MIN_CLEARANCE..=1e-4).contains(&c), "held at {c}");
                    let back = RUSTY.drive(&q, &RustyCmd { v: -u.v, omega: -u.omega }, 0.05).unwrap();
                    assert!(!advance(&scene, &back).blocked, "{q} {u:?}");
                    break;
                }
            }
            let car = if i % 2 == 0 { HITCH } else { HITCH.with_trailer() };
            let body = Pose2::new(draws.uniform(-1.0, 3.0), draws.uniform(-1.0, 1.0), draws.uniform(-PI, PI));
            let mut q = HitchCfg { body, trailer: car.hitch_len.map(|_| body.theta) };
            let u = CarCmd { v: draws.uniform(0.3, 1.5) * [1.0, -1.0][i / 2 % 2], phi: draws.uniform(-0.6, 0.6) };
            if scene.intersects(&car.footprint(&q)) {
                continue;
            }
            for _ in 0..300 {
                let arc = car.drive(&q, &u, 0.05).unwrap();
                let a = advance(&scene, &arc);
                q = arc.at(a.until);
                if a.blocked {
                    held_car += 1;
                    let c = scene.distance(&car.footprint(&q));
                    assert!((MIN_CLEARANCE..=1e-4).contains(&c), "held at {c}");
                    let back = car.drive(&q, &CarCmd { v: -u.v, phi: u.phi }, 0.05).unwrap();
                    assert!(!advance(&scene, &back).blocked, "{q} {u:?}");
                    break;
                }
            }
        }
        assert!(held_rusty > 100 && held_car > 200, "{held_rusty} {held_car}");
    }

    #[test]
    fn sliding_along_a_wall_never_sticks() {
        let scene = wall();
        for clearance in [4.5e-5, 2.00005e-5, 2e-5, 1.5e-5, 1.0000001e-5, 3e-6, 1e-8] {
            let mut q = Pose2::new(-RUSTY.body_radius - clearance, -50.0, FRAC_PI_2);
            let car = HITCH;
            let half = 0.5 * car.body.width;
            let mut p = HitchCfg { body: Pose2::new(half + clearance, -50.0, FRAC_PI_2), trailer: None };
            for _ in 0..3000 {
                let arc = RUSTY.drive(&q, &RustyCmd { v: 0.6, omega: 0.0 }, 0.05).unwrap();
                let a = advance(&scene, &arc);
                assert!(!a.blocked, "Rusty sticks at clearance {clearance} in {q}");
                q = arc.at(1.0);
                let arc = car.drive(&p, &CarCmd { v: 0.6, phi: 0.0 }, 0.05).unwrap();
                let a = advance(&scene, &arc);
                assert!(!a.blocked, "Hitch sticks at clearance {clearance} in {p}");
                p = arc.at(1.0);
            }
            assert!(q.y > 39.0 && p.body.y > 39.0);
            let c = scene.distance(&RUSTY.footprint(&q));
            assert!((c - clearance).abs() < 1e-10, "{c}");
        }
    }

    #[test]
    fn a_start_in_contact_stays_and_another_robot_is_a_wall_too() {
        let scene = wall();
        let motion = RUSTY.drive(&Pose2::new(-0.05, 0.0, PI), &RustyCmd { v: 0.6, omega: 0.0 }, 0.05).unwrap();
        assert_eq!(advance(&scene, &motion), Advance { until: 0.0, blocked: true });
        let start = Pose2::new(-3.0, 0.0, 0.0);
        let motion = RUSTY.drive(&start, &RustyCmd { v: 0.6, omega: 0.0 }, 0.05).unwrap();
        let other = RUSTY.footprint(&Pose2::new(-2.77, 0.0, 0.0)).parts()[0].placed().clone();
        let surroundings = Surroundings { scene: &scene, others: std::slice::from_ref(&other) };
        let a = advance(&surroundings, &motion);
        let gap = -2.77 - motion.at(a.until).x - 2.0 * RUSTY.body_radius;
        assert!(a.blocked && (MIN_CLEARANCE..=1e-4).contains(&gap), "{gap}");
    }

    #[test]
    fn the_margin_lies_below_the_start_and_never_falls_below_the_least() {
        let mut c = 1e-12;
        while c < 1e-3 {
            let m = margin_from(c);
            assert!(m < c && m > 0.0);
            assert!(c < MIN_CLEARANCE + 1e-12 || m >= MIN_CLEARANCE);
            c *= 1.003;
        }
    }
}
