//! `SceneLayers`, what has changed in a scene since it was made.

use std::sync::OnceLock;

use super::boundary::scene_boundary::SceneBoundary;
use super::broad::index::Index;

/// The pieces that were put into a scene after it was made lie in layers, each with a boundary and an index of its own.
/// Like the digits of a binary number, a layer is made of those before it that are not larger than twice its size, so
/// that n pieces put in one after another are listed n log n times (Bentley and Saxe).
#[derive(Clone, Default)]
pub(super) struct SceneLayers {
    /// The numbers of the layers' first pieces.
    firsts: Vec<usize>,
    boundaries: Vec<SceneBoundary>,
    /// How many pieces are not there any more.
    gone: usize,
    /// The index of the scene made whole, where somebody has asked for it since the last change.
    whole: OnceLock<WholeIndex>,
}

/// An index of all pieces in file order, and the numbers that the scene has for them.
#[derive(Clone)]
pub(super) struct WholeIndex {
    pub(super) index: Index,
    pub(super) pieces: Vec<u32>,
}

/// The index of a scene made whole.
///
/// It is for questions whose answers depend on the order in which pieces are found, or on which are passed over, in
/// their last bits or in their order.
#[derive(Clone, Copy)]
pub(super) struct WholeView<'a> {
    pub(super) index: &'a Index,
    pieces: Option<&'a [u32]>,
}

impl<'a> WholeView<'a> {
    /// The view of a scene that has not changed since it was made.
    pub(super) fn of_unchanged(index: &'a Index) -> Self {
        WholeView { index, pieces: None }
    }

    /// The piece that the index knows by this number.
    #[inline]
    pub(super) fn piece(&self, number: usize) -> usize {
        self.pieces.map_or(number, |pieces| pieces[number] as usize)
    }
}

/// The least number of pieces of a layer that others follow: an index of fewer is a list.
const LEAST: usize = 64;

impl SceneLayers {
    /// The first piece of a layer that ends with those from number `first` to `end`: it takes in the layers before it
    /// that are not much larger. `None` where it takes in what the scene was made of.
    pub(super) fn first_of_layer(&self, first: usize, end: usize) -> Option<usize> {
        let (mut from, mut after) = (first, self.firsts.iter().rev().copied().chain([0]));
        loop {
            let before = after.next()?;
            let is_much_larger = from - before >= LEAST && from - before >= 2 * (end - from);
            if is_much_larger {
                return Some(from);
            }
            from = before;
        }
    }

    /// The index of the scene made whole, which `make` makes where it is not known since the last change.
    pub(super) fn whole(&self, make: impl FnOnce() -> WholeIndex) -> WholeView<'_> {
        let WholeIndex { index, pieces } = self.whole.get_or_init(make);
        WholeView { index, pieces: Some(pieces) }
    }

    /// Notes that the scene changes, and that this many pieces are not there any more.
    pub(super) fn note_change(&mut self, gone: usize) {
        self.gone += gone;
        self.whole = OnceLock::new();
    }

    /// Makes the layer that begins with a piece; those after it end.
    pub(super) fn put_from(&mut self, first: usize, boundary: SceneBoundary) {
        let kept = self.firsts.partition_point(|own| *own < first);
        self.firsts.truncate(kept);
        self.boundaries.truncate(kept);
        self.firsts.push(first);
        self.boundaries.push(boundary);
    }

    /// How many pieces are not there any more.
    pub(super) fn gone(&self) -> usize {
        self.gone
    }

    /// The boundaries of the layers.
    pub(super) fn boundaries(&self) -> &[SceneBoundary] {
        &self.boundaries
    }

    /// The boundary of the layer that holds a piece; `None` for what the scene was made of.
    pub(super) fn boundary_of(&mut self, piece: usize) -> Option<&mut SceneBoundary> {
        let number = self.firsts.partition_point(|first| *first <= piece).checked_sub(1)?;
        self.boundaries.get_mut(number)
    }
}
