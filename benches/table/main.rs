//! The lab's times beside those of its rivals, row by row, written into docs/performance.md.
//!
//! `cargo bench --no-default-features --features headless --bench table`
//!
//! With arguments after `--`: `scan` (or another word) measures only the rows whose name contains it, and prints them
//! without writing; `check` measures without writing, and fails if a row misses its mark by more than its interval
//! (`check scan` of those rows only); `digests` prints the digests of the scans, for `benches/wasm`; `agree` does every
//! row once with its checks, such as that lab and peer agree, and times nothing.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, clippy::disallowed_methods)]

mod barriers;
mod contest;
mod crowd;
mod edges;
mod interval;
mod measure;
mod pace;
mod pairs;
mod peers;
mod plans;
mod process;
mod proof;
mod queries;
mod readme;
mod rectangles;
mod rivals;
mod row;
mod runs;
mod scans;
mod start;
mod wasm;
mod worlds;

use measure::{Entrant, race};
use peers::Peers;
use row::{Mark, Row, Verdict};

/// The rows asked for, measured one after the other.
pub struct Table {
    only: Option<String>,
    pub peers: Peers,
    pub rows: Vec<Row>,
}

impl Table {
    /// Adds rows for works that are measured together, each with its mark, if one of them is asked for. The first
    /// entrants are ours, one for each work; the others are the peers of all.
    pub fn race<'a>(&mut self, works: &[(String, Mark)], entrants: impl FnOnce(&mut Peers) -> Vec<Entrant<'a>>) {
        self.race_per(1.0, works, entrants);
    }

    /// The same where a case has this number of parts, and the times are those of one part.
    pub fn race_per<'a>(
        &mut self,
        parts: f64,
        works: &[(String, Mark)],
        entrants: impl FnOnce(&mut Peers) -> Vec<Entrant<'a>>,
    ) {
        if !works.iter().any(|(work, _)| self.wants(work)) {
            return;
        }
        let timings: Vec<_> = race(entrants(&mut self.peers)).iter().map(|timing| timing.per(parts)).collect();
        let (ours, peers) = timings.split_at(works.len());
        for ((work, mark), ours) in works.iter().zip(ours) {
            if self.wants(work) {
                self.push(Row::new(work.clone(), *mark, ours, peers));
            }
        }
    }

    pub fn wants(&self, work: &str) -> bool {
        self.only.as_ref().is_none_or(|only| work.contains(only.as_str()))
    }

    pub fn push(&mut self, row: Row) {
        if measure::is_timed() {
            println!("{}", row.line());
        } else {
            println!("done: {}", row.work);
        }
        self.rows.push(row);
    }
}

fn main() {
    let words: Vec<String> =
        std::env::args().skip(1).filter(|a| a != "--bench").map(|a| a.trim_start_matches('-').to_owned()).collect();
    let is = |word: &str| words.first().is_some_and(|first| first == word);
    if is("digests") {
        return scans::print_digests();
    }
    let (agree, check) = (is("agree"), is("check"));
    let only = words.get(usize::from(check)).filter(|_| !agree).cloned();
    if agree {
        proof::check();
        measure::time_nothing();
    }
    let whole = only.is_none();
    let mut table = Table { only, peers: Peers::start(), rows: Vec::new() };
    scans::rows(&mut table);
    if !agree {
        wasm::rows(&mut table);
    }
    queries::rows(&mut table);
    edges::rows(&mut table);
    plans::rows(&mut table);
    barriers::rows(&mut table);
    runs::rows(&mut table);
    start::rows(&mut table);
    crowd::rows(&mut table);
    crowd::rivals(&mut table);
    crowd::replicas(&mut table);
    if agree {
        assert!(table.rows.len() > 25, "only {} rows", table.rows.len());
        return;
    }
    println!("\n{}", readme::footer());
    if check {
        let missed: Vec<&Row> = table.rows.iter().filter(|row| row.verdict == Verdict::Missed).collect();
        let marked = table.rows.iter().filter(|row| row.verdict != Verdict::Unmarked).count();
        println!("{} of {marked} rows with a mark miss it by more than their interval", missed.len());
        missed.iter().for_each(|row| println!("missed: {}: {} of {}", row.work, row.ratio, row.mark));
        std::process::exit(i32::from(!missed.is_empty() || marked == 0));
    }
    if whole {
        readme::write(&table.rows);
    }
}
