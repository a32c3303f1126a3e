//! The processor's time that this process has taken, and for how long a thread waited for a core, as the system counts.

use std::time::Duration;

/// The time of all threads of this process so far; `None` where it is not known how to ask.
#[cfg(target_os = "linux")]
pub fn time_taken() -> Option<Duration> {
    let ticks = ticks(&std::fs::read_to_string("/proc/self/stat").ok()?)?;
    let a_second = ticks_a_second(&std::fs::read("/proc/self/auxv").ok()?).unwrap_or(100);
    Some(Duration::from_secs_f64(ticks as f64 / a_second as f64))
}

/// The time of all threads of this process so far; `None` where it is not known how to ask.
#[cfg(not(target_os = "linux"))]
pub fn time_taken() -> Option<Duration> {
    None
}

/// How long this thread could have run so far, and waited for a core that another held; `None` where it is not known
/// how to ask.
#[cfg(target_os = "linux")]
pub fn time_waited() -> Option<Duration> {
    waited(&std::fs::read_to_string("/proc/thread-self/schedstat").ok()?)
}

/// How long this thread could have run so far, and waited for a core that another held; `None` where it is not known
/// how to ask.
#[cfg(not(target_os = "linux"))]
pub fn time_waited() -> Option<Duration> {
    None
}

/// The wait of a thread by its line in `/proc`: nanoseconds on a core, nanoseconds waiting for one, turns.
#[cfg(target_os = "linux")]
fn waited(line: &str) -> Option<Duration> {
    line.split_whitespace().nth(1)?.parse().ok().map(Duration::from_nanos)
}

/// The clock ticks in user mode and in the kernel of a process, by its line in `/proc`. The second field, the
/// program's name in brackets, may hold spaces and brackets itself.
#[cfg(target_os = "linux")]
fn ticks(stat: &str) -> Option<u64> {
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut field = || fields.next()?.parse::<u64>().ok();
    Some(field()? + field()?)
}

/// The number of clock ticks in a second, by the vector that the kernel gives a process: pairs of a name and a value.
#[cfg(target_os = "linux")]
fn ticks_a_second(vector: &[u8]) -> Option<usize> {
    const NAME: usize = 17;
    let (words, _) = vector.as_chunks::<{ size_of::<usize>() }>();
    let words: Vec<usize> = words.iter().map(|word| usize::from_ne_bytes(*word)).collect();
    words.as_chunks::<2>().0.iter().find(|[name, _]| *name == NAME).map(|[_, value]| *value).filter(|value| *value > 0)
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn both_times_are_read_whatever_the_program_is_called() {
        let line = "7 (a ) b (c) S 1 7 7 0 -1 4194304 100 0 3 0 1234 66 9 8 20 0 1 0 5 1 1";
        assert_eq!(ticks(line), Some(1300), "user and kernel, and not those of children");
        assert_eq!((ticks("7 (a"), ticks("7 (a) S 1 7")), (None, None));
        let vector: Vec<u8> = [6, 4096, 17, 250, 0, 0].iter().flat_map(|w: &usize| w.to_ne_bytes()).collect();
        assert_eq!((ticks_a_second(&vector), ticks_a_second(&vector[..16])), (Some(250), None));
    }

    #[test]
    fn a_wait_is_the_second_number_and_what_sleeps_does_not_wait() {
        assert_eq!(waited("655330 1200 31\n"), Some(Duration::from_nanos(1200)));
        assert_eq!((waited("655330"), waited("a b c")), (None, None));
        let (before, start) = (time_waited().unwrap(), Instant::now());
        std::thread::sleep(Duration::from_millis(300));
        let waited = time_waited().unwrap() - before;
        assert!(waited + Duration::from_millis(290) <= start.elapsed(), "{waited:?} of {:?}", start.elapsed());
    }

    #[test]
    fn more_threads_than_cores_wait() {
        let cores = std::thread::available_parallelism().unwrap().get();
        let work = || {
            let (before, start) = (time_waited().unwrap(), Instant::now());
            let mut sum = 0u64;
            while start.elapsed() < Duration::from_millis(300) {
                sum = std::hint::black_box(sum.wrapping_add(1));
            }
            time_waited().unwrap() - before
        };
        let threads: Vec<_> = (0..4 * cores).map(|_| std::thread::spawn(work)).collect();
        let waited: Duration = threads.into_iter().map(|thread| thread.join().unwrap()).sum();
        // four times as many threads as cores wait for three quarters of their time, and run for one at most
        let whole = Duration::from_millis(300) * 4 * cores as u32;
        assert!(waited >= whole / 3, "{waited:?} of {whole:?}");
    }

    #[test]
    fn work_takes_time_and_sleep_takes_none() {
        // other tests of this process work too, so only a lower bound is certain
        let (before, start) = (time_taken().unwrap(), Instant::now());
        let mut sum = 0u64;
        while start.elapsed() < Duration::from_millis(400) {
            sum = std::hint::black_box(sum.wrapping_add(1));
        }
        let took = time_taken().unwrap() - before;
        assert!(took >= Duration::from_millis(100), "{took:?}");
        assert!(time_taken().unwrap() < Duration::from_secs(1_000_000));
    }
}
