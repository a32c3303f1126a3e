//! Every column of a driven run's exports, by other readers: CSV rows split by hand, JSON by serde, and the log's own
//! messages by protobuf's wire format. The expected values come from the script, the kinematics and the published
//! schema.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use motion_lab::num::{cos, greater, sin, tan};
use motion_lab::prelude::*;
use motion_lab::recording::Run;
use motion_lab::run::{Frame, Log, RobotInput, Script};
use motion_lab::sensors::RangeSensor;
use motion_lab::tour::TourConfig;
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_128;

use crate::cli::{json, run, sealed};
use oracle::seen::{Tally, check, things_of};
use oracle::short;

/// The first 16 s of tests/scripts/driving.ron: walls hit, inputs refused, the trailer put on.
static DRIVEN: LazyLock<Log> = LazyLock::new(|| {
    let script = Script::parse("driving.ron", include_str!("../../scripts/driving.ron")).unwrap();
    let sensor = Some(RangeSensor { n_rays: 8, max_range: 1.9 });
    Run::record(TourConfig { ticks: 320, sensor, ..TourConfig::default() }, (Seed(2005), script)).unwrap()
});

/// The driven run, and its file.
pub fn driven(folder: &Path) -> (PathBuf, Log) {
    (write(folder, &DRIVEN), DRIVEN.clone())
}

/// The log as a file.
pub fn write(folder: &Path, log: &Log) -> PathBuf {
    let file = folder.join("driven.mcap");
    fs::write(&file, sealed(log)).unwrap();
    file
}

/// Its frames from tick 0 on.
pub fn frames(log: &Log) -> impl Iterator<Item = &Frame> {
    std::iter::once(log.initial().unwrap()).chain(log.frames())
}

/// A row of CSV by the names of its columns.
type Row = BTreeMap<String, String>;

