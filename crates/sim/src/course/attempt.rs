//! `Attempt`, the run of a submission at one seed.

use std::fmt;

use super::assignment::difference;
use super::{Assignment, When};
use crate::recording::RunError;
use crate::run::Script;
use motion_lab_core::configuration::{Configuration as _, Coordinates, RobotKind};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::num::{greater, sqrt};
use motion_lab_core::random::Seed;

/// Least motion of a tick that counts as forward or backward, metres. A robot held at a wall creeps by less.
const CREEP: f64 = 1e-6;

/// The result of an attempt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AttemptOutcome {
    /// At the goal within every limit.
    Passed,
    /// Not at the goal in time.
    Missed,
    /// At the goal in time, but not for as long as asked for, or not at the end.
    Left,
    /// More contact episodes than allowed.
    Contacts,
    /// More reversals than allowed.
    Reversals,
}

impl fmt::Display for AttemptOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            AttemptOutcome::Passed => "passed",
            AttemptOutcome::Missed => "missed the goal",
            AttemptOutcome::Left => "left the goal",
            AttemptOutcome::Contacts => "too many contacts",
            AttemptOutcome::Reversals => "too many reversals",
        })
    }
}

/// The run of a submission at one seed, up to the tick that decides it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Attempt {
    /// The seed.
    pub seed: Seed,
    /// The result.
    pub verdict: AttemptOutcome,
    /// The deciding tick: the one at which the goal was reached or a limit exceeded, else the last.
    pub tick: u64,
    /// The contact episodes up to then.
    pub contacts: u32,
    /// The changes between forward and backward up to then; 0 for a robot that does not drive.
    pub reversals: u32,
    /// The configuration's coordinates at that tick.
    pub configuration: Coordinates,
    /// How far that configuration is from the goal; `None` for one of another space, such as with a trailer.
    pub distance: Option<GoalDistance>,
    /// The criteria that it meets. With [points](super::Points) the attempt goes on after a limit is exceeded, until
    /// the goal is reached or the time is over.
    pub met: Met,
}

/// The criteria that an attempt meets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Met {
    /// It reached the goal in time, and stayed as long as asked for, whatever its contacts and reversals.
    pub goal: bool,
    /// It did so within the limit of contacts.
    pub contacts: bool,
    /// It did so within the limit of reversals.
    pub reversals: bool,
}

/// How far a configuration is from the goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalDistance {
    /// The distance between the places, metres, of a robot whose configuration says a place; 0 of an arm.
    pub metres: f64,
    /// The greatest difference of an angle, the short way round, radians; 0 without angles.
    pub radians: f64,
}

impl GoalDistance {
    /// The distance by the chart difference of two configurations. Of a kind without a description every coordinate
    /// counts as a length.
    fn of(about: Option<&RobotKind>, difference: &[f64]) -> Self {
        let (lengths, angles) = difference.split_at(about.map_or(difference.len(), |known| known.lengths));
        let metres = sqrt(lengths.iter().map(|d| d * d).sum());
        GoalDistance { metres, radians: angles.iter().fold(0.0, |most, d| greater(most, d.abs())) }
    }
}

/// What an attempt has come to at a tick.
#[derive(Clone)]
struct AttemptState {
    verdict: AttemptOutcome,
    tick: u64,
    contacts: u32,
    reversals: u32,
    configuration: Coordinates,
}

impl Attempt {
    /// Whether the robot was at the goal within every limit.
    pub fn passed(&self) -> bool {
        self.verdict == AttemptOutcome::Passed
    }

