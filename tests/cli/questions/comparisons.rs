//! `plan --compare`: with iterations, and by the problems of a scenario.

use std::fs;
use std::path::Path;

use crate::cli::{json, run_in};

/// Two boxes that touch at a corner, with a rover of 10 cm between them on one side.
const CORNER: &str = "World(version: 1, name: \"corner\", bounds: (min: (0, 0), max: (4, 4)), obstacles: [
    (name: \"a\", shape: Box(min: (1, 1), max: (2, 2))), (name: \"b\", shape: Box(min: (2, 2), max: (3, 3)))],
    robots: [(name: \"R\", kind: \"rusty\", start: [1.5, 2.5, 0], disc: (radius: 0.1, track: 0.1, wheel_radius: 0.025))])";

/// The cells of a column of a table, in which no cell before it has a comma.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut lines = table.lines();
    let at = lines.next().unwrap().split(',').position(|known| known == name).unwrap_or_else(|| panic!("{name}"));
    lines.map(|line| line.split(',').nth(at).unwrap().to_owned()).collect()
}

/// The numbers of one of the last columns, behind those with commas in their cells.
fn last_column(table: &str, from_end: usize) -> Vec<f64> {
    table.lines().skip(1).map(|line| line.rsplit(',').nth(from_end).unwrap().parse().unwrap()).collect()
}

#[test]
fn rrt_star_shortens_its_path_up_to_the_iterations_of_a_comparison() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("corner.ron"), CORNER).unwrap();
    let length = |more: &[&str]| {
        let arguments = ["plan", "--compare", "rrt-star", "--robot", "R", "--world", "corner.ron", "--to", "2.5,1.5"];
        let rest = ["--seeds", "3..4", "--csv", "rows.csv"];
        run_in(folder.path(), &[&arguments[..], &rest, more].concat()).done();
        let table = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
        let number = |name: &str| column(&table, name)[0].parse::<f64>().unwrap();
        (number("iterations"), number("length_m"))
    };
    let (first, few, many) = (length(&[]), length(&["--iterations", "1200"]), length(&["--iterations", "5000"]));
    assert!(first.0 < 1200.0 && few.0 == 1200.0 && many.0 == 5000.0, "{first:?} {few:?} {many:?}");
    assert!(first.1 > few.1 && few.1 > many.1, "{first:?} {few:?} {many:?}");
    // round three corners of a box, or of the other: two tangents to a circle of radius and tube about a corner that
    // is half a diagonal away, two sides, and arcs of half a turn and twice the angle of the tangent
    let (radius, diagonal) = (0.12_f64, 0.5_f64.sqrt());
    let tangent = (diagonal * diagonal - radius * radius).sqrt();
    let shortest =
        2.0 * tangent + 2.0 + radius * (std::f64::consts::PI + 2.0 * motion_lab::num::atan2(radius, tangent));
    assert!((shortest - 3.812).abs() < 5e-4, "{shortest}");
    assert!(many.1 > shortest && many.1 < 1.03 * shortest, "{many:?}, {shortest}");
}

/// A wall from side to side with another before it; the last problem begins in that one.
const MAP: &str = "height 5\nwidth 9\nmap\n......@..\n......@..\n...@@@@..\n......@..\n......@..\n";
const SCENARIO: &str = "version 1\n0\tm.map\t9\t5\t0\t0\t5\t0\t5\n2\tm.map\t9\t5\t4\t1\t4\t3\t5.65685425\n\
                        3\tm.map\t9\t5\t0\t0\t8\t0\t0\n7\tm.map\t9\t5\t4\t2\t0\t0\t5\n";

fn with_scenario(folder: &Path) {
    fs::write(folder.join("m.map"), MAP).unwrap();
    fs::write(folder.join("m.map.scen"), SCENARIO).unwrap();
    run_in(folder, &["world", "import", "m.map", "--metres-per-cell", "2", "-o", "m.ron"]).done();
}

