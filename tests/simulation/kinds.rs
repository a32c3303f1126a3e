//! A kind of robot from outside the library.

use bevy::app::App;
use bevy::prelude::MinimalPlugins;
use motion_lab::collision::{Collision, Scene};
use motion_lab::configuration::{RobotKind, Space};
use motion_lab::geometry::Aabb;
use motion_lab::manifest::{Formula, Level};
use motion_lab::prelude::*;
use motion_lab::recording::{Recorder, Run, RunError};
use motion_lab::robots::{ChartLine, ConfigurationError, PartRates, Rates};
use motion_lab::run::RobotInput;
use motion_lab::simulation::{Extra, LatestFrame, RobotPlugin, SimulatedRobot, SimulationPlugin, start_run, view};
use motion_lab::tour::TourConfig;
use motion_lab::worlds::World;

use super::crowd::arena;
use super::{event, quantized, script};

/// A disc that slides about in any direction, at a speed with some noise, and counts its ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Puck {
    radius: f64,
}

impl Robot for Puck {
    type Configuration = R2;

    fn check(&self, q: &R2) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &R2) -> Footprint {
        Footprint::disc(q.0, self.radius)
    }

    fn edge_rates(&self, a: &R2, b: &R2) -> Result<PartRates, ConfigurationError> {
        Ok([Rates { speed: (b.0 - a.0).norm(), acceleration: 0.0 }].into_iter().collect())
    }

    fn sample(&self, min: Point2, max: Point2, draws: &mut Stream) -> R2 {
        R2::new(draws.uniform(min.x, max.x), draws.uniform(min.y, max.y))
    }
}

impl Drivable for Puck {
    type Control = [f64; 2];
    type Drive = ChartLine<Puck>;

    fn drive(&self, q: &R2, u: &[f64; 2], dt: f64) -> Result<ChartLine<Puck>, ConfigurationError> {
        self.edge(q, &R2::new(q.0.x + u[0] * dt, q.0.y + u[1] * dt))
    }
}

impl SimulatedRobot for Puck {
    type Tour = f64;

    fn tour(&self, seed: Seed, name: &str, _world: &World, _start: &R2) -> f64 {
        Stream::new(seed, &format!("{name}/tour")).uniform(-3.0, 3.0)
    }

    fn touring(&self, bearing: &f64, _tick: u64, _dt: f64, _q: &R2, _extra: &mut Extra) -> [f64; 2] {
        let (s, c) = motion_lab::num::sin_cos(*bearing);
        [c, s]
    }

    fn driven(&self, channels: [f64; 2]) -> Option<[f64; 2]> {
        Some(channels)
    }

    /// At most a metre per second, so that a move takes more than a tick.
    fn toward(&self, q: &R2, target: &R2) -> Option<[f64; 2]> {
        let d = target.0 - q.0;
        let scale = if d.norm() > 0.05 { 1.0 / d.norm() } else { 20.0 };
        Some([d.x * scale, d.y * scale])
    }

    fn configuration_at(&self, _now: &R2, coordinates: &[f64]) -> Option<R2> {
        R2::from_coordinates(coordinates)
    }

    fn initial_extra(&self) -> Extra {
        Extra::from_slice(&[0.0])
    }

    fn actuate(&self, u: &[f64; 2], _dt: f64, draws: &mut Stream, extra: &mut Extra) -> [f64; 2] {
        extra[0] += 1.0;
        let noise = 1.0 + 0.01 * draws.unit();
        [u[0] * noise, u[1] * noise]
    }
}

fn config(ticks: u64) -> TourConfig {
    let robots: [(&str, &str, &[f64]); 2] = [("puck", "puck", &[0.0, 0.0]), ("Rusty", "rusty", &[1.0, 1.0, 0.0])];
    TourConfig { worlds: vec![arena(2.0, &robots)], ticks, sensor: None }
}

