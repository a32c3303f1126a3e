//! Many robots: the same run on any number of threads, and replicas that give the bits of the schedule.

use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{RUSTY, Reach};
use motion_lab_core::sensors::{BeamModel, RangeSensor};
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Event, RobotInput, Script};
use motion_lab_sim::simulation::Replicas;
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use crate::simulator::quantized;

/// So many rovers half a metre apart, driven into one another.
fn crowd(robots: usize) -> (TourConfig, Script) {
    let side = 0.5 * (robots as f64).sqrt();
    let corner = Point2::new(side, side);
    let mut world =
        World::empty("square", Aabb { min: Point2::new(-1.0, -1.0), max: corner + (corner - Point2::origin()) });
    let mut draws = Stream::new(Seed(4), "crowd");
    let mut events = Vec::new();
    let columns = (robots as f64).sqrt().ceil() as usize;
    for i in 0..robots {
        let (x, y) = (0.5 * (i % columns) as f64, 0.5 * (i / columns) as f64);
        let start = vec![x, y, draws.uniform(-3.0, 3.0)];
        world.robots.push(Resident::new(format!("rover {i}"), RobotKind::RUSTY.name, start));
        let input = RobotInput::Drive(128, draws.below(65) as i16 - 32);
        events.push(Event { tick: 1, robot: format!("rover {i}"), input });
    }
    let sensor = RangeSensor { n_rays: 12, max_range: 1.0 };
    (TourConfig { worlds: vec![world], ticks: 30, sensor: Some(sensor) }, Script { events, ..Script::empty() })
}

#[test]
fn a_crowd_runs_the_same_on_any_number_of_threads() {
    let (config, script) = crowd(600);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Run::record(config.clone(), (BOOK_SEED, script.clone())).unwrap())
    };
    let alone = run(1);
    let contacts: u32 = alone.frames()[29].robots.iter().map(|r| r.contacts).sum();
    assert!(contacts > 100, "they meet: {contacts}");
    for threads in [2, 3, 8] {
        assert_eq!(run(threads).digest(), alone.digest(), "{threads} threads");
    }
}

/// A world with this resident alone.
fn alone(world: &World, resident: &Resident) -> World {
    World { robots: vec![resident.clone()], ..world.clone() }
}

#[test]
fn replicas_give_the_bits_of_recorded_runs() {
    let sensor = Some(RangeSensor { n_rays: 90, max_range: 4.0 });
    let world = World::apartment();
    let noise = BeamModel { sigma_hit: 0.02, z_short: 0.1, lambda_short: 1.0, z_miss: 0.05, z_max: 0.05, z_rand: 0.05 };
    let rover = Resident { sensor: Some(noise), ..world.robots[0].clone() };
    // into the wall and along it; a teleport into it is refused; then back to the tour
    let inputs = [
        (20, RobotInput::Drive(128, 20)),
        (90, RobotInput::Teleport(quantized(&[0.0; 3]))),
        (130, RobotInput::Drive(-100, -90)),
        (200, RobotInput::Release),
    ];
    let seeds = [Seed(1), Seed(2), BOOK_SEED, Seed(u64::MAX)];
    let mut replicas = Replicas::new(&RUSTY, &world, &rover, sensor, seeds).unwrap();
    let config = TourConfig { worlds: vec![alone(&world, &rover)], ticks: 300, sensor };
    let recorders = seeds.iter().enumerate().map(|(i, &seed)| {
        let events = inputs.iter().filter(|_| i % 2 == 0);
        let events = events.map(|(tick, input)| Event { tick: *tick, robot: rover.name.clone(), input: input.clone() });
        Recorder::new(config.clone(), (seed, Script { events: events.collect(), ..Script::empty() })).unwrap()
    });
    let mut recorders: Vec<Recorder> = recorders.collect();
    for tick in 0..=300 {
        for (i, recorder) in recorders.iter_mut().enumerate() {
            assert_eq!(&replicas.frame(i), recorder.frame(), "replica {i} at tick {tick}");
            recorder.step();
        }
        for (at, input) in &inputs {
            if *at == tick + 1 {
                let accepted = [0, 2].map(|i| replicas.input(i, input));
                assert_eq!(accepted, [!matches!(input, RobotInput::Teleport(_)); 2], "{input:?}");
            }
        }
        replicas.step();
    }
    assert!(replicas.contacts(0).episodes() > 0 && replicas.contacts(1).episodes() == 0);

    // one begins anew, the others go on
    replicas.reset(1, Seed(7)).unwrap();
    let mut anew = Recorder::new(config, Seed(7)).unwrap();
    for _ in 0..40 {
        assert_eq!(&replicas.frame(1), anew.frame());
        assert_eq!(replicas.tick(0), 301 + replicas.tick(1));
        anew.step();
        replicas.step();
    }
}

