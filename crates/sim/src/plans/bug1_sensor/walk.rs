//! `Bug1Walk`, Bug1 by its sensor step by step.

use super::round::{BACK, Lap, Lapped, Round};
use super::rover::{Eyes, KEEP, NOISE, Rover, STEP, Side};
use motion_lab_core::collision::DiscChecker;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::greater;
use motion_lab_core::planning::{LeavePoint, RoundEnd, Sensed};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{ChartLine, RustyDisc};
use motion_lab_core::sensors::BeamModel;

/// The largest number of rounds.
const ROUNDS: usize = 20;

/// Why a walk has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkEnd {
    /// It is within a step of its goal.
    Reached,
    /// It never closed a round.
    NotClosed,
    /// It never came back to where the boundary had seemed nearest to the goal.
    NotFound,
    /// It saw the goal behind the obstacle at the place that had seemed nearest to the goal.
    Behind,
    /// It has made 20 rounds.
    TooManyRounds,
}

/// What the next step does.
#[derive(Clone, Debug)]
enum WalkPhase {
    /// Goes straight to the goal; `bumps` is the number of steps that a wall had stopped before.
    Head { bumps: u32 },
    /// Follows the boundary all the way round.
    Round(Lap),
    /// Returns to the leave point by the shorter way, at the tick `last` at the latest.
    Return { round: Round, side: Side, last: u64 },
}

/// The same round by exact nearest points, by which a leave point is judged.
#[derive(Clone, Debug)]
struct Judge {
    rover: Rover,
    lap: Lap,
    lapped: Lapped,
}

impl Judge {
    fn new(rover: &Rover) -> Self {
        let rover = rover.seeing_truth();
        Judge { lap: Lap::new(&rover), rover, lapped: Lapped::Going }
    }

    /// Goes a step on; false when its round has ended.
    fn step(&mut self) -> bool {
        if let Lapped::Going = self.lapped {
            self.lapped = self.lap.step(&mut self.rover);
        }
        matches!(self.lapped, Lapped::Going)
    }

    /// Where the boundary comes nearest to the goal; `None` where the round never closes.
    fn nearest(&mut self) -> Option<Point2> {
        while self.step() {}
        if let Lapped::Closed(round) = self.lapped { Some(round.leave) } else { None }
    }
}

/// Bug1 (Lumelsky and Stepanov, 1987) for a disc that knows where it is and sees walls by its range sensor alone.
///
/// It heads for the goal. At an obstacle it goes all the way round, remembers where the boundary seems nearest to the
/// goal, returns there by the shorter way, and leaves for the goal. It keeps [`KEEP`](Self::KEEP) metres from the
/// nearest reading, with the wall at its right hand. So "the obstacle" is everything that has no gap wider than twice
/// that. If the goal then lies behind the obstacle, it ends.
///
/// Beside it another goes the same round by exact nearest points, which judges its leave point.
#[derive(Clone, Debug)]
pub struct Bug1Walk {
    rover: Rover,
    phase: WalkPhase,
    judge: Option<Judge>,
    leave_points: Vec<LeavePoint>,
    end: Option<WalkEnd>,
}

impl Bug1Walk {
    /// Distance that the centre of a disc of Rusty's size keeps from the boundary it follows, metres. A larger disc
    /// keeps the same clearance.
    pub const KEEP: f64 = KEEP;

    /// The noise of a cheap range sensor.
    pub const NOISE: BeamModel = NOISE;

    /// A walk from a start to a goal, with an exact sensor, or with a noisy one whose draws come from a stream.
    pub fn new(checker: &DiscChecker, ends: [Point2; 2], noise: Option<(BeamModel, Stream)>) -> Self {
        let eyes = noise.map_or(Eyes::Exact, |noise| Eyes::Noisy(Box::new(noise)));
        let rover = Rover::new(checker.clone(), eyes, ends);
        Bug1Walk { rover, phase: WalkPhase::Head { bumps: 0 }, judge: None, leave_points: Vec::new(), end: None }
    }

