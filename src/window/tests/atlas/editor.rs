//! Adding, numbers, keys and new worlds in the editor.

use super::*;

#[test]
fn what_is_added_goes_where_the_paper_is_clicked_and_by_keys_into_the_middle() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    click(&mut harness, "Add disc");
    harness.get_by_label("Click where the disc goes, or drag. Escape drops it.");
    // it is shown under the pointer, and is not there yet
    let place = at(&harness, [2.02, 4.01]);
    pointer(&mut harness, place, None);
    let ghost = atlas(&harness)
        .added_items(motion_lab_sim::atlas::Template::Disc, motion_lab_core::geometry::Point2::new(2.0, 4.0));
    assert_eq!(ghost.len(), 3, "its outline and two handles");
    assert!(atlas(&harness).world().obstacle("disc").is_none());
    click_at(&mut harness, place);
    let disc = |h: &Harness<'_, Lab>, name: &str| {
        let placed = atlas(h).world().obstacle(name).map(|o| o.placed().next().unwrap().core()[0]);
        placed.map(|p| [p.x, p.y])
    };
    assert_eq!(disc(&harness, "disc"), Some([2.0, 4.0]), "on the grid of 5 cm");
    assert_eq!(atlas(&harness).selected.as_deref(), Some("disc"));
    // the next click selects, and adds nothing
    let elsewhere = at(&harness, [4.5, 3.8]);
    click_at(&mut harness, elsewhere);
    assert_eq!((disc(&harness, "disc 2"), atlas(&harness).selected), (None, None));
    // dropped by Escape, and by the button that asked for it
    click(&mut harness, "Add disc");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    click_at(&mut harness, elsewhere);
    click(&mut harness, "Add disc");
    click(&mut harness, "Add disc");
    click_at(&mut harness, elsewhere);
    assert_eq!(disc(&harness, "disc 2"), None);
    // a screen reader has no pointer: the middle of 12 x 8 m
    harness.get_by_label("Add disc").click_accesskit();
    harness.run_steps(3);
    assert_eq!(disc(&harness, "disc 2"), Some([6.0, 4.0]));
    press(&mut harness, Modifiers::NONE, Key::Delete);
    assert_eq!((disc(&harness, "disc 2"), atlas(&harness).selected), (None, None));
    press(&mut harness, Modifiers::NONE, Key::Delete);
    assert!(disc(&harness, "disc").is_some(), "nothing is selected");
}

#[test]
fn what_is_added_is_drawn_by_a_drag_with_its_size_at_the_pointer() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let draw = |harness: &mut Harness<'_, Lab>, add: &str, [from, to]: [[f64; 2]; 2], is_dropped: bool| {
        click(harness, add);
        let [from, to] = [from, to].map(|p| at(harness, p));
        pointer(harness, from, Some(true));
        (1..=4).for_each(|i| pointer(harness, from.lerp(to, i as f32 / 4.0), None));
        let size = crate::window::tests::safe::words(harness).into_iter().find(|(text, ..)| text.contains(" m"));
        if is_dropped {
            press(harness, Modifiers::NONE, Key::Escape);
        }
        pointer(harness, to, Some(false));
        harness.run_steps(2);
        size.map(|(text, ..)| text)
    };
    let ends = |h: &Harness<'_, Lab>, name: &str| {
        let thing = atlas(h).world().obstacle(name).map(|o| o.placed().next().unwrap().core().to_vec());
        thing.map(|ends| ends.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>())
    };
    // from 1 m, 4 m by 3 m and 4 m: 5 m long; off the grid of 5 cm by a centimetre
    let size = draw(&mut harness, "Add wall", [[6.01, 3.99], [9.0, 4.01]], false);
    assert_eq!(size.as_deref(), Some("3.00 m, 0\u{b0}"));
    assert_eq!(ends(&harness, "wall"), Some(vec![[6.0, 4.0], [9.0, 4.0]]));
    assert_eq!(atlas(&harness).selected.as_deref(), Some("wall"));
    // a second one begins at the end of the first, though the pointer is a little off it
    draw(&mut harness, "Add wall", [[9.03, 4.03], [9.0, 4.5]], false);
    assert_eq!(ends(&harness, "wall 2").unwrap()[0], [9.0, 4.0]);
    draw(&mut harness, "Add wall", [[6.0, 4.5], [7.0, 4.5]], true);
    assert_eq!(ends(&harness, "wall 3"), None, "Escape drops it");
    // let go off the paper, it is not drawn, and the next click adds one of the usual size: two units to either side
    draw(&mut harness, "Add wall", [[6.0, 4.5], [14.0, 4.5]], false);
    assert_eq!((ends(&harness, "wall 3"), atlas(&harness).drawn_from), (None, None));
    let there = at(&harness, [7.0, 4.5]);
    click_at(&mut harness, there);
    let width = 4.0 * atlas(&harness).unit();
    let added = ends(&harness, "wall 3").expect("a click adds it");
    assert!((added[1][0] - added[0][0] - width).abs() < 1e-9, "{added:?}");
    click(&mut harness, "Undo");
    // one step back takes one of them away
    click(&mut harness, "Undo");
    assert_eq!((ends(&harness, "wall 2"), ends(&harness, "wall").is_some()), (None, true));
}

