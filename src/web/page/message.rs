//! `Message`, a request of a page to the lab. docs/web/messages.md has those that a page around a frame may make.

use serde::Deserialize;

use motion_lab_sim::run::{Quantized, RobotInput};

/// A request, with what stands beside it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PageRequest {
    /// What the page wants.
    #[serde(flatten)]
    pub message: Message,
    /// A mark that what comes of it bears.
    #[serde(default)]
    pub request: Option<String>,
    /// Whether the page around a frame asks. What is refused to it is not the reader's: its words would stand there as
    /// the lab's own.
    #[serde(default)]
    pub around: bool,
}

/// A request of a page: a JSON object with its name under `do`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Message {
    /// Act on a widget of the canvas.
    Act {
        /// Its number.
        id: String,
        /// The action.
        action: WidgetAction,
        /// The number or text, where the action takes one.
        #[serde(default)]
        value: Option<String>,
    },
    /// A key, pressed or let go.
    Key {
        /// Its name as in `KeyboardEvent.key`.
        key: String,
        /// Whether it is down now.
        pressed: bool,
        /// Whether Shift is held.
        #[serde(default)]
        shift: bool,
    },
    /// Put text in where the cursor is.
    Paste {
        /// The text.
        text: String,
    },
    /// Light a role, or none.
    Light {
        /// Its name, as in the colour key's classes.
        role: Option<String>,
    },
    /// The browser refuses what was to be copied.
    NotCopied,
    /// Show what an address holds.
    Open {
        /// The address behind its question mark.
        query: String,
    },
    /// Play the run.
    Play,
    /// Pause the run.
    Pause,
    /// One tick.
    Step,
    /// One tick back.
    StepBack,
    /// Go to a tick.
    Seek {
        /// The tick.
        tick: u64,
    },
    /// Say until when the contact at the present tick could have been avoided; the state has it when it is known.
    Why,
    /// Play the way out of the contact that was explained.
    WayOut,
    /// Start a run with the same seed.
    Reset,
    /// Start a run with another seed.
    Reroll,
    /// Start a run with this seed, in decimal: JavaScript's numbers do not hold all.
    Seed {
        /// The seed.
        seed: String,
    },
    /// Put a widget in front.
    Widget {
        /// Its id.
        id: String,
    },
    /// Begin a lesson, or end the one under way.
    Lesson {
        /// Its id.
        id: Option<String>,
    },
    /// Choose Query's question.
    Tab {
        /// `intersects`, `distance`, `witness` or `swept`.
        id: String,
    },
    /// Put Query's robot, which is the configuration space's too, at this configuration.
    Configuration {
        /// Its chart coordinates: metres and radians.
        coordinates: Vec<f64>,
    },
    /// Give a robot of the run an input, which applies at the next tick.
    Robot {
        /// The robot's name.
        robot: String,
        /// The input.
        #[serde(flatten)]
        input: Input,
    },
    /// Open or close a door of the run, before the next tick.
    Door {
        /// The world's name.
        world: String,
        /// The door's name.
        name: String,
        /// Whether it is to be open.
        open: bool,
    },
    /// A gamepad's stick: it drives the robot in hand.
    Stick {
        /// Its channels: ahead and to the left, from -128 to 128.
        channels: (i16, i16),
    },
    /// Send the widget in front as a picture.
    Figure {
        /// Dots for each pixel of the sheet, for a page that makes a PNG of it; SVG when left out.
        #[serde(default)]
        png: Option<u32>,
    },
    /// Choose the paper.
    Theme {
        /// `system`, `light` or `dark`.
        name: String,
    },
    /// The system's preferences.
    System {
        /// Whether it prefers dark paper.
        dark: bool,
        /// Whether it prefers reduced motion.
        reduced_motion: bool,
        /// Whether the pointer is a finger.
        #[serde(default)]
        touch: bool,
    },
    /// Send the state and the lesson under way once more.
    State,
    /// Send the link of what is shown.
    Link,
    /// Send the run's log.
    Save,
    /// The page became visible or hidden.
    Visible {
        /// Whether it is visible.
        visible: bool,
    },
}

/// An input to a robot, by the one field that it has.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Input {
    /// Hold these control channels, from -128 to 128.
    Drive(i16, i16),
    /// Go to these chart coordinates by the end of the tick.
    MoveTo(Vec<f64>),
    /// Be put at these chart coordinates, unless something is there.
    Teleport(Vec<f64>),
    /// Attach the trailer, or detach it.
    Trailer(bool),
    /// Back to the tour, by `true`.
    Release(bool),
}

impl Input {
    /// The run's input; `None` for a coordinate that is not finite or beyond what a script holds.
    pub fn robot_input(self) -> Option<RobotInput> {
        let place = |q: Vec<f64>| q.into_iter().map(Quantized::try_new).collect::<Option<Vec<_>>>();
        Some(match self {
            Input::Drive(a, b) => RobotInput::Drive(a, b),
            Input::MoveTo(q) => RobotInput::MoveTo(place(q)?),
            Input::Teleport(q) => RobotInput::Teleport(place(q)?),
            Input::Trailer(on) => RobotInput::SetTrailer(on),
            Input::Release(_) => RobotInput::Release,
        })
    }
}

/// An action on a widget.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WidgetAction {
    /// Press it.
    Click,
    /// Give it the focus.
    Focus,
    /// Set its number.
    Set,
    /// Put this text in place of its own.
    Type,
}
