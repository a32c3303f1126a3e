//! A world of many robots: found, picked, followed and driven; long work in the background.

use super::*;
use crate::window::session::new_run;
use crate::window::ui::{Command, CrowdState, CrowdView};
use motion_lab_core::geometry::Point2;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::Warehouse;
use motion_lab_sim::recording::{Recorder, verify};
use motion_lab_sim::run::{Log, LogKind, LogWriter, Recipe};
use motion_lab_sim::simulation::{TransportCommand, sensors, sensors_of, view_of};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// The lab with a warehouse of this number of robots, paused at its start.
fn warehouse(robots: usize, size: [f32; 2]) -> (Harness<'static, Lab>, TourConfig) {
    let mut harness = lab(size);
    let world = Warehouse { seed: Seed(1), robots, trailers: false }.world().unwrap();
    let config = TourConfig { worlds: vec![world], ..TourConfig::default() };
    let app = harness.state_mut().app.world_mut();
    app.resource_mut::<Transport>().playback = Playback::Paused;
    new_run(app, Recipe::new(config.clone(), BOOK_SEED)).unwrap();
    harness.run_steps(3);
    (harness, config)
}

fn crowd<'a>(harness: &'a Harness<'_, Lab>) -> &'a CrowdState {
    &interface(harness).crowd
}

fn picked(harness: &Harness<'_, Lab>) -> Option<String> {
    crowd(harness).picked.as_ref().map(|p| p.name.clone())
}

fn step(harness: &mut Harness<'_, Lab>, ticks: u64) {
    for _ in 0..ticks {
        harness.state_mut().app.world_mut().write_message(RunCommand::from(TransportCommand::Step));
        harness.step();
    }
}

/// The point of the screen where a point of the world is, while the whole world is shown.
fn on_screen(harness: &Harness<'_, Lab>, at: Point2) -> Pos2 {
    let shown = &harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0];
    let [x, y] = crate::window::ui::paint::canvas::fit(&shown.world, paper(harness, "30 robots")).screen_from_world(at);
    pos2(x as f32, y as f32)
}

#[test]
fn a_robot_is_found_by_its_name_and_only_who_is_picked_has_words_and_a_scan() {
    let (mut harness, config) = warehouse(30, WIDE);
    let shown =
        |harness: &Harness<'_, Lab>| harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].clone();
    assert!(shown(&harness).robots.is_empty(), "nobody is picked");
    assert_eq!(shown(&harness).crowd.unwrap().names.len(), 30);
    harness.get_by_label("find a robot").focus();
    harness.run_steps(2);
    harness.event(Event::Text("ROVER 00003".into()));
    harness.run_steps(3);
    harness.get_by_label("1 of 30 robots");
    click(&mut harness, "rover 00003");
    let one = shown(&harness).robots;
    assert_eq!(one.iter().map(|r| r.name.as_str()).collect::<Vec<_>>(), ["rover 00003"]);
    let own: Vec<_> = sensors(harness.state().app.world()).into_iter().filter(|s| s.robot == one[0].id).collect();
    assert!(own.len() == 1 && one[0].sees == own, "its scan and no other");
    assert_eq!(sensors_of(harness.state().app.world(), one[0].id), own);
    harness.get_by_label("Follow");
    // another run, in which that one has another name
    let mut other = config.clone();
    let id = config.worlds[0].robots.iter().position(|r| r.name == "rover 00003").unwrap();
    other.worlds[0].robots[id].name = "another".into();
    new_run(harness.state_mut().app.world_mut(), Recipe::new(other, BOOK_SEED)).unwrap();
    harness.run_steps(2);
    assert!(shown(&harness).robots.is_empty(), "nobody is picked there");
    new_run(harness.state_mut().app.world_mut(), Recipe::new(config, BOOK_SEED)).unwrap();
    harness.run_steps(2);
    assert_eq!(shown(&harness).robots.len(), 1);
    // another click on its row, and nobody is
    harness.get_all_by_label("rover 00003").next().unwrap().click();
    harness.run_steps(3);
    assert!(shown(&harness).robots.is_empty() && harness.query_by_label("Follow").is_none());
}

