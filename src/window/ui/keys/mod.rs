//! The keys: one table feeds the shortcuts, the list of them, the hints on buttons and a test against clashes.

use bevy_egui::egui::{Event, EventFilter, FocusDirection, Id, InputState, Key, Modifiers, Popup, Ui};

use motion_lab_sim::manifest::Widget;

mod action;

pub use action::{
    Action, AtlasAction, CameraAction, Direction, DriveDirection, HandAction, HeldAction, SessionAction, TimeAction,
};

/// The states in which a key is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    Always,
    /// While no robot is in hand.
    Unarmed,
    Armed,
    /// While a handle of an arm has the focus, which then takes the key for itself.
    Handle,
    /// While the atlas is in front, where the key means nothing else then.
    Atlas,
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// The action.
    pub action: Action,
    /// The key.
    pub key: Key,
    /// The modifiers held with it.
    pub modifiers: Modifiers,
    /// When it is active.
    pub scope: Scope,
    /// The action in words, for the list and the hints.
    pub words: &'static str,
}

const fn plain(action: Action, key: Key, scope: Scope, words: &'static str) -> Binding {
    Binding { action, key, modifiers: Modifiers::NONE, scope, words }
}

const fn with(action: Action, modifiers: Modifiers, key: Key, words: &'static str) -> Binding {
    Binding { action, key, modifiers, scope: Scope::Always, words }
}

const fn shifted(action: Action, key: Key, words: &'static str) -> Binding {
    Binding { action, key, modifiers: Modifiers::SHIFT, scope: Scope::Atlas, words }
}

