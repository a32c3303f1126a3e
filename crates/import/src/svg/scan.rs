//! Checks the limits of an SVG file in one pass over its text, before any parser reads it. For some files parsers take
//! time and memory out of all proportion.

use std::collections::BTreeMap;

use crate::{ImportError, ImportProblem};

/// Largest number of elements, including those that `use` repeats.
pub const MAX_ELEMENTS: usize = 50_000;

/// Largest number of attributes of one element.
const MAX_ATTRIBUTES: usize = 100;

/// Largest number of attributes in all.
const MAX_ALL_ATTRIBUTES: usize = 200_000;

/// Largest number of attributes that bind a prefix to a namespace, in all.
const MAX_PREFIXES: usize = 200;

/// Greatest length of all expanded entities together, bytes.
const MAX_ENTITY_TEXT: usize = 1 << 20;

/// Checks the numbers of elements, attributes and prefixes of a file, and its entities.
///
/// # Errors
/// [`ImportError`] with the line: too many elements, attributes or prefixes; an entity that is not plain text or is
/// declared twice; entities that expand to too much; any other declaration.
pub(crate) fn scan(text: &str) -> Result<(), ImportError> {
    let refuse = |at: usize, what: String| {
        let line = 1 + text[..at].bytes().filter(|b| *b == b'\n').count();
        Err(ImportError::at(line, "", ImportProblem::Unsupported(what)))
    };
    let mut entities: BTreeMap<&[u8], usize> = BTreeMap::new();
    let (mut tags, mut all, mut prefixes, mut at) = (0, 0, 0, 0);
    while let Some(found) = text[at..].find('<') {
        let start = at + found;
        let tag = &text[start..];
        let skip = |end: &str| tag.find(end).map_or(tag.len(), |i| i + end.len());
        at = start
            + if tag.starts_with("<!--") {
                skip("-->")
            } else if tag.starts_with("<![CDATA[") {
                skip("]]>")
            } else if tag.starts_with("<!ENTITY") {
                let Some((name, value)) = entity(tag) else {
                    return refuse(start, "an entity that is not a plain text".into());
                };
                if entities.insert(name.as_bytes(), value.len()).is_some() {
                    return refuse(start, "an entity declared twice".into());
                }
                extent(tag).length
            } else if tag.starts_with("<?") {
                skip("?>")
            } else if tag.starts_with("<!DOCTYPE") {
                // its declarations stand within it and are scanned next
                head_of(tag)
            } else if tag.starts_with("<!") {
                return refuse(start, "a declaration that is not of an entity".into());
            } else {
                let Extent { length, attributes, bound } = extent(tag);
                if attributes > MAX_ATTRIBUTES {
                    return refuse(start, format!("an element with more than {MAX_ATTRIBUTES} attributes"));
                }
                (all, prefixes) = (all + attributes, prefixes + bound);
                length
            };
        tags += 1;
        // an element has up to two tags, and comments count as well
        if tags > 4 * MAX_ELEMENTS {
            return refuse(start, format!("more than {MAX_ELEMENTS} elements"));
        }
        if all > MAX_ALL_ATTRIBUTES {
            return refuse(start, format!("more than {MAX_ALL_ATTRIBUTES} attributes"));
        }
        if prefixes > MAX_PREFIXES {
            return refuse(start, format!("more than {MAX_PREFIXES} prefixes of namespaces"));
        }
    }
    let mut length = 0;
    let longest = entities.keys().map(|name| name.len()).max().unwrap_or(0);
    for (at, _) in text.match_indices('&').filter(|_| !entities.is_empty()) {
        let name = text.as_bytes()[at + 1..].iter().take(longest + 1).position(|b| *b == b';');
        let name = name.map_or(&[][..], |end| &text.as_bytes()[at + 1..at + 1 + end]);
        length += entities.get(name).copied().unwrap_or(0);
        if length > MAX_ENTITY_TEXT {
            return refuse(at, format!("entities that stand for more than {MAX_ENTITY_TEXT} bytes"));
        }
    }
    Ok(())
}

/// The name and value of an entity declared as plain text; `None` if the text holds further entities or elements.
fn entity(declaration: &str) -> Option<(&str, &str)> {
    let rest = declaration.strip_prefix("<!ENTITY")?.trim_start();
    let (name, rest) = rest.split_once(|c: char| c.is_ascii_whitespace())?;
    let rest = rest.trim_start();
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let (value, _) = rest[1..].split_once(quote)?;
    (!value.contains(['&', '<', '%'])).then_some((name, value))
}

