//! The choice of another robot or world.

use super::{Anatomy, WorldSource};
use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::{AnyConfiguration, RobotKind};
use motion_lab_core::cspace::{Slice, nearest_free};
use motion_lab_core::geometry::Point2;
use motion_lab_core::robots::{AnyRobot, ConfigurationError, HITCH, RUSTY, Reach};
use motion_lab_core::worlds::{Resident, World};

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

    /// The residents of this world whose sizes the world says, with their names: what there is to choose besides
    /// [`choices`](Self::choices). A car is there with its trailer if it starts with it.
    pub fn residents(&self) -> Vec<(String, AnyRobot)> {
        let sized = self.world().robots.iter().filter(|r| r.sizes.is_some());
        sized.filter_map(|r| Some((r.name.clone(), AnyRobot::of_resident(r)?.0))).collect()
    }

    /// The first resident of this world that says its sizes and is the robot in the scene.
    pub fn resident(&self) -> Option<&Resident> {
        self.world().robots.iter().filter(|r| r.sizes.is_some()).find(|r| self.is_resident(r))
    }

    /// The first resident of this world that is the robot in the scene.
    pub fn lives_as(&self) -> Option<&Resident> {
        self.world().robots.iter().find(|resident| self.is_resident(resident))
    }

    /// Whether the robot in the scene is this resident, a car with its trailer or without.
    pub(super) fn is_resident(&self, resident: &Resident) -> bool {
        let model = AnyRobot::model(&resident.kind, resident.sizes.as_ref());
        model.is_some_and(|model| model.fitted(&self.q()) == *self.checker().robot())
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
        let home = robot.about().home;
        let is_one = |resident: &Resident| RobotKind::of(&resident.kind).is_some_and(|kind| kind.home == home);
        let is_elsewhere = matches!(self.source(), WorldSource::BuiltIn(_)) && !self.world().robots.iter().any(is_one);
        match home.filter(|_| is_elsewhere).and_then(|name| Some((name, World::built_in(name)?))) {
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
        self.of_robot(world, source, robot, q).unwrap_or_else(|_| self.clone())
    }

    /// The same question about a robot at `q` in a world. The motion of the swept tab stays where the robot has such
    /// coordinates, and the radius of the links where it is the same arm.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of the robot.
    pub fn of_robot(
        &self,
        world: World,
        source: WorldSource,
        robot: AnyRobot,
        q: AnyConfiguration,
    ) -> Result<Anatomy, ConfigurationError> {
        let mut put = Anatomy::new(world, source, robot, q)?;
        if put.step().len() == self.step().len() && put.q().is_angle(0) == self.q().is_angle(0) {
            (0..self.step().len()).for_each(|i| put.set_step(i, self.step()[i]));
        }
        // the same arm keeps its own radius, bare or not
        if robot == *self.checker().robot() {
            put.thickness = self.thickness;
        }
        (put.tab, put.show_annulus) = (self.tab, self.show_annulus);
        Ok(put)
    }
}

/// The start of the resident that is this robot, else of the first whose start is a configuration of this robot.
fn resident(world: &World, robot: &AnyRobot) -> Option<AnyConfiguration> {
    let starts = || world.robots.iter().filter_map(AnyRobot::of_resident);
    let own = starts().find(|(resident, _)| resident == robot).map(|(_, q)| q);
    own.or_else(|| starts().find_map(|(_, q)| robot.like(&q)))
}

/// The free configuration nearest to the middle of the world.
fn middle(world: &World, robot: &AnyRobot) -> AnyConfiguration {
    let (min, max) = (world.bounds.min, world.bounds.max);
    let wanted = robot.home(Point2::new(0.5 * (min.x + max.x), 0.5 * (min.y + max.y)));
    let slice = Slice::through(&Checker::new(Scene::of_world(world), *robot), &wanted);
    slice.ok().and_then(|slice| nearest_free(&slice, &wanted)).map_or(wanted, |found| found.q)
}
