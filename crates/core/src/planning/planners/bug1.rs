//! `Bug1`, which goes all the way round an obstacle before it leaves it.

use super::walker::{Headed, SETTLE, Walker};
use crate::collision::Problem;
use crate::configuration::Chart;
use crate::planning::{NoPath, Planner, Search};
use crate::robots::Robot;

/// What the next iteration does.
#[derive(Clone, Debug)]
enum Bug1Phase {
    /// Goes straight to the goal.
    Head,
    /// Comes to the clearance that it keeps from the boundary.
    Settle { steps: usize },
    /// Follows the boundary, which is at the right hand, from this node on.
    Round { from: usize },
    /// Goes back along these nodes, the next one last.
    Return { nodes: Vec<usize> },
    /// Leaves for the goal, until it is clear of the boundary.
    Leave,
}

/// Bug1 (Lumelsky and Stepanov, 1987) for a disc that knows where it is and feels the boundary nearest to it.
///
/// It heads for the goal. At an obstacle it goes all the way round, with the boundary at the right hand, returns by the
/// shorter way to where it was nearest to the goal, and leaves for the goal. "The obstacle" is all that has no gap for
/// a disc that keeps its clearance, half its radius. If the goal then lies behind the obstacle, it keeps half as much
/// and begins again; a disc that keeps a sixteenth of its radius and finds no gap ends, [`NoPath::Enclosed`]. The lab's
/// planner `bug1-sensor` walks so by a range sensor, and keeps what it keeps.
///
/// An iteration is one step. A robot that is not a disc gets [`NoPath::Unsuited`] from [`Bug1::try_new`].
#[derive(Clone, Debug)]
pub struct Bug1<R: Robot> {
    walker: Walker<R>,
    phase: Bug1Phase,
}

impl<R: Robot<Configuration: Chart>> Bug1<R> {
    /// The planner; it keeps half its radius from a boundary that it follows, less where that leads nowhere.
    ///
    /// # Errors
    /// [`NoPath::Unsuited`] for a robot that is not a disc.
    pub fn try_new(problem: &Problem<R>) -> Result<Self, NoPath> {
        let walker = Walker::try_new(problem).ok_or(NoPath::Unsuited("Bug1 is for robots that are discs"))?;
        Ok(Bug1 { walker, phase: Bug1Phase::Head })
    }

    /// Takes a step; the reason is why there will be no path.
    fn walk(&mut self) -> Option<NoPath> {
        match std::mem::replace(&mut self.phase, Bug1Phase::Head) {
            Bug1Phase::Leave => match self.walker.leave() {
                Headed::Moved => {
                    self.phase = if self.walker.is_clear() { Bug1Phase::Head } else { Bug1Phase::Leave };
                    None
                }
                Headed::Arrived => self.walker.arrived(),
                Headed::Blocked => self.walker.keep_half(),
            },
            Bug1Phase::Head => match self.walker.head() {
                Headed::Moved => None,
                Headed::Arrived => self.walker.arrived(),
                Headed::Blocked => {
                    self.phase = Bug1Phase::Settle { steps: 0 };
                    None
                }
            },
            Bug1Phase::Settle { steps } => {
                let node = self.walker.node();
                self.phase = if steps < SETTLE {
                    Bug1Phase::Settle { steps: steps + 1 }
                } else {
                    Bug1Phase::Round { from: node }
                };
                self.follow()
            }
            Bug1Phase::Round { from } => {
                let node = self.walker.node();
                if self.walker.is_back(from) {
                    self.phase = Bug1Phase::Return { nodes: self.walker.way_back(from, node) };
                    return None;
                }
                self.phase = Bug1Phase::Round { from: self.walker.beginning(from) };
                self.follow()
            }
            Bug1Phase::Return { mut nodes } => match nodes.pop() {
                None => {
                    self.phase = Bug1Phase::Leave;
                    None
                }
                Some(next) => {
                    let to = self.walker.search.at(next);
                    self.phase = Bug1Phase::Return { nodes };
                    if self.walker.go(to) { None } else { Some(self.walker.stuck()) }
                }
            },
        }
    }

    /// A step along the boundary, or the goal if that is near.
    fn follow(&mut self) -> Option<NoPath> {
        if self.walker.arrive() {
            return self.walker.arrived();
        }
        if self.walker.follow() { None } else { Some(self.walker.stuck()) }
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for Bug1<R> {
    fn name(&self) -> &'static str {
        "bug1"
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
