//! A line of input: a configuration, or a motion between two.

use crate::json_words::in_words;
use motion_lab_core::geometry::MAX_COORDINATE;
use serde::Deserialize;

/// The subject of a question: a configuration, or a motion from it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuerySubject {
    /// The configuration's coordinates.
    pub q: Vec<f64>,
    /// The coordinates of the motion's end.
    #[serde(default)]
    pub to: Option<Vec<f64>>,
}

/// Reads `[x, y, theta]` or `{"q": [..], "to": [..]}`. The error says what is wrong and in which column.
pub fn parse_line(text: &str) -> Result<QuerySubject, String> {
    let read = if text.starts_with('[') {
        serde_json::from_str(text).map(|q| QuerySubject { q, to: None })
    } else {
        serde_json::from_str(text)
    };
    read.map_err(|error| {
        // serde_json counts lines too; here there is only the one
        let reason = in_words(&error.to_string());
        format!("column {}: {reason}; write [numbers] or {{\"q\": [numbers], \"to\": [numbers]}}", error.column())
    })
}

/// Checks that the numbers are finite, and that the first two, a place, are within the coordinates the lab computes
/// with.
pub fn check_place(numbers: &[f64]) -> Result<(), String> {
    finite(numbers)?;
    match numbers.iter().take(2).find(|x| x.abs() > MAX_COORDINATE) {
        Some(x) => Err(format!("coordinate {x} m: at most {MAX_COORDINATE} m in size")),
        None => Ok(()),
    }
}

/// Refuses numbers that are not finite.
pub fn finite(numbers: &[f64]) -> Result<(), String> {
    match numbers.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(format!("{x} is not a finite number")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_read_to_the_last_bit() {
        let q = vec![0.1 + 0.2, -5e-324];
        assert_eq!(parse_line("[0.30000000000000004, -5e-324]"), Ok(QuerySubject { q: q.clone(), to: None }));
        let motion = r#"{"q": [0.30000000000000004, -5e-324], "to": [1, 2]}"#;
        assert_eq!(parse_line(motion), Ok(QuerySubject { q, to: Some(vec![1.0, 2.0]) }));
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, reason) in [
            ("[1, x]", "column 5: no value of JSON; "),
            ("[1, null]", "column 8: null does not belong here, a number does; "),
            ("[1e999]", "number out of range"),
            (r#"{"q": [1], "two": [1]}"#, "there is no field `two`; "),
            (r#"{"to": [1]}"#, "the field `q` is missing; "),
            (r#"{"q": [1], "q": [1]}"#, "the field `q` is there twice; "),
            ("[1] [2]", "column 5: the line goes on after its last bracket; "),
            ("[1, ", "column 4: the line ends too early; "),
            ("nonsense", "column 2: no value of JSON; "),
        ] {
            let error = parse_line(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
