//! `Reversing`, Hitch's tour: six legs, forward and back in turn.

use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{CarCmd, Hitch};

/// The number of legs; after the last the script starts over.
pub const LEGS: usize = 6;

/// The length of a leg, seconds.
pub const LEG_SECONDS: f64 = 10.0;

/// The script's speed as a fraction of the car's greatest speed.
const SPEED: f64 = 0.5;

/// Hitch's tour: six legs of 10 s, backward and forward in turn, then again from the first. Each leg has a steering
/// angle drawn from the seed, radians. Legs count from 0: even legs back up, odd legs go ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversing {
    steering: [f64; LEGS],
}

impl Reversing {
    /// The script that the seed chooses for the car named `name`, from its stream `<name>/tour`: steering angles spread
    /// over the inner nine tenths of what the car can steer.
    pub fn new(seed: Seed, name: &str, car: &Hitch) -> Self {
        let mut draws = Stream::new(seed, &format!("{name}/tour"));
        Reversing { steering: [(); LEGS].map(|()| 0.9 * car.max_steer * draws.uniform(-1.0, 1.0)) }
    }

    /// The command of tick number `tick` (from 1) of `dt` seconds each.
    pub fn command(&self, car: &Hitch, tick: u64, dt: f64) -> CarCmd {
        let ticks_per_leg = (LEG_SECONDS / dt).round() as u64;
        // the step of tick 1 begins at time 0
        let leg = (tick.saturating_sub(1) / ticks_per_leg.max(1)) as usize % LEGS;
        let direction = if leg.is_multiple_of(2) { -1.0 } else { 1.0 };
        CarCmd { v: direction * SPEED * car.max_speed, phi: self.steering[leg] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::robots::HITCH;

    #[test]
    fn six_legs_of_ten_seconds_reverse_in_turn() {
        let script = Reversing::new(Seed(2005), "hitch", &HITCH);
        let commands: Vec<CarCmd> = (1..=1200).map(|t| script.command(&HITCH, t, 0.05)).collect();
        for leg in commands.chunks(200) {
            assert!(leg.iter().all(|u| u == &leg[0] && u.phi.abs() <= 0.9 * HITCH.max_steer));
        }
        let reversals = commands.windows(2).filter(|w| w[0].v * w[1].v < 0.0).count();
        assert_eq!(reversals, LEGS - 1);
        assert_eq!(script.command(&HITCH, 1201, 0.05), commands[0], "and over again");
        assert_ne!(script, Reversing::new(Seed(2006), "hitch", &HITCH));
    }
}
