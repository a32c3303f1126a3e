//! The lab as a Python module: data moved in and out, the arithmetic all the library's.
#![deny(missing_docs)]
#![forbid(unsafe_code)]

mod answers;
mod arrays;
mod assignment;
mod batches;
mod buffers;
mod certificate;
mod checker;
mod drawing;
mod episodes;
mod errors;
mod file;
mod fleet;
mod frame;
mod interrupt;
mod natural;
mod own_planner;
mod path;
mod picture;
mod planning;
mod pool;
mod problem;
mod recorder;
mod recording;
mod resident;
mod robot;
mod run;
mod run_page;
mod scan;
mod script;
mod search;
mod shapes;
mod table;
mod verdicts;
mod verification;
mod world;

use pyo3::prelude::*;

/// The compiled part of the package `motion_lab`.
#[pymodule]
mod _core {
    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    /// The names of the built-in worlds.
    #[pyfunction]
    fn world_names() -> [&'static str; 3] {
        motion_lab_core::worlds::World::built_in_names()
    }

    // questions
    #[pymodule_export]
    use crate::certificate::PyCertificate;
    #[pymodule_export]
    use crate::checker::PyChecker;
    #[pymodule_export]
    use crate::errors::{ConfigurationError, Error, LogError, NoPath, RunError, WorldError};
    #[pymodule_export]
    use crate::pool::{set_threads, threads};
    #[pymodule_export]
    use crate::resident::PyResident;
    #[pymodule_export]
    use crate::robot::{PyDisc, PyHitch, PyReach, PyRobot, PyRusty};
    #[pymodule_export]
    use crate::scan::scan;
    #[pymodule_export]
    use crate::world::{PyObstacle, PyWorld};

    // plans and runs
    #[pymodule_export]
    use crate::assignment::{PyAssignment, PyAttempt, PyGrade};
    #[pymodule_export]
    use crate::drawing::_drawing;
    #[pymodule_export]
    use crate::frame::PyFrame;
    #[pymodule_export]
    use crate::path::PyPath;
    #[pymodule_export]
    use crate::picture::PyPicture;
    #[pymodule_export]
    use crate::planning::{plan, planner_names};
    #[pymodule_export]
    use crate::problem::PyProblem;
    #[pymodule_export]
    use crate::recorder::PyRecorder;
    #[pymodule_export]
    use crate::recording::record;
    #[pymodule_export]
    use crate::run::{PyRun, read};
    #[pymodule_export]
    use crate::search::PySearch;
    #[pymodule_export]
    use crate::verification::{PyDifference, PyVerification};

    // environments
    #[pymodule_export]
    use crate::episodes::PyEpisodes;
    #[pymodule_export]
    use crate::fleet::PyFleet;
}
