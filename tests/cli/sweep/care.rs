//! `sweep`: what it refuses and where that is, what a stop leaves behind, logs asked for later, links of a report.

use std::fs;
use std::time::{Duration, Instant};

use motion_lab::recording::Run;
use motion_lab::run::LogKind;
use motion_lab::web::Link;

use super::{folder_with, folder_with_a_drive, interrupted, names};
use crate::cli::{json, run_in};

/// Six short runs, whose rows have no contact.
const PLAN: &str = "Sweep(version: 1, worlds: [\"lot\"], ticks: 20,\n\
                    axes: [(vary: \"seed\", over: Range(0, 3)), (vary: \"ticks\", over: Values([20, 30]))])";

#[test]
fn an_advice_leads_on() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    for twice in [["all.csv", "all.csv"], ["all.csv", "./all.csv"], ["all.csv", "parts/../all.csv"]] {
        let refused = run_in(at, &["sweep", "merge", "parts", "-o", twice[0], "-o", twice[1]]).failed(2);
        assert!(refused.contains(&format!("{}: it is named twice", twice[1])), "{refused}");
    }
    let csv = run_in(at, &["sweep", "report", "all.csv", "-o", "all.html"]).failed(3);
    assert!(csv.contains("does not hold its study") && csv.contains("Name the table that ends in .parquet"), "{csv}");
    for output in ["nowhere/all.csv", "nowhere/all.parquet"] {
        let refused = run_in(at, &["sweep", "merge", "parts", "-o", output]).failed(1);
        assert!(refused.contains(output) && refused.contains("Make its folder first"), "{refused}");
    }
    fs::write(at.join("file"), "mine").unwrap();
    for output in ["file", "file/rows", "plan.ron"] {
        let before = fs::read(at.join("plan.ron")).unwrap();
        let refused = run_in(at, &["sweep", "plan.ron", "-o", output]).failed(1);
        assert!(refused.contains(&format!("{output}: this output is a folder, and a file is there")), "{refused}");
        assert_eq!(
            (fs::read(at.join("plan.ron")).unwrap(), &*fs::read(at.join("file")).unwrap()),
            (before, &b"mine"[..])
        );
    }
    // a part without a byte, as some file systems leave one after a power cut
    let part = at.join("parts/part-1-of-1.sweep");
    let whole = fs::read(&part).unwrap();
    let refused = |bytes: &[u8]| {
        fs::write(&part, bytes).unwrap();
        let again = run_in(at, &["sweep", "plan.ron", "-o", "parts"]).failed(3);
        let merged = run_in(at, &["sweep", "merge", "parts"]).failed(3);
        for said in [again, merged] {
            assert!(said.contains("part-1-of-1.sweep: it is "), "{said}");
            assert!(said.contains("Take it away and run its shard again."), "{said}");
        }
    };
    refused(b"");
    // another seed in the study is another study, if it was written so; here the seal says that it was not
    let mut other = whole.clone();
    let seed = whole.windows(5).position(|five| five == b"[0,3]").unwrap();
    other[seed + 1] = b'1';
    other[seed + 3] = b'4';
    refused(&other);
    let mut none = whole.clone();
    none[whole.windows(7).position(|seven| seven == b"\"plan\":").unwrap() + 1] = b'q';
    refused(&none);
    // the good one is first, the damaged one second
    fs::write(&part, &whole).unwrap();
    fs::write(at.join("second.sweep"), &other).unwrap();
    let mixed = run_in(at, &["sweep", "merge", "parts", "second.sweep"]).failed(3);
    assert!(mixed.contains("second.sweep: it is damaged"), "{mixed}");
}

#[test]
fn a_name_that_is_wrong_has_its_place_in_the_plan() {
    let study = "Sweep(version: 1,\n  worlds: [\"lot\", \"lott\"])";
    let folder = folder_with(study);
    let at = folder.path();
    let said = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(said.contains("plan.ron:2:19: lott: no built-in world has this name"), "{said}");
    fs::write(at.join("plan.ron"), "Sweep(version: 1, worlds: [\"lot\"],\n  script: \"driv.ron\")").unwrap();
    let said = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(said.contains("plan.ron:2:11: driv.ron: there is no such file"), "{said}");
    fs::write(at.join("driv.ron"), "Script(version: 1, events: 3)").unwrap();
    let said = run_in(at, &["sweep", "plan.ron", "--check"]).failed(3);
    assert!(said.contains("plan.ron:2:11: driv.ron:1:"), "{said}");
}

