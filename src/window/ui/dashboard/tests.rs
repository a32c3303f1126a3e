//! The dashboard without a window: egui lays it out, and the tests examine what it would paint.

use std::sync::Arc;

use bevy_egui::egui::{self, Context, Event, Key, Modifiers, PointerButton, RawInput, Rect, Shape, Vec2, pos2, vec2};

use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{Cockpit, CockpitRobot, Command, Dashboard, UiState, lab};
use motion_lab_core::configuration::{Configuration, HitchCfg, RobotKind, T2};
use motion_lab_core::geometry::{Aabb, Point2, Pose2};
use motion_lab_core::picture::{Gait, Picture, Role, Theme};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, HITCH, RUSTY, Reach, Robot};
use motion_lab_core::worlds::World;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::manifest::ThemeChoice;
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::{History, RobotCommand, RunCommand, TransportCommand};

const WIDE: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

fn robot<R: Robot>(name: &str, kind: &str, robot: &R, q: R::Configuration) -> CockpitRobot {
    CockpitRobot {
        id: 0,
        name: name.into(),
        kind: kind.into(),
        about: RobotKind::of(kind),
        model: AnyRobot::model(kind, None),
        readout: q.to_string(),
        in_full: format!("{q:?}"),
        coordinates: q.coordinates(),
        target: None,
        footprint: robot.footprint(&q),
        heading: None,
        gait: Gait::default(),
        flash: false,
        contacts: 3,
        clearance: None,
        manual: false,
        along_path: false,
        drivable: !kind.starts_with("reach"),
        is_arm: kind.starts_with("reach"),
        trailer: (kind == "hitch").then_some(true),
        sees: Vec::new(),
        tip: None,
        reversals: 0,
        no_room: None,
        put: 0,
        put_since_goal: false,
    }
}

fn cockpit(world: &str, width: f64, height: f64, robot: CockpitRobot) -> Cockpit {
    let still = World::empty(world, Aabb::new(Point2::new(0.0, 0.0), Point2::new(width, height)));
    let (world, atlas) = (Arc::new(Picture::new(world, still.bounds)), Arc::new(Atlas::new(still.clone())));
    Cockpit { world, atlas, standing: still.into(), robots: vec![robot], crowd: None, doors: vec![], waiting: false }
}

fn model() -> Dashboard {
    let pose = Pose2::new(10.5, 6.25, -1.5);
    let hitch = robot("Hitch", "hitch", &HITCH.with_trailer(), HitchCfg { body: pose, trailer: Some(-1.5) });
    Dashboard {
        cockpits: vec![
            cockpit("Apartment", 12.0, 8.0, robot("Rusty", "rusty", &RUSTY, pose)),
            cockpit("Workbench", 4.8, 4.8, robot("Reach", "reach", &Reach::<2>::workbench(), T2::new(0.5, 1.0))),
            cockpit("Lot", 16.0, 10.0, hitch),
        ],
        seed: Seed(2005),
        tick: 1200,
        frontier: 1200,
        speed: 1.0,
        playing: true,
        looping: false,
        behind: None,
        next_contact: None,
        has_contact: false,
        can_undo: true,
        can_redo: false,
    }
}

/// A screen that is run frame by frame.
struct Screen {
    ctx: Context,
    size: Vec2,
    state: UiState,
    shapes: Vec<egui::epaint::ClippedShape>,
    /// The names of all controls, with their rectangles.
    controls: Vec<(String, Rect)>,
}

impl Screen {
    fn new(size: Vec2, model: &Dashboard) -> Self {
        let mut state = UiState::default();
        motion_lab_sim::manifest::Widget::ALL.into_iter().for_each(|widget| state.settings.put_hints_away(widget));
        let mut screen = Screen { ctx: Context::default(), size, state, shapes: Vec::new(), controls: Vec::new() };
        screen.ctx.enable_accesskit();
        for _ in 0..3 {
            screen.frame(model, vec![]); // egui learns sizes from the frame before
        }
        screen
    }

