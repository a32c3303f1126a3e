//! Help and errors of the command line, in lines that fit the terminal.

use std::io::{self, IsTerminal, Write};
use std::process::{Command, Stdio};

use clap::error::Error;

/// The longest line that a wide terminal gets, columns: longer ones are hard to read.
const MAX_WIDTH: usize = 100;
/// How far what goes on in a next line is indented beside the line's own indentation, columns.
const HANGING: usize = 4;

/// Prints the help, the version or the error, and ends the program as clap would.
pub fn exit(error: &Error) -> ! {
    let Some(width) = width(error.use_stderr()) else { error.exit() };
    let text = error.render();
    let is_painted = if error.use_stderr() { io::stderr().is_terminal() } else { io::stdout().is_terminal() };
    let is_painted = is_painted && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let text = if is_painted { text.ansi().to_string() } else { text.to_string() };
    let text = fitted(&text, width);
    // a reader that has gone away is no error
    let _ = if error.use_stderr() {
        io::stderr().lock().write_all(text.as_bytes())
    } else {
        io::stdout().lock().write_all(text.as_bytes())
    };
    std::process::exit(error.exit_code())
}

/// The columns of the terminal that the text goes to: what the variable `COLUMNS` says, else the terminal itself.
/// `None` where neither says anything; then nobody knows how the text is read, and its lines stay whole.
fn width(is_error: bool) -> Option<usize> {
    let is_terminal = if is_error { io::stderr().is_terminal() } else { io::stdout().is_terminal() };
    let said = std::env::var("COLUMNS").ok().and_then(|columns| columns.trim().parse().ok());
    let width = said.or_else(|| is_terminal.then(terminal_columns).flatten());
    width.filter(|width| *width > 0).map(|width| width.min(MAX_WIDTH))
}

/// The columns of the terminal that the program runs in, as the system's `stty` knows them.
fn terminal_columns() -> Option<usize> {
    let terminal = std::fs::File::open("/dev/tty").ok()?;
    let asked = Command::new("stty").arg("size").stdin(terminal).stderr(Stdio::null()).output().ok()?;
    String::from_utf8(asked.stdout).ok()?.split_whitespace().nth(1)?.parse().ok()
}

/// The text in lines of at most this many columns, as far as its words allow. Descriptions stay beside what they
/// describe where there is room, and the parts of a command line end in a backslash, so that it can be copied.
fn fitted(text: &str, width: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        match lines.last_mut() {
            Some(last) if columns(last) > width && goes_on(last, line) => {
                last.push(' ');
                last.push_str(line.trim_start());
            }
            _ => lines.push(line.to_owned()),
        }
    }
    lines.iter().flat_map(|line| wrapped(line, width)).fold(String::new(), |text, line| text + line.trim_end() + "\n")
}

/// Whether a line goes on with the description in the line before it.
fn goes_on(before: &str, line: &str) -> bool {
    let indent = indent_of(line);
    head_of(before).is_some_and(|head| columns(head) == indent) && head_of(line).is_none() && !line.trim().is_empty()
}

fn wrapped(line: &str, width: usize) -> Vec<String> {
    if columns(line) <= width {
        return vec![line.to_owned()];
    }
    let indent = indent_of(line);
    if line.trim_start().starts_with("motion-lab ") {
        let words = command_words(line.trim_start());
        return filled(&words, [indent, indent + HANGING], width, " \\");
    }
    let words = |text: &str| -> Vec<String> { text.split_whitespace().map(str::to_owned).collect() };
    let has_room = |head: &str| {
        let longest = line[head.len()..].split_whitespace().map(columns).max().unwrap_or(0);
        columns(head) <= width / 2 && columns(head) + longest <= width
    };
    match head_of(line) {
        // what is described, with its description beside it
        Some(head) if has_room(head) => {
            let hanging = columns(head);
            let mut lines = filled(&words(&line[head.len()..]), [hanging, hanging], width, "");
            if let Some(first) = lines.first_mut() {
                first.replace_range(..hanging, head);
            }
            lines
        }
        Some(head) => {
            let below = indent + 2 * HANGING;
            let mut lines = filled(&words(head), [indent, below], width, "");
            lines.extend(filled(&words(&line[head.len()..]), [below, below], width, ""));
            lines
        }
        None => {
            let hanging = match line.trim_start() {
                text if text.starts_with("- ") => indent + 2,
                text if columns(text) != text.chars().count() || text.starts_with("Usage:") => indent + HANGING,
                _ => indent,
            };
            filled(&words(line), [indent, hanging], width, "")
        }
    }
}

