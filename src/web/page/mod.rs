//! The lab in its page: what the page asks, and what is reported to it.

mod canvas;
mod controls;
mod downloads;
mod error;
mod inbox;
mod lab;
mod listener;
mod report;
mod run_link;