#[test]
fn a_replica_begun_by_inputs_is_the_run_whose_script_begins_with_them() {
    let rays = RangeSensor { n_rays: 24, max_range: 4.0 };
    let (sensor, world) = (Some(rays), World::apartment());
    let noise = BeamModel { sigma_hit: 0.02, z_short: 0.1, lambda_short: 1.0, z_miss: 0.05, z_max: 0.05, z_rand: 0.05 };
    let rover = Resident { sensor: Some(noise), ..world.robots[0].clone() };
    let mut replicas = Replicas::new(&RUSTY, &world, &rover, sensor, [Seed(1), Seed(2)]).unwrap();
    (0..7).for_each(|_| replicas.step());
    let begin = [RobotInput::Teleport(quantized(&[3.0, 5.5, 0.5])), RobotInput::Drive(128, 30)];
    assert_eq!(replicas.begin(1, Seed(9), &begin), Ok(true));
    assert_eq!((replicas.tick(0), replicas.tick(1)), (7, 0));
    let there = Pose2::new(3.0, 5.5, 0.5);
    assert_eq!(*replicas.configuration(1), there);
    let event = |input: &RobotInput| Event { tick: 1, robot: rover.name.clone(), input: input.clone() };
    let script = Script { events: begin.iter().map(event).collect(), ..Script::empty() };
    let config = TourConfig { worlds: vec![alone(&world, &rover)], ticks: 60, sensor };
    let mut recorder = Recorder::new(config, (Seed(9), script)).unwrap();
    for _ in 0..60 {
        replicas.step();
        assert_eq!(&replicas.frame(1), recorder.step());
    }
    // without noise, what is read at the beginning is the scan from there
    let mut exact = Replicas::new(&RUSTY, &world, &world.robots[0], sensor, [Seed(1)]).unwrap();
    let first = exact.ranges(0).to_vec();
    assert_eq!(exact.begin(0, Seed(9), &begin[..1]), Ok(true));
    let right = rays.scan_from(&Scene::apartment(), &[], &there);
    assert!(exact.ranges(0) == right && exact.ranges(0) != first);
    // one that is refused is said, and those after it apply
    let into_the_wall = [RobotInput::Teleport(quantized(&[0.0; 3])), begin[0].clone()];
    assert_eq!(exact.begin(0, Seed(9), &into_the_wall), Ok(false));
    assert_eq!(*exact.configuration(0), there);
}

#[test]
fn replicas_of_an_arm_have_targets_and_no_sensor() {
    let world = World::workbench();
    let arm = &world.robots[0];
    let mut replicas = Replicas::new(&Reach::<2>::workbench(), &world, arm, None, [Seed(3)]).unwrap();
    let to = RobotInput::MoveTo(quantized(&[1.0, -0.5]));
    assert!(replicas.input(0, &to));
    let script = Script { events: vec![Event { tick: 1, robot: arm.name.clone(), input: to }], ..Script::empty() };
    let config = TourConfig { worlds: vec![alone(&world, arm)], ticks: 100, sensor: None };
    let mut recorder = Recorder::new(config, (Seed(3), script)).unwrap();
    for _ in 0..100 {
        replicas.step();
        assert_eq!(&replicas.frame(0), recorder.step());
    }
    assert_eq!(replicas.configuration(0).0, [1.0, -0.5]);
    assert!(replicas.ranges(0).is_empty());
}
