//! `PlanAttempt`, a planner at work on its problem, whatever the robot.

use crate::run::Script;
use crate::simulation::{PlayError, PlayStage, PlayablePath, PlayedPath};
use motion_lab_core::collision::{Checker, Collision, EdgeVerdict, ProvenStep};
use motion_lab_core::configuration::{AnyConfiguration, Chart, Configuration};
use motion_lab_core::cspace::{Barrier, CellMap};
use motion_lab_core::planning::{
    Bounds, CertifiedPath, Effort, LinePath, Metric, NoPath, PathError, Planner, Progress, UnprovenPath, accepted,
    called_free, solve, solve_unproven,
};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{AnyRobot, ChartLine, Hitch, HitchArc, Motion, Robot};

use super::drawn::{Drawn, DrawnBarrier, Rejected};

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
    /// The steps that prove it free; none where nothing is proven.
    pub steps: Vec<ProvenStep>,
}

/// The length and the clearance of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathLengths {
    /// The length, metres driven or by the chart's coordinates.
    pub length: f64,
    /// The clearance proven along the whole path, metres; 0 where nothing is proven.
    pub clearance: f64,
}

/// A path that may be shortened.
pub trait ShortenedPath<R: Robot>: Sized {
    /// The path [shortened](LinePath::shortened) by shortcuts of this seed; `None` where its motions can't be.
    fn try_shortened(&self, checker: &Checker<R>, seed: Seed) -> Option<Self>;
}

impl<R: Robot<Configuration: Chart>> ShortenedPath<R> for LinePath<R> {
    fn try_shortened(&self, checker: &Checker<R>, seed: Seed) -> Option<Self> {
        let mut stream = Stream::new(seed, "planner/shorten");
        Some(self.shortened(checker, &Metric::unit(&self.start()), &mut stream))
    }
}

impl ShortenedPath<Hitch> for CertifiedPath<HitchArc> {
    fn try_shortened(&self, _: &Checker<Hitch>, _: Seed) -> Option<Self> {
        None
    }
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

    /// Shortens the path: by shortcuts between places drawn from the seed, and by cut corners. It is as certified, and
    /// keeps as much. False where there is no proven path, and of a car's, whose motions are none of straight lines.
    fn shorten(&mut self, seed: Seed) -> bool;

    /// Does one iteration. A path is checked before it counts, as by [`solve`].
    fn step(&mut self) -> Progress;

    /// What there is to draw: the growth, the path, and what the last motion that was rejected hits.
    fn drawn(&self) -> Drawn;

    /// The cells of a plane of configurations that the planner has judged, if it judges any.
    fn cells(&self) -> Option<&CellMap>;

    /// The blocked cells that part the start from the goal, if the planner has such, with the robot and the scene that
    /// they are of: of a car with a trailer the car alone.
    fn barrier(&self) -> Option<(Barrier, &Checker<AnyRobot>)>;

    /// What the planner has done.
    fn effort(&self) -> Effort;

    /// Whether there is a path.
    fn has_path(&self) -> bool;

    /// The path's legs; none without a path.
    fn legs(&self) -> Vec<FileLeg>;

    /// The path's length and the clearance proven along it; zeros without a path.
    fn lengths(&self) -> PathLengths;

    /// The clearance of a proven path, metres, after its certificates were checked once more; `None` without such a
    /// path.
    ///
    /// # Errors
    /// Within, [`PathError`] names the first leg that is not proven.
    fn verify(&self) -> Option<Result<f64, PathError>>;

    /// What the exact scene says of a path that a black box calls free: the clearance that it proves along it, metres,
    /// or which leg it does not prove free, and where that hits. `None` without a path, and of one that is proven.
    fn judged(&self) -> Option<Result<f64, PathError>>;

    /// What the planner has grown: the nodes' coordinates, and the edges by the numbers of their ends.
    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>);

    /// The script that plays the path; `None` without a path, and for one that is not proven.
    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>>;
}

/// A planner of one robot at work.
pub struct Trial<R: Robot, M: LegMotion<Configuration = R::Configuration>> {
    planner: Box<dyn Planner<R, M> + Send>,
    path: Option<CertifiedPath<M>>,
    /// The path where the checker has a black box.
    unproven: Option<UnprovenPath<M>>,
    /// The number of motions that were rejected before the last iteration.
    rejected_before: u64,
    /// The robot in its own scene, and the clearance that its path is to keep there, metres, where the planner's scene
    /// is one of larger obstacles.
    kept: Option<(Checker<R>, f64)>,
}

impl<R: Robot, M: LegMotion<Configuration = R::Configuration>> Trial<R, M> {
    /// The planner before its first iteration.
    pub fn new(planner: Box<dyn Planner<R, M> + Send>) -> Self {
        Trial { planner, path: None, unproven: None, rejected_before: 0, kept: None }
    }

