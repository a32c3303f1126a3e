//! Races: every round, every contender does every case once, forward in even rounds and backward in odd ones, so that
//! disturbances by the machine affect all alike.

use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;

use crate::interval::quantile;
use crate::pace;
use crate::process::Process;
use crate::rivals::lap;

/// Greatest number of rounds.
const ROUNDS: usize = 101;
/// Least number of rounds.
const FEW_ROUNDS: usize = 7;
/// About how long one contender runs in all its rounds, nanoseconds. Rounds are left out for slow ones only.
const BUDGET: f64 = 1.5e9;

/// Set when every contender does one case and nothing is timed.
static UNTIMED: AtomicBool = AtomicBool::new(false);

/// Switches timing off: from now on every contender does one case.
pub fn time_nothing() {
    UNTIMED.store(true, Ordering::Relaxed);
}

/// Whether races are timed.
pub fn is_timed() -> bool {
    !UNTIMED.load(Ordering::Relaxed)
}

/// A contender's way to do all cases of a row.
pub struct Entrant<'a> {
    pub name: String,
    /// Does all cases and returns the time of one, nanoseconds.
    round: Box<dyn FnMut() -> f64 + 'a>,
    factor: f64,
}

impl<'a> Entrant<'a> {
    /// Work in this program, which is called with the number of each case.
    pub fn new<T>(name: impl Into<String>, cases: usize, mut work: impl FnMut(usize) -> T + 'a) -> Self {
        let cases = if is_timed() { cases } else { 1 };
        let round = move || {
            lap(cases, |case| {
                black_box(work(case));
            })
        };
        Entrant { name: name.into(), round: Box::new(round), factor: 1.0 }
    }

    /// Work that prepares something and then returns the time of one case by its own clock, nanoseconds.
    pub fn by_own_clock(name: impl Into<String>, round: impl FnMut() -> f64 + 'a) -> Self {
        Entrant { name: name.into(), round: Box::new(round), factor: 1.0 }
    }

    /// Multiplies its times from now on.
    pub fn scale(&mut self, factor: f64) {
        self.factor = factor;
    }

    /// Way number `way` of a program of its own to do the task that it was given.
    pub fn remote(name: String, process: Arc<Mutex<Process>>, way: usize) -> Self {
        Entrant { name, round: Box::new(move || process.lock().expect("one at a time").round(way)), factor: 1.0 }
    }
}

/// The times of one contender, nanoseconds a case.
#[derive(Clone, Debug)]
pub struct Timing {
    pub name: String,
    pub median: f64,
    rounds: Vec<f64>,
}

impl Timing {
    /// The timing of these rounds, nanoseconds.
    pub fn of(name: impl Into<String>, rounds: Vec<f64>) -> Self {
        Timing { name: name.into(), median: quantile(&rounds, 0.5), rounds }
    }

    /// The time of one of the work's `parts`.
    pub fn per(&self, parts: f64) -> Self {
        Self::of(self.name.clone(), self.rounds.iter().map(|t| t / parts).collect())
    }

    /// The ratio of this one's time to the other's in each round that both ran.
    pub fn over(&self, other: &Timing) -> Vec<f64> {
        self.rounds.iter().zip(&other.rounds).map(|(a, b)| a / b).collect()
    }

    pub fn rounds(&self) -> &[f64] {
        &self.rounds
    }
}

/// How many rounds something joins whose round takes so long, nanoseconds.
fn rounds_of(took: f64) -> usize {
    ((BUDGET / took) as usize).clamp(FEW_ROUNDS, ROUNDS)
}

/// Times all entrants, after a first round that does not count. The slow ones join the first rounds only.
pub fn race(entrants: Vec<Entrant>) -> Vec<Timing> {
    let mut runners: Vec<(Entrant, usize, Vec<f64>)> = entrants
        .into_iter()
        .map(|mut entrant| {
            let start = Instant::now();
            let once = entrant.factor * (entrant.round)();
            let rounds = rounds_of(start.elapsed().as_secs_f64() * 1e9);
            (entrant, rounds, if is_timed() { Vec::new() } else { vec![once] })
        })
        .collect();
    let rounds = if is_timed() { runners.iter().map(|(_, rounds, _)| *rounds).max().unwrap_or(0) } else { 0 };
    for round in 0..rounds {
        pace::beat();
        let mut turn = |(entrant, rounds, times): &mut (Entrant, usize, Vec<f64>)| {
            if round < *rounds {
                times.push(entrant.factor * (entrant.round)());
            }
        };
        if round % 2 == 0 {
            runners.iter_mut().for_each(&mut turn);
        } else {
            runners.iter_mut().rev().for_each(&mut turn);
        }
    }
    runners.into_iter().map(|(entrant, _, times)| Timing::of(entrant.name, times)).collect()
}
