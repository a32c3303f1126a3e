//! The lab's times beside those of parry2d-f64, row by row, written into docs/performance.md.
//!
//! `cargo bench --no-default-features --features headless --bench table`
//!
//! With an argument after `--`: `scan` (or another word) measures only the rows whose name contains it, and prints them
//! without writing; `worlds` prints the worlds, for `benches/peers`; `digests` prints the digests of the scans, for
//! `benches/wasm`; `agree` does every row once with its checks, such as that lab and peer agree, and times nothing.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, clippy::disallowed_methods)]

mod contest;
mod crowd;
mod edges;
mod measure;
mod peer;
mod plans;
mod queries;
mod readme;
mod rectangles;
mod runs;
mod scans;
mod wasm;
mod worlds;
mod worlds_json;

use measure::Timing;

/// A line of the table.
pub struct Row {
    pub work: String,
    pub ours: String,
    pub peer: String,
    pub ratio: String,
    pub spread: String,
    pub must: &'static str,
}

/// The rows asked for, measured one after the other.
pub struct Table {
    only: Option<String>,
    pub rows: Vec<Row>,
}

impl Table {
    /// Adds a row if it is asked for. `measure` returns our timing first, then the others'.
    pub fn row(&mut self, work: &str, must: &'static str, measure: impl FnOnce() -> Vec<Timing>) {
        if self.wants(work) {
            let timings = measure();
            let (ours, peer) = (&timings[0], timings.get(1));
            self.push(Row {
                work: work.into(),
                ours: readme::time(ours.median),
                peer: peer.map_or_else(String::new, |p| format!("{} {}", p.name, readme::time(p.median))),
                ratio: peer.map_or_else(String::new, |p| format!("{:.1}x", ours.times_faster_than(p))),
                spread: timings.iter().map(|t| format!("{:.0} %", 100.0 * t.spread)).collect::<Vec<_>>().join(", "),
                must,
            });
        }
    }

    pub fn wants(&self, work: &str) -> bool {
        self.only.as_ref().is_none_or(|only| work.contains(only.as_str()))
    }

    pub fn push(&mut self, row: Row) {
        if measure::is_timed() {
            println!("{}", readme::line(&row));
        } else {
            println!("done: {}", row.work);
        }
        self.rows.push(row);
    }
}

fn main() {
    if std::env::var_os(runs::CHILD).is_some() {
        return runs::first_step();
    }
    let only = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    if only.as_deref() == Some("worlds") {
        return worlds_json::print();
    }
    if only.as_deref() == Some("digests") {
        return scans::print_digests();
    }
    let agree = only.as_deref() == Some("agree");
    let mut table = Table { only: only.filter(|_| !agree), rows: Vec::new() };
    if agree {
        measure::time_nothing();
    }
    scans::rows(&mut table);
    if !agree {
        wasm::rows(&mut table);
    }
    queries::rows(&mut table);
    edges::rows(&mut table);
    plans::rows(&mut table);
    runs::rows(&mut table);
    crowd::rows(&mut table);
    crowd::replicas(&mut table);
    if agree {
        assert!(table.rows.len() > 25, "only {} rows", table.rows.len());
    } else if table.only.is_none() {
        readme::write(&table.rows);
    }
}
