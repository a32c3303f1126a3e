//! `TableSeal`, the digest of a table's values.

use motion_lab_sim::run::Digest;
use xxhash_rust::xxh3::Xxh3;

use crate::batch::csv;
use crate::batch::row::RowValue;

/// The keys of the file's metadata, in the order in which they are sealed.
pub(super) const COLUMNS: &str = "motion-lab.columns";
pub(super) const PLAN: &str = "motion-lab.plan";
/// The key of the seal.
pub(super) const SEAL: &str = "motion-lab.seal";

/// The xxh3-128 hash, as a part's seal, of a table's metadata and then of its rows in order, each as a line of
/// comma-separated values with its end. So it depends on every bit of every value, and not on how Parquet stores them.
pub(super) struct TableSeal(Xxh3);

impl TableSeal {
    /// The seal of no rows, with these entries of the metadata.
    pub fn new<'a>(entries: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut hasher = Xxh3::new();
        for (key, value) in entries {
            hasher.update(format!("{key} {value}\n").as_bytes());
        }
        TableSeal(hasher)
    }

    /// Takes in the next row, of a cell for each column.
    pub fn add(&mut self, cells: &[RowValue]) {
        self.0.update(csv::line(cells.iter().map(RowValue::to_text)).as_bytes());
        self.0.update(b"\n");
    }

    /// The digest so far.
    pub fn digest(&self) -> Digest {
        Digest(self.0.digest128())
    }
}
