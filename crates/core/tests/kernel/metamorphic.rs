//! Answers that stay the same, or change along, when the whole plane is shifted, turned, mirrored, scaled or
//! renumbered.

use motion_lab_core::collision::{Collision, Witness};
use motion_lab_core::geometry::Point2;
use motion_lab_core::random::{Seed, Stream};

use oracle::fixtures::{Body, KINDS, LatticeShape, footprint_of, lattice_shape, random_body, random_kind, scene_of};

const UNIT: f64 = 1.0 / 16.0;

/// A robot of two lattice shapes, and four obstacles about it.
fn lattice_case(s: &mut Stream) -> (Vec<LatticeShape>, Vec<LatticeShape>) {
    let mut some = |n: u64, spread: u64| -> Vec<LatticeShape> {
        let offset = |s: &mut Stream| s.below(2 * spread + 1) as i32 - spread as i32;
        (0..n)
            .map(|_| {
                let kind = random_kind(s);
                lattice_shape(s, kind, 5).shifted([offset(s), offset(s)])
            })
            .collect()
    };
    (some(2, 4), some(4, 24))
}

struct Answers {
    distance: f64,
    witness: Witness,
    swept: bool,
}

fn ask(robot: &[LatticeShape], moved: &[LatticeShape], obstacles: &[LatticeShape], unit: f64) -> Answers {
    let bodies = |shapes: &[LatticeShape]| -> Vec<Body> { shapes.iter().map(|l| l.body(unit)).collect() };
    let scene = scene_of(&bodies(obstacles));
    let (a, b) = (footprint_of(&bodies(robot)), footprint_of(&bodies(moved)));
    let (distance, witness) = (scene.distance(&a), scene.witness(&a).unwrap());
    assert_eq!(scene.intersects(&a), distance == 0.0);
    Answers { distance, witness, swept: scene.swept(&a, &b) }
}

/// Compares the answers about a case and its image under `map`, also for a sweep by whole steps.
fn compare(name: &str, map: impl Fn([i32; 2]) -> [i32; 2], image: impl Fn(Point2) -> Point2, unit: f64, factor: f64) {
    let mut s = Stream::new(Seed(61), name);
    let (mut contacts, mut swept) = (0, 0);
    for _ in 0..1500 {
        let (robot, obstacles) = lattice_case(&mut s);
        let step = [s.below(31) as i32 - 15, s.below(31) as i32 - 15];
        let moved: Vec<_> = robot.iter().map(|l| l.shifted(step)).collect();
        let mapped = |shapes: &[LatticeShape]| -> Vec<_> { shapes.iter().map(|l| l.map(&map)).collect() };
        let before = ask(&robot, &moved, &obstacles, UNIT);
        let after = ask(&mapped(&robot), &mapped(&moved), &mapped(&obstacles), unit);
        let at = format!("{name}: {robot:?} {obstacles:?}");
        assert_eq!(before.distance == 0.0, after.distance == 0.0, "{at}");
        assert!((factor * before.distance - after.distance).abs() < 1e-13, "{at}");
        assert_eq!(before.swept, after.swept, "by {step:?}: {at}");
        // A tie may go to other shapes only where rounding broke it. A witness may differ only where several pairs
        // attain the distance, so the image of the old one must attain it too.
        let (w, v) = (before.witness, after.witness);
        let apart = (image(w.on_robot) - image(w.on_obstacle)).norm();
        assert!((apart - v.dist).abs() < 1e-13, "{at}");
        contacts += u32::from(before.distance == 0.0);
        swept += u32::from(before.swept);
    }
    assert!((300..1200).contains(&contacts) && (300..1200).contains(&swept), "one-sided: {contacts} {swept}");
}

#[test]
fn shifting_the_plane_by_whole_steps_changes_nothing() {
    compare("shift", |[x, y]| [x + 96, y - 37], |p| Point2::new(p.x + 6.0, p.y - 37.0 * UNIT), UNIT, 1.0);
}

#[test]
fn turning_the_plane_by_a_quarter_changes_nothing() {
    compare("quarter turn", |[x, y]| [-y, x], |p| Point2::new(-p.y, p.x), UNIT, 1.0);
}

