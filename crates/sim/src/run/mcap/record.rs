//! Reads MCAP records: an opcode byte, the length of the content as 64 bits, the content. Little-endian.

use std::collections::BTreeMap;

pub use mcap::MAGIC;
pub use mcap::records::op as opcode;

/// The opcode of a seal, in the range reserved for applications: other readers skip it.
pub const SEAL: u8 = 0x80;
/// The opcode of a record of a digest log that holds digests of seconds.
pub const DIGESTS: u8 = 0x81;
/// The opcode of the record that holds the whole run's digest, in the end of a log.
pub const RUN_DIGEST: u8 = 0x82;

/// Reads values from the front of a slice; `None` if there are too few bytes. A length that was read never causes an
/// allocation by itself.
pub struct Cursor<'a>(pub &'a [u8]);

impl<'a> Cursor<'a> {
    pub fn bytes(&mut self, n: u64) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(usize::try_from(n).ok()?)?;
        self.0 = rest;
        Some(taken)
    }

    pub fn u8(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    pub fn u16(&mut self) -> Option<u16> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u16::from_le_bytes(*taken))
    }

    pub fn u32(&mut self) -> Option<u32> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u32::from_le_bytes(*taken))
    }

    pub fn u64(&mut self) -> Option<u64> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*taken))
    }

    pub fn str(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(u64::from(length))?).ok()
    }

    pub fn map(&mut self) -> Option<BTreeMap<String, String>> {
        let length = self.u32()?;
        let mut entries = Cursor(self.bytes(u64::from(length))?);
        let mut map = BTreeMap::new();
        while !entries.0.is_empty() {
            map.insert(entries.str()?.to_owned(), entries.str()?.to_owned());
        }
        Some(map)
    }
}

/// A record in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record<'a> {
    /// Offset of its first byte, the opcode.
    pub offset: usize,
    pub opcode: u8,
    pub content: &'a [u8],
}

impl Record<'_> {
    /// Offset of the next record.
    pub fn end(&self) -> usize {
        self.offset + 9 + self.content.len()
    }
}

/// The record that begins at `offset`; `None` if it runs past the end of `file`.
pub fn record_at(file: &[u8], offset: usize) -> Option<Record<'_>> {
    let mut cursor = Cursor(file.get(offset..)?);
    let opcode = cursor.u8()?;
    let length = cursor.u64()?;
    Some(Record { offset, opcode, content: cursor.bytes(length)? })
}

/// Splits a message's content into its channel and its data.
pub fn message(content: &[u8]) -> Option<(u16, &[u8])> {
    let mut cursor = Cursor(content);
    let channel = cursor.u16()?;
    let _sequence_and_times = cursor.bytes(4 + 8 + 8)?;
    Some((channel, cursor.0))
}

/// Reads the name and the data from an attachment's content.
pub fn attachment(content: &[u8]) -> Option<(&str, &[u8])> {
    let mut cursor = Cursor(content);
    let _times = cursor.bytes(16)?;
    let name = cursor.str()?;
    let _media_type = cursor.str()?;
    let length = cursor.u64()?;
    let data = cursor.bytes(length)?;
    (cursor.0.len() == 4).then_some((name, data))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_that_lie_are_refused_without_allocating() {
        let mut file = vec![opcode::MESSAGE];
        file.extend(u64::MAX.to_le_bytes());
        file.extend([0; 40]);
        assert_eq!(record_at(&file, 0), None);
        file[1..9].copy_from_slice(&41_u64.to_le_bytes());
        assert_eq!(record_at(&file, 0), None, "one byte too many");
        file[1..9].copy_from_slice(&40_u64.to_le_bytes());
        assert_eq!(record_at(&file, 0).map(|r| r.end()), Some(49));
        assert_eq!(record_at(&file, 41), None, "too short for a length");
        assert_eq!(record_at(&file, usize::MAX), None);
        assert_eq!(Cursor(&[0xff, 0xff, 0xff, 0xff, b'a']).str(), None);
        assert_eq!(Cursor(&[1, 0, 0, 0, 0xff]).str(), None, "not UTF-8");
        assert_eq!(Cursor(&[0xff, 0xff, 0xff, 0xff, 1]).map(), None);
        assert_eq!(attachment(&[0; 31]), None);
        assert_eq!(message(&[0; 21]), None);
    }

    #[test]
    fn what_is_written_as_the_format_says_is_read() {
        let mut out = Vec::new();
        let map = BTreeMap::from([("key".to_owned(), "value".to_owned()), ("other".to_owned(), String::new())]);
        // by MCAP's description: an opcode, the content's length, the content; texts and maps after their lengths
        let text = |t: &str| [&(t.len() as u32).to_le_bytes()[..], t.as_bytes()].concat();
        let entries = ["key", "value", "other", ""].map(text).concat();
        let content = [&7_u16.to_le_bytes()[..], &8_u32.to_le_bytes(), &text("\u{e9}"), &29_u32.to_le_bytes()].concat();
        out.push(SEAL);
        out.extend(((content.len() + entries.len()) as u64).to_le_bytes());
        out.extend(content);
        out.extend(entries);
        let record = record_at(&out, 0).unwrap();
        assert_eq!((record.opcode, record.end()), (SEAL, out.len()));
        let mut cursor = Cursor(record.content);
        assert_eq!((cursor.u16(), cursor.u32(), cursor.str(), cursor.map()), (Some(7), Some(8), Some("é"), Some(map)));
        assert!(cursor.0.is_empty());
    }
}
