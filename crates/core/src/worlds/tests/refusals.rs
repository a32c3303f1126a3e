//! Every refusal names file, line, column, item and reason.

use crate::worlds::World;

/// The error of a file whose third line is `line`. The first two lines hold the version, the name and the bounds.
fn refusal(line: &str) -> String {
    let text = format!("World(version: 1, name: \"yard\",\n  bounds: (min: (0, 0), max: (4, 3)),\n{line}\n)");
    World::parse("yard.ron", &text).unwrap_err().to_string()
}

/// The error of one obstacle of this shape.
fn shape(shape: &str) -> String {
    let error = refusal(&format!("obstacles: [(name: \"o\", shape: {shape})]"));
    error.strip_prefix("yard.ron:3:13: obstacles[0] \"o\": ").unwrap_or(&error).to_owned()
}

fn polygon(points: &str) -> String {
    shape(&format!("Polygon([{points}])"))
}

#[test]
fn numbers_out_of_range() {
    for bad in ["inf", "-inf", "NaN", "1e999", "10000.1", "-1e5"] {
        assert!(shape(&format!("Disc(center: (0, {bad}), radius: 1)")).starts_with("point (0, "), "{bad}");
        assert!(shape(&format!("Disc(center: (0, 0), radius: {bad})")).starts_with("radius "), "{bad}");
        assert!(shape(&format!("Box(min: ({bad}, 0), max: (1, 1))")).starts_with("point ("), "{bad}");
        assert!(polygon(&format!("(0, 0), (1, 0), ({bad}, 1)")).contains("vertex 2 is not finite"), "{bad}");
        let wall = refusal(&format!("walls: [(name: \"w\", points: [(0, 0), (1, 1), (2, {bad})])]"));
        assert!(wall.starts_with("yard.ron:3:9: walls[0] \"w\": from points[1] on: point (2, "), "{wall}");
        let place = refusal(&format!("places: [(name: \"p\", pose: (x: 0, y: {bad}, theta: 0))]"));
        assert!(place.starts_with("yard.ron:3:10: places[0] \"p\": point (0, "), "{place}");
        let robot = refusal(&format!("robots: [(name: \"r\", kind: \"rusty\", start: [{bad}, 0, 0])]"));
        assert!(robot.starts_with("yard.ron:3:10: robots[0] \"r\": "), "{robot}");
    }
    for bad in ["inf", "NaN", "1e999"] {
        let place = refusal(&format!("places: [(name: \"p\", pose: (x: 0, y: 0, theta: {bad}))]"));
        assert_eq!(place, "yard.ron:3:10: places[0] \"p\": the heading is not a finite number");
        let robot = refusal(&format!("robots: [(name: \"r\", kind: \"x-own\", start: [0, {bad}])]"));
        assert_eq!(robot, "yard.ron:3:10: robots[0] \"r\": a start coordinate is not a finite number");
    }
}

#[test]
fn features_too_small() {
    assert!(shape("Disc(center: (0, 0), radius: 0.0009)").starts_with("radius 0.0009 m"));
    assert!(shape("Disc(center: (0, 0), radius: -1)").starts_with("radius -1 m"));
    assert!(shape("Box(min: (0, 0), max: (1, 0.0005))").starts_with("length 0.0005 m"));
    let swapped = "the box's corners are swapped: min (0, 2) must lie left of and below max (1, -1.5)";
    assert_eq!(shape("Box(min: (0, 2), max: (1, -1.5))"), swapped);
    assert!(shape("Box(min: (0, 0), max: (-1, 1))").starts_with("the box's corners are swapped: min (0, 0)"));
    let bounds = World::parse("w", "World(version: 1, name: \"a\", bounds: (min: (4, 0), max: (0, 3)))").unwrap_err();
    assert!(bounds.to_string().starts_with("w:1:38: the box's corners are swapped: min (4, 0)"), "{bounds}");
    assert!(shape("Rounded(points: [(0, 0), (0, 0)], radius: 1)").starts_with("1 points: it needs at least 2"));
    assert!(shape("Rounded(points: [(0, 0), (1, 0)], radius: 1e-4)").starts_with("radius 0.0001 m"));
    assert!(shape("Rounded(points: [(0, 0), (1, 0), (0, 1)], radius: -1)").starts_with("radius -1 m"));
    assert!(shape("Rounded(points: [(0, 0), (1, 0), (0, 0.0001)], radius: 1)").starts_with("length 0.0001 m"));
    assert_eq!(shape("Union([])"), "a union of nothing");
    let wall = |rest: &str| refusal(&format!("walls: [(name: \"w\", points: [{rest})]"));
    assert!(wall("(0, 0), (1, 0), (1, 0)]").contains("walls[0] \"w\": from points[1] on: length 0 m"));
    // the first point at the end closes nothing more
    assert!(wall("(0, 0), (1, 0), (0, 0)], closed: true").contains("2 points: it needs at least 3"));
    assert!(wall("(0, 0), (1, 0), (1, 0), (0, 1)], closed: true").contains("from points[1] on: length 0 m"));
    assert!(wall("(0, 0)]").contains("1 points: it needs at least 2"));
    assert!(wall("(0, 0), (1, 0)], closed: true").contains("2 points: it needs at least 3"));
    let mark = refusal("marks: [(name: \"m\", points: [])]");
    assert_eq!(mark, "yard.ron:3:9: marks[0] \"m\": 0 points: it needs at least 2");
}

