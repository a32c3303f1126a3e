//! The least set of a graph's vertices that parts some of them from others, by a greatest flow.

use std::collections::VecDeque;

/// The room of an arc that no flow fills.
const ENDLESS: u32 = u32::MAX / 2;

/// The depth of what no way reaches.
const NEVER: u32 = u32::MAX;

/// The vertices that can be reached from some through those that `passes` lets in. The first are reached in any case.
pub(super) fn flooded(beside: &[Vec<usize>], from: &[usize], passes: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut is_reached = vec![false; beside.len()];
    from.iter().for_each(|vertex| is_reached[*vertex] = true);
    let mut open: VecDeque<usize> = from.iter().copied().collect();
    while let Some(vertex) = open.pop_front() {
        for &other in &beside[vertex] {
            if !is_reached[other] && passes(other) {
                is_reached[other] = true;
                open.push_back(other);
            }
        }
    }
    is_reached
}

/// The least number of vertices, of those that can be cut, without which no way leads from any of `from` to any of
/// `to`; of several sets of that number the one nearest to `from`. In ascending order. `None` where a way leads through
/// vertices alone that can't be cut, or an end can be.
///
/// Each vertex lets one unit of a flow through where it can be cut, and any number where it can't (Menger, 1927; Ford
/// and Fulkerson, 1956), which grows by all shortest ways at once (Dinitz, 1970). When no way is left, the vertices
/// that the last search entered and could not leave are the cut. The set that it can enter is the same for every
/// greatest flow, so the result does not depend on the ways taken.
pub(super) fn vertex_cut(beside: &[Vec<usize>], can_cut: &[bool], from: &[usize], to: &[usize]) -> Option<Vec<usize>> {
    if from.iter().chain(to).any(|end| can_cut[*end]) {
        return None;
    }
    let open = flooded(beside, from, |vertex| !can_cut[vertex]);
    if to.iter().any(|end| open[*end]) {
        return None;
    }
    let mut network = FlowNetwork::of(beside, can_cut);
    loop {
        let depths = network.depths(from);
        let is_entered = |side: usize| depths[side] != NEVER;
        if to.iter().any(|end| is_entered(entry(*end))) {
            network.fill(&depths, from, to);
            continue;
        }
        let is_cut = |vertex: &usize| is_entered(entry(*vertex)) && !is_entered(exit(*vertex));
        return Some((0..beside.len()).filter(is_cut).collect());
    }
}

/// Every vertex has two sides: a flow enters it by the one and leaves it by the other.
fn entry(vertex: usize) -> usize {
    2 * vertex
}

fn exit(vertex: usize) -> usize {
    2 * vertex + 1
}

/// An arc that a flow may take; the arc back has the number that differs in the last bit.
#[derive(Clone, Copy, Debug)]
struct FlowArc {
    to: usize,
    room: u32,
}

/// What a flow leaves of the arcs between the sides of vertices.
struct FlowNetwork {
    arcs: Vec<FlowArc>,
    /// The numbers of the arcs that leave each side.
    leaving: Vec<Vec<usize>>,
}

impl FlowNetwork {
    /// The network without a flow.
    fn of(beside: &[Vec<usize>], can_cut: &[bool]) -> Self {
        let mut network = FlowNetwork { arcs: Vec::new(), leaving: vec![Vec::new(); 2 * beside.len()] };
        for (vertex, others) in beside.iter().enumerate() {
            network.add(entry(vertex), exit(vertex), if can_cut[vertex] { 1 } else { ENDLESS });
            for other in others {
                network.add(exit(vertex), entry(*other), ENDLESS);
            }
        }
        network
    }

    fn add(&mut self, from: usize, to: usize, room: u32) {
        for (from, to, room) in [(from, to, room), (to, from, 0)] {
            self.leaving[from].push(self.arcs.len());
            self.arcs.push(FlowArc { to, room });
        }
    }

    /// Over how many arcs that have room each side is reached, at least.
    fn depths(&self, from: &[usize]) -> Vec<u32> {
        let mut depths = vec![NEVER; self.leaving.len()];
        from.iter().for_each(|vertex| depths[entry(*vertex)] = 0);
        let mut open: VecDeque<usize> = from.iter().copied().map(entry).collect();
        while let Some(side) = open.pop_front() {
            for &number in &self.leaving[side] {
                let FlowArc { to, room } = self.arcs[number];
                if room > 0 && depths[to] == NEVER {
                    depths[to] = depths[side] + 1;
                    open.push_back(to);
                }
            }
        }
        depths
    }

