//! Numbers in JSON: shortest digits that read back to the same bits, infinity as a text.

use serde::{Serialize, Serializer};

/// A number for JSON. A finite one is written with the fewest digits that read back to the same bits. JSON has no
/// infinity, so infinity is the text `"inf"`, which Python's `float` and most others read.
///
/// ```
/// use motion_lab::export::JsonNumber;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_survives_and_infinity_is_a_text() {
        for x in [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1.0 / 3.0] {
            let text = serde_json::to_string(&JsonNumber(x)).unwrap();
            assert_eq!(serde_json::from_str::<f64>(&text).unwrap().to_bits(), x.to_bits(), "{text}");
        }
        assert_eq!(serde_json::to_string(&JsonNumber(f64::INFINITY)).unwrap(), "\"inf\"");
    }
}
