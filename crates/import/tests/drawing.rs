//! SVG drawings.

use crate::{assert_prints_as_itself, corners, is_hit, sample};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Shape};
use motion_lab_core::num;
use motion_lab_core::worlds::{ObstacleKind, World};
use motion_lab_import::{Imported, SvgOptions, svg};

/// 50 units a metre.
const HALL: SvgOptions = SvgOptions { metres_per_unit: Some(0.02), tolerance: 1e-3 };

fn hall() -> Imported {
    svg("hall.svg", &sample("hall.svg"), "Hall", HALL).unwrap()
}

/// A drawing of 10 x 10 units that holds this.
fn drawing(inside: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10 10\">\n{inside}\n</svg>")
}

fn read(inside: &str) -> World {
    svg("d.svg", &drawing(inside), "d", SvgOptions::default()).unwrap().world
}

#[track_caller]
fn assert_near(found: &[(f64, f64)], expected: &[(f64, f64)]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f.0 - e.0).abs() <= 2e-6 && (f.1 - e.1).abs() <= 2e-6, "{found:?} {expected:?}");
    }
}

#[test]
fn what_is_filled_is_solid_and_what_is_stroked_a_wall() {
    let Imported { world, notes, .. } = hall();
    let names: Vec<(&str, ObstacleKind)> = world.obstacles.iter().map(|o| (o.name.as_str(), o.kind)).collect();
    use ObstacleKind::{Solid, Wall};
    let expected = [
        ("outer wall", Wall),
        ("screen", Wall),
        ("wall 1", Wall),
        ("table", Solid),
        ("pillar", Solid),
        ("polygon 1", Solid),
        ("polygon 2", Solid),
        ("frame", Solid),
    ];
    assert_eq!(names, expected);
    // y up: the sheet is 8 m high
    assert_eq!((world.bounds.min, world.bounds.max), (Point2::new(0.0, 0.0), Point2::new(12.0, 8.0)));
    assert_near(&corners(&world, "outer wall"), &[(1.0, 7.0), (11.0, 7.0), (11.0, 1.0), (1.0, 1.0)]);
    assert_near(&corners(&world, "screen"), &[(6.0, 7.0)]);
    assert_eq!(world.obstacle("wall 1").unwrap().pieces.len(), 2, "a polyline stays open");
    let table = &world.obstacle("table").unwrap().pieces[0].1;
    assert_eq!(*table, Shape::Rectangle { min: Point2::new(8.0, 5.0), max: Point2::new(10.0, 6.0) });
    let (pose, pillar) = &world.obstacle("pillar").unwrap().pieces[0];
    assert_eq!((pose.x, pose.y), (4.0, 5.5));
    assert_eq!(*pillar, Shape::Disc { radius: 0.5 });
    for left_out in ["text is left out", "its paper"] {
        assert!(notes.iter().any(|n| n.contains(left_out)), "{left_out}: {notes:?}");
    }
    assert_prints_as_itself(&world);
}

#[test]
fn groups_turn_and_move_what_they_hold() {
    let world = hall().world;
    // a square of 1 m turned by 45 degrees about its middle, (9, 2.5): corners half a diagonal away, up, down, left and
    // right
    let d = 0.5_f64.sqrt();
    let mut found = corners_of_polygon(&world, "polygon 1");
    found.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_near(&found, &[(9.0 - d, 2.5), (9.0, 2.5 - d), (9.0, 2.5 + d), (9.0 + d, 2.5)]);
    assert!(is_hit(&world, 9.0, 2.5) && !is_hit(&world, 9.4, 2.9), "the middle, not what was the corner");
}

fn corners_of_polygon(world: &World, name: &str) -> Vec<(f64, f64)> {
    let placed: Vec<_> = world.obstacle(name).unwrap().placed().collect();
    placed.iter().flat_map(|p| p.core().iter().map(|c| (c.x, c.y)).collect::<Vec<_>>()).collect()
}

#[test]
fn curves_are_followed_within_the_tolerance() {
    // the apse: from (4, 2) over the control point (5, 3) to (6, 2), a parabola through (5, 2.5)
    for tolerance in [0.1, 1e-2, 1e-3] {
        let options = SvgOptions { tolerance, ..HALL };
        let world = svg("hall.svg", &sample("hall.svg"), "Hall", options).unwrap().world;
        let apse = Scene::of_world(&World { obstacles: vec![world.obstacle("polygon 2").unwrap().clone()], ..world });
        let mut worst = 0.0_f64;
        for k in 0..=200 {
            let t = f64::from(k) / 200.0;
            let (x, y) = (4.0 + 2.0 * t, 2.0 + 2.0 * t * (1.0 - t));
            // a disc whose edge would just reach the curve from outside, by the distance to its middle
            let outside = Point2::new(x, y + 1.0);
            let gap = apse.distance(&Footprint::disc(outside, 1e-3)) + 1e-3;
            worst = num::greater(worst, gap - nearest(outside));
        }
        assert!(worst <= tolerance + 1e-5, "{worst} for {tolerance}");
        assert!(worst > tolerance / 50.0, "{worst} for {tolerance}: pieces were not made for nothing");
    }
}

