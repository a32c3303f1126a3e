//! ROS maps and MovingAI maps.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Footprint, Point2, Vector2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::{Grid, ObstacleKind, World};
use motion_lab_import::{CellStyle, ImportError, OccupancyMap, RosMap, Unknown, movingai};

use crate::{assert_prints_as_itself, corners, is_hit, sample};

/// The note about a hollow world.
const HOLLOW: &str = "the occupied cells are hollow: a robot put inside their walls touches nothing";

fn room(unknown: Unknown) -> OccupancyMap {
    let map = RosMap::parse("room.yaml", &sample("room.yaml")).unwrap();
    assert_eq!(map.image, "room.pgm");
    map.cells("room.pgm", sample("room.pgm").as_bytes(), unknown).unwrap()
}

#[test]
fn a_ros_map_becomes_the_borders_of_its_occupied_cells() {
    let imported = room(Unknown::Free).world("room.yaml", "Room", CellStyle::Hollow).unwrap();
    let world = imported.world;
    assert_eq!(imported.notes, ["unknown cells, taken as free: 1", HOLLOW]);
    let names: Vec<&str> = world.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["wall 1", "wall 2", "wall 3"]);
    // 12 x 8 cells of 0.5 m from (-1, -2) on; the walls are the outside, the block over columns 4, 5 and rows 3, 4, and
    // the inside
    assert_eq!(corners(&world, "wall 1"), [(-1.0, -2.0), (5.0, -2.0), (5.0, 2.0), (-1.0, 2.0)]);
    let mut inside = corners(&world, "wall 3");
    inside.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(inside, [(-0.5, -1.5), (-0.5, 1.5), (4.5, -1.5), (4.5, 1.5)]);
    assert_eq!(corners(&world, "wall 2"), [(1.0, -0.5), (2.0, -0.5), (2.0, 0.5), (1.0, 0.5)]);
    assert_eq!((world.bounds.min, world.bounds.max), (Point2::new(-1.0, -2.0), Point2::new(5.0, 2.0)));
    assert!(is_hit(&world, 1.5, 0.5) && is_hit(&world, 4.5, 0.0) && !is_hit(&world, 0.0, 0.0));
    assert!(!is_hit(&world, 3.75, -0.75), "the unknown cell was to be free");
    assert_prints_as_itself(&world);
}

#[test]
fn what_is_unknown_is_occupied_unless_said_otherwise() {
    let imported = room(Unknown::default()).world("room.yaml", "Room", CellStyle::Hollow).unwrap();
    // column 9, row 2
    assert_eq!(corners(&imported.world, "wall 2"), [(3.5, -1.0), (4.0, -1.0), (4.0, -0.5), (3.5, -0.5)]);
    assert_eq!(imported.notes, ["unknown cells, taken as occupied: 1", HOLLOW]);
    let solid = room(Unknown::default()).world("room.yaml", "Room", CellStyle::default()).unwrap();
    assert_eq!(solid.notes, ["unknown cells, taken as occupied: 1"]);
    assert!(is_hit(&solid.world, 3.75, -0.75), "the middle of the unknown cell");
    assert_eq!(solid.world, room(Unknown::Occupied).world("room.yaml", "Room", CellStyle::Solid).unwrap().world);
}

/// yaml-cpp, with which Nav2 reads, takes the first of them and PyYAML the last: neither is what the file says.
#[test]
fn a_key_that_stands_in_a_ros_map_twice_is_refused_by_name_and_line() {
    let text = format!("{}negate: 0\n", sample("room.yaml"));
    let error = RosMap::parse("room.yaml", &text).unwrap_err().to_string();
    assert_eq!(error, format!("room.yaml:{}: negate: the key stands there twice", text.lines().count()));
}

#[test]
fn what_map_saver_writes_for_unknown_and_the_thresholds_call_free_is_said() {
    // with 0.25, which map_saver of ROS 2 writes, the cell of degree 50 / 255 is free
    let map = RosMap::parse("room.yaml", &sample("room.yaml").replace("0.196", "0.25")).unwrap();
    let cells = |unknown| map.cells("room.pgm", sample("room.pgm").as_bytes(), unknown).unwrap();
    let by_thresholds = cells(Unknown::ByThresholds);
    let note = "1 cell of 205, which map_saver writes for unknown, is free by free_thresh 0.25";
    assert_eq!(by_thresholds.notes, [note]);
    assert!(!by_thresholds.grid.is_occupied(9, 2) && by_thresholds.grid.is_occupied(4, 3));
    let occupied = cells(Unknown::Occupied);
    assert_eq!(occupied.notes, ["unknown cells, taken as occupied: 1"]);
    assert!(occupied.grid.is_occupied(9, 2) && occupied.grid.is_occupied(4, 3) && !occupied.grid.is_occupied(9, 3));
    let free = cells(Unknown::Free);
    assert!(free.notes.is_empty() && free.grid == by_thresholds.grid);
}

