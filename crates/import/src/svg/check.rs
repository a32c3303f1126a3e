//! Refuses SVG files with malformed numbers, or nested too deeply, by line, before a drawing is read.

use roxmltree::{Document, Node};

use super::lengths::number_and_unit;
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

pub(crate) const SVG: &str = "http://www.w3.org/2000/svg";

/// Greatest depth of nested elements.
pub(crate) const DEEPEST: usize = 1000;

/// What the numbers of shapes must be. How large they may be is judged in metres, after all transforms.
pub(crate) const NUMBERS: &str = "finite numbers";

/// The note on text.
pub(crate) const TEXT_LEFT_OUT: &str = "text is left out";

/// The attributes of shapes that are a length each.
const LENGTHS: [&str; 13] = ["x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "x1", "y1", "x2", "y2"];

/// Checks the depth and the numbers of every element; returns notes on what will be left out.
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
            "text" => notes.push(TEXT_LEFT_OUT.to_owned()),
            "marker" => notes.push("markers are left out".to_owned()),
            "rect" | "line" | "polyline" | "polygon" | "circle" | "ellipse" | "path" => check_numbers(node)?,
            _ => {}
        }
    }
    Ok(notes)
}

/// Checks the signs that a shape's numbers are made of, and that its lengths are numbers. The numbers of paths and
/// points are checked where they are read.
fn check_numbers(node: Node) -> Result<(), ImportError> {
    let is_sign = |c: char| c.is_ascii_whitespace() || "+-.,0123456789eE".contains(c);
    for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
        let (name, value) = (attribute.name(), attribute.value().trim());
        let good = match name {
            "rx" | "ry" if value == "auto" => true,
            length if LENGTHS.contains(&length) => number_and_unit(value).is_some(),
            "d" => value.chars().all(|c| is_sign(c) || "MmZzLlHhVvCcSsQqTtAa".contains(c)),
            "points" => value.chars().all(is_sign),
            _ => true,
        };
        if !good {
            return Err(at(node, wrong_value(format!("{name} = {value}"), NUMBERS)));
        }
    }
    Ok(())
}

/// The value of an attribute of SVG itself: one without a namespace.
pub(crate) fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.attributes().find(|a| a.namespace().is_none() && a.name() == name).map(|a| a.value())
}

/// An error at an element: its line, its name and its id.
pub(crate) fn at(node: Node, problem: ImportProblem) -> ImportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    ImportError::at(line, name_and_id(node), problem)
}

fn name_and_id(node: Node) -> String {
    let id = attribute(node, "id").map_or(String::new(), |id| format!(" {id:?}"));
    format!("{}{id}", node.tag_name().name())
}

/// How notes call elements. The lines of a drawing are found once, for elements without an id.
pub(crate) struct Labels {
    line_ends: Vec<usize>,
}

impl Labels {
    pub fn new(document: &Document) -> Self {
        Labels { line_ends: document.input_text().match_indices('\n').map(|(i, _)| i).collect() }
    }

    /// `rect "table"`, or `the rect in line 3`.
    pub fn of(&self, node: Node) -> String {
        let line = 1 + self.line_ends.partition_point(|end| *end < node.range().start);
        let name = name_and_id(node);
        if attribute(node, "id").is_some() { name } else { format!("the {name} in line {line}") }
    }
}
