//! The choice of another robot or world.

use super::{Anatomy, WorldSource};
use crate::collision::{Checker, Scene};
use crate::configuration::AnyConfiguration;
use crate::cspace::{Slice, nearest_free};
use crate::geometry::Point2;
use crate::robots::{AnyRobot, HITCH, RUSTY, Reach};
use crate::worlds::World;

impl Anatomy {
    /// The robots to choose from, with the names shown.
    pub fn choices() -> [(&'static str, AnyRobot); 6] {
        [
            ("Reach, bare links", AnyRobot::Reach(Reach::choset())),
            ("Reach, 3 cm links", AnyRobot::Reach(Reach::workbench())),
            ("Reach, three links", AnyRobot::Reach3(Reach::redundant())),
            ("Rusty", AnyRobot::Rusty(RUSTY)),
            ("Hitch", AnyRobot::Hitch(HITCH)),
            ("Hitch with its trailer", AnyRobot::Hitch(HITCH.with_trailer())),
        ]
    }

    /// The same world and tab with another robot. It stands at the present configuration if that is one of its own;
    /// else where a resident of its kind starts; else at the free configuration nearest to the middle of the world, or
    /// at the middle if none was found.
    #[must_use]
    pub fn with_robot(&self, robot: AnyRobot) -> Anatomy {
        self.put((**self.world()).clone(), self.source().clone(), robot)
    }

    /// The same tab with another robot. It stays in this world if one of its kind lives here or the world is not built
    /// in; else it goes to the built-in world where its kind lives.
    #[must_use]
    pub fn at_home(&self, robot: AnyRobot) -> Anatomy {
        let lives_in = |world: &World| {
            world.robots.iter().any(|r| r.kind.trim_end_matches('3') == robot.kind().trim_end_matches('3'))
        };
        if lives_in(self.world()) || !matches!(self.source(), WorldSource::BuiltIn(_)) {
            return self.with_robot(robot);
        }
        let worlds = World::built_in_names().into_iter().filter_map(|name| Some((name, World::built_in(name)?)));
        match worlds.into_iter().find(|(_, world)| lives_in(world)) {
            Some((name, home)) => self.put(home, WorldSource::BuiltIn(name), robot),
            None => self.with_robot(robot),
        }
    }

    /// The same robot and tab in another world, placed as by [`with_robot`](Self::with_robot). An arm keeps its angles.
    #[must_use]
    pub fn in_world(&self, world: World, source: WorldSource) -> Anatomy {
        self.put(world, source, *self.checker().robot())
    }

    fn put(&self, world: World, source: WorldSource, robot: AnyRobot) -> Anatomy {
        let same_world = world == **self.world();
        let own = robot.like(&self.q()).filter(|q| same_world || q.is_angle(0));
        let q = own.or_else(|| resident(&world, &robot)).unwrap_or_else(|| middle(&world, &robot));
        let Ok(mut put) = Anatomy::new(world, source, robot, q) else { return self.clone() };
        if put.step().len() == self.step().len() && put.q().is_angle(0) == self.q().is_angle(0) {
            (0..self.step().len()).for_each(|i| put.set_step(i, self.step()[i]));
        }
        Anatomy { tab: self.tab, show_annulus: self.show_annulus, ..put }
    }
}

/// The start of the first resident whose start is a configuration of this robot.
fn resident(world: &World, robot: &AnyRobot) -> Option<AnyConfiguration> {
    world.robots.iter().find_map(|r| robot.like(&AnyRobot::of_kind(&r.kind, &r.start)?.1))
}

/// The free configuration nearest to the middle of the world.
fn middle(world: &World, robot: &AnyRobot) -> AnyConfiguration {
    let (min, max) = (world.bounds.min, world.bounds.max);
    let wanted = robot.home(Point2::new(0.5 * (min.x + max.x), 0.5 * (min.y + max.y)));
    let slice = Slice::through(&Checker::new(Scene::of_world(world), *robot), &wanted);
    slice.ok().and_then(|slice| nearest_free(&slice, &wanted)).map_or(wanted, |found| found.q)
}