#[test]
fn boxes_are_solid_and_cover_the_cells_once() {
    let world = room(Unknown::Free).world("room.yaml", "Room", CellStyle::Solid).unwrap().world;
    assert!(world.obstacles.iter().all(|o| o.kind == ObstacleKind::Solid));
    let area: f64 = world
        .obstacles
        .iter()
        .flat_map(|o| o.placed().collect::<Vec<_>>())
        .map(|p| (p.bounds().max.x - p.bounds().min.x) * (p.bounds().max.y - p.bounds().min.y))
        .sum();
    // 2 * 12 + 2 * 6 cells of the border and 4 of the block
    assert_eq!(area, 40.0 * 0.25);
    // a ring is four boxes and the block one
    assert_eq!(world.obstacles.len(), 5);
    assert!(is_hit(&world, 1.5, 0.0), "the inside of the block");
    assert_prints_as_itself(&world);
}

#[test]
fn a_turned_map_is_turned_about_its_lower_left_corner() {
    let text = sample("room.yaml").replace("[-1.0, -2.0, 0.0]", "[3, 1, 1.5707963267948966]");
    let cells = RosMap::parse("room.yaml", &text).unwrap();
    let cells = cells.cells("room.pgm", sample("room.pgm").as_bytes(), Unknown::Free).unwrap();
    for style in [CellStyle::Hollow, CellStyle::Solid] {
        let world = cells.world("room.yaml", "Room", style).unwrap().world;
        // a quarter turn to the left: (x, y) in the map goes to (3 - y, 1 + x)
        for (x, y) in [(2.0, 2.0), (3.0, 1.5), (0.5, 3.5), (5.5, 2.0)] {
            assert!(is_hit(&world, 3.0 - y, 1.0 + x), "{style:?} ({x}, {y})");
        }
        assert!(!is_hit(&world, 3.0 - 1.0, 1.0 + 1.0));
        let (min, max) = (world.bounds.min, world.bounds.max);
        for (found, expected) in [(min.x, -1.0), (min.y, 1.0), (max.x, 3.0), (max.y, 7.0)] {
            assert!((found - expected).abs() < 1e-12, "{min} {max}");
        }
        assert_prints_as_itself(&world);
    }
}

/// Which cells of a map of one row are obstacles where unknown ones are free, and where they are occupied; the notes of
/// the first.
fn row(more: &str, shades: &[u8]) -> (Vec<bool>, Vec<bool>, Vec<String>) {
    let text = format!("image: x\nresolution: 1\norigin: [0, 0, 0]\n{more}");
    let mut image = format!("P5 {} 1 255\n", shades.len()).into_bytes();
    image.extend(shades);
    let cells = |unknown| RosMap::parse("x.yaml", &text).unwrap().cells("x", &image, unknown).unwrap();
    let occupied = |map: &OccupancyMap| (0..map.grid.columns()).map(|c| map.grid.is_occupied(c, 0)).collect();
    let (free, taken) = (cells(Unknown::Free), cells(Unknown::ByThresholds));
    (occupied(&free), occupied(&taken), free.notes)
}

#[test]
fn negate_and_raw_turn_the_shades_round() {
    let shades = [0, 50, 100, 255];
    let of = |more: &str| {
        let (free, taken, notes) = row(more, &shades);
        (free, taken, notes.len())
    };
    // degrees 1, 205/255, 155/255 (unknown), 0
    assert_eq!(of(""), (vec![true, true, false, false], vec![true, true, true, false], 1));
    // degrees 0, 50/255 (unknown), 100/255 (unknown), 1
    assert_eq!(of("negate: 1"), (vec![false, false, false, true], vec![false, true, true, true], 1));
    // costs 0, 50, 100, unknown, whatever the thresholds and negate
    let raw = (vec![false, false, true, false], vec![false, false, true, true], 2);
    for more in ["mode: raw", "mode: raw\noccupied_thresh: 0.5", "mode: Raw\nnegate: 1\nfree_thresh: 0"] {
        assert_eq!(of(more), raw, "{more}");
    }
    assert_eq!(row("mode: raw", &[99, 100, 101, 128, 205]).0, [false, true, false, false, false]);
}

