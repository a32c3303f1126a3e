//! Captures of a run in which its world changes show the world as it stands at their tick.

use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::picture::Panel;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::anatomy::{Anatomy, WorldSource};
use motion_lab_sim::capture::{self, Subject, at_tick};
use motion_lab_sim::recording::Run;

use super::*;

const TABLE: &str = "B's round table";
const CHAIR: &str = "A's armchair";

/// Number of halvings of the configuration space.
const FINEST: u32 = 5;

/// A run in which a door is closed at tick 2, an armchair moved at 4, a table removed at 6 and the door opened at 8.
fn log() -> Log {
    let up = (quantized(0.0), quantized(0.25), quantized(0.0));
    let script = changes(&[
        (2, close()),
        (4, WorldChange::Move { name: CHAIR.into(), to: up }),
        (6, WorldChange::Remove(TABLE.into())),
        (8, open()),
    ]);
    Run::record(apartment(9), (Seed(3), script)).unwrap()
}

/// The Apartment after a tick of that run, as a file would have it.
fn after(tick: u64) -> World {
    let mut world = World::apartment();
    world.doors.iter_mut().find(|door| door.name == DOOR).unwrap().open = !(2..8).contains(&tick);
    if tick >= 4 {
        let chair = world.obstacles.iter_mut().find(|o| o.name == CHAIR).unwrap();
        assert_eq!(chair.pieces[0].0, Pose2::IDENTITY);
        chair.pieces[0].0 = Pose2::new(0.0, 0.25, 0.0);
        *chair = motion_lab_core::worlds::Obstacle::new(CHAIR, chair.kind, chair.pieces.clone());
    }
    world.obstacles.retain(|o| tick < 6 || o.name != TABLE);
    world
}

fn panels(log: &Log, subject: &Subject, tick: u64) -> Vec<Panel> {
    at_tick(log, subject, tick, 640.0).unwrap().figure.panels
}

#[test]
fn workspace_and_configuration_space_are_those_of_the_world_as_it_stands() {
    let log = log();
    let (robot, kind) = (Some("Rusty".to_owned()), None);
    let subject = Subject::Cspace { world: None, robot, kind, finest: FINEST, annulus: false };
    let mut spaces: Vec<Panel> = Vec::new();
    for tick in [1, 2, 5, 7, 9] {
        // the same by hand: the robot where it is, in the world that a file would hold
        let frames = std::iter::once(log.initial().unwrap()).chain(log.frames()).take(tick as usize + 1);
        let place = |frame: &Frame| AnyRobot::of_kind("rusty", &frame.robots[0].configuration).unwrap();
        let trace: Vec<_> = frames.map(place).collect();
        let (robot, q) = *trace.last().unwrap();
        let anatomy = Anatomy::new(after(tick), WorldSource::Unsaved, robot, q).unwrap();
        let mut map = CellMap::new(Slice::through(anatomy.checker(), &q).unwrap(), FINEST);
        map.refine(u32::MAX);
        let expected = capture::cspace(&anatomy, &map, trace.iter().map(|(_, q)| *q).collect());
        let found = panels(&log, &subject, tick);
        assert!(found == expected.figure.panels, "tick {tick}");
        // each change shows in the cells: the drawing without the robot's path differs, or what is known does
        assert!(spaces.iter().all(|space| space.readout[1..] != found[1].readout[1..]), "tick {tick}");
        spaces.push(found[1].clone());
    }
}

#[test]
fn cockpits_and_atlas_show_obstacles_where_they_are() {
    let log = log();
    for subject in
        [Subject::Dashboard { names: false, scan: false, nearest: false }, Subject::Atlas { world: None, names: false }]
    {
        for tick in 0..=9 {
            let world = motion_lab_core::picture::world(&after(tick));
            let [panel] = &panels(&log, &subject, tick)[..] else { panic!("one world") };
            let drawn = |id: &str| panel.picture.items.iter().filter(|item| item.id.starts_with(id)).count();
            assert_eq!(drawn("obstacle/"), after(tick).obstacles.len(), "tick {tick}");
            assert_eq!(drawn("door/"), 5 + if (2..8).contains(&tick) { 4 } else { 5 }, "leaves of the open ones");
            assert!(world.items.iter().all(|item| panel.picture.items.contains(item)), "tick {tick}");
        }
    }
}
