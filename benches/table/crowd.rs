//! Crowds: a robot-step in a generated warehouse beside the static scan of the same rovers, and replicas.

use motion_lab::collision::Scene;
use motion_lab::configuration::AnyConfiguration;
use motion_lab::geometry::Pose2;
use motion_lab::random::Seed;
use motion_lab::recording::Recorder;
use motion_lab::robots::{AnyRobot, RUSTY};
use motion_lab::run::{DT, Recipe, RunDigest};
use motion_lab::sensors::{RangeSensor, Scanner};
use motion_lab::simulation::Replicas;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::{Resident, Warehouse, World};

use crate::Table;
use crate::contest::sides;
use crate::measure::{Entrant, race};
use crate::rivals::Task;
use crate::row::{Mark, Row};

const SENSOR: RangeSensor = RangeSensor { n_rays: 360, max_range: 4.0 };

/// A warehouse of this number of robots: of ten, eight rovers with a sensor, an arm and a car.
pub fn warehouse(robots: usize) -> World {
    Warehouse { seed: Seed(1), robots, trailers: false }.world().expect("a number in range")
}

/// A run under way, with its digest, and the poses from which its rovers scan.
struct Crowd {
    recorder: Recorder,
    digest: RunDigest,
    poses: Vec<Pose2>,
}

impl Crowd {
    fn begin(world: World) -> Self {
        let config = TourConfig { worlds: vec![world], ticks: 1_000_000, sensor: Some(SENSOR) };
        let recipe = Recipe::new(config, BOOK_SEED);
        let mut recorder = Recorder::of(&recipe).expect("the warehouse runs");
        let mut digest = RunDigest::new(&recipe, recorder.frame());
        (0..20).for_each(|_| digest.tick(recorder.step()));
        let frame = recorder.frame();
        let pose = |scan: &motion_lab::run::RobotScan| {
            let q = &frame.robots[scan.robot as usize].configuration;
            Pose2::new(q[0], q[1], q[2])
        };
        let poses = frame.scans.iter().map(pose).collect();
        Crowd { recorder, digest, poses }
    }

    /// A tick: everything up to the frame, and its digest.
    fn step(&mut self) -> u64 {
        self.digest.tick(self.recorder.step());
        self.recorder.frame().tick
    }
}

/// Does some work on this number of threads.
fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work)
}

/// The scans of the poses one after the other, without other robots.
fn scans<'a>(world: &World, poses: &'a [Pose2]) -> impl FnMut(usize) -> f64 + 'a {
    let (scene, mut scanner) = (Scene::of_world(world), Scanner::new(SENSOR));
    let mut ranges = vec![0.0; 360 * poses.len()];
    move |_| {
        for (pose, ranges) in poses.iter().zip(ranges.chunks_mut(360)) {
            scanner.scan_into(&scene, &[], pose, ranges);
        }
        ranges[7]
    }
}

/// The steps of a round, so that small crowds take about as long as large ones.
fn steps(robots: usize) -> usize {
    (2_000 / robots).max(1)
}

