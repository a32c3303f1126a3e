//! The atlas and its editor, behaviour by behaviour.

mod editor;
mod fields;

use bevy::window::FileDragAndDrop;

use super::*;
use motion_lab_core::configuration::Configuration;

/// Drags on the atlas's paper from one point of its world to another.
fn drag_on(harness: &mut Harness<'_, Lab>, from: [f64; 2], to: [f64; 2]) {
    let (from, to) = (at(harness, from), at(harness, to));
    pointer(harness, from, Some(true));
    for i in 1..=6 {
        pointer(harness, from.lerp(to, i as f32 / 6.0), None);
    }
    pointer(harness, to, Some(false));
    harness.run_steps(3);
}

/// Presses a key, with these modifiers.
fn press(harness: &mut Harness<'_, Lab>, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

#[test]
fn a_world_that_is_in_a_file_is_called_by_its_name_until_it_is_edited() {
    let mut model = motion_lab_core::worlds::World::lot();
    model.name = "Yard".into();
    let mut state = AtlasState::of(model);
    assert_eq!(state.label(), "Yard");
    state.mark_saved(std::path::Path::new("somewhere/second.ron"));
    assert_eq!(state.label(), "second.ron");
    state.add(motion_lab_sim::atlas::Template::Disc, motion_lab_core::geometry::Point2::new(3.0, 3.0));
    assert_eq!(state.label(), "second.ron, edited");
    state.mark_saved(std::path::Path::new("third.ron"));
    assert_eq!(state.label(), "third.ron");
}

#[test]
fn the_editor_draws_with_the_mouse_undoes_by_key_and_saves_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bench.ron");
    let text = motion_lab_core::worlds::World::workbench().to_ron();
    std::fs::write(&path, format!("// the bench\n{text}")).unwrap();
    let mut harness = lab(WIDE);
    let opened = crate::window::desktop::files::open_world(harness.state_mut().app.world_mut(), &path);
    assert!(!opened.is_error, "{opened:?}");
    harness.run_steps(3);
    click(&mut harness, "Edit");
    harness.get_by_label("Saving drops the one comment of bench.ron: worlds are saved in canonical form.");
    let saved = crate::window::desktop::files::save_world(harness.state_mut().app.world_mut(), &path);
    assert!(!saved.is_error && std::fs::read_to_string(&path).unwrap() == text);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("Saving drops").is_none());
    // opened and saved again: the same bytes
    crate::window::desktop::files::open_world(harness.state_mut().app.world_mut(), &path);
    crate::window::desktop::files::save_world(harness.state_mut().app.world_mut(), &path);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    harness.run_steps(2);
    // a mark is added where the paper is clicked, moved by its line, and given a corner
    click(&mut harness, "Add mark");
    assert!(atlas(&harness).world().marks.iter().all(|m| m.name != "mark"), "not before it is put");
    let middle = at(&harness, [0.0, 0.0]);
    click_at(&mut harness, middle);
    drag_on(&mut harness, [0.2, 0.0], [0.2, -0.5]);
    drag_on(&mut harness, [0.0, -0.5], [0.0, -0.8]);
    drag_on(&mut harness, [0.5, -0.5], [0.9, -0.5]);
    let points = |h: &Harness<'_, Lab>| {
        let mark = atlas(h).world().marks.iter().find(|m| m.name == "mark").cloned().expect("the mark");
        mark.points.iter().map(|p| [p.x, p.y].map(|c| (c * 1e6).round() / 1e6)).collect::<Vec<_>>()
    };
    assert_eq!(points(&harness), [[-0.5, -0.5], [0.0, -0.8], [0.9, -0.5]]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(points(&harness), [[-0.5, -0.5], [0.0, -0.8], [0.5, -0.5]], "the key undoes the edit");
    assert_eq!(harness.state().app.world().resource::<RunConfig>().config().worlds.len(), 3, "and nothing of the run");
    // a place is turned by its second handle, to a whole step
    click(&mut harness, "Add place");
    click_at(&mut harness, middle);
    let place = atlas(&harness).world().places.last().unwrap().clone();
    let ahead = place.pose.x + 0.05 * 4.8;
    drag_on(&mut harness, [ahead, place.pose.y], [place.pose.x + 0.02, place.pose.y + 0.6]);
    let turned = atlas(&harness).world().places.last().unwrap().pose;
    assert!((turned.theta - std::f64::consts::FRAC_PI_2).abs() < 1e-9 && turned.x == place.pose.x, "{turned:?}");
}

