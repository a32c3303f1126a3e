//! `CarMove`, a control of the car that a script can hold, for whole ticks.

use crate::configuration::HitchCfg;
use crate::num::lesser;
use crate::planning::curves::{Curve, Turn};
use crate::robots::{CHANNEL_UNITS, CarCmd, ConfigurationError, Drivable, Hitch, HitchArc, TICK};

/// A constant control of the car, held for a whole number of ticks. Its two channels are integers in [`CHANNEL_UNITS`],
/// as scripts hold them. So the simulator drives a chain of moves to the same configuration, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CarMove {
    /// The speed channel.
    pub speed: i16,
    /// The steering channel, positive to the left.
    pub steering: i16,
    /// The number of ticks.
    pub ticks: u32,
}

impl CarMove {
    /// The control that a car takes from the channels.
    pub fn control(&self, car: &Hitch) -> CarCmd {
        CarCmd {
            v: f64::from(self.speed) / CHANNEL_UNITS * car.max_speed,
            phi: f64::from(self.steering) / CHANNEL_UNITS * car.max_steer,
        }
    }

    /// What the car drives from `q`.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this car.
    pub fn drive(&self, car: &Hitch, q: &HitchCfg) -> Result<HitchArc, ConfigurationError> {
        car.drive(q, &self.control(car), f64::from(self.ticks) * TICK)
    }

    /// The signed length of the way of the car's rear axle, metres.
    pub fn length(&self, car: &Hitch) -> f64 {
        self.control(car).v * (f64::from(self.ticks) * TICK)
    }

    /// The moves over this signed length, metres, with the wheels at a steering channel: ticks at full speed, and a
    /// last one slower. They are right to half a unit of the speed channel in one tick: 0.3 mm for the lab's car.
    pub fn over(car: &Hitch, length: f64, steering: i16) -> impl Iterator<Item = CarMove> {
        let a_tick = car.max_speed * TICK;
        let sign = if length < 0.0 { -1 } else { 1 };
        let (whole, units) = {
            let ticks = length.abs() / a_tick;
            let whole = ticks.floor();
            let units = ((ticks - whole) * CHANNEL_UNITS).round_ties_even();
            // a whole tick's units are one more whole tick
            if units >= CHANNEL_UNITS { (whole + 1.0, 0.0) } else { (whole, units) }
        };
        let whole = lesser(whole, f64::from(u32::MAX)) as u32;
        let full = CarMove { speed: sign * CHANNEL_UNITS as i16, steering, ticks: whole };
        let last = CarMove { speed: sign * units as i16, steering, ticks: u32::from(units > 0.0) };
        [full, last].into_iter().filter(|m| m.ticks > 0)
    }

    /// The moves along a curve whose arcs are the car's tightest.
    pub fn along(car: &Hitch, curve: &Curve) -> Vec<CarMove> {
        let steering = |turn: Turn| (turn.sign() * CHANNEL_UNITS) as i16;
        curve.pieces().iter().flat_map(|piece| CarMove::over(car, piece.length, steering(piece.turn))).collect()
    }
}
