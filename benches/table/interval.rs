//! A ratio of times with the interval in which it lies, by the bootstrap.
//!
//! Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics 7 (1979), 1 to 26; the interval is
//! that of the percentiles of the resampled medians.

use motion_lab::random::{Seed, Stream};

/// How often the rounds are drawn anew.
const RESAMPLES: usize = 2_000;
/// The share of resampled medians within the interval.
const SHARE: f64 = 0.95;

/// A median, and the bounds within which 95 % of the medians of resampled rounds lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub low: f64,
    pub median: f64,
    pub high: f64,
}

pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[((sorted.len() - 1) as f64 * share).round() as usize]
}

impl Interval {
    /// Of values that were measured round by round. The name seeds the draws, so the same values give the same
    /// interval.
    pub fn of(name: &str, values: &[f64]) -> Self {
        let mut draws = Stream::new(Seed(24), name);
        let count = values.len() as u64;
        let mut resampled = vec![0.0; values.len()];
        let medians: Vec<f64> = (0..RESAMPLES)
            .map(|_| {
                resampled.fill_with(|| values[(draws.bits() % count) as usize]);
                quantile(&resampled, 0.5)
            })
            .collect();
        let tail = 0.5 * (1.0 - SHARE);
        Interval { low: quantile(&medians, tail), median: quantile(values, 0.5), high: quantile(&medians, 1.0 - tail) }
    }
}
