//! The start of the program: one tick of the tour, from the shell's view.

use std::process::{Command, Stdio};

use crate::Table;
use crate::interval::Interval;
use crate::measure::is_timed;
use crate::row::{Row, Verdict, time};

const PROGRAM: &str = env!("CARGO_BIN_EXE_motion-lab");

fn command() -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(["record", "--seconds", "0.05"]).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// The peak memory of one start, kilobytes: the last that the system says before the program ends.
fn peak() -> f64 {
    let mut child = command().spawn().expect("the program starts");
    let path = format!("/proc/{}/status", child.id());
    let mut peak = 0.0;
    while child.try_wait().expect("a child").is_none() {
        let status = std::fs::read_to_string(&path).unwrap_or_default();
        let said = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        peak = said.and_then(|l| l.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(peak);
    }
    peak
}

pub fn rows(table: &mut Table) {
    let work = "the program from its start to its end after one tick, peak memory";
    if !table.wants(work) {
        return;
    }
    let starts = if is_timed() { 41 } else { 1 };
    let took = (0..starts).map(|_| {
        let start = std::time::Instant::now();
        assert!(command().status().expect("the program starts").success());
        start.elapsed().as_secs_f64() * 1e9
    });
    let took = Interval::of(work, &took.collect::<Vec<_>>());
    let peak = (0..starts.min(11)).map(|_| peak()).fold(0.0, f64::max) / 1024.0;
    let verdict = match (took.low > 20e6 || peak > 20.0, took.high <= 20e6) {
        (true, _) => Verdict::Missed,
        (_, true) => Verdict::Met,
        _ => Verdict::Crossed,
    };
    let ours = format!("{} ({} to {}), {peak:.1} MB", time(took.median), time(took.low), time(took.high));
    table.push(Row::note(work.into(), ours).held_to("<= 20 ms, 20 MB", verdict));
}