#[test]
fn the_crowd_that_is_shown_is_the_run_at_its_tick() {
    let (mut harness, config) = warehouse(30, WIDE);
    step(&mut harness, 3);
    let app = harness.state().app.world();
    let crowd = app.resource::<ShownDashboard>().0.cockpits[0].crowd.clone().unwrap();
    let all = view(app);
    assert_eq!((crowd.now.len(), crowd.before.len()), (30, 30));
    let footprint = |crowd: &CrowdView, place| crowd.footprint(place).unwrap().0;
    let earlier = CrowdView { now: crowd.before.clone(), ..crowd.clone() };
    for (place, robot) in all.iter().enumerate() {
        assert_eq!(footprint(&crowd, place), robot.footprint);
        assert_eq!(footprint(&earlier, place), robot.previous_footprint);
        let near = |p: Point2| (p - robot.footprint.bounds().unwrap().centre()).norm();
        assert!(near(crowd.spot(place).unwrap().centre) <= crowd.spot(place).unwrap().radius);
    }
    assert!(crowd.now != crowd.before && crowd.footprint(30).is_none());
    assert_eq!(crowd.names.to_vec(), config.worlds[0].robots.iter().map(|r| r.name.clone()).collect::<Vec<_>>());
    assert_eq!((view_of(app, 29).unwrap(), view_of(app, 30)), (all[29].clone(), None));
    // a jump back is no way that they took
    harness.state_mut().app.world_mut().write_message(RunCommand::from(TransportCommand::Seek(1)));
    harness.step();
    let crowd = harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].crowd.clone().unwrap();
    assert_eq!(crowd.before, crowd.now);
    assert_eq!(footprint(&crowd, 29), view(harness.state().app.world())[29].footprint, "lists are written anew");
}

#[test]
fn a_click_picks_another_drives_and_a_drag_looks_elsewhere() {
    let (mut harness, _) = warehouse(30, WIDE);
    let robot = view_of(harness.state().app.world(), 5).unwrap();
    let at = on_screen(&harness, robot.footprint.bounds().unwrap().centre());
    click_at(&mut harness, at);
    assert_eq!(picked(&harness), Some(robot.name.clone()));
    click_at(&mut harness, at);
    let armed = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.hand.armed.clone();
    assert_eq!(armed(&harness), Some(robot.name.clone()), "a second click takes it in hand");
    harness.key_down(Key::ArrowUp);
    harness.run_steps(6);
    harness.key_up(Key::ArrowUp);
    harness.run_steps(2);
    let after = view_of(harness.state().app.world(), 5).unwrap();
    assert!(after.manual && after.coordinates != robot.coordinates);
    assert!(harness.state().script().events.iter().all(|e| e.robot == robot.name));
    pause(&mut harness);
    // the floor: the first click lets go, the next picks nobody
    let floor = paper(&harness, "30 robots").left_top() + egui::vec2(3.0, 3.0);
    click_at(&mut harness, floor);
    assert_eq!((armed(&harness), picked(&harness)), (None, Some(robot.name)));
    click_at(&mut harness, floor);
    assert_eq!(picked(&harness), None);
    // magnified, the paper is dragged with what is under the pointer
    click(&mut harness, "magnify");
    let name = harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].world.name.clone();
    let camera = |h: &Harness<'_, Lab>| interface(h).cameras[&name];
    let before = camera(&harness);
    assert!((before.zoom - 1.5).abs() < 1e-9);
    let from = paper(&harness, "30 robots").center();
    pointer(&mut harness, from, Some(true));
    for i in 1..=4 {
        pointer(&mut harness, from + egui::vec2(-10.0 * i as f32, 0.0), None);
    }
    pointer(&mut harness, from - egui::vec2(40.0, 0.0), Some(false));
    let moved = camera(&harness).centre.unwrap().x - before.centre.unwrap().x;
    let shown = &harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0];
    let scale = 1.5 * crate::window::ui::paint::canvas::fit(&shown.world, paper(&harness, "30 robots")).px_per_metre();
    assert!((moved - 40.0 / scale).abs() < 0.2 * 40.0 / scale, "40 points to the left: {moved}");
    click(&mut harness, "show the whole world");
    assert_eq!(camera(&harness), Default::default());
}

#[test]
fn the_view_follows_who_is_picked() {
    let (mut harness, _) = warehouse(30, PHONE);
    harness.get_by_label("find a robot");
    click(&mut harness, "rover 00000");
    click(&mut harness, "Follow");
    step(&mut harness, 20);
    harness.step();
    let name = harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].world.name.clone();
    let (camera, robot) = (interface(&harness).cameras[&name], harness.state().robot(0));
    let at = robot.footprint.parts()[0].pose().position();
    assert!((camera.centre.unwrap() - at).norm() < 1e-9 && camera.zoom > 1.0, "{camera:?} {at}");
    // dragged, the view is one's own again
    assert!(crowd(&harness).follows);
    let from = paper(&harness, "30 robots").center() + egui::vec2(0.0, 30.0);
    pointer(&mut harness, from, Some(true));
    pointer(&mut harness, from + egui::vec2(30.0, 0.0), None);
    pointer(&mut harness, from + egui::vec2(30.0, 0.0), Some(false));
    assert!(!crowd(&harness).follows && crowd(&harness).picked.is_some());
}

