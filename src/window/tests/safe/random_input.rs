//! Hands that do anything, at sizes from a point to a wall: nothing stops the lab, every corner that it paints is a
//! number, and the run that comes of it is the same when it is simulated again.
//!
//! `MOTION_LAB_INPUTS=100000 MOTION_LAB_SEED=7 cargo test --lib random_input` does more of them, and others.

use egui::accesskit::{Action, ActionData, ActionRequest};
use egui::{TouchDeviceId, TouchId, TouchPhase, vec2};

use super::*;
use crate::window::desktop::capture::Capturing;
use crate::window::desktop::clipboard::Clipboard;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::simulation::recipe;

/// The inputs of one lab; then another begins.
const INPUTS_OF_A_LAB: u64 = 250;

/// What is typed and pasted.
const TEXTS: [&str; 16] = [
    "0",
    "-1",
    "1.5",
    "1e9",
    "NaN",
    "inf",
    "-0",
    "18446744073709551615",
    "0.000001",
    "\u{2212}2,5",
    "99999999999999999999999999999999999999999",
    "Rusty",
    "kitchen table",
    "\u{202e}\u{0}\n\t\"<b>",
    "\u{1f916}\u{301}\u{6f22}",
    "",
];

/// What was done, which is said where the lab stops.
struct Done(Vec<String>);

impl Drop for Done {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let last = self.0.len().saturating_sub(12);
            eprintln!("the last of {} inputs:\n{}", self.0.len(), self.0[last..].join("\n"));
        }
    }
}

/// One lab with somebody at it.
struct Hands {
    harness: Harness<'static, Lab>,
    draws: Stream,
}

