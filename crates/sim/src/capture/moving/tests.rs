use super::*;
use crate::run::{Script, WorldChange, WorldEvent};
use motion_lab_core::collision::Collision;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::Robot;

#[test]
fn every_picture_of_a_run_is_the_one_of_its_tick() {
    let door = || "door A".to_owned();
    let change = |tick, change| WorldEvent { tick, world: "Apartment".into(), change };
    let changes = vec![change(2, WorldChange::Close(door())), change(3, WorldChange::Open(door()))];
    let config = TourConfig { worlds: vec![World::apartment()], ticks: 3, sensor: None };
    let log = Run::record(config, (Seed(3), Script::new(vec![], changes))).unwrap();
    let space = Subject::Cspace { world: None, robot: None, kind: None, finest: 3, annulus: false };
    for subject in [space, Subject::Dashboard { names: true, scan: false, nearest: false }] {
        let mut moving = Moving::new(&log, subject.clone(), 640.0).unwrap();
        let mut pictures = Vec::new();
        let see = |run: &Recorder| {
            moving.see(run)?;
            pictures.push(moving.captured(run, true)?.figure);
            Ok::<_, CaptureError>(())
        };
        Run::show(&log, see).unwrap();
        for (tick, picture) in (0..).zip(&pictures) {
            assert!(*picture == at_tick(&log, &subject, tick, 640.0).unwrap().figure, "tick {tick}");
            let open = picture.panels[0].picture.items.iter().any(|item| item.id == "door/door A/leaf");
            assert_eq!(open, tick != 2, "tick {tick}");
        }
    }
}

#[test]
fn what_is_nearest_is_drawn_of_the_world_as_it_stands() {
    let change = WorldEvent { tick: 2, world: "Apartment".into(), change: WorldChange::Close("door A".to_owned()) };
    let config = TourConfig { worlds: vec![World::apartment()], ticks: 3, sensor: None };
    // in the gap of door A's wall, beside the door
    let input = crate::run::RobotInput::Teleport(
        [3.0, 4.3, 0.0].iter().filter_map(|x| crate::run::Quantized::try_new(*x)).collect(),
    );
    let event = crate::run::Event { tick: 1, robot: "Rusty".into(), input };
    let log = Run::record(config, (Seed(3), Script::new(vec![event], vec![change]))).unwrap();
    let subject = |nearest| Subject::Dashboard { names: false, scan: false, nearest };
    for (tick, is_closed) in [(1, false), (2, true), (3, true)] {
        let figure = at_tick(&log, &subject(true), tick, 640.0).unwrap().figure;
        let mut standing = World::apartment();
        standing.doors.iter_mut().filter(|door| door.name == "door A").for_each(|door| door.open = !is_closed);
        let frame = &log.frames()[tick as usize - 1];
        let at = &frame.robots[0].configuration;
        let rover = motion_lab_core::robots::RUSTY.footprint(&Pose2::new(at[0], at[1], at[2]));
        let expected = Scene::of_world(&standing).witness(&rover).unwrap();
        let item = figure.panels[0].picture.items.iter().find(|item| item.id == "witness/1/segment").unwrap();
        let Drawing::Polyline(points) = &item.drawing else { panic!("{:?}", item.drawing) };
        assert_eq!(points[..], [expected.on_robot, expected.on_obstacle], "tick {tick}");
        let bare = at_tick(&log, &subject(false), tick, 640.0).unwrap().figure;
        assert!(bare.panels[0].picture.items.iter().all(|item| !item.id.starts_with("witness")));
    }
}
