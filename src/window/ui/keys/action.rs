//! `Action`, what a key asks for, by who carries it out.

use motion_lab_sim::manifest::Widget;

/// An action that a key asks for. [`lab`](mod@super::super::lab) hands each to the one who carries it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Of the run or the planner in front.
    Time(TimeAction),
    Session(SessionAction),
    Hand(HandAction),
    Camera(CameraAction),
    Atlas(AtlasAction),
    /// Read where it applies, as long as the key is held.
    Held(HeldAction),
    /// The widget with this number on the rail.
    Widget(Widget),
}

/// An action that moves the run through time, or the planner through its iterations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeAction {
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
    /// Why the contact at the present tick came about; once that is known, the way out.
    Why,
    /// Play again and again, or not.
    Loop,
    Slower,
    Faster,
    /// Forget what comes after the present tick.
    Continue,
    /// A new run from the same seed.
    Reset,
    /// A new run from another seed.
    ReRoll,
}

/// An action on the session and on what is shown of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SessionAction {
    Undo,
    Redo,
    Save,
    Open,
    /// Capture the widget in front.
    Capture,
    /// Open or fold the plots.
    Plots,
    Labels,
    /// The scan on or off.
    Scan,
    /// The nearest points on or off.
    Nearest,
    /// The picture in front over the whole window, or not.
    Fill,
    /// The hints, or none.
    Hints,
    Theme,
    Help,
}

/// An action that takes a robot of the dashboard in hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandAction {
    /// Take the robot of this pane in hand.
    Arm(usize),
    LetGo,
}

/// What a key does while it is held, or while a handle has the focus: whoever has the robot in hand reads the key
/// itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldAction {
    /// Drive the robot in hand while the key is held.
    Drive(DriveDirection),
    /// Turn the joint of the handle with the focus: counter-clockwise, or clockwise.
    Turn { left: bool },
    /// Leave the handle with the focus.
    LeaveHandle,
}

/// An action on the view of the world in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraAction {
    /// Magnify the world in front.
    Magnify,
    ShowMore,
    /// Show the whole of it.
    Fit,
}

/// An action on the robot of the atlas or on what is selected there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtlasAction {
    /// Move the atlas's robot, its measured point or what is selected in it.
    Move(Direction),
    /// Turn the atlas's robot, or what is selected in it.
    TurnThing { left: bool },
    /// Remove what is selected in the atlas.
    Delete,
    /// Drop what is being added or dragged in the atlas, or select nothing.
    Deselect,
}

impl From<TimeAction> for Action {
    fn from(action: TimeAction) -> Self {
        Action::Time(action)
    }
}

impl From<SessionAction> for Action {
    fn from(action: SessionAction) -> Self {
        Action::Session(action)
    }
}

impl From<HandAction> for Action {
    fn from(action: HandAction) -> Self {
        Action::Hand(action)
    }
}

impl From<HeldAction> for Action {
    fn from(action: HeldAction) -> Self {
        Action::Held(action)
    }
}

impl From<CameraAction> for Action {
    fn from(action: CameraAction) -> Self {
        Action::Camera(action)
    }
}

impl From<AtlasAction> for Action {
    fn from(action: AtlasAction) -> Self {
        Action::Atlas(action)
    }
}

/// A direction in which a robot in hand is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveDirection {
    Forward,
    Backward,
    Left,
    Right,
}

/// A way on the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Left,
    Right,
    Up,
    Down,
}

impl Direction {
    /// One step along x and y.
    pub fn steps(self) -> [f64; 2] {
        match self {
            Direction::Left => [-1.0, 0.0],
            Direction::Right => [1.0, 0.0],
            Direction::Up => [0.0, 1.0],
            Direction::Down => [0.0, -1.0],
        }
    }
}
