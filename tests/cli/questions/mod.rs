//! Queries, plans and figures.

pub mod black_box;
pub mod capture;
pub mod certificates;
pub mod plan;
pub mod queries;
