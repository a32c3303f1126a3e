use std::sync::Arc;

use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{PathLengths, PlannerName, Task};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::*;
use crate::batch::{FailureKind, KnownProblem, ProblemFile, ProblemSet, RunFailure, TableError};

const PLANNERS: [PlannerName; 2] = [PlannerName::RrtStar, PlannerName::AStar];

fn round_the_post() -> PlannerComparison {
    let mut comparison = PlannerComparison::of(Task::round_the_post(), PLANNERS.to_vec(), 4..7);
    comparison.iterations = Some(1800);
    comparison
}

#[test]
fn the_lengths_of_a_path_fall_and_end_with_the_attempts_own() {
    let comparison = round_the_post();
    assert_eq!(comparison.count(), 6);
    let attempts = comparison.run(|_| true).unwrap();
    let order: Vec<_> = attempts.iter().map(|attempt| (attempt.planner, attempt.seed.0)).collect();
    let expected: Vec<_> = PLANNERS.iter().flat_map(|planner| (4..7).map(|seed| (*planner, seed))).collect();
    assert_eq!(order, expected);
    for ComparedAttempt { planner, path, costs, effort, .. } in &attempts {
        let path = path.as_ref().unwrap();
        assert_eq!(costs.last().unwrap().length, path.length);
        assert!(costs.windows(2).all(|w| w[0].length > w[1].length && w[0].iterations < w[1].iterations), "{costs:?}");
        assert!(costs.last().unwrap().iterations <= effort.iterations, "{costs:?}");
        // only a planner that goes on has a second length
        assert_eq!(costs.len() > 1, *planner == PlannerName::RrtStar, "{costs:?}");
    }
    // the first length is the path that there is without a bound on iterations
    let unbounded = PlannerComparison::of(Task::round_the_post(), PLANNERS.to_vec(), 4..7);
    let first = unbounded.run(|_| true).unwrap();
    for (first, attempt) in first.iter().zip(&attempts) {
        let cost = PathCost { iterations: first.effort.iterations, length: first.path.as_ref().unwrap().length };
        assert_eq!((first.costs.as_slice(), attempt.costs[0]), (&[cost][..], cost));
    }
    // the number that had a path by then: none before the first, all at the end
    let firsts: Vec<u64> = attempts[..3].iter().map(|attempt| attempt.costs[0].iterations).collect();
    let within = |iterations| PlannerComparison::solved_within(&attempts, PlannerName::RrtStar, iterations);
    let (least, most) = (*firsts.iter().min().unwrap(), *firsts.iter().max().unwrap());
    assert!(least < most, "{firsts:?}");
    assert_eq!(
        [within(least - 1), within(most - 1), within(most)],
        [0, firsts.iter().filter(|n| **n < most).count(), 3]
    );
    // a row for each of them, and no other
    let text = comparison.costs_csv(&attempts);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("planner,seed,iterations,length_rad"));
    let rows = attempts
        .iter()
        .flat_map(|a| a.costs.iter().map(|c| format!("{},{},{},{}", a.planner.id(), a.seed.0, c.iterations, c.length)));
    assert!(lines.eq(rows), "{text}");
}

#[test]
fn a_comparison_goes_on_as_long_as_it_is_told_to() {
    let comparison = round_the_post();
    let mut asked = Vec::new();
    let attempts = comparison.run(|done| {
        asked.push(done);
        done < 2
    });
    let attempts = attempts.unwrap();
    assert_eq!(attempts.len(), 2, "{asked:?}");
    assert_eq!((asked.first(), asked.last()), (Some(&0), Some(&2)));
    // between the rounds of an attempt it is asked too, and one that is stopped does not count
    assert!(asked.iter().filter(|done| **done == 1).count() > 2, "{asked:?}");
    let mut left = 3;
    let stopped = comparison.run(|_| {
        left -= 1;
        left > 0
    });
    assert_eq!(stopped.unwrap().len(), 0);
}

