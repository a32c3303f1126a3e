//! `TableWriter`, which writes rows as Parquet and seals them.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::error::TableError;
use super::seal::{COLUMNS, HashedBytes, PAGES, PLAN, SEAL, TableSeal};
use crate::batch::columns::{CellKind, Column};
use crate::batch::row::{RowValue, RunRow};
use crate::batch::study::Study;

/// Rows of a group, which are in memory together.
const GROUP: usize = 65_536;

/// Writes a sweep's rows as Parquet, and a digest of all it says into the file's metadata.
pub struct TableWriter<W: Write + Send> {
    writer: SerializedFileWriter<HashedBytes<W>>,
    kinds: Vec<CellKind>,
    rows: Vec<Vec<RowValue>>,
    seal: TableSeal,
}

fn schema(columns: &[Column]) -> Result<Type, ParquetError> {
    let field = |column: &Column| {
        let (physical, logical) = match column.kind {
            CellKind::Whole => (PhysicalType::INT64, Some(LogicalType::integer(64, false))),
            CellKind::Number => (PhysicalType::DOUBLE, None),
            CellKind::Text => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(&column.name, physical).with_logical_type(logical);
        field.with_repetition(Repetition::OPTIONAL).build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    Type::group_type_builder("sweep").with_fields(fields).build()
}

impl<W: Write + Send> TableWriter<W> {
    /// Begins a table of the rows of a study.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn new(output: W, study: &Study) -> Result<Self, TableError> {
        Self::of_columns(output, study.columns(), &[(PLAN, study.line())])
    }

    /// Begins a table of these columns, with entries of the file's metadata beside theirs.
    pub(in crate::batch) fn of_columns(
        output: W,
        columns: &[Column],
        beside: &[(&str, &str)],
    ) -> Result<Self, TableError> {
        let described = serde_json::to_string(columns).map_err(|error| ParquetError::External(error.into()))?;
        let entries = [(COLUMNS, described.as_str())].into_iter().chain(beside.iter().copied());
        let seal = TableSeal::new(entries.clone());
        let metadata = entries.map(|(key, value)| KeyValue::new(key.to_owned(), value.to_owned())).collect();
        let properties = WriterProperties::builder().set_key_value_metadata(Some(metadata)).build();
        let writer =
            SerializedFileWriter::new(HashedBytes::new(output), Arc::new(schema(columns)?), Arc::new(properties))?;
        let kinds = columns.iter().map(|column| column.kind).collect();
        Ok(TableWriter { writer, kinds, rows: Vec::new(), seal })
    }

    /// Adds the next row.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn row(&mut self, row: RunRow) -> Result<(), TableError> {
        self.cells(row.cells)
    }

    /// Adds the next row, of a cell for each column.
    pub(in crate::batch) fn cells(&mut self, cells: Vec<RowValue>) -> Result<(), TableError> {
        self.seal.add(&cells);
        self.rows.push(cells);
        if self.rows.len() == GROUP { self.group() } else { Ok(()) }
    }

    fn group(&mut self) -> Result<(), TableError> {
        let mut group = self.writer.next_row_group()?;
        for (i, kind) in self.kinds.iter().enumerate() {
            let cells: Vec<&RowValue> =
                self.rows.iter().map(|cells| cells.get(i).unwrap_or(&RowValue::Empty)).collect();
            column(&mut group, *kind, &cells)?;
        }
        group.close()?;
        self.rows.clear();
        Ok(())
    }

    /// Writes the rest and the seal, and returns the output.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn finish(mut self) -> Result<W, TableError> {
        if !self.rows.is_empty() {
            self.group()?;
        }
        let seal = self.seal.digest().to_string();
        self.writer.flush().map_err(|error| ParquetError::External(error.into()))?;
        let pages = self.writer.inner().said();
        for (key, value) in [(SEAL, seal), (PAGES, pages)] {
            self.writer.append_key_value_metadata(KeyValue::new(key.to_owned(), value));
        }
        Ok(self.writer.into_inner()?.bytes)
    }
}

/// Writes the next column of a group.
fn column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    kind: CellKind,
    cells: &[&RowValue],
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else { return Ok(()) };
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(**cell != RowValue::Empty)).collect();
    match kind {
        CellKind::Whole => {
            // the bits of an unsigned number; the schema says so
            let whole = |cell: &&RowValue| if let RowValue::Whole(n) = cell { Some(n.cast_signed()) } else { None };
            let values: Vec<i64> = cells.iter().filter_map(whole).collect();
            column.typed::<Int64Type>().write_batch(&values, Some(&levels), None)?;
        }
        CellKind::Number => {
            let number = |cell: &&RowValue| if let RowValue::Number(x) = cell { Some(*x) } else { None };
            let values: Vec<f64> = cells.iter().filter_map(number).collect();
            column.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
        }
        CellKind::Text => {
            let text =
                |cell: &&RowValue| if let RowValue::Text(text) = cell { Some(text.as_str().into()) } else { None };
            let values: Vec<ByteArray> = cells.iter().filter_map(text).collect();
            column.typed::<ByteArrayType>().write_batch(&values, Some(&levels), None)?;
        }
    }
    column.close()
}
