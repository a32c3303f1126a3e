//! A fleet: the run that it is, goals on routes, and rovers that have ended.

use motion_lab_core::prelude::*;
use motion_lab_core::worlds::Warehouse;
use motion_lab_sim::recording::verify;
use motion_lab_sim::tasks::{EpisodeEnd, EpisodesError, Fleet, StepOutcome};

fn fleet(seed: u64) -> Fleet {
    Fleet::new(&Warehouse { seed: Seed(3), robots: 20, trailers: false }, Seed(seed)).unwrap()
}

fn places(fleet: &Fleet) -> Vec<Point2> {
    let q = |i: usize| &fleet.frame().robots[i].configuration;
    (0..fleet.len()).map(|i| Point2::new(q(i)[0], q(i)[1])).collect()
}

#[test]
fn rovers_earn_how_much_nearer_they_came_and_stand_when_they_have_ended() {
    let mut fleet = fleet(1);
    let count = fleet.len();
    assert_eq!((count, fleet.actions(), fleet.observations()), (16, 2, 363));
    let mut seen = vec![0.0; count * 363];
    fleet.observe(&mut seen).unwrap();
    let goals: Vec<Point2> = fleet.goals().collect();
    let apart = |fleet: &Fleet| places(fleet).iter().zip(&goals).map(|(p, goal)| (goal - p).norm()).collect::<Vec<_>>();
    let first = apart(&fleet);
    assert!(first.iter().all(|d| (1.0..=4.0).contains(d)), "{first:?}");
    assert!((0..count).all(|i| (f64::from(seen[i * 363 + 360]) * 4.0 - first[i]).abs() < 1e-6));
    let mut earned = vec![0.0; count];
    let mut stands = vec![None; count];
    for _ in 0..300 {
        let toward = |i: usize| {
            let (cos, sin) = (seen[i * 363 + 361], seen[i * 363 + 362]);
            [if cos > 0.9 { 1.0 } else { 0.0 }, if sin > 0.0 { 1.0 - cos } else { cos - 1.0 }]
        };
        let actions: Vec<f32> = (0..count).flat_map(toward).collect();
        let outcomes = fleet.step(&actions, &mut seen).unwrap().to_vec();
        for (i, (outcome, at)) in outcomes.iter().zip(places(&fleet)).enumerate() {
            if let Some(stood) = stands[i] {
                assert_eq!((*outcome, at), (StepOutcome::default(), stood), "rover {i} has ended and stands");
                continue;
            }
            earned[i] += outcome.reward;
            if let Some(end) = outcome.end {
                let worth = if end == EpisodeEnd::Reached { 1.0 } else { -1.0 };
                assert!((earned[i] - (first[i] - apart(&fleet)[i] + worth)).abs() < 1e-9, "rover {i}");
                stands[i] = Some(at);
            }
        }
    }
    let ends: Vec<_> = fleet.ends().collect();
    assert_eq!(
        ends.iter().map(Option::is_some).collect::<Vec<_>>(),
        stands.iter().map(Option::is_some).collect::<Vec<_>>()
    );
    for end in [EpisodeEnd::Reached, EpisodeEnd::Contact] {
        assert!(ends.contains(&Some(end)), "{ends:?}");
    }
    let log = fleet.log().unwrap();
    assert_eq!((log.ticks(), log.frame(300)), (300, Some(fleet.frame())));
    assert_eq!(verify(&log, |_| {}).unwrap().identical, 300);
}

#[test]
fn a_fleet_is_a_function_of_its_seeds() {
    let run = |fleet: &mut Fleet| {
        let mut seen = vec![0.0; fleet.len() * fleet.observations()];
        (0..40).for_each(|_| _ = fleet.step(&[1.0, 0.1].repeat(16), &mut seen).unwrap());
        (fleet.frame().clone(), fleet.goals().collect::<Vec<_>>(), seen)
    };
    let mut one = fleet(1);
    let first = run(&mut one);
    one.begin_next().unwrap();
    let second = run(&mut one);
    assert!(second.1 != first.1);
    let mut two = fleet(2);
    assert!(run(&mut two).1 != first.1);
    two.begin(Seed(1)).unwrap();
    assert!(run(&mut two) == first);
    let mut other = fleet(1);
    other.begin_next().unwrap();
    assert!(run(&mut other) == second);
}

#[test]
fn wrong_numbers_of_a_fleet_are_refused_and_change_nothing() {
    let mut fleet = fleet(1);
    let mut seen = vec![7.0; 16 * 363];
    let mut says = |actions: &[f32], places: usize| {
        let said = fleet.step(actions, &mut seen[..places]).map(<[StepOutcome]>::to_vec).unwrap_err();
        assert!(fleet.frame().tick == 0 && seen.iter().all(|x| *x == 7.0));
        said.to_string()
    };
    assert_eq!(says(&[0.0; 31], 5808), "31 numbers in actions, but 32 are needed: 2 for each of 16 episodes");
    assert!(says(&[0.0; 32], 5807).starts_with("5807 places for observations"));
    let mut actions = [0.0; 32];
    actions[11] = f32::INFINITY;
    assert_eq!(says(&actions, 5808), "the action of episode 5 is not finite");
    let few = Fleet::new(&Warehouse { seed: Seed(3), robots: 9, trailers: false }, Seed(1)).err().unwrap();
    assert!(matches!(few, EpisodesError::Warehouse(_)) && few.to_string().starts_with("9 robots"));
}