#[test]
fn a_shade_at_a_threshold_itself_is_free_or_occupied() {
    // with negate the degrees are 51/255 = 0.2, 52/255, 152/255, 153/255 = 0.6
    let (free, taken, _) = row("negate: 1\nfree_thresh: 0.2\noccupied_thresh: 0.6", &[51, 52, 152, 153]);
    assert_eq!((free, taken), (vec![false, false, false, true], vec![false, true, true, true]));
    // at both at once it is free
    assert_eq!(row("negate: 1\nfree_thresh: 0.2\noccupied_thresh: 0.2", &[50, 51, 52]).1, [false, false, true]);
    // at the ends of all degrees only white is free and only black occupied
    let ends = "occupied_thresh: 1.0\nfree_thresh: 0.0";
    assert_eq!(row(ends, &[255, 254, 1, 0]).0, [false, false, false, true]);
    assert_eq!(row(ends, &[255, 254, 1, 0]).1, [false, true, true, true]);
    let ends = format!("{ends}\nnegate: 1");
    assert_eq!(row(&ends, &[255, 254, 1, 0]).0, [true, false, false, false]);
}

#[test]
fn scale_gives_costs_of_which_only_a_hundred_is_an_obstacle() {
    let scale = "mode: scale\noccupied_thresh: 1.0\nfree_thresh: 0.0";
    // degrees 0, 127/255 (cost 50), 1, 253/255 (cost 99), 254/255 (cost 99.6, hence 100), 1/255 (cost 0.4, hence 0)
    let (free, taken, notes) = row(scale, &[255, 128, 0, 2, 1, 254]);
    assert_eq!(free, [false, false, true, false, true, false]);
    assert_eq!(taken, free, "nothing of it is unknown");
    assert_eq!(notes, ["2 cells with a cost of 1 to 99 are free: a cell is an obstacle at 100"]);
    // 205 between the thresholds has a cost, too
    let (_, taken, notes) = row("mode: Scale", &[205, 0]);
    assert_eq!((taken, notes.len()), (vec![false, true], 0), "50/255 is 0.02 percent above 0.196, of a cost of 0");
}

#[test]
fn heads_are_read_as_other_programs_write_them() {
    let head = |from: &str, to: &str| {
        let text = sample("room.yaml");
        assert!(text.contains(from), "{from}");
        RosMap::parse("r.yaml", &text.replace(from, to)).unwrap()
    };
    let plain = head("negate: 0", "negate: 0");
    for same in [
        "negate: False",
        "negate: no",
        "negate: 'false'",
        "negate: OFF",
        "negate: \"0\"",
        "negate: 0\nmode: TRINARY",
        "negate: 0\nmode: 'Trinary'",
        "",
    ] {
        assert_eq!(head("negate: 0", same), plain, "{same}");
    }
    assert_eq!(head("resolution: 0.5", "resolution: \"0.5\""), plain);
    assert_eq!(head("[-1.0, -2.0, 0.0]", "['-1.0', -2., +0]"), plain);
    for negated in ["negate: 1", "negate: True", "negate: yes", "negate: 2"] {
        assert!(head("negate: 0", negated).negate, "{negated}");
    }
    let others = head("negate: 0", "negate: 0\nname: my_map\nframe_id: map");
    let notes = ["name in line 6 says nothing of the map", "frame_id in line 7 says nothing of the map"];
    assert_eq!(others.notes, notes);
    assert_eq!(RosMap { notes: vec![], ..others }, plain);
}

