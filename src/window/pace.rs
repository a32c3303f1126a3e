//! `Pace`, whether the run keeps up with its speed; and playing as fast as possible.

use std::collections::VecDeque;
use std::time::Duration;

use bevy::platform::time::Instant;
use bevy::prelude::*;

use motion_lab_sim::run::DT;
use motion_lab_sim::simulation::{LatestFrame, Playback, Transport, play_tick};

/// Time that each frame gives to ticks when the run plays as fast as possible.
const BUDGET: Duration = Duration::from_millis(12);

/// Time of a frame that the ticks of many robots may take, unless one tick takes more.
const TICKS_BUDGET: Duration = Duration::from_millis(30);

/// Largest number of robots whose ticks are not limited.
const MANY: usize = 100;

/// Longest time that a frame lets pass, as Bevy has it.
const MAX_DELTA: Duration = Duration::from_millis(250);

/// Length of the measurement, seconds of the clock.
const WINDOW: f64 = 1.5;

/// Fraction of its speed below which a run is behind.
const ENOUGH: f64 = 0.9;

/// The speed of the run, measured over the last second or so of the clock.
#[derive(Resource, Clone, Debug, Default)]
pub struct Pace {
    /// Seconds of the clock, and ticks, of the last frames.
    frames: VecDeque<(f64, u64)>,
    last: Option<(u64, f64)>,
    /// Where the fixed loop of this frame began: when, and at which tick.
    began: Option<(Instant, u64)>,
    /// Seconds of the clock that a tick takes, smoothed; `None` before the first.
    tick_seconds: Option<f64>,
}

impl Pace {
    /// Records a frame that took `seconds` of the clock, after which a run of this speed stands at `tick`.
    pub fn frame(&mut self, seconds: f64, tick: u64, speed: f64, playback: Playback) {
        let before = self.last.replace((tick, speed));
        // more ticks than a frame can play, those that a stall left over included, are a jump forward
        let most = if speed.is_finite() { 16 + (2.0 * speed * seconds / DT) as u64 } else { u64::MAX };
        let played = |(t, s): &(u64, f64)| (*t..=t.saturating_add(most)).contains(&tick) && *s == speed;
        // a pause, a jump or another speed begins a new measurement
        let Some((from, _)) = before.filter(|b| played(b) && playback == Playback::Playing) else {
            self.frames.clear();
            return;
        };
        self.frames.push_back((seconds, tick - from));
        while self.seconds() - self.frames.front().map_or(0.0, |f| f.0) >= WINDOW {
            self.frames.pop_front();
        }
    }

    fn seconds(&self) -> f64 {
        self.frames.iter().map(|f| f.0).sum()
    }

    /// Longest time that the next frame may let pass, so that the ticks of a run of many robots leave room for drawing.
    /// The run then falls behind its speed, and the window says so.
    pub fn max_delta(&self, robots: usize, speed: f64) -> Duration {
        let Some(tick) = self.tick_seconds.filter(|_| robots > MANY && speed.is_finite()) else { return MAX_DELTA };
        let ticks = (TICKS_BUDGET.as_secs_f64() / tick).floor().clamp(1.0, 1e6);
        MAX_DELTA.min(Duration::try_from_secs_f64(ticks * DT / speed).unwrap_or(MAX_DELTA))
    }

    /// Simulated seconds per second of the clock; `None` before enough is known.
    pub fn reached(&self) -> Option<f64> {
        let seconds = self.seconds();
        let ticks: u64 = self.frames.iter().map(|f| f.1).sum();
        // in a shorter time, one tick more or less would weigh too much
        (seconds >= 0.6 * WINDOW).then(|| DT * ticks as f64 / seconds)
    }

    /// A note on the speed reached, where the run falls behind its speed or plays as fast as possible.
    pub fn words(&self, speed: f64) -> Option<String> {
        let reached = self.reached()?;
        let round = |x: f64| if x < 10.0 { format!("{x:.1}") } else { format!("{x:.0}") };
        if speed.is_infinite() {
            return Some(format!("{} x", round(reached)));
        }
        let slack = DT / WINDOW;
        if reached >= ENOUGH * speed - slack {
            None
        } else if reached < 1.0 {
            Some(format!("slower than real time: {} x", round(reached)))
        } else {
            Some(format!("slower than asked: {} x", round(reached)))
        }
    }
}

/// Plays as many ticks as fit the budget, when the run goes as fast as possible. Their number decides only what the
/// frame shows.
pub fn play_flat_out(world: &mut World) {
    let flat_out = |world: &World| {
        let transport = world.resource::<Transport>();
        let (playback, speed) = (transport.playback, transport.speed);
        playback == Playback::Playing && speed.is_infinite()
    };
    let start = Instant::now();
    while flat_out(world) && start.elapsed() < BUDGET {
        play_tick(world);
    }
}

