//! `Trail`, a robot after one tick, as a history keeps it.

use std::mem::size_of;

use crate::run::RobotState;
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Footprint, Pose2};

/// Displacement in one tick from which on a robot counts as put there rather than driven, metres.
const MAX_DRIVEN: f64 = 0.5;

/// A robot after one tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trail {
    /// The coordinates of its configuration.
    pub coordinates: Coordinates,
    /// Its distance from the nearest obstacle of its world, metres; 0 in contact, infinity where there is none. Among
    /// more than 100 robots it is that of the last sample.
    pub clearance: f64,
    /// Signed distance driven since the start, metres, negative for backward; 0 for an arm.
    pub travelled: f64,
    /// Distance by its wheels' encoders, the mean of both, metres; `None` without encoders. Among more than 100 robots
    /// it is that of the last sample.
    pub encoders: Option<f64>,
    /// Number of changes between forward and backward since the start.
    pub reversals: u32,
    /// Contact episodes since the start.
    pub contacts: u32,
    /// Whether a person drove it.
    pub manual: bool,
    /// Direction of its last motion: 1 forward, -1 backward, 0 before the first.
    direction: i8,
    /// Whether it is an arm, which drives no way.
    has_tip: bool,
}

/// What a robot's state does not say by itself.
pub(crate) struct Gauges {
    pub(crate) footprint: Footprint,
    /// Distance by its wheels' encoders, metres; `None` without encoders.
    pub(crate) odometer: Option<f64>,
    /// Whether it is an arm.
    pub(crate) has_tip: bool,
}

impl Trail {
    /// Goes on to the next tick's state. Clearance and encoders stay.
    pub(crate) fn follow(&mut self, state: &RobotState) {
        let pose = |q: &Coordinates| match (q.get(..3), self.has_tip) {
            (Some(&[x, y, theta]), false) => Some(Pose2 { x, y, theta }),
            _ => None,
        };
        let way = pose(&state.configuration).zip(pose(&self.coordinates)).map(|(now, last)| now.boxminus(&last).dx);
        if let Some(way) = way.filter(|d| d.abs() < MAX_DRIVEN) {
            self.travelled += way;
            // a robot held at a wall does not move, so its control is no change of direction
            if way.abs() > 1e-6 {
                let now = if way > 0.0 { 1 } else { -1 };
                self.reversals += u32::from(self.direction == -now);
                self.direction = now;
            }
        }
        self.coordinates.clone_from(&state.configuration);
        (self.contacts, self.manual) = (state.contacts, state.manual);
    }

    /// Reads the gauges. `clearance` is the footprint's distance from the obstacles, metres.
    pub(crate) fn read(&mut self, gauges: &Gauges, clearance: f64) {
        (self.clearance, self.encoders, self.has_tip) = (clearance, gauges.odometer, gauges.has_tip);
    }

    /// The memory that it takes, bytes, with what lies on the heap.
    pub(crate) fn bytes(&self) -> usize {
        // a list of up to four numbers needs no heap
        let beyond = if self.coordinates.len() > 4 { size_of_val(&self.coordinates[..]) } else { 0 };
        size_of::<Trail>() + beyond
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates are a list that keeps four numbers, a car's with its trailer, in itself.
    #[test]
    fn a_trail_takes_more_for_coordinates_beyond_four_alone() {
        let bytes = |count: usize| Trail { coordinates: (0..count).map(|_| 0.5).collect(), ..Trail::default() }.bytes();
        let own = size_of::<Trail>();
        assert_eq!([2, 4, 5, 9].map(bytes), [own, own, own + 5 * 8, own + 9 * 8]);
    }
}
