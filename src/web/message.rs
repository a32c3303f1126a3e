//! `Message`, a request of a page to the lab. docs/web/messages.md has those that a page around a frame may make.

use serde::Deserialize;
use serde_json::{Map, Value};

use crate::json_words::in_words;
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

impl PageRequest {
    /// Reads a request, or says in words which field of which message is wrong.
    pub fn read(text: &str) -> Result<Self, String> {
        let Value::Object(fields) = serde_json::from_str(text).map_err(|error| in_words(&error.to_string()))? else {
            return Err("a message is an object, with its name under `do`".to_owned());
        };
        // serde would take a number for the message's place among them
        if !fields.get("do").is_some_and(Value::is_string) {
            return Err("the field `do` is missing, a text: the name of the message".to_owned());
        }
        let read = |fields: &Map<String, Value>| {
            serde_json::from_value::<Self>(Value::Object(fields.clone())).map_err(|error| error.to_string())
        };
        read(&fields).map_err(|reason| {
            // serde does not say which field it is about: one without which it finds something else, and not just that
            // field's lack, which it may find before the fault
            let without = |name: &String| {
                let mut others = fields.clone();
                others.remove(name);
                read(&others).err()
            };
            let is_of_a_field = reason.starts_with("invalid ") || reason.starts_with("unknown variant");
            let names = fields.keys().filter(|name| is_of_a_field && *name != "do");
            let blamed: Vec<&String> = names.filter(|name| without(name).as_ref() != Some(&reason)).collect();
            let is_lack = |name: &String| without(name) == Some(format!("missing field `{name}`"));
            let field = blamed.iter().find(|name| !is_lack(name)).or(blamed.first());
            let told = fields
                .get("do")
                .and_then(Value::as_str)
                .filter(|_| field.is_some() || !reason.starts_with("unknown variant"));
            let place = [told, field.map(|name| name.as_str())].into_iter().flatten().map(|name| format!("{name}: "));
            format!("{}{}", place.collect::<String>(), in_words(&reason))
        })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_message_and_field() {
        for (text, said) in [
            (r#"{"do": "seek", "tick": "5"}"#, "seek: tick: the text \"5\" does not belong here, a whole number does"),
            (r#"{"do": "seek"}"#, "seek: the field `tick` is missing"),
            (r#"{"do": "fail", "tick": 5}"#, "there is no `fail`"),
            (r#"{"tick": 5}"#, "the field `do` is missing"),
            (r#"{"do": 7}"#, "the field `do` is missing, a text"),
            (r#"{"do": "play", "request": 7}"#, "play: request: the number `7` does not belong here, a text does"),
            (
                r#"{"do": "configuration", "coordinates": [0, "x"]}"#,
                "configuration: coordinates: the text \"x\" does not",
            ),
            (r#"{"do": "robot", "robot": "Rusty", "drive": [1]}"#, "robot: drive: a list of 1 does not belong here"),
            (r#"{"do": "robot", "robot": "Rusty", "drives": [1, 2]}"#, "robot: what it is to do is missing"),
            (
                r#"{"do": "robot", "robot": "Rusty", "teleport": "x"}"#,
                "robot: teleport: the text \"x\" does not belong",
            ),
            (r#"{"do": "robot", "robot": 5, "teleport": [1]}"#, "robot: robot: the number `5` does not belong here"),
            (r#"{"do": "door", "world": "Lot", "open": true}"#, "door: the field `name` is missing"),
            (r#"{"do": "figure", "png": -1}"#, "figure: png: the number `-1` does not belong here"),
            (r#"{"do": "act", "id": "1", "action": "prss"}"#, "act: action: there is no `prss`"),
            ("[]", "a message is an object, with its name under `do`"),
            ("{", "the line ends too early"),
        ] {
            let error = PageRequest::read(text).unwrap_err();
            assert!(error.starts_with(said), "{text}: {error}");
            assert!(
                !["variant", "u64", "i16", "enum", "struct"].iter().any(|word| error.contains(word)),
                "{text}: {error}"
            );
        }
    }

    #[test]
    fn a_message_is_read_with_its_mark() {
        let read = PageRequest::read(r#"{"do": "seek", "tick": 5, "request": "a", "around": true}"#);
        let message = Message::Seek { tick: 5 };
        assert_eq!(read, Ok(PageRequest { message, request: Some("a".to_owned()), around: true }));
    }
}