/// Lets no more time pass in this frame than its ticks may take.
pub fn limit(world: &mut World) {
    let robots = world.resource::<LatestFrame>().frame().robots.len();
    let most = world.resource::<Pace>().max_delta(robots, world.resource::<Transport>().speed);
    world.resource_mut::<Time<Virtual>>().set_max_delta(most);
}

/// Notes where the fixed loop begins.
pub fn begin_ticks(mut pace: ResMut<Pace>, transport: Res<Transport>) {
    pace.began = Some((Instant::now(), transport.tick()));
}

/// Measures what a tick took.
pub fn end_ticks(mut pace: ResMut<Pace>, transport: Res<Transport>) {
    let Some((began, tick)) = pace.began.take() else { return };
    let ticks = transport.tick().saturating_sub(tick);
    if ticks > 0 && transport.speed.is_finite() {
        let took = began.elapsed().as_secs_f64() / ticks as f64;
        pace.tick_seconds = Some(pace.tick_seconds.map_or(took, |before| before + 0.3 * (took - before)));
    }
}

/// Measures the frame.
pub fn measure(world: &mut World) {
    let seconds = world.resource::<Time<Real>>().delta_secs_f64();
    let transport = world.resource::<Transport>();
    let (tick, speed, playback) = (transport.tick(), transport.speed, transport.playback);
    world.resource_mut::<Pace>().frame(seconds, tick, speed, playback);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The note after two seconds of frames, each `seconds` long, in each of which the run goes on by `ticks`.
    fn said(speed: f64, seconds: f64, ticks: f64) -> Option<String> {
        let mut pace = Pace::default();
        let mut sum = 0.0;
        for _ in 0..(2.0 / seconds) as u32 {
            sum += ticks;
            pace.frame(seconds, sum as u64, speed, Playback::Playing);
        }
        pace.words(speed)
    }

    #[test]
    fn a_run_that_keeps_up_is_not_talked_of() {
        assert_eq!(said(1.0, 1.0 / 60.0, 20.0 / 60.0), None);
        assert_eq!(said(64.0, 1.0 / 30.0, 64.0 * 20.0 / 30.0), None);
        assert_eq!(said(0.125, 1.0 / 60.0, 2.5 / 60.0), None);
    }

    #[test]
    fn one_that_does_not_is() {
        assert_eq!(said(1.0, 0.5, 5.0).as_deref(), Some("slower than real time: 0.5 x"));
        assert_eq!(said(64.0, 0.1, 82.0).as_deref(), Some("slower than asked: 41 x"));
        assert_eq!(said(f64::INFINITY, 0.02, 40.0).as_deref(), Some("100 x"));
    }

    #[test]
    fn the_ticks_of_many_robots_leave_room_for_drawing() {
        let pace = |seconds| Pace { tick_seconds: Some(seconds), ..Pace::default() };
        let millis = |pace: &Pace, robots, speed| pace.max_delta(robots, speed).as_millis();
        // a tick of 45 ms: one a frame, which is 50 ms of the clock at normal speed and 12.5 ms at four times it
        assert_eq!(millis(&pace(0.045), 10_000, 1.0), 50);
        assert_eq!(millis(&pace(0.045), 10_000, 4.0), 12);
        // one of 7 ms: four fit into 30 ms
        assert_eq!(millis(&pace(0.007), 1_000, 1.0), 200);
        assert_eq!(millis(&pace(0.007), 1_000, 8.0), 25);
        // what is quick, few, or not yet measured, is not limited
        assert_eq!([millis(&pace(0.001), 1_000, 1.0), millis(&pace(0.045), 3, 1.0)], [250, 250]);
        assert_eq!(millis(&Pace::default(), 10_000, 1.0), 250);
    }

    #[test]
    fn a_jump_begins_a_new_measurement() {
        let mut pace = Pace::default();
        let frame = |pace: &mut Pace, tick| pace.frame(1.0 / 60.0, tick, 1.0, Playback::Playing);
        for number in 0..120 {
            frame(&mut pace, number / 3);
        }
        assert_eq!(pace.reached().map(|x| x.round()), Some(1.0));
        frame(&mut pace, 539);
        assert_eq!(pace.reached(), None, "forward");
        for number in 0..120 {
            frame(&mut pace, 540 + number / 3);
        }
        assert_eq!(pace.reached().map(|x| x.round()), Some(1.0));
        frame(&mut pace, 3);
        assert_eq!(pace.reached(), None, "back");
    }
}
