//! The guide: chapters to read, whose code blocks run as tests.

#[doc = include_str!("guide/write_a_planner.md")]
pub mod write_a_planner {}

#[doc = include_str!("guide/cars_and_trailers.md")]
pub mod cars_and_trailers {}

#[doc = include_str!("guide/bevy_app.md")]
pub mod bevy_app {}
