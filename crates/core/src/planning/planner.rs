//! `Planner`, the one interface of planners, and `solve`, which runs one.

use super::{
    Bounds, CertifiedPath, Effort, Growth, NoPath, PathError, Progress, Search, Sensed, UnprovenPath, is_same,
};
use crate::collision::{Checker, Problem};
use crate::cspace::{Barrier, CellMap};
use crate::robots::{AnyRobot, ChartLine, Motion, Robot, stays_within};

/// A planner: it works on one problem, an iteration at a time, and shows what it has grown.
///
/// All that it does is a function of the problem, whose samples are seeded, and of its settings. So a window that steps
/// it, a recording and a count see the same planner. `M` is the type of motions that its paths consist of.
///
/// A planner of one's own has a name, holds a [`Search`] and says how it goes on by an iteration; the rest is given.
/// Many planners are compared as `dyn Planner<R>`.
pub trait Planner<R: Robot, M: Motion<Configuration = R::Configuration> + 'static = ChartLine<R>> {
    /// Its name, as the command line has it: `rrt-connect`.
    fn name(&self) -> &'static str;

    /// The problem, what it has grown, and what came of it.
    fn search(&self) -> &Search<R, M>;

    /// The same, to be changed.
    fn search_mut(&mut self) -> &mut Search<R, M>;

    /// Does one iteration, a bounded amount of work, while there is neither a path nor an end. It may set
    /// [`Search::path`] or [`Search::end`].
    fn advance(&mut self);

    /// Does one iteration and counts it. After a path or an end it does nothing and says the same again. A planner that
    /// improves its path has a step of its own.
    fn step(&mut self) -> Progress {
        if self.search().progress() == Progress::Growing {
            self.search_mut().growth.begin_iteration();
            self.advance();
        }
        self.search().progress()
    }

    /// The problem.
    fn problem(&self) -> &Problem<R> {
        &self.search().problem
    }

    /// What it has grown so far.
    fn growth(&self) -> &Growth<R::Configuration, M> {
        &self.search().growth
    }

    /// The best path so far.
    fn path(&self) -> Option<&CertifiedPath<M>> {
        self.search().path.as_ref()
    }

    /// The motion of an edge of its growth, to be drawn: from node number `from` to node number `to`. `None` where the
    /// growth has no such edge.
    fn motion(&self, from: usize, to: usize) -> Option<M> {
        self.search().between(from, to)
    }

    /// The cells of a plane of configurations that it has judged, to be drawn; `None` for a planner without.
    fn cells(&self) -> Option<&CellMap> {
        None
    }

    /// The blocked cells that part the start from the goal, with the robot and the scene that they are of: of a car
    /// with a trailer the car alone. `None` where the planner has none, or has not proven that there is no path.
    fn barrier(&self) -> Option<(Barrier, &Checker<AnyRobot>)> {
        None
    }

    /// What its robot sees where it is, to be drawn; `None` for a planner whose robot does not walk by a sensor.
    fn sensed(&self) -> Option<Sensed> {
        None
    }
}

/// Runs a planner until it has a path, has ended or has reached a bound.
///
/// The path is checked once more before it is returned, whoever wrote the planner: it leads from the problem's start to
/// its goal, it keeps within the scene's bounds, and the verifier accepts its certificates there. The iterations are
/// counted here too, so a planner that counts nothing is bounded as well.
///
/// # Errors
/// [`NoPath`] says why there is none. A path that a black box calls free is refused: [`solve_unproven`] returns it.
pub fn solve<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &mut (impl Planner<R, M> + ?Sized),
    bounds: &Bounds,
) -> Result<CertifiedPath<M>, NoPath> {
    work(planner, bounds)?;
    Ok(accepted(planner)?)
}

/// As [`solve`], of a planner whose checker has a [black box](crate::collision::Checker::with_black_box): its path is
/// what that calls free, and nothing of it is proven.
///
/// # Errors
/// [`NoPath`] says why there is none, or why the path is refused: it leads elsewhere, or the checker does not call it
/// free.
///
/// ```
/// use motion_lab_core::collision::ParryScene;
/// use motion_lab_core::planning::{Bounds, RrtConnect, solve_unproven};
/// use motion_lab_core::prelude::*;
/// let exact = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
/// let checker = exact.clone().with_black_box(ParryScene::of_scene(exact.scene()));
/// let problem = Problem::try_new(checker, T2::new(2.2, 0.5), T2::new(2.9, 0.5), Seed(2005))?;
/// let path = solve_unproven(&mut RrtConnect::new(problem), &Bounds::default())?;
/// assert!(path.certified(&exact).is_err()); // it leads through the post
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve_unproven<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &mut (impl Planner<R, M> + ?Sized),
    bounds: &Bounds,
) -> Result<UnprovenPath<M>, NoPath> {
    work(planner, bounds)?;
    Ok(called_free(planner)?)
}

