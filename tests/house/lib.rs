//! The house rules that no compiler checks: which modules may use which, and what stays in one place.
#![cfg(test)]
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod names;
mod rooms;
mod sources;

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use sources::{CRATES, Source, root, sources};

/// The modules of each crate in reading order: each may use those before it, and the crates above as far as Cargo lets
/// it.
const ORDER: [(&str, &[&str]); 5] = [
    (
        "motion_lab_core",
        &[
            "num",
            "short_list",
            "text_position",
            "one_line",
            "names",
            "random",
            "geometry",
            "configuration",
            "robots",
            "worlds",
            "collision",
            "sensors",
            "picture",
            "cspace",
            "planning",
        ],
    ),
    (
        "motion_lab_sim",
        &[
            "tour",
            "run",
            "tow",
            "anatomy",
            "atlas",
            "simulation",
            "recording",
            "course",
            "shrink",
            "tasks",
            "export",
            "plans",
            "problems",
            "avoid",
            "manifest",
            "capture",
            "lens",
            "run_page",
        ],
    ),
    ("motion_lab_import", &["error", "draft", "yaml", "map", "irsim", "planar", "svg"]),
    ("motion_lab_raster", &["error", "few_colours", "painter", "files"]),
    ("motion_lab", &["json_words", "output", "batch", "capture", "window", "web", "guide", "cli"]),
];

/// The rooms of the simulator that use neither Bevy nor the simulator itself.
const PURE: [&str; 5] = ["tour", "run", "tow", "anatomy", "atlas"];

#[test]
fn each_module_uses_only_those_above_it() {
    let mut seen = 0;
    for source in sources().iter().filter(|s| !s.room().is_empty()) {
        let (_, order) = ORDER.iter().find(|(name, _)| *name == source.of_crate()).unwrap();
        let rank = |m: &str| order.iter().position(|o| *o == m);
        let (file, room) = (&source.file, source.room());
        let own = rank(room).unwrap_or_else(|| panic!("{file}: {room} has no place in the order"));
        for path in source.all_imports().into_iter().filter(|path| path[0] == source.of_crate()) {
            let used = path.get(1).map_or("", String::as_str);
            if let Some(other) = rank(used) {
                seen += 1;
                assert!(other <= own, "{file}: {room} may not use {}", path.join("::"));
                let strangers = ["robots", "worlds"];
                let known = room == used || !(strangers.contains(&room) && strangers.contains(&used));
                assert!(known, "{file}: robots and worlds do not know each other");
            }
        }
    }
    assert!(seen > 1500, "the scan found only {seen} uses: it no longer reads the sources");
}

#[test]
fn parry_is_imported_in_one_folder() {
    let imports = |s: &Source| s.lines.iter().any(|l| l.contains("parry2d_f64::"));
    let mut users: Vec<String> = sources().into_iter().filter(imports).map(|s| s.file).collect();
    users.sort_unstable();
    let folder = ["black_box", "box_tree", "pieces"].map(|file| format!("crates/core/src/collision/parry/{file}.rs"));
    assert_eq!(users, folder);
}

/// The benches' rivals compile this file by itself, with parry as its users build it.
#[test]
fn the_rivals_file_uses_nothing_but_parry() {
    let file = fs::read_to_string(root().join("crates/core/src/collision/parry/pieces.rs")).unwrap();
    let uses: Vec<&str> = file.lines().filter(|line| line.starts_with("use ")).collect();
    assert!(uses.len() > 3 && uses.iter().all(|line| line.starts_with("use parry2d_f64::")), "{uses:?}");
    assert!(!file.contains("crate::") && !file.contains("super::"), "it would not compile elsewhere");
    let rivals = fs::read_to_string(root().join("benches/table/rivals/mod.rs")).unwrap();
    assert!(rivals.contains("collision/parry/pieces.rs\"]"), "the rivals no longer use it");
}

