//! Seeded random streams: one independent stream per stochastic subsystem.
//!
//! A stream is derived from the run's seed and the subsystem's stable name, so that a new robot, sensor or draw changes
//! no other subsystem's numbers. The generator is ChaCha with 8 rounds: the same numbers on 32- and 64-bit targets, and
//! seekable, so that the draws of tick `t` are a pure function of (seed, name, `t`) and no generator state has to be
//! saved.

use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_128_with_seed;

use crate::num;

/// The seed of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Seed(pub u64);

impl std::fmt::Display for Seed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// How many 64-bit draws [`Stream::at`] reserves for each index.
pub const DRAWS_PER_INDEX: u64 = 8;

/// One independent stream of random numbers.
///
/// ```
/// use motion_lab_core::random::{Seed, Stream};
/// let mut slip = Stream::new(Seed(2005), "rusty/slip");
/// let mut tour = Stream::new(Seed(2005), "reach/tour");
/// assert_ne!(slip.unit(), tour.unit());
/// // the draws of tick 7 do not depend on how many were made before
/// assert_eq!(slip.at(7).unit(), Stream::new(Seed(2005), "rusty/slip").at(7).unit());
/// ```
#[derive(Clone, Debug)]
pub struct Stream {
    generator: ChaCha8Rng,
}

impl Stream {
    /// The stream named `name` of the run seeded `seed`. Names are stable: changing one changes every run.
    pub fn new(seed: Seed, name: &str) -> Self {
        let mut key = [0_u8; 32];
        key[..16].copy_from_slice(&xxh3_128_with_seed(name.as_bytes(), seed.0).to_le_bytes());
        // A second, independent half: the same hash of the name behind a byte that no name begins with.
        let mut tagged = Vec::with_capacity(name.len() + 1);
        tagged.push(0);
        tagged.extend_from_slice(name.as_bytes());
        key[16..].copy_from_slice(&xxh3_128_with_seed(&tagged, seed.0).to_le_bytes());
        Stream { generator: ChaCha8Rng::from_seed(key) }
    }

    /// The same stream positioned at `index` (usually a tick). Up to [`DRAWS_PER_INDEX`] draws belong to each index;
    /// one that draws more runs into the next index's numbers.
    #[must_use]
    pub fn at(&self, index: u64) -> Self {
        let mut generator = self.generator.clone();
        generator.set_word_pos(u128::from(index) * u128::from(2 * DRAWS_PER_INDEX));
        Stream { generator }
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.generator.next_u64()
    }

    /// Uniform in `[0, 1)`, a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        // 53 bits fit an f64 exactly
        (self.bits() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Uniform in `[low, high)`, up to rounding.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Normal with mean 0 and standard deviation 1 (Box and Muller, 1958), from two draws.
    pub fn normal(&mut self) -> f64 {
        let radius = num::sqrt(-2.0 * num::ln(1.0 - self.unit()));
        radius * num::cos(TAU * self.unit())
    }

    /// Uniform in `0..n`, without bias (Lemire's multiplication method with rejection). 0 when `n` is 0.
    pub fn below(&mut self, n: u64) -> u64 {
        if n == 0 {
            return 0;
        }
        let threshold = n.wrapping_neg() % n;
        loop {
            let wide = u128::from(self.bits()) * u128::from(n);
            if wide as u64 >= threshold {
                return (wide >> 64) as u64;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_independent_of_one_another_and_of_earlier_draws() {
        let seed = Seed(2005);
        let mut a = Stream::new(seed, "a");
        let mut b = Stream::new(seed, "b");
        let first: Vec<u64> = (0..4).map(|_| a.bits()).collect();
        let other: Vec<u64> = (0..4).map(|_| b.bits()).collect();
        assert_ne!(first, other);
        assert_ne!(Stream::new(Seed(2006), "a").bits(), first[0]);
        assert_eq!(a.at(0).bits(), first[0], "seeking is absolute");
        assert_eq!(Stream::new(seed, "a").at(3).bits(), a.at(3).bits());
        let mut walked = Stream::new(seed, "a");
        for _ in 0..DRAWS_PER_INDEX {
            walked.bits();
        }
        assert_eq!(walked.bits(), a.at(1).bits(), "index 1 starts where index 0's draws end");
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut s = Stream::new(Seed(1), "moments");
        let n = 20_000;
        let normals: Vec<f64> = (0..n).map(|_| s.normal()).collect();
        let mean = normals.iter().sum::<f64>() / f64::from(n);
        let variance = normals.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / f64::from(n);
        // five standard errors of the mean (0.0071) and of the variance (0.01)
        assert!(mean.abs() < 0.036 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
        let mut counts = [0_u32; 7];
        for _ in 0..7000 {
            counts[s.below(7) as usize] += 1;
        }
        assert!(counts.iter().all(|&c| (840..1160).contains(&c)), "{counts:?}");
        assert!((0..1000).all(|_| (0.0..1.0).contains(&s.unit())));
    }
}
