//! The session with its widgets, without a window: every behaviour by the names that a screen reader reads.

use std::time::Duration;

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_egui::egui::{self, Event, Key, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use super::session::{Interface, SessionPlugin, Shown, carry_out};
use super::{open_run, save_run};
use crate::configuration::Coordinates;
use crate::recording::Run;
use crate::run::{Log, RobotInput, Script};
use crate::simulation::{
    History, LatestFrame, PendingInput, Playback, RobotView, RunConfig, Transport, TransportCommand, view,
};
use crate::ui::SessionCommand;

/// The lab, looked at frame by frame; a frame takes a fortieth of a second: half a tick at normal speed.
struct Lab {
    app: App,
}

impl Lab {
    fn frame(&mut self, ui: &mut egui::Ui) {
        self.app.update();
        let world = self.app.world_mut();
        let mut commands = Vec::new();
        world.resource_scope(|world, mut interface: Mut<Interface>| {
            let (shown, history) = (world.resource::<Shown>(), world.resource::<History>());
            crate::ui::lab(ui, &shown.0, history, &mut interface.0, &mut commands);
        });
        carry_out(world, commands);
    }

    fn transport(&self) -> Transport {
        *self.app.world().resource::<Transport>()
    }

    fn robot(&self, id: usize) -> RobotView {
        view(self.app.world()).swap_remove(id)
    }

    fn script(&self) -> &Script {
        self.app.world().resource::<PendingInput>().script()
    }
}

fn app(frame: Duration) -> App {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SessionPlugin))
        .add_message::<SessionCommand>()
        .insert_resource(TimeUpdateStrategy::ManualDuration(frame));
    app.world_mut().resource_mut::<Interface>().0.settings.hints_seen = true;
    app
}

const WIDE: [f32; 2] = [1280.0, 800.0];
const PHONE: [f32; 2] = [390.0, 844.0];

fn lab(size: [f32; 2]) -> Harness<'static, Lab> {
    let lab = Lab { app: app(Duration::from_millis(25)) };
    let mut harness =
        Harness::builder().with_size(size).with_step_dt(0.025).build_ui_state(|ui, lab: &mut Lab| lab.frame(ui), lab);
    harness.run_steps(3);
    harness
}

#[test]
fn the_first_hints_are_put_away_for_good() {
    let mut harness = lab(WIDE);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.settings.hints_seen = false;
    harness.run_steps(2);
    harness.get_by_label("Drag the arm's elbow or tip.");
    click(&mut harness, "Got it");
    assert!(harness.query_by_label("Drag the arm's elbow or tip.").is_none());
    assert!(harness.state().app.world().resource::<Interface>().0.settings.hints_seen, "the settings keep it");
}

/// Clicks what is called so.
fn click(harness: &mut Harness<'_, Lab>, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(3);
}

/// The paper of the pane whose description begins so.
fn paper(harness: &Harness<'_, Lab>, begins: &str) -> egui::Rect {
    let node = harness
        .get_all_by_role(egui::accesskit::Role::Button)
        .find(|n| n.accesskit_node().label().is_some_and(|label| label.starts_with(begins)));
    node.expect("the pane").rect()
}

fn pointer(harness: &mut Harness<'_, Lab>, at: Pos2, pressed: Option<bool>) {
    harness.event(Event::PointerMoved(at));
    if let Some(pressed) = pressed {
        let button = PointerButton::Primary;
        harness.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
    }
    harness.step();
}

fn click_at(harness: &mut Harness<'_, Lab>, at: Pos2) {
    pointer(harness, at, Some(true));
    pointer(harness, at, Some(false));
    harness.run_steps(2);
}

fn arm_rusty(harness: &mut Harness<'_, Lab>) {
    let at = paper(harness, "Apartment").left_top() + egui::vec2(20.0, 60.0);
    click_at(harness, at);
    assert_eq!(harness.state().app.world().resource::<Interface>().0.armed.as_deref(), Some("Rusty"));
}

fn pause(harness: &mut Harness<'_, Lab>) {
    click(harness, "Pause");
    assert_eq!(harness.state().transport().playback, Playback::Paused);
}