#[test]
fn pure_rooms_have_no_bevy_and_open_no_files() {
    let mut read = 0;
    for source in sources() {
        let (file, is_core) = (&source.file, source.of_crate() == "motion_lab_core");
        let pure = source.of_crate() == "motion_lab_sim" && PURE.contains(&source.room());
        if !is_core && !pure && source.of_crate() != "motion_lab_import" {
            continue;
        }
        read += 1;
        let simulates = |path: &Vec<String>| path.get(1).is_some_and(|room| room == "simulation");
        assert!(!source.all_imports().iter().any(simulates), "{file}: the simulator in a pure room");
        for (number, line) in source.lines.iter().enumerate() {
            for banned in ["bevy", "std::fs", "File::", "Instant", "SystemTime", "HashMap", "HashSet"] {
                assert!(!line.contains(banned), "{file}:{}: {banned} in a pure room", number + 1);
            }
        }
    }
    assert!(read > 250, "{read} files: this test no longer reads the sources");
}

/// The table of kinds of robots.
const KINDS: &str = "crates/core/src/configuration/kind.rs";

#[test]
fn kinds_of_robots_are_named_in_one_table() {
    let mut named = 0;
    let table = fs::read_to_string(root().join(KINDS)).unwrap();
    let names: Vec<&str> = table.split("\n        name: ").skip(1).filter_map(|rest| rest.split(',').next()).collect();
    for source in sources() {
        let is_test = source.file.contains("tests") || source.file == "crates/sim/src/run/fixture.rs";
        for line in source.code().iter().filter(|_| !is_test) {
            let names_one = names.iter().any(|name| line.contains(name));
            // a car's hitch is also a mark on its picture
            let allowed = [KINDS, "crates/core/src/picture/robot.rs"].contains(&source.file.as_str());
            assert!(!names_one || allowed, "{}: a kind outside the table: {line}", source.file);
            named += usize::from(names_one);
        }
    }
    assert_eq!(named, 5, "four kinds and the mark: this test no longer finds them");
}

#[test]
fn colours_are_named_in_the_theme_only() {
    let quoted_hex = |line: &str| {
        line.split("\"#").skip(1).any(|rest| rest.chars().take_while(char::is_ascii_hexdigit).count() >= 3)
    };
    let mut in_theme = 0;
    for Source { file, lines, .. } in sources() {
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
            if file == "crates/core/src/picture/theme.rs" || file == "src/window/ui/paint/style.rs" {
                in_theme += usize::from(names_one || line.contains("0x"));
            } else {
                assert!(!names_one, "{file}:{}: a colour outside the theme: {line}", number + 1);
            }
        }
    }
    assert!(in_theme > 0, "the theme names no colour: this test no longer finds them");
}

#[test]
fn unsafe_and_missing_docs_are_forbidden_in_every_crate() {
    let root = root();
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    for rule in ["unsafe_code = \"forbid\"", "missing_docs = \"deny\"", "disallowed_methods = \"deny\""] {
        assert!(manifest.contains(rule), "Cargo.toml no longer says {rule}");
    }
    for (_, folder) in CRATES {
        let manifest = fs::read_to_string(root.join(folder).join("../Cargo.toml")).unwrap();
        assert!(manifest.contains("[lints]\nworkspace = true\n"), "{folder} does not take the lints of the workspace");
    }
    let banned = fs::read_to_string(root.join("clippy.toml")).unwrap();
    // the functions of unspecified precision by the documentation of f64 in `core`, and the three that differ otherwise
    let unspecified = "sin cos tan sin_cos asin acos atan atan2 sinh cosh tanh asinh acosh atanh hypot exp exp2 exp_m1 ln ln_1p \
                       log log2 log10 cbrt powf powi mul_add";
    for method in unspecified.split(' ') {
        for width in ["f64", "f32"] {
            assert!(banned.contains(&format!("\"{width}::{method}\"")), "clippy.toml does not ban {width}::{method}");
        }
    }
    for method in ["min", "max", "rem_euclid"] {
        assert!(banned.contains(&format!("\"f64::{method}\"")), "clippy.toml does not ban f64::{method}");
    }
}

