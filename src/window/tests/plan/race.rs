//! A race of planners: joined, played, read off its table, brought to the front, ended.

use super::*;
use motion_lab_core::planning::Bounds;
use motion_lab_sim::plans::{PlannerName, Task};
use motion_lab_sim::tour::BOOK_SEED;

/// What the table says of a planner that went at the task alone, by the library's own loop.
fn alone(name: PlannerName) -> String {
    let mut attempt = Task::round_the_post().attempt(name, BOOK_SEED).unwrap();
    attempt.solve(&Bounds::default()).unwrap();
    let (effort, lengths) = (attempt.effort(), attempt.lengths());
    let (iterations, edges) = (effort.iterations, effort.edges);
    format!("{}: iterations {iterations}, edges {edges}, length {:.3}, clearance", name.title(), lengths.length)
}

/// Lets a planner join by the menu.
fn join(harness: &mut Harness<'_, Lab>, name: PlannerName) {
    harness.get_by_label("Race another").click_accesskit();
    harness.run_steps(3);
    harness.query_all_by_label(name.title()).last().expect("in the menu").click_accesskit();
    harness.run_steps(3);
    assert_eq!(plan(harness).racing().last(), Some(name));
}

#[test]
fn a_race_is_read_off_its_table_and_the_planner_in_front_is_the_one_whose_path_is_kept() {
    for size in [WIDE, PHONE] {
        let mut harness = planned(size);
        assert!(harness.query_by_label_contains("iterations 0, edges 0").is_none(), "one planner has no table");
        // not in the order of the menu
        for name in [PlannerName::RrtStar, PlannerName::Rrt] {
            join(&mut harness, name);
        }
        assert!(harness.query_by_label("Race another").is_none(), "three at most");
        let racing: Vec<PlannerName> = plan(&harness).racing().collect();
        assert_eq!((racing.len(), plan(&harness).planner()), (3, racing[2]), "who joins comes to the front");
        assert_eq!(harness.query_all_by_label_contains("iterations 0, edges 0, length \u{2013}").count(), 3);
        play(&mut harness);
        harness.run_steps(2);
        for name in &racing {
            harness.get_by_label_contains(&alone(*name)).click_accesskit();
            harness.run_steps(3);
            assert_eq!(plan(&harness).planner(), *name);
            let file = plan(&harness).file().expect("its own path").to_json().unwrap();
            assert!(file.contains(&format!("\"{}\"", name.id())), "{}", name.id());
        }
        harness.get_by_label("End the race").click_accesskit();
        harness.run_steps(3);
        assert_eq!(plan(&harness).racing().collect::<Vec<_>>(), [racing[2]]);
        let left = plan(&harness);
        assert!(left.lengths().is_some() && left.drawn().rivals.is_empty(), "it keeps its path, alone");
        // who joins grows alone, and the first keeps what it has
        join(&mut harness, racing[0]);
        assert!(
            plan(&harness).effort().iterations == 0 && plan(&harness).drawn().rivals == [left.drawn().path.clone()]
        );
        play(&mut harness);
        harness.run_steps(2);
        harness.get_by_label_contains(&alone(racing[2]));
    }
}
