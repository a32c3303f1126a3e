//! `Queue`, the open nodes of a best-first search.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// The open nodes of a best-first search: the least cost comes first, ties go to the lowest number, so the order does
/// not depend on the order of pushing. A node may be in it several times.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    heap: BinaryHeap<Reverse<QueueEntry>>,
}

#[derive(Clone, Copy, Debug)]
struct QueueEntry {
    cost: f64,
    node: usize,
}

impl QueueEntry {
    fn order(&self, other: &Self) -> Ordering {
        self.cost.total_cmp(&other.cost).then(self.node.cmp(&other.node))
    }
}
impl PartialEq for QueueEntry {
    fn eq(&self, other: &Self) -> bool {
        self.order(other).is_eq()
    }
}
impl Eq for QueueEntry {}
impl PartialOrd for QueueEntry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for QueueEntry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.order(other)
    }
}

impl Queue {
    /// An empty queue.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a node at a cost.
    pub fn push(&mut self, cost: f64, node: usize) {
        self.heap.push(Reverse(QueueEntry { cost, node }));
    }

    /// Takes the node of least cost.
    pub fn pop(&mut self) -> Option<usize> {
        self.heap.pop().map(|Reverse(entry)| entry.node)
    }
}