/// All keys.
pub const BINDINGS: [Binding; 59] = [
    plain(Action::Time(TimeAction::PlayPause), Key::Space, Scope::Always, "play or pause"),
    plain(Action::Time(TimeAction::StepBack), Key::ArrowLeft, Scope::Unarmed, "one tick back, and pause"),
    plain(Action::Time(TimeAction::Step), Key::ArrowRight, Scope::Unarmed, "one tick, and pause"),
    plain(Action::Time(TimeAction::Start), Key::Home, Scope::Always, "to the start"),
    plain(Action::Time(TimeAction::End), Key::End, Scope::Always, "as far as the run has come"),
    plain(Action::Time(TimeAction::NextContact), Key::N, Scope::Always, "to the next contact"),
    plain(
        Action::Time(TimeAction::Why),
        Key::W,
        Scope::Always,
        "why the robot touches: its last chance, then the way out",
    ),
    plain(Action::Time(TimeAction::Loop), Key::L, Scope::Always, "loop on or off"),
    plain(Action::Time(TimeAction::Slower), Key::Comma, Scope::Always, "slower"),
    plain(Action::Time(TimeAction::Faster), Key::Period, Scope::Always, "faster"),
    plain(Action::Time(TimeAction::Continue), Key::C, Scope::Always, "continue from here: forget what comes later"),
    plain(Action::Time(TimeAction::Reset), Key::R, Scope::Always, "reset: the same seed, no input"),
    plain(Action::Time(TimeAction::ReRoll), Key::G, Scope::Always, "re-roll: another seed"),
    with(Action::Session(SessionAction::Undo), Modifiers::COMMAND, Key::Z, "undo; in the atlas an edit"),
    with(Action::Session(SessionAction::Redo), Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z, "redo"),
    with(Action::Session(SessionAction::Redo), Modifiers::COMMAND, Key::Y, "redo"),
    with(
        Action::Session(SessionAction::Save),
        Modifiers::COMMAND,
        Key::S,
        "save the run; in the atlas its world, in plan its path",
    ),
    with(
        Action::Session(SessionAction::Open),
        Modifiers::COMMAND,
        Key::O,
        "open a run; in the atlas a world, in plan a path",
    ),
    plain(Action::Session(SessionAction::Capture), Key::I, Scope::Always, "capture: the picture in front as a file"),
    plain(Action::Hand(HandAction::Arm(0)), Key::Num1, Scope::Always, "take the first pane's robot in hand, or let go"),
    plain(
        Action::Hand(HandAction::Arm(1)),
        Key::Num2,
        Scope::Always,
        "take the second pane's robot in hand, or let go",
    ),
    plain(Action::Hand(HandAction::Arm(2)), Key::Num3, Scope::Always, "take the third pane's robot in hand, or let go"),
    plain(Action::Hand(HandAction::LetGo), Key::Escape, Scope::Armed, "let go"),
    plain(
        Action::Held(HeldAction::Drive(DriveDirection::Forward)),
        Key::ArrowUp,
        Scope::Armed,
        "forward; with Shift a quarter as fast",
    ),
    plain(Action::Held(HeldAction::Drive(DriveDirection::Backward)), Key::ArrowDown, Scope::Armed, "backward"),
    plain(Action::Held(HeldAction::Drive(DriveDirection::Left)), Key::ArrowLeft, Scope::Armed, "turn or steer left"),
    plain(Action::Held(HeldAction::Drive(DriveDirection::Right)), Key::ArrowRight, Scope::Armed, "turn or steer right"),
    plain(
        Action::Held(HeldAction::Turn { left: true }),
        Key::ArrowLeft,
        Scope::Handle,
        "turn the joint left; with Shift a tenth as far",
    ),
    plain(Action::Held(HeldAction::Turn { left: true }), Key::ArrowUp, Scope::Handle, "turn the joint left"),
    plain(Action::Held(HeldAction::Turn { left: false }), Key::ArrowRight, Scope::Handle, "turn the joint right"),
    plain(Action::Held(HeldAction::Turn { left: false }), Key::ArrowDown, Scope::Handle, "turn the joint right"),
    plain(Action::Held(HeldAction::LeaveHandle), Key::Escape, Scope::Handle, "leave the handle"),
    plain(
        Action::Atlas(AtlasAction::Move(Direction::Left)),
        Key::ArrowLeft,
        Scope::Atlas,
        "the robot, or what is selected, 5 cm to the left",
    ),
    plain(Action::Atlas(AtlasAction::Move(Direction::Right)), Key::ArrowRight, Scope::Atlas, "5 cm to the right"),
    plain(Action::Atlas(AtlasAction::Move(Direction::Up)), Key::ArrowUp, Scope::Atlas, "5 cm up"),
    plain(Action::Atlas(AtlasAction::Move(Direction::Down)), Key::ArrowDown, Scope::Atlas, "5 cm down"),
    shifted(Action::Atlas(AtlasAction::TurnThing { left: true }), Key::ArrowLeft, "turn it left by 15\u{b0}"),
    shifted(Action::Atlas(AtlasAction::TurnThing { left: false }), Key::ArrowRight, "turn it right by 15\u{b0}"),
    plain(Action::Atlas(AtlasAction::Delete), Key::Delete, Scope::Atlas, "remove what is selected"),
    plain(Action::Atlas(AtlasAction::Delete), Key::Backspace, Scope::Atlas, "remove what is selected"),
    plain(
        Action::Atlas(AtlasAction::Deselect),
        Key::Escape,
        Scope::Atlas,
        "drop what is being added, or select nothing",
    ),
    plain(Action::Session(SessionAction::Plots), Key::P, Scope::Always, "plots"),
    plain(Action::Session(SessionAction::Labels), Key::T, Scope::Always, "names of things"),
    plain(Action::Session(SessionAction::Scan), Key::F, Scope::Always, "what the range sensor sees"),
    plain(Action::Session(SessionAction::Nearest), Key::V, Scope::Always, "what is nearest to the robot"),
    plain(
        Action::Session(SessionAction::Fill),
        Key::M,
        Scope::Always,
        "fill the window with the picture in front, or not",
    ),
    plain(Action::Camera(CameraAction::Magnify), Key::Plus, Scope::Always, "magnify the world in front"),
    plain(Action::Camera(CameraAction::Magnify), Key::Equals, Scope::Always, "magnify the world in front"),
    plain(Action::Camera(CameraAction::ShowMore), Key::Minus, Scope::Always, "show more of the world in front"),
    plain(Action::Camera(CameraAction::Fit), Key::Num0, Scope::Always, "show the whole world"),
    plain(Action::Session(SessionAction::Hints), Key::H, Scope::Always, "hints on or off"),
    plain(Action::Session(SessionAction::Theme), Key::D, Scope::Always, "system, light or dark paper"),
    plain(Action::Session(SessionAction::Help), Key::Questionmark, Scope::Always, "this list"),
    plain(Action::Session(SessionAction::Help), Key::F1, Scope::Always, "this list"),
    with(Action::Widget(Widget::Dashboard), Modifiers::COMMAND, Key::Num1, "the dashboard"),
    with(Action::Widget(Widget::Anatomy), Modifiers::COMMAND, Key::Num2, "query anatomy"),
    with(Action::Widget(Widget::Cspace), Modifiers::COMMAND, Key::Num3, "configuration space"),
    with(Action::Widget(Widget::Atlas), Modifiers::COMMAND, Key::Num4, "world atlas"),
    with(Action::Widget(Widget::Plan), Modifiers::COMMAND, Key::Num5, "plan"),
];

