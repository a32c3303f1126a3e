//! Shrinking: the smallest run that still shows something, by delta debugging over its recipe.
//!
//! ```
//! use motion_lab_core::random::Seed;
//! use motion_lab_sim::recording::Recorder;
//! use motion_lab_sim::run::Recipe;
//! use motion_lab_sim::shrink::{ShrinkOptions, shrink};
//! use motion_lab_sim::tour::TourConfig;
//!
//! // what is needed for Reach to have moved?
//! let moved = |recipe: &Recipe| {
//!     let Ok(mut run) = Recorder::of(recipe) else { return false };
//!     let named = |name: &String| name == "Reach";
//!     let names: Vec<String> = recipe.config.robot_names().map(str::to_owned).collect();
//!     let Some(id) = names.iter().position(named) else { return false };
//!     let start = run.frame().robots[id].configuration.clone();
//!     (0..recipe.config.ticks).for_each(|_| _ = run.step());
//!     run.frame().robots[id].configuration != start
//! };
//! let recipe = Recipe::new(TourConfig { ticks: 40, ..TourConfig::default() }, Seed(7));
//! let shrunk = shrink(&recipe, &ShrinkOptions::default(), moved, || true);
//! let config = &shrunk.recipe.config;
//! assert_eq!((config.worlds.len(), config.worlds[0].robots.len(), config.ticks), (1, 1, 1));
//! assert!(shrunk.is_minimal() && shrunk.after.obstacles == 0);
//! ```

mod condition;
mod condition_error;
mod condition_text;
mod first;
mod reading;
mod recordable;
mod removal;
mod round;
mod search;
mod size;
mod starts;
mod without;

pub use condition::{Condition, Relation};
pub use condition_error::{ConditionError, ConditionProblem};
pub use reading::RunReading;
pub use search::{ShrinkEnd, ShrinkOptions, Shrunk, shrink};
pub use size::RecipeSize;