    fn frame(&mut self, model: &Dashboard, events: Vec<Event>) -> Vec<Command> {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), self.size));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let mut commands = Vec::new();
        let mut output =
            self.ctx.run_ui(input, |ui| lab(ui, model, &History::default(), &mut self.state, &mut commands));
        output.textures_delta.clear(); // no one uploads them
        let tree = output.platform_output.accesskit_update.take();
        let named = |(_, node): (_, egui::accesskit::Node)| {
            let bounds = node.bounds()?;
            let rect = Rect::from_x_y_ranges(bounds.x0 as f32..=bounds.x1 as f32, bounds.y0 as f32..=bounds.y1 as f32);
            Some((node.label()?.to_owned(), rect))
        };
        self.controls = tree.into_iter().flat_map(|tree| tree.nodes).filter_map(named).collect();
        // what has scrolled away is not seen
        self.shapes = output.shapes;
        self.shapes.retain(|s| s.clip_rect.intersects(s.shape.visual_bounding_rect()));
        commands
    }

    fn click(&mut self, model: &Dashboard, words: &str) -> Vec<Command> {
        let texts = self.texts();
        let (_, rect) = texts.iter().find(|(text, _)| text == words).unwrap_or_else(|| self.control(words));
        self.click_at(model, rect.center())
    }

    fn click_at(&mut self, model: &Dashboard, pos: egui::Pos2) -> Vec<Command> {
        let button =
            |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
        let mut commands = self.frame(model, vec![Event::PointerMoved(pos), button(true)]);
        commands.extend(self.frame(model, vec![button(false)]));
        commands
    }

    /// The first control whose name begins so.
    fn control(&self, begins: &str) -> &(String, Rect) {
        let found = self.controls.iter().find(|(name, _)| name.starts_with(begins));
        found.unwrap_or_else(|| panic!("{begins:?} among {:?}", self.controls))
    }

    /// Clicks the control whose name begins so.
    fn press(&mut self, model: &Dashboard, begins: &str) {
        self.click_at(model, self.control(begins).1.center());
        self.frame(model, vec![]);
    }

    /// All words with the rectangles of their ink.
    fn texts(&self) -> Vec<(String, Rect)> {
        fn collect(shape: &Shape, clip: Rect, out: &mut Vec<(String, Rect)>) {
            match shape {
                Shape::Text(text) if !text.galley.text().is_empty() => {
                    // where the ink is: the first line of words in a row is indented within its own rectangle, and
                    // what is scrolled to ends where its room does
                    let rect = text.galley.mesh_bounds.translate(text.pos.to_vec2());
                    let rect = rect.with_max_y(rect.bottom().min(clip.bottom()));
                    out.push((text.galley.text().to_owned(), rect));
                }
                Shape::Vec(shapes) => shapes.iter().for_each(|s| collect(s, clip, out)),
                _ => {}
            }
        }
        let mut out = Vec::new();
        self.shapes.iter().for_each(|s| collect(&s.shape, s.clip_rect, &mut out));
        out
    }
}

#[test]
fn all_words_stay_on_the_screen_and_apart() {
    for size in [WIDE, PHONE, Vec2::new(1920.0, 1080.0)] {
        let screen = Screen::new(size, &model());
        let texts = screen.texts();
        let page = Rect::from_min_size(pos2(0.0, 0.0), size);
        for (i, (text, rect)) in texts.iter().enumerate() {
            assert!(page.contains_rect(*rect), "{text:?} at {rect} leaves the page of {size}");
            for (other, place) in &texts[..i] {
                let is_apart = !rect.shrink(0.5).intersects(place.shrink(0.5));
                assert!(is_apart, "{text:?} at {rect} runs into {other:?} at {place}, {size}");
            }
        }
        assert!(texts.len() > 10, "the test no longer finds the words");
    }
}

