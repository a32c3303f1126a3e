//! Reads maps and drawings of other programs as worlds.
//!
//! | from | what becomes of it |
//! |---|---|
//! | a ROS map, [`RosMap`] | boxes over its occupied cells, or on request closed walls along their borders |
//! | a MovingAI map, [`movingai`] | the same |
//! | a MovingAI scenario, [`Scenario`] | places in the world of its map |
//! | an IR-SIM world, [`irsim()`] | circles, boxes, polygons, walls and robots |
//! | an SVG drawing, [`svg()`] | filled shapes as solid obstacles, shapes that are only stroked as walls |
//!
//! Nothing here opens a file: bytes go in, a [`OccupancyMap`] or an [`Imported`] world comes out. The world is one that
//! [`World::parse`](motion_lab_core::worlds::World::parse) would give: its text reads back as the same world.

mod draft;
mod error;
mod irsim;
mod map;
mod planar;
mod svg;
mod yaml;

use motion_lab_core::worlds::{Resident, World, WorldProblem};

pub use error::{ImportError, ImportProblem};
pub use irsim::context::IrsimOptions;
pub use irsim::scene::irsim;
pub use map::cells::{CellStyle, OccupancyMap};
pub use map::movingai::movingai;
pub use map::ros::{RosMap, RosMode, Unknown, is_ros_map};
pub use map::scenario::{MapCell, Scenario, ScenarioProblem};
pub use svg::read::{SvgOptions, svg};

use draft::WorldDraft;

/// A world that was read from another format.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The world.
    pub world: World,
    /// Notes for the reader, a sentence each: what was left out and how things were interpreted.
    pub notes: Vec<String>,
    /// The length that a unit of a drawing was taken for, metres, where neither the drawing nor the caller says one;
    /// `None` where somebody does. So it may be far from what was drawn.
    pub assumed_unit: Option<f64>,
}

impl Imported {
    /// Adds a robot of this kind, named after its kind. `start` holds its chart coordinates.
    ///
    /// # Errors
    /// [`WorldProblem`] if the kind is unknown or the coordinates do not fit it.
    pub fn put_robot(&mut self, kind: &str, start: &[f64]) -> Result<(), WorldProblem> {
        let plain = draft::capitalised(kind);
        let mut name = plain.clone();
        let mut count = 1;
        while self.world.has_name(&name) {
            count += 1;
            name = format!("{plain} {count}");
        }
        self.world.robots.push(Resident::try_new(name, kind, start, None)?);
        Ok(())
    }
}
