//! The export of a driven run for Rerun (`export --format rerun`): every cloud of points, read by protobuf's wire
//! format and the field numbers of Foxglove's schema, shows what the run's frames, the robots' dimensions and the
//! worlds say. tests/peers/check reads the file by Rerun's own package.

use std::sync::LazyLock;

use motion_lab::geometry::Point2;
use motion_lab::num::{cos, sin};
use motion_lab::picture::{Role, Theme};
use motion_lab::prelude::*;
use motion_lab::run::Log;

use crate::cli::exports::messages::Wire;
use crate::cli::exports::viewer::{NAMES, Topics, exported, off_axis};
use crate::cli::runs::columns::frames;

/// The driven run, and the messages of its export.
static EXPORTED: LazyLock<(Log, Topics)> = LazyLock::new(|| exported("rerun"));

const WORLDS: [&str; 3] = ["world/Apartment", "world/Workbench", "world/Lot"];

/// A role's colour in the dark, opaque.
fn colour(role: Role) -> [u8; 4] {
    let [r, g, b] = Theme::Dark.palette().colour(role).0;
    [r, g, b, 255]
}

/// The points of a cloud of a tick in a frame, with their colours.
#[track_caller]
fn points(message: &Wire, tick: u64, frame: &str) -> Vec<([f64; 2], [u8; 4])> {
    let time = message.message(1);
    assert_eq!(time.number(1) * 1_000_000_000 + time.number(2), tick * 50_000_000);
    assert_eq!((message.text(2), message.number(4)), (frame.to_owned(), 16));
    let pose = message.message(3);
    let [place, turn] = [1, 2].map(|field| [1, 2, 3].map(|axis| pose.message(field).double(axis)));
    assert_eq!((place, turn, pose.message(2).double(4)), ([0.0; 3], [0.0; 3], 1.0));
    let (uint8, float32) = (1, 7); // of Foxglove's numeric types
    let fields: Vec<(String, u64, u64)> =
        message.messages(5).iter().map(|field| (field.text(1), field.number(2), field.number(3))).collect();
    let expected = [
        ("x", 0, float32),
        ("y", 4, float32),
        ("z", 8, float32),
        ("red", 12, uint8),
        ("green", 13, uint8),
        ("blue", 14, uint8),
        ("alpha", 15, uint8),
    ];
    assert_eq!(fields, expected.map(|(name, offset, kind)| (name.to_owned(), offset, kind)));
    let point = |bytes: &[u8]| {
        let [x, y, z] = [0, 4, 8].map(|k| f32::from_le_bytes(bytes[k..k + 4].try_into().unwrap()));
        assert_eq!(z, 0.0);
        ([f64::from(x), f64::from(y)], bytes[12..].try_into().unwrap())
    };
    message.bytes(6).chunks(16).map(point).collect()
}

/// Whether two places are the same as single floats.
fn near(p: [f64; 2], q: [f64; 2]) -> bool {
    (p[0] - q[0]).abs() < 1e-5 && (p[1] - q[1]).abs() < 1e-5
}

#[test]
fn every_finite_range_is_a_point_where_its_ray_ends() {
    let (log, topics) = &*EXPORTED;
    assert_eq!(topics["/viewer/scan/Rusty"].len(), 321);
    let (mut hits, mut misses) = (0, 0);
    for (frame, (tick, cloud)) in frames(log).zip(&topics["/viewer/scan/Rusty"]) {
        assert_eq!(frame.tick, *tick);
        let q = &frame.robots[0].configuration;
        let ray = |(k, range): (usize, &f64)| {
            let bearing = q[2] + k as f64 / 8.0 * std::f64::consts::TAU;
            range.is_finite().then(|| [q[0] + range * cos(bearing), q[1] + range * sin(bearing)])
        };
        let expected: Vec<[f64; 2]> = frame.scans[0].ranges.iter().enumerate().filter_map(ray).collect();
        let found = points(cloud, *tick, "world/Apartment");
        assert_eq!(found.len(), expected.len(), "tick {tick}");
        let same = found.iter().zip(&expected).all(|((p, paint), q)| near(*p, *q) && *paint == colour(Role::Sensor));
        assert!(same, "tick {tick}: {found:?}, not {expected:?}");
        (hits, misses) = (hits + expected.len(), misses + 8 - expected.len());
    }
    assert!(hits > 1_000 && misses > 100, "{hits} hits, {misses} misses");
}

/// The distance of a point from the edge of a part, by the robots' dimensions.
fn off_edge(part: &str, [x, y]: [f64; 2]) -> f64 {
    let rectangle = |back: f64, front: f64, half: f64| {
        let (beside, ahead) = ((y.abs() - half).abs(), (x - back).abs());
        let sides = if x < back - 1e-5 || x > front + 1e-5 { f64::INFINITY } else { beside };
        let ends = if y.abs() > half + 1e-5 {
            f64::INFINITY
        } else if ahead < (x - front).abs() {
            ahead
        } else {
            (x - front).abs()
        };
        if sides < ends { sides } else { ends }
    };
    match part {
        "Rusty/0" => (off_axis([x, y], [0.0, 0.0]) - 0.11).abs(),
        "Hitch/0" => rectangle(-0.7, 3.2, 0.85),
        "Hitch/1" => rectangle(-2.8, -1.0, 0.75),
        _ => (off_axis([x, y], [0.0, 1.0]) - 0.03).abs(),
    }
}

