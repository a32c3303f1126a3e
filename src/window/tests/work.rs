//! Work that is not lost: runs saved and opened, edits of worlds, keys behind dialogs, drags that end off the paper.

use super::*;
use crate::window::desktop::dialogs::{self, Dialogs};
use motion_lab_sim::atlas::Op;

/// Chooses a world from the atlas's list.
fn choose(harness: &mut Harness<'_, Lab>, name: &str) {
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "world").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(egui::accesskit::Role::Button, name).click();
    harness.run_steps(3);
}

/// Presses a button that adds a thing, without a pointer: the thing goes to the middle of the world.
fn add(harness: &mut Harness<'_, Lab>, name: &str) {
    harness.get_by_label(name).click_accesskit();
    harness.run_steps(3);
}

#[test]
fn the_edits_of_a_world_and_their_undo_survive_a_look_at_another() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    add(&mut harness, "Add box");
    add(&mut harness, "Add disc");
    choose(&mut harness, "Lot");
    assert_eq!(atlas(&harness).world().name, "Lot");
    add(&mut harness, "Add box");
    choose(&mut harness, "Apartment, edited");
    let kept = atlas(&harness);
    assert!(kept.world().obstacle("box").is_some() && kept.world().obstacle("disc").is_some());
    assert_eq!(kept.can_undo(), [true, false]);
    click(&mut harness, "Undo");
    click(&mut harness, "Undo");
    assert_eq!(*atlas(&harness).world(), motion_lab_core::worlds::World::apartment());
    assert_eq!(atlas(&harness).can_undo(), [false, true]);
    choose(&mut harness, "Lot, edited");
    assert!(atlas(&harness).world().obstacle("box").is_some());
    // a file that is opened takes nobody's place
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bench.ron");
    std::fs::write(&path, motion_lab_core::worlds::World::workbench().to_ron()).unwrap();
    crate::window::desktop::files::open_world(harness.state_mut().app.world_mut(), &path);
    harness.run_steps(3);
    assert_eq!(atlas(&harness).world().name, "Workbench");
    choose(&mut harness, "Lot, edited");
    assert!(atlas(&harness).world().obstacle("box").is_some());
    assert_eq!(atlas(&harness).can_undo(), [true, false]);
}

/// The lab with its dialogs.
fn with_dialogs() -> Harness<'static, Lab> {
    with_dialogs_at(WIDE)
}

fn with_dialogs_at(size: [f32; 2]) -> Harness<'static, Lab> {
    let mut harness = lab(size);
    let app = &mut harness.state_mut().app;
    app.init_resource::<Dialogs>().add_systems(Update, dialogs::ask.before(super::super::session::gather));
    harness.run_steps(2);
    harness
}

#[test]
fn no_key_reaches_the_lab_behind_a_dialog() {
    for driven in ["Rusty", "Reach"] {
        let mut harness = with_dialogs();
        harness.run_steps(40);
        if driven == "Rusty" {
            arm_rusty(&mut harness);
        } else {
            bring(&mut harness, "Reach");
            harness.get_by_label("Reach: tip, θ₂ in radians").focus();
        }
        harness.run_steps(2);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
        harness.run_steps(4);
        harness.get_by_label("Open a run");
        let before = (harness.state().transport(), harness.state().script().clone());
        for key in [Key::G, Key::R, Key::Space, Key::ArrowLeft, Key::ArrowUp, Key::N, Key::P, Key::Home, Key::Num3] {
            harness.key_down(key);
            harness.run_steps(2);
            harness.key_up(key);
            harness.run_steps(2);
        }
        assert_eq!((harness.state().transport(), harness.state().script().clone()), before, "{driven}");
        let ui = &harness.state().app.world().resource::<Interface>().0;
        assert!(!ui.settings.plots && ui.hand.armed.is_some() == (driven == "Rusty"));
        // with the dialog gone, the keys are the lab's again
        harness.get_by_label_contains("Cancel").click();
        harness.run_steps(4);
        assert!(harness.query_by_label("Open a run").is_none());
        harness.key_press(Key::G);
        harness.run_steps(3);
        assert_ne!(harness.state().transport().seed.0, 2005);
    }
}

