//! Where in a text something stands: what the errors of every file name.

/// Where `part`, a slice of `text`, begins in it, bytes. The end of the text for a slice of another one.
pub fn offset_of(text: &str, part: &str) -> usize {
    (part.as_ptr() as usize).saturating_sub(text.as_ptr() as usize).min(text.len())
}

/// The number of line ends between two bytes.
pub fn line_ends(text: &str, from: usize, to: usize) -> usize {
    text.as_bytes().get(from..to).map_or(0, |bytes| bytes.iter().filter(|&&b| b == b'\n').count())
}

/// The line of a byte, from 1.
pub fn line_at(text: &str, offset: usize) -> usize {
    1 + line_ends(text, 0, offset)
}

/// The column of a byte, from 1, in characters.
fn column_at(text: &str, offset: usize) -> usize {
    text.get(..offset).unwrap_or("").chars().rev().take_while(|&c| c != '\n').count() + 1
}

/// A position in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
}

/// The position of a byte.
pub fn position_at(text: &str, offset: usize) -> Position {
    Position { line: line_at(text, offset), column: column_at(text, offset) }
}

/// The byte at a position: the end of its line for a column beyond it, the end of the text for a line beyond it.
pub fn byte_at(text: &str, at: Position) -> usize {
    let before: usize = text.split_inclusive('\n').take(at.line.saturating_sub(1)).map(str::len).sum();
    let line = text[before..].split('\n').next().unwrap_or("");
    before + line.chars().take(at.column.saturating_sub(1)).map(char::len_utf8).sum::<usize>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let text = "World(\n  \u{e9}: 1,\n)";
        let part = &text[text.find('1').unwrap()..];
        assert_eq!(offset_of(text, part), 13);
        assert_eq!(position_at(text, 13), Position { line: 2, column: 6 });
        assert_eq!(position_at(text, 0), Position { line: 1, column: 1 });
        for (byte, _) in text.char_indices() {
            assert_eq!(byte_at(text, position_at(text, byte)), byte);
        }
        let byte = |line, column| byte_at(text, Position { line, column });
        assert_eq!([byte(1, 99), byte(9, 1), byte(3, 2)], [6, text.len(), text.len()]);
        assert_eq!(line_ends(text, 7, text.len()), 1);
        let far = String::from("elsewhere");
        assert!(offset_of(text, &far) <= text.len());
    }
}
