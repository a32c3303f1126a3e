//! The log in a page: what *Save as page* of the lab writes holds the run and the simulator.

use std::borrow::Cow;

use super::LogError;

/// What stands before a page's log, which is base64 up to the next `<`.
const OPENING: &str = r#"<script type="text/plain" id="bytes">"#;

/// The bytes of a log: the file itself, or what a page holds.
///
/// # Errors
/// [`LogError::Page`] for any other page.
pub fn log_bytes(file: &[u8]) -> Result<Cow<'_, [u8]>, LogError> {
    let begins = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file).trim_ascii_start();
    // a log begins with a byte that no text has
    if !begins.starts_with(b"<") { Ok(Cow::Borrowed(file)) } else { in_page(begins).map(Cow::Owned) }
}

/// The log in a page's text.
fn in_page(page: &[u8]) -> Result<Vec<u8>, LogError> {
    let text = String::from_utf8_lossy(page);
    let held = text.split_once(OPENING).and_then(|(_, rest)| rest.split_once('<'));
    let (held, _) = held.ok_or(LogError::Page("it holds no run"))?;
    unpacked(held)
}

/// The bytes behind a page's letters. Those of an early page were not compressed.
#[cfg(not(target_family = "wasm"))]
fn unpacked(letters: &str) -> Result<Vec<u8>, LogError> {
    use base64::prelude::{BASE64_STANDARD, Engine};
    use std::io::Read;

    /// Largest log that a page unpacks to, bytes: its few bytes may stand for any number of others. The greatest run
    /// that the lab's page saves is far smaller.
    const MAX_UNPACKED: u64 = 256 << 20;

    let packed =
        BASE64_STANDARD.decode(letters).map_err(|_| LogError::Page("its run is not base64: it was changed"))?;
    if !packed.starts_with(&[0x1f, 0x8b]) {
        return Ok(packed);
    }
    let mut bytes = Vec::new();
    let read = flate2::read::GzDecoder::new(&packed[..]).take(MAX_UNPACKED + 1).read_to_end(&mut bytes);
    read.map_err(|_| LogError::Page("its run can't be unpacked: it was cut or changed"))?;
    if bytes.len() as u64 > MAX_UNPACKED {
        Err(LogError::Page("its run unpacks to more than 256 MiB"))
    } else {
        Ok(bytes)
    }
}

/// In a browser the page around has unpacked it.
#[cfg(target_family = "wasm")]
fn unpacked(_: &str) -> Result<Vec<u8>, LogError> {
    Err(LogError::Page("the browser opens it, if it is named .html"))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use base64::prelude::{BASE64_STANDARD, Engine};
    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn page(letters: &str) -> Vec<u8> {
        format!("\n<!doctype html><p>5 < 6</p>{OPENING}{letters}</script><script>1</script>").into_bytes()
    }

    fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut writer = GzEncoder::new(Vec::new(), Compression::fast());
        writer.write_all(bytes).unwrap();
        writer.finish().unwrap()
    }

    #[test]
    fn a_page_gives_its_log_packed_or_not_and_any_other_file_itself() {
        let log = b"\x89MCAP and so on".as_slice();
        assert_eq!(*log_bytes(log).unwrap(), *log);
        assert_eq!(*log_bytes(b"").unwrap(), *b"");
        for held in [log.to_vec(), gzip(log)] {
            let page = page(&BASE64_STANDARD.encode(held));
            assert_eq!(*log_bytes(&page).unwrap(), *log);
            // as some editors save it
            assert_eq!(*log_bytes(&[b"\xef\xbb\xbf", &page[1..]].concat()).unwrap(), *log);
        }
    }

    #[test]
    fn a_page_that_can_not_be_read_says_why() {
        let packed = gzip(&[7; 1000]);
        let mut changed = packed.clone();
        let sum = changed.len() - 8;
        changed[sum] ^= 1;
        let letters = |bytes: &[u8]| page(&BASE64_STANDARD.encode(bytes));
        // 256 MiB and a byte, in less than two
        let bomb = gzip(&vec![0; (256 << 20) + 1]);
        assert!(bomb.len() < 2 << 20, "{}", bomb.len());
        for (page, why) in [
            (b"<html>a report</html>".to_vec(), "it holds no run"),
            (page("MC&AP"), "its run is not base64: it was changed"),
            (letters(&packed[..packed.len() - 9]), "its run can't be unpacked: it was cut or changed"),
            (letters(&changed), "its run can't be unpacked: it was cut or changed"),
            (letters(&bomb), "its run unpacks to more than 256 MiB"),
        ] {
            assert_eq!(log_bytes(&page).unwrap_err().to_string(), format!("this is a page, and {why}"));
        }
    }
}