#[test]
fn a_robot_is_added_dragged_where_it_starts_and_deleted_and_another_stays_where_it_was_put() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let place = at(&harness, [6.0, 4.0]);
    click_at(&mut harness, place);
    let stands = |h: &Harness<'_, Lab>| atlas(h).atlas().robots()[0].q.coordinates()[..2].to_vec();
    let put = stands(&harness);
    assert!((put[0] - 6.0).abs() < 0.05, "{put:?}");
    click(&mut harness, "Edit");
    let start = |h: &Harness<'_, Lab>, i: usize| atlas(h).world().robots.get(i).map(|r| r.start[..2].to_vec());
    let [x, y] = start(&harness, 0).unwrap()[..] else { panic!("a place") };
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "add a robot").click();
    harness.run_steps(3);
    click(&mut harness, "Hitch");
    let free = at(&harness, [2.0, 4.0]);
    click_at(&mut harness, free);
    assert_eq!(start(&harness, 1), Some(vec![2.0, 4.0]));
    assert_eq!(stands(&harness), put, "the one that was put somewhere is there still");
    drag_on(&mut harness, [2.0, 4.0], [3.0, 4.25]);
    assert_eq!(start(&harness, 1), Some(vec![3.0, 4.25]));
    press(&mut harness, Modifiers::NONE, Key::Backspace);
    assert_eq!((start(&harness, 1), stands(&harness)), (None, put));
    // while the world is edited a robot is where it starts: picked there, and dragged
    let at_start = at(&harness, [x, y]);
    click_at(&mut harness, at_start);
    assert_eq!(atlas(&harness).selected.as_deref(), Some("Rusty"));
    drag_on(&mut harness, [x, y], [5.0, 4.0]);
    assert_eq!(start(&harness, 0), Some(vec![5.0, 4.0]));
    assert_eq!(stands(&harness), [5.0, 4.0], "its start was edited, so it is there");
}

