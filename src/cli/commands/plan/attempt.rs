//! `Attempt`, a planner at work on its problem, whatever the robot.

use motion_lab::collision::{ProvenStep, Witness};
use motion_lab::configuration::{AnyConfiguration, Configuration, Coordinates, HitchCfg, R2, T2, Tn};
use motion_lab::cspace::CellMap;
use motion_lab::geometry::{Footprint, Point2};
use motion_lab::planning::{Bounds, CertifiedPath, Effort, NoPath, Planner, Progress, solve};
use motion_lab::robots::{AnyRobot, ChartLine, Hitch, HitchArc, Motion, Reach, Robot, RustyDisc};
use motion_lab::run::Script;
use motion_lab::simulation::{PlayError, PlayStage, PlayablePath, PlayedPath};

/// The number of straight pieces in which a driven motion is drawn.
const DRAWN: u32 = 6;

/// A robot that paths are planned for.
pub trait Planned: Robot {
    /// The point that stands for the robot: a disc's centre, an arm's tip, a car's rear axle.
    fn reference(&self, q: &Self::Configuration) -> Point2;
}

impl Planned for RustyDisc {
    fn reference(&self, q: &R2) -> Point2 {
        q.0
    }
}

impl Planned for Reach<2> {
    fn reference(&self, q: &T2) -> Point2 {
        self.tip(q)
    }
}

impl Planned for Reach<3> {
    fn reference(&self, q: &Tn<3>) -> Point2 {
        self.tip(q)
    }
}

impl Planned for AnyRobot {
    fn reference(&self, q: &AnyConfiguration) -> Point2 {
        AnyRobot::reference(self, q)
    }
}

impl Planned for Hitch {
    fn reference(&self, q: &HitchCfg) -> Point2 {
        q.body.position()
    }
}

/// What drives a leg of a path: a speed, a steering angle and a time; nothing for the chart's straight lines.
#[derive(Clone, Copy, Debug)]
pub struct Driven {
    /// Metres per second.
    pub v: f64,
    /// Radians.
    pub phi: f64,
    /// Seconds.
    pub seconds: f64,
}

/// A motion that a path may consist of.
pub trait LegMotion: Motion + Clone {
    /// What drives it.
    fn driven(&self) -> Option<Driven>;

    /// Its length: metres driven, or the length of the line in the chart.
    fn length(&self) -> f64;

    /// In how many pieces it is drawn.
    fn pieces(&self) -> u32;
}

impl<R: Robot> LegMotion for ChartLine<R> {
    fn driven(&self) -> Option<Driven> {
        None
    }

    fn length(&self) -> f64 {
        let d = self.at(0.0).difference(&self.at(1.0));
        d.map_or(0.0, |d| motion_lab::num::sqrt(d.iter().map(|x| x * x).sum()))
    }

    fn pieces(&self) -> u32 {
        // a line of the chart is none of the workspace where joints turn
        if self.disc_line().is_some() { 1 } else { DRAWN }
    }
}

impl LegMotion for HitchArc {
    fn driven(&self) -> Option<Driven> {
        let control = self.control();
        Some(Driven { v: control.v, phi: control.phi, seconds: self.seconds() })
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
pub struct Leg {
    /// Where it begins.
    pub from: Vec<f64>,
    /// Where it ends.
    pub to: Vec<f64>,
    /// What drives it.
    pub driven: Option<Driven>,
    /// The steps that prove it free.
    pub steps: Vec<ProvenStep>,
}

/// A motion that was rejected, to be drawn.
#[derive(Clone, Debug)]
pub struct Rejected {
    /// The way of the robot's reference point along it.
    pub way: Vec<Point2>,
    /// Its coordinates along the way.
    pub line: Vec<Coordinates>,
    /// The robot in contact, or where the proof ends.
    pub at: Footprint,
    /// The nearest points there.
    pub witness: Option<Witness>,
}

/// A planner at work.
pub trait Attempt {
    /// Works until there is a path.
    fn solve(&mut self, bounds: &Bounds) -> Result<(), NoPath>;

    /// Does one iteration. Returns whether there are more to do.
    fn step(&mut self) -> bool;

    /// What the planner has done.
    fn effort(&self) -> Effort;

    /// The path's legs; none without a path.
    fn legs(&self) -> Vec<Leg>;

    /// The path's length, metres driven or by the chart's coordinates.
    fn length(&self) -> f64;

    /// The clearance proven along the path, metres.
    fn clearance(&self) -> f64;

    /// What the planner has grown: the nodes' coordinates, and the edges by the numbers of their ends.
    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>);

    /// The way of the robot's reference point along each edge of the growth.
    fn ways(&self) -> Vec<Vec<Point2>>;

    /// The coordinates along each edge of the growth.
    fn lines(&self) -> Vec<Vec<Coordinates>>;

    /// The coordinates along the path.
    fn line(&self) -> Vec<Coordinates>;

    /// The coordinates of the start and the goal.
    fn end_coordinates(&self) -> [Coordinates; 2];

    /// The motion that was rejected last.
    fn rejected(&self) -> Option<Rejected>;

    /// The cells of the configuration space that the planner has judged, if it judges any.
    fn cells(&self) -> Option<&CellMap>;

    /// The way of the robot's reference point along the path.
    fn way(&self) -> Vec<Point2>;

    /// The robot at the ends of some of the path's legs, the start and the goal among them.
    fn places(&self) -> Vec<Footprint>;

    /// The robot at the start and at the goal.
    fn ends(&self) -> [Footprint; 2];

    /// The script that plays the path; `None` without a path.
    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>>;
}

/// A planner of one robot at work.
pub struct Trial<R: Robot, M> {
    planner: Box<dyn Planner<R, M>>,
    path: Option<CertifiedPath<M>>,
}

impl<R: Robot, M> Trial<R, M> {
    /// The planner before its first iteration.
    pub fn new(planner: Box<dyn Planner<R, M>>) -> Self {
        Trial { planner, path: None }
    }
}

impl<R: Planned, M: LegMotion<Configuration = R::Configuration>> Trial<R, M> {
    fn drawn(&self, motion: &M) -> Vec<Point2> {
        let (robot, pieces) = (self.planner.problem().checker().robot(), motion.pieces());
        (0..=pieces).map(|i| robot.reference(&motion.at(f64::from(i) / f64::from(pieces)))).collect()
    }

