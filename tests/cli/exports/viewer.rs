//! The export of a driven run for viewers (`export --format foxglove`). Every value of every message, read by
//! protobuf's wire format and the field numbers of Foxglove's schema, agrees with the run's frames, the robots'
//! dimensions and the worlds as written.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};
use std::fs;
use std::sync::LazyLock;

use motion_lab::num::{cos, sin};
use motion_lab::picture::{Role, Theme};
use motion_lab::prelude::*;
use motion_lab::run::{Frame, Log};
use motion_lab::worlds::SourceShape;

use crate::cli::exports::messages::{Wire, messages};
use crate::cli::run;
use crate::cli::runs::columns::{driven, frames, write};

pub type Topics = BTreeMap<String, Vec<(u64, Wire)>>;

pub const NAMES: [&str; 3] = ["Rusty", "Reach", "Hitch"];

/// The driven run, with the trailer taken off and a rover given back to its tour near the end, and the messages of its
/// export.
static EXPORTED: LazyLock<(Log, Topics)> = LazyLock::new(|| exported("foxglove"));

/// That run, and its messages in one of the forms for viewers.
pub fn exported(form: &str) -> (Log, Topics) {
    let folder = tempfile::tempdir().unwrap();
    let (_, mut log) = driven(folder.path());
    // the export shows the frames
    for frame in &mut log.frames_mut()[309..] {
        let q = &mut frame.robots[2].configuration;
        *q = q[..3].iter().copied().collect();
        frame.robots[0].manual = false;
    }
    let (file, viewer) = (write(folder.path(), &log), folder.path().join("viewer.mcap"));
    run(&["export", file.to_str().unwrap(), "--format", form, "-o", viewer.to_str().unwrap()]).done();
    let topics = messages(&fs::read(viewer).unwrap());
    (log, topics)
}

/// A coordinate frame in its parent: position and heading.
type Place = ([f64; 2], f64);

/// The coordinate frames of the robots and of their parts, by the kinematics written out.
fn expected_frames(frame: &Frame) -> Vec<(String, &'static str, Place)> {
    let [rusty, reach, hitch] = [0, 1, 2].map(|id| &frame.robots[id].configuration);
    let (turned, elbow) = (reach[0] + reach[1], [cos(reach[0]), sin(reach[0])]);
    let (car, body) = ([hitch[0], hitch[1]], hitch[2]);
    let mut all = vec![
        ("robot/Rusty".to_owned(), "world/Apartment", ([rusty[0], rusty[1]], rusty[2])),
        ("part/0/Rusty".to_owned(), "world/Apartment", ([rusty[0], rusty[1]], 0.0)),
        ("robot/Reach".to_owned(), "world/Workbench", ([0.0, 0.0], reach[0])),
        ("part/0/Reach".to_owned(), "world/Workbench", ([0.0, 0.0], reach[0])),
        ("part/1/Reach".to_owned(), "world/Workbench", (elbow, turned)),
        ("robot/Hitch".to_owned(), "world/Lot", (car, body)),
        ("part/0/Hitch".to_owned(), "world/Lot", (car, body)),
    ];
    // the trailer turns about the hitch, which is on the rear axle
    all.extend(hitch.get(3).map(|psi| ("part/1/Hitch".to_owned(), "world/Lot", (car, *psi))));
    all
}

fn vector(wire: &Wire) -> [f64; 3] {
    [1, 2, 3].map(|axis| wire.double(axis))
}

