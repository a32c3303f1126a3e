//! `Growth`, what a planner has grown so far, to be drawn and counted.

use super::Effort;
use crate::collision::{Checker, EdgeVerdict, HitBy, Witness};
use crate::robots::{ChartLine, Motion, Robot, stays_within};

/// A configuration that a planner has reached or placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node<C> {
    /// The configuration.
    pub at: C,
    /// The number of the node that it was reached from; `None` for a root, and for a roadmap's nodes.
    pub parent: Option<usize>,
}

/// A motion that was not proven free, and what it would hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejection<C> {
    /// The last configuration along the motion up to which it is proven free; its start if nothing is.
    pub free_until: C,
    /// The configuration in contact; where no contact was found, `free_until`.
    pub at: C,
    /// What it hits; `None` where no contact was found, although the motion could not be proven free.
    pub by: Option<HitBy>,
    /// The nearest points at `at`; `None` in an empty scene.
    pub witness: Option<Witness>,
}

/// What a planner has grown so far: a tree, several trees, or a roadmap. `C` is the type of its configurations, `M` of
/// the motions it asks about.
///
/// All planners ask by [`ask`](Self::ask), so window, recording and bounds see the same numbers.
#[derive(Clone, Debug)]
pub struct Growth<C, M> {
    nodes: Vec<Node<C>>,
    links: Vec<[usize; 2]>,
    rejected: Option<M>,
    effort: Effort,
}

impl<C, M> Default for Growth<C, M> {
    fn default() -> Self {
        Growth { nodes: Vec::new(), links: Vec::new(), rejected: None, effort: Effort::default() }
    }
}

impl<C: Copy, M: Motion<Configuration = C>> Growth<C, M> {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The nodes, in the order in which they were added.
    pub fn nodes(&self) -> &[Node<C>] {
        &self.nodes
    }

    /// The configuration of node number `node`.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn at(&self, node: usize) -> C {
        self.nodes[node].at
    }

    /// The edges, by the numbers of their ends: first of each node with a parent, from the parent on; then a roadmap's.
    pub fn edges(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let of_tree = self.nodes.iter().enumerate().filter_map(|(i, node)| node.parent.map(|parent| [parent, i]));
        of_tree.chain(self.links.iter().copied())
    }

    /// What the planner has done.
    pub fn effort(&self) -> Effort {
        self.effort
    }

    /// The motion that was rejected last, in the last iteration that rejected one.
    pub fn rejected(&self) -> Option<&M> {
        self.rejected.as_ref()
    }

    /// What the motion that was rejected last hits, with the witness; `None` too where it would leave the bounds and is
    /// free. It is computed when asked for, so planning
    /// does not pay for it.
    pub fn rejection<R: Robot<Configuration = C>>(&self, checker: &Checker<R>) -> Option<Rejection<C>> {
        let motion = self.rejected.as_ref()?;
        let (free, at, by) = match checker.motion_verdict(motion) {
            EdgeVerdict::Hit { free_until, contact_at, by, .. } => (free_until, contact_at, Some(by)),
            EdgeVerdict::Unresolved { free_until, .. } => (free_until, free_until, None),
            // the quick answer may reject nothing that the verdict proves free; were it so, there is nothing to show
            EdgeVerdict::Free { .. } => return None,
        };
        let at = motion.at(at);
        let witness = checker.witness(&at).ok().flatten();
        Some(Rejection { free_until: motion.at(free), at, by, witness })
    }

    /// Counts an iteration.
    pub fn begin_iteration(&mut self) {
        self.effort.iterations += 1;
    }

    /// Counts a sample.
    pub fn count_sample(&mut self) {
        self.effort.samples += 1;
    }

    /// Asks whether a motion is proven free and keeps within the scene's bounds, counts it, and keeps it if it is
    /// rejected.
    pub fn ask<R: Robot<Configuration = C>>(&mut self, checker: &Checker<R>, motion: M) -> bool {
        let bounds = checker.scene().bounds();
        let free = stays_within(checker.robot(), &motion, &bounds) && checker.motion_free(&motion);
        self.effort.edges += 1;
        self.effort.free += u64::from(free);
        if !free {
            self.rejected = Some(motion);
        }
        free
    }

    /// Adds a node without a parent and returns its number.
    pub fn add_root(&mut self, at: C) -> usize {
        self.nodes.push(Node { at, parent: None });
        self.nodes.len() - 1
    }

    /// Adds a node that was reached from node number `parent` and returns its number.
    pub fn add(&mut self, at: C, parent: usize) -> usize {
        self.nodes.push(Node { at, parent: Some(parent) });
        self.nodes.len() - 1
    }

    /// Makes `parent` the node that node number `node` is reached from.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn set_parent(&mut self, node: usize, parent: usize) {
        self.nodes[node].parent = Some(parent);
    }

    /// Adds an edge of a roadmap.
    pub fn link(&mut self, a: usize, b: usize) {
        self.links.push([a, b]);
    }

    /// The numbers of the nodes from a root to node number `node`.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn branch(&self, node: usize) -> Vec<usize> {
        let mut branch = vec![node];
        let mut at = node;
        while let Some(parent) = self.nodes[at].parent {
            branch.push(parent);
            at = parent;
        }
        branch.reverse();
        branch
    }
}

impl<R: Robot> Growth<R::Configuration, ChartLine<R>> {
    /// Asks whether the edge from `a` to `b` is proven free, as [`ask`](Self::ask). False when an end is not a
    /// configuration of the robot.
    pub fn ask_edge(&mut self, checker: &Checker<R>, a: &R::Configuration, b: &R::Configuration) -> bool {
        checker.robot().edge(a, b).is_ok_and(|edge| self.ask(checker, edge))
    }
}