#[test]
fn a_drag_turns_the_robot_and_the_offer_is_taken_by_a_click() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let q = |h: &Harness<'_, Lab>| atlas(h).atlas().robots()[0].q.coordinates();
    let is_ticked = |h: &Harness<'_, Lab>| interface(h).settings.done.iter().any(|task| task == "Put");
    let on_table = at(&harness, [6.0, 6.75]);
    click_at(&mut harness, on_table);
    assert!(!is_ticked(&harness), "refused");
    drag_on(&mut harness, [6.0, 4.0], [6.0, 4.8]);
    assert!(is_ticked(&harness));
    assert!((q(&harness)[2] - std::f64::consts::FRAC_PI_2).abs() < 0.05, "{:?}", q(&harness));
    // on the round table it is refused; the ring of the offer is at the nearest free place
    click_at(&mut harness, on_table);
    let before = q(&harness);
    let items = atlas(&harness).over().items;
    let ring = items.iter().find(|i| i.id == "offer/handle").expect("an offer");
    let motion_lab_core::picture::Drawing::Mark { at: ring, .. } = ring.drawing else { panic!("a mark") };
    let ring = at(&harness, [ring.x, ring.y]);
    click_at(&mut harness, ring);
    assert!(q(&harness) != before && atlas(&harness).refusal().is_none(), "{:?}", q(&harness));
}

#[test]
fn names_come_on_demand_and_the_grid_at_any_resolution() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let scale = 60.0;
    assert!(atlas(&harness).labels(scale).iter().any(|i| i.name == "B's round table"));
    click(&mut harness, "names");
    assert!(harness.state().app.world().resource::<Interface>().0.settings.labels);
    click(&mut harness, "Measure");
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "cell size in metres").rect();
    let before = atlas(&harness).resolution;
    click_at(&mut harness, slider.left_center() + egui::vec2(90.0, 0.0));
    let after = atlas(&harness).resolution;
    assert!(after > before && after <= 1.0, "{before} {after}");
    // pointing shows both distances
    let somewhere = at(&harness, [6.0, 4.0]);
    pointer(&mut harness, somewhere, None);
    harness.run_steps(2);
    let probe = atlas(&harness).probe_items(Some(motion_lab_core::geometry::Point2::new(6.0, 4.0)));
    let words = probe.iter().find(|i| i.id == "probe/words").expect("words");
    let scene = motion_lab_core::collision::Scene::of_world(atlas(&harness).world());
    let point = motion_lab_core::geometry::Footprint::disc(motion_lab_core::geometry::Point2::new(6.0, 4.0), 0.0);
    let exact = motion_lab_core::collision::Collision::distance(&scene, &point);
    assert!(words.name.starts_with(&format!("exact {exact:.3} m, by the grid ")), "{}", words.name);
}

#[test]
fn a_thing_is_renamed_and_a_name_that_is_taken_is_refused_in_place() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let table = at(&harness, [6.0, 6.75]);
    click_at(&mut harness, table);
    assert_eq!(atlas(&harness).selected.as_deref(), Some("B's round table"));
    let rename = |harness: &mut Harness<'_, Lab>, to: &str| {
        harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.name_text.clear();
        harness.run_steps(2);
        harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "name").focus();
        harness.run_steps(2);
        harness.event(Event::Text(to.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
    };
    rename(&mut harness, "the hearth");
    assert!(atlas(&harness).world().obstacle("the hearth").is_some());
    assert_eq!(atlas(&harness).selected.as_deref(), Some("the hearth"));
    rename(&mut harness, "A's bed");
    harness.get_by_label_contains("the name is taken");
    assert!(atlas(&harness).world().obstacle("the hearth").is_some());
}

