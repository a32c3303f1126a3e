//! `Search`, what a planner that is written in Python goes on with.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use motion_lab_core::configuration::{Chart, Configuration};
use motion_lab_core::planning::{Metric, Search};
use motion_lab_core::robots::Robot;

use crate::arrays::{Given, RowKind};
use crate::errors::configuration_error;

/// A search of a robot of any kind.
trait AnySearch: Send {
    fn into_any(self: Box<Self>) -> Box<dyn Any>;
    fn ends(&self) -> [Vec<f64>; 2];
    fn names(&self) -> Vec<String>;
    fn nodes(&self) -> Vec<Vec<f64>>;
    fn count(&self) -> usize;
    fn sample(&mut self) -> Vec<f64>;
    fn nearest(&self, q: &[f64]) -> Option<usize>;
    fn asks(&mut self, a: &[f64], b: &[f64]) -> bool;
    fn reach(&mut self, from: usize, to: &[f64]) -> Option<usize>;
    fn take(&mut self, nodes: &[usize]) -> bool;
    fn take_branch(&mut self, node: usize) -> bool;
}

/// A configuration of these coordinates, angles in `(-pi, pi]`.
fn at<C: Configuration>(q: &[f64]) -> Option<C> {
    C::from_coordinates(q).map(|q| q.in_chart())
}

impl<R: Robot<Configuration: Chart>> AnySearch for Search<R> {
    fn into_any(self: Box<Self>) -> Box<dyn Any> {
        self
    }

    fn ends(&self) -> [Vec<f64>; 2] {
        [self.problem.start(), self.problem.goal()].map(|q| q.coordinates().to_vec())
    }

    fn names(&self) -> Vec<String> {
        self.problem.start().coordinate_names()
    }

    fn nodes(&self) -> Vec<Vec<f64>> {
        self.growth.nodes().iter().map(|node| node.at.coordinates().to_vec()).collect()
    }

    fn count(&self) -> usize {
        self.growth.nodes().len()
    }

    fn sample(&mut self) -> Vec<f64> {
        self.growth.count_sample();
        self.problem.sample().coordinates().to_vec()
    }

    fn nearest(&self, q: &[f64]) -> Option<usize> {
        let q: R::Configuration = at(q)?;
        let metric = Metric::unit(&q);
        let distances = self.growth.nodes().iter().map(|node| metric.distance(&node.at, &q));
        distances.enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(number, _)| number)
    }

    fn asks(&mut self, a: &[f64], b: &[f64]) -> bool {
        let (Some(a), Some(b)) = (at(a), at(b)) else { return false };
        self.ask(&a, &b)
    }

    fn reach(&mut self, from: usize, to: &[f64]) -> Option<usize> {
        Search::reach(self, from, at(to)?)
    }

    fn take(&mut self, nodes: &[usize]) -> bool {
        Search::take(self, nodes)
    }

    fn take_branch(&mut self, node: usize) -> bool {
        Search::take_branch(self, node)
    }
}

/// A search that is lent to an object for an iteration.
pub struct Lent(Arc<Mutex<Option<Box<dyn AnySearch>>>>);

impl Lent {
    /// Lends a search.
    pub fn of<R: Robot<Configuration: Chart>>(search: Box<Search<R>>) -> Self {
        Lent(Arc::new(Mutex::new(Some(search))))
    }

    /// Takes it back; `None` where it was one of another kind.
    pub fn back<R: Robot>(self) -> Option<Box<Search<R>>> {
        let search = self.0.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        search.into_any().downcast().ok()
    }
}

/// The search of a planner that is written in Python, for one call of its `advance`: the problem, and what has been
/// grown. A configuration is its coordinates, metres and radians; a rover is planned as a disc, of two. Nodes are
/// numbered from 0, the start.
#[pyclass(frozen, name = "Search", module = "motion_lab")]
pub struct PySearch(Arc<Mutex<Option<Box<dyn AnySearch>>>>);

