//! Lines of comma-separated values.

/// A line of these cells. A cell with a comma or a quote stands in quotes.
pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    let quoted = |cell: String| {
        if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
    };
    cells.into_iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// The cells of a line; `None` where a quote is open or stands in the middle of a cell.
pub(super) fn cells(line: &str) -> Option<Vec<String>> {
    let mut cells = Vec::new();
    let mut rest = line;
    loop {
        let (cell, after) = match rest.strip_prefix('"') {
            None => {
                let end = rest.find(',').unwrap_or(rest.len());
                (rest[..end].to_owned(), &rest[end..])
            }
            Some(quoted) => unquoted(quoted)?,
        };
        if cell.contains('"') && !rest.starts_with('"') {
            return None;
        }
        cells.push(cell);
        match after.strip_prefix(',') {
            Some(after) => rest = after,
            None if after.is_empty() => return Some(cells),
            None => return None,
        }
    }
}

/// A cell after its opening quote, and what follows its closing one.
fn unquoted(text: &str) -> Option<(String, &str)> {
    let (mut cell, mut rest) = (String::new(), text);
    loop {
        let end = rest.find('"')?;
        cell.push_str(&rest[..end]);
        rest = &rest[end + 1..];
        match rest.strip_prefix('"') {
            Some(after) => {
                cell.push('"');
                rest = after;
            }
            None => return Some((cell, rest)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_come_back_and_broken_lines_do_not() {
        let rows = [vec!["", "a", "1.5"], vec!["a,b", "say \"so\"", ""], vec!["\"", "\"\"", ","], vec![""]];
        for row in rows {
            let row: Vec<String> = row.into_iter().map(str::to_owned).collect();
            assert_eq!(cells(&line(row.clone())), Some(row));
        }
        assert_eq!(line(["a,b".to_owned(), "\"".to_owned(), "c".to_owned()]), "\"a,b\",\"\"\"\",c");
        for broken in ["\"a", "a\"b", "\"a\"b,c"] {
            assert_eq!(cells(broken), None, "{broken}");
        }
    }
}
