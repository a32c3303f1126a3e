//! The lab as a Python module: data moved in and out, the arithmetic all the library's.
#![deny(missing_docs)]
#![forbid(unsafe_code)]

mod answers;
mod arrays;
mod batches;
mod certificate;
mod checker;
mod errors;
mod pool;
mod robot;
mod scan;
mod shapes;
mod verdicts;
mod world;

use pyo3::prelude::*;

/// The compiled part of the package `motion_lab`.
#[pymodule]
mod _core {
    use super::*;

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
    use crate::robot::{PyDisc, PyHitch, PyReach, PyRobot, PyRusty};
    #[pymodule_export]
    use crate::scan::scan;
    #[pymodule_export]
    use crate::world::{PyObstacle, PyResident, PyWorld};
}
