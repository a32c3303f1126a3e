//! Episodes: the runs that they are, what follows their end, and what is refused.

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::verify;
use motion_lab_sim::tasks::{
    Autoreset, EpisodeEnd, Episodes, EpisodesError, HitchPark, LearningTask, ReachPost, RustyGoal, StepOutcome,
};

/// Actions drawn for `count` episodes at a step.
pub(super) fn actions<T: LearningTask>(task: &T, draws: &mut Stream, count: usize) -> Vec<f32> {
    (0..count * task.setting().actions).map(|_| draws.uniform(-1.0, 1.0) as f32).collect()
}

/// Steps episodes by drawn actions and compares them with their logs.
fn are_the_runs_of_their_logs<T: LearningTask>(task: impl Fn() -> T, least: usize) {
    let mut episodes = Episodes::new(task(), (0..3).map(Seed), Autoreset::NextStep).unwrap();
    let mut draws = Stream::new(Seed(5), "actions");
    let mut seen = vec![0.0; 3 * episodes.observations()];
    let mut ends = 0;
    let mut held = Vec::new();
    for step in 0..240 {
        if step % 40 == 0 {
            held = actions(episodes.task(), &mut draws, 3);
            held.iter_mut().step_by(2).for_each(|ahead| *ahead = 1.0);
        }
        let outcomes = episodes.step(&held, &mut seen).unwrap();
        ends += outcomes.iter().filter(|outcome| outcome.end.is_some()).count();
        if step % 40 != 39 {
            continue;
        }
        for i in 0..3 {
            let log = episodes.log(i).unwrap();
            assert_eq!(log.ticks(), episodes.tick(i));
            if log.ticks() > 0 {
                assert_eq!(log.frame(log.ticks()), Some(&episodes.frame(i)), "episode {i}, step {step}");
            }
            let verification = verify(&log, |_| {}).unwrap();
            assert_eq!((verification.identical, verification.difference), (log.ticks(), None));
        }
    }
    assert!(ends >= least, "{ends} episodes ended");
}

#[test]
fn an_episode_is_the_run_of_its_log() {
    are_the_runs_of_their_logs(RustyGoal::new, 1);
    are_the_runs_of_their_logs(HitchPark::new, 1);
    are_the_runs_of_their_logs(ReachPost::new, 1);
}

#[test]
fn starts_are_free_and_as_far_from_their_goals_as_the_task_says() {
    let seeds = || (0..200).map(Seed);
    let rovers = Episodes::new(RustyGoal::new(), seeds(), Autoreset::Disabled).unwrap();
    let disc = Checker::new(Scene::apartment(), motion_lab_core::robots::RUSTY);
    let mut far = 0;
    for i in 0..200 {
        let state = &rovers.frame(i).robots[0];
        let q = Pose2::new(state.configuration[0], state.configuration[1], state.configuration[2]);
        let goal = rovers.goal(i);
        let apart = (goal - q.position()).norm();
        assert!(disc.distance(&q) >= 0.2 && (1.0..=4.0).contains(&apart), "{i}: {q}, {apart} m");
        assert!(disc.distance(&Pose2::new(goal.x, goal.y, 0.0)) >= 0.2, "{i}: {goal}");
        far += usize::from(apart > 2.5);
    }
    assert!((20..180).contains(&far), "near and far: {far}");
    let arms = Episodes::new(ReachPost::new(), seeds(), Autoreset::Disabled).unwrap();
    let chain = Checker::new(Scene::workbench(), Reach::<2>::workbench());
    let mut through = 0;
    for i in 0..200 {
        let state = &arms.frame(i).robots[0];
        let q = T2::new(state.configuration[0], state.configuration[1]);
        assert!(chain.is_free(&q) && chain.is_free(arms.goal(i)));
        through += usize::from(!chain.edge_free(&q, arms.goal(i)));
    }
    assert!(through > 190, "the straight way leads through the post: {through} of 200");
}

