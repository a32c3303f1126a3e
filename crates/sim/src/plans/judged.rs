//! `JudgedPath`, what the exact scene says of a path that somebody wrote down.

use super::drawn::Rejected;
use super::task::Task;
use motion_lab_core::collision::{Checker, Collision, EdgeVerdict, Problem};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{CircularArc, Footprint, Segment};
use motion_lab_core::planning::{CertifiedPath, PathError};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, ChartLine, HitchArc, Leaving, Motion, Rates};

/// The number of straight pieces in which a motion is drawn.
pub(super) const DRAWN: u32 = 6;

/// Largest number of legs that are judged, so that a file is opened within seconds.
pub const MAX_JUDGED: usize = 10_000;

/// What the exact scene says of a path of a file, whoever planned it.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedPath {
    /// The clearance proven along it, metres; else what keeps it from being a path from the file's start to its goal.
    pub proof: Result<f64, PathError>,
    /// The first leg that hits, and where.
    pub hit: Option<Rejected>,
}

impl JudgedPath {
    /// The judgement of these motions for a task, whose robot, scene and ends count. `None` of no motion, and of more
    /// than [`MAX_JUDGED`].
    pub(super) fn of(motions: &[FileMotion], task: &Task) -> Option<Self> {
        if motions.is_empty() || motions.len() > MAX_JUDGED {
            return None;
        }
        let checker = Checker::new(task.scene.clone(), task.robot);
        let proof = proof(&checker, motions, task);
        let hit = match &proof {
            Err(PathError::NotFree { leg, verdict: EdgeVerdict::Hit { contact_at, .. }, .. }) => {
                Some(rejected(&checker, &motions[*leg], *contact_at))
            }
            _ => None,
        };
        Some(JudgedPath { proof, hit })
    }
}

fn proof(checker: &Checker<AnyRobot>, motions: &[FileMotion], task: &Task) -> Result<f64, PathError> {
    let path = CertifiedPath::try_new(checker, motions.iter().cloned())?;
    // a problem has no ends but those at which a path can begin and end
    let problem =
        Problem::try_new(checker.clone(), task.start, task.goal, Seed(0)).map_err(|_| PathError::OtherEnds)?;
    path.solves(&problem)
}

/// The motion that hits at `s`, and the nearest points there.
fn rejected(checker: &Checker<AnyRobot>, motion: &FileMotion, s: f64) -> Rejected {
    let witness = checker.scene().witness(&motion.footprint_at(s));
    Rejected { way: motion.drawn(), at: motion.at(s), witness }
}

/// A motion of a file: a chart line, or a car's drive.
#[derive(Clone)]
pub(super) enum FileMotion {
    Line(Box<ChartLine<AnyRobot>>),
    Drive(Box<HitchArc>),
}

impl FileMotion {
    /// The configurations along it in which it is drawn.
    pub(super) fn drawn(&self) -> Vec<AnyConfiguration> {
        (0..=DRAWN).map(|i| self.at(f64::from(i) / f64::from(DRAWN))).collect()
    }
}

macro_rules! of_either {
    ($motion:expr, $either:ident => $answer:expr) => {
        match $motion {
            FileMotion::Line($either) => $answer,
            FileMotion::Drive($either) => $answer,
        }
    };
}

impl Motion for FileMotion {
    type Configuration = AnyConfiguration;

    fn at(&self, s: f64) -> AnyConfiguration {
        match self {
            FileMotion::Line(line) => line.at(s),
            FileMotion::Drive(arc) => AnyConfiguration::Hitch(arc.at(s)),
        }
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        of_either!(self, motion => motion.footprint_at(s))
    }

    fn rates(&self, part: usize) -> Rates {
        of_either!(self, motion => motion.rates(part))
    }

    fn disc_arc(&self) -> Option<(CircularArc, f64)> {
        of_either!(self, motion => motion.disc_arc())
    }

    fn disc_line(&self) -> Option<(Segment, f64)> {
        of_either!(self, motion => motion.disc_line())
    }

    fn leaves_limits(&self) -> Option<Leaving> {
        of_either!(self, motion => motion.leaves_limits())
    }

    fn bound(&self, part: usize, s0: f64, s1: f64) -> f64 {
        of_either!(self, motion => motion.bound(part, s0, s1))
    }

    fn sagitta(&self, part: usize, s0: f64, s1: f64) -> f64 {
        of_either!(self, motion => motion.sagitta(part, s0, s1))
    }
}

#[cfg(test)]
mod tests;
