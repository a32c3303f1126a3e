//! A part of a footprint and a piece of a scene: what holds where either is not a valid shape.

use super::distance::{self, Nearest, nearest, nearest_within};
use crate::geometry::Placed;

/// The nearest points of a part and a piece; contact when the piece is not a valid shape.
pub(crate) fn pair(part: &Placed, piece: &Placed) -> Nearest {
    if piece.is_valid() { nearest(part, piece) } else { contact_at(part) }
}

/// As [`pair`]; `None` only where the distance is greater than `limit`.
pub(crate) fn pair_within(part: &Placed, piece: &Placed, limit: f64) -> Option<Nearest> {
    if piece.is_valid() { nearest_within(part, piece, limit) } else { Some(contact_at(part)) }
}

fn contact_at(part: &Placed) -> Nearest {
    let point = part.core()[0];
    Nearest { dist: 0.0, on_a: point, on_b: point }
}

/// Whether two shapes touch; true when either is not valid.
pub(crate) fn touch(a: &Placed, b: &Placed) -> bool {
    !a.is_valid() || touches(a, b)
}

/// Whether a valid part touches a piece; true when the piece is not a valid shape.
pub(crate) fn touches(part: &Placed, piece: &Placed) -> bool {
    !piece.is_valid() || distance::touch(part, piece)
}
