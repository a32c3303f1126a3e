//! `Anatomy`, one frozen scene with a robot in it.

use super::nearest::{NearestPair, nearest_pairs};
use super::sweep::SweptMotion;
use motion_lab_core::collision::{Checker, Collision, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, Coordinates, T2};
use motion_lab_core::cspace::Overlay;
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Shape};
use motion_lab_core::robots::{AnyRobot, ConfigurationError, Reach, Robot};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::sync::Arc;

/// The radius of the thick links of an arm that has none of its own, metres: the Workbench's.
pub const THICK_LINKS: f64 = 0.03;

/// The lengths that a two-link arm's links may be given, metres.
pub const LENGTHS: std::ops::RangeInclusive<f64> = 0.1..=1.5;

/// The four questions, a tab each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// Whether the robot touches anything.
    #[default]
    Intersects,
    /// The distance from the nearest obstacle.
    Distance,
    /// The nearest points, and what they lie on.
    Witness,
    /// Whether the motion to a second configuration hits something, with the proof.
    Swept,
}

/// The source of a world, by which a command names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WorldSource {
    /// Built in, under this name.
    BuiltIn(&'static str),
    /// The file at this path, as it is now.
    File(String),
    /// No file: the world has not been saved.
    Unsaved,
}

impl WorldSource {
    /// The source of a world that is as one of the built-in ones; `None` for any other.
    pub fn of(world: &World) -> Option<Self> {
        world.built_in_name().map(WorldSource::BuiltIn)
    }
}

/// A frozen scene, a robot in it, and one of the four questions.
#[derive(Clone, Debug)]
pub struct Anatomy {
    world: Arc<World>,
    source: WorldSource,
    checker: Checker<AnyRobot>,
    q: AnyConfiguration,
    step: Coordinates,
    elbow_down: bool,
    /// The radius of the links when they are thick, metres.
    pub(super) thickness: f64,
    /// The question.
    pub tab: Tab,
    /// Whether the annulus of points that an arm's tip can reach is drawn.
    pub show_annulus: bool,
}

impl Default for Anatomy {
    /// The chapter's worked example: the Workbench, links of 1 m without thickness at (pi/4, pi/2), and on the swept
    /// tab a quarter turn of joint 1 clockwise, through the block.
    fn default() -> Self {
        let q = AnyConfiguration::T2(T2::new(FRAC_PI_4, FRAC_PI_2));
        let checker = Checker::new(Scene::workbench(), AnyRobot::Reach(Reach::choset()));
        Anatomy::of(World::workbench(), WorldSource::BuiltIn("workbench"), checker, q, &[-FRAC_PI_2, 0.0])
    }
}

impl Tab {
    /// The tabs, left to right.
    pub const ALL: [Tab; 4] = [Tab::Intersects, Tab::Distance, Tab::Witness, Tab::Swept];

    /// The query's name, as code and commands write it.
    pub const fn name(self) -> &'static str {
        match self {
            Tab::Intersects => "intersects",
            Tab::Distance => "distance",
            Tab::Witness => "witness",
            Tab::Swept => "swept",
        }
    }
}

impl Anatomy {
    /// A robot at `q` in a world. The motion of the swept tab goes forward by half a radian or half a metre in the
    /// first coordinate.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of the robot.
    pub fn new(
        world: World,
        source: WorldSource,
        robot: AnyRobot,
        q: AnyConfiguration,
    ) -> Result<Self, ConfigurationError> {
        robot.check(&q)?;
        let checker = Checker::new(Scene::of_world(&world), robot);
        Ok(Anatomy::of(world, source, checker, q, &[0.5]))
    }

    /// The first of a world's residents that is one of the lab's robots, at its start. `None` for a world without one.
    pub fn of_world(world: World, source: WorldSource) -> Option<Self> {
        let (robot, q) = world.robots.iter().find_map(AnyRobot::of_resident)?;
        Anatomy::new(world, source, robot, q).ok()
    }

    /// The scene of exercise 3: the bare arm at (0, pi/2), whose second link touches a square of side 0.2 at (1, 1).
    pub fn exercise_3() -> Self {
        let p = Point2::new;
        let square = Shape::Rectangle { min: p(0.9, 0.9), max: p(1.1, 1.1) };
        let world = World {
            name: "Exercise 3".into(),
            bounds: Aabb { min: p(-0.4, -0.4), max: p(1.6, 1.6) },
            obstacles: vec![Obstacle::new(
                "the square",
                ObstacleKind::Solid,
                vec![(motion_lab_core::geometry::Pose2::IDENTITY, square)],
            )],
            doors: vec![],
            routes: vec![],
            places: Vec::new(),
            marks: Vec::new(),
            robots: Vec::new(),
        };
        let checker = Checker::new(Scene::of_world(&world), AnyRobot::Reach(Reach::choset()));
        let q = AnyConfiguration::T2(T2::new(0.0, FRAC_PI_2));
        Anatomy::of(world, WorldSource::Unsaved, checker, q, &[0.0, 0.3])
    }

