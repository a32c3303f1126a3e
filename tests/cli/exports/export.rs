//! `export`: the exported values are those of the log, to the last bit.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::run::{Frame, Log, RobotState};
use serde_json::Value;

use crate::cli::{json, run, run_in, sealed};

pub fn recording(folder: &Path) -> PathBuf {
    let file = folder.join("run.mcap");
    // a range so short that most readings are infinite
    run(&["record", "--ticks", "30", "--rays", "16", "--range", "1.9", "-o", file.to_str().unwrap()]).done();
    file
}

fn read(file: &Path) -> Log {
    Log::read_mcap(&fs::read(file).unwrap()).unwrap().log
}

fn frames(log: &Log) -> impl Iterator<Item = &Frame> {
    std::iter::once(log.initial().unwrap()).chain(log.frames())
}

fn export(file: &Path, format: &str) -> crate::cli::Run {
    run(&["export", file.to_str().unwrap(), "--format", format])
}

/// A number as written; infinity is a string.
fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        value => value.as_f64().unwrap(),
    }
}

#[track_caller]
fn same_bits(value: &Value, expected: &[f64]) {
    let found: Vec<u64> = value.as_array().unwrap().iter().map(|x| number(x).to_bits()).collect();
    assert_eq!(found, expected.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
}

/// The names of the numbers of configuration, own state and target of the tour's robots. One more of Reach's own state
/// and of its target than it has is planted, which no table names.
fn names_of(id: u32) -> [Vec<&'static str>; 3] {
    match id {
        0 => [vec!["x_m", "y_m", "theta_rad"], vec!["left_wheel_rad", "right_wheel_rad", "waypoint"], vec![]],
        1 => [
            vec!["theta1_rad", "theta2_rad"],
            vec!["extra0"],
            vec!["target_theta1_rad", "target_theta2_rad", "target2"],
        ],
        _ => [vec!["x_m", "y_m", "theta_rad", "psi_rad"], vec![], vec![]],
    }
}

/// Checks an object with these keys: the numbers, and null where there is none. The last key may be left out.
#[track_caller]
fn same_numbers(object: &Value, names: &[&str], expected: &[f64]) {
    let object = object.as_object().unwrap();
    assert!(object.keys().all(|key| names.contains(&key.as_str())), "{object:?}");
    for (k, name) in names.iter().enumerate() {
        match expected.get(k) {
            Some(x) => assert_eq!(number(&object[*name]).to_bits(), x.to_bits(), "{name}"),
            None if ["extra0", "target2"].contains(name) => assert!(!object.contains_key(*name)),
            None => assert!(object[*name].is_null(), "{name}: {object:?}"),
        }
    }
    assert!(expected.len() <= names.len());
}

#[test]
fn a_line_of_json_for_each_tick_has_every_bit_of_the_frame() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let mut log = read(&file);
    plant(&mut log);
    rewrite(&file, &log);
    let lines: Vec<Value> = export(&file, "jsonl").done().lines().map(json).collect();
    assert_eq!(lines.len(), 31, "tick 0 first");
    let mut infinite = 0;
    for (line, frame) in lines.iter().zip(frames(&log)) {
        assert_eq!(line["tick"], frame.tick);
        assert_eq!(line["digest"], frame.digest().to_string());
        assert_eq!(line["time_s"].as_f64().unwrap().to_bits(), (frame.tick as f64 * 0.05).to_bits());
        for (robot, state) in line["robots"].as_array().unwrap().iter().zip(&frame.robots) {
            let [configuration, extra, target] = names_of(state.id);
            same_numbers(&robot["configuration"], &configuration, &state.configuration);
            same_numbers(&robot["extra"], &extra, &state.extra);
            same_numbers(&robot["target"], &target, &state.target);
            let names = ["name", "kind", "world"].map(|name| robot[name].as_str().unwrap());
            let residents =
                [["Rusty", "rusty", "Apartment"], ["Reach", "reach", "Workbench"], ["Hitch", "hitch", "Lot"]];
            assert_eq!(names, residents[state.id as usize]);
            assert_eq!(robot["channels"], Value::from(state.channels.to_vec()));
            for (name, flag) in [("manual", state.manual), ("in_contact", state.in_contact)] {
                assert_eq!(robot[name], flag, "{name}");
            }
            for (name, count) in counts(state) {
                assert_eq!(robot[name], count, "{name}");
            }
            match frame.scans.iter().find(|s| s.robot == state.id) {
                Some(scan) => {
                    same_bits(&robot["ranges_m"], &scan.ranges);
                    infinite += scan.ranges.iter().filter(|r| r.is_infinite()).count();
                }
                None => assert!(robot["ranges_m"].is_null()),
            }
        }
    }
    assert!(infinite > 0, "nothing out of range: the sensor sees too far for this test");
}

