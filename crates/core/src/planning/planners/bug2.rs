//! `Bug2`, which follows boundaries until it meets the line to the goal.

use super::walker::{Headed, SETTLE, Walker, apart};
use crate::collision::Problem;
use crate::configuration::Chart;
use crate::geometry::Point2;
use crate::planning::{NoPath, Planner, Search};
use crate::robots::Robot;

/// What the next iteration does.
#[derive(Clone, Debug)]
enum Bug2Phase {
    /// Goes straight to the goal.
    Head,
    /// Follows the boundary that it hit, which is at the right hand.
    Follow {
        /// Where it hit.
        hit: Point2,
        steps: usize,
        /// The node from which on it goes round, once it has come to the clearance that it keeps.
        from: Option<usize>,
    },
    /// Goes back along these nodes, the next one last.
    Return { nodes: Vec<usize> },
    /// Leaves for the goal, until it is clear of the boundary.
    Leave,
}

/// Bug2 (Lumelsky and Stepanov, 1987) for a disc that knows where it is and feels the boundary nearest to it.
///
/// It heads for the goal along the line from the start. At an obstacle it follows the boundary, with it at the right
/// hand, until it meets that line nearer to the goal than where it hit.
///
/// It walks in steps, which may go past a place to leave from: where a boundary crosses the line twice within a step,
/// or is left by less than the clearance that it keeps. Bug2 alone would end there without a path. So if it comes all
/// the way round, it does as [`Bug1`](super::Bug1): it returns to where it was nearest to the goal, leaves there, and
/// takes the line from there on. "The obstacle" is all that has no gap for a disc that keeps its clearance, half its
/// radius. Where the goal lies behind the obstacle even there, it keeps half as much and begins again. Only a disc that
/// keeps a sixteenth of its radius and finds no gap ends, [`NoPath::Enclosed`]. So it finds a path wherever Bug1 finds
/// one, which is wherever there is one of that clearance, and where Bug2 finds one by its own rule, that one.
///
/// An iteration is one step. A robot that is not a disc gets [`NoPath::Unsuited`] from [`Bug2::try_new`].
#[derive(Clone, Debug)]
pub struct Bug2<R: Robot> {
    walker: Walker<R>,
    /// Where the line to the goal begins.
    start: Point2,
    phase: Bug2Phase,
}

impl<R: Robot<Configuration: Chart>> Bug2<R> {
    /// The planner; it keeps half its radius from a boundary that it follows, less where that leads nowhere.
    ///
    /// # Errors
    /// [`NoPath::Unsuited`] for a robot that is not a disc.
    pub fn try_new(problem: &Problem<R>) -> Result<Self, NoPath> {
        let walker = Walker::try_new(problem).ok_or(NoPath::Unsuited("Bug2 is for robots that are discs"))?;
        let start = walker.here();
        Ok(Bug2 { walker, start, phase: Bug2Phase::Head })
    }

    /// Takes a step; the reason is why there will be no path.
    fn walk(&mut self) -> Option<NoPath> {
        match std::mem::replace(&mut self.phase, Bug2Phase::Head) {
            Bug2Phase::Head => match self.walker.head() {
                Headed::Moved => None,
                Headed::Arrived => self.walker.arrived(),
                Headed::Blocked => {
                    self.phase = Bug2Phase::Follow { hit: self.walker.here(), steps: 0, from: None };
                    None
                }
            },
            Bug2Phase::Follow { hit, steps, from } => self.follow(hit, steps, from),
            Bug2Phase::Return { mut nodes } => match nodes.pop() {
                None => {
                    self.start = self.walker.here();
                    self.phase = Bug2Phase::Leave;
                    None
                }
                Some(next) => {
                    let to = self.walker.search.at(next);
                    self.phase = Bug2Phase::Return { nodes };
                    if self.walker.go(to) { None } else { Some(self.walker.stuck()) }
                }
            },
            Bug2Phase::Leave => match self.walker.leave() {
                Headed::Moved => {
                    self.phase = if self.walker.is_clear() { Bug2Phase::Head } else { Bug2Phase::Leave };
                    None
                }
                Headed::Arrived => self.walker.arrived(),
                Headed::Blocked => self.walker.keep_half(),
            },
        }
    }

    /// A step along the boundary, or the goal if that is near.
    fn follow(&mut self, hit: Point2, steps: usize, from: Option<usize>) -> Option<NoPath> {
        if self.walker.arrive() {
            return self.walker.arrived();
        }
        let before = self.walker.here();
        if !self.walker.follow() {
            return Some(self.walker.stuck());
        }
        let (here, goal) = (self.walker.here(), self.walker.goal());
        if self.meets_line(before, here) && apart(here, goal) < apart(hit, goal) - self.walker.keep {
            return None;
        }
        let from = from.or_else(|| (steps >= SETTLE).then(|| self.walker.node()));
        self.phase = match from.filter(|from| self.walker.is_back(*from)) {
            Some(from) => Bug2Phase::Return { nodes: self.walker.way_back(from, self.walker.node()) },
            None => {
                let from = from.map(|from| self.walker.beginning(from));
                Bug2Phase::Follow { hit, steps: steps + 1, from }
            }
        };
        None
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

    fn search(&self) -> &Search<R> {
        &self.walker.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.walker.search
    }

    fn advance(&mut self) {
        self.walker.search.end = self.walk();
    }
}
