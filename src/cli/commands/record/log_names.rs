//! `LogNames`, the names of many seeds' logs.

use std::path::{Path, PathBuf};

use super::seeds::SeedRange;
use crate::cli::Failure;
use crate::cli::support::target::{Target, numbers_in};

/// What stands for the seed.
const SEED: &str = "{seed}";

/// The names of many seeds' logs: one name with `{seed}` in it.
pub struct LogNames(String);

impl LogNames {
    /// The names that this output stands for.
    ///
    /// # Errors
    /// [`Failure::Usage`] where it is one name.
    pub fn of(output: &Path) -> Result<Self, Failure> {
        match output.to_str() {
            Some(name) if name.contains(SEED) => Ok(LogNames(name.to_owned())),
            _ => Err(Failure::usage(
                format!("{}: one name for many logs", output.display()),
                "Put {seed} in it, as in -o runs/{seed}.mcap.",
            )),
        }
    }

    /// The log of a seed.
    pub fn log(&self, seed: u64) -> PathBuf {
        self.0.replace(SEED, &seed.to_string()).into()
    }

    /// Refuses these seeds if the log of one, whole or unfinished, would be an input.
    ///
    /// # Errors
    /// [`Failure::Usage`] with the log's name and the input's.
    pub fn check(&self, seeds: SeedRange) -> Result<(), Failure> {
        self.there(seeds).iter().try_for_each(|log| Target::check_log(log))
    }

    /// Whether no two of these seeds have one log. Where `{seed}` names folders only, or a log is a link, it may be so.
    pub fn are_apart(&self, seeds: SeedRange) -> bool {
        let name = Path::new(&self.0).file_name().unwrap_or_default();
        name.to_string_lossy().contains(SEED) && !self.there(seeds).iter().any(|log| log.is_symlink())
    }

    /// The logs of these seeds that may be there, whole or unfinished.
    fn there(&self, seeds: SeedRange) -> Vec<PathBuf> {
        let (folder, before) = self.before_seed();
        numbers_in(folder, before).range(seeds.first..seeds.end).map(|seed| self.log(*seed)).collect()
    }

    /// The folder in whose names the first `{seed}` stands, and what stands before it there.
    fn before_seed(&self) -> (&Path, &str) {
        let before = self.0.split(SEED).next().unwrap_or_default();
        let name = before.rfind(std::path::is_separator).map_or(0, |separator| separator + 1);
        (if name == 0 { Path::new(".") } else { Path::new(&before[..name]) }, &before[name..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_is_looked_for_in_the_folder_that_the_name_says() {
        for (output, folder, before) in [
            ("{seed}.mcap", ".", ""),
            ("run-{seed}.mcap", ".", "run-"),
            ("runs/a/{seed}.mcap", "runs/a", ""),
            ("/runs/{seed}/b-{seed}.mcap", "/runs", ""),
            ("/{seed}", "/", ""),
        ] {
            let names = LogNames::of(Path::new(output)).unwrap();
            assert_eq!(names.before_seed(), (Path::new(folder), before), "{output}");
        }
    }

    #[test]
    fn logs_are_apart_by_their_own_names_but_not_by_links_or_folders() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("2.mcap"), "").unwrap();
        let are_apart = |name: &str, first, end| {
            LogNames::of(&folder.path().join(name)).unwrap().are_apart(SeedRange { first, end })
        };
        for (name, expected) in
            [("{seed}.mcap", true), ("{seed}/a-{seed}.mcap", true), ("{seed}/run.mcap", false), ("{seed}/..", false)]
        {
            assert_eq!(are_apart(name, 0, 9), expected, "{name}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("3.mcap", folder.path().join("5.mcap")).unwrap();
            assert_eq!(
                [(0, 9), (5, 6), (0, 5), (6, 9)].map(|(first, end)| are_apart("{seed}.mcap", first, end)),
                [false, false, true, true]
            );
            assert!(are_apart("x{seed}.mcap", 0, 9));
        }
    }
}
