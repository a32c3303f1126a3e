//! What outlives the window: the run under way, the recent files.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::*;
use crate::window::desktop::files::{open_any, save_world};
use crate::window::desktop::persistence::autosave::{AutosavePlugin, EVERY};

/// A window that keeps its run in this folder.
fn window(folder: &Path) -> Harness<'static, Lab> {
    let mut app = app(Duration::from_millis(25));
    app.add_plugins(AutosavePlugin { folder: Some(folder.to_owned()) });
    lab_of(app, WIDE)
}

/// The number of frames after which the run has been compared with what was written once more.
fn a_look() -> usize {
    EVERY.as_millis() as usize / 25 + 2
}

/// The runs in the folder, in the order of their names.
fn runs(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    let mut runs: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|e| e == "run")).collect();
    runs.sort();
    runs
}

/// Drives Rusty for a while, pauses, and waits until the run as it then stands is written. Returns the file.
fn drive(harness: &mut Harness<'_, Lab>, folder: &Path) -> PathBuf {
    let others = runs(folder);
    arm_rusty(harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(30);
    harness.key_up(Key::ArrowUp);
    harness.key_down(Key::ArrowLeft);
    harness.run_steps(20);
    harness.key_up(Key::ArrowLeft);
    harness.run_steps(10);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    pause(harness);
    // it need not stand at its end
    (0..3).for_each(|_| click(harness, "Back"));
    let wanted = format!("tick:{},", harness.state().transport().tick);
    let start = Instant::now();
    loop {
        harness.run_steps(a_look());
        let written = runs(folder).into_iter().filter(|run| !others.contains(run));
        let is_whole = |run: &PathBuf| fs::read_to_string(run).is_ok_and(|text| text.contains(&wanted));
        if let Some(run) = written.into_iter().find(is_whole) {
            // the thread that wrote it ends too
            harness.run_steps(a_look());
            return run;
        }
        assert!(start.elapsed() < Duration::from_secs(30), "nothing was written in {folder:?}");
    }
}

fn is_offered(harness: &Harness<'_, Lab>) -> bool {
    harness.query_by_label("Bring it back").is_some()
}

fn end(mut harness: Harness<'_, Lab>) {
    harness.state_mut().app.world_mut().write_message(AppExit::Success);
    harness.run_steps(1);
}

#[test]
fn a_run_comes_back_after_a_program_that_ended_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(folder.path());
    drive(&mut harness, folder.path());
    let (before, script) = (harness.state().transport(), harness.state().script().clone());
    let frame = harness.state().app.world().resource::<LatestFrame>().frame().clone();
    assert!(before.tick > 20 && before.tick + 3 == before.frontier && script.events.len() >= 3, "{script:?}");
    drop(harness);
    let mut harness = window(folder.path());
    let words = format!("seed 2005, {} inputs, at tick {}", script.events.len(), before.tick);
    harness.get_by_label_contains(&words);
    assert!(harness.state().script().is_empty(), "it is offered, not forced on anybody");
    harness.run_steps(20);
    click(&mut harness, "Bring it back");
    let now = harness.state().transport();
    assert_eq!((now.seed, now.tick, now.frontier), (before.seed, before.tick, before.frontier));
    assert_eq!(now.playback, Playback::Paused);
    assert_eq!(*harness.state().script(), script);
    assert_eq!(*harness.state().app.world().resource::<LatestFrame>().frame(), frame, "to the last bit");
    harness.get_by_label_contains("bit-identical");
    assert!(!is_offered(&harness));
    // it is the run under way now, kept in this window's own file and no other
    harness.run_steps(a_look());
    let start = Instant::now();
    while runs(folder.path()).len() != 1 || runs(folder.path())[0].to_str().unwrap().ends_with("-0.run") {
        harness.run_steps(a_look());
        assert!(start.elapsed() < Duration::from_secs(30), "{:?}", runs(folder.path()));
    }
    // the tour that stood there comes back by an undo
    click(&mut harness, "Undo");
    assert!(harness.state().script().is_empty());
}

