//! How contacts could be avoided, against trees of inputs that are walked through whole by other means.

mod chances;
mod trees;