#[test]
fn a_long_way_to_another_tick_goes_on_in_the_background_and_ends_on_the_same_bits() {
    let (mut harness, config) = warehouse(1000, WIDE);
    step(&mut harness, 45);
    let seek = |harness: &mut Harness<'_, Lab>, tick| {
        let commands = vec![Command::from(TransportCommand::Seek(tick))];
        carry_out(harness.state_mut().app.world_mut(), commands);
    };
    let working = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.working.clone();
    // 30 ticks of 1,000 robots from tick 0 on
    seek(&mut harness, 30);
    assert!(working(&harness).is_some_and(|w| w.text.starts_with("going to tick 30")), "said before the first piece");
    let mut frames = 0;
    while working(&harness).is_some() && frames < 1000 {
        harness.step();
        frames += 1;
    }
    assert!(frames > 1, "in pieces");
    let mut straight = Recorder::new(config, BOOK_SEED).unwrap();
    (0..30).for_each(|_| _ = straight.step());
    assert_eq!(harness.state().app.world().resource::<LatestFrame>().frame(), straight.frame());
    // it played before the way there, and plays again when something else is asked of it meanwhile
    let app = harness.state_mut().app.world_mut();
    app.resource_mut::<Transport>().playback = Playback::Playing;
    seek(&mut harness, 75);
    assert_eq!(harness.state().transport().playback, Playback::Paused, "it stands meanwhile");
    let faster = vec![Command::from(TransportCommand::SetSpeed(2.0))];
    carry_out(harness.state_mut().app.world_mut(), faster);
    assert_eq!((working(&harness), harness.state().transport().playback), (None, Playback::Playing));
    harness.state_mut().app.world_mut().resource_mut::<Transport>().playback = Playback::Paused;
    // a save gives way to it, and says so
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        save_run(harness.state_mut().app.world_mut(), &folder.path().join("a.mcap")),
        None,
        "it goes on in the background"
    );
    assert!(working(&harness).is_some_and(|w| w.text.starts_with("saving: tick")));
    seek(&mut harness, 300);
    let notice = harness.state().app.world().resource::<Interface>().0.notice().cloned();
    assert_eq!(notice.map(|n| n.text).as_deref(), Some("not saved: stopped"));
    // stopped, it stands where it came to, and says so
    harness.run_steps(2);
    click(&mut harness, "Stop");
    harness.run_steps(2);
    let tick = harness.state().transport().tick;
    assert!(working(&harness).is_none() && (30..300).contains(&tick), "{tick}");
    harness.get_by_label_contains("on the way to 300");
}

#[test]
fn a_crowd_is_saved_without_its_frames_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("crowd.mcap");
    let (mut harness, _) = warehouse(101, WIDE);
    step(&mut harness, 25);
    let app = harness.state_mut().app.world_mut();
    let saved = save_run(app, &path).unwrap();
    let log = Log::read_mcap(&std::fs::read(&path).unwrap()).unwrap().log;
    assert_eq!((log.kind(), log.ticks()), (LogKind::Digests, 25));
    assert!(saved.text.contains(&log.digest().unwrap().to_string()) && !saved.is_error, "{saved:?}");
    assert_eq!(verify(&log, |_| {}).unwrap().difference, None);
    let opened = open_run(app, &path).unwrap();
    assert_eq!(opened.text, "crowd.mcap: bit-identical, 25 of 25");
    assert_eq!((app.resource::<Transport>().tick(), app.resource::<Transport>().frontier()), (0, 25));
    // the digests of a run one bit of which was changed at tick 5
    let mut run = Recorder::of(&log.recipe).unwrap();
    let mut writer = LogWriter::new(Vec::new(), &log.recipe, LogKind::Digests, run.frame()).unwrap();
    for tick in 1..=25 {
        let mut frame = run.step().clone();
        frame.robots[7].flash += u32::from(tick == 5);
        writer.tick(&frame).unwrap();
    }
    std::fs::write(&path, writer.finish().unwrap()).unwrap();
    let opened = open_run(app, &path).unwrap();
    assert!(opened.is_error && opened.text.contains("second 1, ticks 1 to 20"), "{opened:?}");
    assert_eq!(app.resource::<Transport>().tick(), 1, "the first tick that may differ");
}