/// Checks that a Timestamp or a Duration is this number of ticks of 50 ms.
#[track_caller]
fn assert_time(wire: &Wire, ticks: u64) {
    assert_eq!(wire.number(1) * 1_000_000_000 + wire.number(2), ticks * 50_000_000);
    assert!(wire.number(2) < 1_000_000_000);
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

#[test]
fn every_frame_of_reference_lies_where_its_robot_part_or_world_is() {
    let (log, topics) = &*EXPORTED;
    assert_eq!(topics["/viewer/transforms"].len(), 321);
    for (frame, (tick, message)) in frames(log).zip(&topics["/viewer/transforms"]) {
        assert_eq!(frame.tick, *tick);
        let transforms = message.messages(1);
        // the worlds stand in a row from 0 on, a metre apart, their lower sides level
        let mut expected: Vec<(String, &str, Place)> = Vec::new();
        let mut left = 0.0;
        for world in &log.recipe.config.worlds {
            let (min, max) = (world.bounds.min, world.bounds.max);
            expected.push((format!("world/{}", world.name), "lab", ([left - min.x, -min.y], 0.0)));
            left += max.x - min.x + 1.0;
        }
        expected.extend(expected_frames(frame));
        assert_eq!(transforms.len(), expected.len(), "tick {tick}");
        for (child, parent, ([x, y], heading)) in expected {
            let transform =
                transforms.iter().find(|t| t.text(3) == child).unwrap_or_else(|| panic!("no frame {child}"));
            assert_time(&transform.message(1), *tick);
            assert_eq!(transform.text(2), parent, "{child}");
            let [tx, ty, tz] = vector(&transform.message(4));
            assert!(
                near(tx, x) && near(ty, y) && tz == 0.0,
                "tick {tick}: {child} is at {tx}, {ty}, {tz}, not {x}, {y}"
            );
            // a turn about z by an angle has the quaternion (0, 0, sin, cos) of half of it, or its negative
            let rotation = transform.message(5);
            let [qx, qy, qz] = vector(&rotation);
            let (s, c) = (sin(0.5 * heading), cos(0.5 * heading));
            let same = near((qz * s + rotation.double(4) * c).abs(), 1.0) && near(qz * c, rotation.double(4) * s);
            assert!(same && qx == 0.0 && qy == 0.0, "tick {tick}: {child} is turned otherwise than by {heading}");
        }
    }
}

#[test]
fn every_scan_has_the_rays_of_its_frame() {
    let (log, topics) = &*EXPORTED;
    assert_eq!(topics.keys().filter(|topic| topic.starts_with("/viewer/scan/")).count(), 1, "one robot has a sensor");
    assert_eq!(topics["/viewer/scan/Rusty"].len(), 321);
    for (frame, (tick, scan)) in frames(log).zip(&topics["/viewer/scan/Rusty"]) {
        assert_eq!(frame.tick, *tick);
        assert_time(&scan.message(1), *tick);
        assert_eq!(scan.text(2), "robot/Rusty");
        let pose = scan.message(3);
        assert_eq!(
            (vector(&pose.message(1)), vector(&pose.message(2)), pose.message(2).double(4)),
            ([0.0; 3], [0.0; 3], 1.0)
        );
        // ray k of 8 at 2 pi k / 8 from the heading, counter-clockwise: from 0 to seven eighths of a turn
        assert!(scan.double(4) == 0.0 && near(scan.double(5), 0.875 * TAU));
        let bits = |ranges: &[f64]| ranges.iter().map(|r| r.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&scan.doubles(6)), bits(&frame.scans[0].ranges), "tick {tick}");
    }
}

/// Red, green, blue and opacity of a role in the dark, from 0 to 1.
fn colour(role: Role, opacity: f64) -> [f64; 4] {
    let [r, g, b] = Theme::Dark.palette().colour(role).0.map(|c| f64::from(c) / 255.0);
    [r, g, b, opacity]
}

/// Checks that an entity is one flat area with its edge, or an edge alone, in the colours of its role. Returns the
/// edge's points.
fn area(entity: &Wire, role: Role, opacity: f64, above: f64) -> Vec<[f64; 2]> {
    let [lines, areas] = [11, 12].map(|field| entity.messages(field));
    assert_eq!((lines.len(), areas.len().min(1)), (1, areas.len()), "{}", entity.text(3));
    let placed = |wire: &Wire, pose: u64, points: u64, paint: u64, colour: [f64; 4]| -> Vec<[f64; 2]> {
        let [position, turn] = [1, 2].map(|field| wire.message(pose).message(field));
        assert_eq!((vector(&position), vector(&turn), turn.double(4)), ([0.0, 0.0, above], [0.0; 3], 1.0));
        assert_eq!([1, 2, 3, 4].map(|channel| wire.message(paint).double(channel)), colour, "{}", entity.text(3));
        let points = wire.messages(points);
        assert!(points.iter().all(|p| p.double(3) == 0.0));
        points.iter().map(|p| [p.double(1), p.double(2)]).collect()
    };
    let line = &lines[0];
    let edge = placed(line, 2, 5, 6, colour(role, 1.0));
    // a loop about an area, otherwise a strip; 2 pixels wide on the screen
    assert_eq!((line.number(1), line.double(3), line.number(4)), (areas.len() as u64, 2.0, 1), "{}", entity.text(3));
    if let Some(triangles) = areas.first() {
        assert_eq!(placed(triangles, 1, 2, 3, colour(role, opacity)), edge);
        let corners = triangles.fixed32s(5);
        let covered: f64 = corners.chunks(3).map(|t| surface(&[0, 1, 2].map(|i| edge[t[i] as usize])).abs()).sum();
        assert!((covered - surface(&edge)).abs() < 1e-9, "{}: triangles of {covered} m2", entity.text(3));
    }
    edge
}