impl Binding {
    /// Whether its key means something in the atlas.
    fn is_taken_by_the_atlas(&self) -> bool {
        BINDINGS.iter().any(|b| b.scope == Scope::Atlas && b.key == self.key && b.modifiers == self.modifiers)
    }

    /// The key with its modifiers, as printed on the keyboard.
    pub fn keys(&self) -> String {
        let mut keys = String::new();
        for (held, name) in [(self.modifiers.command, "Ctrl+"), (self.modifiers.shift, "Shift+")] {
            if held && self.key != Key::Questionmark {
                keys.push_str(name);
            }
        }
        let name = match self.key {
            Key::ArrowLeft => "\u{2190}",
            Key::ArrowRight => "\u{2192}",
            Key::ArrowUp => "\u{2191}",
            Key::ArrowDown => "\u{2193}",
            Key::Questionmark => "?",
            Key::Comma => ",",
            Key::Period => ".",
            Key::Plus => "+",
            Key::Equals => "=",
            Key::Minus => "\u{2212}",
            key => key.name(),
        };
        keys + name
    }
}

/// The words and the key of an action's first binding: `one tick, and pause (→)`. Empty without a binding.
pub fn hint(action: impl Into<Action>) -> String {
    let action = action.into();
    BINDINGS.iter().find(|b| b.action == action).map_or_else(String::new, |b| format!("{} ({})", b.words, b.keys()))
}

/// The key of an action's first binding: `Ctrl+S`. Empty without a binding.
pub fn keys_of(action: impl Into<Action>) -> String {
    let action = action.into();
    BINDINGS.iter().find(|b| b.action == action).map_or_else(String::new, Binding::keys)
}

/// What the meaning of a key depends on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Situation {
    /// Whether a robot is in hand.
    pub armed: bool,
    /// Whether a handle of an arm has the focus.
    pub nudged: bool,
    /// Whether the atlas is in front.
    pub atlas: bool,
    /// Whether the atlas's paper has the focus.
    pub paper: bool,
    /// Whether a field for text had the focus as the last frame ended.
    pub typing: bool,
}