#[test]
fn rusty_is_driven_into_a_wall_and_stops_a_radius_short_of_it() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    assert!(!harness.state().robot(0).manual, "taking in hand is no input");
    harness.key_down(Key::ArrowUp);
    harness.run_steps(600);
    let rusty = harness.state().robot(0);
    assert!(rusty.manual && rusty.in_contact);
    let trail = harness.state().app.world().resource::<History>().at(harness.state().transport().tick, 0).cloned();
    let clearance = trail.expect("noted").clearance;
    assert!((1e-5..=1e-4).contains(&clearance), "{clearance}");
    assert_eq!(rusty.footprint.parts()[0].placed().radius(), 0.11);
    // backing away is free again
    harness.key_up(Key::ArrowUp);
    harness.key_down(Key::ArrowDown);
    harness.run_steps(40);
    assert!(!harness.state().robot(0).in_contact);
    harness.key_up(Key::ArrowDown);
    harness.step();
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(harness.state().app.world().resource::<Interface>().0.armed, None);
    assert!(harness.state().robot(0).manual, "letting go is not giving back");
    click(&mut harness, "resume tour");
    harness.run_steps(4);
    assert!(!harness.state().robot(0).manual);
}

#[test]
fn a_car_does_not_slide_sideways_and_is_told_so() {
    let mut harness = lab(WIDE);
    harness.key_press(Key::Num3);
    harness.run_steps(2);
    harness.key_down(Key::ArrowLeft);
    harness.run_steps(10);
    let before = harness.state().robot(2).coordinates;
    harness.run_steps(40);
    assert_eq!(harness.state().robot(2).coordinates, before, "steering alone moves nothing");
    assert_eq!(harness.state().robot(2).channels, [0, 128]);
}

/// Drags the handle called so to a point of the Workbench, in ten moves.
fn drag(harness: &mut Harness<'_, Lab>, handle: &str, to: [f64; 2]) {
    let from = harness.get_by_label(handle).rect().center();
    let paper = paper(harness, "Workbench");
    let scale = (paper.width() - 16.0) / 4.8;
    let to = paper.center() + egui::vec2(to[0] as f32, -to[1] as f32) * scale;
    pointer(harness, from, Some(true));
    for i in 1..=10 {
        pointer(harness, from.lerp(to, i as f32 / 10.0), None);
    }
    harness.run_steps(3);
    pointer(harness, to, Some(false));
    harness.run_steps(3);
}

#[test]
fn dragging_the_elbow_keeps_theta2_and_dragging_the_tip_keeps_theta1() {
    let mut harness = lab(WIDE);
    let held = |q: &Coordinates, i: usize| (q[i] * 1e5).round();
    drag(&mut harness, "Reach: elbow, theta1 in radians", [-0.6, 0.9]);
    let first = harness.state().robot(1);
    let bearing = crate::num::atan2(0.9, -0.6);
    assert!(first.manual && (first.coordinates[0] - bearing).abs() < 0.01, "{:?}", first.coordinates);
    harness.run_steps(20);
    assert_eq!(harness.state().robot(1).coordinates, first.coordinates, "it stays where it was put");
    drag(&mut harness, "Reach: elbow, theta1 in radians", [0.3, -1.0]);
    let second = harness.state().robot(1);
    assert_eq!(held(&second.coordinates, 1), held(&first.coordinates, 1), "theta2 is kept");
    let radius = |r: &RobotView| r.tip.map(|t| t.coords.norm());
    assert!((radius(&second).unwrap() - radius(&first).unwrap()).abs() < 1e-5, "a circle about the base");
    drag(&mut harness, "Reach: tip, theta2 in radians", [1.5, 0.5]);
    let third = harness.state().robot(1);
    assert_eq!(held(&third.coordinates, 0), held(&second.coordinates, 0), "theta1 is kept");
    assert_ne!(held(&third.coordinates, 1), held(&second.coordinates, 1));
    // each drag is one thing to undo
    let moves = |lab: &Lab| lab.script().events.len();
    let all = moves(harness.state());
    click(&mut harness, "Undo");
    assert_eq!(harness.state().robot(1).coordinates, second.coordinates);
    click(&mut harness, "Undo");
    assert_eq!(harness.state().robot(1).coordinates, first.coordinates);
    click(&mut harness, "Undo");
    assert!(!harness.state().robot(1).manual && moves(harness.state()) == 0);
    (0..3).for_each(|_| click(&mut harness, "Redo"));
    assert_eq!(moves(harness.state()), all);
}