#[test]
fn a_map_far_out_has_its_own_corner_as_origin() {
    let far = |origin: &str| {
        let text = sample("room.yaml").replace("[-1.0, -2.0, 0.0]", origin);
        let map = RosMap::parse("r.yaml", &text).unwrap();
        map.cells("r.pgm", sample("room.pgm").as_bytes(), Unknown::Free).unwrap()
    };
    let home = far("[0, 0, 0]");
    // national grids, and 6 x 4 m that begin just inside 10 km
    for (origin, corner) in [
        ("[431000.0, 4582000.0, 0.0]", "(431000, 4582000)"),
        ("[9999, 0, 0]", "(9999, 0)"),
        ("[0, -10000.5, 0]", "(0, -10000.5)"),
    ] {
        let map = far(origin);
        assert_eq!((&map.grid, map.frame), (&home.grid, home.frame), "{origin}");
        let note = format!("the map reaches beyond 10000 m: its lower left corner, {corner}, is the world's origin");
        assert_eq!(map.notes[1..], [note]);
        map.world("r.yaml", "Room", CellStyle::Solid).unwrap();
    }
    let near = far("[9994, 0, 0]");
    assert!(near.notes.len() == 1 && near.grid != home.grid, "this one ends at 10 km");
    near.world("r.yaml", "Room", CellStyle::Solid).unwrap();
    // a quarter turn: the map reaches 4 m to the left of its corner
    assert_eq!(far("[-9997, 0, 1.5707963267948966]").frame.position(), Point2::origin());
}

#[test]
fn ros_maps_that_are_none_are_refused() {
    let refuse = |from: &str, to: &str| {
        let text = sample("room.yaml");
        assert!(text.contains(from), "{from}");
        let map = RosMap::parse("r.yaml", &text.replace(from, to));
        map.and_then(|map| map.cells("r.pgm", sample("room.pgm").as_bytes(), Unknown::Free)).unwrap_err().to_string()
    };
    assert_eq!(refuse("resolution: 0.5\n", ""), "r.yaml:2: `resolution` is missing");
    assert_eq!(refuse("0.5\n", "half\n"), "r.yaml:3: resolution: half: it must be a finite number");
    assert!(refuse("0.5\n", ".nan\n").starts_with("r.yaml:3: resolution: .nan"));
    assert!(refuse("0.5\n", "0\n").contains("resolution: 0: it must be a cell's size"));
    assert!(refuse("0.5\n", "1e-9\n").contains("resolution"));
    assert!(refuse("[-1.0, -2.0, 0.0]", "[-1.0, -2.0]").starts_with("r.yaml:4: origin: 2 of them: it must be three"));
    assert!(refuse("[-1.0, -2.0, 0.0]", "[0, .inf, 0]").starts_with("r.yaml:4: origin: .inf"));
    assert!(refuse("0.65", "0.1").contains("free_thresh"));
    assert_eq!(refuse("negate: 0", "negate: perhaps"), "r.yaml:5: negate: perhaps: it must be 0 or 1, false or true");
    assert!(refuse("negate: 0", "mode: loud").starts_with("r.yaml:5: mode: loud"));
    assert!(refuse("negate: 0", "negate: [").starts_with("r.yaml:"));
    let cut = |bytes: usize| {
        let image = sample("room.pgm");
        let map = RosMap::parse("r.yaml", &sample("room.yaml")).unwrap();
        map.cells("r.pgm", &image.as_bytes()[..bytes], Unknown::Free).unwrap_err().to_string()
    };
    assert!(cut(300).starts_with("r.pgm: ") && cut(300).contains("pixels: the head of the file tells 96"));
    assert!(cut(3).contains("`width` is missing"));
}

#[test]
fn an_exported_map_comes_back_cell_for_cell() {
    for (world, resolution) in [(World::apartment(), 0.05), (World::lot(), 0.1), (World::workbench(), 0.0371)] {
        let grid = Grid::rasterize(&world, resolution).unwrap();
        let files = grid.ros_map("it's \"one\" \\ map: #1.pgm");
        let map = RosMap::parse("m.yaml", &files.yaml).unwrap();
        assert_eq!(map.image, "it's \"one\" \\ map: #1.pgm");
        let cells = map.cells("m.pgm", &files.image, Unknown::Occupied).unwrap();
        assert_eq!(cells.grid, grid, "{}: origin, resolution and every cell", world.name);
        assert!(cells.notes.is_empty());
        for (style, check) in
            [(CellStyle::Solid, assert_solid as fn(&Grid, &World)), (CellStyle::Hollow, assert_borders)]
        {
            let again = cells.world("m.yaml", &world.name, style).unwrap().world;
            assert_prints_as_itself(&again);
            check(&grid, &again);
        }
        // a map made again loses no cell: it has the occupied cells and, besides them, exactly the cells that touch one
        let solid = cells.world("m.yaml", &world.name, CellStyle::Solid).unwrap().world;
        let twice = Grid::rasterize(&solid, resolution).unwrap();
        assert_eq!((twice.columns(), twice.rows()), (grid.columns(), grid.rows()));
        let at =
            |column: u32, row: u32| (column < grid.columns() && row < grid.rows()) && grid.is_occupied(column, row);
        for (column, row) in (0..grid.rows()).flat_map(|row| (0..grid.columns()).map(move |column| (column, row))) {
            let beside =
                (0..3).any(|i| (0..3).any(|k| column + i >= 1 && row + k >= 1 && at(column + i - 1, row + k - 1)));
            assert_eq!(twice.is_occupied(column, row), beside, "{}: cell ({column}, {row})", world.name);
        }
    }
}

