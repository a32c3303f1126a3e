use super::site::END_CLEARANCE;
use super::*;
use crate::plans::{PlannerName, Task};
use motion_lab_core::collision::Collision as _;
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _};
use motion_lab_core::geometry::{Point2, Shape};
use motion_lab_core::planning::{Bounds, NoPath};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::Robot as _;
use motion_lab_core::worlds::{Resident, Warehouse, World};

const SEED: Seed = Seed(7);

fn all() -> Vec<ProblemGenerator> {
    let circles = ["rusty", "hitch", "reach", "reach3"]
        .map(|robot| ProblemGenerator::Circles(CircleField { robot: robot.into(), ..CircleField::default() }));
    let passages = ["rusty", "hitch"].map(|robot| {
        let width = if robot == "rusty" { 0.3 } else { 2.2 };
        ProblemGenerator::Passage(NarrowPassage { robot: robot.into(), width, ..NarrowPassage::default() })
    });
    let trips = ["rusty", "hitch"]
        .map(|robot| ProblemGenerator::Warehouse(WarehouseTrip { robot: robot.into(), ..WarehouseTrip::default() }));
    let lots = [false, true].map(|trailer| ProblemGenerator::Parking(ParkingLot { trailer, ..ParkingLot::default() }));
    let maze = [ProblemGenerator::Maze(Maze::default())];
    circles.into_iter().chain(passages).chain(trips).chain(lots).chain(maze).collect()
}

/// Whether a rover has a path, without a tube: one along the corners, or a proof by cells that there is none.
fn decided(task: &Task) -> Option<bool> {
    let task = Task { tube: 0.0, clearance: Some(0.0), ..task.clone() };
    let solve = |planner: PlannerName| {
        let mut attempt = task.attempt(planner, Seed(0)).unwrap();
        attempt.solve(&Bounds::of_iterations(planner.iterations()))
    };
    match solve(PlannerName::VisibilityGraph) {
        Ok(()) => Some(true),
        Err(_) => match solve(PlannerName::CellDecomposition) {
            Ok(()) => Some(true),
            Err(reason) => matches!(reason, NoPath::Unreachable { .. }).then_some(false),
        },
    }
}

fn xy(q: &AnyConfiguration) -> Point2 {
    let q = q.coordinates();
    Point2::new(q[0], q[1])
}

#[test]
fn a_problem_has_its_robot_alone_at_a_start_with_room_and_is_a_world_file() {
    for generator in all() {
        for number in 0..40 {
            let case = format!("{generator:?} {number}");
            let GeneratedProblem { task, .. } = generator.problem(SEED, number).unwrap();
            let [resident] = &task.world.robots[..] else { panic!("{case}: {:?}", task.world.robots) };
            assert_eq!((&resident.name, resident.kind.as_str()), (&task.name, generator.kind()), "{case}");
            assert_eq!((task.robot.kind(), task.robot.title()), (generator.kind(), task.name.as_str()), "{case}");
            assert_eq!(&resident.start[..], &task.start.coordinates()[..], "{case}");
            for q in [task.start, task.goal] {
                assert!(task.robot.like(&q).is_some(), "{case}");
                assert!(task.scene.distance(&task.robot.footprint(&q)) > END_CLEARANCE, "{case}: {q:?}");
                task.world.check_position(generator.kind(), "end", &q.coordinates()).unwrap();
            }
            assert_ne!(task.start, task.goal, "{case}");
            // what is written down is the same world
            assert_eq!(World::parse("made.ron", &task.world.to_ron()).as_ref(), Ok(&*task.world), "{case}");
            assert_eq!(task.world.name, format!("{} {} of seed 7", generator.name(), number + 1));
        }
    }
}

#[test]
fn a_problem_is_a_function_of_generator_seed_and_number() {
    for generator in all() {
        let made = |seed, number| {
            let task = generator.problem(Seed(seed), number).unwrap().task;
            (task.world.obstacles.clone(), task.goal)
        };
        let later = made(7, 3);
        assert_eq!(made(7, 3), later, "{generator:?}");
        assert!(made(8, 3) != later && made(7, 2) != later, "{generator:?}: another one");
    }
}