/// `fuzz` is a crate of its own that only `tests/all/fuzz` compiles.
#[test]
fn the_fuzz_programs_are_alike_and_their_crate_names_what_their_sources_use() {
    let root = root();
    let text = |path: &str| fs::read_to_string(root.join(path)).unwrap();
    let files = |folder: &str| {
        let names =
            fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.ends_with(".rs")).map(|name| format!("{folder}/{name}")).collect::<BTreeSet<_>>()
    };
    let programs = files("fuzz/fuzz_targets");
    for program in &programs {
        let name = program.rsplit('/').next().unwrap().trim_end_matches(".rs");
        let body = "libfuzzer_sys::fuzz_target!(|data: &[u8]| {\n    check(data);\n});\n";
        let expected = format!("#![no_main]\n\nuse motion_lab_fuzz::targets::{name}::check;\n\n{body}");
        assert_eq!(text(program), expected, "{program}");
    }
    assert!(programs.len() > 10, "only {}: this test no longer finds the programs", programs.len());

    // the sources, with those that they take in by a path from the root
    let mut sources: String = files("tests/fuzz").iter().map(|file| text(file)).collect();
    let taken: Vec<String> =
        sources.split("#[path = \"../../").skip(1).map(|rest| text(rest.split('"').next().unwrap())).collect();
    assert!(!taken.is_empty(), "nothing is taken in: this test no longer reads the sources");
    sources.extend(taken);
    let manifest = text("fuzz/Cargo.toml");
    let mut named = 0;
    for dependency in text("Cargo.toml").lines().filter_map(|line| line.split_once([' ', '.']).map(|(name, _)| name)) {
        let path = format!("{}::", dependency.replace('-', "_"));
        let is_used = sources
            .match_indices(&path)
            .any(|(at, _)| !sources[..at].ends_with(|c: char| c.is_alphanumeric() || "_:".contains(c)));
        if is_used && dependency.starts_with(|c: char| c.is_ascii_lowercase()) {
            assert!(manifest.contains(&format!("\n{dependency} = ")), "fuzz/Cargo.toml does not name {dependency}");
            named += 1;
        }
    }
    assert!(named > 1, "{named} crates are named: this test no longer reads the manifests");
}

/// The crates that a crate needs, with what it needs itself, each once.
fn crates(package: &str) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "-e", "normal", "--prefix", "none", "--package", package])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let name = |line: &str| line.split(' ').take(2).collect::<Vec<_>>().join(" ");
    String::from_utf8(output.stdout).unwrap().lines().filter(|l| !l.is_empty()).map(name).collect()
}

#[test]
fn the_core_depends_on_what_planners_need() {
    let core = crates("motion-lab-core");
    assert!(core.len() <= 80, "{} crates: {core:?}", core.len());
    for stranger in ["bevy", "egui", "clap", "resvg", "usvg", "prost", "mcap", "serde_json"] {
        assert!(!core.iter().any(|c| c.starts_with(stranger)), "the core depends on {stranger}");
    }
    assert!(core.iter().any(|c| c.starts_with("parry2d-f64 ")), "this test no longer reads the tree: {core:?}");
    let sim = crates("motion-lab-sim");
    assert!(sim.iter().any(|c| c.starts_with("bevy_ecs ")) && sim.iter().any(|c| c.starts_with("mcap ")));
    for stranger in ["clap", "resvg", "usvg", "roxmltree", "egui", "bevy_render", "saphyr-parser"] {
        assert!(!sim.iter().any(|c| c.starts_with(&format!("{stranger} "))), "the simulator depends on {stranger}");
    }
    let import = crates("motion-lab-import");
    assert!(import.iter().any(|c| c.starts_with("roxmltree ")));
    // it reads drawings itself, in double precision
    for stranger in ["bevy", "resvg", "usvg"] {
        assert!(!import.iter().any(|c| c.starts_with(stranger)), "the import depends on {stranger}");
    }
}

/// Planners handle the lab's own types only. A signature is the text from `pub` to the next brace or semicolon.
#[test]
fn no_public_signature_of_the_core_names_the_crate_behind_short_lists() {
    let mut signatures = 0;
    for source in sources() {
        let Source { file, lines, .. } = &source;
        if source.of_crate() != "motion_lab_core" || file.ends_with("/short_list.rs") {
            continue;
        }
        let text = lines.join("\n");
        for (at, _) in text.match_indices("pub ") {
            let signature = text[at..].split(['{', ';']).next().unwrap_or_default();
            // the fields of a tuple struct are private where they don't say otherwise
            let signature = if signature.starts_with("pub struct") { "" } else { signature };
            assert!(!signature.to_lowercase().contains("smallvec"), "{file}: {signature}");
            signatures += 1;
        }
    }
    assert!(signatures > 500, "only {signatures} signatures: this test no longer reads the sources");
}
