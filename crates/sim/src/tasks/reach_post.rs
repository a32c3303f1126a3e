//! `ReachPost`, an arm's way past the post.

use super::draws::{first, held, quantized, write};
use super::{EpisodeMoment, EpisodeStart, Judgement, LearningTask, TaskSetting};
use crate::run::RobotInput;
use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::{Chart as _, Configuration as _, RobotKind, T2, Tn};
use motion_lab_core::num;
use motion_lab_core::random::Stream;
use motion_lab_core::robots::Reach;
use motion_lab_core::worlds::World;

/// Reach turns from one side of the Workbench's post to the other. On the straight way its first link sweeps through
/// the post: the arm has to fold, or to go round the other way.
///
/// The start is drawn about (2.0, 0) rad and the goal about (3.1, 0) rad, each joint within 0.15 rad of it, free; in
/// half of the episodes they change places. The action is the two joints' turns in a tick, as parts of 0.1 rad. The
/// observation is the cosines and the sines of both joints, those of the goal, the differences to the goal over pi, and
/// the clearance in metres. A tick earns the radians by which it came nearer; the goal, reached within 0.1 rad, 1 more;
/// contact takes 1. Both end the episode; it takes at most 200 ticks, ten seconds.
#[derive(Clone, Debug)]
pub struct ReachPost {
    setting: TaskSetting<Reach<2>>,
    checker: Checker<Reach<2>>,
}

/// The most that a joint turns in a tick, radians: 2 rad/s.
const TURN: f64 = 0.1;
/// So near the goal the arm has reached it, radians.
const REACHED: f64 = 0.1;

impl ReachPost {
    /// The task on the Workbench.
    pub fn new() -> Self {
        let world = World::workbench();
        let (scene, arm) = (Scene::of_world(&world), Reach::<2>::workbench());
        let common = TaskSetting::of(world, arm, &RobotKind::REACH);
        ReachPost { checker: Checker::new(scene, arm), setting: TaskSetting { observations: 11, ..common } }
    }

    fn draw(&self, about: [f64; 2], draws: &mut Stream) -> T2 {
        let near = |draws: &mut Stream| Tn(about.map(|x| held(num::wrap(x + draws.uniform(-0.15, 0.15)))));
        first(draws, near, |q| self.checker.is_free(q))
    }
}

impl Default for ReachPost {
    fn default() -> Self {
        Self::new()
    }
}

impl LearningTask for ReachPost {
    type Robot = Reach<2>;
    type Goal = T2;

    fn setting(&self) -> &TaskSetting<Reach<2>> {
        &self.setting
    }

    fn begin(&self, draws: &mut Stream) -> EpisodeStart<T2> {
        let (here, there) = (self.draw([2.0, 0.0], draws), self.draw([3.1, 0.0], draws));
        let (start, goal) = if draws.below(2) == 0 { (here, there) } else { (there, here) };
        EpisodeStart { inputs: vec![RobotInput::Teleport(quantized(start.0))], goal }
    }

    fn input(&self, now: &EpisodeMoment<'_, Reach<2>>, action: &[f32]) -> RobotInput {
        let turn = |joint: usize| TURN * f64::from(*action.get(joint).unwrap_or(&0.0));
        let Tn([th1, th2]) = *now.q;
        RobotInput::MoveTo(quantized(T2::new(th1 + turn(0), th2 + turn(1)).in_chart().0))
    }

    fn observe(&self, goal: &T2, now: &EpisodeMoment<'_, Reach<2>>, observation: &mut [f32]) {
        let of = |q: &T2| {
            let [(s1, c1), (s2, c2)] = q.0.map(num::sin_cos);
            [c1, s1, c2, s2]
        };
        let rest = write(of(goal), write(of(now.q), observation));
        let left = now.q.difference(goal).map_or([0.0; 2], |d| [d[0], d[1]]);
        let pi = std::f64::consts::PI;
        write([left[0] / pi, left[1] / pi, self.checker.distance(now.q)], rest);
    }

    fn judge(&self, goal: &T2, now: &EpisodeMoment<'_, Reach<2>>) -> Judgement {
        let left = now.q.distance(goal, &[]);
        let nearer = now.before.distance(goal, &[]) - left;
        Judgement::of(nearer, now.in_contact, left <= REACHED)
    }
}
