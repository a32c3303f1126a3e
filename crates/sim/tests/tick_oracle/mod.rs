//! Whole ticks computed again by a second, slow and simple program that shares no code with the simulator.
//!
//! Runs are recorded in random worlds with random scripts. For each tick the program takes the recorded frame before
//! it, so that errors do not accumulate, and computes the frame after it:
//! - [`inputs`]: the changes by the script, and the motion that the driver or the tour asks for;
//! - [`robots`]: the motion by its differential equations, and the footprint;
//! - [`meetings`]: how far the motion can go, and whose sweeps meet, by distances at many places;
//! - [`rays`]: the sensors' readings, ray by ray;
//! - [`judge`]: the comparison. A robot that comes nearer to something than 1e-4 m without contact may be held or not.
//!   Either is accepted, but all of its state must agree with it.
//!
//! Worlds are written as text and read by the library; the program keeps its own list of shapes. From the library it
//! takes the robots' dimensions and the seeded random streams, which have tests of their own. The tours and the wheels'
//! slip are drawn from those.

mod cases;
mod inputs;
mod judge;
mod meetings;
mod rays;
mod robots;

use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Frame, Log, LogKind, RobotState};

use crate::shrink::witness::assert_holds_in_worlds;
use cases::Case;
use judge::{Tally, judge, scans};
use oracle::fixtures::count_from_env;

/// A random run.
fn recorded(number: u64) -> (Case, Log) {
    let case = Case::random(number);
    let log = Run::record(case.config(), (case.seed, case.script.clone())).unwrap();
    (case, log)
}

/// Judges every tick of a run.
fn judge_run(case: &Case, log: &Log, tally: &mut Tally) -> Result<(), String> {
    scans(case, log.initial().unwrap(), tally).map_err(|wrong| format!("tick 0: {wrong}"))?;
    pairs(log).try_for_each(|(before, after)| {
        judge(case, before, after, tally).map_err(|wrong| format!("tick {}: {wrong}", after.tick))
    })
}

/// The frames of a run, each with the one before it.
fn pairs(log: &Log) -> impl Iterator<Item = (&Frame, &Frame)> {
    std::iter::once(log.initial().unwrap()).chain(log.frames()).zip(log.frames())
}

/// `MOTION_LAB_RUNS` sets the number of runs.
#[test]
fn every_tick_is_what_the_frame_before_it_and_the_script_make_it() {
    let runs = count_from_env("MOTION_LAB_RUNS", 24);
    let mut tally = Tally::default();
    for number in 0..runs {
        let (case, log) = recorded(number);
        for (resident, robot) in case.residents.iter().zip(&log.initial().unwrap().robots) {
            assert_eq!(robot.configuration[..], resident.start[..], "run {number}: {} starts elsewhere", resident.name);
            let at_rest = !robot.manual && robot.extra.iter().all(|x| *x == 0.0) && robot.target.is_empty();
            assert!(at_rest && (robot.contacts, robot.flash, robot.refusals) == (0, 0, 0), "run {number}: {robot:?}");
        }
        if judge_run(&case, &log, &mut tally).is_err() {
            assert_holds_in_worlds(&log.recipe, |recipe| {
                let case = Case { script: recipe.script.clone(), ticks: recipe.config.ticks, ..case.clone() };
                let log = Run::record_recipe(recipe.clone(), LogKind::Frames, |_| {});
                // the case has all arenas
                let Some(log) = log.ok().filter(|_| recipe.config.worlds.len() == case.arenas.len()) else {
                    return Ok(());
                };
                judge_run(&case, &log, &mut Tally::default()).map_err(|wrong| format!("run {number}, {wrong}"))
            });
        }
    }
    let Tally { free, at_obstacle, at_robot, yielded, pinned, still, arm_free, arm_hit, undecided, .. } = tally;
    if runs < 24 {
        return; // too few for the counts below
    }
    let judged = free + at_obstacle + at_robot + yielded + pinned + still + arm_free + arm_hit;
    assert!(20 * undecided < judged, "{tally:?}");
    let Tally { refused, put, hitched, hits, misses, .. } = tally;
    let often = [free, at_obstacle, arm_free, arm_hit, refused, hits, misses].iter().all(|n| *n >= 5 * runs);
    let sometimes = [at_robot, put, pinned].iter().all(|n| *n >= runs);
    assert!(often && sometimes && 2 * yielded >= runs && 5 * hitched >= runs, "{tally:?} in {runs} runs");
}

/// A change to a robot's state after a tick, given the state before it. Returns whether there was anything to change.
type Change = fn(&RobotState, &mut RobotState) -> bool;

const CHANGES: [(&str, Change); 9] = [
    ("a place 10 nm off", |_, r| {
        r.configuration[0] += 1e-8;
        !r.in_contact
    }),
    ("a heading 1e-8 rad off", |_, r| {
        *r.configuration.last_mut().unwrap() += 1e-8;
        true
    }),
    ("a held robot that stayed where it was", |before, r| {
        let moved = before.configuration != r.configuration;
        r.configuration = before.configuration.clone();
        moved && r.in_contact
    }),
    ("a contact that was none, or none that was one", |before, r| {
        r.in_contact = !r.in_contact;
        r.contacts = before.contacts + u32::from(r.in_contact && !before.in_contact);
        r.flash = if r.in_contact { 6 } else { before.flash.saturating_sub(1) };
        true
    }),
    ("an episode too many", |_, r| {
        r.contacts += 1;
        true
    }),
    ("a flash too long", |_, r| {
        r.flash += 1;
        true
    }),
    ("a refusal too many", |_, r| {
        r.refusals += 1;
        true
    }),
    ("a driver that is none, or none that is one", |_, r| {
        r.manual = !r.manual;
        true
    }),
    ("wheels that turned otherwise", |_, r| {
        let wheels = r.extra.len() == 3;
        r.extra.iter_mut().take(2).for_each(|turned| *turned += 1e-8);
        wheels
    }),
];

#[test]
fn frames_that_are_not_quite_right_are_refused() {
    let (mut tried, mut refused) = ([0; CHANGES.len()], [0; CHANGES.len()]);
    for number in 0..4 {
        let (case, log) = recorded(number);
        for (before, after) in pairs(&log) {
            let robot = after.tick as usize % case.residents.len();
            for (i, (_, change)) in CHANGES.iter().enumerate() {
                let mut changed = after.clone();
                if change(&before.robots[robot], &mut changed.robots[robot]) {
                    tried[i] += 1;
                    refused[i] += u32::from(judge(&case, before, &changed, &mut Tally::default()).is_err());
                }
            }
            if let Some(range) = after.scans.first().and_then(|scan| scan.ranges.first()).filter(|r| r.is_finite()) {
                let mut changed = after.clone();
                changed.scans[0].ranges_mut()[0] = range + 1e-6;
                assert!(judge(&case, before, &changed, &mut Tally::default()).is_err(), "a range a micrometre off");
            }
        }
    }
    for (i, (name, _)) in CHANGES.iter().enumerate() {
        // near an obstacle, both contact and no contact may be accepted
        let least = if name.contains("contact") || name.contains("stayed") { 9 * tried[i] / 10 } else { tried[i] };
        assert!(tried[i] > 5 && refused[i] >= least, "{name}: {} of {} are refused", refused[i], tried[i]);
    }
}
