//! A car along a path: its channels, held for whole ticks.

use super::rehearsal::Rehearsal;
use super::{PlayError, PlayStage, PlayablePath, PlayedPath};
use crate::run::RobotInput;
use motion_lab_core::configuration::{Configuration, HitchCfg, RobotKind};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::planning::hybrid::CarMove;
use motion_lab_core::planning::{CertifiedPath, is_same};
use motion_lab_core::robots::{CHANNEL_UNITS, HITCH, Hitch, HitchArc, Motion, TICK};

/// How much faster than it can a leg may ask the car to go: what rounding makes of the greatest speed.
const ROUNDING: f64 = 1.0 + 1e-9;

/// How near a leg is to whole ticks and to a channel to be driven as it is, in units of each.
const EXACT: f64 = 1e-6;

impl PlayablePath for CertifiedPath<HitchArc> {
    /// Legs whose controls the channels can hold, in whole ticks, are driven bit for bit. Any other leg is driven at
    /// the nearest channels, its last tick slower, so that it is as long as the path's to 0.3 mm.
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        let mut rehearsal = Rehearsal::new(&HITCH, RobotKind::HITCH.name, stage)?;
        set_up(&mut rehearsal, &self.start())?;
        rehearsal.stray(rehearsal.off(&self.start())?)?;
        let (mut held, mut last) = (None, 0.0);
        for (number, leg) in self.legs().iter().enumerate() {
            let arc = leg.motion();
            let length = arc.control().v * arc.seconds();
            let (mut driven, mut before) = (0.0, 0.0);
            let moves = moves(rehearsal.robot(), number, arc)?;
            for m in moves {
                let a_tick = CarMove { ticks: 1, ..m };
                for _ in 0..m.ticks {
                    if held != Some((m.speed, m.steering)) {
                        rehearsal.input(RobotInput::Drive(m.speed, m.steering))?;
                        held = Some((m.speed, m.steering));
                    }
                    let motion = rehearsal.step()?;
                    driven += a_tick.length(rehearsal.robot()).abs();
                    let s = if length == 0.0 { 1.0 } else { lesser(driven / length.abs(), 1.0) };
                    let s = snapped(s, arc.ticks());
                    let off = rehearsal.off(&arc.at(s))?;
                    let farther = greater(off, last);
                    rehearsal.stray(if farther == 0.0 { 0.0 } else { farther + bends(&motion, arc, before, s) })?;
                    (before, last) = (s, off);
                }
            }
        }
        let missed = rehearsal.off(&self.goal())?;
        if held.is_some_and(|channels| channels.0 != 0) {
            rehearsal.input(RobotInput::Drive(0, 0))?;
        }
        rehearsal.end(missed)
    }
}

/// How far a tick's motion and a stretch of an arc, both as fast as their chords, may stray from these, metres.
fn bends(tick: &HitchArc, arc: &HitchArc, from: f64, to: f64) -> f64 {
    let parts = 0..tick.footprint_at(0.0).parts().len();
    parts.fold(0.0, |most, k| greater(tick.sagitta(k, 0.0, 1.0) + arc.sagitta(k, from, to), most))
}

/// The parameter itself, or that of the end of a tick where it is one but for rounding.
fn snapped(s: f64, ticks: f64) -> f64 {
    let nearest = (s * ticks).round();
    if (s * ticks - nearest).abs() < EXACT { lesser(nearest / ticks, 1.0) } else { s }
}

/// Puts the car where the path begins, with its trailer or without.
fn set_up(rehearsal: &mut Rehearsal<Hitch>, start: &HitchCfg) -> Result<(), PlayError> {
    let coordinates = start.in_chart().coordinates();
    if !is_same(&start.body, &rehearsal.q().body) {
        rehearsal.teleport(&coordinates[..3])?;
    }
    if start.trailer.is_some() != rehearsal.q().trailer.is_some() {
        rehearsal.input(RobotInput::SetTrailer(start.trailer.is_some()))?;
    }
    // the trailer now stands straight behind the car, or as at the run's start
    let straight = start.trailer.zip(rehearsal.q().trailer).is_none_or(|(a, b)| a == b);
    let behind = start.trailer == Some(start.body.theta) && rehearsal.q().trailer == Some(rehearsal.q().body.theta);
    if straight || behind { Ok(()) } else { rehearsal.teleport(&coordinates) }
}

