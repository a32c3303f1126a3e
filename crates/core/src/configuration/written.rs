//! `WrittenCoordinate`, a coordinate of a configuration as a person writes it.

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::str::FromStr;

use serde::de::{Deserializer, Error, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// A coordinate of a configuration as a person writes it: a number, metres or radians; or an angle in degrees, with
/// `deg` behind it. In files the latter stands in quotes: `"90deg"`.
///
/// ```
/// use motion_lab_core::configuration::WrittenCoordinate;
/// let quarter: WrittenCoordinate = "90deg".parse()?;
/// assert_eq!(quarter.value(), std::f64::consts::FRAC_PI_2);
/// let number: WrittenCoordinate = "90".parse()?;
/// assert_eq!(number.turns().unwrap(), "90 rad is 14.3 turns; angles are radians; write 90deg");
/// # Ok::<(), motion_lab_core::configuration::WrittenCoordinateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrittenCoordinate {
    value: f64,
    is_degrees: bool,
}

/// Why a coordinate that somebody has written is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WrittenCoordinateError {
    /// A text that is neither a number nor one with `deg` behind it.
    #[error("{0:?} is no number")]
    NotANumber(String),
    /// Degrees where a length stands.
    #[error("coordinate {index} is a length in metres, and {degrees}deg is an angle")]
    Length {
        /// The coordinate's place, from 0.
        index: usize,
        /// The number of degrees.
        degrees: f64,
    },
}

impl WrittenCoordinate {
    /// A number: metres, or radians.
    pub const fn number(value: f64) -> Self {
        WrittenCoordinate { value, is_degrees: false }
    }

    /// An angle of this many degrees.
    pub const fn degrees(degrees: f64) -> Self {
        WrittenCoordinate { value: degrees / 180.0 * PI, is_degrees: true }
    }

    /// Its value: metres, or radians.
    pub const fn value(self) -> f64 {
        self.value
    }

    /// Whether it was written in degrees.
    pub const fn is_degrees(self) -> bool {
        self.is_degrees
    }

    /// Of an angle that was written in radians and is more than a turn, what its writer may have meant; `None` of
    /// another angle.
    pub fn turns(self) -> Option<String> {
        self.turns_between("")
    }

    /// As [`turns`](Self::turns), of an angle of a RON file, which has degrees in quotes: `write "90deg"`.
    pub fn turns_in_ron(self) -> Option<String> {
        self.turns_between("\"")
    }

    fn turns_between(self, quote: &str) -> Option<String> {
        let WrittenCoordinate { value, is_degrees } = self;
        if is_degrees || !value.is_finite() || value.abs() <= TAU {
            return None;
        }
        let turns = value.abs() / TAU;
        Some(format!("{value} rad is {turns:.1} turns; angles are radians; write {quote}{value}deg{quote}"))
    }

    /// The values of a configuration whose first coordinates, this many, are lengths.
    ///
    /// # Errors
    /// [`WrittenCoordinateError::Length`] for a length in degrees.
    pub fn values(written: &[Self], lengths: usize) -> Result<Vec<f64>, WrittenCoordinateError> {
        match written.iter().take(lengths).position(|coordinate| coordinate.is_degrees) {
            Some(index) => {
                let degrees = written[index].value / PI * 180.0;
                Err(WrittenCoordinateError::Length { index, degrees })
            }
            None => Ok(written.iter().map(|coordinate| coordinate.value).collect()),
        }
    }

    /// What the writer of a configuration in a RON file may have meant by its angles, which follow on this many
    /// lengths: one sentence for each that is [more than a turn](Self::turns_in_ron).
    pub fn all_turns_in_ron(written: &[Self], lengths: usize) -> impl Iterator<Item = String> + '_ {
        written.iter().skip(lengths).filter_map(|coordinate| coordinate.turns_in_ron())
    }
}

impl FromStr for WrittenCoordinate {
    type Err = WrittenCoordinateError;

    fn from_str(text: &str) -> Result<Self, WrittenCoordinateError> {
        let text = text.trim();
        let wrong = || WrittenCoordinateError::NotANumber(text.to_owned());
        match text.strip_suffix("deg") {
            Some(degrees) => degrees.trim_end().parse().map(WrittenCoordinate::degrees).map_err(|_| wrong()),
            None => text.parse().map(WrittenCoordinate::number).map_err(|_| wrong()),
        }
    }
}

