//! `Attempt`, the run of a submission at one seed.

use std::fmt;

use super::Assignment;
use crate::configuration::{Configuration as _, Coordinates, RobotKind};
use crate::geometry::Pose2;
use crate::random::Seed;
use crate::recording::RunError;
use crate::run::Script;

/// Least motion of a tick that counts as forward or backward, metres. A robot held at a wall creeps by less.
const CREEP: f64 = 1e-6;

/// The result of an attempt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// At the goal within every limit.
    Passed,
    /// Not at the goal in time.
    Missed,
    /// More contact episodes than allowed.
    Contacts,
    /// More reversals than allowed.
    Reversals,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Verdict::Passed => "passed",
            Verdict::Missed => "missed the goal",
            Verdict::Contacts => "too many contacts",
            Verdict::Reversals => "too many reversals",
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
    pub verdict: Verdict,
    /// The deciding tick: the one at which the goal was reached or a limit exceeded, else the last.
    pub tick: u64,
    /// The contact episodes up to then.
    pub contacts: u32,
    /// The changes between forward and backward up to then; 0 for a robot that does not drive.
    pub reversals: u32,
    /// The configuration's coordinates at that tick.
    pub configuration: Coordinates,
}

impl Attempt {
    /// Runs the script at a seed until it is decided.
    pub(super) fn run(assignment: &Assignment, seed: Seed, script: &Script) -> Result<Attempt, RunError> {
        let (limits, goal) = (assignment.limits(), assignment.goal());
        let robot = assignment.robot();
        let mut run = assignment.begin(seed, script)?;
        let mut before = run.frame().robots[robot].configuration.clone();
        let (mut reversals, mut ahead, mut there) = (0_u32, None, 0_u64);
        loop {
            let frame = run.step();
            let (tick, state) = (frame.tick, &frame.robots[robot]);
            if let Some(way) = way(assignment.about(), &before, &state.configuration) {
                reversals = reversals.saturating_add(u32::from(ahead.is_some_and(|a| a != way)));
                ahead = Some(way);
            }
            there = if is_within(assignment, &state.configuration) { there + 1 } else { 0 };
            let verdict = if limits.contacts.is_some_and(|most| state.contacts > most) {
                Some(Verdict::Contacts)
            } else if limits.reversals.is_some_and(|most| reversals > most) {
                Some(Verdict::Reversals)
            } else if there >= goal.ticks {
                Some(Verdict::Passed)
            } else {
                (tick >= limits.ticks).then_some(Verdict::Missed)
            };
            before.clone_from(&state.configuration);
            if let Some(verdict) = verdict {
                return Ok(Attempt { seed, verdict, tick, contacts: state.contacts, reversals, configuration: before });
            }
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

/// Whether a configuration is at the goal. A configuration of another space (with a trailer, when the goal has none) is
/// not.
fn is_within(assignment: &Assignment, q: &[f64]) -> bool {
    let goal = assignment.goal();
    difference(assignment.about(), &goal.at, q).is_some_and(|d| {
        d.len() == goal.within.len() && d.iter().zip(&goal.within).all(|(d, within)| d.abs() <= *within)
    })
}

/// The chart difference of two configurations of this kind. A kind that nobody described is compared coordinate by
/// coordinate.
fn difference(about: Option<&RobotKind>, from: &[f64], to: &[f64]) -> Option<Coordinates> {
    match about {
        Some(known) => (known.difference)(from, to),
        None => (from.len() == to.len()).then(|| from.iter().zip(to).map(|(a, b)| b - a).collect()),
    }
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
    fn ahead_is_where_the_robot_faces() {
        let west = [0.0, 0.0, PI];
        assert_eq!(way(Some(&RobotKind::RUSTY), &west, &[-0.1, 0.0, PI]), Some(true));
        assert_eq!(way(Some(&RobotKind::HITCH), &[0.0, 0.0, PI, 0.3], &[0.1, 0.0, PI, 0.3]), Some(false));
        assert_eq!(way(Some(&RobotKind::RUSTY), &west, &[0.0, 0.0, 1.0]), None, "a turn on the spot");
        assert_eq!(way(Some(&RobotKind::REACH), &[0.0, 0.0], &[1.0, 0.0]), None);
    }
}
