//! The program itself: help, habits, shells.

pub mod habits;
pub mod manual;
mod messages;
pub mod shells;
mod width;