/// The area of a polygon, positive when it is counter-clockwise.
fn surface(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0])).sum()
}

/// The distance of a point from a segment on the x axis.
pub fn off_axis([x, y]: [f64; 2], [from, to]: [f64; 2]) -> f64 {
    let beyond = if x < from {
        from - x
    } else if x > to {
        x - to
    } else {
        0.0
    };
    (beyond * beyond + y * y).sqrt()
}

/// The frames of a robot's parts after a tick.
fn parts_of(frame: &Frame, robot: Option<&str>) -> BTreeSet<String> {
    let all = expected_frames(frame).into_iter().map(|(child, ..)| child);
    all.filter(|child| child.starts_with("part/") && robot.is_none_or(|name| child.ends_with(name))).collect()
}

/// Checks that an entity is a part of a robot in the part's frame, with its own shape.
fn assert_part(entity: &Wire, part: &str, role: Role, above: f64) {
    assert_eq!((entity.text(2), entity.number(5)), (part.to_owned(), 1), "it moves with its own frame");
    let edge = area(entity, role, 0.85, above);
    // straight sides are exact; round ones lie inside, by at most a four-hundredth of their radius
    let round = |axis: [f64; 2], radius: f64| {
        let whole = PI * radius * radius + 2.0 * radius * (axis[1] - axis[0]);
        let on = edge.iter().all(|p| near(off_axis(*p, axis), radius));
        on && surface(&edge) < whole && surface(&edge) > whole * 0.99
    };
    let rectangle = |[back, front]: [f64; 2], half: f64| {
        let corners = [[back, -half], [front, -half], [front, half], [back, half]];
        edge.len() == 4 && edge.iter().zip(corners).all(|(p, q)| near(p[0], q[0]) && near(p[1], q[1]))
    };
    assert!(
        match part {
            "part/0/Rusty" => round([0.0, 0.0], 0.11),
            "part/0/Hitch" => rectangle([-0.7, 3.2], 0.85),
            "part/1/Hitch" => rectangle([-2.8, -1.0], 0.75),
            _ => round([0.0, 1.0], 0.03),
        },
        "{part}: {edge:?}"
    );
}

/// Checks the messages of a topic that holds entities in the parts' frames: whenever `expected` changes there is one
/// with all of it, which deletes what is gone, and otherwise none. Returns the numbers of messages and of deletions.
fn assert_whole(topic: &str, prefix: &str, expected: impl Fn(&Frame) -> BTreeSet<String>) -> [usize; 2] {
    let (log, topics) = &*EXPORTED;
    let mut messages = topics[topic].iter();
    let (mut shown, mut deleted) = (BTreeSet::new(), 0);
    for frame in frames(log) {
        let parts = expected(frame);
        if parts == shown {
            continue;
        }
        let (tick, message) = messages.next().unwrap();
        assert_eq!(*tick, frame.tick, "{topic}");
        let entities = message.messages(2);
        let ids: BTreeSet<String> = entities.iter().map(|entity| entity.text(3)).collect();
        let prefixed =
            |parts: &BTreeSet<String>| parts.iter().map(|part| format!("{prefix}{part}")).collect::<Vec<_>>();
        assert!(entities.len() == parts.len() && ids.iter().eq(&prefixed(&parts)), "{topic} at tick {tick}: {ids:?}");
        for entity in &entities {
            assert_time(&entity.message(1), *tick);
            assert_time(&entity.message(4), 0);
            let (role, above) = if prefix.is_empty() { (Role::Robot, 0.01) } else { (Role::Goal, 0.02) };
            assert_part(entity, entity.text(3).strip_prefix(prefix).unwrap(), role, above);
        }
        let gone: Vec<String> = message.messages(1).iter().map(|deletion| deletion.text(3)).collect();
        message.messages(1).iter().for_each(|deletion| assert_time(&deletion.message(1), *tick));
        assert_eq!(gone, prefixed(&shown.difference(&parts).cloned().collect()), "{topic} at tick {tick}");
        deleted += gone.len();
        shown = parts;
    }
    assert!(messages.next().is_none(), "{topic}: a message without a change");
    [topics[topic].len(), deleted]
}