impl Hands {
    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.draws.below(from.len() as u64) as usize]
    }

    /// A place on the screen, or a little beside it.
    fn anywhere(&mut self) -> Pos2 {
        let size = self.harness.ctx.content_rect().size();
        let mut along = |length: f32| self.draws.uniform(-20.0, f64::from(length) + 20.0) as f32;
        pos2(along(size.x), along(size.y))
    }

    /// Two times of three the middle of what a screen reader knows of, which may lie off the screen; else any place.
    fn somewhere(&mut self) -> Pos2 {
        let nodes = self.harness.root().children_recursive();
        let placed = nodes.filter(|node| node.accesskit_node().bounding_box().is_some());
        let middles: Vec<Pos2> = placed.map(|node| node.rect().center()).collect();
        if middles.is_empty() || self.draws.below(3) == 0 { self.anywhere() } else { self.pick(&middles) }
    }

    fn modifiers(&mut self) -> Modifiers {
        let few =
            [Modifiers::SHIFT, Modifiers::ALT, Modifiers::CTRL, Modifiers::COMMAND, Modifiers::CTRL | Modifiers::SHIFT];
        if self.draws.below(4) == 0 { self.pick(&few) } else { Modifiers::NONE }
    }

    fn press(&mut self, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        self.harness.event(Event::PointerMoved(pos));
        self.harness.event(Event::PointerButton { pos, button, pressed, modifiers });
    }

    fn touch(&mut self, finger: u64, phase: TouchPhase, pos: Pos2) {
        self.harness.event(Event::Touch { device_id: TouchDeviceId(1), id: TouchId(finger), phase, pos, force: None });
    }

    /// Does one thing. Returns what.
    fn act(&mut self) -> String {
        let said = match self.draws.below(22) {
            0..=5 => {
                let (at, modifiers) = (self.somewhere(), self.modifiers());
                let button = self.pick(&[
                    PointerButton::Primary,
                    PointerButton::Primary,
                    PointerButton::Primary,
                    PointerButton::Secondary,
                    PointerButton::Middle,
                ]);
                for _ in 0..=self.draws.below(2) {
                    self.press(at, button, true, modifiers);
                    self.press(at, button, false, modifiers);
                }
                format!("click {button:?} at {at:?} with {modifiers:?}")
            }
            6..=8 => {
                let (from, to, modifiers) = (self.somewhere(), self.somewhere(), self.modifiers());
                self.harness.event(Event::ModifiersChanged(modifiers));
                self.press(from, PointerButton::Primary, true, modifiers);
                (1..=3).for_each(|i| self.harness.event(Event::PointerMoved(from.lerp(to, i as f32 / 3.0))));
                // a button may be held on
                if self.draws.below(8) > 0 {
                    self.press(to, PointerButton::Primary, false, modifiers);
                }
                self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
                format!("drag {from:?} to {to:?} with {modifiers:?}")
            }
            9..=11 => {
                let (key, modifiers) = (self.pick(Key::ALL), self.modifiers());
                self.harness.key_down_modifiers(modifiers, key);
                if self.draws.below(4) > 0 {
                    self.harness.key_up_modifiers(modifiers, key);
                }
                format!("key {key:?} with {modifiers:?}")
            }
            12 => {
                let text = self.pick(&TEXTS).to_owned();
                let event = if self.draws.below(3) == 0 { Event::Paste(text) } else { Event::Text(text) };
                let said = format!("{event:?}");
                self.harness.event(event);
                said
            }
            13 => {
                let (at, modifiers) = (self.somewhere(), self.modifiers());
                let delta = vec2(self.draws.uniform(-300.0, 300.0) as f32, self.draws.uniform(-300.0, 300.0) as f32);
                self.harness.event(Event::PointerMoved(at));
                let unit =
                    self.pick(&[egui::MouseWheelUnit::Point, egui::MouseWheelUnit::Line, egui::MouseWheelUnit::Page]);
                self.harness.event(Event::MouseWheel { unit, delta, phase: TouchPhase::Move, modifiers });
                let zoom = self.draws.uniform(0.2, 5.0) as f32;
                self.harness.event(Event::Zoom(zoom));
                format!("wheel {unit:?} {delta:?} at {at:?}, zoom {zoom}")
            }
            14 | 15 => self.ask(),
            16 => {
                let side = |draws: &mut Stream| {
                    [1.0, 60.0, 320.0, 390.0, 820.0, 1280.0, 2560.0][draws.below(7) as usize] + draws.below(40) as f32
                };
                let size = vec2(side(&mut self.draws), side(&mut self.draws));
                self.harness.set_size(size);
                format!("size {size:?}")
            }
            17 => {
                let (at, to) = (self.somewhere(), self.somewhere());
                let finger = self.draws.below(2);
                self.touch(finger, TouchPhase::Start, at);
                self.press(at, PointerButton::Primary, true, Modifiers::NONE);
                self.touch(finger, TouchPhase::Move, to);
                let end = self.pick(&[TouchPhase::End, TouchPhase::Cancel]);
                self.touch(finger, end, to);
                self.press(to, PointerButton::Primary, false, Modifiers::NONE);
                self.harness.event(Event::PointerGone);
                format!("finger {finger} from {at:?} to {to:?}, {end:?}")
            }
            18 => {
                let event = self.pick(&[0, 1, 2, 3, 4]);
                let event = [
                    Event::WindowFocused(false),
                    Event::WindowFocused(true),
                    Event::PointerGone,
                    Event::Copy,
                    Event::Cut,
                ][event]
                    .clone();
                let said = format!("{event:?}");
                self.harness.event(event);
                said
            }
            19 => self.drive(),
            _ => {
                let frames = 1 + self.draws.below(8) as usize;
                self.harness.run_steps(frames);
                format!("{frames} frames")
            }
        };
        self.harness.step();
        said
    }

    /// Takes a robot in hand and holds an arrow for some frames: few of the other hands happen to drive.
    fn drive(&mut self) -> String {
        let robot = self.pick(&[Key::Num1, Key::Num2, Key::Num3]);
        let arrow = self.pick(&[Key::ArrowUp, Key::ArrowDown, Key::ArrowLeft, Key::ArrowRight]);
        self.harness.key_press(robot);
        self.harness.key_down(arrow);
        let frames = 1 + self.draws.below(12) as usize;
        self.harness.run_steps(frames);
        if self.draws.below(4) > 0 {
            self.harness.key_up(arrow);
        }
        format!("{arrow:?} for {frames} frames with {robot:?} in hand")
    }

    /// Asks for something as a screen reader does, of anything.
    fn ask(&mut self) -> String {
        let root = self.harness.root();
        let nodes: Vec<_> = root.children_recursive().collect();
        if nodes.is_empty() {
            return "nothing to ask".to_owned();
        }
        let node = nodes[self.draws.below(nodes.len() as u64) as usize].accesskit_node();
        let (target_node, target_tree) = node.locate();
        let name = node.label().unwrap_or_default();
        drop(nodes);
        let action = self.pick(&[
            Action::Click,
            Action::Click,
            Action::Focus,
            Action::SetValue,
            Action::SetValue,
            Action::Increment,
            Action::Decrement,
            Action::ScrollIntoView,
        ]);
        let data = (action == Action::SetValue).then(|| match self.draws.below(2) {
            0 => ActionData::Value(self.pick(&TEXTS).into()),
            _ => ActionData::NumericValue(self.pick(&[0.0, -1.0, 1e300, f64::NAN, f64::INFINITY, 0.5, 3.0])),
        });
        let said = format!("{action:?} {data:?} of {name:?}");
        self.harness.event(Event::AccessKitActionRequest(ActionRequest { action, target_node, target_tree, data }));
        said
    }
}

