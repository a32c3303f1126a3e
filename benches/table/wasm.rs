//! Scans in WebAssembly, by `benches/wasm/run`, which needs Node.js and Rust's target for it.

use std::process::{Command, Stdio};

use crate::Table;
use crate::contest::WORLDS;
use crate::measure::Timing;
use crate::row::{Mark, Row};

/// Adds a row for each two lines that the script prints: a work, a contender's name and the times of its rounds.
/// Without the script's tools it prints a message and adds none.
pub fn rows(table: &mut Table) {
    if !WORLDS.iter().any(|world| table.wants(&format!("{} (WebAssembly simd128)", world.work()))) {
        return;
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/wasm/run");
    let run = Command::new(script).stderr(Stdio::inherit()).output().expect("a shell runs the script");
    if run.status.code() == Some(77) {
        return;
    }
    assert!(run.status.success(), "{script} failed");
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    let line = |line: &str| -> Option<(String, Timing)> {
        let [work, name, rounds]: [&str; 3] = line.split('|').collect::<Vec<_>>().try_into().ok()?;
        let rounds = rounds.split_whitespace().map(|word| word.parse().expect("a time")).collect();
        Some((work.into(), Timing::of(name, rounds)))
    };
    let timings: Vec<(String, Timing)> = text.lines().filter_map(line).collect();
    for pair in timings.chunks(2) {
        let [(work, ours), (_, peer)] = pair else { continue };
        let is_marked = WORLDS.iter().any(|w| w.must.is_some() && work.starts_with(&w.work())) && work.contains("simd");
        let mark = if is_marked { Mark::faster_by(15.0) } else { Mark::FASTER };
        if table.wants(work) {
            table.push(Row::new(work.clone(), mark, ours, std::slice::from_ref(peer)));
        }
    }
}