#[test]
fn a_focused_handle_is_nudged_and_numbers_are_typed() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let before = harness.state().robot(1).coordinates;
    harness.get_by_label("Reach: tip, theta2 in radians").focus();
    harness.run_steps(2);
    let tick = harness.state().transport().tick;
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(3);
    assert_eq!(harness.state().transport().tick, tick, "the key is the handle's, and paused no tick runs");
    assert_eq!(harness.state().robot(1).coordinates, before);
    assert!(
        harness.state().script().events.iter().any(|e| matches!(e.input, RobotInput::MoveTo(_))),
        "it is on its way"
    );
    // every other key is still what it was
    for playback in [Playback::Playing, Playback::Paused] {
        harness.key_press(Key::Space);
        harness.run_steps(3);
        assert_eq!(harness.state().transport().playback, playback);
    }
    let nudged = harness.state().robot(1).coordinates;
    assert!((nudged[1] - before[1] - 0.02).abs() < 1e-5 && (nudged[0] - before[0]).abs() < 1e-5);
    harness.get_by_label("Reach: theta1").focus();
    harness.run_steps(2);
    harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
    harness.step();
    harness.event(Event::Text("-1.25".into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    click(&mut harness, "Step");
    assert!((harness.state().robot(1).coordinates[0] + 1.25).abs() < 1e-6);
}

#[test]
fn scrubbing_back_and_driving_on_forgets_what_came_later() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(40);
    harness.key_up(Key::ArrowUp);
    harness.step();
    harness.key_press(Key::Escape);
    harness.run_steps(20);
    pause(&mut harness);
    let end = harness.state().transport();
    let there = harness.state().app.world().resource::<LatestFrame>().0.clone();
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(harness.state().transport().tick, 0);
    assert_eq!(harness.state().transport().frontier, end.frontier, "scrubbing forgets nothing");
    harness.key_press(Key::End);
    harness.run_steps(2);
    assert_eq!(harness.state().app.world().resource::<LatestFrame>().0, there, "the same bits");
    // to the middle by the time line itself
    let line = harness.get_by_label("time line, in ticks").rect();
    click_at(&mut harness, line.center());
    let middle = harness.state().transport().tick;
    assert!(middle.abs_diff(end.frontier / 2) <= 1, "{middle} of {}", end.frontier);
    click(&mut harness, "Continue from here");
    assert_eq!(harness.state().transport().frontier, middle);
    assert!(harness.state().script().events.iter().all(|e| e.tick <= middle));
    click(&mut harness, "Undo");
    assert_eq!(harness.state().transport().frontier, end.frontier);
    assert_eq!(harness.state().transport().tick, middle);
    // driving from the past continues from there too
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowDown);
    harness.run_steps(10);
    assert!(harness.state().transport().frontier < end.frontier);
    assert_eq!(harness.state().transport().playback, Playback::Playing, "who drives sees it move");
}

