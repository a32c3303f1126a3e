//! `Run`, a recorded run, and what there is to ask of it.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::{PyException, PyFileExistsError, PyFileNotFoundError, PyIndexError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple, PyType};

use motion_lab_core::names::{hint, nearest};
use motion_lab_sim::capture::run_svg;
use motion_lab_sim::export::{table, table_of_robot, write_csv};
use motion_lab_sim::run::{Digest, Frame, Log, LogError as LabLogError, LogKind};
use motion_lab_sim::tour::TourConfig;

use crate::errors::{LogError, RunError};
use crate::file::{os_error, replace};
use crate::frame::PyFrame;
use crate::interrupt;
use crate::natural::{natural, natural_or_none};
use crate::picture::{PyPicture, theme};
use crate::run_page::{NO_TEMPLATE, framed, is_soon_simulated, page, usual_template};
use crate::table::{by_name, structured};
use crate::verification::{PyDifference, PyVerification, verify};
use crate::world::PyWorld;

/// A recorded run: a seed, worlds with their robots, inputs, and the frame of every tick of 0.05 s. `record` makes one,
/// `read` reads one, and `Recorder.log` takes one of a run under way. The same seed, worlds and inputs give the same
/// frames to the last bit on every machine.
///
/// A digest log has a digest of each second instead of the frames: it verifies, and has no states.
#[pyclass(frozen, name = "Run", module = "motion_lab")]
pub struct PyRun {
    /// The library's log.
    pub log: Arc<Log>,
    digest: OnceLock<Option<Digest>>,
}

impl From<Log> for PyRun {
    fn from(log: Log) -> Self {
        PyRun { log: Arc::new(log), digest: OnceLock::new() }
    }
}

/// Read a run from a log file, of `Run.write` or of `motion-lab record`.
///
/// Raises OSError for a file that cannot be read, and LogError for one that is no whole log: every byte is checked.
#[pyfunction]
pub fn read(py: Python<'_>, path: PathBuf) -> PyResult<PyRun> {
    let bytes = py.detach(|| std::fs::read(&path)).map_err(|error| os_error(&error, &path))?;
    let log = py.detach(|| Log::read_mcap(&bytes));
    let log = log.map_err(|error| LogError::new_err(format!("{}: {error}", path.display())))?;
    Ok(log.log.into())
}

/// Whether a file is there that is no run log.
fn is_other(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head));
    read.is_ok()
        && matches!(Log::read_mcap(&head), Err(LabLogError::NotALog | LabLogError::Export | LabLogError::Page(_)))
}

/// The number of the robot of this name.
///
/// # Errors
/// `RunError` names the nearest one that there is.
pub fn robot_of(config: &TourConfig, name: &str) -> PyResult<usize> {
    let found = config.robot_names().position(|own| own == name);
    found.ok_or_else(|| {
        let near = hint(nearest(name, config.robot_names()));
        RunError::new_err(format!("the run has no robot {name:?}{near}"))
    })
}

/// The ranges of a robot's sensor in a frame.
///
/// # Errors
/// `IndexError` for a sensor that it has not.
pub fn ranges_of<'a>(frame: &'a Frame, id: usize, name: &str, sensor: u64) -> PyResult<&'a [f64]> {
    let mut own = frame.scans.iter().filter(|scan| scan.robot as usize == id);
    let count = own.clone().count();
    let none = || PyIndexError::new_err(format!("{name} has {count} range sensors: there is no number {sensor}"));
    let found = usize::try_from(sensor).ok().and_then(|sensor| own.nth(sensor));
    found.map(|scan| &*scan.ranges).ok_or_else(none)
}

impl PyRun {
    fn digest_of(&self, py: Python<'_>) -> Option<Digest> {
        *self.digest.get_or_init(|| py.detach(|| self.log.digest()))
    }

