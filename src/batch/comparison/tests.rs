use motion_lab_core::planning::NoPath;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{PathLengths, PlannerName, Task};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::*;
use crate::batch::TableError;

const PLANNERS: [PlannerName; 2] = [PlannerName::RrtStar, PlannerName::AStar];

fn round_the_post() -> PlannerComparison {
    let comparison = PlannerComparison::of(Task::round_the_post(), PLANNERS.to_vec(), 4..7);
    PlannerComparison { iterations: Some(1800), ..comparison }
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
    let first = PlannerComparison { iterations: None, ..comparison.clone() }.run(|_| true).unwrap();
    for (first, attempt) in first.iter().zip(&attempts) {
        let cost = PathCost { iterations: first.effort.iterations, length: first.path.as_ref().unwrap().length };
        assert_eq!((first.costs.as_slice(), attempt.costs[0]), (&[cost][..], cost));
    }
    // so many had a path by then: none before the first, all at the end
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
    let unsuited = PlannerComparison { planners: vec![PlannerName::Bug1, PlannerName::Prm], ..comparison.clone() };
    let none = unsuited.run(|_| true).unwrap_err();
    assert_eq!((none.planner, none.seed), (PlannerName::Prm, Seed(0)));
    assert!(matches!(none.reason, NoPath::Problem(_)) && none.to_string().contains("the post"), "{none}");
    let known = KnownProblem { number: 7, bucket: 3, optimal: 2.0 };
    let cases = vec![PlanCase { ends, problem: Some(known) }];
    let comparison = PlannerComparison { cases, ..comparison };
    let attempts = comparison.run(|_| true).unwrap();
    assert_eq!(attempts.len(), 2);
    for attempt in &attempts {
        assert!(attempt.path.as_ref().is_err_and(|reason| reason.contains("the post")), "{:?}", attempt.path);
        assert!(attempt.costs.is_empty() && attempt.effort.iterations == 0);
    }
    let medians = &comparison.medians(&attempts)[0];
    assert_eq!((medians.solved, medians.attempts, medians.length.is_none()), (0, 2, true));
    assert_eq!(PlannerComparison::solved_within(&attempts, PlannerName::RrtConnect, u64::MAX), 0);
    let text = comparison.costs_csv(&attempts);
    assert_eq!(text, "planner,seed,iterations,length_rad,problem\n");
    // of two problems one has a path, which says whose it is
    let free = [[2.0, 0.0], [2.0, 0.3]].map(|q| AnyRobot::of_kind("reach", &q).unwrap().1);
    let second = KnownProblem { number: 9, bucket: 4, optimal: 0.3 };
    let cases = vec![comparison.cases[0], PlanCase { ends: free, problem: Some(second) }];
    let comparison = PlannerComparison { cases, seeds: 5..6, ..comparison };
    assert_eq!(comparison.count(), 2);
    let attempts = comparison.run(|_| true).unwrap();
    let text = comparison.costs_csv(&attempts);
    assert_eq!(text.lines().nth(1), Some("rrt-connect,5,1,0.3,9"), "{text}");
    assert!(comparison.csv(&attempts).lines().nth(2).unwrap().ends_with(",\"2,0\",\"2,0.3\",9,4,0.3"));
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
        attempt.case.problem = Some(KnownProblem { number: 1, bucket: 0, optimal: 0.5 });
    }
    attempts[5].path = Err("none".into());
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
    attempts[3].path = Err("no, none".into());
    let csv = comparison.csv(&attempts);
    let head =
        "planner,seed,solved,time_s,iterations,samples,edges,free,length_m,clearance_m,reason,robot,world,start,goal";
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
        assert_eq!((text(0), text(12), text(13)), (attempt.planner.id(), "=a, \"b\"", "1.5,5.75,0.3"));
        assert_eq!(*fields[1].1, Field::ULong(attempt.seed.0));
        assert_eq!(*fields[6].1, Field::ULong(attempt.effort.edges));
        match &attempt.path {
            Ok(path) => assert_eq!((fields[8].1, fields[10].1), (&Field::Double(path.length), &Field::Null)),
            Err(reason) => assert_eq!((fields[8].1, text(10)), (&Field::Null, reason.as_str())),
        }
    }
    // as CSV the same, and no spreadsheet takes the world's name for a formula
    let last = csv.lines().last().unwrap();
    assert!(last.starts_with("a-star,1,false,"), "{last}");
    assert!(last.ends_with(",,,\"no, none\",Rusty,\"'=a, \"\"b\"\"\",\"1.5,5.75,0.3\",\"2.5,6.25,0\""), "{last}");
    let entries = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let columns = entries.iter().find(|entry| entry.key == "motion-lab.columns").unwrap();
    let columns: serde_json::Value = serde_json::from_str(columns.value.as_ref().unwrap()).unwrap();
    assert_eq!((&columns[8]["name"], &columns[8]["unit"]), (&"length_m".into(), &"m".into()));
    // it is no sweep's, which could be run again
    let file = tempfile::tempfile().unwrap();
    comparison.parquet(&attempts, file.try_clone().unwrap()).unwrap();
    assert!(matches!(crate::batch::TableFile::open(file), Err(TableError::NoSweep(_))));
}