#[test]
fn a_new_kind_runs_by_name_beside_the_lab_s_own() {
    let add = |app: &mut bevy::app::App| {
        app.add_plugins(RobotPlugin::new("puck", Puck { radius: 0.2 }));
    };
    let events = vec![
        event(60, "puck", RobotInput::MoveTo(quantized(&[-1.0, 0.5]))),
        event(150, "puck", RobotInput::Drive(128, 0)),
    ];
    let log = Run::record_with_robots(config(220), (Seed(8), script(events.clone())), add).unwrap();
    assert_eq!(Run::replay_with_robots(&log, add).unwrap(), log.frames);
    let puck = |k: usize| &log.frames[k - 1].robots[0];
    let scene = Scene::of_world(&arena(2.0, &[]));
    let clearance =
        scene.distance(&Puck { radius: 0.2 }.footprint(&R2::from_coordinates(&puck(59).configuration).unwrap()));
    assert!(puck(59).in_contact && (1e-5..=1e-4).contains(&clearance), "it tours into a wall and is held: {clearance}");
    assert_eq!(puck(61).target.len(), 2);
    assert_eq!(puck(220).extra[0], 220.0);
    assert!(puck(149).configuration[0] < -0.99 && puck(220).configuration[0] > 1.0);
    // its own state is in the frames, so a run restored in the middle goes on the same
    let mut run = Recorder::with_robots(config(220), (Seed(8), script(events)), add).unwrap();
    run.restore(&log.frames[80]).unwrap();
    assert_eq!(run.step(), &log.frames[81]);

    let unknown = Run::record(config(1), Seed(8));
    assert!(matches!(unknown, Err(RunError::Spawn(e)) if e.to_string().contains("no kind \"puck\"")));
}

/// One of the lab's own kinds, registered again: a car with dimensions of its own.
#[test]
fn a_kind_registered_again_is_the_new_one_and_keeps_its_dimensions() {
    let own = Hitch { wheelbase: 2.0, hitch_len: Some(3.0), ..HITCH };
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin, RobotPlugin::new("hitch", own)));
    let config = TourConfig { worlds: vec![arena(30.0, &[("Hitch", "hitch", &[0.0; 4])])], ticks: 10, sensor: None };
    let events = vec![event(1, "Hitch", RobotInput::Drive(128, 128))];
    start_run(app.world_mut(), config, (Seed(1), script(events))).unwrap();
    let footprint = view(app.world_mut()).remove(0).footprint;
    // the trailer's box: from its axle, 3 m behind the car's, 0.8 m back and 1 m ahead
    let Aabb { min: low, max: high } = footprint.parts()[1].placed().bounds();
    assert_eq!((low.x, high.x), (-3.8, -2.0));
    motion_lab::simulation::step(app.world_mut());
    // an arc of v dt tan(phi) / L
    let heading = app.world().resource::<LatestFrame>().0.robots[0].configuration[2];
    let expected = 1.5 * 0.05 * motion_lab::num::tan(0.6) / 2.0;
    assert!((heading - expected).abs() < 1e-12, "{heading} {expected}");
}

#[test]
fn a_kind_of_ones_own_is_shown_by_its_own_description() {
    static PUCK: RobotKind = RobotKind {
        name: "puck",
        coordinates: &["x", "y"],
        start: "two: x, y",
        spaces: &[Space { coordinates: 2, formula: "q = (x, y) \u{2208} R^2", words: "A point of the plane." }],
        lengths: 2,
        drives: false,
        senses: false,
        has_encoders: false,
        difference: |from, to| R2::from_coordinates(from)?.difference(&R2::from_coordinates(to)?).ok(),
        printed: |q| R2::from_coordinates(q).map(|q| q.to_string()),
    };
    let about = |plugin: RobotPlugin<Puck>| {
        let add = |app: &mut App| _ = app.add_plugins(plugin);
        let run = Recorder::with_robots(config(1), Seed(8), add).unwrap();
        run.view().into_iter().map(|robot| robot.about.map(|kind| kind.name)).collect::<Vec<_>>()
    };
    let plugin = || RobotPlugin::new("puck", Puck { radius: 0.2 });
    assert_eq!(about(plugin()), [None, Some("rusty")], "nobody described it");
    assert_eq!(about(plugin().described(&PUCK)), [Some("puck"), Some("rusty")]);
    let formula = Formula::of(PUCK.space(2).unwrap());
    assert_eq!(formula.0.iter().map(|term| term.text).collect::<String>(), "q = (x, y) \u{2208} R2");
    assert_eq!(formula.0.last().map(|term| term.level), Some(Level::Sup));
}
