//! Axes of the problems of a problem file.

use super::super::*;
use super::rows::cell;
use super::{filed_bundle, try_filed};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_sim::plans::Task;

/// Two pairs in the lot, of a car that is not at its world's start, and a maze's rover as often as is asked for.
const CARS: &str = "Paired(name: \"pairs\", world: \"lot\", robot: \"Hitch\", starts: [[4, 2, 0], [6, 3, \"90deg\"]],
    goals: [[9, 2, 0.5], [8, 2.5, 0]]), Generated(of: Parking(), count: 3, seed: 6)";

const GOAL: &str =
    "robots: [\"Hitch\"], planner: (), goal: (robot: \"Hitch\", at: [0, 0, 0], within: [0.1, 0.1, 0.2]),";

fn tasks(sets: &str) -> Vec<Task> {
    let set = filed_bundle(sets).set().unwrap();
    (0..set.len()).map(|index| set.problem(index).unwrap().task.unwrap()).collect()
}

#[test]
fn a_filed_problem_is_the_world_the_start_and_the_goal_of_its_run() {
    let study = try_filed(CARS, GOAL, "").unwrap();
    let tasks = tasks(CARS);
    assert_eq!((study.runs(), tasks.len()), (5, 5));
    let head = "row seed ticks problem problem.set problem.known problem.bucket problem.optimal_m problem.start.x_m problem.start.y_m \
                problem.start.theta_rad problem.start.psi_rad problem.goal.x_m problem.goal.y_m problem.goal.theta_rad \
                problem.goal.psi_rad failure";
    let names: Vec<&str> = study.columns()[..17].iter().map(|column| column.name.as_str()).collect();
    assert_eq!(names.join(" "), head);
    for (row, task) in (0..).zip(&tasks) {
        let RunSetup { config, inputs: RunInputs::Planner(planning), length, .. } = study.setup(row).unwrap() else {
            panic!("row {row} has no planner")
        };
        let [world] = &config.worlds[..] else { panic!("{} worlds", config.worlds.len()) };
        assert_eq!((&world.name, &world.obstacles), (&task.world.name, &task.world.obstacles));
        let [resident] = &world.robots[..] else { panic!("{:?}", world.robots) };
        assert_eq!((resident.name.as_str(), &resident.start[..]), ("Hitch", &task.start.coordinates()[..]));
        assert_eq!((&planning.goal[..], length), (&task.goal.coordinates()[..], RunLength::Unsimulated));
        let told = study.failed(row, "made up");
        assert_eq!(cell(&study, &told, "problem"), RowValue::Whole(row + 1));
        let set = if row < 2 { "pairs" } else { "parking" };
        assert_eq!(cell(&study, &told, "problem.set"), RowValue::text(set));
        assert_eq!(cell(&study, &told, "problem.start.y_m"), RowValue::Number(task.start.coordinates()[1]));
        assert_eq!(cell(&study, &told, "problem.goal.theta_rad"), RowValue::Number(task.goal.coordinates()[2]));
        assert_eq!(cell(&study, &told, "problem.goal.psi_rad"), RowValue::Empty, "it has no trailer");
        assert_eq!(cell(&study, &told, "failure"), RowValue::text("made up"));
    }
    // the study's line holds all that the file names
    let again = Study::of_line(study.line()).unwrap();
    assert_eq!((again.digest(), again.runs()), (study.digest(), 5));
    assert_eq!(
        (0..5).map(|row| again.setup(row)).collect::<Vec<_>>(),
        (0..5).map(|row| study.setup(row)).collect::<Vec<_>>()
    );
    // what is known of a maze stands in its row
    let mazes = "Generated(of: Maze(columns: 2, rows: 2), count: 1), Generated(of: Maze(closed: true), count: 1)";
    let rover = GOAL.replace("Hitch", "Rusty").replace("0.2]", "4]");
    let study = try_filed(mazes, &rover, "").unwrap();
    let known = |row| cell(&study, &study.failed(row, ""), "problem.known");
    assert_eq!((known(0), known(1)), (RowValue::text("path"), RowValue::text("none")));
}

