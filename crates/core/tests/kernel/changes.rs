//! A scene that is changed obstacle by obstacle answers as one that is made of the same obstacles, bit for bit.

use std::collections::BTreeSet;
use std::sync::Arc;

use allocation_counter::measure;
use motion_lab_core::collision::{Certificate, Checker, MarchOptions, ObstacleId, march};
use motion_lab_core::geometry::{Aabb, ConvexPolygon};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};

use oracle::fixtures::footprint_of;

/// The side of the square in which everything happens, metres.
const SIDE: f64 = 30.0;

fn bounds() -> Aabb {
    Aabb { min: Point2::origin(), max: Point2::new(SIDE, SIDE) }
}

/// A place, every other one on a lattice, so that distances tie.
fn place(draws: &mut Stream) -> Pose2 {
    match draws.below(2) {
        0 => Pose2::new(draws.below(30) as f64, draws.below(30) as f64, 0.0),
        _ => Pose2::new(draws.uniform(0.0, SIDE), draws.uniform(0.0, SIDE), draws.uniform(-3.0, 3.0)),
    }
}

/// A wall, a box, a disc, a rounded wall or a triangle.
fn shape(draws: &mut Stream) -> Shape {
    let (a, b) = (Point2::new(-0.25, -0.25), Point2::new(0.25, 0.25));
    match draws.below(5) {
        0 => Shape::Segment { a, b },
        1 => Shape::try_rectangle(a, b).unwrap(),
        2 => Shape::Disc { radius: 0.25 },
        3 => Shape::Capsule { a, b, radius: 0.125 },
        _ => Shape::Polygon(ConvexPolygon::try_new(&[a, Point2::new(0.25, -0.25), b]).unwrap()),
    }
}

/// An obstacle of none to three pieces; its pieces may be alike.
fn obstacle(number: usize, draws: &mut Stream) -> Obstacle {
    let pieces = (0..[0, 1, 1, 1, 2, 3][draws.below(6) as usize]).map(|_| (place(draws), shape(draws))).collect();
    Obstacle::new(format!("obstacle {number}"), ObstacleKind::Solid, pieces)
}

/// What a scene is asked.
struct Questions {
    footprints: Vec<Footprint>,
    poses: Vec<Pose2>,
}

/// How often which answer was met.
#[derive(Default)]
struct Met {
    answers: usize,
    contacts: usize,
    free: usize,
    ties: usize,
    edges_free: usize,
    edges_hit: usize,
    seen: usize,
}

impl Questions {
    fn draw(draws: &mut Stream) -> Self {
        let footprint = |draws: &mut Stream| {
            footprint_of(&(0..1 + draws.below(2)).map(|_| (place(draws), shape(draws))).collect::<Vec<_>>())
        };
        Questions {
            footprints: (0..4).map(|_| footprint(draws)).collect(),
            poses: (0..4).map(|_| place(draws)).collect(),
        }
    }

    /// All answers of a scene, written so that every bit shows.
    fn answers(&self, scene: &Arc<Scene>, met: &mut Met) -> Vec<String> {
        let mut all = vec![format!("{scene:?} {:?}", scene.pieces().collect::<Vec<_>>())];
        for (footprint, next) in self.footprints.iter().zip(self.footprints.iter().cycle().skip(1)) {
            let (intersects, ties) = (scene.intersects(footprint), scene.witnesses(footprint, 1e-9));
            met.contacts += usize::from(intersects);
            met.free += usize::from(!intersects);
            met.ties += usize::from(ties.len() > 1);
            let (from, to) = (footprint.parts()[0].placed(), next.parts()[0].placed());
            all.push(format!("{intersects} {:?} {:?}", scene.distance(footprint), scene.witness(footprint)));
            all.push(format!("{:?} {:?} {ties:?}", scene.touched(footprint), scene.deepest(footprint)));
            all.push(format!("{:?} {:?}", scene.clears(from, from, 0.3), scene.clears(from, to, 0.0)));
            all.push(format!("{:?}", scene.distance_of_hull_within(from.hull_with(to), 1.0)));
            let same = footprint.parts().len() == next.parts().len();
            all.push(format!("{:?}", same.then(|| scene.swept(footprint, next))));
        }
        for (pose, other) in self.poses.iter().zip(self.poses.iter().cycle().skip(1)) {
            let (p, q) = (pose.position(), other.position());
            let near = Pose2::new(p.x + 0.8, p.y + 0.3, pose.theta + 0.4);
            let disc = Checker::new(Arc::clone(scene), RustyDisc { radius: 0.11 });
            let far = edge(&disc, &R2::new(p.x, p.y), &R2::new(q.x, q.y), met);
            all.extend([far, edge(&disc, &R2::new(p.x, p.y), &R2::new(near.x, near.y), met)]);
            let arm = Checker::new(Arc::clone(scene), Reach { base: p, lengths: [0.5, 0.4], link_radius: 0.04 });
            all.push(edge(&arm, &T2::new(pose.theta, 0.3), &T2::new(pose.theta + 0.9, -0.4), met));
            let car = Checker::new(Arc::clone(scene), HITCH);
            let at = |body: Pose2| HitchCfg { body, trailer: None };
            all.push(edge(&car, &at(*pose), &at(near), met));
            for (n_rays, max_range) in [(36, 4.0), (200, 40.0)] {
                let ranges = RangeSensor { n_rays, max_range }.scan_from(scene, &[], pose);
                met.seen += ranges.iter().filter(|range| range.is_finite() && **range > 0.0).count();
                all.push(format!("{ranges:?}"));
            }
        }
        met.answers += all.len();
        all
    }
}

