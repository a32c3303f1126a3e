//! The recipes of the pinned runs but the live one. `tests/determinism` runs them too, in other builds.

use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::run::{Event, Quantized, Recipe, RobotInput, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

fn event(tick: u64, robot: &str, input: RobotInput) -> Event {
    Event { tick, robot: robot.into(), input }
}

fn quantized(values: &[f64]) -> Vec<Quantized> {
    values.iter().map(|&v| Quantized::try_new(v).unwrap()).collect()
}

fn script(events: Vec<Event>) -> Script {
    Script::new(events, Vec::new())
}

/// The Apartment's file with this sensor written into it.
pub fn noisy_apartment(sensor: &str) -> World {
    let text = World::apartment().to_ron();
    let (before, after) = text.split_once("kind: \"rusty\", start: [2.25, 6.25, 0.0]").expect("Rusty in room A");
    let text = format!("{before}kind: \"rusty\", start: [2.25, 6.25, 0.0], sensor: ({sensor}){after}");
    World::parse("noisy.ron", &text).unwrap()
}

/// The 60 s tour of the three worlds at the book's seed.
pub fn tour() -> Recipe {
    Recipe::new(TourConfig::default(), BOOK_SEED)
}

/// A minute of driving by hand: walls hit, refusals, the tours taken over and given back.
pub fn driving() -> Recipe {
    let script = Script::parse("driving.ron", include_str!("../../../../tests/scripts/driving.ron")).unwrap();
    Recipe::new(TourConfig::default(), (BOOK_SEED, script))
}

/// Eight robots of every kind among all kinds of obstacles. They scan, and some are driven into one another.
pub fn eight() -> Recipe {
    let world = World::parse("eight.ron", include_str!("../../../../tests/samples/eight.ron")).unwrap();
    let sensor = Some(RangeSensor { n_rays: 90, max_range: 6.0 });
    let script = script(vec![
        event(1, "Anna", RobotInput::Drive(96, -10)),
        event(1, "Bert", RobotInput::Drive(128, 20)),
        event(1, "Finn", RobotInput::Drive(-64, 90)),
        event(1, "Dora", RobotInput::Drive(100, 40)),
        event(20, "Gina", RobotInput::Drive(128, 0)),
        event(30, "Hugo", RobotInput::Drive(-128, -33)),
        event(60, "Cleo", RobotInput::MoveTo(quantized(&[1.5, -0.75]))),
        event(90, "Emil", RobotInput::MoveTo(quantized(&[-1.25, 0.5, 2.0]))),
        event(120, "Bert", RobotInput::Drive(-128, -60)),
        event(150, "Anna", RobotInput::Release),
        event(180, "Finn", RobotInput::Drive(128, 0)),
    ]);
    Recipe::new(TourConfig { worlds: vec![world], ticks: 400, sensor }, (Seed(8), script))
}

/// Rusty's tour with a range sensor that misreads in every way of the beam model.
pub fn noisy() -> Recipe {
    let sensor = "sigma_hit: 0.05, z_short: 0.15, lambda_short: 0.8, z_miss: 0.05, z_max: 0.04, z_rand: 0.1";
    let world = noisy_apartment(sensor);
    let sensor = Some(RangeSensor { n_rays: 60, max_range: 4.0 });
    Recipe::new(TourConfig { worlds: vec![world], ticks: 300, sensor }, Seed(7))
}

/// The trailer put on, pulled and taken off, and all three robots put elsewhere at tick 100.
pub fn trailer() -> Recipe {
    let script = script(vec![
        event(5, "Hitch", RobotInput::SetTrailer(true)),
        event(6, "Hitch", RobotInput::Drive(80, 48)),
        event(60, "Hitch", RobotInput::Drive(-64, -20)),
        event(100, "Hitch", RobotInput::Teleport(quantized(&[5.5, 2.25, -0.0625, 0.125]))),
        event(100, "Rusty", RobotInput::Teleport(quantized(&[6.0, 4.0, 1.0]))),
        event(100, "Reach", RobotInput::Teleport(quantized(&[-1.0, 0.5]))),
        event(140, "Hitch", RobotInput::SetTrailer(false)),
        event(150, "Hitch", RobotInput::Release),
    ]);
    Recipe::new(TourConfig { ticks: 240, ..TourConfig::default() }, (Seed(11), script))
}
