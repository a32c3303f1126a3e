//! `Drawn`, what there is to draw of a plan.

use motion_lab_core::collision::{Checker, Witness};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{Barrier, BarrierCell};
use motion_lab_core::geometry::Placed;
use motion_lab_core::planning::Sensed;
use motion_lab_core::robots::AnyRobot;

/// What there is to draw of a plan, whoever made it: a planner at work, or a file. Motions are lists of configurations
/// along them, so close together that a chart line between two of them is the motion as far as one can see.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The start and the goal.
    pub ends: [AnyConfiguration; 2],
    /// The edges of the tree or the roadmap.
    pub edges: Vec<Vec<AnyConfiguration>>,
    /// The path, from the start on; empty without one.
    pub path: Vec<AnyConfiguration>,
    /// The path's start and the ends of its legs; empty without a path.
    pub corners: Vec<AnyConfiguration>,
    /// The motion that was rejected in the last iteration, if one was.
    pub rejected: Option<Rejected>,
    /// What a robot that walks by its sensor sees where it is.
    pub sensed: Option<Sensed>,
    /// What parts the start from the goal, where that is proven.
    pub barrier: Option<DrawnBarrier>,
    /// The paths of the other planners of a race, in the order of its table; empty of one that has none yet.
    pub rivals: Vec<Vec<AnyConfiguration>>,
}

/// The proof that there is no path, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnBarrier {
    /// The cells that part the ends.
    pub cells: Vec<BarrierCell>,
    /// The shapes of the obstacles that the cells name.
    pub shapes: Vec<Placed>,
}

impl DrawnBarrier {
    /// The barrier of a robot in its scene.
    pub fn new(barrier: Barrier, checker: &Checker<AnyRobot>) -> Self {
        let is_named = |id| barrier.cells.iter().any(|cell| cell.blocking.obstacle == id);
        let named = checker.scene().pieces().filter(|(id, _)| is_named(*id));
        let shapes = named.map(|(_, shape)| shape.clone()).collect();
        DrawnBarrier { cells: barrier.cells, shapes }
    }
}

/// A motion that was rejected, and what it hits.
#[derive(Clone, Debug, PartialEq)]
pub struct Rejected {
    /// The motion.
    pub way: Vec<AnyConfiguration>,
    /// The configuration in contact.
    pub at: AnyConfiguration,
    /// The nearest points there; `None` in an empty scene.
    pub witness: Option<Witness>,
}

impl Drawn {
    /// The ends alone, before anything is grown.
    pub fn of_ends(ends: [AnyConfiguration; 2]) -> Self {
        let (edges, path, corners) = (Vec::new(), Vec::new(), Vec::new());
        Drawn { ends, edges, path, corners, rejected: None, sensed: None, barrier: None, rivals: Vec::new() }
    }

    /// The number of the path's legs in words.
    pub fn legs(&self) -> String {
        match self.corners.len().saturating_sub(1) {
            1 => "1 leg".to_owned(),
            legs => format!("{legs} legs"),
        }
    }

    /// The robot's places along the path: corners, at most fifteen of them, from the start on and the goal the last.
    pub fn places(&self) -> Vec<AnyConfiguration> {
        let every = self.corners.len().div_ceil(14).max(1);
        let some = self.corners.iter().step_by(every).copied();
        let last = self.corners.last().copied().filter(|_| self.corners.len() % every != 1 % every);
        some.chain(last).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::robots::AnyRobot;

    #[test]
    fn one_leg_is_no_legs() {
        let at = |i: usize| AnyRobot::of_kind("rusty", &[i as f64, 0.0, 0.0]).map(|(_, q)| q).unwrap();
        for (corners, words) in [(0, "0 legs"), (2, "1 leg"), (3, "2 legs")] {
            let corners: Vec<AnyConfiguration> = (0..corners).map(at).collect();
            let drawn = Drawn { corners, ..Drawn::of_ends([at(0), at(1)]) };
            assert_eq!(drawn.legs(), words, "a leg lies between two corners");
        }
    }

    #[test]
    fn the_places_are_few_and_end_at_the_goal() {
        let at = |i: usize| AnyRobot::of_kind("rusty", &[i as f64, 0.0, 0.0]).map(|(_, q)| q).unwrap();
        for count in [1, 2, 13, 14, 15, 16, 28, 29, 30, 1000] {
            let corners: Vec<AnyConfiguration> = (0..count).map(at).collect();
            let ends = [at(0), at(count - 1)];
            let drawn = Drawn { corners, ..Drawn::of_ends(ends) };
            let places = drawn.places();
            assert!(places.len() <= 15 && places[0] == at(0), "{count}");
            assert_eq!(places.iter().filter(|q| **q == at(count - 1)).count(), 1, "{count}: the goal once");
        }
    }
}
