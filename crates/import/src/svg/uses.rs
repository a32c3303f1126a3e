//! References within a drawing, and the bounds on what `use` repeats.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::check::{DEEPEST, SVG, at, attribute};
use super::scan::MAX_ELEMENTS;
use crate::{ImportError, ImportProblem};

const ELEMENTS: [&str; 15] = [
    "svg", "g", "a", "defs", "symbol", "use", "switch", "path", "rect", "circle", "ellipse", "line", "polyline",
    "polygon", "clipPath",
];

/// Greatest length of all path data and polygon points together, including those that `use` repeats, bytes.
const MAX_PATH_DATA: usize = 1 << 22;

/// Greatest length of all attributes together, including those that `use` repeats, bytes.
const MAX_ATTRIBUTE_TEXT: usize = 1 << 25;

const XLINK: &str = "http://www.w3.org/1999/xlink";

/// The elements of a drawing by their ids.
pub(crate) type Targets<'a> = BTreeMap<&'a str, Node<'a, 'a>>;

/// The target of an element's `href`, or of its older `xlink:href`.
pub(crate) fn href<'a>(node: &Node<'a, 'a>) -> Option<&'a str> {
    attribute(*node, "href").or_else(|| node.attribute((XLINK, "href"))).map(str::trim)
}

/// The id in `url(#id)`, with or without quotes.
pub(crate) fn url_target(text: &str) -> Option<&str> {
    let (inside, _) = text.trim().strip_prefix("url(")?.split_once(')')?;
    inside.trim().trim_matches(['"', '\'']).trim().strip_prefix('#')
}

/// The elements by their ids; of two with one id, the first.
pub(crate) fn targets<'a>(root: Node<'a, 'a>) -> Targets<'a> {
    let mut targets = Targets::new();
    for node in root.descendants() {
        if let Some(id) = attribute(node, "id") {
            targets.entry(id).or_insert(node);
        }
    }
    targets
}

/// Whether an element is of SVG, or of no namespace in a drawing that names none.
pub(crate) fn is_drawn(node: &Node) -> bool {
    node.is_element() && node.tag_name().namespace().is_none_or(|name| name == SVG)
}

/// Checks the number of elements, the length of path data and the depth of a drawing in which each `use` is expanded.
/// The walk ends when nothing is left of what is allowed.
pub(crate) fn check_uses<'a>(root: Node<'a, 'a>, targets: &Targets<'a>) -> Result<(), ImportError> {
    let (mut elements, mut path_data, mut attributes) = (0, 0, 0);
    let mut open = vec![(root, 0)];
    while let Some((node, depth)) = open.pop() {
        let refuse = |what: String| Err(at(node, ImportProblem::Unsupported(what)));
        elements += 1;
        path_data += ["d", "points"].iter().filter_map(|name| attribute(node, name)).map(str::len).sum::<usize>();
        attributes += node.attributes().map(|a| a.value().len()).sum::<usize>();
        if elements > MAX_ELEMENTS {
            return refuse(format!("more than {MAX_ELEMENTS} elements"));
        }
        if path_data > MAX_PATH_DATA {
            return refuse(format!("more than {MAX_PATH_DATA} bytes of paths and points: fewer digits will do"));
        }
        if attributes > MAX_ATTRIBUTE_TEXT {
            return refuse(format!("more than {MAX_ATTRIBUTE_TEXT} bytes of attributes"));
        }
        if depth > DEEPEST {
            return refuse(format!("elements nested deeper than {DEEPEST}"));
        }
        let is_counted = |node: &Node| is_drawn(node) && ELEMENTS.contains(&node.tag_name().name());
        let target = href(&node).filter(|_| node.tag_name().name() == "use");
        let target = target.and_then(|href| targets.get(href.strip_prefix('#')?)).copied();
        open.extend(node.children().rev().chain(target).filter(is_counted).map(|child| (child, depth + 1)));
    }
    Ok(())
}
