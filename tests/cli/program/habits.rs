//! Habits that all commands share: names that tell the form, `-`, `--quiet`, what was replaced, older spellings.

use std::fs;
use std::path::Path;

use crate::cli::{Run, command, json, run, run_in, run_with, sealed};

/// A folder with `run.mcap`, the first 40 ticks of the tour.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["record", "--ticks", "40", "-o", "run.mcap"]).done();
    folder
}

/// Runs the program in a folder; returns the bytes of its standard output.
#[track_caller]
fn bytes(folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let output = command(arguments).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

#[test]
fn a_file_s_name_tells_the_form() {
    let folder = folder();
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    for (name, form, begin) in [
        ("a.jsonl", "jsonl", &b"{\""[..]),
        ("a.csv", "csv", b"tick,"),
        ("a.svg", "svg", b"<svg"),
        ("a.png", "png", b"\x89PNG"),
        ("a.gif", "gif", b"GIF89a"),
        ("a.mcap", "foxglove", b"\x89MCAP"),
    ] {
        run_in(folder.path(), &["export", "run.mcap", "-o", name]).done();
        run_in(folder.path(), &["export", "run.mcap", "--format", form, "-o", "other"]).done();
        assert!(read(name).starts_with(begin), "{name}");
        assert!(read(name) == read("other"), "{name} is as --format {form} writes it");
    }
    for (arguments, said) in [
        (&["export", "run.mcap", "-o", "a.xyz"][..], "a.xyz: its name does not tell the form"),
        (&["export", "run.mcap"], "no form is named"),
        (&["capture", "--widget", "atlas", "-o", "a.xyz"], "a.xyz: its name does not tell the form"),
        (&["world", "export", "lot", "-o", "a.xyz"], "a.xyz: its name does not tell the format"),
    ] {
        let error = run_in(folder.path(), arguments).failed(2);
        assert!(error.contains(said) && error.contains("--format"), "{arguments:?}: {error}");
    }
    assert!(!folder.path().join("a.xyz").exists());
    run_in(folder.path(), &["capture", "--widget", "atlas", "--format", "svg", "-o", "a.xyz"]).done();
    assert!(read("a.xyz").starts_with(b"<svg"));
}

#[test]
fn what_is_printed_goes_to_a_file_too() {
    let folder = folder();
    for (arguments, name) in [(&["world", "show", "lot"][..], "lot.ron"), (&["script", "print", "run.mcap"], "run.ron")]
    {
        let printed = run_in(folder.path(), arguments).done();
        for said in
            [format!("wrote {name}\n"), format!("wrote {name}, replacing an older file of {} bytes", printed.len())]
        {
            let written = run_in(folder.path(), &[arguments, &["-o", name]].concat());
            assert!(written.out.is_empty() && written.err.contains(&said), "{}", written.err);
            assert_eq!(fs::read_to_string(folder.path().join(name)).unwrap(), printed);
        }
        assert_eq!(run_in(folder.path(), &[arguments, &["-o", "-"]].concat()).done(), printed);
    }
}

/// The script in a text, from `Script(` to the line that ends it.
fn script_in(text: &str) -> String {
    let text = &text[text.find("Script(").unwrap()..];
    let end = text.find("\n\n").into_iter().chain(text.find("```")).min().unwrap();
    text[..end].to_owned()
}

#[test]
fn the_scripts_in_help_and_docs_are_scripts_of_every_kind_of_robot() {
    let docs = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/formats.md")).unwrap();
    let docs = docs.split("\n## Scripts\n").nth(1).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for text in [docs, &run(&["script", "--help"]).done()] {
        fs::write(folder.path().join("a.ron"), script_in(text)).unwrap();
        let worlds = ["--world", "apartment", "--world", "workbench", "--world", "lot"];
        let said = run_in(folder.path(), &[&["script", "check", "a.ron"], &worlds[..]].concat()).done();
        assert_eq!(said, "a.ron: 5 events, ticks 1 to 90, robots: Hitch, Reach, Rusty\n");
    }
    // whoever writes metres is led to the form
    fs::write(
        folder.path().join("a.ron"),
        "Script(version: 1, events: [(tick: 1, robot: \"Rusty\", input: Teleport([2.25, 6.25, 0]))])",
    )
    .unwrap();
    let error = run_in(folder.path(), &["script", "check", "a.ron"]).failed(3);
    assert!(
        error.contains("a whole number belongs here") && error.contains("`motion-lab script --help` has"),
        "{error}"
    );
}

#[test]
fn a_dash_is_standard_input_for_logs() {
    let folder = folder();
    let log = fs::read(folder.path().join("run.mcap")).unwrap();
    let file = folder.path().join("run.mcap").to_str().unwrap().to_owned();
    for arguments in [
        &["info"][..],
        &["verify"],
        &["replay"],
        &["script", "print"],
        &["export", "--format", "csv"],
        &["export", "--format", "svg"],
        &["diff", &file],
    ] {
        let of_file = run(&[arguments, &[&file]].concat()).done();
        let piped = run_with(&log, &[arguments, &["-"]].concat());
        assert_eq!(piped.done(), of_file, "{arguments:?}");
    }
    // this export reads its log twice
    let target = folder.path().join("viewer.mcap").to_str().unwrap().to_owned();
    run_with(&log, &["export", "-", "-o", &target]).done();
    assert!(fs::metadata(&target).unwrap().len() > 10_000);
    for arguments in [&["info"][..], &["verify"], &["export", "--format", "csv"]] {
        let error = run_with(b"hello", &[arguments, &["-"]].concat()).failed(3);
        assert!(error.contains("standard input: ") && error.contains("not a run log"), "{arguments:?}: {error}");
    }
    let error = run_with(b"hello", &["script", "print", "-"]).failed(3);
    assert!(error.contains("standard input:1: "), "{error}");
}

#[test]
fn a_dash_is_standard_output_for_pictures() {
    let folder = folder();
    let run_of = ["--widget", "dashboard", "--run", "run.mcap"];
    for (begin, form) in [
        (&["export", "run.mcap"][..], "png"),
        (&["export", "run.mcap"], "gif"),
        (&["export", "run.mcap"], "svg"),
        (&["world", "export", "lot"], "svg"),
        (&["world", "export", "lot"], "png"),
        (&[&["capture"], &run_of[..]].concat(), "png"),
        (&[&["capture"], &run_of[..]].concat(), "gif"),
        (&["capture", "--widget", "atlas"], "svg"),
    ] {
        let file = format!("picture.{form}");
        bytes(folder.path(), &[begin, &["-o", &file]].concat());
        let piped = bytes(folder.path(), &[begin, &["--format", form, "-o", "-"]].concat());
        assert!(piped.len() > 1000 && piped == fs::read(folder.path().join(&file)).unwrap(), "{begin:?} {form}");
    }
    // what no pipe takes is refused, and no file or folder is called `-`
    let study = "Sweep(version: 1, ticks: 1, axes: [(vary: \"seed\", over: Range(0, 2))])";
    fs::write(folder.path().join("study.ron"), study).unwrap();
    for arguments in [
        &["record", "--ticks", "3", "-o", "-"][..],
        &["replay", "run.mcap", "-o", "-"],
        &["export", "run.mcap", "--format", "foxglove", "-o", "-"],
        &["world", "export", "lot", "--format", "ros", "-o", "-"],
        &["man", "-o", "-"],
        &["sweep", "study.ron", "-o", "-"],
    ] {
        let error = run_in(folder.path(), arguments).failed(2);
        assert!(error.contains("not for standard output") && error.contains("-o F"), "{arguments:?}: {error}");
    }
    assert!(!folder.path().join("-").exists());
}

#[test]
fn of_several_logs_each_has_its_turn_and_the_worst_decides() {
    let folder = folder();
    let bytes = fs::read(folder.path().join("run.mcap")).unwrap();
    fs::write(folder.path().join("cut.mcap"), &bytes[..bytes.len() / 2]).unwrap();
    // the log of a run that says it is another: its frames differ from the first on
    run_in(folder.path(), &["record", "--ticks", "40", "--seed", "7", "-o", "seven.mcap"]).done();
    let mut log = motion_lab::run::Log::read_mcap(&fs::read(folder.path().join("seven.mcap")).unwrap()).unwrap().log;
    log.recipe.seed = motion_lab::random::Seed(8);
    fs::write(folder.path().join("forged.mcap"), sealed(&log)).unwrap();

    let verify = |files: &[&str]| run_in(folder.path(), &[&["verify"], files].concat());
    for (files, code) in [
        (&["run.mcap", "run.mcap"][..], 0),
        (&["cut.mcap", "run.mcap"], 5),
        (&["cut.mcap", "nowhere.mcap", "run.mcap"], 3),
        (&["nowhere.mcap", "cut.mcap"], 3),
        (&["forged.mcap", "nowhere.mcap", "cut.mcap"], 4),
        (&["cut.mcap", "nowhere.mcap", "forged.mcap"], 4),
    ] {
        let Run { code: found, out, err } = verify(files);
        assert_eq!(found, Some(code), "{files:?}: {err}");
        let titles: Vec<&str> = out.lines().filter_map(|line| line.strip_suffix(".mcap:")).collect();
        let there: Vec<&str> =
            files.iter().filter_map(|f| f.strip_suffix(".mcap")).filter(|f| *f != "nowhere").collect();
        assert_eq!(titles, there, "{out}");
        assert_eq!(err.contains("nowhere.mcap: there is no such file"), files.contains(&"nowhere.mcap"), "{err}");
    }
    let info = run_in(folder.path(), &["info", "--json", "run.mcap", "nowhere.mcap", "cut.mcap"]);
    assert_eq!(info.code, Some(3), "{}", info.err);
    let files: Vec<_> = info.out.lines().map(|line| json(line)["file"].clone()).collect();
    assert_eq!(files, ["run.mcap", "cut.mcap"]);
    // of one file alone nothing has changed
    assert!(json(&run_in(folder.path(), &["info", "--json", "run.mcap"]).done())["file"].is_null());
    assert!(verify(&["run.mcap"]).done().starts_with("40 of 40 ticks bit-identical\ndigest "));
}

#[test]
fn what_an_output_replaced_is_said() {
    let folder = folder();
    for arguments in [
        &["record", "--ticks", "3"][..],
        &["replay", "run.mcap"],
        &["export", "run.mcap", "--format", "csv"],
        &["export", "run.mcap", "--format", "png"],
        &["export", "run.mcap", "--format", "foxglove"],
        &["capture", "--widget", "anatomy", "--format", "svg"],
        &["world", "export", "lot", "--format", "svg"],
        &["world", "export", "lot", "--format", "ros"],
        &["world", "generate", "warehouse", "--robots", "10"],
        &["script", "convert", "table.csv"],
    ] {
        fs::write(folder.path().join("table.csv"), "1,Rusty,Drive,64,0\n").unwrap();
        let output = folder.path().join("output");
        let _ = fs::remove_file(&output);
        let arguments = [arguments, &["-o", "output"]].concat();
        let first = run_in(folder.path(), &arguments);
        assert!(first.err.contains("wrote output") && !first.err.contains("replacing"), "{arguments:?}: {}", first.err);
        fs::write(&output, [b'x'; 77]).unwrap();
        let second = run_in(folder.path(), &arguments);
        assert!(second.err.contains(", replacing an older file of 77 bytes\n"), "{arguments:?}: {}", second.err);
        // asked to be quiet, it says nothing, and does the same
        fs::remove_file(&output).unwrap();
        let quiet = run_in(folder.path(), &[&arguments[..], &["--quiet"]].concat());
        assert!(quiet.code == Some(0) && quiet.err.is_empty() && output.exists(), "{arguments:?}: {}", quiet.err);
        assert_eq!(quiet.out, second.out, "{arguments:?}");
    }
    let error = run_in(folder.path(), &["-q", "info", "nowhere.mcap"]).failed(3);
    assert!(error.contains("nowhere.mcap: there is no such file"), "what is wrong is still said: {error}");
}

#[test]
fn older_spellings_are_still_read_and_no_longer_named() {
    let folder = folder();
    let same = |old: &[&str], new: &[&str]| {
        let read = |arguments: &[&str]| bytes(folder.path(), arguments);
        assert!(read(old) == read(new), "{old:?}");
    };
    same(&["capture", "--widget", "atlas", "--out", "-"], &["capture", "--widget", "atlas", "--output", "-"]);
    let dashboard = ["capture", "--widget", "dashboard", "-o", "-"];
    same(&[&dashboard[..], &["--log", "run.mcap"]].concat(), &[&dashboard[..], &["--run", "run.mcap"]].concat());
    run_in(folder.path(), &["world", "export", "lot", "-o", "lot.yaml"]).done();
    same(&["world", "import", "lot.yaml", "--from", "ros"], &["world", "import", "lot.yaml", "--format", "ros"]);
    let record = ["record", "--ticks", "3", "--json"];
    same(
        &[&record[..], &["--robot", "Reach=reach3:0.1,0.2,0.3"]].concat(),
        &[&record[..], &["--robot", "Reach", "--place", "Reach=reach3:0.1,0.2,0.3"]].concat(),
    );
    for (command, gone) in [
        (&["capture"][..], "--out\n"),
        (&["capture"], "--out]"),
        (&["capture"], "--log "),
        (&["world", "import"], "--from"),
        (&["record"], "NAME[=KIND"),
    ] {
        let help = run(&[command, &["--help"]].concat()).done();
        assert!(!help.contains(gone), "{command:?} still names {gone}");
    }
}

#[test]
fn a_placement_puts_a_robot_somewhere_and_keeps_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let robots = |more: &[&str]| {
        let record = ["record", "--ticks", "0", "--json"];
        let summary = json(&run_in(folder.path(), &[&record[..], more].concat()).done());
        let robots = summary["robots"].as_array().unwrap().clone();
        let of = |r: &serde_json::Value| (r["name"].to_string(), r["kind"].to_string(), r["configuration"].to_string());
        robots.iter().map(of).collect::<Vec<_>>()
    };
    let line = |name: &str, kind: &str, q: &str| (format!("{name:?}"), format!("{kind:?}"), q.to_owned());
    // the starts of the world files
    let rusty = line("Rusty", "rusty", "[2.25,6.25,0.0]");
    let hitch = line("Hitch", "hitch", "[6.5,2.5,0.0]");
    let put = line("Reach", "reach", "[0.25,-0.5]");
    assert_eq!(robots(&["--place", "Reach=0.25,-0.5"]), [rusty.clone(), put.clone(), hitch.clone()]);
    let three = line("Reach", "reach3", "[0.1,0.2,0.3]");
    assert_eq!(robots(&["--place", "Reach=reach3:0.1,0.2,0.3"]), [rusty, three, hitch.clone()]);
    let two = ["--robot", "Reach", "--place", "Reach=0.25,-0.5", "--robot", "Hitch"];
    assert_eq!(robots(&two), [put, hitch], "--robot keeps, --place puts");
    for (place, reason) in [
        ("Reach", "write NAME=NUMBERS or NAME=KIND:NUMBERS"),
        ("Reach=a,b", "\"a\" is no number"),
        ("Reach=1", "two: th1, th2"),
        ("Nobody=1,2", "--place Nobody: no such robot"),
        ("Rusty=10001,0,0", "10001"),
    ] {
        let error = run(&["record", "--ticks", "0", "--place", place]).failed(2);
        assert!(error.contains(reason), "{place}: {error}");
    }
    // a robot that is only moved keeps what its world says of it: its noisy sensor gives other ranges than an exact one
    let world = run(&["world", "show", "apartment"]).done();
    let exact = "start: [2.25, 6.25, 0.0]";
    assert!(world.contains(exact), "{world}");
    fs::write(folder.path().join("noisy.ron"), world.replace(exact, &format!("{exact}, sensor: (sigma_hit: 0.5)")))
        .unwrap();
    let digest = |world: &str, place: &str| {
        let arguments = ["record", "--ticks", "2", "--json", "--world", world, "--robot", "Rusty", "--place", place];
        json(&run_in(folder.path(), &arguments).done())["digest"].to_string()
    };
    let moved = digest("noisy.ron", "Rusty=2.25,6.25,0");
    let untouched = ["record", "--ticks", "2", "--json", "--world", "noisy.ron", "--robot", "Rusty"];
    assert_eq!(moved, json(&run_in(folder.path(), &untouched).done())["digest"].to_string());
    assert_eq!(moved, digest("noisy.ron", "Rusty=rusty:2.25,6.25,0"));
}

