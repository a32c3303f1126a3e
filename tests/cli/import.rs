//! `world import` and `world export`.

use std::fs;

use super::{run, run_in};

fn sample(name: &str) -> String {
    format!("{}/tests/samples/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn what_is_imported_passes_the_check_and_can_be_run() {
    let folder = tempfile::tempdir().unwrap();
    for (file, start) in [("room.yaml", "0,0,0"), ("yard.map", "1.5,1.5,0")] {
        let told = run_in(
            folder.path(),
            &["world", "import", &sample(file), "--robot", "rusty", "--start", start, "-o", "world.ron"],
        );
        assert!(told.err.contains("wrote world.ron with ") && !told.err.contains("contact"), "{}", told.err);
        told.done();
        let checked = run_in(folder.path(), &["world", "check", "world.ron"]).done();
        assert!(checked.contains("robots: Rusty"), "{checked}");
        let recorded = run_in(folder.path(), &["record", "--world", "world.ron", "--ticks", "3"]).done();
        assert!(recorded.starts_with("Rusty  Pose2 {"), "{recorded}");
        // without -o the same text is printed
        let printed = run(&["world", "import", &sample(file), "--robot", "rusty", "--start", start]).done();
        assert_eq!(fs::read_to_string(folder.path().join("world.ron")).unwrap(), printed);
    }
}

#[test]
fn a_robot_in_a_wall_is_told_of() {
    let told = run(&["world", "import", &sample("room.yaml"), "--robot", "rusty", "--start", "-0.5,-1.4,0"]);
    assert!(told.err.contains("Rusty starts in contact with wall 4"), "{}", told.err);
    assert!(told.err.contains("1 unknown cells are taken as occupied"), "{}", told.err);
    assert!(told.done().contains("start: [-0.5, -1.4, 0.0]"));
}

#[test]
fn imports_that_cannot_be_say_why() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("lost.yaml"), "image: nowhere.pgm\nresolution: 1\norigin: [0, 0, 0]\n").unwrap();
    fs::write(folder.path().join("cut.map"), "type octile\nheight 2\nwidth 2\nmap\n@@\n").unwrap();
    fs::write(folder.path().join("world.txt"), "").unwrap();
    let failed =
        |arguments: &[&str], code| run_in(folder.path(), &[&["world", "import"], arguments].concat()).failed(code);
    assert!(failed(&["lost.yaml"], 3).contains("nowhere.pgm: there is no such file"));
    assert!(failed(&["cut.map"], 3).contains("cut.map: 1 rows: the head of the file tells 2"));
    assert!(failed(&["nowhere.map"], 3).contains("nowhere.map: there is no such file"));
    assert!(failed(&["world.txt"], 2).contains("--from"));
    assert!(failed(&["room.pgm"], 2).contains("yaml file beside it"));
    let wrong = failed(&[&sample("yard.map"), "--robot", "rusty", "--start", "1,2"], 2);
    assert!(wrong.contains("a rusty starts with three: x, y, theta"), "{wrong}");
    failed(&[&sample("yard.map"), "--robot", "rusty"], 2);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "nothing was written");
}
