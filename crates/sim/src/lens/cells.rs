//! `SpaceCells`, the cells of a slice judged so far, with the last picture of them.

use std::sync::Arc;

use motion_lab_core::collision::Checker;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellMap, Overlay, Region, Slice, cspace_picture, region_items, regions};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::wrap;
use motion_lab_core::picture::{Anchor, Drawing, Fit, Item, Picture};
use motion_lab_core::robots::AnyRobot;

/// Radius of the point of a configuration with its ring, pixels.
const POINT: f64 = 8.0;

/// The cells judged so far, and the last picture of them.
#[derive(Clone, Debug)]
pub struct SpaceCells {
    map: CellMap,
    picture: Arc<Picture>,
    /// Number of cells judged when the picture was drawn.
    drawn: u64,
    /// The regions of single obstacles, once they have been asked for.
    regions: Option<Vec<Region>>,
}

impl SpaceCells {
    /// The slice through `q`, of which nothing is known; `None` if `q` is not a configuration of the checker's robot.
    pub fn through(checker: &Checker<AnyRobot>, q: &AnyConfiguration, finest: u32) -> Option<Self> {
        let map = CellMap::new(Slice::through(checker, q).ok()?, finest);
        let picture = Arc::new(cspace_picture(&map, &Overlay::default()));
        Some(SpaceCells { map, picture, drawn: 0, regions: None })
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

    /// Finds which obstacle each region is, once all cells are judged.
    pub fn name(&mut self) {
        if self.regions.is_none() && self.map.progress().done {
            self.regions = Some(regions(self.map.slice()));
        }
    }

    /// The names of the regions; one that a point would cover, where the picture lies as `fit` says, stands beside it.
    pub fn names_off(&self, point: Point2, fit: &Fit) -> Vec<Item> {
        let [x, y] = fit.screen_from_world(point);
        let mut items = region_items(self.regions());
        for item in &mut items {
            let Drawing::Label { at, text, anchor, size_px, .. } = &mut item.drawing else { continue };
            let [left, top] = fit.screen_from_world(*at);
            // letters are about half as wide as high
            let half_width = 0.25 * *size_px * text.chars().count() as f64;
            if (x - left).abs() < half_width + POINT && (y - top).abs() < *size_px + POINT {
                *anchor = if y > top { Anchor::Above } else { Anchor::Below };
            }
        }
        items
    }

    /// Whether a point of the slice's plane is on its chart, or at most this far beyond its edges: a point on the edge
    /// can be taken from there.
    pub fn is_on_chart(&self, point: Point2, reach: f64) -> bool {
        let slice = self.map.slice();
        let chart = Aabb::new(Point2::from(slice.min()), Point2::from(slice.max())).grown(reach);
        !chart.is_apart(&Aabb::new(point, point))
    }

    /// The configuration of a point of the slice's plane, and whether the way there led over an edge of a torus: beyond
    /// it the square goes on at the opposite one. Any other slice ends at its edges.
    pub fn configuration_at(&self, point: Point2) -> (AnyConfiguration, bool) {
        let slice = self.map.slice();
        let to = [point.x, point.y];
        if slice.wraps() {
            let within = to.map(wrap);
            return (slice.at(within), within != to);
        }
        let (min, max) = (slice.min(), slice.max());
        (slice.at([to[0].clamp(min[0], max[0]), to[1].clamp(min[1], max[1])]), false)
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

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::collision::Scene;
    use motion_lab_core::configuration::Tn;
    use motion_lab_core::picture::ScreenRect;
    use motion_lab_core::robots::Reach;

    #[test]
    fn the_name_of_a_region_gives_way_to_the_point() {
        let arm = AnyRobot::Reach(Reach::workbench());
        let checker = Checker::new(Scene::workbench(), arm);
        let mut cells = SpaceCells::through(&checker, &AnyConfiguration::T2(Tn([0.3, 0.2])), 5).unwrap();
        while cells.refine(10_000) {}
        cells.name();
        let square = Aabb::new(Point2::new(-3.2, -3.2), Point2::new(3.2, 3.2));
        let fit = Fit::new(&square, ScreenRect { min: [0.0; 2], size: [640.0; 2] }, 0.0);
        let region = cells.regions()[0].at;
        let anchors = |off: [f64; 2]| {
            let [x, y] = [region[0] + off[0] / 100.0, region[1] + off[1] / 100.0];
            let items = cells.names_off(Point2::new(x, y), &fit);
            let anchor = |item: &Item| match item.drawing {
                Drawing::Label { anchor, .. } => Some(anchor),
                _ => None,
            };
            anchor(&items[0]).unwrap()
        };
        // a pixel is a hundredth: letters are 11 pixels high, the point's ring reaches 8
        assert_eq!([[0.0, 4.0], [0.0, -4.0]].map(anchors), [Anchor::Below, Anchor::Above]);
        assert_eq!([[0.0, 30.0], [0.0, -30.0], [120.0, 0.0]].map(anchors), [Anchor::Centre; 3]);
    }
}