    /// Runs the script at a seed until it is decided. Asks after each tick whether to go on; `None` once it is not to.
    pub(super) fn run(
        assignment: &Assignment,
        seed: Seed,
        script: &Script,
        mut goes_on: impl FnMut(u64) -> bool,
    ) -> Result<Option<Attempt>, RunError> {
        let (limits, hold) = (assignment.limits(), assignment.hold());
        let (robot, about, goal) = (assignment.robot(), assignment.about(), assignment.goal());
        let mut run = assignment.begin(seed, script)?;
        let mut before = run.frame().robots[robot].configuration.clone();
        let (mut reversals, mut ahead, mut there, mut was_there) = (0_u32, None, 0_u64, false);
        let mut broken: Option<AttemptState> = None;
        loop {
            let frame = run.step();
            let (tick, state) = (frame.tick, &frame.robots[robot]);
            if !goes_on(tick) {
                return Ok(None);
            }
            if let Some(way) = way(about, &before, &state.configuration) {
                reversals = reversals.saturating_add(u32::from(ahead.is_some_and(|a| a != way)));
                ahead = Some(way);
            }
            there = if assignment.is_at_goal(&state.configuration) { there + 1 } else { 0 };
            was_there |= there > 0;
            before.clone_from(&state.configuration);
            let (contacts, configuration) = (state.contacts, &before);
            let reached =
                |verdict| AttemptState { verdict, tick, contacts, reversals, configuration: configuration.clone() };
            let kept = [
                limits.contacts.is_none_or(|most| contacts <= most),
                limits.reversals.is_none_or(|most| reversals <= most),
            ];
            let exceeded = match kept {
                [false, _] => Some(AttemptOutcome::Contacts),
                [_, false] => Some(AttemptOutcome::Reversals),
                _ => None,
            };
            if let (None, Some(verdict)) = (&broken, exceeded) {
                broken = Some(reached(verdict));
            }
            let is_last = tick >= limits.ticks;
            let is_there = there >= hold && (is_last || assignment.stay().at == When::Any);
            // without points nothing is left to find out after a limit is exceeded
            if !(is_there || is_last || broken.is_some() && assignment.points().is_none()) {
                continue;
            }
            let met = Met { goal: is_there, contacts: is_there && kept[0], reversals: is_there && kept[1] };
            let verdict = match (is_there, was_there) {
                (true, _) => AttemptOutcome::Passed,
                (false, true) => AttemptOutcome::Left,
                (false, false) => AttemptOutcome::Missed,
            };
            let AttemptState { verdict, tick, contacts, reversals, configuration } =
                broken.unwrap_or_else(|| reached(verdict));
            let difference = difference(about, &goal.at, &configuration);
            let distance = difference.map(|difference| GoalDistance::of(about, &difference));
            return Ok(Some(Attempt { seed, verdict, tick, contacts, reversals, configuration, distance, met }));
        }
    }
}

/// Whether a robot that drives went forward; `None` when it hardly moved, or does not drive.
fn way(about: Option<&RobotKind>, before: &[f64], after: &[f64]) -> Option<bool> {
    about.filter(|known| known.drives)?;
    let pose = |q: &[f64]| Pose2::from_coordinates(q.get(..3)?);
    let dx = pose(after)?.boxminus(&pose(before)?).dx;
    (dx.abs() > CREEP).then_some(dx > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn angles_differ_the_short_way_and_spaces_do_not_mix() {
        let near = difference(Some(&RobotKind::RUSTY), &[0.0, 0.0, PI - 0.1], &[1.0, -1.0, 0.1 - PI]).unwrap();
        assert!((near[2] - 0.2).abs() < 1e-12 && near[0] == 1.0 && near[1] == -1.0, "{near:?}");
        assert!(difference(Some(&RobotKind::HITCH), &[0.0; 3], &[0.0; 4]).is_none());
        assert!(difference(Some(&RobotKind::REACH), &[0.0; 2], &[0.0; 3]).is_none());
        assert_eq!(difference(None, &[1.0], &[7.5]).unwrap()[..], [6.5]);
    }

    #[test]
    fn the_distance_to_a_goal_is_that_of_the_places_and_the_greatest_angle() {
        let far = |about, d: &[f64]| GoalDistance::of(about, d);
        assert_eq!(far(Some(&RobotKind::RUSTY), &[3.0, -4.0, -0.5]), GoalDistance { metres: 5.0, radians: 0.5 });
        assert_eq!(far(Some(&RobotKind::REACH), &[0.25, -0.5]), GoalDistance { metres: 0.0, radians: 0.5 });
        assert_eq!(far(None, &[3.0, -4.0]), GoalDistance { metres: 5.0, radians: 0.0 });
    }

    #[test]
    fn ahead_is_where_the_robot_faces() {
        let west = [0.0, 0.0, PI];
        assert_eq!(way(Some(&RobotKind::RUSTY), &west, &[-0.1, 0.0, PI]), Some(true));
        assert_eq!(way(Some(&RobotKind::HITCH), &[0.0, 0.0, PI, 0.3], &[0.1, 0.0, PI, 0.3]), Some(false));
        assert_eq!(way(Some(&RobotKind::RUSTY), &west, &[0.0, 0.0, 1.0]), None, "a turn on the spot");
        assert_eq!(way(Some(&RobotKind::REACH), &[0.0, 0.0], &[1.0, 0.0]), None);
    }
}