/// Puts values into a frame that a log may hold and no run gives, no number twice, so that no column can stand for its
/// neighbour.
fn plant(log: &mut Log) {
    let reach = &mut log.frames_mut()[4].robots[1];
    reach.extra.push(-0.0);
    reach.target.extend([f64::MIN_POSITIVE / 3.0, 1.0 / 3.0, 0.7]);
    reach.channels = [-7, 100];
    (reach.manual, reach.in_contact) = (true, false);
    (reach.contacts, reach.flash, reach.refusals) = (31, 41, 59);
    let next = &mut log.frames_mut()[5].robots[1];
    (next.manual, next.in_contact) = (false, true);
}

/// The counts of a robot by their names.
fn counts(state: &RobotState) -> [(&'static str, u32); 4] {
    [("id", state.id), ("contacts", state.contacts), ("flash", state.flash), ("refusals", state.refusals)]
}

fn rewrite(file: &Path, log: &Log) {
    fs::write(file, sealed(log)).unwrap();
}

#[test]
fn a_row_of_csv_for_each_tick_and_robot_has_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let mut log = read(&file);
    plant(&mut log);
    rewrite(&file, &log);
    let text = run(&["export", file.to_str().unwrap(), "--format", "csv", "--ranges"]).done();
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(head[..7], ["tick", "time_s", "id", "robot", "x_m", "y_m", "theta_rad"]);
    assert_eq!(head[head.len() - 1], "range15_m");
    for frame in frames(&log) {
        for (robot, name) in frame.robots.iter().zip(["Rusty", "Reach", "Hitch"]) {
            let line = lines.next().unwrap();
            let row: BTreeMap<&str, &str> = head.iter().copied().zip(line.split(',')).collect();
            assert_eq!(line.split(',').count(), head.len(), "{line}");
            assert_eq!((row["tick"], row["robot"]), (frame.tick.to_string().as_str(), name));
            let bits = |cell: &str| cell.parse::<f64>().unwrap().to_bits();
            let numbers = [&robot.configuration[..], &robot.extra, &robot.target];
            let mut named: BTreeMap<&str, f64> = BTreeMap::new();
            for (names, numbers) in names_of(robot.id).into_iter().zip(numbers) {
                assert!(numbers.len() <= names.len());
                named.extend(names.into_iter().zip(numbers.iter().copied()));
            }
            let every = (0..3).flat_map(names_of).flatten();
            for column in every {
                match named.get(column) {
                    Some(x) => assert_eq!(bits(row[column]), x.to_bits(), "{column}: {line}"),
                    None => assert_eq!(row[column], "", "{column}: {line}"),
                }
            }
            assert_eq!(bits(row["time_s"]), (frame.tick as f64 * 0.05).to_bits());
            for (column, channel) in [("channel0", robot.channels[0]), ("channel1", robot.channels[1])] {
                assert_eq!(row[column], channel.to_string(), "{column}: {line}");
            }
            for (column, flag) in [("manual", robot.manual), ("in_contact", robot.in_contact)] {
                assert_eq!(row[column], flag.to_string(), "{column}: {line}");
            }
            for (column, count) in counts(robot) {
                assert_eq!(row[column], count.to_string(), "{column}: {line}");
            }
            match frame.scans.iter().find(|s| s.robot == robot.id) {
                Some(scan) => {
                    for (k, x) in scan.ranges.iter().enumerate() {
                        assert_eq!(bits(row[format!("range{k}_m").as_str()]), x.to_bits());
                    }
                }
                None => assert_eq!(row["range3_m"], ""),
            }
        }
    }
    assert_eq!(lines.next(), None);
    assert!(text.contains(",inf"));
    assert!(!export(&file, "csv").done().contains("range0"), "without --ranges");
}

