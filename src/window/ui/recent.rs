//! `Recent`, the files opened or saved last.

use std::path::{Path, PathBuf};

/// Largest number of files in the list.
const MAX_FILES: usize = 8;

/// The files opened or saved last, the newest first, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recent(Vec<PathBuf>);

impl Recent {
    /// The list as it was kept.
    pub fn of(kept: &[String]) -> Self {
        let mut recent = Recent::default();
        kept.iter().rev().for_each(|path| recent.put_first(Path::new(path)));
        recent
    }

    /// The list as it is kept. Paths that are no text are not.
    pub fn saved(&self) -> Vec<String> {
        self.0.iter().filter_map(|path| path.to_str().map(str::to_owned)).collect()
    }

    /// The files, the newest first.
    pub fn files(&self) -> &[PathBuf] {
        &self.0
    }

    /// Puts a file first.
    pub fn put_first(&mut self, path: &Path) {
        // the program may be started in another folder next time
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.0.retain(|other| *other != path);
        self.0.insert(0, path);
        self.0.truncate(MAX_FILES);
    }

    /// Takes a file off the list.
    pub fn remove(&mut self, path: &Path) {
        self.0.retain(|other| other != path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_stands_first_each_once_and_eight_at_most() {
        let mut recent = Recent::default();
        for i in 0..10 {
            recent.put_first(Path::new(&format!("/runs/{i}.mcap")));
        }
        recent.put_first(Path::new("/runs/4.mcap"));
        let names = |recent: &Recent| recent.saved().join(" ").replace("/runs/", "").replace(".mcap", "");
        assert_eq!(names(&recent), "4 9 8 7 6 5 3 2");
        assert_eq!(Recent::of(&recent.saved()), recent);
        recent.remove(Path::new("/runs/8.mcap"));
        assert_eq!(names(&recent), "4 9 7 6 5 3 2");
        // another folder of the same name's file is another file
        recent.put_first(Path::new("/else/9.mcap"));
        assert_eq!(names(&recent), "/else/9 4 9 7 6 5 3 2");
        let here = std::env::current_dir().unwrap().join("x.ron");
        recent.put_first(Path::new("x.ron"));
        assert_eq!(recent.files()[0], here);
    }
}