#[test]
fn polygons_that_are_none() {
    assert_eq!(polygon("(0, 0), (1, 0)"), "polygon: a polygon needs at least 3 vertices, found 2");
    let bow_tie = polygon("(0, 0), (1, 1), (1, 0), (0, 1)");
    assert_eq!(bow_tie, "polygon: the edges after vertex 0 and vertex 2 cross or touch");
    assert!(polygon("(0, 0), (1, 0), (1, 0), (0, 1)").contains("the edge after vertex 1 is shorter"));
    assert!(polygon("(0, 0), (1, 0), (2, 0)").contains("cross or touch"), "flat");
}

#[test]
fn forms_that_are_not_the_formats() {
    let fence = "walls: [(name: \"fence\", points: [(0, 0), (1, 0)]),\n";
    let unknown = refusal(&format!("{fence}   (name: \"gate\", points: [], colour: 3)]"));
    assert!(unknown.starts_with("yard.ron:4:") && unknown.contains(": walls[1] \"gate\": "), "{unknown}");
    assert!(unknown.contains("colour"), "{unknown}");
    let nameless = refusal(&format!("{fence}   // no name\n   (points: [])]"));
    assert!(nameless.starts_with("yard.ron:5:") && nameless.contains(": walls[1]: "), "{nameless}");
    assert!(nameless.contains("`name`"), "{nameless}");
    let text = refusal(&format!("{fence}\n\n   (\n     name: \"gate\",\n     points: \"all\")]"));
    assert!(text.starts_with("yard.ron:8:") && text.contains(": walls[1] \"gate\": "), "{text}");
    let list = refusal("gates: []");
    assert!(list.starts_with("yard.ron:3:") && list.contains("gates"), "{list}");
    let twice = refusal("walls: [], walls: []");
    assert!(twice.starts_with("yard.ron:3:") && twice.contains("walls"), "{twice}");
    assert!(shape("Ball(center: (0, 0), radius: 1)").contains("Ball"));
    let open = refusal("walls: [");
    assert!(open.starts_with("yard.ron:4:1: "), "{open}");
}

#[test]
fn names_empty_or_taken() {
    for bad in ["", " ", " x", "x\\n", "\\u{7}", &"x".repeat(201)] {
        let error = refusal(&format!("places: [(name: \"{bad}\", pose: (x: 0, y: 0, theta: 0))]"));
        assert!(error.contains(": it must be 1 to 200 bytes"), "{error}");
    }
    let place = "places: [(name: \"a\", pose: (x: 0, y: 0, theta: 0))],";
    let wall = "walls: [(name: \"a\", points: [(0, 0), (1, 0)])],";
    // whichever is written first, the lists' order decides who had it
    let taken = "places[0] \"a\": the name is taken by walls[0] \"a\" in line";
    assert_eq!(refusal(&format!("{wall}\n{place}")), format!("yard.ron:4:10: {taken} 3"));
    assert_eq!(refusal(&format!("{place}\n{wall}")), format!("yard.ron:3:10: {taken} 4"));
    for list in [
        "marks: [(name: \"a\", points: [(0, 0), (1, 0)])]",
        "robots: [(name: \"a\", kind: \"x-y\", start: [0])]",
        "obstacles: [(name: \"a\", shape: Disc(center: (0, 0), radius: 1))]",
    ] {
        assert!(refusal(&format!("{place}{list}")).contains("the name is taken by "), "{list}");
    }
}

