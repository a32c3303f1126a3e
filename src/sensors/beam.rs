//! `BeamModel`, the noise of a real range finder.

use super::RangeSensor;
use crate::num::ln;
use crate::random::Stream;

/// The standard beam model (Thrun, Burgard and Fox, *Probabilistic Robotics*, section 6.3): each reading is, independently,
/// a short return from something unexpected, a miss, a maximum reading, or a hit with Gaussian noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamModel {
    /// Standard deviation of a hit's noise, metres.
    pub hit_sigma: f64,
    /// Probability of a short return.
    pub short: f64,
    /// Rate of the exponential distribution of short returns, per metre; cut off at the true range.
    pub short_rate: f64,
    /// Probability of a miss: the reading is infinity.
    pub miss: f64,
    /// Probability of a maximum reading: the reading is the greatest range exactly.
    pub max: f64,
}

/// Why a beam model's numbers are refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BeamError {
    /// A number that is not finite, or negative.
    #[error("{name} = {value}: it must be finite and not negative")]
    Number {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A rate of exactly 0 with short returns possible.
    #[error("short returns need a rate above 0 per metre")]
    Rate,
    /// The probabilities add up to more than 1.
    #[error("the probabilities short + miss + max add up to {0}, more than 1")]
    Sum(f64),
}

impl BeamModel {
    /// No noise at all: readings are exact.
    pub const EXACT: BeamModel = BeamModel { hit_sigma: 0.0, short: 0.0, short_rate: 1.0, miss: 0.0, max: 0.0 };

    /// The model with these numbers.
    ///
    /// # Errors
    /// [`BeamError`] for a number that is not finite or negative, or probabilities above 1 in all.
    pub fn try_new(self) -> Result<Self, BeamError> {
        let BeamModel { hit_sigma, short, short_rate, miss, max } = self;
        let named =
            [("hit_sigma", hit_sigma), ("short", short), ("short_rate", short_rate), ("miss", miss), ("max", max)];
        for (name, value) in named {
            if !(value.is_finite() && value >= 0.0) {
                return Err(BeamError::Number { name, value });
            }
        }
        if short > 0.0 && short_rate == 0.0 {
            return Err(BeamError::Rate);
        }
        let sum = short + miss + max;
        if sum > 1.0 { Err(BeamError::Sum(sum)) } else { Ok(self) }
    }

    /// The noisy readings for the exact `ranges` of `sensor` at tick `tick`, drawn from `stream`.
    ///
    /// Every ray draws from its own place in the stream, so a reading depends on the seed, the stream's name, the tick and the
    /// ray only. Hits are kept in [0, R]; a ray whose exact range is infinite has no hit and no short return within it: it
    /// reads infinity or R. A reading is never negative.
    pub fn apply(&self, sensor: &RangeSensor, ranges: &[f64], stream: &Stream, tick: u64) -> Vec<f64> {
        let rays = u64::from(sensor.n_rays);
        (0_u64..)
            .zip(ranges)
            .map(|(k, &exact)| self.reading(exact, sensor.max_range, stream.at(tick * rays + k)))
            .collect()
    }

    fn reading(&self, exact: f64, max_range: f64, mut draws: Stream) -> f64 {
        // every ray makes the same draws, whatever becomes of them
        let (choice, u, noise) = (draws.unit(), draws.unit(), draws.normal());
        if choice < self.miss {
            return f64::INFINITY;
        }
        if choice < self.miss + self.max {
            return max_range;
        }
        if exact.is_infinite() {
            return exact;
        }
        if choice < self.miss + self.max + self.short {
            // the inverse of the exponential distribution's function, cut off at the exact range
            let mass = 1.0 - crate::num::exp(-self.short_rate * exact);
            return -ln(1.0 - u * mass) / self.short_rate;
        }
        (exact + self.hit_sigma * noise).clamp(0.0, max_range)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Seed;

    const SENSOR: RangeSensor = RangeSensor { n_rays: 50_000, max_range: 4.0 };

    fn readings(model: BeamModel, exact: f64) -> Vec<f64> {
        let stream = Stream::new(Seed(2005), "rusty/beam");
        model.try_new().unwrap().apply(&SENSOR, &vec![exact; 50_000], &stream, 3)
    }

    #[test]
    fn an_exact_model_changes_nothing() {
        assert_eq!(readings(BeamModel::EXACT, 2.5), vec![2.5; 50_000]);
    }

    #[test]
    fn each_kind_of_reading_comes_as_often_as_its_probability() {
        let model = BeamModel { hit_sigma: 0.05, short: 0.1, short_rate: 1.0, miss: 0.03, max: 0.02 };
        let all = readings(model, 2.0);
        let share = |f: &dyn Fn(f64) -> bool| all.iter().filter(|r| f(**r)).count() as f64 / 50_000.0;
        // five standard deviations of a share p of 50,000 draws: 5 sqrt(p (1 - p) / 50,000)
        assert!((share(&|r| r.is_infinite()) - 0.03).abs() < 0.004);
        assert!((share(&|r| r == 4.0) - 0.02).abs() < 0.0032);
        // short returns below 1.5 m (ten sigma from the hits): their share times (1 - e^-1.5) / (1 - e^-2)
        let (e_1_5, e_2) = (0.223_130_160_148_429_8, 0.135_335_283_236_612_7); // e^-1.5, e^-2
        let below = 0.1 * (1.0 - e_1_5) / (1.0 - e_2);
        assert!((share(&|r| r < 1.5) - below).abs() < 0.007, "{} {below}", share(&|r| r < 1.5));
        let hits: Vec<f64> = all.iter().copied().filter(|r| (1.5..3.9).contains(r)).collect();
        assert!(hits.len() > 40_000);
    }

    #[test]
    fn hits_are_normal_about_the_exact_range() {
        let all = readings(BeamModel { hit_sigma: 0.1, ..BeamModel::EXACT }, 2.0);
        let mean = all.iter().sum::<f64>() / 50_000.0;
        let variance = all.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / 50_000.0;
        assert!(
            (mean - 2.0).abs() < 5.0 * 0.1 / 223.6 && (variance - 0.01).abs() < 5.0 * 0.01 * 0.0064,
            "{mean} {variance}"
        );
    }

    #[test]
    fn nothing_in_range_stays_infinite_and_every_tick_draws_anew() {
        let model = BeamModel { hit_sigma: 0.1, short: 0.5, ..BeamModel::EXACT };
        assert!(readings(model, f64::INFINITY).iter().all(|r| r.is_infinite()));
        let stream = Stream::new(Seed(1), "a");
        let at = |tick| model.apply(&RangeSensor { n_rays: 8, max_range: 4.0 }, &[1.0; 8], &stream, tick);
        assert_ne!(at(1), at(2));
        assert_eq!(at(1), at(1));
    }

    #[test]
    fn numbers_that_make_no_distribution_are_refused() {
        let refuse = |m: BeamModel| m.try_new().unwrap_err();
        assert_eq!(refuse(BeamModel { short: 0.6, miss: 0.6, ..BeamModel::EXACT }), BeamError::Sum(1.2));
        assert!(matches!(refuse(BeamModel { hit_sigma: f64::NAN, ..BeamModel::EXACT }), BeamError::Number { .. }));
        assert_eq!(refuse(BeamModel { short: 0.1, short_rate: 0.0, ..BeamModel::EXACT }), BeamError::Rate);
    }
}
