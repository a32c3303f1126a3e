//! What goes with a removal, and what worlds are left.

use super::super::removal::RemovalGroup;
use super::*;
use crate::run::Quantized;
use motion_lab_core::random::Seed;

const WORLD: &str = r#"World(
    version: 1,
    name: "yard",
    bounds: (min: (0, 0), max: (20, 20)),
    walls: [(name: "fence", points: [(0, 0), (20, 0), (20, 20), (0, 20)], closed: true)],
    obstacles: [
        (name: "heap", shape: Union([
            Disc(center: (5.125, 5), radius: 0.5),
            Polygon([(8, 8), (10, 8), (10, 10), (9, 9), (8, 10)]),
            Box(min: (12, 12), max: (13, 13)),
        ])),
        (name: "post", shape: Disc(center: (3, 3), radius: 0.2)),
    ],
    doors: [(name: "gate", hinge: (1, 1), end: (2, 1), open: true)],
    routes: [(name: "round", points: [(4, 14), (8, 14), (8, 18), (4, 18)], radius: 0.5, speed: 0.4)],
    places: [(name: "here", pose: (x: 1, y: 2, theta: 0))],
    marks: [(name: "line", points: [(0, 1), (2, 1)])],
    robots: [
        (name: "A", kind: "rusty", start: [6.5, 14, 0], route: "round",
            sensors: [(name: "front", rays: 3, range: 2), (name: "rear", rays: 2, range: 2)]),
        (name: "B", kind: "rusty", start: [15, 5, 0]),
    ],
)"#;

fn q(x: f64) -> Quantized {
    Quantized::try_new(x).unwrap()
}

fn recipe() -> Recipe {
    let text = r#"Script(version: 2, events: [
        (tick: 2, robot: "A", input: Drive(1, 0)), (tick: 3, robot: "B", input: Drive(2, 0)),
    ], changes: [
        (tick: 1, world: "yard", change: Add(name: "new", points: [(1048576, 1048576)], radius: 104857)),
        (tick: 2, world: "yard", change: Close("gate")),
        (tick: 3, world: "yard", change: Move(name: "new", to: (1, 2, 3))),
        (tick: 4, world: "yard", change: Move(name: "post", to: (1, 2, 3))),
        (tick: 5, world: "yard", change: Remove("heap")),
    ])"#;
    let worlds = vec![World::parse("yard.ron", WORLD).unwrap(), World::lot()];
    let config = TourConfig { worlds, ticks: 9, sensor: TourConfig::default().sensor };
    let script = Script::parse("drive.ron", text).unwrap();
    assert_eq!(script.check_for(&config), Ok(()));
    assert_eq!(q(1.0).0, 1_048_576);
    Recipe::new(config, (Seed(3), script))
}

fn left(removals: &[Removal]) -> Recipe {
    let left = without(&recipe(), &removals.iter().copied().collect()).unwrap();
    assert_eq!(left.script.check_for(&left.config), Ok(()), "{removals:?}");
    assert_eq!(left.config.validate(), Ok(()), "{removals:?}");
    for world in &left.config.worlds {
        assert_eq!(World::parse("left.ron", &world.to_ron()).as_ref(), Ok(world), "{removals:?}");
    }
    left
}

/// Changes by the name of what they change, and their ticks; events by robot.
fn inputs(recipe: &Recipe) -> (Vec<(u64, &str)>, Vec<&str>) {
    let Script { events, changes, .. } = &recipe.script;
    let changes = changes.iter().map(|change| (change.tick, change.change.name())).collect();
    (changes, events.iter().map(|event| &*event.robot).collect())
}

#[test]
fn what_refers_to_a_part_goes_with_it() {
    let of = |removal| Removal::Of(0, removal);
    let all = [(1, "new"), (2, "gate"), (3, "new"), (4, "post"), (5, "heap")];
    let rest = |names: &[&str]| all.into_iter().filter(|(_, name)| !names.contains(name)).collect::<Vec<_>>();
    assert!(left(&[]) == recipe());
    assert_eq!(inputs(&left(&[of(WorldRemoval::Robot(0))])), (all.to_vec(), vec!["B"]));
    assert_eq!(inputs(&left(&[of(WorldRemoval::Door(0))])), (rest(&["gate"]), vec!["A", "B"]));
    assert_eq!(inputs(&left(&[of(WorldRemoval::Obstacle(2))])), (rest(&["post"]), vec!["A", "B"]));
    assert_eq!(inputs(&left(&[Removal::Change(0)])), (rest(&["new"]), vec!["A", "B"]));
    assert_eq!(inputs(&left(&[Removal::Change(2), Removal::Event(0)])).0, [all[0], all[1], all[3], all[4]]);
    assert_eq!(inputs(&left(&[Removal::World(0)])), (vec![], vec![]));
    assert_eq!(left(&[Removal::World(0)]).script.version, 1);
    let pieces = [0, 1, 2].map(|p| of(WorldRemoval::Piece(1, p)));
    assert_eq!(inputs(&left(&pieces)).0, rest(&["heap"]), "without its pieces it is not there");
    let routeless = left(&[of(WorldRemoval::Route(0))]);
    assert!(routeless.config.worlds[0].robots[0].route.is_none());
    let afoot = left(&[of(WorldRemoval::Following(0))]);
    assert!(afoot.config.worlds[0].robots[0].route.is_none() && afoot.config.worlds[0].routes.len() == 1);
    let one_eyed = left(&[of(WorldRemoval::Sensor(0, 0)), Removal::RunSensor]);
    assert_eq!(one_eyed.config.worlds[0].robots[0].sensors[0].name, "rear");
    assert!(one_eyed.config.sensor.is_none());
}

#[test]
fn pieces_are_shapes_as_written_and_what_is_left_is_as_from_a_file() {
    let removals = RemovalGroup::Pieces.removals(&recipe());
    let of_first = |removal: &&Removal| matches!(removal, Removal::Of(0, _));
    assert_eq!(removals.iter().filter(of_first).count(), 7, "four sides and three shapes");
    for removal in removals {
        let recipe = left(&[removal]);
        let Removal::Of(w, WorldRemoval::Piece(o, p)) = removal else { panic!("{removal:?}") };
        let before = &self::recipe().config.worlds[w].obstacles[o];
        let after = recipe.config.worlds[w].obstacle(&before.name).unwrap();
        assert_eq!(after.written().len(), before.written().len() - 1, "{removal:?}");
        if before.name == "heap" {
            assert_eq!(after.outlines.len(), usize::from(p != 1));
        }
    }
}

#[test]
fn every_single_part_leaves_a_recipe_that_runs() {
    let mut seen = 0;
    for removal in RemovalGroup::ALL.into_iter().flat_map(|group| group.removals(&recipe())) {
        seen += 1;
        let left = left(&[removal]);
        assert!(left != recipe(), "{removal:?}");
        assert!(crate::recording::Recorder::of(&left).is_ok(), "{removal:?}");
    }
    assert!(seen > 30, "{seen} removals");
}

#[test]
fn a_shorter_run_has_no_later_inputs() {
    let short = up_to(&recipe(), 2);
    assert_eq!(inputs(&short), (vec![(1, "new"), (2, "gate")], vec!["A"]));
    assert_eq!(short.config.ticks, 2);
}
