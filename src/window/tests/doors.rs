//! Doors on the dashboard, and robots put into the run from the atlas.

use super::safe::{read_whole, words};
use super::*;
use motion_lab_sim::run::{RobotInput, WorldChange, WorldEvent};

/// Where a point of the Apartment is in its pane.
fn in_the_apartment(harness: &Harness<'_, Lab>, [x, y]: [f64; 2]) -> Pos2 {
    let world = motion_lab_core::worlds::World::apartment();
    let fit =
        crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(&world), paper(harness, "Apartment"));
    let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
    pos2(x as f32, y as f32)
}

fn changes(harness: &Harness<'_, Lab>) -> Vec<WorldEvent> {
    harness.state().script().changes.clone()
}

fn notice(harness: &Harness<'_, Lab>) -> String {
    harness.state().app.world().resource::<Interface>().0.notice().map_or_else(String::new, |n| n.text.clone())
}

#[test]
fn a_click_on_a_door_closes_it_and_its_link_opens_it_again() {
    for size in [WIDE, PHONE] {
        let mut harness = lab(size);
        pause(&mut harness);
        let tick = harness.state().transport().tick;
        // the gap of door B, from (5.5625, 4.75) to (6.4375, 4.75)
        let at = in_the_apartment(&harness, [6.0, 4.75]);
        click_at(&mut harness, at);
        let close = WorldChange::Close("door B".into());
        assert_eq!(changes(&harness), [WorldEvent { tick: tick + 1, world: "Apartment".into(), change: close }]);
        assert_eq!(
            harness.state().app.world().resource::<Interface>().0.hand.armed,
            None,
            "and takes no robot in hand"
        );
        harness.get_by_label("comes with the next tick");
        harness.get_by_label("door B closes");
        assert!(harness.query_by_label("close door B").is_none());
        click(&mut harness, "Step");
        assert!(harness.query_by_label("comes with the next tick").is_none());
        let standing = |h: &Harness<'_, Lab>| {
            let shown = &h.state().app.world().resource::<ShownDashboard>().0;
            shown.cockpits[0].atlas.world().door("door B").unwrap().open
        };
        assert!(!standing(&harness), "the pane shows it closed");
        click(&mut harness, "open door B");
        click(&mut harness, "Step");
        assert!(standing(&harness));
        assert_eq!(changes(&harness).len(), 2);
        // each is one step to undo
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(3);
        assert_eq!(changes(&harness).len(), 1);
        // a click elsewhere takes Rusty in hand as before
        let at = in_the_apartment(&harness, [6.0, 4.0]);
        click_at(&mut harness, at);
        assert_eq!(harness.state().app.world().resource::<Interface>().0.hand.armed.as_deref(), Some("Rusty"));
    }
}

#[test]
fn a_door_closed_for_a_tick_that_never_came_is_not_in_the_log() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "close door C");
    assert_eq!(changes(&harness).len(), 1);
    let (log, _) = crate::window::run_files::recorded(harness.state().app.world()).unwrap();
    assert_eq!(log.recipe.script, Script::empty());
    click(&mut harness, "Step");
    let (log, _) = crate::window::run_files::recorded(harness.state().app.world()).unwrap();
    assert_eq!(log.recipe.script.changes, changes(&harness));
}

