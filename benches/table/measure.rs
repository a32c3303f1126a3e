//! Interleaved measurements: every round times every contender, so that disturbances by the machine affect all alike.

use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Number of rounds of a row.
const ROUNDS: usize = 101;
/// Working time of one contender in one round: less than a system's time slice.
const SLICE: Duration = Duration::from_millis(1);
/// Number of rounds for work that takes longer than that.
const FEW_ROUNDS: usize = 15;

/// Set when every contender does its work once and nothing is timed.
static UNTIMED: AtomicBool = AtomicBool::new(false);

/// Switches timing off: from now on every contender does its work once.
pub fn time_nothing() {
    UNTIMED.store(true, Ordering::Relaxed);
}

/// Whether races are timed.
pub fn is_timed() -> bool {
    !UNTIMED.load(Ordering::Relaxed)
}

/// A way to do the row's work. It is called again and again with a rising count.
pub struct Contender<'a> {
    pub name: &'static str,
    work: Box<dyn FnMut(usize) + 'a>,
}

impl<'a> Contender<'a> {
    pub fn new<T>(name: &'static str, mut work: impl FnMut(usize) -> T + 'a) -> Self {
        Contender { name, work: Box::new(move |i| _ = black_box(work(i))) }
    }
}

/// The times of one contender, nanoseconds per call.
pub struct Timing {
    pub name: &'static str,
    pub median: f64,
    /// Half the distance between the quartiles, as a share of the median.
    pub spread: f64,
    rounds: Vec<f64>,
}

impl Timing {
    /// The timing of these rounds, nanoseconds.
    pub fn of(name: &'static str, rounds: Vec<f64>) -> Self {
        let (low, median, high) = (quantile(&rounds, 0.25), quantile(&rounds, 0.5), quantile(&rounds, 0.75));
        Timing { name, median, spread: 0.5 * (high - low) / median, rounds }
    }

    /// The time of one of the work's `parts`.
    pub fn per(&self, parts: f64) -> Self {
        Self::of(self.name, self.rounds.iter().map(|t| t / parts).collect())
    }

    /// The median over the rounds of the ratio of `other`'s time to this one's.
    pub fn times_faster_than(&self, other: &Timing) -> f64 {
        let ratios: Vec<f64> = self.rounds.iter().zip(&other.rounds).map(|(a, b)| b / a).collect();
        quantile(&ratios, 0.5)
    }
}

fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[((sorted.len() - 1) as f64 * share).round() as usize]
}

/// Times the contenders, of which the first is ours.
pub fn race(contenders: Vec<Contender>) -> Vec<Timing> {
    if !is_timed() {
        let once = |mut c: Contender| {
            (c.work)(0);
            Timing::of(c.name, vec![1.0])
        };
        return contenders.into_iter().map(once).collect();
    }
    let mut contenders: Vec<(Contender, usize, usize, Vec<f64>)> = contenders
        .into_iter()
        .map(|mut c| {
            let (mut calls, mut done) = (1, 0);
            // as many calls as fill a slice
            loop {
                let start = Instant::now();
                (done..done + calls).for_each(|i| (c.work)(i));
                done += calls;
                let took = start.elapsed();
                if took >= SLICE / 2 || calls >= 1 << 28 {
                    let per_call = took.as_secs_f64() / calls as f64;
                    calls = ((SLICE.as_secs_f64() / per_call) as usize).max(1);
                    break;
                }
                calls *= 2;
            }
            (c, calls, done, Vec::new())
        })
        .collect();
    let slow = contenders.iter().any(|(_, calls, _, _)| *calls == 1);
    for _ in 0..if slow { FEW_ROUNDS } else { ROUNDS } {
        for (c, calls, done, rounds) in &mut contenders {
            let start = Instant::now();
            (*done..*done + *calls).for_each(|i| (c.work)(i));
            rounds.push(start.elapsed().as_secs_f64() * 1e9 / *calls as f64);
            *done += *calls;
        }
    }
    contenders.into_iter().map(|(c, _, _, rounds)| Timing::of(c.name, rounds)).collect()
}
