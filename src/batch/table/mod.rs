//! Tables as Parquet, with the study, the columns' units and a seal in the file's own metadata.
//!
//! Whole numbers are unsigned 64-bit, numbers double, texts UTF-8. Four entries of the file's metadata say the rest:
//! `motion-lab.columns`, a list of each column's name, kind, unit and meaning in JSON; `motion-lab.plan`, the study
//! with all it names, from which a row can be run again; `motion-lab.seal`, the digest of both and of every row in
//! order; and `motion-lab.pages`, the digest and the number of the file's bytes before its metadata.

mod error;
mod file;
mod seal;
mod writer;

pub use error::TableError;
pub use file::{TableFile, VerifiedTable};
pub use writer::TableWriter;
