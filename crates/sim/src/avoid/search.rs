//! `EvasionSearch`, which tries all inputs of a set, a branch at a time.

use std::collections::VecDeque;

use super::branches::Branches;
use super::{AvoidError, EvasionSet, SearchExtent};
use crate::run::{Frame, RobotInput};

/// Channels, each from its tick on.
pub(super) type DrivenChannels = Vec<(u64, [i16; 2])>;

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
        EvasionSearch { channels, switches, every, until, ticks, switching: switches, stack: Vec::new(), extent }
    }

    /// Tries the next branch.
    pub(super) fn step(&mut self, branches: &mut Branches) -> Result<SearchState, AvoidError> {
        loop {
            let depth = self.stack.len() as u32;
            let Some(prefix) = self.stack.last_mut() else {
                if !self.begin(branches) {
                    return Ok(SearchState::Exhausted);
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
            self.extent.branches += 1;
            let places = (depth <= self.switching).then_some((self.extent.earliest, self.every));
            let (frame, until) = (prefix.frame.clone(), self.until);
            return match drive(branches, &frame, channels, until, places)? {
                None => Ok(SearchState::Found(std::mem::take(&mut prefix.tried))),
                Some(places) => {
                    prefix.places = places;
                    Ok(SearchState::Open)
                }
            };
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

/// Drives by constant channels after a frame. `None` where the robot comes through; else the frames before the contact
/// after which the channels may change: those `every` ticks from the first tick of the branch.
fn drive(
    branches: &mut Branches,
    start: &Frame,
    [a, b]: [i16; 2],
    until: u64,
    places: Option<(u64, u64)>,
) -> Result<Option<VecDeque<Frame>>, AvoidError> {
    branches.begin(start)?;
    branches.input(RobotInput::Drive(a, b));
    let mut kept = VecDeque::new();
    loop {
        let (frame, robot) = branches.step();
        if robot.in_contact {
            return Ok(Some(kept));
        }
        if frame.tick >= until {
            return Ok(None);
        }
        if places.is_some_and(|(first, every)| (frame.tick + 1 - first).is_multiple_of(every)) {
            kept.push_back(frame.clone());
        }
    }
}
