//! Rays whose readings are known to the last bit: through corners, along sides, on tangents, and to exactly the
//! greatest range.
//!
//! Every thing is met four metres off, at coordinates that are exact. The quarter turns and the mirrored plane are
//! exact too.

use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;

use oracle::seen::{Seen, world_of};

/// A small length, metres, that adds exactly to every coordinate here.
const HAIR: f64 = 1.0 / (1_u64 << 40) as f64;

/// A thing that a ray along x from the origin meets at x = 4.
struct Met {
    what: &'static str,
    thing: Seen,
    /// Whether the ray only grazes the thing, so that moved a hair to the left it is missed.
    grazed: bool,
}

fn met() -> Vec<Met> {
    let p = |&(x, y): &(f64, f64)| Point2::new(x, y);
    let points = |corners: &[(f64, f64)]| corners.iter().map(p).collect::<Vec<_>>();
    let wall = |a: (f64, f64), b: (f64, f64)| Seen::Wall(p(&a), p(&b));
    let outline = |corners: &[(f64, f64)]| Seen::Outline(points(corners));
    let round = |core: &[(f64, f64)], radius: f64| Seen::Round(points(core), radius);
    let m = |what, thing, grazed| Met { what, thing, grazed };
    vec![
        m("a wall across", wall((4.0, -1.0), (4.0, 2.0)), false),
        m("a wall's end", wall((4.0, 0.0), (4.0, 2.0)), true),
        m("the end of a wall that slants away", wall((4.0, 0.0), (7.0, 1.0)), true),
        m("a wall along the ray", wall((4.0, 0.0), (6.0, 0.0)), true),
        m("a wall along the ray, from behind", wall((6.0, 0.0), (4.0, 0.0)), true),
        m("a box's side", outline(&[(4.0, -1.0), (6.0, -1.0), (6.0, 1.0), (4.0, 1.0)]), false),
        m("along a box's side", outline(&[(4.0, 0.0), (6.0, 0.0), (6.0, 2.0), (4.0, 2.0)]), true),
        m("a corner head on", outline(&[(4.0, 0.0), (5.0, -1.0), (6.0, 0.0), (5.0, 1.0)]), false),
        m("past a corner", outline(&[(4.0, 0.0), (6.0, 1.0), (2.0, 1.0)]), true),
        m(
            "into a bay",
            outline(&[
                (2.0, -2.0),
                (5.0, -2.0),
                (5.0, 2.0),
                (2.0, 2.0),
                (2.0, 1.0),
                (4.0, 1.0),
                (4.0, -1.0),
                (2.0, -1.0),
            ]),
            false,
        ),
        m("a disc head on", round(&[(5.0, 0.0)], 1.0), false),
        m("a disc's tangent", round(&[(4.0, 0.25)], 0.25), true),
        m("a large disc's tangent", round(&[(4.0, 2.0)], 2.0), true),
        m("a capsule's side", round(&[(5.0, -1.0), (5.0, 1.0)], 1.0), false),
        m("a capsule's cap", round(&[(5.0, 0.0), (7.0, 0.0)], 1.0), false),
        m("along a capsule", round(&[(4.0, 0.5), (6.0, 0.5)], 0.5), true),
        m("a capsule's tangent cap", round(&[(4.0, 0.5), (4.0, 2.0)], 0.5), true),
        m("a rounded box's side", round(&[(5.0, -1.0), (7.0, -1.0), (7.0, 1.0), (5.0, 1.0)], 1.0), false),
        m("along a rounded polygon", round(&[(4.0, 0.5), (6.0, 0.5), (5.0, 2.0)], 0.5), true),
        m("a rounded polygon's tangent corner", round(&[(4.0, 0.5), (6.0, 2.0), (2.0, 2.0)], 0.5), true),
    ]
}

/// The eight symmetries of the lattice.
fn symmetries() -> [fn(Point2) -> Point2; 8] {
    [
        |p| p,
        |p| Point2::new(-p.y, p.x),
        |p| Point2::new(-p.x, -p.y),
        |p| Point2::new(p.y, -p.x),
        |p| Point2::new(p.x, -p.y),
        |p| Point2::new(p.y, p.x),
        |p| Point2::new(-p.x, p.y),
        |p| Point2::new(-p.y, -p.x),
    ]
}

