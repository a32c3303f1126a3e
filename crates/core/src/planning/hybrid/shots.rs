//! Shots: moves that lead straight to a goal where nothing is in the way.

use super::{CarMove, HybridSettings};
use crate::collision::Problem;
use crate::configuration::HitchCfg;
use crate::num::{atan2, cos, lesser, sin, wrap};
use crate::planning::curves::reeds_shepp;
use crate::robots::{CHANNEL_UNITS, Hitch, Motion, TICK};

/// The greatest number of moves of a shot that follows a line.
const MAX_MOVES: usize = 100;

/// The number of ticks between two changes of the steering.
const HELD: u32 = 2;

/// How sharply the trailer turns toward the line, per metre beside it.
const TO_LINE: f64 = 0.35;

/// How fast the trailer takes the heading that leads to the line, per metre driven.
const TURNING: f64 = 0.9;

/// How fast the hitch takes the angle that turns the trailer so, per metre driven.
const FOLDING: f64 = 1.8;

/// Part of the sine of the greatest fold that the tightest turn keeps, up to which the trailer is folded.
const HELD_FOLD: f64 = 0.8;

/// How much farther a trailer may be beside its line than it has to go back, metres.
const BESIDE: f64 = 1.0;

/// The greatest angle of a trailer to its line, radians.
const ACROSS: f64 = 1.2;

/// The moves of a shot, and where they lead.
pub(super) struct Shot {
    pub(super) moves: Vec<CarMove>,
    pub(super) end: HitchCfg,
}

/// The shots from `q` that solve a problem if they are free: along Reeds and Shepp's curve, and with a trailer
/// backward onto the goal's line.
pub(super) fn shots(problem: &Problem<Hitch>, q: &HitchCfg, settings: &HybridSettings) -> Vec<Shot> {
    let (car, goal) = (problem.checker().robot(), &problem.goal());
    let along =
        reeds_shepp(&q.body, &goal.body, car.tightest()).and_then(|curve| shot(car, q, CarMove::along(car, &curve)));
    let backward = backward_onto_line(car, q, goal, settings);
    [along, backward].into_iter().flatten().filter(|shot| problem.is_goal(&shot.end)).collect()
}

fn shot(car: &Hitch, q: &HitchCfg, moves: Vec<CarMove>) -> Option<Shot> {
    let mut end = *q;
    for m in &moves {
        end = m.drive(car, &end).ok()?.at(1.0);
    }
    Some(Shot { moves, end })
}

/// Backs a trailer onto the line along which it stands at the goal, and along it to the goal.
///
/// Going back, the trailer is what is steered, by the hitch's angle. Three loops, one within the other: the distance
/// from the line asks for a heading of the trailer, that for an angle of the hitch, and that for a curvature of the
/// car's way. `None` where the goal does not lie behind, where the hitch would fold too far, or the way is too long.
fn backward_onto_line(car: &Hitch, q: &HitchCfg, goal: &HitchCfg, settings: &HybridSettings) -> Option<Shot> {
    let (hitch_len, line) = (car.hitch_len?, goal.trailer?);
    let ahead = |q: &HitchCfg| {
        (q.body.x - goal.body.x) * cos(goal.body.theta) + (q.body.y - goal.body.y) * sin(goal.body.theta)
    };
    // beyond the fold that the tightest turn keeps, backing only folds the hitch further
    let most = lesser(HELD_FOLD * hitch_len * car.curvature(car.max_steer), settings.most_fold);
    let a_move = car.max_speed * TICK * f64::from(HELD);
    let (mut end, mut moves) = (*q, Vec::new());
    while moves.len() < MAX_MOVES {
        let left = ahead(&end);
        let psi = end.trailer?;
        let hitch = wrap(end.body.theta - psi);
        if hitch.abs() > settings.most_fold || left > a_move * MAX_MOVES as f64 {
            return None;
        }
        if left <= 0.0 {
            break;
        }
        // the trailer's axle, to the left of the line
        let (x, y) = (end.body.x - hitch_len * cos(psi), end.body.y - hitch_len * sin(psi));
        let beside = (y - goal.body.y) * cos(line) - (x - goal.body.x) * sin(line);
        let heading = wrap(psi - line);
        // too far beside the line, or across it: nothing that backing alone could mend
        if beside.abs() > left + BESIDE || heading.abs() > ACROSS {
            return None;
        }
        // going back: beside' = -sin(heading), heading' = -sin(hitch) / d, hitch' = sin(hitch) / d - curvature
        let wanted_heading = atan2(TO_LINE * beside, 1.0);
        let turn = (hitch_len * TURNING * (heading - wanted_heading)).clamp(-most, most);
        let curvature = sin(hitch) / hitch_len + FOLDING * (hitch - turn);
        let phi = atan2(car.wheelbase * curvature, 1.0).clamp(-car.max_steer, car.max_steer);
        let steering = (phi / car.max_steer * CHANNEL_UNITS).round_ties_even() as i16;
        let next = if left < a_move {
            let last: Vec<CarMove> = CarMove::over(car, -left, steering).collect();
            if last.is_empty() {
                break;
            }
            last
        } else {
            vec![CarMove { speed: -(CHANNEL_UNITS as i16), steering, ticks: HELD }]
        };
        for m in next {
            end = m.drive(car, &end).ok()?.at(1.0);
            moves.push(m);
        }
    }
    Some(Shot { moves, end })
}