/// The distance from a point above it to the parabola y = 2 + 2t(1 - t), x = 4 + 2t, by sampling.
fn nearest(p: Point2) -> f64 {
    (0..=4000)
        .map(|k| f64::from(k) / 4000.0)
        .map(|t| num::hypot(4.0 + 2.0 * t - p.x, 2.0 + 2.0 * t * (1.0 - t) - p.y))
        .fold(f64::INFINITY, num::lesser)
}

#[test]
fn drawings_without_sizes_ids_or_sense_still_have_walls() {
    let line = read("<path d='M1 1 L9 1' stroke='black'/>");
    assert_near(&corners(&line, "wall 1"), &[(1.0, 9.0)]);
    assert_eq!((line.bounds.max.x, line.bounds.max.y), (10.0, 10.0), "the viewBox's units");
    // a filled bow-tie is two triangles
    let bow = read("<polygon id='bow' points='1,1 9,9 9,1 1,9'/>");
    assert_eq!((bow.obstacles[0].kind, bow.obstacles[0].pieces.len()), (ObstacleKind::Solid, 2));
    assert!(is_hit(&bow, 2.0, 5.0) && is_hit(&bow, 8.0, 5.0) && !is_hit(&bow, 5.0, 7.0));
    // an ellipse is no disc, and the same id twice is two names
    let two = read("<ellipse id='e' cx='3' cy='3' rx='2' ry='1'/><circle id='e' cx='7' cy='7' r='1'/>");
    let names: Vec<&str> = two.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["e", "e 2"]);
    assert!(matches!(two.obstacles[1].pieces[0].1, Shape::Disc { .. }));
    assert!(!matches!(two.obstacles[0].pieces[0].1, Shape::Disc { .. }));
    // a quarter of a circle is no disc
    let quarter = read("<path d='M5 5 L9 5 A4 4 0 0 1 5 9 Z'/>");
    assert!(is_hit(&quarter, 6.0, 4.0) && !is_hit(&quarter, 4.9, 5.1), "y was turned over");
    // a hidden shape is no obstacle
    let rect = "<rect x='1' y='1' width='1' height='1' visibility='hidden'/>";
    let hidden = drawing(&format!("{rect}{rect}<rect x='4' y='4' width='1' height='1'/>"));
    let hidden = svg("d.svg", &hidden, "d", SvgOptions::default()).unwrap();
    assert_eq!(hidden.world.obstacles.len(), 1);
    assert_eq!(hidden.notes, ["what is drawn invisibly is left out"], "said once");
    for world in [line, bow, two, quarter] {
        assert_prints_as_itself(&world);
    }
}

#[test]
fn drawings_that_cannot_be_worlds_are_refused_with_line_and_element() {
    let refuse = |inside: &str| svg("d.svg", &drawing(inside), "d", SvgOptions::default()).unwrap_err().to_string();
    assert_eq!(refuse(""), "d.svg: there is no obstacle in it");
    assert_eq!(refuse("<text x='1' y='1'>words</text>"), "d.svg: there is no obstacle in it");
    let photo = refuse("\n<image id='photo' href='/etc/passwd'/><text>words</text>");
    assert_eq!(photo, "d.svg: there is no obstacle in it: image \"photo\" is left out");
    assert_eq!(
        refuse("<foreignObject/>"),
        "d.svg: there is no obstacle in it: the foreignObject in line 2 is left out"
    );
    for (shape, item) in [
        ("<rect width='nan' height='1'/>", "rect: width = nan"),
        ("<circle r='inf'/>", "circle: r = inf"),
        ("<circle id='c' r='1e999'/>", "circle \"c\": r = 1e999"),
        ("<path d='M 0 0 L nan 1'/>", "path: d = "),
        ("<polygon points='0,0 1,inf 2,2'/>", "polygon: points = "),
    ] {
        assert!(refuse(shape).starts_with(&format!("d.svg:2: {item}")), "{}", refuse(shape));
    }
    let far = refuse("<line id='far' x1='0' y1='0' x2='1e6' y2='5' stroke='red'/>");
    assert!(far.starts_with("d.svg: far: ") && far.contains("coordinates must be finite and at most 10000"), "{far}");
    let huge = svg("d.svg", &drawing("").replace("0 0 10 10", "0 0 1e9 1e9"), "d", SvgOptions::default());
    assert!(huge.is_err());
    let sheet = drawing("<line x1='0' y1='0' x2='1' y2='1' stroke='red'/>").replace("0 0 10 10", "0 0 1e9 1e9");
    assert!(svg("d.svg", &sheet, "d", SvgOptions::default()).unwrap_err().to_string().contains("at most 10000"));
    assert!(svg("d.svg", "<svg", "d", HALL).unwrap_err().to_string().starts_with("d.svg:1: "));
    assert!(svg("d.svg", "<html/>", "d", HALL).unwrap_err().to_string().starts_with("d.svg: no drawing"));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let one = svg("d.svg", &sample("hall.svg"), "d", SvgOptions { metres_per_unit: Some(bad), ..HALL });
        let other = svg("d.svg", &sample("hall.svg"), "d", SvgOptions { tolerance: bad, ..HALL });
        assert!(one.unwrap_err().to_string().contains("metres per unit"));
        assert!(other.unwrap_err().to_string().contains("tolerance"));
    }
    let deep = format!("{}{}", "<g>".repeat(1_200), "</g>".repeat(1_200));
    assert!(refuse(&deep).contains("nested deeper than 1000"));
}

