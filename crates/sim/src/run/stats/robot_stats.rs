//! `RunStats`, what a run was like for each of its robots.

use super::gauge::Gauge;
use crate::run::{Frame, Log, Script, seconds};
use crate::tour::TourConfig;
use motion_lab_core::configuration::Kinds;

/// What a run was like for each of its robots, from tick 0 to the last frame that was seen.
///
/// ```
/// use motion_lab_sim::recording::Run;
/// use motion_lab_sim::run::RunStats;
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
///
/// let log = Run::record(TourConfig { ticks: 40, ..TourConfig::default() }, BOOK_SEED)?;
/// let stats = RunStats::of(&log);
/// let rusty = &stats.robots[0];
/// assert_eq!((stats.ticks, rusty.name.as_str()), (40, "Rusty"));
/// assert!(rusty.path_length.unwrap() > 0.0 && rusty.least_clearance.unwrap().metres > 0.0);
/// # Ok::<(), motion_lab_sim::recording::RunError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunStats {
    /// The last tick that was seen.
    pub ticks: u64,
    /// The robots by ascending id.
    pub robots: Vec<RobotStats>,
}

/// What a run was like for one robot.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotStats {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: String,
    /// The name of its world.
    pub world: String,
    /// Its contact episodes.
    pub contacts: u32,
    /// The number of ticks that ended in contact.
    pub contact_ticks: u64,
    /// The first tick that ended in contact, or in which a contact began; `None` if there was none.
    pub first_contact: Option<u64>,
    /// The length of its path, metres: of a body that drives, forward and backward, the arc from tick to tick; of an
    /// arm the way of its tip, in straight lines from tick to tick. A tick in which it was put somewhere counts
    /// nothing. `None` for a robot whose kind nobody described.
    pub path_length: Option<f64>,
    /// The least clearance that it had at the end of a tick, or at tick 0; `None` in a world without obstacles, and for
    /// a robot whose kind nobody described.
    pub least_clearance: Option<LeastClearance>,
    /// The inputs of the script that it refused.
    pub refusals: u32,
}

/// The least distance of a robot from the obstacles of its world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastClearance {
    /// The distance, metres; 0 in contact. Other robots are no obstacles.
    pub metres: f64,
    /// The first tick at which it was that small.
    pub tick: u64,
}

impl RobotStats {
    /// The time at which ticks ended in contact, seconds.
    pub fn contact_seconds(&self) -> f64 {
        seconds(self.contact_ticks)
    }
}

impl RunStats {
    /// The stats of a log's run, by its frames; nothing is simulated. Robots of kinds that are not the lab's have
    /// neither path nor clearance: [`of_kinds`](Self::of_kinds) knows a program's own.
    pub fn of(log: &Log) -> Self {
        RunStats::of_kinds(log, &Kinds::default())
    }

    /// [`of`](Self::of) with kinds of robots that a program added.
    pub fn of_kinds(log: &Log, kinds: &Kinds) -> Self {
        let mut gatherer = StatsGatherer::new(&log.recipe.config, &log.recipe.script, kinds);
        log.initial().into_iter().chain(log.frames()).for_each(|frame| gatherer.see(frame));
        gatherer.stats()
    }
}

/// Gathers the stats of a run frame by frame, so that the frames need not be kept.
pub struct StatsGatherer<'a> {
    gauge: Gauge<'a>,
    stats: RunStats,
}

impl<'a> StatsGatherer<'a> {
    /// A gatherer for a run of this configuration and script, with these kinds of robots.
    pub fn new(config: &TourConfig, script: &'a Script, kinds: &'a Kinds) -> Self {
        let residents = config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r)));
        let robots = residents.map(|(world, resident)| RobotStats {
            name: resident.name.clone(),
            kind: resident.kind.clone(),
            world: world.name.clone(),
            contacts: 0,
            contact_ticks: 0,
            first_contact: None,
            path_length: None,
            least_clearance: None,
            refusals: 0,
        });
        let stats = RunStats { ticks: 0, robots: robots.collect() };
        StatsGatherer { gauge: Gauge::new(config, script, kinds, true), stats }
    }

    /// The same without clearances, which take most of the time.
    #[must_use]
    pub fn without_clearance(self) -> Self {
        StatsGatherer { gauge: self.gauge.without_clearance(), ..self }
    }

    /// Sees the next frame; the first one is that of tick 0.
    pub fn see(&mut self, frame: &Frame) {
        let readings = self.gauge.read(frame);
        self.stats.ticks = frame.tick;
        for ((stats, state), reading) in self.stats.robots.iter_mut().zip(&frame.robots).zip(readings) {
            (stats.contacts, stats.refusals) = (state.contacts, state.refusals);
            stats.contact_ticks += u64::from(state.in_contact);
            if stats.first_contact.is_none() && (state.in_contact || state.contacts > 0) {
                stats.first_contact = Some(frame.tick);
            }
            if let Some(step) = reading.step {
                stats.path_length = Some(stats.path_length.unwrap_or(0.0) + step.abs());
            }
            if let Some(metres) = reading.clearance.filter(|c| c.is_finite())
                && stats.least_clearance.is_none_or(|least| metres < least.metres)
            {
                stats.least_clearance = Some(LeastClearance { metres, tick: frame.tick });
            }
        }
    }

    /// The stats so far.
    pub fn stats(self) -> RunStats {
        self.stats
    }
}
