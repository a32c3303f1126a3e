//! `query edge --certificate`: proofs written for other programs, checked by a program that shares nothing with the
//! lab.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use motion_lab::collision::{Certificate, ProvenStep, Scene, verify_certificate};
use motion_lab::configuration::Configuration;
use motion_lab::geometry::Placed;
use motion_lab::num;
use motion_lab::robots::{HITCH, RUSTY, Reach, Robot};
use serde_json::{Value, json as value};
use tempfile::TempDir;

use crate::cli::{json, run};

/// One shape of every kind.
const SHAPES: &str = r#"World(version: 1, name: "Shapes", bounds: (min: (-5, -5), max: (15, 5)),
    walls: [(name: "the wall", points: [(-5, 3), (15, 3)])],
    obstacles: [
        (name: "the post", shape: Disc(center: (3, 0), radius: 0.2)),
        (name: "the log", shape: Rounded(points: [(-4, -3), (4, -3)], radius: 0.5)),
        (name: "the wedge", shape: Polygon([(12, -4), (14, -4), (13, -3)])),
    ])"#;

/// A folder of certificates.
struct Certificates {
    folder: TempDir,
    files: Vec<PathBuf>,
}

impl Certificates {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("shapes.ron"), SHAPES).unwrap();
        Certificates { folder, files: Vec::new() }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    /// The certificate of an edge, read back. Its verdict is that of the same query without `--certificate`.
    fn ask(&mut self, robot: &str, world: &str, q: &str, to: &str) -> Value {
        let file = self.path(&format!("{}.json", self.files.len()));
        let plain = ["query", "edge", "--robot", robot, "--world", world, q, to];
        let asked = run(&[&plain[..], &["--certificate", file.as_str()]].concat());
        assert!(asked.err.contains(&format!("wrote {file}: ")), "{}", asked.err);
        let answer = asked.done();
        assert_eq!(answer, run(&plain).done(), "{robot} {q} {to}");
        let certificate = json(&fs::read_to_string(&file).unwrap());
        assert_eq!(certificate["verdict"], json(&answer), "{robot} {q} {to}");
        assert_eq!((&certificate["version"], &certificate["margin"]), (&value!(1), &value!(0.0)));
        self.files.push(file.into());
        certificate
    }

    fn in_shapes(&mut self, robot: &str, q: &str, to: &str) -> Value {
        let world = self.path("shapes.ron");
        self.ask(robot, &world, q, to)
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn steps(certificate: &Value) -> Vec<ProvenStep> {
    let step = |step: &Value| match numbers(step)[..] {
        [from, to, clearance] => ProvenStep { from, to, clearance },
        _ => panic!("{step} is no step"),
    };
    certificate["steps"].as_array().unwrap().iter().map(step).collect()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// The clearance of a motion proven in one step.
#[track_caller]
fn clearance(certificate: &Value) -> f64 {
    let [step] = steps(certificate)[..] else { panic!("{}", certificate["steps"]) };
    assert_eq!((step.from, step.to, number(&certificate["proven_until"])), (0.0, 1.0, 1.0));
    assert_eq!(certificate["verdict"], value!({"edge": "free", "clearance": step.clearance}));
    step.clearance
}

/// Checks that the library's verifier accepts the certificate as read back, up to the end that the verdict gives.
#[track_caller]
fn verified<R: Robot>(robot: R, scene: &Scene, certificate: &Value) {
    let verdict = &certificate["verdict"];
    let until = if verdict["edge"] == "free" { 1.0 } else { number(&verdict["free_until"]) };
    let steps = steps(certificate);
    near(steps.iter().map(|step| step.to - step.from).sum(), until, 1e-12);
    assert_eq!(number(&certificate["proven_until"]), until);
    let end = |end: &str| {
        <R::Configuration as Configuration>::from_coordinates(&numbers(&certificate["motion"][end])).unwrap()
    };
    let line = robot.edge(&end("from"), &end("to")).unwrap();
    assert_eq!(verify_certificate(scene, &line, &Certificate::from_steps(0.0, steps)), Ok(until), "{certificate}");
    let shape = |(id, piece): (_, &Placed)| {
        let core: Vec<[f64; 2]> = piece.core().iter().map(|p| [p.x, p.y]).collect();
        value!({"name": scene.obstacle_name(id), "core": core, "radius": piece.radius()})
    };
    assert_eq!(certificate["world"]["obstacles"], scene.pieces().map(shape).collect::<Value>());
}

/// The output of a script of tests/peers about these files. `None` where it can't be run; a message about that bypasses
/// the tests' capture of output.
pub fn peer(script: &str, files: &[PathBuf]) -> Option<Output> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers").join(script);
    let python = Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success());
    if python && path.exists() {
        return Some(Command::new("python3").arg(path).args(files).output().unwrap());
    }
    let reason = if python { "is not in the package" } else { "needs python3" };
    let _ = writeln!(std::io::stderr(), "\n!!! SKIPPED: proofs checked by a peer: {script} {reason}");
    None
}