#[test]
fn a_seed_is_typed_and_typed_back() {
    let mut harness = lab(WIDE);
    harness.run_steps(100);
    pause(&mut harness);
    let tick = harness.state().transport().tick;
    let before = harness.state().app.world().resource::<LatestFrame>().0.clone();
    let seed = |harness: &mut Harness<'_, Lab>, seed: &str| {
        harness.get_by_label("seed").focus();
        harness.run_steps(2);
        harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        harness.step();
        harness.event(Event::Text(seed.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        for _ in 0..tick {
            harness.key_press(Key::ArrowRight);
            harness.step();
        }
        harness.run_steps(2);
        harness.state().app.world().resource::<LatestFrame>().0.clone()
    };
    let other = seed(&mut harness, "77");
    assert_eq!(harness.state().transport().seed.0, 77);
    assert_eq!(other.tick, tick);
    for (a, b) in other.robots.iter().zip(&before.robots) {
        assert!(a.configuration.iter().zip(&b.configuration).all(|(a, b)| a != b), "every coordinate is another");
    }
    assert_eq!(seed(&mut harness, "2005"), before, "typed back, each is restored");
}

#[test]
fn letters_are_words_while_words_are_typed() {
    let mut harness = lab(WIDE);
    harness.get_by_label("seed").focus();
    harness.run_steps(2);
    harness.key_press(Key::P);
    harness.key_press(Key::G);
    harness.run_steps(2);
    let settings = harness.state().app.world().resource::<Interface>().0.settings.clone();
    assert!(!settings.plots && harness.state().transport().seed.0 == 2005);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    harness.key_press(Key::P);
    harness.run_steps(2);
    assert!(harness.state().app.world().resource::<Interface>().0.settings.plots);
}

#[test]
fn the_trailer_goes_on_and_a_goal_is_set_for_it() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "put a trailer on");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates.len(), 4);
    click(&mut harness, "goal: one metre to the left");
    harness.get_by_label("goal: off by 1.00 m, 0.00 rad; 0 reversals");
    click(&mut harness, "drop the goal");
    assert!(harness.query_by_label("drop the goal").is_none());
    click(&mut harness, "take the trailer off");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates.len(), 3);
}

#[test]
fn where_there_is_no_room_for_a_trailer_it_is_said() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    // the rear axle half a metre from the west curb, facing away from it: the trailer would stand through it, or wholly beyond
    for x in [1.2, 2.5] {
        let to = [x, 2.5, 0.0].map(|v| crate::run::Quantized::try_new(v).unwrap()).to_vec();
        let command = crate::simulation::RobotCommand { robot: "Hitch".into(), input: RobotInput::Teleport(to) };
        harness.state_mut().app.world_mut().write_message(command);
        harness.run_steps(3);
        harness.get_by_label("comes with the next tick");
        click(&mut harness, "Step");
        assert!((harness.state().robot(2).coordinates[0] - x).abs() < 1e-6, "{:?}", harness.state().robot(2));
        harness.get_by_label("no room for a trailer: would overlap the west curb");
        assert!(harness.query_by_label("put a trailer on").is_none());
    }
}

#[test]
fn an_arm_of_three_links_walks_while_its_tip_stays() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "three links");
    let robot = harness.state().robot(1);
    assert_eq!((robot.kind.as_str(), robot.coordinates.len()), ("reach3", 3));
    let tip = robot.tip.unwrap();
    let slider = harness.get_by_label("tip kept:").rect();
    let mut at = Vec::new();
    for part in [0.1, 0.3, 0.6, 0.9] {
        click_at(&mut harness, slider.left_center() + egui::vec2(part * slider.width(), 0.0));
        harness.run_steps(2);
        click(&mut harness, "Step");
        let robot = harness.state().robot(1);
        assert!((robot.tip.unwrap() - tip).norm() < 1e-5, "the tip stays, to the rounding of the targets");
        at.push(robot.coordinates[0]);
    }
    assert!(at.windows(2).all(|w| w[1] > w[0] + 0.05), "theta1 walks: {at:?}");
    click(&mut harness, "Undo");
    click(&mut harness, "two links");
    assert_eq!(harness.state().robot(1).coordinates.len(), 2);
}

#[test]
fn the_pad_drives_like_the_keys() {
    let mut harness = lab(PHONE);
    arm_rusty(&mut harness);
    let pad = harness.get_by_label("Rusty: pad, up drives forward").rect();
    pointer(&mut harness, pad.center_top() + egui::vec2(0.0, 1.0), Some(true));
    harness.run_steps(6);
    let channels = harness.state().robot(0).channels;
    assert!(channels[0] > 120 && channels[1] == 0, "{channels:?}");
    pointer(&mut harness, pad.center_top(), Some(false));
    harness.run_steps(6);
    assert_eq!(harness.state().robot(0).channels, [0, 0]);
}