/// Drawings that took, or would take, their reader minutes or gigabytes. Each is refused with a reason, or read as the
/// shapes it shows.
#[test]
fn drawings_that_would_take_for_ever_are_refused_or_read() {
    let refuse = |inside: &str| svg("d.svg", &drawing(inside), "d", SvgOptions::default()).unwrap_err().to_string();
    let rect = "<rect id='u0' x='1' y='1' width='1' height='1'/>";
    assert!(refuse("<circle id='c' r='1e30'/>").contains("coordinates must be finite and at most 10000 m in size"));
    let coarse = "not supported: numbers that stand for more than a million kilometres";
    assert!(refuse("<path d='M0 0 A 1e10 1e10 0 0 1 9 9'/>").starts_with(&format!("d.svg:2: path: {coarse}")));
    // ten copies of ten copies: 1 + 10 + ... above fifty thousand elements
    let ten = |k: usize| format!("<g id='u{k}'>{}</g>", format!("<use href='#u{}'/>", k - 1).repeat(10));
    let nested: String = (1..9).map(ten).collect();
    assert!(refuse(&format!("<defs>{rect}{nested}</defs><use href='#u8'/>")).contains("more than 50000 elements"));
    assert!(refuse("<g id='g'><use href='#g'/></g>").contains("elements nested deeper than 1000"));
    // and ten copies alone are ten obstacles
    assert_eq!(read(&format!("<defs>{rect}</defs>{}", "<use href='#u0'/>".repeat(10))).obstacles.len(), 10);
    let elements = |n: usize| refuse(&"<g/>".repeat(n));
    assert_eq!(elements(49_999), "d.svg: there is no obstacle in it");
    assert!(elements(50_000).contains("more than 50000 elements"));
    let path = |n: usize| format!("<path fill='none' stroke='red' d='M0 0{}'/>", " h1v1h-1v-1".repeat(n / 4));
    assert!(refuse(&path(1_600_000)).contains("bytes of paths and points"));
    assert!(refuse(&path(100_004)).contains("too many shapes: at most 100000"));
    // a curve of 10^4 m at a micrometre
    let fine = SvgOptions { tolerance: 1e-6, ..SvgOptions::default() };
    let large = "<path stroke='red' d='M0 0 C 9e3 9e3 9e3 -9e3 0 0'/>".repeat(20);
    let error = svg("d.svg", &drawing(&large), "d", fine).unwrap_err().to_string();
    assert!(error.contains("too many"), "{error}");
    let below = SvgOptions { tolerance: 0.9e-6, ..SvgOptions::default() };
    assert!(svg("d.svg", &drawing(rect), "d", below).unwrap_err().to_string().contains("tolerance: 0.0000009"));
    // a fill of patterns within patterns, markers, filters and gradients is a filled box like any other
    let pattern =
        |k: usize| format!("<pattern id='p{k}'><rect width='1' height='1' fill='url(#p{})'/></pattern>", k + 1);
    let patterns: String = (0..30).map(|k| pattern(k).repeat(2)).collect();
    let painted = "<rect x='1' y='2' width='3' height='4' style='fill:url(#p0);filter:url(#f)' marker-mid='url(#m)'/>";
    let marker = format!("<marker id='m'>{}</marker><filter id='f'/>", rect.repeat(300));
    let imported = svg("d.svg", &drawing(&format!("{patterns}{marker}{painted}")), "d", SvgOptions::default()).unwrap();
    assert_eq!(imported.world.obstacles.len(), 1);
    let expected = Shape::Rectangle { min: Point2::new(1.0, 4.0), max: Point2::new(4.0, 8.0) };
    assert_eq!(imported.world.obstacles[0].pieces[0].1, expected, "y was turned over");
    assert_eq!(imported.notes, ["markers are left out"]);
    // styles: the sheet decides as it does in a browser; a sheet of many rules for many elements is refused
    let styled =
        |rules: &str| read(&format!("<style>{rules}</style>{}", painted.replace("style=", "class='a' title=")));
    assert_eq!(styled(".a{fill:none;stroke:red;filter:url(#f)}").obstacles[0].kind, ObstacleKind::Wall);
    assert_eq!(styled(".b{fill:none;stroke:red}").obstacles[0].kind, ObstacleKind::Solid);
    let rules = format!("<style>{}</style>{}", ".a{fill:red}".repeat(30_000), rect.repeat(100));
    assert!(refuse(&rules).contains("bytes of style sheets"), "{}", refuse(&rules));
    let rules = format!("<style>{}</style>{}", ".a{fill:red}".repeat(20_000), "<g/>".repeat(60));
    assert!(refuse(&rules).contains("style sheets of 20000 selectors for 62 elements"), "{}", refuse(&rules));
    // 101 concave polygons of 1,000 corners each: more pieces than a world may have
    let comb: String = (0..499).map(|k| format!("{} 0 {}.5 1 ", 2 * k, 2 * k)).collect();
    let polygon = format!("<polygon points='{comb} 998 9 0 9'/>");
    assert!(refuse(&polygon.repeat(101)).contains("too many corners of concave polygons: at most 100000"));
}

