//! Reference planners, each a small file that can be read.

mod rrt_connect;

pub use rrt_connect::RrtConnect;