#[test]
fn numbers_are_typed_and_a_refused_one_changes_nothing() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let kind = |harness: &mut Harness<'_, Lab>, field: &str, text: &str| {
        harness.get_by_label(field).focus();
        harness.run_steps(2);
        harness.event(Event::Text(text.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
    };
    // nothing is selected: the world's own
    kind(&mut harness, "Apartment: width", "13");
    assert_eq!(atlas(&harness).world().bounds.max.x, 13.0);
    let table = at(&harness, [6.0, 6.75]);
    click_at(&mut harness, table);
    kind(&mut harness, "B's round table: radius", "0.75");
    let radius = |h: &Harness<'_, Lab>| {
        atlas(h).world().obstacle("B's round table").map(|o| o.placed().next().unwrap().radius())
    };
    assert_eq!(radius(&harness), Some(0.75));
    kind(&mut harness, "B's round table: radius", "0");
    harness.get_by_label_contains("radius 0 m");
    assert_eq!(radius(&harness), Some(0.75));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(radius(&harness), Some(0.5), "one change, one undo");
    // dragged, the change is made once, when it is let go
    let field = harness.get_by_label("B's round table: radius").rect().center();
    pointer(&mut harness, field, Some(true));
    for i in 1..=5 {
        pointer(&mut harness, field + egui::vec2(4.0 * i as f32, 0.0), None);
        assert_eq!(radius(&harness), Some(0.5), "not while it is dragged");
    }
    pointer(&mut harness, field + egui::vec2(20.0, 0.0), Some(false));
    harness.run_steps(3);
    let dragged = radius(&harness).unwrap();
    assert!(dragged > 0.55 && dragged < 1.0, "{dragged}");
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(radius(&harness), Some(0.5), "one drag, one undo");
    // a door is opened and closed
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "find a thing").focus();
    harness.run_steps(2);
    harness.event(Event::Text("door b".into()));
    harness.run_steps(2);
    // the list may lie below what the panel shows
    harness.get_by_label("door B \u{b7} door").click_accesskit();
    harness.run_steps(3);
    assert!(atlas(&harness).world().door("door B").unwrap().open);
    click(&mut harness, "open at the start");
    assert!(!atlas(&harness).world().door("door B").unwrap().open);
}

#[test]
fn arrows_move_what_is_in_front_and_turn_it_with_shift() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let before = harness.state().transport().tick;
    let q = |h: &Harness<'_, Lab>| atlas(h).atlas().robots()[0].q.coordinates().to_vec();
    let place = at(&harness, [6.0, 4.0]);
    click_at(&mut harness, place);
    let [x, y, theta] = q(&harness)[..] else { panic!("a pose") };
    for key in [Key::ArrowRight, Key::ArrowRight, Key::ArrowUp] {
        press(&mut harness, Modifiers::NONE, key);
    }
    let moved = q(&harness);
    assert!((moved[0] - x - 0.1).abs() < 1e-9 && (moved[1] - y - 0.05).abs() < 1e-9, "{moved:?}");
    // 15 degrees are a 24th of a turn; the heading was a whole number of them
    press(&mut harness, Modifiers::SHIFT, Key::ArrowLeft);
    let turned = q(&harness)[2];
    assert!(((turned - theta) * 24.0 / std::f64::consts::TAU - 1.0).abs() < 1e-6, "{theta} {turned}");
    assert_eq!(q(&harness)[..2], moved[..2]);
    // into the corridor's wall it is refused, and the wall named
    for _ in 0..20 {
        press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    }
    assert!(atlas(&harness).refusal().unwrap().starts_with("would overlap the corner of D and E"));
    assert_eq!(harness.state().transport().tick, before, "no tick of the run");
    // the point that is measured, from the middle of the world
    click(&mut harness, "Measure");
    press(&mut harness, Modifiers::NONE, Key::ArrowLeft);
    assert!(atlas(&harness).measured().unwrap().starts_with("At x 5.95, y 4.00 m: exact 0.7"));
    // what is selected; nothing is no robot either
    click(&mut harness, "Edit");
    press(&mut harness, Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(*atlas(&harness).world(), motion_lab_core::worlds::World::apartment());
    let table = at(&harness, [6.0, 6.75]);
    click_at(&mut harness, table);
    press(&mut harness, Modifiers::NONE, Key::ArrowLeft);
    let core = atlas(&harness).world().obstacle("B's round table").unwrap().placed().next().unwrap().core()[0];
    assert_eq!([core.x, core.y], [5.95, 6.75]);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(atlas(&harness).selected, None);
    // with the focus on the paper, as Tab gives it, arrows are the atlas's too
    let table = at(&harness, [5.95, 6.75]);
    click_at(&mut harness, table);
    harness.get_by_label_contains("World Apartment").focus();
    harness.run_steps(2);
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    let core = atlas(&harness).world().obstacle("B's round table").unwrap().placed().next().unwrap().core()[0];
    assert_eq!([core.x, core.y], [6.0, 6.75]);
    // also an arrow that comes in the first frame in which the paper has the focus, and the ones after it
    harness.get_by_label("names").focus();
    harness.run_steps(2);
    harness.get_by_label_contains("World Apartment").focus();
    harness.step();
    for key in [Key::ArrowRight, Key::ArrowDown] {
        harness.key_press(key);
        harness.step();
    }
    let core = atlas(&harness).world().obstacle("B's round table").unwrap().placed().next().unwrap().core()[0];
    assert_eq!([core.x, core.y], [6.05, 6.7]);
    assert!(harness.get_by_label_contains("World Apartment").is_focused());
}

