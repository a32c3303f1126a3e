//! Queries about the lab's robots make no heap allocation, and neither does logging a tick.

use motion_lab_core::collision::{
    Certificate, Checker, Collision, Counted, MarchOptions, Problem, Scene, march, verify_certificate,
};
use motion_lab_core::prelude::*;

/// The number of heap allocations in `work`.
fn allocations(work: impl FnOnce()) -> u64 {
    allocation_counter::measure(work).count_total
}

fn check<R: Robot>(checker: &Checker<R>, a: R::Configuration, b: R::Configuration) {
    let mut certificate = Certificate::new();
    checker.edge_certified(&a, &b, &mut certificate).unwrap(); // lets the buffer grow once
    let counted = allocations(|| {
        let footprint = checker.robot().footprint(&a);
        std::hint::black_box(checker.scene().intersects(&footprint));
        std::hint::black_box(checker.scene().distance(&footprint));
        std::hint::black_box(checker.scene().witness(&footprint));
        std::hint::black_box(checker.scene().swept(&footprint, &checker.robot().footprint(&b)));
        std::hint::black_box(checker.edge(&a, &b).unwrap());
        std::hint::black_box(checker.edge_certified(&a, &b, &mut certificate).unwrap());
        std::hint::black_box(checker.is_free(&a) || checker.edge_free(&a, &b));
        std::hint::black_box((
            checker.distance(&a),
            checker.witness(&a).unwrap(),
            checker.clearance_gradient(&a).unwrap(),
        ));
        std::hint::black_box(checker.last_free(&a, &b).unwrap());
        let edge = checker.robot().edge(&a, &b).unwrap();
        std::hint::black_box(verify_certificate(checker.scene(), &edge, &certificate).unwrap());
        let through = Counted::new(checker.scene());
        std::hint::black_box(march(&through, &edge, MarchOptions::default(), None));
        assert!(through.counts().distance_of_hull > 0, "the march asks for distances of hulls");
    });
    assert_eq!(counted, 0, "{a} to {b}");
    if let Ok(mut problem) = Problem::try_new(checker.clone(), a, a, Seed(1)) {
        let counted = allocations(|| _ = std::hint::black_box((problem.sample(), problem.sample_free(9))));
        assert_eq!(counted, 0, "samples");
    }
}

/// Random edges take every branch of the march. Hulls of moving rectangles have up to eight corners.
#[test]
fn no_random_edge_of_the_three_robots_allocates() {
    fn random<R: Robot>(checker: &Checker<R>) {
        let mut draws = Stream::new(Seed(17), "allocation");
        let bounds = checker.scene().bounds();
        let mut draw = || checker.robot().sample(bounds.min, bounds.max, &mut draws);
        for _ in 0..300 {
            check(checker, draw(), draw());
        }
    }
    random(&Checker::new(Scene::apartment(), RustyDisc::default()));
    random(&Checker::new(Scene::workbench(), Reach::<2>::workbench()));
    random(&Checker::new(Scene::workbench(), Reach::<3>::redundant()));
    random(&Checker::new(Scene::lot(), HITCH));
    random(&Checker::new(Scene::lot(), HITCH.with_trailer()));
}

#[test]
fn footprints_queries_and_edges_of_the_three_robots_do_not_allocate() {
    assert!(allocations(|| drop(std::hint::black_box(Box::new(1)))) > 0, "the counter counts");
    let bounds = motion_lab_core::geometry::Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) };
    let corner = |x: f64, y: f64| Point2::new(x, y);
    let mut scene = Scene::empty(bounds);
    for k in 0..12 {
        let x = f64::from(k) - 6.0;
        scene = scene
            .with_obstacle(&format!("box {k}"), Shape::try_rectangle(corner(x, 3.0), corner(x + 0.5, 3.5)).unwrap())
            .with_obstacle(&format!("wall {k}"), Shape::try_segment(corner(x, -3.0), corner(x + 0.5, -2.0)).unwrap());
    }
    let scene = std::sync::Arc::new(scene);
    check(&Checker::new(scene.clone(), RustyDisc::default()), R2::new(0.0, 0.0), R2::new(5.0, 6.0));
    check(&Checker::new(scene.clone(), Reach::<2>::workbench()), T2::new(0.3, 0.2), T2::new(2.0, -1.0));
    check(&Checker::new(scene.clone(), Reach::<3>::redundant()), Tn([0.3, 0.2, 0.1]), Tn([2.0, -1.0, 1.0]));
    let pose = |x: f64, theta: f64| Pose2::new(x, 0.0, theta);
    let car = |x: f64, theta: f64| HitchCfg { body: pose(x, theta), trailer: None };
    check(&Checker::new(scene.clone(), HITCH), car(-4.0, 0.0), car(2.0, 0.7));
    let towing = |x: f64, theta: f64| HitchCfg { body: pose(x, theta), trailer: Some(theta - 0.2) };
    check(&Checker::new(scene, HITCH.with_trailer()), towing(-4.0, 0.0), towing(2.0, 0.7));
}

