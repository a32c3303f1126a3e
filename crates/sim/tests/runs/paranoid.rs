//! Runs whose every tick is run twice: what keeps something that no frame holds is found and named.

use std::sync::atomic::{AtomicU64, Ordering};

use bevy::app::App;
use bevy::prelude::{IntoScheduleConfigs, Local, Query};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ChartLine, ConfigurationError, PartRates, Rates};
use motion_lab_sim::recording::{ParanoidRun, Recorder, UnrepeatedTick};
use motion_lab_sim::run::{Recipe, RobotInput, Value};
use motion_lab_sim::simulation::{
    Configuration, Extra, RobotPlugin, SimulatedRobot, SimulationSchedule, SimulationSystems,
};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use crate::simulator::crowd::arena;
use crate::simulator::{event, script};

/// How often a drifter's tour was asked, in all runs: what no frame holds.
static ASKED: AtomicU64 = AtomicU64::new(0);

/// A disc that goes to the east, a little faster in every third tick: of the run, or where it is forgetful, of those
/// that were asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drifter {
    is_forgetful: bool,
}

impl Robot for Drifter {
    type Configuration = R2;

    fn check(&self, q: &R2) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &R2) -> Footprint {
        Footprint::disc(q.0, 0.125)
    }

    fn edge_rates(&self, a: &R2, b: &R2) -> Result<PartRates, ConfigurationError> {
        Ok([Rates { speed: (b.0 - a.0).norm(), acceleration: 0.0 }].into_iter().collect())
    }

    fn sample(&self, min: Point2, _max: Point2, _draws: &mut Stream) -> R2 {
        R2(min)
    }
}

impl Drivable for Drifter {
    type Control = f64;
    type Drive = ChartLine<Drifter>;

    fn drive(&self, q: &R2, u: &f64, _dt: f64) -> Result<ChartLine<Drifter>, ConfigurationError> {
        self.edge(q, &R2::new(q.0.x + u, q.0.y))
    }
}

impl SimulatedRobot for Drifter {
    type Tour = ();

    fn tour(&self, _seed: Seed, _name: &str, _world: &World, _start: &R2) {}

    fn touring(&self, (): &(), tick: u64, _dt: f64, _q: &R2, _extra: &mut Extra) -> f64 {
        let number = if self.is_forgetful { tick } else { ASKED.fetch_add(1, Ordering::Relaxed) };
        if number.is_multiple_of(3) { 0.0625 } else { 0.03125 }
    }

    fn driven(&self, _channels: [f64; 2]) -> Option<f64> {
        None
    }

    fn configuration_at(&self, _now: &R2, coordinates: &[f64]) -> Option<R2> {
        R2::from_coordinates(coordinates)
    }
}

/// A run of a rover and a drifter, who have the ids 0 and 1.
fn recipe() -> Recipe {
    let robots: [(&str, &str, &[f64]); 2] =
        [("Rusty", "rusty", &[-1.0, 1.0, 0.0]), ("Dora", "x-drifter", &[-1.5, 0.0])];
    Recipe::new(TourConfig { worlds: vec![arena(2.0, &robots)], ticks: 12, sensor: None }, BOOK_SEED)
}

/// The first tick of that run that does not come out twice.
fn found(add: impl FnOnce(&mut App)) -> Option<UnrepeatedTick> {
    let mut run = ParanoidRun::of(&recipe(), add).unwrap();
    (0..12).find_map(|_| run.step().unwrap())
}

#[test]
fn a_tour_that_counts_in_a_static_is_found_with_its_control_robot_field_and_bits() {
    let remembers = |app: &mut App| _ = app.add_plugins(RobotPlugin::new("x-drifter", Drifter { is_forgetful: false }));
    let found = found(remembers).expect("it keeps what no frame holds");
    assert_eq!(found.phase, SimulationSystems::Drive);
    let control = found.control.clone().unwrap();
    let mut speeds = [control.first.as_str(), &control.second];
    speeds.sort_unstable();
    assert_eq!((found.robot.as_deref(), speeds), (Some("Dora"), ["0.03125", "0.0625"]));
    let value = found.value.clone().unwrap();
    assert_eq!((value.robot, value.field.as_str(), value.tick), (Some(1), "configuration[0]", found.tick));
    let (Value::Float(a), Value::Float(b)) = (value.expected, value.found) else { panic!("{value}") };
    assert_eq!((a - b).abs(), 0.03125, "the one step or the other, from one place");
    let said = found.to_string();
    for part in ["phase Drive, robot \"Dora\": ", "control: first 0.0", "robot 1, configuration[0]: expected ", "(0x"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// Moves drifters a little every second time that it runs.
fn nudge(mut times: Local<u32>, mut robots: Query<&mut Configuration<Drifter>>) {
    *times += 1;
    if times.is_multiple_of(2) {
        robots.iter_mut().for_each(|mut q| q.0.0.y += 0.25);
    }
}

#[test]
fn a_system_that_counts_in_a_local_is_found_after_the_phase_in_which_it_runs() {
    let add = |app: &mut App| {
        app.add_plugins(RobotPlugin::new("x-drifter", Drifter { is_forgetful: true }));
        let place = (SimulationSystems::Collide, SimulationSystems::Sense);
        app.add_systems(SimulationSchedule, nudge.after(place.0).before(place.1));
    };
    let found = found(add).expect("it keeps what no frame holds");
    assert!([SimulationSystems::Collide, SimulationSystems::Sense].contains(&found.phase), "{found}");
    assert_eq!((found.tick, found.control.clone()), (1, None), "{found}");
    assert_eq!(found.robot.as_deref(), Some("Dora"));
    let value = found.value.unwrap();
    assert_eq!((value.robot, value.field.as_str()), (Some(1), "configuration[1]"));
    assert_eq!((value.expected, value.found), (Value::Float(0.0), Value::Float(0.25)));
}

#[test]
fn where_frames_hold_all_every_tick_comes_out_twice_and_the_run_is_the_usual_one() {
    let forgets = |app: &mut App| _ = app.add_plugins(RobotPlugin::new("x-drifter", Drifter { is_forgetful: true }));
    let mut twice = ParanoidRun::of(&recipe(), forgets).unwrap();
    let mut once = Recorder::of_with_robots(&recipe(), forgets).unwrap();
    for _ in 0..12 {
        assert_eq!(twice.step().unwrap(), None);
        assert_eq!(twice.recorder().frame(), once.step());
    }
    let events = vec![
        event(3, "Rusty", RobotInput::Drive(128, 40)),
        event(5, "Hitch", RobotInput::SetTrailer(true)),
        event(6, "Hitch", RobotInput::Drive(-90, 40)),
    ];
    let tour = Recipe::new(TourConfig { ticks: 60, ..TourConfig::default() }, (BOOK_SEED, script(events)));
    let mut twice = ParanoidRun::of(&tour, |_| {}).unwrap();
    let mut once = Recorder::of(&tour).unwrap();
    for _ in 0..60 {
        assert_eq!(twice.step().unwrap(), None);
        assert_eq!(twice.recorder().frame(), once.step());
    }
}