/// The moves that drive an arc.
fn moves(car: &Hitch, leg: usize, arc: &HitchArc) -> Result<Vec<CarMove>, PlayError> {
    let (control, seconds) = (arc.control(), arc.seconds());
    if control.v.abs() > car.max_speed * ROUNDING || seconds < 0.0 {
        let speed = if seconds < 0.0 { -control.v } else { control.v };
        return Err(PlayError::Speed { leg, speed, most: car.max_speed });
    }
    let channel = |part: f64| (part * CHANNEL_UNITS).clamp(-CHANNEL_UNITS, CHANNEL_UNITS).round_ties_even() as i16;
    let steering = channel(if car.max_steer > 0.0 { control.phi / car.max_steer } else { 0.0 });
    let (ticks, speed) = (seconds / TICK, channel(control.v / car.max_speed));
    let near = |x: f64, whole: f64| (x - whole).abs() <= EXACT;
    if near(ticks, ticks.round()) && near(control.v / car.max_speed * CHANNEL_UNITS, f64::from(speed)) {
        return Ok(vec![CarMove { speed, steering, ticks: ticks.round() as u32 }]);
    }
    Ok(CarMove::over(car, control.v * seconds, steering).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::{Footprint, Point2, Pose2};
    use motion_lab_core::num::{atan2, hypot};
    use motion_lab_core::random::{Seed, Stream};
    use motion_lab_core::robots::{CarCmd, Drivable};

    /// How far the corners of each part are from their places in another footprint, at most, metres.
    fn apart(a: &Footprint, b: &Footprint) -> Vec<f64> {
        let far = |(p, q): (&Point2, &Point2)| hypot(p.x - q.x, p.y - q.y);
        let parts = a.parts().iter().zip(b.parts());
        let corners = parts.map(|(a, b)| a.placed().core().iter().zip(b.placed().core()));
        corners.map(|pairs| pairs.map(far).fold(0.0, |most, d| greater(d, most))).collect()
    }

    /// Two arcs over one chord, one to its left and one to its right, as a lens: they are farthest apart in the middle.
    #[test]
    fn two_motions_stray_from_one_another_by_no_more_than_at_their_ends_and_by_both_bends() {
        let mut draws = Stream::new(Seed(9), "lenses");
        let (mut sharp, mut by_trailers) = (0, 0);
        for round in 0..200 {
            let car = if round % 2 == 0 { HITCH } else { HITCH.with_trailer() };
            let folded = |theta: f64, fold: f64| car.hitch_len.map(|_| theta - fold);
            let v = draws.uniform(0.5, 1.5) * [1.0, -1.0][round / 2 % 2];
            let (fold, seconds) = (draws.uniform(-0.9, 0.9), draws.uniform(1.0, 90.0));
            // the whole turn is small, so that a parabola is as high as the arc
            let phi = atan2(car.wheelbase * draws.uniform(0.1, 0.7), v.abs() * seconds);
            let theta = draws.uniform(-3.0, 3.0);
            let start = HitchCfg { body: Pose2::new(0.0, 0.0, theta), trailer: folded(theta, fold) };
            let arc = car.drive(&start, &CarCmd { v, phi }, seconds).unwrap();
            let (from, to) = (draws.uniform(0.0, 0.4), draws.uniform(0.6, 1.0));
            let [a, b] = [from, to].map(|s| arc.at(s).body);
            // the same stretch mirrored at its chord
            let mirrored = 2.0 * atan2(b.y - a.y, b.x - a.x) - a.theta;
            let begin = HitchCfg { body: Pose2::new(a.x, a.y, mirrored), trailer: folded(mirrored, -fold) };
            let tick = car.drive(&begin, &CarCmd { v, phi: -phi }, seconds * (to - from)).unwrap();
            let end = tick.at(1.0).body;
            assert!(hypot(end.x - b.x, end.y - b.y) < 1e-6, "they meet again");
            let off = |u: f64| apart(&tick.footprint_at(u), &arc.footprint_at(from + u * (to - from)));
            let (first, last, bound) = (off(0.0), off(1.0), bends(&tick, &arc, from, to));
            for k in 1..32 {
                for (part, off) in off(f64::from(k) / 32.0).into_iter().enumerate() {
                    let ends = greater(first[part], last[part]);
                    assert!(off <= ends + bound + 1e-9, "part {part}: {off} m, {ends} m at the ends and {bound} m");
                    sharp += u32::from(off > ends + 0.6 * bound);
                    by_trailers += u32::from(part == 1 && off > ends);
                }
            }
        }
        assert!(sharp > 20 && by_trailers > 20, "{sharp} come near the bound, {by_trailers} of trailers");
    }
}
