//! Counts the comments of a world file.

/// Counts the comments of a world file, which printing the world drops. Comment marks within a name do not count.
///
/// ```
/// use motion_lab_core::worlds::comments;
/// assert_eq!(comments("World( // a note\n name: \"http://x\", /* two /* nested */ */ )"), 2);
/// ```
pub fn comments(text: &str) -> usize {
    let mut count = 0;
    let mut rest = text;
    while let Some(at) = rest.find(['/', '"', 'r', '\'']) {
        rest = &rest[at..];
        let length = if rest.starts_with("//") {
            count += 1;
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            count += 1;
            block(rest)
        } else {
            literal(rest).unwrap_or(1)
        };
        rest = rest.get(length..).unwrap_or("");
    }
    count
}

/// Length of a block comment, bytes, including the comments nested in it.
fn block(text: &str) -> usize {
    let (mut depth, mut at) = (1, 2);
    while let Some(found) = text.get(at..).and_then(|t| Some(at + t.find(['/', '*'])?)) {
        let (step, deeper) = match text.get(found..found + 2) {
            Some("/*") => (2, 1),
            Some("*/") => (2, -1),
            _ => (1, 0),
        };
        depth += deeper;
        at = found + step;
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

/// Length, bytes, of the string or character literal at the start of a text; `None` if there is none.
fn literal(text: &str) -> Option<usize> {
    if let Some(raw) = text.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let inner = raw[hashes..].strip_prefix('"')?;
        let end = format!("\"{}", "#".repeat(hashes));
        return Some(inner.find(&end).map_or(text.len(), |at| 2 + hashes + at + end.len()));
    }
    let quote = text.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return Some(at + 1),
            _ => {}
        }
    }
    Some(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worlds::World;

    #[test]
    fn comments_are_told_from_names() {
        for (text, expected) in [
            ("", 0),
            ("// one", 1),
            ("// one // still one\n// two", 2),
            ("/* /* */ // */ x // y", 2),
            ("\"// none /* none \\\" // none\"", 0),
            ("r\"\\\" // one", 1),
            ("r#\"a \" // none\"# // one", 1),
            ("rim '\"' // one", 1),
            ("name: \"r\" /", 0),
            ("/* open", 1),
        ] {
            assert_eq!(comments(text), expected, "{text}");
        }
        let apartment = include_str!("../../../worlds/apartment.ron");
        let lines = apartment.lines().filter(|l| l.trim_start().starts_with("//")).count();
        assert!(comments(apartment) >= lines && lines > 0);
        assert_eq!(comments(&World::apartment().to_ron()), 0, "printed, it has none");
    }
}
