//! Painting, for every widget: canvas, sheets, frame, buttons, colours and style.

pub(crate) mod button;
pub(crate) mod camera;
pub(crate) mod canvas;
mod coarse;
pub(crate) mod fold;
pub(crate) mod frame;
pub(crate) mod frame_colours;
pub(crate) mod icon;
pub(crate) mod magnifier;
pub(crate) mod plate;
pub(crate) mod polygons;
pub(crate) mod scale_bar;
pub(crate) mod sheet;
pub(crate) mod style;
pub(crate) mod touch;