/// Asserts that the run is what its recipe says, where it is short enough to be simulated here.
fn replays(lab: &Lab) -> bool {
    let world = lab.app.world();
    let now = &world.resource::<LatestFrame>().frame();
    let Some(recipe) = recipe(world).filter(|_| now.tick <= 4000) else { return false };
    let mut again = Recorder::of(&recipe).expect("the run starts again");
    while again.frame().tick < now.tick {
        again.step();
    }
    assert_eq!(
        again.frame().digest(),
        now.digest(),
        "tick {} of the run is another when it is simulated again",
        now.tick
    );
    true
}

#[test]
fn nothing_that_hands_do_stops_the_lab_and_its_run_is_the_same_again() {
    let number = |name: &str, usual: u64| std::env::var(name).map_or(usual, |n| n.parse().expect("a whole number"));
    let (inputs, seed) = (number("MOTION_LAB_INPUTS", 2000), number("MOTION_LAB_SEED", 1));
    let (mut replayed, mut ticks, mut driven) = (0, 0, 0);
    for n in 0..inputs.div_ceil(INPUTS_OF_A_LAB) {
        let size = [WIDE, PHONE, [820.0, 1180.0], [600.0, 500.0]][n as usize % 4];
        let mut app = app(Duration::from_millis(25));
        app.insert_resource(Clipboard::by(|_| Ok(()))).init_resource::<Capturing>();
        let mut hands = Hands { harness: lab_of(app, size), draws: Stream::new(Seed(seed), &format!("hands {n}")) };
        let mut done = Done(vec![format!("seed {seed}, lab {n}")]);
        for i in 0..INPUTS_OF_A_LAB.min(inputs - n * INPUTS_OF_A_LAB) {
            let said = hands.act();
            done.0.push(said);
            if i % 50 == 0 {
                let primitives = hands.harness.ctx.tessellate(hands.harness.output().shapes.clone(), 1.0);
                for primitive in primitives {
                    let egui::epaint::Primitive::Mesh(mesh) = primitive.primitive else { continue };
                    let whole = mesh.vertices.iter().all(|v| v.pos.x.is_finite() && v.pos.y.is_finite());
                    assert!(whole, "a corner that is painted is no number");
                }
            }
        }
        replayed += u64::from(replays(hands.harness.state()));
        ticks += hands.harness.state().transport().frontier;
        driven += hands.harness.state().script().events.len();
    }
    println!("{inputs} inputs: {ticks} ticks, {driven} inputs of runs, {replayed} runs simulated again");
    assert!(
        replayed > 0 && ticks > 0 && (inputs < 2000 || driven > 40),
        "hands did little: {ticks} ticks, {driven} inputs, {replayed} runs"
    );
}

#[test]
fn a_robot_is_driven_in_a_magnified_world_that_has_no_room() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_press(Key::M);
    harness.run_steps(2);
    (0..3).for_each(|_| harness.key_press(Key::Plus));
    harness.key_down(Key::ArrowUp);
    for height in [800.0, 60.0, 30.0, 8.0, 1.0, 800.0] {
        harness.set_size(vec2(600.0, height));
        harness.run_steps(4);
    }
    harness.key_up(Key::ArrowUp);
    harness.run_steps(2);
    let drives =
        harness.state().script().events.iter().filter(|event| event.input == RobotInput::Drive(128, 0)).count();
    assert_eq!(drives, 1, "it was held all the while");
}