/// The number of the ray along the image of the x axis.
fn ray_along(turn: fn(Point2) -> Point2, n_rays: u32) -> usize {
    let ahead = turn(Point2::new(1.0, 0.0));
    let quarters = match (ahead.x as i32, ahead.y as i32) {
        (1, 0) => 0,
        (0, 1) => 1,
        (-1, 0) => 2,
        _ => 3,
    };
    (quarters * n_rays / 4) as usize
}

/// The reading of the ray along the image of x, alone or, when `crowded`, with enough walls far behind that the scene
/// has a grid.
fn reading(thing: &Seen, turn: fn(Point2) -> Point2, sensor: RangeSensor, crowded: bool) -> f64 {
    let mut things = vec![thing.map(turn)];
    if crowded {
        things.extend((0..130).map(|i| {
            let x = 40.0 + f64::from(i);
            Seen::Wall(turn(Point2::new(x, -3.0)), turn(Point2::new(x, 5.0)))
        }));
    }
    let scene = Scene::of_world(&world_of(&things, false));
    sensor.scan(&scene, Point2::origin())[ray_along(turn, sensor.n_rays)]
}

#[test]
fn rays_are_closed_and_so_is_the_range_and_a_hair_beyond_is_beyond() {
    for Met { what, thing, grazed } in met() {
        for (i, turn) in symmetries().into_iter().enumerate() {
            let n_rays = [4, 8, 12, 360][i % 4];
            for crowded in [false, true] {
                let reads =
                    |thing: &Seen, max_range: f64| reading(thing, turn, RangeSensor { n_rays, max_range }, crowded);
                let at = format!("{what}, symmetry {i}, crowded: {crowded}");
                assert_eq!(reads(&thing, 9.0), 4.0, "{at}");
                assert_eq!(reads(&thing, 4.0), 4.0, "at exactly the greatest range: {at}");
                // four ulps allow for the rounding of inverses, so five are beyond the range
                let below = 4.0 - 5.0 * f64::EPSILON * 4.0;
                assert_eq!(reads(&thing, below), f64::INFINITY, "just beyond the range: {at}");
                let farther = thing.map(|p| p + Vector2::new(HAIR, 0.0));
                assert_eq!(reads(&farther, 4.0), f64::INFINITY, "a hair farther than the range: {at}");
                if grazed {
                    let aside = thing.map(|p| p + Vector2::new(0.0, HAIR));
                    assert_eq!(reads(&aside, 9.0), f64::INFINITY, "a hair aside: {at}");
                }
            }
        }
    }
}

#[test]
fn from_inside_and_from_the_edge_everything_reads_zero() {
    let sensor = RangeSensor { n_rays: 12, max_range: 9.0 };
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let triangle = [(-1.0, 0.0), (1.0, 0.0), (0.0, 1.5)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let p = Point2::new;
    // a thing, places in it, places on its edge, and a place a hair off it
    let cases = [
        (Seen::Wall(p(-1.0, 0.0), p(1.0, 0.0)), vec![], vec![p(0.5, 0.0), p(1.0, 0.0)], p(0.5, HAIR)),
        (
            Seen::Outline(square.clone()),
            vec![p(0.0, 0.0), p(0.9, -0.9)],
            vec![p(1.0, 0.25), p(1.0, 1.0)],
            p(1.0 + HAIR, 0.5),
        ),
        (
            Seen::Round(vec![p(0.0, 0.0)], 1.25),
            vec![p(0.0, 0.0), p(0.5, 0.5)],
            vec![p(0.75, 1.0), p(0.0, -1.25)],
            p(1.25 + HAIR, 0.0),
        ),
        (
            Seen::Round(square[..2].to_vec(), 0.25),
            vec![p(0.0, -0.875), p(1.125, -1.0)],
            vec![p(0.5, -0.75), p(1.25, -1.0)],
            p(0.5, -0.75 + HAIR),
        ),
        (
            Seen::Round(triangle, 0.25),
            vec![p(0.0, 0.5), p(0.0, -0.125)],
            vec![p(0.5, -0.25), p(0.0, 1.75)],
            p(0.5, -0.25 - HAIR),
        ),
    ];
    for (thing, inside, edge, off) in cases {
        let scene = Scene::of_world(&world_of(std::slice::from_ref(&thing), false));
        for place in inside.iter().chain(&edge) {
            assert_eq!(sensor.scan(&scene, *place), vec![0.0; 12], "{thing:?} from {place}");
        }
        let ranges = sensor.scan(&scene, off);
        assert!(ranges.iter().all(|r| *r > 0.0) && ranges.iter().any(|r| r.is_infinite()), "{thing:?}: {ranges:?}");
    }
}
