//! Grazing rays: parry's miss walls that the exact scan meets, and who drives as far as a ray goes meets them too.

use motion_lab_core::collision::{Collision, ParryScene};
use motion_lab_core::geometry::{Footprint, Vector2};
use motion_lab_core::num::{atan2, greater, hypot};
use motion_lab_core::picture::{Drawing, Figure, Item, Line, Panel, Picture, Role, footprint};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;

use super::figures::{check_figure, frame, walls};

/// Two walls that share a corner, seen from the origin: whatever goes there is met by one of them or the other.
fn corner(at: Point2) -> Scene {
    let [left, right] = [1.0, -1.0].map(|y| Point2::new(at.x - 0.2, at.y + y));
    Scene::of_walls(&[Segment::new(left, at), Segment::new(at, right)])
}

fn unit(v: Vector2) -> Vector2 {
    v / hypot(v.x, v.y)
}

/// The places of the corners that are asked about: those of a lattice of decimetres.
fn corners() -> impl Iterator<Item = Point2> {
    (5..25).flat_map(|i| (-8..9).map(move |j| Point2::new(f64::from(i) / 10.0, f64::from(j) / 10.0)))
}

#[test]
fn rays_slip_between_two_walls_that_share_a_corner() {
    let (mut slipped, mut asked) = (0, 0);
    for at in corners() {
        let (scene, direction) = (corner(at), unit(at - Point2::origin()));
        let range = ParryScene::of_scene(&scene).range(Point2::origin(), direction, 9.0);
        let pose = Pose2::new(0.0, 0.0, atan2(direction.y, direction.x));
        let exact = RangeSensor { n_rays: 1, max_range: 9.0 }.scan_from(&scene, &[], &pose)[0];
        assert!((exact - hypot(at.x, at.y)).abs() < 1e-12, "the exact ray meets the corner at {at}: {exact}");
        asked += 1;
        if range == f64::INFINITY {
            slipped += 1;
        } else {
            assert!((range - hypot(at.x, at.y)).abs() < 1e-9, "{at}: {range}");
        }
    }
    assert_eq!(asked, 340);
    assert!(slipped > 20, "{slipped} of {asked}");
}

/// A ray that falls by 2 nm in 4 m from 1 nm above a wall's line meets the wall in its middle, 2 m away.
#[test]
fn a_ray_that_falls_by_a_nanometre_over_a_wall_misses_it() {
    let scene = Scene::of_walls(&[Segment::new(Point2::new(1.0, 0.0), Point2::new(3.0, 0.0))]);
    let black_box = ParryScene::of_scene(&scene);
    let range = |height: f64| black_box.range(Point2::new(0.0, height), unit(Vector2::new(2.0, -height)), 9.0);
    assert!((range(1e-6) - 2.0).abs() < 0.01, "{}", range(1e-6));
    assert_eq!(range(1e-9), f64::INFINITY);
    let pose = Pose2::new(0.0, 1e-9, -0.5e-9);
    let exact = RangeSensor { n_rays: 1, max_range: 9.0 }.scan_from(&scene, &[], &pose)[0];
    assert!((exact - 2.0).abs() < 1e-6, "{exact}");
}

#[test]
fn who_drives_as_far_as_such_a_ray_goes_drives_through_the_corner() {
    let slips = |at: &Point2| {
        let range = ParryScene::of_scene(&corner(*at)).range(Point2::origin(), unit(*at - Point2::origin()), 3.0);
        range == f64::INFINITY
    };
    let at = corners().filter(|at| at.x > 1.5 && at.y > 0.3).find(slips).unwrap();
    let (scene, direction) = (corner(at), unit(at - Point2::origin()));
    let [from, to] = [Point2::origin(), Point2::origin() + direction * 3.0].map(|at| Footprint::disc(at, 0.11));
    assert!(!scene.intersects(&from) && !scene.intersects(&to));
    assert!(scene.swept(&from, &to), "the exact sweep meets the corner");
    assert!(ParryScene::of_scene(&scene).swept(&from, &to), "and so does parry's cast of a disc");
    figure(&scene, at, direction);
}

/// Capsules are where parry's distances are worst: its iteration ends some 1e-7 m early.
#[test]
fn distances_of_capsules_are_off_by_a_tenth_of_a_micrometre() {
    let mut s = Stream::new(Seed(45), "tests/capsules");
    let (mut capsules, mut discs) = (0.0, 0.0);
    for _ in 0..3000 {
        let mut point = || Point2::new(s.uniform(-2.0, 2.0), s.uniform(-2.0, 2.0));
        let scene = Scene::of_walls(&[Segment::new(point(), point())]);
        let black_box = ParryScene::of_scene(&scene);
        let link = Footprint::capsules([Segment::new(point(), point())], 0.1);
        let off = |footprint: &Footprint| (black_box.distance(footprint) - scene.distance(footprint)).abs();
        capsules = greater(capsules, off(&link));
        discs = greater(discs, off(&Footprint::disc(point(), 0.1)));
    }
    assert!((1e-8..1e-6).contains(&capsules), "{capsules}");
    assert!(discs < 1e-14, "{discs}");
}

fn figure(scene: &Scene, at: Point2, direction: Vector2) {
    let [from, end] = [Point2::origin(), Point2::origin() + direction * 3.0];
    let ray = Item::new("ray", "the ray by parry", Role::Sensor, Drawing::Rays { from, ends: vec![end] });
    let picture = Picture::new("a ray slips through a corner", frame([-0.3, -0.6], [3.0, 2.2]))
        .with(walls(scene))
        .with([ray.stroked(Line::solid(1.5))])
        .with(footprint("from", "the start", &Footprint::disc(from, 0.11), Role::Robot, 0.5))
        .with(footprint("to", "where it would drive", &Footprint::disc(end, 0.11), Role::Path, 0.2))
        .with(footprint("contact", "in the corner", &Footprint::disc(at, 0.11), Role::Goal, 0.4));
    check_figure(
        "grazing",
        &Figure {
            title: "A ray through a corner".to_owned(),
            description: "Parry's ray goes on between two walls that share a corner. Red: the rover in the corner."
                .to_owned(),
            panels: vec![Panel { picture, heading: "open by parry's ray".to_owned(), readout: vec![] }],
            caption: vec![],
        },
    );
}