    /// Checks that there are frames.
    fn needs_frames(&self) -> PyResult<()> {
        match self.log.kind() {
            LogKind::Frames => Ok(()),
            LogKind::Digests => Err(LogError::new_err(LabLogError::NoFrames.to_string())),
        }
    }

    fn svg(&self, py: Python<'_>, tick: Option<u64>, theme_name: &str) -> PyResult<PyPicture> {
        self.needs_frames()?;
        let (tick, theme) = (tick.unwrap_or(self.log.ticks()), theme(theme_name)?);
        let robots = self.log.recipe.config.robot_names().count();
        let svg = interrupt::once(py, robots, || run_svg(&self.log, tick, theme, |_| {}))?;
        svg.map(PyPicture::of).map_err(|error| RunError::new_err(error.to_string()))
    }

    fn bytes(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        py.detach(|| {
            let mut bytes = Vec::new();
            self.log.write_mcap(&mut bytes).map(|()| bytes)
        })
        .map_err(|error| LogError::new_err(error.to_string()))
    }
}

#[pymethods]
impl PyRun {
    /// The digest of the run, 32 hexadecimal digits, as `motion-lab record` prints it: equal digests mean runs that are
    /// equal in every bit.
    #[getter]
    fn digest(&self, py: Python<'_>) -> Option<String> {
        self.digest_of(py).map(|digest| digest.to_string())
    }

    /// The seed.
    #[getter]
    fn seed(&self) -> u64 {
        self.log.recipe.seed.0
    }

    /// The number of recorded ticks of 0.05 s.
    #[getter]
    fn ticks(&self) -> u64 {
        self.log.ticks()
    }

