//! Queries, plans and figures.

pub mod barriers;
mod black_box;
pub mod capture;
pub mod certificates;
pub mod clearance;
pub mod comparisons;
pub mod narrow_gap;
pub mod plan;
pub mod problems;
pub mod queries;
pub mod shortest;
