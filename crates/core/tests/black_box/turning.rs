//! Sweeps that ignore turning: the cast of a part that only turns stays where it is.

use motion_lab_core::collision::{Collision, EdgeVerdict, HitBy, ParryScene};
use motion_lab_core::num::atan2;
use motion_lab_core::picture::{Figure, Panel, Role, footprint, world};
use motion_lab_core::planning::{
    Bounds, GridSearch, NoPath, PathError, Planner, PotentialField, Prm, Rrt, RrtConnect, RrtStar, solve,
    solve_unproven,
};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ChartLine, Motion, Robot};

use super::figures::check_figure;

/// Two free configurations with the post between them. Of the chapter's own pair, (2.0, 0) and (3.1, 0), the second
/// link's cast happens to meet the post.
const ENDS: [[f64; 2]; 2] = [[2.2, 0.5], [2.9, 0.5]];

fn exact() -> ChainChecker<2> {
    ChainChecker::new(Scene::workbench(), Reach::<2>::workbench())
}

fn problem(seed: u64) -> Problem<Reach<2>> {
    let checker = exact().with_black_box(ParryScene::of_scene(exact().scene()));
    let [a, b] = ENDS.map(|[th1, th2]| T2::new(th1, th2));
    Problem::try_new(checker, a, b, Seed(seed)).unwrap()
}

#[test]
fn the_cast_of_an_arm_that_turns_through_the_post_meets_nothing() {
    let (exact, [a, b]) = (exact(), ENDS.map(|[th1, th2]| T2::new(th1, th2)));
    let [from, to] = [a, b].map(|q| exact.robot().footprint(&q));
    let black_box = ParryScene::of_scene(exact.scene());
    assert!(!black_box.intersects(&from) && !black_box.intersects(&to));
    assert!(!black_box.swept(&from, &to), "the chapter's cast");
    assert!(exact.scene().swept(&from, &to), "each link in a straight line, turning");
    let EdgeVerdict::Hit { free_until, contact_at, part: 0, by: HitBy::Obstacle(post) } = exact.edge(&a, &b).unwrap()
    else {
        panic!("the post is not met")
    };
    assert_eq!(exact.scene().obstacle_name(post), Some("the post"));
    let at = |s: f64| black_box.intersects(&exact.robot().footprint(&T2::new(2.2 + 0.7 * s, 0.5)));
    assert!(!at(free_until - 1e-5) && at(contact_at + 1e-5) && at(0.5), "parry sees it where it is asked");
    // the post's corner (-0.5, 0.5) is reached when the middle line of the first link is 0.03 m from it
    let sine = 0.03 / 0.5_f64.sqrt();
    let bearing = 0.75 * std::f64::consts::PI - atan2(sine, (1.0 - sine * sine).sqrt());
    assert!((2.2 + 0.7 * contact_at - bearing).abs() < 1e-5, "{contact_at}");
}

#[test]
fn a_planner_that_asks_it_goes_through_the_post() {
    let path = solve_unproven(&mut RrtConnect::new(problem(2005)), &Bounds::default()).unwrap();
    assert_eq!(path.motions().len(), 1, "straight");
    let refused = path.certified(&exact()).unwrap_err();
    let PathError::NotFree { leg: 0, verdict: EdgeVerdict::Hit { contact_at, .. }, .. } = refused else {
        panic!("{refused}")
    };
    figure(&path.motions()[0], contact_at);
}

#[test]
fn what_any_planner_finds_by_it_is_not_proven() {
    let planners: [fn(u64) -> Box<dyn Planner<Reach<2>>>; 6] = [
        |seed| Box::new(RrtConnect::new(problem(seed))),
        |seed| Box::new(Rrt::new(problem(seed))),
        |seed| Box::new(RrtStar::new(problem(seed))),
        |seed| Box::new(Prm::new(problem(seed))),
        |seed| Box::new(GridSearch::a_star(problem(seed))),
        |seed| Box::new(PotentialField::new(problem(seed))),
    ];
    let (mut solved, mut through) = (0, 0);
    for planner in planners {
        for seed in 0..3 {
            let name = planner(seed).name();
            let Ok(path) = solve_unproven(planner(seed).as_mut(), &Bounds::of_iterations(20_000)) else { continue };
            assert_eq!((path.start(), path.goal()), (problem(seed).start(), problem(seed).goal()), "{name}");
            // every leg is what the black box calls free, and `solve` returns nothing that is only called free
            assert!(path.motions().iter().all(|leg| problem(seed).checker().motion_free(leg)), "{name}");
            let refused = solve(planner(seed).as_mut(), &Bounds::of_iterations(20_000)).unwrap_err();
            assert_eq!(refused, NoPath::Refused(PathError::Unproven), "{name}");
            solved += 1;
            through += u32::from(path.certified(&exact()).is_err());
        }
    }
    assert!(solved >= 12 && through >= 6, "{solved} solved, {through} of them through something");
}

#[test]
fn verdicts_and_certificates_of_a_checker_with_a_black_box_are_those_of_the_scene() {
    let (exact, boxed) = (exact(), problem(1));
    let mut s = Stream::new(Seed(45), "tests/verdicts");
    let mut draw = || T2::new(s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0));
    let mut differing = 0;
    for _ in 0..300 {
        let (a, b) = (draw(), draw());
        assert_eq!(boxed.checker().edge(&a, &b), exact.edge(&a, &b));
        assert_eq!(boxed.checker().last_free(&a, &b), exact.last_free(&a, &b));
        differing += u32::from(boxed.checker().edge_free(&a, &b) != exact.edge_free(&a, &b));
    }
    assert!(differing > 20, "{differing}: the black box was asked");
}

fn figure(line: &ChartLine<Reach<2>>, contact_at: f64) {
    let mut picture = world(&World::workbench());
    for k in 1..6 {
        let at = line.footprint_at(f64::from(k) / 6.0);
        picture = picture.with(footprint(&format!("way/{k}"), "on the way", &at, Role::Path, 0.12));
    }
    let picture = picture
        .with(footprint("from", "the start", &line.footprint_at(0.0), Role::Robot, 0.5))
        .with(footprint("to", "the goal", &line.footprint_at(1.0), Role::Free, 0.4))
        .with(footprint("contact", "in contact with the post", &line.footprint_at(contact_at), Role::Goal, 0.4));
    check_figure(
        "turning",
        &Figure {
            title: "A sweep that ignores turning".to_owned(),
            description: "The path that RRT-Connect finds by parry's casts leads through the post. Red: the contact."
                .to_owned(),
            panels: vec![Panel { picture, heading: "called free by parry's casts".to_owned(), readout: vec![] }],
            caption: vec![],
        },
    );
}