#[test]
fn the_figure_is_the_runs() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let svg = export(&file, "svg").done();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(svg.contains(&read(&file).digest().unwrap().to_string()), "the figure tells the digest");
    for name in ["Rusty", "Reach", "Hitch"] {
        assert!(svg.contains(&format!("<title>the way of {name}</title>")), "{name}");
    }
    // written to a file it is the same
    run_in(folder.path(), &["export", "run.mcap", "--format", "svg", "-o", "run.svg"]).done();
    assert_eq!(fs::read_to_string(folder.path().join("run.svg")).unwrap(), svg);
}

/// A car with two sensors, and a rover with the run's.
const TWO_SENSORS: &str = "World(version: 1, name: \"room\", bounds: (min: (-5, -5), max: (5, 5)),
    walls: [(name: \"wall\", points: [(-5, -5), (5, -5), (5, 5), (-5, 5)], closed: true)], robots: [
    (name: \"rover\", kind: \"rusty\", start: [-2, 0, 1]), (name: \"car\", kind: \"hitch\", start: [1, 0.5, 0], sensors: [
        (name: \"left\", rays: 3, range: 9, field_of_view: 1, mount: (x: 0, y: 0.5, theta: 1.5)),
        (name: \"ahead\", rays: 2, range: 9, mount: (x: 0.5, y: 0, theta: 0))])])";

#[test]
fn every_sensor_of_a_robot_is_exported_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("room.ron"), TWO_SENSORS).unwrap();
    let record = ["record", "--world", "room.ron", "--ticks", "3", "--rays", "4", "-o", "run.mcap"];
    run_in(folder.path(), &record).done();
    run_in(folder.path(), &["verify", "run.mcap"]).done();
    let file = folder.path().join("run.mcap");
    let info = run(&["info", file.to_str().unwrap()]).done();
    assert!(info.contains("\nsensors  car: ahead, left\n"), "{info}");
    let log = read(&file);
    for (line, frame) in export(&file, "jsonl").done().lines().map(json).zip(frames(&log)) {
        let [rover, car] = &line["robots"].as_array().unwrap()[..] else { panic!("two robots") };
        assert!(rover.get("further_scans").is_none(), "a robot with one sensor has the fields it had");
        same_bits(&rover["ranges_m"], &frame.scans[0].ranges);
        same_bits(&car["ranges_m"], &frame.scans[1].ranges);
        let further = car["further_scans"].as_array().unwrap();
        assert_eq!((further.len(), further[0]["sensor"].as_str()), (1, Some("left")));
        same_bits(&further[0]["ranges_m"], &frame.scans[2].ranges);
    }
    let text = run(&["export", file.to_str().unwrap(), "--format", "csv", "--ranges"]).done();
    let mut lines = text.lines();
    let head = lines.next().unwrap();
    assert!(
        head.ends_with(",range0_m,range1_m,range2_m,range3_m,scan2_range0_m,scan2_range1_m,scan2_range2_m"),
        "{head}"
    );
    let (rover, car) = (lines.next().unwrap(), lines.next().unwrap());
    assert!(rover.ends_with(",,,") && !rover.ends_with(",,,,"), "{rover}");
    let [ahead, left] =
        [1, 2].map(|i| log.initial().unwrap().scans[i].ranges.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>());
    assert!(car.ends_with(&format!(",{},,,{}", ahead.join(","), left.join(","))), "{car}");
    let viewer = ["export", "run.mcap", "--format", "foxglove", "-o", "viewer.mcap"];
    run_in(folder.path(), &viewer).done();
    let bytes = fs::read(folder.path().join("viewer.mcap")).unwrap();
    let topics: std::collections::BTreeSet<String> = mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(|message| message.unwrap().channel.topic.clone())
        .filter(|topic| topic.starts_with("/viewer/scan/"))
        .collect();
    let expected = ["/viewer/scan/car/ahead", "/viewer/scan/car/left", "/viewer/scan/rover"];
    assert!(topics.iter().eq(expected), "{topics:?}");
}

#[test]
fn of_a_damaged_log_the_sealed_beginning_is_exported_and_it_is_5() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let whole: Vec<String> = export(&file, "jsonl").done().lines().map(str::to_owned).collect();
    let bytes = fs::read(&file).unwrap();
    fs::write(&file, &bytes[..bytes.len() * 2 / 3]).unwrap();
    let cut = export(&file, "jsonl");
    assert_eq!(cut.code, Some(5));
    assert!(cut.err.contains("run.mcap: the log is cut off after byte "), "{}", cut.err);
    let lines: Vec<&str> = cut.out.lines().collect();
    assert!((2..31).contains(&lines.len()) && lines == whole[..lines.len()], "{} lines", lines.len());
    for format in ["csv", "svg"] {
        assert_eq!(export(&file, format).code, Some(5), "{format}");
    }
    let viewer = run_in(folder.path(), &["export", "run.mcap", "--format", "foxglove", "-o", "viewer.mcap"]);
    assert_eq!(viewer.code, Some(5), "{}", viewer.err);
    let bytes = fs::read(folder.path().join("viewer.mcap")).unwrap();
    let ticks = mcap::MessageStream::new(&bytes).unwrap().filter(|m| m.as_ref().unwrap().channel.topic == "/digest");
    assert_eq!(ticks.count(), lines.len());
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let name = file.to_str().unwrap();
    for (arguments, code, reason) in [
        (&["export", name][..], 2, "--format"),
        (&["export", name, "--format", "foxglove"], 2, "-o FILE"),
        (&["export", name, "--format", "rerun"], 2, "-o FILE"),
        (&["export", name, "--format", "jsonl", "--ranges"], 2, "--ranges"),
        (&["export", "nowhere.mcap", "--format", "csv"], 3, "nowhere.mcap: there is no such file"),
        (&["export", name, "--format", "csv", "-o", "nowhere/run.csv"], 1, "Make its folder first"),
        (&["export", name, "--format", "foxglove", "-o", "nowhere/run.mcap"], 1, "Make its folder first"),
    ] {
        let error = run(arguments).failed(code);
        assert!(error.contains(reason) && error.lines().count() >= 2, "{arguments:?}: {error}");
    }
    // a state that no robot of this kind has
    let mut log = read(&file);
    log.frames_mut()[7].robots[0].configuration.push(1.0);
    rewrite(&file, &log);
    let error = export(&file, "svg").failed(3);
    assert!(error.contains("run.mcap") && error.contains("tick 8") && error.contains("robot 0"), "{error}");
    assert_eq!(export(&file, "jsonl").done().lines().count(), 31, "as data it can be written all the same");
}

#[test]
fn pictures_of_a_run_carry_its_seed_digest_and_tick() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let log = read(&file);
    let made = |name: &str, more: &[&str]| {
        let (path, format) = (folder.path().join(name), name.rsplit('.').next().unwrap());
        let arguments = ["export", file.to_str().unwrap(), "--format", format, "-o", path.to_str().unwrap()];
        run(&[&arguments, more].concat()).done();
        fs::read(path).unwrap()
    };
    let image = made("half.png", &["--tick", "15", "--width", "400"]);
    let mut reader = png::Decoder::new(std::io::Cursor::new(&image)).read_info().unwrap();
    let mut first = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut first).unwrap();
    let notes: BTreeMap<&str, &str> =
        reader.info().uncompressed_latin1_text.iter().map(|note| (&*note.keyword, &*note.text)).collect();
    assert_eq!((notes["Seed"], notes["Tick"]), ("2005", "15"));
    assert_eq!(notes["Digest"], log.digest().unwrap().to_string());
    assert_eq!(reader.info().width, 400);
    assert_ne!(made("end.png", &["--width", "400"]), image, "robots have moved on");
    let svg = String::from_utf8(made("half.svg", &["--tick", "15"])).unwrap();
    assert!(svg.contains("tick 15 of 30 (0.75 s)"), "the figure tells where it is");
    // from tick 10 to 20 a picture for every fifth: three, a quarter of a second each
    let film = made("film.gif", &["--from", "10", "--to", "20", "--every", "5", "--width", "400"]);
    let mut frames = gif::DecodeOptions::new().read_info(&film[..]).unwrap();
    let mut delays = Vec::new();
    while let Some(frame) = frames.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [25, 25, 25]);
    let named = String::from_utf8_lossy(&film).contains(&format!("seed 2005, digest {}", log.digest().unwrap()));
    assert!(named, "the comment tells the run");
    for wrong in [&["--format", "png", "--tick", "31"][..], &["--format", "gif", "--from", "20", "--to", "10"]] {
        let output = folder.path().join("wrong");
        let arguments = ["export", file.to_str().unwrap(), "-o", output.to_str().unwrap()];
        run(&[&arguments, wrong].concat()).failed(2);
        assert!(!output.exists());
    }
}
