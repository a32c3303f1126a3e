//! Maps of cells: those of ROS and of MovingAI.

pub(crate) mod cells;
pub(crate) mod movingai;
pub(crate) mod pgm;
pub(crate) mod ros;
pub(crate) mod trace;