    pub(super) fn of(
        world: World,
        source: WorldSource,
        checker: Checker<AnyRobot>,
        q: AnyConfiguration,
        step: &[f64],
    ) -> Self {
        let mut step = Coordinates::from_slice(step);
        step.resize(q.coordinates().len(), 0.0);
        let elbow_down = elbow(&q).is_none_or(|angle| angle >= 0.0);
        let (tab, show_annulus) = (Tab::default(), false);
        let thickness = super::thickness::of_links(&world, checker.robot()).unwrap_or(THICK_LINKS);
        Anatomy { world: Arc::new(world), source, checker, q, step, elbow_down, thickness, tab, show_annulus }
    }

    /// The same anatomy with another tab in front.
    #[must_use]
    pub fn with_tab(self, tab: Tab) -> Self {
        Anatomy { tab, ..self }
    }

    /// The world.
    pub fn world(&self) -> &Arc<World> {
        &self.world
    }

    /// The source of the world.
    pub fn source(&self) -> &WorldSource {
        &self.source
    }

    /// The robot in the scene.
    pub fn checker(&self) -> &Checker<AnyRobot> {
        &self.checker
    }

    /// The configuration.
    pub fn q(&self) -> AnyConfiguration {
        self.q
    }

    /// The footprint there.
    pub fn footprint(&self) -> Footprint {
        self.checker.robot().footprint(&self.q)
    }

    /// Whether the links have a radius; `None` for a robot that is no two-link arm.
    pub fn thick_links(&self) -> Option<bool> {
        match self.checker.robot() {
            AnyRobot::Reach(arm) => Some(arm.link_radius > 0.0),
            _ => None,
        }
    }

    /// The radius that a two-link arm's links have when they are thick, metres: its own; of an arm with bare links that
    /// of the world's resident with the same base and lengths, else [`THICK_LINKS`]. `None` for another robot.
    pub fn thickness(&self) -> Option<f64> {
        self.thick_links().map(|_| self.thickness)
    }

    /// Sets the link radius of a two-link arm to its [`thickness`](Self::thickness) or to 0; other robots stay as they
    /// are.
    pub fn set_thick_links(&mut self, thick: bool) {
        if let AnyRobot::Reach(arm) = *self.checker.robot() {
            let arm = Reach { link_radius: if thick { self.thickness } else { 0.0 }, ..arm };
            self.checker = Checker::new(self.checker.shared_scene(), AnyRobot::Reach(arm));
        }
    }

    /// The lengths of the links, metres; `None` for a robot that is no two-link arm.
    pub fn lengths(&self) -> Option<[f64; 2]> {
        match self.checker.robot() {
            AnyRobot::Reach(arm) => Some(arm.lengths),
            _ => None,
        }
    }

    /// Sets the length of a two-link arm's link, counted from 0, metres, clamped to [`LENGTHS`].
    /// The arm keeps its angles; other robots, and a length that is not finite, change nothing.
    pub fn set_length(&mut self, link: usize, length: f64) {
        if let AnyRobot::Reach(mut arm) = *self.checker.robot()
            && let Some(own) = arm.lengths.get_mut(link).filter(|_| length.is_finite())
        {
            *own = length.clamp(*LENGTHS.start(), *LENGTHS.end());
            self.checker = Checker::new(self.checker.shared_scene(), AnyRobot::Reach(arm));
        }
    }

    /// Sets coordinate number `index` (0 is theta1), an angle wrapped. A value that is not finite changes nothing.
    pub fn set_coordinate(&mut self, index: usize, value: f64) {
        self.set(self.q.with(index, value));
    }

    /// Puts the robot at `q`.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of the robot; the robot then stays where it is.
    pub fn set_q(&mut self, q: AnyConfiguration) -> Result<(), ConfigurationError> {
        self.checker.robot().check(&q)?;
        self.set(q);
        Ok(())
    }

    /// The range of a slider for coordinate number `index`: -pi to pi for an angle, else the world's bounds in that
    /// direction, metres.
    pub fn range(&self, index: usize) -> [f64; 2] {
        let Aabb { min, max } = self.world.bounds;
        match index {
            _ if self.q.is_angle(index) => [-PI, PI],
            0 => [min.x, max.x],
            _ => [min.y, max.y],
        }
    }

    /// Drags the robot's reference point. An arm's tip moves by inverse kinematics on its elbow side, clamped to the
    /// annulus; a straight or folded arm keeps the side it had. Other robots move without turning.
    pub fn drag(&mut self, to: Point2) {
        // an arm's base stays where it is; what moves about stays in its world
        let Aabb { min, max } = self.world.bounds;
        let within = Point2::new(to.x.clamp(min.x, max.x), to.y.clamp(min.y, max.y));
        let to = if self.q.is_angle(0) { to } else { within };
        self.set(self.checker.robot().dragged(&self.q, to, self.elbow_down));
    }