    /// Sends a unit along shortest ways, until each of them has an arc without room.
    fn fill(&mut self, depths: &[u32], from: &[usize], to: &[usize]) {
        let mut is_end = vec![false; self.leaving.len()];
        to.iter().for_each(|vertex| is_end[entry(*vertex)] = true);
        // of the arcs that leave a side those before lead nowhere any more
        let mut next = vec![0; self.leaving.len()];
        for start in from.iter().copied().map(entry) {
            let (mut way, mut side) = (Vec::<usize>::new(), start);
            loop {
                if is_end[side] {
                    for number in way.drain(..) {
                        self.arcs[number].room -= 1;
                        self.arcs[number ^ 1].room += 1;
                    }
                    side = start;
                    continue;
                }
                if let Some(&number) = self.leaving[side].get(next[side]) {
                    let FlowArc { to, room } = self.arcs[number];
                    if room > 0 && depths[to] == depths[side] + 1 {
                        way.push(number);
                        side = to;
                    } else {
                        next[side] += 1;
                    }
                } else if let Some(number) = way.pop() {
                    side = self.arcs[number ^ 1].to;
                    next[side] += 1;
                } else {
                    break;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    /// Whether a way is left without these vertices.
    fn is_parted(beside: &[Vec<usize>], removed: &[usize], from: usize, to: usize) -> bool {
        !flooded(beside, &[from], |vertex| !removed.contains(&vertex))[to]
    }

    /// The least number of vertices that part two others, by trying every set of them.
    fn by_trying(beside: &[Vec<usize>], can_cut: &[bool]) -> Option<usize> {
        let count = beside.len();
        let sets = (0..1_u32 << count).filter(|set| (0..count).all(|i| set >> i & 1 == 0 || can_cut[i]));
        let members = |set: u32| (0..count).filter(|i| set >> i & 1 == 1).collect::<Vec<_>>();
        let parting = sets.map(members).filter(|set| is_parted(beside, set, 0, count - 1));
        parting.map(|set| set.len()).min()
    }

    #[test]
    fn no_smaller_set_parts_the_ends_of_small_graphs() {
        let mut draws = Stream::new(Seed(6), "cuts");
        let (mut cut, mut joined) = (0, 0);
        for _ in 0..300 {
            let count = 4 + draws.below(7) as usize;
            let mut beside = vec![Vec::new(); count];
            for a in 0..count {
                for b in 0..a {
                    if draws.below(5) < 2 && (a, b) != (count - 1, 0) {
                        beside[a].push(b);
                        beside[b].push(a);
                    }
                }
            }
            let can_cut: Vec<bool> = (0..count).map(|i| i > 0 && i + 1 < count && draws.below(8) > 0).collect();
            let found = vertex_cut(&beside, &can_cut, &[0], &[count - 1]);
            assert_eq!(found.as_ref().map(Vec::len), by_trying(&beside, &can_cut), "{beside:?} {can_cut:?}");
            match found {
                Some(set) => {
                    assert!(is_parted(&beside, &set, 0, count - 1) && set.iter().all(|vertex| can_cut[*vertex]));
                    cut += usize::from(set.len() > 1);
                }
                None => joined += 1,
            }
        }
        assert!(cut > 80 && joined > 20, "{cut} cuts of several vertices, {joined} without");
    }

    #[test]
    fn of_equal_cuts_the_one_nearest_to_the_start_is_taken() {
        // a line of five: any of the three in the middle parts its ends
        let line: Vec<Vec<usize>> = vec![vec![1], vec![0, 2], vec![1, 3], vec![2, 4], vec![3]];
        let can_cut = [false, true, true, true, false];
        assert_eq!(vertex_cut(&line, &can_cut, &[0], &[4]), Some(vec![1]));
        assert_eq!(vertex_cut(&line, &can_cut, &[4], &[0]), Some(vec![3]));
        assert_eq!(vertex_cut(&line, &can_cut, &[1], &[4]), None, "an end that can be cut is none");
        let mut parted = line;
        (parted[2], parted[3]) = (vec![1], vec![4]);
        assert_eq!(vertex_cut(&parted, &can_cut, &[0], &[4]), Some(vec![]), "nothing has to be taken");
    }
}