#[test]
fn the_edges_of_parts_are_written_when_they_or_their_colour_change() {
    let (log, topics) = &*EXPORTED;
    let mut counted = [0; 2];
    for (part, id, longest) in
        [("Rusty/0", 0, 0.01), ("Reach/0", 1, 0.02), ("Reach/1", 1, 0.02), ("Hitch/0", 2, 0.1), ("Hitch/1", 2, 0.1)]
    {
        let mut messages = topics[&format!("/viewer/robots/{part}")].iter();
        let mut shown = None;
        for frame in frames(log) {
            let robot = &frame.robots[id];
            let there = part != "Hitch/1" || robot.configuration.len() == 4;
            let look = there.then_some(robot.flash > 0);
            if shown == Some(look) || shown.is_none() && !there {
                continue;
            }
            shown = Some(look);
            let (tick, cloud) = messages.next().unwrap();
            assert_eq!(*tick, frame.tick, "{part}");
            let (robot, k) = part.split_once('/').unwrap();
            let found = points(cloud, *tick, &format!("part/{k}/{robot}"));
            let paint = colour(if look == Some(true) { Role::Goal } else { Role::Robot });
            assert!(found.iter().all(|(_, found)| *found == paint), "{part} at tick {tick}");
            assert_eq!(found.is_empty(), !there, "{part} at tick {tick}");
            // chords of round sides stray by at most a four-hundredth of the radius
            let off = found.iter().map(|(p, _)| off_edge(part, *p)).fold(0.0, motion_lab::num::greater);
            assert!(off < 0.11 / 400.0, "{part}: {off} m off its edge");
            let gap = |a: [f64; 2], b: [f64; 2]| {
                motion_lab::num::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]))
            };
            assert!(found.windows(2).all(|pair| gap(pair[0].0, pair[1].0) < longest), "{part}: a gap");
            assert!(!there || near(found[0].0, found[found.len() - 1].0) && found.len() > 100, "{part} goes all round");
            counted[usize::from(there)] += 1;
        }
        assert!(messages.next().is_none(), "{part}: a message without a change");
    }
    assert!(counted[0] == 1 && counted[1] > 20, "{counted:?}");
}

#[test]
fn worlds_paths_and_contacts_are_written_once() {
    let (log, topics) = &*EXPORTED;
    for (world, frame) in log.recipe.config.worlds.iter().zip(WORLDS) {
        let [(0, cloud)] = &topics[&format!("/viewer/worlds/{}", world.name)][..] else { panic!("{frame}: once") };
        let found = points(cloud, 0, frame);
        let scene = Scene::of_world(world);
        let (mut walls, mut marks) = (0, 0);
        for ([x, y], paint) in &found {
            if *paint == colour(Role::Muted) {
                marks += 1;
                continue;
            }
            assert_eq!(*paint, colour(Role::Obstacle));
            let point = Footprint::disc(Point2::new(*x, *y), 0.0);
            assert!(scene.distance(&point) < 1e-3, "{frame}: a point at {x}, {y} where no obstacle is");
            walls += 1;
        }
        assert_eq!(marks > 0, !world.marks.is_empty(), "{frame}");
        assert!(walls > 100, "{frame}: {walls} points");
        // no stretch of a wall of five centimetres is without a point
        for (_, shape) in world.obstacles.iter().flat_map(|obstacle| &obstacle.pieces) {
            let Shape::Segment { a, b } = shape else { continue };
            for k in 0..=20 {
                let at = a + (b - a) * (f64::from(k) / 20.0);
                let close = found.iter().any(|(p, _)| (Point2::new(p[0], p[1]) - at).norm() < 0.0501);
                assert!(close, "{frame}: no point near {at}");
            }
        }
    }
    for (id, (name, frame)) in NAMES.iter().zip(WORLDS).enumerate() {
        let [path, contacts] = ["paths", "contacts"].map(|kind| {
            let [(0, cloud)] = &topics[&format!("/viewer/{kind}/{name}")][..] else { panic!("{kind} of {name}: once") };
            points(cloud, 0, frame)
        });
        let place = |q: &[f64]| match id {
            1 => [cos(q[0]) + cos(q[0] + q[1]), sin(q[0]) + sin(q[0] + q[1])],
            _ => [q[0], q[1]],
        };
        let places: Vec<[f64; 2]> = frames(log).map(|frame| place(&frame.robots[id].configuration)).collect();
        let of_path = path.iter().all(|(p, paint)| *paint == colour(Role::Path) && places.iter().any(|q| near(*p, *q)));
        assert!(of_path && path.len() > 50, "{name}: {} points", path.len());
        let close =
            |q: &[f64; 2]| path.iter().any(|(p, _)| (p[0] - q[0]).abs() < 0.0101 && (p[1] - q[1]).abs() < 0.0101);
        assert!(places.iter().all(close), "{name}: a place without a point of the path");
        let all: Vec<_> = frames(log).collect();
        let began = (1..all.len()).filter(|&k| all[k].robots[id].contacts > all[k - 1].robots[id].contacts);
        let began: Vec<[f64; 2]> = began.map(|k| places[k]).collect();
        let same = contacts.iter().zip(&began).all(|((p, paint), q)| near(*p, *q) && *paint == colour(Role::Goal));
        assert!(same && contacts.len() == began.len() && !began.is_empty(), "{name}: {contacts:?}, not {began:?}");
    }
}
