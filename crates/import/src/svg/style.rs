//! What styles say of each element.

use std::cell::Cell;

use roxmltree::{Document, Node};
use simplecss::{AttributeOperator, Element, PseudoClass, Selector};

use super::check::{at, attribute};
use super::css::{SheetRule, StyleDeclaration, declarations, style_sheet};
use super::scan::MAX_ELEMENTS;
use crate::{ImportError, ImportProblem};

/// Largest product of the numbers of elements and style-sheet selectors: every selector is tried on every element.
const MAX_MATCHES: usize = 1_000_000;

/// What all these tries may take, in bytes compared. A selector that names ancestors asks each of them: the time of a
/// try grows with their number, for one of three parts with its square.
const MAX_MATCHING: usize = 300_000_000;

/// What it takes to go to another element or to ask one, in bytes compared.
const STEP: usize = 10;

/// What it takes to look for words in a byte, or to copy one, in bytes compared.
const BYTE: usize = 4;

/// Greatest length of all style sheets together, bytes.
const MAX_STYLES: usize = 1 << 18;

/// The properties that matter, of every element: attributes, rules and `style` attributes, the one that counts.
pub(crate) struct StyleTable {
    declared: Vec<Vec<StyleDeclaration>>,
}

impl StyleTable {
    /// Reads the styles of a drawing.
    ///
    /// # Errors
    /// [`ImportError`]: style sheets that are too long or have too many selectors.
    pub fn read(document: &Document) -> Result<Self, ImportError> {
        let sheet = style_sheets(document)?;
        let elements = document.descendants().filter(Node::is_element);
        let count = elements.clone().take(4 * MAX_ELEMENTS).count();
        let selectors: usize = sheet.iter().map(|rule| rule.selectors.len()).sum();
        let too_many = || {
            let problem = format!("style sheets of {selectors} selectors for {count} elements");
            ImportError::from(ImportProblem::Unsupported(problem))
        };
        if count * selectors > MAX_MATCHES {
            return Err(too_many());
        }
        let rules = StyleRules::new(&sheet);
        let mut declared = Vec::new();
        for node in elements {
            declared.resize(node.id().get_usize() + 1, Vec::new());
            declared[node.id().get_usize()] = declarations_of(node, rules.of(node).ok_or_else(too_many)?);
        }
        Ok(StyleTable { declared })
    }

    /// The value of a property that an element itself has; `None` if it has none, or asks for its parent's.
    pub fn own(&self, node: Node, property: &str) -> Option<&str> {
        let all = self.declared.get(node.id().get_usize())?;
        let own = all.iter().find(|declaration| declaration.property == property)?;
        (!matches!(own.value.as_str(), "inherit" | "unset")).then_some(own.value.as_str())
    }

    /// Whether `visibility` hides an element, if the one around it is hidden or not.
    pub fn is_hidden(&self, node: Node, around: bool) -> bool {
        const WORDS: [(&str, bool); 4] = [("hidden", true), ("collapse", true), ("visible", false), ("initial", false)];
        self.keyword(node, "visibility", &WORDS).unwrap_or(around)
    }

    /// Whether a fill rule, `fill-rule` or `clip-rule`, is `evenodd`, if that of the element around is or is not.
    pub fn is_even_odd(&self, node: Node, property: &str, around: bool) -> bool {
        const WORDS: [(&str, bool); 3] = [("evenodd", true), ("nonzero", false), ("initial", false)];
        self.keyword(node, property, &WORDS).unwrap_or(around)
    }

    /// What an element's own word stands for; `None` if it has none of these.
    fn keyword(&self, node: Node, property: &str, words: &[(&str, bool)]) -> Option<bool> {
        let own = self.own(node, property)?;
        words.iter().find(|(word, _)| own.eq_ignore_ascii_case(word)).map(|(_, meaning)| *meaning)
    }
}

fn style_sheets(document: &Document) -> Result<Vec<SheetRule>, ImportError> {
    let mut all = Vec::new();
    let mut length = 0;
    for node in document.descendants().filter(|node| node.is_element() && node.tag_name().name() == "style") {
        if attribute(node, "type").is_some_and(|kind| !matches!(kind.trim(), "" | "text/css")) {
            continue;
        }
        let text: String = node.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
        length += text.len();
        if length > MAX_STYLES {
            let problem = format!("more than {MAX_STYLES} bytes of style sheets");
            return Err(at(node, ImportProblem::Unsupported(problem)));
        }
        all.extend(style_sheet(&text).map_err(|problem| at(node, problem))?);
    }
    Ok(all)
}

/// Attributes count least, then rules by how specific they are, then the `style` attribute; of all these what is
/// `!important` counts most.
fn declarations_of(node: Node, of_rules: Vec<StyleDeclaration>) -> Vec<StyleDeclaration> {
    let attributes = node.attributes().filter(|a| a.namespace().is_none());
    let mut all: Vec<StyleDeclaration> =
        attributes.filter_map(|a| StyleDeclaration::new(a.name(), a.value())).collect();
    all.extend(of_rules);
    all.extend(attribute(node, "style").map(declarations).unwrap_or_default());
    // a stable order, from which the last of each property is kept
    all.sort_by_key(|declaration| declaration.important);
    let mut kept: Vec<StyleDeclaration> = Vec::new();
    for declaration in all.into_iter().rev() {
        if kept.iter().all(|other| other.property != declaration.property) {
            kept.push(declaration);
        }
    }
    kept
}

/// The rules of all style sheets, those that count more later.
struct StyleRules<'s> {
    rules: Vec<(Selector<'s>, &'s [StyleDeclaration])>,
    room: MatchingRoom,
}

