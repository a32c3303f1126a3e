//! `Planner`, the one interface of planners, and `solve`, which runs one.

use super::{Bounds, CertifiedPath, Effort, Growth, NoPath, PathError, Progress, Search, Sensed, is_same};
use crate::collision::Problem;
use crate::cspace::CellMap;
use crate::robots::{ChartLine, Motion, Robot, stays_within};

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

    /// The cells of the configuration space that it has judged, to be drawn; `None` for a planner without.
    fn cells(&self) -> Option<&CellMap> {
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
/// [`NoPath`] says why there is none.
pub fn solve<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &mut (impl Planner<R, M> + ?Sized),
    bounds: &Bounds,
) -> Result<CertifiedPath<M>, NoPath> {
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
            Progress::Solved => return Ok(accepted(planner)?),
        }
    }
}

/// The planner's path, if it stands the check of [`solve`].
///
/// # Errors
/// [`PathError`]: there is none, it leads elsewhere, it leaves the scene's bounds, or the verifier refuses it.
pub fn accepted<R: Robot, M: Motion<Configuration = R::Configuration> + Clone + 'static>(
    planner: &(impl Planner<R, M> + ?Sized),
) -> Result<CertifiedPath<M>, PathError> {
    let (path, problem) = (planner.path().ok_or(PathError::Missing)?, planner.problem());
    if !is_same(&path.start(), &problem.start()) || !problem.is_goal(&path.goal()) {
        return Err(PathError::OtherEnds);
    }
    path.verify(problem.checker().scene())?;
    let (robot, bounds) = (problem.checker().robot(), problem.checker().scene().bounds());
    if let Some(leg) = path.legs().iter().position(|leg| !stays_within(robot, leg.motion(), &bounds)) {
        return Err(PathError::Outside(leg));
    }
    Ok(path.clone())
}