/// The cells of a maze that a point gets to from the lower left one, by looking at the walls between their middles.
fn flooded(world: &World, maze: &Maze) -> Vec<bool> {
    let (columns, rows) = (maze.columns as i64, maze.rows as i64);
    let walls: Vec<[Point2; 2]> = world
        .obstacles
        .iter()
        .flat_map(|obstacle| &obstacle.pieces)
        .map(|(_, shape)| if let Shape::Segment { a, b } = shape { [*a, *b] } else { panic!("{shape:?}") })
        .collect();
    let is_open = |from: Point2, to: Point2| {
        walls.iter().all(|[a, b]| {
            let side = |p: Point2, q: Point2, r: Point2| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
            side(*a, *b, from) * side(*a, *b, to) > 0.0 || side(from, to, *a) * side(from, to, *b) > 0.0
        })
    };
    let middle = |column: i64, row: i64| Point2::new((column as f64 + 0.5) * maze.cell, (row as f64 + 0.5) * maze.cell);
    let mut seen = vec![false; (columns * rows) as usize];
    let mut open = vec![(0, 0)];
    while let Some((column, row)) = open.pop() {
        if std::mem::replace(&mut seen[(row * columns + column) as usize], true) {
            continue;
        }
        for (c, r) in [(column - 1, row), (column + 1, row), (column, row - 1), (column, row + 1)] {
            let is_cell = (0..columns).contains(&c) && (0..rows).contains(&r);
            if is_cell && is_open(middle(column, row), middle(c, r)) {
                open.push((c, r));
            }
        }
    }
    seen
}

#[test]
fn a_maze_joins_all_its_cells_by_one_way_each_and_a_closed_one_parts_the_goal() {
    for number in 0..40 {
        let maze = Maze { columns: 6, rows: 4, cell: 0.7, closed: false };
        let problem = ProblemGenerator::Maze(maze.clone()).problem(SEED, number).unwrap();
        assert_eq!(problem.has_path, Some(true));
        let world = &problem.task.world;
        assert!(flooded(world, &maze).iter().all(|seen| *seen), "{number}");
        // a tree of 24 cells has 23 of the 38 passages, so 15 sides of a cell are walls
        let length = |(_, shape): &(_, Shape)| match shape {
            Shape::Segment { a, b } => (a.x - b.x).abs() + (a.y - b.y).abs(),
            _ => f64::NAN,
        };
        let inner: f64 = world.obstacles[1..].iter().flat_map(|wall| &wall.pieces).map(length).sum();
        assert!((inner - 15.0 * 0.7).abs() < 1e-9, "{number}: {inner}");
        assert_eq!((xy(&problem.task.start), xy(&problem.task.goal)), ([0.35, 0.35].into(), [3.85, 2.45].into()));
        let closed = ProblemGenerator::Maze(Maze { closed: true, ..maze.clone() }).problem(SEED, number).unwrap();
        assert_eq!(closed.has_path, Some(false));
        let seen = flooded(&closed.task.world, &maze);
        assert!(seen[0] && !seen[23], "{number}");
    }
    // the wall is now here, now there on the way
    let seen = |number| {
        let maze = Maze { columns: 6, rows: 4, cell: 0.7, closed: true };
        let problem = ProblemGenerator::Maze(maze.clone()).problem(SEED, number).unwrap();
        flooded(&problem.task.world, &maze).iter().filter(|seen| **seen).count()
    };
    let counts: std::collections::BTreeSet<usize> = (0..40).map(seen).collect();
    assert!(counts.len() > 8, "{counts:?}");
}

#[test]
fn what_is_known_of_a_path_is_what_cells_prove() {
    let radius = 0.11;
    let passage = |width: f64| {
        let passage = NarrowPassage { width, walls: 2, ..NarrowPassage::default() };
        ProblemGenerator::Passage(passage)
    };
    let maze = |closed: bool| ProblemGenerator::Maze(Maze { columns: 3, rows: 3, closed, ..Maze::default() });
    for number in 0..8 {
        for (generator, known) in [
            (passage(2.0 * radius + 0.005), true),
            (passage(2.0 * radius - 0.1), false),
            (maze(false), true),
            (maze(true), false),
        ] {
            let problem = generator.problem(SEED, number).unwrap();
            assert_eq!(problem.has_path, Some(known), "{generator:?}");
            assert_eq!(decided(&problem.task), Some(known), "{generator:?} {number}");
        }
    }
    let of = |generator: ProblemGenerator| generator.problem(SEED, 0).unwrap().has_path;
    assert_eq!(of(passage(2.0 * radius)), None, "one that is as wide as the rover, but for rounding");
    assert_eq!((of(passage(2.0 * radius + 1e-8)), of(passage(2.0 * radius - 1e-8))), (Some(true), Some(false)));
    let car = |width| ProblemGenerator::Passage(NarrowPassage { robot: "hitch".into(), width, ..Default::default() });
    assert_eq!((of(car(1.69)), of(car(1.7)), of(car(1.8))), (Some(false), None, None), "Hitch is 1.7 m wide");
}

