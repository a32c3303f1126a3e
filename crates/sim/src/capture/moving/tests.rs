use super::*;
use crate::run::{Script, WorldChange, WorldEvent};
use motion_lab_core::random::Seed;

#[test]
fn every_picture_of_a_run_is_the_one_of_its_tick() {
    let door = || "door A".to_owned();
    let change = |tick, change| WorldEvent { tick, world: "Apartment".into(), change };
    let changes = vec![change(2, WorldChange::Close(door())), change(3, WorldChange::Open(door()))];
    let config = TourConfig { worlds: vec![World::apartment()], ticks: 3, sensor: None };
    let log = Run::record(config, (Seed(3), Script::new(vec![], changes))).unwrap();
    let space = Subject::Cspace { world: None, robot: None, kind: None, finest: 3, annulus: false };
    for subject in [space, Subject::Dashboard { names: true, scan: false }] {
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