#[test]
fn planners_are_compared_by_every_problem_of_a_scenario() {
    let folder = tempfile::tempdir().unwrap();
    with_scenario(folder.path());
    let compare = ["plan", "--robot", "rusty", "--world", "m.ron", "--compare", "visibility-graph,a-star"];
    let problems = [&compare[..], &["--problems", "m.map.scen", "--iterations", "3000"]].concat();
    let table = run_in(folder.path(), &[&problems[..], &["--csv", "rows.csv"]].concat()).done();
    let head: Vec<&str> = table.lines().next().unwrap().split("  ").filter(|word| !word.is_empty()).collect();
    assert_eq!(head.last().unwrap().trim(), "of optimal", "{table}");
    assert!(table.lines().nth(1).unwrap().contains("2 of 4"), "{table}");
    let rows = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    assert!(rows.lines().next().unwrap().ends_with(",start,goal,problem,set,known,bucket,optimal_m"), "{rows}");
    assert_eq!(column(&rows, "solved"), ["true", "true", "false", "false"].repeat(2));
    assert_eq!(last_column(&rows, 4), [1.0, 2.0, 3.0, 4.0].repeat(2));
    assert_eq!(last_column(&rows, 1), [0.0, 2.0, 3.0, 7.0].repeat(2));
    // lengths in cells of 2 m
    assert_eq!(last_column(&rows, 0), [10.0, 11.3137085, 0.0, 10.0].repeat(2));
    // cell (x, y) of 5 rows has its middle at (x + 0.5, 5 - y - 0.5) cells
    assert!(rows.lines().nth(2).unwrap().contains("Rusty,m,\"9,7,0\",\"9,3,0\",2,m.map.scen,,2,"), "{rows}");
    assert!(rows.lines().nth(1).unwrap().contains(",\"1,9,0\",\"11,9,0\",1,m.map.scen,,0,10"), "{rows}");
    assert!(rows.lines().nth(4).unwrap().contains("the start would overlap box "), "{rows}");
    // the first problem is a straight line of the shortest length, of which the median is 1; the second goes round the
    // end of the first wall, from (9, 7) by its corner (6, 6) to (9, 3), with the radius and the tube of 13 cm
    let lengths: Vec<f64> = column(&rows, "length_m")[..2].iter().map(|x| x.parse().unwrap()).collect();
    assert!((lengths[0] - 10.0).abs() < 1e-9, "{lengths:?}");
    assert!(lengths[1] > 2.0 * 10_f64.sqrt() + 2.0 && lengths[1] < 9.5, "{lengths:?}");
    let medians = json(&run_in(folder.path(), &[&problems[..], &["--json"]].concat()).done());
    let expected = 0.5 * (1.0 + lengths[1] / 11.3137085);
    assert!((medians[0]["of_optimal"].as_f64().unwrap() - expected).abs() < 1e-12, "{medians}");
    // more seeds are more rows; without problems there is neither column
    let more = run_in(folder.path(), &[&problems[..], &["--seeds", "0..3"]].concat()).done();
    assert!(more.contains("6 of 12"), "{more}");
    let plain = [&compare[..], &["--from", "1,9", "--to", "11,9", "--seeds", "0..1", "--csv", "rows.csv"]].concat();
    let plain = run_in(folder.path(), &plain).done();
    let rows = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    assert!(!plain.contains("optimal") && rows.lines().next().unwrap().ends_with(",start,goal"), "{plain} {rows}");
}

#[test]
fn a_scenario_in_a_problem_file_has_the_rows_of_the_scenario_alone() {
    let folder = tempfile::tempdir().unwrap();
    with_scenario(folder.path());
    let file = "Problems(version: 1, sets: [Scenario(file: \"m.map.scen\", world: \"m.ron\", robot: \"rusty\")])";
    fs::write(folder.path().join("p.ron"), file).unwrap();
    let rows = |more: &[&str]| {
        let compare = ["plan", "--compare", "visibility-graph", "--iterations", "3000", "--csv", "rows.csv"];
        run_in(folder.path(), &[&compare[..], more].concat()).done();
        let table = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
        // the time differs from run to run
        let line = |line: &str| {
            let cells: Vec<&str> = line.splitn(5, ',').collect();
            [&cells[..3], &cells[4..]].concat().join(",")
        };
        table.lines().map(line).collect::<Vec<_>>()
    };
    let alone = rows(&["--robot", "rusty", "--world", "m.ron", "--problems", "m.map.scen"]);
    assert_eq!((rows(&["--problems", "p.ron"]), alone.len()), (alone.clone(), 5));
    assert!(alone[2].ends_with(",2,m.map.scen,,2,11.3137085"), "{alone:?}");
}

#[test]
fn problems_that_do_not_fit_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    with_scenario(folder.path());
    let compare = |more: &[&str], code: i32| {
        let arguments = ["plan", "--compare", "rrt-connect", "--problems"];
        run_in(folder.path(), &[&arguments[..], more].concat()).failed(code)
    };
    let said = compare(&["m.map.scen", "--robot", "rusty"], 3);
    assert!(said.contains("m.map.scen: 9 x 5 cells do not fill the world's bounds, 12 x 8 m"), "{said}");
    let said = compare(&["m.map.scen", "--robot", "reach", "--world", "m.ron"], 2);
    assert!(said.contains("--problems: a reach does not go from place to place"), "{said}");
    let said = compare(&["none.scen", "--robot", "rusty", "--world", "m.ron"], 3);
    assert!(said.contains("none.scen"), "{said}");
    let said = compare(&["m.map.scen", "--robot", "rusty", "--world", "m.ron", "--to", "1,1"], 2);
    assert!(said.contains("--to") && said.contains("--problems"), "{said}");
    fs::write(folder.path().join("bad.scen"), SCENARIO.replace("\t4\t1\t", "\t4\t5\t")).unwrap();
    let said = compare(&["bad.scen", "--robot", "rusty", "--world", "m.ron"], 3);
    assert!(said.contains("bad.scen:3: start: cell (4, 5) of 9 x 5"), "{said}");
    let said = run_in(folder.path(), &["plan", "--robot", "rusty", "--problems", "m.map.scen"]).failed(2);
    assert!(said.contains("--compare") && said.contains("--problem"), "{said}");
    let said = compare(&["m.map.scen", "--world", "m.ron"], 2);
    assert!(said.contains("no robot") && said.contains("--robot"), "{said}");
    // a car is planned too, as its own start says which way it faces
    let car = ["m.map.scen", "--robot", "hitch", "--world", "m.ron", "--iterations", "20", "--compare"];
    let arguments = [&["plan", "--problems"][..], &car, &["hybrid-a-star"]].concat();
    let said = run_in(folder.path(), &arguments);
    assert!(said.out.contains("hybrid-a-star"), "{} {}", said.out, said.err);
}
