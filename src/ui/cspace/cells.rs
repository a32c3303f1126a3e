//! `Cells`, the cells of a slice judged so far, with the last picture of them.

use std::sync::Arc;

use crate::collision::Checker;
use crate::configuration::AnyConfiguration;
use crate::cspace::{CellMap, Overlay, Region, Slice, cspace_picture, region_items, regions};
use crate::picture::Picture;
use crate::robots::AnyRobot;

/// The cells judged so far, and the last picture of them.
#[derive(Clone, Debug)]
pub struct Cells {
    map: CellMap,
    picture: Arc<Picture>,
    /// Number of cells judged when the picture was drawn.
    drawn: u64,
    /// The regions of single obstacles, once they have been asked for.
    regions: Option<Vec<Region>>,
}

impl Cells {
    /// The slice through `q`, of which nothing is known; `None` if `q` is not a configuration of the checker's robot.
    pub fn through(checker: &Checker<AnyRobot>, q: &AnyConfiguration, finest: u32) -> Option<Self> {
        let map = CellMap::new(Slice::through(checker, q).ok()?, finest);
        let picture = Arc::new(cspace_picture(&map, &Overlay::default()));
        Some(Cells { map, picture, drawn: 0, regions: None })
    }

    /// The cells.
    pub fn map(&self) -> &CellMap {
        &self.map
    }

    /// The picture of them, a little behind what is known.
    pub fn picture(&self) -> &Arc<Picture> {
        &self.picture
    }

    /// The regions of single obstacles; none before [`name`](Self::name).
    pub fn regions(&self) -> &[Region] {
        self.regions.as_deref().unwrap_or_default()
    }

    /// Finds which obstacle each region is, once all cells are judged, and writes its name there.
    pub fn name(&mut self) {
        if self.regions.is_none() && self.map.progress().done {
            let found = regions(self.map.slice());
            let named = cspace_picture(&self.map, &Overlay::default()).with(region_items(&found));
            (self.picture, self.regions) = (Arc::new(named), Some(found));
        }
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
