//! The first of several candidates that holds, looked for by several threads.

use std::sync::atomic::{AtomicUsize, Ordering};

/// The least index below `count` for which `holds` is true, whatever the number of threads. Asks `go_on` before each
/// candidate; once it says no, none further is begun, and the answer may be another.
///
/// Candidates are begun in order. With several threads some behind the first that holds are tried in vain.
pub(super) fn first_holding(
    jobs: usize,
    count: usize,
    holds: impl Fn(usize) -> bool + Sync,
    go_on: impl Fn() -> bool + Sync,
) -> Option<usize> {
    let (next, found) = (AtomicUsize::new(0), AtomicUsize::new(usize::MAX));
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            // what is begun lies before every candidate that is not, so nothing before the first is left out
            if i >= count || i > found.load(Ordering::Relaxed) || !go_on() {
                return;
            }
            if holds(i) {
                found.fetch_min(i, Ordering::Relaxed);
            }
        }
    };
    let threads = jobs.clamp(1, count.max(1));
    if threads == 1 {
        work();
    } else {
        std::thread::scope(|scope| (0..threads).for_each(|_| _ = scope.spawn(work)));
    }
    Some(found.into_inner()).filter(|found| *found < count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_in_order_is_found_by_any_number_of_threads() {
        for jobs in [0, 1, 2, 8, 100] {
            for (holding, expected) in
                [(&[][..], None), (&[0], Some(0)), (&[19], Some(19)), (&[7, 8, 15], Some(7)), (&[20], None)]
            {
                // later candidates are quicker, so that they would win a race
                let holds = |i: usize| {
                    std::thread::sleep(std::time::Duration::from_micros(20 * (20 - i as u64)));
                    holding.contains(&i)
                };
                assert_eq!(first_holding(jobs, 20, holds, || true), expected, "{jobs} jobs, {holding:?}");
            }
            assert_eq!(first_holding(jobs, 0, |_| true, || true), None);
        }
    }

    #[test]
    fn nothing_is_begun_once_it_is_not_to_go_on() {
        for jobs in [1, 2, 8] {
            let (asked, tried) = (AtomicUsize::new(0), AtomicUsize::new(0));
            let holds = |_| tried.fetch_add(1, Ordering::Relaxed) > 100;
            let found = first_holding(jobs, 50, holds, || asked.fetch_add(1, Ordering::Relaxed) < 5);
            assert_eq!((found, tried.into_inner()), (None, 5), "{jobs} jobs");
        }
    }
}