#[test]
fn robots_nobody_knows() {
    let robot =
        |kind: &str, start: &str| refusal(&format!("robots: [(name: \"r\", kind: \"{kind}\", start: [{start}])]"));
    for kind in ["", "Rusty", "drone", "x-", "x", "x-\\n"] {
        assert!(robot(kind, "0, 0, 0").contains("robots[0] \"r\": kind "), "{kind}");
    }
    assert!(robot("rusty", "0, 0").ends_with("2 start coordinates: a rusty starts with three: x, y, theta"));
    assert!(robot("rusty", "0").ends_with("1 start coordinate: a rusty starts with three: x, y, theta"));
    for (kind, start) in [
        ("reach", "0"),
        ("reach", "0, 0, 0"),
        ("reach3", "0, 0"),
        ("hitch", "0, 0"),
        ("hitch", "0, 0, 0, 0, 0"),
        ("x-own", ""),
    ] {
        assert!(robot(kind, start).contains(" start coordinate"), "{kind}");
    }
}

#[test]
fn sensors_that_are_none() {
    let robot = |kind: &str, start: &str, sensor: &str| {
        refusal(&format!("robots: [\n  (name: \"r\", kind: \"{kind}\", start: [{start}], sensor: ({sensor}))]"))
    };
    let rusty = |sensor: &str| robot("rusty", "0, 0, 0", sensor);
    let at = "yard.ron:4:3: robots[0] \"r\": ";
    assert_eq!(rusty("sigma_hit: NaN"), format!("{at}sensor: sigma_hit = NaN: it must be finite and not negative"));
    for (name, value) in [("sigma_hit", "1e999"), ("z_short", "-0.1"), ("lambda_short", "-1"), ("z_rand", "inf")] {
        assert!(rusty(&format!("{name}: {value}")).starts_with(&format!("{at}sensor: {name} = ")), "{name}");
    }
    let sum = rusty("z_short: 0.5, z_miss: 0.25, z_max: 0.25, z_rand: 0.25");
    assert!(sum.starts_with(&format!("{at}sensor: z_short + z_miss + z_max + z_rand = 1.25: ")), "{sum}");
    assert!(rusty("z_short: 0.1, lambda_short: 0").contains("lambda_short = 0: short returns need a rate"));
    let unknown = rusty("sigma: 0.1");
    assert!(unknown.starts_with("yard.ron:4:") && unknown.contains(": robots[0] \"r\": "), "{unknown}");
    for (kind, start) in [("reach", "0, 0"), ("reach3", "0, 0, 0"), ("hitch", "0, 0, 0")] {
        assert_eq!(robot(kind, start, ""), format!("{at}a {kind} has no range sensor: leave out `sensor`"));
    }
}

#[test]
fn sensors_of_a_robots_own_that_are_none() {
    let own = |sensors: &str| {
        refusal(&format!("robots: [\n  (name: \"r\", kind: \"hitch\", start: [0, 0, 0], sensors: [{sensors}])]"))
    };
    let at = "yard.ron:4:3: robots[0] \"r\": ";
    let good = "(name: \"a\", rays: 4, range: 2)";
    let with = |more: &str| own(&format!("{good}, (name: \"front\", rays: 4, range: 2, {more})"));
    for (more, reason) in [
        ("field_of_view: 0", "field of view 0 rad: it must be 0.001 to 6.283185307179586 rad, a full turn"),
        ("field_of_view: 6.3", "field of view 6.3 rad: "),
        ("field_of_view: NaN", "field of view NaN rad: "),
        ("mount: (x: inf, y: 0, theta: 0)", "mount x: inf, y: 0, theta: 0: it must be finite, and within 10000 m"),
        ("mount: (x: 0, y: -10000.1, theta: 0)", "mount x: 0, y: -10000.1, "),
        ("mount: (x: 0, y: 0, theta: NaN)", "mount x: 0, y: 0, theta: NaN: "),
        ("noise: (z_miss: -1)", "noise: z_miss = -1: it must be finite and not negative"),
    ] {
        let error = with(more);
        assert!(error.starts_with(&format!("{at}sensors[1] \"front\": {reason}")), "{error}");
    }
    let numbers = |rays: &str, range: &str| own(&format!("(name: \"s\", rays: {rays}, range: {range})"));
    assert_eq!(numbers("0", "1"), format!("{at}sensors[0] \"s\": 0 rays: there must be 1 to 100000"));
    assert!(numbers("100001", "1").contains("100001 rays: "));
    assert_eq!(numbers("1", "0"), format!("{at}sensors[0] \"s\": range 0 m: it must be 0.001 to 10000 m"));
    assert_eq!(own(&format!("{good}, {good}")), format!("{at}sensors[1] \"a\": the name is taken by sensors[0]"));
    for name in ["", " a", "a\\n"] {
        let error = own(&format!("(name: \"{name}\", rays: 4, range: 2)"));
        assert!(
            error.starts_with(&format!("{at}sensors[0] ")) && error.contains("its name must be 1 to 200"),
            "{error}"
        );
    }
    let many = |count: usize| {
        let each = (0..count).map(|i| format!("(name: \"{i}\", rays: 1, range: 1)"));
        format!("\"hitch\", start: [0, 0, 0], sensors: [{}])]", each.collect::<Vec<_>>().join(", "))
    };
    let yard = |tail: &str| {
        format!(
            "World(version: 1, name: \"yard\", bounds: (min: (0, 0), max: (4, 3)),\nrobots: [(name: \"r\", kind: {tail})"
        )
    };
    assert_eq!(World::parse("yard.ron", &yard(&many(64))).unwrap().robots[0].sensors.len(), 64);
    let error = World::parse("yard.ron", &yard(&many(65))).unwrap_err().to_string();
    assert_eq!(error, "yard.ron:2:10: robots[0] \"r\": sensors[64] \"64\": a robot has at most 64 sensors");
    let unknown = own("(name: \"a\", rays: 4, range: 2, fov: 1)");
    assert!(unknown.starts_with("yard.ron:4:") && unknown.contains(": robots[0] \"r\": "), "{unknown}");
}