#[test]
fn a_wide_screen_shows_one_cockpit_in_front_and_the_others_small_and_a_narrow_one_the_chosen() {
    let headings = |screen: &Screen| {
        screen.texts().into_iter().map(|(text, _)| text).filter(|t| t.contains(" \u{b7} ")).collect::<Vec<_>>()
    };
    let all = ["Rusty \u{b7} Apartment", "Reach \u{b7} Workbench", "Hitch \u{b7} Lot"];
    let mut wide = Screen::new(WIDE, &model());
    // the small ones stand above the words of the one in front
    assert_eq!(headings(&wide), [all[1], all[2], all[0]]);
    let paper = |screen: &Screen, begins: &str| screen.control(begins).1.area();
    assert!(paper(&wide, "Apartment.") > 4.0 * paper(&wide, "Bring Reach"));
    wide.press(&model(), "Bring Hitch");
    assert_eq!(headings(&wide), [all[0], all[1], all[2]]);
    assert!(paper(&wide, "Lot.") > 4.0 * paper(&wide, "Bring Rusty"));
    // where there is room for three, they may stand side by side
    let mut roomy = Screen::new(Vec2::new(1920.0, 1080.0), &model());
    assert_eq!(headings(&roomy), [all[1], all[2], all[0]]);
    roomy.press(&model(), "All side by side");
    assert_eq!(headings(&roomy), all);
    roomy.press(&model(), "One in front");
    assert_eq!(headings(&roomy), [all[1], all[2], all[0]]);
    let mut phone = Screen::new(PHONE, &model());
    assert_eq!(headings(&phone), all[..1]);
    phone.press(&model(), "Hitch");
    phone.frame(&model(), vec![]);
    assert_eq!(headings(&phone), all[2..]);
}