    /// The same planner, whose scene is that of `checker` with obstacles larger by `margin` metres: a path counts once
    /// it is proven to keep more than that margin in the checker's own scene.
    #[must_use]
    pub fn keeping(self, checker: Checker<R>, margin: f64) -> Self {
        Trial { kept: Some((checker, margin)), ..self }
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

    /// The motions of the path's legs; none without a path.
    fn motions(&self) -> impl Iterator<Item = &M> {
        let proven = self.path.iter().flat_map(|path| path.legs()).map(|leg| leg.motion());
        proven.chain(self.unproven.iter().flat_map(|path| path.motions()))
    }

    /// Takes the planner's path, if it stands the check of [`solve`] or [`solve_unproven`].
    fn take(&mut self) -> Result<(), PathError> {
        let planner = self.planner.as_ref();
        if planner.problem().checker().black_box().is_some() {
            self.unproven = Some(called_free(planner)?);
        } else {
            let path = accepted(planner)?;
            self.path = Some(self.in_own_scene(path)?);
        }
        Ok(())
    }

    /// The path with its proof in the robot's own scene.
    fn in_own_scene(&self, path: CertifiedPath<M>) -> Result<CertifiedPath<M>, PathError> {
        let Some((checker, margin)) = &self.kept else { return Ok(path) };
        CertifiedPath::try_keeping(checker, path.legs().iter().map(|leg| leg.motion().clone()), *margin)
    }

    /// The motion of a path that nobody has proven, where the exact scene says that it hits.
    fn hit(&self) -> Option<Rejected> {
        let (path, checker) = (self.unproven.as_ref()?, self.planner.problem().checker());
        let Err(PathError::NotFree { leg, verdict, .. }) = path.certified(checker) else { return None };
        let (motion, EdgeVerdict::Hit { contact_at, .. }) = (&path.motions()[leg], verdict) else { return None };
        let at = motion.at(contact_at);
        let witness = checker.scene().witness(&motion.footprint_at(contact_at));
        Some(Rejected { way: Self::among_any(motion), at: at.into(), witness })
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
    CertifiedPath<M>: PlayablePath + ShortenedPath<R>,
{
    fn solve(&mut self, bounds: &Bounds) -> Result<(), NoPath> {
        let planner = self.planner.as_mut();
        if planner.problem().checker().black_box().is_some() {
            self.unproven = Some(solve_unproven(planner, bounds)?);
        } else {
            let path = solve(planner, bounds)?;
            self.path = Some(self.in_own_scene(path)?);
        }
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
        Ok(self.take()?)
    }

    fn shorten(&mut self, seed: Seed) -> bool {
        let (planner, checker) = (self.planner.as_ref(), self.planner.problem().checker());
        // in the planner's scene, whose obstacles are larger by what the path is to keep
        let shortened = planner.path().filter(|_| self.path.is_some());
        let shortened = shortened.and_then(|path| path.try_shortened(checker, seed));
        let Some(path) = shortened.and_then(|path| self.in_own_scene(path).ok()) else { return false };
        self.path = Some(path);
        true
    }

    fn step(&mut self) -> Progress {
        let before = self.planner.growth().effort();
        self.rejected_before = before.edges - before.free;
        match self.planner.step() {
            Progress::Solved => {
                self.take().map_or_else(|refused| Progress::Ended(refused.into()), |()| Progress::Solved)
            }
            progress => progress,
        }
    }

    fn drawn(&self) -> Drawn {
        let (growth, problem) = (self.planner.growth(), self.planner.problem());
        let edges = growth.edges().filter_map(|[a, b]| Some(Self::among_any(&self.planner.motion(a, b)?)));
        let first = self.motions().next().map(|motion| motion.at(0.0));
        let corners = first.into_iter().chain(self.motions().map(|motion| motion.at(1.0)));
        Drawn {
            ends: [problem.start(), problem.goal()].map(Into::into),
            edges: edges.collect(),
            path: self.motions().flat_map(Self::among_any).collect(),
            corners: corners.map(Into::into).collect(),
            rejected: if self.motions().next().is_none() { self.rejected() } else { self.hit() },
            sensed: self.planner.sensed(),
            barrier: self.planner.barrier().map(|(barrier, checker)| DrawnBarrier::new(barrier, checker)),
            rivals: Vec::new(),
        }
    }

    fn cells(&self) -> Option<&CellMap> {
        self.planner.cells()
    }

    fn barrier(&self) -> Option<(Barrier, &Checker<AnyRobot>)> {
        self.planner.barrier()
    }

    fn effort(&self) -> Effort {
        self.planner.growth().effort()
    }

    fn has_path(&self) -> bool {
        self.path.is_some() || self.unproven.is_some()
    }

    fn legs(&self) -> Vec<FileLeg> {
        let proofs = self.path.iter().flat_map(|path| path.legs()).map(|leg| leg.certificate().steps().to_vec());
        let legs = self.motions().zip(proofs.map(Some).chain(std::iter::repeat(None)));
        legs.map(|(motion, steps)| FileLeg {
            from: motion.at(0.0).coordinates().to_vec(),
            to: motion.at(1.0).coordinates().to_vec(),
            driven: motion.driven(),
            steps: steps.unwrap_or_default(),
        })
        .collect()
    }

    fn lengths(&self) -> PathLengths {
        PathLengths {
            length: self.motions().map(|motion| motion.length()).sum(),
            clearance: self.path.as_ref().map_or(0.0, CertifiedPath::clearance),
        }
    }

    fn verify(&self) -> Option<Result<f64, PathError>> {
        let kept = self.kept.as_ref().map(|(checker, _)| checker);
        let checker = kept.unwrap_or(self.planner.problem().checker());
        self.path.as_ref().map(|path| path.verify(checker.scene()))
    }

    fn judged(&self) -> Option<Result<f64, PathError>> {
        let proof = self.unproven.as_ref()?.certified(self.planner.problem().checker());
        Some(proof.map(|path| path.clearance()))
    }

    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>) {
        let growth = self.planner.growth();
        (growth.nodes().iter().map(|node| node.at.coordinates().to_vec()).collect(), growth.edges().collect())
    }

    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>> {
        self.path.as_ref().map(|path| Script::of_path(path, stage))
    }
}
