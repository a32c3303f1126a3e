use super::*;

fn of(rest: &str) -> Study {
    try_plan(&format!("Sweep(version: 1, worlds: [\"lot\", \"apartment\"], {rest})")).unwrap()
}

/// The values of a row in words, by the cells that say them.
fn said(study: &Study, row: u64, columns: &[&str]) -> Vec<String> {
    let cells = study.parameters(row);
    let at = |name: &str| study.columns().iter().position(|column| column.name == name).unwrap();
    columns.iter().map(|name| cells[at(name)].to_text()).collect()
}

#[test]
fn runs_are_told_apart_by_axes_of_two_to_twelve_values() {
    let axes = "(vary: \"seed\", over: Range(5, 17)), (vary: \"ticks\", over: Values([7])), \
                (vary: \"Hitch.start.x\", over: Steps(6, 7, 13)), (vary: \"Rusty.noise.sigma_hit\", over: Values([0, 0.1, 0]))";
    let study = of(&format!("axes: [{axes}]"));
    let varied = study.varied();
    let names: Vec<&str> = varied.iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["seed", "Rusty.noise.sigma_hit"], "neither one value nor thirteen");
    assert_eq!(varied[0].values, (5..17).map(|n| n.to_string()).collect::<Vec<_>>());
    assert_eq!(varied[1].values, ["0", "0.1"], "each value once");
    for row in 0..study.runs() {
        let values: Vec<&str> =
            varied.iter().zip(study.values_of(&varied, row)).map(|(axis, i)| axis.values[i].as_str()).collect();
        assert_eq!(values, said(&study, row, &["seed", "Rusty.noise.sigma_hit_m"]), "{row}");
    }
}

#[test]
fn the_values_of_lists_and_samples_are_those_of_their_rows() {
    let axes = "axes: [(vary: \"seed\", over: Range(0, 4)), (vary: \"Hitch.start.y\", over: Values([2, 3, 2.5, 2]))]";
    for points in ["List", "Sample(count: 40, seed: 3)"] {
        let study = of(&format!("points: {points}, {axes}"));
        let varied = study.varied();
        assert_eq!(varied[1].values, ["2", "3", "2.5"]);
        let mut seen = std::collections::BTreeSet::new();
        for row in 0..study.runs() {
            let numbers = study.values_of(&varied, row);
            let values: Vec<&str> = varied.iter().zip(&numbers).map(|(axis, i)| axis.values[*i].as_str()).collect();
            assert_eq!(values, said(&study, row, &["seed", "Hitch.start.y_m"]), "{points} {row}");
            seen.insert(numbers);
        }
        assert!(seen.len() >= 4, "{points}: {seen:?}");
    }
    let study = of("points: Sample(count: 5, seed: 3), axes: [(vary: \"Hitch.start.y\", over: Uniform(2, 3))]");
    assert!(study.varied().is_empty(), "a range without steps has no values");
}

#[test]
fn starts_and_names_are_values_in_words() {
    let axes = "axes: [(vary: \"world\", over: Names([\"lot\", \"apartment\"])), \
                (vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [6.5, 2.5, \"90deg\"]]))]";
    let varied = of(axes).varied();
    assert_eq!(varied[0].values, ["lot", "apartment"]);
    assert_eq!(varied[1].values, ["6.5, 2.5, 0", "6.5, 2.5, 1.5707963267948966"]);
}

#[test]
fn a_run_is_as_long_as_it_is_said_to_be_and_with_a_planner_as_its_path_or_none() {
    let goal = "robots: [\"Hitch\"], goal: (robot: \"Hitch\", at: [6.75, 7, 0], within: [1, 1, 1])";
    let length = |rest: &str, row| of(&format!("{rest}, {goal}")).setup(row).unwrap().length;
    let varied = "planner: (), ticks: Planned, axes: [(vary: \"ticks\", over: Values([70, 80]))]";
    for (rest, expected) in [
        ("seed: 1", RunLength::Ticks(1200)),
        ("ticks: 7", RunLength::Ticks(7)),
        ("planner: ()", RunLength::Unsimulated),
        ("planner: (), ticks: Planned", RunLength::Planned),
        ("planner: (), ticks: 7", RunLength::Ticks(7)),
        (varied, RunLength::Ticks(70)),
    ] {
        assert_eq!(length(rest, 0), expected, "{rest}");
        let study = of(&format!("{rest}, {goal}"));
        let ticks = expected.ticks().map_or(String::new(), |ticks| ticks.to_string());
        assert_eq!(said(&study, 0, &["ticks"]), [ticks], "{rest}");
        // a study is the same from its own line
        assert_eq!(Study::of_line(study.line()).unwrap().digest(), study.digest(), "{rest}");
        assert_eq!(Study::of_line(study.line()).unwrap().setup(0).unwrap().length, expected, "{rest}");
    }
    assert_eq!(length(varied, 1), RunLength::Ticks(80));
}

