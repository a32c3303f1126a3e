//! `LinkedState`, the cells behind the configuration beside a position.

use std::sync::Arc;

use super::cells::Cells;
use crate::atlas::Atlas;
use crate::collision::{Checker, Scene};
use crate::configuration::AnyConfiguration;
use crate::robots::AnyRobot;

/// Level of the finest cells: a 64th of the sides.
const FINEST: u32 = 6;

/// The cells behind a point, kept from frame to frame.
#[derive(Clone, Debug, Default)]
pub struct LinkedState {
    kept: Option<(Arc<Atlas>, Cells)>,
}

impl LinkedState {
    /// The cells of the slice through `q`: those that are kept, or for another world, robot or slice new ones. `None`
    /// if `q` is not a configuration of the robot.
    pub fn cells_of(&mut self, world: &Arc<Atlas>, robot: &AnyRobot, q: &AnyConfiguration) -> Option<&mut Cells> {
        let serves = |(of, cells): &(Arc<Atlas>, Cells)| {
            let slice = cells.map().slice();
            Arc::ptr_eq(of, world) && slice.checker().robot() == robot && slice.holds(q)
        };
        if !self.kept.as_ref().is_some_and(serves) {
            // another slice of the same robot's configurations has the same checker
            let own = |(of, cells): (Arc<Atlas>, Cells)| {
                let checker = cells.map().slice().checker();
                (Arc::ptr_eq(&of, world) && checker.robot() == robot).then(|| checker.clone())
            };
            let checker = self.kept.take().and_then(own);
            let checker = checker.unwrap_or_else(|| Checker::new(Scene::of_world(world.world()), *robot));
            self.kept = Some((Arc::clone(world), Cells::through(&checker, q, FINEST)?));
        }
        self.kept.as_mut().map(|(_, cells)| cells)
    }
}
