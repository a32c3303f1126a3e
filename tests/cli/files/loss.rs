//! No output is an input, another output, or in place of a log, by whatever name.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::Path;

use crate::cli::{Run, command, ended, run, run_in, run_with};

/// Options and arguments that name files to read.
const READ: [&str; 11] = [
    "record --world",
    "record --script",
    "record --resume",
    "export --template",
    "query --world",
    "query --input",
    "plan --world",
    "plan --problems",
    "capture --world",
    "capture --run",
    "script convert --world",
];

/// Options that name files to write, each with command lines that write `OUT` while they read `IN`, and the file that
/// they read.
const WRITTEN: [(&str, &[(&str, &str)]); 28] = [
    (
        "record --output",
        &[
            ("record --world IN --ticks 2 -o OUT", "wb.ron"),
            ("record --script IN --world lot --ticks 2 -o OUT", "drive.ron"),
            ("record --resume IN -o OUT", "run.mcap"),
        ],
    ),
    ("replay --output", &[("replay IN -o OUT", "run.mcap"), ("replay IN --log digest -o OUT", "run.mcap")]),
    (
        "export --output",
        &[
            ("export IN --format csv -o OUT", "run.mcap"),
            ("export IN --format jsonl -o OUT", "run.mcap"),
            ("export IN --format svg -o OUT", "run.mcap"),
            ("export IN --format png -o OUT", "run.mcap"),
            ("export IN --format gif -o OUT", "run.mcap"),
            ("export IN --format foxglove -o OUT", "run.mcap"),
            ("export IN --format rerun -o OUT", "run.mcap"),
            ("export IN -o OUT --every 9 --format gif", "run.mcap"),
            ("export IN --format html -o OUT", "run.mcap"),
            ("export run.mcap --format html --template IN -o OUT", "wb.ron"),
        ],
    ),
    ("why --output", &[("why IN --robot Reach --contact 1 -o OUT", "run.mcap")]),
    ("why --script", &[("why IN --robot Reach --contact 1 --script OUT", "run.mcap")]),
    ("shrink --output", &[("shrink IN --while Rusty.path_m>0 -o OUT", "run.mcap")]),
    ("plot --output", &[("plot IN --what speed --format svg -o OUT", "run.mcap")]),
    (
        "capture --output",
        &[
            ("capture --widget atlas --world IN --format svg -o OUT", "wb.ron"),
            ("capture --widget dashboard --run IN --format png -o OUT", "run.mcap"),
            ("capture --widget dashboard --run IN --format gif -o OUT", "run.mcap"),
        ],
    ),
    ("query --certificate", &[("query edge --robot reach 2.0,0 2.1,0 --world IN --certificate OUT", "wb.ron")]),
    ("plan --output", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 -o OUT", "wb.ron")]),
    ("plan --script", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --script OUT", "wb.ron")]),
    ("plan --record", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --record OUT", "wb.ron")]),
    ("plan --svg", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --svg OUT", "wb.ron")]),
    ("plan --barrier", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --barrier OUT", "wb.ron")]),
    ("plan --gif", &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --gif OUT", "wb.ron")]),
    (
        "plan --costs",
        &[("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --compare rrt --seeds 0..1 --costs OUT", "wb.ron")],
    ),
    (
        "plan --ompl",
        &[
            ("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --compare rrt --seeds 0..1 --ompl OUT", "wb.ron"),
            ("plan --problems IN --robot reach --compare rrt --ompl OUT", "problems.ron"),
        ],
    ),
    ("problems --output", &[("problems IN --problem 1 -o OUT", "problems.ron")]),
    (
        "plan --csv",
        &[
            ("plan --world IN --robot Reach --from 2,0 --to 2.1,0 --compare rrt --seeds 0..1 --csv OUT", "wb.ron"),
            ("plan --world lot --robot Hitch --problems IN --compare rrt --iterations 1 --csv OUT", "lot.map.scen"),
        ],
    ),
    ("world show --output", &[("world show IN -o OUT", "wb.ron")]),
    ("world import --output", &[("world import IN -o OUT", "map.yaml")]),
    (
        "world export --output",
        &[("world export IN --format svg -o OUT", "wb.ron"), ("world export IN --format ros -o OUT", "wb.ron")],
    ),
    ("script print --output", &[("script print IN -o OUT", "run.mcap"), ("script print IN -o OUT", "drive.ron")]),
    ("script convert --output", &[("script convert IN -o OUT", "table.csv")]),
    (
        "sweep merge --output",
        &[
            ("sweep merge IN --format csv -o OUT", "part.sweep"),
            ("sweep merge IN --format parquet -o OUT", "part.sweep"),
        ],
    ),
    (
        "sweep report --output",
        &[
            ("sweep report IN --format svg -o OUT", "all.parquet"),
            ("sweep report IN --format html -o OUT", "all.parquet"),
        ],
    ),
    ("sweep reproduce --output", &[("sweep reproduce IN --row 0 -o OUT", "all.parquet")]),
    // it reads no file
    ("world generate --output", &[]),
];

/// Options that name a folder, in which the command names the files.
const FOLDERS: [&str; 2] = ["man --output", "sweep --output"];

/// A folder with a file of each kind that is read.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "8", "-o", "run.mcap"]).done();
    run_in(at, &["world", "show", "workbench", "-o", "wb.ron"]).done();
    run_in(at, &["world", "export", "lot", "--resolution", "0.5", "-o", "map.yaml"]).done();
    fs::write(at.join("lot.map.scen"), "0 lot.map 16 10 6 6 7 6 1\n").unwrap();
    let near = "world: \"workbench\", robot: \"reach\", starts: [[2, 0]], goals: [[2.1, 0]]";
    fs::write(at.join("problems.ron"), format!("Problems(version: 1, sets: [Paired({near})])")).unwrap();
    fs::write(at.join("table.csv"), "tick,robot,input\n1,Hitch,Drive,1,0\n").unwrap();
    run_in(at, &["script", "convert", "table.csv", "-o", "drive.ron"]).done();
    fs::write(
        at.join("study.ron"),
        "Sweep(version: 1, worlds: [\"lot\"], ticks: 2, axes: [(vary: \"seed\", over: Range(0, 2))])",
    )
    .unwrap();
    run_in(at, &["sweep", "study.ron", "-o", "parts"]).done();
    fs::rename(at.join("parts/part-1-of-1.sweep"), at.join("part.sweep")).unwrap();
    fs::remove_dir_all(at.join("parts")).unwrap();
    run_in(at, &["sweep", "merge", "part.sweep", "-o", "all.parquet"]).done();
    folder
}

/// What a folder holds by its names, hidden ones too: files with their bytes, folders without what they hold.
pub fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<_> = entries
        .map(|path| {
            (path.display().to_string(), if path.is_dir() { Vec::new() } else { fs::read(&path).unwrap_or_default() })
        })
        .collect();
    all.sort();
    all
}

fn line(template: &str, input: &str, output: &str) -> Vec<String> {
    template.split(' ').map(|word| word.replace("IN", input).replace("OUT", output)).collect()
}

fn run_line(folder: &Path, line: &[String]) -> Run {
    run_in(folder, &line.iter().map(String::as_str).collect::<Vec<_>>())
}

#[test]
fn no_command_writes_over_its_own_input_by_any_name_of_it() {
    let folder = folder();
    let at = folder.path();
    fs::create_dir(at.join("sub")).unwrap();
    let mut tried = 0;
    for (template, input) in WRITTEN.iter().flat_map(|(_, lines)| *lines) {
        let mut names = vec![(*input).to_owned(), format!("sub/../{input}"), at.join(input).display().to_string()];
        let _ = fs::remove_file(at.join("hard"));
        fs::hard_link(at.join(input), at.join("hard")).unwrap();
        names.push("hard".to_owned());
        #[cfg(unix)]
        {
            let _ = (fs::remove_file(at.join("soft")), fs::remove_file(at.join("sub/soft")));
            std::os::unix::fs::symlink(input, at.join("soft")).unwrap();
            std::os::unix::fs::symlink("../soft", at.join("sub/soft")).unwrap();
            names.push("sub/soft".to_owned());
        }
        let before = contents(at);
        for name in names {
            // a recording goes on in place, which loses nothing
            if template.contains("--resume") && name == *input {
                continue;
            }
            // force replaces logs, and no input
            let line = line(&format!("{template} --force"), input, &name);
            let ended = run_line(at, &line);
            assert!(contents(at) == before, "{line:?} has changed the folder: {}", ended.err);
            let error = ended.failed(2);
            assert!(error.contains("this output is the same file as the input"), "{line:?}: {error}");
            tried += 1;
        }
    }
    assert!(tried > 140, "{tried}");
}

/// Every option of every command that names a file is known here as one that is read or one that is written, so that a
/// new one is tried above.
#[test]
fn every_option_that_names_a_file_is_known_to_the_tests_of_loss() {
    let mut found = BTreeSet::new();
    walk("", &mut found);
    let known: BTreeSet<String> = READ
        .into_iter()
        .chain(WRITTEN.map(|(option, _)| option))
        .chain(FOLDERS)
        // these write nothing
        .chain(["script check --world", "sweep verify --csv"])
        .map(str::to_owned)
        .collect();
    assert_eq!(found, known);
}

/// Adds the options of a command and of those below it that take a file or a folder.
fn walk(name: &str, found: &mut BTreeSet<String>) {
    let help = run(&name.split_whitespace().chain(["--help"]).collect::<Vec<_>>()).done();
    for line in help.lines().map(str::trim_start).filter(|line| line.starts_with('-')) {
        let value = line.split_once(" <").map_or("", |(_, value)| value);
        if value.contains("FILE") || value.contains("FOLDER") {
            let option = line.split("--").nth(1).unwrap().split([' ', ',']).next().unwrap();
            found.insert(format!("{name} --{option}").trim().to_owned());
        }
    }
    let commands = help.split("\nCommands:\n").nth(1).unwrap_or_default().split("\n\n").next().unwrap();
    for below in commands.lines().filter_map(|line| line.strip_prefix("  ")).filter(|line| !line.starts_with(' ')) {
        let below = below.split(' ').next().unwrap();
        if below != "help" {
            walk(format!("{name} {below}").trim(), found);
        }
    }
}

#[test]
fn two_outputs_are_never_one_file_whether_it_is_there_or_not() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("sub")).unwrap();
    let outputs = ["-o", "--script", "--record", "--svg", "--gif", "--barrier"];
    let mut names = vec![("x", "x"), ("x", "sub/../x"), ("sub/x", "./sub/x")];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("sub", at.join("other")).unwrap();
        std::os::unix::fs::symlink("sub/new", at.join("dangling")).unwrap();
        names.extend([("sub/x", "other/x"), ("dangling", "sub/new"), ("other/new", "dangling")]);
    }
    let before = contents(at);
    for (i, first) in outputs.iter().enumerate() {
        for second in &outputs[i + 1..] {
            for (a, b) in &names {
                let plan = ["plan", "--robot", "reach", "--from", "2,0", "--to", "2.1,0", first, a, second, b];
                let ended = run_in(at, &plan);
                assert!(contents(at) == before && contents(&at.join("sub")).is_empty(), "{plan:?}");
                let error = ended.failed(2);
                assert!(error.contains("it is named twice, also as"), "{plan:?}: {error}");
            }
        }
    }
    let twice = ["plan", "--robot", "reach", "--from", "2,0", "--to", "2.1,0", "-o", "-", "--script", "-"];
    assert!(run_in(at, &twice).failed(2).contains("two outputs can't both go to standard output"));
    // different files are written
    run_in(at, &["plan", "--robot", "reach", "--from", "2,0", "--to", "2.1,0", "-o", "a", "--script", "b"]).done();
    assert!(at.join("a").exists() && at.join("b").exists());
}

#[test]
fn a_written_link_stays_a_link_and_a_hidden_image_is_seen() {
    let folder = folder();
    let at = folder.path();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("target.ron", at.join("link.ron")).unwrap();
        run_in(at, &["world", "show", "lot", "-o", "link.ron"]).done();
        assert!(at.join("link.ron").is_symlink() && at.join("target.ron").is_file());
    }
    // the image of a map is an input, and an output, beside the yaml that is named
    let error = run_in(at, &["world", "import", "map.yaml", "-o", "map.pgm"]).failed(2);
    assert!(error.contains("map.pgm: this output is the same file as the input map.pgm"), "{error}");
    fs::copy(at.join("wb.ron"), at.join("world.pgm")).unwrap();
    let error = run_in(at, &["world", "export", "world.pgm", "--format", "ros", "-o", "world.yaml"]).failed(2);
    assert!(error.contains("world.pgm: this output is the same file as the input world.pgm"), "{error}");
    // both files that it replaces are named
    let (yaml, pgm) =
        (fs::metadata(at.join("map.yaml")).unwrap().len(), fs::metadata(at.join("map.pgm")).unwrap().len());
    let said = run_in(at, &["world", "export", "lot", "--resolution", "0.5", "-o", "map.yaml"]).err;
    for (name, size) in [("map.yaml", yaml), ("map.pgm", pgm)] {
        let line = said.lines().find(|line| line.contains(&format!("wrote {name}, replacing"))).unwrap();
        assert!(line.ends_with(&format!(", replacing an older file of {size} bytes")), "{said}");
    }
}