#[test]
fn goals_are_crossed_with_starts_or_paired_with_them() {
    let starts = "(vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [6.5, 3, 0]]))";
    let goals = "(vary: \"goal\", over: Goals([[6.75, 7, 0], [5, 7, \"90deg\"]]))";
    let rest = "robots: [\"Hitch\"], planner: (), goal: (robot: \"Hitch\", at: [0, 0, 0], within: [1, 1, 1])";
    let right = std::f64::consts::FRAC_PI_2;
    let ends = |study: &Study, row| {
        let setup = study.setup(row).unwrap();
        let RunInputs::Planner(planning) = setup.inputs else { panic!("a planner") };
        (setup.config.worlds[0].robots[0].start[1], planning.goal)
    };
    let crossed =
        of(&format!("worlds: [\"lot\"], {rest}, axes: [{starts}, {goals}]").replace("worlds: [\"lot\"], ", ""));
    let found: Vec<_> = (0..crossed.runs()).map(|row| ends(&crossed, row)).collect();
    let (near, far) = (vec![6.75, 7.0, 0.0], vec![5.0, 7.0, right]);
    assert_eq!(found, [(2.5, near.clone()), (2.5, far.clone()), (3.0, near.clone()), (3.0, far.clone())]);
    assert_eq!(said(&crossed, 1, &["goal.x_m", "goal.y_m", "goal.theta_rad"]), ["5", "7", "1.5707963267948966"]);
    assert_eq!(crossed.varied()[1].values, ["6.75, 7, 0", "5, 7, 1.5707963267948966"]);
    let paired = of(&format!("points: List, {rest}, axes: [{starts}, {goals}]"));
    assert_eq!([ends(&paired, 0), ends(&paired, 1)], [(2.5, near), (3.0, far)]);
    // a run is watched for the goal of its row, and a goal outside is said by its row
    assert_eq!(paired.goal_of(1, &[World::lot()]).unwrap().at(), [5.0, 7.0, right]);
    let outside = of(&format!("{rest}, axes: [(vary: \"goal\", over: Goals([[6.75, 7, 0], [60, 7, 0]]))]"));
    assert!(outside.setup(0).is_ok() && outside.setup(1).unwrap_err().starts_with("Hitch: "), "{:?}", outside.setup(1));
}

#[test]
fn goals_that_cannot_be_are_refused_where_they_stand() {
    let goal = "goal: (robot: \"Hitch\", at: [6.75, 7, 0], within: [1, 1, 1])";
    for (rest, item, reason) in [
        (
            "axes: [(vary: \"goal\", over: Goals([[1, 2, 3]]))]",
            "axes[0] \"goal\"",
            "it would change nothing: the study has no goal",
        ),
        (
            &format!("{goal}, axes: [(vary: \"goal\", over: Starts([[1, 2, 3]]))]"),
            "axes[0] \"goal\"",
            "Goals([[...], [...]])",
        ),
        (
            &format!("{goal}, axes: [(vary: \"Hitch.start\", over: Goals([[1, 2, 3]]))]"),
            "axes[0] \"Hitch.start\"",
            "Starts([[...], [...]])",
        ),
        (
            &format!("{goal}, axes: [(vary: \"goal\", over: Goals([[6, 7, 0], [6, 7]]))]"),
            "axes[0] \"goal\"",
            "goal 1: ",
        ),
        (
            &format!("{goal}, axes: [(vary: \"gaol\", over: Goals([[6, 7, 0]]))]"),
            "axes[0] \"gaol\"",
            "did you mean \"goal\"?",
        ),
        (
            &format!(
                "{goal}, axes: [(vary: \"goal\", over: Goals([[6, 7, 0]])), (vary: \"goal\", over: Goals([[6, 7, 1]]))]"
            ),
            "axes[1] \"goal\"",
            "axes[0]",
        ),
    ] {
        let error = try_plan(&format!("Sweep(version: 1, worlds: [\"lot\"], {rest})")).unwrap_err().to_string();
        assert!(error.contains(item) && error.contains(reason), "{rest}: {error}");
    }
}
