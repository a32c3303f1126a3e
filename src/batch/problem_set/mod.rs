//! Planning problems as data: a file of sets, each given by its ends, by a scenario, or made by a seed.
//!
//! ```
//! use motion_lab::batch::ProblemFile;
//!
//! let text = "Problems(version: 1, sets: [
//!     Crossed(world: \"apartment\", robot: \"Rusty\", starts: [[1.5, 5.75, 0]], goals: [[9.75, 6.25, 0], [4, 2, 0]]),
//!     Generated(of: Maze(columns: 6, rows: 6), count: 50, seed: 1),
//! ])";
//! let file = ProblemFile::parse("problems.ron", text)?;
//! let apartment = motion_lab::worlds::World::apartment();
//! let set = file.with(&[("apartment".to_owned(), apartment)].into(), &[].into())?;
//! assert_eq!(set.len(), 52);
//! let maze = set.problem(2).unwrap();
//! assert_eq!((maze.known.unwrap().number, maze.task?.name.as_str()), (3, "Rusty"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bundle;
mod file;
mod known;
mod place;
mod set;
mod source;
#[cfg(test)]
mod tests;
mod text;

pub use bundle::ProblemBundle;
pub use file::{ProblemFile, ProblemFileError};
pub use known::{KnownProblem, SetProblem};
pub use set::ProblemSet;
