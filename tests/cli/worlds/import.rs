//! `world import` and `world export`.

use std::fs;

use crate::cli::{run, run_in};

fn sample(name: &str) -> String {
    format!("{}/tests/samples/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn what_is_imported_passes_the_check_and_can_be_run() {
    let folder = tempfile::tempdir().unwrap();
    for (file, start) in [("room.yaml", "0,0,0"), ("yard.map", "1.5,1.5,0"), ("hall.svg", "100,60,0")] {
        let output = run_in(
            folder.path(),
            &["world", "import", &sample(file), "--robot", "rusty", "--start", start, "-o", "world.ron"],
        );
        assert!(output.err.contains("wrote world.ron with ") && !output.err.contains("contact"), "{}", output.err);
        output.done();
        let checked = run_in(folder.path(), &["world", "check", "world.ron"]).done();
        assert!(checked.contains("robots: Rusty"), "{checked}");
        let recorded = run_in(folder.path(), &["record", "--world", "world.ron", "--ticks", "3"]).done();
        assert!(recorded.contains("\nRusty  x "), "{recorded}");
        // without -o the same text is printed
        let printed = run(&["world", "import", &sample(file), "--robot", "rusty", "--start", start]).done();
        assert_eq!(fs::read_to_string(folder.path().join("world.ron")).unwrap(), printed);
    }
}

#[test]
fn a_world_of_ir_sim_brings_its_robots() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), &["world", "import", &sample("garden.yaml"), "-o", "garden.ron"]);
    assert!(output.err.contains("motion-lab: robot.behavior is left out"), "{}", output.err);
    output.done();
    let checked = run_in(folder.path(), &["world", "check", "garden.ron"]).done();
    assert!(checked.contains("garden, ") && checked.ends_with("robots: Rusty, Hitch\n"), "{checked}");
    run_in(folder.path(), &["record", "--world", "garden.ron", "--ticks", "3"]).done();
}

#[test]
fn what_an_ir_sim_world_has_beyond_the_lab_is_left_out_if_asked_and_chance_has_a_seed() {
    let folder = tempfile::tempdir().unwrap();
    let text = "world: {height: 50, width: 50}\nobstacle:\n  - number: 10\n    distribution: {name: random}\n    \
                shape: {name: circle, radius: 0.4}\n  - kinematics: {name: omni}\n    state: [5, 5, 0]\n";
    fs::write(folder.path().join("yard.yaml"), text).unwrap();
    let import = |more: &[&str]| run_in(folder.path(), &[&["world", "import", "yard.yaml"], more].concat());
    let refused = import(&[]).failed(3);
    assert!(
        refused.contains("yard.yaml:6: obstacle[1].kinematics: not supported: an obstacle that moves"),
        "{refused}"
    );
    let output = import(&["--lenient"]);
    let note = "obstacle[1] is left out: obstacle[1].kinematics: an obstacle that moves";
    assert!(output.err.contains(note) && output.err.contains("10 objects are drawn with seed 0"), "{}", output.err);
    let world = output.done();
    assert_eq!(world.matches("Disc").count(), 10, "{world}");
    assert_eq!(import(&["--lenient", "--seed", "0"]).done(), world);
    assert_ne!(import(&["--lenient", "--seed", "1"]).done(), world);
}

