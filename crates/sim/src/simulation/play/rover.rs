//! A rover along a path: a follower that corrects its slip.

use super::rehearsal::Rehearsal;
use super::{PlayError, PlayStage, PlayablePath, PlayedPath};
use crate::run::{DT, RobotInput};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::num::{atan2, greater, hypot, lesser, wrap};
use motion_lab_core::planning::LinePath;
use motion_lab_core::robots::{CHANNEL_UNITS, Motion, RUSTY, Rusty, RustyArc, RustyDisc};

/// How near a corner the rover turns to the next, metres.
const NEAR: f64 = 1e-3;

/// The angle from its line beyond which the rover turns on the spot, radians.
const TURNED: f64 = 0.05;

/// How sharply the rover turns back to its line, per metre beside it.
const TO_LINE: f64 = 6.0;

/// Part of the angle to be turned that a tick may turn: a wheel's slip then never turns the rover beyond it.
const PART: f64 = 0.8;

impl PlayablePath for LinePath<RustyDisc> {
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        play(self.corners().iter().map(|q| q.0).collect(), stage)
    }
}

impl PlayablePath for LinePath<Rusty> {
    /// Along the path of its centre: a disc's heading does not matter to what it covers, and is not followed.
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        play(self.corners().iter().map(Pose2::position).collect(), stage)
    }
}

#[derive(Clone, Copy)]
struct StraightPiece {
    from: Point2,
    to: Point2,
    along: Vector2,
    length: f64,
}

impl StraightPiece {
    /// The line between two points; `None` between a point and itself.
    fn new(from: Point2, to: Point2) -> Option<Self> {
        let (d, length) = (to - from, hypot(to.x - from.x, to.y - from.y));
        (length > 0.0).then(|| StraightPiece { from, to, along: d / length, length })
    }

    /// How far ahead along the line a point is, and how far to the left of it, metres.
    fn seen(&self, p: Point2) -> (f64, f64) {
        let d = p - self.from;
        (d.x * self.along.x + d.y * self.along.y, d.y * self.along.x - d.x * self.along.y)
    }

    /// How far a point is from the line's nearest point, metres.
    fn distance(&self, p: Point2) -> f64 {
        let (ahead, left) = self.seen(p);
        hypot(ahead - ahead.clamp(0.0, self.length), left)
    }
}

/// Turns the rover on the spot at each corner, and drives it along each line with its heading corrected.
pub(super) fn play(corners: Vec<Point2>, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
    let mut rehearsal = Rehearsal::new(&RUSTY, RobotKind::RUSTY.name, stage)?;
    let lines: Vec<StraightPiece> =
        corners.windows(2).filter_map(|ends| StraightPiece::new(ends[0], ends[1])).collect();
    let (Some(first), Some(last)) = (corners.first(), corners.last()) else {
        return rehearsal.end(0.0);
    };
    if *first != rehearsal.q().position() {
        let heading = lines.first().map_or(rehearsal.q().theta, |line| atan2(line.along.y, line.along.x));
        rehearsal.teleport(&[first.x, first.y, heading])?;
    }
    let mut held = None;
    for line in &lines {
        while let Some(channels) = channels(rehearsal.robot(), line, &rehearsal.q()) {
            if held != Some(channels) {
                rehearsal.input(RobotInput::Drive(channels[0], channels[1]))?;
                held = Some(channels);
            }
            let arc = rehearsal.step()?;
            rehearsal.stray(strays(line, &arc))?;
        }
    }
    if held.is_some_and(|channels| channels != [0, 0]) {
        rehearsal.input(RobotInput::Drive(0, 0))?;
    }
    let end = rehearsal.q().position();
    rehearsal.end(hypot(end.x - last.x, end.y - last.y))
}

/// How far the rover's centre is from a line during a tick's arc, at most, metres. The distance from a line is convex,
/// so along the chord it is greatest at an end, and the arc strays from its chord by no more than the sagitta.
fn strays(line: &StraightPiece, arc: &RustyArc) -> f64 {
    let ends = [0.0, 1.0].map(|s| line.distance(arc.at(s).position()));
    greater(ends[0], ends[1]) + arc.sagitta(0, 0.0, 1.0)
}

