//! `sweep` of the problems of a MovingAI scenario, in the world that `world import` makes of its map, and of a problem
//! file.

use std::fs;

use super::folder_with;
use super::planner::rows;
use crate::cli::run_in;

/// A wall of three cells; the last problem begins in it.
const MAP: &str = "height 5\nwidth 9\nmap\n.........\n.........\n...@@@...\n.........\n.........\n";
const SCENARIO: &str = "version 1\n0\tm.map\t9\t5\t0\t0\t8\t0\t8\n2\tm.map\t9\t5\t4\t1\t4\t3\t5.65685425\n\
                        7\tm.map\t9\t5\t4\t2\t0\t0\t5\n";

const STUDY: &str = "Sweep(version: 1, worlds: [\"m.ron\"], ticks: 2400, planner: (name: \"visibility-graph\"),
    goal: (robot: \"Rusty\", at: [0, 0, 0], within: [0.05, 0.05, 4]),
    axes: [(vary: \"problem\", over: Problems(\"m.map.scen\"))])";

#[test]
fn every_problem_of_a_scenario_is_a_run() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    fs::write(at.join("m.map"), MAP).unwrap();
    fs::write(at.join("m.map.scen"), SCENARIO).unwrap();
    let import = ["world", "import", "m.map", "--metres-per-cell", "0.5", "--robot", "rusty", "--start", "1,2,0"];
    run_in(at, &[&import[..], &["-o", "m.ron"]].concat()).done();
    let listed = run_in(at, &["sweep", "plan.ron", "--check"]);
    assert!(listed.err.contains("3 runs, varying problem (3); 0 of those listed can't be run"), "{}", listed.err);
    let swept = run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    assert!(swept.contains("3 runs, 3 of them made now; 1 failed, of which 1 without a run"), "{swept}");
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    let table = fs::read_to_string(at.join("all.csv")).unwrap();
    let rows = rows(&table);
    let numbers = |row: usize, name: &str| rows[row](name).parse::<f64>().unwrap();
    // the middles of the cells: (x + 0.5, 5 - y - 0.5) cells of half a metre
    for (row, known) in [
        (0, [1.0, 0.0, 0.25, 2.25, 4.25, 2.25, 4.0]),
        (1, [2.0, 2.0, 2.25, 1.75, 2.25, 0.75, 2.828427125]),
        (2, [3.0, 7.0, 2.25, 1.25, 0.25, 2.25, 2.5]),
    ] {
        let names = ["", ".bucket", ".start.x_m", ".start.y_m", ".goal.x_m", ".goal.y_m", ".optimal_m"];
        let found = names.map(|name| numbers(row, &format!("problem{name}")));
        assert_eq!(found, known);
    }
    // the first is a straight line of eight cells; the second goes round one end of the wall, which is 1.5 m long
    assert!((numbers(0, "planned_path_m") - 4.0).abs() < 1e-9);
    let round = numbers(1, "planned_path_m");
    assert!(round > 2.0 * motion_lab::num::hypot(0.75, 0.5) && round < 2.6, "{round}");
    for row in [0, 1] {
        assert_eq!((rows[row]("failure"), rows[row]("contacts")), (String::new(), "0".into()));
        assert!((numbers(row, "Rusty.end.x_m") - numbers(row, "problem.goal.x_m")).abs() < 0.05);
        assert!((numbers(row, "Rusty.end.y_m") - numbers(row, "problem.goal.y_m")).abs() < 0.05);
    }
    assert!(rows[2]("failure").starts_with("the start would overlap box "), "{}", rows[2]("failure"));
    assert_eq!(rows[2]("failure_kind"), "no-problem");
    run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "1", "-o", "again.mcap"]).done();
    run_in(at, &["verify", "again.mcap"]).done();
    // what the study cannot be is said where it names the scenario
    fs::remove_file(at.join("m.map.scen")).unwrap();
    let missing = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(missing.contains("plan.ron:3:") && missing.contains("m.map.scen"), "{missing}");
    fs::write(at.join("m.map.scen"), SCENARIO.replace("\t9\t5\t", "\t9\t6\t")).unwrap();
    let other = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(other.contains("m.map.scen: 9 x 6 cells do not fill the world's bounds, 4.5 x 2.5 m"), "{other}");
}

