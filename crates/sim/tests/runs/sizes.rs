//! Residents with sizes of their own: two arms, two rovers and a lorry in one world, asked about and driven. The
//! expected numbers are elementary geometry.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_6, TAU};

use motion_lab_core::collision::{Checker, Collision, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, DiscSizes, Sizes};
use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::anatomy::{Anatomy, Tab, WorldSource};
use motion_lab_sim::atlas::{Atlas, Editor, Op};
use motion_lab_sim::capture::{Subject, at_tick};
use motion_lab_sim::recording::{Recorder, Run, RunError, verify};
use motion_lab_sim::run::{Event, RobotInput, Script};
use motion_lab_sim::simulation::{App, History, HistoryPlugin, SimulationPlugin, start_run, step};
use motion_lab_sim::tour::TourConfig;

use crate::simulator::{event, quantized, script};

/// A yard with a post before either arm, and a wall with a gap of 0.3 m before either rover.
const YARD: &str = include_str!("../../../../tests/samples/yard.ron");

fn yard() -> World {
    World::parse("yard.ron", YARD).unwrap()
}

fn config(world: World, ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![world], ticks, sensor: None }
}

fn resident(name: &str) -> (AnyRobot, AnyConfiguration) {
    AnyRobot::of_resident(yard().robots.iter().find(|r| r.name == name).unwrap()).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12, "{found} is not {expected}");
}

#[test]
fn footprints_are_those_of_the_residents_own_numbers() {
    for (name, x, [first, second]) in [("Short", 2.0, [0.5, 0.4]), ("Long", 6.0, [0.8, 0.6])] {
        let (arm, q) = resident(name);
        // the first link 30 degrees up, the second straight up
        let tip = arm.reference(&q.with(0, FRAC_PI_6).with(1, FRAC_PI_3));
        near(tip.x, x + first * 0.75_f64.sqrt());
        near(tip.y, 2.0 + 0.5 * first + second);
        assert!(arm.footprint(&q).parts().iter().all(|part| part.placed().radius() == 0.02));
        let (base, [least, most]) = arm.annulus().unwrap();
        assert_eq!((base.x, base.y), (x, 2.0));
        near(least, first - second);
        near(most, first + second);
    }
    for (name, x, y, radius) in [("Small", 3.5, 7.0, 0.06), ("Big", 2.0, 10.0, 0.25)] {
        let (rover, q) = resident(name);
        let Aabb { min, max } = rover.footprint(&q).parts()[0].placed().bounds();
        assert_eq!([min.x, max.x, min.y, max.y], [x - radius, x + radius, y - radius, y + radius]);
    }
    let (lorry, q) = resident("Lorry");
    let footprint = lorry.footprint(&q);
    assert_eq!(footprint.parts().len(), 1, "no trailer yet");
    let Aabb { min, max } = footprint.parts()[0].placed().bounds();
    let expected = [10.0 - 0.8, 10.0 + 4.8, 7.0, 9.0];
    [min.x, max.x, min.y, max.y].iter().zip(expected).for_each(|(found, expected)| near(*found, expected));
    // with four coordinates it starts with its own trailer
    let mut towing = yard().robots[4].clone();
    towing.start.push(0.0);
    let (lorry, q) = AnyRobot::of_resident(&towing).unwrap();
    let Aabb { min, max } = lorry.footprint(&q).parts()[1].placed().bounds();
    let expected = [10.0 - 3.0 - 1.0, 10.0 - 3.0 + 1.2, 8.0 - 0.9, 8.0 + 0.9];
    [min.x, max.x, min.y, max.y].iter().zip(expected).for_each(|(found, expected)| near(*found, expected));
}

/// Both arms swing down to their posts, both rovers drive at their gaps, the lorry turns left for a second and takes
/// its trailer.
fn driven() -> Script {
    let down = || RobotInput::MoveTo(quantized(&[0.0, 0.0]));
    let ahead = || RobotInput::Drive(128, 0);
    let mut events: Vec<Event> = vec![event(1, "Short", down()), event(1, "Long", down())];
    events.extend([event(1, "Small", ahead()), event(1, "Big", ahead())]);
    events.push(event(1, "Lorry", RobotInput::Drive(128, 128)));
    events.push(event(21, "Lorry", RobotInput::Drive(0, 0)));
    events.push(event(21, "Lorry", RobotInput::SetTrailer(true)));
    script(events)
}

