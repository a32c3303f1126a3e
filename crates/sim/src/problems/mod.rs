//! Planning problems by seed: fields of circles, mazes, narrow passages, parking lots and warehouses.
//!
//! A problem is a function of its generator, the seed and its number alone, the same to the bit everywhere. Where its
//! making tells whether there is a path, it says so.
//!
//! ```
//! use motion_lab_core::random::Seed;
//! use motion_lab_sim::problems::{Maze, ProblemGenerator};
//!
//! let mazes = ProblemGenerator::Maze(Maze { columns: 4, rows: 3, ..Maze::default() });
//! let problem = mazes.problem(Seed(1), 0)?;
//! assert_eq!((problem.task.name.as_str(), problem.has_path), ("Rusty", Some(true)));
//! # Ok::<(), motion_lab_sim::problems::GeneratorError>(())
//! ```

mod circles;
mod error;
mod generated;
mod generator;
mod maze;
mod parking;
mod passage;
mod site;
#[cfg(test)]
mod tests;
mod warehouse;

pub use circles::CircleField;
pub use error::GeneratorError;
pub use generated::GeneratedProblem;
pub use generator::ProblemGenerator;
pub use maze::Maze;
pub use parking::ParkingLot;
pub use passage::NarrowPassage;
pub use warehouse::WarehouseTrip;