#[test]
fn standard_streams_that_are_files_are_files_too() {
    let folder = folder();
    let at = folder.path();
    let before = contents(at);
    let from = |name: &str, arguments: &[&str]| {
        let stdin = File::open(at.join(name)).unwrap();
        ended(command(arguments).current_dir(at).stdin(stdin).output().unwrap())
    };
    for (name, arguments) in [
        ("wb.ron", &["world", "show", "-", "-o", "wb.ron"][..]),
        ("wb.ron", &["record", "--world", "-", "--ticks", "2", "-o", "wb.ron"]),
        ("run.mcap", &["export", "-", "--format", "csv", "-o", "run.mcap"]),
        ("run.mcap", &["replay", "-", "-o", "run.mcap"]),
    ] {
        let error = from(name, arguments).failed(2);
        assert!(error.contains("is the same file as the input standard input"), "{arguments:?}: {error}");
        assert!(contents(at) == before, "{arguments:?}");
    }
    // what is piped in is no file
    let script = fs::read(at.join("drive.ron")).unwrap();
    let target = at.join("again.ron").display().to_string();
    run_with(&script, &["script", "print", "-", "-o", &target]).done();
    // a file that standard output goes to
    let out = File::create(at.join("out.txt")).unwrap();
    let mut both = command(&["record", "--ticks", "2", "-o", "out.txt"]);
    let error = ended(both.current_dir(at).stdout(out).output().unwrap()).failed(2);
    assert!(error.contains("out.txt: it is named twice, also as standard output"), "{error}");
    let appended = fs::OpenOptions::new().append(true).open(at.join("wb.ron")).unwrap();
    let mut shown = command(&["world", "show", "wb.ron"]);
    ended(shown.current_dir(at).stdout(appended).output().unwrap()).failed(2);
    assert!(contents(at).contains(&before.iter().find(|(name, _)| name.ends_with("wb.ron")).unwrap().clone()));
}

