//! Captures: a widget's view as a figure for a page, with metadata in its file: a run's seed and digest, or a world's
//! content hash and the configuration. The window and the command `capture` draw and write with these alone.
//!
//! A [`Captured`] is a figure with its notes. [`anatomy`], [`cspace`] and [`atlas`] make one of a scene without a run,
//! [`at_tick`] of a run at a tick. A [`Paper`] gives its size and colours. The program writes a capture as SVG or
//! PNG, or a [`Film`] over a [`CaptureSpan`] of ticks as GIF; a page paints both out of the sheets as SVG.
//!
//! ```
//! use motion_lab_sim::anatomy::{Anatomy, Tab};
//! use motion_lab_sim::capture::{Paper, anatomy};
//! use motion_lab_core::picture::Theme;
//! let captured = anatomy(&Anatomy::default(), &[Tab::Witness]);
//! let svg = captured.svg(&Paper { palette: Theme::Light.palette(), width: 640, scale: 1.0 });
//! assert!(svg.contains("Configuration: T2(")); // its metadata
//! ```

mod captured;
mod chart;
mod costs;
mod distributions;
mod error;
mod film;
mod marks;
mod moving;
mod plan;
mod plot;
mod run_figure;
mod scenes;
mod space;
mod tour_figure;

pub use captured::{CaptureForm, Captured, Note, Paper, TICK_HUNDREDTHS};
pub use chart::MAX_LINES;
pub use costs::{CostCurve, CostFigure, costs};
pub use distributions::{ByValue, ConfidenceInterval, Distribution, Quartiles, boxes, histograms};
pub use error::CaptureError;
pub use film::Film;
pub use moving::{CaptureSpan, Subject, at_tick, at_tick_with_robots};
pub use plan::{PlanOutcome, PlanSheet, bounded, judged_words, plan, proven, unit, within_best};
pub use plot::{RunPlot, plot};
pub use run_figure::{RunFigure, run_svg, with_names};
pub use scenes::{AtlasSheet, anatomy, atlas, cspace, what_is_known};
