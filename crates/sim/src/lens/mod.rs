//! Lenses that stand still, as values: the query anatomy, and the configuration space beside the workspace, under a
//! reader's hand. The window and a book's figures share what is here.
//!
//! ```
//! use motion_lab_sim::anatomy::{Anatomy, Tab};
//! use motion_lab_sim::lens::{Lens, LensPaper};
//! use motion_lab_sim::manifest::{HintTask, Widget};
//! let mut lens = Lens::new(Widget::Anatomy, Anatomy::default().with_tab(Tab::Witness)).unwrap();
//! lens.change(|anatomy| anatomy.set_coordinate(1, 1.42));
//! lens.let_go(); // what a hand only passes through is no task
//! assert_eq!(lens.take_done(), [HintTask::Near]);
//! assert!(lens.moving(LensPaper::World, [400.0; 2]).contains("the shortest way"));
//! ```

mod cells;
mod done;
mod held;
mod still;
#[cfg(test)]
mod tests;

pub use cells::SpaceCells;
pub use done::{done_between, have_one_tip};
pub use held::{Lens, LensPaper, remember_in};
pub use still::{LensSlider, LensWords};
