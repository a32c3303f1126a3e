//! `NoPath`, why a planner returned no path.

use std::fmt;

use super::{Bound, Effort, PathError};
use crate::collision::ProblemError;

/// Why a planner returned no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoPath {
    /// The start or the goal is in contact, outside the robot's limits, or none of its configurations.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A bound was reached first. There may be a path.
    #[error("no path within the bound on {bound}: {effort}")]
    Exhausted {
        /// The bound.
        bound: Bound,
        /// What the planner had done by then.
        effort: Effort,
    },
    /// The planner has searched all of its finite graph, a grid or a roadmap. There may be a path beside it.
    #[error("no path in the planner's own graph of {nodes} configurations")]
    NoneInGraph {
        /// The number of the graph's nodes.
        nodes: usize,
    },
    /// The planner has cut the space into cells, and the finest decide nothing: neither do those proven free join the
    /// start to the goal, nor do those proven blocked part them. There may be a path, through gaps of about that size.
    #[error("undecided: cells of {sides} are proven neither free nor blocked")]
    Undecided {
        /// The sides of the undecided cells.
        sides: CellSides,
    },
    /// Cells that are proven free join the start to the goal, but the robot is a car, which drives no straight lines:
    /// nothing parts the two, and whether the car can drive between them, or park where it would have to, they do not
    /// say.
    #[error("undecided: {cells} cells proven free join the start to the goal, but do not say how a car drives there")]
    JoinedByCells {
        /// The number of the cells from the one end to the other.
        cells: usize,
    },
    /// No path leads to the goal, whatever the planner: configurations that are proven to be in contact part it from
    /// the start, within the scene's bounds. A [`Barrier`](crate::cspace::Barrier) is those that do, to be checked.
    #[error(
        "the goal can't be reached: {cells} cells prove that obstacles part it from the start within the world's bounds"
    )]
    Unreachable {
        /// The number of cells that were judged.
        cells: u64,
    },
    /// The planner went all the way round an obstacle, and the goal lies behind it. Whoever keeps less clearance may
    /// pass through a gap.
    #[error(
        "the goal lies behind an obstacle without a gap for one that keeps {} m from it",
        (kept * 1e6).round_ties_even() / 1e6
    )]
    Enclosed {
        /// The clearance that the planner keeps, metres.
        kept: f64,
    },
    /// The planner's robot walks by a sensor, and gave up for this reason. There may be a path.
    #[error("the robot gave up: {0}")]
    GaveUp(&'static str),
    /// The planner is stuck where nothing near is better: a local minimum of a potential.
    #[error("stuck in a local minimum at configuration {node} of its growth")]
    LocalMinimum {
        /// The number of the node.
        node: usize,
    },
    /// The planner does not work for this robot or this space.
    #[error("this planner does not work here: {0}")]
    Unsuited(&'static str),
    /// The planner said that it had solved the problem, but its path does not stand the check of
    /// [`solve`](super::solve).
    #[error("the planner's path is refused: {0}")]
    Refused(#[from] PathError),
}

/// The sides of a cell, each with its unit: `m` or `rad`. They are shown to six decimals.
#[derive(Clone, Debug, PartialEq)]
pub struct CellSides(pub Vec<(f64, &'static str)>);

impl fmt::Display for CellSides {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut sides = self.0.iter().peekable();
        while let Some((side, unit)) = sides.next() {
            write!(f, "{}", (side * 1e6).round_ties_even() / 1e6)?;
            match sides.peek() {
                // said once of sides of one unit
                Some((_, other)) if other == unit => write!(f, " by ")?,
                Some(_) => write!(f, " {unit} by ")?,
                None => write!(f, " {unit}")?,
            }
        }
        Ok(())
    }
}
