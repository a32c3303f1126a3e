//! The journal of a shard: its finished rows, in the order in which they were finished, until the part is written.

use std::fs::{File, OpenOptions, TryLockError, remove_file};
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::batch::{Column, PartHead, PartWriter, sealed_line, unsealed_line};

use crate::cli::Failure;
use crate::cli::support::output::ReportedFile;
use crate::cli::support::target::Target;

/// The journal of a shard. A row that it holds need not be run again, also after a crash.
pub struct Journal {
    path: PathBuf,
    file: File,
    head: PartHead,
    /// The bytes that the journal has.
    end: u64,
    /// For each row of the shard, the first byte of its line; 0 for one that is not there.
    places: Vec<u64>,
}

/// The length of a seal before a row's line, bytes: the hash and a blank.
const SEAL: u64 = 17;

impl Journal {
    /// Opens the journal at `path`, or begins it. A line that a crash cut short is left out, with all behind it.
    pub fn open(path: &Path, head: PartHead, columns: &[Column]) -> Result<Self, Failure> {
        let failed = |error: io::Error| Failure::output(path, &error);
        let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path).map_err(failed)?;
        // on systems without locks two processes of one shard are not told from one
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(Failure::usage(
                format!("{}: another process is at work on this part", path.display()),
                "Wait for it, or name another folder.",
            ));
        }
        let count = usize::try_from(head.rows.end - head.rows.start).unwrap_or(usize::MAX);
        let mut journal = Journal { path: path.to_owned(), file, head, end: 0, places: vec![0; count] };
        journal.read(columns).map_err(failed)?.map_err(|()| {
            Failure::input(
                format!("{}: it is of another study", path.display()),
                "Name another folder with -o, or take the journal away.",
            )
        })?;
        Ok(journal)
    }

    /// Reads what is there. `Err(())` for the journal of another study.
    fn read(&mut self, columns: &[Column]) -> io::Result<Result<(), ()>> {
        let head = self.head.to_text(columns);
        let mut there = Vec::new();
        (&self.file).take(head.len() as u64).read_to_end(&mut there)?;
        if there != head.as_bytes() {
            if !head.as_bytes().starts_with(&there) {
                return Ok(Err(()));
            }
            self.file.set_len(0)?;
            self.file.seek(SeekFrom::Start(0))?;
            self.file.write_all(head.as_bytes())?;
            self.end = head.len() as u64;
            return Ok(Ok(()));
        }
        self.end = head.len() as u64;
        let mut input = BufReader::new(&self.file);
        let mut bytes = Vec::new();
        loop {
            bytes.clear();
            input.read_until(b'\n', &mut bytes)?;
            let sealed = bytes.strip_suffix(b"\n").and_then(|sealed| std::str::from_utf8(sealed).ok());
            let Some((row, _)) = sealed.and_then(|sealed| unsealed_line(sealed, columns)) else { break };
            let Some(i) = self.index(row) else { break };
            self.places[i] = self.end + SEAL;
            self.end += bytes.len() as u64;
        }
        self.file.set_len(self.end)?;
        self.file.seek(SeekFrom::Start(self.end))?;
        Ok(Ok(()))
    }

    fn index(&self, row: u64) -> Option<usize> {
        let Range { start, end } = self.head.rows;
        (start..end).contains(&row).then(|| usize::try_from(row - start).ok()).flatten()
    }

    /// The rows that it does not hold yet.
    pub fn missing(&self) -> Vec<u64> {
        let rows = self.head.rows.clone().zip(&self.places);
        rows.filter(|(_, place)| **place == 0).map(|(row, _)| row).collect()
    }

    /// Calls `see` with the line of every row that it holds, in the order of the rows.
    pub fn each(&self, mut see: impl FnMut(&str)) -> Result<(), Failure> {
        let failed = |error: io::Error| Failure::output(&self.path, &error);
        let mut input = BufReader::new(&self.file);
        let (mut at, mut line) = (input.stream_position().map_err(failed)?, String::new());
        for &place in self.places.iter().filter(|place| **place > 0) {
            // rows are near each other, so that most of them are in the buffer
            input.seek_relative(place.wrapping_sub(at).cast_signed()).map_err(failed)?;
            line.clear();
            at = place + input.read_line(&mut line).map_err(failed)? as u64;
            see(line.trim_end_matches('\n'));
        }
        (&self.file).seek(SeekFrom::Start(self.end)).map_err(failed)?;
        Ok(())
    }

    /// Adds a row with its line.
    pub fn add(&mut self, row: u64, line: &str) -> Result<(), Failure> {
        let failed = |error: io::Error| Failure::output(&self.path, &error);
        let sealed = sealed_line(line);
        self.file.write_all(sealed.as_bytes()).map_err(failed)?;
        let Some(i) = self.index(row) else { return Ok(()) };
        self.places[i] = self.end + SEAL;
        self.end += sealed.len() as u64;
        Ok(())
    }

    /// Writes everything so far to the disk.
    pub fn sync(&self) -> Result<(), Failure> {
        self.file.sync_data().map_err(|error| Failure::output(&self.path, &error))
    }

    /// Writes the part, whole or not at all, and takes the journal away. All rows must be there.
    pub fn finish(self, part: &Target, columns: &[Column]) -> Result<(), Failure> {
        let failed = |error: io::Error| Failure::output(part.path(), &error);
        if self.places.contains(&0) {
            return Err(failed(ErrorKind::UnexpectedEof.into()));
        }
        let mut writer = PartWriter::new(ReportedFile::create(part)?, &self.head, columns).map_err(failed)?;
        let mut written = Ok(());
        self.each(|line| {
            if written.is_ok() {
                written = writer.row(line);
            }
        })?;
        written.map_err(failed)?;
        writer.finish().map_err(failed)?.commit()?;
        // the part holds all of it; a journal that stays is of no harm
        let _ = remove_file(&self.path);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::batch::{Study, StudyFile};
    use motion_lab_core::worlds::World;

    use super::*;

    fn study() -> Study {
        let text = "Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(0, 4))])";
        let worlds = [("lot".to_owned(), World::lot())].into();
        StudyFile::parse("study.ron", text).unwrap().with(&worlds, &[].into()).unwrap()
    }

    /// A line that a crash cut short must go, or the next crash would lose what came after it.
    #[test]
    fn a_journal_goes_on_after_every_crash() {
        let (study, folder) = (study(), tempfile::tempdir().unwrap());
        let path = folder.path().join("part.journal");
        let open = || Journal::open(&path, PartHead::new(&study, 1..4), study.columns());
        for (row, missing) in [(2, vec![1, 3]), (3, vec![1]), (1, vec![])] {
            let mut journal = open().unwrap();
            journal.add(row, &study.failed(row, "why").to_line()).unwrap();
            assert_eq!(journal.missing(), missing);
            drop(journal);
            let mut file = OpenOptions::new().append(true).open(&path).unwrap();
            file.write_all(b"0123456789abcdef 1,1,12").unwrap();
            drop(file);
            assert_eq!(open().unwrap().missing(), missing);
        }
        let held = open().unwrap();
        let second = open().err().map(|failure| failure.to_string()).unwrap_or_default();
        assert!(second.contains("another process is at work"), "{second}");
        let part = Target::of(&folder.path().join("part.sweep")).unwrap();
        held.finish(&part, study.columns()).unwrap();
        assert!(!path.exists() && folder.path().join("part.sweep").exists());
    }
}
