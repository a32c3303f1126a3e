//! A run as a page: its template, and the frame in which a notebook shows it.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use motion_lab_sim::run::Log;
use motion_lab_sim::run_page::{PageTemplate, RunPageError, UnfinishedPage};

use crate::errors::RunError;
use crate::file::os_error;
use crate::interrupt;

/// What is said where the package has no template.
pub const NO_TEMPLATE: &str = "this package was built without the template of a run's page: give template= a page that \
                               the lab saved, or the file run-page.template of assets/web/build";

/// The most robots times ticks of a run that a notebook simulates again whenever it shows it: some second.
const SOON: u64 = 50_000;

/// Whether a run is simulated again so soon that a notebook can wait for it, and its reader's browser too.
pub fn is_soon_simulated(log: &Log) -> bool {
    let robots = log.recipe.config.robot_names().count() as u64;
    robots.saturating_mul(log.ticks()) <= SOON
}

/// The template that was installed with the package; `None` where there is none.
///
/// # Errors
/// What Python's own import of the package's metadata raises.
pub fn usual_template(py: Python<'_>) -> PyResult<Option<PathBuf>> {
    py.import("motion_lab._template")?.call_method0("usual")?.extract()
}

/// The page of the run in a log.
///
/// # Errors
/// `OSError` for a file that cannot be read or is no template of this simulator, `RunError` for a run that cannot start
/// or is not the recorded one, `KeyboardInterrupt`.
pub fn page(py: Python<'_>, template: &Path, log: &Log) -> PyResult<String> {
    let mut bytes = Vec::new();
    let read = py.detach(|| File::open(template)?.take(PageTemplate::MAX_BYTES).read_to_end(&mut bytes));
    read.map_err(|error| os_error(&error, template))?;
    let read = py.detach(|| PageTemplate::read(&bytes).and_then(|read| read.check_simulator().map(|()| read)));
    let read = read.map_err(|error| PyOSError::new_err(format!("{}: {error}", template.display())))?;
    let robots = log.recipe.config.robot_names().count();
    let mut begun = None;
    let step = || -> Option<Result<String, RunPageError>> {
        let mut page = match begun.take() {
            Some(page) => page,
            None => match UnfinishedPage::of_log(&read, log) {
                Ok(page) => page,
                Err(refused) => return Some(Err(refused)),
            },
        };
        match page.go_on() {
            Ok(true) => {
                begun = Some(page);
                None
            }
            Ok(false) => Some(page.page()),
            Err(refused) => Some(Err(refused)),
        }
    };
    interrupt::until(py, robots, step)?.map_err(|error| RunError::new_err(error.to_string()))
}

/// A page in a frame of its own, with what stands in its place where frames are taken away.
pub fn framed(page: &str, instead: &str) -> String {
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    format!(
        "<iframe srcdoc=\"{page}\" title=\"A run of the motion lab\" width=\"100%\" height=\"640\" frameborder=\"0\">{instead}</iframe>"
    )
}
