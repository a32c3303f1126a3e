//! Worlds in which much comes, moves and goes: the scene and the world as it stands are as if made anew in each tick.

use std::sync::Arc;

use allocation_counter::measure;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Footprint};
use motion_lab_core::num::wrap;
use motion_lab_core::worlds::{Door, Obstacle, ObstacleKind};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::Recipe;
use motion_lab_sim::simulation::{App, Roster, SimulationPlugin, StandingWorld, WorldScene, start_run, step};

use super::*;

fn post(name: &str, x: f64, y: f64) -> Obstacle {
    let piece = (Pose2::new(x, y, 0.0), Shape::Disc { radius: 0.25 });
    Obstacle::new(name, ObstacleKind::Solid, vec![piece])
}

/// A world of this many posts and two doors, one of them open, in which nobody is.
fn yard(posts: usize) -> World {
    let mut world = World::empty("yard", Aabb { min: Point2::origin(), max: Point2::new(40.0, 40.0) });
    let at = |k: usize| (1.0 + (k % 20) as f64, 1.0 + (k / 20) as f64);
    world.obstacles = (0..posts).map(|k| post(&format!("post {k}"), at(k).0, at(k).1)).collect();
    let door = |name: &str, x: f64, open: bool| {
        let (a, b) = (Point2::new(x, 38.0), Point2::new(x + 1.0, 38.0));
        Door { name: name.into(), a, b, open }
    };
    world.doors = vec![door("left", 5.0, false), door("right", 8.0, true)];
    world
}

/// What stands in the yard, by the test's own account: an obstacle where it is at first, where it was moved to, and
/// whether it is there. First come those of the file, then the doors, then the added ones.
struct Account(Vec<(Obstacle, Pose2, bool)>);

impl Account {
    fn of(world: &World) -> Self {
        let posts = world.obstacles.iter().map(|post| (post.clone(), Pose2::IDENTITY, true));
        Account(posts.chain(world.doors.iter().map(|door| (door.leaf(), Pose2::IDENTITY, !door.open))).collect())
    }

    fn change(&mut self, change: &WorldChange) {
        if let WorldChange::Add { name, points, .. } = change {
            let (x, y) = points[0];
            return self.0.push((post(name, x.value(), y.value()), Pose2::IDENTITY, true));
        }
        let (_, pose, is_there) = self.0.iter_mut().find(|(own, ..)| own.name == change.name()).unwrap();
        *is_there = !matches!(change, WorldChange::Open(_) | WorldChange::Remove(_));
        *pose = match change {
            WorldChange::Move { to: (x, y, theta), .. } => Pose2::new(x.value(), y.value(), wrap(theta.value())),
            _ => Pose2::IDENTITY,
        };
    }

    /// The obstacles that stand, and which doors are open.
    fn standing(&self, posts: usize) -> (Vec<Obstacle>, [bool; 2]) {
        let is_door = |k: &usize| (posts..posts + 2).contains(k);
        let placed = |(own, pose, _): &(Obstacle, Pose2, bool)| {
            let pieces = own.pieces.iter().map(|(frame, shape)| (pose.compose(frame), shape.clone())).collect();
            Obstacle::new(&own.name, own.kind, if *pose == Pose2::IDENTITY { own.pieces.clone() } else { pieces })
        };
        let there = self.0.iter().enumerate().filter(|(k, (.., is_there))| *is_there && !is_door(k));
        (there.map(|(_, own)| placed(own)).collect(), [posts, posts + 1].map(|k| !self.0[k].2))
    }
}

/// Random changes, some in each tick: of what stands, what came before and the doors.
fn drawn(posts: usize, ticks: u64, draws: &mut Stream) -> Vec<(u64, WorldChange)> {
    let mut all = Vec::new();
    let (mut added, mut numbers) = (0, 0..);
    for tick in 1..=ticks {
        for _ in 0..draws.below(5) {
            let name = |draws: &mut Stream| match draws.below((posts + added) as u64) as usize {
                k if k < posts => format!("post {k}"),
                k => format!("added {}", k - posts),
            };
            let door = |draws: &mut Stream| ["left", "right"][draws.below(2) as usize].to_owned();
            let (x, y) = (quantized(draws.below(40) as f64), quantized(draws.below(36) as f64));
            all.push((
                tick,
                match draws.below(8) {
                    0..3 => {
                        added += 1;
                        let name = format!("added {}", numbers.next().unwrap());
                        WorldChange::Add { name, points: vec![(x, y)], radius: quantized(0.25) }
                    }
                    3..5 => WorldChange::Move { name: name(draws), to: (x, y, quantized(draws.uniform(-3.0, 3.0))) },
                    5 => WorldChange::Remove(name(draws)),
                    6 => WorldChange::Open(door(draws)),
                    _ => WorldChange::Close(door(draws)),
                },
            ));
        }
    }
    all
}

fn script(of: &[(u64, WorldChange)]) -> Script {
    let event =
        |(tick, change): &(u64, WorldChange)| WorldEvent { tick: *tick, world: "yard".into(), change: change.clone() };
    Script::new(vec![], of.iter().map(event).collect())
}

fn recorder(world: World, ticks: u64, of: &[(u64, WorldChange)]) -> Recorder {
    let config = TourConfig { worlds: vec![world], ticks, sensor: None };
    Recorder::of(&Recipe::new(config, (Seed(1), script(of)))).unwrap()
}