#[test]
fn results_are_said_with_units_and_in_rust_s_spelling_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    let record = ["record", "--ticks", "0", "--place", "Hitch=6.5,2.5,0.5,0.25", "-o", "run.mcap"];
    let printed = run_in(folder.path(), &record).done();
    let expected = "\
robot  where                                                                contacts
Rusty  x 2.250 m, y 6.250 m, heading 0.000 rad                                     0
Reach  theta1 0.785 rad, theta2 1.571 rad                                          0
Hitch  x 6.500 m, y 2.500 m, heading 0.500 rad, trailer's heading 0.250 rad         0
";
    let words =
        |text: &str| text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>();
    assert_eq!(words(&printed)[..4], words(expected));
    let rust = "\
Rusty  Pose2 { x: 2.250, y: 6.250 }  contacts: 0
Reach  T2 { th1: 0.785, th2: 1.571 }  contacts: 0
Hitch  HitchCfg { body: Pose2 { x: 6.500, y: 2.500, theta: 0.500 }, trailer: Some(0.250) }  contacts: 0
";
    assert!(run_in(folder.path(), &[&record[..], &["--debug"]].concat()).done().starts_with(rust));
    for command in ["replay", "info"] {
        let plain = run_in(folder.path(), &[command, "run.mcap"]).done();
        assert!(plain.contains(&printed[..printed.find("digest").unwrap()]), "{command}: {plain}");
        let debug = run_in(folder.path(), &[command, "run.mcap", "--debug"]).done();
        assert!(debug.contains(rust) && !debug.contains("where"), "{command}: {debug}");
    }
}

