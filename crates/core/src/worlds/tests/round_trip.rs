//! Tests of reading, printing and reading again, and of malformed texts.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::{Point2, Pose2, Shape};
use crate::random::{Seed, Stream};
use crate::worlds::{BeamModel, MAX_ITEMS, ObstacleKind, World, turns};

const FILES: [&str; 3] = [
    include_str!("../../../worlds/apartment.ron"),
    include_str!("../../../worlds/workbench.ron"),
    include_str!("../../../worlds/lot.ron"),
];

/// A world with every feature of the format.
const YARD: &str = r#"
// a comment
World(
    version: 1, name: "Yard \"2\" \\ \u{e9}\u{2603}",
    bounds: (min: (-0.0, 0), max: (8, 6)),
    walls: [(name: "fence", points: [(0, 0), (8, 0), (8, 6)], closed: true), (name: "gate", points: [(1, 1), (2, 2)])],
    obstacles: [
        (name: "tree", shape: Disc(center: (2, 3), radius: 0.4)),
        (name: "shed", shape: Box(min: (5, 4), max: (7, 5.5))),
        (name: "pond", shape: Polygon([(4, 1), (6, 1), (5.5, 2), (6, 3), (4, 3)])),
        (name: "sign", shape: Polygon([(1, 4), (1, 5), (2, 4)])), // clockwise
        (name: "log", shape: Rounded(points: [(1, 1), (2, 1)], radius: 0.2)),
        (name: "rail", shape: Rounded(points: [(1, 1), (2, 1)], radius: 0)),
        (name: "rock", shape: Rounded(points: [(1, 1), (2, 1), (1.5, 1.25), (1, 2)], radius: 0.1)),
        (name: "table", shape: Union([Box(min: (1, 4), max: (3, 5)), Union([Disc(center: (0, 0), radius: 1e-3)])])),
        (name: "islands", shape: Union([Disc(center: (0, 0), radius: 1), Polygon([(5, 1), (7, 1), (6, 1.5), (6, 3)]),
            Box(min: (1, 4), max: (3, 5)), Polygon([(5, 3), (5.5, 1), (5, 1.5), (4, 1)])])), // the second clockwise
    ],
    places: [(name: "home", pose: (x: 3e0, y: 0.1, theta: 7))],
    marks: [(name: "path", points: [(0, 3), (4, 3.5), (4.00000000001, 5e-324)], closed: true)],
    robots: [
        (name: "Rusty", kind: "rusty", start: [3, 5.5, -3.141592653589793]), (name: "a", kind: "hitch", start: [1, 2, 3, 4]),
        (name: "b", kind: "reach3", start: [1, 2, 3]), (name: "c", kind: "x-drone", start: [10000000000, 9]),
        (name: "d", kind: "rusty", start: [1, 1, 0], sensor: (sigma_hit: 0.02, z_miss: 1e-3, z_max: -0.0)),
        (name: "e", kind: "x-own", start: [1], sensor: ()),
    ],
)
"#;

fn assert_round_trip(world: &World) {
    let text = world.to_ron();
    let again = World::parse("printed", &text).unwrap();
    assert_eq!(&again, world);
    assert_eq!(again.to_ron(), text);
}

#[test]
fn printing_and_reading_gives_the_same_world_and_the_same_bytes() {
    for text in FILES.into_iter().chain([YARD]) {
        assert_round_trip(&World::parse("file", text).unwrap());
    }
}

