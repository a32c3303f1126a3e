//! Numbers joined by commas, as an argument.

use std::str::FromStr;

/// Numbers joined by commas.
#[derive(Clone, Debug)]
pub struct Numbers(pub Vec<f64>);

impl FromStr for Numbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number =
            |n: &str| n.trim().parse().map_err(|_| format!("{n:?} is no number; join numbers by commas: 0.785,1.571"));
        text.split(',').map(number).collect::<Result<_, _>>().map(Numbers)
    }
}
