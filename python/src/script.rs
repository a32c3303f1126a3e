//! Inputs of a run: scripts, and single inputs as keywords.

use std::path::PathBuf;

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use motion_lab_sim::run::{Event, MAX_CHANNEL, Quantized, RobotInput, Script, WorldChange, WorldEvent};

use crate::errors::RunError;
use crate::file::{MAX_TEXT, text_of};

/// What an input to a robot may be.
const INPUTS: &str = "drive, move_to, teleport, trailer, release";
/// What a change of a world may be.
const CHANGES: &str = "close, open, remove, move, add";

/// A script that somebody gives: none, the text or the file of one, or a list of `(tick, name, input)`.
///
/// # Errors
/// `RunError` in the library's words, `OSError` for a file that cannot be read, `TypeError` for anything else.
pub fn script(given: Option<&Bound<'_, PyAny>>) -> PyResult<Script> {
    let Some(given) = given.filter(|given| !given.is_none()) else { return Ok(Script::empty()) };
    if let Ok(text) = given.cast::<PyString>() {
        let text = text.to_string_lossy();
        return if text.contains("Script") && text.contains('(') { parsed("script", &text) } else { file(given) };
    }
    if given.hasattr("__fspath__")? {
        return file(given);
    }
    let (mut events, mut changes) = (Vec::new(), Vec::new());
    for (i, item) in given.try_iter().map_err(|_| no_script(given))?.enumerate() {
        let item = item?;
        let form = || PyTypeError::new_err(format!("script[{i}]: it is a tuple (tick, name, input)"));
        let (tick, name, input): (i64, String, Bound<'_, PyDict>) = item.extract().map_err(|_| form())?;
        let tick = u64::try_from(tick).map_err(|_| RunError::new_err(format!("script[{i}]: tick {tick}")))?;
        let (key, value) = only(&input, &format!("script[{i}]"))?;
        if CHANGES.split(", ").any(|known| known == key) {
            changes.push(WorldEvent { tick, world: name, change: change(&key, &value)? });
        } else {
            events.push(Event { tick, robot: name, input: robot_input(&key, &value)? });
        }
    }
    let script = Script::new(events, changes);
    script.check().map_err(|error| RunError::new_err(error.to_string()))?;
    Ok(script)
}

fn no_script(given: &Bound<'_, PyAny>) -> PyErr {
    let class = given.get_type().name().map_or_else(|_| "an object".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("a script is its text, the path of its file or a list of inputs, not {class}"))
}

fn file(given: &Bound<'_, PyAny>) -> PyResult<Script> {
    let path: PathBuf = given.extract()?;
    let text = text_of(given.py(), &path, "a script", MAX_TEXT)?.map_err(RunError::new_err)?;
    parsed(&path.display().to_string(), &text)
}

fn parsed(name: &str, text: &str) -> PyResult<Script> {
    Script::parse(name, text).map_err(|error| RunError::new_err(error.to_string()))
}

/// The one keyword of an input, and its value.
fn only<'py>(input: &Bound<'py, PyDict>, place: &str) -> PyResult<(String, Bound<'py, PyAny>)> {
    match <[_; 1]>::try_from(pairs(input)?) {
        Ok([one]) => Ok(one),
        Err(given) => {
            let n = given.len();
            Err(PyTypeError::new_err(format!("{place}: {n} inputs: one of {INPUTS}; of a world {CHANGES}")))
        }
    }
}

fn pairs<'py>(input: &Bound<'py, PyDict>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    input.iter().map(|(key, value)| Ok((key.extract()?, value))).collect()
}

/// The one input to a robot that these keywords are.
///
/// # Errors
/// `TypeError` for none, several or an unknown one, `ValueError` for a number that no script holds.
pub fn input_of(given: Option<&Bound<'_, PyDict>>) -> PyResult<RobotInput> {
    let (key, value) = one_of(given, INPUTS)?;
    robot_input(&key, &value)
}

/// The one change of a world that these keywords are.
///
/// # Errors
/// As [`input_of`].
pub fn change_of(given: Option<&Bound<'_, PyDict>>) -> PyResult<WorldChange> {
    let (key, value) = one_of(given, CHANGES)?;
    change(&key, &value)
}

fn one_of<'py>(given: Option<&Bound<'py, PyDict>>, known: &str) -> PyResult<(String, Bound<'py, PyAny>)> {
    let none = || PyTypeError::new_err(format!("no input: it is one of {known}"));
    let given = given.ok_or_else(none)?;
    match pairs(given)?.len() {
        1 => only(given, "input"),
        n => Err(PyTypeError::new_err(format!("{n} inputs at once: give one of {known}"))),
    }
}

fn robot_input(key: &str, value: &Bound<'_, PyAny>) -> PyResult<RobotInput> {
    Ok(match key {
        "drive" => {
            let (first, second) = value.extract().map_err(|_| {
                PyTypeError::new_err("drive: two whole numbers, each from -128 to 128, the robot's maximum")
            })?;
            RobotInput::Drive(channel(first)?, channel(second)?)
        }
        "move_to" => RobotInput::MoveTo(quantized(key, value)?),
        "teleport" => RobotInput::Teleport(quantized(key, value)?),
        "trailer" => RobotInput::SetTrailer(value.extract()?),
        "release" => {
            if !value.extract::<bool>()? {
                return Err(PyValueError::new_err("release: it is True, or left out"));
            }
            RobotInput::Release
        }
        _ => return Err(PyTypeError::new_err(format!("{key}: a robot's input is one of {INPUTS}"))),
    })
}

fn channel(value: i64) -> PyResult<i16> {
    // of those that it can hold, the library itself says which it takes
    let beyond = |_| RunError::new_err(format!("channel {value}: it must be in -{MAX_CHANNEL} to {MAX_CHANNEL}"));
    i16::try_from(value).map_err(beyond)
}

fn quantized(key: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Quantized>> {
    let numbers: Vec<f64> =
        value.extract().map_err(|_| PyTypeError::new_err(format!("{key}: a configuration, as a list of numbers")))?;
    numbers.into_iter().map(|number| one_quantized(key, number)).collect()
}

fn one_quantized(key: &str, number: f64) -> PyResult<Quantized> {
    let none = || PyValueError::new_err(format!("{key}: {number} is no coordinate that a script can hold"));
    Quantized::try_new(number).ok_or_else(none)
}

fn change(key: &str, value: &Bound<'_, PyAny>) -> PyResult<WorldChange> {
    Ok(match key {
        "close" => WorldChange::Close(value.extract()?),
        "open" => WorldChange::Open(value.extract()?),
        "remove" => WorldChange::Remove(value.extract()?),
        "move" => {
            let form = |_| PyTypeError::new_err("move: a tuple (name, (x, y, theta))");
            let (name, (x, y, theta)): (String, (f64, f64, f64)) = value.extract().map_err(form)?;
            let to = (one_quantized(key, x)?, one_quantized(key, y)?, one_quantized(key, theta)?);
            WorldChange::Move { name, to }
        }
        "add" => {
            let form = |_| PyTypeError::new_err("add: a tuple (name, [(x, y), ..], radius)");
            let (name, points, radius): (String, Vec<(f64, f64)>, f64) = value.extract().map_err(form)?;
            let points = points.into_iter().map(|(x, y)| Ok((one_quantized(key, x)?, one_quantized(key, y)?)));
            let points = points.collect::<PyResult<_>>()?;
            WorldChange::Add { name, points, radius: one_quantized(key, radius)? }
        }
        _ => return Err(PyTypeError::new_err(format!("{key}: a change of a world is one of {CHANGES}"))),
    })
}
