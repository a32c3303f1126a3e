//! `Bounds`, how much a planner may do, and `Effort`, what it has done.

use std::fmt;

/// What a planner has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The number of iterations.
    pub iterations: u64,
    /// The number of samples drawn.
    pub samples: u64,
    /// The number of edges and driven motions asked about, free or not; those of the final proof are not counted.
    pub edges: u64,
    /// The number of those that were proven free.
    pub free: u64,
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Effort { iterations, samples, edges, .. } = self;
        write!(f, "{iterations} iterations, {samples} samples, {edges} edges asked about")
    }
}

/// One of the bounds of a planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Iterations.
    Iterations,
    /// Samples drawn.
    Samples,
    /// Edges asked about.
    Edges,
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Bound::Iterations => "iterations",
            Bound::Samples => "samples",
            Bound::Edges => "edges",
        })
    }
}

/// How much a planner may do. The bounds are checked before each iteration, and an iteration that has begun is
/// finished: so samples and edges may exceed their bounds by those of one iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// The greatest number of iterations.
    pub iterations: u64,
    /// The greatest number of samples.
    pub samples: u64,
    /// The greatest number of edges asked about.
    pub edges: u64,
}

impl Default for Bounds {
    /// 100,000 iterations, and no other bound.
    fn default() -> Self {
        Bounds::of_iterations(100_000)
    }
}

impl Bounds {
    /// A bound on the iterations alone.
    pub const fn of_iterations(iterations: u64) -> Self {
        Bounds { iterations, samples: u64::MAX, edges: u64::MAX }
    }

    /// The first bound that this effort has reached; `None` while there is still something left of each.
    pub fn reached(&self, effort: &Effort) -> Option<Bound> {
        if effort.iterations >= self.iterations {
            Some(Bound::Iterations)
        } else if effort.samples >= self.samples {
            Some(Bound::Samples)
        } else if effort.edges >= self.edges {
            Some(Bound::Edges)
        } else {
            None
        }
    }
}