#[test]
fn an_end_in_contact_is_no_problem_and_one_of_a_scenario_has_no_path() {
    let ends = [[2.4, 0.0], [3.1, 0.0]].map(|q| AnyRobot::of_kind("reach", &q).unwrap().1);
    let task = Task { start: ends[0], goal: ends[1], ..Task::round_the_post() };
    let comparison = PlannerComparison::of(task, vec![PlannerName::RrtConnect], 0..2);
    // the first planner that meets it is one that suits the robot
    let mut unsuited = comparison.clone();
    unsuited.planners = vec![PlannerName::Bug1, PlannerName::Prm];
    let none = unsuited.run(|_| true).unwrap_err();
    assert_eq!((none.planner, none.seed), (PlannerName::Prm, Seed(0)));
    assert!(matches!(none.reason, NoPath::Problem(_)) && none.to_string().contains("the post"), "{none}");
    let of_file = |start: &str| {
        let text = format!(
            "Problems(version: 1, sets: [Paired(name: \"post\", world: \"workbench\", robot: \"Reach\", \
             starts: [{start}], goals: [[3.1, 0], [2, 0.3]])])"
        );
        let worlds = [("workbench".to_owned(), World::workbench())].into();
        ProblemFile::parse("p.ron", &text).unwrap().with(&worlds, &[].into()).unwrap()
    };
    let blocked = of_file("[2.4, 0], [2.4, 0]");
    let comparison = PlannerComparison::of_problems(blocked, vec![PlannerName::RrtConnect], 0..1).unwrap();
    let attempts = comparison.run(|_| true).unwrap();
    assert_eq!(attempts.len(), 2);
    for attempt in &attempts {
        assert!(attempt.path.as_ref().is_err_and(|failure| failure.reason.contains("the post")), "{:?}", attempt.path);
        assert!(attempt.costs.is_empty() && attempt.effort.iterations == 0);
    }
    let medians = &comparison.medians(&attempts)[0];
    assert_eq!((medians.solved, medians.attempts, medians.length.is_none()), (0, 2, true));
    assert_eq!(medians.set, None, "one set has no table of its own");
    assert_eq!(PlannerComparison::solved_within(&attempts, PlannerName::RrtConnect, u64::MAX), 0);
    let text = comparison.costs_csv(&attempts);
    assert_eq!(text, "planner,seed,iterations,length_rad,problem\n");
    // of two problems one has a path, which says whose it is
    let half = of_file("[2.4, 0], [2, 0]");
    let comparison = PlannerComparison::of_problems(half, vec![PlannerName::RrtConnect], 5..6).unwrap();
    assert_eq!(comparison.count(), 2);
    let attempts = comparison.run(|_| true).unwrap();
    let text = comparison.costs_csv(&attempts);
    assert_eq!(text.lines().nth(1), Some("rrt-connect,5,1,0.3,2"), "{text}");
    let csv = comparison.csv(&attempts);
    assert!(csv.lines().nth(2).unwrap().ends_with("Reach,Workbench,\"2,0\",\"2,0.3\",2,post,,,"), "{csv}");
}

#[test]
fn the_problems_of_a_comparison_are_for_one_kind_of_robot() {
    let text = "Problems(version: 1, sets: [Generated(of: Maze(columns: 2, rows: 2), count: 1), \
                Generated(of: Circles(robot: \"reach\"), count: 1), Generated(of: Parking(), count: 1)])";
    let all = ProblemFile::parse("p.ron", text).unwrap().with(&[].into(), &[].into()).unwrap();
    let of = |problems: ProblemSet| PlannerComparison::of_problems(problems, PLANNERS.to_vec(), 0..1);
    let mixed = of(all.clone()).unwrap_err();
    assert_eq!(mixed.to_string(), "the problems are for several kinds of robot: rusty, reach, hitch");
    for (robot, unit) in [("rusty", "m"), ("Reach", "rad"), ("hitch", "m")] {
        let comparison = of(all.clone().of_robot(robot)).unwrap();
        assert_eq!((comparison.unit(), comparison.count()), (unit, 2), "{robot}");
    }
}

