//! The program itself: help, habits, shells.

pub mod habits;
pub mod manual;
pub mod shells;