#[test]
fn a_drag_that_ends_off_the_paper_ends() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let (table, beside) = (at(&harness, [6.0, 6.75]), at(&harness, [6.5, 6.75]));
    let paper = harness.get_by_label_contains("World Apartment").rect();
    let off = pos2(beside.x, paper.top() - 12.0);
    pointer(&mut harness, table, Some(true));
    pointer(&mut harness, table.lerp(beside, 0.5), None);
    pointer(&mut harness, beside, None);
    pointer(&mut harness, off, None);
    pointer(&mut harness, off, Some(false));
    harness.run_steps(2);
    assert_eq!(atlas(&harness).drag, None, "the button is up");
    let moved = atlas(&harness).world().clone();
    assert_eq!(atlas(&harness).can_undo(), [true, false], "it stays where it was last shown");
    // the pointer comes back without its button
    let below = at(&harness, [6.0, 4.0]);
    pointer(&mut harness, below, None);
    harness.run_steps(2);
    assert_eq!(*atlas(&harness).world(), moved);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.undo(true);
    assert_eq!(*atlas(&harness).world(), motion_lab_core::worlds::World::apartment());
    // a robot that is turned while it is put: the heading is that of the way to where the button came up
    click(&mut harness, "Put the robot");
    let floor = at(&harness, [6.0, 4.0]);
    let east = pos2(paper.right() + 10.0, floor.y);
    pointer(&mut harness, floor, Some(true));
    pointer(&mut harness, floor.lerp(east, 0.3), None);
    pointer(&mut harness, east, None);
    pointer(&mut harness, east, Some(false));
    harness.run_steps(2);
    assert!(atlas(&harness).over().items.iter().all(|item| !item.id.starts_with("wanted")), "no ghost is left");
    let q = motion_lab_core::configuration::Configuration::coordinates(&atlas(&harness).atlas().robots()[0].q);
    assert!((q[0] - 6.0).abs() < 0.05 && (q[1] - 4.0).abs() < 0.05 && q[2].abs() < 0.05, "{q:?}");
    assert_eq!(atlas(&harness).pressed, None);
}

#[test]
fn a_rename_is_kept_with_the_world_it_was_made_in() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let rename = Op::Rename { name: "B's round table".into(), to: "the hearth".into() };
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.atlas.change(&rename, None);
    harness.run_steps(2);
    choose(&mut harness, "Workbench");
    choose(&mut harness, "Lot");
    choose(&mut harness, "Apartment, edited");
    assert!(atlas(&harness).world().obstacle("the hearth").is_some());
}

#[test]
fn the_names_of_files_say_what_is_in_them() {
    let mut harness = with_dialogs();
    let proposed = |harness: &mut Harness<'_, Lab>, command: SessionCommand| {
        carry_out(harness.state_mut().app.world_mut(), vec![crate::window::ui::Command::Session(command)]);
        harness.run_steps(4);
        let fields: Vec<String> = harness
            .get_all_by_role(egui::accesskit::Role::TextInput)
            .filter_map(|n| n.accesskit_node().value())
            .collect();
        harness.get_by_label_contains("Cancel").click();
        harness.run_steps(4);
        fields
    };
    let fields = proposed(&mut harness, SessionCommand::Save);
    assert!(fields.iter().any(|f| f == "run-2005.mcap"), "{fields:?}");
    let fields = proposed(&mut harness, SessionCommand::SaveWorld);
    assert!(fields.iter().any(|f| f == "apartment.ron"), "{fields:?}");
    let order = crate::window::ui::CaptureState::default().order;
    let tick = harness.state().transport().tick;
    let fields = proposed(&mut harness, SessionCommand::Capture(order));
    let name = format!("dashboard-2005-{tick}.{}", order.form.extension());
    assert!(fields.contains(&name), "{fields:?}, not {name}");
}

#[test]
fn a_run_that_has_not_begun_is_refused_before_a_file_is_named() {
    let mut harness = with_dialogs();
    pause(&mut harness);
    click(&mut harness, "Reset");
    assert_eq!(harness.state().transport().frontier, 0);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run_steps(4);
    assert!(harness.query_by_label("Save the run").is_none() && !interface(&harness).focus.dialog);
    harness.get_by_label("nothing has been run yet; press Play first");
    // after a tick there is something to save
    click(&mut harness, "Step");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run_steps(4);
    harness.get_by_label("Save the run");
}

#[test]
fn a_dialog_has_its_folder_and_a_name_to_read_in_a_small_window() {
    for (size, least) in [([800.0, 600.0], 200.0), ([600.0, 480.0], 80.0)] {
        read_dialog(size, least);
    }
}

