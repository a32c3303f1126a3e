//! Planning by cells of the configuration space: paths, proofs that there is none, and how short a path may be.

mod bound;
mod decomposition;
mod lengths;
mod norm;
mod states;

pub use bound::cell_length_bound;
pub use decomposition::CellDecomposition;