impl PySearch {
    /// The object for a search that is lent.
    pub fn of(lent: &Lent) -> Self {
        PySearch(Arc::clone(&lent.0))
    }

    fn with<T>(&self, work: impl FnOnce(&mut dyn AnySearch) -> PyResult<T>) -> PyResult<T> {
        let mut held: MutexGuard<'_, _> = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match held.as_mut() {
            Some(search) => work(search.as_mut()),
            None => Err(PyRuntimeError::new_err("a search can be used within advance alone")),
        }
    }

    fn row(&self, name: &'static str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        let names = self.with(|search| Ok(search.names()))?;
        match (RowKind { what: "a configuration".into(), names }).read(name, given)? {
            Given::One(row) if row.numbers().iter().all(|x| x.is_finite()) => Ok(row.numbers().to_vec()),
            Given::One(_) => Err(configuration_error(given.py(), name, &[], "the configuration is not finite")),
            Given::Many(_) => Err(PyValueError::new_err(format!("{name} is one configuration, not many"))),
        }
    }
}

fn checked(search: &dyn AnySearch, nodes: &[usize]) -> PyResult<()> {
    let count = search.count();
    match nodes.iter().find(|node| **node >= count) {
        Some(node) => Err(PyIndexError::new_err(format!("there is no node {node}: the search has {count}"))),
        None => Ok(()),
    }
}

#[pymethods]
impl PySearch {
    /// Where the path begins, shape `(d,)`.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.with(|search| Ok(search.ends()[0].clone().into_pyarray(py)))
    }

    /// Where it is to end, shape `(d,)`.
    #[getter]
    fn goal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.with(|search| Ok(search.ends()[1].clone().into_pyarray(py)))
    }

    /// The configurations of the nodes, shape `(n, d)`.
    #[getter]
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.with(|search| {
            let nodes = search.nodes();
            let shape = [nodes.len(), search.names().len()];
            nodes.concat().into_pyarray(py).reshape(shape)
        })
    }

    /// The next configuration at random, shape `(d,)`: a function of the seed, and counted.
    fn sample<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.with(|search| Ok(search.sample().into_pyarray(py)))
    }

    /// The number of the node nearest to a configuration: metres and radians as they are, angles the short way round.
    fn nearest(&self, q: &Bound<'_, PyAny>) -> PyResult<usize> {
        let q = self.row("q", q)?;
        self.with(|search| search.nearest(&q).ok_or_else(|| PyValueError::new_err("q is near no node")))
    }

    /// Whether the straight line from `a` to `b` is proven free; the question is counted.
    fn edge_free(&self, a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>) -> PyResult<bool> {
        let (a, b) = (self.row("a", a)?, self.row("b", b)?);
        self.with(|search| Ok(search.asks(&a, &b)))
    }

    /// The number of a new node at `q`, reached by a straight line from a node; None where the line is not proven free.
    ///
    /// Raises IndexError where there is no such node.
    fn reach(&self, node: usize, q: &Bound<'_, PyAny>) -> PyResult<Option<usize>> {
        let q = self.row("q", q)?;
        self.with(|search| {
            checked(search, &[node])?;
            Ok(search.reach(node, &q))
        })
    }

    /// Take the straight lines through these nodes, from the start to the goal, as the path. Returns whether they have
    /// their proofs: then the search is over, and `plan` raises NoPath for a path that leads elsewhere.
    ///
    /// Raises IndexError where there is no such node.
    fn take(&self, nodes: Vec<usize>) -> PyResult<bool> {
        self.with(|search| {
            checked(search, &nodes)?;
            Ok(search.take(&nodes))
        })
    }

    /// Take the way by which a node was reached from the start as the path, as `take` does.
    ///
    /// Raises IndexError where there is no such node.
    fn take_branch(&self, node: usize) -> PyResult<bool> {
        self.with(|search| {
            checked(search, &[node])?;
            Ok(search.take_branch(node))
        })
    }

    fn __repr__(&self) -> PyResult<String> {
        self.with(|search| Ok(format!("<Search of {} nodes>", search.count())))
    }
}