#[test]
fn an_exported_map_is_imported_again_and_a_picture_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), &["world", "export", "lot", "--resolution", "0.25", "-o", "lot.yaml"]);
    assert!(output.err.contains("wrote lot.yaml and lot.pgm, 64 x 40 cells"), "{}", output.err);
    output.done();
    // 16 x 10 m in cells of 0.25 m
    assert!(fs::read(folder.path().join("lot.pgm")).unwrap().starts_with(b"P5\n64 40\n255\n"));
    run_in(folder.path(), &["world", "import", "lot.yaml", "-o", "again.ron"]).done();
    run_in(folder.path(), &["world", "check", "again.ron"]).done();
    run_in(folder.path(), &["world", "export", "again.ron", "--format", "svg", "-o", "picture"]).done();
    let picture = fs::read_to_string(folder.path().join("picture")).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("box 1"), "{picture}");
    for (arguments, reason) in [
        (&["lot", "-o", "lot.bmp"][..], "--format"),
        (&["lot", "-o", "lot.yaml", "--resolution", "0"], "resolution of 0 m"),
        (&["lot", "-o", "lot.pgm", "--format", "ros"], "the image's name"),
    ] {
        let error = run_in(folder.path(), &[&["world", "export"], arguments].concat()).failed(2);
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn a_robot_in_a_wall_is_reported() {
    let hollow = ["world", "import", &sample("room.yaml"), "--robot", "rusty", "--start", "-0.5,-1.4,0", "--hollow"];
    let output = run(&hollow);
    assert!(output.err.contains("Rusty starts in contact with wall 4"), "{}", output.err);
    assert!(output.err.contains("the occupied cells are hollow"), "{}", output.err);
    assert!(output.err.contains("unknown cells, taken as occupied: 1"), "{}", output.err);
    assert!(output.done().contains("start: [-0.5, -1.4, 0.0]"));
    // a yard whose cells are all occupied: Rusty in the middle touches a box, but nothing where the cells are hollow
    let folder = tempfile::tempdir().unwrap();
    let rows = ["@@@@@@"; 6].join("\n");
    fs::write(folder.path().join("full.map"), format!("type octile\nheight 6\nwidth 6\nmap\n{rows}\n")).unwrap();
    let inside = ["world", "import", "full.map", "--robot", "rusty", "--start", "3,3,0"];
    let output = run_in(folder.path(), &inside);
    assert!(output.err.contains("Rusty starts in contact with box 1"), "{}", output.err);
    output.done();
    let output = run_in(folder.path(), &[&inside[..], &["--hollow"]].concat());
    assert!(!output.err.contains("contact"), "{}", output.err);
    output.done();
}

#[test]
fn a_map_far_out_lies_where_it_is_shifted_to() {
    let folder = tempfile::tempdir().unwrap();
    let head = "image: x.ppm\nresolution: 0.5\norigin: [431000, 4582000, 0]\nnegate: no\nmode: Trinary\n";
    fs::write(folder.path().join("far.yaml"), head).unwrap();
    // cells of 0, 255 and 205
    fs::write(folder.path().join("x.ppm"), "P3 3 1 255  0 0 0  255 255 255  205 205 205").unwrap();
    let imported =
        |more: &[&str]| run_in(folder.path(), &[&["world", "import", "far.yaml", "--unknown", "free"], more].concat());
    let output = imported(&[]);
    let note = "lower left corner, (431000, 4582000), is the world's origin";
    assert!(output.err.contains(note), "{}", output.err);
    assert!(output.done().contains("shape: Box(min: (0.0, 0.0), max: (0.5, 0.5))"));
    let output = imported(&["--shift", "-430990,-4582001.5"]);
    assert!(!output.err.contains("corner"), "{}", output.err);
    assert!(output.done().contains("shape: Box(min: (10.0, -1.5), max: (10.5, -1.0))"));
    assert!(imported(&["--shift", "1"]).failed(2).contains("--shift takes two numbers"));
    let other = run(&["world", "import", &sample("yard.map"), "--shift", "1,2"]).failed(2);
    assert!(other.contains("only ROS maps"), "{other}");
}

#[test]
fn a_scenario_brings_its_map_and_its_problems() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(sample("yard.map"), folder.path().join("yard.map")).unwrap();
    let line = "0\tbenchmarks/yard.map\t10\t6\t1\t1\t8\t4\t8.2\n";
    fs::write(folder.path().join("yard.map.scen"), format!("version 1\n{line}")).unwrap();
    let world = run_in(folder.path(), &["world", "import", "yard.map.scen"]).done();
    assert!(world.contains("name: \"yard\""), "{world}");
    assert!(world.contains("(name: \"start 1\", pose: (x: 1.5, y: 4.5, theta: 0.0))"), "{world}");
    assert!(world.contains("(name: \"goal 1\", pose: (x: 8.5, y: 1.5, theta: 0.0))"), "{world}");
    fs::remove_file(folder.path().join("yard.map")).unwrap();
    let error = run_in(folder.path(), &["world", "import", "yard.map.scen"]).failed(3);
    assert!(error.contains("yard.map: there is no such file"), "{error}");
}

