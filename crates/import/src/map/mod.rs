//! Maps of cells: those of ROS and of MovingAI.

pub(crate) mod bmp_image;
pub(crate) mod cells;
pub(crate) mod gray_image;
pub(crate) mod image;
pub(crate) mod lines;
pub(crate) mod movingai;
pub(crate) mod png_image;
pub(crate) mod pnm;
pub(crate) mod ros;
pub(crate) mod scenario;
pub(crate) mod trace;
