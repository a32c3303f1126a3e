//! Shows the configuration space: a plane of configurations, cut into cells that are proven free, proven blocked, or
//! not yet known.
//!
//! A [`Slice`] is the plane: for Reach the torus as a square whose edges wrap, for Rusty the workspace with every
//! obstacle grown by its radius, for Hitch the rear axle's positions at one heading; or the whole space of a robot of
//! three coordinates ([`Slice::space`]). A [`CellMap`] proves its cells a few at a time. The same proof finds the
//! [nearest free](nearest_free) configuration. A [`Barrier`] is the smallest set of blocked cells that parts a start
//! from a goal, and so a proof that there is no path.
//!
//! ```
//! use motion_lab_core::collision::{Checker, Scene};
//! use motion_lab_core::cspace::{CellMap, CellState, Slice};
//! use motion_lab_core::robots::AnyRobot;
//! let (arm, q) = AnyRobot::of_kind("reach", &[0.8, 1.5]).unwrap();
//! let slice = Slice::through(&Checker::new(Scene::workbench(), arm), &q).unwrap();
//! let mut map = CellMap::new(slice, 7);
//! map.refine(2000);
//! assert_eq!(map.state([-0.8, 1.5]), CellState::Free); // proven, and so is every configuration of its cell
//! ```

mod barrier;
mod cells;
mod nearest;
mod picture;
#[doc(hidden)]
pub mod rectangles;
mod regions;
mod slice;
mod vertex_cut;
mod wrapping;

pub use barrier::{Barrier, BarrierAxis, BarrierCell};
pub use cells::{Cell, CellMap, MAX_LEVEL, ProofProgress};
pub use nearest::{NearestFree, nearest_free};
pub use picture::{Overlay, cspace_picture, lines_through, overlay_items};
pub use regions::{Region, region_items, regions};
pub use slice::{Blocking, CellProof, CellState, Slice};
pub use wrapping::wrapped_pieces;

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use crate::collision::{Checker, Scene};
    use crate::configuration::AnyConfiguration;
    use crate::robots::{AnyRobot, Reach};

    /// The chapter's arm on the Workbench, and its configuration.
    pub(super) fn arm(thick: bool) -> (Checker<AnyRobot>, AnyConfiguration) {
        let (_, q) = AnyRobot::of_kind("reach", &[FRAC_PI_4, FRAC_PI_2]).unwrap();
        let arm = if thick { Reach::workbench() } else { Reach::choset() };
        (Checker::new(Scene::workbench(), AnyRobot::Reach(arm)), q)
    }
}
