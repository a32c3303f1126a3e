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
    // and so are columns that only another version has
    let other = text[..text.rfind("seal ").unwrap()].replace(",failure_kind,", ",");
    assert!(matches!(read(self::sealed(&other).as_bytes()), Err(PartError::Columns)));
    assert!(matches!(read(text.replace(",failure_kind,", ",").as_bytes()), Err(PartError::Line(4))));
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
    let bytes = writer.finish().unwrap();
    let opened = || opened(&bytes).unwrap();
    assert_eq!(opened().study().line(), study.line());
    let mut seen = Vec::new();
    assert_eq!(opened().each(|row| seen.push(row)).unwrap(), 500);
    assert_eq!(seen, rows);
    assert_eq!(opened().row(499).unwrap(), rows[499]);
    assert!(matches!(opened().row(500), Err(TableError::NoRow { row: 500, rows: 500 })));
    assert!(TableFile::open(on_disk(b"PAR1 and nothing else")).is_err());
}

/// Bytes as a file.
fn on_disk(bytes: &[u8]) -> std::fs::File {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), bytes).unwrap();
    file.reopen().unwrap()
}

fn opened(bytes: &[u8]) -> Result<TableFile<std::fs::File>, TableError> {
    TableFile::open(on_disk(bytes))
}

/// A table of these lengths of paths.
fn table_of(study: &Study, lengths: &[f64]) -> Vec<u8> {
    let at = study.columns().iter().position(|column| column.name == "path_m").unwrap();
    let mut writer = TableWriter::new(Vec::new(), study).unwrap();
    for (row, length) in (0..).zip(lengths) {
        let mut made = study.failed(row, "");
        made.cells[at] = RowValue::Number(*length);
        writer.row(made).unwrap();
    }
    writer.finish().unwrap()
}

/// Where a text stands in bytes for the last time.
fn last_place(bytes: &[u8], text: &str) -> usize {
    bytes.windows(text.len()).rposition(|window| window == text.as_bytes()).unwrap()
}

#[test]
fn no_flipped_bit_of_a_table_changes_a_value_unseen() {
    let study = study("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(0, 3))])");
    let whole = table_of(&study, &[0.5, 2.0, 3.25]);
    let about = VerifiedTable::of(on_disk(&whole)).unwrap();
    assert_eq!(about.rows, 3);
    let read = |bytes: &[u8]| -> Result<(String, Vec<RunRow>), TableError> {
        let table = opened(bytes)?;
        let (line, mut rows) = (table.study().line().to_owned(), Vec::new());
        table.each(|row| rows.push(row)).map(|_| (line, rows))
    };
    let own = read(&whole).unwrap();
    let (mut refused, mut harmless) = (0, 0);
    for at in 0..whole.len() {
        let mut changed = whole.clone();
        changed[at] ^= 1 << (at % 8);
        match (read(&changed), VerifiedTable::of(on_disk(&changed))) {
            (Err(_), Err(_)) => refused += 1,
            // such as a name of the program that wrote it, or a bound of a column that nobody asks for
            (Ok(read), Ok(verified)) => {
                harmless += 1;
                assert!(read == own && verified == about, "byte {at} of {}", whole.len());
            }
            // the study is read anew only where the table is a sweep's
            (read, verified) => panic!("byte {at}: {:?}, {verified:?}", read.map(|_| ())),
        }
    }
    assert!(refused > 2 * harmless && refused > 1000, "{refused} {harmless}");
}

#[test]
fn a_seal_is_of_the_values_in_their_order_and_of_the_study() {
    let studies = ["0, 3", "1, 4"].map(|range| {
        study(&format!("Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range({range}))])"))
    });
    let lengths = [[1.0, 2.0, 3.0], [2.0, 1.0, 3.0], [1.0, 2.0, 3.0000000000000004], [1.0, 2.0, -0.0]];
    let tables: Vec<Vec<u8>> = lengths.iter().map(|lengths| table_of(&studies[0], lengths)).collect();
    let seal = |table: &[u8]| VerifiedTable::of(on_disk(table)).unwrap().seal.to_string();
    let seals: Vec<String> =
        tables.iter().map(|table| seal(table)).chain([seal(&table_of(&studies[1], &lengths[0]))]).collect();
    for (i, own) in seals.iter().enumerate() {
        assert!(!seals[..i].contains(own), "{i}");
    }
    // the same rows have the same seal, whoever writes them
    assert_eq!(seals[0], seal(&table_of(&studies[0], &lengths[0])));
    // the seal of another order of the same values
    let mut exchanged = tables[0].clone();
    let at = last_place(&exchanged, &seals[0]);
    exchanged[at..at + 32].copy_from_slice(seals[1].as_bytes());
    assert!(matches!(opened(&exchanged).unwrap().each(|_| ()), Err(TableError::Seal)));
    assert!(matches!(opened(&exchanged).unwrap().row(0), Err(TableError::Seal)));
    // a table without one, as one whose key was changed
    let mut without = tables[0].clone();
    let at = last_place(&without, "motion-lab.seal");
    without[at] = b'M';
    assert!(matches!(opened(&without).err(), Some(TableError::NoSeal)));
    assert!(matches!(VerifiedTable::of(on_disk(&without)), Err(TableError::NoSeal)));
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