#[test]
fn the_robots_are_written_once_and_again_when_a_trailer_comes_or_goes() {
    assert_eq!(assert_whole("/viewer/robots", "", |frame| parts_of(frame, None)), [3, 1]);
}

#[test]
fn what_flashes_is_red() {
    let flashing = |frame: &Frame| {
        let red = NAMES.iter().zip(&frame.robots).filter(|(_, robot)| robot.flash > 0);
        red.flat_map(|(name, _)| parts_of(frame, Some(name))).collect()
    };
    let [messages, deleted] = assert_whole("/viewer/contacts", "contact/", flashing);
    assert!(messages > 10 && deleted > 5, "{messages} messages, {deleted} deletions");
}

#[test]
fn the_paths_of_the_whole_run_are_written_once_with_a_cross_at_each_contact() {
    let (log, topics) = &*EXPORTED;
    let [(0, message)] = &topics["/viewer/paths"][..] else { panic!("the paths are written once") };
    let entities = message.messages(2);
    let mut crosses = 0;
    for (id, name) in NAMES.iter().enumerate() {
        let (mut path, mut hits, mut counted): (Vec<[f64; 2]>, Vec<[f64; 2]>, u32) = (Vec::new(), Vec::new(), 0);
        for frame in frames(log) {
            let (q, contacts) = (&frame.robots[id].configuration, frame.robots[id].contacts);
            let turned = q[0] + q[1];
            let at = if id == 1 { [cos(q[0]) + cos(turned), sin(q[0]) + sin(turned)] } else { [q[0], q[1]] };
            if path.last().is_none_or(|[x, y]| (at[0] - x) * (at[0] - x) + (at[1] - y) * (at[1] - y) >= 1e-4) {
                path.push(at);
            }
            if contacts > counted {
                (counted, crosses) = (contacts, crosses + 1);
                hits.extend(
                    [[-0.05, -0.05], [0.05, 0.05], [-0.05, 0.05], [0.05, -0.05]].map(|d| [at[0] + d[0], at[1] + d[1]]),
                );
            }
        }
        let entity = |kind: &str| entities.iter().find(|entity| entity.text(3) == format!("{kind}/{name}")).unwrap();
        let near_all = |found: &[[f64; 2]], expected: &[[f64; 2]]| {
            found.len() == expected.len()
                && found.iter().zip(expected).all(|(p, q)| near(p[0], q[0]) && near(p[1], q[1]))
        };
        let line = area(entity("path"), Role::Path, 1.0, 0.01);
        assert!(near_all(&line, &path), "{name}: {} points, not {}", line.len(), path.len());
        let world = ["world/Apartment", "world/Workbench", "world/Lot"][id];
        assert_eq!((entity("path").text(2), entity("contacts").text(2)), (world.to_owned(), world.to_owned()));
        let [cross] = &entity("contacts").messages(11)[..] else { panic!("one list of lines") };
        assert_eq!((cross.number(1), [1, 2, 3, 4].map(|c| cross.message(6).double(c))), (2, colour(Role::Goal, 1.0)));
        let ends: Vec<[f64; 2]> = cross.messages(5).iter().map(|p| [p.double(1), p.double(2)]).collect();
        assert!(near_all(&ends, &hits), "{name}: {ends:?}, not {hits:?}");
    }
    assert!(entities.len() == 6 && crosses > 5, "{crosses} contacts");
}

