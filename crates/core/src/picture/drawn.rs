//! `Picture`, a drawing in metres.

use super::item::Item;
use crate::geometry::Aabb;

/// A drawing in metres: items in painting order, the first below all others.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// What it shows, in a few words.
    pub name: String,
    /// The part of the plane it shows, metres.
    pub bounds: Aabb,
    /// Whether its plane is in metres, so that a scale bar applies. Otherwise its axes give the units.
    pub in_metres: bool,
    /// The items, lowest first. Their ids are unique.
    pub items: Vec<Item>,
}

impl Picture {
    /// Creates a picture without items, in metres.
    pub fn new(name: impl Into<String>, bounds: Aabb) -> Self {
        Picture { name: name.into(), bounds, in_metres: true, items: Vec::new() }
    }

    /// Returns the picture with these items painted over those already there.
    #[must_use]
    pub fn with(mut self, items: impl IntoIterator<Item = Item>) -> Self {
        self.items.extend(items);
        self
    }
}