#[test]
fn the_yard_is_read_as_meant() {
    let world = World::parse("yard.ron", YARD).unwrap();
    let p = Point2::new;
    assert_eq!(world.name, "Yard \"2\" \\ \u{e9}\u{2603}");
    assert_eq!(world.bounds.min.x.to_bits(), 0.0_f64.to_bits(), "no negative zero");
    let pieces = |name: &str| world.obstacle(name).unwrap().pieces.clone();
    // a closed wall gets its last side; the order is walls, then solids
    assert_eq!(pieces("fence")[2], (Pose2::IDENTITY, Shape::Segment { a: p(8.0, 6.0), b: p(0.0, 0.0) }));
    let kinds: Vec<ObstacleKind> = world.obstacles.iter().map(|o| o.kind).collect();
    assert!(
        kinds[..2].iter().all(|k| *k == ObstacleKind::Wall) && kinds[2..].iter().all(|k| *k == ObstacleKind::Solid)
    );
    assert_eq!(pieces("tree"), [(Pose2::new(2.0, 3.0, 0.0), Shape::Disc { radius: 0.4 })]);
    assert_eq!(pieces("pond").len(), 2, "one notch, two convex pieces");
    let pond = "(name: \"pond\", shape: Polygon([(4.0, 1.0), (6.0, 1.0), (5.5, 2.0), (6.0, 3.0), (4.0, 3.0)])),";
    assert!(world.to_ron().contains(pond), "and printed as the polygon that was written");
    // an obstacle changed by hand, whose outline no longer matches, is printed as its pieces
    let mut other = world.clone();
    let at = other.obstacles.iter().position(|o| o.name == "pond").unwrap();
    other.obstacles[at].outlines[0].points[2].x = 5.25;
    assert!(other.to_ron().contains("(name: \"pond\", shape: Union([Polygon(["));
    other.obstacles[at].outlines.clear();
    assert!(other.to_ron().contains("(name: \"pond\", shape: Union([Polygon(["));
    assert_eq!(world.obstacle("sign").unwrap().placed().next().unwrap().core(), [p(1., 4.), p(2., 4.), p(1., 5.)]);
    assert_eq!(pieces("log")[0].1, Shape::Capsule { a: p(1.0, 1.0), b: p(2.0, 1.0), radius: 0.2 });
    assert!(matches!(&pieces("rock")[0].1, Shape::Hull { vertices, radius: 0.1 } if vertices.len() == 3));
    assert_eq!(pieces("table").len(), 2);
    assert_eq!(world.marks[0].points.len(), 4);
    assert_eq!(world.place("home").unwrap().pose.theta, 7.0 - std::f64::consts::TAU);
    assert_eq!(world.robots[0].start[2], std::f64::consts::PI, "angles lie in (-pi, pi]");
    let noise = BeamModel { sigma_hit: 0.02, z_miss: 1e-3, ..BeamModel::EXACT };
    let sensors: Vec<_> = world.robots.iter().map(|r| r.sensor).collect();
    assert_eq!(sensors, [None, None, None, None, Some(noise), Some(BeamModel::EXACT)], "left out, 0 (or a rate of 1)");
    assert_eq!(world.robots[3].start, [1e10, 9.0], "what a program's own robot means is its own business");
}

#[test]
fn sensors_are_read_as_meant_and_printed_without_what_is_as_if_left_out() {
    let yard = |sensors: &str| {
        let robot = format!("(name: \"car\", kind: \"hitch\", start: [1.0, 2.0, 0.5]{sensors})");
        format!("World(version: 1, name: \"y\", bounds: (min: (0, 0), max: (8, 6)), robots: [{robot}])")
    };
    let world = World::parse(
        "y.ron",
        &yard(
            ", sensors: [(name: \"b \\\"2\\\"\", rays: 3, range: 4, field_of_view: 1.5,
        mount: (x: 0.5, y: -0.0, theta: 7), noise: (sigma_hit: 0.25)), (name: \"a\", rays: 90, range: 0.5,
        field_of_view: 6.283185307179586, mount: (x: 0, y: 0, theta: -0.0))]",
        ),
    )
    .unwrap();
    assert_round_trip(&world);
    let [b, a] = &world.robots[0].sensors[..] else { panic!("in the order of the file") };
    assert_eq!((b.rays.sensor.n_rays, b.rays.sensor.max_range, b.rays.field_of_view), (3, 4.0, 1.5));
    assert_eq!(b.mount, Pose2::new(0.5, 0.0, 7.0));
    assert_eq!(b.noise, Some(BeamModel { sigma_hit: 0.25, ..BeamModel::EXACT }));
    assert_eq!((a.rays.field_of_view, a.mount, a.noise), (std::f64::consts::TAU, Pose2::IDENTITY, None));
    let noise = "(sigma_hit: 0.25, z_short: 0.0, lambda_short: 1.0, z_miss: 0.0, z_max: 0.0, z_rand: 0.0)";
    let line = format!(
        "(name: \"car\", kind: \"hitch\", start: [1.0, 2.0, 0.5], sensors: [(name: \"b \\\"2\\\"\", rays: 3, range: 4.0, \
         field_of_view: 1.5, mount: (x: 0.5, y: 0.0, theta: 0.7168146928204138), noise: {noise}), (name: \"a\", rays: 90, \
         range: 0.5)]),"
    );
    assert!(world.to_ron().contains(&line), "{}", world.to_ron());
    let empty = World::parse("y.ron", &yard(", sensors: []")).unwrap();
    assert_eq!(empty.to_ron(), World::parse("y.ron", &yard("")).unwrap().to_ron(), "no sensors, no word of them");
    assert_ne!(world.content_hash(), empty.content_hash());
}