/// Asserts that the dialog for saving a run is on a screen of this size in whole, with a name of this width at least.
fn read_dialog(size: [f32; 2], least: f32) {
    let screen = egui::Rect::from_min_size(Pos2::ZERO, size.into());
    let mut harness = with_dialogs_at(size);
    carry_out(harness.state_mut().app.world_mut(), vec![crate::window::ui::Command::Session(SessionCommand::Save)]);
    harness.run_steps(4);
    let is_name = |n: &egui_kittest::Node<'_>| n.accesskit_node().value().as_deref() == Some("run-2005.mcap");
    let field = harness.get_all_by_role(egui::accesskit::Role::TextInput).find(is_name).expect("the name");
    assert!(field.rect().width() >= least && screen.contains_rect(field.rect()), "{}", field.rect());
    let buttons = ["Cancel", "Save"].map(|name| {
        let found = harness.get_all_by_role(egui::accesskit::Role::Button).filter(|n| {
            n.accesskit_node().label().is_some_and(|label| label.contains(name))
                && n.rect().top() > field.rect().top() - 4.0
        });
        found.map(|n| n.rect()).find(|rect| screen.contains_rect(*rect))
    });
    assert!(buttons.iter().all(Option::is_some), "{buttons:?}");
    // the folders on the way to the present one, each of which goes there
    let here = std::env::current_dir().unwrap();
    let folder = here.file_name().unwrap().to_str().unwrap();
    let crumb = harness.get_all_by_role(egui::accesskit::Role::Button).find(|n| {
        let is_above = n.rect().bottom() < field.rect().top() - 100.0;
        is_above && n.accesskit_node().label().as_deref() == Some(folder)
    });
    let crumb = crumb.expect("the present folder").rect();
    assert!(screen.contains_rect(crumb), "{crumb}");
}

#[test]
fn closing_asks_where_edits_would_be_lost() {
    use bevy::window::WindowCloseRequested;
    let closing = |harness: &mut Harness<'_, Lab>| {
        let window = Entity::PLACEHOLDER;
        harness.state_mut().app.world_mut().write_message(WindowCloseRequested { window });
        harness.run_steps(3);
        harness.state().app.should_exit()
    };
    let lab_to_close = || {
        let mut harness = lab(WIDE);
        let app = &mut harness.state_mut().app;
        app.add_message::<WindowCloseRequested>().add_systems(Update, crate::window::desktop::window::close);
        harness
    };
    assert!(closing(&mut lab_to_close()).is_some(), "nothing is lost");
    let mut harness = lab_to_close();
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    add(&mut harness, "Add box");
    choose(&mut harness, "Lot");
    assert_eq!(closing(&mut harness), None, "the Apartment on the shelf has an edit");
    harness.get_by_label("Save Apartment, edited");
    harness.key_press(Key::Num1);
    harness.run_steps(2);
    click(&mut harness, "Keep the window");
    assert!(harness.query_by_label("Close without saving?").is_none());
    assert!(harness.state().app.world().resource::<Interface>().0.hand.armed.is_none(), "keys were the question's");
    assert_eq!(closing(&mut harness), None);
    // saving asks for a file of that world, and keeps the window
    let mut asked = harness.state().app.world().resource::<Messages<SessionCommand>>().get_cursor_current();
    click(&mut harness, "Save Apartment, edited");
    let commands = harness.state().app.world().resource::<Messages<SessionCommand>>();
    assert!(asked.read(commands).any(|command| *command == SessionCommand::SaveWorld));
    assert_eq!((atlas(&harness).label().as_str(), interface(&harness).closing), ("Apartment, edited", None));
    assert_eq!(closing(&mut harness), None, "nothing is saved yet");
    click(&mut harness, "Close and lose the edits");
    assert!(harness.state().app.should_exit().is_some());
    // two edited worlds of one name have two labels
    let mut harness = lab_to_close();
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    add(&mut harness, "Add box");
    choose(&mut harness, "Apartment, as it came");
    add(&mut harness, "Add box");
    add(&mut harness, "Add box");
    assert_eq!(closing(&mut harness), None);
    let labels = ["Apartment, edited", "Apartment (2), edited"];
    labels.into_iter().for_each(|label| _ = harness.get_by_label(&format!("Save {label}")));
    let boxes = |harness: &Harness<'_, Lab>| atlas(harness).world().obstacles.len();
    let two = boxes(&harness);
    click(&mut harness, "Save Apartment, edited");
    assert_eq!((atlas(&harness).label().as_str(), boxes(&harness)), ("Apartment, edited", two - 1));
    // undone, there is nothing to lose
    let mut harness = lab_to_close();
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    add(&mut harness, "Add box");
    click(&mut harness, "Undo");
    assert!(closing(&mut harness).is_some());
}

