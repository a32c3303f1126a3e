//! Seeded random streams: one independent stream per stochastic subsystem.
//!
//! A stream is derived from the run's seed and the subsystem's stable name, so that a new robot, sensor or draw changes
//! no other subsystem's numbers. The generator is ChaCha with 8 rounds: the same numbers on 32- and 64-bit targets, and
//! seekable, so that the draws of tick `t` are a pure function of (seed, name, `t`) and no generator state has to be
//! saved.

use std::convert::Infallible;
use std::f64::consts::TAU;

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng, TryRng};
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_128_with_seed;

use crate::num;

/// The seed of a run: every random number of the run follows from it. [`Stream`] draws them, one stream for each name.
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
/// It is a generator of the crate `rand` too, so that anyone draws from any distribution. How many words a distribution
/// of `rand` takes, and which value it makes of them, may change with that crate's version; what is drawn by the
/// methods here never does.
///
/// ```
/// use motion_lab_core::random::{Seed, Stream};
/// let mut slip = Stream::new(Seed(2005), "rusty/slip");
/// let mut tour = Stream::new(Seed(2005), "reach/tour");
/// assert_ne!(slip.unit(), tour.unit());
/// // the draws of tick 7 do not depend on how many were made before
/// assert_eq!(slip.at(7).unit(), Stream::new(Seed(2005), "rusty/slip").at(7).unit());
/// // as a generator of `rand`
/// use rand::RngExt;
/// assert!((1..=6).contains(&slip.random_range(1..=6)));
/// ```
#[derive(Debug)]
pub struct Stream {
    generator: ChaCha8Rng,
}

/// `rand`'s generator is no `Clone`, lest a key stream be used twice for a cipher; the lab uses it for nothing else.
impl Clone for Stream {
    fn clone(&self) -> Self {
        self.at_word(self.generator.get_word_pos())
    }
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
        self.at_word(u128::from(index) * u128::from(2 * DRAWS_PER_INDEX))
    }

    /// Puts this stream itself at `index`, where [`at`](Self::at) would give another one. To the next index it goes on
    /// through what it has generated already.
    pub fn seek(&mut self, index: u64) {
        let word = u128::from(index) * u128::from(2 * DRAWS_PER_INDEX);
        match word.checked_sub(self.generator.get_word_pos()) {
            Some(ahead) if ahead <= u128::from(2 * DRAWS_PER_INDEX) => {
                (0..ahead).for_each(|_| _ = self.generator.next_u32());
            }
            _ => self.generator.set_word_pos(word),
        }
    }

    fn at_word(&self, word: u128) -> Self {
        let mut generator = ChaCha8Rng::from_seed(self.generator.get_seed());
        generator.set_word_pos(word);
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

/// The generator of the crate `rand`; `Rng` and `RngExt` follow.
impl TryRng for Stream {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(self.generator.next_u32())
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.generator.next_u64())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.generator.fill_bytes(bytes);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;
    use rand::seq::SliceRandom;

    #[test]
    fn a_stream_that_seeks_has_the_numbers_of_one_put_there() {
        let stream = Stream::new(Seed(2005), "a");
        let mut sought = stream.clone();
        let indices = [0, 1, 2, 3, 4, 9, 10, 10, 3, 4, 5, u64::MAX, 0, 1];
        for (index, draws) in indices.into_iter().zip([2, 0, 8, 9, 1, 3, 20, 2, 2].into_iter().cycle()) {
            sought.seek(index);
            let mut put = stream.at(index);
            for draw in 0..draws {
                assert_eq!(sought.bits(), put.bits(), "draw {draw} of index {index}");
            }
        }
        // half a draw was taken
        sought.seek(6);
        let _ = sought.try_next_u32();
        sought.seek(7);
        assert_eq!(sought.bits(), stream.at(7).bits());
    }

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
    fn the_words_are_those_of_the_chacha_cipher_with_8_rounds() {
        // the key stream of eSTREAM's test vectors for ChaCha8, a key of 256 zero bits and a nonce of 0, block 0
        let key_stream = "3e00ef2f895f40d67f5bb8e81f09a5a12c840ec3ce9a7f3b181be188ef711a1e984ce172b9216f419f445367456d5619\
                          314a42a3da86b001387bfdb80e0cfe42";
        let mut bytes = [0; 64];
        Stream { generator: ChaCha8Rng::from_seed([0; 32]) }.fill_bytes(&mut bytes);
        assert_eq!(bytes.map(|b| format!("{b:02x}")).concat(), key_stream);
    }

    #[test]
    fn a_stream_is_a_generator_of_rand() {
        let stream = Stream::new(Seed(3), "rand");
        let (mut own, mut rand) = (stream.clone(), stream.clone());
        for _ in 0..10 {
            assert_eq!(own.bits(), rand.next_u64(), "the same words in the same order");
        }
        assert_eq!(own.clone().bits(), rand.next_u64(), "a clone goes on where the stream is");
        let mut low = stream.clone();
        assert_eq!(
            (low.next_u32(), low.next_u32()),
            ((stream.clone().bits()) as u32, (stream.clone().bits() >> 32) as u32)
        );
        let mut bytes = [0; 8];
        stream.clone().fill_bytes(&mut bytes);
        assert_eq!(u64::from_le_bytes(bytes), stream.clone().bits());
        let mut deck: Vec<u32> = (0..52).collect();
        deck.shuffle(&mut own);
        assert!(!deck.is_sorted());
        deck.sort_unstable();
        assert!(deck.iter().copied().eq(0..52), "every card is there once");
        assert!((0..1000).all(|_| own.random_range(1..=6) <= 6));
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