/// The verdicts on an edge, with their certificate.
fn edge<R: Robot>(checker: &Checker<R>, a: &R::Configuration, b: &R::Configuration, met: &mut Met) -> String {
    let mut certificate = Certificate::new();
    let (verdict, is_free) = (checker.edge_certified(a, b, &mut certificate), checker.edge_free(a, b));
    if is_free {
        met.edges_free += 1
    } else {
        met.edges_hit += 1
    }
    let motion = checker.robot().edge(a, b).unwrap();
    let marched = march(checker.scene(), &motion, MarchOptions { margin: 0.02, budget: 64 }, None);
    format!("{verdict:?} {:?} {is_free} {:?} {marched:?}", checker.edge(a, b), certificate.steps())
}

/// Makes `changes` changes of a scene, and compares all answers after each `every` of them.
fn survey(name: &str, at_first: usize, changes: usize, every: usize, puts_in: f64) -> Met {
    let mut draws = Stream::new(Seed(47), name);
    let mut list: Vec<Obstacle> = (0..at_first).map(|k| obstacle(k, &mut draws)).collect();
    let mut scene = Arc::new(Scene::of_obstacles(bounds(), &list));
    let (mut met, mut sizes) = (Met::default(), BTreeSet::new());
    for change in 0..changes {
        let some = draws.below(list.len().max(1) as u64) as usize;
        let what = draws.uniform(0.0, 1.0);
        // nobody else has it, so it is changed in place
        let own = Arc::get_mut(&mut scene).unwrap();
        if what < puts_in || list.is_empty() {
            // mostly behind all others, as a run does
            let new = obstacle(at_first + change, &mut draws);
            if draws.below(4) == 0 {
                own.insert_obstacle(ObstacleId(some as u32), &new);
                list.insert(some, new);
            } else {
                own.insert_obstacle(ObstacleId(u32::MAX), &new);
                list.push(new);
            }
        } else {
            own.remove_obstacle(ObstacleId(some as u32));
            let mut obstacle = list.remove(some);
            if what < puts_in + 0.5 * (1.0 - puts_in) {
                // a move
                let by = place(&mut draws);
                obstacle.pieces.iter_mut().for_each(|(pose, _)| *pose = by.compose(pose));
                own.insert_obstacle(ObstacleId(some as u32), &obstacle);
                list.insert(some, obstacle);
            }
        }
        if change % every == 0 {
            let whole = Arc::new(Scene::of_obstacles(bounds(), &list));
            let (questions, mut again) = (Questions::draw(&mut draws), Met::default());
            let (found, expected) = (questions.answers(&scene, &mut met), questions.answers(&whole, &mut again));
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(found, expected, "after {change} changes of {name}");
            }
            sizes.insert(whole.pieces().count());
        }
    }
    println!("{name}: {} answers, {} to {} pieces", met.answers, sizes.first().unwrap(), sizes.last().unwrap());
    met
}

fn check(met: &Met, least: usize) {
    let Met { contacts, free, ties, edges_free, edges_hit, seen, .. } = *met;
    println!("{contacts} {free} {ties} {edges_free} {edges_hit} {seen}");
    assert!(
        [contacts, free, edges_free, edges_hit, seen / 100].into_iter().all(|count| count > least),
        "too little met"
    );
    assert!(ties > least / 20, "{ties} ties");
}

