//! `Bug2`, which follows boundaries until it meets the line from the start to the goal.

use super::walker::{Headed, Walker, apart};
use crate::collision::Problem;
use crate::configuration::Chart;
use crate::geometry::Point2;
use crate::planning::{Growth, LinePath, NoPath, Planner, Progress};
use crate::robots::{ChartLine, Robot};

/// What the next iteration does.
#[derive(Clone, Copy, Debug)]
enum Phase {
    /// Goes along the line from the start to the goal.
    Head,
    /// Follows the boundary that it hit, which is at the right hand.
    Follow {
        hit: Point2,
        /// The number of steps since.
        steps: u64,
    },
}

/// Bug2 (Lumelsky and Stepanov, 1987) for a disc that knows where it is and feels the boundary nearest to it.
///
/// It heads for the goal along the line from the start. At an obstacle it follows the boundary, with it at the right
/// hand, until it meets that line nearer to the goal than where it hit. If it comes back to where it hit, it ends
/// without a path, [`NoPath::NoneInGraph`]: the goal lies behind the obstacle, or its steps went past a place to leave
/// from.
///
/// An iteration is one step. A robot that is not a disc gets [`NoPath::Unsuited`] from [`Bug2::try_new`].
#[derive(Clone, Debug)]
pub struct Bug2<R: Robot> {
    walker: Walker<R>,
    start: Point2,
    phase: Phase,
    end: Option<Progress>,
    path: Option<LinePath<R>>,
}

/// The number of steps along a boundary before coming back counts.
const AWAY: u64 = 8;

impl<R: Robot<Configuration: Chart>> Bug2<R> {
    /// The planner; it keeps half its radius from a boundary that it follows.
    ///
    /// # Errors
    /// [`NoPath::Unsuited`] for a robot that is not a disc.
    pub fn try_new(problem: &Problem<R>) -> Result<Self, NoPath> {
        let walker = Walker::try_new(problem).ok_or(NoPath::Unsuited("Bug2 is for robots that are discs"))?;
        let start = walker.here();
        Ok(Bug2 { walker, start, phase: Phase::Head, end: None, path: None })
    }

    fn advance(&mut self) -> Option<Progress> {
        match self.phase {
            Phase::Head => match self.walker.head() {
                Headed::Moved => None,
                Headed::Arrived => self.arrived(),
                Headed::Blocked => {
                    self.phase = Phase::Follow { hit: self.walker.here(), steps: 0 };
                    None
                }
            },
            Phase::Follow { hit, steps } => {
                if self.walker.arrive() {
                    return self.arrived();
                }
                let before = self.walker.here();
                if !self.walker.follow() {
                    return Some(Progress::Ended(NoPath::LocalMinimum { node: self.walker.node() }));
                }
                self.phase = Phase::Follow { hit, steps: steps + 1 };
                let here = self.walker.here();
                if self.meets_line(before, here)
                    && apart(here, self.walker.goal()) < apart(hit, self.walker.goal()) - self.walker.keep
                {
                    self.phase = Phase::Head;
                } else if steps > AWAY && apart(here, hit) < 1.5 * self.walker.stride() {
                    let nodes = self.walker.growth.nodes().len();
                    return Some(Progress::Ended(NoPath::NoneInGraph { nodes }));
                }
                None
            }
        }
    }

    fn arrived(&mut self) -> Option<Progress> {
        self.path = self.walker.path();
        let no_proof = Progress::Ended(NoPath::LocalMinimum { node: self.walker.node() });
        Some(if self.path.is_some() { Progress::Solved } else { no_proof })
    }

    /// Whether a step crosses the line through the start and the goal.
    fn meets_line(&self, a: Point2, b: Point2) -> bool {
        let line = self.walker.goal() - self.start;
        let side = |p: Point2| line.x * (p.y - self.start.y) - line.y * (p.x - self.start.x);
        (side(a) <= 0.0) != (side(b) <= 0.0)
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for Bug2<R> {
    fn name(&self) -> &'static str {
        "bug2"
    }

    fn problem(&self) -> &Problem<R> {
        &self.walker.problem
    }

    fn step(&mut self) -> Progress {
        if self.end.is_none() {
            self.walker.growth.begin_iteration();
            self.end = self.advance();
        }
        self.end.clone().unwrap_or(Progress::Growing)
    }

    fn growth(&self) -> &Growth<R::Configuration, ChartLine<R>> {
        &self.walker.growth
    }

    fn motion(&self, from: usize, to: usize) -> Option<ChartLine<R>> {
        self.walker.growth.line(self.walker.problem.checker().robot(), from, to)
    }

    fn path(&self) -> Option<&LinePath<R>> {
        self.path.as_ref()
    }
}