#[test]
fn medians_are_those_of_the_attempts_that_have_a_path() {
    let comparison = round_the_post();
    let mut attempts = comparison.run(|_| true).unwrap();
    let lengths = [[3.0, 1.0, 2.0], [7.0, 4.0, 9.0]];
    for (attempt, length) in attempts.iter_mut().zip(lengths.as_flattened()) {
        let path = PathLengths { length: *length, clearance: 0.1 * length };
        attempt.path = Ok(path);
        (attempt.seconds, attempt.effort.edges) = (0.001 * length, *length as u64 * 10);
        let known = KnownProblem { number: 1, set: "s".into(), bucket: None, optimal: Some(0.5), has_path: None };
        attempt.case = Arc::new(PlanCase { known: Some(known), ..PlanCase::clone(&attempt.case) });
    }
    attempts[5].path = Err(RunFailure::new(FailureKind::NoPath, "none"));
    let [star, grid] = &comparison.medians(&attempts)[..] else { panic!("two planners") };
    assert_eq!((star.planner.as_str(), star.solved, star.attempts), ("rrt-star", 3, 3));
    assert_eq!((grid.planner.as_str(), grid.solved, grid.attempts), ("a-star", 2, 3));
    // the middle one, and the mean of two
    assert_eq!((star.length.unwrap().0, grid.length.unwrap().0), (2.0, 5.5));
    assert_eq!((star.edges, grid.edges), (Some(20.0), Some(55.0)));
    assert_eq!((star.milliseconds, grid.of_optimal), (Some(2.0), Some(11.0)));
    assert!((grid.clearance.unwrap().0 - 0.55).abs() < 1e-12);
}

#[test]
fn the_tables_have_the_same_cells_by_a_reader_of_parquet() {
    let mut world = World::apartment();
    world.name = "=a, \"b\"".into();
    let [(robot, start), (_, goal)] =
        [[1.5, 5.75, 0.3], [2.5, 6.25, 0.0]].map(|q| AnyRobot::of_kind("rusty", &q).unwrap());
    let comparison = PlannerComparison::of(Task::new("Rusty", robot, world, [start, goal]), PLANNERS.to_vec(), 0..2);
    let mut attempts = comparison.run(|_| true).unwrap();
    attempts[3].path = Err(RunFailure::new(FailureKind::GaveUp, "no, none"));
    let csv = comparison.csv(&attempts);
    let head = "planner,seed,solved,time_s,iterations,samples,edges,free,length_m,clearance_m,clearance_asked_m,reason,\
                failure_kind,robot,world,start,goal";
    assert_eq!(csv.lines().next(), Some(head));
    let file = tempfile::tempfile().unwrap();
    comparison.parquet(&attempts, file.try_clone().unwrap()).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 4);
    for (row, attempt) in rows.iter().zip(&attempts) {
        let fields: Vec<(&String, &Field)> = row.get_column_iter().collect();
        assert_eq!(fields.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(","), head);
        let text =
            |i: usize| if let Field::Str(text) = fields[i].1 { text.as_str() } else { panic!("{:?}", fields[i]) };
        assert_eq!((text(0), text(14), text(15)), (attempt.planner.id(), "=a, \"b\"", "1.5,5.75,0.3"));
        assert_eq!(*fields[1].1, Field::ULong(attempt.seed.0));
        assert_eq!(*fields[6].1, Field::ULong(attempt.effort.edges));
        match &attempt.path {
            Ok(path) => assert_eq!((fields[8].1, fields[11].1), (&Field::Double(path.length), &Field::Null)),
            Err(failure) => {
                let said = (&Field::Null, failure.reason.as_str(), "gave-up");
                assert_eq!((fields[8].1, text(11), text(12)), said);
            }
        }
        // of these two one draws samples, and is to keep a millimetre
        let asked = if attempt.planner == PlannerName::AStar { 0.0 } else { 0.001 };
        assert_eq!(*fields[10].1, Field::Double(asked));
    }
    // as CSV the same, and no spreadsheet takes the world's name for a formula
    let last = csv.lines().last().unwrap();
    assert!(last.starts_with("a-star,1,false,"), "{last}");
    assert!(
        last.ends_with(",,,0,\"no, none\",gave-up,Rusty,\"'=a, \"\"b\"\"\",\"1.5,5.75,0.3\",\"2.5,6.25,0\""),
        "{last}"
    );
    let entries = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let columns = entries.iter().find(|entry| entry.key == "motion-lab.columns").unwrap();
    let columns: serde_json::Value = serde_json::from_str(columns.value.as_ref().unwrap()).unwrap();
    assert_eq!((&columns[8]["name"], &columns[8]["unit"]), (&"length_m".into(), &"m".into()));
    // it is no sweep's, which could be run again
    let file = tempfile::tempfile().unwrap();
    comparison.parquet(&attempts, file.try_clone().unwrap()).unwrap();
    assert!(matches!(crate::batch::TableFile::open(file), Err(TableError::NoSweep(_))));
}