#[test]
fn buttons_and_the_space_bar_send_what_they_say() {
    let space =
        Event::Key { key: Key::Space, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let sent = |command| [Command::from(command)];
    let (playing, paused) = (model(), Dashboard { playing: false, ..model() });
    let mut screen = Screen::new(WIDE, &playing);
    assert_eq!(screen.frame(&playing, vec![space.clone()]), sent(TransportCommand::Pause));
    assert_eq!(screen.frame(&paused, vec![space]), sent(TransportCommand::Play));
    screen.frame(&playing, vec![]);
    assert_eq!(screen.click(&playing, "Pause"), sent(TransportCommand::Pause));
    assert_eq!(screen.click(&playing, "Step"), sent(TransportCommand::Step));
    assert_eq!(screen.click(&playing, "Reset"), sent(TransportCommand::Reset));
    assert_eq!(screen.click(&playing, "Re-roll"), sent(TransportCommand::ReRoll));
    screen.press(&playing, "Menu");
    screen.press(&playing, "Light theme");
    assert_eq!(screen.state.settings.theme, ThemeChoice::Light);
    screen.press(&playing, "Menu");
    screen.press(&playing, "Dark theme");
    assert_eq!(screen.state.settings.theme, ThemeChoice::Dark, "chosen by name, not in turn");
}

#[test]
fn a_seed_is_typed_in_and_what_is_none_stays_for_mending() {
    let press = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let typed = |text: &str| {
        let mut screen = Screen::new(WIDE, &model());
        screen.click(&model(), "2005");
        let select_all =
            Event::Key { key: Key::A, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::COMMAND };
        screen.frame(&model(), vec![select_all]);
        screen.frame(&model(), vec![Event::Text(text.into())]);
        let mut commands = screen.frame(&model(), vec![press(Key::Enter)]);
        commands.extend(screen.frame(&model(), vec![]));
        screen.frame(&model(), vec![]);
        let back = screen.texts().iter().any(|(t, _)| t == "2005");
        (commands, back, screen.state.seed.map(|draft| (draft.text, draft.is_refused)))
    };
    assert_eq!(typed("77"), (vec![Command::from(TransportCommand::SetSeed(Seed(77)))], true, None));
    assert_eq!(typed("a cat"), (vec![], false, Some(("a cat".into(), true))));
}

#[test]
fn on_no_width_do_the_words_of_the_bar_lie_on_one_another() {
    let late = Dashboard { behind: Some("slower than real time: 0.5 x".into()), ..model() };
    for width in (320..=1400).step_by(20) {
        let screen = Screen::new(vec2(width as f32, 800.0), &late);
        let texts = screen.texts();
        let top = screen.control("Pause").1.top() - 4.0;
        let bar: Vec<_> = texts.iter().filter(|(_, at)| at.top() >= top && (width < 720 || at.left() > 76.0)).collect();
        for (i, (a, at)) in bar.iter().enumerate() {
            for (b, there) in &bar[i + 1..] {
                // the note keeps off the time
                let apart = if b.starts_with("slower") { 4.0 } else { -1.0 };
                assert!(!at.expand(apart).intersects(*there), "{width} wide: {a} at {at} on {b} at {there}");
            }
        }
    }
}

#[test]
fn contact_shows_in_the_goals_red() {
    let painted = |flash| {
        let mut model = model();
        model.cockpits[1].robots[0].flash = flash;
        let red = Theme::Light.tint(Role::Goal, 0.85);
        Screen::new(WIDE, &model).shapes.iter().any(|s| matches!(&s.shape, Shape::Path(path) if path.fill == red))
    };
    assert!(painted(true) && !painted(false));
}

#[test]
fn arrow_keys_and_buttons_move_through_time() {
    let press = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let sent = |command| [Command::from(command)];
    let paused = Dashboard { playing: false, tick: 600, ..model() };
    let mut screen = Screen::new(WIDE, &paused);
    assert_eq!(screen.frame(&paused, vec![press(Key::ArrowLeft)]), sent(TransportCommand::StepBack));
    assert_eq!(screen.frame(&paused, vec![press(Key::ArrowRight)]), sent(TransportCommand::Step));
    assert_eq!(screen.frame(&paused, vec![press(Key::Home)]), sent(TransportCommand::Seek(0)));
    assert_eq!(screen.click(&paused, "Back"), sent(TransportCommand::StepBack));
}

#[test]
fn the_time_line_goes_to_the_tick_that_is_pointed_at() {
    let paused = Dashboard { playing: false, tick: 1200, ..model() };
    for size in [WIDE, PHONE] {
        let mut screen = Screen::new(size, &paused);
        let pos = screen.control("time line").1.center();
        let button =
            |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
        let mut commands = screen.frame(&paused, vec![Event::PointerMoved(pos), button(true)]);
        commands.extend(screen.frame(&paused, vec![button(false)]));
        let [Command::Run(RunCommand::Transport(TransportCommand::Seek(tick))), ..] = commands[..] else {
            panic!("{commands:?}")
        };
        assert!(tick.abs_diff(600) <= 20, "the middle of 1200 ticks, not {tick}");
    }
    // before the first tick there is nowhere to go
    let fresh = Dashboard { playing: false, tick: 0, frontier: 0, ..model() };
    let mut screen = Screen::new(WIDE, &fresh);
    let pos = screen.control("time line").1.center();
    let button =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    let mut commands = screen.frame(&fresh, vec![Event::PointerMoved(pos), button(true)]);
    commands.extend(screen.frame(&fresh, vec![button(false)]));
    assert_eq!(commands, []);
}

#[test]
fn a_speed_is_chosen_from_its_list() {
    let mut screen = Screen::new(WIDE, &model());
    assert_eq!(screen.click(&model(), "1 x"), []);
    for _ in 0..3 {
        screen.frame(&model(), vec![]);
    }
    assert_eq!(screen.click(&model(), "16 x"), [Command::from(TransportCommand::SetSpeed(16.0))]);
    let fast = Dashboard { speed: 16.0, ..model() };
    screen.frame(&fast, vec![]);
    assert!(screen.texts().iter().any(|(text, _)| text == "16 x"));
}

#[test]
fn a_clicked_pane_is_driven_by_the_arrow_keys_until_esc() {
    let key = |key, pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE };
    let drive = |a, b| [Command::from(RobotCommand { robot: "Rusty".into(), input: RobotInput::Drive(a, b) })];
    let model = model();
    let mut screen = Screen::new(WIDE, &model);
    let pos = pos2(150.0, 200.0); // on the first paper
    let button =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    screen.frame(&model, vec![Event::PointerMoved(pos), button(true)]);
    assert_eq!(screen.frame(&model, vec![button(false)]), [], "arming is no input");
    assert_eq!(screen.state.hand.armed.as_deref(), Some("Rusty"));
    screen.frame(&model, vec![]);
    assert!(screen.texts().iter().any(|(text, _)| text == "arrows drive, Esc lets go"));
    let checkpoint = Command::from(TransportCommand::Checkpoint);
    let first = screen.frame(&model, vec![key(Key::ArrowUp, true)]);
    assert_eq!((&first[0], &first[1..]), (&checkpoint, &drive(128, 0)[..]), "what follows can be undone");
    assert_eq!(screen.frame(&model, vec![]), [], "held: nothing changes");
    assert_eq!(screen.frame(&model, vec![key(Key::ArrowRight, true)]), drive(128, -128));
    assert_eq!(screen.frame(&model, vec![key(Key::ArrowUp, false)]), drive(0, -128));
    assert_eq!(screen.frame(&model, vec![key(Key::Escape, true)]), drive(0, 0), "it does not drive on by itself");
    assert_eq!(screen.state.hand.armed, None);
    screen.frame(&model, vec![key(Key::ArrowRight, false), key(Key::Escape, false)]);
    let step = [Command::from(TransportCommand::StepBack)];
    assert_eq!(screen.frame(&model, vec![key(Key::ArrowLeft, true)]), step, "the keys move through time again");
}

