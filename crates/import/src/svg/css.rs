//! Reduces a drawing's styles to those that decide what is an obstacle: whether a shape is filled, stroked and visible.

use crate::ImportProblem;

/// The properties that matter.
pub(crate) const PROPERTIES: [&str; 23] = [
    "fill",
    "stroke",
    "fill-opacity",
    "stroke-opacity",
    "stroke-width",
    "opacity",
    "display",
    "visibility",
    "color",
    "transform",
    "transform-origin",
    "transform-box",
    "font-size",
    "fill-rule",
    "clip-rule",
    "clip-path",
    "mask",
    "mask-image",
    "mask-type",
    "filter",
    "overflow",
    "stop-color",
    "stop-opacity",
];

/// Largest number of parts of a selector: each is a call deeper when it is matched. What matching takes is counted
/// there.
const MAX_PARTS: usize = 10;

/// Greatest length of a value in a style sheet, bytes: a rule may hold for every element. What all of them take
/// together is counted where they are matched.
const MAX_VALUE: usize = 10_000;

/// A rule of a style sheet, with the properties that matter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SheetRule {
    /// Each as written.
    pub selectors: Vec<String>,
    pub declarations: Vec<StyleDeclaration>,
}

/// A declaration of a property that matters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct StyleDeclaration {
    pub property: &'static str,
    pub value: String,
    pub important: bool,
}

impl StyleDeclaration {
    /// The declaration; `None` if the property does not matter.
    pub fn new(property: &str, value: &str) -> Option<Self> {
        let property = *PROPERTIES.iter().find(|known| **known == property.trim())?;
        let value = value.trim();
        let (value, important) = match value.strip_suffix("important").map(str::trim_end) {
            Some(before) if before.ends_with('!') => (before[..before.len() - 1].trim_end(), true),
            _ => (value, false),
        };
        Some(StyleDeclaration { property, value: value.to_owned(), important })
    }
}

/// Returns the declarations of a `style` attribute that matter, each property once. The last one counts, unless only an
/// earlier one is `!important`.
pub(crate) fn declarations(style: &str) -> Vec<StyleDeclaration> {
    let mut last: Vec<StyleDeclaration> = Vec::new();
    let pairs = style.split(';').filter_map(|declaration| declaration.split_once(':'));
    for new in pairs.filter_map(|(name, value)| StyleDeclaration::new(name, value)) {
        match last.iter_mut().find(|old| old.property == new.property) {
            Some(old) if old.important && !new.important => {}
            Some(old) => *old = new,
            None => last.push(new),
        }
    }
    last
}

/// Returns the rules of a style sheet, each with the declarations that matter. Of rules that begin with `@`, those for
/// screens are read and all others left out, as are comments.
///
/// # Errors
/// [`ImportProblem::Unsupported`] for a selector of too many parts, and for a value that is too long.
pub(crate) fn style_sheet(text: &str) -> Result<Vec<SheetRule>, ImportProblem> {
    let mut sheet = Vec::new();
    rules(&without_comments(text), true, &mut sheet)?;
    Ok(sheet)
}

fn rules(text: &str, may_nest: bool, sheet: &mut Vec<SheetRule>) -> Result<(), ImportProblem> {
    let mut rest = text;
    while let Some(open) = rest.find(['{', ';']) {
        let selector = rest[..open].trim();
        if rest.as_bytes()[open] == b';' {
            // a rule that ends with a semicolon, such as @import
            rest = &rest[open + 1..];
            continue;
        }
        let close = block_end(&rest[open..]);
        let block = &rest[open + 1..open + close];
        let block = block.strip_suffix('}').unwrap_or(block);
        rest = &rest[open + close..];
        if !selector.starts_with('@') {
            rule(selector, block, sheet)?;
        } else if may_nest && is_for_screens(selector) {
            rules(block, false, sheet)?;
        }
    }
    Ok(())
}

fn is_for_screens(at_rule: &str) -> bool {
    let Some(media) = at_rule.strip_prefix("@media") else { return false };
    media.split(',').any(|query| !query.contains("print") && !query.contains("not "))
}

fn rule(selector: &str, block: &str, sheet: &mut Vec<SheetRule>) -> Result<(), ImportProblem> {
    let declared = declarations(block);
    if declared.is_empty() {
        return Ok(());
    }
    if let Some(long) = declared.iter().find(|declaration| declaration.value.len() > MAX_VALUE) {
        let problem = format!("a `{}` of more than {MAX_VALUE} bytes in a style sheet", long.property);
        return Err(ImportProblem::Unsupported(problem));
    }
    let mut selectors = Vec::new();
    for one in selector.split(',') {
        let parts = one.split([' ', '\t', '\n', '\r', '>', '+', '~']).filter(|part| !part.is_empty()).count();
        if parts > MAX_PARTS {
            let problem = format!("a selector of more than {MAX_PARTS} parts in a style sheet");
            return Err(ImportProblem::Unsupported(problem));
        }
        selectors.push(one.trim().to_owned());
    }
    sheet.push(SheetRule { selectors, declarations: declared });
    Ok(())
}

fn without_comments(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        plain.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    // older files hide their style sheets from older readers
    (plain + rest).replace("<!--", "").replace("-->", "")
}

/// Length of a block that begins with a brace, bytes, including the blocks in it.
fn block_end(text: &str) -> usize {
    let mut depth = 0_usize;
    for (i, b) in text.bytes().enumerate() {
        match b {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => continue,
        }
        if depth == 0 {
            return i + 1;
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(style: &str) -> Vec<String> {
        let mark = |important: bool| if important { "!" } else { "" };
        declarations(style).iter().map(|d| format!("{}:{}{}", d.property, d.value, mark(d.important))).collect()
    }

    fn selectors(sheet: &str) -> Vec<String> {
        style_sheet(sheet).unwrap().into_iter().flat_map(|rule| rule.selectors).collect()
    }

    #[test]
    fn what_decides_nothing_is_left_out() {
        let style = "fill:red; cursor:url(#f);fill : url(#g) none;marker-mid:url(#m); display:none;x";
        assert_eq!(texts(style), ["fill:url(#g) none", "display:none"]);
        let sheet = "/* a{} */@import 'b';@media print { .c { fill: red } } .d, g > .e{stroke:none;cursor:url(#f)} .f{";
        assert_eq!(selectors(sheet), [".d", "g > .e"]);
        let screens =
            "<!-- @media screen and (x){.a{fill:none}@media all{.b{fill:none}}} @media print,all{.c{fill:red}} -->";
        assert_eq!(selectors(screens), [".a", ".c"]);
        assert!(style_sheet(&format!(".a{{transform:{}}}", "x".repeat(MAX_VALUE))).is_ok());
        assert!(style_sheet(&format!(".a{{transform:{}}}", "x".repeat(MAX_VALUE + 1))).is_err());
        assert_eq!(texts("fill:none !important;fill:red"), ["fill:none!"]);
        assert_eq!(texts("fill:none;fill:red ! important"), ["fill:red!"]);
    }

    #[test]
    fn long_selectors_are_refused() {
        let ten = format!("g{}", " > g".repeat(9));
        assert_eq!(selectors(&format!("{ten}{{fill:red}}")), [ten.as_str()]);
        assert!(style_sheet(&format!("{ten} *{{fill:red}}")).is_err());
        assert!(selectors(&format!("{ten} text{{font-weight:bold}}")).is_empty());
    }
}