/// As its value.
impl Serialize for WrittenCoordinate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.value)
    }
}

impl<'de> Deserialize<'de> for WrittenCoordinate {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(WrittenCoordinateVisitor)
    }
}

struct WrittenCoordinateVisitor;

impl Visitor<'_> for WrittenCoordinateVisitor {
    type Value = WrittenCoordinate;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or degrees in quotes, as \"90deg\"")
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<WrittenCoordinate, E> {
        Ok(WrittenCoordinate::number(x))
    }

    fn visit_i64<E: Error>(self, n: i64) -> Result<WrittenCoordinate, E> {
        Ok(WrittenCoordinate::number(n as f64))
    }

    fn visit_u64<E: Error>(self, n: u64) -> Result<WrittenCoordinate, E> {
        Ok(WrittenCoordinate::number(n as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<WrittenCoordinate, E> {
        // a number in quotes is a text that was meant for something else
        let read = text.parse().ok().filter(|read: &WrittenCoordinate| read.is_degrees);
        read.ok_or_else(|| E::custom(format!("{text:?} is no angle; write a number, or degrees, as \"90deg\"")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<WrittenCoordinate, WrittenCoordinateError> {
        text.parse()
    }

    #[test]
    fn degrees_are_parts_of_pi_and_numbers_are_themselves() {
        // the nearest doubles to pi/2, -pi, pi/180 and 2.5 pi, by a calculator of many digits
        for (text, value) in [
            ("90deg", std::f64::consts::FRAC_PI_2),
            ("-180deg", -PI),
            ("1 deg", 0.017_453_292_519_943_295),
            ("450deg", 7.853_981_633_974_483),
        ] {
            assert_eq!(read(text).map(|c| (c.value(), c.is_degrees())), Ok((value, true)), "{text}");
        }
        assert_eq!(read(" -1.5e1 ").map(|c| (c.value(), c.is_degrees())), Ok((-15.0, false)));
        for wrong in ["deg", "", "90 rad", "90degdeg", "x", "9,5"] {
            assert_eq!(read(wrong), Err(WrittenCoordinateError::NotANumber(wrong.into())), "{wrong}");
        }
    }

    #[test]
    fn more_than_a_turn_in_radians_is_noted_and_nothing_else_is() {
        let turns = |text: &str| read(text).unwrap().turns();
        // 90 / (2 pi) is 14.32
        assert_eq!(turns("90").unwrap(), "90 rad is 14.3 turns; angles are radians; write 90deg");
        assert_eq!(turns("-180").unwrap(), "-180 rad is 28.6 turns; angles are radians; write -180deg");
        let in_ron = read("-180").unwrap().turns_in_ron().unwrap();
        assert_eq!(in_ron, "-180 rad is 28.6 turns; angles are radians; write \"-180deg\"");
        for fine in ["6.283185307179586", "-6.283185307179586", "450deg", "0", "inf"] {
            assert_eq!(turns(fine), None, "{fine}");
        }
    }

    #[test]
    fn a_length_in_degrees_is_refused() {
        let written = ["1", "2", "90deg"].map(|text| read(text).unwrap());
        assert_eq!(WrittenCoordinate::values(&written, 2).unwrap(), [1.0, 2.0, 0.5 * PI]);
        let error = WrittenCoordinate::values(&written, 3).unwrap_err();
        assert_eq!(error.to_string(), "coordinate 2 is a length in metres, and 90deg is an angle");
    }

    #[test]
    fn files_hold_numbers_or_degrees_in_quotes() {
        let read = ron::from_str::<Vec<WrittenCoordinate>>("[1, -2, 0.5, \"180deg\"]").unwrap();
        assert_eq!(WrittenCoordinate::values(&read, 3).unwrap(), [1.0, -2.0, 0.5, PI]);
        for wrong in ["[\"90\"]", "[\"x\"]", "[true]"] {
            assert!(ron::from_str::<Vec<WrittenCoordinate>>(wrong).is_err(), "{wrong}");
        }
    }
}