#[test]
fn mirroring_the_plane_changes_nothing() {
    compare("mirror", |[x, y]| [-x, y], |p| Point2::new(-p.x, p.y), UNIT, 1.0);
}

#[test]
fn doubling_all_lengths_doubles_the_distances() {
    compare("scale", |p| p, |p| p * 2.0, 2.0 * UNIT, 2.0);
}

#[test]
fn doubling_all_lengths_doubles_the_distances_to_the_last_bit() {
    // a power of two rounds nothing, so even the bits must agree, whatever the shapes
    let mut s = Stream::new(Seed(62), "tests/scale bits");
    for i in 0..2000_usize {
        let (p, q) = (lattice_shape(&mut s, KINDS[i % 5], 20), lattice_shape(&mut s, KINDS[i / 5 % 5], 20));
        let at = |unit: f64| scene_of(&[q.body(unit)]).witness(&footprint_of(&[p.body(unit)])).unwrap();
        let (small, large) = (at(0.5), at(1.0));
        assert_eq!(2.0 * small.dist, large.dist, "{p:?} {q:?}");
        assert_eq!((small.on_robot * 2.0, small.on_obstacle * 2.0), (large.on_robot, large.on_obstacle), "{p:?} {q:?}");
    }
}

#[test]
fn renumbering_the_obstacles_changes_only_their_numbers() {
    let mut s = Stream::new(Seed(63), "tests/permutation");
    for _ in 0..1000 {
        let obstacles: Vec<Body> =
            (0..2 + s.below(20)).map(|k| random_body(&mut s, KINDS[k as usize % 5], 12.0)).collect();
        let kind = random_kind(&mut s);
        let robot = [random_body(&mut s, kind, 12.0)];
        let target = [(random_body(&mut s, KINDS[0], 12.0).0, robot[0].1.clone())];
        let mut order: Vec<usize> = (0..obstacles.len()).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, s.below(i as u64 + 1) as usize);
        }
        let shuffled: Vec<Body> = order.iter().map(|&i| obstacles[i].clone()).collect();
        let (scene, other) = (scene_of(&obstacles), scene_of(&shuffled));
        let (a, b) = (footprint_of(&robot), footprint_of(&target));
        assert_eq!(scene.distance(&a), other.distance(&a));
        assert_eq!(scene.swept(&a, &b), other.swept(&a, &b));
        assert_eq!(scene.depth(&a), other.depth(&a));
        let (w, v) = (scene.witness(&a).unwrap(), other.witness(&a).unwrap());
        assert_eq!(w.dist, v.dist);
        if w.dist > 0.0 {
            assert_eq!(w.obstacle.0 as usize, order[v.obstacle.0 as usize]);
            assert_eq!((w.on_robot, w.on_obstacle), (v.on_robot, v.on_obstacle));
        }
    }
}

#[test]
fn ties_go_to_the_lowest_part_and_then_to_the_first_obstacle() {
    // four walls around two discs at the centre: everything is equally far
    let wall = |points: [[i32; 2]; 2]| LatticeShape { kind: KINDS[1], points: points.to_vec(), radius: 0 }.body(1.0);
    let walls =
        [wall([[-4, 4], [4, 4]]), wall([[4, -4], [4, 4]]), wall([[-4, -4], [4, -4]]), wall([[-4, -4], [-4, 4]])];
    let disc = LatticeShape { kind: KINDS[0], points: vec![[0, 0]], radius: 1 }.body(1.0);
    let robot = footprint_of(&[disc.clone(), disc]);
    for first in 0..4 {
        let mut turned = walls.clone();
        turned.rotate_left(first);
        let w = scene_of(&turned).witness(&robot).unwrap();
        assert_eq!((w.dist, w.part, w.obstacle.0), (3.0, 0, 0));
    }
    // in contact with the last part and apart with the first: contact wins
    let far = LatticeShape { kind: KINDS[0], points: vec![[4, 0]], radius: 1 }.body(1.0);
    let near = LatticeShape { kind: KINDS[0], points: vec![[0, 0]], radius: 1 }.body(1.0);
    let w = scene_of(&walls).witness(&footprint_of(&[near, far])).unwrap();
    assert_eq!((w.dist, w.part, w.obstacle.0), (0.0, 1, 1));
}
