//! Checks of motion bounds by sampling: whether any point of a part moves farther than the robot says.

use super::{ConfigurationError, Drivable, Motion, Robot};
use crate::configuration::{Configuration, Coordinates};
use crate::geometry::{Footprint, Point2, largest_coordinate};
use crate::num::{greater, ulp};
use crate::random::{Seed, Stream};

/// The number of stretches measured of each motion.
const STRETCHES: u32 = 4;

/// The halves of the stretches measured, in units of the motion's parameter: short ones see a peak, long ones are
/// measured most exactly.
const HALVES: [f64; 3] = [1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0];

/// The rounding of a placed vertex, ulps of the largest coordinate.
const ROUNDING: f64 = 32.0;

/// Positions are drawn from a square about the origin that reaches this far, metres.
const AWAY: f64 = 10.0;

/// One of the two motion bounds of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionBound {
    /// The bound on the speed, [`Rates::speed`](super::Rates::speed).
    Speed,
    /// The bound on the acceleration, [`Rates::acceleration`](super::Rates::acceleration).
    Acceleration,
}

impl std::fmt::Display for MotionBound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            MotionBound::Speed => "speed",
            MotionBound::Acceleration => "acceleration",
        })
    }
}

/// Why the motion bounds of a robot are wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatesError<C: Configuration> {
    /// A point of a part's core moves more than the bound allows.
    #[error("part {part} from {from} to {to}: its {bound} at {s} is {measured} m, its bound {claimed} m")]
    Exceeded {
        /// The bound that is exceeded.
        bound: MotionBound,
        /// The number of the part.
        part: usize,
        /// The configuration at which the motion starts.
        from: C,
        /// The configuration at which it ends.
        to: C,
        /// The parameter in the middle of the stretch measured.
        s: f64,
        /// The mean speed or acceleration over the stretch, metres, per unit of the parameter or its square.
        measured: f64,
        /// The bound, in the same unit.
        claimed: f64,
    },
    /// The edge has bounds for more or fewer parts than the footprint has.
    #[error("the edge from {from} to {to} has bounds for {rates} parts, the footprint has {parts}")]
    Parts {
        /// The configuration at which the edge starts.
        from: C,
        /// The configuration at which it ends.
        to: C,
        /// The number of bounds.
        rates: usize,
        /// The number of parts.
        parts: usize,
    },
    /// The footprint at `s` is not finite, or has other parts, other numbers of vertices or other radii than at the
    /// motion's start. No bound on the points of a core says anything about that.
    #[error("from {from} to {to}: the footprint at {s} is not finite, or its shapes are not those at the start")]
    Footprint {
        /// The configuration at which the motion starts.
        from: C,
        /// The configuration at which it ends.
        to: C,
        /// The parameter.
        s: f64,
    },
    /// The robot refuses a configuration that it drew, or a control.
    #[error("from {from}: {source}")]
    Refused {
        /// The configuration at which the motion would start.
        from: C,
        /// The robot's reason.
        source: ConfigurationError,
    },
}

/// How much of the bounds was seen to be used: the greatest measured speed and acceleration as parts of their bounds. 1
/// is a bound that is attained; far below 1 it is sound but makes proofs longer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RatesUse {
    /// The greatest part of a bound on the speed.
    pub speed: f64,
    /// The greatest part of a bound on the acceleration.
    pub acceleration: f64,
}

/// Looks for edges along which a part of a robot moves faster than [`Robot::edge_rates`] says. The checker trusts these
/// bounds: one that is too small proves motions free that are not.
///
/// `samples` edges are drawn from a fixed seed, with positions up to ten metres from the origin: between random
/// configurations, short, and along one or two coordinates alone, where many bounds are attained. Each is measured at
/// four random places. Between `s - h` and `s + h` a core's point may move by at most `2 h` times the bound on its
/// speed, and lie off the middle of that way by at most `h^2 / 2` times the bound on its acceleration. Only rounding is
/// allowed for, so a bound that holds is never refused. One that is a percent too small is found if the edges drawn
/// come within that percent of the greatest motion: sampling proves nothing.
///
/// # Errors
/// [`RatesError`]: the first bound exceeded, with the edge and the place; a bound that is missing; a footprint that is
/// not finite or changes its shapes.
///
/// ```
/// use motion_lab_core::robots::{HITCH, check_rates};
/// let used = check_rates(&HITCH.with_trailer(), 1000).unwrap();
/// assert!(used.speed > 0.99 && used.speed < 1.0 + 1e-5); // attained, but for rounding
/// ```
pub fn check_rates<R: Robot>(robot: &R, samples: u32) -> Result<RatesUse, RatesError<R::Configuration>> {
    let mut draws = Stream::new(Seed(0), "robots/check_rates");
    let mut used = RatesUse::default();
    for i in 0..samples {
        let (from, to) = (draw(robot, &mut draws), draw(robot, &mut draws));
        let to = varied(robot, i % 4, &from, to, &mut draws);
        let refused = |source| RatesError::Refused { from, source };
        let rates = robot.edge_rates(&from, &to).map_err(refused)?.len();
        let parts = robot.footprint(&from).parts().len();
        if rates != parts {
            return Err(RatesError::Parts { from, to, rates, parts });
        }
        measure(&robot.edge(&from, &to).map_err(refused)?, &mut draws, &mut used)?;
    }
    Ok(used)
}

