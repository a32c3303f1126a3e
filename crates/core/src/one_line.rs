//! `OneLine`, what is said about a file in a line of bounded length, whatever stands in the file.

use std::fmt::{self, Display, Formatter, Write};

/// Largest number of characters of such a line.
const MAX_CHARACTERS: usize = 800;

/// Prints what its value prints, in one line: line breaks become blanks, and dots stand for what is too long.
#[derive(Clone, Copy, Debug)]
pub struct OneLine<T>(pub T);

impl<T: Display> Display for OneLine<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut line = CutLine { to: f, room: MAX_CHARACTERS, is_cut: false };
        match write!(line, "{}", self.0) {
            Err(_) if line.is_cut => f.write_str("..."),
            written => written,
        }
    }
}

/// Somebody's words between quotes, as such a line.
pub fn quoted(words: &str) -> String {
    OneLine(format_args!("{words:?}")).to_string()
}

/// Takes characters as long as there is room.
struct CutLine<'a, 'b> {
    to: &'a mut Formatter<'b>,
    room: usize,
    is_cut: bool,
}

impl Write for CutLine<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for letter in text.chars() {
            self.is_cut = self.room == 0;
            if self.is_cut {
                return Err(fmt::Error);
            }
            self.room -= 1;
            self.to.write_char(if matches!(letter, '\n' | '\r') { ' ' } else { letter })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_where_it_is_too_long_and_has_no_line_breaks() {
        assert_eq!(OneLine("a\nb\r\nc").to_string(), "a b  c");
        let longest = "\u{e9}".repeat(MAX_CHARACTERS);
        assert_eq!(OneLine(&longest).to_string(), longest);
        assert_eq!(OneLine(format_args!("{longest}{}", "x".repeat(1 << 20))).to_string(), longest + "...");
        assert_eq!(quoted("a\nb"), r#""a\nb""#);
    }
}