    /// Goes a step on at most. Returns why the walk has ended, if it has.
    pub fn step(&mut self) -> Option<WalkEnd> {
        if self.end.is_none() {
            self.rover.stopped = None;
            self.end = self.advance();
        }
        self.end
    }

    fn advance(&mut self) -> Option<WalkEnd> {
        let rover = &mut self.rover;
        match &mut self.phase {
            WalkPhase::Head { bumps } => {
                if rover.to_goal() <= STEP {
                    return Some(WalkEnd::Reached);
                }
                if rover.bumps > *bumps || rover.is_blocked() {
                    self.judge = Some(Judge::new(rover));
                    self.phase = WalkPhase::Round(Lap::new(rover));
                    return None;
                }
                rover.step(rover.goal - rover.at, STEP);
            }
            WalkPhase::Round(lap) => {
                let lapped = lap.step(rover);
                self.judge.as_mut().map(Judge::step);
                match lapped {
                    Lapped::Going => {}
                    Lapped::Closed(round) => self.phase = way_back(rover, round),
                    Lapped::Lost => return self.leave(RoundEnd::NotClosed, WalkEnd::NotClosed),
                }
            }
            WalkPhase::Return { round, side, last } => {
                let to = round.leave - rover.at;
                if to.norm() > BACK {
                    if rover.tick >= *last {
                        return self.leave(RoundEnd::NotFound, WalkEnd::NotFound);
                    }
                    rover.follow(*side);
                    return None;
                }
                // the rest of the way goes by its own position
                rover.step(to, greater(to.norm(), 1e-9));
                if rover.is_blocked() {
                    return self.leave(RoundEnd::Behind, WalkEnd::Behind);
                }
                rover.turn_to_goal();
                self.phase = WalkPhase::Head { bumps: rover.bumps };
                return self.leave(RoundEnd::Free, WalkEnd::TooManyRounds).filter(|_| self.rounds() >= ROUNDS);
            }
        }
        None
    }

    /// Notes the end of a round where the rover is. Returns `end`.
    fn leave(&mut self, leaving: RoundEnd, end: WalkEnd) -> Option<WalkEnd> {
        let (at, goal) = (self.rover.at, self.rover.goal);
        let nearest = self.judge.take().and_then(|mut judge| judge.nearest());
        let best = nearest.map_or(0.0, |place| (place - goal).norm());
        let excess = (at - goal).norm() - best;
        self.leave_points.push(LeavePoint { at, nearest, excess, leaving });
        Some(end)
    }

    /// Where it is.
    pub fn at(&self) -> Point2 {
        self.rover.at
    }

    /// The length of its way so far, metres.
    pub fn length(&self) -> f64 {
        self.rover.length
    }

    /// The number of steps that a wall stopped.
    pub fn bumps(&self) -> u32 {
        self.rover.bumps
    }

    /// The last step as it was meant, if a wall stopped it.
    pub fn stopped(&self) -> Option<&ChartLine<RustyDisc>> {
        self.rover.stopped.as_ref()
    }

    /// The number of rounds that have ended.
    pub fn rounds(&self) -> usize {
        self.leave_points.len()
    }

    /// Where it has left boundaries, a place for each round that has ended.
    pub fn leave_points(&self) -> &[LeavePoint] {
        &self.leave_points
    }

    /// The distance that its centre keeps from a boundary, metres.
    pub fn keep(&self) -> f64 {
        self.rover.keep()
    }

    /// What its sensor reads where it is, and where it has left boundaries.
    pub fn sensed(&self) -> Sensed {
        let ranges = self.rover.ranges().unwrap_or_default();
        Sensed { at: self.rover.at, ranges, leave_points: self.leave_points.clone() }
    }
}

/// The way back to a round's leave point.
fn way_back(rover: &Rover, round: Round) -> WalkPhase {
    let ahead = round.until_leave <= 0.5 * round.length;
    let (side, way) =
        if ahead { (Side::Right, round.until_leave) } else { (Side::Left, round.length - round.until_leave) };
    WalkPhase::Return { round, side, last: rover.tick + (1.5 * way / STEP) as u64 + 50 }
}
