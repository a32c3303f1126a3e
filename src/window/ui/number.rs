//! Numbers as a reader types them: `0.7854`, `pi/4`, `−3π/4`, `2/3`, `45deg`; and why one that is typed is not entered
//! as it is.

use std::cell::RefCell;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

use bevy_egui::egui::{Id, Key, Response, Ui};

use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_core::num::wrap;
use motion_lab_core::picture::true_minus;

/// The number that a text stands for: a decimal number, pi, or a number times pi, over a decimal number if one follows;
/// or a decimal number of degrees, with `deg` or a degree sign behind it. `None` for any other text, and for what is
/// not finite.
pub fn number(text: &str) -> Option<WrittenCoordinate> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let text = text.replace('\u{2212}', "-").replace('\u{3c0}', "pi").replace('\u{b0}', "deg").to_lowercase();
    let number = match text.strip_suffix("deg") {
        Some(degrees) => WrittenCoordinate::degrees(degrees.parse().ok()?),
        None => WrittenCoordinate::number(quotient(&text)?),
    };
    Some(number).filter(|number| number.value().is_finite())
}

/// A number or a multiple of pi, over a number if one follows.
fn quotient(text: &str) -> Option<f64> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    let above: f64 = match above.strip_suffix("pi") {
        Some("" | "+") => PI,
        Some("-") => -PI,
        Some(times) => times.strip_suffix('*').unwrap_or(times).parse::<f64>().ok()? * PI,
        None => above.parse().ok()?,
    };
    let below: f64 = below.parse().ok()?;
    Some(above / below)
}

/// Says that a text is no number.
pub fn no_number(text: &str) -> String {
    format!("\u{201c}{}\u{201d} is no number. Write 0.7854, pi/4 or 45deg.", text.trim())
}

/// Says that degrees stand where a length belongs.
pub fn no_length(text: &str) -> String {
    format!("\u{201c}{}\u{201d} is an angle, and this is a length in metres.", text.trim())
}

/// Says what the writer of an angle of more than a turn may have meant by it. Whoever writes pi means radians.
pub fn turns(text: &str) -> Option<String> {
    let means_radians = text.contains('\u{3c0}') || text.to_lowercase().contains("pi");
    number(text)?.turns().filter(|_| !means_radians)
}

/// What a field takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TypedKind {
    /// A length, or another number that is no angle: clamped to the field's range.
    Plain,
    /// An angle on a circle, radians: wrapped.
    Heading,
    /// An angle that may go round, radians: clamped to the field's range.
    Turn,
}

impl TypedKind {
    /// What the field of a coordinate takes that is an angle on a circle, or not.
    pub const fn of(is_angle: bool) -> Self {
        if is_angle { TypedKind::Heading } else { TypedKind::Plain }
    }
}

/// What is typed into a number field: its parser, which egui calls once the text is entered.
///
/// An angle may be in degrees; one on a circle is wrapped. Any other number is clamped by the field to its range.
/// Escape leaves the number as it was.
pub struct NumberInput {
    range: RangeInclusive<f64>,
    takes: TypedKind,
    /// Whether a field was left by Escape in this frame or the one before, in which egui still enters its text.
    is_escaped: bool,
    why: RefCell<Option<String>>,
}

impl NumberInput {
    /// What is typed into a field of this range.
    pub fn new(ui: &Ui, range: RangeInclusive<f64>, takes: TypedKind) -> Self {
        let (id, now) = (Id::new("a number field was escaped"), ui.ctx().cumulative_pass_nr());
        if ui.input(|i| i.key_pressed(Key::Escape)) {
            ui.data_mut(|data| data.insert_temp(id, now));
        }
        let escaped: Option<u64> = ui.data(|data| data.get_temp(id));
        let is_escaped = escaped.is_some_and(|then| now - then <= 1);
        NumberInput { range, takes, is_escaped, why: RefCell::default() }
    }

    /// The number that is entered; `None` leaves it as it was.
    pub fn read(&self, text: &str) -> Option<f64> {
        if self.is_escaped || text.trim().is_empty() {
            return None;
        }
        let (found, why) = match (number(text), self.takes) {
            (None, _) => (None, Some(no_number(text))),
            (Some(angle), TypedKind::Plain) if angle.is_degrees() => (None, Some(no_length(text))),
            (Some(angle), TypedKind::Heading) => (Some(wrap(angle.value())), turns(text)),
            (Some(number), _) => (Some(number.value()), self.beyond(text, number.value())),
        };
        self.why.replace(why);
        found
    }