/// Checks that the peer accepts these certificates and refuses forgeries of them.
#[track_caller]
fn peer_accepts(files: &[PathBuf]) {
    for (script, lines) in [("certificate.py", files.len()), ("tamper.py", 1)] {
        let Some(output) = peer(script, files) else { continue };
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
        let ending = if script == "tamper.py" { " refused" } else { ": proven free to s=" };
        assert!(said.lines().count() == lines && said.lines().all(|line| line.contains(ending)), "{said}");
    }
}

#[test]
fn clearances_known_by_hand() {
    let mut certificates = Certificates::new();
    // a disc of 11 cm goes along a wall 1 m away
    let rusty = certificates.in_shapes("rusty", "0,2", "2,2,1");
    near(clearance(&rusty), 0.89, 1e-12);
    assert_eq!(rusty["robot"], value!({"kind": "rusty", "radius": 0.11}));
    assert_eq!(rusty["motion"], value!({"kind": "chart line", "from": [0.0, 2.0, 0.0], "to": [2.0, 2.0, 1.0]}));
    let shapes = value!([
        {"name": "the wall", "core": [[-5.0, 3.0], [15.0, 3.0]], "radius": 0.0},
        {"name": "the post", "core": [[3.0, 0.0]], "radius": 0.2},
        {"name": "the log", "core": [[-4.0, -3.0], [4.0, -3.0]], "radius": 0.5},
        {"name": "the wedge", "core": [[12.0, -4.0], [14.0, -4.0], [13.0, -3.0]], "radius": 0.0},
    ]);
    assert_eq!(rusty["world"], value!({"name": "Shapes", "obstacles": shapes}));
    // A straight arm of two links of 1 m swings by a radian before the post. The chord of its tip is nearest to it;
    // each link turns by a radian, so the second derivative of the tip is 2 m and it strays from its chord by at most
    // an eighth of that.
    let arm = certificates.in_shapes("choset", "-0.5,0", "0.5,0");
    near(clearance(&arm), 3.0 - 0.2 - 2.0 * num::cos(0.5) - 0.25, 1e-12);
    assert_eq!(arm["robot"], value!({"kind": "reach", "base": [0.0, 0.0], "lengths": [1.0, 1.0], "radius": 0.0}));
    // the car's side, 85 cm from its axis, goes up to 1 m from the axis' start; its trailer is narrower
    let towing = certificates.in_shapes("hitch", "8,0,0,0", "8,1,0,0");
    near(clearance(&towing), 3.0 - 1.0 - 0.85, 1e-12);
    let mut car = value!({
        "kind": "hitch",
        "body": {"length": 3.9, "width": 1.7, "rear_overhang": 0.7},
        "trailer": {"hitch_len": 2.0, "front_overhang": 1.0, "rear_overhang": 0.8, "width": 1.5},
    });
    assert_eq!(towing["robot"], car);
    let alone = certificates.in_shapes("hitch", "8,0,0", "8,1,0");
    near(clearance(&alone), 3.0 - 1.0 - 0.85, 1e-12);
    car["trailer"] = Value::Null;
    assert_eq!(alone["robot"], car);
    // the disc touches the wall at y = 2.89; what comes before is proven
    let hit = certificates.in_shapes("rusty", "0,0", "0,4");
    assert_eq!((&hit["verdict"]["edge"], &hit["verdict"]["obstacle"]), (&value!("hit"), &value!("the wall")));
    near(number(&hit["proven_until"]), 2.89 / 4.0, 1e-6);
    peer_accepts(&certificates.files);
}