/// The actions whose keys were pressed in this frame: keys with more modifiers first, else in the order of the table.
///
/// None while text is typed; the Escape that leaves a field is the field's. A control with the focus keeps its own
/// keys: arrows, Space, Enter, Home and End. A handle with the focus keeps only the arrows, the atlas's paper none. The
/// keys that drive and those of handles are not among the actions.
pub fn pressed(ui: &Ui, now: Situation) -> Vec<Action> {
    // by Escape a field loses the focus before the frame begins
    if ui.ctx().text_edit_focused() || now.typing && ui.input(|i| i.key_pressed(Key::Escape)) {
        return vec![];
    }
    let focused = ui.memory(|m| m.focused().is_some()) && !now.paper;
    let own = |key| {
        use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, End, Enter, Home, Space};
        let arrows = matches!(key, ArrowLeft | ArrowRight | ArrowUp | ArrowDown);
        focused && (arrows || !now.nudged && matches!(key, Space | Enter | Home | End))
    };
    // an open list closes by Escape, and goes on by arrows
    let in_atlas = now.atlas && !Popup::is_any_open(ui.ctx());
    let due = |b: &&Binding| {
        let scope = match b.scope {
            Scope::Always => true,
            Scope::Unarmed => !(now.armed || in_atlas && b.is_taken_by_the_atlas()),
            Scope::Armed => now.armed,
            Scope::Handle => false,
            Scope::Atlas => in_atlas,
        };
        scope && !own(b.key) && !matches!(b.action, Action::Held(HeldAction::Drive(_)))
    };
    // more modifiers first: egui ignores extra modifiers, so Ctrl+Z would also take Ctrl+Shift+Z
    let mut bindings: Vec<&Binding> = BINDINGS.iter().filter(due).collect();
    bindings.sort_by_key(|b| std::cmp::Reverse(u8::from(b.modifiers.command) + u8::from(b.modifiers.shift)));
    ui.input_mut(|i| bindings.iter().filter(|b| i.consume_key(b.modifiers, b.key)).map(|b| b.action).collect())
}

/// Leaves the arrow keys and Escape to a part that has the focus, from its first frame on.
pub fn keep_arrows(ui: &Ui, id: Id) {
    let own = EventFilter { horizontal_arrows: true, vertical_arrows: true, escape: true, ..EventFilter::default() };
    ui.memory_mut(|m| {
        m.set_focus_lock_filter(id, own);
        // the filter is for later frames: an arrow of this one would still move the focus as the frame ends
        m.move_focus(FocusDirection::None);
    });
}

/// The directions whose keys are held down.
pub fn pushed(input: &InputState) -> impl Iterator<Item = DriveDirection> {
    BINDINGS.iter().filter(|b| input.key_down(b.key)).filter_map(|b| match b.action {
        Action::Held(HeldAction::Drive(push)) => Some(push),
        _ => None,
    })
}

/// How often the keys of a handle's joint were pressed in this frame: to the left counted positive, to the right
/// negative; with Shift a tenth each.
pub fn turns(input: &InputState) -> f64 {
    let turn = |event: &Event| {
        let Event::Key { key, pressed: true, modifiers, .. } = event else { return 0.0 };
        let far = if modifiers.shift { 0.1 } else { 1.0 };
        BINDINGS.iter().filter(|b| b.key == *key).fold(0.0, |sum, b| match b.action {
            Action::Held(HeldAction::Turn { left }) => sum + if left { far } else { -far },
            _ => sum,
        })
    };
    input.events.iter().map(turn).sum()
}

/// Whether the key that leaves a handle was pressed in this frame.
pub fn leaves_handle(input: &InputState) -> bool {
    BINDINGS.iter().any(|b| b.action == HeldAction::LeaveHandle.into() && input.key_pressed(b.key))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_means_two_things_at_once() {
        for (i, a) in BINDINGS.iter().enumerate() {
            assert!(!a.words.is_empty() && !a.keys().is_empty());
            for b in &BINDINGS[..i] {
                let together = a.scope == b.scope || a.scope == Scope::Always || b.scope == Scope::Always;
                let same = a.key == b.key && a.modifiers == b.modifiers && together;
                assert!(!same, "{:?} and {:?} share {}", a.action, b.action, a.keys());
            }
        }
    }

    #[test]
    fn the_page_about_the_window_lists_every_key() {
        let page = include_str!("../../../../docs/window.md");
        let (_, keys) = page.split_once("## Keys").unwrap();
        let (table, _) = keys.split_once("\n## ").unwrap();
        for binding in BINDINGS {
            assert!(table.contains(&format!("`{}`", binding.keys())), "{:?}: {}", binding.action, binding.keys());
        }
    }

    #[test]
    fn hints_name_the_key() {
        assert_eq!(hint(TimeAction::Step), "one tick, and pause (\u{2192})");
        assert_eq!(hint(SessionAction::Redo), "redo (Ctrl+Shift+Z)");
        assert_eq!(hint(SessionAction::Help), "this list (?)");
    }
}
