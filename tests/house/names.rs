//! Names mean one thing: types are called differently where they are different things, and no name uses a worn-out
//! word.

use std::collections::BTreeMap;

use super::sources::{Source, sources};

/// Largest number of names that several types share. The few that do are one thing seen twice, such as a door of a
/// world file and the component that a door of a run has.
const SHARED: usize = 5;

/// Words that no item is called by: what they stand for has a noun of its own.
const WORN: [&str; 8] = ["told", "hush", "deed", "aside", "kept", "most", "slack", "leap"];

/// The kind and the name of the item that begins on a line; `None` for any other line.
fn item(line: &str) -> Option<(&str, &str)> {
    let mut code = line.trim_start();
    if let Some(rest) = code.strip_prefix("pub") {
        let rest = rest.trim_start();
        code = if rest.starts_with('(') { rest.split_once(')')?.1.trim_start() } else { rest };
    }
    let code = code.strip_prefix("const ").filter(|rest| rest.starts_with("fn ")).unwrap_or(code);
    let (kind, rest) = code.split_once(' ')?;
    let kinds = ["struct", "enum", "trait", "type", "fn", "const", "static", "mod"];
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    (kinds.contains(&kind) && end > 0).then(|| (kind, &rest[..end]))
}

/// The sources without tests.
fn code() -> impl Iterator<Item = Source> {
    sources().into_iter().filter(|s| !s.file.contains("/tests/") && !s.file.ends_with("/tests.rs"))
}

#[test]
fn a_type_has_its_name_for_itself() {
    let mut types: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for source in code() {
        for line in source.code() {
            let Some((kind, name)) = item(line) else { continue };
            // the type of a trait's implementation is called as the trait says
            let is_associated = kind == "type" && line.starts_with(' ');
            if ["struct", "enum", "trait", "type"].contains(&kind) && !is_associated {
                types.entry(name.to_owned()).or_default().push(source.file.clone());
            }
        }
    }
    let shared: Vec<String> =
        types.iter().filter(|(_, files)| files.len() > 1).map(|(name, files)| format!("{name}: {files:?}")).collect();
    assert!(shared.len() <= SHARED, "{} names of several types:\n{}", shared.len(), shared.join("\n"));
    assert!(types.len() > 900, "{} types: this test no longer finds them", types.len());
}

#[test]
fn no_item_is_called_by_a_worn_out_word() {
    let (mut items, mut worn) = (0, Vec::new());
    for source in code() {
        for line in source.code() {
            let Some((kind, name)) = item(line) else { continue };
            items += 1;
            if name.split('_').flat_map(humps).any(|word| WORN.contains(&word.as_str())) {
                worn.push(format!("{}: {kind} {name}", source.file));
            }
        }
    }
    assert!(worn.is_empty(), "what these are has a noun of its own:\n{}", worn.join("\n"));
    assert!(items > 4000, "{items} items: this test no longer finds them");
}

/// The words of a name in camel case, in lower case.
fn humps(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let is_shouting = !name.chars().any(char::is_lowercase);
    for c in name.chars() {
        if c.is_uppercase() && !is_shouting {
            words.push(String::new());
        }
        words.last_mut().unwrap().extend(c.to_lowercase());
    }
    words
}

#[test]
fn items_and_their_words_are_found() {
    assert_eq!(item("    pub(super) const fn nearest<T>(a: T)"), Some(("fn", "nearest")));
    assert_eq!(item("pub(crate) struct Ready {"), Some(("struct", "Ready")));
    assert_eq!(item("const MOST_LANES: usize = 3;"), Some(("const", "MOST_LANES")));
    assert_eq!(item("let kept = 1;"), None);
    assert_eq!((humps("KeptRun"), humps("MOST")), (vec!["".into(), "kept".into(), "run".into()], vec!["most".into()]));
}
