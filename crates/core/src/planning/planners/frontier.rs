//! `Frontier`, the costs and the open nodes of a best-first search.

use crate::planning::Queue;

/// The costs of a best-first search's nodes, which are numbered from 0 in the order in which they were reached, and
/// those that are not closed yet.
#[derive(Clone, Debug, Default)]
pub(super) struct Frontier {
    /// The cost of the shortest way known to each node.
    costs: Vec<f64>,
    is_closed: Vec<bool>,
    /// A node that was reached by a shorter way since it was opened is in it twice.
    open: Queue,
}

impl Frontier {
    /// Opens the next node, which a way of this cost reaches; `rest` is the least that the rest of the way costs.
    pub(super) fn add(&mut self, cost: f64, rest: f64) {
        self.costs.push(cost);
        self.is_closed.push(false);
        self.open.push(cost + rest, self.costs.len() - 1);
    }

    /// A way of this lower cost reaches a node that is open.
    pub(super) fn improve(&mut self, node: usize, cost: f64, rest: f64) {
        self.costs[node] = cost;
        self.open.push(cost + rest, node);
    }

    /// The cost of the shortest way known to a node.
    pub(super) fn cost(&self, node: usize) -> f64 {
        self.costs[node]
    }

    /// Whether a way of this cost is of use: to a node that was not reached, or shorter to one that is open.
    pub(super) fn is_of_use(&self, node: Option<usize>, cost: f64) -> bool {
        node.is_none_or(|node| !self.is_closed[node] && cost < self.costs[node])
    }

    /// Closes the open node of least cost, its own and the rest's.
    pub(super) fn close_next(&mut self) -> Option<usize> {
        loop {
            let node = self.open.pop()?;
            if !self.is_closed[node] {
                self.is_closed[node] = true;
                return Some(node);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_close_once_by_their_least_cost() {
        let mut frontier = Frontier::default();
        for (cost, rest) in [(0.0, 5.0), (4.0, 3.0), (1.0, 5.0)] {
            frontier.add(cost, rest);
        }
        assert_eq!(frontier.close_next(), Some(0));
        assert!(!frontier.is_of_use(Some(0), -1.0), "closed");
        assert!(frontier.is_of_use(None, 9.0) && frontier.is_of_use(Some(1), 3.0) && !frontier.is_of_use(Some(1), 4.0));
        // before the other, whose whole way costs 6; it was in the queue with 7
        frontier.improve(1, 2.5, 3.0);
        assert_eq!(frontier.cost(1), 2.5);
        let rest = [frontier.close_next(), frontier.close_next(), frontier.close_next()];
        assert_eq!(rest, [Some(1), Some(2), None]);
    }
}