/// Asking for the numbers of a thing copies the thing, and not its world.
#[test]
fn the_numbers_of_a_thing_cost_nothing_of_the_rest_of_the_world() {
    use motion_lab_core::worlds::{Resident, World};
    use motion_lab_sim::atlas::Editor;

    let mut world = World::apartment();
    world.robots = (0..10_000).map(|i| Resident::new(format!("Rover {i}"), "rusty", [6.0, 4.0, 0.0])).collect();
    assert!(allocations(|| drop(std::hint::black_box(world.clone()))) > 10_000, "a name for each robot");
    let editor = Editor::new(world);
    let things = editor.things();
    for kind in ["wall", "obstacle", "door", "place", "mark", "robot"] {
        let (_, name) = things.iter().find(|(of, _)| *of == kind).unwrap();
        let counted = allocations(|| assert!(!std::hint::black_box(editor.numbers(name)).is_empty()));
        assert!(counted < 100, "{name}: {counted} allocations");
    }
}

/// A log's buffers are allocated in its first ticks.
#[test]
fn logging_a_tick_does_not_allocate() {
    use motion_lab_sim::recording::Run;
    use motion_lab_sim::run::{LogKind, LogWriter};
    use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

    let config = TourConfig { ticks: 40, ..TourConfig::default() };
    let log = Run::record(config, BOOK_SEED).unwrap();
    let mut writer = LogWriter::new(std::io::sink(), &log.recipe, LogKind::Frames, log.initial().unwrap()).unwrap();
    let (first, rest) = log.frames().split_at(5);
    first.iter().for_each(|frame| writer.tick(frame).unwrap());
    let counted = allocations(|| rest.iter().for_each(|frame| writer.tick(std::hint::black_box(frame)).unwrap()));
    assert_eq!(counted, 0, "of {} ticks", rest.len());
}

/// A tick in which no contact begins or ends allocates as much as the schedule alone, observed or not.
#[test]
fn contact_events_allocate_nothing_where_nothing_happens() {
    use bevy::prelude::{On, World};
    use motion_lab_sim::simulation::{ContactBegan, SimulationSchedule, headless_app, start_run, step};
    use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

    let counted = |observed: bool, tick: fn(&mut World)| {
        let mut app = headless_app();
        if observed {
            app.add_observer(|_: On<ContactBegan>| panic!("nothing is met in the first second"));
        }
        start_run(app.world_mut(), TourConfig::default(), BOOK_SEED).unwrap();
        (0..5).for_each(|_| tick(app.world_mut())); // systems and buffers are made
        allocations(|| (0..15).for_each(|_| tick(app.world_mut())))
    };
    let bare = counted(false, |world| world.run_schedule(SimulationSchedule));
    assert_eq!(counted(false, step), bare, "nobody listens");
    assert_eq!(counted(true, step), bare, "somebody listens");
}

/// What keyframes and a history say of their size is what the allocator counts, or a little more.
#[test]
fn the_memory_of_keyframes_and_of_a_history_is_counted_honestly() {
    use motion_lab_core::worlds::{Resident, World};
    use motion_lab_sim::simulation::{
        History, HistoryPlugin, Keyframes, headless_app, restore, snapshot, start_run, step,
    };
    use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

    let bounds = motion_lab_core::geometry::Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) };
    // robots alone in their worlds, of which some have a configuration of more than four numbers
    let world = |k: u32| {
        let (kind, start) = if k.is_multiple_of(3) { ("reach3", [0.1, 0.2, 0.3]) } else { ("rusty", [0.0; 3]) };
        let robots = vec![Resident::new(format!("robot {k}"), kind, start)];
        World { robots, ..World::empty(format!("world {k}"), bounds) }
    };
    let config = TourConfig { worlds: (0..150).map(world).collect(), ticks: 200, sensor: None };
    let mut app = headless_app();
    app.add_plugins(HistoryPlugin);
    start_run(app.world_mut(), config, BOOK_SEED).unwrap();
    app.world_mut().insert_resource(Keyframes::every(5));
    let start = snapshot(app.world());
    restore(app.world_mut(), &start).unwrap();
    (0..200).for_each(|_| step(app.world_mut()));

    fn counted<T: Clone>(kept: &T, said: usize) {
        let mut copy = None;
        let measured = allocation_counter::measure(|| copy = Some(kept.clone())).bytes_current as usize;
        drop(copy);
        assert!(measured > 100_000 && measured <= said, "{said} bytes are said, {measured} counted");
        assert!(said < measured + measured / 4, "{said} bytes are said, {measured} counted");
    }
    let keyframes = app.world().resource::<Keyframes>();
    counted(keyframes, keyframes.bytes());
    let history = app.world().resource::<History>();
    assert_eq!(history.samples(), 11, "one a second of more than a hundred robots");
    let arm = [0, 200].map(|tick| history.at(tick, 0).unwrap());
    assert!(
        arm[0].coordinates != arm[1].coordinates && arm[1].travelled == 0.0,
        "an arm of three joints drives no way"
    );
    counted(history, history.bytes());
}