#[test]
fn the_colour_key_lights_its_role_and_the_list_of_keys_opens() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    harness.get_by_label("colour key: obstacle").focus();
    harness.run_steps(3);
    let lit = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.lit;
    assert_eq!(lit(&harness), Some(crate::picture::Role::Obstacle));
    harness.get_by_label("Keys").focus();
    harness.run_steps(12);
    assert_eq!(lit(&harness), None, "the fade ends");
    harness.key_press(Key::Questionmark);
    harness.run_steps(3);
    harness.get_by_label("play again and again, or not");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_label("play again and again, or not").is_none());
}

#[test]
fn loops_speeds_and_contacts() {
    let mut harness = lab(WIDE);
    harness.run_steps(200);
    pause(&mut harness);
    let frontier = harness.state().transport().frontier;
    click(&mut harness, "Loop");
    click(&mut harness, "Play");
    harness.run_steps(60);
    let transport = harness.state().transport();
    assert!(transport.looping && transport.frontier == frontier && transport.tick < frontier, "{transport:?}");
    pause(&mut harness);
    let next = harness.state().app.world().resource::<Shown>().0.next_contact.expect("the arm meets obstacles");
    click(&mut harness, "Next contact");
    assert_eq!(harness.state().transport().tick, next);
    assert!(view(harness.state().app.world()).iter().any(|r| r.in_contact));
    for _ in 0..20 {
        harness.key_press(Key::Period);
        harness.run_steps(2);
    }
    assert!(harness.state().transport().speed.is_infinite());
    click(&mut harness, "Loop");
    harness.key_press(Key::End);
    harness.run_steps(2);
    click(&mut harness, "Play");
    harness.run_steps(10);
    let gone = harness.state().transport().tick - frontier;
    assert!(gone >= 10, "at least a tick a frame, where normal speed makes half of one: {gone} in ten frames");
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
    drag(&mut harness, "Reach: elbow, theta1 in radians", [-0.6, 0.9]);
    click(&mut harness, "put a trailer on");
    harness.run_steps(60);
    pause(&mut harness);
    harness.key_press(Key::End);
    harness.run_steps(2);
    let last = harness.state().app.world().resource::<LatestFrame>().0.clone();
    let notice = save_run(harness.state().app.world(), &path);
    assert!(!notice.is_error, "{notice:?}");
    let bytes = std::fs::read(&path).unwrap();
    let log = Log::read_mcap(&bytes).unwrap().log;
    assert!(log.script.events.len() >= 4);
    assert_eq!(log.frames.last(), Some(&last), "what was seen is what was saved");
    assert_eq!(Run::replay(&log).unwrap(), log.frames, "headless, to the last bit");
    assert!(notice.text.contains(&log.digest().to_string()));
    // opened again it says so, and stands at its start
    let opened = open_run(harness.state_mut().app.world_mut(), &path);
    let ticks = log.frames.len();
    assert_eq!(opened.text, format!("driven.mcap: bit-identical, {ticks} of {ticks}"));
    let transport = harness.state().transport();
    assert_eq!((transport.tick, transport.frontier), (0, ticks as u64));
    // one bit of one coordinate, in the file of a run that was not: the tick is named and shown
    let mut forged = log.clone();
    let x = &mut forged.frames[70].robots[0].configuration[0];
    *x = f64::from_bits(x.to_bits() ^ 1);
    forged.digests = forged.frames.iter().map(crate::run::Frame::digest).collect();
    let mut file = std::fs::File::create(&path).unwrap();
    forged.write_mcap(&mut file).unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path);
    assert!(opened.is_error && opened.text.contains("71"), "{opened:?}");
    assert_eq!(harness.state().transport().tick, 71);
    // what is no log leaves the run as it is
    std::fs::write(&path, b"a cat").unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path);
    assert!(opened.is_error && harness.state().transport().tick == 71, "{opened:?}");
}