#[test]
fn medians_are_told_for_each_set_of_a_file() {
    let text = "Problems(version: 1, sets: [\
        Paired(name: \"far\", world: \"workbench\", robot: \"Reach\", starts: [[2, 0]], goals: [[3.1, 0]]), \
        Paired(name: \"near\", world: \"workbench\", robot: \"Reach\", starts: [[2, 0], [2, 0]], \
            goals: [[2, 0.25], [2, 0.5]]), \
        Generated(name: \"none\", of: Circles(robot: \"reach\", circles: 400, radius: (2, 2)), count: 2), \
        Paired(name: \"post\", world: \"workbench\", robot: \"reach\", starts: [[2.4, 0]], goals: [[3.1, 0]])])";
    let worlds = [("workbench".to_owned(), World::workbench())].into();
    let set = ProblemFile::parse("p.ron", text).unwrap().with(&worlds, &[].into()).unwrap();
    let comparison = PlannerComparison::of_problems(set, PLANNERS.to_vec(), 3..4).unwrap();
    let attempts = comparison.run(|_| true).unwrap();
    let lines = comparison.medians(&attempts);
    let told: Vec<_> = lines
        .iter()
        .map(|line| (line.set.as_deref().unwrap(), line.planner.as_str(), line.solved, line.attempts))
        .collect();
    // an end in contact is a problem without a path, a number without a problem is nothing
    let of = |set, solved, attempts| [(set, "rrt-star", solved, attempts), (set, "a-star", solved, attempts)];
    let expected = [of("far", 1, 1), of("near", 2, 2), of("none", 0, 0), of("post", 0, 1)].concat();
    assert_eq!(told, expected);
    // the middle of a quarter and a half
    assert!((lines[2].length.unwrap().0 - 0.375).abs() < 1e-12, "{:?}", lines[2].length);
}

/// A log of OMPL's as its grammar has it: the words of the head, and the rows of each planner by property.
fn read_ompl(text: &str) -> (Vec<String>, Vec<(String, Vec<std::collections::BTreeMap<String, String>>)>) {
    let mut lines = text.lines();
    let mut next = || lines.next().unwrap().to_owned();
    let count =
        |line: &str, end: &str| line.strip_suffix(end).unwrap_or_else(|| panic!("{line}")).parse::<usize>().unwrap();
    let mut head: Vec<String> = (0..4).map(|_| next()).collect();
    assert_eq!(next(), "<<<|");
    loop {
        let line = next();
        if line == "|>>>" {
            break;
        }
        head.push(line);
    }
    assert_eq!(next(), "4 is the random seed");
    assert_eq!((next(), next()), ("inf seconds per run".into(), "inf MB per run".into()));
    let runs = count(&next(), " runs per planner");
    assert!(next().strip_suffix(" seconds spent to collect the data").unwrap().parse::<f64>().is_ok());
    assert_eq!(next(), "0 enum type");
    let planners = (0..count(&next(), " planners")).map(|_| {
        let name = next();
        assert_eq!(next(), "0 common properties");
        let properties: Vec<String> = (0..count(&next(), " properties for each run")).map(|_| next()).collect();
        assert_eq!(count(&next(), " runs"), runs);
        let rows = (0..runs).map(|_| {
            let row = next();
            let values: Vec<&str> = row.strip_suffix("; ").unwrap().split("; ").collect();
            assert_eq!(values.len(), properties.len(), "{row}");
            properties.iter().cloned().zip(values.into_iter().map(str::to_owned)).collect()
        });
        let rows = rows.collect();
        assert_eq!(next(), ".");
        (name, rows)
    });
    let planners = planners.collect();
    assert_eq!(lines.next(), None);
    (head, planners)
}