/// Fails unless the run's scene and its world are those of the account.
#[track_caller]
fn assert_agree(run: &Recorder, start: &World, account: &Account, why: &str) {
    let entity = run.world().resource::<Roster>().worlds()[0];
    let standing = &run.world().get::<StandingWorld>(entity).unwrap().0;
    let scene = &run.world().get::<WorldScene>(entity).unwrap().0;
    let (obstacles, open) = account.standing(start.obstacles.len());
    assert_eq!(standing.obstacles, obstacles, "{why}");
    assert_eq!([standing.doors[0].open, standing.doors[1].open], open, "{why}");
    let leaves = start.doors.iter().zip(open).filter(|(_, open)| !open).map(|(door, _)| door.leaf());
    let all: Vec<Obstacle> = obstacles.into_iter().chain(leaves).collect();
    let whole = Scene::of_obstacles(start.bounds, &all);
    assert_eq!(scene.pieces().collect::<Vec<_>>(), whole.pieces().collect::<Vec<_>>(), "{why}");
    assert_eq!(format!("{scene:?}"), format!("{whole:?}"), "{why}");
    for k in 0..20 {
        let probe = Footprint::disc(Point2::new(f64::from(k) * 2.0, f64::from(k * 7 % 40)), 0.2);
        assert_eq!(scene.witness(&probe), whole.witness(&probe), "{why}");
    }
}

#[test]
fn scene_and_world_are_those_of_what_stands_after_every_tick_and_every_seek() {
    for (posts, seed) in [(30, 1), (200, 2)] {
        let mut draws = Stream::new(Seed(seed), "growing");
        let (world, ticks) = (yard(posts), 150);
        let all = drawn(posts, ticks, &mut draws);
        let mut run = recorder(world.clone(), ticks, &all);
        let mut account = Account::of(&world);
        let mut accounts = Vec::new();
        for tick in 1..=ticks {
            run.step();
            all.iter().filter(|(at, _)| *at == tick).for_each(|(_, change)| account.change(change));
            assert_agree(&run, &world, &account, &format!("tick {tick} of {posts} posts"));
            accounts.push(Account(account.0.clone()));
        }
        assert_eq!(run.refusals().count(), 0);
        for _ in 0..20 {
            let tick = 1 + draws.below(ticks);
            run.seek(tick).unwrap();
            assert_agree(&run, &world, &accounts[tick as usize - 1], &format!("seek to {tick}"));
        }
    }
}

/// A scene that somebody puts in the place of the run's does not stay, though it has as many obstacles.
#[test]
fn a_scene_from_outside_gives_way_to_that_of_what_stands() {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SimulationPlugin));
    start_run(app.world_mut(), apartment(9), (Seed(1), changes(&[(3, close())]))).unwrap();
    app.update();
    step(app.world_mut());
    let entity = app.world().resource::<Roster>().worlds()[0];
    let standing = |app: &App| Scene::of_world(&app.world().get::<StandingWorld>(entity).unwrap().0);
    let far = standing(&app).grown(0.25);
    let before: Vec<_> = standing(&app).pieces().map(|(_, piece)| piece.clone()).collect();
    app.world_mut().entity_mut(entity).insert(WorldScene(Arc::new(far)));
    for more in [0, 1, 1] {
        step(app.world_mut());
        let scene = &app.world().get::<WorldScene>(entity).unwrap().0;
        let pieces: Vec<_> = scene.pieces().map(|(_, piece)| piece.clone()).collect();
        assert_eq!((pieces.len(), &pieces[..before.len()]), (before.len() + more, &before[..]));
    }
}

/// Whoever has a scene or a world of before keeps it as it was.
#[test]
fn what_somebody_keeps_of_an_earlier_tick_stays_as_it_was() {
    let add = |k: u64| WorldChange::Add {
        name: format!("added {k}"),
        points: vec![(quantized(0.5 * k as f64), quantized(30.0))],
        radius: quantized(0.25),
    };
    let mut run = recorder(yard(200), 20, &(1..=20).map(|k| (k, add(k))).collect::<Vec<_>>());
    let mut kept = Vec::new();
    for tick in 1..=20 {
        run.step();
        let entity = run.world().resource::<Roster>().worlds()[0];
        let scene = Arc::clone(&run.world().get::<WorldScene>(entity).unwrap().0);
        kept.push((200 + tick, scene, run.standing_worlds().remove(0)));
    }
    for (count, scene, world) in kept {
        assert_eq!((scene.obstacle_count(), world.obstacles.len()), (count + 1, count), "with the closed door");
    }
}

/// The bytes allocated while this number of posts is added, four in each tick.
fn allocated(count: usize) -> u64 {
    let add = |k: usize| WorldChange::Add {
        name: format!("added {k}"),
        points: vec![(quantized((k % 40) as f64), quantized((k / 40) as f64))],
        radius: quantized(0.25),
    };
    let all: Vec<_> = (0..count).map(|k| (1 + k as u64 / 4, add(k))).collect();
    let mut run = recorder(yard(100), count as u64 / 4, &all);
    let info = measure(|| (0..count / 4).for_each(|_| _ = run.step()));
    assert_eq!(run.standing_worlds()[0].obstacles.len(), 100 + count);
    info.bytes_total
}

/// With five times as many ticks and obstacles it would be 25 times as much if each tick made the scene anew.
#[test]
fn a_tick_that_adds_something_makes_no_more_anew_where_there_is_more() {
    let (few, many) = (allocated(400), allocated(2000));
    println!("{few} and {many} bytes");
    assert!(many < 9 * few, "{few} and {many} bytes");
}