#[test]
fn a_scene_that_grows_answers_as_one_made_whole() {
    check(&survey("growth", 40, 900, 3, 0.9), 100);
}

#[test]
fn a_scene_whose_obstacles_come_and_go_and_move_answers_as_one_made_whole() {
    check(&survey("change", 300, 900, 3, 0.3), 100);
}

#[test]
fn a_scene_that_shrinks_to_nothing_answers_as_one_made_whole() {
    survey("shrinking", 200, 600, 3, 0.02);
}

/// Twins at the same place: a ray meets the one that is left.
#[test]
fn of_two_obstacles_alike_the_other_stays() {
    let mut draws = Stream::new(Seed(3), "twins");
    let mut list: Vec<Obstacle> = (0..200).map(|k| obstacle(k, &mut draws)).collect();
    let twin = |name: &str| {
        let disc = (Pose2::new(50.0, 50.0, 0.0), Shape::Disc { radius: 0.5 });
        let wall = Shape::Segment { a: Point2::new(52.0, 49.0), b: Point2::new(52.0, 51.0) };
        Obstacle::new(name, ObstacleKind::Solid, vec![disc, (Pose2::IDENTITY, wall)])
    };
    list.extend([twin("one"), twin("other")]);
    let mut scene = Scene::of_obstacles(bounds(), &list);
    let sensor = RangeSensor { n_rays: 4, max_range: 10.0 };
    let seen = |scene: &Scene| {
        let east = |y: f64| sensor.scan_from(scene, &[], &Pose2::new(49.0, y, 0.0))[0];
        (east(50.0), east(50.75))
    };
    assert_eq!(seen(&scene), (0.5, 3.0));
    scene.remove_obstacle(ObstacleId(201));
    assert_eq!(seen(&scene), (0.5, 3.0));
    scene.remove_obstacle(ObstacleId(200));
    assert_eq!(seen(&scene), (f64::INFINITY, f64::INFINITY));
    assert_eq!(scene.obstacle_count(), 200);
    scene.remove_obstacle(ObstacleId(200));
    assert_eq!(scene.obstacle_count(), 200, "there is none");
}

/// A small scene lists what can be seen from a place where many scans begin.
#[test]
fn what_an_obstacle_hid_is_seen_when_it_is_taken_out_and_what_comes_is_seen_too() {
    let wall = |name: &str, half: f64, y: f64| {
        let shape = Shape::Segment { a: Point2::new(-half, y), b: Point2::new(half, y) };
        Obstacle::new(name, ObstacleKind::Solid, vec![(Pose2::IDENTITY, shape)])
    };
    let far = |k: i32| wall("far", 1.0, if k == 0 { -20.0 } else { f64::from(50 + k) });
    let mut list: Vec<Obstacle> = (0..98).map(far).collect();
    list.extend([wall("in front", 5.0, 1.0), wall("hidden", 0.5, 2.0)]);
    let mut scene = Scene::of_obstacles(bounds(), &list);
    let north = |scene: &Scene| RangeSensor { n_rays: 4, max_range: 9.0 }.scan(scene, Point2::new(0.1, 0.0))[1];
    (0..100).for_each(|_| assert_eq!(north(&scene), 1.0));
    scene.insert_obstacle(ObstacleId(3), &wall("nearer", 0.5, 0.5));
    assert_eq!(north(&scene), 0.5);
    scene.remove_obstacle(ObstacleId(3));
    assert_eq!(north(&scene), 1.0);
    scene.remove_obstacle(ObstacleId(98));
    assert_eq!(scene.obstacle_name(ObstacleId(98)), Some("hidden"));
    (0..100).for_each(|_| assert_eq!(north(&scene), 2.0));
    scene.remove_obstacle(ObstacleId(98));
    assert_eq!(north(&scene), f64::INFINITY);
}