fn rows(file: &Path) -> Vec<Row> {
    let text = run(&["export", file.to_str().unwrap(), "--format", "csv", "--ranges"]).done();
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let ranges: Vec<String> = (0..8).map(|i| format!("range{i}_m")).collect();
    let expected = "tick,time_s,id,robot,x_m,y_m,theta_rad,theta1_rad,theta2_rad,psi_rad,\
        left_wheel_rad,right_wheel_rad,waypoint,channel0,channel1,target_theta1_rad,target_theta2_rad,\
        manual,in_contact,contacts,flash,refusals";
    assert_eq!(head.join(","), format!("{expected},{}", ranges.join(",")));
    let row = |line: &str| -> Row {
        assert_eq!(line.split(',').count(), head.len(), "{line}");
        head.iter().zip(line.split(',')).map(|(name, cell)| ((*name).to_owned(), cell.to_owned())).collect()
    };
    lines.map(row).collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// The columns of a list of a robot's numbers.
fn columns_of(robot: &str, list: &str) -> Vec<String> {
    let names = match (list, robot) {
        ("configuration", "Rusty") => "x_m y_m theta_rad",
        ("configuration", "Reach") => "theta1_rad theta2_rad",
        ("configuration", _) => "x_m y_m theta_rad psi_rad",
        ("extra", "Rusty") => "left_wheel_rad right_wheel_rad waypoint",
        ("range", _) => "range0_m range1_m range2_m range3_m range4_m range5_m range6_m range7_m",
        _ => "",
    };
    names.split_whitespace().map(str::to_owned).collect()
}

/// The numbers of a list, up to the first empty one.
fn list(row: &Row, name: &str) -> Vec<f64> {
    let columns = columns_of(&row["robot"], name);
    columns.iter().take_while(|column| !row[*column].is_empty()).map(|column| number(row, column)).collect()
}

/// The channels that a driver holds at a tick by the script; `None` before the first event.
fn held(log: &Log, robot: &str, tick: u64) -> Option<[i16; 2]> {
    let due = log.recipe.script.events.iter().filter(|e| e.robot == robot && e.tick <= tick);
    due.fold(None, |held, event| match event.input {
        RobotInput::Drive(a, b) if robot != "Reach" => Some([a, b]),
        RobotInput::Drive(..) => held,
        _ => held.or(Some([0, 0])),
    })
}

/// Checks a rover's tick: its wheels roll as commanded and, unless it is held, cover that distance but for 5 % of slip.
fn check_rover(before: &Row, after: &Row, [speed, turn]: [i16; 2]) {
    let (v, omega) = (0.6 * f64::from(speed) / 128.0, 2.5 * f64::from(turn) / 128.0);
    let rolled = [v - 0.08 * omega, v + 0.08 * omega].map(|wheel| 0.05 * wheel);
    let (a, b) = (list(before, "configuration"), list(after, "configuration"));
    let turned = short(a[2], b[2]);
    let (mean, half) = (a[2] + 0.5 * turned, 0.5 * turned);
    let chord = (b[0] - a[0]) * cos(mean) + (b[1] - a[1]) * sin(mean);
    let ahead = if half == 0.0 { chord } else { chord * half / sin(half) };
    for (wheel, ground) in [ahead - 0.08 * turned, ahead + 0.08 * turned].into_iter().enumerate() {
        let turned = list(after, "extra")[wheel] - list(before, "extra")[wheel];
        assert!((turned - rolled[wheel] / 0.033).abs() < 1e-12, "wheel {wheel}: {after:?}");
        if after["in_contact"] == "false" {
            assert!((ground / rolled[wheel] - 1.0).abs() < 0.05 + 1e-9, "wheel {wheel}: {after:?}");
        }
    }
}

/// Checks a car's tick: its rear axle goes round the turning centre, and its trailer's heading follows its differential
/// equation.
fn check_car(before: &Row, after: &Row, [speed, steering]: [i16; 2]) {
    let (v, phi) = (1.5 * f64::from(speed) / 128.0, 0.6 * f64::from(steering) / 128.0);
    let (a, b) = (list(before, "configuration"), list(after, "configuration"));
    let (way, curvature) = (0.05 * v, tan(phi) / 2.5);
    let theta = a[2] + curvature * way;
    let (dx, dy) = if curvature == 0.0 {
        (way * cos(theta), way * sin(theta))
    } else {
        ((sin(theta) - sin(a[2])) / curvature, (cos(a[2]) - cos(theta)) / curvature)
    };
    let off = [b[0] - a[0] - dx, b[1] - a[1] - dy, short(b[2], theta)];
    assert!(off.iter().all(|d| d.abs() < 1e-12), "{off:?}: {after:?}");
    if let Some(found) = b.get(3) {
        let mut psi = a.get(3).copied().unwrap_or(a[2]);
        for k in 0..200 {
            let (h, heading) = (way / 200.0, |half: f64| a[2] + curvature * way / 200.0 * (f64::from(k) + half));
            let middle = psi + 0.25 * h * sin(heading(0.0) - psi);
            psi += 0.5 * h * sin(heading(0.5) - middle);
        }
        assert!(short(psi, *found).abs() < 1e-9, "{psi}: {after:?}");
    }
}

#[test]
fn the_columns_of_a_driven_run_are_what_its_script_and_the_kinematics_make_them() {
    let folder = tempfile::tempdir().unwrap();
    let (file, log) = driven(folder.path());
    let rows = rows(&file);
    assert_eq!(rows.len(), 3 * 321);
    let apartment = things_of(&World::apartment());
    let (mut tally, mut contacts) = (Tally::default(), 0);
    for (i, after) in rows.iter().enumerate() {
        let (tick, id) = ((i / 3) as u64, i % 3);
        let robot = ["Rusty", "Reach", "Hitch"][id];
        let named = ["tick", "id", "robot"].map(|column| after[column].as_str());
        assert_eq!(named, [tick.to_string().as_str(), id.to_string().as_str(), robot]);
        assert!((number(after, "time_s") - tick as f64 / 20.0).abs() < 1e-12, "20 ticks a second: {after:?}");
        let filled =
            after.iter().filter(|(name, cell)| (name.ends_with("_rad") || name.ends_with("_m")) && !cell.is_empty());
        let widths = [list(after, "configuration").len(), list(after, "extra").len(), list(after, "range").len()];
        let towing = usize::from(robot == "Hitch" && tick > 230);
        assert_eq!(widths, [[3, 3, 8], [2, 0, 0], [3 + towing, 0, 0]][id], "{after:?}");
        assert_eq!(filled.count(), [3 + 2 + 8, 2, 3 + towing][id], "a number in another robot's column: {after:?}");
        if id == 0 {
            let q = list(after, "configuration");
            let pose = Pose2 { x: q[0], y: q[1], theta: q[2] };
            check(&apartment, 1.9, &pose, &list(after, "range"), &mut tally);
        }
        let driver = held(&log, robot, tick);
        let [first, second] = driver.unwrap_or([0, 0]);
        assert_eq!([&after["channel0"], &after["channel1"]], [&first.to_string(), &second.to_string()], "{after:?}");
        assert_eq!(after["manual"], driver.is_some().to_string(), "{after:?}");
        // refused: a teleport onto the block at tick 230, and channels, which an arm does not have, at tick 260
        let refused = if id == 1 { u8::from(tick >= 230) + u8::from(tick >= 260) } else { 0 };
        assert_eq!(after["refusals"], refused.to_string(), "{after:?}");
        let Some(before) = i.checked_sub(3).map(|i| &rows[i]) else { continue };
        // an episode begins with the first tick in contact; the red flash holds for 0.3 s after the last
        let hit = [before, after].map(|row| row["in_contact"] == "true");
        let episodes = number(before, "contacts") + f64::from(u8::from(hit == [false, true]));
        let flash = if hit[1] { 6.0 } else { greater(number(before, "flash") - 1.0, 0.0) };
        assert_eq!([number(after, "contacts"), number(after, "flash")], [episodes, flash], "{after:?}");
        contacts += u32::from(hit == [false, true]);
        match (robot, driver) {
            ("Rusty", Some(channels)) => check_rover(before, after, channels),
            ("Hitch", Some(channels)) if !hit[1] => check_car(before, after, channels),
            ("Reach", Some(_)) => {
                let moves =
                    log.recipe.script.events.iter().filter(|e| e.robot == "Reach" && e.tick <= tick && e.tick != 230);
                let mut moved = moves.filter_map(|e| match &e.input {
                    RobotInput::MoveTo(q) | RobotInput::Teleport(q) => Some([q[0].value(), q[1].value()]),
                    _ => None,
                });
                let (target, q) = (moved.next_back().unwrap(), list(after, "configuration"));
                assert!((0..2).all(|k| short(target[k], q[k]).abs() < 1e-12), "{target:?}: {after:?}");
            }
            _ => {}
        }
        // a held robot stays where it is while its control is the same
        if hit == [true, true] && id != 1 && held(&log, robot, tick) == held(&log, robot, tick - 1) {
            assert_eq!(list(before, "configuration"), list(after, "configuration"), "{after:?}");
        }
    }
    assert!(contacts > 5 && tally.hits > 1_000, "{contacts} contacts, {tally:?}");
}

/// A number in JSON; infinity is a string.
fn float(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

/// The numbers of a list of a robot of a line, in the order of its kind's coordinates.
fn numbers(robot: &Value, list: &str) -> Vec<f64> {
    if list == "range" {
        return robot["ranges_m"].as_array().map_or(Vec::new(), |all| all.iter().map(float).collect());
    }
    let columns = columns_of(robot["name"].as_str().unwrap(), list);
    columns.iter().map(|column| &robot[list][column]).take_while(|x| !x.is_null()).map(float).collect()
}

/// The encoding documented at `Frame::encode`, from a line of JSON: 64-bit words, little-endian.
fn words(line: &Value) -> Vec<u8> {
    let (mut words, mut scans) = (vec![line["tick"].as_u64().unwrap()], Vec::new());
    let push = |words: &mut Vec<u64>, list: &[f64]| {
        words.push(list.len() as u64);
        words.extend(list.iter().map(|x| x.to_bits()));
    };
    let robots = line["robots"].as_array().unwrap();
    words.push(robots.len() as u64);
    for robot in robots {
        words.push(robot["id"].as_u64().unwrap());
        push(&mut words, &numbers(robot, "configuration"));
        push(&mut words, &numbers(robot, "extra"));
        words.extend(robot["channels"].as_array().unwrap().iter().map(|c| c.as_i64().unwrap() as u64));
        push(&mut words, &numbers(robot, "target"));
        words.extend(["manual", "in_contact"].map(|flag| u64::from(robot[flag].as_bool().unwrap())));
        words.extend(["contacts", "flash", "refusals"].map(|count| robot[count].as_u64().unwrap()));
        if !robot["ranges_m"].is_null() {
            scans.push(robot["id"].as_u64().unwrap());
            push(&mut scans, &numbers(robot, "range"));
        }
    }
    words.push(1); // scan
    words.extend(scans);
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

#[test]
fn a_line_of_json_has_what_the_rows_of_csv_have_and_the_digest_of_its_words() {
    let folder = tempfile::tempdir().unwrap();
    let (file, _) = driven(folder.path());
    let rows = rows(&file);
    let text = run(&["export", file.to_str().unwrap(), "--format", "jsonl"]).done();
    let lines: Vec<Value> = text.lines().map(json).collect();
    assert_eq!(lines.len(), 321);
    for (tick, line) in lines.iter().enumerate() {
        assert_eq!(line["digest"], format!("{:032x}", xxh3_128(&words(line))), "tick {tick}");
        let robots = line["robots"].as_array().unwrap();
        assert_eq!(robots.len(), 3);
        for (id, robot) in robots.iter().enumerate() {
            let row = &rows[3 * tick + id];
            let names = ["name", "kind", "world"].map(|name| robot[name].as_str().unwrap());
            let expected =
                [["Rusty", "rusty", "Apartment"], ["Reach", "reach", "Workbench"], ["Hitch", "hitch", "Lot"]];
            assert_eq!((names, row["robot"].as_str()), (expected[id], names[0]));
            for name in ["configuration", "extra", "range"] {
                let found: Vec<u64> = numbers(robot, name).iter().map(|x| x.to_bits()).collect();
                let cells: Vec<u64> = list(row, name).iter().map(|x| x.to_bits()).collect();
                assert_eq!(found, cells, "{name} of {} at tick {tick}", names[0]);
            }
            assert_eq!((&line["time_s"], &line["tick"]), (&number(row, "time_s").into(), &tick.into()));
            let channels = ["channel0", "channel1"].map(|column| Value::from(number(row, column) as i64));
            assert_eq!(robot["channels"], Value::from(channels.to_vec()));
            let target = robot["target"].as_object().unwrap();
            assert!(target.len() == [0, 2, 0][id] && target.values().all(Value::is_null), "{target:?}");
            for name in ["id", "manual", "in_contact", "contacts", "flash", "refusals"] {
                assert_eq!(robot[name].to_string(), row[name], "{name} of {} at tick {tick}", names[0]);
            }
        }
    }
}
