//! Reference planners, each a small file that can be read.

mod bug1;
mod bug2;
mod cells;
mod disc;
mod frontier;
mod grid_search;
mod potential_field;
mod prm;
mod rrt;
mod rrt_connect;
mod rrt_star;
mod tangents;
mod visibility_graph;
mod walker;

pub use bug1::Bug1;
pub use bug2::Bug2;
pub use cells::{CellDecomposition, cell_length_bound};
pub use grid_search::GridSearch;
pub use potential_field::{FieldSettings, PotentialField};
pub use prm::Prm;
pub use rrt::Rrt;
pub use rrt_connect::RrtConnect;
pub use rrt_star::RrtStar;
pub use tangents::{TangentGraph, length_bound};
pub use visibility_graph::VisibilityGraph;
