//! Maps and scenarios of the MovingAI benchmarks.

use motion_lab_core::geometry::{Aabb, Point2, Pose2};
use motion_lab_import::{CellStyle, MapCell, Scenario, movingai};

use crate::{assert_prints_as_itself, corners, is_hit, sample};

#[test]
fn a_movingai_map_becomes_walls_with_the_first_row_on_top() {
    let map = movingai("yard.map", &sample("yard.map"), 2.0).unwrap();
    let world = map.world("yard.map", "yard", CellStyle::Hollow).unwrap().world;
    let names: Vec<&str> = world.obstacles.iter().map(|o| o.name.as_str()).collect();
    // around the yard, the trees (rows 2 and 3), the water (row 2), and inside
    assert_eq!(names, ["wall 1", "wall 2", "wall 3", "wall 4"]);
    assert_eq!(corners(&world, "wall 1"), [(0.0, 0.0), (20.0, 0.0), (20.0, 12.0), (0.0, 12.0)]);
    let trees = [(6.0, 4.0), (8.0, 4.0), (8.0, 6.0), (10.0, 6.0), (10.0, 8.0), (6.0, 8.0)];
    assert_eq!(corners(&world, "wall 2"), trees);
    assert_eq!(corners(&world, "wall 3"), [(12.0, 4.0), (14.0, 4.0), (14.0, 6.0), (12.0, 6.0)]);
    assert!(is_hit(&world, 13.0, 4.0) && !is_hit(&world, 15.0, 5.0), "water blocks, ground and swamp do not");
    assert_prints_as_itself(&world);
}

#[test]
fn movingai_maps_that_are_none_are_refused() {
    let refuse = |from: &str, to: &str| {
        let text = sample("yard.map");
        assert!(text.contains(from), "{from}");
        movingai("y.map", &text.replacen(from, to, 1), 1.0).unwrap_err().to_string()
    };
    assert!(refuse("type octile", "type hexagon").starts_with("y.map:1: type: hexagon: it must be octile"));
    assert!(refuse("type octile", "octile").starts_with("y.map:1: octile: it must be the head"));
    assert_eq!(refuse("height 6", "height 0"), "y.map:2: height: 0: it must be a whole number from 1 on");
    assert_eq!(refuse("width 10", "width ten"), "y.map:3: width: ten: it must be a whole number from 1 on");
    assert!(refuse("width 10", "width 99999999999").contains("cells: at most 16777216"));
    assert_eq!(refuse("WGS", "WXS"), "y.map:8: column 8: 'X': it must be one of . G S E @ O T W");
    assert_eq!(refuse("..TT..", "..TT."), "y.map:7: 9 signs: the head of the file tells 10");
    assert_eq!(refuse("height 6", "height 7"), "y.map: 6 rows: the head of the file tells 7");
    assert_eq!(refuse("height 6", "height 5"), "y.map: 6 rows: the head of the file tells 5");
    assert_eq!(movingai("y.map", "type octile\n", 1.0).unwrap_err().to_string(), "y.map: `height` is missing");
    assert_eq!(movingai("y.map", "height 1\nwidth 2", 1.0).unwrap_err().to_string(), "y.map: `map` is missing");
    for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-4] {
        assert!(movingai("y.map", &sample("yard.map"), resolution).unwrap_err().to_string().contains("resolution"));
    }
    assert_eq!(refuse("height 6", "height 6\nheight 6").split(": it must").next(), Some("y.map:3: height 6"));
    assert_eq!(refuse("height 6\n", ""), "y.map:3: `height` is missing");
    assert_eq!(refuse("map\n", "map 3\n").split(": it must").next(), Some("y.map:4: map 3"));
}

#[test]
fn heads_may_lack_the_type_and_have_tabs_and_another_order() {
    let yard = movingai("y.map", &sample("yard.map"), 1.0).unwrap();
    for (from, to) in [
        ("type octile\n", ""),
        ("height 6\nwidth 10", "width\t10\nheight\t6"),
        ("type octile\nheight 6", "\n  height   6\n type\toctile"),
        ("\n", "\r\n"),
        ("\n", "\r"),
    ] {
        let text = sample("yard.map");
        assert!(text.contains(from), "{from}");
        assert_eq!(movingai("y.map", &text.replace(from, to), 1.0).unwrap(), yard, "{to:?}");
    }
}

/// By the formats of the League of Robot Runners, whose warehouses have emitters `E` and service points `S`.
#[test]
fn robots_pass_the_places_of_a_warehouse() {
    let map = movingai("w.map", "type octile\nheight 1\nwidth 5\nmap\nE@SET\n", 1.0).unwrap();
    let occupied: Vec<bool> = (0..5).map(|column| map.grid.is_occupied(column, 0)).collect();
    assert_eq!(occupied, [false, true, false, false, true]);
}

#[test]
fn a_map_without_obstacles_is_a_world_without_them() {
    let map = movingai("y.map", "type octile\nheight 1\nwidth 2\nmap\n.G\n", 3.0).unwrap();
    for style in [CellStyle::Solid, CellStyle::Hollow] {
        let imported = map.world("y.map", "y", style).unwrap();
        assert!(imported.world.obstacles.is_empty());
        assert_eq!(imported.notes, ["no cell of the map is an obstacle"]);
        assert_eq!(imported.world.bounds.max, Point2::new(6.0, 3.0));
        assert_prints_as_itself(&imported.world);
    }
}

const PROBLEMS: &str = "version 1\n0\tyard.map\t10\t6\t1\t1\t8\t4\t8.24264069\n1\tyard.map\t10\t6\t5\t2\t1\t4\t5.5\n";

