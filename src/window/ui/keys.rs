//! The keys: one table feeds the shortcuts, the list of them, the hints on buttons and a test against clashes.

use bevy_egui::egui::{EventFilter, FocusDirection, Id, InputState, Key, Modifiers, Popup, Ui};

use motion_lab_sim::manifest::Widget;

/// An action that a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Play, or pause.
    PlayPause,
    /// One tick back.
    StepBack,
    /// One tick on.
    Step,
    /// To tick 0.
    Start,
    /// As far as the run has come.
    End,
    /// To the next contact known.
    NextContact,
    /// Play again and again, or not.
    Loop,
    /// The next slower speed.
    Slower,
    /// The next faster speed.
    Faster,
    /// Forget what comes after the present tick.
    Continue,
    /// A new run from the same seed.
    Reset,
    /// A new run from another seed.
    ReRoll,
    /// Undo.
    Undo,
    /// Do again.
    Redo,
    /// Save the run.
    Save,
    /// Open a run.
    Open,
    /// Capture the widget in front.
    Capture,
    /// Take the robot of this pane in hand.
    Arm(usize),
    /// Let go of it.
    LetGo,
    /// Drive the robot in hand while the key is held.
    Drive(Push),
    /// Turn the joint of the handle with the focus: counter-clockwise, or clockwise.
    Turn {
        /// Whether counter-clockwise.
        left: bool,
    },
    /// Leave the handle with the focus.
    LeaveHandle,
    /// Move the atlas's robot, its measured point or what is selected in it.
    Move(Way),
    /// Turn the atlas's robot, or what is selected in it.
    TurnThing {
        /// Whether counter-clockwise.
        left: bool,
    },
    /// Remove what is selected in the atlas.
    Delete,
    /// Drop what is being added or dragged in the atlas, or select nothing.
    Deselect,
    /// Open or fold the plots.
    Plots,
    /// Names on or off.
    Labels,
    /// The scan on or off.
    Scan,
    /// The picture in front over the whole window, or not.
    Fill,
    /// Magnify the world in front.
    Magnify,
    /// Show more of it.
    ShowMore,
    /// Show the whole of it.
    Fit,
    /// The hints, or none.
    Hints,
    /// The next theme.
    Theme,
    /// The list of keys.
    Help,
    /// The widget with this number on the rail.
    Widget(Widget),
}

/// A direction in which a robot in hand is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Push {
    /// Forward.
    Forward,
    /// Backward.
    Backward,
    /// Turning or steering left.
    Left,
    /// Turning or steering right.
    Right,
}

/// A way on the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Towards lesser x.
    Left,
    /// Towards greater x.
    Right,
    /// Towards greater y.
    Up,
    /// Towards lesser y.
    Down,
}

impl Way {
    /// One step along x and y.
    pub fn steps(self) -> [f64; 2] {
        match self {
            Way::Left => [-1.0, 0.0],
            Way::Right => [1.0, 0.0],
            Way::Up => [0.0, 1.0],
            Way::Down => [0.0, -1.0],
        }
    }
}

