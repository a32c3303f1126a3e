use super::*;

/// A path of one's own, as docs/formats.md says it: no more than what a reader needs.
const OWN: &str = r#"{"version": 1, "robot": {"kind": "reach"}, "start": [3.0, 0], "goal": [-3.0, 0.5],
    "legs": [{"kind": "chart line", "from": [3.0, 0], "to": [-3.0, 0.5]}],
    "growth": {"nodes": [[3.0, 0], [1, 1], [0, 2]], "edges": [[0, 1], [1, 2]]}}"#;

fn drawn(text: &str) -> Drawn {
    let file = PathFile::read(text).unwrap();
    file.drawn(&file.robot().unwrap().0).unwrap()
}

fn refused(from: &str, to: &str) -> String {
    assert!(OWN.contains(from), "{from}");
    PathFile::read(&OWN.replacen(from, to, 1)).unwrap_err().to_string()
}

#[test]
fn a_path_of_ones_own_is_drawn_the_short_way_round() {
    let drawn = drawn(OWN);
    assert_eq!((drawn.path.len(), drawn.corners.len(), drawn.edges.len()), (7, 2, 2));
    // half of the short way from 3 to -3 goes over pi
    let middle = drawn.path[3].coordinates();
    assert!((middle[0].abs() - std::f64::consts::PI).abs() < 1e-12 && (middle[1] - 0.25).abs() < 1e-12, "{middle:?}");
}

#[test]
fn a_driven_leg_is_drawn_as_it_is_driven() {
    let car = r#"{"version": 1, "robot": {"kind": "hitch"}, "start": [0, 0, 0], "goal": [1, 0, 0], "legs": [{"kind":
        "drive", "from": [0, 0, 0], "to": [1, 0, 0], "control": {"v": 1, "phi": 0.5, "seconds": 2}}]}"#;
    let drawn = drawn(car);
    // in 2 s at 1 m/s the heading turns by 2 tan(phi) / wheelbase
    let turn = 2.0 * motion_lab_core::num::tan(0.5) / motion_lab_core::robots::HITCH.wheelbase;
    let end = drawn.path[6].coordinates();
    assert!((end[2] - turn).abs() < 1e-9, "{end:?} {turn}");
    let parked = car.replace("\"v\": 1", "\"v\": \"inf\"");
    assert!(PathFile::read(&parked).unwrap_err().to_string().starts_with("legs[0].kind"), "{parked}");
    let for_ever = car.replace("\"seconds\": 2", "\"seconds\": 1e300");
    assert!(PathFile::read(&for_ever).is_err());
}

#[test]
fn a_refusal_names_the_field() {
    for (from, to, words) in [
        ("\"version\": 1", "\"version\": 2", "version 2"),
        ("\"reach\"", "\"tortoise\"", "robot.kind: no kind of the lab is called \"tortoise\""),
        ("\"start\": [3.0, 0]", "\"start\": [3.0]", "robot.kind"),
        ("\"goal\": [-3.0, 0.5]", "\"goal\": [-3.0, \"inf\"]", "goal: no configuration"),
        ("\"from\": [3.0, 0]", "\"from\": [3.0, 0, 0]", "legs[0].from"),
        ("chart line", "leap", "legs[0].kind: \"leap\""),
        ("[1, 1]", "[1]", "growth.nodes[1]"),
        ("[1, 2]]", "[1, 3]]", "growth.edges[1]: there is no such node"),
        ("\"goal\"", "\"gaol\"", "missing field `goal`"),
    ] {
        assert!(refused(from, to).contains(words), "{}", refused(from, to));
    }
    let edges =
        format!(r#""legs": [], "growth": {{"nodes": [[2, 0]], "edges": [{}[0, 0]]}}"#, "[0,0],".repeat(300_000));
    let many = format!(r#"{{"version": 1, "robot": {{"kind": "reach"}}, "start": [2, 0], "goal": [3, 0], {edges}}}"#);
    let many = PathFile::read(&many).unwrap_err().to_string();
    assert_eq!(many, "growth.edges: 300001; at most 300000 are drawn");
    let large = PathFile::read(&" ".repeat(MAX_PATH_BYTES + 1)).unwrap_err().to_string();
    assert!(large.starts_with("67108865 bytes"), "{large}");
}

#[test]
fn a_refusal_is_one_short_line_whatever_stands_in_the_file() {
    let long = format!("\"{}\"", "long ".repeat(100_000));
    for from in ["\"reach\"", "\"chart line\"", "1, \"robot\"", "[-3.0, 0.5],"] {
        let refused = refused(from, &from.replacen(from.split(", ").next().unwrap().trim_end_matches(','), &long, 1));
        assert!(refused.contains("long ") && refused.len() < 1000, "{refused:.200}");
    }
}
