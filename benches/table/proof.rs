//! Checks of the table's own arithmetic, which `agree` runs before the rows.

use std::cell::Cell;

use crate::interval::Interval;
use crate::rivals::{Task, bisected};
use crate::row::{Mark, Verdict};

/// The order statistics that bound the median of 101 values with 95 % are numbers 41 and 61, by the binomial
/// distribution; the bootstrap may be one or two off.
fn intervals() {
    let values: Vec<f64> = (1..=101).map(f64::from).collect();
    let Interval { low, median, high } = Interval::of("proof", &values);
    assert_eq!(median, 51.0);
    assert!((39.0..=43.0).contains(&low) && (59.0..=63.0).contains(&high), "{low} to {high}");
    assert_eq!(Interval::of("proof", &values), Interval { low, median, high }, "the draws are seeded");
    assert_eq!(Interval::of("proof", &[2.5; 9]), Interval { low: 2.5, median: 2.5, high: 2.5 });
}

fn verdicts() {
    let ratio = Interval { low: 4.0, median: 5.0, high: 6.0 };
    let fast = |bound| Mark::faster_by(bound).verdict(&ratio);
    assert_eq!([3.9, 5.0, 5.5, 6.1].map(fast), [Verdict::Met, Verdict::Crossed, Verdict::Crossed, Verdict::Missed]);
    let cost = |bound| Mark::at_most(bound, " scans").verdict(&ratio);
    assert_eq!([6.1, 5.5, 4.5, 3.9].map(cost), [Verdict::Met, Verdict::Crossed, Verdict::Crossed, Verdict::Missed]);
    assert_eq!(Mark::FASTER.verdict(&ratio), Verdict::Unmarked);
}

/// Bisection visits every sample of a free edge once, and finds the first that meets something.
fn samples() {
    for last in 1..70 {
        let visits = Cell::new(0);
        let free = bisected(last, false, |_| {
            visits.set(visits.get() + 1);
            false
        });
        assert_eq!((free, visits.get()), (None, last + 1));
        for first in 0..=last {
            assert_eq!(bisected(last, false, |i| i >= first), Some(first), "of {last}");
            assert_eq!(bisected(last, false, |i| i == first), Some(first), "of {last}");
            assert_eq!(bisected(last, true, |i| i == first), Some(first), "of {last}");
        }
    }
}

/// A task comes through a pipe bit for bit.
fn tasks() {
    let task = Task {
        kind: "scan".into(),
        settings: vec![0.1, -0.0],
        obstacles: vec![vec![1.0 / 3.0, f64::MIN_POSITIVE], vec![]],
        cases: vec![vec![1e300, -2.5e-17]],
    };
    let mut text = Vec::new();
    task.write(&mut text).expect("a buffer");
    let text = String::from_utf8(text).expect("text");
    let (head, mut rest) =
        text.strip_prefix("task ").and_then(|t| t.split_once('\n')).map(|(h, r)| (h, r.as_bytes())).expect("a head");
    let bits = |task: &Task| -> Vec<u64> {
        let lists = std::iter::once(&task.settings).chain(&task.obstacles).chain(&task.cases);
        lists.flatten().map(|x| x.to_bits()).collect()
    };
    let read = Task::read(head, &mut rest).expect("a task");
    assert_eq!((&read, bits(&read)), (&task, bits(&task)));
}

pub fn check() {
    intervals();
    verdicts();
    samples();
    tasks();
}