    /// That a number is out of the range, in words.
    fn beyond(&self, text: &str, number: f64) -> Option<String> {
        let (least, most) = (*self.range.start(), *self.range.end());
        let (than, end) = if number < least {
            ("less than the least", least)
        } else if number > most {
            ("more than the largest", most)
        } else {
            return None;
        };
        let end = true_minus(&((end * 1e4).round() / 1e4).to_string());
        Some(format!("\u{201c}{}\u{201d} is {than}, {end}.", text.trim()))
    }

    /// Why the field that was left has not the number that was typed; `None` while it is typed into.
    pub fn refused(self, response: &Response) -> Option<String> {
        self.why.into_inner().filter(|_| !response.has_focus())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::*;

    #[test]
    fn a_number_is_written_in_decimals_as_a_part_of_pi_or_as_a_quotient() {
        for (text, expected) in [
            ("0.7", 0.7),
            (" -1.25 ", -1.25),
            ("\u{2212}1.25", -1.25),
            ("1e3", 1000.0),
            ("12 000", 12_000.0),
            ("pi", PI),
            ("Pi", PI),
            ("-pi", -PI),
            ("\u{2212}\u{3c0}", -PI),
            ("+pi", PI),
            ("pi/4", FRAC_PI_4),
            ("\u{3c0}/2", FRAC_PI_2),
            ("- \u{3c0} / 2", -FRAC_PI_2),
            ("2pi", 2.0 * PI),
            ("3*pi/4", 3.0 * FRAC_PI_4),
            ("3pi/4", 3.0 * FRAC_PI_4),
            ("\u{2212}0.5\u{3c0}", -FRAC_PI_2),
            ("pi/-4", -FRAC_PI_4),
            ("1/2", 0.5),
            ("2/3", 2.0 / 3.0),
        ] {
            assert_eq!(number(text).map(WrittenCoordinate::value), Some(expected), "{text}");
        }
        for (text, expected) in [("90deg", FRAC_PI_2), ("\u{2212}45\u{b0}", -FRAC_PI_4), (" 180 Deg", PI)] {
            let angle = number(text).unwrap();
            assert!(angle.value() == expected && angle.is_degrees(), "{text}");
        }
    }

    #[test]
    fn any_other_text_is_no_number() {
        for text in [
            "", "abc", "pie", "p", "pi/", "/4", "pi/0", "*pi", "3**pi", "1/2/3", "1/2pi", "0,5", "inf", "NaN", "deg",
            "pideg",
        ] {
            assert!(number(text).is_none(), "{text}");
        }
        assert_eq!(no_number(" abc "), "\u{201c}abc\u{201d} is no number. Write 0.7854, pi/4 or 45deg.");
    }

    #[test]
    fn an_angle_is_wrapped_and_a_length_out_of_range_is_said() {
        let typed = |takes| NumberInput { range: -PI..=PI, takes, is_escaped: false, why: RefCell::default() };
        let said = |typed: &NumberInput| typed.why.borrow().clone();
        let angle = typed(TypedKind::Heading);
        // three quarters of a turn to the left are a quarter to the right
        assert_eq!((angle.read("3pi/2"), said(&angle)), (Some(-FRAC_PI_2), None));
        assert_eq!((angle.read("270deg"), said(&angle)), (Some(-FRAC_PI_2), None));
        assert_eq!((angle.read("9pi").is_some(), said(&angle)), (true, None), "whoever writes pi means it");
        angle.read("90");
        assert_eq!(said(&angle).as_deref(), Some("90 rad is 14.3 turns; angles are radians; write 90deg"));
        let turn = typed(TypedKind::Turn);
        assert_eq!((turn.read("180deg"), said(&turn)), (Some(PI), None));
        let length = typed(TypedKind::Plain);
        assert_eq!(length.read("1e9"), Some(1e9), "the field clamps it");
        assert_eq!(said(&length).as_deref(), Some("\u{201c}1e9\u{201d} is more than the largest, 3.1416."));
        assert_eq!(length.read("-4"), Some(-4.0));
        assert_eq!(said(&length).as_deref(), Some("\u{201c}-4\u{201d} is less than the least, \u{2212}3.1416."));
        assert_eq!((length.read("2"), said(&length)), (Some(2.0), None));
        assert_eq!(length.read("90deg"), None);
        let no_length = "\u{201c}90deg\u{201d} is an angle, and this is a length in metres.";
        assert_eq!(said(&length).as_deref(), Some(no_length));
        let escaped = NumberInput { is_escaped: true, ..typed(TypedKind::Plain) };
        assert_eq!((escaped.read("2"), escaped.read("abc"), said(&escaped)), (None, None, None));
    }
}