#[test]
fn an_episode_depends_on_its_own_seed_alone_and_on_no_number_of_threads() {
    let run = |seeds: &[u64], watched: usize| {
        let seeds: Vec<Seed> = seeds.iter().copied().map(Seed).collect();
        let mut episodes = Episodes::new(RustyGoal::new(), seeds.iter().copied(), Autoreset::NextStep).unwrap();
        let width = episodes.observations();
        let mut seen = vec![0.0; seeds.len() * width];
        let mut all: Vec<(Vec<f32>, StepOutcome)> = Vec::new();
        for step in 0..150 {
            // the watched one acts alike wherever it is
            let row = |i: usize| if i == watched { [1.0, 0.0] } else { [0.3, (i + step) as f32 % 2.0] };
            let actions: Vec<f32> = (0..seeds.len()).flat_map(row).collect();
            let outcome = episodes.step(&actions, &mut seen).unwrap()[watched];
            all.push((seen[watched * width..(watched + 1) * width].to_vec(), outcome));
        }
        all
    };
    let alone = run(&[7], 0);
    assert!(alone.iter().any(|(_, outcome)| outcome.end.is_some()), "it hits a wall and begins anew");
    assert_eq!(run(&[1, 2, 7, 3], 2), alone);
    let many: Vec<u64> = (0..300).collect();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| run(&many, 7)), alone, "{threads} threads");
    }
}

/// Drives two rovers ahead until the first one's episode ends.
fn until_an_end(episodes: &mut Episodes<RustyGoal>, seen: &mut [f32]) -> usize {
    for _ in 0..700 {
        let outcomes = episodes.step(&[1.0, 0.0, 1.0, 0.0], seen).unwrap();
        if let Some(ended) = outcomes.iter().position(|outcome| outcome.end.is_some()) {
            return ended;
        }
    }
    panic!("a rover that goes straight ahead hits a wall");
}

#[test]
fn the_three_ways_to_go_on_after_an_end() {
    let begin = |autoreset| Episodes::new(RustyGoal::new(), [Seed(1), Seed(2)], autoreset).unwrap();
    let [mut next, mut same, mut off] = [Autoreset::NextStep, Autoreset::SameStep, Autoreset::Disabled].map(begin);
    let width = next.observations();
    let [mut a, mut b, mut c] = [0, 1, 2].map(|_| vec![0.0; 2 * width]);
    let i = until_an_end(&mut next, &mut a);
    assert_eq!((until_an_end(&mut same, &mut b), until_an_end(&mut off, &mut c)), (i, i));
    let (row, of_end) = (i * width..(i + 1) * width, a[i * width..(i + 1) * width].to_vec());
    assert_eq!(c, a, "what was observed at the end");
    // the same step: what is observed is the new start, the end apart
    assert_eq!(same.final_observation(i), Some(&of_end[..]));
    assert_eq!((same.final_observation(1 - i), next.final_observation(i)), (None, None));
    assert!(same.tick(i) == 0 && next.tick(i) > 0);
    assert_eq!(same.outcomes()[i], next.outcomes()[i]);
    // nothing by itself
    let refused = off.step(&[1.0, 0.0, 1.0, 0.0], &mut c).map(<[StepOutcome]>::to_vec);
    assert_eq!(refused, Err(EpisodesError::Ended(i)));
    off.begin_next(i).unwrap();
    off.observe(&mut c).unwrap();
    assert_eq!(c[row.clone()], b[row.clone()]);
    // the next step: it observes the same new start and earns nothing
    let outcomes = next.step(&[1.0, 0.0, 1.0, 0.0], &mut a).unwrap();
    assert_eq!(outcomes[i], StepOutcome { reward: 0.0, end: None });
    assert_eq!((next.tick(i), &a[row.clone()]), (0, &b[row]));
    assert_eq!(next.goal(i), same.goal(i));
    // another episode, and with another seed the first of that
    let first = begin(Autoreset::Disabled);
    assert!(next.goal(i) != first.goal(i) && next.frame(i) != first.frame(i));
    next.begin(i, Seed(1 + i as u64)).unwrap();
    assert_eq!((next.goal(i), next.frame(i)), (first.goal(i), first.frame(i)));
}

