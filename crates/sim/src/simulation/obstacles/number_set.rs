//! `NumberSet`, a set of small numbers that counts those in a range.

use std::ops::Range;

/// A set of small numbers, a bit for each.
#[derive(Clone, Debug, Default)]
pub(super) struct NumberSet(Vec<u64>);

impl NumberSet {
    /// Whether a number is in it.
    pub(super) fn holds(&self, number: usize) -> bool {
        self.0.get(number / 64).is_some_and(|word| word >> (number % 64) & 1 == 1)
    }

    /// Puts a number into it, or takes it out.
    pub(super) fn set(&mut self, number: usize, is_in: bool) {
        if number / 64 >= self.0.len() {
            self.0.resize(number / 64 + 1, 0);
        }
        let bit = 1 << (number % 64);
        let word = &mut self.0[number / 64];
        *word = if is_in { *word | bit } else { *word & !bit };
    }

    /// How many numbers of a range are in it.
    pub(super) fn count_in(&self, range: Range<usize>) -> usize {
        if range.is_empty() {
            return 0;
        }
        self.count_below(range.end) - self.count_below(range.start)
    }

    fn count_below(&self, end: usize) -> usize {
        let whole = self.0.iter().take(end / 64).map(|word| word.count_ones() as usize).sum::<usize>();
        let rest = self.0.get(end / 64).map_or(0, |word| word & ((1 << (end % 64)) - 1));
        whole + rest.count_ones() as usize
    }
}

impl FromIterator<bool> for NumberSet {
    /// The numbers, from 0, of the items that are true.
    fn from_iter<I: IntoIterator<Item = bool>>(items: I) -> Self {
        let mut set = NumberSet::default();
        items.into_iter().enumerate().filter(|(_, is_in)| *is_in).for_each(|(number, _)| set.set(number, true));
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_counts_what_is_in_a_range() {
        let multiples = |n: usize| (0..300).map(move |k| k % n == 0);
        for n in [1, 2, 3, 64, 67] {
            let mut set: NumberSet = multiples(n).collect();
            for range in [0..0, 0..1, 0..64, 63..65, 64..128, 1..300, 128..1000, 299..300, 300..300] {
                let expected = range.clone().filter(|k| *k < 300 && k % n == 0).count();
                assert_eq!(set.count_in(range.clone()), expected, "{range:?} of {n}");
            }
            assert!((0..400).all(|k| set.holds(k) == (k < 300 && k % n == 0)));
            set.set(0, false);
            set.set(512, true);
            set.set(513, false);
            assert_eq!((set.count_in(0..64), set.count_in(300..600)), (63 / n, 1));
        }
    }
}
