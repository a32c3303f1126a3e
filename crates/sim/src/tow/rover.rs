//! A rover that is towed: it turns to what pulls it, and goes.

use super::command::{TowCommand, TowState, channel};
use super::pull::Pull;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::{atan2, cos, hypot};
use motion_lab_core::robots::Rusty;

/// Distance at which the grip has arrived, metres.
const ARRIVAL: f64 = 0.02;

/// Speed per metre of way, per second.
const GAIN: f64 = 2.0;

/// Turn rate per radian off the aim's bearing, per second.
const TURNING_GAIN: f64 = 4.0;

/// Angle off the aim's bearing beyond which the rover turns on the spot, radians.
const TURN_ON_THE_SPOT: f64 = 0.6;

/// The command for the pull. Gripped behind its centre, the rover turns its back to the aim and backs up.
pub(super) fn command(rover: &Rusty, pull: &Pull) -> TowCommand {
    if pull.is_within(ARRIVAL) {
        return TowCommand::REST;
    }
    let side = if pull.grip < 0.0 { -1.0 } else { 1.0 };
    let aim = Point2::new(side * pull.aim.x, side * pull.aim.y);
    let off = atan2(aim.y, aim.x);
    let way = hypot(aim.x, aim.y) - pull.grip.abs();
    let speed = if off.abs() > TURN_ON_THE_SPOT { 0.0 } else { side * pull.rate(way, GAIN) * cos(off) };
    let turn = pull.rate(off, TURNING_GAIN);
    let channels = [channel(speed, rover.max_speed), channel(turn, rover.max_turn_rate)];
    TowCommand { channels, state: TowState::Goes }
}
