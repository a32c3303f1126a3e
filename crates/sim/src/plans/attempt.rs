//! `PlanAttempt`, a planner at work on its problem, whatever the robot.

use crate::run::Script;
use crate::simulation::{PlayError, PlayStage, PlayablePath, PlayedPath};
use motion_lab_core::collision::ProvenStep;
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::cspace::CellMap;
use motion_lab_core::planning::{Bounds, CertifiedPath, Effort, NoPath, Planner, Progress, accepted, solve};
use motion_lab_core::robots::{ChartLine, HitchArc, Motion, Robot};

use super::drawn::{Drawn, Rejected};

/// The number of straight pieces in which a driven motion is drawn.
const DRAWN: u32 = 6;

/// What drives a leg of a path: a speed, a steering angle and a time; nothing for the chart's straight lines.
#[derive(Clone, Copy, Debug)]
pub struct LegControl {
    /// Metres per second.
    pub v: f64,
    /// Radians.
    pub phi: f64,
    /// Seconds.
    pub seconds: f64,
}

/// A motion that a path may consist of.
pub trait LegMotion: Motion + Clone + Send + 'static {
    /// What drives it.
    fn driven(&self) -> Option<LegControl>;

    /// Its length: metres driven, or the length of the line in the chart.
    fn length(&self) -> f64;

    /// In how many pieces it is drawn.
    fn pieces(&self) -> u32;
}

impl<R: Robot> LegMotion for ChartLine<R> {
    fn driven(&self) -> Option<LegControl> {
        None
    }

    fn length(&self) -> f64 {
        let d = self.at(0.0).difference(&self.at(1.0));
        d.map_or(0.0, |d| motion_lab_core::num::sqrt(d.iter().map(|x| x * x).sum()))
    }

    fn pieces(&self) -> u32 {
        // a line of the chart is none of the workspace where joints turn
        if self.disc_line().is_some() { 1 } else { DRAWN }
    }
}

impl LegMotion for HitchArc {
    fn driven(&self) -> Option<LegControl> {
        let control = self.control();
        Some(LegControl { v: control.v, phi: control.phi, seconds: self.seconds() })
    }

    fn length(&self) -> f64 {
        (self.control().v * self.seconds()).abs()
    }

    fn pieces(&self) -> u32 {
        DRAWN
    }
}

/// A leg of a path, as files hold it.
#[derive(Clone, Debug)]
pub struct FileLeg {
    /// Where it begins.
    pub from: Vec<f64>,
    /// Where it ends.
    pub to: Vec<f64>,
    /// What drives it.
    pub driven: Option<LegControl>,
    /// The steps that prove it free.
    pub steps: Vec<ProvenStep>,
}

/// The length and the clearance of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathLengths {
    /// The length, metres driven or by the chart's coordinates.
    pub length: f64,
    /// The clearance proven along the whole path, metres.
    pub clearance: f64,
}

/// A planner at work.
pub trait PlanAttempt: Send {
    /// Works until there is a path.
    ///
    /// # Errors
    /// [`NoPath`] says why there is none.
    fn solve(&mut self, bounds: &Bounds) -> Result<(), NoPath>;

    /// Goes on to a bound after there is a path, where the planner shortens it; another one stays as it is.
    ///
    /// # Errors
    /// [`NoPath::Refused`]: the shorter path does not stand the check.
    fn improve(&mut self, bounds: &Bounds) -> Result<(), NoPath>;

    /// Does one iteration. A path is checked before it counts, as by [`solve`].
    fn step(&mut self) -> Progress;

    /// What there is to draw: the growth, the path, and what the last motion that was rejected hits.
    fn drawn(&self) -> Drawn;

    /// The cells of the configuration space that the planner has judged, if it judges any.
    fn cells(&self) -> Option<&CellMap>;

    /// What the planner has done.
    fn effort(&self) -> Effort;

    /// The path's legs; none without a path.
    fn legs(&self) -> Vec<FileLeg>;

    /// The path's length and the clearance proven along it; zeros without a path.
    fn lengths(&self) -> PathLengths;

    /// What the planner has grown: the nodes' coordinates, and the edges by the numbers of their ends.
    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>);

    /// The script that plays the path; `None` without a path.
    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>>;
}

/// A planner of one robot at work.
pub struct Trial<R: Robot, M: LegMotion<Configuration = R::Configuration>> {
    planner: Box<dyn Planner<R, M> + Send>,
    path: Option<CertifiedPath<M>>,
    /// The number of motions that were rejected before the last iteration.
    rejected_before: u64,
}

