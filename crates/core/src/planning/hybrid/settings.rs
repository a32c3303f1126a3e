//! `HybridSettings`, what hybrid A* takes beside the problem, and `NearGoal`, where its paths may end.

use crate::collision::GoalRegion;
use crate::configuration::HitchCfg;
use crate::num::{hypot, wrap};

/// The settings of hybrid A*.
#[derive(Clone, Debug, PartialEq)]
pub struct HybridSettings {
    /// How near to the goal the path's end may be, metres, where the problem has no region of its own.
    pub near: f64,
    /// How far from the goal's headings, the car's and the trailer's, those at the path's end may then be, radians.
    pub aligned: f64,
    /// The number of ticks of a move, at full speed.
    pub ticks: u32,
    /// The steering channels tried to either side, beside straight ahead.
    pub steering: Vec<i16>,
    /// The side of a cell, metres. Of the configurations in a cell only the first that is reached is followed.
    pub cell: f64,
    /// The number of cells that a whole turn has, for the car's heading and for the hitch's angle.
    pub headings: u32,
    /// What a change between ahead and back costs, metres.
    pub reversal: f64,
    /// How much more a metre back costs than one ahead.
    pub back: f64,
    /// What a radian of the hitch's angle costs over a metre.
    pub fold: f64,
    /// The greatest angle of the hitch that is followed, radians, whatever the car's own limit.
    pub most_fold: f64,
    /// How much the estimate of what remains counts. With 1 a path is as short as the moves allow, with more it is
    /// found sooner.
    pub greed: f64,
    /// The clearance that a path keeps where its moves end, metres, unless the start or the goal has less: then half of
    /// that.
    pub keep: f64,
}

impl Default for HybridSettings {
    fn default() -> Self {
        HybridSettings {
            near: 0.1,
            aligned: 0.05,
            ticks: 12,
            steering: vec![64, 128],
            cell: 0.6,
            headings: 24,
            reversal: 1.0,
            back: 0.2,
            fold: 0.3,
            most_fold: 1.0,
            greed: 2.5,
            keep: 0.02,
        }
    }
}

impl HybridSettings {
    /// The region about a goal in which a path may end.
    pub fn around(&self, goal: HitchCfg) -> NearGoal {
        NearGoal { goal, near: self.near, aligned: self.aligned }
    }
}

/// The configurations of a car near a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearGoal {
    /// The goal.
    pub goal: HitchCfg,
    /// The greatest distance of the rear axles, metres.
    pub near: f64,
    /// The greatest difference of each heading, the car's and the trailer's, radians.
    pub aligned: f64,
}

impl GoalRegion<HitchCfg> for NearGoal {
    fn contains(&self, q: &HitchCfg) -> bool {
        let NearGoal { goal, near, aligned } = self;
        let off = |a: f64, b: f64| wrap(a - b).abs();
        let trailers = match (q.trailer, goal.trailer) {
            (Some(a), Some(b)) => off(a, b) <= *aligned,
            (None, None) => true,
            _ => false,
        };
        trailers
            && hypot(q.body.x - goal.body.x, q.body.y - goal.body.y) <= *near
            && off(q.body.theta, goal.body.theta) <= *aligned
    }
}
