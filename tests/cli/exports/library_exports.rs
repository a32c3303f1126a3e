//! Exports by the library: the bytes of the command `export`, and logs with a kind of robot of a program's own.

use std::fs;
use std::io::{self, Write};

use motion_lab::configuration::{Kinds, RobotKind};
use motion_lab::export::{
    ExportError, write_csv, write_csv_of_kinds, write_foxglove, write_foxglove_of_file, write_jsonl,
    write_jsonl_of_kinds, write_rerun, write_rerun_of_file,
};
use motion_lab::prelude::*;
use motion_lab::recording::RunError;
use motion_lab::run::{Log, Recipe};
use motion_lab::simulation::{App, RobotPlugin, SpawnError};
use motion_lab::tour::TourConfig;

use crate::cli::exports::messages::messages;
use crate::cli::runs::columns::frames;
use crate::cli::{json, run};
use crate::lab::examples::custom_robot::{record, with_trains};

/// What `write` writes.
#[track_caller]
fn written(write: impl FnOnce(&mut Vec<u8>) -> Result<(), ExportError>) -> Vec<u8> {
    let mut out = Vec::new();
    write(&mut out).unwrap();
    out
}

/// The trailers' run of the example, its first 60 ticks.
fn trains() -> Log {
    first_ticks(&record(Seed(8)).unwrap(), 60)
}

/// The run as if it ended after `ticks` ticks.
fn first_ticks(log: &Log, ticks: u64) -> Log {
    let config = TourConfig { ticks, ..TourConfig::clone(&log.recipe.config) };
    let recipe = Recipe { config: config.into(), ..log.recipe.clone() };
    Log::with_frames(recipe, log.initial().unwrap().clone(), log.frames()[..ticks as usize].to_vec())
}

#[test]
fn the_library_writes_what_the_command_writes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    run(&["record", "--ticks", "30", "--rays", "8", "-o", &path("new.mcap")]).done();
    let older = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/samples/format_2.mcap");
    for (is_new, file) in [(true, path("new.mcap")), (false, older.to_owned())] {
        let bytes = fs::read(&file).unwrap();
        let log = Log::read_mcap(&bytes).unwrap().log;
        let command = |form: &[&str]| {
            run(&[&["export", &file, "-o", &path("out"), "--format"], form].concat()).done();
            fs::read(path("out")).unwrap()
        };
        assert!(command(&["jsonl"]) == written(|out| write_jsonl(&log, out)), "{file}");
        assert!(command(&["csv"]) == written(|out| write_csv(&log, false, out)), "{file}");
        assert!(command(&["csv", "--ranges"]) == written(|out| write_csv(&log, true, out)), "{file}");
        let viewer = command(&["foxglove"]);
        let mut frames = 0;
        assert!(viewer == written(|out| write_foxglove_of_file(&bytes, &log, out, |_| {}, || frames += 1)), "{file}");
        assert_eq!(frames, 2 * (log.frames().len() + 1), "each frame is drawn and written");
        // a log that was never in a file has the records that this program gives it
        assert!(!is_new || viewer == written(|out| write_foxglove(&log, out, |_| {})), "{file}");
        let rerun = command(&["rerun"]);
        assert!(
            rerun == written(|out| write_rerun_of_file(&bytes, &log, out, |_| {}, || {})) && rerun != viewer,
            "{file}"
        );
        assert!(!is_new || rerun == written(|out| write_rerun(&log, out, |_| {})), "{file}");
    }
}

/// The corners of the first area of an entity's edge.
fn corners(entity: &crate::cli::exports::messages::Wire) -> Vec<[f64; 2]> {
    entity.messages(11)[0].messages(5).iter().map(|p| [p.double(1), p.double(2)]).collect()
}

#[test]
fn a_kind_of_a_program_s_own_is_exported_with_its_own_footprint() {
    let log = trains();
    let topics = messages(&written(|out| write_foxglove(&log, out, with_trains)));
    assert_eq!(topics["/frame"].len(), 61, "the log's own messages are there");
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    // by the example's numbers: 0.3 m beyond the car's axles, 1.2 m apart, and beyond a trailer's, 1 m behind its hitch
    let boxes = [[-0.3, 1.5], [-1.3, -0.7], [-1.3, -0.7]];
    let [(0, scene)] = &topics["/viewer/robots"][..] else { panic!("the train is written once") };
    let entities = scene.messages(2);
    assert_eq!(entities.len(), 3);
    for (part, (entity, [back, front])) in entities.iter().zip(boxes).enumerate() {
        assert_eq!(entity.text(3), format!("part/{part}/Train"));
        let expected = [[back, -0.3], [front, -0.3], [front, 0.3], [back, 0.3]];
        let same = corners(entity).iter().zip(expected).all(|(p, q)| near(p[0], q[0]) && near(p[1], q[1]));
        assert!(same && corners(entity).len() == 4, "part {part}: {:?}", corners(entity));
    }
    for (k, frame) in frames(&log).enumerate() {
        let tick = frame.tick;
        let q = &frame.robots[0].configuration;
        let axle = [q[0] - motion_lab::num::cos(q[3]), q[1] - motion_lab::num::sin(q[3])];
        let places = [("part/0/Train", [q[0], q[1]]), ("part/1/Train", [q[0], q[1]]), ("part/2/Train", axle)];
        let transforms = topics["/viewer/transforms"][k].1.messages(1);
        for (name, [x, y]) in places {
            let transform = transforms.iter().find(|t| t.text(3) == name).unwrap();
            let at = transform.message(4);
            assert!(near(at.double(1), x) && near(at.double(2), y), "tick {tick}: {name}");
            assert_eq!(transform.text(2), "world/Lot");
        }
    }
}