#[test]
fn the_hash_sees_the_content_and_not_the_form() {
    for text in FILES {
        let world = World::parse("file", text).unwrap();
        let hash = world.content_hash();
        let bare: String = text.lines().filter_map(|l| l.split("//").next()).collect::<Vec<_>>().join(" ");
        assert_ne!(bare, text);
        assert_eq!(World::parse("bare", &bare).unwrap().content_hash(), hash);
        assert_eq!(World::parse("printed", &world.to_ron()).unwrap().content_hash(), hash);
        let mut other = world.clone();
        other.bounds.max.x = f64::from_bits(other.bounds.max.x.to_bits() + 1);
        assert_ne!(other.content_hash(), hash, "the last bit of one number");
        let mut other = world;
        other.robots[0].name.push('2');
        assert_ne!(other.content_hash(), hash);
    }
}

#[test]
fn every_prefix_is_refused_and_none_panics() {
    for text in FILES.into_iter().chain([YARD]) {
        let whole = text.trim_end().len();
        for end in (0..whole).filter(|&end| text.is_char_boundary(end)) {
            let error = World::parse("cut.ron", &text[..end]).unwrap_err();
            assert!(error.line >= 1 && error.line <= text.lines().count(), "{error}");
        }
        assert!(World::parse("whole.ron", &text[..whole]).is_ok());
    }
}

#[test]
fn random_edits_give_an_error_or_a_world_that_survives_printing() {
    const SPICE: [&str; 24] = [
        "inf",
        "-inf",
        "NaN",
        "1e999",
        "-1",
        "0",
        "1e-4",
        "9999999",
        "\"\"",
        "(",
        ")",
        "[",
        "]",
        ",",
        ":",
        "r#\"",
        "/*",
        "//",
        "\u{0}",
        "\u{1F980}",
        "Some(1)",
        "'x'",
        "#![enable(implicit_some)]",
        "0xff",
    ];
    let mut s = Stream::new(Seed(6), "fuzz");
    let (mut good, mut bad) = (0, 0);
    for i in 0..4000 {
        let text = if i % 4 == 3 { YARD } else { FILES[i % 4] };
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..=s.below(3) {
            let at = s.below(bytes.len() as u64) as usize;
            match s.below(4) {
                0 => bytes[at] = s.below(128) as u8,
                1 => drop(bytes.drain(at..std::cmp::min(bytes.len(), at + 1 + s.below(6) as usize))),
                2 => drop(bytes.splice(at..at, SPICE[s.below(24) as usize].bytes())),
                _ => {
                    let digit = bytes.iter().skip(at).position(u8::is_ascii_digit);
                    digit.into_iter().for_each(|d| bytes[at + d] = b'0' + s.below(10) as u8);
                }
            }
        }
        match World::parse("edited.ron", &String::from_utf8_lossy(&bytes)) {
            Ok(world) => {
                assert_round_trip(&world);
                good += 1;
            }
            Err(error) => {
                assert!(error.to_string().starts_with(&format!("edited.ron:{}:{}: ", error.line, error.column)));
                bad += 1;
            }
        }
    }
    assert!(good > 500 && bad > 500, "{good} {bad}");
}

#[test]
fn deep_nesting_is_an_error_and_no_overflow() {
    for (open, close) in [("[", "]"), ("(", ")"), ("Some(", ")"), ("/*", "*/"), ("Union([", "])"), ("{", "}")] {
        for around in
            ["", "World(version: 1, extra: ", "World(version: 1, name: \"\", bounds: (), obstacles: [(shape: "]
        {
            for n in [100, 127, 200, 50_000] {
                let text = format!("{around}{}{}", open.repeat(n), close.repeat(n));
                assert!(World::parse("deep.ron", &text).is_err());
            }
        }
    }
}

