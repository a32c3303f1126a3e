//! The four questions.

mod changes;
mod chapter;
mod exercises;
mod extremes;
mod failsafe;
mod faults;
mod footprints;
mod metamorphic;
mod pairs;
mod penetration;
mod polygons;
mod rounded;
mod send_sync;
mod ties;
mod touches;
mod wrappers;
