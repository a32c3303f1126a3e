//! Crowds: a robot-step in a generated warehouse beside the static scan of the same rovers, and replicas.

use motion_lab::collision::Scene;
use motion_lab::geometry::Pose2;
use motion_lab::random::Seed;
use motion_lab::recording::Recorder;
use motion_lab::robots::RUSTY;
use motion_lab::run::{DT, RunDigest, Script};
use motion_lab::sensors::{RangeSensor, Scanner};
use motion_lab::simulation::Replicas;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::worlds::{Warehouse, World};

use crate::measure::{Contender, Timing, is_timed, race};
use crate::{Row, Table, readme};

const SENSOR: RangeSensor = RangeSensor { n_rays: 360, max_range: 4.0 };

/// A warehouse of so many robots: of ten, eight rovers with a sensor, an arm and a car.
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
        let mut recorder = Recorder::new(config.clone(), BOOK_SEED).expect("the warehouse runs");
        let mut digest = RunDigest::new(BOOK_SEED, &config, &Script::empty(), recorder.frame());
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

/// Does some work on so many threads.
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

pub fn rows(table: &mut Table) {
    for robots in [10, 100, 1_000, 10_000, 100_000] {
        let work = format!("a robot-step in a warehouse of {robots} robots, one thread");
        if !table.wants(&work) {
            continue;
        }
        let world = warehouse(robots);
        let mut crowd = Crowd::begin(world.clone());
        let poses = crowd.poses.clone();
        let timings = on(1, || {
            race(vec![Contender::new("", |_| crowd.step()), Contender::new("scan alone", scans(&world, &poses))])
        });
        let (step, scan) = (timings[0].per(robots as f64), timings[1].per(poses.len() as f64));
        let contacts: u32 = crowd.recorder.frame().robots.iter().map(|r| r.contacts).sum();
        assert_eq!(contacts, 0, "nobody meets anybody");
        if is_timed() {
            println!("  {:.1}x real time on one thread", DT * 1e9 / timings[0].median);
        }
        table.push(Row {
            work,
            ours: readme::time(step.median),
            peer: format!("scan alone {}", readme::time(scan.median)),
            ratio: format!("{:.2} scans", scan.times_faster_than(&step)),
            spread: spread(&[&step, &scan]),
            must: if matches!(robots, 1_000 | 10_000) { "<= 2.5 scans" } else { "" },
        });
    }
    let work = "a robot-step in a warehouse of 10000 robots, two threads";
    if table.wants(work) {
        let world = warehouse(10_000);
        let [mut one, mut two] = [1, 2].map(|_| Crowd::begin(world.clone()));
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let (single, pair) = (pool(1), pool(2));
        let timings = race(vec![
            Contender::new("", |_| pair.install(|| two.step())),
            Contender::new("one thread", |_| single.install(|| one.step())),
        ]);
        // both at one tick
        while one.recorder.frame().tick != two.recorder.frame().tick {
            let behind = if one.recorder.frame().tick < two.recorder.frame().tick { &mut one } else { &mut two };
            behind.step();
        }
        assert_eq!(one.digest.digest(), two.digest.digest(), "threads change nothing");
        let timings: Vec<Timing> = timings.iter().map(|t| t.per(10_000.0)).collect();
        table.push(Row {
            work: work.into(),
            ours: readme::time(timings[0].median),
            peer: format!("one thread {}", readme::time(timings[1].median)),
            ratio: format!("{:.2} of one", 1.0 / timings[0].times_faster_than(&timings[1])),
            spread: spread(&[&timings[0], &timings[1]]),
            must: "<= 0.8 of one",
        });
    }
}

fn spread(timings: &[&Timing]) -> String {
    timings.iter().map(|t| format!("{:.0} %", 100.0 * t.spread)).collect::<Vec<_>>().join(", ")
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
    let timings = on(1, || {
        race(vec![Contender::new("", |_| replicas.step()), Contender::new("scans alone", scans(&world, &poses))])
    });
    table.push(Row {
        work: work.into(),
        ours: readme::time(timings[0].median),
        peer: format!("scans alone {}", readme::time(timings[1].median)),
        ratio: format!("{:.2} times", timings[1].times_faster_than(&timings[0])),
        spread: spread(&[&timings[0], &timings[1]]),
        must: "<= 3 times",
    });
}
