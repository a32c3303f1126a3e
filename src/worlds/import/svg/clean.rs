//! `clean`, a drawing reduced to what its obstacles depend on. Gradients, patterns, markers, filters and the like take their readers
//! time and memory without bound and move no wall.

use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use super::check::{DEEPEST, SVG, at};
use super::css::{declarations, kept, style_sheet};
use super::scan::MAX_ELEMENTS;
use crate::worlds::import::{ImportError, ImportProblem};

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

/// The largest length of what describes paths and polygons, in all, those that `use` repeats among them, bytes.
const MAX_PATH_DATA: usize = 1 << 20;

/// The largest product of elements and selectors of style sheets: each is tried on each.
const MAX_MATCHES: usize = 1_000_000;

/// The largest length of style sheets, in all, bytes.
const MAX_STYLES: usize = 1 << 18;

/// The drawing as text, of known elements and attributes only, after [`check`](super::check::check). What is painted with a
/// gradient or a pattern is painted black.
///
/// # Errors
/// [`ImportError`]: more elements than allowed, those that `use` repeats among them; style sheets with too many selectors; a cut by
/// style.
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

/// Whether an element is written at all.
fn is_kept(node: &Node) -> bool {
    let name = node.tag_name().name();
    node.tag_name().namespace() == Some(SVG) && (name == "style" || ELEMENTS.contains(&name))
}

/// What an element refers to: by its own attribute, or by that of xlink, which is older.
fn href<'a>(node: &Node<'a, 'a>) -> Option<&'a str> {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).map(str::trim)
}

const XLINK: &str = "http://www.w3.org/1999/xlink";

struct Writer {
    out: String,
    elements: usize,
    selectors: usize,
    /// Bytes of style sheets.
    styles: usize,
}

impl Writer {
    /// Writes an element and what it holds: no deeper than was checked.
    fn element(&mut self, node: Node) -> Result<(), ImportError> {
        if !is_kept(&node) {
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
            } else if let Some(value) = kept(name, value).map_err(|problem| at(node, problem))? {
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

/// That the drawing has no more elements and path data than allowed, and no element nested deeper, where each `use` stands for what it
/// repeats.
fn check_uses(root: Node) -> Result<(), ImportError> {
    let mut targets: BTreeMap<&str, Node> = BTreeMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            targets.entry(id).or_insert(node);
        }
    }
    expand(root, &targets, 0, &mut Left { elements: MAX_ELEMENTS, path_data: MAX_PATH_DATA })
}

/// How much more a drawing may have.
struct Left {
    elements: usize,
    path_data: usize,
}

/// Walks through the elements as they are drawn; the walk ends with what is left.
fn expand<'a>(
    node: Node<'a, 'a>,
    targets: &BTreeMap<&str, Node<'a, 'a>>,
    depth: usize,
    left: &mut Left,
) -> Result<(), ImportError> {
    if !is_kept(&node) {
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
