//! Refuses SVG files with unsupported elements or numbers, by line, before a drawing is read from them.

use usvg::roxmltree::{Document, Node};

use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

pub(crate) const SVG: &str = "http://www.w3.org/2000/svg";

/// Greatest depth of nested elements: readers of drawings recurse.
pub(crate) const DEEPEST: usize = 200;

/// Largest number in a shape's attributes. The number of pieces of an arc or a circle grows with its radius.
const LARGEST: f64 = 1e7;

/// The attributes of shapes that are a length each.
const LENGTHS: [&str; 13] = ["x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "x1", "y1", "x2", "y2"];

/// Checks every element; returns notes on what will be left out.
pub(crate) fn check(document: &Document) -> Result<Vec<String>, ImportError> {
    let mut notes = Vec::new();
    let (mut depth, mut last) = (0_usize, document.root());
    for node in document.descendants() {
        // descendants come in document order, so the depth is counted along the way
        depth = if node.parent() == Some(last) {
            depth + 1
        } else {
            let up = std::iter::successors(last.parent(), Node::parent).position(|n| Some(n) == node.parent());
            depth - up.unwrap_or(0)
        };
        last = node;
        if depth > DEEPEST {
            return Err(at(node, ImportProblem::Unsupported(format!("elements nested deeper than {DEEPEST}"))));
        }
        if !node.is_element() || node.tag_name().namespace().is_some_and(|name| name != SVG) {
            continue;
        }
        match node.tag_name().name() {
            name @ ("image" | "foreignObject" | "feImage") => {
                return Err(at(node, ImportProblem::Unsupported(format!("{name}: draw it as shapes"))));
            }
            "text" => notes.push("text is left out".to_owned()),
            "marker" => notes.push("markers are left out".to_owned()),
            "rect" | "line" | "polyline" | "polygon" | "circle" | "ellipse" | "path" => check_numbers(node)?,
            _ => {}
        }
        for cut in ["clip-path", "mask"] {
            if node.attribute(cut).is_some_and(|value| value != "none") {
                return Err(at(node, ImportProblem::Unsupported(format!("{cut}: cut the shape itself"))));
            }
        }
    }
    Ok(notes)
}

/// Checks the numbers in a shape's attributes. The reader would silently skip a malformed number, and the shape with
/// it.
fn check_numbers(node: Node) -> Result<(), ImportError> {
    let refuse = |name: &str, value: &str| {
        Err(at(node, wrong_value(format!("{name} = {value}"), "finite numbers, at most 10000000 in size")))
    };
    let is_number = |text: &str| text.parse::<f64>().is_ok_and(|x| x.abs() <= LARGEST);
    for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
        let (name, value) = (attribute.name(), attribute.value().trim());
        let good = match name {
            "rx" | "ry" if value == "auto" => true,
            length if LENGTHS.contains(&length) => {
                is_number(value.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%'))
            }
            // numbers may follow one another without a blank, so only the signs that they are made of are checked
            "d" => {
                value.chars().all(|c| c.is_ascii_whitespace() || "+-.,0123456789eEMmZzLlHhVvCcSsQqTtAa".contains(c))
                    && are_small(value)
            }
            "points" => {
                value.chars().all(|c| c.is_ascii_whitespace() || "+-.,0123456789eE".contains(c)) && are_small(value)
            }
            _ => true,
        };
        if !good {
            return refuse(name, value);
        }
    }
    Ok(())
}

/// Whether every number in a text is small: the count of digits before its point plus its exponent is at most seven.
/// The text is not split into numbers; any other sign starts the count again.
fn are_small(text: &str) -> bool {
    let bytes = text.as_bytes();
    let (mut digits, mut is_fraction) = (0, false);
    for (i, b) in bytes.iter().enumerate() {
        match b {
            b'0'..=b'9' => digits += usize::from(!is_fraction),
            b'.' => is_fraction = true,
            b'e' | b'E' => {
                let exponent = bytes[i + 1..].strip_prefix(b"+").unwrap_or(&bytes[i + 1..]);
                let up = exponent
                    .iter()
                    .take_while(|b| b.is_ascii_digit())
                    .take(8)
                    .fold(0, |n, b| 10 * n + usize::from(b - b'0'));
                digits += up;
                is_fraction = true;
            }
            _ => (digits, is_fraction) = (0, false),
        }
        if digits > 7 {
            return false;
        }
    }
    true
}

/// An error at an element: its line, its name and its id.
pub(crate) fn at(node: Node, problem: ImportProblem) -> ImportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    let id = node.attribute("id").map_or(String::new(), |id| format!(" {id:?}"));
    ImportError::at(line, format!("{}{id}", node.tag_name().name()), problem)
}

#[cfg(test)]
mod tests {
    use super::are_small;

    #[test]
    fn the_digits_before_the_point_and_the_exponent_tell_the_size() {
        for small in ["M1234567 0", "0.123456789e-300 .5.5-.25", "1e3,1E+3", "9999999-9999999", "1e-9999999", ""] {
            assert!(are_small(small), "{small}");
        }
        for large in ["12345678", "0 0 1e9", "1E+8", "1.5e7", "h99999999.0", "1e99999999999999999999"] {
            assert!(!are_small(large), "{large}");
        }
    }
}