/// As [`check_rates`], for the motions of `dt` seconds under these controls, from random configurations. Each motion
/// takes one of the controls by chance. Without a control there is nothing to check.
///
/// # Errors
/// [`RatesError`], as for [`check_rates`].
pub fn check_drive_rates<R: Drivable>(
    robot: &R,
    controls: &[R::Control],
    dt: f64,
    samples: u32,
) -> Result<RatesUse, RatesError<R::Configuration>> {
    let mut draws = Stream::new(Seed(0), "robots/check_drive_rates");
    let mut used = RatesUse::default();
    for _ in 0..samples {
        let from = draw(robot, &mut draws);
        let Some(control) = controls.get(draws.below(controls.len().max(1) as u64) as usize) else { break };
        let motion = robot.drive(&from, control, dt).map_err(|source| RatesError::Refused { from, source })?;
        measure(&motion, &mut draws, &mut used)?;
    }
    Ok(used)
}

fn draw<R: Robot>(robot: &R, draws: &mut Stream) -> R::Configuration {
    robot.sample(Point2::new(-AWAY, -AWAY), Point2::new(AWAY, AWAY), draws)
}

/// The end of an edge of the kind number `kind`: as drawn, a thousandth of the way, or with all coordinates but one or
/// two those of the start. As drawn where that is no configuration of the robot.
fn varied<R: Robot>(
    robot: &R,
    kind: u32,
    from: &R::Configuration,
    to: R::Configuration,
    draws: &mut Stream,
) -> R::Configuration {
    if kind == 0 {
        return to;
    }
    if kind == 1 {
        return from.interpolate(&to, 1.0 / 1024.0).unwrap_or(to);
    }
    let (mut mixed, there): (Coordinates, Coordinates) = (from.coordinates(), to.coordinates());
    for _ in 1..kind {
        let k = draws.below(there.len().max(1) as u64) as usize;
        if let (Some(here), Some(there)) = (mixed.get_mut(k), there.get(k)) {
            *here = *there;
        }
    }
    R::Configuration::from_coordinates(&mixed).filter(|q| robot.check(q).is_ok()).unwrap_or(to)
}

/// Whether two footprints have the same parts but for their places.
fn alike(a: &Footprint, b: &Footprint) -> bool {
    let shape = |f: &Footprint, k: usize| (f.parts()[k].placed().core().len(), f.parts()[k].placed().radius());
    a.parts().len() == b.parts().len() && (0..a.parts().len()).all(|k| shape(a, k) == shape(b, k))
}

/// Measures a motion at random places.
fn measure<M: Motion>(motion: &M, draws: &mut Stream, used: &mut RatesUse) -> Result<(), RatesError<M::Configuration>> {
    let (from, to) = (motion.at(0.0), motion.at(1.0));
    let start = motion.footprint_at(0.0);
    for _ in 0..STRETCHES {
        let h = HALVES[draws.below(HALVES.len() as u64) as usize];
        let s = draws.uniform(h, 1.0 - h);
        let places = [s - h, s, s + h].map(|s| motion.footprint_at(s));
        if let Some(k) = places.iter().position(|f| !(f.is_valid() && alike(f, &start))) {
            return Err(RatesError::Footprint { from, to, s: [s - h, s, s + h][k] });
        }
        for part in 0..start.parts().len() {
            let [before, middle, after] = [0, 1, 2].map(|k: usize| places[k].parts()[part].placed());
            let rounding = ROUNDING * ulp(greater(largest_coordinate([before, middle, after]), 4.0));
            let (mut moved, mut bow) = (0.0, 0.0);
            for v in 0..middle.core().len() {
                let (p, m, q) = (before.core()[v], middle.core()[v], after.core()[v]);
                moved = greater((q - p).norm(), moved);
                bow = greater((m - (p + (q - p) * 0.5)).norm(), bow);
            }
            let speed =
                MeasuredPart { bound: MotionBound::Speed, value: moved, claimed: motion.bound(part, s - h, s + h) };
            let acceleration = MeasuredPart {
                bound: MotionBound::Acceleration,
                value: bow,
                claimed: motion.sagitta(part, s - h, s + h),
            };
            for (MeasuredPart { bound, value, claimed }, unit) in [(speed, 2.0 * h), (acceleration, 0.5 * h * h)] {
                // a bound that is no number is exceeded
                let holds = value <= claimed + 2.0 * rounding;
                if !holds {
                    let (measured, claimed) = (value / unit, claimed / unit);
                    return Err(RatesError::Exceeded { bound, part, from, to, s, measured, claimed });
                }
                // where rounding is less than a millionth of the motion
                if value > 2e6 * rounding {
                    let most = match bound {
                        MotionBound::Speed => &mut used.speed,
                        MotionBound::Acceleration => &mut used.acceleration,
                    };
                    *most = greater(value / claimed, *most);
                }
            }
        }
    }
    Ok(())
}

/// What was measured of a part between two places, and what its bound allows, metres.
struct MeasuredPart {
    bound: MotionBound,
    value: f64,
    claimed: f64,
}