#[test]
fn in_a_run_the_short_arm_passes_where_the_long_one_is_in_contact() {
    let mut run = Recorder::new(config(yard(), 100), (Seed(3), driven())).unwrap();
    let frame = run.step();
    let touching: Vec<bool> = frame.robots.iter().map(|r| r.in_contact).collect();
    assert_eq!(touching, [false, true, false, false, false]);
    // a tick of the circle with curvature tan(0.4) / 4
    let turned = 1.5 * 0.05 * 0.422_793_218_738_161_8 / 4.0;
    near(frame.robots[4].configuration[2], turned);
    (2..=20).for_each(|_| _ = run.step());
    near(run.frame().robots[4].configuration[2], 20.0 * turned);
    let views = run.view();
    // 0.03 m a tick; counts are whole
    for (view, wheel, counts) in [(&views[2], 0.02, 1718), (&views[3], 0.05, 687)] {
        let turns: f64 = 20.0 * 0.03 / wheel / TAU * 360.0;
        assert_eq!((turns.floor() as i64, view.encoders.unwrap().left), (counts, counts));
        near(view.odometer.unwrap(), counts as f64 / 360.0 * TAU * wheel);
    }
    (21..=100).for_each(|_| _ = run.step());
    let views = run.view();
    assert_eq!((views[0].contacts, views[1].contacts), (0, 1), "the post is 8 cm beyond the short arm");
    let x = |robot: usize| run.frame().robots[robot].configuration[0];
    assert!(x(2) > 4.5 && views[2].contacts == 0, "0.12 m through 0.3 m: {}", x(2));
    // a disc of 0.25 m between two ends that are 0.3 m apart reaches sqrt(0.25^2 - 0.15^2) = 0.2 m before them
    assert!((x(3) - 3.8).abs() < 0.03 && views[3].contacts > 0, "{}", x(3));
    let [chassis, trailer] = views[4].footprint.parts() else { panic!("it has its trailer") };
    assert_eq!(views[4].refusals, 0);
    let off = chassis.pose().position() - trailer.pose().position();
    let corners = trailer.placed().core();
    let sides = [3, 1].map(|i: usize| (corners[0] - corners[i]).norm());
    let width = if sides[0] < sides[1] { sides[0] } else { sides[1] };
    assert!((width - 1.8).abs() < 1e-9 && off.norm() < 1e-9, "the box is in the hitch's frame: {width} {off}");
    // the far corners are 3 m and 1 m behind the hitch, and 0.9 m to a side
    let far = (4.0_f64 * 4.0 + 0.9 * 0.9).sqrt();
    let away: Vec<f64> = corners.iter().map(|c| (c - chassis.pose().position()).norm()).collect();
    assert!(away.iter().all(|d| *d < far + 1e-9) && away.iter().filter(|d| **d > far - 1e-9).count() == 2, "{away:?}");
}

#[test]
fn its_log_verifies_and_knows_the_sizes() {
    let log = Run::record(config(yard(), 60), (Seed(3), driven())).unwrap();
    assert!(verify(&log, |_| {}).unwrap().difference.is_none());
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).unwrap();
    let read = motion_lab_sim::run::Log::read_mcap(&bytes).unwrap().log;
    assert_eq!(read.recipe.config.worlds, [yard()]);
    assert_eq!(read.digest(), log.digest());
}

#[test]
fn the_history_counts_with_the_rovers_own_wheels() {
    let mut app = App::new();
    app.add_plugins((SimulationPlugin, HistoryPlugin));
    let turning = script(vec![event(1, "Big", RobotInput::Drive(0, 128))]);
    start_run(app.world_mut(), config(yard(), 10), (Seed(3), driven())).unwrap();
    (0..10).for_each(|_| step(app.world_mut()));
    let at = |app: &App, robot| app.world().resource::<History>().at(10, robot).unwrap().encoders.unwrap();
    // 0.3 m in whole counts: 6 and 15 rad of their own wheels
    near(at(&app, 3), 343.0 / 360.0 * TAU * 0.05);
    near(at(&app, 2), 859.0 / 360.0 * TAU * 0.02);
    start_run(app.world_mut(), config(yard(), 10), (Seed(3), turning)).unwrap();
    (0..10).for_each(|_| step(app.world_mut()));
    let counts = motion_lab_sim::simulation::view(app.world())[3].encoders.unwrap();
    // 2.5 rad/s over half of 0.4 m by wheels of 0.05 m: 5 rad in half a second, 286.5 counts
    assert_eq!((counts.left, counts.right), (-287, 286));
}