/// Steps a planner until it says that it has a path.
fn work<R: Robot, M: Motion<Configuration = R::Configuration> + 'static>(
    planner: &mut (impl Planner<R, M> + ?Sized),
    bounds: &Bounds,
) -> Result<(), NoPath> {
    let mut steps = 0;
    loop {
        let counted = planner.growth().effort();
        let effort = Effort { iterations: counted.iterations.max(steps), ..counted };
        if let Some(bound) = bounds.reached(&effort) {
            return Err(NoPath::Exhausted { bound, effort });
        }
        steps += 1;
        match planner.step() {
            Progress::Growing => {}
            Progress::Ended(reason) => return Err(reason),
            Progress::Solved => return Ok(()),
        }
    }
}

/// The planner's path, if it stands the check of [`solve`].
///
/// # Errors
/// [`PathError`]: there is none, nothing of it is proven, it leads elsewhere, it leaves the scene's bounds, or the
/// verifier refuses it.
pub fn accepted<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &(impl Planner<R, M> + ?Sized),
) -> Result<CertifiedPath<M>, PathError> {
    let is_unproven = planner.search().unproven.is_some();
    let none = || if is_unproven { PathError::Unproven } else { PathError::Missing };
    let (path, problem) = (planner.path().ok_or_else(none)?, planner.problem());
    path.solves(problem)?;
    Ok(path.clone())
}

impl<M: Motion> CertifiedPath<M> {
    /// Checks that the path solves a problem, whoever found it: it leads from the start to the goal, its certificates
    /// stand [`verify`](Self::verify), and it keeps within the scene's bounds. Returns the proven clearance, metres.
    ///
    /// # Errors
    /// [`PathError`]: what is not so.
    pub fn solves<R: Robot<Configuration = M::Configuration>>(&self, problem: &Problem<R>) -> Result<f64, PathError> {
        if !is_same(&self.start(), &problem.start()) || !problem.is_goal(&self.goal()) {
            return Err(PathError::OtherEnds);
        }
        let clearance = self.verify(problem.checker().scene())?;
        keeps_inside(problem, self.legs().iter().map(|leg| leg.motion()))?;
        Ok(clearance)
    }
}

/// Checks that the motions of a path keep within the bounds of a problem's scene.
fn keeps_inside<'a, R: Robot, M: Motion<Configuration = R::Configuration> + 'a>(
    problem: &Problem<R>,
    mut motions: impl Iterator<Item = &'a M>,
) -> Result<(), PathError> {
    let (robot, bounds) = (problem.checker().robot(), problem.checker().scene().bounds());
    match motions.position(|motion| !stays_within(robot, motion, &bounds)) {
        Some(leg) => Err(PathError::Outside(leg)),
        None => Ok(()),
    }
}

/// The planner's path, if it stands the check of [`solve_unproven`].
///
/// # Errors
/// [`PathError`]: there is none, it leads elsewhere, it leaves the scene's bounds, or the checker calls it not free.
pub fn called_free<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &(impl Planner<R, M> + ?Sized),
) -> Result<UnprovenPath<M>, PathError> {
    let (search, problem) = (planner.search(), planner.problem());
    let motions: Vec<M> = match (&search.unproven, planner.path()) {
        (Some(path), _) => path.motions().to_vec(),
        (None, Some(path)) => path.legs().iter().map(|leg| leg.motion().clone()).collect(),
        (None, None) => return Err(PathError::Missing),
    };
    let path = UnprovenPath::try_new(problem.checker(), motions)?;
    if !is_same(&path.start(), &problem.start()) || !problem.is_goal(&path.goal()) {
        return Err(PathError::OtherEnds);
    }
    keeps_inside(problem, path.motions().iter())?;
    Ok(path)
}