/// The frames of the first 200 ticks with input in them, at some rate of frames, with a stall of 5 s or not.
fn played(frames_per_second: u32, stall: bool) -> Vec<crate::run::Frame> {
    let mut app = app(Duration::from_secs_f64(1.0 / f64::from(frames_per_second)));
    app.update();
    let config = RunConfig::clone(app.world().resource::<RunConfig>());
    let event = |tick, robot: &str, input| crate::run::Event { tick, robot: robot.into(), input };
    let events = vec![
        event(10, "Rusty", RobotInput::Drive(128, 0)),
        event(40, "Hitch", RobotInput::SetTrailer(true)),
        event(60, "Hitch", RobotInput::Drive(-100, 50)),
        event(90, "Rusty", RobotInput::Release),
    ];
    let script = Script { events, ..Script::empty() };
    let world = app.world_mut();
    crate::simulation::start_run(world, (*config.0).clone(), (crate::tour::BOOK_SEED, script)).unwrap();
    world.resource_mut::<Transport>().playback = Playback::Playing;
    let mut frames = Vec::new();
    while app.world().resource::<Transport>().tick < 200 {
        if stall && app.world().resource::<Transport>().tick > 50 && frames.len() < 60 {
            let usual = Duration::from_secs_f64(1.0 / f64::from(frames_per_second));
            app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(5)));
            app.update();
            app.insert_resource(TimeUpdateStrategy::ManualDuration(usual));
        }
        app.update();
        frames.push(app.world().resource::<LatestFrame>().0.clone());
    }
    let world = app.world_mut();
    (1..=200)
        .map(|tick| {
            crate::simulation::obey(world, TransportCommand::Seek(tick)).unwrap();
            world.resource::<LatestFrame>().0.clone()
        })
        .collect()
}

#[test]
fn frame_rates_and_stalls_change_no_bit_of_a_run() {
    let smooth = played(60, false);
    for (rate, stall) in [(20, false), (144, false), (60, true), (7, true)] {
        assert_eq!(played(rate, stall), smooth, "{rate} frames a second, stall: {stall}");
    }
}

#[test]
fn every_corner_that_is_painted_is_a_number() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Names");
    click(&mut harness, "show the scan");
    for _ in 0..20 {
        harness.run_steps(10);
        let primitives = harness.ctx.tessellate(harness.output().shapes.clone(), 1.0);
        let meshes = primitives.iter().filter_map(|p| match &p.primitive {
            egui::epaint::Primitive::Mesh(mesh) => Some(mesh),
            egui::epaint::Primitive::Callback(_) => None,
        });
        let corners: Vec<Pos2> = meshes.flat_map(|m| m.vertices.iter().map(|v| v.pos)).collect();
        assert!(corners.len() > 5000 && corners.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
    }
}

#[test]
fn a_phone_shows_one_pane_at_a_time_and_all_can_be_reached() {
    let mut harness = lab(PHONE);
    assert!(harness.query_by_label_contains("Workbench. Reach").is_none());
    click(&mut harness, "Reach");
    assert!(harness.query_by_label_contains("Workbench. Reach").is_some());
    let handle = harness.get_by_label("Reach: tip, theta2 in radians").rect();
    assert!(handle.width() >= 44.0, "as large as a fingertip");
    click(&mut harness, "Menu");
    click(&mut harness, "Plots");
    assert!(harness.state().app.world().resource::<Interface>().0.settings.plots);
}

/// Puts the widget with this word on the rail in front.
fn front(harness: &mut Harness<'_, Lab>, word: &str) {
    click(harness, word);
    harness.run_steps(3);
}

fn value(harness: &Harness<'_, Lab>, name: &str) -> f64 {
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, name);
    slider.accesskit_node().numeric_value().expect("a value")
}

#[test]
fn the_anatomy_answers_the_four_questions() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    assert_eq!(harness.state().transport().playback, Playback::Paused, "the run waits");
    harness.get_by_label("intersects: false");
    click(&mut harness, "distance");
    harness.get_by_label("distance: 0.0607 m");
    click(&mut harness, "3 cm capsule links");
    harness.get_by_label("distance: 0.0307 m");
    click(&mut harness, "3 cm capsule links");
    // theta2 slides down until the arm touches the block: exactly 0, and it stays 0
    let anatomy = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.anatomy.anatomy.clone();
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "th2").rect();
    let mut seen = Vec::new();
    for part in [0.76, 0.74, 0.71, 0.68] {
        click_at(&mut harness, slider.left_center() + egui::vec2(part * 180.0, 0.0));
        seen.push((value(&harness, "th2"), anatomy(&harness).distance(), anatomy(&harness).intersects()));
    }
    assert!(seen[0].1 > 0.0 && !seen[0].2, "{seen:?}");
    assert!(seen.iter().all(|(th2, d, hit)| (*d == 0.0) == *hit && (*th2 < 1.4008) == *hit), "{seen:?}");
    assert!(seen[3].2, "{seen:?}");
    click(&mut harness, "Reset");
    click(&mut harness, "swept");
    let said = anatomy(&harness).described();
    assert!(said.contains("the block"), "{said}");
    harness.get_by_role_and_label(egui::accesskit::Role::Slider, "step of th1");
}

