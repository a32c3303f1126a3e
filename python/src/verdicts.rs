//! Answers of several numbers: witnesses and edges, one by one and as named tuples of arrays.

use std::ops::Range;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

use motion_lab_core::collision::{EdgeVerdict, HitBy, ObstacleId, RowsError, Witness};

use crate::answers::{Answers, each_chunk};

/// The classes of `motion_lab._answers`, and the three verdicts.
struct Classes {
    witness: Py<PyAny>,
    edge: Py<PyAny>,
    verdicts: [Py<PyAny>; 3],
    /// What makes a tuple of a class, at a third of the cost of the named one's own.
    tuple: Py<PyAny>,
}

impl Classes {
    fn make<'py>(
        &self,
        class: &Py<PyAny>,
        py: Python<'py>,
        fields: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error = PyErr>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.tuple.bind(py).call1((class, fields.into_pyobject(py)?))
    }
}

fn classes(py: Python<'_>) -> PyResult<&Classes> {
    static CLASSES: PyOnceLock<Classes> = PyOnceLock::new();
    CLASSES.get_or_try_init(py, || {
        let module = py.import("motion_lab._answers")?;
        let of = |name: &str| module.getattr(name).map(Bound::unbind);
        let verdicts = [of("FREE")?, of("HIT")?, of("UNRESOLVED")?];
        let tuple = py.get_type::<PyTuple>().getattr("__new__")?.unbind();
        Ok(Classes { witness: of("Witness")?, edge: of("Edge")?, verdicts, tuple })
    })
}

/// An obstacle's number in Python; -1 for none that is known.
fn number_of(obstacle: Option<ObstacleId>) -> i64 {
    obstacle.filter(|id| *id != ObstacleId::UNKNOWN).map_or(-1, |id| i64::from(id.0))
}

/// A part's number in Python.
fn part_of(part: usize) -> i64 {
    i64::try_from(part).unwrap_or(-1)
}

/// A witness as Python has it.
struct WitnessRow {
    distance: f64,
    on_robot: [f64; 2],
    on_obstacle: [f64; 2],
    part: i64,
    obstacle: i64,
}

impl From<Option<Witness>> for WitnessRow {
    fn from(witness: Option<Witness>) -> Self {
        match witness {
            None => WitnessRow {
                distance: f64::INFINITY,
                on_robot: [f64::NAN; 2],
                on_obstacle: [f64::NAN; 2],
                part: -1,
                obstacle: -1,
            },
            Some(w) => WitnessRow {
                distance: w.dist,
                on_robot: [w.on_robot.x, w.on_robot.y],
                on_obstacle: [w.on_obstacle.x, w.on_obstacle.y],
                part: part_of(w.part),
                obstacle: number_of(Some(w.obstacle)),
            },
        }
    }
}

/// A verdict as Python has it.
struct EdgeRow {
    verdict: u8,
    clearance: f64,
    free_until: f64,
    contact_at: f64,
    part: i64,
    obstacle: i64,
    gap: f64,
}

impl From<EdgeVerdict> for EdgeRow {
    fn from(verdict: EdgeVerdict) -> Self {
        let free = EdgeRow {
            verdict: 0,
            clearance: 0.0,
            free_until: 1.0,
            contact_at: f64::INFINITY,
            part: -1,
            obstacle: -1,
            gap: 0.0,
        };
        match verdict {
            EdgeVerdict::Free { clearance } => EdgeRow { clearance, ..free },
            EdgeVerdict::Hit { free_until, contact_at, part, by } => {
                let obstacle = match by {
                    HitBy::Obstacle(id) => number_of(Some(id)),
                    HitBy::Limit => -1,
                };
                EdgeRow { verdict: 1, free_until, contact_at, part: part_of(part), obstacle, ..free }
            }
            EdgeVerdict::Unresolved { free_until, gap, .. } => EdgeRow { verdict: 2, free_until, gap, ..free },
        }
    }
}

/// A witness as a named tuple of numbers and pairs.
pub fn witness(py: Python<'_>, witness: Option<Witness>) -> PyResult<Bound<'_, PyAny>> {
    let WitnessRow { distance, on_robot: [x, y], on_obstacle: [u, v], part, obstacle } = witness.into();
    let classes = classes(py)?;
    classes.make(&classes.witness, py, (distance, (x, y), (u, v), part, obstacle))
}

/// A verdict as a named tuple of numbers.
pub fn edge(py: Python<'_>, verdict: EdgeVerdict) -> PyResult<Bound<'_, PyAny>> {
    let row = EdgeRow::from(verdict);
    let classes = classes(py)?;
    let verdict = classes.verdicts.get(usize::from(row.verdict));
    let fields = (verdict, row.clearance, row.free_until, row.contact_at, row.part, row.obstacle, row.gap);
    classes.make(&classes.edge, py, fields)
}

/// The places of some rows.
fn places_of<'a, T>(places: &'a mut [T], rows: &Range<usize>) -> std::slice::IterMut<'a, T> {
    places.get_mut(rows.clone()).unwrap_or_default().iter_mut()
}

