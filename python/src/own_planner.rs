//! Planners that are written in Python: an object that says how a search goes on by an iteration.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyType;

use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::Chart;
use motion_lab_core::planning::{NoPath, Planner, Search};
use motion_lab_core::robots::Robot;
use motion_lab_sim::plans::{LinePlanner, MadePlanner, OwnPlanner, PlannerName, Planners};

use crate::errors::Error;
use crate::search::{Lent, PySearch};

/// The end of a search whose planner raised an error, which is raised instead.
const RAISED: NoPath = NoPath::Unsuited("its advance raised an error");

/// The names that planners have had, each with and without samples. They stay, as names of planners are for ever.
static NAMED: Mutex<BTreeMap<String, &'static OwnPlanner>> = Mutex::new(BTreeMap::new());

/// A planner's object while it plans, and what it raised.
#[derive(Default)]
struct Object {
    planner: Option<Py<PyAny>>,
    raised: Option<PyErr>,
}

/// A planner that is written in Python.
pub struct PyPlanner {
    named: &'static OwnPlanner,
    object: Arc<Mutex<Object>>,
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl PyPlanner {
    /// The planner of an object with a `name` and a method `advance`, and perhaps `draws_samples`; of a class of such,
    /// which is called for one.
    ///
    /// # Errors
    /// `TypeError` for another object, `Error` for a name that is none or one of the lab's planners.
    pub fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let object = if given.is_instance_of::<PyType>() { given.call0()? } else { given.clone() };
        let words = "planner is a name, or an object with a name and a method advance(search)";
        let no_planner = |_| PyTypeError::new_err(words);
        if !object.getattr("advance").map_err(no_planner)?.is_callable() {
            return Err(PyTypeError::new_err(words));
        }
        let name: String = object.getattr("name").and_then(|name| name.extract()).map_err(no_planner)?;
        let draws_samples = match object.getattr_opt("draws_samples")? {
            Some(draws) => draws.extract().map_err(|_| PyTypeError::new_err("draws_samples is True or False"))?,
            None => false,
        };
        let named = row(name, draws_samples)?;
        let object = Object { planner: Some(object.unbind()), raised: None };
        Ok(PyPlanner { named, object: Arc::new(Mutex::new(object)) })
    }

    /// Its name.
    pub fn name(&self) -> PlannerName {
        PlannerName::Own(self.named)
    }

    /// Lets go of the object, and returns what it raised.
    pub fn ended(&self) -> Option<PyErr> {
        let Object { planner, raised } = std::mem::take(&mut *locked(&self.object));
        drop(planner);
        raised
    }
}

/// The row of this name, checked as that of a planner in Rust.
fn row(name: String, draws_samples: bool) -> PyResult<&'static OwnPlanner> {
    let mut known = locked(&NAMED);
    let key = format!("{name}/{draws_samples}");
    if let Some(row) = known.get(&key) {
        return Ok(row);
    }
    // nothing stays of a name that is refused
    Planners::default().check_name(&name).map_err(|refused| Error::new_err(refused.to_string()))?;
    let id: &'static str = Box::leak(name.into_boxed_str());
    let row = OwnPlanner { draws_samples, ..OwnPlanner::new(id, id, "A planner written in Python") };
    let row: &'static OwnPlanner = Box::leak(Box::new(row.by_lines::<Nowhere>()));
    known.insert(key, row);
    Ok(row)
}

/// Makes no planner: one that is written in Python is made by its object.
#[derive(Default)]
struct Nowhere;

impl LinePlanner for Nowhere {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, _: Problem<R>) -> MadePlanner<R> {
        Err(NoPath::Unsuited("it is made by its object"))
    }
}

impl LinePlanner for PyPlanner {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        let search = Some(Box::new(Search::from_start(problem)));
        Ok(Box::new(Advancing { named: self.named, object: Arc::clone(&self.object), search }))
    }
}

/// A planner at work: its object advances the search.
struct Advancing<R: Robot> {
    named: &'static OwnPlanner,
    object: Arc<Mutex<Object>>,
    /// The search, but while the object has it.
    search: Option<Box<Search<R>>>,
}

impl<R: Robot<Configuration: Chart>> Planner<R> for Advancing<R> {
    fn name(&self) -> &'static str {
        self.named.id
    }

    fn search(&self) -> &Search<R> {
        match &self.search {
            Some(search) => search,
            None => unreachable!("nobody asks while the object advances"),
        }
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        match &mut self.search {
            Some(search) => search,
            None => unreachable!("nobody asks while the object advances"),
        }
    }

    fn advance(&mut self) {
        let Some(search) = self.search.take() else { return };
        let (lent, raised) = Python::attach(|py| {
            let planner = locked(&self.object).planner.as_ref().map(|planner| planner.clone_ref(py));
            let lent = Lent::of(search);
            let raised = planner.and_then(|planner| {
                let search = PySearch::of(&lent);
                planner.call_method1(py, "advance", (search,)).err()
            });
            (lent, raised)
        });
        self.search = lent.back();
        if let (Some(raised), Some(search)) = (raised, &mut self.search) {
            search.end = Some(RAISED);
            locked(&self.object).raised = Some(raised);
        }
    }
}