impl<'s> StyleRules<'s> {
    fn new(sheet: &'s [SheetRule]) -> Self {
        let mut rules: Vec<(Selector, &[StyleDeclaration])> = Vec::new();
        for rule in sheet {
            let selectors = rule.selectors.iter().filter_map(|text| Selector::parse(text));
            rules.extend(selectors.map(|selector| (selector, &rule.declarations[..])));
        }
        // of rules that are equally specific, the later one counts more
        rules.sort_by_cached_key(|(selector, _)| selector.specificity());
        StyleRules { rules, room: MatchingRoom(Cell::new(Some(MAX_MATCHING))) }
    }

    /// What the rules declare of an element; `None` if finding it takes too much.
    fn of(&self, node: Node) -> Option<Vec<StyleDeclaration>> {
        let element = StyledElement { node, room: &self.room };
        let mut all = Vec::new();
        for (_, declared) in self.rules.iter().filter(|(selector, _)| selector.matches(&element)) {
            self.room.take(declared.iter().map(|one| BYTE * (STEP + one.value.len())).sum());
            self.room.0.get()?;
            all.extend_from_slice(declared);
        }
        self.room.0.get().map(|_| all)
    }
}

/// What is left of [`MAX_MATCHING`]; `None` once it did not suffice.
struct MatchingRoom(Cell<Option<usize>>);

impl MatchingRoom {
    /// Takes room, and says whether there was enough.
    fn take(&self, work: usize) -> bool {
        self.0.set(self.0.get().and_then(|left| left.checked_sub(work)));
        self.0.get().is_some()
    }
}

/// An element that selectors are tried on. Without room it answers each question by no, so that the try ends.
struct StyledElement<'a, 'r> {
    node: Node<'a, 'a>,
    room: &'r MatchingRoom,
}

impl Element for StyledElement<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        let node = self.node.parent_element()?;
        self.room.take(STEP).then_some(StyledElement { node, ..*self })
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        // comments and text lie between elements
        let earlier = std::iter::successors(self.node.prev_sibling(), Node::prev_sibling);
        let mut earlier = earlier.take_while(|_| self.room.take(STEP));
        Some(StyledElement { node: earlier.find(Node::is_element)?, ..*self })
    }

    fn has_local_name(&self, local_name: &str) -> bool {
        self.room.take(STEP + local_name.len()) && self.node.tag_name().name() == local_name
    }

    fn attribute_matches(&self, local_name: &str, operator: AttributeOperator<'_>) -> bool {
        if !self.room.take(STEP + self.node.attributes().len() * (1 + local_name.len())) {
            return false;
        }
        let Some(value) = attribute(self.node, local_name) else { return false };
        let compared = match operator {
            AttributeOperator::Exists => 0,
            AttributeOperator::Contains(_) => BYTE * value.len(),
            AttributeOperator::Matches(wanted) | AttributeOperator::StartsWith(wanted) => wanted.len(),
        };
        self.room.take(compared) && operator.matches(value)
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.prev_sibling_element().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What it takes to try rules on the element with the id `e`, and whether one holds for it.
    fn work(rule: &str, drawing: &str) -> (usize, bool) {
        let document = Document::parse(drawing).unwrap();
        let node = document.descendants().find(|node| attribute(*node, "id") == Some("e")).unwrap();
        let sheet = style_sheet(rule).unwrap();
        let rules = StyleRules::new(&sheet);
        let declared = rules.of(node).unwrap();
        let work = MAX_MATCHING - rules.room.0.get().unwrap();
        // with just so much it is done, and with a byte less it is not
        let with = |room: usize| StyleRules { room: MatchingRoom(Cell::new(Some(room))), ..StyleRules::new(&sheet) };
        assert_eq!(with(work).of(node), Some(declared.clone()), "{rule}");
        assert!(work == 0 || with(work - 1).of(node).is_none(), "{rule}");
        (work, !declared.is_empty())
    }

    #[test]
    fn each_step_of_a_selector_is_counted() {
        let drawing = "<s><g a='1' b='two'><!-- --><g/> <!-- --><path id='e' k='x y'/></g></s>";
        // its own name
        assert_eq!(work("rect{fill:a}", drawing), (10 + 4, false));
        // two ancestors and their names
        assert_eq!(work("a path{fill:a}", drawing), (10 + 4 + 2 * (10 + 10 + 1), false));
        // of the group `g`, whose name fits, the one ancestor
        assert_eq!(work("a g path{fill:a}", drawing), (10 + 4 + 21 + 21 + 21, false));
        // one parent
        assert_eq!(work("a > path{fill:a}", drawing), (10 + 4 + 21, false));
        // three nodes to the element before, and its name
        assert_eq!(work("a + path{fill:a}", drawing), (10 + 4 + 3 * 10 + 11, false));
        assert_eq!(work("path:first-child{fill:a}", drawing), (10 + 4 + 3 * 10, false));
        // two attributes by a name of one byte, and what is compared with the value `x y`
        assert_eq!(work("[z]{fill:a}", drawing), (10 + 2 * 2, false));
        assert_eq!(work("[k='long']{fill:a}", drawing), (10 + 2 * 2 + 4, false));
        assert_eq!(work("[k|='long']{fill:a}", drawing), (10 + 2 * 2 + 4, false));
        assert_eq!(work("[k~='z']{fill:a}", drawing), (10 + 2 * 2 + 4 * 3, false));
        // two declarations that are copied, of one and of three bytes
        assert_eq!(work("*{fill:a;stroke:red}", drawing), (4 * (10 + 1) + 4 * (10 + 3), true));
        // two rules
        assert_eq!(work("rect{fill:a} circle{fill:a}", drawing), (10 + 4 + 10 + 6, false));
    }
}