/// The witnesses of all rows of an array with these leading axes, as a named tuple of arrays. `ask` answers some rows.
pub fn witnesses<'py>(
    py: Python<'py>,
    leading: &[usize],
    ask: impl Fn(&Range<usize>, &mut [Option<Witness>]) -> Result<(), RowsError> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let pairs = [leading, &[2]].concat();
    let mut distance = Answers::<f64>::new(py, None, leading, &[])?;
    let mut on_robot = Answers::<f64>::new(py, None, &pairs, &[])?;
    let mut on_obstacle = Answers::<f64>::new(py, None, &pairs, &[])?;
    let mut part = Answers::<i64>::new(py, None, leading, &[])?;
    let mut obstacle = Answers::<i64>::new(py, None, leading, &[])?;
    {
        let (distance, part, obstacle) = (distance.places()?, part.places()?, obstacle.places()?);
        let (on_robot, _) = on_robot.places()?.as_chunks_mut::<2>();
        let (on_obstacle, _) = on_obstacle.places()?.as_chunks_mut::<2>();
        let mut found = Vec::new();
        each_chunk(py, leading.iter().product(), |rows| {
            if found.len() < rows.len() {
                found = vec![None; rows.len()];
            }
            let found = found.get_mut(..rows.len()).unwrap_or_default();
            ask(&rows, found)?;
            let places = places_of(distance, &rows)
                .zip(places_of(on_robot, &rows))
                .zip(places_of(on_obstacle, &rows))
                .zip(places_of(part, &rows))
                .zip(places_of(obstacle, &rows));
            for (w, ((((d, a), b), p), o)) in found.iter().zip(places) {
                let row = WitnessRow::from(*w);
                (*d, *a, *b, *p, *o) = (row.distance, row.on_robot, row.on_obstacle, row.part, row.obstacle);
            }
            Ok(())
        })?;
    }
    classes(py)?.witness.bind(py).call1((
        distance.into_object(),
        on_robot.into_object(),
        on_obstacle.into_object(),
        part.into_object(),
        obstacle.into_object(),
    ))
}

/// The verdicts on all edges of arrays with these leading axes, as a named tuple of arrays. `ask` answers some of them.
pub fn edges<'py>(
    py: Python<'py>,
    leading: &[usize],
    ask: impl Fn(&Range<usize>) -> Result<Vec<EdgeVerdict>, RowsError> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let mut verdict = Answers::<i8>::new(py, None, leading, &[])?;
    let mut numbers = Vec::new();
    for _ in 0..4 {
        numbers.push(Answers::<f64>::new(py, None, leading, &[])?);
    }
    let mut part = Answers::<i64>::new(py, None, leading, &[])?;
    let mut obstacle = Answers::<i64>::new(py, None, leading, &[])?;
    {
        let mut columns = numbers.iter_mut().map(|column| column.places()).collect::<PyResult<Vec<_>>>()?;
        let mut labels = verdict.places()?.iter_mut().zip(part.places()?).zip(obstacle.places()?);
        each_chunk(py, leading.iter().product(), |rows| {
            let found: Vec<EdgeRow> = ask(&rows)?.into_iter().map(EdgeRow::from).collect();
            for (row, ((v, p), o)) in found.iter().zip(&mut labels) {
                (*v, *p, *o) = (i8::try_from(row.verdict).unwrap_or(-1), row.part, row.obstacle);
            }
            for (k, column) in columns.iter_mut().enumerate() {
                for (row, place) in found.iter().zip(column.get_mut(rows.clone()).into_iter().flatten()) {
                    let of = [row.clearance, row.free_until, row.contact_at, row.gap];
                    *place = of.get(k).copied().unwrap_or(f64::NAN);
                }
            }
            Ok(())
        })?;
    }
    let mut numbers = numbers.into_iter().map(Answers::into_object);
    let mut next = || numbers.next();
    classes(py)?.edge.bind(py).call1((
        verdict.into_object(),
        next(),
        next(),
        next(),
        part.into_object(),
        obstacle.into_object(),
        next(),
    ))
}
