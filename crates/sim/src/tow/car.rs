//! A car that is towed, with a trailer or without: pure pursuit from its rear axle.

use std::f64::consts::FRAC_PI_2;

use super::command::{TowCommand, TowState, channel};
use super::pull::Pull;
use motion_lab_core::configuration::HitchCfg;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::{acos, atan2, lesser, sin, wrap};
use motion_lab_core::robots::Hitch;

/// Distance at which the grip has arrived, metres.
const ARRIVAL: f64 = 0.05;

/// Speed per metre of way, per second.
const GAIN: f64 = 1.2;

/// How much tighter than the car turns an arc may be for the car to begin it: what rounded channels make of the limit.
const ALMOST: f64 = 1.05;

/// Way over which a trailer's fold comes to a third of its error while the car backs up, metres.
const FOLDING: f64 = 0.8;

/// The longest way back by one command with a trailer on, metres: what it folds must be seen.
const BACK_AT_ONCE: f64 = 0.3;

/// Parts of the greatest fold that steering can open again: what backing up asks for, and where it ends.
const PART_ASKED: f64 = 0.6;
const PART_ALLOWED: f64 = 0.9;

/// A way to the aim: how sharply to the left, per metre, and how far, metres, backward below 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CarWay {
    curvature: f64,
    length: f64,
}

/// The command for the pull.
pub(super) fn command(car: &Hitch, q: &HitchCfg, pull: &Pull) -> TowCommand {
    if pull.is_within(ARRIVAL) {
        return TowCommand::REST;
    }
    let fold = q.hitch_angle();
    let tightest = tightest(car, fold);
    let Some(way) = arc_to(pull, tightest).or_else(|| straight_on(pull, tightest)) else {
        let channels = [0, channel(car.max_steer.copysign(pull.way().y), car.max_steer)];
        return TowCommand { channels, state: TowState::OnlySteers };
    };
    match fold.filter(|_| way.length < 0.0) {
        None => go(car, way.curvature, pull.rate(way.length, GAIN)),
        Some(fold) => back_up(car, fold, way, pull),
    }
}

/// The arc on which the grip comes to the aim, the shorter way round; `None` where the car cannot turn so sharply.
///
/// About the centre `(0, R)` of the rear axle's arc the aim is as far off as the grip `(g, 0)`:
/// `x^2 + (y - R)^2 = g^2 + R^2`.
fn arc_to(pull: &Pull, tightest: f64) -> Option<CarWay> {
    let Pull { grip, aim, .. } = *pull;
    let curvature = if aim.y == 0.0 { 0.0 } else { 2.0 * aim.y / (aim.x * aim.x + aim.y * aim.y - grip * grip) };
    if curvature.abs() > ALMOST * tightest {
        return None;
    }
    let radius = 1.0 / curvature;
    let bearing = |point: Point2| atan2(point.y - radius, point.x);
    let length = if radius.is_finite() && curvature.abs() > STRAIGHT {
        radius * wrap(bearing(aim) - bearing(Point2::new(grip, 0.0)))
    } else {
        pull.way().x
    };
    Some(CarWay { curvature: curvature.clamp(-tightest, tightest), length })
}

/// Curvature below which an arc is as good as straight, per metre.
const STRAIGHT: f64 = 1e-6;

/// As far toward an aim within the turning circle as it is rather ahead or behind than abeam, steered as sharply as can
/// be; `None` abeam.
fn straight_on(pull: &Pull, tightest: f64) -> Option<CarWay> {
    let way = pull.way();
    let outside = pull.aim.coords.norm_squared() - pull.grip * pull.grip;
    let is_along = way.x.abs() > way.y.abs();
    is_along.then(|| CarWay { curvature: tightest.copysign(pull.aim.y * outside), length: way.x })
}

/// The sharpest curvature that the car may be asked for: with a trailer, one that folds it within its limit.
fn tightest(car: &Hitch, fold: Option<f64>) -> f64 {
    let own = car.curvature(car.max_steer);
    let limit = car.jackknife.filter(|limit| fold.is_some() && *limit < FRAC_PI_2);
    limit.zip(car.hitch_len).map_or(own, |(limit, bar)| lesser(own, sin(PART_ALLOWED * limit) / bar))
}

/// Backs up with the trailer folded by `fold`.
///
/// For each metre back the fold grows by `sin(fold) / bar + curvature`, so the wheels steer the trailer: to the fold at
/// which the car follows the arc, `sin(fold) = -bar * curvature`. Folded farther than sharp steering can open, the car
/// stands.
fn back_up(car: &Hitch, fold: f64, way: CarWay, pull: &Pull) -> TowCommand {
    let (own, bar) = (car.curvature(car.max_steer), car.hitch_len.unwrap_or(f64::INFINITY));
    let open = lesser(arc_sine(own * bar), car.jackknife.unwrap_or(FRAC_PI_2));
    if fold.abs() > PART_ALLOWED * open {
        return TowCommand { channels: [0, 0], state: TowState::Folded };
    }
    let asked = (-arc_sine(bar * way.curvature)).clamp(-PART_ASKED * open, PART_ASKED * open);
    let curvature = -sin(fold) / bar - (fold - asked) / FOLDING;
    let most = BACK_AT_ONCE / pull.held;
    go(car, curvature, pull.rate(way.length, GAIN).clamp(-most, most))
}

/// The angle of this sine, the nearest where there is none.
fn arc_sine(sine: f64) -> f64 {
    FRAC_PI_2 - acos(sine.clamp(-1.0, 1.0))
}

/// The command for a curvature, per metre, and a speed, metres per second.
fn go(car: &Hitch, curvature: f64, speed: f64) -> TowCommand {
    let steering = atan2(curvature * car.wheelbase, 1.0);
    let channels = [channel(speed, car.max_speed), channel(steering, car.max_steer)];
    TowCommand { channels, state: TowState::Goes }
}
