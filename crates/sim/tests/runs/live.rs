//! Runs that get inputs while they go on: the same as runs of a script that has them.

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{Event, MAX_EVENTS, RobotInput, Script, WorldChange, WorldEvent};
use motion_lab_sim::simulation::CommandError;
use motion_lab_sim::tour::{MAX_TICKS, TourConfig};

use crate::simulator::quantized;

const SEED: Seed = Seed(31);

fn event(tick: u64, robot: &str, input: RobotInput) -> Event {
    Event { tick, robot: robot.into(), input }
}

fn closing(tick: u64) -> WorldEvent {
    WorldEvent { tick, world: "Apartment".into(), change: WorldChange::Close("door A".into()) }
}

fn until(live: &mut Recorder, tick: u64) {
    while live.frame().tick < tick {
        live.step();
    }
}

fn config(ticks: u64) -> TourConfig {
    TourConfig { ticks, ..TourConfig::default() }
}

#[test]
fn inputs_to_a_run_under_way_are_its_script_and_a_recording_of_that_has_its_bits() {
    // what the script had for later stays
    let before = vec![event(40, "Reach", RobotInput::MoveTo(quantized(&[0.5, 0.25])))];
    let mut live = Recorder::new(config(1200), (SEED, Script::new(before, vec![]))).unwrap();
    live.input("Rusty", RobotInput::Drive(128, 0)).unwrap();
    until(&mut live, 20);
    live.input("Hitch", RobotInput::Drive(-64, 32)).unwrap();
    live.change("Apartment", closing(21).change).unwrap();
    live.input("Rusty", RobotInput::Drive(100, -20)).unwrap();
    live.input("Rusty", RobotInput::Drive(0, 0)).unwrap();
    until(&mut live, 60);

    let events = vec![
        event(1, "Rusty", RobotInput::Drive(128, 0)),
        event(21, "Hitch", RobotInput::Drive(-64, 32)),
        event(21, "Rusty", RobotInput::Drive(100, -20)),
        event(21, "Rusty", RobotInput::Drive(0, 0)),
        event(40, "Reach", RobotInput::MoveTo(quantized(&[0.5, 0.25]))),
    ];
    let script = Script::new(events, vec![closing(21)]);
    let recorded = Run::record(config(60), (SEED, script)).unwrap();
    assert_eq!(live.script(), &recorded.recipe.script);
    assert_eq!(live.frame(), recorded.frame(60).unwrap());
    assert_eq!(live.log().unwrap(), recorded);
    // the last of a tick's two holds, from that tick on: the rover stands
    let at = |tick: u64| &recorded.frame(tick).unwrap().robots[0].configuration;
    assert!(at(20) == at(60) && at(0) != at(20));

    // it goes on as if nobody had asked for its log
    let next = live.step().clone();
    let mut other = Recorder::new(config(61), (SEED, recorded.recipe.script.clone())).unwrap();
    assert_eq!(&next, other.seek(61).unwrap());
    let verification = verify(&recorded, |_| {}).unwrap();
    assert_eq!((verification.identical, verification.recorded), (60, 60));
}

#[test]
fn a_run_moved_back_and_given_another_input_goes_on_from_there() {
    let mut live = Recorder::new(config(1200), SEED).unwrap();
    live.input("Rusty", RobotInput::Drive(128, 0)).unwrap();
    until(&mut live, 20);
    live.input("Rusty", RobotInput::Drive(-128, 0)).unwrap();
    until(&mut live, 30);
    live.seek(10).unwrap();
    // as far as it stands, which is before the second input
    let log = live.log().unwrap();
    assert!(log.ticks() == 10 && live.frame().tick == 10);
    assert_eq!(verify(&log, |_| {}).unwrap().identical, 10);
    live.input("Rusty", RobotInput::Drive(0, 128)).unwrap();
    until(&mut live, 40);
    let events = vec![event(1, "Rusty", RobotInput::Drive(128, 0)), event(11, "Rusty", RobotInput::Drive(0, 128))];
    assert_eq!(live.log().unwrap(), Run::record(config(40), (SEED, Script::new(events, vec![]))).unwrap());
}

#[test]
fn what_no_script_could_hold_is_refused_and_what_the_tick_refuses_is_counted() {
    let mut live = Recorder::new(config(1200), SEED).unwrap();
    let says = |said: Result<(), CommandError>| said.unwrap_err().to_string();
    let unknown = says(live.input("Rosty", RobotInput::Release));
    assert!(unknown.contains("Rosty"), "{unknown}");
    let wide = says(live.input("Rusty", RobotInput::Drive(129, 0)));
    assert!(wide.contains("129"), "{wide}");
    let no_door = says(live.change("Apartment", WorldChange::Close("door Q".into())));
    assert!(no_door.contains("door Q"), "{no_door}");
    let no_world = says(live.change("Apartmint", closing(1).change));
    assert!(no_world.contains("Apartmint"), "{no_world}");
    assert!(live.script().is_empty() && live.refusals().count() == 2, "{:?}", live.refusals());

    // a teleport into the wall is one of the script, and refused at its tick
    live.input("Rusty", RobotInput::Teleport(quantized(&[0.0; 3]))).unwrap();
    assert_eq!((live.script().events.len(), live.refusals().count()), (1, 2));
    live.step();
    assert_eq!(live.refusals().count(), 3);
}

#[test]
fn a_script_that_is_full_takes_no_further_input_and_no_change() {
    let full = vec![event(MAX_TICKS, "Rusty", RobotInput::Release); MAX_EVENTS];
    let mut live = Recorder::new(config(1), (SEED, Script::new(full, vec![]))).unwrap();
    let refused = live.input("Rusty", RobotInput::Drive(1, 0)).unwrap_err().to_string();
    assert!(refused.contains(&(MAX_EVENTS + 1).to_string()), "{refused}");
    assert!(live.change("Apartment", closing(1).change).is_err());
    assert_eq!(live.script().events.len() + live.script().changes.len(), MAX_EVENTS);
}
