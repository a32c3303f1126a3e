//! `TableFile`, a sweep's table that is read, and `VerifiedTable`, what is known of any that was proven.

use std::io::{self, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};

use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaDataReader;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

use super::error::TableError;
use super::seal::{COLUMNS, HashedBytes, PAGES, PLAN, SEAL, TableSeal};
use crate::batch::columns::{CellKind, Column};
use crate::batch::row::{RowValue, RunRow};
use crate::batch::study::Study;
use motion_lab_sim::run::Digest;

/// A table's rows, its columns, and what its metadata says.
struct SealedRows<R: ChunkReader + 'static> {
    reader: SerializedFileReader<R>,
    columns: Vec<Column>,
    plan: Option<String>,
    seal: TableSeal,
    sealed: Digest,
}

/// What reading a table gives. The crate that reads Parquet panics where metadata that was changed sends it to bytes
/// that are no page.
fn whole<T>(read: impl FnOnce() -> T) -> Result<T, TableError> {
    catch_unwind(AssertUnwindSafe(read)).map_err(|_| TableError::Seal)
}

/// The cell of a field; `None` for a field that no writer of ours makes of its column.
fn cell(field: Field, kind: CellKind) -> Option<RowValue> {
    match (field, kind) {
        (Field::Null, _) => Some(RowValue::Empty),
        (Field::ULong(n), CellKind::Whole) => Some(RowValue::Whole(n)),
        (Field::Double(x), CellKind::Number) => Some(RowValue::Number(x)),
        (Field::Str(text), CellKind::Text) if !text.is_empty() => Some(RowValue::Text(text)),
        _ => None,
    }
}

impl<R: ChunkReader + 'static> SealedRows<R> {
    /// Opens a table whose pages are those that were written: what was changed in them is found before anything of it
    /// is decoded.
    fn open(input: R) -> Result<Self, TableError> {
        whole(|| Self::open_whole(input))?
    }

    fn open_whole(input: R) -> Result<Self, TableError> {
        let metadata = ParquetMetaDataReader::new().parse_and_finish(&input)?;
        let metadata = metadata.file_metadata().key_value_metadata();
        let entry = |key: &str| {
            let entry = metadata.and_then(|entries| entries.iter().find(|entry| entry.key == key));
            entry.and_then(|entry| entry.value.as_deref())
        };
        let described = entry(COLUMNS).ok_or(TableError::NoSweep(COLUMNS))?;
        let plan = entry(PLAN);
        let sealed = entry(SEAL).ok_or(TableError::NoSeal)?.parse().map_err(|_| TableError::Seal)?;
        let seal = TableSeal::new([(COLUMNS, described)].into_iter().chain(plan.map(|plan| (PLAN, plan))));
        let columns = serde_json::from_str(described).map_err(|_| TableError::Seal)?;
        let plan = plan.map(str::to_owned);
        let pages = entry(PAGES).ok_or(TableError::NoSeal)?;
        let count = pages.split(' ').nth(1).and_then(|count| count.parse().ok()).ok_or(TableError::Seal)?;
        let mut hashed = HashedBytes::new(io::sink());
        io::copy(&mut input.get_read(0)?.take(count), &mut hashed)
            .map_err(|error| ParquetError::External(error.into()))?;
        if hashed.said() != pages {
            return Err(TableError::Seal);
        }
        let reader = SerializedFileReader::new(input)?;
        Ok(SealedRows { reader, columns, plan, seal, sealed })
    }

    /// Calls `see` with the cells of every row, in order, then proves the seal. Returns the number of rows.
    fn each(mut self, mut see: impl FnMut(u64, Vec<RowValue>) -> Result<(), TableError>) -> Result<u64, TableError> {
        let mut number = 0;
        let mut rows = whole(|| self.reader.get_row_iter(None))??;
        while let Some(row) = whole(|| rows.next())? {
            let cells = Self::cells(row?, &self.columns).ok_or(TableError::Row(number))?;
            self.seal.add(&cells);
            see(number, cells)?;
            number += 1;
        }
        if self.seal.digest() == self.sealed { Ok(number) } else { Err(TableError::Seal) }
    }

    fn cells(row: Row, columns: &[Column]) -> Option<Vec<RowValue>> {
        let fields = row.into_columns();
        let fits = fields.len() == columns.len() && fields.iter().zip(columns).all(|((name, _), c)| *name == c.name);
        let cells = fields.into_iter().zip(columns).map(|((_, field), column)| cell(field, column.kind));
        if fits { cells.collect() } else { None }
    }
}

/// What is known of a table that was read to its end, and whose seal is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerifiedTable {
    /// The number of rows.
    pub rows: u64,
    /// The digest of its rows, its study and its columns.
    pub seal: Digest,
}

impl VerifiedTable {
    /// Reads a table of a sweep or of compared planners to its end, and proves its seal.
    ///
    /// # Errors
    /// [`TableError`] for another file, and for one in which any value was changed.
    pub fn of(input: impl ChunkReader + 'static) -> Result<Self, TableError> {
        let rows = SealedRows::open(input)?;
        let seal = rows.sealed;
        Ok(VerifiedTable { rows: rows.each(|_, _| Ok(()))?, seal })
    }
}

/// A sweep's table, opened for reading.
pub struct TableFile<R: ChunkReader + 'static> {
    rows: SealedRows<R>,
    study: Study,
}

impl<R: ChunkReader + 'static> TableFile<R> {
    /// Opens a table.
    ///
    /// # Errors
    /// [`TableError`] for a file that is no sweep's table.
    pub fn open(input: R) -> Result<Self, TableError> {
        let rows = SealedRows::open(input)?;
        let line = rows.plan.as_deref().ok_or(TableError::NoSweep(PLAN))?;
        let study = Study::of_line(line).map_err(TableError::Study)?;
        let is_own = |(a, b): (&Column, &Column)| a.name == b.name && a.kind == b.kind;
        if rows.columns.len() != study.columns().len() || !rows.columns.iter().zip(study.columns()).all(is_own) {
            return Err(TableError::Columns);
        }
        Ok(TableFile { rows, study })
    }

    /// The study.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// The row of this number. The table is read to its end, where the seal proves every row.
    ///
    /// # Errors
    /// [`TableError`] when there is no such row, or the table is damaged.
    pub fn row(self, number: u64) -> Result<RunRow, TableError> {
        let mut found = None;
        let rows = self.each(|row| found = found.take().or((row.row == number).then_some(row)))?;
        found.ok_or(TableError::NoRow { row: number, rows })
    }

    /// Calls `see` with every row, in order, and returns their number. What `see` gets is proven only at the end, where
    /// the seal is compared.
    ///
    /// # Errors
    /// [`TableError`] when a row can't be read, and at the end when the table is damaged.
    pub fn each(self, mut see: impl FnMut(RunRow)) -> Result<u64, TableError> {
        self.rows.each(|row, cells| {
            if cells.first() != Some(&RowValue::Whole(row)) {
                return Err(TableError::Row(row));
            }
            see(RunRow { row, cells });
            Ok(())
        })
    }
}