    /// The worlds as they were at the start.
    #[getter]
    fn worlds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.log.recipe.config.worlds.iter().cloned().map(PyWorld::from).collect::<Vec<_>>())
    }

    /// The names of the robots, by id.
    #[getter]
    fn robots<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.log.recipe.config.robot_names().collect::<Vec<_>>())
    }

    /// The inputs as the text of a script, which `record` and `motion-lab record --script` take.
    #[getter]
    fn script(&self) -> String {
        self.log.recipe.script.to_ron()
    }

    /// Whether every frame is kept; a digest log has a digest of each second instead.
    #[getter]
    fn has_frames(&self) -> bool {
        self.log.kind() == LogKind::Frames
    }

    /// The states of a robot: a structured array with a row for each tick from 0 on, `ticks + 1` of them.
    ///
    /// Its fields are `tick` and `time` (s), the coordinates by their names (`x`, `y`, m; `theta`, rad), what else its
    /// kind has (`left_wheel`, `right_wheel`, rad), `channel0`, `channel1` of its driver, `manual`, `in_contact`,
    /// `contacts`, `flash` and `refusals`: the columns of `motion-lab export --format csv` without their units. NaN is
    /// a number that the robot has not, as the trailer's heading without a trailer.
    ///
    /// Raises RunError for a robot that there is not, LogError for a digest log.
    fn states<'py>(&self, py: Python<'py>, robot: &str) -> PyResult<Bound<'py, PyAny>> {
        self.needs_frames()?;
        let id = robot_of(&self.log.recipe.config, robot)?;
        let mut columns = py.detach(|| table_of_robot(&self.log, id));
        columns.retain(|column| column.name != "id");
        let rows = self.log.frames().len() + usize::from(self.log.initial().is_some());
        structured(py, &columns, rows)
    }

    /// The scans of a robot's range sensor, metres, shape `(ticks + 1, rays)`, from tick 0 on; inf where nothing is
    /// within reach. `sensor` is its number, from 0, of a robot with several: the
    /// run's own sensor is the first.
    ///
    /// Raises RunError for a robot that there is not, IndexError for a sensor that it has not, LogError for a digest
    /// log.
    #[pyo3(signature = (robot, sensor = None))]
    fn scans<'py>(
        &self,
        py: Python<'py>,
        robot: &str,
        sensor: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.needs_frames()?;
        let id = robot_of(&self.log.recipe.config, robot)?;
        let sensor = natural_or_none("sensor", sensor)?.unwrap_or(0);
        let frames = || self.log.initial().into_iter().chain(self.log.frames());
        let mut width = None;
        let mut all = Vec::new();
        for frame in frames() {
            let ranges = ranges_of(frame, id, robot, sensor)?;
            let rays = *width.get_or_insert_with(|| {
                all.reserve(ranges.len() * (self.log.frames().len() + 1));
                ranges.len()
            });
            if rays != ranges.len() {
                let words = format!("tick {}: the scan has {} rays, those before {rays}", frame.tick, ranges.len());
                return Err(LogError::new_err(words));
            }
            all.extend_from_slice(ranges);
        }
        let shape = [frames().count(), width.unwrap_or(0)];
        Ok(all.into_pyarray(py).reshape(shape)?.into_any())
    }

    /// The frame after a tick, 0 for the start: the state of the whole run.
    ///
    /// Raises IndexError for a tick that there is not, LogError for a digest log.
    fn frame(&self, tick: &Bound<'_, PyAny>) -> PyResult<PyFrame> {
        self.needs_frames()?;
        let tick = natural("tick", tick)?;
        let last = self.log.ticks();
        let none = || PyIndexError::new_err(format!("there is no tick {tick}: they are 0 to {last}"));
        self.log.frame(tick).map(PyFrame::from).ok_or_else(none)
    }

    /// The table of `motion-lab export --format csv` as text: a row for each tick and robot. With `ranges` there is a
    /// column for each ray too.
    ///
    /// Raises LogError for a digest log.
    #[pyo3(signature = (*, ranges = false))]
    fn to_csv(&self, py: Python<'_>, ranges: bool) -> PyResult<String> {
        self.needs_frames()?;
        let text = py.detach(|| {
            let mut text = Vec::new();
            write_csv(&self.log, ranges, &mut text).map(|()| text)
        });
        let text = text.map_err(|error| LogError::new_err(error.to_string()))?;
        String::from_utf8(text).map_err(|error| LogError::new_err(error.to_string()))
    }

    /// The same table as a `pandas.DataFrame`, bit for bit. A cell without a value is NaN.
    ///
    /// Raises ImportError without pandas, LogError for a digest log.
    #[pyo3(signature = (*, ranges = false))]
    fn to_pandas<'py>(&self, py: Python<'py>, ranges: bool) -> PyResult<Bound<'py, PyAny>> {
        self.needs_frames()?;
        let pandas = py.import("pandas")?;
        let columns = py.detach(|| table(&self.log, ranges));
        pandas.call_method1("DataFrame", (by_name(py, columns)?,))
    }

    /// Write it as a log file, which `read` and `motion-lab` read. The same run gives the same bytes. An older log is
    /// replaced; any other file only with `overwrite`.
    ///
    /// Raises FileExistsError for a file that is no log, OSError where the file cannot be written.
    #[pyo3(signature = (path, *, overwrite = false))]
    fn write(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> PyResult<()> {
        if !overwrite && py.detach(|| is_other(&path)) {
            let words = format!("{}: this file is no run log; overwrite=True replaces it", path.display());
            return Err(PyFileExistsError::new_err(words));
        }
        replace(py, &path, &self.bytes(py)?)
    }

    /// Simulate it again, from its seed, its worlds and its script alone, and compare every bit.
    ///
    /// Raises RunError for a run that cannot start. A run that differs is no error: the answer says where. Ctrl+C stops
    /// it within 0.1 s.
    fn verify(&self, py: Python<'_>) -> PyResult<PyVerification> {
        verify(py, &self.log)
    }

    /// Where another run differs from this one: settings, ticks, the first value.
    ///
    /// Raises LogError for digest logs.
    fn diff(&self, py: Python<'_>, other: &Bound<'_, PyRun>) -> PyResult<PyDifference> {
        let other = other.get();
        self.needs_frames()?;
        other.needs_frames()?;
        Ok(py.detach(|| PyDifference::of(&self.log, &other.log)))
    }

    /// The figure of the run after a tick, by default the last: the ways of the robots, their contacts and where they
    /// are, world by world. `theme` is `"light"` or `"dark"`.
    ///
    /// Raises RunError for a tick that there is not, LogError for a digest log.
    #[pyo3(signature = (tick = None, *, theme = "light"))]
    fn plot(&self, py: Python<'_>, tick: Option<&Bound<'_, PyAny>>, theme: &str) -> PyResult<PyPicture> {
        self.svg(py, natural_or_none("tick", tick)?, theme)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        if self.needs_frames().is_err() {
            return Ok(None);
        }
        Ok(Some(self.svg(py, None, "light")?.svg().to_owned()))
    }

    /// The run as one page, which any browser opens without a network: it holds the simulator, simulates the run again,
    /// says whether every second comes out the same, and plays it. The page of `motion-lab export -o RUN.html`;
    /// `read` reads it. `template` is what the run is put into: by default what the wheel brings, else a page that this
    /// version of the lab wrote, or the file `run-page.template` of `assets/web/build`.
    ///
    /// Raises RunError for a run that is another when it is simulated again, OSError for a template that cannot be read
    /// or is none, FileNotFoundError where the package has none. Ctrl+C stops it within 0.1 s.
    #[pyo3(signature = (*, template = None))]
    fn to_html(&self, py: Python<'_>, template: Option<PathBuf>) -> PyResult<String> {
        let template = match template {
            Some(named) => named,
            None => usual_template(py)?.ok_or_else(|| PyFileNotFoundError::new_err(NO_TEMPLATE))?,
        };
        page(py, &template, &self.log)
    }

    /// The page of `to_html` in a frame, where it is made within a second or so; else the picture. A notebook that is
    /// not trusted takes the frame away, and shows the picture within it.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let picture = match self.needs_frames() {
            Ok(()) => Some(self.svg(py, None, "light")?.html(py)?),
            Err(_) => None,
        };
        if !is_soon_simulated(&self.log) {
            return Ok(picture);
        }
        let Some(template) = usual_template(py)? else { return Ok(picture) };
        match page(py, &template, &self.log) {
            Ok(page) => Ok(Some(framed(&page, picture.as_deref().unwrap_or_default()))),
            // what a page refuses is none of the picture's; an interrupt is
            Err(error) if error.is_instance_of::<PyException>(py) => Ok(picture),
            Err(error) => Err(error),
        }
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let worlds: Vec<&str> = self.log.recipe.config.worlds.iter().map(|world| &*world.name).collect();
        let (seed, ticks, worlds) = (self.log.recipe.seed, self.log.ticks(), worlds.join(", "));
        let digest = self.digest_of(py).map_or(String::new(), |digest| format!(", digest {digest}"));
        format!("<Run of {ticks} ticks at seed {seed} in {worlds}{digest}>")
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<PyRun>().is_ok_and(|other| *other.get().log == *self.log)
    }

    fn __hash__(&self, py: Python<'_>) -> u64 {
        self.digest_of(py).map_or(0, |Digest(bits)| bits as u64)
    }

    /// The bytes of its log file.
    fn __bytes__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.bytes(py)?))
    }

    /// The run of a log file's bytes.
    ///
    /// Raises LogError for what is no whole log.
    #[classmethod]
    fn from_bytes(_class: &Bound<'_, PyType>, py: Python<'_>, data: &[u8]) -> PyResult<PyRun> {
        let log = py.detach(|| Log::read_mcap(data)).map_err(|error| LogError::new_err(error.to_string()))?;
        Ok(log.log.into())
    }

    /// What pickles hold: the bytes of its log file.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let py = slf.py();
        Ok((slf.get_type().getattr("from_bytes")?, (PyBytes::new(py, &slf.get().bytes(py)?),)))
    }
}
