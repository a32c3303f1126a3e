//! What an SVG file must not hold: told with its line before anything is read of it.

use usvg::roxmltree::{Document, Node};

use super::error::wrong_value;
use super::{ImportError, ImportProblem};

const SVG: &str = "http://www.w3.org/2000/svg";

/// How deep elements may be nested: readers of drawings go down recursively.
const DEEPEST: usize = 200;

/// The attributes of shapes that are a length each.
const LENGTHS: [&str; 13] = ["x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "x1", "y1", "x2", "y2"];

/// Checks every element; returns notes on what will be left out.
pub(super) fn check(document: &Document) -> Result<Vec<String>, ImportError> {
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

/// Numbers that are none would be passed over in silence, and the shape with them.
fn check_numbers(node: Node) -> Result<(), ImportError> {
    let refuse = |name: &str, value: &str| Err(at(node, wrong_value(format!("{name} = {value}"), "finite numbers")));
    let is_number = |text: &str| text.parse::<f64>().is_ok_and(f64::is_finite);
    for attribute in node.attributes() {
        let (name, value) = (attribute.name(), attribute.value().trim());
        let good = match name {
            "rx" | "ry" if value == "auto" => true,
            length if LENGTHS.contains(&length) => {
                is_number(value.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%'))
            }
            // numbers may follow one another without a blank, so the signs they are made of is what can be told
            "d" => value.chars().all(|c| c.is_ascii_whitespace() || "+-.,0123456789eEMmZzLlHhVvCcSsQqTtAa".contains(c)),
            "points" => value.chars().all(|c| c.is_ascii_whitespace() || "+-.,0123456789eE".contains(c)),
            _ => true,
        };
        if !good {
            return refuse(name, value);
        }
    }
    Ok(())
}

/// The problem of an element.
fn at(node: Node, problem: ImportProblem) -> ImportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    let id = node.attribute("id").map_or(String::new(), |id| format!(" {id:?}"));
    ImportError::at(line, format!("{}{id}", node.tag_name().name()), problem)
}