#[test]
fn an_arm_is_not_armed_and_links_release_and_couple() {
    let sent = |robot: &str, input| {
        let checkpoint = Command::from(TransportCommand::Checkpoint);
        [checkpoint, Command::from(RobotCommand { robot: robot.into(), input })]
    };
    let mut model = model();
    model.cockpits[0].robots[0].drivable = false;
    model.cockpits[1].robots[0].manual = true;
    model.cockpits[2].robots[0].trailer = Some(true);
    let mut screen = Screen::new(WIDE, &model);
    let pos = pos2(150.0, 200.0);
    let button =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    screen.frame(&model, vec![Event::PointerMoved(pos), button(true)]);
    screen.frame(&model, vec![button(false)]);
    assert_eq!(screen.state.hand.armed, None);
    screen.press(&model, "Bring Reach");
    assert_eq!(screen.click(&model, "resume tour"), sent("Reach", RobotInput::Release));
    screen.press(&model, "Bring Hitch");
    assert_eq!(screen.click(&model, "take the trailer off"), sent("Hitch", RobotInput::SetTrailer(false)));
    model.cockpits[2].robots[0].trailer = Some(false);
    screen.frame(&model, vec![]);
    assert_eq!(screen.click(&model, "put a trailer on"), sent("Hitch", RobotInput::SetTrailer(true)));
}

#[test]
fn hints_and_lists_are_on_the_themes_paper_too() {
    let mut screen = Screen::new(WIDE, &model());
    for theme in [Theme::Light, Theme::Dark] {
        screen.state.settings.theme = if theme == Theme::Dark { ThemeChoice::Dark } else { ThemeChoice::Light };
        screen.frame(&model(), vec![]);
        assert_eq!(screen.ctx.global_style().visuals.window_fill, theme.colour(Role::Paper), "{theme:?}");
    }
}
