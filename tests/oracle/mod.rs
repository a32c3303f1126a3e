//! Two implementations of the collision questions that share no geometry code with the library: [`exact`], integer
//! arithmetic without any rounding (and [`ray`], the same for scans), and [`plain`], everyday `f64` by other methods
//! than the library's.
//!
//! Both take placed shapes, each a list of core vertices and a radius, and nothing else from the library. [`arm`] gives
//! them the kinematics of the Workbench's arm, written out.

pub mod arm;
pub mod exact;
pub mod plain;
pub mod ray;
mod short;
pub mod sweep;

pub use short::short;
