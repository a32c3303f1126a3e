//! Parts, journals and tables: they come back, and damaged ones do not.

use super::super::*;
use super::study;

/// A part of rows 2 to 4 of five failed runs.
fn part(study: &Study) -> Vec<u8> {
    let mut writer = PartWriter::new(Vec::new(), &PartHead::new(study, 2..5), study.columns()).unwrap();
    (2..5).for_each(|row| writer.row(&study.failed(row, "a, \"b\"").to_line()).unwrap());
    writer.finish().unwrap()
}

fn read(bytes: &[u8]) -> Result<Vec<RunRow>, PartError> {
    let mut reader = PartReader::new(bytes)?;
    let mut rows = Vec::new();
    while let Some((row, _)) = reader.row()? {
        rows.push(row);
    }
    Ok(rows)
}

/// A part's text with its seal.
fn sealed(text: &str) -> String {
    format!("{text}seal {:032x}\n", xxhash_rust::xxh3::xxh3_128(text.as_bytes()))
}

#[test]
fn a_part_comes_back_and_no_damaged_one_is_taken_for_whole() {
    let study = study("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(0, 5))])");
    let whole = part(&study);
    assert_eq!(read(&whole).unwrap(), (2..5).map(|row| study.failed(row, "a, \"b\"")).collect::<Vec<_>>());
    let text = String::from_utf8(whole.clone()).unwrap();
    assert!(text.contains("\nrows 2..5 of 5\n"));
    let rows = text.rfind("rows 2..5").unwrap();
    // every byte from the rows on, cut off there or changed
    for at in rows..whole.len() {
        assert!(read(&whole[..at]).is_err(), "cut at {at}");
        let mut changed = whole.clone();
        changed[at] ^= 1;
        assert!(read(&changed).is_err(), "changed at {at}");
    }
    assert!(read(&[&whole[..], b"\n"].concat()).is_err(), "something behind its seal");
    assert!(matches!(read(b"Sweep(version: 1)"), Err(PartError::NotAPart)));
    assert!(matches!(read(b""), Err(PartError::Empty)));
    // a damaged study is damage, not the study of another version
    let line = text.find("motion-lab sweep 1").unwrap();
    for (at, byte) in [(line + 17, b'2'), (text.find("worlds").unwrap(), b'W'), (text.find("{").unwrap(), b'(')] {
        let mut changed = whole.clone();
        changed[at] = byte;
        assert!(matches!(read(&changed), Err(PartError::Seal)), "byte {at}");
    }
    let later = text[..text.rfind("seal ").unwrap()].replace("motion-lab sweep 1", "motion-lab sweep 2");
    let sealed = sealed(&later);
    assert!(matches!(read(sealed.as_bytes()), Err(PartError::Study(reason)) if reason.contains("sweep 2")));
    assert!(matches!(read(format!("{sealed}\n").as_bytes()), Err(PartError::Seal)));
}

#[test]
fn the_rows_of_a_part_are_written_in_one_way() {
    let study = study("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(0, 5))])");
    let text = String::from_utf8(part(&study)).unwrap();
    let with = |rows: &str| sealed(&text[..text.rfind("seal ").unwrap()].replace("\nrows 2..5 of 5\n", rows));
    assert_eq!(with("\nrows 2..5 of 5\n"), text);
    for other in ["+2..5 of 5", "2..+5 of 5", "2..5 of +5", "02..5 of 5", "2..05 of 5", "2..5 of 05", "2..5 of 5 "] {
        let refused = read(with(&format!("\nrows {other}\n")).as_bytes());
        assert!(matches!(refused, Err(PartError::Line(3))), "{other}: {refused:?}");
    }
}

#[test]
fn a_journals_line_is_known_whole() {
    let study = study("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(0, 5))])");
    let line = study.failed(3, "b").to_line();
    let sealed = sealed_line(&line);
    let sealed = sealed.strip_suffix('\n').unwrap();
    assert_eq!(unsealed_line(sealed, study.columns()), Some((3, line.as_str())));
    for at in 0..sealed.len() {
        assert_eq!(unsealed_line(&sealed[..at], study.columns()), None, "cut at {at}");
    }
    assert_eq!(unsealed_line(&sealed.replace(",b,", ",c,"), study.columns()), None);
}

#[test]
fn a_table_comes_back_row_by_row() {
    let study = study(
        "Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(18446744073709551000, 18446744073709551500))])",
    );
    let rows: Vec<RunRow> = (0..study.runs())
        .map(|row| {
            let mut made = study.failed(row, if row % 3 == 0 { "l'\u{e9}t\u{e9}" } else { "" });
            let x = study.columns().iter().position(|column| column.name == "path_m").unwrap();
            made.cells[x] = RowValue::Number(row as f64 / 7.0);
            made
        })
        .collect();
    let mut writer = TableWriter::new(Vec::new(), &study).unwrap();
    rows.iter().for_each(|row| writer.row(row.clone()).unwrap());
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), writer.finish().unwrap()).unwrap();
    let table = TableFile::open(file.reopen().unwrap()).unwrap();
    assert_eq!(table.study().line(), study.line());
    let mut seen = Vec::new();
    table.each(|row| seen.push(row)).unwrap();
    assert_eq!(seen, rows);
    assert_eq!(table.row(499).unwrap(), rows[499]);
    assert!(matches!(table.row(500), Err(TableError::NoRow { row: 500, rows: 500 })));
    std::fs::write(file.path(), b"PAR1 and nothing else").unwrap();
    assert!(TableFile::open(file.reopen().unwrap()).is_err());
}

#[test]
fn a_refusal_is_one_short_line_whatever_stands_in_the_file() {
    let long = "long_".repeat(100_000);
    for (text, begins) in [
        (format!("Sweep(version: 1, {long}: 2)"), "study.ron:1:"),
        (
            format!("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"{long}\", over: Range(0, 5))])"),
            "study.ron:1:",
        ),
        (format!("Sweep(version: 1, worlds: [\"lot\"], robots: [\"{long}\"])"), "study.ron:1:"),
    ] {
        let worlds = [("lot".to_owned(), motion_lab_core::worlds::World::lot())].into();
        let study = StudyFile::parse("study.ron", &text).and_then(|file| file.with(&worlds, &[].into()));
        let refused = study.unwrap_err().to_string();
        assert!(refused.starts_with(begins) && refused.contains("long_") && refused.len() < 2000, "{refused:.200}");
    }
    let forged = format!("motion-lab sweep part 1\n{{\"{long}\n\": 1}}\n");
    let refused = PartReader::new(sealed(&forged).as_bytes()).err().unwrap().to_string();
    assert!(refused.lines().count() == 1 && refused.len() < 1000, "{refused:.200}");
}
