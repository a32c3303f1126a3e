//! A kind of robot from outside the library.

use bevy::app::App;
use bevy::prelude::MinimalPlugins;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{DiscSizes, InputKind, Kinds, RobotKind, Sizes, Space};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::picture::Theme;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ChartLine, ConfigurationError, PartRates, Rates};
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::atlas::{Atlas, names};
use motion_lab_sim::capture::{CaptureError, Subject, at_tick_with_robots, run_svg};
use motion_lab_sim::manifest::{Formula, Level};
use motion_lab_sim::recording::{Recorder, Run, RunError, final_lines, final_lines_with, verify, verify_with_robots};
use motion_lab_sim::run::{Log, RobotInput};
use motion_lab_sim::simulation::{
    Extra, LatestFrame, RobotKinds, RobotPlugin, SimulatedRobot, SimulationPlugin, headless_app, start_run, view,
};
use motion_lab_sim::tour::TourConfig;

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
        let (s, c) = motion_lab_core::num::sin_cos(*bearing);
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
    assert_eq!(Run::replay_with_robots(&log, add).unwrap(), log.frames());
    let puck = |k: usize| &log.frames()[k - 1].robots[0];
    let scene = Scene::of_world(&arena(2.0, &[]));
    let clearance =
        scene.distance(&Puck { radius: 0.2 }.footprint(&R2::from_coordinates(&puck(59).configuration).unwrap()));
    assert!(puck(59).in_contact && (1e-5..=1e-4).contains(&clearance), "it tours into a wall and is held: {clearance}");
    assert_eq!(puck(61).target.len(), 2);
    assert_eq!(puck(220).extra[0], 220.0);
    assert!(puck(149).configuration[0] < -0.99 && puck(220).configuration[0] > 1.0);
    // its own state is in the frames, so a run restored in the middle goes on the same
    let mut run = Recorder::with_robots(config(220), (Seed(8), script(events)), add).unwrap();
    run.restore(&log.frames()[80]).unwrap();
    assert_eq!(run.step(), &log.frames()[81]);

    let unknown = Run::record(config(1), Seed(8));
    assert!(matches!(unknown, Err(RunError::Spawn(e)) if e.to_string().contains("no kind \"puck\"")));
}

#[test]
fn a_type_without_the_hook_takes_no_sizes() {
    let add = |app: &mut bevy::app::App| {
        app.add_plugins(RobotPlugin::new("puck", Puck { radius: 0.2 }));
        app.add_plugins(RobotPlugin::new("x-big", RUSTY));
    };
    assert_eq!(bevy::app::Plugin::name(&RobotPlugin::new("x-big", RUSTY)), "x-big", "Bevy tells kinds apart");
    let sizes = || Sizes::Disc(DiscSizes { radius: 0.4, track: 0.3, wheel_radius: 0.05 });
    let mut config = config(1);
    config.worlds[0].robots[0].sizes = Some(sizes());
    let refused = Run::record_with_robots(config.clone(), Seed(8), add).unwrap_err().to_string();
    assert!(refused.ends_with("`disc` is for the lab's kinds: what a puck is like, its program says"), "{refused}");
    // a type that has the hook takes them under any name
    config.worlds[0].robots = vec![Resident::new("it", "x-big", [0.0; 3]).with_sizes(sizes())];
    let run = Recorder::with_robots(config, Seed(8), add).unwrap();
    assert_eq!(run.view()[0].footprint.parts()[0].placed().radius(), 0.4);
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
    motion_lab_sim::simulation::step(app.world_mut());
    // an arc of v dt tan(phi) / L
    let heading = app.world().resource::<LatestFrame>().frame().robots[0].configuration[2];
    let expected = 1.5 * 0.05 * motion_lab_core::num::tan(0.6) / 2.0;
    assert!((heading - expected).abs() < 1e-12, "{heading} {expected}");
}

static PUCK: RobotKind = RobotKind {
    name: "puck",
    title: "Puck",
    home: None,
    usual: None,
    sizes: None,
    coordinates: &["x", "y"],
    start: "two: x, y",
    spaces: &[Space { coordinates: 2, formula: "q = (x, y) \u{2208} R^2", words: "A point of the plane." }],
    lengths: 2,
    drives: false,
    takes: &[InputKind::Drive, InputKind::MoveTo, InputKind::Teleport, InputKind::Release],
    senses: false,
    has_encoders: false,
    difference: |from, to| R2::from_coordinates(from)?.difference(&R2::from_coordinates(to)?).ok(),
    printed: |q| R2::from_coordinates(q).map(|q| q.to_string()),
};

