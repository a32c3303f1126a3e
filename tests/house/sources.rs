//! The project's source files and their imports: enough of Rust's grammar for `use` trees and paths.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The crates, each below those before it, with their folders. The last has the library and the program on top of it.
pub const CRATES: [(&str, &str); 5] = [
    ("motion_lab_core", "crates/core/src"),
    ("motion_lab_sim", "crates/sim/src"),
    ("motion_lab_import", "crates/import/src"),
    ("motion_lab_raster", "crates/raster/src"),
    ("motion_lab", "src"),
];

/// A source file of one of the crates.
pub struct Source {
    /// Its path from the root on, with `/`.
    pub file: String,
    /// Its module, from the crate on: `motion_lab_core::collision::broad::index`.
    pub module: Vec<String>,
    /// Its text without comments, line by line.
    pub lines: Vec<String>,
    /// The line on which its tests begin, if it has any.
    tests: usize,
}

impl Source {
    /// Its crate.
    pub fn of_crate(&self) -> &str {
        &self.module[0]
    }

    /// The room: the module below the crate.
    pub fn room(&self) -> &str {
        self.module.get(1).map_or("", String::as_str)
    }

    /// Whether it is a room's own file, which declares and re-exports.
    pub fn is_room(&self) -> bool {
        self.file.ends_with("/mod.rs")
    }

    /// The lines without those of its tests.
    pub fn code(&self) -> &[String] {
        &self.lines[..self.tests]
    }

    /// The items of the crates that it names outside its tests, as paths from the crate on.
    pub fn imports(&self) -> Vec<Vec<String>> {
        self.imports_in(self.code())
    }

    /// As [`imports`](Self::imports), with those of its tests.
    pub fn all_imports(&self) -> Vec<Vec<String>> {
        self.imports_in(&self.lines)
    }

    fn imports_in(&self, lines: &[String]) -> Vec<Vec<String>> {
        let text = lines.join("\n");
        let mut found = Vec::new();
        for (at, _) in text.match_indices("use ") {
            let line = text[..at].rsplit('\n').next().unwrap_or_default().trim_start();
            if line.is_empty() || line.starts_with("pub") {
                let tree = text[at + 4..].split(';').next().unwrap_or_default();
                leaves(&[], tree, &mut found);
            }
        }
        let crates = CRATES.map(|(name, _)| format!("{name}::"));
        for start in ["crate::", "super::"].into_iter().chain(crates.iter().map(String::as_str)) {
            for (at, _) in text.match_indices(start) {
                if !text[..at].ends_with([':', '_']) && !text[..at].ends_with(char::is_alphanumeric) {
                    let path = text[at..].split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).next();
                    found.push(
                        path.unwrap_or_default().split("::").filter(|s| !s.is_empty()).map(str::to_owned).collect(),
                    );
                }
            }
        }
        found.into_iter().filter_map(|path| self.absolute(path)).collect()
    }

    /// The path from its crate on; `None` for a path of a stranger's crate.
    fn absolute(&self, path: Vec<String>) -> Option<Vec<String>> {
        let supers = path.iter().take_while(|s| *s == "super").count();
        let rest = path[supers..].to_vec();
        match path.first()?.as_str() {
            "crate" => Some([vec![self.module[0].clone()], path[1..].to_vec()].concat()),
            name if CRATES.iter().any(|(known, _)| *known == name) => Some(path),
            "self" => Some([self.module.clone(), path[1..].to_vec()].concat()),
            "super" => Some([self.module[..self.module.len().saturating_sub(supers)].to_vec(), rest].concat()),
            // a room's own file names its children without a prefix
            _ if self.is_room() => Some([self.module.clone(), path].concat()),
            _ => None,
        }
    }
}

/// The leaves of a `use` tree under a prefix.
fn leaves(prefix: &[String], tree: &str, found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let Some((head, inner)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default();
        let own = path
            .split("::")
            .map(str::trim)
            .filter(|s| !s.is_empty() && *s != "self" || prefix.is_empty() && *s == "self");
        found.push([prefix, &own.map(str::to_owned).collect::<Vec<_>>()].concat());
        return;
    };
    let own: Vec<String> = head.split("::").map(str::trim).filter(|s| !s.is_empty()).map(str::to_owned).collect();
    let prefix = [prefix, &own].concat();
    let (mut depth, mut from) = (0, 0);
    let inner = inner.strip_suffix('}').unwrap_or(inner);
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let leaf = inner[from..at].trim();
                if !leaf.is_empty() {
                    leaves(&prefix, leaf, found);
                }
                from = at + 1;
            }
            _ => {}
        }
    }
}

