//! Scenes of IR-SIM whose short entries stand for very much: they are refused soon, or cost nothing.

use motion_lab_core::random::Seed;
use motion_lab_import::{ImportError, Imported, IrsimOptions};

fn read(text: &str, is_lenient: bool) -> Result<Imported, ImportError> {
    motion_lab_import::irsim("s.yaml", text, "s", IrsimOptions { is_lenient, seed: Seed(0) })
}

/// A scene of a circle and then these entries.
fn scene(entries: &str) -> String {
    format!("obstacle:\n  - {{shape: {{name: circle, radius: 0.1}}, state: [1, 1]}}\n{entries}")
}

#[test]
fn objects_are_counted_whether_or_not_anything_is_left_of_them() {
    // 1 + 50,000 + 49,999 objects; one more is too many
    let two = |second: usize, more: &str| {
        scene(&format!("  - {{number: 50000, {more}}}\n  - {{number: {second}, {more}}}\n"))
    };
    let painted = read(&two(49_999, "unobstructed: true"), false).unwrap();
    assert_eq!((painted.world.obstacles.len(), painted.world.marks.len()), (1, 0));
    for i in [1, 2] {
        let note = format!("obstacle[{i}], a circle that nothing collides with, is left out");
        assert!(painted.notes.contains(&note), "{:?}", painted.notes);
    }
    for is_lenient in [false, true] {
        for more in ["unobstructed: true", "distribution: {name: circle}", "name: post, unobstructed: true"] {
            let error = read(&two(50_000, more), is_lenient).unwrap_err().to_string();
            assert_eq!(error, "s.yaml:4: obstacle[2].number: too many objects: at most 100000", "{more}");
        }
    }
    // thousands of such entries, of obstacles and of robots
    let many = scene(&"  - {number: 50000, unobstructed: true}\n".repeat(5_000));
    assert!(read(&many, true).unwrap_err().to_string().starts_with("s.yaml:4: obstacle[2].number: too many"));
    let robots = scene(&format!("robot:\n{}", "  - {number: 60000, kinematics: {name: diff}}\n".repeat(2)));
    let error = read(&robots, true).unwrap_err().to_string();
    assert_eq!(error, "s.yaml:5: robot[1].number: too many objects: at most 100000");
}

#[test]
fn points_of_painted_shapes_are_counted_over_the_whole_scene() {
    // a polygon of four points unless its entry says otherwise, and 4 points for the circle
    let marks = |number: usize, shape: &str, entries: usize| {
        let entry = format!("  - {{number: {number}, unobstructed: true, shape: {{{shape}}}, state: [5, 5]}}\n");
        read(&scene(&entry.repeat(entries)), false)
    };
    // 16 * 1,000 * 24 + 4 points, then 1,000 * 24 more
    let corners: Vec<String> = (0..24).map(|i| format!("[{i}, {}]", i * i)).collect();
    let polygon = format!("name: polygon, vertices: [{}]", corners.join(", "));
    assert_eq!(marks(1_000, &polygon, 16).unwrap().world.marks.len(), 16_000);
    let error = marks(1_000, &polygon, 17).unwrap_err().to_string();
    assert_eq!(error, "s.yaml:19: obstacle[17]: not supported: obstacles of more than 400000 points in all");
    // what is drawn may have as many vertices as its range says
    let drawn = "name: polygon, random_shape: true, num_vertices_range: [900, 1000]";
    assert!(marks(400, drawn, 1).unwrap_err().to_string().contains("more than 400000 points in all"));
}

#[test]
fn tries_at_random_are_counted_over_the_whole_scene() {
    let apart = "  - {number: 1000, distribution: {name: random, min_distance: 1e9}}\n";
    // states and goals: 8 for the first object, 1,000 tries of 8 + 1 for each other one, 17,982,016 in all; eleven
    // times that is below 200,000,000
    let entries = |n: usize| format!("obstacle:\n{}", apart.repeat(n));
    assert_eq!(read(&entries(11), false).unwrap().world.obstacles.len(), 11_000);
    let expected = "what is drawn at random takes too many tries in the scene as a whole";
    let error = read(&entries(12), false).unwrap_err().to_string();
    assert_eq!(error, format!("s.yaml:13: obstacle[11].distribution: not supported: {expected}"));
    // polygons of 999 corners, of which two coincide, are drawn 20 times, of 8 + 499,000 comparisons each
    let spiky = "{name: polygon, random_shape: true, num_vertices_range: [999, 1000], spikeyness_range: [1, 1]}";
    let shape = format!("unobstructed: true, shape: {{name: compound, parts: [{spiky}]}}");
    let polygons = |n: usize| read(&scene(&format!("  - {{number: {n}, {shape}}}\n")), false);
    assert_eq!(polygons(20).unwrap().world.obstacles.len(), 1);
    assert_eq!(polygons(21).unwrap_err().to_string(), format!("s.yaml:3: obstacle[1]: not supported: {expected}"));
    // left out, thousands of them take no longer; the hundred and first has an object too many
    let error = read(&entries(3_000), true).unwrap_err().to_string();
    assert_eq!(error, "s.yaml:102: obstacle[100].number: too many objects: at most 100000");
}

#[test]
fn sensors_of_robots_are_counted_as_objects() {
    let robots = |lidars: usize| {
        let sensors = vec!["{name: lidar2d}"; lidars].join(", ");
        let robot = format!("{{number: 25000, state: [5, 5], kinematics: {{name: diff}}, sensors: [{sensors}]}}");
        read(&scene(&format!("robot:\n  - {robot}\n")), true)
    };
    // 1 + 25,000 * (1 + 2) objects, and 1 + 25,000 * (1 + 3)
    assert_eq!(robots(2).unwrap().world.robots.len(), 25_000);
    assert_eq!(robots(3).unwrap_err().to_string(), "s.yaml:4: robot[0]: too many objects: at most 100000");
}

#[test]
fn a_note_is_one_short_line_whatever_stands_in_the_file() {
    // yaml has keys of at most 1,024 characters
    let long = "long_".repeat(190);
    let map = format!("image: a\nresolution: 1\norigin: [0, 0, 0]\n{long}: 1\n");
    let notes = motion_lab_import::RosMap::parse("m.yaml", &map).unwrap().notes;
    assert!(notes.len() == 1 && notes[0].ends_with("long_... in line 4 says nothing of the map"), "{notes:?}");
}
