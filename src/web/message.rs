//! `Message`, what a page asks of the lab. README names this file to who embeds the lab.

use serde::Deserialize;

/// What a page asks of the lab: JSON with its name under `do`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Message {
    /// Do something with a widget of the canvas.
    Act {
        /// Its number.
        id: String,
        /// What.
        action: Action,
        /// What to set it to.
        #[serde(default)]
        value: Option<String>,
    },
    /// A key, pressed or let go.
    Key {
        /// Its name as in `KeyboardEvent.key`.
        key: String,
        /// Whether it is down now.
        pressed: bool,
        /// Whether Shift is.
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
    /// Let ticks follow one another.
    Play,
    /// Stop.
    Pause,
    /// One tick.
    Step,
    /// One tick back.
    StepBack,
    /// To a tick.
    Seek {
        /// Which.
        tick: u64,
    },
    /// The same seed from its start.
    Reset,
    /// Another seed.
    Reroll,
    /// This seed, in decimal: JavaScript's numbers do not hold all.
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
    /// What the system asks for.
    System {
        /// Dark paper.
        dark: bool,
        /// That nothing eases.
        reduced_motion: bool,
    },
    /// Say the link of what is shown.
    Link,
    /// Give the run's log.
    Save,
    /// The page is seen, or no more.
    Visible {
        /// Whether it is.
        visible: bool,
    },
    /// Fail, so that the page shows what it does then. For tests of the page.
    Fail,
}

/// What can be done with a widget.
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