/// The channels for the next tick on a line; `None` at its end.
fn channels(rover: &Rusty, line: &StraightPiece, q: &Pose2) -> Option<[i16; 2]> {
    let (ahead, left) = line.seen(q.position());
    let remaining = line.length - ahead;
    let d = line.to - q.position();
    if remaining <= NEAR || hypot(d.x, d.y) <= NEAR {
        return None;
    }
    let wanted = atan2(line.along.y, line.along.x) - atan2(TO_LINE * left, 1.0);
    let turn = wrap(wanted - q.theta);
    let channel = |wanted: f64, most: f64| {
        let units = wanted / most * CHANNEL_UNITS;
        // rounded away from 0, so that the last of the way is driven at all
        (units.abs().ceil().copysign(units)).clamp(-CHANNEL_UNITS, CHANNEL_UNITS) as i16
    };
    let omega = channel(PART * turn / DT, rover.max_turn_rate);
    if turn.abs() > TURNED {
        return Some([0, omega]);
    }
    let speed = channel(lesser(PART * remaining / DT, rover.max_speed), rover.max_speed);
    Some([speed, omega])
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::num::{cos, sin};
    use motion_lab_core::random::{Seed, Stream};
    use motion_lab_core::robots::{Drivable, RustyCmd};

    /// How far a point is from a line between two points, by the nearest of ten thousand of its places.
    fn by_places(from: Point2, to: Point2, p: Point2) -> f64 {
        let place = |k: u32| from + (to - from) * (f64::from(k) / 1e4);
        (0..=10_000).fold(f64::INFINITY, |least, k| lesser(hypot(place(k).x - p.x, place(k).y - p.y), least))
    }

    /// A tick's arc by its circle, against a line that it begins and ends anywhere beside, ahead of and beyond.
    #[test]
    fn an_arc_strays_as_far_as_its_farthest_place_between_its_ends_too() {
        let (from, to) = (Point2::new(-1.0, 0.5), Point2::new(2.0, 1.5));
        let line = StraightPiece::new(from, to).unwrap();
        let mut draws = Stream::new(Seed(8), "arcs");
        let (mut between, mut beyond) = (0, 0);
        for _ in 0..60 {
            let start = Pose2::new(draws.uniform(-2.0, 3.0), draws.uniform(0.0, 2.0), draws.uniform(-3.0, 3.0));
            let (v, omega) = (draws.uniform(-1.0, 1.0), draws.uniform(0.1, 1.0));
            let arc = RUSTY.drive(&start, &RustyCmd { v, omega }, 1.0).unwrap();
            let radius = v / omega;
            let middle = Point2::new(start.x - radius * sin(start.theta), start.y + radius * cos(start.theta));
            let at = |u: f64| {
                let heading = start.theta + omega * u;
                Point2::new(middle.x + radius * sin(heading), middle.y - radius * cos(heading))
            };
            let off = |u: f64| by_places(from, to, at(u));
            let ends = greater(off(0.0), off(1.0));
            let farthest = (0..=20).fold(0.0, |most, k| greater(off(f64::from(k) / 20.0), most));
            let found = strays(&line, &arc);
            assert!(farthest <= found + 1e-7, "{farthest} m at {start:?}, {v} {omega}, not {found} m");
            // the height of the arc over its chord, and the little that a parabola is higher
            let height = radius.abs() * (1.0 - cos(0.5 * omega)) * (1.0 + omega * omega / 40.0);
            assert!(found <= ends + height + 1e-7, "{found} m is more than {ends} m and {height} m");
            between += u32::from(farthest > ends + 1e-3);
            let (ahead, _) = line.seen(at(if off(0.0) > off(1.0) { 0.0 } else { 1.0 }));
            beyond += u32::from(!(0.0..=line.length).contains(&ahead));
        }
        assert!(between > 2 && beyond > 5, "{between} are farthest between their ends, {beyond} beyond the line");
    }
}
