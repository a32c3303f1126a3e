//! What styles say of each element, and what of it is inherited.

use std::cmp::Ordering;

use roxmltree::{Document, Node};
use simplecss::{AttributeOperator, Element, PseudoClass, Selector};

use super::check::{at, attribute};
use super::css::{SheetRule, StyleDeclaration, declarations, style_sheet};
use super::lengths::{Along, LengthScale, ratio};
use super::scan::MAX_ELEMENTS;
use crate::{ImportError, ImportProblem};

/// Largest product of the numbers of elements and style-sheet selectors: every selector is tried on every element.
const MAX_MATCHES: usize = 1_000_000;

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
        if count * selectors > MAX_MATCHES {
            let problem = format!("style sheets of {selectors} selectors for {count} elements");
            return Err(ImportProblem::Unsupported(problem).into());
        }
        let mut rules: Vec<(Selector, &[StyleDeclaration])> = Vec::new();
        for rule in &sheet {
            rules.extend(
                rule.selectors.iter().filter_map(|text| Some((Selector::parse(text)?, &rule.declarations[..]))),
            );
        }
        // of rules that are equally specific, the later one counts more
        rules.sort_by_cached_key(|(selector, _)| selector.specificity());
        let mut declared = Vec::new();
        for node in elements {
            declared.resize(node.id().get_usize() + 1, Vec::new());
            declared[node.id().get_usize()] = declarations_of(node, &rules);
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
fn declarations_of(node: Node, rules: &[(Selector, &[StyleDeclaration])]) -> Vec<StyleDeclaration> {
    let attributes = node.attributes().filter(|a| a.namespace().is_none());
    let mut all: Vec<StyleDeclaration> =
        attributes.filter_map(|a| StyleDeclaration::new(a.name(), a.value())).collect();
    for (_, declared) in rules.iter().filter(|(selector, _)| selector.matches(&StyledElement(node))) {
        all.extend_from_slice(declared);
    }
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

struct StyledElement<'a>(Node<'a, 'a>);

impl Element for StyledElement<'_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(StyledElement)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(StyledElement)
    }

    fn has_local_name(&self, local_name: &str) -> bool {
        self.0.tag_name().name() == local_name
    }

    fn attribute_matches(&self, local_name: &str, operator: AttributeOperator<'_>) -> bool {
        attribute(self.0, local_name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.prev_sibling_element().is_none()
    }
}

/// What an element inherits from those around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inherited<'s> {
    pub fill: &'s str,
    pub stroke: &'s str,
    pub color: &'s str,
    pub fill_opacity: f64,
    pub stroke_opacity: f64,
    /// The units of the element.
    pub stroke_width: f64,
    pub hidden: bool,
    pub even_odd: bool,
    pub font_size: f64,
}

/// Pixels, when nothing says otherwise.
pub(crate) const FONT_SIZE: f64 = 16.0;

impl Default for Inherited<'_> {
    fn default() -> Self {
        Inherited {
            fill: "black",
            stroke: "none",
            color: "black",
            fill_opacity: 1.0,
            stroke_opacity: 1.0,
            stroke_width: 1.0,
            hidden: false,
            even_odd: false,
            font_size: FONT_SIZE,
        }
    }
}

impl<'s> Inherited<'s> {
    /// What holds for an element, and is handed on to its children.
    pub fn at(&self, node: Node, styles: &'s StyleTable, scale: &LengthScale) -> Self {
        let own = |property: &str| styles.own(node, property);
        let mut new = *self;
        if let Some(size) = own("font-size") {
            new.font_size = font_size(size, self.font_size, scale).unwrap_or(self.font_size);
        }
        let scale = LengthScale { font_size: new.font_size, ..*scale };
        new.fill = own("fill").map_or(self.fill, |fill| if fill == "initial" { "black" } else { fill });
        new.stroke = own("stroke").map_or(self.stroke, |stroke| if stroke == "initial" { "none" } else { stroke });
        // a colour of the words `currentColor` is the parent's
        new.color = own("color").filter(|c| !c.eq_ignore_ascii_case("currentcolor")).unwrap_or(self.color);
        new.fill_opacity = own("fill-opacity").and_then(ratio).unwrap_or(self.fill_opacity);
        new.stroke_opacity = own("stroke-opacity").and_then(ratio).unwrap_or(self.stroke_opacity);
        let width = own("stroke-width").and_then(|text| scale.length(text, Along::Both));
        new.stroke_width = width.unwrap_or(self.stroke_width);
        new.hidden = styles.is_hidden(node, self.hidden);
        new.even_odd = styles.is_even_odd(node, "fill-rule", self.even_odd);
        new
    }
}

/// A font's size, the parent's being known.
fn font_size(text: &str, parent: f64, scale: &LengthScale) -> Option<f64> {
    const WORDS: [(&str, f64); 7] = [
        ("xx-small", 9.0),
        ("x-small", 10.0),
        ("small", 13.0),
        ("medium", 16.0),
        ("large", 18.0),
        ("x-large", 24.0),
        ("xx-large", 32.0),
    ];
    let word = WORDS.iter().find(|(word, _)| *word == text).map(|(_, size)| *size);
    let relative = LengthScale { viewport: (parent, parent), font_size: parent, ..*scale };
    let size = match text {
        "larger" => Some(parent * 1.2),
        "smaller" => Some(parent / 1.2),
        _ => word.or_else(|| relative.length(text, Along::X)),
    };
    size.filter(|size| size.partial_cmp(&0.0) != Some(Ordering::Less))
}
