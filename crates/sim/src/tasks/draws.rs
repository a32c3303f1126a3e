//! Starts and goals, drawn where they are free.

use crate::run::{Quantized, RobotInput};
use motion_lab_core::random::Stream;

/// Largest number of draws, after which the last one stays, free or not.
const MAX_DRAWS: usize = 1_000;

/// The first of the draws that is as it should be; the last one if none is.
pub(super) fn first<T>(draws: &mut Stream, mut draw: impl FnMut(&mut Stream) -> T, is_right: impl Fn(&T) -> bool) -> T {
    let mut drawn = draw(draws);
    for _ in 1..MAX_DRAWS {
        if is_right(&drawn) {
            break;
        }
        drawn = draw(draws);
    }
    drawn
}

/// The nearest coordinate that a script holds, as a number.
pub(super) fn held(x: f64) -> f64 {
    Quantized::try_new(x).map_or(x, Quantized::value)
}

/// The coordinates as scripts hold them; those that no script could hold are 0.
pub(super) fn quantized<const N: usize>(coordinates: [f64; N]) -> Vec<Quantized> {
    coordinates.iter().map(|x| Quantized::try_new(*x).unwrap_or(Quantized(0))).collect()
}

/// The channels that two numbers in `[-1, 1]` stand for.
pub(super) fn channels(action: &[f32]) -> RobotInput {
    let of = |part: Option<&f32>| (f64::from(*part.unwrap_or(&0.0)) * 128.0).round_ties_even() as i16;
    RobotInput::Drive(of(action.first()), of(action.get(1)))
}

/// Writes these numbers into the first places of an observation; returns the rest of it.
pub(super) fn write<const N: usize>(numbers: [f64; N], observation: &mut [f32]) -> &mut [f32] {
    let (places, rest) = observation.split_at_mut(N.min(observation.len()));
    for (place, number) in places.iter_mut().zip(numbers) {
        *place = number as f32;
    }
    rest
}
