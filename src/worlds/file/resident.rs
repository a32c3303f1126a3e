//! The robots of a world, checked.

use super::description::RobotText;
use super::items::{finite, make_point};
use super::name::check_name;
use crate::num;
use crate::worlds::{BeamModel, Resident, WorldProblem};

impl Resident {
    /// The robot as a world file may have it: the kind known, as many coordinates as it has, a place within the coordinates that the
    /// lab computes with, and the angles wrapped to `(-pi, pi]`. The name is not checked.
    ///
    /// # Errors
    /// [`WorldProblem`](crate::worlds::WorldProblem): the kind, the number of coordinates, one that is not finite or too large, or a sensor that
    /// is refused.
    pub fn try_new(
        name: impl Into<String>,
        kind: impl Into<String>,
        start: impl Into<Vec<f64>>,
        sensor: Option<BeamModel>,
    ) -> Result<Self, WorldProblem> {
        let kind = kind.into();
        let start = make_start(&kind, start.into())?;
        let sensor = sensor.map(|noise| make_noise(&kind, noise)).transpose()?;
        Ok(Resident { name: name.into(), kind, start, sensor })
    }
}

pub(crate) fn make_resident(text: &RobotText) -> Result<Resident, WorldProblem> {
    let RobotText { name, kind, start, sensor } = text;
    Resident::try_new(name.clone(), kind.clone(), start.clone(), *sensor)
}

/// The start of a robot of this kind, checked and its angles wrapped.
pub(crate) fn make_start(kind: &str, mut start: Vec<f64>) -> Result<Vec<f64>, WorldProblem> {
    // how many of the coordinates are a position, and how many there may be
    let (lengths, counts, expected) = match kind {
        "rusty" => (2, 3..=3, "three: x, y, theta"),
        "reach" => (0, 2..=2, "two: th1, th2"),
        "reach3" => (0, 3..=3, "three: th1, th2, th3"),
        "hitch" => (2, 3..=4, "three: x, y, theta; or with a trailer four: x, y, theta, psi"),
        own if own.len() > 2 && own.starts_with("x-") && check_name(own).is_ok() => (usize::MAX, 1..=64, "1 to 64"),
        _ => return Err(WorldProblem::Kind(kind.to_owned())),
    };
    if !counts.contains(&start.len()) {
        return Err(WorldProblem::Start { kind: kind.to_owned(), expected, found: start.len() });
    }
    for (i, x) in start.iter_mut().enumerate() {
        *x = finite(*x, "a start coordinate")?;
        if i >= lengths {
            *x = num::wrap(*x);
        }
    }
    if lengths == 2 {
        make_point((start[0], start[1]))?;
    }
    Ok(start)
}

/// The noise of the sensor of a robot of this kind, which must have one.
pub(crate) fn make_noise(kind: &str, noise: BeamModel) -> Result<BeamModel, WorldProblem> {
    if ["reach", "reach3", "hitch"].contains(&kind) {
        return Err(WorldProblem::NoSensor(kind.to_owned()));
    }
    Ok(noise.try_new()?)
}
