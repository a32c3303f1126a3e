//! Why a contact came about: asked by a key or a button, shown on the time line, its way out played and undone.

use super::super::*;
use motion_lab_sim::avoid::{EvasionSet, contact_episodes, explain};
use motion_lab_sim::run::{Event as RunEvent, Recipe, seconds};
use motion_lab_sim::simulation::{Happening, start_run};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// A lab whose rover was driven into a wall, paused some ticks after it, and the first tick in contact.
fn crashed(size: [f32; 2]) -> (Harness<'static, Lab>, u64, Script) {
    let mut harness = lab(size);
    let drive = RunEvent { tick: 1, robot: "Rusty".into(), input: RobotInput::Drive(128, 0) };
    let script = Script::new(vec![drive], vec![]);
    let world = harness.state_mut().app.world_mut();
    start_run(world, TourConfig::default(), (BOOK_SEED, script.clone())).unwrap();
    world.resource_mut::<Transport>().playback = Playback::Playing;
    while !harness.state().robot(0).in_contact {
        harness.step();
    }
    let first = harness.state().transport().tick;
    harness.run_steps(20);
    harness.state_mut().app.world_mut().resource_mut::<Transport>().playback = Playback::Paused;
    // the last contact before the present tick is the rover's own
    harness
        .state_mut()
        .app
        .world_mut()
        .write_message(RunCommand::from(motion_lab_sim::simulation::TransportCommand::Seek(first)));
    harness.run_steps(3);
    (harness, first, script)
}

fn wait(harness: &mut Harness<'_, Lab>) {
    for _ in 0..2000 {
        harness.step();
        if interface(harness).working.is_none() {
            break;
        }
    }
    harness.run_steps(2);
}

#[test]
fn a_contact_is_explained_and_its_way_out_is_a_branch_that_undo_takes_back() {
    let (mut harness, first, script) = crashed(WIDE);
    let before = harness.state().transport();
    harness.key_press(Key::W);
    harness.run_steps(2);
    wait(&mut harness);
    assert_eq!(harness.state().transport(), before, "asking changes nothing");
    let recipe = Recipe::new(TourConfig { ticks: before.frontier, ..TourConfig::default() }, (BOOK_SEED, script));
    let episode = contact_episodes(&recipe, |robot| robot == "Rusty").unwrap().remove(0);
    let why = explain(&recipe, &episode, &EvasionSet::default()).unwrap();
    let way_out = why.going_on.evasion().unwrap();
    let chance = interface(&harness).chance.as_ref().expect("it is explained");
    assert_eq!(chance.way_out.as_ref(), Some(way_out));
    let said = format!("steer away until {:.2} s before", seconds(first - way_out.tick));
    assert!(harness.query_by_label_contains(&said).is_some(), "{}", chance.text);
    // the flag stands at the last chance, before the contact's mark
    let flag = harness.get_by_label_contains("play the way out, from").rect();
    let line = harness.get_by_label("time line, in ticks").rect();
    assert!(flag.bottom() <= line.top() + 1.0 && line.x_range().contains(flag.center().x), "{flag} over {line}");
    click_at(&mut harness, flag.center());
    harness.run_steps(2);
    let now = harness.state().transport();
    assert!(now.playback == Playback::Playing && now.tick < first, "{now:?}");
    assert_eq!(harness.state().script(), &way_out.script);
    assert!(interface(&harness).chance.is_none(), "the run has no such contact any more");
    while harness.state().transport().tick < way_out.free_until {
        assert!(!harness.state().robot(0).in_contact, "tick {}", harness.state().transport().tick);
        harness.step();
    }
    pause(&mut harness);
    click(&mut harness, "Undo");
    assert_eq!(harness.state().script(), &recipe.script);
    assert_eq!(harness.state().transport().frontier, before.frontier);
}

#[test]
fn a_chance_is_for_its_own_contact_and_its_own_inputs() {
    let (mut harness, first, _) = crashed(WIDE);
    harness.key_press(Key::W);
    harness.run_steps(2);
    wait(&mut harness);
    assert_eq!(interface(&harness).chance.as_ref().map(|chance| chance.contact), Some(first));
    // at another contact the key asks about that one
    let marks = harness.state().app.world().resource::<History>().marks().to_vec();
    let other = marks.iter().find(|mark| mark.robot == 1).expect("the arm has met the post").tick;
    assert!(other < first);
    let seek = motion_lab_sim::simulation::TransportCommand::Seek(other);
    harness.state_mut().app.world_mut().write_message(RunCommand::from(seek));
    harness.run_steps(3);
    harness.key_press(Key::W);
    harness.run_steps(2);
    wait(&mut harness);
    assert_eq!(interface(&harness).chance.as_ref().map(|chance| chance.contact), Some(other));
    // an input that leaves the contact as it was makes it another run
    let end = harness.state().transport().frontier;
    let seek = motion_lab_sim::simulation::TransportCommand::Seek(end);
    harness.state_mut().app.world_mut().write_message(RunCommand::from(seek));
    harness.run_steps(3);
    assert!(interface(&harness).chance.is_some());
    let drive = motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input: RobotInput::Drive(9, 0) };
    harness.state_mut().app.world_mut().write_message(RunCommand::from(drive));
    harness.run_steps(3);
    assert!(interface(&harness).chance.is_none());
}

#[test]
fn what_is_known_of_a_contact_goes_with_its_run_and_can_be_put_away() {
    let (mut harness, ..) = crashed(PHONE);
    harness.get_by_label("More").click();
    harness.run_steps(3);
    click(&mut harness, "Why?");
    wait(&mut harness);
    assert!(interface(&harness).chance.is_some());
    click(&mut harness, "Put away");
    assert!(interface(&harness).chance.is_none());
    harness.key_press(Key::W);
    harness.run_steps(2);
    wait(&mut harness);
    assert!(interface(&harness).chance.is_some());
    harness.key_press(Key::G);
    harness.run_steps(3);
    assert!(interface(&harness).chance.is_none(), "another seed is another run");
    harness.key_press(Key::W);
    harness.run_steps(2);
    assert_eq!(interface(&harness).notice().unwrap().text, "No robot has touched anything yet.");
}

#[test]
fn a_contact_of_the_world_in_front_is_explained_before_later_ones_elsewhere() {
    let (mut harness, first, _) = crashed(WIDE);
    // in this run the car touches something at tick 104 and the arm at 113, both after the rover
    let begun = |harness: &Harness<'_, Lab>, robot: u32| {
        let marks = harness.state().app.world().resource::<History>().marks().to_vec();
        let mut contacts = marks.iter().filter(|mark| mark.robot == robot && mark.what == Happening::Contact);
        contacts.rfind(|mark| mark.tick > first).map(|mark| mark.tick)
    };
    harness.state_mut().app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
    while [1, 2].iter().any(|robot| begun(&harness, *robot).is_none()) {
        harness.step();
    }
    pause(&mut harness);
    let [arm, car] = [1, 2].map(|robot| begun(&harness, robot).unwrap());
    assert!(begun(&harness, 0).is_none() && first < car && car < arm, "{first}, {car}, {arm}");
    for (front, asked) in [(0, first), (1, arm), (2, car)] {
        interface_mut(&mut harness).settings.world = front;
        harness.run_steps(3);
        harness.key_press(Key::W);
        harness.run_steps(2);
        wait(&mut harness);
        assert_eq!(interface(&harness).chance.as_ref().map(|chance| chance.contact), Some(asked), "world {front}");
    }
}