#[test]
fn every_obstacle_and_mark_of_the_worlds_is_there_as_it_is_written() {
    let (log, topics) = &*EXPORTED;
    let [(0, message)] = &topics["/viewer/worlds"][..] else { panic!("the worlds are written once") };
    let entities = message.messages(2);
    let mut expected = 0;
    let entity = |world: &World, kind: &str, name: &str| {
        let id = format!("world/{}/{kind}/{name}", world.name);
        let entity = entities.iter().find(|entity| entity.text(3) == id).unwrap_or_else(|| panic!("no {id}"));
        assert_eq!((entity.text(2), entity.number(5)), (format!("world/{}", world.name), 0), "{id}");
        entity
    };
    for world in &log.recipe.config.worlds {
        expected += world.marks.len() + world.obstacles.len();
        for mark in &world.marks {
            let points: Vec<[f64; 2]> = mark.points.iter().map(|p| [p.x, p.y]).collect();
            assert_eq!(area(entity(world, "mark", &mark.name), Role::Muted, 1.0, 0.0), points, "{}", mark.name);
        }
        for obstacle in &world.obstacles {
            let entity = entity(world, "obstacle", &obstacle.name);
            let walls = obstacle.pieces.iter().filter_map(|(_, shape)| match shape {
                Shape::Segment { a, b } => Some(vec![[a.x, a.y], [b.x, b.y]]),
                _ => None,
            });
            let walls: Vec<Vec<[f64; 2]>> = walls.collect();
            let points = |wire: &Wire| wire.messages(5).iter().map(|p| [p.double(1), p.double(2)]).collect::<Vec<_>>();
            for (field, paint, opacity) in [(11, 6, 1.0), (12, 3, 0.35)] {
                for primitive in entity.messages(field) {
                    let found = [1, 2, 3, 4].map(|channel| primitive.message(paint).double(channel));
                    assert_eq!(found, colour(Role::Obstacle, opacity), "{}", obstacle.name);
                }
            }
            let strips: Vec<Vec<[f64; 2]>> =
                entity.messages(11).iter().filter(|line| line.number(1) == 0).map(points).collect();
            assert_eq!(strips, walls, "{}", obstacle.name);
            // a solid obstacle covers its area
            let solid = obstacle.written().into_iter().map(|written| match written {
                SourceShape::Piece((_, Shape::Rectangle { min, max })) => (max.x - min.x) * (max.y - min.y),
                SourceShape::Piece((_, Shape::Disc { radius })) => PI * radius * radius,
                SourceShape::Piece((_, Shape::Polygon(p))) => {
                    surface(&p.vertices().iter().map(|p| [p.x, p.y]).collect::<Vec<_>>())
                }
                _ => 0.0,
            });
            let loops = entity.messages(11).into_iter().filter(|line| line.number(1) == 1);
            let (solid, drawn): (f64, f64) = (solid.sum(), loops.map(|line| surface(&points(&line))).sum());
            assert!(drawn <= solid + 1e-9 && drawn >= 0.995 * solid, "{}: {drawn} m2 of {solid}", obstacle.name);
        }
    }
    assert_eq!(entities.len(), expected);
}

#[test]
fn what_happens_is_logged_at_its_tick_of_its_robot() {
    let (log, topics) = &*EXPORTED;
    let written: Vec<(u64, u64, String, String)> = topics["/viewer/log"]
        .iter()
        .map(|(tick, message)| (*tick, message.number(2), message.text(4), message.text(3)))
        .collect();
    topics["/viewer/log"].iter().for_each(|(tick, message)| assert_time(&message.message(1), *tick));
    let (info, warning) = (2, 3); // of Foxglove's levels
    let first = format!("seed 2005, 320 ticks, digest {}", log.digest().unwrap());
    let mut expected = vec![(0, info, "motion-lab".to_owned(), first)];
    let all: Vec<&Frame> = frames(log).collect();
    for pair in all.windows(2) {
        for (id, name) in NAMES.iter().enumerate() {
            let [before, now] = [0, 1].map(|i| &pair[i].robots[id]);
            let mut tell = |level, message: String| expected.push((pair[1].tick, level, (*name).to_owned(), message));
            if now.contacts > before.contacts {
                tell(warning, format!("contact {}", now.contacts));
            }
            if now.refusals > before.refusals {
                tell(warning, format!("an input was refused, {} so far", now.refusals));
            }
            match (before.manual, now.manual) {
                (false, true) => tell(info, "taken over from its tour".to_owned()),
                (true, false) => tell(info, "back on its tour".to_owned()),
                _ => {}
            }
        }
    }
    assert_eq!(written, expected);
    for word in ["contact ", "refused", "taken over", "back on"] {
        assert!(written.iter().any(|(.., message)| message.contains(word)), "no message of {word}");
    }
}
