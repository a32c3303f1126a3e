//! `RustyGoal`, to a goal by lidar.

use super::draws::{channels, first, held, quantized, write};
use super::{EpisodeMoment, EpisodeStart, Judgement, LearningTask, TaskSetting};
use crate::run::RobotInput;
use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Aabb, Point2, Pose2};
use motion_lab_core::num;
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{RUSTY, Robot as _, Rusty};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;

/// Rusty drives to a goal that it knows the direction of, by what its range sensor reads, in the Apartment with all
/// doors open.
///
/// Start and goal are drawn free, 0.2 m or more from everything, 1 to 4 m apart. The action is the speed and the turn
/// rate, as parts of the greatest. The observation is, for each of 360 rays from straight ahead counter-clockwise, its
/// range over 4 m (1 where nothing is in range), then the goal's distance over 4 m, and the cosine and the sine of its
/// bearing from the heading. A tick earns the metres by which it came nearer; the goal, reached within 0.25 m, 1 more;
/// contact takes 1. Both end the episode; it takes at most 600 ticks, half a minute.
#[derive(Clone, Debug)]
pub struct RustyGoal {
    setting: TaskSetting<Rusty>,
    checker: Checker<Rusty>,
}

/// So near the goal the rover has reached it, metres.
const REACHED: f64 = 0.25;
/// So far from everything start and goal are, metres.
const ROOM: f64 = 0.2;
/// The rays.
pub(super) const SENSOR: RangeSensor = RangeSensor { n_rays: 360, max_range: 4.0 };

impl RustyGoal {
    /// The task in the Apartment.
    pub fn new() -> Self {
        let world = World::apartment();
        let checker = Checker::new(Scene::of_world(&world), RUSTY);
        let common = TaskSetting::of(world, RUSTY, &RobotKind::RUSTY);
        RustyGoal { checker, setting: TaskSetting { sensor: Some(SENSOR), ticks: 600, observations: 363, ..common } }
    }

    fn draw(&self, draws: &mut Stream) -> Pose2 {
        let Aabb { min, max } = self.setting.world.bounds;
        let q = self.checker.robot().sample(min, max, draws);
        Pose2 { x: held(q.x), y: held(q.y), theta: held(q.theta) }
    }

    fn has_room(&self, q: &Pose2) -> bool {
        self.checker.distance(q) >= ROOM
    }
}

impl Default for RustyGoal {
    fn default() -> Self {
        Self::new()
    }
}

pub(super) fn distance(q: &Pose2, goal: &Point2) -> f64 {
    num::hypot(goal.x - q.x, goal.y - q.y)
}

impl LearningTask for RustyGoal {
    type Robot = Rusty;
    type Goal = Point2;

    fn setting(&self) -> &TaskSetting<Rusty> {
        &self.setting
    }

    fn begin(&self, draws: &mut Stream) -> EpisodeStart<Point2> {
        let start = first(draws, |draws| self.draw(draws), |q| self.has_room(q));
        let is_near = |q: &Pose2| (1.0..=4.0).contains(&distance(&start, &q.position()));
        let goal = first(draws, |draws| self.draw(draws), |q| is_near(q) && self.has_room(q)).position();
        EpisodeStart { inputs: vec![RobotInput::Teleport(quantized([start.x, start.y, start.theta]))], goal }
    }

    fn input(&self, _now: &EpisodeMoment<'_, Rusty>, action: &[f32]) -> RobotInput {
        channels(action)
    }

    fn observe(&self, goal: &Point2, now: &EpisodeMoment<'_, Rusty>, observation: &mut [f32]) {
        observe_goal(goal, now, observation);
    }

    fn judge(&self, goal: &Point2, now: &EpisodeMoment<'_, Rusty>) -> Judgement {
        judge_goal(goal, now)
    }
}

/// What a rover observes: its rays, and where its goal is.
pub(super) fn observe_goal(goal: &Point2, now: &EpisodeMoment<'_, Rusty>, observation: &mut [f32]) {
    let (rays, rest) = observation.split_at_mut(now.ranges.len().min(observation.len()));
    for (place, range) in rays.iter_mut().zip(now.ranges) {
        *place = num::lesser(range / SENSOR.max_range, 1.0) as f32;
    }
    let bearing = num::atan2(goal.y - now.q.y, goal.x - now.q.x) - now.q.theta;
    let (sin, cos) = num::sin_cos(bearing);
    write([distance(now.q, goal) / SENSOR.max_range, cos, sin], rest);
}

/// What a tick earns on the way to a goal.
pub(super) fn judge_goal(goal: &Point2, now: &EpisodeMoment<'_, Rusty>) -> Judgement {
    let left = distance(now.q, goal);
    let nearer = distance(now.before, goal) - left;
    Judgement::of(nearer, now.in_contact, left <= REACHED)
}
