//! `Question`, a question of `query`.

use clap::ValueEnum;

/// A question that can be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Question {
    /// Whether the robot touches anything.
    Intersects,
    /// How far it is from the nearest obstacle.
    Distance,
    /// The nearest points, and what they lie on.
    Witness,
    /// Whether the motion to TO hits, each part moving in a straight line.
    Swept,
    /// What is known of the straight line of the configuration chart to TO.
    Edge,
    /// What a range sensor there sees.
    Scan,
}

impl Question {
    /// Whether it is about a motion, not about one configuration.
    pub(super) fn is_of_motion(self) -> bool {
        match self {
            Question::Swept | Question::Edge => true,
            Question::Intersects | Question::Distance | Question::Witness | Question::Scan => false,
        }
    }
}