#[test]
fn a_log_for_ompl_has_each_run_of_each_planner_in_its_grammar() {
    let comparison = round_the_post();
    let mut attempts = comparison.run(|_| true).unwrap();
    attempts[4].path = Err(RunFailure::new(FailureKind::NoPath, "none"));
    let logs = comparison.ompl_logs(&attempts, "1.2.3");
    let [(1, log)] = &logs[..] else { panic!("{}", logs.len()) };
    let (head, planners) = read_ompl(log);
    let expected = [
        "motion-lab version 1.2.3",
        "Experiment Reach_in_Workbench",
        "Running on unknown",
        "Starting at unknown",
        "robot Reach",
        "world Workbench",
        "start 2,0",
        "goal 3.1,0",
        "lengths in rad",
    ];
    assert_eq!(head, expected);
    assert_eq!(planners.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["rrt-star", "a-star"]);
    for (rows, attempts) in planners.iter().map(|(_, rows)| rows).zip(attempts.chunks(3)) {
        for (row, attempt) in rows.iter().zip(attempts) {
            let solved = if attempt.path.is_ok() { "1" } else { "0" };
            assert_eq!((row["solved BOOLEAN"].as_str(), row["correct solution BOOLEAN"].as_str()), (solved, solved));
            assert_eq!(row["time REAL"].parse(), Ok(attempt.seconds));
            assert_eq!(row["seed INTEGER"].parse(), Ok(attempt.seed.0));
            let Effort { iterations, samples, edges, free } = attempt.effort;
            let counts = ["iterations", "samples", "edges asked", "edges free"]
                .map(|name| row[&format!("{name} INTEGER")].parse());
            assert_eq!(counts, [iterations, samples, edges, free].map(Ok));
            match &attempt.path {
                Ok(path) => {
                    assert_eq!(row["solution length REAL"].parse(), Ok(path.length));
                    assert_eq!(row["proven clearance REAL"].parse(), Ok(path.clearance));
                }
                Err(_) => {
                    assert_eq!((row["solution length REAL"].as_str(), row["proven clearance REAL"].as_str()), ("", ""))
                }
            }
        }
    }
    // of several problems each has its own
    let text = "Problems(version: 1, sets: [\
        Crossed(name: \"the post\", world: \"workbench\", robot: \"Reach\", starts: [[2, 0]], goals: [[3.1, 0], [2, 0.5]])])";
    let worlds = [("workbench".to_owned(), World::workbench())].into();
    let set = ProblemFile::parse("p.ron", text).unwrap().with(&worlds, &[].into()).unwrap();
    let comparison = PlannerComparison::of_problems(set, PLANNERS.to_vec(), 4..6).unwrap();
    let logs = comparison.ompl_logs(&comparison.run(|_| true).unwrap(), "1");
    assert_eq!(logs.len(), 2);
    for ((at, log), (number, goal)) in logs.iter().zip([(1, "3.1,0"), (2, "2,0.5")]) {
        assert_eq!(*at, number);
        let (head, planners) = read_ompl(log);
        assert_eq!(
            (head[1].as_str(), head[7].as_str()),
            (format!("Experiment the_post_{number}").as_str(), format!("goal {goal}").as_str())
        );
        assert!(planners.iter().all(|(_, rows)| rows.iter().map(|row| row["seed INTEGER"].as_str()).eq(["4", "5"])));
        let short = number == 2;
        assert!(
            planners.iter().all(|(_, rows)| rows.iter().all(|row| (row["solution length REAL"] == "0.5") == short))
        );
    }
}