/// Of 24 public maps tried, three name their image by a path of the machine that made it.
#[test]
fn the_image_of_a_ros_map_may_lie_beside_the_yaml_instead_of_where_it_says() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("far")).unwrap();
    fs::write(folder.path().join("room.pgm"), "P2 2 1 255 0 255").unwrap();
    let import = |image: &str| {
        let text = format!("image: {image}\nresolution: 1\norigin: [0, 0, 0]\n");
        fs::write(folder.path().join("room.yaml"), text).unwrap();
        let output = run_in(folder.path(), &["world", "import", "room.yaml", "-o", "room.ron"]);
        let said = output.err.clone();
        output.done();
        said
    };
    let moved = import("/home/someone/maps/room.pgm");
    assert!(moved.contains("the image was read from room.pgm: /home/someone/maps/room.pgm is not there"), "{moved}");
    assert!(moved.contains("wrote room.ron with 1 obstacle"), "{moved}");
    assert!(!import("room.pgm").contains("was read from"));
    // the one that the yaml names counts, if it is there
    fs::write(folder.path().join("far/room.pgm"), "P2 3 1 255 0 255 0").unwrap();
    assert!(import("far/room.pgm").contains("with 2 obstacles"));
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
    assert!(failed(&["world.txt"], 2).contains("--format"));
    assert!(failed(&["room.pgm"], 2).contains("yaml file beside it"));
    let wrong = failed(&[&sample("yard.map"), "--robot", "rusty", "--start", "1,2"], 2);
    assert!(wrong.contains("a rusty starts with three: x, y, theta"), "{wrong}");
    failed(&[&sample("yard.map"), "--robot", "rusty"], 2);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "nothing was written");
}

#[test]
fn a_size_that_nobody_says_is_warned_of_by_the_files_name() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let rectangle = "<rect id='a' width='2' height='3' x='1' y='1'/></svg>";
    let svg = |head: &str| format!("<svg xmlns='http://www.w3.org/2000/svg' {head}>{rectangle}");
    fs::write(at.join("plain.svg"), svg("viewBox='0 0 9 9'")).unwrap();
    fs::write(at.join("pixels.svg"), svg("width='36' height='36' viewBox='0 0 9 9'")).unwrap();
    fs::write(at.join("plan.svg"), svg("width='9cm' height='9cm' viewBox='0 0 9 9'")).unwrap();
    fs::write(at.join("yard.map"), "type octile\nheight 2\nwidth 3\nmap\n..@\n...\n").unwrap();
    for (file, option, assumed) in [
        ("plain.svg", "--metres-per-unit", "a unit of it was taken for 1 m"),
        ("pixels.svg", "--metres-per-unit", "a unit of it was taken for 4 m"),
        ("yard.map", "--metres-per-cell", "a cell was taken for 1 m"),
    ] {
        let import = ["world", "import", file, "-o", "world.ron"];
        let silent = run_in(at, &import);
        assert_eq!(silent.err.matches(&format!("motion-lab: {file}: the ")).count(), 1, "{}", silent.err);
        assert!(silent.err.contains(assumed) && silent.err.contains(option), "{}", silent.err);
        let assumed_world = fs::read_to_string(at.join("world.ron")).unwrap();
        // who says the same gets the same world, and no warning
        let metres = if file == "pixels.svg" { "4" } else { "1" };
        let said = run_in(at, &[&import[..], &[option, metres]].concat());
        assert!(!said.err.contains("taken for"), "{}", said.err);
        assert_eq!(fs::read_to_string(at.join("world.ron")).unwrap(), assumed_world);
    }
    let physical = run_in(at, &["world", "import", "plan.svg", "-o", "world.ron"]);
    assert!(physical.err.contains("9cm x 9cm") && !physical.err.contains("taken for"), "{}", physical.err);
}
