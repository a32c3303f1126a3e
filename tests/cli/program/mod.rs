//! The program itself: help, habits, shells.

pub mod habits;
pub mod manual;
mod messages;
mod own;
pub mod shells;
mod width;
