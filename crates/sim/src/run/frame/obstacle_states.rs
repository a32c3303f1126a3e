//! `ObstacleStates`, the obstacles of a frame that are not as at the start. Frames share what is the same in them.

use std::fmt;
use std::sync::Arc;

use motion_lab_core::geometry::Pose2;

/// An obstacle or a door that is not as it was at the start of the run: added, moved, taken away, opened or closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleState {
    /// The number of its world in the run's configuration, from 0.
    pub world: u32,
    /// Its number in the world, from 0: the obstacles in file order, the doors in file order, then what the script adds
    /// to the world, in the script's order.
    pub obstacle: u32,
    /// Whether it is there; a closed door is, an open one is not.
    pub present: bool,
    /// The rigid motion from where it was at first to where it is, metres and radians.
    pub pose: Pose2,
}

impl ObstacleState {
    /// Its world and its number, by which a frame orders them.
    pub(crate) fn key(&self) -> (u32, u32) {
        (self.world, self.obstacle)
    }

    /// Whether two states are the same to the bit.
    fn is_bit_equal(&self, other: &ObstacleState) -> bool {
        let bits = |p: &Pose2| [p.x, p.y, p.theta].map(f64::to_bits);
        self.key() == other.key() && self.present == other.present && bits(&self.pose) == bits(&other.pose)
    }
}

/// The most states of a block.
const MAX_BLOCK: usize = 64;

/// The obstacles and doors that are not as at the start, by ascending world, then number.
///
/// They lie in blocks that copies share until one of them changes. The frames of a run with many obstacles added or
/// moved thus take the memory of what changed from tick to tick, and a pointer for every block.
#[derive(Clone, Default)]
pub struct ObstacleStates {
    /// None of them is empty.
    blocks: Vec<Arc<Vec<ObstacleState>>>,
}

/// An obstacle whose state differs between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ObstacleDifference {
    /// Its world and its number.
    pub(crate) key: (u32, u32),
    /// Its state in the later frame; `None` where it is as at the start.
    pub(crate) after: Option<ObstacleState>,
}

impl ObstacleStates {
    /// None: all obstacles are as at the start.
    pub fn new() -> Self {
        Self::default()
    }