#[test]
fn a_kind_of_a_program_s_own_is_exported_as_data() {
    let log = trains();
    let lines = String::from_utf8(written(|out| write_jsonl(&log, out))).unwrap();
    let table = String::from_utf8(written(|out| write_csv(&log, true, out))).unwrap();
    let mut rows = table.lines().map(|row| row.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = rows.next().unwrap();
    assert!(table.starts_with("tick,time_s,id,robot,configuration0,") && !table.contains("range0"), "{head:?}");
    assert_eq!(head.iter().filter(|name| name.starts_with("configuration")).count(), 5);
    assert_eq!((lines.lines().count(), table.lines().count()), (61, 62));
    for ((line, row), frame) in lines.lines().map(json).zip(rows).zip(frames(&log)) {
        let train = &line["robots"][0];
        assert_eq!((&train["name"], &train["kind"]), (&"Train".into(), &"x-train".into()));
        assert!(train["ranges_m"].is_null() && train.get("further_scans").is_none());
        for (k, x) in frame.robots[0].configuration.iter().enumerate() {
            assert_eq!(train["configuration"][format!("configuration{k}")].as_f64().unwrap().to_bits(), x.to_bits());
            assert_eq!(row[4 + k].parse::<f64>().unwrap().to_bits(), x.to_bits());
        }
    }
}

#[test]
fn a_described_kind_of_a_program_s_own_has_named_columns() {
    static TRAIN: RobotKind =
        RobotKind { name: "x-train", coordinates: &["x", "y", "theta", "first", "second"], ..RobotKind::HITCH };
    let (log, kinds) = (trains(), Kinds::default().with("x-train", &TRAIN));
    let names = ["x_m", "y_m", "theta_rad", "first_rad", "second_rad"];
    let table = String::from_utf8(written(|out| write_csv_of_kinds(&log, &kinds, false, out))).unwrap();
    let head = table.lines().next().unwrap();
    assert!(head.starts_with(&format!("tick,time_s,id,robot,{},", names.join(","))), "{head}");
    assert!(!head.contains("configuration"), "{head}");
    let plain = String::from_utf8(written(|out| write_csv(&log, false, out))).unwrap();
    assert!(table.lines().skip(1).eq(plain.lines().skip(1)), "the same numbers");
    let lines = String::from_utf8(written(|out| write_jsonl_of_kinds(&log, &kinds, out))).unwrap();
    for (line, frame) in lines.lines().map(json).zip(frames(&log)) {
        let q = line["robots"][0]["configuration"].as_object().unwrap();
        assert_eq!(q.len(), names.len());
        for (name, x) in names.iter().zip(&frame.robots[0].configuration) {
            assert_eq!(q[*name].as_f64().unwrap().to_bits(), x.to_bits(), "{name}");
        }
    }
}

/// Takes this many bytes, and no more.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.0.min(bytes.len());
        self.0 -= taken;
        if taken == 0 { Err(io::Error::from(io::ErrorKind::StorageFull)) } else { Ok(taken) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn what_cannot_be_exported_is_a_typed_error() {
    let log = trains();
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    let full = |error: ExportError| matches!(error, ExportError::Write(e) if e.kind() == io::ErrorKind::StorageFull);
    for room in [0, 500] {
        assert!(full(write_jsonl(&log, Full(room)).unwrap_err()));
        assert!(full(write_csv(&log, true, Full(room)).unwrap_err()));
        assert!(full(write_foxglove(&log, Full(room), with_trains).unwrap_err()));
    }
    // a kind that nobody added, and another robot under its name
    let viewer = |file: &[u8], log: &Log, add: fn(&mut App)| write_foxglove_of_file(file, log, io::sink(), add, || {});
    let error = viewer(&file, &log, |_| {}).unwrap_err();
    assert!(error.to_string().contains("there is no kind \"x-train\""), "{error}");
    let ExportError::Run(unknown) = error else { panic!("{error:?}") };
    assert!(matches!(*unknown, RunError::Spawn(SpawnError::UnknownKind { .. })), "{unknown:?}");
    let error = viewer(&file, &log, |app| _ = app.add_plugins(RobotPlugin::new("x-train", HITCH))).unwrap_err();
    assert!(matches!(error, ExportError::Run(_)), "{error:?}");
    // a frame that no train has
    let mut other = log.clone();
    other.frames_mut()[6].robots[0].configuration.push(0.0);
    let error = viewer(&file, &other, with_trains).unwrap_err();
    assert!(error.to_string().contains("tick 7"), "{error}");
    let ExportError::Run(frame) = error else { panic!("{error:?}") };
    assert!(matches!(*frame, RunError::Restore(_)), "{frame:?}");
    // another log's file, no file, and a file that ends within a record
    let shorter = first_ticks(&log, 20);
    let mut short = Vec::new();
    shorter.write_mcap(&mut short).unwrap();
    for (file, tick) in [(&short[..], 21), (b"", 0)] {
        let error = viewer(file, &log, with_trains).unwrap_err();
        assert!(matches!(error, ExportError::Ends(t) if t == tick), "{error:?}");
    }
    for file in [&file[..file.len() / 2], b"no log"] {
        let error = viewer(file, &log, with_trains).unwrap_err();
        assert!(matches!(error, ExportError::Records(_)), "{error:?}");
    }
    // what the log's writer refuses
    let wrong = Log::with_frames(log.recipe.clone(), log.initial().unwrap().clone(), log.frames()[..59].to_vec());
    assert!(matches!(write_foxglove(&wrong, io::sink(), with_trains), Err(ExportError::Log(_))));
}
