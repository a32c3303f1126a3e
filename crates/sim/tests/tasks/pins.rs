//! Pinned episodes: what the tasks let robots observe and earn, by three seeds over 200 steps of drawn actions. A
//! digest may change only when a task is meant to be another; then policies learned before are worth nothing, and the
//! task gets a new name.

use motion_lab_core::prelude::*;
use motion_lab_sim::tasks::{Autoreset, Episodes, HitchPark, LearningTask, ReachPost, RustyGoal};
use xxhash_rust::xxh3::xxh3_64;

use super::episodes::actions;

/// Of [`RustyGoal`], [`HitchPark`] and [`ReachPost`].
const PINS: [&str; 3] = ["79618dd27e97cb81", "d217519e69ec3e15", "409931136ddbd1f4"];

/// The digest of all observations and rewards, and of where episodes ended.
fn digest<T: LearningTask>(task: T) -> String {
    let mut episodes = Episodes::new(task, [Seed(1), Seed(2), Seed(3)], Autoreset::NextStep).unwrap();
    let mut draws = Stream::new(Seed(4), "pins");
    let mut seen = vec![0.0; 3 * episodes.observations()];
    let mut bytes = Vec::new();
    for _ in 0..200 {
        let outcomes = episodes.step(&actions(episodes.task(), &mut draws, 3), &mut seen).unwrap();
        for outcome in outcomes {
            bytes.extend_from_slice(&outcome.reward.to_bits().to_le_bytes());
            bytes.push(outcome.end.map_or(0, |end| 1 + end as u8));
        }
        seen.iter().for_each(|x| bytes.extend_from_slice(&x.to_bits().to_le_bytes()));
    }
    format!("{:016x}", xxh3_64(&bytes))
}

#[test]
fn tasks_are_what_they_were() {
    let now = [digest(RustyGoal::new()), digest(HitchPark::new()), digest(ReachPost::new())];
    assert_eq!(now, PINS);
}