/// Attributes and elements that other programs add to a drawing.
#[test]
fn attributes_of_others_and_what_is_left_out_change_nothing() {
    let spaces = "xmlns:xlink='http://www.w3.org/1999/xlink' xmlns:q='urn:q'";
    let read = |inside: &str| {
        let text = drawing(inside).replacen("<svg ", &format!("<svg {spaces} "), 1);
        svg("d.svg", &text, "d", SvgOptions::default()).map(|imported| imported.world)
    };
    let corners = |inside: &str| {
        let world = read(inside).unwrap();
        assert_eq!(world.obstacles.len(), 1, "{inside}");
        let Aabb { min: low, max: high } = world.obstacles[0].placed().next().unwrap().bounds();
        [low.x, low.y, high.x, high.y].map(|x| (x * 1e6).round() / 1e6)
    };
    let rect = "<rect id='a' x='1' y='1' width='2' height='1'/>";
    assert_eq!(corners(rect), [1.0, 8.0, 3.0, 9.0]);
    // both kinds of reference, as written for older readers, one with a blank
    let used = format!("<defs>{rect}</defs><use href=' #a' xlink:href='#a' x='4'/>");
    assert_eq!(corners(&used), [5.0, 8.0, 7.0, 9.0]);
    assert_eq!(corners(&used.replace("href=' #a' ", "")), [5.0, 8.0, 7.0, 9.0]);
    let foreign =
        "<rect q:fill='none' q:r='any text' q:x='5' q:id='b' x='1' y='1' width='2' height='1' q:transform='x'/>";
    assert_eq!(corners(foreign), [1.0, 8.0, 3.0, 9.0]);
    // a quarter turn about the middle of a box of 2 by 1
    let turned = rect.replace("/>", " transform='rotate(90)' transform-origin='2 1.5'/>");
    assert_eq!(corners(&turned), [1.5, 7.5, 2.5, 9.5]);
    let switch = format!("<switch><rect requiredExtensions='urn:x' width='9' height='1'/>{rect}</switch>");
    assert_eq!(corners(&switch), [1.0, 8.0, 3.0, 9.0]);
    let sized = "<g style='font-size:2px'><rect x='1em' y='1' width='1em' height='1'/></g>";
    assert_eq!(corners(sized), [2.0, 8.0, 4.0, 9.0]);
    let important = rect.replace("/>", " style='fill:none !important;stroke:red;fill:red'/>");
    assert_eq!(read(&important).unwrap().obstacles[0].kind, ObstacleKind::Wall);
    // style rules for ignored elements, and ten thousand metadata elements
    let rules = format!(
        "<style>#g .a .b text{{font-size-adjust:1}}</style><metadata>{}</metadata>{rect}",
        "<q:x/>".repeat(9_000)
    );
    assert_eq!(corners(&rules), [1.0, 8.0, 3.0, 9.0]);
    // a path of a megabyte may be used three times beside itself, but not four times
    let path = format!("<path id='p' stroke='red' fill='none' d='M1 1{}'/>", "h1h-1".repeat(200_000));
    let uses = |n: usize| read(&format!("{path}{}", "<use href='#p'/>".repeat(n))).unwrap_err().to_string();
    assert!(uses(3).contains("too many"), "{}", uses(3));
    assert!(uses(4).contains("bytes of paths and points"), "{}", uses(4));
}
