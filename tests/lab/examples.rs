//! The example programs: their output is pinned, and their claims are checked by other means than theirs.

use std::f64::consts::TAU;
use std::path::Path;

use motion_lab::collision::{Checker, Scene};
use motion_lab::num::{cos, sin};
use motion_lab::prelude::*;
use motion_lab::robots::PartRates;
use oracle::arm::{arm_clearance, obstacles};
use oracle::{plain, short};

#[path = "../../examples/bevy_app.rs"]
mod bevy_app;
#[path = "../../examples/bug1.rs"]
mod bug1;
#[path = "../../examples/crowd.rs"]
mod crowd;
#[path = "../../examples/custom_robot.rs"]
pub mod custom_robot;
#[path = "../../examples/foreign_systems.rs"]
mod foreign_systems;
#[path = "../../examples/lab_tour.rs"]
mod lab_tour;
#[path = "../../examples/own_planner.rs"]
mod own_planner;
#[path = "../../examples/redundancy_walk.rs"]
mod redundancy_walk;

/// Fails when an example's output differs from the one pinned in tests/pinned.
macro_rules! assert_prints {
    ($name:literal, $printed:expr) => {
        assert_eq!($printed, include_str!(concat!("../pinned/", $name, ".txt")), "examples/{}.rs", $name)
    };
}

#[test]
fn the_lab_tour() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("lab_tour-{}", std::process::id()));
    let figure = folder.join("figures/ch02_tour.svg");
    assert_prints!("lab_tour", lab_tour::report(&figure).unwrap());
    let svg = std::fs::read_to_string(&figure).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    // the pinned run, whole: its digest and its length stand under the figure
    let pins = include_str!("../../crates/sim/tests/pins/mod.rs");
    let digest = svg.split("Digest ").nth(1).and_then(|rest| rest.get(..32)).unwrap();
    assert!(pins.contains(digest) && svg.contains("Seed 2005, 1200 ticks (60.00 s)"), "{digest}");
    for robot in ["Rusty", "Reach", "Hitch"] {
        assert!(svg.contains(&format!("the way of {robot}")), "{robot}");
    }
}

#[test]
fn a_planner_of_ones_own() {
    assert_prints!("own_planner", own_planner::report().unwrap());
    let source = include_str!("../../examples/own_planner.rs");
    assert!(source.lines().count() < 80, "the guide promises fewer than 80 lines");
    for seed in 0..5 {
        let checker = own_planner::problem().unwrap().checker().clone();
        let (start, goal) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
        let mut problem = motion_lab::collision::Problem::try_new(checker, start, goal, Seed(seed)).unwrap();
        let path = own_planner::rrt(&mut problem, 0.4, 10_000).unwrap();
        assert_eq!((path[0], path[path.len() - 1]), (start, goal));
        assert!(arm_clearance(&path) > 0.0, "seed {seed}: the oracle finds a contact");
        assert!(own_planner::rrt(&mut problem, 0.4, 1).is_none(), "one sample leads nowhere: the post is between");
    }
}

#[test]
fn the_redundancy_walk() {
    assert_prints!("redundancy_walk", redundancy_walk::report().unwrap());
    let arm = Reach::<3>::redundant();
    for seed in [1, 2, 2005] {
        let walk = redundancy_walk::walk(&arm, Tn([0.3, 0.9, 0.8]), Seed(seed));
        assert_eq!(walk.len(), 200);
        // the tip by hand: three links of 0.6, 0.5 and 0.4 m
        let tip = |q: &Tn<3>| {
            let [a, b, c] = q.0;
            let headings = [(0.6, a), (0.5, a + b), (0.4, a + b + c)];
            headings.iter().fold([0.0, 0.0], |[x, y], (l, th)| [x + l * cos(*th), y + l * sin(*th)])
        };
        let [x, y] = tip(&walk[0]);
        for q in &walk {
            let [qx, qy] = tip(q);
            assert!((qx - x).abs() < 1e-9 && (qy - y).abs() < 1e-9, "{q}");
        }
        assert!(walk.windows(2).all(|w| w[0].0[0] != w[1].0[0]), "theta1 varies at every step");
        let all_near = walk.windows(2).all(|w| short(w[0].0[1], w[1].0[1]).abs() < 0.6);
        assert!(all_near, "the elbow stays on its side: the arm moves without a jump");
    }
}

