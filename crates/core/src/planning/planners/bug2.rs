//! `Bug2`, which follows boundaries until it meets the line from the start to the goal.

use super::walker::{Headed, Walker, apart};
use crate::collision::Problem;
use crate::configuration::Chart;
use crate::geometry::Point2;
use crate::planning::{NoPath, Planner, Search};
use crate::robots::Robot;

/// What the next iteration does.
#[derive(Clone, Copy, Debug)]
enum Bug2Phase {
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
    phase: Bug2Phase,
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
        Ok(Bug2 { walker, start, phase: Bug2Phase::Head })
    }

    /// Takes a step; the reason is why there will be no path.
    fn walk(&mut self) -> Option<NoPath> {
        match self.phase {
            Bug2Phase::Head => match self.walker.head() {
                Headed::Moved => None,
                Headed::Arrived => self.walker.arrived(),
                Headed::Blocked => {
                    self.phase = Bug2Phase::Follow { hit: self.walker.here(), steps: 0 };
                    None
                }
            },
            Bug2Phase::Follow { hit, steps } => {
                if self.walker.arrive() {
                    return self.walker.arrived();
                }
                let before = self.walker.here();
                if !self.walker.follow() {
                    return Some(self.walker.stuck());
                }
                self.phase = Bug2Phase::Follow { hit, steps: steps + 1 };
                let here = self.walker.here();
                if self.meets_line(before, here)
                    && apart(here, self.walker.goal()) < apart(hit, self.walker.goal()) - self.walker.keep
                {
                    self.phase = Bug2Phase::Head;
                } else if steps > AWAY && apart(here, hit) < 1.5 * self.walker.stride() {
                    let nodes = self.walker.search.growth.nodes().len();
                    return Some(NoPath::NoneInGraph { nodes });
                }
                None
            }
        }
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
