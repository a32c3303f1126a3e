//! `BeamModel`, the noise of a range sensor, as a world file gives it to a robot.

use serde::Deserialize;

/// The beam model of a range finder (Thrun, Burgard and Fox, *Probabilistic Robotics*, 2005, section 6.3). The
/// parameters have their usual names. A reading is, independently of all others,
///
/// - with probability `z_short` a short return, from something that is not in the world: exponential with rate
///   `lambda_short`, cut off at the exact range;
/// - with probability `z_miss` a miss: infinity, nothing came back;
/// - with probability `z_max` a maximum reading: the sensor's greatest range R exactly;
/// - with probability `z_rand` a random reading: uniform in [0, R);
/// - else, with probability [`z_hit`](Self::z_hit), a hit: normal about the exact range with standard deviation
///   `sigma_hit`, kept in [0, R].
///
/// Where nothing is in range, the reading is infinity instead of a hit or a short return. [`apply`](Self::apply) draws
/// the readings.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BeamModel {
    /// Standard deviation of a hit's noise, metres.
    pub sigma_hit: f64,
    /// Probability of a short return.
    pub z_short: f64,
    /// Rate of the exponential distribution of short returns, per metre.
    pub lambda_short: f64,
    /// Probability of a miss.
    pub z_miss: f64,
    /// Probability of a maximum reading.
    pub z_max: f64,
    /// Probability of a random reading.
    pub z_rand: f64,
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
    #[error("lambda_short = 0: short returns need a rate above 0 per metre")]
    Rate,
    /// The probabilities add up to more than 1.
    #[error("z_short + z_miss + z_max + z_rand = {0}: the probabilities must add up to at most 1, the rest is z_hit")]
    Sum(f64),
}

/// Parameters that are left out mean no noise.
impl Default for BeamModel {
    fn default() -> Self {
        BeamModel::EXACT
    }
}

impl BeamModel {
    /// No noise at all: readings are exact.
    pub const EXACT: BeamModel =
        BeamModel { sigma_hit: 0.0, z_short: 0.0, lambda_short: 1.0, z_miss: 0.0, z_max: 0.0, z_rand: 0.0 };

    /// The parameters by name, in the order of a world file.
    pub fn named(&self) -> [(&'static str, f64); 6] {
        let BeamModel { sigma_hit, z_short, lambda_short, z_miss, z_max, z_rand } = *self;
        [
            ("sigma_hit", sigma_hit),
            ("z_short", z_short),
            ("lambda_short", lambda_short),
            ("z_miss", z_miss),
            ("z_max", z_max),
            ("z_rand", z_rand),
        ]
    }

    /// The probability of a hit: what the others leave.
    pub fn z_hit(&self) -> f64 {
        1.0 - (self.z_short + self.z_miss + self.z_max + self.z_rand)
    }

    /// Returns the model if its numbers are valid; `-0.0` becomes `0.0`.
    ///
    /// # Errors
    /// [`BeamError`] for a number that is negative or not finite, a rate of 0 with short returns possible, or
    /// probabilities above 1 in all.
    pub fn try_new(self) -> Result<Self, BeamError> {
        for (name, value) in self.named() {
            if !(value.is_finite() && value >= 0.0) {
                return Err(BeamError::Number { name, value });
            }
        }
        if self.z_short > 0.0 && self.lambda_short == 0.0 {
            return Err(BeamError::Rate);
        }
        let sum = self.z_short + self.z_miss + self.z_max + self.z_rand;
        if sum > 1.0 {
            return Err(BeamError::Sum(sum));
        }
        let [sigma_hit, z_short, lambda_short, z_miss, z_max, z_rand] = self.named().map(|(_, value)| value + 0.0);
        Ok(BeamModel { sigma_hit, z_short, lambda_short, z_miss, z_max, z_rand })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_make_no_distribution_are_refused() {
        let refuse = |m: BeamModel| m.try_new().unwrap_err();
        assert_eq!(refuse(BeamModel { z_short: 0.75, z_miss: 0.5, ..BeamModel::EXACT }), BeamError::Sum(1.25));
        assert_eq!(refuse(BeamModel { z_max: 0.75, z_rand: 0.5, ..BeamModel::EXACT }), BeamError::Sum(1.25));
        let nan = refuse(BeamModel { sigma_hit: f64::NAN, ..BeamModel::EXACT });
        assert!(matches!(nan, BeamError::Number { name: "sigma_hit", .. }));
        let negative = refuse(BeamModel { z_rand: -0.1, ..BeamModel::EXACT });
        assert_eq!(negative, BeamError::Number { name: "z_rand", value: -0.1 });
        assert_eq!(refuse(BeamModel { z_short: 0.1, lambda_short: 0.0, ..BeamModel::EXACT }), BeamError::Rate);
        let all_short = BeamModel { z_short: 1.0, sigma_hit: -0.0, ..BeamModel::EXACT }.try_new().unwrap();
        assert_eq!((all_short.z_hit(), all_short.sigma_hit.to_bits()), (0.0, 0));
    }
}