#[test]
fn bug1_with_both_sensors() {
    let all = bug1::outcomes();
    assert_prints!("bug1", bug1::table(&all));
    let world = Checker::new(Scene::apartment(), RustyDisc::default());
    for (seed, [exact, noisy]) in (0..).map(Seed).zip(&all) {
        let (start, goal) = bug1::task(&world, seed);
        assert!(exact.reached && exact.misjudged == 0, "seed {seed}: Bug1 reaches what can be reached");
        // Bug1's bound: the straight way, and one and a half times round each obstacle met, with a little for turning
        // in and out. No obstacle is longer than both sides of the walls of all rooms
        let bound = (goal - start).norm() + f64::from(exact.rounds) * (1.5 * 95.0 + 2.0);
        assert!(exact.length >= (goal - start).norm() - 0.1 && exact.length <= bound, "seed {seed}: {exact:?}");
        assert!(
            noisy.misjudged > 0 || noisy.reached,
            "seed {seed}: only a misjudged leave point keeps it from the goal"
        );
    }
    assert!(all.iter().map(|[_, noisy]| noisy.misjudged).sum::<u32>() > 0, "noise breaks the promise");
}

#[test]
fn bug1_round_one_disc_goes_as_far_as_geometry_says() {
    let bounds = motion_lab::geometry::Aabb { min: Point2::new(-3.0, -3.0), max: Point2::new(3.0, 3.0) };
    let scene = Scene::empty(bounds).with_obstacle("the disc", Shape::Disc { radius: 0.5 });
    let (start, goal) = (Point2::new(-2.0, 0.05), Point2::new(2.0, 0.05));
    let run = bug1::bug1(&Checker::new(scene.clone(), RustyDisc::default()), start, goal, None);
    // the way: up to the circle at KEEP around the obstacle, once round, half round again to the nearest point, and on
    // to the goal
    let circle = 0.5 + bug1::KEEP;
    let expected = 2.0 * (2.0 - circle) + 1.5 * TAU * circle;
    assert!(run.reached && run.rounds == 1 && run.misjudged == 0, "{run:?}");
    assert!((run.length - expected).abs() < 0.06 * expected, "{} m, not {expected} m", run.length);

    // a walled-in goal is given up after one round
    let corner = |x: f64, y: f64| Point2::new(1.5 + 0.6 * x, 0.6 * y);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let walls: Vec<Segment> = (0..4).map(|i| Segment::new(corners[i], corners[(i + 1) % 4])).collect();
    let walled = Checker::new(Scene::of_walls(&walls), RustyDisc::default());
    let run = bug1::bug1(&walled, start, Point2::new(1.5, 0.0), None);
    assert!(!run.reached && run.rounds == 1, "{run:?}");
}

#[test]
fn an_app_of_ones_own() {
    use motion_lab::simulation::PendingInput;

    assert_prints!("bevy_app", bevy_app::report().unwrap());
    let app = bevy_app::ran(400).unwrap();
    let script = app.world().resource::<PendingInput>().script();
    let [going, turning] = [[128, 0], [0, 64]].map(|channels| {
        let is = |e: &&motion_lab::run::Event| e.input == motion_lab::run::RobotInput::Drive(channels[0], channels[1]);
        script.events.iter().filter(is).count()
    });
    assert!(going > 2 && turning > 2 && going + turning == script.events.len(), "{going} and {turning}");
    assert!(script.events.iter().all(|e| e.robot == "Rusty"), "the system drives rovers alone");
    // the observer's count is the frame's
    let frame = app.world().resource::<motion_lab::simulation::LatestFrame>().frame();
    assert_eq!(
        app.world().resource::<bevy_app::Diary>().contacts,
        frame.robots.iter().map(|r| r.contacts).sum::<u32>()
    );
}

#[test]
fn a_hundred_robots() {
    assert_prints!("crowd", crowd::report(300).unwrap());
    let log = crowd::record(Seed(3), 40).unwrap();
    let names: std::collections::BTreeSet<&str> = log.recipe.config.robot_names().collect();
    assert_eq!((names.len(), log.frames()[39].robots.len()), (100, 100));
    let moved = log
        .initial()
        .unwrap()
        .robots
        .iter()
        .zip(&log.frames()[39].robots)
        .filter(|(a, b)| a.configuration != b.configuration);
    assert!(moved.count() > 90, "nearly all are on tour");
    assert_eq!(motion_lab::recording::verify(&log, |_| {}).unwrap().identical, 40);
}

