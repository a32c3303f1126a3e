//! The table as text, and the page that holds it.

use crate::Row;

/// The page that holds the table.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/performance.md");

const BEGIN: &str = "<!-- table: begin -->";
const END: &str = "<!-- table: end -->";

/// A duration with three digits.
pub fn time(nanoseconds: f64) -> String {
    let (value, unit) = match nanoseconds {
        n if n < 999.5 => (n, "ns"),
        n if n < 999.5e3 => (n / 1e3, "us"),
        n => (n / 1e6, "ms"),
    };
    let places = if value < 9.995 {
        2
    } else if value < 99.95 {
        1
    } else {
        0
    };
    format!("{value:.places$} {unit}")
}

pub fn line(row: &Row) -> String {
    let Row { work, ours, peer, ratio, spread, must } = row;
    format!("| {work} | {ours} | {peer} | {ratio} | {must} | {spread} |")
}

/// Replaces the table in its page, between its two marks.
pub fn write(rows: &[Row]) {
    let text = std::fs::read_to_string(PAGE).expect("the page is there");
    let (before, rest) = text.split_once(BEGIN).expect("the page has the table's first mark");
    let (_, after) = rest.split_once(END).expect("the page has the table's last mark");
    let lines: Vec<String> = rows.iter().map(line).collect();
    let table = format!(
        "{BEGIN}\n| work | here | beside it | ratio | must reach | spread |\n|---|---|---|---|---|---|\n{}\n\n\
         Medians of 101 interleaved rounds (15 where one call takes a millisecond); the ratio is the median of the rounds' own; the spread is half the distance between the \
         quartiles, of each. {}.\n{END}",
        lines.join("\n"),
        processor()
    );
    std::fs::write(PAGE, format!("{before}{table}{after}")).expect("the page can be written");
}

fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info
        .lines()
        .find_map(|l| l.strip_prefix("model name"))
        .map_or("unknown processor", |m| m.trim_start_matches(['\t', ' ', ':']));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{model}, {cores} cores, Rust {}", env!("CARGO_PKG_RUST_VERSION"))
}
