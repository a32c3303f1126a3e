//! Two implementations of the collision questions that share no geometry code with the library: [`exact`], integer
//! arithmetic without any rounding (and [`ray`], the same for scans), and [`plain`], everyday `f64` by other methods
//! than the library's. [`seen`] does the same for scans of whole worlds, [`proof`] for certificates.
//!
//! They take placed shapes, each a list of core vertices and a radius, and nothing else from the library. [`arm`] gives
//! them the kinematics of the Workbench's arm, written out, [`car`] that of a trailer. [`fixtures`] are shapes and
//! scenes for several tests.
//!
//! A crate of its own, so that it alone is optimised: the surveys spend their time here and in the core.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

pub mod arm;
pub mod car;
pub mod exact;
pub mod fixtures;
pub mod grazing;
pub mod plain;
pub mod proof;
pub mod ray;
pub mod seen;
mod short;
pub mod sweep;

pub use short::short;