#[test]
fn the_atlas_puts_a_robot_of_the_run_under_way_and_says_why_not() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "close door B");
    click(&mut harness, "Step");
    click(&mut harness, "Atlas");
    // the world as it came, in which the door is open
    interface_mut(&mut harness).atlas = crate::window::ui::AtlasState::default();
    harness.run_steps(3);
    let on_atlas = |h: &Harness<'_, Lab>, [x, y]: [f64; 2]| {
        let paper = h.get_by_label_contains("World Apartment").rect();
        let fit = crate::window::ui::paint::canvas::fit(
            &motion_lab_core::picture::world(&motion_lab_core::worlds::World::apartment()),
            paper,
        );
        let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    };
    let events = |h: &Harness<'_, Lab>| h.state().script().events.clone();
    // in the gap of door B: free in the atlas's own world, not in the run, where the door is closed
    let at = on_atlas(&harness, [6.0, 4.75]);
    click_at(&mut harness, at);
    click(&mut harness, "Put it in the run");
    assert!(notice(&harness).contains("door B"), "{}", notice(&harness));
    assert!(events(&harness).is_empty());
    let at = on_atlas(&harness, [6.0, 4.0]);
    click_at(&mut harness, at);
    click(&mut harness, "Put it in the run");
    let [event] = &events(&harness)[..] else { panic!("one event") };
    let RobotInput::Teleport(to) = &event.input else { panic!("a teleport") };
    assert!((to[0].value() - 6.0).abs() < 0.02 && (to[1].value() - 4.0).abs() < 0.02, "{to:?}");
    click(&mut harness, "Drive");
    click(&mut harness, "Step");
    let there = harness.state().robot(0).coordinates;
    // it stands where it was put: the input took it over from its tour
    assert!((there[0] - 6.0).abs() < 0.02 && (there[1] - 4.0).abs() < 0.02, "{there:?}");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert!(events(&harness).is_empty());
}

#[test]
fn a_run_begins_where_the_atlas_has_its_robot() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "Atlas");
    let robot = |h: &Harness<'_, Lab>| {
        h.state().app.world().resource::<Interface>().0.atlas.atlas().robots()[0].q.coordinates()
    };
    use motion_lab_core::configuration::Configuration as _;
    let paper = harness.get_by_label_contains("World Apartment").rect();
    click_at(&mut harness, paper.center());
    let there = robot(&harness);
    click(&mut harness, "Run from here");
    assert_eq!(harness.state().transport().playback, Playback::Playing, "it runs");
    let worlds = &harness.state().app.world().resource::<RunConfig>().config().worlds;
    assert_eq!((worlds.len(), &worlds[0].robots[0].start[..]), (1, &there[..]));
}

#[test]
fn each_door_bears_its_letter() {
    let harness = lab(WIDE);
    let words = super::safe::words(&harness);
    for (letter, x, y) in [("B", 6.0, 4.75), ("E", 8.0625, 3.25)] {
        let door = motion_lab_core::worlds::World::apartment()
            .doors
            .into_iter()
            .find(|door| door.name == format!("door {letter}"));
        let door = door.expect("a door");
        let middle = door.a + 0.5 * (door.b - door.a);
        assert!((middle.x - x).abs() < 0.5 && (middle.y - y).abs() < 0.5, "{letter}: {middle}");
        let ink = words.iter().find(|(text, ..)| text == letter).expect(letter).1;
        assert!(ink.center().distance(in_the_apartment(&harness, [middle.x, middle.y])) < 4.0, "{letter} at {ink}");
    }
}

#[test]
fn on_a_wide_screen_a_notice_covers_no_door_and_no_word_of_robots_on_wheels() {
    let mut under = Vec::new();
    for world in [0, 2] {
        let mut harness = lab(WIDE);
        pause(&mut harness);
        harness.state_mut().app.world_mut().resource_mut::<Interface>().0.settings.world = world;
        harness.run_steps(3);
        let before: Vec<String> = words(&harness).into_iter().map(|(text, ..)| text).collect();
        // as long as what a link says of another run
        let text = format!("this run differs from the link's: digest {0}, expected {0}", "0".repeat(32));
        let said = crate::window::ui::Notice { text, is_error: true };
        harness.state_mut().app.world_mut().resource_mut::<Interface>().0.say(said);
        harness.run_steps(3);
        let shown = words(&harness);
        let lines = ["this run differs", "Dismiss"].map(|text| read_whole(&harness, text));
        let plate = lines[0].union(lines[1]).expand(8.0);
        let covered = shown.into_iter().filter(|(text, ink, _)| before.contains(text) && plate.intersects(*ink));
        under.extend(covered.map(|(text, ..)| (world, text)));
    }
    assert_eq!(under, []);
}
