use std::collections::BTreeMap;

use super::*;
use motion_lab_core::configuration::Configuration as _;
use motion_lab_core::worlds::World;
use motion_lab_import::Scenario;

/// A map of 8 x 5 cells, and a world of 2 m a cell with its corner at (-4, 1).
const SCENARIO: &str = "version 1\n3\ty.map\t8\t5\t0\t0\t7\t4\t12.5\n9\ty.map\t8\t5\t1\t1\t1\t1\t0\n";

fn worlds() -> BTreeMap<String, World> {
    let yard = "World(version: 1, name: \"yard\", bounds: (min: (-4, 1), max: (12, 11)), robots: [
        (name: \"R\", kind: \"rusty\", start: [0, 2, 0.5], disc: (radius: 0.2, track: 0.2, wheel_radius: 0.05)),
        (name: \"T\", kind: \"hitch\", start: [5, 5, 0.25, 0.75]), (name: \"A\", kind: \"reach\", start: [1, 1], arm: (base: (4, 6), lengths: [1, 1], radius: 0.03))])";
    let yard = World::parse("yard.ron", yard).unwrap();
    [("yard.ron".to_owned(), yard), ("workbench".to_owned(), World::workbench())].into()
}

fn with(sets: &str) -> Result<ProblemSet, String> {
    let text = format!("Problems(\n    version: 1,\n    sets: [{sets}],\n)\n");
    let scenarios = [("y.scen".to_owned(), Scenario::parse("y.scen", SCENARIO).unwrap())].into();
    let file = ProblemFile::parse("p.ron", &text).map_err(|error| error.to_string())?;
    file.with(&worlds(), &scenarios).map_err(|error| error.to_string())
}

/// The coordinates of all starts and goals.
fn ends(set: &ProblemSet) -> Vec<[Vec<f64>; 2]> {
    let tasks = (0..set.len()).map(|index| set.problem(index).unwrap().task.unwrap());
    tasks.map(|task| [task.start, task.goal].map(|q| q.coordinates().to_vec())).collect()
}

const STARTS: &str = "world: \"yard.ron\", robot: \"R\", starts: [[1, 2], [3, 4, \"90deg\"]]";

#[test]
fn ends_are_paired_or_crossed_with_the_goal_changing_first() {
    let turned = std::f64::consts::FRAC_PI_2;
    let (a, b) = (vec![1.0, 2.0, 0.0], vec![3.0, 4.0, turned]);
    let (c, d) = (vec![5.0, 6.0, 1.0], vec![7.0, 8.0, 0.0]);
    let paired = with(&format!("Paired({STARTS}, goals: [[5, 6, 1], [7, 8]])")).unwrap();
    assert_eq!(ends(&paired), [[a.clone(), c.clone()], [b.clone(), d.clone()]]);
    let crossed = with(&format!("Crossed({STARTS}, goals: [[5, 6, 1], [7, 8]])")).unwrap();
    assert_eq!(ends(&crossed), [[a.clone(), c.clone()], [a, d.clone()], [b.clone(), c], [b, d]]);
    // the robot is alone in the world, and as large as the world says
    let task = crossed.problem(3).unwrap().task.unwrap();
    assert_eq!((task.name.as_str(), task.world.robots.len(), task.robot.kind()), ("R", 1, "rusty"));
    let width = task.robot.about().sizes.unwrap()();
    assert_ne!(task.world.robots[0].sizes.as_ref(), Some(&width));
    assert!(crossed.problem(4).is_none());
}

#[test]
fn problems_of_a_scenario_stand_in_the_middle_of_their_cells_with_the_robots_headings() {
    let of =
        |robot: &str| with(&format!("Scenario(file: \"y.scen\", world: \"yard.ron\", robot: \"{robot}\")")).unwrap();
    // cell (0, 0) is the upper left one of 5 rows of 2 m above 1 m
    let expected = [[vec![-3.0, 10.0, 0.5], vec![11.0, 2.0, 0.5]], [vec![-1.0, 8.0, 0.5], vec![-1.0, 8.0, 0.5]]];
    assert_eq!(ends(&of("R")), expected);
    assert_eq!(ends(&of("T"))[0], [vec![-3.0, 10.0, 0.25, 0.75], vec![11.0, 2.0, 0.25, 0.75]]);
    assert_eq!(ends(&of("rusty"))[0][0], [-3.0, 10.0, 0.0], "a kind of no heading of its own");
    let known: Vec<_> = (0..2).map(|index| of("R").problem(index).unwrap().known.unwrap()).collect();
    let of_first =
        KnownProblem { number: 1, set: "y.scen".into(), bucket: Some(3), optimal: Some(25.0), has_path: None };
    assert_eq!(known[0], of_first);
    assert_eq!((known[0].of_optimal(50.0), known[1].of_optimal(50.0)), (Some(2.0), None), "no share of nothing");
}

#[test]
fn numbers_are_those_of_the_file_whichever_robot_is_asked_for() {
    let sets = format!(
        "Generated(of: Maze(columns: 2, rows: 2), count: 3, seed: 5), Paired({STARTS}, goals: [[5, 6], [7, 8]]), \
         Generated(name: \"cars\", of: Parking(), count: 2), Generated(of: Maze(closed: true), count: 1)"
    );
    let all = with(&sets).unwrap();
    let told = |set: &ProblemSet| -> Vec<(u64, String, Option<&'static str>)> {
        let known = (0..set.len()).map(|index| set.problem(index).unwrap().known.unwrap());
        known.map(|known| (known.number, known.set.clone(), known.path_in_words())).collect()
    };
    let row = |number: u64, set: &str, known| (number, set.to_owned(), known);
    let mazes = (1..=3).map(|number| row(number, "maze", Some("path")));
    let pairs = (4..=5).map(|number| row(number, "yard.ron", None));
    let closed = row(8, "maze 2", Some("none"));
    let rovers: Vec<_> = mazes.chain(pairs).chain([closed]).collect();
    let cars = [row(6, "cars", None), row(7, "cars", None)];
    let mut expected = [&rovers[..5], &cars, &rovers[5..]].concat();
    assert_eq!(told(&all), expected);
    assert!(all.numbers().eq(1..=8));
    assert_eq!(all.names(), ["maze", "yard.ron", "cars", "maze 2"]);
    assert_eq!(all.kinds().iter().map(|kind| kind.name).collect::<Vec<_>>(), ["rusty", "hitch"]);
    expected.retain(|(number, ..)| !(6..=7).contains(number));
    let own = all.clone().of_robot("rusty");
    assert_eq!((told(&own), own.numbers().collect::<Vec<_>>()), (expected, vec![1, 2, 3, 4, 5, 8]));
    assert_eq!(all.robots(), ["Rusty", "R", "Hitch"]);
    // by a robot's name: the maze's rover is called Rusty
    assert_eq!((all.clone().of_robot("Rusty").len(), all.clone().of_robot("R").len()), (4, 2));
    assert!(all.clone().of_robot("reach").is_empty());
    for number in [0, 1, 3, 4, 5, 6, 7, 8, 9] {
        let found = own.numbered(number).map(|problem| problem.known.unwrap().number);
        let is_there = (1..=8).contains(&number) && !(6..=7).contains(&number);
        assert_eq!(found, is_there.then_some(number));
    }
    // a generated one is its generator's own
    let maze = motion_lab_sim::problems::Maze { columns: 2, rows: 2, ..Default::default() };
    let generator = motion_lab_sim::problems::ProblemGenerator::Maze(maze);
    let second = generator.problem(motion_lab_core::random::Seed(5), 1).unwrap().task;
    assert_eq!(all.problem(1).unwrap().task.unwrap().world, second.world);
}

#[test]
fn what_is_asked_of_all_problems_is_asked_of_each() {
    let mut set = with("Generated(of: Maze(), count: 1), Generated(of: Parking(), count: 1)").unwrap();
    (set.tube, set.clearance) = (0.01, Some(0.03));
    for index in 0..2 {
        let task = set.problem(index).unwrap().task.unwrap();
        assert_eq!((task.tube, task.clearance), (0.01, Some(0.03)));
    }
    let own = ProblemSet::of_task(motion_lab_sim::plans::Task::round_the_post());
    assert!(own.len() == 1 && own.names().is_empty() && own.problem(0).unwrap().known.is_none());
}

#[test]
fn a_problem_without_room_says_so_and_the_others_are_there() {
    let set = with("Generated(of: Circles(circles: 40, radius: (1.4, 1.6)), count: 30)").unwrap();
    let tasks: Vec<_> = (0..30).map(|index| set.problem(index).unwrap()).collect();
    let crowded = tasks.iter().filter(|problem| problem.task.is_err()).count();
    assert!((1..30).contains(&crowded), "{crowded}");
    let reason = tasks.iter().find_map(|problem| problem.task.as_ref().err()).unwrap();
    assert!(reason.contains("has no room: none of 1000 places that were drawn is free"), "{reason}");
    assert!(tasks.iter().all(|problem| problem.known.is_some()));
}

#[test]
fn what_a_file_can_not_say_is_refused_with_its_place() {
    let refused = |sets: &str| with(sets).unwrap_err();
    let end = |sets: &str, place: &str, reason: &str| {
        let said = refused(sets);
        assert!(said.starts_with(&format!("p.ron:{place}: ")) && said.ends_with(reason), "{said}");
    };
    end("", "2:14", "it has no set of problems");
    end("Generated(of: Maze(columns: 1), count: 2)", "3:12", "sets[0] \"maze\": columns 1: it must be from 2 to 200");
    end(
        "Generated(of: Maze(), count: 2), Generated(name: \"n\", of: Maze(), count: 0)",
        "3:45",
        "sets[1] \"n\": it has no problem",
    );
    end("Generated(of: Maze(), count: 10000001)", "3:12", "10000001 problems: at most 10000000");
    end(
        "Generated(of: Circles(robot: \"rover\"), count: 1)",
        "3:12",
        "robot \"rover\": there are such problems for rusty, hitch, reach and reach3",
    );
    end(
        &format!("Paired({STARTS}, goals: [[5, 6]])"),
        "3:12",
        "2 starts and 1 goals: paired ones are as many; write Crossed for each to each",
    );
    end(&format!("Crossed({STARTS}, goals: [])"), "3:12", "it has no problem");
    end(
        &format!("Paired({STARTS}, goals: [[5, 6], [7]])"),
        "3:12",
        "goal 2: 1 coordinates: a rusty has three: x, y, theta",
    );
    let degrees = refused(&format!("Paired({STARTS}, goals: [[5, 6], [\"7deg\", 1]])"));
    assert!(degrees.starts_with("p.ron:3:12: sets[0] \"yard.ron\": goal 2: "), "{degrees}");
    end(
        "Paired(world: \"yard.ron\", robot: \"rustty\", starts: [[1, 2]], goals: [[3, 4]])",
        "3:12",
        "there is no robot \"rustty\"; in yard lives R, T, A; did you mean \"rusty\"?",
    );
    end(
        "Paired(world: \"yard.ron\", robot: \"T\", starts: [[1, 2, 0]], goals: [[3, 4, 0, 0]])",
        "3:12",
        "some of the starts and goals have a trailer's heading, others have none",
    );
    end(
        "Scenario(file: \"y.scen\", world: \"yard.ron\", robot: \"A\")",
        "3:12",
        "a reach does not go from place to place",
    );
    end(
        "Scenario(file: \"y.scen\", world: \"workbench\", robot: \"rusty\")",
        "3:12",
        "8 x 5 cells do not fill the world's bounds, 4.8 x 4.8 m",
    );
    let mazes = |first: &str, second: &str| {
        format!(
            "Generated(name: \"{first}\", of: Maze(), count: 1), Generated(name: \"{second}\", of: Maze(), count: 1)"
        )
    };
    end(&mazes("a", "a"), "3:56", "sets[1] \"a\": another set has this name already");
    for bad in ["", " a", "a\\nb", "a\\u{1b}[31m"] {
        let said = refused(&mazes(bad, "b"));
        assert!(said.starts_with("p.ron:3:12: sets[0] ") && said.contains("name"), "{said}");
    }
    // what has no name of its own keeps out of the way of one that has
    let text = "Generated(of: Maze(), count: 1), Generated(of: Maze(), count: 1), Generated(name: \"maze 2\", of: Maze(), count: 1)";
    assert_eq!(with(text).unwrap().names(), ["maze", "maze 3", "maze 2"]);
    end(&format!("Paired({STARTS}, goals: [[5, 6], [NaN, 1]])"), "3:12", "goal 2: NaN: it must be finite");
    let unknown = refused("Generated(of: Maze(columnz: 3), count: 1)");
    assert!(unknown.starts_with("p.ron:3:") && unknown.contains("columnz"), "{unknown}");
    let later = ProblemFile::parse("p.ron", "Problems(version: 2, problems: [])").unwrap_err();
    assert_eq!(later.to_string(), "p.ron:1:19: version: version 2: this program reads version 1");
}

#[test]
fn a_file_says_what_it_names_and_where() {
    let text = "Problems(version: 1, sets: [\n    Scenario(file: \"b.scen\", world: \"a.ron\", robot: \"R\"),\n    \
                Paired(world: \"lot\", robot: \"Hitch\", starts: [], goals: []),\n])";
    let file = ProblemFile::parse("p.ron", text).unwrap();
    assert!(file.world_names().into_iter().eq(["a.ron", "lot"]) && file.scenario_names().into_iter().eq(["b.scen"]));
    assert_eq!((file.place_of("b.scen"), file.place_of("lot")), ("p.ron:2:20".into(), "p.ron:3:19".into()));
}