#[test]
fn gaps_are_as_wide_as_they_are_said_to_be() {
    for number in 0..20 {
        let generator = NarrowPassage { width: 0.37, walls: 3, thickness: 0.5, ..NarrowPassage::default() };
        let task = ProblemGenerator::Passage(generator).problem(SEED, number).unwrap().task;
        assert_eq!(task.world.obstacles.len(), 7);
        for pair in task.world.obstacles[1..].chunks(2) {
            let sides = pair.iter().map(|wall| match wall.pieces[0].1 {
                Shape::Rectangle { min, max } => (min, max),
                ref other => panic!("{other:?}"),
            });
            let [(low_min, low_max), (high_min, high_max)] = sides.collect::<Vec<_>>()[..] else { panic!() };
            assert!((high_min.y - low_max.y - 0.37).abs() < 1e-12, "{number}");
            assert_eq!((low_min.y, high_max.y), (0.0, 5.0));
            assert!((low_max.x - low_min.x - 0.5).abs() < 1e-12 && low_min.x == high_min.x && low_max.x == high_max.x);
        }
        // three walls lie between the ends
        assert!(xy(&task.start).x < 3.0 && xy(&task.goal).x > 10.5);
    }
}

#[test]
fn gaps_lie_anywhere_in_their_walls() {
    let gap = |number| {
        let task = ProblemGenerator::Passage(NarrowPassage::default()).problem(SEED, number).unwrap().task;
        match task.world.obstacles[1].pieces[0].1 {
            Shape::Rectangle { max, .. } => max.y,
            ref other => panic!("{other:?}"),
        }
    };
    let lows: Vec<f64> = (0..50).map(gap).collect();
    // from a tenth of the wall to where a gap ends at nine tenths, each third of that with some of them
    assert!(lows.iter().all(|low| (0.5..=4.2).contains(low)), "{lows:?}");
    for third in 0..3 {
        let from = 0.5 + 3.7 / 3.0 * f64::from(third);
        assert!(lows.iter().filter(|low| (from..from + 3.7 / 3.0).contains(*low)).count() > 5, "{lows:?}");
    }
}

#[test]
fn circles_are_as_many_and_as_large_as_suits_the_robot() {
    for (robot, count, radii, size) in [
        ("rusty", 30, 0.2..=0.8, 10.0),
        ("hitch", 30, 0.5..=1.5, 40.0),
        ("reach", 8, 0.1..=0.3, 5.0),
        ("reach3", 8, 0.1..=0.3, 5.0),
    ] {
        for number in 0..20 {
            let field = CircleField { robot: robot.into(), ..CircleField::default() };
            let task = ProblemGenerator::Circles(field).problem(SEED, number).unwrap().task;
            let bounds = task.world.bounds;
            assert_eq!([bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y], [size; 2], "{robot}");
            let circles = task.world.obstacles.iter().filter(|obstacle| obstacle.name.starts_with("circle "));
            let circles: Vec<(Point2, f64)> = circles
                .map(|circle| match circle.pieces[0] {
                    (pose, Shape::Disc { radius }) => (Point2::new(pose.x, pose.y), radius),
                    ref other => panic!("{other:?}"),
                })
                .collect();
            assert_eq!(circles.len(), count, "{robot}");
            assert!(circles.iter().all(|(at, radius)| radii.contains(radius) && bounds.contains(*at)), "{circles:?}");
            if robot.starts_with("reach") {
                // the base, in the middle, is free with room about it
                assert!(circles.iter().all(|(at, radius)| at.coords.norm() > radius + 0.19), "{circles:?}");
            } else {
                let [start, goal] = [task.start, task.goal].map(|q| xy(&q).x / size);
                assert!((0.0..=0.25).contains(&start) && (0.75..=1.0).contains(&goal));
            }
        }
    }
}

