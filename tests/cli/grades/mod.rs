//! Grading.

pub mod gaming;
pub mod grade;
pub mod gradebook;
