//! The lab's fonts hold every character that it shows.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use motion_lab::picture::FACES;
use motion_lab::worlds::World;
use skrifa::{FontRef, MetadataProvider};

/// The characters that no font has.
fn missing(signs: impl IntoIterator<Item = char>) -> BTreeSet<char> {
    let faces = FACES.map(|(name, bytes)| FontRef::new(bytes).unwrap_or_else(|e| panic!("{name}: {e}")));
    let has = |c: char| faces.iter().any(|face| face.charmap().map(c).is_some_and(|glyph| glyph.to_u32() != 0));
    // the SVG writer names the two code points that are no characters, to drop them
    let is_sign = |c: &char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    signs.into_iter().filter(is_sign).filter(|c| !has(*c)).collect()
}

/// The characters of a source file before its tests, those written as escapes too.
fn signs_of(file: &Path, signs: &mut BTreeSet<char>) {
    let text = fs::read_to_string(file).unwrap();
    let shown = text.split("#[cfg(test)]").next().unwrap_or_default();
    signs.extend(shown.chars());
    for escape in shown.split("\\u{").skip(1) {
        let number = escape.split('}').next().and_then(|hex| u32::from_str_radix(hex, 16).ok());
        signs.extend(number.and_then(char::from_u32));
    }
}

fn signs_under(folder: &Path, signs: &mut BTreeSet<char>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.ends_with("tests") {
            signs_under(&path, signs);
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            signs_of(&path, signs);
        }
    }
}

#[test]
fn every_sign_on_screen_is_in_a_face() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut signs = BTreeSet::new();
    let shown = [
        ("src", &["window/ui"][..]),
        ("crates/core/src", &["configuration", "cspace", "picture"]),
        ("crates/sim/src", &["manifest", "anatomy", "atlas"]),
    ];
    for (folder, room) in shown.iter().flat_map(|(folder, rooms)| rooms.iter().map(move |room| (folder, room))) {
        signs_under(&root.join(folder).join(room), &mut signs);
    }
    signs_of(&root.join("crates/sim/assets/widgets.ron"), &mut signs);
    signs_of(&root.join("crates/sim/assets/formulas.ron"), &mut signs);
    for name in World::built_in_names() {
        signs.extend(World::built_in(name).unwrap().to_ron().chars());
    }
    for sign in ['\u{3b8}', '\u{2208}', '\u{2212}', '\u{d7}'] {
        assert!(signs.contains(&sign), "{sign} is no longer found in the sources");
    }
    assert_eq!(missing(signs), BTreeSet::new());
}

#[test]
fn names_in_european_scripts_and_the_signs_of_formulas_are_there() {
    let names = "Küche Łódź Ängström λάμδα Ωmega Москва";
    let formulas = "φϕψθρωλμπΔ∈∉∞≤≥≠≈√±·×−∂∇∑∫ℝℕℂẋⁿ₀₁₂₃²³←→↑↓";
    assert_eq!(missing(names.chars().chain(formulas.chars())), BTreeSet::new());
    assert_eq!(missing(['\u{4e2d}']), BTreeSet::from(['\u{4e2d}']), "a missing letter is reported");
}
