//! The lines of a text, whatever ends them.

/// The lines with their numbers, from 1. They end in a line feed, with a carriage return before it or not; in a text
/// without line feeds, in a carriage return alone.
pub(crate) fn numbered_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    (1..).zip(text.split_terminator(end).map(str::trim_end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_of_three_ends_gives_the_same_lines() {
        for text in ["a\n\nb", "a\n\nb\n", "a\r\n\r\nb\r\n", "a\r\rb\r", "a \r\r\tb"] {
            let lines: Vec<(usize, &str)> = numbered_lines(text).map(|(line, text)| (line, text.trim())).collect();
            assert_eq!(lines, [(1, "a"), (2, ""), (3, "b")], "{text:?}");
        }
        assert_eq!(numbered_lines("").count(), 0);
    }
}