#[test]
fn a_scenario_puts_starts_and_goals_into_the_middles_of_their_cells() {
    let scenario = Scenario::parse("s.scen", PROBLEMS).unwrap();
    assert_eq!((scenario.map.as_str(), scenario.width, scenario.height), ("yard.map", 10, 6));
    let second = &scenario.problems[1];
    assert_eq!(
        (second.line, second.bucket, second.start, second.goal, second.length),
        (3, 1, MapCell { x: 5, y: 2 }, MapCell { x: 1, y: 4 }, 5.5)
    );
    let map = movingai("yard.map", &sample("yard.map"), 2.0).unwrap();
    let mut yard = map.world("yard.map", "yard", CellStyle::Solid).unwrap();
    scenario.put_places("s.scen", [10, 6], 2.0, &mut yard).unwrap();
    let place = |name: &str| yard.world.place(name).unwrap().pose;
    // (x + 0.5, 6 - y - 0.5) cells of 2 m
    assert_eq!(place("start 1"), Pose2::new(3.0, 9.0, 0.0));
    assert_eq!(place("goal 1"), Pose2::new(17.0, 3.0, 0.0));
    assert_eq!(place("start 2"), Pose2::new(11.0, 7.0, 0.0));
    assert_eq!(place("goal 2"), Pose2::new(3.0, 3.0, 0.0));
    assert_prints_as_itself(&yard.world);
    // every middle lies on the sign of its own row and column
    let signs: Vec<Vec<char>> = sample("yard.map").lines().skip(4).map(|row| row.chars().collect()).collect();
    for (y, row) in signs.iter().enumerate() {
        for (x, sign) in row.iter().enumerate() {
            let middle = scenario.pose(MapCell { x: x as u64, y: y as u64 }, 2.0);
            assert_eq!(is_hit(&yard.world, middle.x, middle.y), "@OTW".contains(*sign), "({x}, {y})");
        }
    }
    let error = scenario.put_places("s.scen", [10, 7], 2.0, &mut yard).unwrap_err().to_string();
    assert_eq!(error, "s.scen: 10 x 6 cells: the map has 10 x 7");
}

#[test]
fn the_worlds_bounds_say_how_large_a_cell_is() {
    let scenario = Scenario::parse("s.scen", PROBLEMS).unwrap();
    for scale in [0.25, 0.1, 1.0, 3.7] {
        let map = movingai("yard.map", &sample("yard.map"), scale).unwrap();
        let bounds = map.world("yard.map", "yard", CellStyle::Solid).unwrap().world.bounds;
        let found = scenario.metres_per_cell("s.scen", &bounds).unwrap();
        assert!((found - scale).abs() < 1e-15, "{found}");
    }
    let other = Aabb::new(Point2::new(1.0, 1.0), Point2::new(11.0, 8.0));
    let error = scenario.metres_per_cell("s.scen", &other).unwrap_err().to_string();
    assert_eq!(error, "s.scen: 10 x 6 cells do not fill the world's bounds, 10 x 7 m");
}

#[test]
fn a_scenario_prints_as_itself() {
    let scenario = Scenario::parse("s.scen", PROBLEMS).unwrap();
    assert_eq!(scenario.to_text(), PROBLEMS);
    assert_eq!(Scenario::parse("s.scen", &scenario.to_text()).unwrap(), scenario);
}

#[test]
fn scenarios_are_read_in_their_several_forms_and_refused_by_line() {
    let read = |from: &str, to: &str| {
        assert!(PROBLEMS.contains(from), "{from}");
        Scenario::parse("s.scen", &PROBLEMS.replacen(from, to, 1))
    };
    let plain = read("version", "version").unwrap();
    for (from, to) in [("version 1", "version 1.0"), ("\t8.24", " \t 8.24"), ("version 1\n", "")] {
        assert_eq!(
            Scenario { problems: vec![], ..read(from, to).unwrap() },
            Scenario { problems: vec![], ..plain.clone() }
        );
    }
    assert_eq!(Scenario::parse("s.scen", &PROBLEMS.replace('\n', "\r")).unwrap(), plain);
    let blanks = Scenario::parse("s.scen", &PROBLEMS.replace('\t', " ").replace('\n', "\r\n")).unwrap();
    assert_eq!(blanks, plain);
    let refused = |from: &str, to: &str| read(from, to).unwrap_err().to_string();
    assert_eq!(refused("version 1", "version 2"), "s.scen:1: version: 2: it must be 1");
    assert!(refused("\t8.24264069", "").starts_with("s.scen:2: 8 columns: there must be 9: bucket, map"));
    assert_eq!(
        refused("\t8\t4", "\t10\t4"),
        "s.scen:2: goal: cell (10, 4) of 10 x 6: it must be on the map; x and y count from 0"
    );
    assert_eq!(refused("\t1\t1", "\t1\t-1"), "s.scen:2: start y: -1: it must be a whole number");
    assert_eq!(refused("\n1\tyard", "\nfirst\tyard"), "s.scen:3: bucket: first: it must be a whole number");
    assert_eq!(refused("5.5", "far"), "s.scen:3: length: far: it must be a finite number from 0 on");
    assert!(refused("1\tyard.map", "1\tother.map").starts_with("s.scen:3: map: not supported: other.map"));
    assert_eq!(Scenario::parse("s.scen", "version 1\n").unwrap_err().to_string(), "s.scen: `a problem` is missing");
    let many = "0 m 1 1 0 0 0 0 0\n".repeat(50_001);
    assert_eq!(
        Scenario::parse("s.scen", &many).unwrap_err().to_string(),
        "s.scen:50001: not supported: more than 50000 problems"
    );
}
