//! `AtlasSpace`, the configuration space of the robot that the atlas's clicks put, in the world as it is drawn.

use std::sync::Arc;

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::picture::Picture;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::lens::SpaceCells;

/// Level of the finest cells: a 64th of the sides.
const FINEST: u32 = 6;

/// Largest number of cells judged in a frame: nearly all of them, for a wall that is dragged is another world in each.
const BUDGET: u32 = 2500;

/// The cells of a robot's slice, and what they were judged in.
#[derive(Clone, Debug)]
pub struct AtlasSpace {
    /// The picture of the world.
    still: Arc<Picture>,
    /// Where the other robots stand.
    others: Vec<AnyConfiguration>,
    cells: SpaceCells,
}

impl AtlasSpace {
    /// The cells.
    pub fn cells(&self) -> &SpaceCells {
        &self.cells
    }

    /// The space of robot number `index` among a world and its other robots, of which nothing is known: what is known
    /// already, if it is of the same. `still` is the world's picture, another one wherever the world is another. `None`
    /// without a robot of the lab's.
    pub fn of(known: Option<Self>, shown: &Atlas, index: usize, still: &Arc<Picture>) -> Option<Self> {
        let robot = shown.robots().get(index)?;
        let others = || shown.robots().iter().enumerate().filter(|(i, _)| *i != index).map(|(_, robot)| robot.q);
        let serves = |space: &AtlasSpace| {
            let slice = space.cells.map().slice();
            let is_its = *slice.checker().robot() == robot.robot && slice.holds(&robot.q);
            is_its && Arc::ptr_eq(&space.still, still) && others().eq(space.others.iter().copied())
        };
        known.filter(serves).or_else(|| {
            let cells = SpaceCells::through(&shown.checker(index)?, &robot.q, FINEST)?;
            Some(AtlasSpace { others: others().collect(), still: Arc::clone(still), cells })
        })
    }

    /// Judges more cells. Returns whether any remain.
    pub fn refine(&mut self) -> bool {
        self.cells.refine(BUDGET)
    }
}

#[cfg(test)]
mod tests {
    use motion_lab_core::cspace::CellState;
    use motion_lab_core::picture::world as picture_of;
    use motion_lab_core::worlds::World;

    use super::*;

    #[test]
    fn the_other_robots_are_in_the_way_and_what_is_known_goes_when_one_moves() {
        let rover = |name: &str, x: f64| format!("(name: \"{name}\", kind: \"rusty\", start: [{x}, 2, 0])");
        let world = format!(
            "World(version: 1, name: \"hall\", bounds: (min: (0, 0), max: (8, 4)), obstacles: [], robots: [{}, {}])",
            rover("one", 2.0),
            rover("other", 6.0)
        );
        let mut atlas = Atlas::new(World::parse("hall.ron", &world).unwrap());
        let still = Arc::new(picture_of(atlas.world()));
        let states = |atlas: &Atlas, known: Option<AtlasSpace>| {
            let mut space = AtlasSpace::of(known, atlas, 0, &still).unwrap();
            while space.refine() {}
            let states = [[2.0, 2.0], [6.0, 2.0], [4.0, 3.0]].map(|at| space.cells().map().state(at));
            (states, space)
        };
        let (free, blocked) = (CellState::Free, CellState::Blocked);
        let (now, space) = states(&atlas, None);
        assert_eq!(now, [free, blocked, free], "where the robot itself stands it is free");
        let to = atlas.robots()[1].q.with(0, 4.0).with(1, 3.0);
        assert_eq!(atlas.teleport(1, to), Some(Ok(())));
        assert_eq!(states(&atlas, Some(space)).0, [free, free, blocked]);
    }
}
