//! The memory that a study takes while it is read.

use motion_lab::batch::StudyFile;
use motion_lab::worlds::World;

/// The greatest memory that reading a study of a million bytes takes, in times its size.
fn times_its_size(head: &str, item: &str, tail: &str) -> f64 {
    let text = format!("{head}{}{tail}", item.repeat(1_000_000 / item.len()));
    let worlds = [("lot".to_owned(), World::lot())].into();
    let measured = allocation_counter::measure(|| {
        let study = StudyFile::parse("study.ron", &text).unwrap().with(&worlds, &[].into()).unwrap();
        assert!(study.runs() >= 10);
    });
    measured.bytes_max as f64 / text.len() as f64
}

/// Short items are the worst: their values take more than their texts.
#[test]
fn a_study_takes_at_most_sixteen_times_its_size() {
    let head = "Sweep(version: 1, worlds: [\"lot\"], points: Sample(count: 10, seed: 1), axes: [";
    let axes = [
        ("(vary: \"Hitch.start\", over: Starts([", "[6,2,0],"),
        ("(vary: \"Hitch.start.x\", over: Values([", "0.1,"),
        ("(vary: \"world\", over: Names([", "\"lot\","),
    ];
    for (axis, item) in axes {
        let times = times_its_size(&format!("{head}{axis}"), item, "]))])");
        println!("{item} {times:.1} times");
        assert!((2.0..16.0).contains(&times), "{item} {times:.1} times its size");
    }
}
