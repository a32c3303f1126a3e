//! Tables as Parquet, with the study and the columns' units in the file's own metadata.
//!
//! Whole numbers are unsigned 64-bit, numbers double, texts UTF-8. Two entries of the file's metadata say the rest:
//! `motion-lab.columns`, a list of each column's name, kind, unit and meaning in JSON; and `motion-lab.study`, the
//! study with all it names, from which a row can be run again.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::{Field, Row};
use parquet::schema::types::Type;

use motion_lab_core::one_line::OneLine;

use super::columns::{CellKind, Column};
use super::row::{RowValue, RunRow};
use super::study::Study;

/// The keys of the file's metadata.
const PLAN: &str = "motion-lab.plan";
const COLUMNS: &str = "motion-lab.columns";

/// Rows of a group, which are in memory together.
const GROUP: usize = 65_536;

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
    /// A row whose values are not those of its columns.
    #[error("row {0} does not fit the columns")]
    Row(u64),
}

/// Writes a sweep's rows as Parquet.
pub struct TableWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    kinds: Vec<CellKind>,
    rows: Vec<Vec<RowValue>>,
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
    pub(super) fn of_columns(output: W, columns: &[Column], beside: &[(&str, &str)]) -> Result<Self, TableError> {
        let described = serde_json::to_string(columns).map_err(|error| ParquetError::External(error.into()))?;
        let entries = [(COLUMNS, described.as_str())].into_iter().chain(beside.iter().copied());
        let metadata = entries.map(|(key, value)| KeyValue::new(key.to_owned(), value.to_owned())).collect();
        let properties = WriterProperties::builder().set_key_value_metadata(Some(metadata)).build();
        let writer = SerializedFileWriter::new(output, Arc::new(schema(columns)?), Arc::new(properties))?;
        let kinds = columns.iter().map(|column| column.kind).collect();
        Ok(TableWriter { writer, kinds, rows: Vec::new() })
    }

    /// Adds the next row.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn row(&mut self, row: RunRow) -> Result<(), TableError> {
        self.cells(row.cells)
    }

    /// Adds the next row, of a cell for each column.
    pub(super) fn cells(&mut self, cells: Vec<RowValue>) -> Result<(), TableError> {
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

    /// Writes the rest and returns the output.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn finish(mut self) -> Result<W, TableError> {
        if !self.rows.is_empty() {
            self.group()?;
        }
        Ok(self.writer.into_inner()?)
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

/// A sweep's table, opened for reading.
pub struct TableFile<R: ChunkReader + 'static> {
    reader: SerializedFileReader<R>,
    study: Study,
}

impl<R: ChunkReader + 'static> TableFile<R> {
    /// Opens a table.
    ///
    /// # Errors
    /// [`TableError`] for a file that is no sweep's table.
    pub fn open(input: R) -> Result<Self, TableError> {
        let reader = SerializedFileReader::new(input)?;
        let metadata = reader.metadata().file_metadata().key_value_metadata();
        let entry = metadata.and_then(|entries| entries.iter().find(|entry| entry.key == PLAN));
        let line = entry.and_then(|entry| entry.value.as_deref()).ok_or(TableError::NoSweep(PLAN))?;
        let study = Study::of_line(line).map_err(TableError::Study)?;
        Ok(TableFile { reader, study })
    }

    /// The study.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// The row of this number.
    ///
    /// # Errors
    /// [`TableError`] when there is no such row, or it can't be read.
    pub fn row(&self, number: u64) -> Result<RunRow, TableError> {
        let mut first = 0;
        for i in 0..self.reader.num_row_groups() {
            let group = self.reader.get_row_group(i)?;
            let rows = u64::try_from(group.metadata().num_rows()).unwrap_or(0);
            if number - first < rows {
                let skipped = usize::try_from(number - first).unwrap_or(usize::MAX);
                let row = group.get_row_iter(None)?.nth(skipped);
                return self.read(row.ok_or(TableError::Row(number))??, number);
            }
            first += rows;
        }
        Err(TableError::NoRow { row: number, rows: first })
    }

    /// Calls `see` with every row, in order.
    ///
    /// # Errors
    /// [`TableError`] when a row can't be read, and what `see` returns.
    pub fn each(&self, mut see: impl FnMut(RunRow)) -> Result<(), TableError> {
        for (number, row) in (0..).zip(self.reader.get_row_iter(None)?) {
            see(self.read(row?, number)?);
        }
        Ok(())
    }

    fn read(&self, row: Row, number: u64) -> Result<RunRow, TableError> {
        let columns = self.study.columns();
        let fields = row.into_columns();
        let cell = |(field, column): ((String, Field), &Column)| match (field.1, column.kind) {
            (Field::Null, _) => Some(RowValue::Empty),
            (Field::ULong(n), CellKind::Whole) => Some(RowValue::Whole(n)),
            (Field::Double(x), CellKind::Number) => Some(RowValue::Number(x)),
            (Field::Str(text), CellKind::Text) => Some(RowValue::Text(text)),
            _ => None,
        };
        let fits = fields.len() == columns.len() && fields.iter().zip(columns).all(|((name, _), c)| *name == c.name);
        let cells: Option<Vec<RowValue>> = fields.into_iter().zip(columns).map(cell).collect();
        let cells = cells.filter(|cells| fits && cells.first() == Some(&RowValue::Whole(number)));
        cells.map(|cells| RunRow { row: number, cells }).ok_or(TableError::Row(number))
    }
}
