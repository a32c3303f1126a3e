//! `FrameTimes`, what a window takes of the program's own time and, paused, of the processor.

use std::time::Duration;

/// What the frames of a window took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameTimes {
    /// The program's own time of each measured frame, in order: reading the run, laying out the widgets, turning all
    /// that is drawn into triangles. Ticks of the run are no part of it, nor is what the graphics driver does.
    pub own: Vec<Duration>,
    /// Of each of these frames how long it waited for a core that another thread held, such as one of a driver that
    /// draws without a graphics processor; empty where the system is not asked.
    pub waited: Vec<Duration>,
    /// Of each of these frames what its three pieces took: reading, laying out, triangles.
    pub pieces: Vec<[Duration; 3]>,
    /// The time of the clock that all measured frames took together.
    pub clock: Duration,
    /// The pause after them.
    pub paused: Option<Pause>,
}

/// What a window takes while its run is paused and nobody touches it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pause {
    /// The length of the pause by the clock.
    pub clock: Duration,
    /// The processor's time in it, of all threads together; `None` where the system is not asked.
    pub processor: Option<Duration>,
}

impl Pause {
    /// The share of one core, 1 for all of it; `None` where the system is not asked.
    pub fn share(&self) -> Option<f64> {
        Some(self.processor?.as_secs_f64() / self.clock.as_secs_f64())
    }
}

impl FrameTimes {
    /// The own time that a `share` of the frames, from 0 to 1, does not exceed; none without frames.
    pub fn quantile(&self, share: f64) -> Option<Duration> {
        quantile(self.own.clone(), share)
    }

    /// What [`FrameTimes::quantile`] says, of the frames' own time without the wait for a core; none where the system
    /// is not asked.
    pub fn on_core(&self, share: f64) -> Option<Duration> {
        quantile(self.own.iter().zip(&self.waited).map(|(own, waited)| own.saturating_sub(*waited)).collect(), share)
    }

    /// What each piece takes in the median: reading, laying out, triangles; none without frames.
    pub fn medians(&self) -> Option<[Duration; 3]> {
        let median = |k: usize| quantile(self.pieces.iter().filter_map(|frame| frame.get(k).copied()).collect(), 0.5);
        Some([median(0)?, median(1)?, median(2)?])
    }

    /// Frames per second of the clock; none without frames.
    pub fn rate(&self) -> Option<f64> {
        (!self.own.is_empty()).then(|| self.own.len() as f64 / self.clock.as_secs_f64())
    }
}

/// The time that a `share` of these does not exceed.
fn quantile(mut times: Vec<Duration>, share: f64) -> Option<Duration> {
    times.sort_unstable();
    let last = times.len().checked_sub(1)?;
    times.get((share.clamp(0.0, 1.0) * last as f64).round() as usize).copied()
}

/// What the frames and the pause took, in words. A window that was closed before has no pause.
pub fn words(times: &FrameTimes) -> String {
    let millis = |share| times.quantile(share).map_or(f64::NAN, |t| 1e3 * t.as_secs_f64());
    let (median, most) = (millis(0.5), millis(0.95));
    let rate = times.rate().unwrap_or(f64::NAN);
    let frames = times.own.len();
    let played = format!(
        "{frames} frames, {rate:.1} a second; own time {median:.2} ms in the median, {most:.2} ms in 95 of 100"
    );
    let on_core = times.on_core(0.5).zip(times.on_core(0.95)).map_or_else(String::new, |(median, most)| {
        let [median, most] = [median, most].map(|time| 1e3 * time.as_secs_f64());
        format!("\nwithout the wait for a core that others held: {median:.2} ms, {most:.2} ms in 95 of 100")
    });
    let pieces = times.medians().map(|pieces| pieces.map(|piece| 1e3 * piece.as_secs_f64()));
    let pieces = pieces.map_or_else(String::new, |[reading, laying_out, triangles]| {
        format!(
            "\nof it, in the median: reading the run {reading:.2}, laying out {laying_out:.2}, triangles {triangles:.2}"
        )
    });
    let played = played + &on_core + &pieces;
    let Some(pause) = &times.paused else { return played };
    let seconds = pause.clock.as_secs_f64();
    match pause.share() {
        Some(share) => format!("{played}\npaused for {seconds:.1} s: {:.1} % of a core", 100.0 * share),
        None => format!("{played}\npaused for {seconds:.1} s: the share of a core is not known here"),
    }
}
