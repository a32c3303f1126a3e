//! Lines of drawings: their pieces, their images, the straight pieces that follow them, and the simple polygons of what
//! closed lines enclose by a rule.

mod affine;
mod arrangement;
mod curves;
mod ellipse;
mod extent;
mod faces;
mod part;
mod sweep;
mod vertices;

pub(crate) use affine::Affine;
pub(crate) use arrangement::{Arrangement, Ring, micro, rounded};
pub(crate) use curves::{PathOutline, disc, outline};
pub(crate) use ellipse::{EllipticArc, arc_between};
pub(crate) use extent::{beyond, extent, is_coarse};
pub(crate) use part::{CurvedPart, PathPiece};
