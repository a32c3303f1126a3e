//! The frame of a widget: its title, the misconception it removes, its colour key and the sentence under its pictures.

mod focus_ring;
mod formulas;
mod sentence;
mod tasks;
mod title;

pub use focus_ring::focus_ring;
pub use formulas::{formula, formulas};
pub use sentence::{sentence, sentence_in_rows};
pub use tasks::{kind_of, mode_of};
pub use title::{headline, key_row, misconception, name, name_and_key, rests, row_height, rows_of_words};
