//! Random and lattice pairs: the library against both oracles, and its four answers against one another.

use motion_lab_core::collision::{Collision, Scene, distance, footprint_distance, touch};
use motion_lab_core::geometry::{Footprint, Placed, Point2, Pose2, Shape, largest_coordinate};
use motion_lab_core::num::ulp;
use motion_lab_core::random::{Seed, Stream};

use oracle::exact::{ExactPair, lies_on};
use oracle::fixtures::{
    Body, KINDS, count_from_env, footprint_of, lattice_shape, placed, random_body, random_kind, scene_of,
};
use oracle::plain;

/// Number of pairs. `MOTION_LAB_PAIRS` changes it.
fn pairs() -> u64 {
    count_from_env("MOTION_LAB_PAIRS", 100_000)
}

/// Checks the four answers for one part and one obstacle against one another. Returns the distance.
fn consistent(scene: &Scene, footprint: &Footprint, part: &Placed, piece: &Placed, m: f64) -> f64 {
    let at = || format!("{footprint:?} against {piece:?}");
    let dist = scene.distance(footprint);
    assert!(dist >= 0.0, "{dist}: {}", at());
    assert_eq!(scene.intersects(footprint), dist == 0.0, "intersects but {dist}: {}", at());
    // the pair by itself, asked about either way
    assert_eq!(distance(part, piece).to_bits(), dist.to_bits(), "{}", at());
    assert_eq!((touch(part, piece), touch(piece, part)), (dist == 0.0, dist == 0.0), "{}", at());
    assert_eq!(scene.swept(footprint, footprint), dist == 0.0, "swept on the spot but {dist}: {}", at());
    let w = scene.witness(footprint).expect("the scene is not empty");
    assert_eq!((w.dist, w.part, w.obstacle.0), (dist, 0, 0), "{}", at());
    let apart = (w.on_robot - w.on_obstacle).norm();
    assert!((apart - dist).abs() <= 16.0 * ulp(m), "witnesses {apart} apart, distance {dist}: {}", at());
    assert!(dist > 0.0 || w.on_robot == w.on_obstacle, "no common point {w:?}: {}", at());
    let (on_part, on_piece) = (plain::point_distance(w.on_robot, part), plain::point_distance(w.on_obstacle, piece));
    assert!(on_part <= 16.0 * ulp(m) && on_piece <= 16.0 * ulp(m), "{w:?} off by {on_part}, {on_piece}: {}", at());
    dist
}

/// Checks one pair against the `f64` oracle.
fn against_plain(scene: &Scene, footprint: &Footprint, body: &Body, obstacle: &Body) -> (Placed, Placed, f64) {
    let (part, piece) = (placed(body), placed(obstacle));
    let m = largest_coordinate([&part, &piece]);
    let dist = consistent(scene, footprint, &part, &piece, m);
    let plain = plain::distance(&part, &piece);
    assert!((plain - dist).abs() <= 32.0 * ulp(m), "{dist}, but {plain} by C6: {body:?} against {obstacle:?}");
    (part, piece, dist)
}

/// Checks a distance and the contact it implies against exact arithmetic.
fn against_exact(part: &Placed, piece: &Placed, dist: f64) -> bool {
    let m = largest_coordinate([part, piece]);
    let exact = ExactPair::new(part, piece);
    let at = || format!("{part:?} against {piece:?}");
    if exact.contact() {
        assert_eq!(dist, 0.0, "in contact, but {dist}: {}", at());
    } else if part.radius() + piece.radius() == 0.0 || exact.apart_by_more_than(8.0 * ulp(m)) {
        assert!(dist > 0.0, "apart, but in contact: {}", at());
    }
    assert!(exact.distance_is(dist, 16.0 * ulp(m)), "distance {dist} is off by more than 16 ulp({m}): {}", at());
    exact.contact()
}

#[test]
fn lattice_pairs_agree_with_both_oracles() {
    let mut s = Stream::new(Seed(21), "tests/lattice");
    let (mut contacts, mut apart) = (0, 0);
    for i in 0..pairs() * 6 / 10 {
        let (p, q) = (KINDS[i as usize % 5], KINDS[i as usize / 5 % 5]);
        // from crowded scenes, where everything touches, to roomy ones; from millimetres to many metres
        let range = [3, 6, 12, 40][i as usize / 25 % 4];
        let unit = [1.0 / 128.0, 0.25, 1.0, 32.0][i as usize / 100 % 4];
        let far = [[0, 0], [1000, -3000]][i as usize / 400 % 2];
        let body = lattice_shape(&mut s, p, range).shifted(far).body(unit);
        let obstacle = lattice_shape(&mut s, q, range).shifted(far).body(unit);
        let scene = scene_of(std::slice::from_ref(&obstacle));
        let footprint = footprint_of(std::slice::from_ref(&body));
        let (part, piece, dist) = against_plain(&scene, &footprint, &body, &obstacle);
        if against_exact(&part, &piece, dist) {
            contacts += 1;
        } else {
            apart += 1;
        }
    }
    assert!(contacts > apart / 4 && apart > contacts / 4, "one-sided: {contacts} contacts, {apart} apart");
}