/// Checks that every occupied cell is solid and every other one free, at its middle and at four points near its
/// corners.
fn assert_solid(grid: &Grid, world: &World) {
    let scene = Scene::of_world(world);
    let inside = 0.49 * grid.resolution();
    for (column, row) in (0..grid.rows()).flat_map(|row| (0..grid.columns()).map(move |column| (column, row))) {
        let middle = grid.centre(column, row);
        for (x, y) in [(0.0, 0.0), (inside, inside), (-inside, inside), (inside, -inside), (-inside, -inside)] {
            let hit = scene.intersects(&Footprint::disc(middle + Vector2::new(x, y), 1e-6));
            assert_eq!(hit, grid.is_occupied(column, row), "cell ({column}, {row}), ({x}, {y}) from its middle");
        }
    }
}

/// Checks that the walls lie along the grid's borders: a ray from a cell's middle to the right crosses walls an odd
/// number of times exactly when the cell is occupied.
fn assert_borders(grid: &Grid, world: &World) {
    for row in 0..grid.rows() {
        let y = grid.centre(0, row).y;
        let placed = world.obstacles.iter().flat_map(|o| o.placed().collect::<Vec<_>>());
        let crossings: Vec<f64> = placed
            .map(|p| (p.core()[0], p.core()[1]))
            .filter(|(a, b)| (a.y > y) != (b.y > y))
            .map(|(a, b)| {
                assert_eq!(a.x, b.x, "borders run along the grid");
                a.x
            })
            .collect();
        for column in 0..grid.columns() {
            let x = grid.centre(column, row).x;
            let right = crossings.iter().filter(|c| **c > x).count();
            assert_eq!(right % 2 == 1, grid.is_occupied(column, row), "cell ({column}, {row})");
        }
    }
}

#[test]
fn random_maps_keep_every_cell() {
    let mut s = Stream::new(Seed(11), "maps");
    for round in 0..40 {
        let (columns, rows) = (1 + s.below(30), 1 + s.below(30));
        let mut text = format!("type octile\nheight {rows}\nwidth {columns}\nmap\n");
        for _ in 0..rows {
            text.extend((0..columns).map(|_| ['.', 'G', 'S', '@', 'O', 'T', 'W'][s.below(7) as usize]));
            text.push('\n');
        }
        let map = movingai("random.map", &text, 0.1).unwrap();
        let world = |style| map.world("random.map", "Random", style).map(|imported| imported.world);
        let (hollow, solid) = (world(CellStyle::Hollow).unwrap(), world(CellStyle::default()).unwrap());
        assert_borders(&map.grid, &hollow);
        assert_solid(&map.grid, &solid);
        assert_prints_as_itself(&hollow);
        assert_prints_as_itself(&solid);
        let signs: Vec<&str> = text.lines().skip(4).collect();
        for row in 0..rows {
            for (column, sign) in signs[(rows - 1 - row) as usize].chars().enumerate() {
                assert_eq!(map.grid.is_occupied(column as u32, row as u32), "@OTW".contains(sign), "round {round}");
            }
        }
    }
}

#[test]
fn more_obstacles_than_a_world_holds_are_refused() {
    // a chessboard of 448 x 448: 100,352 cells that touch in corners only, a piece each, more than a world may have
    let row = |odd: bool| if odd { "@.".repeat(224) } else { ".@".repeat(224) };
    let rows: Vec<String> = (0..448).map(|r| row(r % 2 == 1)).collect();
    let text = format!("type octile\nheight 448\nwidth 448\nmap\n{}\n", rows.join("\n"));
    let map = movingai("board.map", &text, 0.1).unwrap();
    for style in [CellStyle::Hollow, CellStyle::Solid] {
        let error: ImportError = map.world("board.map", "board", style).unwrap_err();
        assert_eq!(error.to_string(), "board.map: too many shapes: at most 100000", "{style:?}");
    }
}
