//! `TableSeal`, the digest of a table's values.

use std::io::{self, Write};

use motion_lab_sim::run::Digest;
use xxhash_rust::xxh3::Xxh3;

use crate::batch::csv;
use crate::batch::row::RowValue;

/// The keys of the file's metadata, in the order in which they are sealed.
pub(super) const COLUMNS: &str = "motion-lab.columns";
pub(super) const PLAN: &str = "motion-lab.plan";
/// The key of the seal.
pub(super) const SEAL: &str = "motion-lab.seal";
/// The key of the digest of the file's bytes before its metadata, and of their number.
pub(super) const PAGES: &str = "motion-lab.pages";

/// Bytes that are hashed on their way.
pub(super) struct HashedBytes<T> {
    /// Where they come from or go to.
    pub bytes: T,
    hasher: Xxh3,
    count: u64,
}

impl<T> HashedBytes<T> {
    /// None yet.
    pub fn new(bytes: T) -> Self {
        HashedBytes { bytes, hasher: Xxh3::new(), count: 0 }
    }

    /// The digest of those so far, and their number, as the metadata has them.
    pub fn said(&self) -> String {
        format!("{} {}", Digest(self.hasher.digest128()), self.count)
    }
}

impl<T: Write> Write for HashedBytes<T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.bytes.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        self.count += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.bytes.flush()
    }
}

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