/// Pairs in the Apartment, and mazes of which two are closed.
const FILE: &str = "Problems(version: 1, sets: [
    Crossed(name: \"rooms\", world: \"apartment\", robot: \"Rusty\", starts: [[1.5, 5.75]], goals: [[4, 2], [1.7, 5.75]]),
    Generated(of: Maze(columns: 3, rows: 3), count: 2, seed: 4),
    Generated(name: \"shut\", of: Maze(columns: 3, rows: 3, closed: true), count: 2)])";

const FILED: &str = "Sweep(version: 1, planner: (iterations: 2000),
    goal: (robot: \"Rusty\", at: [0, 0, 0], within: [0.1, 0.1, 4]),
    axes: [(vary: \"planner\", over: Names([\"rrt-connect\", \"prm\"])),
        (vary: \"problem\", over: Problems(\"sub/p.ron\")), (vary: \"seed\", over: Range(3, 5))])";

#[test]
fn every_problem_of_a_problem_file_is_a_row_with_the_path_of_the_comparison() {
    let folder = folder_with(FILED);
    let at = folder.path();
    fs::create_dir(at.join("sub")).unwrap();
    fs::write(at.join("sub/p.ron"), FILE).unwrap();
    let swept = run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    assert!(swept.contains("24 runs, 24 of them made now; 8 failed, of which 8 without a run"), "{swept}");
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    let of_sweep = fs::read_to_string(at.join("all.csv")).unwrap();
    let compare = ["plan", "--compare", "rrt-connect,prm", "--problems", "sub/p.ron", "--iterations", "2000"];
    run_in(at, &[&compare[..], &["--seeds", "3..5", "--csv", "rows.csv"]].concat()).done();
    let of_comparison = fs::read_to_string(at.join("rows.csv")).unwrap();
    let (swept, compared) = (rows(&of_sweep), rows(&of_comparison));
    assert_eq!((swept.len(), compared.len()), (24, 24));
    let mut solved = 0;
    for (row, attempt) in swept.iter().zip(&compared) {
        for (name, other) in [
            ("planner", "planner"),
            ("seed", "seed"),
            ("problem", "problem"),
            ("problem.set", "set"),
            ("problem.known", "known"),
            ("iterations", "iterations"),
            ("edges", "edges"),
            ("planned_path_m", "length_m"),
            ("planned_clearance_m", "clearance_m"),
        ] {
            assert_eq!(row(name), attempt(other), "{name} of problem {}", row("problem"));
        }
        assert_eq!(row("solved") == "1", attempt("solved") == "true");
        solved += usize::from(row("solved") == "1");
    }
    assert_eq!(solved, 16, "all but those of closed mazes");
    let report = run_in(at, &["sweep", "report", "all.parquet", "-o", "-"]).done();
    assert!(report.contains("By problem.set") && report.contains(">shut<"), "{}", &report[..2000]);
    run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "5"]).done();
    // with a length the path is played in the problem's own world
    fs::write(at.join("plan.ron"), FILED.replace("planner: (", "ticks: Planned, planner: (")).unwrap();
    let played = run_in(at, &["sweep", "plan.ron", "-o", "played", "--shard", "1/4"]).done();
    assert!(played.contains("6 runs, 6 of them made now; none failed"), "{played}");
    fs::write(at.join("sub/p.ron"), FILE.replace("count: 2", "count: 0")).unwrap();
    let refused = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(refused.contains("plan.ron:4:") && refused.contains("sub/p.ron:3:5: sets[1]"), "{refused}");
}
