//! Lengths and numbers with units, as SVG and style sheets write them.

use motion_lab_core::num;

/// Pixels an inch, of style sheets.
const PIXELS_PER_INCH: f64 = 96.0;

/// The length of a pixel, metres, where it has one.
pub(crate) const METRES_PER_PIXEL: f64 = 0.0254 / PIXELS_PER_INCH;

/// The physical units, and how long they are, pixels.
const PHYSICAL: [(&str, f64); 6] = [
    ("mm", PIXELS_PER_INCH / 25.4),
    ("cm", PIXELS_PER_INCH / 2.54),
    ("in", PIXELS_PER_INCH),
    ("pt", PIXELS_PER_INCH / 72.0),
    ("pc", PIXELS_PER_INCH / 6.0),
    ("q", PIXELS_PER_INCH / 101.6),
];

/// What relative lengths are measured by, in the units of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LengthScale {
    /// Width and height of the nearest viewport.
    pub viewport: (f64, f64),
    pub font_size: f64,
    pub root_font_size: f64,
}

/// Which length is the whole of a percentage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    X,
    Y,
    Both,
}

/// A number and its unit, which is in lower case. `None` if the text does not begin with a finite number.
pub(crate) fn number_and_unit(text: &str) -> Option<(f64, String)> {
    let text = text.trim();
    let is_unit = |c: char| c.is_ascii_alphabetic() || c == '%';
    let unit_start = text.trim_end_matches(is_unit).len();
    // the exponent of a number without a unit ends with a digit
    let number: f64 = text[..unit_start].trim_end().parse().ok()?;
    number.is_finite().then(|| (number, text[unit_start..].to_ascii_lowercase()))
}

/// A length in physical units, metres; `None` for others.
pub(crate) fn physical(text: &str) -> Option<f64> {
    let (number, unit) = number_and_unit(text)?;
    let (_, pixels) = PHYSICAL.iter().find(|(name, _)| *name == unit)?;
    Some(number * pixels * METRES_PER_PIXEL)
}

impl LengthScale {
    /// A length in the units of the element; `None` if it is malformed or its unit is unknown.
    pub fn length(&self, text: &str, along: Along) -> Option<f64> {
        let (number, unit) = number_and_unit(text)?;
        let (width, height) = self.viewport;
        let whole = match along {
            Along::X => width,
            Along::Y => height,
            Along::Both => num::hypot(width, height) / std::f64::consts::SQRT_2,
        };
        match unit.as_str() {
            "" | "px" => Some(number),
            "%" => Some(number * whole / 100.0),
            "em" => Some(number * self.font_size),
            "ex" => Some(number * self.font_size / 2.0),
            "rem" => Some(number * self.root_font_size),
            _ => PHYSICAL.iter().find(|(name, _)| *name == unit).map(|(_, pixels)| number * pixels),
        }
    }
}

/// An angle in degrees; a number without a unit is in degrees.
pub(crate) fn degrees(text: &str) -> Option<f64> {
    let (number, unit) = number_and_unit(text)?;
    match unit.as_str() {
        "" | "deg" => Some(number),
        "grad" => Some(number * 0.9),
        "rad" => Some(number.to_degrees()),
        "turn" => Some(number * 360.0),
        _ => None,
    }
}

/// A number, or a percentage as a part of 1.
pub(crate) fn ratio(text: &str) -> Option<f64> {
    match number_and_unit(text)? {
        (number, unit) if unit.is_empty() => Some(number),
        (number, unit) if unit == "%" => Some(number / 100.0),
        _ => None,
    }
}