#[test]
fn a_run_without_input_is_neither_kept_nor_offered() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(folder.path());
    harness.run_steps(2 * a_look());
    drop(harness);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    // input that was taken back is none
    let mut harness = window(folder.path());
    drive(&mut harness, folder.path());
    harness.key_press(Key::R);
    harness.run_steps(a_look());
    assert!(runs(folder.path()).is_empty());
    drop(harness);
    assert!(!is_offered(&window(folder.path())));
}

#[test]
fn two_windows_keep_a_run_each_and_a_third_is_offered_neither() {
    let folder = tempfile::tempdir().unwrap();
    let (mut one, mut two) = (window(folder.path()), window(folder.path()));
    let first = drive(&mut one, folder.path());
    two.run_steps(8);
    let second = drive(&mut two, folder.path());
    assert_ne!(first, second);
    let bytes = [fs::read(&first).unwrap(), fs::read(&second).unwrap()];
    assert_ne!(bytes[0], bytes[1], "the second has gone on farther");
    assert!(!is_offered(&window(folder.path())), "both windows are open");
    drop(one);
    let mut third = window(folder.path());
    click(&mut third, "Forget it");
    assert!(!is_offered(&third));
    assert_eq!(runs(folder.path()), [&*second]);
    assert_eq!(fs::read(&second).unwrap(), bytes[1]);
    assert!(!is_offered(&window(folder.path())));
}

#[test]
fn a_damaged_file_is_said_so_and_put_aside() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window(folder.path());
    let run = drive(&mut harness, folder.path());
    drop(harness);
    let mut bytes = fs::read(&run).unwrap();
    let at = bytes.len() / 2;
    bytes[at] ^= 4;
    fs::write(&run, &bytes).unwrap();
    let harness = window(folder.path());
    assert!(!is_offered(&harness));
    let notice = interface(&harness).notice().cloned().unwrap();
    assert!(notice.is_error && notice.text.contains("its file is damaged"), "{notice:?}");
    let aside = run.with_extension("damaged");
    assert!(notice.text.contains(&aside.display().to_string()), "{notice:?}");
    assert_eq!((fs::read(&aside).unwrap(), runs(folder.path()).len()), (bytes, 0));
    drop(harness);
    assert!(interface(&window(folder.path())).notice().is_none(), "said once");
}

#[test]
fn at_the_ordinary_end_only_input_that_is_in_no_file_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let saved = folder.path().join("saved.mcap");
    let kept = folder.path().join("kept");
    let mut harness = window(&kept);
    drive(&mut harness, &kept);
    harness.key_press(Key::Space);
    harness.run_steps(30);
    pause(&mut harness);
    let tick = harness.state().transport().tick;
    end(harness);
    assert_eq!(fs::read_dir(&kept).unwrap().count(), 1, "the run, and no lock");
    let mut harness = window(&kept);
    harness.get_by_label_contains(&format!("at tick {tick}"));
    click(&mut harness, "Bring it back");
    let notice = save_run(harness.state_mut().app.world_mut(), &saved).unwrap();
    assert!(!notice.is_error, "{notice:?}");
    end(harness);
    assert_eq!(fs::read_dir(&kept).unwrap().count(), 0, "it is in the reader's own file");
    // so is a run that was opened, until the reader drives on
    let mut harness = window(&kept);
    open_run(harness.state_mut().app.world_mut(), &saved).unwrap();
    harness.run_steps(a_look());
    assert!(runs(&kept).is_empty());
    harness.key_press(Key::End);
    harness.run_steps(2);
    drive(&mut harness, &kept);
    end(harness);
    assert_eq!(runs(&kept).len(), 1);
}

