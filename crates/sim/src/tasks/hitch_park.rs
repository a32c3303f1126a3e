//! `HitchPark`, a trailer backed into a bay.

use super::draws::{channels, first, held, quantized, write};
use super::{EpisodeMoment, EpisodeStart, Judgement, LearningTask, TaskSetting};
use crate::run::RobotInput;
use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::{HitchCfg, RobotKind};
use motion_lab_core::geometry::{Aabb, Point2, Pose2};
use motion_lab_core::num;
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{HITCH, Hitch, Robot as _};
use motion_lab_core::worlds::World;

/// Hitch backs its trailer into a bay of the Lot.
///
/// The car starts in the aisle, about along it, its trailer straight behind; the bay is one of the four. The action is
/// the speed and the steering angle, as parts of the greatest. The observation is the car's rear axle (x / 16 m,
/// y / 10 m, the cosine and the sine of its heading), the cosine and the sine of the trailer's heading from the car's,
/// from the trailer's axle to the middle of the bay (x / 16 m, y / 10 m), and the cosine and the sine of the trailer's
/// own heading. A tick earns the metres by which the trailer's axle came nearer to the middle of the bay; the whole
/// trailer within the bay's marks 1 more; contact takes 1. Both end the episode; it takes at most 1,200 ticks, a
/// minute.
#[derive(Clone, Debug)]
pub struct HitchPark {
    setting: TaskSetting<Hitch>,
    checker: Checker<Hitch>,
    bays: Vec<Aabb>,
}

impl HitchPark {
    /// The task in the Lot.
    pub fn new() -> Self {
        let world = World::lot();
        let bays = world.marks.iter().filter_map(|mark| Aabb::around(&mark.points)).collect();
        let checker = Checker::new(Scene::of_world(&world), HITCH.with_trailer());
        let common = TaskSetting::of(world, HITCH, &RobotKind::HITCH);
        HitchPark { checker, bays, setting: TaskSetting { ticks: 1_200, observations: 10, ..common } }
    }

    fn axle(&self, q: &HitchCfg) -> Pose2 {
        self.checker.robot().trailer_axle(q).unwrap_or(q.body)
    }

    fn distance(&self, q: &HitchCfg, bay: &Aabb) -> f64 {
        let (axle, middle) = (self.axle(q), bay.centre());
        num::hypot(middle.x - axle.x, middle.y - axle.y)
    }

    /// Whether every corner of the trailer is in the bay.
    fn is_in(&self, q: &HitchCfg, bay: &Aabb) -> bool {
        let Aabb { min, max } = *bay;
        let is_within = |p: &Point2| (min.x..=max.x).contains(&p.x) && (min.y..=max.y).contains(&p.y);
        let footprint = self.checker.robot().footprint(q);
        footprint.parts().get(1).is_some_and(|trailer| trailer.placed().core().iter().all(is_within))
    }
}

impl Default for HitchPark {
    fn default() -> Self {
        Self::new()
    }
}

impl LearningTask for HitchPark {
    type Robot = Hitch;
    type Goal = Aabb;

    fn setting(&self) -> &TaskSetting<Hitch> {
        &self.setting
    }

    fn begin(&self, draws: &mut Stream) -> EpisodeStart<Aabb> {
        let draw = |draws: &mut Stream| {
            let (x, y) = (held(draws.uniform(4.0, 11.0)), held(draws.uniform(1.75, 3.25)));
            let theta = held(draws.uniform(-0.25, 0.25));
            HitchCfg { body: Pose2 { x, y, theta }, trailer: Some(theta) }
        };
        let start = first(draws, draw, |q| self.checker.is_free(q)).body;
        let bay = draws.below(self.bays.len() as u64) as usize;
        let goal = self.bays.get(bay).copied().unwrap_or(self.setting.world.bounds);
        let there = RobotInput::Teleport(quantized([start.x, start.y, start.theta]));
        EpisodeStart { inputs: vec![there, RobotInput::SetTrailer(true)], goal }
    }

    fn input(&self, _now: &EpisodeMoment<'_, Hitch>, action: &[f32]) -> RobotInput {
        channels(action)
    }

    fn observe(&self, goal: &Aabb, now: &EpisodeMoment<'_, Hitch>, observation: &mut [f32]) {
        let HitchCfg { body, trailer } = *now.q;
        let (axle, middle, size) = (self.axle(now.q), goal.centre(), self.setting.world.bounds);
        let (width, height) = (size.max.x - size.min.x, size.max.y - size.min.y);
        let (sin, cos) = num::sin_cos(body.theta);
        let (bent_sin, bent_cos) = num::sin_cos(trailer.unwrap_or(body.theta) - body.theta);
        let (trailer_sin, trailer_cos) = num::sin_cos(axle.theta);
        let rest = write([body.x / width, body.y / height, cos, sin, bent_cos, bent_sin], observation);
        write([(middle.x - axle.x) / width, (middle.y - axle.y) / height, trailer_cos, trailer_sin], rest);
    }

    fn judge(&self, goal: &Aabb, now: &EpisodeMoment<'_, Hitch>) -> Judgement {
        let nearer = self.distance(now.before, goal) - self.distance(now.q, goal);
        Judgement::of(nearer, now.in_contact, self.is_in(now.q, goal))
    }
}