#[test]
fn an_episode_out_of_time_is_cut_off_and_not_ended() {
    let mut episodes = Episodes::new(ReachPost::new(), [Seed(3)], Autoreset::NextStep).unwrap();
    let mut seen = vec![0.0; episodes.observations()];
    for tick in 1..=200 {
        let outcome = episodes.step(&[0.0, 0.0], &mut seen).unwrap()[0];
        let end = (tick == 200).then_some(EpisodeEnd::OutOfTime);
        assert_eq!((outcome.end, outcome.reward), (end, 0.0), "an arm that stands, tick {tick}");
    }
    assert!(EpisodeEnd::OutOfTime.is_truncation() && !EpisodeEnd::Contact.is_truncation());
    assert!(!EpisodeEnd::Reached.is_truncation());
}

#[test]
fn what_a_whole_episode_earns_is_how_much_nearer_it_came_and_what_its_end_is_worth() {
    let mut episodes = Episodes::new(RustyGoal::new(), (0..16).map(Seed), Autoreset::Disabled).unwrap();
    let width = episodes.observations();
    let mut seen = vec![0.0; 16 * width];
    episodes.observe(&mut seen).unwrap();
    let first: Vec<f64> = (0..16).map(|i| f64::from(seen[i * width + 360]) * 4.0).collect();
    let mut earned = [0.0; 16];
    let mut reached = 0;
    for _ in 0..400 {
        // straight for the goal: turn toward it, and go when it is ahead
        let toward = |i: usize| {
            let (cos, sin) = (seen[i * width + 361], seen[i * width + 362]);
            [if cos > 0.9 { 1.0 } else { 0.0 }, if sin > 0.0 { (1.0 - cos).min(1.0) } else { (cos - 1.0).max(-1.0) }]
        };
        let actions: Vec<f32> = (0..16).flat_map(toward).collect();
        let outcomes = episodes.step(&actions, &mut seen).unwrap().to_vec();
        for (i, outcome) in outcomes.iter().enumerate() {
            earned[i] += outcome.reward;
            let Some(end) = outcome.end else { continue };
            let left = f64::from(seen[i * width + 360]) * 4.0;
            let worth = if end == EpisodeEnd::Reached { 1.0 } else { -1.0 };
            assert!((earned[i] - (first[i] - left + worth)).abs() < 1e-5, "{i}: {} of {}", earned[i], first[i]);
            reached += usize::from(end == EpisodeEnd::Reached);
            earned[i] = 0.0;
            episodes.begin(i, Seed(i as u64)).unwrap();
            episodes.observe(&mut seen).unwrap();
        }
    }
    assert!(reached > 2, "goals in sight are reached: {reached}");
}

#[test]
fn wrong_numbers_are_refused_and_change_nothing() {
    let mut episodes = Episodes::new(RustyGoal::new(), (0..2).map(Seed), Autoreset::Disabled).unwrap();
    let mut seen = vec![7.0; 2 * episodes.observations()];
    let mut says = |actions: &[f32], places: usize| {
        let said = episodes.step(actions, &mut seen[..places]).map(<[StepOutcome]>::to_vec).unwrap_err();
        assert!(episodes.tick(0) == 0 && seen.iter().all(|x| *x == 7.0));
        said.to_string()
    };
    assert_eq!(says(&[0.0; 3], 726), "3 numbers in actions, but 4 are needed: 2 for each of 2 episodes");
    let few = says(&[0.0; 4], 700);
    assert_eq!(few, "700 places for observations, but 726 are needed: 363 for each of 2 episodes");
    assert_eq!(says(&[0.0, 0.0, f32::NAN, 0.0], 726), "the action of episode 1 is not finite");
    assert_eq!(episodes.begin_next(2), Err(EpisodesError::NoEpisode { index: 2, count: 2 }));
    assert!(episodes.log(2).is_err());
    // beyond the greatest is the greatest
    let mut other = Episodes::new(RustyGoal::new(), (0..2).map(Seed), Autoreset::Disabled).unwrap();
    episodes.step(&[9.0, 0.5, 1.0, -7.0], &mut seen).unwrap();
    other.step(&[1.0, 0.5, 1.0, -1.0], &mut seen).unwrap();
    assert!((0..2).all(|i| episodes.frame(i) == other.frame(i)));
}