#[test]
fn edges_of_every_robot_are_accepted_by_verifier_and_peer() {
    let mut certificates = Certificates::new();
    for (q, to) in [("2,4", "10,4,1"), ("2,4", "2,7.9"), ("1,4", "11,3.6,-3"), ("4.7,4", "2.9,6.2")] {
        verified(RUSTY, &Scene::apartment(), &certificates.ask("rusty", "apartment", q, to));
    }
    // the first hits the post; the third crosses the angle pi
    let bench = Scene::workbench();
    let reach = [
        ("2,0", "3.1,0"),
        ("0.7853981633974483,1.5707963267948966", "0.79,1.6"),
        ("3,0.5", "-3,0.2"),
        ("0.8,1.5", "1.4,-1.8"),
    ];
    for (q, to) in reach {
        verified(Reach::workbench(), &bench, &certificates.ask("reach", "workbench", q, to));
    }
    // a difference of half a turn goes the positive way, in which link 1 meets the post's corner (-0.5, 0.5) after an
    // eighth of a turn
    let half = certificates.ask("choset", "workbench", "1.5707963267948966,-0.3", "-1.5707963267948966,-0.3");
    near(number(&half["proven_until"]), 0.25, 1e-6);
    verified(Reach::choset(), &bench, &half);
    verified(Reach::choset(), &bench, &certificates.ask("choset", "workbench", "2.8,0.4", "-2.7,-0.6"));
    for (q, to) in [("-0.2,0.5,0.4", "0.9,-2,0.9"), ("2,0.4,2.7", "-0.9,-2.5,-2.6")] {
        verified(Reach::redundant(), &bench, &certificates.ask("reach3", "workbench", q, to));
    }
    let lot = Scene::lot();
    for (q, to) in [("6.5,2.5,0", "8,2.6,0.4"), ("8,2.5,3", "8.5,2.7,-3"), ("9.3,4,-0.9", "9.4,5,-1.4")] {
        verified(HITCH, &lot, &certificates.ask("hitch", "lot", q, to));
    }
    for (q, to) in [("8,2.5,0,0", "8,2.5,0,1.5707963267948966"), ("6.3,7.1,-2.6,-1.1", "5,6.5,-2.2,-1.2")] {
        verified(HITCH.with_trailer(), &lot, &certificates.ask("hitch", "lot", q, to));
    }
    let read = |file: &PathBuf| json(&fs::read_to_string(file).unwrap());
    let all: Vec<Value> = certificates.files.iter().map(read).collect();
    let several = all.iter().filter(|certificate| steps(certificate).len() > 1).count();
    assert!(several >= 5, "only {several} certificates have more than one step");
    peer_accepts(&certificates.files);
}

#[test]
fn an_empty_world_leaves_infinite_clearance() {
    let mut certificates = Certificates::new();
    let world = certificates.path("empty.ron");
    fs::write(&world, r#"World(version: 1, name: "empty", bounds: (min: (0, 0), max: (1, 1)))"#).unwrap();
    let certificate = certificates.ask("reach3", &world, "0,0,0", "1,1,1");
    assert_eq!(certificate["steps"], value!([[0.0, 1.0, "inf"]]));
    assert_eq!(certificate["world"]["obstacles"], value!([]));
    peer_accepts(&certificates.files);
}

#[test]
fn a_motion_that_begins_in_contact_has_a_certificate_of_nothing() {
    let mut certificates = Certificates::new();
    // an older proof left in the file would be taken for this motion's
    fs::write(certificates.path("0.json"), "an older file").unwrap();
    let nothing = certificates.in_shapes("rusty", "0,3", "0,0");
    assert_eq!((&nothing["steps"], &nothing["proven_until"]), (&value!([]), &value!(0.0)));
    assert_eq!(nothing["verdict"]["edge"], "hit");
    if let Some(output) = peer("certificate.py", &certificates.files) {
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.code() == Some(1) && said.contains("REFUSED: no step: nothing is proven"), "{said}");
    }
}

#[test]
fn only_an_edge_has_a_certificate_and_a_failure_writes_none() {
    let certificates = Certificates::new();
    let (file, missing) = (certificates.path("one.json"), certificates.path("missing/one.json"));
    let wrong: [(&[&str], i32); 7] = [
        (&["distance", "--robot", "reach", "1,2"], 2),
        (&["swept", "--robot", "reach", "1,2", "1,2.1"], 2),
        (&["scan", "1,2"], 2),
        (&["edge", "--robot", "reach", "1,2"], 2),
        (&["edge", "--robot", "hitch", "5,5,0", "5,5,0,0"], 2),
        (&["edge", "--robot", "reach", "--input", "-"], 2),
        (&["edge", "--robot", "reach", "1,2", "1,2.1", "--world", "nowhere.ron"], 3),
    ];
    for (arguments, code) in wrong {
        let asked = run(&[&["query"][..], arguments, &["--certificate", file.as_str()]].concat());
        assert!(asked.code == Some(code) && asked.out.is_empty(), "{arguments:?}: {} {}", asked.out, asked.err);
        assert!(asked.err.lines().count() >= 2, "{arguments:?} says what to do: {}", asked.err);
        assert!(!Path::new(&file).exists(), "{arguments:?}");
    }
    let error = run(&["query", "edge", "--robot", "reach", "1,2", "1,2.1", "--certificate", &missing]).failed(1);
    assert!(error.contains(&missing) && error.contains("Make its folder first"), "{error}");
}
