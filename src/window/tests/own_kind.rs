//! A kind of robot that the program added: what the window shows of it.

mod sizes;

use super::*;
use motion_lab_core::configuration::{Configuration as _, HitchCfg, RobotKind, Space};
use motion_lab_core::robots::HITCH;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::atlas::Op;
use motion_lab_sim::simulation::{RobotPlugin, start_run};
use motion_lab_sim::tour::TourConfig;

static TUG: RobotKind = RobotKind {
    name: "x-tug",
    title: "Tug",
    home: None,
    usual: None,
    sizes: None,
    coordinates: &["x", "y", "course", "tow"],
    lengths: 2,
    start: "three: x, y, course",
    spaces: &[Space { coordinates: 4, formula: "q = (x, y, c, t)", words: "A tug's course, and its tow's." }],
    drives: true,
    takes: RobotKind::HITCH.takes,
    senses: false,
    has_encoders: false,
    difference: |from, to| HitchCfg::from_coordinates(from)?.difference(&HitchCfg::from_coordinates(to)?).ok(),
    printed: |q| q.first().map(|x| format!("a tug at x = {x:.3}")),
};

fn yard() -> World {
    let mut world = World::lot();
    world.robots = vec![Resident::new("Tug", "x-tug", [8.0, 1.9, 0.0, 0.0])];
    world
}

/// The window of a program that adds tugs, with a run of one in the Lot.
fn lab_with_tugs() -> Harness<'static, Lab> {
    let mut app = app(Duration::from_millis(25));
    app.add_plugins(RobotPlugin::new("x-tug", HITCH.with_trailer()).described(&TUG));
    let config = TourConfig { worlds: vec![yard()], ticks: 100, sensor: None };
    start_run(app.world_mut(), config, motion_lab_core::random::Seed(3)).unwrap();
    app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
    let build = |ui: &mut egui::Ui, lab: &mut Lab| lab.frame(ui);
    let mut harness = Harness::builder().with_size(WIDE).with_step_dt(0.025).build_ui_state(build, Lab { app });
    harness.run_steps(30);
    harness
}

#[test]
fn names_formula_and_plots_are_its_own() {
    let mut harness = lab_with_tugs();
    assert!(harness.state().transport().tick > 5);
    click(&mut harness, "Plots");
    harness.get_by_label_contains("Tug \u{b7} Lot");
    harness.get_by_label("A tug's course, and its tow's.");
    harness.get_by_label_contains("Tug course");
    harness.get_by_label_contains("Tug tow");
    assert!(
        harness.query_by_label_contains("Tug theta").is_none() && harness.query_by_label_contains("Tug psi").is_none()
    );
    assert!(harness.query_by_label_contains("Tug x").is_none(), "its lengths are no angles");
}

#[test]
fn what_holds_it_is_named() {
    let mut harness = lab_with_tugs();
    let input = motion_lab_sim::run::RobotInput::Drive(128, 0);
    let command = motion_lab_sim::simulation::RobotCommand { robot: "Tug".into(), input };
    harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
    harness.run_steps(300);
    let tug = &harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].robots[0];
    assert!(tug.flash && tug.contacts > 0, "it drove into something");
    let scene = motion_lab_core::collision::Scene::of_world(&yard());
    let wall = motion_lab_core::collision::Collision::witness(&scene, &tug.footprint).unwrap().obstacle;
    super::safe::read_whole(&harness, scene.obstacle_name(wall).unwrap());
}

#[test]
fn its_run_is_saved_opened_and_captured() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tug.mcap");
    let mut harness = lab_with_tugs();
    pause(&mut harness);
    let saved = save_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(!saved.is_error, "{saved:?}");
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(!opened.is_error && opened.text.contains("bit-identical"), "{opened:?}");
    let world = harness.state().app.world();
    let run = crate::window::run_files::shown_run(world, 10);
    let figure = crate::window::captured::captured(&world.resource::<Interface>().0, run, 4, 640.0).unwrap().figure;
    assert!(figure.panels[0].picture.items.iter().any(|item| item.name.contains("Tug")));
}

#[test]
fn the_atlas_names_and_draws_it() {
    let mut harness = lab_with_tugs();
    let world = harness.state_mut().app.world_mut();
    let opened = crate::window::run_files::open_world_text(world, "yard.ron", &yard().to_ron());
    assert!(!opened.is_error, "{opened:?}");
    harness.run_steps(3);
    let atlas = &mut harness.state_mut().app.world_mut().resource_mut::<Interface>().into_inner().0.atlas;
    let label = |items: &[motion_lab_core::picture::Item]| items.iter().any(|item| item.id == "name/robots/Tug");
    assert!(label(atlas.labels(60.0)));
    assert!(atlas.over().items.iter().any(|item| item.name.contains("Tug")), "its outline");
    // for who hears the window, its kind prints its start
    harness.get_by_label_contains("World Lot. Tug: a tug at x = 8.000.");
}

/// The editor knows the kind of a file opened in the window, and of a world drawn anew after an edit.
#[test]
fn the_editor_moves_it_and_warns_of_its_start() {
    let mut harness = lab_with_tugs();
    let world = harness.state_mut().app.world_mut();
    let opened = crate::window::run_files::open_world_text(world, "yard.ron", &yard().to_ron());
    assert!(!opened.is_error, "{opened:?}");
    let atlas = &mut world.resource_mut::<Interface>().into_inner().0.atlas;
    let none: [&str; 0] = [];
    assert_eq!(atlas.warnings(), none);
    let by = |x, y| Op::Move { name: "Tug".into(), by: motion_lab_core::geometry::Vector2::new(x, y) };
    // its front is 3.2 m ahead of its axle, the tow's end 2.8 m behind it
    let start = |atlas: &crate::window::ui::AtlasState| atlas.world().robots[0].start.clone();
    atlas.change(&by(5.0, 0.5), None);
    assert_eq!((start(atlas), &atlas.message), (vec![13.0, 2.4, 0.0, 0.0], &None));
    assert_eq!(atlas.warnings(), ["Tug would overlap the east curb at its start"]);
    atlas.change(&by(-10.5, 0.0), None);
    assert_eq!(atlas.warnings(), ["Tug would overlap the west curb at its start"]);
    atlas.change(&by(2.5, 0.0), None);
    assert_eq!((start(atlas), atlas.warnings()), (vec![5.0, 2.4, 0.0, 0.0], &[][..]));
    // it is drawn and named where it is now
    assert!(atlas.over().items.iter().any(|item| item.name.contains("Tug")));
    assert!(atlas.labels(60.0).iter().any(|item| item.id == "name/robots/Tug"));
    assert_eq!(atlas.described(), "World Lot. Tug: a tug at x = 5.000.");
}

/// A stranger's file names a kind that this window does not have.
#[test]
fn of_a_kind_that_nobody_added_the_window_says_nothing_wrong() {
    let mut harness = lab(WIDE);
    let world = harness.state_mut().app.world_mut();
    let opened = crate::window::run_files::open_world_text(world, "yard.ron", &yard().to_ron());
    assert!(!opened.is_error, "{opened:?}");
    harness.run_steps(3);
    harness.get_by_label_contains("World Lot.");
    assert!(harness.query_by_label_contains("Tug").is_none(), "nobody knows where it stands");
}
