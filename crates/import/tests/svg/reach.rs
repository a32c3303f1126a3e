//! Numbers that grow beyond every world by their transforms, and boxes around large curves.

use super::{drawn, extent, import, names, sheet};
use motion_lab_core::geometry::Shape;
use motion_lab_import::{SvgOptions, svg};

const SHAPES: [&str; 7] = [
    "<rect id='s' width='3' height='2'/>",
    "<rect id='s' width='3' height='2' rx='1'/>",
    "<circle id='s' r='2'/>",
    "<polygon id='s' points='0 0 3 3 3 0 0 3'/>",
    "<path id='s' d='M0 0h5v5h-5zM1 1h5v5h-5z'/>",
    "<path id='s' d='M1 1C2 3 4 5 9 9' fill='none' stroke='red'/>",
    "<line id='s' x2='5' y2='5' stroke='red'/>",
];

fn refusal(inside: &str) -> String {
    svg("d.svg", &sheet(inside), "d", SvgOptions::default()).unwrap_err().to_string()
}

#[test]
fn shapes_that_transforms_throw_out_of_the_world_are_refused() {
    let clip = "<clipPath id='c'><rect width='9' height='9'/></clipPath>";
    for shape in SHAPES {
        for (before, after) in [
            ("<g transform='scale(1e20)'>", "</g>"),
            ("<g transform='translate(1e20)'>", "</g>"),
            ("<g transform='scale(1e300)'><g transform='scale(1e300)'>", "</g></g>"),
            // infinity times zero
            ("<g transform='scale(1e300)'><g transform='scale(1e300)'><g transform='scale(0)'>", "</g></g></g>"),
            ("<g transform='matrix(1 0 1e30 1 -1e30 0)'>", "</g>"),
            ("<g clip-path='url(#c)'><g transform='scale(1e20)'>", "</g></g>"),
            ("<svg width='9' height='9'><g transform='scale(-1e20)'>", "</g></svg>"),
            ("<svg width='9' height='9' viewBox='0 0 1e-20 1e-20'>", "</svg>"),
            ("<svg width='1e300' height='1e300' viewBox='0 0 1 1' overflow='visible'>", "</svg>"),
        ] {
            let error = refusal(&format!("{clip}{before}{shape}{after}"));
            let is_far = error.contains("coordinates must be finite and at most 10000 m in size");
            assert!(error.starts_with("d.svg: s: ") && is_far, "{before}{shape}: {error}");
        }
        // what is out of a world only is refused as well, once nothing cuts it
        let far = format!("<g transform='translate(20000)'>{shape}</g>");
        assert!(refusal(&far).starts_with("d.svg: s: "), "{}", refusal(&far));
        for metres in [1e20, 1e300] {
            let options = SvgOptions { metres_per_unit: Some(metres), ..SvgOptions::default() };
            let error = svg("d.svg", &sheet(shape), "d", options).unwrap_err().to_string();
            assert!(error.contains("coordinates must be finite and at most 10000 m in size"), "{shape}: {error}");
        }
    }
}

#[test]
fn what_cuts_too_far_out_leaves_out_what_it_cuts() {
    let post = "<circle id='post' cx='9' cy='5' r='1'/>";
    let cuts = "<circle r='1'/><path d='M0 0C1 1 2 1 3 0'/><polygon points='0 0 1 0 1 1'/>";
    for shape in SHAPES {
        let by_clip = |clip: &str| drawn(&format!("{clip}<g id='g' clip-path='url(#c)'>{shape}</g>{post}"));
        let shapes = cuts.split_inclusive('>').map(|cut| format!("<clipPath id='c' transform='scale(1e20)'>{cut}"));
        let moved = cuts.replace("/>", " transform='scale(1e200) scale(1e100)'/>");
        for clip in shapes.chain([format!("<clipPath id='c'>{moved}")]) {
            let found = by_clip(&format!("{clip}</clipPath>"));
            assert_eq!(names(&found.world), ["post"], "{clip}");
            assert_eq!(found.notes, ["g \"g\" is left out: its clip path reaches too far"], "{clip}");
        }
        for around in
            ["<g transform='scale(1e20)'>", "<g transform='scale(1e200)'><g transform='rotate(9) scale(1e200)'>"]
        {
            let end = "</g>".repeat(around.matches("<g").count());
            let found = drawn(&format!("{around}<svg id='v' width='9' height='9'>{shape}</svg>{end}{post}"));
            assert_eq!(names(&found.world), ["post"], "{around}");
            assert_eq!(found.notes, ["svg \"v\" is left out: its viewport reaches too far"], "{around}");
        }
    }
}

