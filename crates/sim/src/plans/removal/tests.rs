//! What to move, against all subsets and against another planner.

use super::*;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{AnyRobot, RUSTY};

fn thing(number: usize) -> Blocker {
    let kind = [BlockerKind::Door, BlockerKind::Obstacle, BlockerKind::Wall][number % 3];
    Blocker { kind, name: format!("{number}") }
}

/// Barriers of `count` things, some of them chosen by a stream; each set that has a thing of all suffices.
fn hidden(stream: &mut Stream, count: usize) -> Vec<BTreeSet<Blocker>> {
    let mut some = |most: usize| (stream.unit() * most as f64) as usize;
    let barriers = 1 + some(6);
    (0..barriers).map(|_| (0..1 + some(3)).map(|_| thing(some(count))).collect()).collect()
}

fn suffices(barriers: &[BTreeSet<Blocker>], set: &BTreeSet<Blocker>) -> bool {
    barriers.iter().all(|barrier| !barrier.is_disjoint(set))
}

/// What is tried first: few things, then few that are no doors, then few walls.
fn rank(set: &BTreeSet<Blocker>) -> [usize; 3] {
    let count = |kinds: &[BlockerKind]| set.iter().filter(|blocker| kinds.contains(&blocker.kind)).count();
    [set.len(), count(&[BlockerKind::Obstacle, BlockerKind::Wall]), count(&[BlockerKind::Wall])]
}

#[test]
fn the_least_set_is_that_of_all_subsets() {
    let mut stream = Stream::new(Seed(7), "removals");
    let (mut small, mut large, mut with_doors) = (0, 0, 0);
    for _ in 0..2000 {
        let count = 8;
        let barriers = hidden(&mut stream, count);
        let decide = |gone: &BTreeSet<Blocker>| {
            let stands = barriers.iter().find(|barrier| barrier.is_disjoint(gone));
            stands.map_or(Decision::Path, |barrier| Decision::Blocked(barrier.clone()))
        };
        let removal = Trials::new(MAX_TRIED, decide).least().unwrap();
        let subsets = (0..1_usize << count)
            .map(|bits| (0..count).filter(|i| bits >> i & 1 == 1).map(thing).collect::<BTreeSet<Blocker>>());
        let enough: Vec<_> = subsets.filter(|set| suffices(&barriers, set)).collect();
        let least = enough.iter().map(rank).min().unwrap();
        let found: BTreeSet<Blocker> = removal.blockers.iter().cloned().collect();
        assert!(suffices(&barriers, &found));
        assert_eq!(removal.is_least, least[0] <= 3, "{barriers:?}");
        if removal.is_least {
            small += 1;
            assert_eq!(rank(&found), least, "{barriers:?}");
        } else {
            large += 1;
            for blocker in &found {
                let fewer: BTreeSet<Blocker> = found.iter().filter(|other| *other != blocker).cloned().collect();
                assert!(!suffices(&barriers, &fewer), "{blocker:?} may stand: {barriers:?}");
            }
        }
        let doors = enough.iter().map(rank).filter(|rank| rank[0] <= 3 && rank[1] == 0).min();
        let expected = doors.filter(|_| rank(&found)[1] > 0).map(|rank| rank[0]);
        with_doors += u32::from(expected.is_some());
        assert_eq!(removal.doors.map(|doors| doors.len()), expected, "{barriers:?}");
    }
    assert!(small > 500 && large > 100 && with_doors > 10, "{small} {large} {with_doors}");
}

#[test]
fn what_stays_undecided_makes_no_claim_to_be_least() {
    let [door, post] = [0, 1].map(thing);
    let all = BTreeSet::from([door.clone(), post.clone()]);
    let decide = |gone: &BTreeSet<Blocker>| match gone.len() {
        0 => Decision::Blocked(all.clone()),
        _ if gone.contains(&post) => Decision::Path,
        _ => Decision::Undecided(NoPath::Unsuited("a narrow gap")),
    };
    let removal = Trials::new(MAX_TRIED, decide).least().unwrap();
    assert_eq!((removal.blockers, removal.is_least), (vec![post], false));
    let never = |_: &BTreeSet<Blocker>| Decision::Undecided(NoPath::Unsuited("a car"));
    assert_eq!(Trials::new(MAX_TRIED, never).least(), Err(NoRemoval::Undecided(NoPath::Unsuited("a car"))));
    let nothing = |_: &BTreeSet<Blocker>| Decision::Blocked(BTreeSet::new());
    assert_eq!(Trials::new(MAX_TRIED, nothing).least(), Err(NoRemoval::Nothing));
    let endless =
        |gone: &BTreeSet<Blocker>| Decision::Blocked(BTreeSet::from([thing(3 + gone.len()), thing(90 + gone.len())]));
    assert_eq!(Trials::new(MAX_TRIED, endless).least(), Err(NoRemoval::TooMany(MAX_TRIED)));
}

fn rover(world: World, [from, to]: [[f64; 2]; 2]) -> Task {
    let [from, to] = [from, to].map(|[x, y]| AnyConfiguration::Pose(Pose2::new(x, y, 0.0)));
    Task::new("Rusty", AnyRobot::Rusty(RUSTY), world, [from, to])
}

fn shut_apartment() -> World {
    let mut world = World::apartment();
    world.doors.iter_mut().for_each(|door| door.open = false);
    world
}

const ROOM_A: [f64; 2] = [2.25, 6.25];
const ROOM_B: [f64; 2] = [6.0, 5.5];
const ROOM_C: [f64; 2] = [9.75, 6.25];