#[test]
fn logs_asked_for_later_are_written() {
    let folder = folder_with_a_drive();
    let at = folder.path();
    let logs = || names(&at.join("parts/logs"));
    let sweep = |keep: &str| run_in(at, &["sweep", "plan.ron", "-o", "parts", "--keep", keep]);
    sweep("none").done();
    let part = fs::read(at.join("parts/part-1-of-1.sweep")).unwrap();
    sweep("failures").done();
    assert!(logs().is_empty(), "the run that can't be has no log");
    let contacts = sweep("contacts");
    assert!(contacts.err.contains("wrote the full logs of 1 run made before"), "{}", contacts.err);
    assert_eq!(logs(), ["1.mcap"]);
    let first = fs::metadata(at.join("parts/logs/1.mcap")).unwrap().modified().unwrap();
    sweep("all").done();
    assert_eq!(logs(), ["0.mcap", "1.mcap", "3.mcap"]);
    assert_eq!(fs::metadata(at.join("parts/logs/1.mcap")).unwrap().modified().unwrap(), first, "it was there");
    assert!(fs::read(at.join("parts/part-1-of-1.sweep")).unwrap() == part);
    // a journal's rows likewise: rows 0 and 1 are there, row 3 is not
    fs::remove_dir_all(at.join("parts/logs")).unwrap();
    fs::remove_file(at.join("parts/part-1-of-1.sweep")).unwrap();
    let text = String::from_utf8(part.clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let sealed = |row: usize| {
        let line = lines[4 + row];
        format!("{:016x} {line}\n", xxhash_rust::xxh3::xxh3_64(line.as_bytes()))
    };
    let journal = format!("{}\n{}{}{}", lines[..4].join("\n"), sealed(1), sealed(2), sealed(0));
    fs::write(at.join("parts/part-1-of-1.journal"), journal).unwrap();
    let all = sweep("all");
    assert!(all.err.contains("3 of 4 rows are there") && all.err.contains("logs of 2 runs made before"), "{}", all.err);
    assert_eq!(logs(), ["0.mcap", "1.mcap", "3.mcap"]);
    assert!(fs::read(at.join("parts/part-1-of-1.sweep")).unwrap() == part);
    let logs = ["0", "1", "3"].map(|row| format!("parts/logs/{row}.mcap"));
    run_in(at, &[&["verify"], &logs.each_ref().map(String::as_str)[..]].concat()).done();
}

#[cfg(unix)]
#[test]
fn a_stop_leaves_nothing_that_is_of_no_use() {
    let folder = folder_with("Sweep(version: 1, worlds: [\"apartment\"], ticks: 2000)");
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    // a run that takes longer than anybody waits, with the row of the short one; a part's own seal is right
    let part = fs::read_to_string(at.join("parts/part-1-of-1.sweep")).unwrap();
    let (rows, _) = part.rsplit_once("seal ").unwrap();
    let long = rows.replace("\"ticks\":2000", "\"ticks\":9000000").replace("\n0,2005,2000,", "\n0,2005,9000000,");
    assert_ne!(long, rows);
    let seal = xxhash_rust::xxh3::xxh3_128(long.as_bytes());
    fs::write(at.join("long.sweep"), format!("{long}seal {seal:032x}\n")).unwrap();
    let before = names(at);
    let under_way = || names(at).iter().any(|name| name.contains("unfinished"));
    let stopped = interrupted(at, &["sweep", "reproduce", "long.sweep", "--row", "0"], "-INT", || {
        let begun = under_way();
        // its first seconds are with the operating system then
        begun.then(|| std::thread::sleep(Duration::from_millis(300)));
        begun
    });
    assert_eq!(stopped.code, Some(75), "{}", stopped.err);
    assert!(stopped.err.contains("nothing is kept, start again"), "{}", stopped.err);
    assert_eq!(names(at), before, "neither 0.mcap nor 0.mcap.partial");
    fs::write(at.join("plan.ron"), "Sweep(version: 1, worlds: [\"apartment\"], ticks: 9000000)").unwrap();
    let begin = Instant::now();
    let stopped = interrupted(at, &["sweep", "plan.ron", "--estimate"], "-INT", || begin.elapsed().as_millis() > 700);
    assert_eq!(stopped.code, Some(75), "{}", stopped.err);
    assert!(stopped.err.contains("stopped with 0 of 1 run measured\nNothing is kept"), "{}", stopped.err);
    assert_eq!((stopped.out.as_str(), names(at)), ("", before));
}

#[test]
fn an_estimate_is_of_its_shard() {
    // row 0 takes a thousand times as long as the others
    let ticks: Vec<String> = (0..40).map(|row| if row == 0 { "300000" } else { "20" }.to_owned()).collect();
    let axes = format!("axes: [(vary: \"ticks\", over: Values([{}]))]", ticks.join(", "));
    let folder = folder_with(&format!("Sweep(version: 1, worlds: [\"lot\"], {axes})"));
    let estimate = |shard: &str| run_in(folder.path(), &["sweep", "plan.ron", "--estimate", "--shard", shard]).done();
    let second = estimate("2/2");
    assert!(second.contains("20 runs, 20 of them measured: ") && second.contains("1 shard of all 40 runs"), "{second}");
    assert!(estimate("1/50").contains("0 runs: the sweep has 40 in all"));
}

#[test]
fn a_report_links_to_the_runs_that_a_link_can_hold() {
    let study = "Sweep(version: 1, axes: [(vary: \"world\", over: Names([\"lot\", \"own.ron\"])), \
                (vary: \"seed\", over: Range(5, 7)), (vary: \"ticks\", over: Values([30]))])";
    let folder = folder_with(study);
    let at = folder.path();
    let lot = run_in(at, &["world", "show", "apartment"]).done();
    fs::write(at.join("own.ron"), lot.replacen("\"Rusty\"", "\"Rosty\"", 1)).unwrap();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.parquet"]).done();
    let page = |site: &[&str]| {
        run_in(at, &[&["sweep", "report", "all.parquet", "-o", "all.html"], site].concat()).done();
        fs::read_to_string(at.join("all.html")).unwrap()
    };
    let shown = page(&["--site", "https://lab.example/book/"]);
    let worst = &shown[shown.find("Worst runs").unwrap()..shown.find("Failures, the first").unwrap()];
    for seed in ["5", "6"] {
        // the digest is that of the run that `record` records
        let name = format!("{seed}.mcap");
        run_in(at, &["record", "--world", "lot", "--seed", seed, "--ticks", "30", "-o", &name]).done();
        let about = json(&run_in(at, &["info", "--json", &name]).done());
        let digest = about["digest"].as_str().unwrap();
        let link =
            format!("https://lab.example/book/?v=1&amp;seed={seed}&amp;world=lot&amp;tick=30&amp;digest={digest}");
        assert!(worst.contains(&format!("<td><a href=\"{link}\">run ")), "{link}\n{worst}");
    }
    // a world of one's own is in the address
    let own: Vec<&str> = worst.split("href=\"").filter(|link| link.contains("&amp;file=World(")).collect();
    assert_eq!((own.len(), worst.matches("no link: ").count()), (2, 0), "{worst}");
    for link in own {
        let query = link.split_once('"').unwrap().0.split_once('?').unwrap().1.replace("&amp;", "&");
        let link = Link::parse(&query).unwrap();
        let again = Run::record_recipe(link.recipe(), LogKind::Frames, |_| {}).unwrap();
        assert_eq!(link.digest, again.digest().map(|digest| digest.to_string()));
    }
    assert!(shown.contains("Varied: world (2 values), seed (2 values), ticks (1 value)."));
    assert!(page(&[]).contains("<a href=\"http://localhost:8000/?v=1&amp;"));
    // parameters are called as the study calls them, and `ticks` are no unit of `ticks`
    for title in
        ["<th title=\"varied by the study\">world</th>", ">ticks</th>", ">seed</th>", ">least clearance, m</th>"]
    {
        assert!(shown.contains(title), "{title}");
    }
    for wrong in ["javascript:alert(1)", "https://lab.example/?a=1", "lab.example", "https://"] {
        run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html", "--site", wrong]).failed(2);
    }
}

#[test]
fn a_report_calls_parameters_as_the_plan_does() {
    let study = "Sweep(version: 1, worlds: [\"apartment\"], ticks: 5, axes: [(vary: \"Rusty.noise.sigma_hit\", over: Values([0, 0.1])), \
                (vary: \"Rusty.noise.lambda_short\", over: Values([1]))])";
    let folder = folder_with(study);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.parquet"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html"]).done();
    let page = fs::read_to_string(at.join("all.html")).unwrap();
    for title in [">Rusty.noise.sigma_hit, m</th>", ">Rusty.noise.lambda_short, per_m</th>", ">ticks</th>"] {
        assert!(page.contains(title), "{title}");
    }
}