/// The colour of the paper in the themes, red, green and blue.
fn papers() -> [String; 2] {
    let words = json(&run(&["describe"]).done());
    ["light", "dark"].map(|theme| words["colours"][theme]["paper"].as_str().unwrap().to_owned())
}

#[test]
fn pictures_have_a_theme_a_width_and_names_wherever_they_are_made() {
    let folder = folder();
    let [light, dark] = papers();
    assert_ne!(light, dark);
    let dashboard = ["capture", "--widget", "dashboard", "--run", "run.mcap"];
    for begin in [&["export", "run.mcap"][..], &["world", "export", "lot"], &dashboard] {
        let svg = |more: &[&str]| {
            let svg = bytes(folder.path(), &[begin, &["--format", "svg", "-o", "-"], more].concat());
            String::from_utf8(svg).unwrap()
        };
        let paper = |svg: &str| svg.split(".paper").nth(1).unwrap().split('}').next().unwrap().to_owned();
        assert!(paper(&svg(&[])).contains(&light), "{begin:?}: {}", paper(&svg(&[])));
        assert!(paper(&svg(&["--theme", "dark"])).contains(&dark), "{begin:?}");
        let name = ">the west pillar</text>";
        assert!(!svg(&[]).contains(name) && svg(&["--names"]).contains(name), "{begin:?}: names");
        let width = |svg: &str| {
            let width = svg.split(" width=\"").nth(1).unwrap().split('"').next().unwrap();
            width.parse::<f64>().unwrap()
        };
        let (wide, narrow) = (width(&svg(&[])), width(&svg(&["--width", "480"])));
        assert!((600.0..=1280.0).contains(&wide) && (200.0..=480.0).contains(&narrow), "{begin:?}: {wide}, {narrow}");
        // and painted: the first pixel is paper, the picture as wide as asked
        let png = bytes(
            folder.path(),
            &[begin, &["--format", "png", "--theme", "dark", "--width", "480", "-o", "-"]].concat(),
        );
        let mut reader = png::Decoder::new(std::io::Cursor::new(&png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(format!("#{:02x}{:02x}{:02x}", pixels[0], pixels[1], pixels[2]), dark, "{begin:?}");
        assert!((200..=480).contains(&reader.info().width), "{begin:?}: {}", reader.info().width);
    }
}
