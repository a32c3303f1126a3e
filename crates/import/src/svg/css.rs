//! Reduces a drawing's styles to those that decide what is an obstacle: whether a shape is filled, stroked and visible.

use crate::ImportProblem;

const PROPERTIES: [&str; 12] = [
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
    "font-size",
];

/// Largest number of parts of a selector. The time to match one that names ancestors grows steeply with their number.
const MAX_PARTS: usize = 3;

/// A style sheet reduced to the properties that matter.
pub(crate) struct StyleSheet {
    pub text: String,
    /// Number of its selectors.
    pub selectors: usize,
}

/// Returns the value of a property that matters; `None` for any other. Paint that refers to another element becomes
/// black.
///
/// # Errors
/// [`ImportProblem::Unsupported`] for a clip path or a mask.
pub(crate) fn supported_value<'a>(name: &str, value: &'a str) -> Result<Option<&'a str>, ImportProblem> {
    let value = value.trim();
    match name {
        "clip-path" | "mask" if value != "none" => {
            let what = if name == "mask" { "a mask" } else { "a clip path" };
            Err(ImportProblem::Unsupported(format!("{what}: cut the shapes themselves")))
        }
        "fill" | "stroke" if value.contains("url(") => Ok(Some("black")),
        name if PROPERTIES.contains(&name) => Ok(Some(value)),
        _ => Ok(None),
    }
}

/// Returns the declarations of a `style` attribute that matter, each property once. The last one counts, unless only an
/// earlier one is `!important`.
///
/// # Errors
/// As [`supported_value`].
pub(crate) fn declarations(style: &str) -> Result<String, ImportProblem> {
    let mut last: [Option<&str>; PROPERTIES.len()] = [None; PROPERTIES.len()];
    for declaration in style.split(';') {
        let Some((name, value)) = declaration.split_once(':') else { continue };
        let name = name.trim();
        if let Some(value) = supported_value(name, value)?
            && let Some(i) = PROPERTIES.iter().position(|p| *p == name)
        {
            let is_outranked = last[i].is_some_and(|last| is_important(last) && !is_important(value));
            last[i] = if is_outranked { last[i] } else { Some(value) };
        }
    }
    let all = PROPERTIES.iter().zip(last).filter_map(|(name, value)| Some([name, ":", value?, ";"].concat()));
    Ok(all.collect())
}

fn is_important(value: &str) -> bool {
    value.trim_end().ends_with("!important")
}

/// Returns the rules of a style sheet, each with the declarations that matter. Comments and rules that begin with `@`
/// are left out.
///
/// # Errors
/// As [`supported_value`]; a selector of too many parts.
pub(crate) fn style_sheet(text: &str) -> Result<StyleSheet, ImportProblem> {
    let plain = without_comments(text);
    let mut sheet = StyleSheet { text: String::new(), selectors: 0 };
    let mut rest = plain.as_str();
    while let Some(open) = rest.find(['{', ';']) {
        let selector = rest[..open].trim();
        if rest.as_bytes()[open] == b';' {
            // a rule that ends with a semicolon, such as @import
            rest = &rest[open + 1..];
            continue;
        }
        let close = block_end(&rest[open..]);
        let block = rest[open..open + close].trim_matches(['{', '}']);
        rest = &rest[open + close..];
        if selector.starts_with('@') {
            continue;
        }
        let kept = declarations(block)?;
        if kept.is_empty() {
            continue;
        }
        for one in selector.split(',') {
            let parts = one.split([' ', '\t', '\n', '\r', '>', '+', '~']).filter(|part| !part.is_empty()).count();
            if parts > MAX_PARTS {
                let problem = format!("a selector of more than {MAX_PARTS} parts in a style sheet");
                return Err(ImportProblem::Unsupported(problem));
            }
            sheet.selectors += 1;
        }
        sheet.text.extend([selector, "{", &kept, "}"]);
    }
    Ok(sheet)
}

fn without_comments(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        plain.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    plain + rest
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

    #[test]
    fn what_decides_nothing_is_left_out() {
        let style = "fill:red; filter:url(#f);fill : url(#g) none;marker-mid:url(#m); display:none;x";
        assert_eq!(declarations(style).unwrap(), "fill:black;display:none;");
        let sheet = "/* a{} */@import 'b';@media print { .c { fill: red } } .d, g > .e{stroke:none;filter:url(#f)} .f{";
        let sheet = style_sheet(sheet).unwrap();
        assert_eq!((sheet.text.as_str(), sheet.selectors), (".d, g > .e{stroke:none;}", 2));
        assert_eq!(declarations("fill:none !important;fill:red").unwrap(), "fill:none !important;");
        assert_eq!(declarations("fill:none;fill:red !important").unwrap(), "fill:red !important;");
    }

    #[test]
    fn cuts_and_long_selectors_are_refused() {
        assert!(declarations("clip-path:none;mask:none").unwrap().is_empty());
        for (style, what) in [("clip-path: url(#c)", "a clip path"), ("mask:url(#m)", "a mask")] {
            let problem = declarations(style).unwrap_err().to_string();
            assert_eq!(problem, format!("not supported: {what}: cut the shapes themselves"));
            assert!(style_sheet(&format!(".a{{{style}}}")).is_err());
        }
        assert_eq!(style_sheet("g > .a b{fill:red}").unwrap().selectors, 1);
        assert!(style_sheet("g > .a b *{fill:red}").is_err());
        assert_eq!(style_sheet("g > .a b text{font-weight:bold}").unwrap().selectors, 0);
    }
}
