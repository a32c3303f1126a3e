//! `GeneratorError`, why there is no such problem.

use motion_lab_core::worlds::WarehouseError;

/// Why a generator makes no problem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeneratorError {
    /// A number out of range, or not finite.
    #[error("{field} {value}: it must be from {least} to {most}")]
    Range {
        /// The field's name.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The most that it may be.
        most: f64,
    },
    /// A robot for which there are no such problems.
    #[error("robot {found:?}: there are such problems for {expected}")]
    Robot {
        /// The kind that was asked for.
        found: String,
        /// The kinds that there are, in words.
        expected: &'static str,
    },
    /// There is no room for the robot.
    #[error("the {end} has no room: none of {tries} places that were drawn is free")]
    Crowded {
        /// What has none: `start`, `goal`.
        end: &'static str,
        /// The number of places that were drawn.
        tries: usize,
    },
    /// A warehouse with less than two robots of the kind.
    #[error("the warehouse has {found} {kind}: a trip is from the place of one to that of another")]
    Few {
        /// The kind.
        kind: &'static str,
        /// How many there are.
        found: usize,
    },
    /// There is no such warehouse.
    #[error(transparent)]
    Warehouse(#[from] WarehouseError),
}

/// Checks that a number is within a range, whose ends belong to it.
pub(super) fn within(field: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), GeneratorError> {
    if (least..=most).contains(&value) { Ok(()) } else { Err(GeneratorError::Range { field, value, least, most }) }
}