pub fn rows(table: &mut Table) {
    for robots in [10, 100, 1_000, 10_000, 100_000] {
        let work = format!("a robot-step in a warehouse of {robots} robots, one thread");
        if !table.wants(&work) {
            continue;
        }
        let mark = if matches!(robots, 1_000 | 10_000) { Mark::at_most(2.5, " scans") } else { Mark::cost(" scans") };
        let world = warehouse(robots);
        let mut crowd = Crowd::begin(world.clone());
        let poses = crowd.poses.clone();
        on(1, || {
            let (sensed, all) = (poses.len() as f64, robots as f64);
            // a robot's scan is a share of all scans as its step is of all steps
            let mut scan = Entrant::new("its scan alone", steps(robots), scans(&world, &poses));
            scan.scale(all / sensed);
            let entrants = vec![Entrant::new("", steps(robots), |_| crowd.step()), scan];
            table.race_per(all, &[(work, mark)], |_| entrants);
        });
        let contacts: u32 = crowd.recorder.frame().robots.iter().map(|r| r.contacts).sum();
        assert_eq!(contacts, 0, "nobody meets anybody");
    }
    let work = "a robot-step in a warehouse of 10000 robots, two threads";
    if table.wants(work) {
        let world = warehouse(10_000);
        let [mut one, mut two] = [1, 2].map(|_| Crowd::begin(world.clone()));
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let (single, pair) = (pool(1), pool(2));
        table.race_per(10_000.0, &[(work.into(), Mark::at_most(0.8, " of one"))], |_| {
            vec![
                Entrant::new("", 1, |_| pair.install(|| two.step())),
                Entrant::new("one thread", 1, |_| single.install(|| one.step())),
            ]
        });
        // both at one tick
        while one.recorder.frame().tick != two.recorder.frame().tick {
            let behind = if one.recorder.frame().tick < two.recorder.frame().tick { &mut one } else { &mut two };
            behind.step();
        }
        assert_eq!(one.digest.digest(), two.digest.digest(), "threads change nothing");
    }
}

/// The same crowd by simulators that others use, a robot-step each: agents that drive straight on with the same scans.
pub fn rivals(table: &mut Table) {
    for (robots, mark) in [(100, 50.0), (1_000, 250.0)] {
        let work = format!("a robot-step in a warehouse of {robots} robots");
        if !table.wants(&format!("{work} by others")) {
            continue;
        }
        let world = warehouse(robots);
        let task = Task {
            kind: "crowd".into(),
            settings: vec![SENSOR.max_range, DT, RUSTY.body_radius],
            obstacles: sides(&Scene::of_world(&world)),
            cases: world.robots.iter().map(|resident| at(resident).to_vec()).collect(),
        };
        let peers = table.peers.entrants(&task, |_, _| ());
        if peers.is_empty() {
            continue;
        }
        let mut crowd = Crowd::begin(world);
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let mut ours = Entrant::new("", steps(robots), |_| one.install(|| crowd.step()));
        ours.scale(1.0 / robots as f64);
        let timings = race(std::iter::once(ours).chain(peers).collect());
        for peer in &timings[1..] {
            let mark = if peer.name == "navground" { Mark::faster_by(mark) } else { Mark::FASTER };
            let work = format!("{work}, by {}", peer.name);
            table.push(Row::new(work, mark, &timings[0], std::slice::from_ref(peer)));
        }
    }
}

/// Where a resident begins: x, y and heading; an arm at its base.
fn at(resident: &Resident) -> [f64; 3] {
    match AnyRobot::of_resident(resident).expect("a robot of the lab") {
        (_, AnyConfiguration::Pose(pose)) => [pose.x, pose.y, pose.theta],
        (_, AnyConfiguration::Hitch(car)) => [car.body.x, car.body.y, car.body.theta],
        (AnyRobot::Reach(arm), _) => [arm.base.x, arm.base.y, 0.0],
        (AnyRobot::Reach3(arm), _) => [arm.base.x, arm.base.y, 0.0],
        (robot, _) => panic!("{robot:?} is nowhere"),
    }
}

/// Many runs of one robot, stepped together, beside their scans alone.
pub fn replicas(table: &mut Table) {
    let work = "a step of 1,024 replicas of Rusty in the Apartment with its scan, one thread";
    if !table.wants(work) {
        return;
    }
    let world = World::apartment();
    let seeds = (0..1024).map(Seed);
    let mut replicas = Replicas::new(&RUSTY, &world, &world.robots[0], Some(SENSOR), seeds).expect("they start");
    (0..200).for_each(|_| replicas.step());
    let poses: Vec<Pose2> = (0..replicas.len()).map(|i| *replicas.configuration(i)).collect();
    on(1, || {
        let scans = Entrant::new("its scans alone", 1, scans(&world, &poses));
        let entrants = vec![Entrant::new("", 1, |_| replicas.step()), scans];
        table.race(&[(work.into(), Mark::at_most(3.0, " times"))], |_| entrants);
    });
}
