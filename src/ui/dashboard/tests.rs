//! The dashboard without a window: egui lays it out and we look at what it would paint.

use std::sync::Arc;

use bevy_egui::egui::{Context, Event, Key, Modifiers, PointerButton, RawInput, Rect, Shape, Vec2, pos2};

use super::dashboard;
use crate::configuration::{HitchCfg, T2};
use crate::geometry::{Point2, Pose2};
use crate::picture::{Picture, Role};
use crate::random::Seed;
use crate::robots::{HITCH, RUSTY, Reach, Robot};
use crate::simulation::TransportCommand;
use crate::ui::{Cockpit, CockpitRobot, Command, Dashboard, Theme, UiState};
use crate::worlds::Bounds;

const WIDE: Vec2 = Vec2::new(1280.0, 800.0);
const PHONE: Vec2 = Vec2::new(390.0, 844.0);

fn robot<R: Robot>(name: &str, robot: &R, q: R::Configuration) -> CockpitRobot {
    CockpitRobot {
        name: name.into(),
        readout: q.to_string(),
        footprint: robot.footprint(&q),
        heading: None,
        flash: false,
        contacts: 3,
        manual: false,
    }
}

fn cockpit(world: &str, width: f64, height: f64, robot: CockpitRobot) -> Cockpit {
    let bounds = Bounds { min: Point2::new(0.0, 0.0), max: Point2::new(width, height) };
    Cockpit { world: Arc::new(Picture::new(world, bounds)), robots: vec![robot] }
}

fn model() -> Dashboard {
    let car = HITCH.with_trailer();
    let pose = Pose2::new(10.5, 6.25, -1.5);
    Dashboard {
        cockpits: vec![
            cockpit("Apartment", 12.0, 8.0, robot("Rusty", &RUSTY, pose)),
            cockpit("Workbench", 4.8, 4.8, robot("Reach", &Reach::<2>::workbench(), T2::new(0.5, 1.0))),
            cockpit("Lot", 16.0, 10.0, robot("Hitch", &car, HitchCfg { body: pose, trailer: Some(-1.5) })),
        ],
        seed: Seed(2005),
        tick: 1200,
        playing: true,
    }
}

/// A screen that is looked at frame by frame.
struct Screen {
    ctx: Context,
    size: Vec2,
    state: UiState,
    shapes: Vec<Shape>,
}

impl Screen {
    fn new(size: Vec2, model: &Dashboard) -> Self {
        let mut screen = Screen { ctx: Context::default(), size, state: UiState::default(), shapes: Vec::new() };
        for _ in 0..3 {
            screen.frame(model, vec![]); // egui learns sizes from the frame before
        }
        screen
    }

    fn frame(&mut self, model: &Dashboard, events: Vec<Event>) -> Vec<Command> {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), self.size));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let mut commands = Vec::new();
        let output = self.ctx.run_ui(input, |ui| dashboard(ui, model, &mut self.state, &mut commands));
        self.shapes = output.shapes.into_iter().map(|clipped| clipped.shape).collect();
        commands
    }

    fn click(&mut self, model: &Dashboard, words: &str) -> Vec<Command> {
        let (_, rect) = self.texts().into_iter().find(|(text, _)| text == words).expect("a button with these words");
        let pos = rect.center();
        let button =
            |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
        let mut commands = self.frame(model, vec![Event::PointerMoved(pos), button(true)]);
        commands.extend(self.frame(model, vec![button(false)]));
        commands
    }

    /// All words with the place they take.
    fn texts(&self) -> Vec<(String, Rect)> {
        fn collect(shape: &Shape, out: &mut Vec<(String, Rect)>) {
            match shape {
                Shape::Text(text) => {
                    let rect = text.galley.rect.translate(text.pos.to_vec2());
                    out.push((text.galley.text().to_owned(), rect));
                }
                Shape::Vec(shapes) => shapes.iter().for_each(|s| collect(s, out)),
                _ => {}
            }
        }
        let mut out = Vec::new();
        self.shapes.iter().for_each(|s| collect(s, &mut out));
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
                assert!(!rect.shrink(0.5).intersects(place.shrink(0.5)), "{text:?} runs into {other:?} at {size}");
            }
        }
        assert!(texts.len() > 10, "the test no longer finds the words");
    }
}

#[test]
fn a_wide_screen_shows_all_cockpits_and_a_narrow_one_the_chosen() {
    let headings = |screen: &Screen| {
        screen.texts().into_iter().map(|(text, _)| text).filter(|t| t.contains(" \u{b7} ")).collect::<Vec<_>>()
    };
    let all = ["Rusty \u{b7} Apartment", "Reach \u{b7} Workbench", "Hitch \u{b7} Lot"];
    assert_eq!(headings(&Screen::new(WIDE, &model())), all);
    let mut phone = Screen::new(PHONE, &model());
    assert_eq!(headings(&phone), all[..1]);
    phone.click(&model(), "Hitch");
    phone.frame(&model(), vec![]);
    assert_eq!(headings(&phone), all[2..]);
}

#[test]
fn buttons_and_the_space_bar_send_what_they_say() {
    let space =
        Event::Key { key: Key::Space, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let sent = |command| [Command::Transport(command)];
    let (playing, paused) = (model(), Dashboard { playing: false, ..model() });
    let mut screen = Screen::new(WIDE, &playing);
    assert_eq!(screen.frame(&playing, vec![space.clone()]), sent(TransportCommand::Pause));
    assert_eq!(screen.frame(&paused, vec![space]), sent(TransportCommand::Play));
    screen.frame(&playing, vec![]);
    assert_eq!(screen.click(&playing, "Pause"), sent(TransportCommand::Pause));
    assert_eq!(screen.click(&playing, "Step"), sent(TransportCommand::Step));
    assert_eq!(screen.click(&playing, "Reset"), sent(TransportCommand::Reset));
    assert_eq!(screen.click(&playing, "Re-roll"), sent(TransportCommand::ReRoll));
    assert_eq!(screen.click(&playing, "Dark"), []);
    assert_eq!(screen.state.theme, Theme::Dark);
}

#[test]
fn a_seed_is_typed_in_and_what_is_none_is_put_back() {
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
        (commands, screen.texts().iter().any(|(t, _)| t == "2005"))
    };
    assert_eq!(typed("77"), (vec![Command::Transport(TransportCommand::SetSeed(Seed(77)))], true));
    assert_eq!(typed("a cat"), (vec![], true));
}

#[test]
fn contact_shows_in_the_goals_red() {
    let painted = |flash| {
        let mut model = model();
        model.cockpits[1].robots[0].flash = flash;
        let red = Theme::Light.tint(Role::Goal, 0.85);
        Screen::new(WIDE, &model).shapes.iter().any(|s| matches!(s, Shape::Path(path) if path.fill == red))
    };
    assert!(painted(true) && !painted(false));
}
