//! Tasks for learning: what an episode is, as values, and many episodes stepped together.
//!
//! A [`LearningTask`] says what a robot sees, what its actions mean, what they earn and when an episode ends.
//! [`Episodes`] runs as many as are asked for, each a run of the lab: [`Episodes::log`] gives it as a log that any
//! program verifies. Three tasks are here: [`RustyGoal`], [`HitchPark`] and [`ReachPost`]. A [`Fleet`] is the first of
//! them for many rovers in one run.

mod draws;
mod episode;
mod episodes;
mod error;
mod fleet;
mod hitch_park;
mod reach_post;
mod rusty_goal;
mod task;

pub use episode::Autoreset;
pub use episodes::{Episodes, StepOutcome};
pub use error::EpisodesError;
pub use fleet::Fleet;
pub use hitch_park::HitchPark;
pub use reach_post::ReachPost;
pub use rusty_goal::RustyGoal;
pub use task::{EpisodeEnd, EpisodeMoment, EpisodeStart, Judgement, LearningTask, TaskSetting};