/// The folder of the whole project.
pub fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).unwrap()
}

/// All files with this ending under a folder, sorted.
pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Every source file of the crates.
pub fn sources() -> Vec<Source> {
    let root = root();
    let read = |name: &str, folder: &str, path: PathBuf| {
        let file = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&path).unwrap();
        let lines: Vec<String> = text.lines().map(|l| l.split("//").next().unwrap().to_owned()).collect();
        let tests = lines.iter().position(|l| l.starts_with("mod tests {")).unwrap_or(lines.len());
        let below = file[folder.len() + 1..].trim_end_matches(".rs").trim_end_matches("/mod");
        let below = if ["lib", "main"].contains(&below) { "" } else { below };
        let parts = below.split('/').filter(|s| !s.is_empty()).map(str::to_owned);
        let module = [vec![name.to_owned()], parts.collect()].concat();
        Source { file, module, lines, tests }
    };
    let of_crate = |(name, folder): (&'static str, &'static str)| {
        files(&root.join(folder), "rs").into_iter().map(move |path| read(name, folder, path))
    };
    CRATES.into_iter().flat_map(of_crate).collect()
}

/// The imports from file to file. An item that a room re-exports leads to the file that defines it.
pub struct Graph<'a> {
    files: BTreeMap<&'a [String], &'a Source>,
    exports: BTreeMap<Vec<String>, Vec<String>>,
}

impl<'a> Graph<'a> {
    /// The imports of these files.
    pub fn new(sources: &[&'a Source]) -> Self {
        let files: BTreeMap<&[String], &Source> = sources.iter().map(|s| (&s.module[..], *s)).collect();
        let mut exports = BTreeMap::new();
        for room in sources.iter().filter(|s| s.is_room()) {
            for path in room.imports() {
                if path.len() > room.module.len() && path.starts_with(&room.module) {
                    let name = path.last().cloned().unwrap_or_default();
                    let exported = [room.module.clone(), vec![name]].concat();
                    // a file that shares its name with an item is found without an export
                    if !files.contains_key(&exported[..]) {
                        exports.insert(exported, path);
                    }
                }
            }
        }
        Graph { files, exports }
    }

    /// The file that defines the item of a path.
    fn home(&self, path: &[String]) -> Option<&'a Source> {
        if let Some(target) = self.exports.get(path)
            && target != path
        {
            return self.home(target);
        }
        (1..=path.len()).rev().find_map(|n| {
            let end = &path[..n];
            if n < path.len()
                && let Some(target) = self.exports.get(end)
                && target != end
            {
                return self.home(target);
            }
            self.files.get(end).copied()
        })
    }

    /// The files that a file imports from. A room's own file imports nothing from its room: it re-exports.
    pub fn uses(&self, source: &Source) -> Vec<&'a Source> {
        let paths = source.imports().into_iter();
        let paths = paths.filter(|path| !(source.is_room() && path.starts_with(&source.module)));
        // the beginning of a tree, `super` of `use super::{Frame, Log}`, is a room above and no item of it
        let paths = paths.filter(|path| !source.module.starts_with(path));
        let mut used: Vec<&Source> = paths
            .filter_map(|path| self.home(&path))
            .filter(|s| {
                s.file != source.file && !["src/lib.rs", "src/main.rs"].iter().any(|root| s.file.ends_with(root))
            })
            .collect();
        used.sort_by(|a, b| a.file.cmp(&b.file));
        used.dedup_by(|a, b| a.file == b.file);
        used
    }
}

#[test]
fn imports_inside_braces_are_seen() {
    let mut found = Vec::new();
    leaves(&[], "crate::{run::{self, Frame as F, mcap::Writer}, simulation::Transport}", &mut found);
    let found: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["crate::run", "crate::run::Frame", "crate::run::mcap::Writer", "crate::simulation::Transport"]);
    let lines = "use super::{\n    Frame,\n    mcap::{Reader, Writer},\n};\nlet x = motion_lab_core::num::sin(1.0);";
    let source = Source {
        file: "crates/sim/src/run/log.rs".into(),
        module: ["motion_lab_sim", "run", "log"].map(str::to_owned).to_vec(),
        lines: lines.lines().map(str::to_owned).collect(),
        tests: 5,
    };
    let found: Vec<String> = source.imports().iter().map(|path| path.join("::")).collect();
    let expected = ["Frame", "mcap::Reader", "mcap::Writer"].map(|item| format!("motion_lab_sim::run::{item}"));
    assert!(expected.iter().all(|e| found.contains(e)), "{found:?}");
    assert!(found.iter().any(|f| f == "motion_lab_core::num::sin"), "{found:?}");
}