#[test]
fn a_kind_of_ones_own_is_shown_by_its_own_description() {
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

/// Adds pucks as worlds' files may name them.
fn with_pucks(app: &mut App) {
    app.add_plugins(RobotPlugin::new("x-puck", Puck { radius: 0.2 }).described(&PUCK));
}

/// A recorded run of a puck and a rover, written as a file and read back.
fn log_of_pucks() -> Log {
    let mut config = config(80);
    config.worlds[0].robots[0].kind = "x-puck".into();
    let log = Run::record_with_robots(config, Seed(8), with_pucks).unwrap();
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    Log::read_mcap(&file).unwrap().log
}

#[test]
fn a_log_with_a_kind_of_ones_own_verifies_and_is_drawn_by_the_library() {
    let mut log = log_of_pucks();
    assert!(verify(&log, |_| {}).unwrap_err().to_string().contains("no kind \"x-puck\""));
    let mut seen = 0;
    let verified = verify_with_robots(&log, with_pucks, |run| seen += run.view().len()).unwrap();
    assert_eq!((verified.identical, verified.difference, verified.digest), (80, None, log.digest().unwrap()));
    assert_eq!(seen, 2 * 81);

    // the last lines are printed by the description
    let q = &log.frames()[79].robots[0].configuration;
    let kinds = Kinds::default().with("x-puck", &PUCK);
    let contacts = log.frames()[79].robots[0].contacts;
    let line = format!("puck  R2 {{ x: {:.3}, y: {:.3} }}  contacts: {contacts}", q[0], q[1]);
    assert_eq!(final_lines_with(&log, &kinds)[0], line);
    assert_eq!(final_lines(&log)[0], format!("puck  [{:.3}, {:.3}]  contacts: {contacts}", q[0], q[1]));

    // its figures, of any tick
    let svg = run_svg(&log, 80, Theme::Light, with_pucks).unwrap();
    assert!(
        svg.contains(&log.digest().unwrap().to_string()) && svg.contains(&format!("R2 {{ x: {:.3}", q[0])),
        "{svg}"
    );
    assert_ne!(svg, run_svg(&log, 40, Theme::Light, with_pucks).unwrap());
    assert!(matches!(run_svg(&log, 81, Theme::Light, with_pucks), Err(CaptureError::NoTick { tick: 81, last: 80 })));
    assert!(matches!(run_svg(&log, 80, Theme::Light, |_| {}), Err(CaptureError::Run(_))));
    let subject = Subject::Dashboard { names: false, scan: false, nearest: false };
    let captured = at_tick_with_robots(&log, &subject, 30, 640.0, with_pucks, |_| {}).unwrap();
    assert!(captured.figure.panels[0].picture.items.iter().any(|item| item.name == "puck"));

    // a forged tick is found
    log.frames_mut()[9].robots[0].refusals += 1;
    assert_eq!(verify_with_robots(&log, with_pucks, |_| {}).unwrap().identical, 9);
}

/// An app hands its kinds on to what records beside it.
#[test]
fn the_kinds_of_an_app_are_added_to_another() {
    let log = log_of_pucks();
    let mut app = headless_app();
    with_pucks(&mut app);
    let longer = Hitch { hitch_len: Some(3.0), ..HITCH };
    app.add_plugins(RobotPlugin::new("hitch", longer));
    let kinds = app.world().resource::<RobotKinds>().clone();
    assert_eq!(verify_with_robots(&log, |app| kinds.add_to(app), |_| {}).unwrap().identical, 80);
    // from hand to hand, and a kind registered again is the new one
    let mut second = headless_app();
    kinds.add_to(&mut second);
    let mut config = config(1);
    config.worlds[0].robots = vec![Resident::new("car", "hitch", [0.0; 4])];
    let second = second.world().resource::<RobotKinds>().clone();
    let run = Recorder::with_robots(config, Seed(1), |app| second.add_to(app)).unwrap();
    // the trailer's box ends 0.8 m behind its axle, which is 3 m behind the car's
    assert_eq!(run.view()[0].footprint.parts()[1].placed().bounds().min.x, -3.8);
    assert_eq!(second.known().of("x-puck"), Some(&PUCK));
}

/// The atlas names and draws it at its start, and puts nothing onto it.
#[test]
fn the_atlas_shows_a_kind_that_it_knows() {
    let mut app = headless_app();
    with_pucks(&mut app);
    let kinds = app.world().resource::<RobotKinds>().known();
    let robots: [(&str, &str, &[f64]); 2] = [("puck", "x-puck", &[0.0, 0.5]), ("Rusty", "rusty", &[1.0, 1.0, 0.0])];
    let plain = Atlas::new(arena(2.0, &robots));
    let named = |atlas: &Atlas| names(atlas, 100.0).iter().any(|item| item.id == "name/robots/puck");
    let drawn = |atlas: &Atlas| atlas.picture().items.iter().any(|item| item.name == "puck");
    assert!(!named(&plain) && !drawn(&plain));
    let mut atlas = plain.knowing(kinds);
    assert!(named(&atlas) && drawn(&atlas));
    let (name, footprint) = atlas.others().next().unwrap();
    assert_eq!((name, footprint.parts()[0].placed().core()[0]), ("puck", Point2::new(0.0, 0.5)));
    // a rover of radius 0.11 m beside a puck of radius 0.2 m
    let rover = atlas.robots()[0].q;
    let refusal = atlas.teleport(0, rover.with(0, 0.3).with(1, 0.5)).unwrap().unwrap_err();
    assert_eq!(refusal.to_string(), "would overlap puck");
    assert_eq!(atlas.teleport(0, rover.with(0, 0.32).with(1, 0.5)), Some(Ok(())));
}
