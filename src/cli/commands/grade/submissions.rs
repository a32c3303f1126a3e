//! The submissions named on the command line: files, folders, and patterns that a shell did not resolve.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::cli::Failure;
use crate::cli::support::input::unreadable;

/// How deep folders are looked into.
const DEEPEST: usize = 8;

/// Largest number of files in the folders and patterns of one command.
const MAX_SUBMISSIONS: usize = 100_000;

/// The endings of what can be handed in, in any case of letters.
const ENDINGS: [&str; 5] = ["ron", "mcap", "csv", "html", "htm"];

/// The title of every page that the lab saves (assets/web/saved.html), and how far into a page it is looked for, bytes.
const SAVED_TITLE: &str = "<title>A run of the motion lab</title>";
const HEAD: u64 = 4096;

/// What the command line names.
#[derive(Default)]
pub struct Submissions {
    /// The submissions that are graded, each of which gets a row.
    pub graded: Vec<PathBuf>,
    /// What is left out of the folders, each with the reason.
    pub left_out: Vec<(PathBuf, &'static str)>,
}

/// The files that `names` name, in their order. A folder stands for the scripts, logs, pages and tables in it and in
/// its folders, by name, but for the file `assignment`; whatever else it holds is left out by name. A pattern with `*`
/// or `?` that is no file's name stands for the files that match it. A folder or a pattern without any stays itself.
/// Any other name is taken as it is, whether there is such a file or not.
pub fn find(names: &[PathBuf], assignment: &Path) -> Result<Submissions, Failure> {
    let own = fs::canonicalize(assignment).ok();
    let is_assignment = |file: &PathBuf| own.is_some() && fs::canonicalize(file).ok() == own;
    let mut submissions = Submissions::default();
    for name in names {
        let before = submissions.graded.len();
        if name.is_dir() {
            walk(name, 0, &mut submissions)?;
        } else if !name.exists() && is_pattern(name) {
            matching(name, &mut submissions)?;
        } else {
            submissions.graded.push(name.clone());
            continue;
        }
        let mut new = submissions.graded.split_off(before);
        new.retain(|file| !is_assignment(file));
        if new.is_empty() {
            // it gets a row that says so
            new.push(name.clone());
        }
        submissions.graded.append(&mut new);
    }
    submissions.left_out.retain(|(file, _)| !is_assignment(file));
    Ok(submissions)
}

/// The ending of a file's name in small letters; empty without one.
pub fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// Why a file of a folder is no submission; `None` for one that is.
fn reason_left_out(file: &Path) -> Option<&'static str> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    if name.starts_with('.') {
        return Some("it is hidden");
    }
    match ending(file).as_str() {
        "html" | "htm" if !is_saved_page(file) => Some("it is a page that the lab did not save"),
        known if ENDINGS.contains(&known) => None,
        "partial" => Some("it is the beginning of a log, which was not finished"),
        _ => Some("its name ends in none of .ron, .mcap, .html and .csv"),
    }
}

/// Whether a page says in its head that the lab saved it. One that does is read as a run, whatever is in it.
fn is_saved_page(file: &Path) -> bool {
    let mut head = Vec::new();
    let read = fs::File::open(file).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.is_ok() && String::from_utf8_lossy(&head).contains(SAVED_TITLE)
}

/// The files and folders in a folder, by name.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let read =
        fs::read_dir(folder).and_then(|all| all.map(|entry| entry.map(|e| e.path())).collect::<Result<Vec<_>, _>>());
    let mut all = read.map_err(|error| unreadable(folder, &error))?;
    all.sort();
    Ok(all)
}

/// Adds the submissions in a folder and its folders, and names what it leaves out. Links to folders are not followed.
fn walk(folder: &Path, depth: usize, submissions: &mut Submissions) -> Result<(), Failure> {
    for path in entries(folder)? {
        let reason = if !path.is_dir() {
            reason_left_out(&path)
        } else if path.is_symlink() {
            Some("it is a link to a folder")
        } else if depth == DEEPEST {
            Some("it lies too deep in folders")
        } else {
            walk(&path, depth + 1, submissions)?;
            continue;
        };
        match reason {
            None => push(path, submissions)?,
            Some(reason) => {
                submissions.check_room()?;
                submissions.left_out.push((path, reason));
            }
        }
    }
    Ok(())
}

impl Submissions {
    fn check_room(&self) -> Result<(), Failure> {
        if self.graded.len() + self.left_out.len() < MAX_SUBMISSIONS {
            return Ok(());
        }
        Err(Failure::input(format!("more than {MAX_SUBMISSIONS} submissions"), "Grade them in several parts."))
    }
}

fn push(path: PathBuf, submissions: &mut Submissions) -> Result<(), Failure> {
    submissions.check_room()?;
    submissions.graded.push(path);
    Ok(())
}

fn is_pattern(name: &Path) -> bool {
    name.to_str().is_some_and(|name| name.contains(['*', '?']))
}

/// Adds the files that a pattern matches.
fn matching(pattern: &Path, submissions: &mut Submissions) -> Result<(), Failure> {
    let mut places = vec![PathBuf::new()];
    for part in pattern.components() {
        let part = part.as_os_str();
        let mut next = Vec::new();
        for place in places {
            if !is_pattern(Path::new(part)) {
                next.push(place.join(part));
                continue;
            }
            let folder = if place.as_os_str().is_empty() { Path::new(".") } else { &place };
            if !folder.is_dir() {
                continue;
            }
            for entry in entries(folder)? {
                let Some(name) = entry.file_name() else { continue };
                if name.to_str().zip(part.to_str()).is_some_and(|(name, pattern)| matches(pattern, name)) {
                    next.push(place.join(name));
                }
            }
        }
        places = next;
    }
    places.into_iter().filter(|place| place.is_file()).try_for_each(|place| push(place, submissions))
}

/// Whether a name matches a pattern, in which `*` stands for any characters and `?` for one. A hidden file matches a
/// pattern that begins with its dot only.
fn matches(pattern: &str, name: &str) -> bool {
    if name.starts_with('.') && !pattern.starts_with('.') {
        return false;
    }
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    // the last star, and how much of the name it stands for
    let (mut p, mut n, mut star) = (0, 0, None);
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == '?' || *c == name[n] => (p, n) = (p + 1, n + 1),
            _ => match star {
                Some((at, taken)) => {
                    star = Some((at, taken + 1));
                    (p, n) = (at + 1, taken + 1);
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_and_question_marks_stand_for_what_shells_let_them_stand_for() {
        for (pattern, name, is) in [
            ("*.ron", "anna.ron", true),
            ("*.ron", "anna.mcap", false),
            ("*.ron", ".anna.ron", false),
            (".*", ".anna", true),
            ("a*a*b", "aaab", true),
            ("a*a*b", "ab", false),
            ("?nna", "anna", true),
            ("?nna", "nna", false),
            ("*", "", true),
            ("a*", "a", true),
            ("anna", "annab", false),
            ("\u{fc}?.ron", "\u{fc}\u{e9}.ron", true),
        ] {
            assert_eq!(matches(pattern, name), is, "{pattern} {name}");
        }
        // without going back only to the last star, this would not end
        assert!(!matches(&"a*".repeat(50), &format!("{}b", "a".repeat(40))));
    }
}
