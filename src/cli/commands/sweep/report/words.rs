//! Numbers and texts as the page has them.

use crate::capture::ConfidenceInterval;

/// A number with six decimals at most.
pub fn rounded(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A text as HTML has it.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A share with its interval: `0.5 (0.254 to 0.746)`; nothing for a share of none.
pub fn share(count: u64, of: u64) -> String {
    let interval = ConfidenceInterval::of_share(count, of);
    let three = |x: f64| rounded((x * 1e3).round() / 1e3);
    interval.map_or(String::new(), |interval| {
        format!("{} ({} to {})", three(count as f64 / of as f64), three(interval.lower), three(interval.upper))
    })
}
