//! docs/formats.md lists every column, key, field and topic that the code writes, with its unit and since when, and
//! nothing that it does not write. The schemas carry comments.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use motion_lab::export::{write_csv, write_foxglove, write_jsonl, write_rerun};
use motion_lab::prelude::*;
use motion_lab::recording::Run;
use motion_lab::run::{Log, Script};
use motion_lab::sensors::RangeSensor;
use motion_lab::tour::TourConfig;
use prost::Message;
use prost_types::FileDescriptorSet;
use serde_json::Value;

use crate::cli::json;
use crate::lab::examples::custom_robot;

/// A file of the repository.
fn text(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The rows of the tables of a section whose head has the first name: the names in the first cell, and the other cells.
fn rows(section: &str, head: &str) -> BTreeMap<String, Vec<String>> {
    let docs = text("docs/formats.md");
    let section = docs.split("\n## ").find(|part| part.starts_with(section)).unwrap_or_else(|| panic!("no {section}"));
    let table = section.split(&format!("\n| {head} |")).nth(1).unwrap_or_else(|| panic!("no table of {head}"));
    let mut rows = BTreeMap::new();
    for line in table.lines().skip(1).take_while(|line| line.starts_with('|')).filter(|line| line.starts_with("| `")) {
        let cells: Vec<String> = line.split(" |").map(|cell| cell.trim_start_matches('|').trim().to_owned()).collect();
        for name in cells[0].split(", ") {
            let name = name.strip_prefix('`').unwrap().strip_suffix('`').unwrap();
            assert!(rows.insert(name.to_owned(), cells[1..].to_vec()).is_none(), "{name} is listed twice");
        }
    }
    rows
}

#[track_caller]
fn assert_listed(written: &BTreeSet<String>, listed: &BTreeMap<String, Vec<String>>) {
    let listed: BTreeSet<String> = listed.keys().cloned().collect();
    let missing: Vec<&String> = written.difference(&listed).collect();
    assert!(missing.is_empty(), "docs/formats.md does not list {missing:?}");
    let stale: Vec<&String> = listed.difference(written).collect();
    assert!(stale.is_empty(), "docs/formats.md lists {stale:?}, which nothing writes");
}

/// A robot of each kind, two sensors on the car, and a door.
const WORLD: &str = "World(version: 1, name: \"room\", bounds: (min: (-9, -9), max: (9, 9)),
    walls: [(name: \"wall\", points: [(-9, -9), (9, -9), (9, 9), (-9, 9)], closed: true)],
    doors: [(name: \"door\", hinge: (-8, -8), end: (-7, -8), open: true)], robots: [
    (name: \"rover\", kind: \"rusty\", start: [-5, 0, 1]), (name: \"arm\", kind: \"reach\", start: [1, 0],
        arm: (base: (5, 5), lengths: [0.5, 0.5], radius: 0.02)),
    (name: \"long arm\", kind: \"reach3\", start: [1, 0, 0], arm: (base: (-5, 5), lengths: [0.4, 0.4, 0.4], radius: 0.02)),
    (name: \"car\", kind: \"hitch\", start: [1, 0.5, 0, 0], sensors: [
        (name: \"left\", rays: 3, range: 9, field_of_view: 1, mount: (x: 0, y: 0.5, theta: 1.5)),
        (name: \"ahead\", rays: 2, range: 9, mount: (x: 0.5, y: 0, theta: 0))])])";

/// A run with everything, and a contact that flashes planted.
fn full() -> Log {
    let worlds = vec![World::parse("room.ron", WORLD).unwrap()];
    let script = "Script(version: 2, events: [(tick: 1, robot: \"rover\", input: Drive(64, 0))],
        changes: [(tick: 2, world: \"room\", change: Close(\"door\"))])";
    let script = Script::parse("script.ron", script).unwrap();
    let sensor = Some(RangeSensor { n_rays: 4, max_range: 9.0 });
    let mut log = Run::record(TourConfig { worlds, ticks: 4, sensor }, (Seed(1), script)).unwrap();
    let frames = log.frames_mut();
    (frames[2].robots[0].flash, frames[2].robots[0].contacts) = (3, 1);
    frames[3].robots[0].contacts = 1;
    log
}

/// A run of a program's own kind, with own state and a target, which that kind does not have.
fn own_kind() -> Log {
    let log = custom_robot::record(Seed(8)).unwrap();
    let (recipe, initial) = (log.recipe.clone(), log.initial().unwrap().clone());
    let mut frames = log.into_frames();
    frames.truncate(2);
    frames[1].robots[0].extra.push(1.0);
    frames[1].robots[0].target.push(1.0);
    Log::with_frames(recipe, initial, frames)
}

/// A name with its numbers left open, where it counts rays, sensors or the numbers of a list.
fn family(name: &str) -> String {
    let lists = ["configuration", "extra", "target"];
    let open = |text: &str| text.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned();
    if lists.iter().any(|list| *list == open(name) && name != *list) {
        return format!("{}K", open(name));
    }
    let Some(ray) = name.strip_suffix("_m") else { return name.to_owned() };
    match ray.split_once("_range") {
        Some((sensor, _)) if open(sensor) == "scan" => "scanN_rangeK_m".to_owned(),
        None if open(ray) == "range" => "rangeK_m".to_owned(),
        _ => name.to_owned(),
    }
}

fn csv_columns(log: &Log) -> BTreeSet<String> {
    let mut table = Vec::new();
    write_csv(log, true, &mut table).unwrap();
    let head = String::from_utf8(table).unwrap().lines().next().unwrap().to_owned();
    head.split(',').map(family).collect()
}

/// Checks that a name ends with the unit that is listed.
fn assert_unit(name: &str, unit: &str) {
    let of_name = ["s", "m", "rad"].into_iter().find(|unit| name.ends_with(&format!("_{unit}")));
    match of_name {
        Some(of_name) => assert_eq!(unit, of_name, "{name}"),
        None => assert!(["", "ticks", "1/128"].contains(&unit), "{name} is listed in {unit}"),
    }
}

#[test]
fn every_column_of_csv_is_listed_with_its_unit() {
    let listed = rows("The columns of CSV", "column");
    let written: BTreeSet<String> = [full(), own_kind()].iter().flat_map(csv_columns).collect();
    assert_listed(&written, &listed);
    for (name, cells) in &listed {
        assert_unit(name, &cells[0]);
        assert!(cells[2] == "0.1.0" && !cells[1].is_empty(), "{name}: {cells:?}");
    }
}

/// The keys of a value by their paths. What is called as a column is left to the columns.
fn keys(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) if !["robots.configuration", "robots.extra", "robots.target"].contains(&path) => {
            for (key, value) in fields {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                found.insert(path.clone());
                keys(value, &path, found);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| keys(value, path, found)),
        _ => {}
    }
}

#[test]
fn every_key_of_json_is_listed_and_the_numbers_are_called_as_columns() {
    let listed = rows("The columns of CSV", "key");
    let columns = rows("The columns of CSV", "column");
    let mut written = BTreeSet::new();
    for log in [full(), own_kind()] {
        let mut lines = Vec::new();
        write_jsonl(&log, &mut lines).unwrap();
        for line in String::from_utf8(lines).unwrap().lines().map(json) {
            keys(&line, "", &mut written);
            let of_robot = |robot: &Value| -> Vec<String> {
                let lists = ["configuration", "extra", "target"].map(|list| robot[list].as_object().unwrap().clone());
                lists.iter().flat_map(|list| list.keys().map(|key| family(key))).collect()
            };
            for name in line["robots"].as_array().unwrap().iter().flat_map(of_robot) {
                assert!(columns.contains_key(&name), "{name} is no column");
            }
        }
    }
    assert_listed(&written, &listed);
    for (name, cells) in &listed {
        assert_unit(name, &cells[0]);
        assert_eq!(cells[2], "0.1.0", "{name}");
    }
}

fn descriptors(compiled: &[u8]) -> FileDescriptorSet {
    FileDescriptorSet::decode(compiled).unwrap()
}

/// The fields of a log's messages; `Release` has none.
fn fields(compiled: &[u8]) -> BTreeSet<String> {
    let messages = descriptors(compiled).file.into_iter().flat_map(|file| file.message_type);
    let of_message = |m: prost_types::DescriptorProto| {
        let name = m.name().to_owned();
        m.field.into_iter().map(move |field| format!("{name}.{}", field.name()))
    };
    messages.flat_map(of_message).collect()
}

/// The topics of a file with their schemas; names are left open.
fn topics(file: &[u8]) -> BTreeMap<String, String> {
    let summary = mcap::Summary::read(file).unwrap().unwrap();
    let named = |topic: &str| {
        let parts: Vec<&str> = topic.split('/').collect();
        let open = match parts[..] {
            ["", "viewer", "worlds", _] => vec!["", "viewer", "worlds", "WORLD"],
            ["", "viewer", "robots", _, _] => vec!["", "viewer", "robots", "NAME", "K"],
            ["", "viewer", kind @ ("paths" | "contacts" | "scan"), _] => vec!["", "viewer", kind, "NAME"],
            ["", "viewer", "scan", _, _] => vec!["", "viewer", "scan", "NAME", "SENSOR"],
            _ => parts,
        };
        open.join("/")
    };
    let channels = summary.channels.values();
    channels.map(|channel| (named(&channel.topic), channel.schema.as_ref().unwrap().name.clone())).collect()
}

#[test]
fn every_topic_and_field_of_a_log_is_listed() {
    let mut file = Vec::new();
    full().write_mcap(&mut file).unwrap();
    let listed = rows("What a log holds", "topic");
    let written = topics(&file);
    assert_listed(&written.keys().cloned().collect(), &listed);
    for (topic, cells) in &listed {
        assert_eq!((cells[0].trim_matches('`'), &cells[2][..]), (&written[topic][..], "format 1"), "{topic}");
    }
    let [first, second, third] = [
        fields(include_bytes!("../../../crates/sim/assets/schema/motion_lab.binpb")),
        fields(include_bytes!("../../../crates/sim/assets/schema/motion_lab_2.binpb")),
        fields(include_bytes!("../../../crates/sim/assets/schema/motion_lab_3.binpb")),
    ];
    assert!(first.is_subset(&second) && second.is_subset(&third) && first.len() > 20);
    let listed = rows("What a log holds", "field");
    assert_listed(&third, &listed);
    for (field, cells) in &listed {
        let since = match (first.contains(field), second.contains(field)) {
            (true, _) => "format 1",
            (false, true) => "format 2",
            (false, false) => "format 3",
        };
        assert_eq!(cells[2], since, "{field}");
    }
}

#[test]
fn every_topic_for_viewers_is_listed_with_its_schema() {
    let log = full();
    let (mut foxglove, mut rerun) = (Vec::new(), Vec::new());
    write_foxglove(&log, &mut foxglove, |_| {}).unwrap();
    write_rerun(&log, &mut rerun, |_| {}).unwrap();
    let listed = rows("The files for viewers", "topic");
    let of_log = rows("What a log holds", "topic");
    let mut written = BTreeSet::new();
    for (column, file) in [&foxglove, &rerun].into_iter().enumerate() {
        let topics = topics(file);
        for (topic, schema) in topics.iter().filter(|(topic, _)| !of_log.contains_key(*topic)) {
            let cells = listed.get(topic).unwrap_or_else(|| panic!("docs/formats.md does not list {topic}"));
            assert_eq!((cells[column].trim_matches('`'), &cells[3][..]), (&schema[..], "0.1.0"), "{topic}");
            written.insert(topic.clone());
        }
        assert!(of_log.keys().all(|topic| topics.contains_key(topic)), "the log's own topics");
        let here = listed.iter().filter(|(_, cells)| !cells[column].is_empty()).map(|(topic, _)| topic);
        assert!(here.clone().all(|topic| topics.contains_key(topic)), "{:?}", here.collect::<Vec<_>>());
    }
    assert_listed(&written, &listed);
}

#[test]
fn every_message_and_field_of_the_schemas_has_a_comment() {
    for name in ["motion_lab.proto", "motion_lab_2.proto", "motion_lab_3.proto", "foxglove.proto"] {
        let proto = text(&format!("crates/sim/assets/schema/{name}"));
        let (mut before, mut commented, mut in_enum) = ("", 0, false);
        for line in proto.lines().map(str::trim) {
            in_enum = (in_enum || line.starts_with("enum ")) && line != "}";
            let declares = ["message ", "enum ", "oneof "].iter().any(|word| line.starts_with(word));
            let is_field = line.ends_with(';') && line.contains(" = ") && !line.starts_with("syntax");
            if declares || is_field && !in_enum {
                assert!(before.starts_with("// "), "{name}: {line} has no comment");
                commented += 1;
            }
            before = line;
        }
        assert!(commented > 30, "{name}: {commented}");
    }
}
