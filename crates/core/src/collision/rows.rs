//! `Rows`, configurations as rows of numbers, one after the other: what arrays and tables hold.

use std::marker::PhantomData;
use std::ops::Range;

use crate::configuration::Configuration;
use crate::robots::{ConfigurationError, Robot};

/// Configurations of a robot as rows of numbers in the caller's memory, one after the other, each checked.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::collision::{Checker, Rows, Scene};
/// let checker = Checker::new(Scene::apartment(), RustyDisc::default());
/// let numbers = [3.0, 5.5, 6.0, 4.0];
/// let mut distances = [0.0; 2];
/// checker.distances_into(&Rows::new(checker.robot(), &numbers, 2)?, &mut distances)?;
/// assert_eq!(distances[1], checker.distance(&R2::new(6.0, 4.0)));
///
/// let refused = Rows::new(checker.robot(), &[0.0, 1.0, f64::NAN, 1.0], 2).unwrap_err();
/// assert_eq!(refused.to_string(), "row 1: the configuration is not finite");
/// # Ok::<(), motion_lab_core::collision::RowsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, R> {
    numbers: &'a [f64],
    width: usize,
    robot: PhantomData<fn(&R)>,
}

/// Why numbers are no rows of a robot's configurations, or have no place for their answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RowsError {
    /// The numbers do not fill their last row, or rows of no numbers were asked for.
    #[error("{numbers} numbers are no rows of {width}")]
    Ragged {
        /// How many numbers there are.
        numbers: usize,
        /// How many a row was said to have.
        width: usize,
    },
    /// Edges with fewer beginnings than ends, or fewer ends.
    #[error("{from} rows to begin at, but {to} to end at")]
    Pairs {
        /// The number of rows that edges begin at.
        from: usize,
        /// The number of rows that they end at.
        to: usize,
    },
    /// Not as many places as answers.
    #[error("{answers} answers, but {places} places for them")]
    Places {
        /// The number of answers.
        answers: usize,
        /// The number of places.
        places: usize,
    },
    /// A row as long as no configuration of this type.
    #[error("{width} numbers are no configuration of this robot")]
    Width {
        /// How many numbers a row has.
        width: usize,
    },
    /// A row is no configuration of the robot.
    #[error("row {row}: {reason}")]
    Row {
        /// Its number, from 0.
        row: usize,
        /// The reason.
        reason: ConfigurationError,
    },
}

impl<'a, R: Robot> Rows<'a, R> {
    /// These numbers as rows of `width` numbers each, in the order of the configuration's coordinates: metres, and
    /// radians for angles.
    ///
    /// # Errors
    /// [`RowsError`] names the first row that is no configuration of this robot. Configurations of
    /// [`AnyRobot`](crate::robots::AnyRobot) do not follow from numbers alone.
    pub fn new(robot: &R, numbers: &'a [f64], width: usize) -> Result<Self, RowsError> {
        if width == 0 || !numbers.len().is_multiple_of(width) {
            return Err(RowsError::Ragged { numbers: numbers.len(), width });
        }
        // where a row's width is known when this is compiled, rows are checked at half the cost
        let all_are = match width {
            2 => are_configurations::<R, 2>(robot, numbers),
            3 => are_configurations::<R, 3>(robot, numbers),
            4 => are_configurations::<R, 4>(robot, numbers),
            _ => false,
        };
        let rows = Rows { numbers, width, robot: PhantomData };
        if all_are {
            return Ok(rows);
        }
        for row in 0..rows.len() {
            let q = rows.configuration(row).ok_or(RowsError::Width { width })?;
            robot.check(&q).map_err(|reason| RowsError::Row { row, reason })?;
        }
        Ok(rows)
    }

    /// The rows of this range, as far as there are such: none of them is checked again.
    pub fn part(&self, rows: Range<usize>) -> Self {
        let end = rows.end.min(self.len());
        let numbers = self.numbers.get(rows.start.min(end) * self.width..end * self.width);
        Rows { numbers: numbers.unwrap_or_default(), ..*self }
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.numbers.len() / self.width
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The configuration in a row; `None` never, once the rows are checked.
    #[inline]
    pub(super) fn configuration(&self, row: usize) -> Option<R::Configuration> {
        let from = row * self.width;
        R::Configuration::from_coordinates(&self.numbers[from..from + self.width])
    }
}

/// Whether all rows of `N` numbers are configurations of the robot.
fn are_configurations<R: Robot, const N: usize>(robot: &R, numbers: &[f64]) -> bool {
    let (rows, _) = numbers.as_chunks::<N>();
    let is_one = |row| R::Configuration::from_coordinates(row).is_some_and(|q| robot.check(&q).is_ok());
    // without a way out of the loop, several rows at once
    rows.iter().fold(true, |all, row| all & is_one(row))
}
