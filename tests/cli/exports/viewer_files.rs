//! The files for viewers as MCAP files: what they hold, in chunks, and when. Their values are in `viewer` and `rerun`.

use std::collections::BTreeMap;
use std::fs;

use crate::cli::exports::export::recording;
use crate::cli::{run, run_in};

/// The export for viewers, read by the crate `mcap`; tests/peers/check reads it by its schemas.
#[test]
fn the_viewers_file_has_the_logs_own_messages_and_more() {
    let folder = tempfile::tempdir().unwrap();
    recording(folder.path());
    let export = ["export", "run.mcap", "--format", "foxglove", "-o", "viewer.mcap"];
    run_in(folder.path(), &export).done();
    let bytes = fs::read(folder.path().join("viewer.mcap")).unwrap();
    let messages = |bytes: &[u8]| {
        let mut by_topic: BTreeMap<String, Vec<(u64, Vec<u8>)>> = BTreeMap::new();
        for message in mcap::MessageStream::new(bytes).unwrap() {
            let message = message.unwrap();
            by_topic
                .entry(message.channel.topic.clone())
                .or_default()
                .push((message.log_time, message.data.into_owned()));
        }
        by_topic
    };
    let (log, mut viewer) = (messages(&fs::read(folder.path().join("run.mcap")).unwrap()), messages(&bytes));
    for (topic, own) in log {
        assert_eq!(viewer.remove(&topic), Some(own), "{topic}");
    }
    let counts: Vec<(&str, usize)> = viewer.iter().map(|(topic, messages)| (topic.as_str(), messages.len())).collect();
    let [(log_topic, messages), rest @ ..] = &counts[..] else { panic!("no topics") };
    assert!(*log_topic == "/viewer/log" && *messages >= 1);
    assert_eq!(
        rest,
        [
            ("/viewer/paths", 1),
            ("/viewer/robots", 1),
            ("/viewer/scan/Rusty", 31),
            ("/viewer/transforms", 31),
            ("/viewer/worlds", 1)
        ]
    );
    let summary = mcap::Summary::read(&bytes).unwrap().expect("a summary");
    assert!(!summary.chunk_indexes.is_empty(), "viewers go to any time by the index");
    assert!(summary.chunk_indexes.iter().all(|c| c.compression == "lz4" && c.compressed_size < c.uncompressed_size));
    assert_eq!(summary.attachment_indexes.len(), 5, "configuration, script and three worlds");
    // the same log gives the same bytes
    run_in(folder.path(), &export).done();
    assert_eq!(fs::read(folder.path().join("viewer.mcap")).unwrap(), bytes);
    // the export is not taken for a log
    let error = run_in(folder.path(), &["verify", "viewer.mcap"]).failed(3);
    assert!(error.contains("viewer.mcap: this is an export") && error.contains("exported from"), "{error}");
}

/// The run of the sample: door A closes at tick 2 and opens at 9, the bed goes at 3 and comes back at 7, a cone comes
/// at 5.
#[test]
fn viewers_see_worlds_change() {
    let folder = tempfile::tempdir().unwrap();
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/samples/format_2.mcap");
    run_in(folder.path(), &["export", sample, "--format", "foxglove", "-o", "viewer.mcap"]).done();
    let topics = crate::cli::exports::messages::messages(&fs::read(folder.path().join("viewer.mcap")).unwrap());
    let worlds = &topics["/viewer/worlds"];
    assert_eq!(worlds.iter().map(|(tick, _)| *tick).collect::<Vec<_>>(), [0, 2, 3, 5, 7, 9]);
    // how often each message deletes (1) or shows (2) what has this in its id
    let count = |field: u64, name: &str| -> Vec<usize> {
        let named = |(_, message): &(u64, crate::cli::exports::messages::Wire)| {
            message.messages(field).iter().filter(|item| item.text(3).contains(name)).count()
        };
        worlds.iter().map(named).collect()
    };
    // each message shows all worlds: a viewer that goes to another time takes the last one only
    assert_eq!(count(2, "obstacle/door A"), [0, 1, 1, 1, 1, 0]);
    assert_eq!(count(1, "obstacle/door A"), [0, 0, 0, 0, 0, 1]);
    assert_eq!(count(2, "obstacle/A's bed"), [1, 1, 0, 0, 1, 1]);
    assert_eq!(count(1, "obstacle/A's bed"), [0, 0, 1, 0, 0, 0]);
    assert_eq!(count(2, "obstacle/a cone"), [0, 0, 0, 1, 1, 1]);
    assert_eq!(count(1, "obstacle/").iter().sum::<usize>(), 2, "nothing else goes");
    let bench = count(2, "world/Workbench/");
    assert!(bench[0] > 0 && bench.iter().all(|shown| *shown == bench[0]), "{bench:?}");
    let info = run(&["info", sample]).done();
    assert!(info.contains("3 events, 5 changes of worlds"), "{info}");
    let script = run_in(folder.path(), &["script", "print", sample]).done();
    fs::write(folder.path().join("s.ron"), &script).unwrap();
    let check = |world: &str| run_in(folder.path(), &["script", "check", "s.ron", "--world", world, "--world", "lot"]);
    let workbench = check("workbench").failed(3);
    assert!(workbench.contains("there is no robot \"Rusty\""), "{workbench}");
    fs::write(folder.path().join("s.ron"), script.replace("Close(\"door A\")", "Close(\"door X\")")).unwrap();
    let all = ["script", "check", "s.ron", "--world", "apartment", "--world", "workbench", "--world", "lot"];
    let refused = run_in(folder.path(), &all).failed(3);
    assert!(refused.contains("changes[0]: there is no door \"door X\" in world \"Apartment\""), "{refused}");
}

#[test]
fn rerun_sees_each_world_change() {
    let folder = tempfile::tempdir().unwrap();
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/samples/format_2.mcap");
    run_in(folder.path(), &["export", sample, "--format", "rerun", "-o", "viewer.mcap"]).done();
    let topics = crate::cli::exports::messages::messages(&fs::read(folder.path().join("viewer.mcap")).unwrap());
    // the ticks of a world's clouds, and the number of points of each
    let clouds = |world: &str| -> (Vec<u64>, Vec<usize>) {
        let clouds = topics[&format!("/viewer/worlds/{world}")].iter();
        clouds.map(|(tick, cloud)| (*tick, cloud.bytes(6).len() / 16)).unzip()
    };
    let (ticks, points) = clouds("Apartment");
    let [open, closed, without_bed, with_bed, at_last] = points[..] else { panic!("{points:?}") };
    assert_eq!(ticks, [0, 2, 3, 7, 9]);
    assert!(open < closed && closed > without_bed && without_bed < with_bed, "a door closes, a bed goes and comes");
    assert_eq!((with_bed, at_last), (closed, open), "everything is as it was");
    let (ticks, points) = clouds("Lot");
    assert!(ticks == [0, 5] && points[0] < points[1], "a cone comes: {points:?}");
    assert_eq!(clouds("Workbench").0, [0]);
}