#[test]
fn random_pairs_agree_with_both_oracles() {
    let mut s = Stream::new(Seed(22), "tests/random");
    let (mut contacts, mut apart) = (0, 0);
    for i in 0..pairs() * 4 / 10 {
        let (p, q) = (KINDS[i as usize % 5], KINDS[i as usize / 5 % 5]);
        let range = [0.7, 2.0, 5.0][i as usize / 25 % 3];
        let (body, obstacle) = (random_body(&mut s, p, range), random_body(&mut s, q, range));
        let scene = scene_of(std::slice::from_ref(&obstacle));
        let footprint = footprint_of(std::slice::from_ref(&body));
        let (part, piece, dist) = against_plain(&scene, &footprint, &body, &obstacle);
        if i % 8 == 0 {
            against_exact(&part, &piece, dist);
        }
        if dist == 0.0 {
            contacts += 1;
        } else {
            apart += 1;
        }
    }
    assert!(contacts > apart / 4 && apart > contacts / 4, "one-sided: {contacts} contacts, {apart} apart");
}

#[test]
fn random_pairs_moved_to_almost_touch_are_decided_to_the_last_ulps() {
    // bodies are moved along their witness to within a rounding error of contact, where only exact arithmetic can
    // decide
    let mut s = Stream::new(Seed(23), "tests/almost");
    for i in 0..pairs() / 20 {
        let (p, q) = (KINDS[i as usize % 5], KINDS[i as usize / 5 % 5]);
        let (body, obstacle) = (random_body(&mut s, p, 2.0), random_body(&mut s, q, 2.0));
        let near = plain::nearest(&placed(&body), &placed(&obstacle));
        if near.dist == 0.0 {
            continue;
        }
        let step = (near.on_b - near.on_a) * (1.0 + (s.unit() - 0.5) * 8.0 * f64::EPSILON / near.dist);
        let mut moved = body.clone();
        (moved.0.x, moved.0.y) = (body.0.x + step.x, body.0.y + step.y);
        let scene = scene_of(std::slice::from_ref(&obstacle));
        let footprint = footprint_of(std::slice::from_ref(&moved));
        let (part, piece, dist) = against_plain(&scene, &footprint, &moved, &obstacle);
        assert!(dist < 1e-13, "the slide failed");
        against_exact(&part, &piece, dist);
        let w = scene.witness(&footprint).unwrap();
        let tolerance = 16.0 * ulp(largest_coordinate([&part, &piece]));
        assert!(lies_on(w.on_robot, &part, tolerance) && lies_on(w.on_obstacle, &piece, tolerance), "{w:?}");
    }
}

#[test]
fn a_crowd_of_obstacles_answers_with_its_nearest_one() {
    let mut s = Stream::new(Seed(24), "tests/crowd");
    for _ in 0..pairs() / 100 {
        let obstacles: Vec<Body> = (0..1 + s.below(40))
            .map(|k| {
                let mut body = random_body(&mut s, KINDS[k as usize % 5], 20.0);
                if let Shape::Disc { radius } = &mut body.1 {
                    *radius *= 0.5;
                }
                body
            })
            .collect();
        let bodies: Vec<Body> = (0..1 + s.below(4))
            .map(|_| {
                let kind = random_kind(&mut s);
                random_body(&mut s, kind, 20.0)
            })
            .collect();
        let (scene, footprint) = (scene_of(&obstacles), footprint_of(&bodies));
        let mut least = (f64::INFINITY, 0, 0);
        let mut m = 1.0;
        for (k, part) in bodies.iter().map(placed).enumerate() {
            for (o, piece) in obstacles.iter().map(placed).enumerate() {
                let size = largest_coordinate([&part, &piece]);
                m = if size > m { size } else { m };
                let dist = plain::distance(&part, &piece);
                if dist < least.0 {
                    least = (dist, k, o as u32);
                }
            }
        }
        let w = scene.witness(&footprint).unwrap();
        assert_eq!(w.dist, scene.distance(&footprint));
        let crowd = footprint_of(&obstacles);
        assert_eq!(footprint_distance(&footprint, &crowd), w.dist, "the same shapes as the parts of another footprint");
        assert_eq!(w.dist == 0.0, scene.intersects(&footprint));
        assert!((w.dist - least.0).abs() <= 32.0 * ulp(m), "{w:?} but C6 has {least:?}");
        // Contacts tie at 0 and go to the lowest part, then to the first obstacle, as in the plain search. Apart, no
        // two random distances are this near.
        assert_eq!((w.part, w.obstacle.0), (least.1, least.2), "{w:?} but C6 has {least:?}");
    }
}

#[test]
fn a_shape_that_is_not_valid_is_in_contact_with_everything_and_nothing_is_far_from_everything() {
    let disc = |x: f64| Shape::Disc { radius: 0.5 }.place(&Pose2::new(x, 0.0, 0.0));
    for odd in [f64::NAN, f64::INFINITY] {
        assert!(touch(&disc(odd), &disc(9.0)) && touch(&disc(9.0), &disc(odd)));
        assert_eq!((distance(&disc(odd), &disc(9.0)), distance(&disc(9.0), &disc(odd))), (0.0, 0.0));
    }
    let at = |x: f64| Footprint::disc(Point2::new(x, 0.0), 0.5);
    assert_eq!(footprint_distance(&at(0.0), &at(3.0)), 2.0);
    assert_eq!((footprint_distance(&at(f64::NAN), &at(3.0)), footprint_distance(&at(3.0), &at(f64::NAN))), (0.0, 0.0));
    assert_eq!(footprint_distance(&Footprint::default(), &at(3.0)), f64::INFINITY);
}
