//! Query anatomy: one frozen scene, one robot in it, and the answers to the four questions, as plain values and
//! pictures.
//!
//! ```
//! use motion_lab_sim::anatomy::{Anatomy, Tab};
//! let mut anatomy = Anatomy::default(); // the chapter's arm beside the block
//! assert!((anatomy.distance() - 0.0606602).abs() < 1e-7);
//! anatomy.set_thick_links(true);
//! assert!((anatomy.distance() - 0.0306602).abs() < 1e-7); // less by exactly the radius
//! anatomy.set_coordinate(1, 1.45);
//! assert!(anatomy.intersects() && anatomy.distance() == 0.0);
//! let picture = anatomy.with_tab(Tab::Witness).picture();
//! assert!(picture.items.iter().any(|item| item.id == "contact")); // a cross where they meet
//! ```

mod choice;
mod close_up;
mod contact;
mod feature;
mod frozen;
mod nearest;
mod picture;
mod prompt;
mod readout;
mod snippet;
mod sweep;
#[cfg(test)]
mod tests;
mod thickness;
mod twin;
mod words;

pub use contact::{held_before, touching_items};
pub use feature::Feature;
pub use frozen::{Anatomy, LENGTHS, THICK_LINKS, Tab, WorldSource};
pub use nearest::{NearestPair, TIE, nearest_pairs};
pub use picture::nearest_items;
pub use prompt::{Guess, NoGuess, Prompt, PromptSeries};
pub use sweep::SweptMotion;
pub use twin::{both_configurations, contact_items, in_the_way, straight_way, twin, twin_items};