#[test]
fn a_new_world_is_named_filled_and_run_and_the_old_ones_are_kept() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let table = at(&harness, [6.0, 6.75]);
    click_at(&mut harness, table);
    press(&mut harness, Modifiers::NONE, Key::Delete);
    click(&mut harness, "New");
    assert_eq!(atlas(&harness).world().name, "New world");
    let bounds = atlas(&harness).world().bounds;
    let wall: Vec<_> = atlas(&harness).world().obstacles[0].placed().flat_map(|p| p.core().to_vec()).collect();
    assert_eq!(motion_lab_core::geometry::Aabb::around(&wall), Some(bounds), "a wall around it");
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "add a robot").click();
    harness.run_steps(3);
    click(&mut harness, "Rusty");
    let free = at(&harness, [3.0, 2.0]);
    click_at(&mut harness, free);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.name_text.clear();
    harness.run_steps(2);
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "name of the world").focus();
    harness.run_steps(2);
    harness.event(Event::Text("Yard".into()));
    harness.step();
    press(&mut harness, Modifiers::NONE, Key::Enter);
    click(&mut harness, "Run this world");
    let config = harness.state().app.world().resource::<RunConfig>().config().clone();
    assert_eq!(config.worlds.iter().map(|w| w.name.as_str()).collect::<Vec<_>>(), ["Yard"]);
    assert_eq!(config.worlds[0].robots[0].start, [3.0, 2.0, 0.0]);
    // the Apartment without its table is in the list
    let shelf = &interface(&harness).shelf;
    assert!(shelf.iter().any(|kept| kept.label() == "Apartment, edited" && kept.can_undo() == [true, false]));
}

#[test]
fn a_number_typed_for_one_thing_is_never_the_next_ones() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let starts = motion_lab_core::worlds::World::apartment();
    // two boxes of one height, which stands at one place of the panel
    let [first, second] = ["A's bed", "C's bed"];
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.select(Some(first));
    harness.run_steps(2);
    harness.get_by_label(&format!("{first}: height")).focus();
    harness.run_steps(2);
    harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
    harness.step();
    harness.event(Event::Text("0.75".into()));
    harness.step();
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.select(Some(second));
    harness.run_steps(3);
    let of = |h: &Harness<'_, Lab>| atlas(h).world().obstacle(second).unwrap().clone();
    assert_eq!(of(&harness), *starts.obstacle(second).unwrap());
}

#[test]
fn a_warning_moves_neither_a_button_nor_a_field() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let names = ["Add box", "Add disc", "Apartment: width"];
    let places = |h: &Harness<'_, Lab>| names.map(|name| h.get_by_label(name).rect());
    let before = places(&harness);
    let start = atlas(&harness).world().robots[0].start[..2].to_vec();
    click(&mut harness, "Add box");
    let over_rusty = at(&harness, [start[0], start[1]]);
    click_at(&mut harness, over_rusty);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!((atlas(&harness).selected, atlas(&harness).warnings().len()), (None, 1));
    assert!(harness.query_all_by_label_contains("would overlap box").count() > 0, "it is shown");
    assert_eq!(places(&harness), before, "what was pointed at is there still");
}
