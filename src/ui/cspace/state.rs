//! `CspaceState`, the state of the configuration space.

use std::sync::Arc;

use crate::anatomy::Anatomy;
use crate::capture::{self, Captured};
use crate::configuration::AnyConfiguration;
use crate::cspace::{CellMap, Overlay, Slice, cspace_picture};
use crate::picture::Picture;
use crate::robots::ConfigurationError;

/// Level of the finest cells: a 256th of the sides.
const FINEST: u32 = 8;
/// Largest number of cells judged in a frame.
const BUDGET: u32 = 1500;

/// The state of the configuration space.
#[derive(Clone, Debug, Default)]
pub struct CspaceState {
    pub(super) map: Option<Map>,
    /// The configurations visited, oldest first.
    pub(super) trace: Vec<AnyConfiguration>,
}

/// The cells judged so far, and the last picture of them.
#[derive(Clone, Debug)]
pub(super) struct Map {
    pub(super) cells: CellMap,
    pub(super) picture: Arc<Picture>,
    /// Number of cells judged when the picture was drawn.
    drawn: u64,
}

impl Map {
    /// Whether its cells are those of this robot, in this scene, with the same coordinates held.
    fn is_of(&self, anatomy: &Anatomy) -> bool {
        let (ours, its) = (self.cells.slice(), anatomy.checker());
        let same_scene = Arc::ptr_eq(&ours.checker().shared_scene(), &its.shared_scene());
        same_scene && ours.checker().robot() == its.robot() && ours.holds(&anatomy.q())
    }
}

impl CspaceState {
    /// The figure of workspace and configuration space, with every cell judged down to the finest level.
    pub fn captured(&self, anatomy: &Anatomy) -> Result<Captured, ConfigurationError> {
        let kept = self.map.as_ref().filter(|map| map.is_of(anatomy)).map(|map| map.cells.clone());
        let mut cells = match kept {
            Some(cells) => cells,
            None => CellMap::new(Slice::through(anatomy.checker(), &anatomy.q())?, FINEST),
        };
        cells.refine(u32::MAX);
        Ok(capture::cspace(anatomy, &cells, self.trace.clone()))
    }

    /// Judges more cells, from the start for another robot or scene. Returns whether any remain.
    pub(super) fn refine(&mut self, anatomy: &Anatomy) -> bool {
        if !self.map.as_ref().is_some_and(|map| map.is_of(anatomy)) {
            let Ok(slice) = Slice::through(anatomy.checker(), &anatomy.q()) else { return false };
            let cells = CellMap::new(slice, FINEST);
            let picture = Arc::new(cspace_picture(&cells, &Overlay::default()));
            self.map = Some(Map { cells, picture, drawn: 0 });
            self.trace.clear();
        }
        let Some(map) = &mut self.map else { return false };
        let more = map.cells.refine(BUDGET);
        let judged = map.cells.progress().judged;
        // what is drawn lags a little behind what is known: merging the cells costs more than judging them
        if judged != map.drawn && (!more || judged > map.drawn + map.drawn / 3) {
            map.picture = Arc::new(cspace_picture(&map.cells, &Overlay::default()));
            map.drawn = judged;
        }
        more
    }
}
