//! Every column of a sweep's rows, worked out from the bytes of a log by another reader: the records as docs/formats.md
//! has them, the messages by protobuf's wire format, the robots by their dimensions.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::super::*;
use super::rows::run;
use motion_lab_core::num::{cos, hypot, sin};
use motion_lab_core::worlds::World;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Quantized, RobotInput, Script};

/// A walled square from -8 to 8, a rover, an arm about (3, 3), and a car that has a trailer.
const PEN: &str = "World(version: 1, name: \"pen\", bounds: (min: (-8, -8), max: (8, 8)),
    walls: [(name: \"the wall\", points: [(-8, -8), (8, -8), (8, 8), (-8, 8)], closed: true)], robots: [
    (name: \"Rusty\", kind: \"rusty\", start: [-5, -5, 0]),
    (name: \"Arm\", kind: \"reach\", start: [0.5, 0.5], arm: (base: (3, 3), lengths: [1.5, 1], radius: 0.05)),
    (name: \"Hitch\", kind: \"hitch\", start: [0, -4, 0, 0])])";

const STUDY: &str = "Sweep(version: 1, worlds: [\"pen.ron\"], script: \"a.ron\", ticks: 120,
    goal: (robot: \"Rusty\", at: [-4.2, -5, 0], within: [0.3, 0.3, 0.25]), axes: [
    (vary: \"Rusty.start\", over: Starts([[-5, -5, 0], [-5, -5, -0.2], [-4.25, -5, 0.1], [6, 6, 3.125]])),
    (vary: \"seed\", over: Range(3, 5)), (vary: \"ticks\", over: Values([70, 120]))])";

/// Inputs of all robots: they drive back and forth and into the wall, are put elsewhere, and refuse some.
fn script() -> Script {
    let units = |to: &[f64]| to.iter().map(|x| Quantized((x * 1048576.0).round() as i64)).collect::<Vec<_>>();
    let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
    let drive = |tick, robot, a, b| event(tick, robot, RobotInput::Drive(a, b));
    Script::new(
        vec![
            drive(1, "Rusty", 128, 6),
            drive(1, "Hitch", 128, 40),
            event(2, "Arm", RobotInput::MoveTo(units(&[2.5, -1.5]))),
            // into the wall
            event(9, "Rusty", RobotInput::Teleport(units(&[7.95, 0.0, 0.0]))),
            event(10, "Hitch", RobotInput::Teleport(units(&[7.0, 0.0, 0.0, 0.0]))),
            drive(31, "Rusty", -128, 30),
            // into the wall and elsewhere in one tick
            event(40, "Rusty", RobotInput::Teleport(units(&[7.95, 0.0, 0.0]))),
            event(40, "Rusty", RobotInput::Teleport(units(&[-5.5, -5.0, 0.0]))),
            drive(41, "Rusty", 128, 0),
            event(50, "Arm", RobotInput::MoveTo(units(&[0.0, 0.25]))),
            drive(75, "Hitch", -128, -100),
        ],
        vec![],
    )
}

/// The fields of a message: each one's number, with its bytes or its number.
fn fields(mut bytes: &[u8]) -> Vec<(u64, Vec<u8>, u64)> {
    fn varint(bytes: &mut &[u8]) -> u64 {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = bytes[0];
            *bytes = &bytes[1..];
            value |= u64::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    }
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let key = varint(&mut bytes);
        let length = match key & 7 {
            0 => {
                all.push((key >> 3, Vec::new(), varint(&mut bytes)));
                continue;
            }
            1 => 8,
            5 => 4,
            _ => varint(&mut bytes) as usize,
        };
        all.push((key >> 3, bytes[..length].to_vec(), 0));
        bytes = &bytes[length..];
    }
    all
}

/// A robot after a tick, as the log has it.
#[derive(Clone)]
struct Logged {
    q: Vec<f64>,
    in_contact: bool,
    contacts: u64,
    refusals: u64,
}

/// The robots of all frames, tick 0 first, and the run's digest.
fn read(file: &[u8]) -> (Vec<Vec<Logged>>, String) {
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0_u64, |n, byte| n << 8 | u64::from(*byte));
    let (mut at, mut frames, mut channel, mut digest) = (8, Vec::new(), 0, String::new());
    while at + 9 <= file.len() {
        let (kind, length) = (file[at], number(&file[at + 1..at + 9]) as usize);
        let record = &file[at + 9..at + 9 + length];
        at += 9 + length;
        match kind {
            4 if record[8..].starts_with(b"/frame") => channel = number(&record[..2]),
            5 if number(&record[..2]) == channel => {
                let robots = fields(&record[22..]).into_iter().filter(|field| field.0 == 3);
                let robot = |(_, bytes, _): (u64, Vec<u8>, u64)| {
                    let fields = fields(&bytes);
                    let of = |n: u64| fields.iter().find(|field| field.0 == n).map_or(0, |field| field.2);
                    let q = fields.iter().find(|field| field.0 == 2).unwrap();
                    Logged {
                        q: q.1.chunks(8).map(|x| f64::from_bits(number(x))).collect(),
                        in_contact: of(7) == 1,
                        contacts: of(8),
                        refusals: of(10),
                    }
                };
                frames.push(robots.map(robot).collect());
            }
            0x82 => digest = record[..16].iter().rev().map(|byte| format!("{byte:02x}")).collect(),
            2 => break,
            _ => {}
        }
    }
    (frames, digest)
}

/// The corners of a robot, each with the distance that the robot reaches beyond it.
fn corners(robot: usize, q: &[f64]) -> Vec<([f64; 2], f64)> {
    let placed = |[x, y]: [f64; 2], heading: f64, [u, v]: [f64; 2]| {
        [x + u * cos(heading) - v * sin(heading), y + u * sin(heading) + v * cos(heading)]
    };
    let boxed = |heading: f64, [back, front, half]: [f64; 3]| {
        [[back, -half], [front, -half], [front, half], [back, half]]
            .map(|corner| (placed([q[0], q[1]], heading, corner), 0.0))
    };
    match robot {
        0 => vec![([q[0], q[1]], 0.11)],
        1 => {
            let elbow = placed([3.0, 3.0], q[0], [1.5, 0.0]);
            vec![([3.0, 3.0], 0.05), (elbow, 0.05), (placed(elbow, q[0] + q[1], [1.0, 0.0]), 0.05)]
        }
        _ => boxed(q[2], [-0.7, 3.2, 0.85]).into_iter().chain(boxed(q[3], [-2.8, -1.0, 0.75])).collect(),
    }
}

fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The distance of a robot from the square's sides, within which it is.
fn clearance(robot: usize, q: &[f64]) -> f64 {
    let of = |(p, radius): ([f64; 2], f64)| least(8.0 - p[0].abs(), 8.0 - p[1].abs()) - radius;
    corners(robot, q).into_iter().map(of).fold(f64::INFINITY, least)
}

/// An angle, or the difference of two, the short way.
fn short(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// How far a robot has come in a tick: its body along an arc, or the arm's tip.
fn way(robot: usize, a: &[f64], b: &[f64]) -> f64 {
    if robot == 1 {
        let [a, b] = [a, b].map(|q| corners(1, q)[2].0);
        return hypot(b[0] - a[0], b[1] - a[1]);
    }
    let (chord, half) = (hypot(b[0] - a[0], b[1] - a[1]), 0.5 * short(b[2] - a[2]));
    if half == 0.0 { chord } else { chord * half / sin(half) }
}

/// What each column should hold: a text as it is written, or a number to within what is added up.
#[derive(Debug)]
enum Expectation {
    Text(String),
    Near(f64),
}

/// The columns of a run of this row by the log's frames.
fn expected(row: u64, frames: &[Vec<Logged>], digest: String) -> BTreeMap<String, Expectation> {
    let text = |x: &dyn ToString| Expectation::Text(x.to_string());
    let whole = |n: u64| Expectation::Text(n.to_string());
    let time = |tick: Option<usize>| {
        tick.map_or(Expectation::Text(String::new()), |tick| Expectation::Near(0.05 * tick as f64))
    };
    let last = &frames[frames.len() - 1];
    // the ticks in which the script puts the rover somewhere that it takes
    let is_put = |robot: usize, tick: usize| robot == 0 && tick == 40;
    let mut all = BTreeMap::new();
    let (mut contacts, mut first_contact, mut nearest, mut ways) = (0, None, f64::INFINITY, 0.0);
    for (robot, (name, names)) in [
        ("Rusty", &["x_m", "y_m", "theta_rad"][..]),
        ("Arm", &["theta1_rad", "theta2_rad"]),
        ("Hitch", &["x_m", "y_m", "theta_rad", "psi_rad"]),
    ]
    .into_iter()
    .enumerate()
    {
        let states: Vec<&Logged> = frames.iter().map(|frame| &frame[robot]).collect();
        let first = states.iter().position(|state| state.in_contact || state.contacts > 0);
        let near = states.iter().map(|state| clearance(robot, &state.q)).fold(f64::INFINITY, least);
        let pairs = states.windows(2).enumerate().filter(|(k, _)| !is_put(robot, k + 1));
        let path: f64 = pairs.map(|(_, two)| way(robot, &two[0].q, &two[1].q)).sum();
        let in_contact = states.iter().filter(|state| state.in_contact).count();
        let mut put = |column: &str, cell| _ = all.insert(format!("{name}.{column}"), cell);
        for (coordinate, x) in names.iter().zip(&last[robot].q) {
            put(&format!("end.{coordinate}"), text(&(x + 0.0)));
        }
        put("contacts", whole(last[robot].contacts));
        put("in_contact_s", Expectation::Near(0.05 * in_contact as f64));
        put("first_contact_s", time(first));
        put("least_clearance_m", Expectation::Near(near));
        put("path_m", Expectation::Near(path));
        put("refusals", whole(last[robot].refusals));
        contacts += last[robot].contacts;
        first_contact = [first_contact, first].into_iter().flatten().min();
        (nearest, ways) = (least(nearest, near), ways + path);
    }
    let goal = |state: &Logged| {
        let off = [state.q[0] + 4.2, state.q[1] + 5.0, short(state.q[2])];
        off.iter().zip([0.3, 0.3, 0.25]).all(|(off, within)| off.abs() <= within)
    };
    let there: Vec<usize> = (0..frames.len()).filter(|tick| goal(&frames[*tick][0])).collect();
    let start =
        [["-5", "-5", "0"], ["-5", "-5", "-0.2"], ["-4.25", "-5", "0.1"], ["6", "6", "3.125"]][row as usize / 4];
    for (column, x) in ["x_m", "y_m", "theta_rad"].into_iter().zip(start) {
        all.insert(format!("Rusty.start.{column}"), text(&x));
    }
    let refused: u64 = last.iter().map(|state| state.refusals).sum();
    let failure = match (refused, there.first()) {
        (0, Some(_)) => String::new(),
        (0, None) => "the goal was not reached".into(),
        _ => format!("{refused} inputs were refused, the first at tick 9: robot \"Rusty\" refused Teleport: it would "),
    };
    let kind = match (refused, there.first()) {
        (0, Some(_)) => "",
        (0, None) => "goal-not-reached",
        _ => "inputs-refused",
    };
    for (column, cell) in [
        ("row", whole(row)),
        ("seed", whole(3 + row / 2 % 2)),
        ("ticks", whole(frames.len() as u64 - 1)),
        ("failure", Expectation::Text(failure)),
        ("failure_kind", text(&kind)),
        ("contacts", whole(contacts)),
        ("first_contact_s", time(first_contact)),
        ("least_clearance_m", Expectation::Near(nearest)),
        ("path_m", Expectation::Near(ways)),
        // tick 0 takes no time
        ("at_goal_s", Expectation::Near(0.05 * there.iter().filter(|tick| **tick > 0).count() as f64)),
        ("first_at_goal_s", time(there.first().copied())),
        ("digest", Expectation::Text(digest)),
    ] {
        all.insert(column.into(), cell);
    }
    all
}

#[test]
fn every_column_of_a_row_follows_from_the_log_of_its_run() {
    let file = StudyFile::parse("study.ron", STUDY).unwrap();
    let worlds = [("pen.ron".to_owned(), World::parse("pen.ron", PEN).unwrap())];
    let study = file.with(&worlds.into(), &[("a.ron".to_owned(), script())].into()).unwrap();
    assert_eq!(study.runs(), 16);
    let names: Vec<&str> = study.columns().iter().map(|column| column.name.as_str()).collect();
    let (mut met, mut goals, mut without) = (0, 0, 0);
    for number in 0..study.runs() {
        let RunSetup { seed, config, inputs: RunInputs::Script(script), .. } = study.setup(number).unwrap() else {
            panic!()
        };
        let mut log = Vec::new();
        Run::record(config, (seed, script)).unwrap().write_mcap(&mut log).unwrap();
        let (frames, digest) = read(&log);
        let expected = expected(number, &frames, digest);
        let mut sorted = names.clone();
        sorted.sort_unstable();
        assert_eq!(expected.keys().collect::<Vec<_>>(), sorted, "every column, and no other");
        let row = run(&study, number);
        for (name, cell) in names.iter().zip(&row.cells) {
            let found = cell.to_text();
            match &expected[*name] {
                Expectation::Near(x) => {
                    let off = (found.parse::<f64>().unwrap() - x).abs();
                    assert!(off < 1e-9, "row {number}, {name}: {found}, not {x}");
                }
                Expectation::Text(text) if *name == "failure" => {
                    assert!(found.starts_with(text), "{found}, not {text}")
                }
                Expectation::Text(text) => assert_eq!(found, *text, "row {number}, {name}"),
            }
        }
        met += u32::from(row.has_contacts(study.columns()));
        let first = row.cell(study.columns(), "first_at_goal_s");
        goals += u32::from(matches!(first, Some(RowValue::Number(x)) if *x > 0.0));
        without += u32::from(matches!(first, Some(RowValue::Empty)));
    }
    assert!(met > 3 && goals > 3 && without > 0, "{met} with contacts, {goals} come to the goal, {without} do not");
}