impl<R: Robot, M: LegMotion<Configuration = R::Configuration>> Trial<R, M> {
    /// The planner before its first iteration.
    pub fn new(planner: Box<dyn Planner<R, M> + Send>) -> Self {
        Trial { planner, path: None, rejected_before: 0 }
    }
}

impl<R: Robot<Configuration: Into<AnyConfiguration>>, M: LegMotion<Configuration = R::Configuration>> Trial<R, M> {
    fn sampled(motion: &M) -> impl Iterator<Item = R::Configuration> {
        let pieces = motion.pieces();
        (0..=pieces).map(move |i| motion.at(f64::from(i) / f64::from(pieces)))
    }

    fn among_any(motion: &M) -> Vec<AnyConfiguration> {
        Self::sampled(motion).map(Into::into).collect()
    }

    /// The motion that was rejected last, if it was in the last iteration.
    fn rejected(&self) -> Option<Rejected> {
        let (growth, checker) = (self.planner.growth(), self.planner.problem().checker());
        let effort = growth.effort();
        let is_new = effort.edges - effort.free > self.rejected_before;
        let rejection = growth.rejection(checker).filter(|_| is_new)?;
        Some(Rejected { way: Self::among_any(growth.rejected()?), at: rejection.at.into(), witness: rejection.witness })
    }
}

impl<R: Robot<Configuration: Into<AnyConfiguration>>, M: LegMotion<Configuration = R::Configuration>> PlanAttempt
    for Trial<R, M>
where
    CertifiedPath<M>: PlayablePath,
{
    fn solve(&mut self, bounds: &Bounds) -> Result<(), NoPath> {
        self.path = Some(solve(self.planner.as_mut(), bounds)?);
        Ok(())
    }

    fn improve(&mut self, bounds: &Bounds) -> Result<(), NoPath> {
        loop {
            let effort = self.planner.growth().effort();
            if bounds.reached(&effort).is_some() {
                break;
            }
            self.planner.step();
            if self.planner.growth().effort() == effort {
                // it does nothing more
                break;
            }
        }
        self.path = Some(accepted(self.planner.as_ref())?);
        Ok(())
    }

    fn step(&mut self) -> Progress {
        let before = self.planner.growth().effort();
        self.rejected_before = before.edges - before.free;
        match self.planner.step() {
            Progress::Solved => match accepted(self.planner.as_ref()) {
                Ok(path) => {
                    self.path = Some(path);
                    Progress::Solved
                }
                Err(refused) => Progress::Ended(refused.into()),
            },
            progress => progress,
        }
    }

    fn drawn(&self) -> Drawn {
        let (growth, problem) = (self.planner.growth(), self.planner.problem());
        let edges = growth.edges().filter_map(|[a, b]| Some(Self::among_any(&self.planner.motion(a, b)?)));
        let path = self.path.iter().flat_map(|path| path.legs());
        let corners = self.path.iter().flat_map(CertifiedPath::corners);
        Drawn {
            ends: [problem.start(), problem.goal()].map(Into::into),
            edges: edges.collect(),
            path: path.flat_map(|leg| Self::among_any(leg.motion())).collect(),
            corners: corners.map(Into::into).collect(),
            rejected: self.rejected().filter(|_| self.path.is_none()),
            sensed: self.planner.sensed(),
        }
    }

    fn cells(&self) -> Option<&CellMap> {
        self.planner.cells()
    }

    fn effort(&self) -> Effort {
        self.planner.growth().effort()
    }

    fn legs(&self) -> Vec<FileLeg> {
        let legs = self.path.iter().flat_map(|path| path.legs());
        legs.map(|leg| FileLeg {
            from: leg.motion().at(0.0).coordinates().to_vec(),
            to: leg.motion().at(1.0).coordinates().to_vec(),
            driven: leg.motion().driven(),
            steps: leg.certificate().steps().to_vec(),
        })
        .collect()
    }

    fn lengths(&self) -> PathLengths {
        let legs = self.path.iter().flat_map(|path| path.legs());
        PathLengths {
            length: legs.map(|leg| leg.motion().length()).sum(),
            clearance: self.path.as_ref().map_or(0.0, CertifiedPath::clearance),
        }
    }

    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>) {
        let growth = self.planner.growth();
        (growth.nodes().iter().map(|node| node.at.coordinates().to_vec()).collect(), growth.edges().collect())
    }

    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>> {
        self.path.as_ref().map(|path| Script::of_path(path, stage))
    }
}