/// The states in which a key is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Always.
    Always,
    /// While no robot is in hand.
    Unarmed,
    /// While one is.
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
pub const BINDINGS: [Binding; 57] = [
    plain(Action::PlayPause, Key::Space, Scope::Always, "play or pause"),
    plain(Action::StepBack, Key::ArrowLeft, Scope::Unarmed, "one tick back, and pause"),
    plain(Action::Step, Key::ArrowRight, Scope::Unarmed, "one tick, and pause"),
    plain(Action::Start, Key::Home, Scope::Always, "to the start"),
    plain(Action::End, Key::End, Scope::Always, "as far as the run has come"),
    plain(Action::NextContact, Key::N, Scope::Always, "to the next contact"),
    plain(Action::Loop, Key::L, Scope::Always, "loop on or off"),
    plain(Action::Slower, Key::Comma, Scope::Always, "slower"),
    plain(Action::Faster, Key::Period, Scope::Always, "faster"),
    plain(Action::Continue, Key::C, Scope::Always, "continue from here: forget what comes later"),
    plain(Action::Reset, Key::R, Scope::Always, "reset: the same seed, no input"),
    plain(Action::ReRoll, Key::G, Scope::Always, "re-roll: another seed"),
    with(Action::Undo, Modifiers::COMMAND, Key::Z, "undo; in the atlas an edit"),
    with(Action::Redo, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z, "redo"),
    with(Action::Redo, Modifiers::COMMAND, Key::Y, "redo"),
    with(Action::Save, Modifiers::COMMAND, Key::S, "save the run; in the atlas its world, in plan its path"),
    with(Action::Open, Modifiers::COMMAND, Key::O, "open a run; in the atlas a world, in plan a path"),
    plain(Action::Capture, Key::I, Scope::Always, "capture: the picture in front as a file"),
    plain(Action::Arm(0), Key::Num1, Scope::Always, "take the first pane's robot in hand, or let go"),
    plain(Action::Arm(1), Key::Num2, Scope::Always, "take the second pane's robot in hand, or let go"),
    plain(Action::Arm(2), Key::Num3, Scope::Always, "take the third pane's robot in hand, or let go"),
    plain(Action::LetGo, Key::Escape, Scope::Armed, "let go"),
    plain(Action::Drive(Push::Forward), Key::ArrowUp, Scope::Armed, "forward; with Shift a quarter as fast"),
    plain(Action::Drive(Push::Backward), Key::ArrowDown, Scope::Armed, "backward"),
    plain(Action::Drive(Push::Left), Key::ArrowLeft, Scope::Armed, "turn or steer left"),
    plain(Action::Drive(Push::Right), Key::ArrowRight, Scope::Armed, "turn or steer right"),
    plain(Action::Turn { left: true }, Key::ArrowLeft, Scope::Handle, "turn the joint left; with Shift a tenth as far"),
    plain(Action::Turn { left: true }, Key::ArrowUp, Scope::Handle, "turn the joint left"),
    plain(Action::Turn { left: false }, Key::ArrowRight, Scope::Handle, "turn the joint right"),
    plain(Action::Turn { left: false }, Key::ArrowDown, Scope::Handle, "turn the joint right"),
    plain(Action::LeaveHandle, Key::Escape, Scope::Handle, "leave the handle"),
    plain(Action::Move(Way::Left), Key::ArrowLeft, Scope::Atlas, "the robot, or what is selected, 5 cm to the left"),
    plain(Action::Move(Way::Right), Key::ArrowRight, Scope::Atlas, "5 cm to the right"),
    plain(Action::Move(Way::Up), Key::ArrowUp, Scope::Atlas, "5 cm up"),
    plain(Action::Move(Way::Down), Key::ArrowDown, Scope::Atlas, "5 cm down"),
    shifted(Action::TurnThing { left: true }, Key::ArrowLeft, "turn it left by 15\u{b0}"),
    shifted(Action::TurnThing { left: false }, Key::ArrowRight, "turn it right by 15\u{b0}"),
    plain(Action::Delete, Key::Delete, Scope::Atlas, "remove what is selected"),
    plain(Action::Delete, Key::Backspace, Scope::Atlas, "remove what is selected"),
    plain(Action::Deselect, Key::Escape, Scope::Atlas, "drop what is being added, or select nothing"),
    plain(Action::Plots, Key::P, Scope::Always, "plots"),
    plain(Action::Labels, Key::T, Scope::Always, "names of things"),
    plain(Action::Scan, Key::F, Scope::Always, "what the range sensor sees"),
    plain(Action::Fill, Key::M, Scope::Always, "fill the window with the picture in front, or not"),
    plain(Action::Magnify, Key::Plus, Scope::Always, "magnify the world in front"),
    plain(Action::Magnify, Key::Equals, Scope::Always, "magnify the world in front"),
    plain(Action::ShowMore, Key::Minus, Scope::Always, "show more of the world in front"),
    plain(Action::Fit, Key::Num0, Scope::Always, "show the whole world"),
    plain(Action::Hints, Key::H, Scope::Always, "hints on or off"),
    plain(Action::Theme, Key::D, Scope::Always, "system, light or dark paper"),
    plain(Action::Help, Key::Questionmark, Scope::Always, "this list"),
    plain(Action::Help, Key::F1, Scope::Always, "this list"),
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
pub fn hint(action: Action) -> String {
    BINDINGS.iter().find(|b| b.action == action).map_or_else(String::new, |b| format!("{} ({})", b.words, b.keys()))
}

/// The key of an action's first binding: `Ctrl+S`. Empty without a binding.
pub fn keys_of(action: Action) -> String {
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
        scope && !own(b.key) && !matches!(b.action, Action::Drive(_))
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
pub fn pushed(input: &InputState) -> impl Iterator<Item = Push> {
    BINDINGS.iter().filter(|b| input.key_down(b.key)).filter_map(|b| match b.action {
        Action::Drive(push) => Some(push),
        _ => None,
    })
}

/// How often the keys of a handle's joint were pressed in this frame: to the left counted positive, to the right
/// negative.
pub fn turns(input: &InputState) -> f64 {
    let presses = BINDINGS.iter().map(|b| match b.action {
        Action::Turn { left } => (if left { 1.0 } else { -1.0 }) * input.num_presses(b.key) as f64,
        _ => 0.0,
    });
    presses.sum()
}

/// Whether the key that leaves a handle was pressed in this frame.
pub fn leaves_handle(input: &InputState) -> bool {
    BINDINGS.iter().any(|b| b.action == Action::LeaveHandle && input.key_pressed(b.key))
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
        let page = include_str!("../../../docs/window.md");
        let (_, keys) = page.split_once("## Keys").unwrap();
        let (table, _) = keys.split_once("\n## ").unwrap();
        for binding in BINDINGS {
            assert!(table.contains(&format!("`{}`", binding.keys())), "{:?}: {}", binding.action, binding.keys());
        }
    }

    #[test]
    fn hints_name_the_key() {
        assert_eq!(hint(Action::Step), "one tick, and pause (\u{2192})");
        assert_eq!(hint(Action::Redo), "redo (Ctrl+Shift+Z)");
        assert_eq!(hint(Action::Help), "this list (?)");
    }
}