    /// The states in order.
    pub fn iter(&self) -> impl Iterator<Item = &ObstacleState> + Clone {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// The last state.
    pub fn last(&self) -> Option<&ObstacleState> {
        self.blocks.last()?.last()
    }

    /// How many obstacles are not as at the start.
    pub fn len(&self) -> usize {
        self.blocks.iter().map(|block| block.len()).sum()
    }

    /// Whether all obstacles are as at the start.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Forgets all states.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }

    /// Appends a state, whose place is behind all others.
    pub fn push(&mut self, state: ObstacleState) {
        match self.blocks.last_mut() {
            Some(last) if last.len() < MAX_BLOCK => Arc::make_mut(last).push(state),
            _ => self.blocks.push(Arc::new(vec![state])),
        }
    }

    /// Appends all states of a list, whose places are behind all others. Both share them from now on.
    pub(crate) fn append(&mut self, states: &ObstacleStates) {
        self.blocks.extend_from_slice(&states.blocks);
    }

    /// The number of the block in which a key is or would be, and its place there.
    fn place_of(&self, key: (u32, u32)) -> (usize, Result<usize, usize>) {
        let after = self.blocks.partition_point(|block| block.first().is_some_and(|first| first.key() <= key));
        let number = after.saturating_sub(1);
        let search = |block: &Arc<Vec<ObstacleState>>| block.binary_search_by_key(&key, ObstacleState::key);
        (number, self.blocks.get(number).map_or(Err(0), search))
    }

    /// The state of an obstacle; `None` where it is as at the start.
    pub(crate) fn get(&self, key: (u32, u32)) -> Option<&ObstacleState> {
        let (number, place) = self.place_of(key);
        self.blocks.get(number)?.get(place.ok()?)
    }

    /// Puts a state in its place, for the one that the obstacle had.
    pub(crate) fn set(&mut self, state: ObstacleState) {
        let (number, place) = self.place_of(state.key());
        let Some(block) = self.blocks.get_mut(number) else { return self.push(state) };
        match place {
            Ok(at) => Arc::make_mut(block)[at] = state,
            Err(at) if block.len() < MAX_BLOCK => Arc::make_mut(block).insert(at, state),
            Err(MAX_BLOCK) => self.blocks.insert(number + 1, Arc::new(vec![state])),
            Err(at) => {
                let block = Arc::make_mut(block);
                let later = block.split_off(at);
                block.push(state);
                self.blocks.insert(number + 1, Arc::new(later));
            }
        }
    }

    /// Takes the state of an obstacle away, which is as at the start.
    pub(crate) fn remove(&mut self, key: (u32, u32)) {
        let (number, Ok(at)) = self.place_of(key) else { return };
        if self.blocks[number].len() == 1 {
            self.blocks.remove(number);
        } else {
            Arc::make_mut(&mut self.blocks[number]).remove(at);
        }
    }

    /// Takes the states away of what is not before a world and number.
    pub(crate) fn truncate_before(&mut self, key: (u32, u32)) {
        while let Some(last) = self.last().filter(|last| last.key() >= key) {
            let last = last.key();
            self.remove(last);
        }
    }

    /// Makes the states those of an earlier list with these differences.
    pub(crate) fn change(&mut self, difference: ObstacleDifference) {
        match difference.after {
            Some(state) => self.set(state),
            None => self.remove(difference.key),
        }
    }

    /// The states that differ in a bit from those of an earlier frame, in order. What both share is passed over block
    /// by block. Both have to be in order.
    pub(crate) fn since(&self, before: &ObstacleStates) -> Vec<ObstacleDifference> {
        let (mut old, mut new) = (StateCursor::at_start(before), StateCursor::at_start(self));
        let mut differing = Vec::new();
        loop {
            while old.skip_shared(&mut new) {}
            let (was, is) = (old.state(), new.state());
            let order = match (was, is) {
                (None, None) => return differing,
                (Some(_), None) => std::cmp::Ordering::Less,
                (None, Some(_)) => std::cmp::Ordering::Greater,
                (Some(was), Some(is)) => was.key().cmp(&is.key()),
            };
            let is_same = was.zip(is).is_some_and(|(was, is)| was.is_bit_equal(is));
            let difference = match (was, is) {
                (Some(was), _) if order.is_lt() => Some(ObstacleDifference { key: was.key(), after: None }),
                (_, Some(is)) if !is_same => Some(ObstacleDifference { key: is.key(), after: Some(*is) }),
                _ => None,
            };
            differing.extend(difference);
            if order.is_le() {
                old.go_on();
            }
            if order.is_ge() {
                new.go_on();
            }
        }
    }

    /// The same states, which share with an earlier list in order what is in both. Without an order they share nothing.
    pub(crate) fn sharing(self, before: &ObstacleStates) -> Self {
        if !self.are_in_order() {
            return self;
        }
        let mut shared = before.clone();
        self.since(before).into_iter().for_each(|difference| shared.change(difference));
        shared
    }

    /// Whether the states are by ascending world, then number, each once.
    pub(crate) fn are_in_order(&self) -> bool {
        self.iter().is_sorted_by(|a, b| a.key() < b.key())
    }

    /// The memory that the states take beyond what they share with those of the frame before, bytes.
    pub(crate) fn bytes_beyond(&self, before: &ObstacleStates) -> usize {
        let mut known = before.blocks.iter().peekable();
        let mut bytes = size_of_val(&self.blocks[..]);
        for block in &self.blocks {
            let first = |block: &Arc<Vec<ObstacleState>>| block.first().map(ObstacleState::key);
            while known.next_if(|old| !Arc::ptr_eq(old, block) && first(old) < first(block)).is_some() {}
            if known.next_if(|old| Arc::ptr_eq(old, block)).is_none() {
                bytes += block.capacity() * size_of::<ObstacleState>();
            }
        }
        bytes
    }
}

/// A place among states.
struct StateCursor<'a> {
    blocks: &'a [Arc<Vec<ObstacleState>>],
    within: usize,
}

impl<'a> StateCursor<'a> {
    fn at_start(states: &'a ObstacleStates) -> Self {
        StateCursor { blocks: &states.blocks, within: 0 }
    }

    fn state(&self) -> Option<&'a ObstacleState> {
        self.blocks.first()?.get(self.within)
    }

    fn go_on(&mut self) {
        self.within += 1;
        if self.blocks.first().is_some_and(|block| block.len() == self.within) {
            *self = StateCursor { blocks: &self.blocks[1..], within: 0 };
        }
    }

    /// Passes over a block that both have. False where they do not stand before one.
    fn skip_shared(&mut self, other: &mut Self) -> bool {
        match (self.blocks, other.blocks) {
            ([a, mine @ ..], [b, others @ ..]) if (self.within, other.within) == (0, 0) && Arc::ptr_eq(a, b) => {
                (self.blocks, other.blocks) = (mine, others);
                true
            }
            _ => false,
        }
    }
}

impl FromIterator<ObstacleState> for ObstacleStates {
    fn from_iter<I: IntoIterator<Item = ObstacleState>>(states: I) -> Self {
        let mut all = ObstacleStates::new();
        states.into_iter().for_each(|state| all.push(state));
        all
    }
}

impl PartialEq for ObstacleStates {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl PartialEq<[ObstacleState]> for ObstacleStates {
    fn eq(&self, other: &[ObstacleState]) -> bool {
        self.iter().eq(other)
    }
}

impl<const N: usize> PartialEq<[ObstacleState; N]> for ObstacleStates {
    fn eq(&self, other: &[ObstacleState; N]) -> bool {
        self.iter().eq(other)
    }
}

impl fmt::Debug for ObstacleStates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests;
