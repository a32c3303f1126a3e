//! The seeds of an assignment as written: a list, or ranges in quotes.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::MAX_SEEDS;

/// Seeds as an assignment writes them: `[1, 2005]`, `"0..100"` for 0 to 99, or `"7, 100..110"`.
///
/// Never holds more than one beyond [`MAX_SEEDS`], however long a range is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seeds(pub Vec<u64>);

impl<'de> Deserialize<'de> for Seeds {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ListOrRanges)
    }
}

struct ListOrRanges;

impl<'de> Visitor<'de> for ListOrRanges {
    type Value = Seeds;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of seeds, as [1, 2005], or of ranges in quotes, as \"0..100\",")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Seeds, A::Error> {
        let mut seeds = Vec::new();
        while let Some(seed) = list.next_element()? {
            // what is too many already is not kept
            if seeds.len() <= MAX_SEEDS {
                seeds.push(seed);
            }
        }
        Ok(Seeds(seeds))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Seeds, E> {
        ranges(text).map(Seeds).map_err(|part| E::custom(BadRange(part)))
    }
}

/// A part of ranges that is none.
struct BadRange<'a>(&'a str);

impl fmt::Display for BadRange<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} is no seed and no range of seeds; write \"0..100\" for the seeds 0 to 99", self.0)
    }
}

/// The seeds of numbers and ranges without their ends, joined by commas; the part that is neither as an error.
fn ranges(text: &str) -> Result<Vec<u64>, &str> {
    let mut seeds = Vec::new();
    for part in text.split(',').map(str::trim) {
        let (first, end) = match part.split_once("..") {
            Some((first, end)) => (first.trim().parse::<u64>(), end.trim().parse::<u64>()),
            None => (part.parse(), part.parse::<u64>().map(|seed| seed.saturating_add(1))),
        };
        match (first, end) {
            (Ok(first), Ok(end)) if first < end => seeds.extend((first..end).take(MAX_SEEDS + 1 - seeds.len())),
            // the last seed of all has none after it
            (Ok(u64::MAX), Ok(u64::MAX)) if !part.contains("..") => seeds.push(u64::MAX),
            _ => return Err(part),
        }
        if seeds.len() > MAX_SEEDS {
            break;
        }
    }
    Ok(seeds)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<u64>, String> {
        ron::from_str::<Seeds>(text).map(|seeds| seeds.0).map_err(|error| error.to_string())
    }

    #[test]
    fn seeds_are_a_list_or_ranges() {
        assert_eq!(read("[1, 2005]"), Ok(vec![1, 2005]));
        assert_eq!(read("\"3..6\""), Ok(vec![3, 4, 5]));
        assert_eq!(read("\"7, 10..12 ,18446744073709551615\""), Ok(vec![7, 10, 11, u64::MAX]));
        assert_eq!(read("[18446744073709551615]"), Ok(vec![u64::MAX]));
        for wrong in ["\"\"", "\"3..\"", "\"6..3\"", "\"3..3\"", "\"1, x\"", "\"-1..3\"", "\"1..=3\"", "3", "[-1]"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
        let error = read("\"1, 6..3\"").unwrap_err();
        assert!(error.contains("\"6..3\" is no seed and no range of seeds"), "{error}");
        let error = read("3").unwrap_err();
        assert!(error.contains("a list of seeds"), "{error}");
    }

    /// Written out, this range would take the memory of the machine.
    #[test]
    fn a_range_without_bounds_holds_one_seed_too_many_and_no_more() {
        assert_eq!(read("\"0..18446744073709551615\"").unwrap().len(), MAX_SEEDS + 1);
        assert_eq!(read("\"0..9999, 20000..18446744073709551615\"").unwrap().len(), MAX_SEEDS + 1);
        assert_eq!(read("\"0..10000\"").unwrap().len(), MAX_SEEDS);
    }
}
