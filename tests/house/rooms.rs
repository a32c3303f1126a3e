//! Limits on the size of rooms and files, and on circles of imports.

use std::collections::BTreeMap;
use std::fs;

use super::sources::{CRATES, Graph, Source, files, root, sources};

/// Largest number of lines in a source file.
const LONGEST: usize = 400;

/// Where the project's Rust stands.
const FOLDERS: [&str; 6] = ["src", "crates", "tests", "benches", "examples", "python/src"];

/// Largest number of files in a room, without its own file and its tests.
const LARGEST: usize = 15;

#[test]
fn no_source_file_is_longer_than_400_lines() {
    let root = root();
    let mut longest = (0, String::new());
    for folder in FOLDERS {
        for path in files(&root.join(folder), "rs") {
            let lines = fs::read_to_string(&path).unwrap().lines().count();
            longest = longest.max((lines, path.strip_prefix(root).unwrap().display().to_string()));
        }
    }
    assert!(longest.0 <= LONGEST, "{} has {} lines", longest.1, longest.0);
    assert!(longest.0 > LONGEST / 2, "the longest has {} lines: this test no longer reads the files", longest.0);
}

#[test]
fn comments_keep_the_line_width() {
    let root = root();
    let mut comments = 0;
    for folder in FOLDERS {
        for path in files(&root.join(folder), "rs") {
            for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
                let text = line.trim_start();
                // a row of a table has one line, and a string may hold a comment of another language
                if text.starts_with("//") && !text.starts_with("//! |") && !text.contains("\\n") {
                    comments += 1;
                    let width = line.chars().count();
                    assert!(width <= 120, "{}:{}: {width} columns", path.display(), number + 1);
                }
            }
        }
    }
    assert!(comments > 5000, "{comments} lines of comments: this test no longer reads the files");
}

#[test]
fn pages_keep_the_line_width() {
    let mut prose = 0;
    let pages = ["docs", "src/guide"].into_iter().flat_map(|folder| files(&root().join(folder), "md"));
    let own = ["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "CHANGELOG.md"].map(|page| root().join(page));
    for path in pages.chain(own) {
        let (mut is_code, text) = (false, fs::read_to_string(&path).unwrap());
        for (number, line) in text.lines().enumerate() {
            is_code ^= line.trim_start().starts_with("```");
            // a row of a table has one line, and so has what a bench writes below its table
            let is_one_line = line.starts_with(['|', '<']) || line.starts_with("Times are medians");
            if !is_code && !is_one_line {
                prose += 1;
                let width = line.chars().count();
                assert!(width <= 120, "{}:{}: {width} columns", path.display(), number + 1);
            }
        }
    }
    assert!(prose > 1500, "{prose} lines: this test no longer reads the pages");
}

#[test]
fn the_files_that_pages_name_exist() {
    let known: Vec<String> = FOLDERS
        .iter()
        .flat_map(|folder| files(&root().join(folder), "rs"))
        .map(|path| format!("/{}", path.strip_prefix(root()).unwrap().display()))
        .collect();
    let mut named = 0;
    for page in
        ["ARCHITECTURE.md", "CONTRIBUTING.md", "docs/how-we-know.md", "docs/web.md", "src/guide/write_a_planner.md"]
    {
        let text = fs::read_to_string(root().join(page)).unwrap();
        for name in text.split(|c: char| !(c.is_ascii_alphanumeric() || "_/.".contains(c))) {
            // a name of a pattern, as of `NAME.rs`, is of no file
            if name.ends_with(".rs") && name.len() > 3 && !name.contains("NAME") && name != "src/main.rs" {
                named += 1;
                let is_known = known.iter().any(|path| path.ends_with(&format!("/{name}")));
                assert!(is_known, "{page} names {name}, and there is no such file");
            }
        }
    }
    assert!(named > 80, "{named} files: this test no longer reads the pages");
}

#[test]
fn no_room_is_crowded() {
    let mut rooms: BTreeMap<String, usize> = BTreeMap::new();
    for source in sources() {
        if let Some((room, name)) = source.file.rsplit_once('/') {
            *rooms.entry(room.to_owned()).or_default() += usize::from(!["mod.rs", "tests.rs"].contains(&name));
        }
    }
    let (room, files) = rooms.iter().max_by_key(|(_, files)| **files).unwrap();
    assert!(*files <= LARGEST, "{room} has {files} files");
    assert!(rooms.len() > 30, "{} rooms: this test no longer reads the sources", rooms.len());
}

#[test]
fn readme_is_a_two_minute_read() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let words = readme.split_whitespace().count();
    assert!(words <= 1500, "{words} words: the rest belongs under docs");
    assert!(words > 500, "{words} words");
}

/// The state of a file in a walk through the imports.
#[derive(Clone, Copy, PartialEq)]
enum Seen {
    Never,
    OnTheWay,
    Done,
}