#[test]
fn worlds_at_the_ends_of_the_settings_are_world_files() {
    let passage = |width, walls, thickness| {
        ProblemGenerator::Passage(NarrowPassage { width, walls, thickness, ..NarrowPassage::default() })
    };
    let maze = |columns, rows, cell| ProblemGenerator::Maze(Maze { columns, rows, cell, closed: true });
    for generator in [
        passage(0.001, 100, 0.01),
        passage(2.5, 1, 10.0),
        passage(0.12345678901, 100, 0.0123456789),
        maze(2, 2, 0.4),
        maze(200, 3, 0.4),
        maze(3, 200, 10.0),
        maze(7, 7, 0.4567891234),
        ProblemGenerator::Parking(ParkingLot { bay: 2.0, parked: 4, trailer: true }),
        ProblemGenerator::Parking(ParkingLot { bay: 3.2, parked: 0, trailer: false }),
        ProblemGenerator::Circles(CircleField {
            radius: Some((0.001, 0.001)),
            side: Some(1000.0),
            ..Default::default()
        }),
    ] {
        for number in 0..3 {
            let task = generator.problem(SEED, number).unwrap_or_else(|error| panic!("{generator:?}: {error}")).task;
            let read = World::parse("made.ron", &task.world.to_ron());
            assert_eq!(read.as_ref().map_err(ToString::to_string), Ok(&*task.world), "{generator:?}");
        }
    }
}

/// Problems that were published stay what they were, as whoever names a seed and a number expects: a change of these
/// lines makes other problems of every file.
#[test]
fn problems_stay_what_they_were() {
    let pinned = [
        (
            ProblemGenerator::Circles(CircleField::default()),
            "626fffa2671628108a54472c536349e9 0.368,2.072,-0.243 8.89,3.923,0.194",
        ),
        (ProblemGenerator::Maze(Maze::default()), "9a0754d19fb68bde51b4f48749e4ff67 0.5,0.5,2.835 7.5,7.5,0.008"),
        (
            ProblemGenerator::Passage(NarrowPassage::default()),
            "16472d90950a2ae81116d21321f1dbc7 0.872,1.913,-2.515 3.897,3.413,2.687",
        ),
        (
            ProblemGenerator::Parking(ParkingLot::default()),
            "b3987e11f40c63fd17973fc2e864179f 5.597,2.426,0.098 8,8.875,-1.5707963267948966",
        ),
        (
            ProblemGenerator::Warehouse(WarehouseTrip::default()),
            "aadb81f404502174b38e3948b37a800c 7.498,17.817,-0.8395 3,10.947,1.5707",
        ),
    ];
    for (generator, expected) in pinned {
        let task = generator.problem(SEED, 5).unwrap().task;
        let [start, goal] =
            [task.start, task.goal].map(|q| q.coordinates().iter().map(f64::to_string).collect::<Vec<_>>().join(","));
        assert_eq!(format!("{:032x} {start} {goal}", task.world.content_hash()), expected, "{generator:?}");
    }
}

#[test]
fn a_lot_has_its_parked_cars_in_bays_and_the_goal_in_an_empty_one() {
    let mut goals = std::collections::BTreeSet::new();
    for number in 0..40 {
        let few = ProblemGenerator::Parking(ParkingLot { parked: 2, bay: 2.5, ..ParkingLot::default() });
        let few = few.problem(SEED, number).unwrap().task;
        assert_eq!(few.world.obstacles.len(), 3, "the outer wall and two cars");
        assert!([3.0, 5.5, 8.0, 10.5, 13.0].contains(&few.goal.coordinates()[0]), "bays of 2.5 m about the middle");
        for trailer in [false, true] {
            let lot = ParkingLot { trailer, parked: 4, bay: 3.0 };
            let task = ProblemGenerator::Parking(lot).problem(SEED, number).unwrap().task;
            let middles = [2.0, 5.0, 8.0, 11.0, 14.0];
            let parked: Vec<f64> = task.world.obstacles[1..]
                .iter()
                .map(|car| match car.pieces[0].1 {
                    Shape::Rectangle { min, max } => 0.5 * (min.x + max.x),
                    ref other => panic!("{other:?}"),
                })
                .collect();
            let goal = task.goal.coordinates();
            assert_eq!((goal.len(), task.start.coordinates().len()), if trailer { (4, 4) } else { (3, 3) });
            for middle in middles {
                let holds = |x: &f64| (x - middle).abs() < 0.11;
                let cars = parked.iter().filter(|x| holds(x)).count() + usize::from(holds(&goal[0]));
                assert_eq!(cars, 1, "{number}: bay at {middle}: {parked:?} {goal:?}");
            }
            goals.insert((goal[0] * 10.0) as i64);
        }
    }
    assert_eq!(goals.len(), 5, "each bay is the goal of some");
}

