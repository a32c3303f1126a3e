//! Lines of a text of any length, each of limited size.

use std::io::{self, BufRead, BufReader, Read};

/// Largest length of a line, bytes.
pub const MAX_LINE: u64 = 1 << 20;

/// A line, or what is wrong with it.
pub struct InputLine {
    /// Its number, from 1.
    pub number: u64,
    /// The text without its end, or why there is none.
    pub text: Result<String, String>,
}

/// Reads line by line, holding one at a time.
pub struct Lines<R> {
    reader: BufReader<R>,
    number: u64,
}

impl<R: Read> Lines<R> {
    /// The lines of this reader.
    pub fn new(reader: R) -> Self {
        Lines { reader: BufReader::with_capacity(1 << 16, reader), number: 0 }
    }

    /// Whether the next line may not have arrived yet.
    pub fn would_wait(&self) -> bool {
        !self.reader.buffer().contains(&b'\n')
    }

    /// The next line; `None` at the end.
    pub fn next_line(&mut self) -> io::Result<Option<InputLine>> {
        let mut bytes = Vec::new();
        self.reader.by_ref().take(MAX_LINE + 1).read_until(b'\n', &mut bytes)?;
        if bytes.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        let text = if bytes.len() as u64 > MAX_LINE {
            if bytes.last() != Some(&b'\n') {
                self.skip_rest()?;
            }
            Err(format!("longer than {MAX_LINE} bytes"))
        } else {
            String::from_utf8(bytes)
                .map_err(|e| format!("not UTF-8 from byte {} of the line on", e.utf8_error().valid_up_to()))
        };
        Ok(Some(InputLine { number: self.number, text }))
    }

    fn skip_rest(&mut self) -> io::Result<()> {
        loop {
            let buffer = self.reader.fill_buf()?;
            let (used, found) = match buffer.iter().position(|&b| b == b'\n') {
                Some(at) => (at + 1, true),
                None => (buffer.len(), buffer.is_empty()),
            };
            self.reader.consume(used);
            if found {
                return Ok(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_line_leaves_the_next_one_whole() {
        let mut text = vec![b'7'; 3 * MAX_LINE as usize];
        text.extend(b"\n[1]\n\xff\xfe\n\n[2]");
        let mut lines = Lines::new(&text[..]);
        let mut read = Vec::new();
        while let Some(line) = lines.next_line().unwrap() {
            read.push((line.number, line.text.map_err(|e| e.split(' ').next().unwrap().to_owned())));
        }
        let ok = |s: &str| Ok(s.to_owned());
        let expected =
            [(1, Err("longer".into())), (2, ok("[1]\n")), (3, Err("not".into())), (4, ok("\n")), (5, ok("[2]"))];
        assert_eq!(read, expected);
    }
}
