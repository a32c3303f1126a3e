//! `Cells`, the cells of a slice judged so far, with the last picture of them.

use std::sync::Arc;

use crate::collision::Checker;
use crate::configuration::AnyConfiguration;
use crate::cspace::{CellMap, Overlay, Slice, cspace_picture};
use crate::picture::Picture;
use crate::robots::AnyRobot;

/// The cells judged so far, and the last picture of them.
#[derive(Clone, Debug)]
pub struct Cells {
    map: CellMap,
    picture: Arc<Picture>,
    /// Number of cells judged when the picture was drawn.
    drawn: u64,
}

impl Cells {
    /// The slice through `q`, of which nothing is known; `None` if `q` is not a configuration of the checker's robot.
    pub fn through(checker: &Checker<AnyRobot>, q: &AnyConfiguration, finest: u32) -> Option<Self> {
        let map = CellMap::new(Slice::through(checker, q).ok()?, finest);
        let picture = Arc::new(cspace_picture(&map, &Overlay::default()));
        Some(Cells { map, picture, drawn: 0 })
    }

    /// The cells.
    pub fn map(&self) -> &CellMap {
        &self.map
    }

    /// The picture of them, a little behind what is known.
    pub fn picture(&self) -> &Arc<Picture> {
        &self.picture
    }

    /// Judges `budget` more cells. Returns whether any remain.
    pub fn refine(&mut self, budget: u32) -> bool {
        let more = self.map.refine(budget);
        let judged = self.map.progress().judged;
        // merging the cells costs more than judging them
        if judged != self.drawn && (!more || judged > self.drawn + self.drawn / 3) {
            self.picture = Arc::new(cspace_picture(&self.map, &Overlay::default()));
            self.drawn = judged;
        }
        more
    }
}
