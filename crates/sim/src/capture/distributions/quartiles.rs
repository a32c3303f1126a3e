//! `Quartiles`, five numbers that say where many lie.

/// The least, the quartiles and the greatest of some numbers.
///
/// Between two numbers a quartile is interpolated, as by most programs: of n ascending numbers, counted from 0, the
/// share p is number p (n - 1) (Hyndman and Fan, 1996, their seventh definition). So the median of an even count is the
/// mean of the two in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quartiles {
    /// How many numbers there are.
    pub count: usize,
    /// The least.
    pub least: f64,
    /// The lower quartile.
    pub lower: f64,
    /// The median.
    pub median: f64,
    /// The upper quartile.
    pub upper: f64,
    /// The greatest.
    pub greatest: f64,
}

impl Quartiles {
    /// Those of the numbers that are finite; `None` without any.
    pub fn of(numbers: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut numbers: Vec<f64> = numbers.into_iter().filter(|x| x.is_finite()).collect();
        numbers.sort_by(f64::total_cmp);
        let last = numbers.len().checked_sub(1)?;
        let at = |quarter: usize| {
            // in quarters of a place, so that no rounding decides which two numbers it lies between
            let (below, part) = (quarter * last / 4, (quarter * last % 4) as f64 / 4.0);
            let above = numbers[(below + 1).min(last)];
            // two shares of one number, so that it neither overflows nor leaves the two
            if part == 0.0 { numbers[below] } else { (1.0 - part) * numbers[below] + part * above }
        };
        let [least, lower, median, upper, greatest] = [0, 1, 2, 3, 4].map(at);
        Some(Quartiles { count: numbers.len(), least, lower, median, upper, greatest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn five(numbers: &[f64]) -> Option<[f64; 5]> {
        let Quartiles { least, lower, median, upper, greatest, .. } = Quartiles::of(numbers.iter().copied())?;
        Some([least, lower, median, upper, greatest])
    }

    #[test]
    fn quartiles_are_those_of_numpy() {
        // numpy.percentile(x, [0, 25, 50, 75, 100])
        assert_eq!(five(&[7.0]), Some([7.0; 5]));
        assert_eq!(five(&[4.0, 1.0]), Some([1.0, 1.75, 2.5, 3.25, 4.0]));
        assert_eq!(five(&[3.0, 1.0, 2.0]), Some([1.0, 1.5, 2.0, 2.5, 3.0]));
        assert_eq!(five(&[10.0, 30.0, 20.0, 60.0]), Some([10.0, 17.5, 25.0, 37.5, 60.0]));
        assert_eq!(five(&[5.0, 1.0, 4.0, 2.0, 3.0]), Some([1.0, 2.0, 3.0, 4.0, 5.0]));
        assert_eq!(five(&[0.0, 0.0, 1.0, 8.0, 8.0, 9.0, 12.0]), Some([0.0, 0.5, 8.0, 8.5, 12.0]));
    }

    #[test]
    fn what_is_not_finite_does_not_count_and_nothing_overflows() {
        assert_eq!(five(&[]), None);
        assert_eq!(five(&[f64::NAN, f64::INFINITY]), None);
        assert_eq!(five(&[f64::INFINITY, 2.0, f64::NAN, 4.0]), five(&[2.0, 4.0]));
        assert_eq!(Quartiles::of([f64::INFINITY, 2.0, 4.0]).unwrap().count, 2);
        assert_eq!(five(&[-f64::MAX, f64::MAX]).unwrap()[2], 0.0);
    }
}