#[test]
fn a_robot_of_ones_own() {
    use custom_robot::{TRAIN, TrainCfg, config, record, with_trains};
    use motion_lab::recording::Run;

    assert_prints!("custom_robot", custom_robot::report().unwrap());
    let log = record(Seed(8)).unwrap();
    assert_eq!(Run::replay_with_robots(&log, with_trains).unwrap(), log.frames());
    assert_eq!(log.frames(), Run::record_with_robots(config(), Seed(8), with_trains).unwrap().frames());
    assert_ne!(log.frames(), record(Seed(9)).unwrap().frames());
    let unknown = Run::replay(&log).unwrap_err().to_string();
    assert!(unknown.contains("there is no kind \"x-train\""), "{unknown}");

    // on tour every axle rolls and none slides: a step moves it along the mean heading of its part, by kinematics
    // written out from the recorded numbers
    let axles = |c: &[f64]| {
        let behind = |[x, y]: [f64; 2], psi: f64| [x - TRAIN.draw_bar * cos(psi), y - TRAIN.draw_bar * sin(psi)];
        let first = behind([c[0], c[1]], c[3]);
        [([c[0], c[1]], c[2]), (first, c[3]), (behind(first, c[4]), c[4])]
    };
    let scene = obstacles(&Scene::lot());
    for pair in log.frames().windows(2) {
        let (a, b) = (&pair[0].robots[0], &pair[1].robots[0]);
        assert!(!b.in_contact);
        for ((p, th), (q, to)) in axles(&a.configuration).into_iter().zip(axles(&b.configuration)) {
            let (dx, dy, mid) = (q[0] - p[0], q[1] - p[1], th + 0.5 * short(th, to));
            let (ahead, aside) = (dx * cos(mid) + dy * sin(mid), dy * cos(mid) - dx * sin(mid));
            assert!(ahead > 0.03 && aside.abs() < 1e-4, "an axle slides: {ahead} ahead, {aside} aside");
        }
        let footprint = TRAIN.footprint(&TrainCfg::from_coordinates(&b.configuration).unwrap());
        assert!(footprint.parts().iter().all(|p| scene.iter().all(|o| plain::distance(p.placed(), o) > 0.0)));
    }
}

#[test]
fn the_bounds_of_a_robot_of_ones_own_hold() {
    use custom_robot::{TRAIN, TrainCfg};
    let mut s = Stream::new(Seed(4), "train");
    let holds = |footprint_at: &dyn Fn(f64) -> Footprint, rates: PartRates| {
        for i in 0..16 {
            let h = 1.0 / 16.0;
            let s0 = f64::from(i) * h;
            let at = [0.0, 0.5, 1.0].map(|k| footprint_at(s0 + k * h));
            for (part, bound) in rates.iter().enumerate() {
                for v in 0..4 {
                    let [p, mid, q] = [0, 1, 2].map(|k: usize| at[k].parts()[part].placed().core()[v]);
                    assert!((q - p).norm() <= bound.speed * h + 1e-12, "part {part} is faster than its bound");
                    let bow = (mid - (p + (q - p) * 0.5)).norm();
                    assert!(
                        bow <= 0.125 * bound.acceleration * h * h + 1e-12,
                        "part {part} strays farther than its bound"
                    );
                }
            }
        }
    };
    let (low, high) = (Point2::new(-5.0, -5.0), Point2::new(5.0, 5.0));
    for _ in 0..200 {
        let (a, b) = (TRAIN.sample(low, high, &mut s), TRAIN.sample(low, high, &mut s));
        let edge = TRAIN.edge(&a, &b).unwrap();
        holds(&|s| edge.footprint_at(s), TRAIN.edge_rates(&a, &b).unwrap());
        assert_eq!((edge.at(0.0), edge.at(1.0)), (a, b));
        // three turns on, reduced by the language's own remainder: the same edge but for rounding
        let far = TrainCfg { psi: a.psi.map(|psi| psi + 3.0 * TAU), ..a };
        let near = TrainCfg { psi: far.psi.map(|psi| short(0.0, psi)), ..a };
        assert_eq!(TRAIN.edge(&far, &b).unwrap().at(0.0), near);
        let u = CarCmd { v: s.uniform(-3.0, 3.0), phi: s.uniform(-0.7, 0.7) };
        let drive = TRAIN.drive(&a, &u, 0.2).unwrap();
        holds(&|s| drive.footprint_at(s), (0..3).map(|part| drive.rates(part)).collect());
        assert_eq!(drive.at(0.0), a);
    }
}

#[test]
fn systems_of_others_change_the_start_and_not_the_run() {
    assert_prints!("foreign_systems", foreign_systems::report().unwrap());
}
