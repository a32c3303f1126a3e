//! Readouts: printed configurations whose figures keep their places while they change.

/// Least width of a figure, characters.
const FIGURE: usize = 6;

/// Formats a printed configuration for the screen. Every number gets a true minus sign and is padded on the left, so
/// that what follows it does not move while it changes.
///
/// ```
/// # use motion_lab_core::picture::readout;
/// assert_eq!(readout("T2 { th1: 0.785, th2: -1.571 }"), "T2 { th1:  0.785, th2: \u{2212}1.571 }");
/// ```
pub fn readout(printed: &str) -> String {
    let mut out = String::with_capacity(printed.len() + 8);
    let mut rest = printed;
    while let Some(start) = number_start(rest) {
        out.push_str(&rest[..start]);
        let tail = &rest[start..];
        let end = tail.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).unwrap_or(tail.len());
        let number = true_minus(&tail[..end]);
        out.extend(std::iter::repeat_n(' ', FIGURE.saturating_sub(number.chars().count())));
        out.push_str(&number);
        rest = &tail[end..];
    }
    out.push_str(rest);
    out
}

/// Text whose hyphens are true minus signs.
pub fn true_minus(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

/// The name of a coordinate in mathematical signs: a joint's angle `th1` is θ₁, `theta` θ and `psi` ψ. Any other stays.
///
/// ```
/// # use motion_lab_core::picture::in_signs;
/// assert_eq!(["th1", "theta", "x"].map(in_signs), ["\u{3b8}\u{2081}", "\u{3b8}", "x"]);
/// ```
pub fn in_signs(name: &str) -> String {
    match name {
        "theta" => return "\u{3b8}".to_owned(),
        "psi" => return "\u{3c8}".to_owned(),
        _ => {}
    }
    let digit = name.strip_prefix("th").and_then(|rest| rest.parse::<u32>().ok()).filter(|joint| *joint < 10);
    match digit.and_then(|joint| char::from_u32(0x2080 + joint)) {
        Some(subscript) => format!("\u{3b8}{subscript}"),
        None => name.to_owned(),
    }
}

/// Byte offset of the next decimal number: a digit or minus after a space or an opening bracket. Digits in names (`T2`,
/// `Tn<3>`) do not count.
fn number_start(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    (1..bytes.len()).find(|&i| (bytes[i].is_ascii_digit() || bytes[i] == b'-') && matches!(bytes[i - 1], b' ' | b'('))
}

/// Breaks a readout into lines. A car's body and trailer get lines of their own; a line that is still longer than
/// `most` characters is broken once, after its opening brace.
pub fn readout_lines(readout: &str, most: usize) -> Vec<String> {
    let too_long = |line: &String| line.chars().count() > most;
    let broken = |line: String| match line.split_once("{ ") {
        Some((name, numbers)) if too_long(&line) => {
            let indent = name.chars().take_while(|c| *c == ' ').count() + 2;
            vec![format!("{name}{{"), format!("{:indent$}{numbers}", "")]
        }
        _ => vec![line],
    };
    fields(readout).into_iter().flat_map(broken).collect()
}

/// Each field of a car's configuration on a line of its own.
fn fields(readout: &str) -> Vec<String> {
    let fields = readout.split_once(" body:").and_then(|(name, rest)| Some((name, rest.split_once(" trailer:")?)));
    match fields {
        Some((name, (body, trailer))) => {
            vec![name.to_owned(), format!("  body:{body}"), format!("  trailer:{trailer}")]
        }
        None => vec![readout.to_owned()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::{HitchCfg, T2};
    use crate::geometry::Pose2;

    #[test]
    fn figures_do_not_jump() {
        let printed = |x, theta| readout(&Pose2::new(x, 1.0, theta).to_string());
        let widths = [printed(0.5, 0.1), printed(11.9, -0.1), printed(9.999, -3.1)].map(|s| s.chars().count());
        assert_eq!(widths[0], widths[1]);
        assert_eq!(widths[1], widths[2]);
        assert!(!printed(0.5, -0.1).contains('-'), "a true minus sign");
        assert_eq!(readout(&T2::new(1.0, 2.0).to_string()), "T2 { th1:  1.000, th2:  2.000 }");
        assert_eq!(readout("Tn<3> { th1: 0.100 }"), "Tn<3> { th1:  0.100 }");
    }

    #[test]
    fn a_car_reads_field_by_field() {
        let q = HitchCfg { body: Pose2::new(1.0, 2.0, 0.5), trailer: Some(-0.1) };
        let lines = readout_lines(&readout(&q.to_string()), 60);
        let expected = [
            "HitchCfg {",
            "  body: Pose2 { x:  1.000, y:  2.000, theta:  0.500 },",
            "  trailer: Some(\u{2212}0.100) }",
        ];
        assert_eq!(lines, expected);
        assert_eq!(readout_lines("T2 { th1: 0.1 }", 60), ["T2 { th1: 0.1 }"]);
        let narrow = readout_lines(&readout(&q.to_string()), 50);
        assert_eq!(narrow[1..3], ["  body: Pose2 {", "    x:  1.000, y:  2.000, theta:  0.500 },"]);
        assert!(narrow.iter().all(|line| line.chars().count() <= 50));
    }
}