#[test]
fn a_world_dropped_on_the_window_is_opened_in_the_atlas() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.ron");
    std::fs::write(&path, motion_lab_core::worlds::World::lot().to_ron()).unwrap();
    let mut harness = lab(WIDE);
    let drop_file = |harness: &mut Harness<'_, Lab>, path: &std::path::Path| {
        let world = harness.state_mut().app.world_mut();
        world.init_resource::<crate::window::desktop::dialogs::Dialogs>();
        world.init_resource::<Messages<FileDragAndDrop>>();
        world.write_message(FileDragAndDrop::DroppedFile { window: Entity::PLACEHOLDER, path_buf: path.to_owned() });
        crate::window::desktop::dialogs::dropped(world);
        harness.run_steps(3);
    };
    drop_file(&mut harness, &path);
    harness.get_by_label("mine.ron: opened");
    harness.get_by_label_contains("World Lot");
    assert!(atlas(&harness).is_saved());
    std::fs::write(&path, "World(version: 1, name: \"\")").unwrap();
    drop_file(&mut harness, &path);
    harness.get_by_label_contains("mine.ron: not opened: mine.ron:1:");
    assert_eq!(atlas(&harness).world().name, "Lot", "the present one stays");
}

#[test]
fn a_click_selects_a_door_which_is_dragged_whole_and_by_its_ends() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let selected = |h: &Harness<'_, Lab>| atlas(h).selected.clone();
    // by its leaf, which is open upwards from its hinge, and by its gap
    for place in [[5.5625, 5.25], [5.85, 4.75]] {
        let floor = at(&harness, [5.0, 4.375]);
        click_at(&mut harness, floor);
        assert_eq!(selected(&harness), None);
        let on_door = at(&harness, place);
        click_at(&mut harness, on_door);
        assert_eq!(selected(&harness).as_deref(), Some("door B"));
    }
    let shown = atlas(&harness).over();
    for id in ["selected", "handle/0", "handle/1"] {
        assert!(shown.items.iter().any(|item| item.id == id), "{id}");
    }
    let door = |h: &Harness<'_, Lab>| atlas(h).world().door("door B").map(|d| [d.a.x, d.a.y, d.b.x, d.b.y]);
    drag_on(&mut harness, [5.85, 4.75], [5.85, 5.25]);
    assert_eq!(door(&harness), Some([5.5625, 5.25, 6.4375, 5.25]));
    assert_eq!(selected(&harness).as_deref(), Some("door B"));
    drag_on(&mut harness, [6.4375, 5.25], [6.5, 5.75]);
    drag_on(&mut harness, [5.5625, 5.25], [5.75, 5.5]);
    assert_eq!(door(&harness), Some([5.75, 5.5, 6.5, 5.75]));
    click(&mut harness, "Delete");
    assert_eq!((door(&harness), selected(&harness)), (None, None));
    for _ in 0..4 {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(3);
    }
    assert_eq!(*atlas(&harness).world(), motion_lab_core::worlds::World::apartment());
}

#[test]
fn a_world_takes_no_other_worlds_name_and_is_unsaved_once_it_is_edited() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    assert!(harness.query_by_label("not saved in a file").is_none(), "it is as it came");
    let rename = |harness: &mut Harness<'_, Lab>, text: &str| {
        harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "name of the world").focus();
        harness.run_steps(2);
        press(harness, Modifiers::COMMAND, Key::A);
        harness.event(Event::Text(text.into()));
        harness.run_steps(2);
        press(harness, Modifiers::NONE, Key::Enter);
    };
    rename(&mut harness, "Flat");
    harness.get_by_label("not saved in a file");
    interface_mut(&mut harness).new_world();
    harness.run_steps(3);
    // the one left in the list, and one that is built in
    for taken in ["Flat", "Lot"] {
        rename(&mut harness, taken);
        assert_eq!((&*atlas(&harness).world().name, atlas(&harness).can_undo()), ("New world", [false; 2]));
        harness.get_by_label(&format!("another world is named {taken}"));
    }
    rename(&mut harness, "Yard");
    assert_eq!(atlas(&harness).world().name, "Yard");
    interface_mut(&mut harness).take_from_shelf(0);
    harness.run_steps(3);
    rename(&mut harness, "Apartment");
    assert_eq!(*atlas(&harness).world(), motion_lab_core::worlds::World::apartment(), "its own name again");
}
