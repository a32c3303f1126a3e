//! An arm along a path: a target in every tick.

use super::rehearsal::{Rehearsal, quantized};
use super::{PlayError, PlayStage, PlayablePath, PlayedPath};
use crate::run::{DT, RobotInput};
use motion_lab_core::configuration::{Configuration, RobotKind, Tn};
use motion_lab_core::num::greater;
use motion_lab_core::planning::{LinePath, is_same};
use motion_lab_core::robots::Reach;

/// The greatest rate at which a joint turns, radians per second: that of the arm's tour.
const JOINT_RATE: f64 = 2.0;

impl PlayablePath for LinePath<Reach<2>> {
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        play_two(&self.corners(), stage)
    }
}

impl PlayablePath for LinePath<Reach<3>> {
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        play_three(&self.corners(), stage)
    }
}

/// Plays the path of an arm with two links through these corners.
pub(super) fn play_two(corners: &[Tn<2>], stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
    play(corners, Rehearsal::new(&Reach::<2>::workbench(), RobotKind::REACH.name, stage)?)
}

/// Plays the path of an arm with three links through these corners.
pub(super) fn play_three(corners: &[Tn<3>], stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
    play(corners, Rehearsal::new(&Reach::<3>::redundant(), RobotKind::REACH3.name, stage)?)
}

/// Moves the arm along each line in ticks of one length, so that no joint turns faster than [`JOINT_RATE`]. The targets
/// are rounded to the script's units; that is how far the arm strays.
fn play<const N: usize>(corners: &[Tn<N>], mut rehearsal: Rehearsal<Reach<N>>) -> Result<PlayedPath, PlayError> {
    let Some(mut at) = corners.first().copied() else {
        return rehearsal.end(0.0);
    };
    if !is_same(&at, &rehearsal.q()) {
        rehearsal.teleport(&at.coordinates())?;
    }
    rehearsal.stray(rehearsal.off(&at)?)?;
    for corner in &corners[1..] {
        let source = |source: motion_lab_core::configuration::ChartMismatch| source.into();
        let refused = |source| PlayError::Configuration { tick: rehearsal.tick() + 1, source };
        let turns = at.difference(corner).map_err(source).map_err(refused)?;
        let most = turns.iter().fold(0.0, |most, turn| greater(turn.abs(), most));
        let ticks = greater((most / (JOINT_RATE * DT)).ceil(), 1.0);
        let mut tick = 0.0;
        while tick < ticks {
            tick += 1.0;
            let planned: Tn<N> = at.interpolate(corner, tick / ticks).unwrap_or(*corner);
            rehearsal.input(RobotInput::MoveTo(quantized(&planned.coordinates())?))?;
            rehearsal.step()?;
            // both ends of the tick's line are this near to the path's line, and so is all between them
            rehearsal.stray(rehearsal.off(&planned)?)?;
        }
        at = *corner;
    }
    let missed = rehearsal.off(&at)?;
    rehearsal.end(missed)
}
