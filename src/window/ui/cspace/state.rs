//! `CspaceState`, the state of the configuration space.

use std::sync::Arc;

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::picture::{Picture, Role};
use motion_lab_core::robots::ConfigurationError;
use motion_lab_sim::anatomy::Anatomy;
use motion_lab_sim::capture::{self, Captured};
use motion_lab_sim::lens::SpaceCells;

/// Level of the finest cells: a 256th of the sides.
const FINEST: u32 = 8;

/// Largest number of cells judged in a frame.
const BUDGET: u32 = 1500;

/// How a torus is turned at first: about its axis, and its axis towards the eye, radians.
const TURNED: [f64; 2] = [-0.9, 0.85];

/// The state of the configuration space.
#[derive(Clone, Debug)]
pub struct CspaceState {
    pub(super) cells: Option<SpaceCells>,
    /// The configurations visited, oldest first.
    pub trace: Vec<AnyConfiguration>,
    /// Whether a square whose edges are one is shown as a torus.
    pub is_torus: bool,
    /// How the torus is turned: about its axis, and its axis towards the eye, radians.
    pub turned: [f64; 2],
}

impl Default for CspaceState {
    fn default() -> Self {
        CspaceState { cells: None, trace: Vec::new(), is_torus: false, turned: TURNED }
    }
}

/// Whether the cells are those of this robot, in this scene, with the same coordinates held.
fn are_of(cells: &SpaceCells, anatomy: &Anatomy) -> bool {
    let (ours, its) = (cells.map().slice(), anatomy.checker());
    let same_scene = Arc::ptr_eq(&ours.checker().shared_scene(), &its.shared_scene());
    same_scene && ours.checker().robot() == its.robot() && ours.holds(&anatomy.q())
}

impl CspaceState {
    /// The figure of workspace and configuration space, with every cell judged down to the finest level.
    pub fn captured(&self, anatomy: &Anatomy) -> Result<Captured, ConfigurationError> {
        let kept = self.cells.as_ref().filter(|cells| are_of(cells, anatomy)).map(|cells| cells.map().clone());
        let mut cells = match kept {
            Some(cells) => cells,
            None => CellMap::new(Slice::through(anatomy.checker(), &anatomy.q())?, FINEST),
        };
        cells.refine(u32::MAX);
        Ok(capture::cspace(anatomy, &cells, self.trace.clone()))
    }

    /// The picture of what is known of this robot's space; `None` before anything is.
    pub fn still(&self, anatomy: &Anatomy) -> Option<&Picture> {
        self.cells.as_ref().filter(|cells| are_of(cells, anatomy)).map(|cells| &**cells.picture())
    }

    /// How much of the space is known to be what a role of the colour key stands for, in words such as `74.2 %`; `None`
    /// for other roles, and before any cell has been judged.
    pub fn share(&self, role: Role) -> Option<String> {
        let known = self.cells.as_ref()?.map().progress();
        let share = match role {
            Role::Free => known.free,
            Role::Obstacle => known.blocked,
            Role::Unknown => known.unknown,
            _ => return None,
        };
        Some(format!("{:.1} %", 100.0 * share))
    }

    /// Judges more cells, from the start for another robot or scene. Returns whether any remain.
    pub(super) fn refine(&mut self, anatomy: &Anatomy) -> bool {
        if !self.cells.as_ref().is_some_and(|cells| are_of(cells, anatomy)) {
            let Some(cells) = SpaceCells::through(anatomy.checker(), &anatomy.q(), FINEST) else { return false };
            self.cells = Some(cells);
            self.trace.clear();
        }
        self.cells.as_mut().is_some_and(|cells| {
            let more = cells.refine(BUDGET);
            cells.name();
            more
        })
    }
}