#[test]
fn a_log_is_replaced_by_a_log_alone_unless_it_is_forced() {
    let folder = folder();
    let at = folder.path();
    fs::copy(at.join("run.mcap"), at.join("other.mcap")).unwrap();
    let log = fs::read(at.join("run.mcap")).unwrap();
    // damaged or unfinished, it is a log still
    fs::write(at.join("cut.mcap.partial"), &log[..log.len() / 2]).unwrap();
    let other = [
        &["export", "run.mcap", "-o"][..],
        &["export", "run.mcap", "--format", "csv", "-o"],
        &["script", "print", "run.mcap", "-o"],
        &["world", "show", "lot", "-o"],
        &["plot", "run.mcap", "--what", "speed", "--format", "svg", "-o"],
    ];
    let before = contents(at);
    for arguments in other {
        for target in ["other.mcap", "cut.mcap.partial"] {
            let format = if arguments == other[0] { &["--format", "foxglove"][..] } else { &[] };
            let error = run_in(at, &[arguments, &[target], format].concat()).failed(2);
            assert!(error.contains(&format!("{target}: it is a log, and this output is none")), "{error}");
            assert!(error.contains("--force") && contents(at) == before, "{arguments:?}");
        }
    }
    run_in(at, &["record", "--ticks", "3", "-o", "other.mcap"]).done();
    run_in(at, &["replay", "run.mcap", "-o", "other.mcap"]).done();
    run_in(at, &["export", "run.mcap", "--format", "csv", "-o", "other.mcap", "--force"]).done();
    assert!(fs::read_to_string(at.join("other.mcap")).unwrap().starts_with("tick,"));
    // a file for viewers is no log, though its name is one's
    for _ in 0..2 {
        run_in(at, &["export", "run.mcap", "-o", "viewer.mcap"]).done();
    }
    run_in(at, &["world", "show", "lot", "-o", "viewer.mcap"]).done();
}

#[test]
fn a_recording_goes_on_in_place_and_its_beginning_is_in_it() {
    let folder = folder();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "8", "--stop-after", "5", "-o", "b.mcap"]).failed(75);
    run_in(at, &["record", "--resume", "b.mcap.partial", "--stop-after", "6"]).failed(75);
    run_in(at, &["record", "--resume", "./b.mcap.partial", "-o", "b.mcap"]).done();
    assert_eq!(fs::read(at.join("b.mcap")).unwrap(), fs::read(at.join("run.mcap")).unwrap());
    run_in(at, &["record", "--resume", "run.mcap"]).done();
    run_in(at, &["verify", "run.mcap"]).done();
    // what a stopped run is kept as is an output as well
    fs::copy(at.join("wb.ron"), at.join("c.mcap.partial")).unwrap();
    let stopped = ["record", "--world", "c.mcap.partial", "--ticks", "9", "--stop-after", "3", "-o", "c.mcap"];
    assert!(run_in(at, &stopped).failed(2).contains("c.mcap.partial: this output is the same file as the input"));
}
