//! Batches: the questions over rows of arrays.

use numpy::Element;
use pyo3::prelude::*;
use rayon::prelude::*;

use motion_lab_core::collision::{Checker, Collision, EdgeVerdict, Rows, RowsError};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::robots::{ConfigurationError, Robot};

use crate::answers::{ALONE, Answers, each_chunk};
use crate::arrays::{CheckedRows, ManyRows, along};

/// Answers about all rows.
pub fn of_rows<'py, R: Robot, T: Element + Send>(
    py: Python<'py>,
    checker: &Checker<R>,
    q: &ManyRows<'py>,
    out: Option<&Bound<'py, PyAny>>,
    ask: impl Fn(&Rows<'_, R>, &mut [T]) -> Result<(), RowsError> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let rows = q.checked(py, checker.robot())?;
    let mut answers = Answers::<T>::new(py, out, q.leading(), &[q])?;
    let places = answers.places()?;
    each_chunk(py, places.len(), |part| ask(&rows.part(&part)?, places.get_mut(part).unwrap_or_default()))?;
    Ok(answers.into_object())
}

/// Answers about all pairs of rows; `ask` answers one of them.
pub fn of_pairs<'py, R: Robot>(
    py: Python<'py>,
    checker: &Checker<R>,
    (a, b): (ManyRows<'py>, ManyRows<'py>),
    out: Option<&Bound<'py, PyAny>>,
    ask: impl Fn(&Rows<'_, R>, &Rows<'_, R>, &mut [bool]) -> Result<(), RowsError> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let (a, b) = joined(py, checker.robot(), a, b)?;
    let (from, to) = both(py, checker.robot(), &a, &b)?;
    let mut answers = Answers::<bool>::new(py, out, a.leading(), &[&a, &b])?;
    let places = answers.places()?;
    each_chunk(py, places.len(), |part| {
        ask(&from.part(&part)?, &to.part(&part)?, places.get_mut(part).unwrap_or_default())
    })?;
    Ok(answers.into_object())
}

/// Both arguments along the axes that they share. What is broadcast is checked before, in the caller's own axes, also
/// where it comes to no rows.
pub fn joined<'py, R: Robot>(
    py: Python<'py>,
    robot: &R,
    a: ManyRows<'py>,
    b: ManyRows<'py>,
) -> PyResult<(ManyRows<'py>, ManyRows<'py>)> {
    if a.leading() != b.leading() {
        both(py, robot, &a, &b)?;
    }
    along(py, a, b)
}

/// Both arguments, checked.
pub fn both<'a, R: Robot>(
    py: Python<'_>,
    robot: &R,
    a: &'a ManyRows<'_>,
    b: &'a ManyRows<'_>,
) -> PyResult<(CheckedRows<'a, R>, CheckedRows<'a, R>)> {
    Ok((a.checked(py, robot)?, b.checked(py, robot)?))
}

/// Whether the sweep from one configuration to another hits.
pub fn sweep_hits<R: Robot>(checker: &Checker<R>, a: &R::Configuration, b: &R::Configuration) -> bool {
    checker.scene().swept(&checker.robot().footprint(a), &checker.robot().footprint(b))
}

/// Every verdict, or the first reason why there is none.
pub fn numbered(
    found: Vec<Result<EdgeVerdict, ConfigurationError>>,
    first: usize,
) -> Result<Vec<EdgeVerdict>, RowsError> {
    let one = |(i, verdict): (usize, Result<EdgeVerdict, _>)| {
        verdict.map_err(|reason| RowsError::Row { row: first + i, reason })
    };
    found.into_iter().enumerate().map(one).collect()
}

/// Sweeps from all rows to all rows.
pub fn sweeps<'py, R: Robot>(
    py: Python<'py>,
    checker: &Checker<R>,
    (a, b): (ManyRows<'py>, ManyRows<'py>),
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (a, b) = joined(py, checker.robot(), a, b)?;
    both(py, checker.robot(), &a, &b)?;
    let mut answers = Answers::<bool>::new(py, out, a.leading(), &[&a, &b])?;
    let (from, to, width) = (a.numbers()?, b.numbers()?, a.width());
    let places = answers.places()?;
    let configuration = |numbers: &[f64], row: usize| {
        R::Configuration::from_coordinates(numbers.get(row * width..(row + 1) * width).unwrap_or_default())
    };
    each_chunk(py, places.len(), |part| {
        let first = part.start;
        let one = |(i, place): (usize, &mut bool)| {
            let ends = configuration(from, first + i).zip(configuration(to, first + i));
            *place = ends.is_none_or(|(a, b)| sweep_hits(checker, &a, &b));
        };
        let places = places.get_mut(part).unwrap_or_default();
        if places.len() > ALONE {
            places.par_iter_mut().enumerate().for_each(one);
        } else {
            places.iter_mut().enumerate().for_each(one);
        }
        Ok(())
    })?;
    Ok(answers.into_object())
}