#[test]
fn doors_are_opened_before_walls_are_taken_away() {
    let door = |name: &str| Blocker { kind: BlockerKind::Door, name: name.to_owned() };
    // by the plan: A and C have no wall in common, so two things have to go, and two doors do
    let removal = rover(shut_apartment(), [ROOM_A, ROOM_C]).what_blocks().unwrap();
    assert_eq!((removal.blockers, removal.doors), (vec![door("door A"), door("door C")], None));
    assert!(removal.is_least);
    // A and B have a wall between them, and one that closes both off the corridor: one thing, or two doors
    let removal = rover(shut_apartment(), [ROOM_A, ROOM_B]).what_blocks().unwrap();
    let [Blocker { kind: BlockerKind::Wall, name }] = &removal.blockers[..] else { panic!("{removal:?}") };
    assert!(["the wall between A and B", "the corner of A and B"].contains(&name.as_str()), "{name}");
    assert_eq!((removal.doors, removal.is_least), (Some(vec![door("door A"), door("door B")]), true));
    // nothing is in the way where doors are open; and an end in an obstacle needs that one gone, whatever else
    let removal = rover(World::apartment(), [ROOM_A, ROOM_C]).what_blocks().unwrap();
    assert_eq!((removal.blockers, removal.tried), (vec![], 1));
    let in_bed = rover(World::apartment(), [ROOM_A, [0.75, 7.0]]).what_blocks().unwrap();
    let [Blocker { kind: BlockerKind::Obstacle, name }] = &in_bed.blockers[..] else { panic!("{in_bed:?}") };
    assert_eq!(name, "A's bed");
}

/// Hitch east of a wall of the Lot's middle that has a gate of 4 m in it, which is open or closed, and the way back
/// west.
fn at_the_gate(is_open: bool, trailer: bool) -> Task {
    let text = format!(
        "World(version: 1, name: \"yard\", bounds: (min: (0, 0), max: (26, 9)), walls: [
            (name: \"south\", points: [(13, 0), (13, 2.5)]), (name: \"north\", points: [(13, 6.5), (13, 9)])],
            doors: [(name: \"gate\", hinge: (13, 2.5), end: (13, 6.5), open: {is_open})])"
    );
    let at = |x: f64| [x, 4.5, 0.0, 0.0][..if trailer { 4 } else { 3 }].to_vec();
    let [(robot, start), (_, goal)] = [5.0, 19.0].map(|x| AnyRobot::of_kind("hitch", &at(x)).unwrap());
    Task::new("Hitch", robot, World::parse("yard.ron", &text).unwrap(), [start, goal])
}

#[test]
fn a_cars_gate_is_opened_for_it_to_drive_through_with_its_trailer_or_without() {
    for trailer in [false, true] {
        let removal = at_the_gate(false, trailer).what_blocks().unwrap();
        let gate = Blocker { kind: BlockerKind::Door, name: "gate".to_owned() };
        assert_eq!((removal.blockers, removal.doors, removal.is_least), (vec![gate], None, true));
        let removal = at_the_gate(true, trailer).what_blocks().unwrap();
        assert_eq!((removal.blockers, removal.tried), (vec![], 1));
    }
}

#[test]
fn an_end_outside_the_world_is_undecided() {
    let outside = rover(World::apartment(), [ROOM_A, [20.0, 1.0]]).what_blocks();
    assert!(matches!(outside, Err(NoRemoval::Undecided(NoPath::Problem(_)))), "{outside:?}");
}

/// A square of 6 m, its left side closed off by walls from border to border with gaps that blocks may fill.
fn walled(stream: &mut Stream) -> World {
    let mut some = |from: f64, to: f64| from + (to - from) * stream.unit();
    let mut text = String::new();
    for column in 0..2 {
        let x = 2.0 + 1.7 * f64::from(column) + some(-0.2, 0.2);
        let gap = some(1.0, 4.0);
        text += &format!("(name: \"low {column}\", points: [({x}, 0), ({x}, {gap})]),");
        text += &format!("(name: \"high {column}\", points: [({x}, {}), ({x}, 6)]),", gap + 0.8);
        if some(0.0, 1.0) < 0.8 {
            text += &format!("(name: \"gate {column}\", points: [({x}, {gap}), ({x}, {})]),", gap + 0.8);
        }
    }
    let world = format!("World(version: 1, name: \"w\", bounds: (min: (0, 0), max: (6, 6)), walls: [{text}])");
    World::parse("w.ron", &world).unwrap()
}

#[test]
fn what_one_removal_does_is_what_a_planner_by_tangents_says() {
    let mut stream = Stream::new(Seed(11), "walls");
    let (mut one, mut more) = (0, 0);
    for _ in 0..12 {
        let world = walled(&mut stream);
        let task = rover(world.clone(), [[0.7, 3.0], [5.3, 3.0]]);
        let removal = task.what_blocks().unwrap();
        // the other planner's answer for each thing alone
        let helps = |name: &str| {
            let mut world = world.clone();
            world.obstacles.retain(|obstacle| obstacle.name != name);
            let mut attempt =
                rover(world, [[0.7, 3.0], [5.3, 3.0]]).attempt(PlannerName::VisibilityGraph, Seed(0)).unwrap();
            attempt.solve(&Bounds::default()).is_ok()
        };
        let alone: Vec<_> = world.obstacles.iter().map(|obstacle| &obstacle.name).filter(|name| helps(name)).collect();
        match &removal.blockers[..] {
            [] => assert!(helps("nothing")),
            [single] => {
                one += 1;
                assert!(!helps("nothing") && alone.contains(&&single.name), "{removal:?}: {alone:?}");
            }
            several => {
                more += 1;
                assert!(!helps("nothing") && alone.is_empty() && several.len() == 2, "{removal:?}: {alone:?}");
            }
        }
        assert!(removal.is_least);
    }
    assert!(one >= 2 && more >= 4, "{one} {more}");
}
