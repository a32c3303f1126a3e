//! The check of a frame against the frame before it and the script.

use std::f64::consts::TAU;

use motion_lab_core::geometry::{Placed, Point2};
use motion_lab_sim::run::{Frame, RobotState};

use super::cases::{Case, SENSOR};
use super::inputs::{apply, motion_of};
use super::meetings::{Answer, Cut, NEAR, clearance, sweeps_meet};
use super::rays::is_range;
use super::robots::{Kind, Motion, shapes};
use oracle::short;

/// Largest error of a coordinate against the equations, metres or radians.
const TOLERANCE: f64 = 1e-9;

/// Least clearance at the end of a motion, metres, unless it started nearer.
const LEAST: f64 = 1e-5;

/// The number of ticks for which a flash holds.
const FLASH: u32 = 6;

/// Counts of what happened: one for each robot and tick, and counts of inputs and rays.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Robots on wheels whose motion was free.
    pub free: u64,
    /// Robots held at an obstacle.
    pub at_obstacle: u64,
    /// Robots held at another robot.
    pub at_robot: u64,
    /// Robots that stayed where they started, because their sweep met that of a lower id.
    pub yielded: u64,
    /// Robots that started in contact with an arm.
    pub pinned: u64,
    /// Robots that stood still and touched nothing.
    pub still: u64,
    /// Arms that hit nothing, and those that hit something.
    pub arm_free: u64,
    pub arm_hit: u64,
    /// Robots so near to something that both contact and no contact are accepted.
    pub undecided: u64,
    /// Inputs that were refused.
    pub refused: u64,
    /// Accepted teleports and trailer changes, and trailers put on.
    pub put: u64,
    pub hitched: u64,
    /// Rays.
    pub hits: u64,
    pub misses: u64,
}

/// A robot's plan for the tick.
struct Plan {
    kind: Kind,
    motion: Motion,
    /// Everything it may not touch: obstacles, and the other robots at their starts.
    around: Vec<Placed>,
    cut: Cut,
}

/// Checks the frame `after`. The error says what is wrong with it.
pub fn judge(case: &Case, before: &Frame, after: &Frame, tally: &mut Tally) -> Result<(), String> {
    let tick = before.tick + 1;
    ensure(after.tick == tick && after.robots.len() == case.residents.len(), || "is not the run's next frame".into())?;
    let mut robots = before.robots.clone();
    for event in case.script.events.iter().filter(|e| e.tick == tick) {
        apply(case, &mut robots, event);
    }
    for (now, was) in robots.iter().zip(&before.robots) {
        tally.refused += u64::from(now.refusals - was.refusals);
        tally.put += u64::from(now.configuration != was.configuration);
        tally.hitched += u64::from(now.configuration.len() > was.configuration.len());
    }
    let around: Vec<Vec<Placed>> = (0..robots.len()).map(|id| case.around(&robots, id)).collect();
    let plan = |(id, around): (usize, Vec<Placed>)| {
        let kind = case.residents[id].kind;
        let motion = motion_of(case, id, tick, &mut robots[id]);
        let mut cut = Cut::new(&motion, &around, NEAR);
        if kind.is_arm() {
            (cut.at_least, cut.at_most) = (1.0, 1.0); // it is never held
        }
        Plan { kind, motion, around, cut }
    };
    let plans: Vec<Plan> = around.into_iter().enumerate().map(plan).collect();
    for (id, (plan, found)) in plans.iter().zip(&after.robots).enumerate() {
        let arena = case.residents[id].arena;
        let lower = case.in_arena(arena).map(|(other, _)| other).filter(|other| *other < id);
        let meets = |other: usize| sweeps_meet((&plan.motion, &plan.cut), (&plans[other].motion, &plans[other].cut));
        let yields = Answer::any(lower.map(meets));
        let right = state(&robots[id], found).and_then(|()| place(plan, yields, found));
        right.map_err(|wrong| {
            format!("{} {wrong}: {plan:?}, yields: {yields:?}; found {found:?}", case.residents[id].name)
        })?;
        let at_obstacle = || clearance(&shapes(plan.kind, &found.configuration), &case.arenas[arena].obstacles) <= NEAR;
        *tally.of(plan, yields, at_obstacle) += 1;
    }
    ends_apart(case, &plans, after)?;
    scans(case, after, tally)
}

impl std::fmt::Debug for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} {:?}", self.motion, self.cut)
    }
}

impl Tally {
    /// The count that a robot's tick belongs to.
    fn of(&mut self, plan: &Plan, yields: Answer, at_obstacle: impl Fn() -> bool) -> &mut u64 {
        let held = yields == Answer::No || plan.cut.at_least == 0.0;
        match (plan.kind.is_arm(), plan.cut.blocked, yields) {
            (true, Answer::Yes, _) | (true, _, Answer::Yes) => &mut self.arm_hit,
            (true, Answer::No, Answer::No) => &mut self.arm_free,
            (false, Answer::Yes, _) if plan.cut.start_clearance == 0.0 => &mut self.pinned,
            (false, _, Answer::Yes) => &mut self.yielded,
            (false, Answer::No, Answer::No) if plan.motion.speed() == 0.0 => &mut self.still,
            (false, Answer::No, Answer::No) => &mut self.free,
            (false, Answer::Yes, _) if held && at_obstacle() => &mut self.at_obstacle,
            (false, Answer::Yes, _) if held => &mut self.at_robot,
            _ => &mut self.undecided,
        }
    }
}

