//! Grading.

pub mod grade;
pub mod gradebook;
