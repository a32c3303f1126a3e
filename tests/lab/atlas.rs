//! The atlas and the configuration space from outside: a world drawn by hand runs at once, and the cells of a
//! configuration space agree with a brute-force raster.

use std::process::Command;

use motion_lab::atlas::{Atlas, EditShape, Editor, Op};
use motion_lab::collision::{Checker, Scene};
use motion_lab::configuration::Configuration;
use motion_lab::cspace::{CellMap, CellState, Slice};
use motion_lab::geometry::{Point2, Vector2};
use motion_lab::random::{Seed, Stream};
use motion_lab::recording::Run;
use motion_lab::robots::{AnyRobot, Reach};
use motion_lab::run::{Event, Quantized, RobotInput, Script};
use motion_lab::tour::TourConfig;
use motion_lab::worlds::World;

#[test]
fn a_world_drawn_in_the_editor_is_checked_and_toured_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("drawn.ron");
    let mut editor = Editor::new(World::lot());
    let p = Point2::new;
    let ops = [
        Op::Add {
            name: "the island".into(),
            shape: EditShape::Polygon(vec![p(12.0, 1.0), p(14.0, 1.0), p(14.0, 2.0), p(13.0, 1.4), p(12.0, 2.0)]),
        },
        Op::Add { name: "the hedge".into(), shape: EditShape::Wall(vec![p(1.0, 4.0), p(2.0, 4.0), p(2.5, 4.5)]) },
        Op::Move { name: "the west pillar".into(), by: Vector2::new(-0.5, 0.0) },
        Op::Rename { name: "the aisle".into(), to: "the way in".into() },
    ];
    for op in &ops {
        editor.apply(op).unwrap();
    }
    assert!(editor.warnings().is_empty());
    std::fs::write(&file, editor.text()).unwrap();
    let path = file.to_str().unwrap();
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_motion-lab")).args(arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let hash = format!("{:032x}", editor.world().content_hash());
    assert!(run(&["world", "check", path]).contains(&hash), "the file is the world that was drawn");
    assert_eq!(run(&["world", "show", path]), std::fs::read_to_string(&file).unwrap(), "it is saved in canonical form");
    let log = folder.path().join("d.mcap");
    run(&["record", "--world", path, "--seconds", "5", "-o", log.to_str().unwrap()]);
    run(&["verify", log.to_str().unwrap()]);
    assert_eq!(Editor::open(path, &std::fs::read_to_string(&file).unwrap()).unwrap().text(), editor.text());
}

#[test]
fn the_atlas_and_a_run_accept_and_refuse_the_same_teleports() {
    let mut world = World::apartment();
    world.robots.truncate(1);
    let name = world.robots[0].name.clone();
    let mut s = Stream::new(Seed(4), "tests/teleports");
    let mut atlas = Atlas::new(world.clone());
    let (mut events, mut refused) = (Vec::new(), 0);
    for tick in 1..=120 {
        let to = [s.uniform(0.0, 12.0), s.uniform(0.0, 8.0), s.uniform(-3.0, 3.0)];
        let to = to.map(|x| Quantized::try_new(x).unwrap());
        let q = (0..3).fold(atlas.robots()[0].q, |q, i| q.with(i, to[i].value()));
        refused += u32::from(atlas.teleport(0, q).unwrap().is_err());
        events.push(Event { tick, robot: name.clone(), input: RobotInput::Teleport(to.to_vec()) });
    }
    assert!(refused > 20 && refused < 100, "{refused} of 120");
    let config = TourConfig { worlds: vec![world], ticks: 121, ..TourConfig::default() };
    let log = Run::record(config, (Seed(1), Script { events, ..Script::empty() })).unwrap();
    let rusty = &log.frames().last().unwrap().robots[0];
    assert_eq!(rusty.refusals, refused);
    assert_eq!(rusty.configuration, atlas.robots()[0].q.coordinates(), "and it stands where the atlas has it");
}

/// Compares every proven cell with a raster of exact answers, and prints the share of unknown cells over time.
#[test]
fn the_torus_of_the_workbench_against_a_brute_force_raster() {
    let side = 256_usize;
    for (name, arm) in [("bare links", Reach::choset()), ("3 cm links", Reach::workbench())] {
        let robot = AnyRobot::Reach(arm);
        let (_, q) = AnyRobot::of_kind("reach", &[0.0, 0.0]).unwrap();
        let checker = Checker::new(Scene::workbench(), robot);
        let slice = Slice::through(&checker, &q).unwrap();
        // the middle of each cell of a raster as fine as the finest cells
        let at = |k: usize| {
            let part = |i: usize| std::f64::consts::PI * (2.0 * (i as f64 + 0.5) / side as f64 - 1.0);
            [part(k % side), part(k / side)]
        };
        let samples: Vec<_> = (0..side * side).map(|k| slice.at(at(k))).collect();
        let truth = checker.are_free(&samples);
        let mut map = CellMap::new(slice, 8);
        let mut last = 1.0;
        for judged in [1000, 1000, 3000, 5000, u32::MAX] {
            map.refine(judged);
            let image = map.raster(8);
            for (k, state) in image.iter().enumerate() {
                let contradicts = match state {
                    CellState::Free => !truth[k],
                    CellState::Blocked => truth[k],
                    CellState::Unknown => false,
                };
                assert!(!contradicts, "{name}: {:?} is {state:?}", samples[k]);
            }
            let progress = map.progress();
            println!("{name}: {} cells judged, {:.2} % unknown", progress.judged, 100.0 * progress.unknown);
            assert!(progress.unknown < last, "{name}: each time less");
            last = progress.unknown;
        }
        assert!(map.progress().done && last < 0.07, "{name}: {last} unknown at the end");
        let free = truth.iter().filter(|f| **f).count() as f64 / truth.len() as f64;
        let progress = map.progress();
        assert!(progress.free <= free + 0.01 && free <= progress.free + progress.unknown + 0.01, "{name}: {free}");
    }
}
