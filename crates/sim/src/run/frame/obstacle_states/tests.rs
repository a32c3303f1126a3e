//! Tests of `ObstacleStates` beside a map of the same states, which knows nothing of blocks.

use std::collections::BTreeMap;

use super::*;
use motion_lab_core::random::{Seed, Stream};

type Map = BTreeMap<(u32, u32), ObstacleState>;

fn state(world: u32, obstacle: u32, x: f64) -> ObstacleState {
    ObstacleState { world, obstacle, present: true, pose: Pose2 { x, y: 0.0, theta: 0.0 } }
}

fn of(map: &Map) -> Vec<ObstacleState> {
    map.values().copied().collect()
}

/// The differences of two maps, key by key.
fn differing(before: &Map, after: &Map) -> Vec<ObstacleDifference> {
    let keys: std::collections::BTreeSet<_> = before.keys().chain(after.keys()).copied().collect();
    let bits = |state: Option<&ObstacleState>| state.map(|s| (s.present, s.pose.x.to_bits()));
    let differ = keys.into_iter().filter(|key| bits(before.get(key)) != bits(after.get(key)));
    differ.map(|key| ObstacleDifference { key, after: after.get(&key).copied() }).collect()
}

#[test]
fn states_are_those_of_a_map_and_copies_keep_what_they_had() {
    let mut s = Stream::new(Seed(47), "states");
    let (mut map, mut states) = (Map::new(), ObstacleStates::new());
    let mut copies: Vec<(Map, ObstacleStates)> = Vec::new();
    let (mut largest, mut changed) = (0, 0);
    for round in 0..2500 {
        // few numbers, so that many are set again and taken away; in the last rounds the list grows short
        let (world, number) = (s.below(3) as u32, s.below(300) as u32);
        if s.below(10) < if round < 1700 { 6 } else { 1 } {
            let state = state(world, number, [0.0, -0.0, 1.0, 2.0][s.below(4) as usize]);
            map.insert(state.key(), state);
            states.set(state);
        } else if s.below(100) == 0 {
            map.split_off(&(world, number));
            states.truncate_before((world, number));
        } else {
            map.remove(&(world, number));
            states.remove((world, number));
        }
        assert!(states == of(&map)[..] && states.are_in_order(), "round {round}");
        assert_eq!((states.len(), states.is_empty(), states.last()), (map.len(), map.is_empty(), map.values().last()));
        assert_eq!(states.get((world, number)), map.get(&(world, number)));
        assert!(states.blocks.iter().all(|block| (1..=MAX_BLOCK).contains(&block.len())), "round {round}");
        largest = largest.max(states.blocks.len());
        if round % 50 == 0 {
            for (old, kept) in copies.iter().rev().take(3) {
                let expected = differing(old, &map);
                assert_eq!(states.since(kept), expected, "round {round}");
                changed += expected.iter().filter(|difference| difference.after.is_some()).count();
                let mut again = kept.clone();
                expected.into_iter().for_each(|difference| again.change(difference));
                assert!(again.since(&states).is_empty() && again == states);
                // the same states from elsewhere, in blocks of their own
                let own: ObstacleStates = of(&map).into_iter().collect();
                assert!(own.since(&states).is_empty() && own.clone().sharing(kept).since(&states).is_empty());
            }
            copies.push((map.clone(), states.clone()));
        }
    }
    copies.iter().for_each(|(old, kept)| assert!(*kept == of(old)[..]));
    assert!(largest > 5 && changed > 1000 && map.len() > 10, "{largest} blocks, {changed} changes, {}", map.len());
    states.truncate_before((0, 0));
    assert!(states.is_empty() && states.last().is_none());
}

#[test]
fn the_sign_of_a_zero_is_a_difference() {
    let [plus, minus] = [0.0, -0.0].map(|x| ObstacleStates::from_iter([state(0, 1, x), state(0, 2, 1.0)]));
    assert_eq!(minus.since(&plus), [ObstacleDifference { key: (0, 1), after: Some(state(0, 1, -0.0)) }]);
    assert!(plus.since(&plus.clone()).is_empty());
    let hidden = ObstacleStates::from_iter([ObstacleState { present: false, ..state(0, 1, 0.0) }, state(0, 2, 1.0)]);
    assert_eq!(hidden.since(&plus).len(), 1);
}

/// Of 600 lists, in each of which 16 states more are, a new one takes the block that has changed and the pointers.
#[test]
fn lists_that_grow_share_all_but_the_last_block() {
    let (mut lists, mut read) = (vec![ObstacleStates::new()], vec![ObstacleStates::new()]);
    let (mut bytes, mut alone) = (0, 0);
    for k in 0..600 {
        let mut next = lists[k].clone();
        (16 * k..16 * (k + 1)).for_each(|number| next.set(state(0, number as u32, 0.0)));
        bytes += next.bytes_beyond(&lists[k]);
        alone += next.len() * size_of::<ObstacleState>();
        // as one that is read whole
        read.push(ObstacleStates::from_iter(next.iter().copied()).sharing(&read[k]));
        lists.push(next);
    }
    assert!(alone > 100_000_000 && bytes < 3_000_000, "{bytes} bytes, {alone} without sharing");
    let shared: usize = (1..read.len()).map(|k| read[k].bytes_beyond(&read[k - 1])).sum();
    assert!(shared < 3_000_000, "{shared} bytes of lists that were read");
    // a list that shares nothing counts in full
    assert!(lists[600].bytes_beyond(&ObstacleStates::new()) > 9600 * size_of::<ObstacleState>());
    assert_eq!(lists[600].bytes_beyond(&lists[600]), 150 * size_of::<usize>());
}

#[test]
fn what_is_not_in_order_is_kept_as_it_is() {
    let listed = [state(0, 2, 0.0), state(0, 1, 0.0), state(0, 1, 5.0)];
    let states = ObstacleStates::from_iter(listed).sharing(&ObstacleStates::from_iter([state(0, 1, 0.0)]));
    assert!(states == listed && !states.are_in_order());
}
