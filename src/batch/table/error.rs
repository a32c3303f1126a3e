//! `TableError`, why a table can't be written or read.

use motion_lab_core::one_line::OneLine;
use parquet::errors::ParquetError;

/// Why a table can't be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The crate that writes and reads Parquet refuses.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
    /// A Parquet file that no sweep wrote.
    #[error("it is no table of a sweep: its metadata has no {0}")]
    NoSweep(&'static str),
    /// A study that can't be read, with the reason.
    #[error("{}", OneLine(.0))]
    Study(String),
    /// A row that is not there.
    #[error("there is no row {row}: it has {rows}, from 0")]
    NoRow {
        /// The row asked for.
        row: u64,
        /// The number of rows.
        rows: u64,
    },
    /// Columns that this version does not give to the study.
    #[error("its columns are not those of its study: another version of motion-lab wrote it, or it is damaged")]
    Columns,
    /// A table without a digest of its rows.
    #[error("it has no seal, so nothing tells whether a cell was changed")]
    NoSeal,
    /// Rows, a study or units that are not those that were sealed.
    #[error("it is damaged: its seal is not that of its rows, study and columns")]
    Seal,
    /// A row whose values are not those of its columns.
    #[error("row {0} does not fit the columns")]
    Row(u64),
}
