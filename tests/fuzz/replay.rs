//! The files of the corpora: what each format looks like, what fuzzing found interesting, and what it found wrong.

use std::collections::BTreeSet;
use std::fs;
use std::panic::catch_unwind;
use std::path::Path;

use super::{FuzzTarget, TARGETS};

/// Most files of a corpus, and most bytes of all of them.
const MAX_FILES: usize = 30;
const MAX_BYTES: usize = 100_000;

/// The names in a folder, in order.
fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn every_file_of_the_corpora_passes_its_target() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus");
    let mut failed = Vec::new();
    for FuzzTarget { name, check } in TARGETS {
        let (mut bytes, mut read) = (0, 0);
        let files = names(&root.join(name));
        for file in &files {
            let data = fs::read(root.join(name).join(file)).unwrap();
            bytes += data.len();
            match catch_unwind(|| check(&data)) {
                Ok(is_read) => read += usize::from(is_read),
                Err(_) => failed.push(format!("tests/fuzz/corpus/{name}/{file}")),
            }
        }
        // a target that refuses all of them, or none, asks nothing
        assert!(read > 1 && read < files.len(), "{name}: {read} of {} files are read", files.len());
        assert!(files.len() <= MAX_FILES && bytes <= MAX_BYTES, "{name}: {} files, {bytes} bytes", files.len());
    }
    assert!(failed.is_empty(), "these fail; what is said above says why: {failed:#?}");
}

#[test]
fn each_target_has_its_program() {
    let programs = names(&Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/fuzz_targets"));
    assert_eq!(programs, TARGETS.iter().map(|target| format!("{}.rs", target.name)).collect());
}
