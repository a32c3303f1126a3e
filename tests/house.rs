//! The house rules that no compiler checks: who may use whom, and what stays in one place.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules in reading order: each may use those before it.
const ORDER: [&str; 23] = [
    "num",
    "random",
    "geometry",
    "configuration",
    "robots",
    "worlds",
    "collision",
    "sensors",
    "tour",
    "run",
    "simulation",
    "recording",
    "picture",
    "cspace",
    "anatomy",
    "atlas",
    "output",
    "manifest",
    "capture",
    "ui",
    "app",
    "web",
    "guide",
];

/// The modules without Bevy: the pure core, and what draws without a window.
const PURE: [&str; 14] = [
    "num",
    "random",
    "geometry",
    "configuration",
    "robots",
    "worlds",
    "collision",
    "sensors",
    "tour",
    "run",
    "picture",
    "cspace",
    "anatomy",
    "atlas",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Every source file of the library with its path below src, its module and its code lines (comments cut off).
fn library() -> Vec<(String, String, Vec<String>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    sources(&root)
        .into_iter()
        .map(|path| {
            let below = path.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/");
            let module = below.split(['/', '.']).next().unwrap().to_owned();
            let text = fs::read_to_string(&path).unwrap();
            let lines = text.lines().map(|l| l.split("//").next().unwrap().to_owned()).collect();
            (below, module, lines)
        })
        .filter(|(_, module, _)| !["lib", "main", "cli"].contains(&module.as_str()))
        .collect()
}

/// The names that follow `crate::` in a line.
fn used_modules(line: &str) -> impl Iterator<Item = &str> {
    line.split("crate::").skip(1).map(|rest| {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        &rest[..end]
    })
}

#[test]
fn each_module_uses_only_those_above_it() {
    let rank = |m: &str| ORDER.iter().position(|o| *o == m);
    let mut seen = 0;
    for (file, module, lines) in library() {
        let own = rank(&module).unwrap_or_else(|| panic!("{file}: module {module} has no place in the order"));
        for (number, line) in lines.iter().enumerate() {
            for used in used_modules(line) {
                if let Some(other) = rank(used) {
                    seen += 1;
                    assert!(other <= own, "{file}:{}: {module} may not use {used}", number + 1);
                    let strangers = ["robots", "worlds"];
                    assert!(
                        module == used || !(strangers.contains(&module.as_str()) && strangers.contains(&used)),
                        "{file}:{}: robots and worlds do not know each other",
                        number + 1
                    );
                }
            }
        }
    }
    assert!(seen > 50, "the scan found only {seen} uses: it no longer reads the sources");
}

#[test]
fn parry_is_imported_in_one_file() {
    let users: Vec<String> = library()
        .into_iter()
        .filter(|(_, _, lines)| lines.iter().any(|l| l.contains("parry2d")))
        .map(|(file, ..)| file)
        .collect();
    assert_eq!(users, ["collision/tree.rs"]);
}

#[test]
fn foreign_formats_are_read_in_one_place() {
    let mut readers = 0;
    for (file, _, lines) in library() {
        let reads = lines.iter().any(|l| l.contains("usvg") || l.contains("saphyr_parser"));
        // our own SVG is painted by the reader of others'
        assert!(!reads || file.starts_with("worlds/import/") || file == "capture/raster.rs", "{file}");
        readers += usize::from(reads);
    }
    assert!(readers > 0, "nothing reads them: this test no longer finds the sources");
}

#[test]
fn the_pure_core_has_no_bevy_no_egui_and_opens_no_files() {
    for (file, module, lines) in library() {
        if PURE.contains(&module.as_str()) {
            for (number, line) in lines.iter().enumerate() {
                for banned in ["bevy", "egui", "std::fs", "File::", "Instant", "SystemTime", "HashMap", "HashSet"] {
                    assert!(!line.contains(banned), "{file}:{}: {banned} in the pure core", number + 1);
                }
            }
        }
    }
}

#[test]
fn colours_are_named_in_the_theme_only() {
    let quoted_hex = |line: &str| {
        line.split("\"#").skip(1).any(|rest| rest.chars().take_while(char::is_ascii_hexdigit).count() >= 3)
    };
    let mut in_theme = 0;
    for (file, _, lines) in library() {
        for (number, line) in lines.iter().enumerate() {
            let names_one = [
                "from_rgb",
                "from_rgba",
                "from_gray",
                "from_hex",
                "Color32::WHITE",
                "Color32::BLACK",
                "Srgba::",
                "Color::srgb",
            ]
            .iter()
            .any(|c| line.contains(c))
                || quoted_hex(line);
            if file.starts_with("ui/theme") {
                in_theme += usize::from(names_one || line.contains("0x"));
            } else {
                assert!(!names_one, "{file}:{}: a colour outside the theme: {line}", number + 1);
            }
        }
    }
    assert!(in_theme > 0, "the theme names no colour: this test no longer finds them");
}

#[test]
fn unsafe_and_missing_docs_are_forbidden_for_the_whole_package() {
    let manifest = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap();
    for rule in ["unsafe_code = \"forbid\"", "missing_docs = \"deny\"", "disallowed_methods = \"deny\""] {
        assert!(manifest.contains(rule), "Cargo.toml no longer says {rule}");
    }
    let banned = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("clippy.toml")).unwrap();
    for method in ["sin", "cos", "tan", "atan2", "hypot", "exp", "ln", "min", "max", "mul_add"] {
        assert!(banned.contains(&format!("\"f64::{method}\"")), "clippy.toml no longer bans f64::{method}");
    }
}
