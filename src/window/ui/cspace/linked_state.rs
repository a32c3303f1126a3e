//! `LinkedState`, the cells behind the configuration beside a position, and the scenes of the worlds on the screen.

use std::sync::Arc;

use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::Footprint;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::lens::SpaceCells;

/// Level of the finest cells: a 64th of the sides.
const FINEST: u32 = 6;

/// What is kept from frame to frame of the worlds in front and of the cells behind a point.
#[derive(Clone, Debug, Default)]
pub struct LinkedState {
    kept: Option<(Arc<Atlas>, SpaceCells)>,
    /// The scenes of the worlds seen, as long as somebody else has these worlds too.
    scenes: Vec<(Arc<Atlas>, Arc<Scene>)>,
    /// The robot that a drag of its point or its heading would put where it can't be, and its footprint there.
    pub refused: Option<(String, Footprint)>,
}

impl LinkedState {
    /// Keeps the scene of a world that is in front.
    pub fn see(&mut self, world: &Arc<Atlas>) {
        if !self.scenes.iter().any(|(of, _)| Arc::ptr_eq(of, world)) {
            self.scenes.retain(|(of, _)| Arc::strong_count(of) > 1);
            self.scenes.push((Arc::clone(world), Arc::new(Scene::of_world(world.world()))));
        }
    }

    /// The scene of a world: the one that is kept, or for another world a new one.
    pub fn scene_of(&self, world: &Arc<Atlas>) -> Arc<Scene> {
        let kept = self.scenes.iter().find(|(of, _)| Arc::ptr_eq(of, world));
        kept.map_or_else(|| Arc::new(Scene::of_world(world.world())), |(_, scene)| Arc::clone(scene))
    }

    /// The checker of a robot in a world.
    pub fn checker_of(&self, world: &Arc<Atlas>, robot: &AnyRobot) -> Checker<AnyRobot> {
        Checker::new(self.scene_of(world), *robot)
    }

    /// The cells of the slice through `q`: those that are kept, or for another world, robot or slice new ones. `None`
    /// if `q` is not a configuration of the robot.
    pub fn cells_of(&mut self, world: &Arc<Atlas>, robot: &AnyRobot, q: &AnyConfiguration) -> Option<&mut SpaceCells> {
        let serves = |(of, cells): &(Arc<Atlas>, SpaceCells)| {
            let slice = cells.map().slice();
            Arc::ptr_eq(of, world) && slice.checker().robot() == robot && slice.holds(q)
        };
        if !self.kept.as_ref().is_some_and(serves) {
            self.see(world);
            let checker = self.checker_of(world, robot);
            self.kept = Some((Arc::clone(world), SpaceCells::through(&checker, q, FINEST)?));
        }
        self.kept.as_mut().map(|(_, cells)| cells)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::Tn;
    use motion_lab_core::worlds::World;

    #[test]
    fn the_cells_are_those_of_the_robots_own_world_and_sizes() {
        let [bench, empty] = [World::workbench(), World { obstacles: vec![], ..World::workbench() }];
        let [bench, empty] = [bench, empty].map(|world| Arc::new(Atlas::new(world)));
        let three = |th1: f64| AnyConfiguration::T3(Tn([th1, 0.2, 0.3]));
        let (arm, bare) = (AnyRobot::Reach3(motion_lab_core::robots::Reach::redundant()), |radius: f64| {
            AnyRobot::Reach3(motion_lab_core::robots::Reach {
                link_radius: radius,
                ..motion_lab_core::robots::Reach::redundant()
            })
        });
        let mut state = LinkedState::default();
        let mut asked = |world: &Arc<Atlas>, robot: &AnyRobot, q: &AnyConfiguration| {
            let slice = state.cells_of(world, robot, q).unwrap().map().slice().clone();
            assert!(slice.holds(q));
            (slice.checker().scene().obstacle_count(), *slice.checker().robot(), slice.checker().shared_scene())
        };
        let (pieces, robot, scene) = asked(&bench, &arm, &three(0.1));
        assert!(pieces > 0 && robot == arm);
        // another slice of the same robot in the same world: the scene is kept
        assert!(Arc::ptr_eq(&asked(&bench, &arm, &three(0.4)).2, &scene));
        assert_eq!(asked(&empty, &arm, &three(0.4)).0, 0);
        assert_eq!(asked(&empty, &bare(0.5), &three(0.4)).1, bare(0.5));
    }
}
