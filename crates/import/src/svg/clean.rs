//! `clean` reduces a drawing to what its obstacles depend on. Gradients, patterns, markers, filters and the like can
//! take unbounded time and memory to read, and affect no obstacle.

use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use super::check::{DEEPEST, SVG, at};
use super::css::{declarations, style_sheet, supported_value};
use super::scan::MAX_ELEMENTS;
use crate::{ImportError, ImportProblem};

const ELEMENTS: [&str; 14] = [
    "svg", "g", "a", "defs", "symbol", "use", "switch", "path", "rect", "circle", "ellipse", "line", "polyline",
    "polygon",
];

const ATTRIBUTES: [&str; 24] = [
    "id",
    "class",
    "viewBox",
    "preserveAspectRatio",
    "x",
    "y",
    "width",
    "height",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "x1",
    "y1",
    "x2",
    "y2",
    "d",
    "points",
    "systemLanguage",
    "requiredExtensions",
    "requiredFeatures",
    "pathLength",
    "fill-rule",
];

/// Greatest length of all path data and polygon points together, including those that `use` repeats, bytes.
const MAX_PATH_DATA: usize = 1 << 20;

/// Largest product of the numbers of elements and style-sheet selectors: every selector is tried on every element.
const MAX_MATCHES: usize = 1_000_000;

/// Greatest length of all style sheets together, bytes.
const MAX_STYLES: usize = 1 << 18;

/// Writes a drawing as text, with known elements and attributes only. [`check`](super::check::check) must have accepted
/// it. Paint from a gradient or a pattern becomes black.
///
/// # Errors
/// [`ImportError`]: too many elements or too much path data, including those that `use` repeats; style sheets that are
/// too long or have too many selectors; a clip path or mask in a style.
pub(crate) fn clean(document: &Document) -> Result<String, ImportError> {
    let root = document.root_element();
    if !is_svg(&root, "svg") {
        return Err(ImportProblem::Syntax("no drawing: the root element is no svg element".into()).into());
    }
    check_uses(root)?;
    let mut writer = Writer { out: String::new(), elements: 0, selectors: 0, styles: 0 };
    writer.element(root)?;
    if writer.elements * writer.selectors > MAX_MATCHES {
        let problem = format!("style sheets of {} selectors for {} elements", writer.selectors, writer.elements);
        return Err(ImportProblem::Unsupported(problem).into());
    }
    Ok(writer.out)
}

fn is_svg(node: &Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name && node.tag_name().namespace() == Some(SVG)
}

/// Whether an element is kept.
fn is_supported(node: &Node) -> bool {
    let name = node.tag_name().name();
    node.tag_name().namespace() == Some(SVG) && (name == "style" || ELEMENTS.contains(&name))
}

/// The target of an element's `href`, or of its older `xlink:href`.
fn href<'a>(node: &Node<'a, 'a>) -> Option<&'a str> {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).map(str::trim)
}

const XLINK: &str = "http://www.w3.org/1999/xlink";

struct Writer {
    out: String,
    elements: usize,
    selectors: usize,
    styles: usize,
}

impl Writer {
    /// Writes an element with its children. The recursion ends: the depth has been checked.
    fn element(&mut self, node: Node) -> Result<(), ImportError> {
        if !is_supported(&node) {
            return Ok(());
        }
        let name = node.tag_name().name();
        if name == "style" {
            let text: String = node.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
            self.styles += text.len();
            if self.styles > MAX_STYLES {
                let problem = format!("more than {MAX_STYLES} bytes of style sheets");
                return Err(at(node, ImportProblem::Unsupported(problem)));
            }
            let sheet = style_sheet(&text).map_err(|problem| at(node, problem))?;
            self.selectors += sheet.selectors;
            self.out.push_str("<style>");
            escape(&sheet.text, &mut self.out);
            self.out.push_str("</style>");
            return Ok(());
        }
        self.elements += 1;
        self.out.extend(["<", name]);
        if node.parent_element().is_none() {
            self.attribute("xmlns", SVG);
        }
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            let (name, value) = (attribute.name(), attribute.value());
            if name == "style" {
                let style = declarations(value).map_err(|problem| at(node, problem))?;
                self.attribute(name, &style);
            } else if ATTRIBUTES.contains(&name) {
                self.attribute(name, value);
            } else if let Some(value) = supported_value(name, value).map_err(|problem| at(node, problem))? {
                self.attribute(name, value);
            }
        }
        if let Some(href) = href(&node) {
            self.attribute("href", href);
        }
        self.out.push('>');
        node.children().filter(Node::is_element).try_for_each(|child| self.element(child))?;
        self.out.extend(["</", name, ">"]);
        Ok(())
    }

    fn attribute(&mut self, name: &str, value: &str) {
        self.out.extend([" ", name, "=\""]);
        escape(value, &mut self.out);
        self.out.push('"');
    }
}

fn escape(text: &str, out: &mut String) {
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
}

/// Checks the number of elements, the length of path data and the depth of a drawing in which each `use` is expanded.
fn check_uses(root: Node) -> Result<(), ImportError> {
    let mut targets: BTreeMap<&str, Node> = BTreeMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            targets.entry(id).or_insert(node);
        }
    }
    expand(root, &targets, 0, &mut RemainingAllowance { elements: MAX_ELEMENTS, path_data: MAX_PATH_DATA })
}

/// The elements, and the bytes of path data, that a drawing may still have.
struct RemainingAllowance {
    elements: usize,
    path_data: usize,
}

/// Walks through the elements as they are drawn. The walk ends when nothing is left of the allowance.
fn expand<'a>(
    node: Node<'a, 'a>,
    targets: &BTreeMap<&str, Node<'a, 'a>>,
    depth: usize,
    left: &mut RemainingAllowance,
) -> Result<(), ImportError> {
    if !is_supported(&node) {
        return Ok(());
    }
    let refuse = |what: String| at(node, ImportProblem::Unsupported(what));
    let elements = left.elements.checked_sub(1);
    left.elements = elements.ok_or_else(|| refuse(format!("more than {MAX_ELEMENTS} elements")))?;
    let data: usize = ["d", "points"].iter().filter_map(|name| node.attribute(*name)).map(str::len).sum();
    left.path_data = left
        .path_data
        .checked_sub(data)
        .ok_or_else(|| refuse(format!("more than {MAX_PATH_DATA} bytes of paths and points: fewer digits will do")))?;
    if depth > DEEPEST {
        return Err(refuse(format!("elements nested deeper than {DEEPEST}")));
    }
    if is_svg(&node, "use")
        && let Some(target) = href(&node).and_then(|href| targets.get(href.strip_prefix('#')?))
    {
        expand(*target, targets, depth + 1, left)?;
    }
    node.children().filter(Node::is_element).try_for_each(|child| expand(child, targets, depth + 1, left))
}