#[test]
fn a_hundred_thousand_shapes_are_read_and_one_more_is_not() {
    let with = |n: usize| {
        let points: Vec<String> = (0..=n).map(|i| format!("({}, {})", i % 1000, i / 1000)).collect();
        let text = format!(
            "World(version: 1, name: \"many\", bounds: (min: (0, 0), max: (1000, 1000)),\n\
             walls: [(name: \"w\", points: [{}])],\nobstacles: [(name: \"o\", shape: Disc(center: (0, 0), radius: 1))])",
            points.join(", ")
        );
        World::parse("many.ron", &text)
    };
    assert_round_trip(&with(MAX_ITEMS - 1).unwrap());
    let error = with(MAX_ITEMS).unwrap_err();
    assert_eq!(error.to_string(), "many.ron:3:13: obstacles[0] \"o\": too many shapes: at most 100000");
}

#[test]
fn every_angle_of_a_world_file_may_be_in_degrees() {
    let file = |angles: [&str; 6]| {
        let [theta, mount, view, steer, fold, start] = angles;
        format!(
            "World(version: 1, name: \"w\", bounds: (min: (0, 0), max: (40, 20)), places: [\n\
             (name: \"p\", pose: (x: 3, y: 4, theta: {theta})),\n], robots: [\n\
             (name: \"car\", kind: \"hitch\", start: [5, 5, {start}],\n\
             car: (max_steer: {steer}, trailer: (jackknife: {fold})),\n\
             sensors: [(name: \"ahead\", rays: 9, range: 4, field_of_view: {view},\n\
             mount: (x: 0.5, y: 0, theta: {mount}))]),\n])"
        )
    };
    // 90, -180, 60, 30, 80 and 45 degrees, by a calculator of many digits
    let degrees = file(
        ["90deg", "-180deg", "60deg", "30deg", "80deg", "45deg"]
            .map(|a| format!("\"{a}\""))
            .each_ref()
            .map(String::as_str),
    );
    let radians = file([
        "1.5707963267948966",
        "-3.141592653589793",
        "1.0471975511965976",
        "0.5235987755982988",
        "1.3962634015954636",
        "0.7853981633974483",
    ]);
    let [degrees, radians] = [degrees, radians].map(|text| World::parse("w.ron", &text).unwrap());
    let (p, q) = (degrees.places[0].pose, radians.places[0].pose);
    assert_eq!((p.theta, q.theta), (FRAC_PI_2, FRAC_PI_2));
    assert!(degrees.to_ron() == radians.to_ron(), "{}\n{}", degrees.to_ron(), radians.to_ron());

    let noted = turns(&file(["90", "-180", "60", "30", "80", "45"]));
    let says = |what: &str, n: &str, turns: &str| {
        format!("the {what}: {n} rad is {turns} turns; angles are radians; write \"{n}deg\"")
    };
    // 90, 45, 30, 80, 180 and 60 over 2 pi are 14.32, 7.16, 4.77, 12.73, 28.65 and 9.55
    let expected = [
        says("place p", "90", "14.3"),
        says("start of car", "45", "7.2"),
        says("max_steer of car", "30", "4.8"),
        says("jackknife of car", "80", "12.7"),
        says("mount of car's ahead", "-180", "28.6"),
        says("field_of_view of car's ahead", "60", "9.5"),
    ];
    assert_eq!(noted, expected);
    assert!(turns(&radians.to_ron()).is_empty());
    for (from, to) in [("x: 3", "x: \"3deg\""), ("x: 0.5", "x: \"5deg\""), ("range: 4", "range: \"4deg\"")] {
        let text = file(["0", "0", "1", "0.5", "1", "0"]);
        assert!(World::parse("w.ron", &text).is_ok() && text.contains(from));
        let error = World::parse("w.ron", &text.replace(from, to)).unwrap_err().to_string();
        assert!(error.starts_with("w.ron:"), "{error}");
    }
}