#[test]
fn what_reaches_beyond_the_world_may_be_cut_down_to_it() {
    let window = "<clipPath id='c'><rect x='2' y='3' width='4' height='5'/></clipPath>";
    for size in ["2e5", "1e7"] {
        let rect = format!("<rect id='r' x='-1e5' y='-1e5' width='{size}' height='{size}'/>");
        let cut = drawn(&format!("{window}<g clip-path='url(#c)'>{rect}</g>")).world;
        assert_eq!(extent(&cut, "r"), [2.0, 2.0, 6.0, 7.0]);
        // and a clip path may be larger than the world
        let small = "<rect id='r' x='1' y='1' width='2' height='1'/>";
        let cut = drawn(&format!("<clipPath id='c'>{rect}</clipPath><g clip-path='url(#c)'>{small}</g>")).world;
        assert_eq!(extent(&cut, "r"), [1.0, 8.0, 3.0, 9.0]);
    }
    // paper that is larger than any world
    let found = drawn("<rect x='-1e6' y='-1e6' width='1e7' height='1e7'/><circle id='post' r='1'/>");
    assert_eq!(names(&found.world), ["post"]);
}

#[test]
fn a_drawing_without_a_size_is_as_large_as_its_largest_curve() {
    let bounds = |inside: &str| {
        let found = import(&format!("<svg xmlns='http://www.w3.org/2000/svg'>{inside}</svg>")).world;
        (found.bounds.max.x, found.bounds.max.y)
    };
    for r in [1.0, 7.0, 3_000.0, 4_999.0] {
        let circle = format!("<circle cx='{r}' cy='{r}' r='{r}'/>");
        assert_eq!(bounds(&circle), (2.0 * r, 2.0 * r), "{r}");
        // two arcs of a path, and quarters at the corners of a rectangle
        let path = format!("<path d='M0 {r}A{r} {r} 0 0 1 {d} {r}A{r} {r} 0 0 1 0 {r}z'/>", d = 2.0 * r);
        assert_eq!(bounds(&path), (2.0 * r, 2.0 * r), "{r}");
        let round = format!("<rect width='{d}' height='{d}' rx='{r}'/>", d = 2.0 * r);
        assert_eq!(bounds(&round), (2.0 * r, 2.0 * r), "{r}");
        // the greatest y of a parabola with its control point at 2 r
        assert_eq!(bounds(&format!("<path d='M0 0Q{r} {d} {d} 0'/>", d = 2.0 * r)), (2.0 * r, r), "{r}");
    }
}

#[test]
fn large_curves_are_cut_and_turned_by_the_boxes_around_them() {
    let large = |inside: &str| {
        import(&format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9000 9000'>{inside}</svg>"))
    };
    let near = |found: [f64; 4], expected: [f64; 4]| (0..4).all(|i| (found[i] - expected[i]).abs() < 2e-3);
    let half = "<clipPath id='c' clipPathUnits='objectBoundingBox'><rect x='.5' width='.5' height='1'/></clipPath>";
    let cut = large(&format!("{half}<circle id='s' cx='4000' cy='4000' r='4000' clip-path='url(#c)'/>"));
    assert!(cut.notes.is_empty(), "{:?}", cut.notes);
    assert!(near(extent(&cut.world, "s"), [4000.0, 1000.0, 8000.0, 9000.0]), "{:?}", extent(&cut.world, "s"));
    // a quarter turn about the middle of its own box
    let style = "style='transform-box:fill-box;transform-origin:center;transform:rotate(90deg)'";
    let turned = large(&format!("<ellipse id='s' cx='5000' cy='4000' rx='3000' ry='2500' {style}/>"));
    assert!(turned.notes.is_empty(), "{:?}", turned.notes);
    assert!(near(extent(&turned.world, "s"), [2500.0, 2000.0, 7500.0, 8000.0]), "{:?}", extent(&turned.world, "s"));
    // about the lower right corner of the box around a disc
    let style = style.replace("center", "100% 100%").replace("90deg", "180deg");
    let moved = large(&format!("<circle id='s' cx='2000' cy='2000' r='2000' {style}/>")).world;
    let (pose, disc) = &moved.obstacles[0].pieces[0];
    assert_eq!((pose.x, pose.y, disc), (6000.0, 3000.0, &Shape::Disc { radius: 2000.0 }));
}
