//! `RowGatherer`, which makes a row of a run while it goes on.

use super::columns::RobotColumns;
use super::failure_kind::{FailureKind, RunFailure};
use super::row::{RowValue, RunRow};
use super::study::Study;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::num::lesser;
use motion_lab_core::worlds::Resident;
use motion_lab_sim::run::{Digest, Frame, RobotState, RobotStats, Script, StatsGatherer, seconds};
use motion_lab_sim::simulation::Refusals;
use motion_lab_sim::tour::TourConfig;

/// The goal of a run, and how long its robot was there.
struct GoalWatch {
    robot: usize,
    about: Option<&'static RobotKind>,
    at: Vec<f64>,
    within: Vec<f64>,
    /// The number of ticks that ended there.
    ticks: u64,
    /// The first tick there; 0 is the start.
    first: Option<u64>,
}

/// Gathers the row of a run frame by frame.
pub struct RowGatherer<'a> {
    study: &'a Study,
    row: u64,
    residents: Vec<&'a Resident>,
    stats: StatsGatherer<'a>,
    goal: Option<GoalWatch>,
}

impl<'a> RowGatherer<'a> {
    /// A gatherer for the run of this row.
    pub fn new(study: &'a Study, row: u64, config: &'a TourConfig, script: &'a Script) -> Self {
        let residents: Vec<&Resident> = config.worlds.iter().flat_map(|world| &world.robots).collect();
        let goal = study.goal_of(row, &config.worlds).and_then(|goal| {
            let robot = residents.iter().position(|resident| resident.name == goal.robot)?;
            let about = study.kinds.of(&residents[robot].kind);
            Some(GoalWatch { robot, about, at: goal.at(), within: goal.within(), ticks: 0, first: None })
        });
        let stats = StatsGatherer::new(config, script, &study.kinds);
        RowGatherer { study, row, residents, stats, goal }
    }

    /// Sees the next frame; the first one is that of tick 0.
    pub fn see(&mut self, frame: &Frame) {
        self.stats.see(frame);
        if let Some(goal) = &mut self.goal
            && frame.robots.get(goal.robot).is_some_and(|state| goal.is_met(&state.configuration))
        {
            goal.first.get_or_insert(frame.tick);
            // tick 0 takes no time
            goal.ticks += u64::from(frame.tick > 0);
        }
    }

    /// The row of the run that ended with this frame and digest.
    pub fn row(self, last: &Frame, digest: Digest, refusals: &Refusals) -> RunRow {
        let RowGatherer { study, row, residents, stats, goal } = self;
        let stats = stats.stats().robots;
        let failure = match (refusals.first(), &goal) {
            (Some(first), _) => {
                let reason = format!("{} inputs were refused, the first at {first}", refusals.count());
                Some(RunFailure::new(FailureKind::InputsRefused, reason))
            }
            (None, Some(goal)) if goal.first.is_none() => {
                Some(RunFailure::new(FailureKind::GoalNotReached, "the goal was not reached"))
            }
            (None, None) if study.goal().is_some() => {
                Some(RunFailure::new(FailureKind::NoGoalRobot, "the goal's robot is not in this run"))
            }
            _ => None,
        };
        let first = stats.iter().filter_map(|robot| robot.first_contact).min();
        let least = stats.iter().filter_map(|robot| robot.least_clearance).map(|least| least.metres).reduce(lesser);
        let paths = stats.iter().filter_map(|robot| robot.path_length);
        let mut cells = study.parameters(row);
        cells.extend(failure.map_or([RowValue::Empty, RowValue::Empty], |failure| failure.cells()));
        cells.extend([
            RowValue::Whole(stats.iter().map(|robot| u64::from(robot.contacts)).sum()),
            RowValue::finite(first.map(seconds)),
            RowValue::finite(least),
            RowValue::finite(Some(paths.sum())),
        ]);
        if study.goal().is_some() {
            let times = goal.map(|goal| (seconds(goal.ticks), goal.first.map(seconds)));
            cells.extend([
                RowValue::finite(times.map(|(there, _)| there)),
                RowValue::finite(times.and_then(|(_, first)| first)),
            ]);
        }
        // what comes of planning is known before the run: `Study::with_planned`
        let results = study.columns().iter().position(|column| column.name == "digest").unwrap_or(cells.len());
        cells.resize(results, RowValue::Empty);
        cells.push(RowValue::text(digest.to_string()));
        for columns in &study.robots {
            let robot = residents.iter().position(|resident| resident.name == columns.name);
            let known = robot.and_then(|i| Some((residents[i], stats.get(i)?, last.robots.get(i)?)));
            cells.extend(of_robot(columns, known));
        }
        RunRow { row, cells }
    }
}

impl GoalWatch {
    /// Whether a configuration is at the goal, angles the short way round. One of another space is not.
    fn is_met(&self, q: &[f64]) -> bool {
        let Some(about) = self.about else { return false };
        let difference = (about.difference)(&self.at, q);
        difference.is_some_and(|d| d.iter().zip(&self.within).all(|(d, within)| d.abs() <= *within))
    }
}

/// The cells of one robot; all of them empty for one that was not in the run.
fn of_robot(columns: &RobotColumns, known: Option<(&Resident, &RobotStats, &RobotState)>) -> Vec<RowValue> {
    let width = RobotKind::of(&columns.kind).map_or(0, |kind| kind.coordinates.len());
    let end = |i: usize| {
        let state = known.filter(|(resident, ..)| resident.kind == columns.kind).map(|(.., state)| state);
        RowValue::finite(state.and_then(|state| state.configuration.get(i)).copied())
    };
    let mut cells: Vec<RowValue> = (0..width).map(end).collect();
    let Some((_, stats, _)) = known else {
        cells.resize(width + super::columns::OF_ROBOT.len(), RowValue::Empty);
        return cells;
    };
    cells.extend([
        RowValue::Whole(u64::from(stats.contacts)),
        RowValue::Number(stats.contact_seconds()),
        RowValue::finite(stats.first_contact.map(seconds)),
        RowValue::finite(stats.least_clearance.map(|least| least.metres)),
        RowValue::finite(stats.path_length),
        RowValue::Whole(u64::from(stats.refusals)),
    ]);
    cells
}
