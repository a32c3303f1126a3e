//! Scans in WebAssembly, by `benches/wasm/run`, which needs Node.js and Rust's target for it.

use std::process::{Command, Stdio};

use crate::contest::WORLDS;
use crate::{Row, Table};

/// Adds the rows that the script prints. Without the script's tools it prints a message and adds none.
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
    for line in String::from_utf8_lossy(&run.stdout).lines() {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [work, ours, peer, ratio, must, spread] = cells[..] else { continue };
        if table.wants(work) {
            let [work, ours, peer, ratio, spread] = [work, ours, peer, ratio, spread].map(String::from);
            let must = if must.is_empty() { "" } else { ">= 15x" };
            table.push(Row { work, ours, peer, ratio, spread, must });
        }
    }
}