/// Words in lines of at most this many columns; the first line and the others are indented so. Each line but the last
/// ends with `end`.
fn filled(words: &[String], [first, others]: [usize; 2], width: usize, end: &str) -> Vec<String> {
    let mut lines = vec![" ".repeat(first)];
    let mut is_empty = true;
    for (i, word) in words.iter().enumerate() {
        let rest = if i + 1 == words.len() { 0 } else { end.len() };
        let line = lines.last_mut().map_or(0, |line| columns(line));
        if !is_empty && line + 1 + columns(word) + rest > width {
            if let Some(line) = lines.last_mut() {
                line.push_str(end);
            }
            lines.push(" ".repeat(others));
            is_empty = true;
        }
        if let Some(line) = lines.last_mut() {
            if !is_empty {
                line.push(' ');
            }
            line.push_str(word);
        }
        is_empty = false;
    }
    lines
}

/// The words of a command line. What is in quotes is a part of its word, blanks and all.
fn command_words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in line.chars() {
        match (quote, c) {
            (None, ' ') => {
                words.push(String::new());
                continue;
            }
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if open == c => quote = None,
            _ => {}
        }
        if let Some(word) = words.last_mut() {
            word.push(c);
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// The beginning of a line up to its description, which two blanks or more part from what it describes.
fn head_of(line: &str) -> Option<&str> {
    let text = line.trim_start();
    let gap = text.find("  ")?;
    let description = text[gap..].trim_start();
    (!description.is_empty()).then(|| &line[..line.len() - description.len()])
}

fn indent_of(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The columns of a text on a terminal, without the sequences that paint it.
fn columns(text: &str) -> usize {
    let mut columns = 0;
    let mut is_paint = false;
    for c in text.chars() {
        match (is_paint, c) {
            (false, '\u{1b}') => is_paint = true,
            (true, 'm') => is_paint = false,
            (true, _) => {}
            (false, _) => columns += 1,
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descriptions_hang_beside_or_below_what_they_describe() {
        let text = "Codes:\n   0  done\n   4  the replay differs from the recording, or\n      there is no path\n\n  \
                    -o, --output <FILE>  Write to this file and to no other one\n";
        assert_eq!(
            fitted(text, 28),
            "Codes:\n   0  done\n   4  the replay differs\n      from the recording, or\n      there is no path\n\n  -o, \
             --output <FILE>\n          Write to this file\n          and to no other\n          one\n"
        );
        assert_eq!(
            fitted(text, 48),
            "Codes:\n   0  done\n   4  the replay differs from the recording, or\n      there is no path\n\n  -o, \
             --output <FILE>  Write to this file and to\n                       no other one\n"
        );
        assert_eq!(fitted(text, 100), text);
    }

    #[test]
    fn command_lines_can_be_copied_and_words_stay_whole() {
        let text = "  motion-lab script print 'a b c d' -o drive.ron | less\n- a point that goes on\n";
        assert_eq!(
            fitted(text, 26),
            "  motion-lab script \\\n      print 'a b c d' -o \\\n      drive.ron | less\n- a point that goes on\n"
        );
        assert_eq!(fitted("- a point that goes on", 12), "- a point\n  that goes\n  on\n");
        assert_eq!(fitted("see /a/very/long/path there", 9), "see\n/a/very/long/path\nthere\n");
        // paint takes no room
        assert_eq!(fitted("\u{1b}[1mbold\u{1b}[0m and more", 13), "\u{1b}[1mbold\u{1b}[0m and more\n");
    }
}
