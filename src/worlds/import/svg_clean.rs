//! `clean`, a drawing reduced to what its obstacles depend on. Gradients, patterns, markers, filters and the like take their readers
//! time and memory without bound and move no wall.

use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use super::svg_check::{DEEPEST, SVG, at};
use super::svg_css::{declarations, style_sheet};
use super::svg_scan::MAX_ELEMENTS;
use super::{ImportError, ImportProblem};

const ELEMENTS: [&str; 14] = [
    "svg", "g", "a", "defs", "symbol", "use", "switch", "path", "rect", "circle", "ellipse", "line", "polyline",
    "polygon",
];

const ATTRIBUTES: [&str; 26] = [
    "id",
    "class",
    "transform",
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
    "color",
    "font-size",
    "systemLanguage",
    "style",
    "href",
    "fill-rule",
];

/// The largest product of elements and selectors of style sheets: each is tried on each.
const MAX_MATCHES: usize = 1_000_000;

/// The largest length of style sheets, in all, bytes.
const MAX_STYLES: usize = 1 << 18;

/// The drawing as text, of known elements and attributes only, after [`check`](super::svg_check::check). What is painted with a
/// gradient or a pattern is painted black.
///
/// # Errors
/// [`ImportError`]: more elements than allowed, those that `use` repeats among them; style sheets with too many selectors; a cut by
/// style.
pub(super) fn clean(document: &Document) -> Result<String, ImportError> {
    let root = document.root_element();
    if !is_svg(&root, "svg") {
        return Err(ImportProblem::Syntax("no drawing: the root element is no svg element".into()).into());
    }
    let mut writer = Writer { out: String::new(), elements: 0, selectors: 0, styles: 0 };
    writer.element(root)?;
    if writer.elements * writer.selectors > MAX_MATCHES {
        let problem = format!("style sheets of {} selectors for {} elements", writer.selectors, writer.elements);
        return Err(ImportProblem::Unsupported(problem).into());
    }
    check_uses(root)?;
    Ok(writer.out)
}

fn is_svg(node: &Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name && node.tag_name().namespace() == Some(SVG)
}

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
        if node.tag_name().namespace() != Some(SVG) {
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
        if !ELEMENTS.contains(&name) {
            return Ok(());
        }
        self.elements += 1;
        self.out.extend(["<", name]);
        if node.parent_element().is_none() {
            self.attribute("xmlns", SVG);
        }
        for attribute in node.attributes() {
            // href is that of xlink, too
            let (name, value) = (attribute.name(), attribute.value());
            if name == "style" {
                let style = declarations(value).map_err(|problem| at(node, problem))?;
                self.attribute(name, &style);
            } else if ATTRIBUTES.contains(&name) {
                self.attribute(name, value);
            } else if let Some(value) = super::svg_css::kept(name, value).map_err(|problem| at(node, problem))? {
                self.attribute(name, value);
            }
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

/// That the drawing has no more elements than allowed, and none nested deeper, where each `use` stands for what it repeats.
fn check_uses(root: Node) -> Result<(), ImportError> {
    let mut targets: BTreeMap<&str, Node> = BTreeMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            targets.entry(id).or_insert(node);
        }
    }
    let mut left = MAX_ELEMENTS;
    expand(root, &targets, 0, &mut left)
}

/// Walks through the elements as they are drawn; the walk ends with the elements that are left.
fn expand<'a>(
    node: Node<'a, 'a>,
    targets: &BTreeMap<&str, Node<'a, 'a>>,
    depth: usize,
    left: &mut usize,
) -> Result<(), ImportError> {
    *left = left.checked_sub(1).ok_or_else(|| at(node, too_many()))?;
    if depth > DEEPEST {
        return Err(at(node, ImportProblem::Unsupported(format!("elements nested deeper than {DEEPEST}"))));
    }
    if is_svg(&node, "use")
        && let Some(href) = node.attributes().find(|a| a.name() == "href")
        && let Some(target) = href.value().strip_prefix('#').and_then(|id| targets.get(id))
    {
        expand(*target, targets, depth + 1, left)?;
    }
    node.children().filter(Node::is_element).try_for_each(|child| expand(child, targets, depth + 1, left))
}

fn too_many() -> ImportProblem {
    ImportProblem::Unsupported(format!("more than {MAX_ELEMENTS} elements"))
}
