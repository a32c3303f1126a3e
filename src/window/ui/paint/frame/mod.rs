//! The frame of a widget: its title, the misconception it removes, its colour key and the first hints.

mod focus_ring;
mod formulas;
mod hints;
mod sentence;
mod tasks;
mod title;

pub use focus_ring::focus_ring;
pub use formulas::{formula, formulas};
pub use hints::{is_done_here, lesson, next_hint};
pub use sentence::sentence;
pub use tasks::{is_true_of, kind_of, mode_of};
pub use title::{headline, key_row, misconception, name, name_and_key, rests, row_height, rows_of_words, title};