/// What is not valid is contact everywhere, as long as it is there.
#[test]
fn an_obstacle_that_is_not_valid_is_contact_until_it_is_taken_out() {
    let mut draws = Stream::new(Seed(4), "invalid");
    let mut scene = Scene::of_obstacles(bounds(), &(0..200).map(|k| obstacle(k, &mut draws)).collect::<Vec<_>>());
    let disc = |x: f64| vec![(Pose2::new(x, 90.0, 0.0), Shape::Disc { radius: 0.5 })];
    scene.insert_obstacle(ObstacleId(u32::MAX), &Obstacle::new("far", ObstacleKind::Solid, disc(90.0)));
    let robot = Footprint::disc(Point2::new(80.0, 80.0), 0.1);
    let distance = |scene: &Scene| (scene.distance(&robot), scene.witness(&robot).unwrap().obstacle);
    let before = distance(&scene);
    assert!((before.0 - (200.0_f64.sqrt() - 0.6)).abs() < 1e-12 && before.1 == ObstacleId(200), "{before:?}");
    let of = |radius: f64| vec![(Pose2::new(5.0, 5.0, 0.0), Shape::Disc { radius })];
    for pieces in [disc(f64::NAN), of(f64::NAN), of(-0.5), disc(1e70)] {
        scene.insert_obstacle(ObstacleId(7), &Obstacle::new("not valid", ObstacleKind::Solid, pieces));
        assert_eq!(distance(&scene), (0.0, ObstacleId(7)));
        scene.remove_obstacle(ObstacleId(7));
        assert_eq!(distance(&scene), before);
    }
}

/// Puts this many boxes into a scene of 100 one after another, moves each once and takes all out again. Returns the
/// bytes allocated meanwhile, first for the boxes put in, then for the rest.
fn allocated(count: u32) -> [u64; 2] {
    let box_at = |k: u32, y: f64| {
        let shape = Shape::try_rectangle(Point2::origin(), Point2::new(0.4, 0.4)).unwrap();
        let pose = Pose2::new(f64::from(k % 100), y + f64::from(k / 100), 0.0);
        Obstacle::new("box", ObstacleKind::Solid, vec![(pose, shape)])
    };
    let mut scene = Scene::of_obstacles(bounds(), &(0..100).map(|k| box_at(k, -9.0)).collect::<Vec<_>>());
    let put_in = measure(|| (0..count).for_each(|k| scene.insert_obstacle(ObstacleId(u32::MAX), &box_at(k, 0.0))));
    let rest = measure(|| {
        for k in 0..count {
            let id = ObstacleId(100 + k * 7919 % count);
            scene.remove_obstacle(id);
            scene.insert_obstacle(id, &box_at(k, 500.0));
        }
        (0..count).for_each(|k| scene.remove_obstacle(ObstacleId(100 + k * 7919 % (count - k))));
    });
    assert_eq!(scene.obstacle_count(), 100);
    [put_in, rest].map(|info| info.bytes_total)
}

/// The memory made anew is that of a scene's parts, and with ten times as many changes it would be a hundred times as
/// much if each of them made all parts anew: n log n is at most thirteen times as much.
#[test]
fn changes_one_after_another_do_not_make_the_scene_anew() {
    let (few, many) = (allocated(300), allocated(3000));
    for (few, many) in few.into_iter().zip(many) {
        println!("{few} and {many} bytes, {:.1} times", many as f64 / few as f64);
        assert!(many < 20 * few, "{few} and {many} bytes");
    }
}

/// How near a separation test still decides depends on the largest coordinate of the scene.
#[test]
fn the_largest_coordinate_is_that_of_what_is_there() {
    let post = |x: f64| {
        Obstacle::new("post", ObstacleKind::Solid, vec![(Pose2::new(x, 3.0, 0.0), Shape::Disc { radius: 0.25 })])
    };
    let mut list: Vec<Obstacle> = (0..100).map(|k| post(f64::from(k))).collect();
    let mut scene = Scene::of_obstacles(bounds(), &list);
    let part = Footprint::disc(Point2::new(7.0, 0.0), 0.5);
    let part = part.parts()[0].placed();
    // 2.25 m apart
    let clears = |scene: &Scene| -> Vec<bool> {
        (20..50).map(|k| scene.clears(part, part, 2.25 - 1.0 / (1_u64 << k) as f64)).collect()
    };
    let before = clears(&scene);
    scene.insert_obstacle(ObstacleId(50), &post(5e5));
    list.insert(50, post(5e5));
    let with_far = clears(&Scene::of_obstacles(bounds(), &list));
    assert_ne!(before, with_far);
    assert_eq!(clears(&scene), with_far);
    scene.remove_obstacle(ObstacleId(50));
    assert_eq!(clears(&scene), before);
}
