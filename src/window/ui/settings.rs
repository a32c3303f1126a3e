//! `Settings`, what is kept from one start of the program to the next.

use serde::{Deserialize, Serialize};

use motion_lab_sim::manifest::{HintTask, ThemeChoice, Widget};

/// The user's settings. They are no part of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, bevy::reflect::Reflect)]
#[serde(default)]
pub struct Settings {
    /// Light or dark paper.
    pub theme: ThemeChoice,
    /// Whether places and obstacles carry their names.
    pub labels: bool,
    /// Whether the range sensor's scan is drawn.
    pub scan: bool,
    /// Whether the nearest points are drawn.
    pub nearest: bool,
    /// Whether the plots are open.
    pub plots: bool,
    /// Index of the world in front.
    pub world: u32,
    /// Whether a wide window shows all worlds side by side.
    pub side_by_side: bool,
    /// The ids of the widgets whose first hints were put away.
    pub hints_away: Vec<String>,
    /// The ids of what hints ask for and the reader has done.
    pub done: Vec<String>,
    /// Whether fades and other animations are off.
    pub reduced_motion: bool,
}

impl Settings {
    /// Whether the first hints of this widget were put away.
    pub fn are_hints_away(&self, widget: Widget) -> bool {
        self.hints_away.iter().any(|id| id == widget.id())
    }

    /// Puts the first hints of this widget away.
    pub fn put_hints_away(&mut self, widget: Widget) {
        if !self.are_hints_away(widget) {
            self.hints_away.push(widget.id().to_owned());
        }
    }

    /// Puts the hints of this widget away, or brings them back.
    pub fn toggle_hints(&mut self, widget: Widget) {
        if self.are_hints_away(widget) {
            self.show_hints(widget);
        } else {
            self.put_hints_away(widget);
        }
    }

    /// Brings the hints of this widget back.
    pub fn show_hints(&mut self, widget: Widget) {
        self.hints_away.retain(|id| id != widget.id());
    }

    /// Whether the reader has done this.
    pub fn is_ticked_off(&self, task: HintTask) -> bool {
        self.done.contains(&task.id())
    }

    /// Keeps that the reader has done this.
    pub fn tick_off(&mut self, task: HintTask) {
        if !self.is_ticked_off(task) {
            self.done.push(task.id());
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            theme: ThemeChoice::System,
            labels: false,
            scan: false,
            nearest: false,
            plots: false,
            world: 0,
            side_by_side: false,
            hints_away: Vec::new(),
            done: Vec::new(),
            reduced_motion: false,
        }
    }
}
