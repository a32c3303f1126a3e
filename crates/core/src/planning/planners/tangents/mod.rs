//! Shortest paths of a disc: tangents between the rims about the corners of obstacles, and arcs on the rims.
//!
//! The centre of a disc must keep its radius from every obstacle. What is forbidden to it is bounded by straight lines
//! and by arcs about vertices, the rims; a shortest path consists of arcs on rims and of lines that touch two of them,
//! and it never turns the other way on a rim (Liu and Arimoto, 1992).

mod bound;
mod planner;
mod rim;
mod search;
mod space;

pub use bound::length_bound;
pub use planner::TangentGraph;