#[test]
fn a_number_is_asked_for_before_it_is_shown() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    assert!(harness.query_by_label_contains("0.0306").is_none());
    harness.get_by_label_contains("the links are given a radius of 3 cm").focus();
    harness.run_steps(2);
    harness.event(Event::Text("0.05".into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    harness.get_by_label_contains("Off by +0.0193 m: it is 0.030660 m");
}

#[test]
fn the_configuration_space_is_proven_and_moves_the_arm() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Space");
    harness.run_steps(12);
    harness.get_by_label_contains("proven free  71.");
    let space = harness.get_by_label_contains("configuration space. The robot is the point").rect();
    click_at(&mut harness, space.center());
    let q = harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.q().to_string();
    click_at(&mut harness, space.center() + egui::vec2(60.0, 0.0));
    let moved = harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.q().to_string();
    assert_ne!(q, moved);
    let th2 = |q: &str| q.rsplit_once("th2: ").map(|(_, tail)| tail.to_owned());
    assert_eq!(th2(&q), th2(&moved), "a point to the right is another theta1");
}

#[test]
fn the_atlas_puts_robots_refuses_and_edits() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Atlas");
    let paper = harness.get_by_label_contains("World Apartment").rect();
    let atlas = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.atlas.clone();
    let fit = crate::ui::canvas::fit(&crate::picture::world(atlas(&harness).world()), paper);
    let at = |x: f64, y: f64| {
        let [x, y] = fit.screen_from_world(crate::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    };
    click_at(&mut harness, at(6.0, 4.0));
    let q = atlas(&harness).atlas().robots()[0].q;
    assert!((crate::configuration::Configuration::coordinates(&q)[0] - 6.0).abs() < 0.05, "{q}");
    // on the round table: refused by name, in place
    click_at(&mut harness, at(6.0, 6.75));
    assert_eq!(atlas(&harness).atlas().robots()[0].q, q, "it stays");
    harness.get_by_label("would overlap B's round table; click the ring for the nearest free place");
    // the editor
    click(&mut harness, "Edit");
    click(&mut harness, "Add box");
    assert!(atlas(&harness).world().obstacle("box").is_some());
    click(&mut harness, "Delete");
    assert!(atlas(&harness).world().obstacle("box").is_none());
    click(&mut harness, "Undo");
    assert!(atlas(&harness).world().obstacle("box").is_some());
    // saved, it is a world file that runs
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.ron");
    let notice = super::files::save_world(harness.state_mut().app.world_mut(), &path);
    assert!(!notice.is_error && atlas(&harness).is_saved(), "{notice:?}");
    let text = std::fs::read_to_string(&path).unwrap();
    let world = crate::worlds::World::parse("mine.ron", &text).unwrap();
    assert_eq!(world.to_ron(), text, "canonical");
    let opened = super::files::open_world(harness.state_mut().app.world_mut(), &path);
    assert!(!opened.is_error && atlas(&harness).is_saved());
    std::fs::write(&path, "a cat").unwrap();
    let refused = super::files::open_world(harness.state_mut().app.world_mut(), &path);
    assert!(refused.is_error && atlas(&harness).is_saved(), "{refused:?}");
    click(&mut harness, "Run this world");
    let config = harness.state().app.world().resource::<RunConfig>().0.clone();
    assert!(config.worlds.len() == 1 && config.worlds[0].obstacle("box").is_some());
    click(&mut harness, "Undo");
    assert_eq!(harness.state().app.world().resource::<RunConfig>().0.worlds.len(), 3);
}
