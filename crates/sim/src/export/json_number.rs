//! Numbers in JSON: shortest digits that read back to the same bits, infinity as a text; seeds of any size.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number for JSON. A finite one is written with the fewest digits that read back to the same bits. JSON has no
/// infinity, so infinity is the text `"inf"`, which Python's `float` and most others read.
///
/// ```
/// use motion_lab_sim::export::JsonNumber;
/// assert_eq!(serde_json::to_string(&[0.1, -0.0, f64::INFINITY].map(JsonNumber)).unwrap(), "[0.1,-0.0,\"inf\"]");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JsonNumber(pub f64);

impl Serialize for JsonNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            x if x.is_finite() => serializer.serialize_f64(x),
            x => serializer.collect_str(&x),
        }
    }
}

impl<'de> Deserialize<'de> for JsonNumber {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberText)
    }
}

/// Reads a number, or the text of one that is not finite.
struct NumberText;

impl Visitor<'_> for NumberText {
    type Value = JsonNumber;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number, \"inf\", \"-inf\" or \"NaN\"")
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<JsonNumber, E> {
        Ok(JsonNumber(x))
    }

    fn visit_i64<E: Error>(self, x: i64) -> Result<JsonNumber, E> {
        Ok(JsonNumber(x as f64))
    }

    fn visit_u64<E: Error>(self, x: u64) -> Result<JsonNumber, E> {
        Ok(JsonNumber(x as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<JsonNumber, E> {
        match text {
            "inf" => Ok(JsonNumber(f64::INFINITY)),
            "-inf" => Ok(JsonNumber(f64::NEG_INFINITY)),
            "NaN" => Ok(JsonNumber(f64::NAN)),
            _ => Err(E::invalid_value(serde::de::Unexpected::Str(text), &self)),
        }
    }
}

/// The largest whole number up to which every one is a double of its own: 2^53.
const MAX_EXACT: u64 = 1 << 53;

/// Writes a seed for JSON: a number up to 2^53, and above that a text of its digits, because most programs read the
/// numbers of JSON as doubles, which would make it another seed.
///
/// # Errors
/// Those of the serializer.
pub fn json_seed<S: Serializer>(seed: &u64, serializer: S) -> Result<S::Ok, S::Error> {
    if *seed <= MAX_EXACT { serializer.serialize_u64(*seed) } else { serializer.collect_str(seed) }
}

/// Reads a seed as [`json_seed`] writes it.
///
/// # Errors
/// Those of the deserializer, for what is neither a number nor the digits of one.
pub fn read_json_seed<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
    deserializer.deserialize_any(SeedText)
}

/// Reads a number, or the text of its digits.
struct SeedText;

impl Visitor<'_> for SeedText {
    type Value = u64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a seed: a whole number, or its digits as a text")
    }

    fn visit_u64<E: Error>(self, seed: u64) -> Result<u64, E> {
        Ok(seed)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<u64, E> {
        text.parse().map_err(|_| E::invalid_value(serde::de::Unexpected::Str(text), &self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2^53 + 1 is the first whole number that no double is: as one it would be 2^53.
    #[test]
    fn a_seed_that_no_double_is_is_a_text() {
        #[derive(Serialize, Deserialize)]
        struct Line(#[serde(serialize_with = "json_seed", deserialize_with = "read_json_seed")] u64);
        let written = |seed| serde_json::to_string(&Line(seed)).unwrap();
        for seed in [0, 1 << 53, (1 << 53) + 1, u64::MAX] {
            assert_eq!(serde_json::from_str::<Line>(&written(seed)).unwrap().0, seed);
        }
        for wrong in ["\"-1\"", "\"\"", "1.5", "\"18446744073709551616\""] {
            assert!(serde_json::from_str::<Line>(wrong).is_err(), "{wrong}");
        }
        assert_eq!((written(0), written(9_007_199_254_740_992)), ("0".into(), "9007199254740992".into()));
        assert_eq!(written(9_007_199_254_740_993), "\"9007199254740993\"");
        assert_eq!(written(u64::MAX), "\"18446744073709551615\"");
    }

    #[test]
    fn every_bit_survives_and_infinity_is_a_text() {
        for x in [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1.0 / 3.0] {
            let text = serde_json::to_string(&JsonNumber(x)).unwrap();
            assert_eq!(serde_json::from_str::<f64>(&text).unwrap().to_bits(), x.to_bits(), "{text}");
        }
        assert_eq!(serde_json::to_string(&JsonNumber(f64::INFINITY)).unwrap(), "\"inf\"");
        let read: Vec<JsonNumber> = serde_json::from_str(r#"[0.30000000000000004, -7, 7, "inf", "-inf"]"#).unwrap();
        assert_eq!(read, [0.1 + 0.2, -7.0, 7.0, f64::INFINITY, f64::NEG_INFINITY].map(JsonNumber));
        assert!(serde_json::from_str::<JsonNumber>("\"7\"").unwrap_err().to_string().contains("a number, \"inf\""));
    }
}
