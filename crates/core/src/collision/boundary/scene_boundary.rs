//! `SceneBoundary`, the boundary of pieces with what finds the segments that a ray can meet.

use std::sync::Arc;

use super::grid::Cells;
use super::segments::{Circle, SegmentSoup};
use super::sight::SightCells;
use crate::geometry::{Placed, Point2, Segment};

/// Largest number of segments and discs for which a scan tests them all; with more it walks through a grid.
const MANY: usize = 128;

/// The boundary of a scene's pieces, or of some of them.
#[derive(Clone, Debug)]
pub(crate) struct SceneBoundary {
    soup: SegmentSoup,
    /// The grid over the boundary; `None` where it is small.
    cells: Option<Cells>,
    /// What can be seen from where, of a small boundary; copies share it.
    sight: Option<Arc<SightCells>>,
}

impl SceneBoundary {
    /// The boundary of these pieces; of small ones it will list what can be seen from where.
    pub(crate) fn new<'a>(pieces: impl IntoIterator<Item = &'a Placed>) -> Self {
        let mut boundary = Self::without_lists(pieces);
        if boundary.cells.is_none() {
            boundary.sight = SightCells::new(boundary.soup.segments()).map(Arc::new);
        }
        boundary
    }

    /// The boundary of these pieces, which lists nothing.
    pub(crate) fn without_lists<'a>(pieces: impl IntoIterator<Item = &'a Placed>) -> Self {
        let mut soup = SegmentSoup::default();
        pieces.into_iter().for_each(|piece| soup.push(piece));
        let many = soup.segments().len() + soup.circles().len() > MANY;
        let cells = if many { Cells::new(&soup) } else { None };
        SceneBoundary { soup, cells, sight: None }
    }

    /// The segments and discs.
    pub(crate) fn soup(&self) -> &SegmentSoup {
        &self.soup
    }

    /// The grid over them; `None` where they are few.
    pub(crate) fn cells(&self) -> Option<&Cells> {
        self.cells.as_ref()
    }

    /// The arrays of the segments, without some that a scan of this reach from a point cannot meet first.
    pub(crate) fn seen_from(&self, origin: Point2, reach: f64) -> [&[f64]; 4] {
        let segments = self.soup.segments();
        let seen = self.sight.as_ref().and_then(|sight| sight.seen_from(origin, reach, segments));
        seen.unwrap_or(segments.arrays())
    }

    /// Takes the boundary of a piece away: no ray meets it any more. False where it does not find all of it.
    ///
    /// Of two pieces alike it is that of either, so it is found by its coordinates. A segment or a disc that is gone is
    /// NaN, so that the others keep their numbers.
    pub(crate) fn forget(&mut self, piece: &Placed) -> bool {
        let mut own = SegmentSoup::default();
        own.push(piece);
        // a list may leave out what only this piece hides
        self.sight = None;
        let segments = own.segments();
        (0..segments.len()).all(|i| self.forget_segment(&segments.segment(i)))
            && own.circles().iter().all(|circle| self.forget_circle(circle))
    }

    fn forget_segment(&mut self, segment: &Segment) -> bool {
        match &mut self.cells {
            Some(cells) => cells.forget(segment),
            None => self.soup.forget_segment(segment),
        }
    }

    fn forget_circle(&mut self, circle: &Circle) -> bool {
        let Some(cells) = &self.cells else { return self.soup.forget_circle(0..self.soup.circles().len(), circle) };
        let place = cells.place(circle.centre);
        if !cells.holds(place.column, place.row) {
            return false;
        }
        let segments = self.soup.segments().len();
        let discs = cells.things(cells.number(place.column, place.row)).iter();
        self.soup.forget_circle(discs.filter_map(|number| (*number as usize).checked_sub(segments)), circle)
    }
}
