//! A read log in the forms that other programs read: JSON lines, CSV, and MCAP for viewers; and the CSV's [`table()`]
//! as columns.
//!
//! Each other function writes to any `std::io::Write`, and the same log gives the same bytes. In text, every number has
//! the fewest digits that read back to the same bits; an infinite range is `inf`, in JSON as a text. Columns are called
//! as the coordinates of the robots' kinds, with units. A log of which only the beginning was read is written as far as
//! it has frames. Figures of a run are in [`capture`](crate::capture).
//!
//! ```
//! use motion_lab_sim::export;
//! use motion_lab_sim::recording::Run;
//! use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
//!
//! let log = Run::record(TourConfig { ticks: 2, ..TourConfig::default() }, BOOK_SEED)?;
//! let mut table = Vec::new();
//! export::write_csv(&log, false, &mut table)?;
//! let table = String::from_utf8(table)?;
//! assert!(table.starts_with("tick,time_s,id,robot,x_m,y_m,theta_rad,"));
//! assert_eq!(table.lines().count(), 1 + 3 * 3); // three robots at ticks 0, 1 and 2
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod columns;
mod csv;
mod error;
mod every_frame;
mod foxglove;
mod json_number;
mod jsonl;
mod table;

pub use csv::{csv_cell, write_csv, write_csv_of_kinds};
pub use error::ExportError;
pub use foxglove::{write_foxglove, write_foxglove_of_file, write_rerun, write_rerun_of_file};
pub use json_number::{JsonNumber, json_seed, read_json_seed};
pub use jsonl::{write_jsonl, write_jsonl_of_kinds};
pub use table::{LogCells, LogColumn, table, table_of_robot};
