//! `EvasionSearch`, which tries all inputs of a set, some ticks of a branch at a time.

use std::collections::VecDeque;

use super::branches::Branches;
use super::{AvoidError, EvasionSet, SearchExtent};
use crate::run::{Frame, RobotInput};

/// Channels, each from its tick on.
pub(super) type DrivenChannels = Vec<(u64, [i16; 2])>;

/// The number of ticks of a branch that are run at once.
const TICKS_AT_ONCE: u32 = 8;

/// A search for channels by which a robot comes through a span of ticks without contact. It begins at the last of its
/// ticks and goes back; from each the fewest switches come first, then the order of the channels, then the earliest
/// switch.
pub(super) struct EvasionSearch {
    /// The channels, in the order in which they are tried.
    channels: Vec<[i16; 2]>,
    /// The greatest number of switches.
    switches: u32,
    /// Channels change at multiples of this many ticks.
    every: u64,
    /// The last tick that must be free.
    until: u64,
    /// The ticks that are still to be tried, the last first.
    ticks: VecDeque<u64>,
    /// The number of switches that are tried now, from the tick that is tried now.
    switching: u32,
    /// The branches under way, each one switch longer than the one before.
    stack: Vec<Prefix>,
    /// The frames after which the channels that are driven now may change; `None` between two branches.
    driven: Option<VecDeque<Frame>>,
    pub(super) extent: SearchExtent,
}

/// A branch up to a tick, and what is still to be tried from there.
struct Prefix {
    /// Its channels so far.
    before: DrivenChannels,
    /// The frame after which the next ones apply.
    frame: Frame,
    /// The number of the next channels.
    next: usize,
    /// The channels with those that were tried last.
    tried: DrivenChannels,
    /// The frames after which those may change.
    places: VecDeque<Frame>,
}

/// How a search stands.
pub(super) enum SearchState {
    /// There is more to try.
    Open,
    /// These channels come through.
    Found(DrivenChannels),
    /// None do.
    Exhausted,
}

impl EvasionSearch {
    /// A search among these channels, from these ticks, the last first.
    pub(super) fn new(channels: Vec<[i16; 2]>, set: &EvasionSet, until: u64, ticks: VecDeque<u64>) -> Self {
        let EvasionSet { switches, every, .. } = *set;
        let extent = SearchExtent { earliest: until, ..SearchExtent::default() };
        EvasionSearch {
            channels,
            switches,
            every,
            until,
            ticks,
            switching: switches,
            stack: Vec::new(),
            driven: None,
            extent,
        }
    }

    /// Goes on with the branch under way for some ticks, or begins the next.
    pub(super) fn step(&mut self, branches: &mut Branches) -> Result<SearchState, AvoidError> {
        match self.driven.take() {
            Some(places) => Ok(self.drive(branches, places)),
            None if self.next_branch(branches)? => Ok(SearchState::Open),
            None => Ok(SearchState::Exhausted),
        }
    }

    /// Drives by constant channels for some ticks.
    fn drive(&mut self, branches: &mut Branches, mut places: VecDeque<Frame>) -> SearchState {
        let may_switch = self.stack.len() as u32 <= self.switching;
        let Some(prefix) = self.stack.last_mut() else { return SearchState::Open };
        for _ in 0..TICKS_AT_ONCE {
            let (frame, robot) = branches.step();
            if robot.in_contact {
                prefix.places = places;
                return SearchState::Open;
            }
            if frame.tick >= self.until {
                return SearchState::Found(std::mem::take(&mut prefix.tried));
            }
            if may_switch && (frame.tick + 1 - self.extent.earliest).is_multiple_of(self.every) {
                places.push_back(frame.clone());
            }
        }
        self.driven = Some(places);
        SearchState::Open
    }

    /// Begins the next branch. Returns whether there is one.
    fn next_branch(&mut self, branches: &mut Branches) -> Result<bool, AvoidError> {
        loop {
            let depth = self.stack.len() as u32;
            let Some(prefix) = self.stack.last_mut() else {
                if !self.begin(branches) {
                    return Ok(false);
                }
                continue;
            };
            if let Some(frame) = prefix.places.pop_front() {
                let longer = Prefix::new(prefix.tried.clone(), frame);
                self.stack.push(longer);
                continue;
            }
            let Some(&channels) = self.channels.get(prefix.next) else {
                self.stack.pop();
                continue;
            };
            prefix.next += 1;
            if prefix.before.last().is_some_and(|(_, last)| *last == channels) {
                continue;
            }
            prefix.tried = prefix.before.clone();
            prefix.tried.push((prefix.frame.tick + 1, channels));
            // a shorter branch was counted when fewer switches were tried
            self.extent.branches += u64::from(depth == self.switching + 1);
            let [a, b] = channels;
            branches.begin(&prefix.frame)?;
            branches.input(RobotInput::Drive(a, b));
            self.driven = Some(VecDeque::new());
            return Ok(true);
        }
    }

    /// Begins with one switch more, or else at the next tick. Returns whether there is any.
    fn begin(&mut self, branches: &Branches) -> bool {
        if self.switching < self.switches {
            self.switching += 1;
        } else {
            let Some(tick) = self.ticks.pop_front() else { return false };
            (self.extent.earliest, self.switching) = (tick, 0);
        }
        let frame = self.extent.earliest.checked_sub(1).and_then(|before| branches.frame(before));
        self.stack.extend(frame.map(|frame| Prefix::new(Vec::new(), frame.clone())));
        true
    }
}

impl Prefix {
    fn new(before: DrivenChannels, frame: Frame) -> Self {
        Prefix { before, frame, next: 0, tried: Vec::new(), places: VecDeque::new() }
    }
}
