//! `Sinusoids`, Reach's tour: every joint swings at a rate incommensurate with the others'.

use std::f64::consts::TAU;

use motion_lab_core::configuration::Tn;
use motion_lab_core::num::{greater, lesser, sin, sqrt, wrap};
use motion_lab_core::random::{Seed, Stream};

/// Greatest joint speed of a touring arm, radians per second. The sinusoids of two or three joints stay below it; it
/// bounds the way back to them after manual driving.
pub const MAX_JOINT_SPEED: f64 = 2.0;

/// The squares of the joints' frequency ratios. Square roots of different primes are incommensurate.
const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];

/// One sinusoid per joint, with amplitude, frequency and phase from the seed.
///
/// Joint k is at `start + A (sin(w t + p) - sin p)`: the curve passes through the start at time 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sinusoids<const N: usize> {
    start: Tn<N>,
    amplitudes: [f64; N],
    frequencies: [f64; N],
    phases: [f64; N],
}

impl<const N: usize> Sinusoids<N> {
    /// The sinusoids that the seed chooses for the arm named `name`, from its stream `<name>/tour`.
    ///
    /// Amplitudes lie in [0.8, 1.4] rad, the first frequency in [0.5, 0.8] rad/s and the others in fixed irrational
    /// ratio to it, so that the tip's path never closes.
    pub fn new(seed: Seed, name: &str, start: Tn<N>) -> Self {
        let mut draws = Stream::new(seed, &format!("{name}/tour"));
        let base = draws.uniform(0.5, 0.8);
        let mut tour = Sinusoids { start, amplitudes: [0.0; N], frequencies: [0.0; N], phases: [0.0; N] };
        for k in 0..N {
            tour.amplitudes[k] = draws.uniform(0.8, 1.4);
            tour.frequencies[k] = base * sqrt(PRIMES[k % PRIMES.len()] / PRIMES[0]);
            tour.phases[k] = draws.uniform(0.0, TAU);
        }
        tour
    }

    /// The joint angles at `time` seconds, wrapped.
    pub fn at(&self, time: f64) -> Tn<N> {
        let mut q = self.start.0;
        for (k, angle) in q.iter_mut().enumerate() {
            let (w, p) = (self.frequencies[k], self.phases[k]);
            *angle = wrap(*angle + self.amplitudes[k] * (sin(w * time + p) - sin(p)));
        }
        Tn(q)
    }

    /// The next configuration of an arm at `q`, `dt` seconds later, at `time`: on the curve, or on the way back to it,
    /// with each joint turning the short way at no more than [`MAX_JOINT_SPEED`].
    pub fn follow(&self, q: &Tn<N>, time: f64, dt: f64) -> Tn<N> {
        let (goal, most) = (self.at(time), MAX_JOINT_SPEED * dt);
        let mut next = goal.0;
        for (angle, from) in next.iter_mut().zip(q.0) {
            let turn = wrap(*angle - from);
            if turn.abs() > most {
                *angle = wrap(from + greater(lesser(turn, most), -most));
            }
        }
        Tn(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::{Configuration, T2};

    #[test]
    fn the_curve_starts_at_the_start_and_stays_below_the_speed_limit() {
        let start = T2::new(0.7, -1.2);
        for seed in 0..200 {
            let tour = Sinusoids::new(Seed(seed), "reach", start);
            assert!(start.difference(&tour.at(0.0)).unwrap().iter().all(|d| d.abs() < 1e-15));
            let mut q = tour.at(0.0);
            for k in 1..=200 {
                let time = f64::from(k) * 0.05;
                let next = tour.follow(&q, time, 0.05);
                assert_eq!(next, tour.at(time), "on the curve the limit never binds");
                q = next;
            }
        }
    }

    #[test]
    fn the_frequencies_are_incommensurate_and_the_seed_s_own() {
        let a = Sinusoids::new(Seed(1), "reach", Tn([0.0; 3]));
        let b = Sinusoids::new(Seed(2), "reach", Tn([0.0; 3]));
        assert!(a.frequencies[0] != b.frequencies[0] && a.amplitudes != b.amplitudes && a.phases != b.phases);
        assert_ne!(a, Sinusoids::new(Seed(1), "other", Tn([0.0; 3])), "each arm draws its own");
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let ratio = a.frequencies[j] / a.frequencies[i];
            for q in 1..=40 {
                let p = (ratio * f64::from(q)).round();
                // a square root of a rational is never this near a fraction with a small denominator (Liouville)
                assert!((ratio * f64::from(q) - p).abs() > 0.1 / f64::from(q), "{ratio} is near {p}/{q}");
            }
        }
    }

    #[test]
    fn the_way_back_is_bounded_and_arrives() {
        let tour = Sinusoids::new(Seed(3), "reach", T2::new(0.0, 0.0));
        let mut q = T2::new(3.0, -3.0);
        for k in 1..=80 {
            let next = tour.follow(&q, f64::from(k) * 0.05, 0.05);
            assert!(q.difference(&next).unwrap().iter().all(|d| d.abs() <= MAX_JOINT_SPEED * 0.05 + 1e-15));
            q = next;
        }
        assert_eq!(q, tour.at(4.0));
    }
}