#[test]
fn anatomy_configuration_space_and_captures_show_the_resident() {
    let flat = |name: &str| {
        let (robot, q) = resident(name);
        (robot, q.with(0, 0.0).with(1, 0.0))
    };
    let scene = Scene::of_world(&yard());
    near(scene.distance(&flat("Short").0.footprint(&flat("Short").1)), 1.1 - 0.1 - 0.9 - 0.02);
    assert!(scene.intersects(&flat("Long").0.footprint(&flat("Long").1)));
    let first = Anatomy::of_world(yard(), WorldSource::File("my yard.ron".into())).unwrap().with_tab(Tab::Distance);
    near(first.distance(), 1.1 - 0.1 - 0.02);
    let command = first.copy_as_command().unwrap();
    assert_eq!(command, "motion-lab query distance --robot Short --world 'my yard.ron' 1.5707963267948966,0.0");
    let named: Vec<String> = first.residents().into_iter().map(|(name, _)| name).collect();
    assert_eq!(named, ["Short", "Long", "Small", "Big", "Lorry"]);
    let big = first.with_robot(first.residents()[3].1);
    assert_eq!((big.q().coordinates().to_vec(), big.resident().unwrap().name.as_str()), (vec![2.0, 10.0, 0.0], "Big"));
    near(big.distance(), (4.0_f64 + 0.15 * 0.15).sqrt() - 0.25);
    // a kind's own robot goes by its kind
    let lab = first.with_robot(AnyRobot::Rusty(RUSTY));
    assert!(lab.copy_as_command().unwrap().contains("--robot rusty ") && lab.resident().is_none());
    // Long's slice has blocked configurations, Short's none: nothing is within 0.92 m of its base
    let blocked = |name: &str| {
        let (robot, q) = flat(name);
        let checker = Checker::new(Scene::of_world(&yard()), robot);
        let mut map = CellMap::new(Slice::through(&checker, &q).unwrap(), 7);
        map.refine(u32::MAX);
        map.progress().blocked
    };
    assert_eq!(blocked("Short"), 0.0);
    assert!(blocked("Long") > 0.001);
    let log = Run::record(config(yard(), 2), (Seed(3), driven())).unwrap();
    let shown = |name: &str| {
        let robot = Some(name.to_owned());
        let subject = Subject::Cspace { world: None, robot, kind: None, finest: 5, annulus: false };
        at_tick(&log, &subject, 1, 640.0).map(|captured| captured.figure.panels[0].readout.join(" "))
    };
    let (short, long) = (shown("Short").unwrap(), shown("Long").unwrap());
    assert!(short.contains("false") && long.contains("true"), "{short} | {long}");
    assert!(shown("Nobody").unwrap_err().to_string().contains("robot Nobody"));
}

#[test]
fn the_atlas_aims_moves_and_keeps_what_residents_are() {
    let atlas = Atlas::new(yard());
    let refusal = atlas.target(0, Point2::new(3.5, 2.0), None).unwrap().unwrap_err();
    assert_eq!(refusal.to_string(), "out of reach: 1.50 m from the base, and the tip gets from 0.10 to 0.90 m");
    let mut atlas = atlas;
    let big = atlas.robots()[3].q;
    // 0.25 m before the middle wall, and a millimetre
    assert_eq!(atlas.teleport(3, big.with(0, 3.749).with(1, 9.0)), Some(Ok(())));
    assert_eq!(
        atlas.teleport(3, big.with(0, 3.75).with(1, 9.0)).unwrap().unwrap_err().to_string(),
        "would overlap the middle wall"
    );
    let mut editor = Editor::new(yard());
    let by = |x, y| Vector2::new(x, y);
    editor.apply(&Op::Move { name: "Big".into(), by: by(0.5, 0.0) }).unwrap();
    editor.apply(&Op::Rename { name: "Big".into(), to: "Bigger".into() }).unwrap();
    editor.apply(&Op::Move { name: "Short".into(), by: by(0.25, -1.0) }).unwrap();
    let (now, before) = (&editor.world().robots, yard().robots);
    assert_eq!((now[3].name.as_str(), &now[3].start[..]), ("Bigger", &[2.5, 10.0, 0.0][..]));
    assert_eq!((&now[3].sizes, &now[4]), (&before[3].sizes, &before[4]));
    let Some(Sizes::Arm(arm)) = &now[0].sizes else { panic!("an arm") };
    assert_eq!(
        (arm.base, &arm.lengths[..], &now[0].start),
        (Point2::new(2.25, 1.0), &[0.5, 0.4][..], &before[0].start)
    );
    // An arm without sizes of its own stands at the origin, with links of 1 m: its world says so once it is moved.
    let mut plain = yard();
    plain.robots[0].sizes = None;
    let mut editor = Editor::new(plain);
    editor.apply(&Op::Move { name: "Short".into(), by: by(1.0, 0.5) }).unwrap();
    let Some(Sizes::Arm(arm)) = &editor.world().robots[0].sizes else { panic!("an arm") };
    assert_eq!((arm.base, &arm.lengths[..]), (Point2::new(1.0, 0.5), &[1.0, 1.0][..]));
}

