//! `world`: what is built in, and what is wrong with a file.

use std::fs;

use super::{json, run};

#[test]
fn the_built_in_worlds_are_listed_and_shown_as_files() {
    let folder = tempfile::tempdir().unwrap();
    let list = run(&["world", "list", "--json"]).done();
    let names: Vec<String> = list.lines().map(|l| json(l)["source"].as_str().unwrap().to_owned()).collect();
    assert_eq!(names, ["apartment", "workbench", "lot"]);
    for line in list.lines() {
        let world = json(line);
        let file = folder.path().join(format!("{}.ron", world["source"].as_str().unwrap()));
        let shown = run(&["world", "show", world["source"].as_str().unwrap()]).done();
        fs::write(&file, &shown).unwrap();
        let file = file.to_str().unwrap();
        let checked = json(&run(&["world", "check", "--json", file]).done());
        assert_eq!(checked["content_hash"], world["content_hash"], "the file is the world");
        assert_eq!(run(&["world", "show", file]).done(), shown);
    }
}

#[test]
fn every_wrong_file_is_named_and_the_right_ones_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let right = file("right.ron", run(&["world", "show", "lot"]).done().as_bytes());
    let small = "World(version: 1, name: \"w\", bounds: (min: (0, 0), max: (4, 3)),\n\
                 obstacles: [\n(name: \"the tree\", shape: Disc(center: (1, 1), radius: 0))])";
    let item = file("item.ron", small.as_bytes());
    let syntax = file("syntax.ron", b"World(\n  version: 1,\n  nome: 3)");
    let bytes = file("bytes.ron", b"World(\n\xff)");
    let huge = folder.path().join("huge.ron");
    fs::File::create(&huge).unwrap().set_len((64 << 20) + 1).unwrap();
    let huge = huge.to_str().unwrap().to_owned();
    let folder_name = folder.path().to_str().unwrap();

    let checked = run(&["world", "check", &item, &right, &syntax, &bytes, &huge, folder_name]);
    assert_eq!(checked.code, Some(3));
    assert_eq!(checked.out.lines().count(), 1);
    assert!(checked.out.starts_with(&format!("{right}: Lot, ")), "{}", checked.out);
    for message in [
        format!("{item}:3:1: obstacles[0] \"the tree\": radius 0 m"),
        format!("{syntax}:3:"),
        format!("{bytes}: not UTF-8: byte 7 (line 2)"),
        format!("{huge}: too large"),
        format!("{folder_name}: it is a folder"),
    ] {
        assert!(checked.err.contains(&message), "{message} is missing from\n{}", checked.err);
    }
}