#[test]
fn a_trip_through_a_warehouse_goes_from_one_robots_place_to_that_of_another() {
    for robot in ["rusty", "hitch"] {
        let trip = WarehouseTrip { robot: robot.into(), ..WarehouseTrip::default() };
        let task = ProblemGenerator::Warehouse(trip).problem(SEED, 4).unwrap().task;
        // the first bits of the problem's draws are the warehouse's seed
        let seed = Seed(Stream::new(SEED, "problems/warehouse/4").bits());
        let warehouse = Warehouse { seed, robots: 80, trailers: false }.world().unwrap();
        assert_eq!((&task.world.obstacles, task.world.bounds), (&warehouse.obstacles, warehouse.bounds));
        let place = |q: &AnyConfiguration| {
            let is_there = |known: &&Resident| known.kind == robot && known.start[..] == q.coordinates()[..];
            warehouse.robots.iter().find(is_there).unwrap_or_else(|| panic!("{robot}: nobody stands at {q:?}"))
        };
        let [start, goal] = [task.start, task.goal].map(|q| place(&q));
        assert_ne!(start.name, goal.name);
        assert_eq!((&task.world.robots[0].sizes, robot == "hitch"), (&start.sizes, start.sizes.is_some()));
    }
    let one = WarehouseTrip { robot: "hitch".into(), robots: 10, ..WarehouseTrip::default() };
    let refused = ProblemGenerator::Warehouse(one).problem(SEED, 0).unwrap_err();
    assert_eq!(refused.to_string(), "the warehouse has 1 hitch: a trip is from the place of one to that of another");
    let few = WarehouseTrip { robots: 0, ..WarehouseTrip::default() };
    let refused = ProblemGenerator::Warehouse(few).problem(SEED, 0).unwrap_err();
    assert_eq!(refused.to_string(), "robots 0: it must be from 10 to 100000");
}

#[test]
fn settings_out_of_range_and_crowded_fields_are_refused_in_words() {
    let refused = |generator: ProblemGenerator| generator.problem(SEED, 0).unwrap_err().to_string();
    let maze = |maze: Maze| refused(ProblemGenerator::Maze(maze));
    assert_eq!(maze(Maze { columns: 1, ..Maze::default() }), "columns 1: it must be from 2 to 200");
    assert_eq!(maze(Maze { rows: 201, ..Maze::default() }), "rows 201: it must be from 2 to 200");
    assert_eq!(maze(Maze { cell: f64::NAN, ..Maze::default() }), "cell NaN: it must be from 0.4 to 10");
    let field = |field: CircleField| refused(ProblemGenerator::Circles(field));
    assert_eq!(
        field(CircleField { robot: "rover".into(), ..CircleField::default() }),
        "robot \"rover\": there are such problems for rusty, hitch, reach and reach3"
    );
    let swapped = CircleField { radius: Some((0.8, 0.2)), ..CircleField::default() };
    assert_eq!(field(swapped), "radius 0.2: it must be from 0.8 to 10");
    let crowded = CircleField { circles: Some(400), radius: Some((2.0, 2.0)), ..CircleField::default() };
    assert_eq!(field(crowded), "the start has no room: none of 1000 places that were drawn is free");
    let lot = |lot: ParkingLot| refused(ProblemGenerator::Parking(lot));
    assert_eq!(lot(ParkingLot { parked: 5, ..ParkingLot::default() }), "parked 5: it must be from 0 to 4");
    assert_eq!(lot(ParkingLot { bay: 1.5, ..ParkingLot::default() }), "bay 1.5: it must be from 2 to 3.2");
    let passage = NarrowPassage { robot: "reach".into(), ..NarrowPassage::default() };
    assert_eq!(
        refused(ProblemGenerator::Passage(passage)),
        "robot \"reach\": there are such problems for rusty and hitch"
    );
}
