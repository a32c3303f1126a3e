//! Parts of sweeps: a study, rows, and a seal, which is made anew so that what lies behind it is reached.
//!
//! A wrong reader believes rows that are not the study's, or takes a part that was changed for a whole one.

use std::io::Cursor;

use super::{plan, refusal};
use motion_lab::batch::{PartError, PartReader, PartWriter, RunRow, sealed_line, unsealed_line};
use xxhash_rust::xxh3::xxh3_128;

/// Reads a part as it is, and sealed anew.
pub fn check(data: &[u8]) -> bool {
    if plan::robots_of_warehouse(&String::from_utf8_lossy(data)) > plan::MAX_ROBOTS {
        return false;
    }
    if let Err(error) = rows(data) {
        refusal::check(&error, "");
    }
    // what stands before the last line, with a seal of its own
    let lines = data.strip_suffix(b"\n").unwrap_or(data);
    let end = lines.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let mut part = data[..end].to_vec();
    part.extend(format!("seal {:032x}\n", xxh3_128(&part)).bytes());
    match rows(&part) {
        Ok(written) => {
            assert_eq!(String::from_utf8_lossy(&written), String::from_utf8_lossy(&part), "written again");
            changed(&part);
            true
        }
        Err(error) => {
            refusal::check(&error, "");
            false
        }
    }
}

/// Reads a part to its end, and writes what was read again.
fn rows(part: &[u8]) -> Result<Vec<u8>, PartError> {
    let mut reader = PartReader::new(Cursor::new(part))?;
    plan::same(reader.study());
    let columns = reader.study().columns().to_vec();
    let mut writer = PartWriter::new(Vec::new(), reader.head(), &columns)?;
    let mut count = 0;
    while let Some((row, line)) = reader.row()? {
        assert_eq!(RunRow::of_line(&row.to_line(), &columns).as_ref(), Some(&row), "{line}");
        let sealed = sealed_line(&line);
        assert_eq!(unsealed_line(sealed.trim_end_matches('\n'), &columns), Some((row.row, &*line)));
        writer.row(&line)?;
        count += 1;
    }
    assert_eq!(count, reader.head().rows.end - reader.head().rows.start);
    Ok(writer.finish()?)
}

/// A bit that was changed anywhere is found.
fn changed(part: &[u8]) {
    let mut forged = part.to_vec();
    let hash = xxh3_128(part) as usize;
    forged[hash % part.len()] ^= 1 << (hash >> 61);
    assert!(rows(&forged).is_err(), "byte {} was changed", hash % part.len());
    assert!(rows(&part[..hash % part.len()]).is_err(), "{} bytes are left", hash % part.len());
}
