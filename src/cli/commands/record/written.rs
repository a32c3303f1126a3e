//! The logs that a recording of many seeds has written.

use crate::cli::support::console::note;
use crate::cli::support::words::counted;

/// Largest number of stretches of seeds that are named.
const MAX_NAMED: usize = 20;

/// The logs that a recording of many seeds has written.
#[derive(Debug, Default)]
pub struct RecordedLogs {
    /// How many there are.
    logs: usize,
    /// The seeds whose logs replaced older files, ascending.
    replacing: Vec<u64>,
    /// The size of these older files, bytes.
    older: u64,
}

impl RecordedLogs {
    /// Counts the log of a seed. `older` is the size of the file that it replaced, bytes.
    pub fn add(&mut self, seed: u64, older: Option<u64>) {
        self.logs += 1;
        if let Some(bytes) = older {
            self.replacing.push(seed);
            self.older += bytes;
        }
    }

    /// Says how many logs were written, and which of them replaced older files.
    pub fn say(&self) {
        if self.logs > 0 {
            note(self.in_words());
        }
    }

    /// `wrote 10 logs, replacing 4 older files of 5120 bytes in all, those of the seeds 2, 5..8`.
    fn in_words(&self) -> String {
        let wrote = format!("wrote {}", counted(self.logs, "log"));
        match &self.replacing[..] {
            [] => wrote,
            [seed] => format!("{wrote}, replacing an older file of {} bytes, that of the seed {seed}", self.older),
            seeds => format!(
                "{wrote}, replacing {} older files of {} bytes in all, those of the seeds {}",
                seeds.len(),
                self.older,
                stretches(seeds)
            ),
        }
    }
}

/// Ascending seeds as `--seeds` would have them, `2, 5..8`; the first of them, where there are many stretches.
fn stretches(seeds: &[u64]) -> String {
    let parts: Vec<&[u64]> = seeds.chunk_by(|a, b| a.checked_add(1) == Some(*b)).collect();
    let named = parts.iter().take(MAX_NAMED).map(|part| match part {
        [first, .., last] => format!("{first}..{}", u128::from(*last) + 1),
        part => part.iter().map(u64::to_string).collect(),
    });
    let mut text = named.collect::<Vec<_>>().join(", ");
    if parts.len() > MAX_NAMED {
        text.push_str(" and more");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_replaced_is_named_by_its_seeds() {
        let words = |logs: &[(u64, Option<u64>)]| {
            let mut written = RecordedLogs::default();
            logs.iter().for_each(|(seed, older)| written.add(*seed, *older));
            written.in_words()
        };
        assert_eq!(words(&[(3, None)]), "wrote 1 log");
        assert_eq!(
            words(&[(3, None), (4, Some(7))]),
            "wrote 2 logs, replacing an older file of 7 bytes, that of the seed 4"
        );
        let some = [(1, None), (2, Some(5)), (3, None), (5, Some(6)), (6, Some(7)), (7, Some(8)), (8, None)];
        assert_eq!(
            words(&some),
            "wrote 7 logs, replacing 4 older files of 26 bytes in all, those of the seeds 2, 5..8"
        );
        let odd: Vec<(u64, Option<u64>)> = (0..50).map(|i| (2 * i, Some(1))).collect();
        assert!(words(&odd).ends_with(" 36, 38 and more"), "{}", words(&odd));
    }
}
