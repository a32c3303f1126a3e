//! Scans: what a range sensor reads at many poses.

use std::sync::Mutex;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use motion_lab_core::configuration::Configuration;
use motion_lab_core::geometry::Pose2;
use motion_lab_core::robots::RUSTY;
use motion_lab_core::sensors::{FanSensor, MAX_RAYS, RangeSensor, Scanner};

use crate::answers::{ALONE, Answers, each_chunk};
use crate::arrays::RowKind;
use crate::errors::Error;
use crate::world::PyWorld;

/// The scanner of the last few scans: its rays' directions cost more than a scan. Nobody waits for it.
static KEPT: Mutex<Option<Scanner>> = Mutex::new(None);

/// The kept scanner if it is of this sensor, else a new one.
fn taken(fan: FanSensor) -> Scanner {
    let kept = KEPT.try_lock().ok().and_then(|mut kept| kept.take());
    let is_same = |kept: &Scanner| *kept.sensor() == fan.sensor && kept.field_of_view() == fan.field_of_view;
    kept.filter(is_same).unwrap_or_else(|| Scanner::new(fan))
}

fn keep(scanner: Scanner) {
    if let Ok(mut kept) = KEPT.try_lock() {
        *kept = Some(scanner);
    }
}

/// The ranges of an exact range sensor at `poses`, `(..., 3)`, each `x`, `y`, metres, and a heading, radians: metres,
/// `(..., rays)`, inf where nothing is within `range`, and 0 everywhere when the position is inside an obstacle or
/// touches one. `world` is a `World` or the name of a built-in one.
///
/// Ray `k` points at `2 pi k / rays` from the heading, counter-clockwise. With a `field_of_view`, radians, below a full
/// turn the rays lie evenly from half of it on the right to half of it on the left, the first and the last on its
/// borders. Rays are closed: one through a corner hits it. `out` takes the ranges, as those of a `Checker` do.
///
/// Raises Error for a sensor that there cannot be: 1 to 100,000 rays, a range from 1 mm to 10 km.
#[pyfunction]
#[pyo3(signature = (world, poses, rays = 360, range = 4.0, *, field_of_view = None, out = None))]
pub fn scan<'py>(
    py: Python<'py>,
    world: &Bound<'py, PyAny>,
    poses: &Bound<'py, PyAny>,
    rays: i64,
    range: f64,
    field_of_view: Option<f64>,
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let scene = PyWorld::of(world)?.get().scene();
    let refused = |error: motion_lab_core::sensors::SensorError| Error::new_err(error.to_string());
    let Ok(n_rays) = u32::try_from(rays) else {
        return Err(Error::new_err(format!("{rays} rays: there must be 1 to {MAX_RAYS}")));
    };
    let sensor = RangeSensor::try_new(n_rays, range).map_err(refused)?;
    let fan = match field_of_view {
        None => FanSensor::from(sensor),
        Some(angle) => FanSensor::try_new(sensor, angle).map_err(refused)?,
    };
    let pose = RowKind { what: "a pose".to_owned(), names: ["x", "y", "theta"].map(str::to_owned).to_vec() };
    let poses = pose.read_array("poses", poses)?;
    poses.checked(py, &RUSTY)?;
    let n = n_rays as usize;
    let mut answers = Answers::<f64>::new(py, out, &[poses.leading(), &[n]].concat(), &[&poses])?;
    let (numbers, width) = (poses.numbers()?, poses.width());
    let count = numbers.len() / width.max(1);
    let places = answers.places()?;
    if places.len() != count * n {
        return Err(PyValueError::new_err("there are not as many places as ranges"));
    }
    each_chunk(py, count, |part| {
        let poses = numbers.get(part.start * width..part.end * width).unwrap_or_default().par_chunks_exact(width);
        let places = places.get_mut(part.start * n..part.end * n).unwrap_or_default();
        let scan = |scanner: &mut Scanner, (pose, ranges): (&[f64], &mut [f64])| {
            if let Some(pose) = Pose2::from_coordinates(pose) {
                scanner.scan_into(&scene, &[], &pose, ranges);
            }
        };
        if part.len() > ALONE {
            poses.zip(places.par_chunks_exact_mut(n)).for_each_init(|| Scanner::new(fan), scan);
        } else {
            let mut scanner = taken(fan);
            let poses = numbers.get(part.start * width..part.end * width).unwrap_or_default().chunks_exact(width);
            poses.zip(places.chunks_exact_mut(n)).for_each(|one| scan(&mut scanner, one));
            keep(scanner);
        }
        Ok(())
    })?;
    Ok(answers.into_object())
}