#[test]
fn what_was_driven_is_saved_and_verifies_to_the_same_digest() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("driven.mcap");
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(60);
    harness.key_up(Key::ArrowUp);
    bring(&mut harness, "Reach");
    drag(&mut harness, "Reach: elbow, θ₁ in radians", [-0.6, 0.9]);
    bring(&mut harness, "Hitch");
    click(&mut harness, "put a trailer on");
    harness.run_steps(60);
    pause(&mut harness);
    harness.key_press(Key::End);
    harness.run_steps(2);
    let last = harness.state().app.world().resource::<LatestFrame>().frame().clone();
    let notice = save_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(!notice.is_error, "{notice:?}");
    let bytes = std::fs::read(&path).unwrap();
    let log = Log::read_mcap(&bytes).unwrap().log;
    assert!(log.recipe.script.events.len() >= 4);
    assert_eq!(log.frames().last(), Some(&last), "what was seen is what was saved");
    assert_eq!(Run::replay(&log).unwrap(), log.frames(), "headless, to the last bit");
    assert!(notice.text.contains(&log.digest().unwrap().to_string()));
    // opened again it says so, and stands at its start
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    let ticks = log.frames().len();
    assert_eq!(opened.text, format!("driven.mcap: bit-identical, {ticks} of {ticks}"));
    let transport = harness.state().transport();
    assert_eq!((transport.tick, transport.frontier), (0, ticks as u64));
    // one bit of one coordinate, in the file of a run that was not: the tick is named and shown
    let mut forged = log.clone();
    let x = &mut forged.frames_mut()[70].robots[0].configuration[0];
    *x = f64::from_bits(x.to_bits() ^ 1);
    let mut file = std::fs::File::create(&path).unwrap();
    forged.write_mcap(&mut file).unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(opened.is_error && opened.text.contains("71"), "{opened:?}");
    assert_eq!(harness.state().transport().tick, 71);
    // of a cut file the sealed beginning is opened, and the notice says how much that is
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    let sealed = harness.state().transport().frontier;
    assert!(sealed > 10 && sealed < ticks as u64 && opened.is_error, "{opened:?}");
    let [whole, cut] = [format!("bit-identical, {sealed} of {ticks}"), format!("{sealed} of {ticks} ticks are whole")];
    assert!(opened.text.contains(&whole) && opened.text.contains(&cut), "{opened:?}");
    // what is no log leaves the run as it is
    let stands = harness.state().transport().tick;
    std::fs::write(&path, b"a cat").unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(opened.is_error && harness.state().transport().tick == stands, "{opened:?}");
}

#[test]
fn the_three_robots_come_back_from_any_run_and_a_new_run_says_what_became_of_the_old() {
    let mut harness = lab(WIDE);
    let cockpits =
        |harness: &Harness<'_, Lab>| harness.state().app.world().resource::<ShownDashboard>().0.cockpits.len();
    click(&mut harness, "Atlas");
    click(&mut harness, "Run this world");
    assert_eq!(cockpits(&harness), 1);
    let said = "A new run. Undo brings back the one before.";
    harness.get_by_label(said);
    click(&mut harness, "The three robots");
    assert_eq!(cockpits(&harness), 3);
    harness.get_by_label(said);
    click(&mut harness, "Undo");
    assert_eq!(cockpits(&harness), 1);
    let said = "Undone. Redo brings it back.";
    // it goes by itself, after six seconds of forty frames each
    harness.run_steps(200);
    harness.get_by_label(said);
    harness.run_steps(60);
    assert!(harness.query_by_label(said).is_none());
    // what went wrong stays
    let text = "it went wrong".to_owned();
    interface_mut(&mut harness).say(crate::window::ui::Notice { text, is_error: true });
    harness.run_steps(500);
    harness.get_by_label_contains("it went wrong");
}

#[test]
fn an_edited_world_stays_in_the_list_beside_the_world_as_it_came() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    let things = |harness: &Harness<'_, Lab>| atlas(harness).world().obstacles.len();
    let before = things(&harness);
    click(&mut harness, "Edit");
    add(&mut harness, "Add box");
    assert_eq!(things(&harness), before + 1);
    choose(&mut harness, "Apartment, as it came");
    assert_eq!((things(&harness), atlas(&harness).label().as_str()), (before, "Apartment"));
    choose(&mut harness, "Apartment, edited");
    assert_eq!((things(&harness), atlas(&harness).label().as_str()), (before + 1, "Apartment, edited"));
}