    /// The coordinates along a motion: both ends of the chart's lines, which are straight.
    fn charted(motion: &M) -> Vec<Coordinates> {
        let pieces = if motion.driven().is_some() { DRAWN } else { 1 };
        (0..=pieces).map(|i| motion.at(f64::from(i) / f64::from(pieces)).coordinates()).collect()
    }

    fn motions(&self) -> impl Iterator<Item = M> + '_ {
        self.planner.growth().edges().filter_map(|[a, b]| self.planner.motion(a, b))
    }
}

impl<R: Planned, M: LegMotion<Configuration = R::Configuration>> Attempt for Trial<R, M>
where
    CertifiedPath<M>: PlayablePath,
{
    fn solve(&mut self, bounds: &Bounds) -> Result<(), NoPath> {
        self.path = Some(solve(self.planner.as_mut(), bounds)?);
        Ok(())
    }

    fn step(&mut self) -> bool {
        let is_growing = self.planner.step() == Progress::Growing;
        if !is_growing {
            self.path = self.planner.path().cloned();
        }
        is_growing
    }

    fn effort(&self) -> Effort {
        self.planner.growth().effort()
    }

    fn legs(&self) -> Vec<Leg> {
        let legs = self.path.iter().flat_map(|path| path.legs());
        legs.map(|leg| Leg {
            from: leg.motion().at(0.0).coordinates().to_vec(),
            to: leg.motion().at(1.0).coordinates().to_vec(),
            driven: leg.motion().driven(),
            steps: leg.certificate().steps().to_vec(),
        })
        .collect()
    }

    fn length(&self) -> f64 {
        self.path.iter().flat_map(|path| path.legs()).map(|leg| leg.motion().length()).sum()
    }

    fn clearance(&self) -> f64 {
        self.path.as_ref().map_or(0.0, CertifiedPath::clearance)
    }

    fn growth(&self) -> (Vec<Vec<f64>>, Vec<[usize; 2]>) {
        let growth = self.planner.growth();
        (growth.nodes().iter().map(|node| node.at.coordinates().to_vec()).collect(), growth.edges().collect())
    }

    fn ways(&self) -> Vec<Vec<Point2>> {
        self.motions().map(|motion| self.drawn(&motion)).collect()
    }

    fn lines(&self) -> Vec<Vec<Coordinates>> {
        self.motions().map(|motion| Self::charted(&motion)).collect()
    }

    fn line(&self) -> Vec<Coordinates> {
        self.path.iter().flat_map(|path| path.legs()).flat_map(|leg| Self::charted(leg.motion())).collect()
    }

    fn end_coordinates(&self) -> [Coordinates; 2] {
        let problem = self.planner.problem();
        [problem.start().in_chart().coordinates(), problem.goal().in_chart().coordinates()]
    }

    fn rejected(&self) -> Option<Rejected> {
        let (growth, checker) = (self.planner.growth(), self.planner.problem().checker());
        let (motion, rejection) = (growth.rejected()?, growth.rejection(checker)?);
        let at = checker.robot().footprint(&rejection.at);
        Some(Rejected { way: self.drawn(motion), line: Self::charted(motion), at, witness: rejection.witness })
    }

    fn cells(&self) -> Option<&CellMap> {
        self.planner.cells()
    }

    fn way(&self) -> Vec<Point2> {
        self.path.iter().flat_map(|path| path.legs()).flat_map(|leg| self.drawn(leg.motion())).collect()
    }

    fn places(&self) -> Vec<Footprint> {
        let Some(path) = &self.path else { return Vec::new() };
        let (robot, corners) = (self.planner.problem().checker().robot(), path.corners());
        let every = corners.len().div_ceil(14);
        corners.iter().step_by(every.max(1)).map(|q| robot.footprint(q)).collect()
    }

    fn ends(&self) -> [Footprint; 2] {
        let problem = self.planner.problem();
        [problem.start(), problem.goal()].map(|q| problem.checker().robot().footprint(&q))
    }

    fn play(&self, stage: &PlayStage<'_>) -> Option<Result<PlayedPath, PlayError>> {
        self.path.as_ref().map(|path| Script::of_path(path, stage))
    }
}
