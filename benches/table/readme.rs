//! The page that holds the table.

use std::process::Command;

use crate::pace;
use crate::row::Row;

/// The page that holds the table.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/performance.md");

const BEGIN: &str = "<!-- table: begin -->";
const END: &str = "<!-- table: end -->";
const HEAD: &str = "| work | here | the fastest beside it | ratio (95 %) | mark | others |";

/// Replaces the table in its page, between its two marks.
pub fn write(rows: &[Row]) {
    let text = std::fs::read_to_string(PAGE).expect("the page is there");
    let (before, rest) = text.split_once(BEGIN).expect("the page has the table's first mark");
    let (_, after) = rest.split_once(END).expect("the page has the table's last mark");
    let lines: Vec<String> = rows.iter().map(Row::line).collect();
    let table = format!("{BEGIN}\n{HEAD}\n|---|---|---|---|---|---|\n{}\n\n{}\n{END}", lines.join("\n"), footer());
    std::fs::write(PAGE, format!("{before}{table}{after}")).expect("the page can be written");
}

/// What was measured how, where and by which compiler.
pub fn footer() -> String {
    format!(
        "Times are medians over up to 101 rounds, 7 at least; a ratio is the median of the rounds' own, with the \
         interval of 95 % of its bootstrap. {}. {}.",
        pace::say(),
        machine()
    )
}

fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info
        .lines()
        .find_map(|l| l.strip_prefix("model name"))
        .map_or("unknown processor", |m| m.trim_start_matches(['\t', ' ', ':']));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let instructions = if cfg!(baseline) { ", the collision checker with baseline instructions" } else { "" };
    format!("{model}, {cores} cores, {}{instructions}", compiler())
}

/// What the compiler in this folder says of itself: cargo used the same one to build this.
fn compiler() -> String {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let said = Command::new(compiler).arg("--version").current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let said = said.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned()).unwrap_or_default();
    if said.is_empty() { "a compiler that does not say its version".into() } else { said }
}
