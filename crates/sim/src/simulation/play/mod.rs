//! Playing a path: the script that drives a robot along it, made by driving it, and certified tick by tick.

mod any;
mod arm;
mod car;
mod error;
mod rehearsal;
mod rover;
mod stage;
#[cfg(test)]
mod tests;

pub use error::PlayError;
pub use stage::{PlayStage, PlayablePath, PlayedPath};
