//! `Message`, a request of a page to the lab. `docs/web.md` names this file to those who embed the lab.

use serde::Deserialize;

/// A request of a page: a JSON object with its name under `do`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Message {
    /// Act on a widget of the canvas.
    Act {
        /// Its number.
        id: String,
        /// The action.
        action: Action,
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
    },
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

/// An action on a widget.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Press it.
    Click,
    /// Give it the focus.
    Focus,
    /// Set its number.
    Set,
    /// Put this text in place of its own.
    Type,
}