#[test]
fn sizes_that_no_file_may_hold_start_no_run() {
    let refused = |resident: Resident| {
        let world = World { robots: vec![resident], ..yard() };
        match Run::record(config(world, 1), Seed(1)) {
            Err(RunError::Spawn(error)) => error.to_string(),
            other => panic!("{other:?}"),
        }
    };
    let disc = |radius| Sizes::Disc(DiscSizes { radius, track: 0.2, wheel_radius: 0.03 });
    let rover = || Resident::new("R", "rusty", [1.0, 1.0, 0.0]);
    assert_eq!(
        refused(rover().with_sizes(disc(f64::NAN))),
        "robot \"R\" in world \"Yard\": disc.radius NaN: it must be from 0.001 to 1000"
    );
    let arm = Resident::new("A", "reach3", [0.0; 3]);
    assert!(refused(arm.clone().with_sizes(disc(0.2))).ends_with("a reach3 has no `disc`: its numbers are its `arm`"));
    let two = Sizes::of_kind("reach").unwrap();
    assert!(refused(arm.with_sizes(two)).ends_with("arm.lengths: 2 links, a reach3 has 3"));
}

#[test]
fn robots_of_the_smallest_and_the_largest_sizes_run() {
    let sizes = |field: &str| format!("(name: \"it\", kind: {field})");
    for robot in [
        r#""rusty", start: [0, 0, 0], disc: (radius: 0.001, track: 0.001, wheel_radius: 0.001)"#,
        r#""rusty", start: [0, 0, 0], disc: (radius: 1000, track: 1000, wheel_radius: 1000)"#,
        r#""reach3", start: [0, 0, 0], arm: (base: (10000, 10000), lengths: [1000, 1000, 1000], radius: 1000)"#,
        r#""reach", start: [0, 0], arm: (lengths: [0.001, 0.001], radius: 0.001)"#,
        r#""hitch", start: [0, 0, 0, 2], car: (wheelbase: 0.1, length: 0.1, rear_overhang: 0, max_steer: 1.5,
            trailer: (hitch_len: 0.1, front_overhang: 0, rear_overhang: 0.001, width: 0.001))"#,
    ] {
        let text = format!(
            "World(version: 1, name: \"w\", bounds: (min: (-10000, -10000), max: (10000, 10000)),\n\
             walls: [(name: \"wall\", points: [(1, -5), (1, 5)])], robots: [{}])",
            sizes(robot)
        );
        let world = World::parse("w.ron", &text).unwrap();
        let events = script(vec![event(1, "it", RobotInput::Drive(128, 128))]);
        let log = Run::record(config(world, 40), (Seed(9), events)).unwrap();
        assert!(verify(&log, |_| {}).unwrap().difference.is_none(), "{robot}");
        let last = log.frames().last().unwrap();
        assert!(last.robots[0].configuration.iter().all(|x| x.is_finite()), "{robot}");
    }
}

#[test]
fn a_straight_arm_turned_a_quarter_is_a_quarter_turned() {
    let (arm, q) = resident("Long");
    let tip = arm.reference(&q.with(0, FRAC_PI_2).with(1, 0.0));
    near(tip.x, 6.0);
    near(tip.y, 3.4);
}
