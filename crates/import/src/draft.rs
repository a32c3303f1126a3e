//! `WorldDraft`, a world under construction, with notes for its reader.

use super::Imported;
use motion_lab_core::configuration::Sizes;
use motion_lab_core::one_line::OneLine;
use motion_lab_core::worlds::{Resident, ResidentSensor, WorldBuilder, WorldProblem, Xy};

/// Largest number of notes kept.
const MAX_NOTES: usize = 100;

/// A world under construction, and what its reader must know of it.
#[derive(Default)]
pub struct WorldDraft {
    pub world: WorldBuilder,
    notes: Vec<String>,
    /// See [`Imported::assumed_unit`].
    pub assumed_unit: Option<f64>,
}

/// A robot that is to be added.
pub struct DraftRobot<'a> {
    pub kind: &'a str,
    /// Its chart coordinates.
    pub start: Vec<f64>,
    /// What it is like; `None` for its kind's own.
    pub sizes: Option<Sizes>,
    pub sensors: &'a [ResidentSensor],
}

impl WorldDraft {
    /// Adds a robot under this name, else named after its kind.
    pub fn robot(&mut self, name: Option<&str>, robot: DraftRobot) -> Result<(), WorldProblem> {
        let name = self.world.claim(&name.map_or_else(|| capitalised(robot.kind), str::to_owned));
        let mut resident = Resident::try_new(name, robot.kind, robot.start, None)?.try_with_sensors(robot.sensors)?;
        if let Some(sizes) = robot.sizes {
            resident = resident.try_with_sizes(sizes)?;
        }
        self.world.robot(resident)
    }

    /// Adds a note in one line, unless it is there already or there are too many.
    pub fn note(&mut self, note: impl Into<String>) {
        let note = OneLine(note.into()).to_string();
        if self.notes.len() < MAX_NOTES && !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// The first note but `common` that says of a thing that it is left out.
    pub fn first_left_out(&self, common: &str) -> Option<&str> {
        self.notes.iter().map(String::as_str).find(|note| *note != common && note.contains(" is left out"))
    }

    /// Returns the finished world with these bounds, and the notes.
    pub fn finish(self, name: &str, min: Xy, max: Xy) -> Result<Imported, WorldProblem> {
        Ok(Imported { world: self.world.finish(name, min, max)?, notes: self.notes, assumed_unit: self.assumed_unit })
    }
}

/// The kind of a robot as a name: its first letter becomes a capital.
pub fn capitalised(kind: &str) -> String {
    let mut name = kind.to_owned();
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    name
}
