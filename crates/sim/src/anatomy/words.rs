//! Numbers as the anatomy prints them: fixed decimals, a true minus sign.

use motion_lab_core::geometry::Point2;

/// A number with this many decimals and a true minus sign; never a minus before a zero.
pub(super) fn figure(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
        Some(rest) => format!("\u{2212}{rest}"),
        None => text,
    }
}

/// A length in metres, four decimals: `0.0607 m`. Exactly 0 is `0 m`.
pub(super) fn metres(x: f64) -> String {
    if x == 0.0 {
        "0 m".into()
    } else if x.is_infinite() {
        "\u{221e}".into()
    } else {
        format!("{} m", figure(x, 4))
    }
}

/// A point, three decimals.
pub(super) fn point(p: Point2) -> String {
    format!("({}, {})", figure(p.x, 3), figure(p.y, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minus_signs_are_true_and_never_before_a_zero() {
        assert_eq!(figure(-1.25, 2), "\u{2212}1.25");
        assert_eq!(figure(-0.0004, 3), "0.000");
        assert_eq!(metres(0.0), "0 m");
        assert_eq!(metres(1e-7), "0.0000 m", "not contact: contact is exactly 0");
    }
}