#[test]
fn runs_are_told_apart_by_the_set_of_their_problem() {
    let study = try_filed(CARS, GOAL, "(vary: \"seed\", over: Range(3, 5)), ").unwrap();
    let varied = study.varied();
    let told: Vec<_> = varied.iter().map(|axis| (axis.name.as_str(), axis.values.join(" "))).collect();
    assert_eq!(told, [("seed", "3 4".into()), ("problem.set", "pairs parking".into())]);
    let of: Vec<Vec<usize>> = (0..study.runs()).map(|row| study.values_of(&varied, row)).collect();
    let of_seed = |seed| [0, 0, 1, 1, 1].map(|set| vec![seed, set]);
    assert_eq!(of, [of_seed(0), of_seed(1)].concat());
    // one set tells nothing apart
    let one = try_filed("Generated(of: Parking(), count: 3)", GOAL, "").unwrap();
    assert!(one.varied().is_empty());
}

#[test]
fn what_a_filed_problem_says_is_varied_by_nothing_else() {
    let refused = |sets: &str, more: &str, axes: &str| try_filed(sets, more, axes).unwrap_err();
    for axis in [
        "(vary: \"world\", over: Names([\"lot\"])), ",
        "(vary: \"Hitch.start\", over: Starts([[2, 3, 0]])), ",
        "(vary: \"Hitch.start.theta\", over: Values([2])), ",
        "(vary: \"goal\", over: Goals([[2, 3, 0]])), ",
    ] {
        let said = refused(CARS, GOAL, axis);
        assert!(said.ends_with("axes[0] varies the same"), "{axis}: {said}");
    }
    // sizes are another matter
    let longer = try_filed(CARS, GOAL, "(vary: \"Hitch.car.max_steer\", over: Values([0.5])), ").unwrap();
    assert!(longer.setup(0).is_ok());
    let said = refused(CARS, "", "");
    assert!(said.ends_with("the study has no goal, which says whose problems they are"), "{said}");
    let rover = "Generated(of: Maze(), count: 1)";
    let said = refused(rover, GOAL, "");
    assert!(said.contains("there is no robot \"Hitch\" in the worlds; they have Rusty"), "{said}");
    let said = refused(&format!("{CARS}, {rover}"), GOAL, "");
    assert!(
        said.ends_with("it would change nothing: its problems are for Hitch, Rusty (hitch, rusty), and the goal's robot is Hitch, a hitch"),
        "{said}"
    );
    // with a trailer a goal has four tolerances, which a row says
    let both = format!("{CARS}, Generated(of: Parking(trailer: true), count: 1)");
    let study = try_filed(&both, GOAL, "").unwrap();
    assert!(study.setup(4).is_ok());
    let reason = study.setup(5).unwrap_err();
    assert_eq!(reason, "the problem's goal has 4 coordinates, and 3 tolerances");
    // a kind's robot has the kind's name in the book
    let named = "Paired(world: \"lot\", robot: \"hitch\", starts: [[4, 2, 0]], goals: [[9, 2, 0]])";
    assert!(try_filed(named, GOAL, "").is_ok());
    for more in ["worlds: [\"lot\"],", "warehouse: (robots: 20),"] {
        let said = refused(CARS, &format!("{more} {GOAL}"), "");
        assert!(said.ends_with("each problem of the file has its own world: leave out worlds and warehouse"), "{said}");
    }
}

#[test]
fn what_is_known_of_a_path_is_told_of_robots_of_the_problems_own_sizes_alone() {
    let rover = GOAL.replace("Hitch", "Rusty").replace("0.2]", "4]");
    let known = |axis: &str| {
        let study = try_filed("Generated(of: Maze(columns: 2, rows: 2), count: 1)", &rover, axis).unwrap();
        cell(&study, &study.failed(0, ""), "problem.known")
    };
    assert_eq!(known("(vary: \"seed\", over: Range(0, 2)), "), RowValue::text("path"));
    assert_eq!(known("(vary: \"Rusty.disc.radius\", over: Values([0.05, 0.6])), "), RowValue::Empty);
}

#[test]
fn a_file_whose_first_problem_has_no_room_is_a_study_of_the_others() {
    let rover = GOAL.replace("Hitch", "Rusty").replace("0.2]", "4]");
    let crowded =
        |seed: u64| format!("Generated(of: Circles(circles: 40, radius: (1.4, 1.6)), count: 30, seed: {seed})");
    let mut first_is_none = 0;
    for seed in 0..6 {
        let study = try_filed(&crowded(seed), &rover, "").unwrap();
        first_is_none += usize::from(study.setup(0).is_err_and(|reason| reason.contains("has no room")));
        assert!((0..30).any(|row| study.setup(row).is_ok()));
    }
    assert!(first_is_none > 0);
}
