//! A range of seeds.

use std::str::FromStr;

/// The seeds from `first` to `end`, without `end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeedRange {
    /// The first seed.
    pub first: u64,
    /// The seed after the last.
    pub end: u64,
}

impl FromStr for SeedRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is no range of seeds; write 0..10000 for the seeds 0 to 9999");
        let (first, end) = text.split_once("..").ok_or_else(wrong)?;
        let range = SeedRange { first: first.parse().map_err(|_| wrong())?, end: end.parse().map_err(|_| wrong())? };
        if range.first < range.end { Ok(range) } else { Err(format!("{text:?} is empty: write the lesser seed first")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_written_as_in_rust() {
        assert_eq!("3..7".parse(), Ok(SeedRange { first: 3, end: 7 }));
        for wrong in ["3", "3..", "7..3", "3..3", "-1..3", "a..b", "3..=7"] {
            assert!(wrong.parse::<SeedRange>().is_err(), "{wrong}");
        }
    }
}
