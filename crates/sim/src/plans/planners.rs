//! `Planners`, the planners that a program has.

use bevy::prelude::Resource;
use motion_lab_core::names::{hint, nearest};

use super::named::PlannerName;
use super::own::OwnPlanner;

/// The longest name of a planner, characters.
const MAX_ID: usize = 40;

/// The planners that a program has: the lab's, and those of its own. As kinds of robots are, they are registered by
/// name.
#[derive(Clone, Debug, Default, Resource)]
pub struct Planners {
    own: Vec<&'static OwnPlanner>,
}

/// Why a planner is not registered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlannerError {
    /// Another planner has its name.
    #[error("there is a planner {0:?} already")]
    Taken(String),
    /// Its name can't be written on a command line, in a list joined by commas and in the name of a file.
    #[error("{0:?} is no name of a planner: small letters, digits and hyphens, at most {MAX_ID}, a letter first")]
    Id(String),
    /// It is made for no robot.
    #[error("the planner {0:?} is made for no robot")]
    NoRobot(String),
}

/// There is no planner of a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no planner {name:?}; there are {}{}", known.join(", "), hint(nearest(name, known.iter().copied())))]
pub struct UnknownPlanner {
    name: String,
    known: Vec<&'static str>,
}

impl Planners {
    /// Puts a planner behind the others.
    ///
    /// # Errors
    /// [`PlannerError`]: it has no name of its own, or is made for no robot. Then nothing is registered.
    pub fn register(&mut self, planner: &'static OwnPlanner) -> Result<(), PlannerError> {
        self.check_name(planner.id)?;
        if !planner.suits_any() {
            return Err(PlannerError::NoRobot(planner.id.to_owned()));
        }
        self.own.push(planner);
        Ok(())
    }

    /// Whether a planner of this name could be registered.
    ///
    /// # Errors
    /// [`PlannerError`]: it is no name, or another planner has it.
    pub fn check_name(&self, id: &str) -> Result<(), PlannerError> {
        let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if !id.starts_with(|c: char| c.is_ascii_lowercase()) || !id.chars().all(is_part) || id.len() > MAX_ID {
            return Err(PlannerError::Id(id.to_owned()));
        }
        if self.all().any(|known| known.id() == id) {
            return Err(PlannerError::Taken(id.to_owned()));
        }
        Ok(())
    }

    /// All planners: the lab's, then those of the program's own in the order in which they were registered.
    pub fn all(&self) -> impl Iterator<Item = PlannerName> {
        PlannerName::ALL.into_iter().chain(self.own.iter().copied().map(PlannerName::Own))
    }

    /// The planner with this [`id`](PlannerName::id).
    ///
    /// # Errors
    /// [`UnknownPlanner`] says which there are, and which may be meant.
    pub fn named(&self, id: &str) -> Result<PlannerName, UnknownPlanner> {
        let unknown = || UnknownPlanner { name: id.to_owned(), known: self.all().map(PlannerName::id).collect() };
        self.all().find(|name| name.id() == id).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests;
