//! The robots of a recipe that start in contact.

use std::collections::BTreeSet;

use crate::run::Recipe;
use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::Footprint;
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

/// The robots that touch an obstacle or one another at their starts, each by its world and its number there. Kinds that
/// are not the lab's are left out.
pub(super) fn in_contact_at_start(recipe: &Recipe) -> BTreeSet<(usize, usize)> {
    let worlds = recipe.config.worlds.iter().enumerate();
    worlds.flat_map(|(w, world)| touching(world).into_iter().map(move |r| (w, r))).collect()
}

fn touching(world: &World) -> Vec<usize> {
    let footprint = |resident| AnyRobot::of_resident(resident).map(|(robot, q)| robot.footprint(&q));
    let robots: Vec<(usize, Footprint)> =
        world.robots.iter().enumerate().filter_map(|(r, resident)| Some((r, footprint(resident)?))).collect();
    let as_obstacle = |(_, footprint): &(usize, Footprint)| {
        let pieces = footprint.parts().iter().map(|part| (*part.pose(), part.shape().clone())).collect();
        Obstacle::new("", ObstacleKind::Solid, pieces)
    };
    let scene = Scene::of_world(world);
    let crowd = robots.iter().map(as_obstacle).collect();
    let crowd = Scene::of_world(&World { obstacles: crowd, ..World::empty("", world.bounds) });
    // each touches itself
    let touches = |footprint: &Footprint| !scene.touched(footprint).is_empty() || crowd.touched(footprint).len() > 1;
    robots.iter().filter(|(_, footprint)| touches(footprint)).map(|(r, _)| *r).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour::TourConfig;
    use motion_lab_core::random::Seed;
    use motion_lab_core::worlds::Resident;

    #[test]
    fn robots_that_touch_something_at_their_starts_are_found() {
        let mut config = TourConfig::default();
        assert!(in_contact_at_start(&Recipe::new(config.clone(), Seed(1))).is_empty());
        let beside = config.worlds[2].robots[0].start.clone();
        config.worlds[2].robots.push(Resident::new("beside", "rusty", &beside[..3]));
        config.worlds[2].robots.push(Resident::new("far", "rusty", [8.0, 8.0, 0.0]));
        let mut wall = config.worlds[1].robots[0].clone();
        wall.start = vec![3.1, 0.0];
        config.worlds[1].robots = vec![wall];
        let found = in_contact_at_start(&Recipe::new(config, Seed(1)));
        assert!(found.is_superset(&BTreeSet::from([(2, 0), (2, 1)])) && !found.contains(&(0, 0)), "{found:?}");
        assert!(!found.contains(&(2, 2)), "{found:?}");
    }
}
