//! The marks of a chart's axes.

use std::f64::consts::PI;

/// A mark of an axis, with its figure.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::capture) struct AxisMark {
    pub(in crate::capture) at: f64,
    pub(in crate::capture) text: String,
}

/// Round marks between both ends, about `most` of them and at least two where there is room for two: multiples of 1, 2
/// or 5 times a power of ten.
pub(in crate::capture) fn marks([low, high]: [f64; 2], most: usize) -> Vec<AxisMark> {
    const DECADES: [(f64, usize); 16] = [
        (1e-6, 6),
        (1e-5, 5),
        (1e-4, 4),
        (1e-3, 3),
        (1e-2, 2),
        (1e-1, 1),
        (1.0, 0),
        (1e1, 0),
        (1e2, 0),
        (1e3, 0),
        (1e4, 0),
        (1e5, 0),
        (1e6, 0),
        (1e7, 0),
        (1e8, 0),
        (1e9, 0),
    ];
    let steps = DECADES.into_iter().flat_map(|(decade, places)| [1.0, 2.0, 5.0].map(|digit| (digit * decade, places)));
    let fits = |step: f64| (high - low) / step <= std::cmp::max(most, 2) as f64;
    let Some((step, places)) = steps.into_iter().find(|(step, _)| fits(*step)) else { return Vec::new() };
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let mark = |k: i64| {
        let at = k as f64 * step;
        AxisMark { at, text: format!("{at:.places$}").replace('-', "\u{2212}") }
    };
    (first..=last).map(mark).collect()
}

pub(in crate::capture) fn angle_marks() -> Vec<AxisMark> {
    let marks = [
        (-PI, "\u{2212}\u{3c0}"),
        (-0.5 * PI, "\u{2212}\u{3c0}/2"),
        (0.0, "0"),
        (0.5 * PI, "\u{3c0}/2"),
        (PI, "\u{3c0}"),
    ];
    marks.map(|(at, text)| AxisMark { at, text: text.into() }).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(marks: &[AxisMark]) -> Vec<&str> {
        marks.iter().map(|mark| mark.text.as_str()).collect()
    }

    #[test]
    fn marks_are_round_and_few() {
        assert_eq!(texts(&marks([0.0, 60.0], 6)), ["0", "10", "20", "30", "40", "50", "60"]);
        assert_eq!(texts(&marks([-0.31, 0.52], 5)), ["\u{2212}0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(texts(&marks([0.0, 0.0007], 4)), ["0.0000", "0.0002", "0.0004", "0.0006"]);
        assert_eq!(texts(&marks([0.0, 1e12], 4)), [""; 0], "beyond all axes");
    }
}