/// Length of a document type's head, bytes: up to the `[` before its declarations, or to its end `>`. Quoted text may
/// hold either sign.
fn head_of(document_type: &str) -> usize {
    let mut quote = None;
    let end = document_type.bytes().position(|b| {
        match (quote, b) {
            (Some(open), _) if b == open => quote = None,
            (None, b'"' | b'\'') => quote = Some(b),
            (None, b'[' | b'>') => return true,
            _ => {}
        }
        false
    });
    end.map_or(document_type.len(), |end| end + 1)
}

/// The length of a tag, bytes, and its numbers of attributes.
struct Extent {
    length: usize,
    attributes: usize,
    /// Number of attributes that bind a prefix.
    bound: usize,
}

fn extent(tag: &str) -> Extent {
    let (mut quote, mut attributes, mut length) = (None, 0, tag.len());
    for (i, b) in tag.bytes().enumerate() {
        match (quote, b) {
            (Some(open), _) if b == open => {
                (quote, attributes) = (None, attributes + 1);
            }
            (None, b'"' | b'\'') => quote = Some(b),
            (None, b'>') => {
                length = i + 1;
                break;
            }
            _ => {}
        }
    }
    Extent { length, attributes, bound: tag[..length].matches("xmlns").count() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        scan(text).unwrap_err().of("d.svg").to_string()
    }

    #[test]
    fn each_limit_is_reached_and_not_passed() {
        let attributes = |n: usize| format!("<svg>\n<g {}/></svg>", "a='>' ".repeat(n));
        assert_eq!(scan(&attributes(100)), Ok(()));
        assert!(refusal(&attributes(101)).starts_with("d.svg:2: not supported: an element with more than 100"));
        let all = |n: usize| format!("<g {}/>", "a=''".repeat(100)).repeat(n);
        assert_eq!(scan(&all(2_000)), Ok(()));
        assert!(refusal(&all(2_001)).contains("more than 200000 attributes"));
        let prefixes = |n: usize| "<g xmlns:a='b'/>".repeat(n);
        assert_eq!(scan(&prefixes(200)), Ok(()));
        assert!(refusal(&prefixes(201)).contains("more than 200 prefixes"));
        assert_eq!(scan(&"<a>\n</a><!-- <a a=''> --><![CDATA[<a>]]>".repeat(50_000)), Ok(()));
        let many = refusal(&format!("{}<a/>", "<a>\n</a><!-- -->\n<!-- -->".repeat(50_000)));
        assert_eq!(many, "d.svg:100001: not supported: more than 50000 elements");
    }

    #[test]
    fn entities_are_plain_texts_of_bounded_length() {
        let file = |entity: &str, uses: usize| format!("<!DOCTYPE svg [\n{entity}]><a b=\"{}\"/>", "&e;".repeat(uses));
        let plain = format!("<!ENTITY e \"{}\">", "x".repeat(1 << 10));
        assert_eq!(scan(&file(&plain, 1 << 10)), Ok(()));
        assert!(
            refusal(&file(&plain, (1 << 10) + 1)).starts_with("d.svg:2: not supported: entities that stand for more")
        );
        let twice = format!("{plain}<!ENTITY e \"\">");
        assert!(refusal(&file(&twice, 0)).contains("an entity declared twice"));
        // signs that must hide nothing: in an instruction, in the name of a document type, before a name that never
        // ends
        for before in ["<?a '?>", "<!DOCTYPE a PUBLIC \"<a '\" \"[>\" [", "&".repeat(100_000).as_str()] {
            let text = format!("{before}{plain}<a b=\"{}\"/>", "&e;".repeat(2_000));
            assert!(refusal(&text).contains("entities that stand for more"), "{:.20}", text);
        }
        assert!(refusal("<!DOCTYPE a [<!ATTLIST a '>").contains("a declaration that is not of an entity"));
        for entity in
            ["<!ENTITY e '&f;'>", "<!ENTITY e '<g/>'>", "<!ENTITY % e 'x'>", "<!ENTITY e SYSTEM 'f'>", "<!ENTITY"]
        {
            assert!(refusal(&file(entity, 0)).starts_with("d.svg:2: not supported: an entity that is not"), "{entity}");
        }
    }
}