#[test]
fn the_head_of_the_file() {
    let parse = |text: &str| World::parse("w.ron", text).unwrap_err().to_string();
    let bounds = "bounds: (min: (0, 0), max: (1, 1))";
    assert_eq!(
        parse(&format!("// new\nWorld(\n  version: 2, name: \"w\", sky: Blue, {bounds})")),
        "w.ron:3:12: version 2: this program reads version 1"
    );
    assert!(parse(&format!("World(name: \"w\", {bounds})")).contains("`version`"));
    assert!(parse(&format!("World(version: 1, name: \"\", {bounds})")).starts_with("w.ron:1:25: name \"\": "));
    assert!(
        parse("World(version: 1, name: \"w\",\n bounds: (min: (0, 0), max: (0, 1)))")
            .starts_with("w.ron:2:10: length 0")
    );
    assert!(
        parse("World(version: 1, name: \"w\",\n bounds: (min: (0, 0), max: (inf, 1)))")
            .starts_with("w.ron:2:10: point")
    );
    assert!(parse("World(version: 1, name: \"w\")").contains("`bounds`"));
    assert!(parse("").starts_with("w.ron:1:1: "));
    assert!(parse("Lot(version: 1)").starts_with("w.ron:1:"));
    assert!(parse(&format!("World(version: 1, name: \"w\", {bounds}) more")).starts_with("w.ron:1:"));
}

#[test]
fn the_rays_of_all_robots_together_have_a_limit() {
    let yard = |robots: &[usize]| {
        let sensors = |count: usize| {
            let each = (0..count).map(|k| format!("(name: \"{k}\", rays: 100000, range: 1)"));
            each.collect::<Vec<_>>().join(", ")
        };
        let robot = |(i, count): (usize, &usize)| {
            format!("(name: \"R{i}\", kind: \"rusty\", start: [1, 1, 0], sensors: [{}])", sensors(*count))
        };
        let robots: Vec<String> = robots.iter().enumerate().map(robot).collect();
        let bounds = "bounds: (min: (0, 0), max: (4, 3))";
        format!("World(version: 1, name: \"yard\", {bounds}, robots: [\n{}\n])", robots.join(",\n"))
    };
    // 6 times 64 and 16 are 400 sensors of 100,000 rays, forty million
    let most = World::parse("yard.ron", &yard(&[64, 64, 64, 64, 64, 64, 16])).unwrap();
    assert_eq!(most.robots.iter().map(|robot| robot.own_rays()).sum::<u64>(), 40_000_000);
    let error = World::parse("yard.ron", &yard(&[64, 64, 64, 64, 64, 64, 17, 1])).unwrap_err().to_string();
    let expected = "with its sensors there are 40100000 rays in all: at most 40000000";
    assert_eq!(error, format!("yard.ron:8:1: robots[6] \"R6\": {expected}"));
}

#[test]
fn a_refusal_is_one_short_line_whatever_stands_in_the_file() {
    let long = "long_".repeat(100_000);
    let lines = [format!("{long}: 1"), format!("walls: [(name: \"{long}\", points: [])]"), format!("walls: [{long}]")];
    for line in lines.into_iter().chain([format!("robots: [(name: \"r\", kind: \"{long}\\n\", start: [])]")]) {
        let refused = refusal(&line);
        assert!(refused.starts_with("yard.ron:3:") && refused.contains("long_"), "{refused:.200}");
        assert!(refused.len() < 1000 && refused.ends_with("..."), "{} bytes", refused.len());
    }
    let lines = refusal("robots: [(name: \"a\\nb\", kind: \"rusty\", start: [1, 1, 0])]");
    assert_eq!(lines.lines().count(), 1, "{lines}");
}
