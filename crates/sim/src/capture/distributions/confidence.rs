//! `ConfidenceInterval`, how far a share or a median of some runs may lie from that of all runs like them.

/// The quantile of the standard normal distribution with 2.5 % above it.
const Z: f64 = 1.959_963_984_540_054;

/// The share of samples that a bound of an interval may miss on its side.
const ON_A_SIDE: f64 = 0.025;

/// Weights below this part of the greatest are no part of a sum.
const NEGLIGIBLE: f64 = 1e-30;

/// An interval that holds the true value in 95 of 100 samples, or a few more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfidenceInterval {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

impl ConfidenceInterval {
    /// The interval of 95 % of a share of which `count` of `of` were found; `None` for a share of none.
    ///
    /// It is Wilson's score interval (E. B. Wilson, 1927, Journal of the American Statistical Association 22), without
    /// a correction for continuity: of a share p of n the ends of
    /// `(p + z²/2n ± z √(p (1 - p)/n + z²/4n²)) / (1 + z²/n)` with z = 1.96. It is not empty for a share of 0 or of 1,
    /// which is one of its ends then.
    pub fn of_share(count: u64, of: u64) -> Option<Self> {
        if of == 0 || count > of {
            return None;
        }
        let (n, p) = (of as f64, count as f64 / of as f64);
        let middle = p + Z * Z / (2.0 * n);
        let reach = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let scale = 1.0 + Z * Z / n;
        // the ends of a share of 0 and of 1 are these, which rounding would miss
        let lower = if count == 0 { 0.0 } else { (middle - reach) / scale };
        let upper = if count == of { 1.0 } else { (middle + reach) / scale };
        Some(ConfidenceInterval { lower, upper })
    }

    /// The interval of at least 95 % of the median of which these numbers are a sample; those that are not finite do
    /// not count. `None` for fewer than six, of which not even the least and the greatest are such an interval.
    ///
    /// Its ends are numbers of the sample, as far in from both as the binomial distribution of one half lets them
    /// (W. R. Thompson, 1936, Annals of Mathematical Statistics 7): of n ascending numbers, counted from 1, number r
    /// and number n + 1 - r, with r the greatest for which at most 2.5 % of all outcomes of n tosses have fewer than r
    /// heads. So it asks nothing of how the numbers are distributed.
    pub fn of_median(numbers: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut numbers: Vec<f64> = numbers.into_iter().filter(|x| x.is_finite()).collect();
        numbers.sort_by(f64::total_cmp);
        let rank = median_rank(numbers.len());
        let lower = *numbers.get(rank.checked_sub(1)?)?;
        Some(ConfidenceInterval { lower, upper: numbers[numbers.len() - rank] })
    }
}

/// The rank from both ends, from 1, of the numbers that bound a median; 0 where there is none.
fn median_rank(n: usize) -> usize {
    // binomial coefficients as parts of the one in the middle, downward: none of them overflows
    let mut weights = vec![1.0];
    let mut weight = 1.0;
    for k in (1..=n / 2).rev() {
        weight *= k as f64 / (n - k + 1) as f64;
        if weight < NEGLIGIBLE {
            break;
        }
        weights.push(weight);
    }
    let half: f64 = weights.iter().rev().sum();
    // of an even number the one in the middle stands on neither side
    let whole = 2.0 * half - if n.is_multiple_of(2) { 1.0 } else { 0.0 };
    let mut tail = 0.0;
    for (below, weight) in weights.iter().enumerate().rev() {
        tail += weight;
        if tail > ON_A_SIDE * whole {
            return n / 2 - below;
        }
    }
    n / 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_the_intervals_that_newcombe_published() {
        // R. G. Newcombe, 1998, Statistics in Medicine 17, table I, method 3
        for (count, of, lower, upper) in
            [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
        {
            let found = ConfidenceInterval::of_share(count, of).unwrap();
            assert!(
                (found.lower - lower).abs() < 5e-5 && (found.upper - upper).abs() < 5e-5,
                "{count}/{of}: {found:?}"
            );
            // what was not found has the same, from the other side
            let others = ConfidenceInterval::of_share(of - count, of).unwrap();
            assert!((others.upper - (1.0 - found.lower)).abs() < 1e-15, "{others:?}");
        }
        assert_eq!(ConfidenceInterval::of_share(0, 7).unwrap().lower, 0.0);
        assert_eq!(ConfidenceInterval::of_share(7, 7).unwrap().upper, 1.0);
        assert_eq!(ConfidenceInterval::of_share(0, 0), None);
        assert_eq!(ConfidenceInterval::of_share(2, 1), None);
    }

    #[test]
    fn medians_have_the_ranks_of_published_tables() {
        // G. J. Hahn and W. Q. Meeker, 1991, Statistical Intervals, table A.15a's ranks; by hand for six: 2/64 < 0.05,
        // and 14/64 is more; for five 2/32 is more
        for (n, rank) in [(6, 1), (8, 1), (9, 2), (10, 2), (15, 4), (20, 6), (25, 8), (30, 10), (50, 18), (100, 40)] {
            assert_eq!(median_rank(n), rank, "{n}");
        }
        for n in 0..6 {
            assert_eq!(median_rank(n), 0, "{n}");
        }
    }

    /// Whole numbers count the tosses where they have room for them.
    #[test]
    fn ranks_are_those_of_counted_tosses_and_of_the_normal_distribution() {
        for n in 1..=120_usize {
            let (mut choices, mut fewer, mut rank) = (1_u128, 0_u128, 0);
            for k in 0..n {
                fewer += choices;
                // 2 * fewer / 2^n <= 0.05
                if n < 6 || fewer * 40 > 1 << n {
                    break;
                }
                rank = k + 1;
                choices = choices * (n - k) as u128 / (k + 1) as u128;
            }
            assert_eq!(median_rank(n), rank, "{n}");
        }
        for n in [10_000_usize, 1_000_001, 10_000_000] {
            let near = 0.5 * (n as f64 - Z * (n as f64).sqrt());
            assert!((median_rank(n) as f64 - near).abs() < 2.0, "{n}: {} {near}", median_rank(n));
        }
    }

    #[test]
    fn the_ends_are_numbers_of_the_sample() {
        let numbers = || (1..=10).rev().map(f64::from);
        assert_eq!(ConfidenceInterval::of_median(numbers()), Some(ConfidenceInterval { lower: 2.0, upper: 9.0 }));
        let with = numbers().chain([f64::NAN, f64::INFINITY]);
        assert_eq!(ConfidenceInterval::of_median(with), ConfidenceInterval::of_median(numbers()));
        assert_eq!(ConfidenceInterval::of_median((1..=5).map(f64::from)), None);
        assert_eq!(ConfidenceInterval::of_median([]), None);
    }
}