fn ensure(right: bool, wrong: impl FnOnce() -> String) -> Result<(), String> {
    if right { Ok(()) } else { Err(wrong()) }
}

/// Whether two lists of coordinates are the same, the first `lengths` of them metres and the others angles.
fn is_near(a: &[f64], b: &[f64], lengths: usize) -> bool {
    let apart = |(k, (a, b)): (usize, (&f64, &f64))| if k < lengths { (a - b).abs() } else { short(*a, *b).abs() };
    a.len() == b.len() && a.iter().zip(b).enumerate().map(apart).all(|d| d <= TOLERANCE)
}

/// Checks everything but the configuration. `expected` is the state before the tick, with its inputs applied and its
/// wheels turned.
fn state(expected: &RobotState, found: &RobotState) -> Result<(), String> {
    let touches = found.in_contact;
    let contacts = expected.contacts + u32::from(touches && !expected.in_contact);
    let flash = if touches { FLASH } else { expected.flash.saturating_sub(1) };
    ensure((found.contacts, found.flash) == (contacts, flash), || {
        format!("has not {contacts} contacts, flash {flash}")
    })?;
    let of = |r: &RobotState| (r.id, r.channels, r.manual, r.refusals, r.target.to_vec());
    ensure(of(found) == of(expected), || format!("is not driven as {:?}", of(expected)))?;
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE;
    let same = expected.extra.len() == found.extra.len() && expected.extra.iter().zip(&found.extra).all(close);
    ensure(same, || format!("has not the wheels and waypoint {:?}", expected.extra))
}

/// Checks the configuration and the contact.
fn place(plan: &Plan, yields: Answer, found: &RobotState) -> Result<(), String> {
    let Plan { kind, motion, around, cut } = plan;
    let (q, touches, lengths) = (&found.configuration[..], found.in_contact, if kind.is_arm() { 0 } else { 2 });
    let is_at = |s: f64| is_near(q, &motion.at(s), lengths);
    match Answer::any([cut.blocked, yields]) {
        Answer::Yes => ensure(touches, || "is not in contact".into())?,
        Answer::No => ensure(!touches, || "is in contact".into())?,
        Answer::Undecided => {}
    }
    if kind.is_arm() || !touches {
        ensure(is_at(1.0), || "has not gone all the way".into())?;
    } else if is_at(0.0) {
        ensure(yields != Answer::No || cut.at_least == 0.0, || "stays where it started".into())?;
    } else {
        ensure(yields != Answer::Yes, || "does not stay where it started".into())?;
        let s = motion.parameter_of(q);
        ensure(is_at(s) && s <= cut.at_most + TOLERANCE, || format!("is not on its motion, at {s}"))?;
        let held_at = clearance(&shapes(*kind, q), around);
        ensure(held_at <= NEAR, || format!("is held at a clearance of {held_at}"))?;
    }
    let least = if cut.start_clearance < LEAST { cut.start_clearance } else { LEAST };
    let ends = if kind.is_arm() { f64::INFINITY } else { clearance(&shapes(*kind, q), around) };
    ensure(ends >= least - TOLERANCE, || format!("ends at a clearance of {ends}"))
}

/// Checks that no two robots on wheels end nearer to one another than motions may.
fn ends_apart(case: &Case, plans: &[Plan], after: &Frame) -> Result<(), String> {
    let ends = |id: usize| shapes(plans[id].kind, &after.robots[id].configuration);
    for (id, plan) in plans.iter().enumerate().filter(|(_, plan)| !plan.kind.is_arm()) {
        for (other, _) in case.in_arena(case.residents[id].arena).filter(|(other, a)| *other < id && !a.kind.is_arm()) {
            let starts = [plan.cut.start_clearance, plans[other].cut.start_clearance];
            let least = starts.into_iter().fold(LEAST, |least, start| if start < least { start } else { least });
            let apart = clearance(&ends(id), &ends(other));
            ensure(apart >= least - TOLERANCE, || format!("robots {other} and {id} end {apart} apart"))?;
        }
    }
    Ok(())
}

/// Checks the readings of every Rusty's sensor after the tick.
pub fn scans(case: &Case, after: &Frame, tally: &mut Tally) -> Result<(), String> {
    let sensing: Vec<usize> = (0..case.residents.len()).filter(|id| case.residents[*id].kind == Kind::Rusty).collect();
    let scanned: Vec<usize> = after.scans.iter().map(|scan| scan.robot as usize).collect();
    ensure(sensing == scanned, || format!("scans by {scanned:?}"))?;
    for scan in &after.scans {
        let id = scan.robot as usize;
        let (q, obstacles) = (&after.robots[id].configuration, case.around(&after.robots, id));
        ensure(scan.ranges.len() == SENSOR.n_rays as usize, || format!("{} rays", scan.ranges.len()))?;
        for (k, range) in scan.ranges.iter().enumerate() {
            let bearing = q[2] + TAU * k as f64 / f64::from(SENSOR.n_rays);
            let right = is_range(*range, Point2::new(q[0], q[1]), bearing, SENSOR.max_range, &obstacles);
            ensure(right, || format!("ray {k} of {} reads {range}", case.residents[id].name))?;
            tally.hits += u64::from(range.is_finite());
            tally.misses += u64::from(range.is_infinite());
        }
    }
    Ok(())
}