/// The files of a circle that a walk from `at` finds, if any.
fn circle(at: usize, uses: &[Vec<usize>], seen: &mut [Seen], way: &mut Vec<usize>) -> Option<Vec<usize>> {
    seen[at] = Seen::OnTheWay;
    way.push(at);
    for &next in &uses[at] {
        match seen[next] {
            Seen::OnTheWay => return way.iter().position(|w| *w == next).map(|from| way[from..].to_vec()),
            Seen::Never => {
                if let Some(found) = circle(next, uses, seen, way) {
                    return Some(found);
                }
            }
            Seen::Done => {}
        }
    }
    seen[at] = Seen::Done;
    way.pop();
    None
}

fn first_circle(uses: &[Vec<usize>]) -> Option<Vec<usize>> {
    let mut seen = vec![Seen::Never; uses.len()];
    (0..uses.len()).find_map(
        |at| {
            if seen[at] == Seen::Never { circle(at, uses, &mut seen, &mut Vec::new()) } else { None }
        },
    )
}

#[test]
fn no_circle_of_files() {
    let sources = sources();
    let (mut arrows, mut circles) = (0, Vec::new());
    for (name, _) in CRATES {
        let part: Vec<&Source> = sources.iter().filter(|s| s.of_crate() == name).collect();
        let graph = Graph::new(&part);
        let number = |s: &Source| part.iter().position(|p| p.file == s.file).unwrap();
        let mut uses: Vec<Vec<usize>> =
            part.iter().map(|s| graph.uses(s).into_iter().map(number).collect::<Vec<_>>()).collect();
        arrows += uses.iter().map(Vec::len).sum::<usize>();
        while let Some(circle) = first_circle(&uses) {
            let names: Vec<&str> = circle.iter().map(|&k| part[k].file.as_str()).collect();
            circles.push(names.join(" -> "));
            let (last, first) = (circle[circle.len() - 1], circle[0]);
            uses[last].retain(|&k| k != first);
        }
    }
    assert!(circles.is_empty(), "circles:\n{}", circles.join("\n"));
    assert!(arrows > 1000, "{arrows} imports: this test no longer reads the sources");
}

/// The two files of the window that put its app together: what starts it, `desktop/window.rs`, asks them for it.
const OF_THE_APP: [&str; 2] = ["src/window/mod.rs", "src/window/desktop/mod.rs"];

/// A room's own file is its shop window, not a corridor: what its files share has a file of its own, so that inside a
/// room all arrows go down.
#[test]
fn no_file_imports_what_its_own_rooms_file_defines() {
    let sources = sources();
    let (mut within, mut upward) = (0, Vec::new());
    for (name, _) in CRATES {
        let part: Vec<&Source> = sources.iter().filter(|s| s.of_crate() == name).collect();
        let graph = Graph::new(&part);
        for source in part.iter().filter(|s| !s.file.ends_with("/tests.rs") && !s.file.contains("/tests/")) {
            for used in graph.uses(source).into_iter().filter(|used| used.room() == source.room()) {
                within += 1;
                let is_above = used.is_room() && source.module.starts_with(&used.module);
                if is_above && !OF_THE_APP.contains(&used.file.as_str()) {
                    upward.push(format!("{} -> {}", source.file, used.file));
                }
            }
        }
    }
    assert!(upward.is_empty(), "{} arrows go up:\n{}", upward.len(), upward.join("\n"));
    assert!(within > 800, "{within} arrows within rooms: this test no longer reads the sources");
}

#[test]
fn a_circle_is_found() {
    assert_eq!(first_circle(&[vec![1], vec![2], vec![], vec![0, 4], vec![5], vec![3]]), Some(vec![3, 4, 5]));
    assert_eq!(first_circle(&[vec![1, 2], vec![2], vec![]]), None);
}

#[test]
fn every_file_of_tests_is_a_module_of_its_main() {
    let root = root();
    let mut declared = 0;
    for folder in ["tests", "crates/core/tests", "crates/sim/tests", "crates/import/tests"] {
        let folder = root.join(folder);
        for path in files(&folder, "rs") {
            let below = path.strip_prefix(&folder).unwrap();
            // crates have a root, and the snippets are included
            let is_root = ["main.rs", "lib.rs"].iter().any(|name| path.ends_with(name));
            if is_root || below.starts_with("snippets") || below.starts_with("oracle/src") {
                continue;
            }
            let stem = path.file_stem().unwrap().to_str().unwrap();
            let (parent, module) = match (stem, path.parent().unwrap()) {
                ("mod", own) => (own.parent().unwrap(), own.file_name().unwrap().to_str().unwrap()),
                (_, parent) => (parent, stem),
            };
            let own = ["main.rs", "lib.rs", "mod.rs"].map(|name| parent.join(name));
            let parents = own.into_iter().chain([parent.with_extension("rs")]);
            let declares =
                |text: String| text.lines().any(|l| l.trim_start_matches("pub ") == format!("mod {module};"));
            let found = parents.filter_map(|p| fs::read_to_string(p).ok()).any(declares);
            assert!(found, "{}: no file declares the module {module}, so its tests never run", path.display());
            declared += 1;
        }
    }
    assert!(declared > 100, "{declared} files: this test no longer reads the folders");
}
