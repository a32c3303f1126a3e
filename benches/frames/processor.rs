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
pub fn waited(line: &str) -> Option<Duration> {
    line.split_whitespace().nth(1)?.parse().ok().map(Duration::from_nanos)
}

/// The clock ticks in user mode and in the kernel of a process, by its line in `/proc`. The second field, the
/// program's name in brackets, may hold spaces and brackets itself.
#[cfg(target_os = "linux")]
pub fn ticks(stat: &str) -> Option<u64> {
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut field = || fields.next()?.parse::<u64>().ok();
    Some(field()? + field()?)
}

/// The number of clock ticks in a second, by the vector that the kernel gives a process: pairs of a name and a value.
#[cfg(target_os = "linux")]
pub fn ticks_a_second(vector: &[u8]) -> Option<usize> {
    const NAME: usize = 17;
    let (words, _) = vector.as_chunks::<{ size_of::<usize>() }>();
    let words: Vec<usize> = words.iter().map(|word| usize::from_ne_bytes(*word)).collect();
    words.as_chunks::<2>().0.iter().find(|[name, _]| *name == NAME).map(|[_, value]| *value).filter(|value| *value > 0)
}