/// The recent files in the menu, from above.
fn recent(harness: &mut Harness<'_, Lab>) -> Vec<String> {
    let names = interface(harness).recent.files().iter().map(|p| p.file_name().unwrap().to_string_lossy().into_owned());
    let names: Vec<String> = names.collect();
    open_menu(harness);
    let heights: Vec<f32> = names.iter().map(|name| harness.get_by_label(name).rect().top()).collect();
    assert!(heights.is_sorted(), "{names:?} at {heights:?}");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    names
}

fn open_menu(harness: &mut Harness<'_, Lab>) {
    harness.get_by_label("Menu").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Recent files").click();
    harness.run_steps(3);
}

#[test]
fn the_menu_lists_the_files_opened_and_saved_last_and_opens_them() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut harness = lab(WIDE);
    harness.run_steps(20);
    pause(&mut harness);
    harness.get_by_label("Menu").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Recent files").is_none(), "there are none");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    let world = harness.state_mut().app.world_mut();
    assert!(!save_run(world, &at("a.mcap")).unwrap().is_error);
    assert!(!save_world(world, &at("b.ron")).is_error);
    assert_eq!(world.resource::<Interface>().0.recent.files(), [at("b.ron"), at("a.mcap")], "what was saved");
    assert!(!open_any(world, &at("b.ron")).unwrap().is_error);
    assert!(!open_any(world, &at("a.mcap")).unwrap().is_error);
    fs::write(at("c.json"), b"no path").unwrap();
    assert!(open_any(world, &at("c.json")).unwrap().is_error && open_any(world, &at("d.ron")).unwrap().is_error);
    fs::write(at("e.mcap"), b"no run").unwrap();
    assert!(open_any(world, &at("e.mcap")).unwrap().is_error);
    harness.run_steps(3);
    assert_eq!(recent(&mut harness), ["a.mcap", "b.ron"], "once each, and none that was refused");
    // a click opens the file in its widget
    click(&mut harness, "Drive");
    open_menu(&mut harness);
    click(&mut harness, "b.ron");
    assert_eq!(interface(&harness).widget, motion_lab_sim::manifest::Widget::Atlas);
    assert_eq!(interface(&harness).notice().unwrap().text, "b.ron: opened");
    assert_eq!(recent(&mut harness), ["b.ron", "a.mcap"]);
    open_menu(&mut harness);
    click(&mut harness, "a.mcap");
    assert_eq!(interface(&harness).widget, motion_lab_sim::manifest::Widget::Dashboard);
    assert!(interface(&harness).notice().unwrap().text.contains("bit-identical"));
    // one that has gone is said so and leaves the list
    fs::remove_file(at("b.ron")).unwrap();
    open_menu(&mut harness);
    click(&mut harness, "b.ron");
    let notice = interface(&harness).notice().cloned().unwrap();
    assert!(notice.is_error && notice.text.contains("b.ron: it is no longer there"), "{notice:?}");
    assert_eq!(recent(&mut harness), ["a.mcap"]);
}

#[test]
fn what_the_program_was_started_with_is_among_the_recent_files() {
    use crate::window::desktop::window::{Opened, open};
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut harness = lab(WIDE);
    harness.run_steps(20);
    let world = harness.state_mut().app.world_mut();
    assert!(!save_run(world, &at("a.mcap")).unwrap().is_error);
    world.resource_mut::<Interface>().0.recent = Default::default();
    assert!(!open(world, Opened::Log(at("a.mcap"))).unwrap().is_error);
    assert!(open(world, Opened::World(Box::new(motion_lab_core::worlds::World::lot()))).is_none(), "it has no file");
    assert!(
        open(world, Opened::WorldFile(at("b.ron"), Box::new(motion_lab_core::worlds::World::workbench()))).is_none()
    );
    assert_eq!(interface(&harness).recent.files(), [at("b.ron"), at("a.mcap")]);
    assert_eq!(harness.state().app.world().resource::<RunConfig>().config().worlds[0].name, "Workbench");
}