    fn set(&mut self, q: AnyConfiguration) {
        self.q = q;
        if let Some(angle) = elbow(&q).filter(|a| *a != 0.0 && *a < PI) {
            self.elbow_down = angle > 0.0;
        }
    }

    /// The motion of the swept tab, as a step of the chart.
    pub fn step(&self) -> &[f64] {
        &self.step
    }

    /// The largest step of a slider for coordinate number `index`: pi for an angle, else 5 m.
    pub fn step_range(&self, index: usize) -> f64 {
        if self.q.is_angle(index) { PI } else { 5.0 }
    }

    /// Sets the swept tab's motion in coordinate number `index`. An angle is clamped to -pi to pi, because the chart's
    /// line goes the short way. A value that is not finite changes nothing.
    pub fn set_step(&mut self, index: usize, step: f64) {
        let limit = if self.q.is_angle(index) { PI } else { f64::MAX };
        if let Some(s) = self.step.get_mut(index).filter(|_| step.is_finite()) {
            *s = step.clamp(-limit, limit);
        }
    }

    /// The second configuration of the swept tab, one step on.
    pub fn second(&self) -> AnyConfiguration {
        self.q.plus(&self.step)
    }

    /// Whether the robot touches anything.
    pub fn intersects(&self) -> bool {
        self.checker.scene().intersects(&self.footprint())
    }

    /// The distance from the robot to the nearest obstacle, metres: exactly 0 in contact, infinity in an empty scene.
    pub fn distance(&self) -> f64 {
        self.checker.scene().distance(&self.footprint())
    }

    /// The witness and the pairs that tie with it; empty in an empty scene.
    pub fn nearest(&self) -> Vec<NearestPair> {
        nearest_pairs(self.checker.scene(), &self.footprint())
    }

    /// The configurations of a two-link arm with the present tip, its own among them: two, or one where they coincide.
    /// Empty for another robot.
    pub fn solutions(&self) -> Vec<AnyConfiguration> {
        match (self.checker.robot(), self.q) {
            (AnyRobot::Reach(arm), AnyConfiguration::T2(q)) => {
                arm.ik(arm.tip(&q)).into_iter().flatten().map(AnyConfiguration::T2).collect()
            }
            _ => Vec::new(),
        }
    }

    /// What is drawn of it over the cells of its configuration space, with the path of its configuration, oldest first.
    /// The chart line is drawn when the tab is the swept one.
    pub fn in_space(&self, trace: Vec<AnyConfiguration>) -> Overlay {
        Overlay {
            now: Some(self.q),
            in_contact: self.intersects(),
            trace,
            line: (self.tab == Tab::Swept).then(|| [self.q, self.second()]),
            solutions: self.solutions(),
        }
    }

    /// The verdict on the motion to the [second configuration](Self::second), with its proof.
    ///
    /// # Errors
    /// [`ConfigurationError`] when the second configuration is not one of the robot's.
    pub fn sweep(&self) -> Result<SweptMotion, ConfigurationError> {
        SweptMotion::new(&self.checker, &self.q, &self.second())
    }
}

/// The joint angle whose sign is the side of an arm's elbow; `None` for other robots.
fn elbow(q: &AnyConfiguration) -> Option<f64> {
    match q {
        AnyConfiguration::T2(q) => Some(q.th2()),
        AnyConfiguration::T3(q) => Some(q.0[2]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::robots::{HITCH, RUSTY};

    #[test]
    fn what_is_dragged_beyond_its_world_stays_at_its_edge() {
        for robot in [AnyRobot::Rusty(RUSTY), AnyRobot::Hitch(HITCH)] {
            let mut anatomy = Anatomy::default().at_home(robot);
            let Aabb { min, max } = anatomy.world().bounds;
            for (to, edge) in [([max.x + 1.0, 3.0], [max.x, 3.0]), ([4.0, min.y - 2.0], [4.0, min.y])] {
                anatomy.drag(Point2::from(to));
                let [x, y] = [0, 1].map(|i| anatomy.q().coordinates()[i]);
                assert!((Point2::new(x, y) - Point2::from(edge)).norm() < 1e-9, "{x} {y}");
            }
        }
        // an arm's tip is drawn out as far as it goes, wherever the pointer is: along the x axis it is straight
        let mut arm = Anatomy::default();
        arm.drag(Point2::new(50.0, 0.0));
        let q = arm.q().coordinates();
        assert!(q[0].abs() < 1e-6 && q[1].abs() < 1e-6, "{q:?}");
    }
}
