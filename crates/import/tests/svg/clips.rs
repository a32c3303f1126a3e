//! Clip paths and viewports cut; what cannot be read is left out by name.

use super::{area, drawn, extent, import, lies_in, names};
use crate::is_hit;
use motion_lab_core::geometry::Shape;

/// What a shape becomes under a clip path of this content.
fn clipped(clip: &str, shape: &str) -> motion_lab_import::Imported {
    drawn(&format!("<g clip-path='url(#c)'>{shape}</g><defs><clipPath id='c'>{clip}</clipPath></defs>"))
}

const BOX: &str = "<rect id='box' x='2' y='2' width='4' height='2'/>";

#[test]
fn a_clip_path_that_cuts_nothing_changes_nothing() {
    let plain = drawn(&format!("{BOX}<circle id='post' cx='10' cy='5' r='1'/>")).world;
    for clip in [
        "<rect width='20' height='10' fill='white'/>",
        "<path d='M0 0h20v10h-20z'/>",
        "<circle cx='7' cy='5' r='9'/>",
        // the shapes' own outline, and an outline with a corner between them
        "<path d='M2 2h9v4h-9z'/>",
        "<path d='M0 0h8l.5 3l.5 -3h11v10h-20z'/>",
        "<rect x='1' y='1' width='6' height='5'/><rect x='8' y='3' width='4' height='5'/>",
    ] {
        let found = clipped(clip, &format!("{BOX}<circle id='post' cx='10' cy='5' r='1'/>"));
        assert_eq!(found.world.obstacles, plain.obstacles, "{clip}");
        assert!(found.notes.is_empty(), "{:?}", found.notes);
    }
    // one that is not there cuts nothing either
    assert_eq!(drawn(&format!("<g clip-path='url(#none)'>{BOX}</g>")).world.obstacles, plain.obstacles[..1]);
}

#[test]
fn a_clip_path_cuts_what_is_filled() {
    let half = clipped("<rect x='4' width='20' height='10'/>", BOX).world;
    assert_eq!(extent(&half, "box"), [4.0, 6.0, 6.0, 8.0]);
    assert!(matches!(half.obstacles[0].pieces[0].1, Shape::Rectangle { .. }));
    // a hole by the clip's own rule: 4 x 2 less 2 x 1
    let frame = "M1 1h9v9h-9zM3 2.5h2v1h-2z";
    assert_eq!(area(&clipped(&format!("<path d='{frame}' clip-rule='evenodd'/>"), BOX).world, "box"), 6.0);
    assert_eq!(area(&clipped(&format!("<path d='{frame}' fill-rule='evenodd'/>"), BOX).world, "box"), 8.0);
    // two shapes of a clip path let through what lies in either, the overlap too
    let two = "<rect x='2' y='2' width='2' height='1'/><rect x='3' y='2' width='2' height='1'/>";
    assert_eq!(area(&clipped(two, BOX).world, "box"), 3.0);
    // a clip path that is cut itself, and a shape of one
    let nested = "<clipPath id='d'><rect x='3' width='9' height='9'/></clipPath>";
    let inner = drawn(&format!(
        "{nested}<clipPath id='c' clip-path='url(#d)'><rect x='1' width='4' height='9'/></clipPath>\
         <g clip-path='url(#c)'>{BOX}</g>"
    ));
    assert_eq!(extent(&inner.world, "box"), [3.0, 6.0, 5.0, 8.0]);
    let child = format!(
        "{nested}<g clip-path='url(#c)'>{BOX}</g>\
                         <clipPath id='c'><rect clip-path='url(#d)' x='1' width='4' height='9'/></clipPath>"
    );
    assert_eq!(extent(&drawn(&child).world, "box"), [3.0, 6.0, 5.0, 8.0]);
    // around and around: under the transforms of what is cut, of the clip path and of its shape
    let moved = drawn(&format!(
        "<clipPath id='c' transform='translate(1)'><rect transform='scale(2)' width='1' height='9'/></clipPath>\
         <g transform='translate(1 1)' clip-path='url(#c)'>{BOX}</g>"
    ));
    assert_eq!(extent(&moved.world, "box"), [3.0, 5.0, 4.0, 7.0]);
    // in parts of the box around what is cut
    let part = drawn(&format!(
        "<clipPath id='c' clipPathUnits='objectBoundingBox'><rect x='.5' width='.5' height='1'/></clipPath>\
         <g clip-path='url(#c)'>{BOX}</g>"
    ));
    assert_eq!(extent(&part.world, "box"), [4.0, 6.0, 6.0, 8.0]);
    let used = drawn(&format!(
        "<defs><rect id='r' width='3' height='9'/></defs><g style=\"clip-path:url('#c')\">{BOX}</g>\
         <clipPath id='c'><use href='#r' x='1'/></clipPath>"
    ));
    assert_eq!(extent(&used.world, "box"), [2.0, 6.0, 4.0, 8.0]);
}

#[test]
fn a_clip_path_cuts_walls() {
    let wall = "<path id='wall' fill='none' stroke='red' d='M1 5h18'/>";
    let cut = clipped("<rect x='2' width='3' height='10'/><rect x='8' width='4' height='10'/>", wall).world;
    assert_eq!(names(&cut), ["wall", "wall 2"]);
    assert_eq!((extent(&cut, "wall"), extent(&cut, "wall 2")), ([2.0, 5.0, 5.0, 5.0], [8.0, 5.0, 12.0, 5.0]));
    let ring = "<rect id='ring' fill='none' stroke='red' x='2' y='2' width='6' height='6'/>";
    let open = clipped("<rect width='20' height='5'/>", ring).world;
    assert!(is_hit(&open, 5.0, 8.0) && is_hit(&open, 2.0, 5.5) && !is_hit(&open, 2.0, 4.5) && !is_hit(&open, 5.0, 2.0));
}

#[test]
fn what_is_cut_away_is_gone_and_what_cannot_be_cut_is_left_out_by_name() {
    let other = "<circle id='post' cx='10' cy='5' r='1'/>";
    for (text, note) in [
        (format!("<clipPath id='c'/><g clip-path='url(#c)'>{BOX}</g>"), None),
        (format!("<clipPath id='c'><rect width='1' height='1'/></clipPath><g clip-path='url(#c)'>{BOX}</g>"), None),
        (
            format!("<clipPath id='c'><text>a</text></clipPath><g id='x' clip-path='url(#c)'>{BOX}</g>"),
            Some("g \"x\" is left out: its clip path is a text"),
        ),
        (
            format!("<g id='x' style='clip-path:url(other.svg)'>{BOX}</g>"),
            Some("g \"x\" is left out: its clip path, url(other.svg), is not understood"),
        ),
        (
            format!(
                "<clipPath id='c' clip-path='url(#c)'><rect width='9' height='9'/></clipPath>\
                     <g clip-path='url(#c)'>{BOX}</g>"
            ),
            Some("the g in line 2 is left out: its clip paths are nested too deeply"),
        ),
        (format!("<mask id='m'/><g mask='url(#m)'>{BOX}</g>"), None),
        ("<image id='photo' width='9' height='9'/>".to_owned(), Some("image \"photo\" is left out")),
        ("<foreignObject id='f'><p/></foreignObject>".to_owned(), Some("foreignObject \"f\" is left out")),
    ] {
        let found = drawn(&format!("{text}{other}"));
        assert_eq!(names(&found.world), ["post"], "{text}");
        let notes: Vec<&str> =
            found.notes.iter().map(String::as_str).filter(|note| *note != "text is left out").collect();
        assert_eq!(notes, note.into_iter().collect::<Vec<_>>(), "{text}");
    }
    // Illustrator's switch: what it cannot read comes first
    let switch = "<switch><foreignObject requiredExtensions='urn:ai' width='1' height='1'/><g>";
    assert!(drawn(&format!("{switch}{BOX}</g></switch>")).notes.is_empty());
}

#[test]
fn viewports_cut_what_they_hold() {
    let nested = import(
        "<svg xmlns='http://www.w3.org/2000/svg' width='900' height='700' viewBox='0 0 45 35' \
         preserveAspectRatio='none'><svg width='27' height='27' viewBox='0 0 6 6' x='9' y='4'>\
         <rect id='out' x='5' y='5' width='3' height='3'/></svg></svg>",
    );
    // 20 pixels a unit, 90 a unit inside: from 180 + 5 x 90 to the viewport's end at 180 + 540
    assert_eq!(extent(&nested.world, "out"), [630.0, 80.0, 720.0, 170.0]);
    let long = "<rect id='a' width='9' height='1'/>";
    let inner = |attributes: &str| format!("<svg x='2' y='3' width='4' height='2' {attributes}>{long}</svg>");
    assert_eq!(extent(&drawn(&inner("")).world, "a"), [2.0, 6.0, 6.0, 7.0]);
    assert_eq!(extent(&drawn(&inner("overflow='visible'")).world, "a"), [2.0, 6.0, 11.0, 7.0]);
    assert_eq!(extent(&drawn(&inner("style='overflow:visible'")).world, "a"), [2.0, 6.0, 11.0, 7.0]);
    // fitted: 8 x 2 into 4 x 2 is half the size, in the middle
    assert_eq!(extent(&drawn(&inner("viewBox='0 0 8 2'")).world, "a"), [2.0, 6.0, 6.0, 6.5]);
    assert_eq!(extent(&drawn(&inner("viewBox='0 0 8 2' preserveAspectRatio='xMidYMin'")).world, "a")[3], 7.0);
    assert_eq!(extent(&drawn(&inner("viewBox='0 0 8 2' preserveAspectRatio='xMaxYMid slice'")).world, "a")[3], 7.0);
    // a symbol has the size that its use says
    let symbol = format!("<symbol id='s' viewBox='0 0 4 2'>{long}</symbol>");
    let used = drawn(&format!("{symbol}<use id='u' href='#s' x='1' y='1' width='8' height='4'/>"));
    assert_eq!(extent(&used.world, "u"), [1.0, 7.0, 9.0, 9.0]);
    let shown = drawn(&format!(
        "{}<use id='u' href='#s' width='8' height='4'/>",
        symbol.replace("<symbol ", "<symbol overflow='visible' ")
    ));
    assert_eq!(extent(&shown.world, "u"), [0.0, 8.0, 18.0, 10.0]);
}

#[test]
fn many_shapes_under_large_clip_paths_take_bounded_time() {
    let corners: String = (0..3_000).map(|k| format!("{}.{:03} {} ", k / 160, k % 160, k % 2 * 9)).collect();
    let clip = format!("<clipPath id='c'><polygon points='{corners} 19 10 0 10'/></clipPath>");
    let shapes: String = (0..5_000).map(|k| format!("<circle cx='{}' cy='5' r='.2'/>", f64::from(k) / 300.0)).collect();
    let found = drawn(&format!("{clip}<g clip-path='url(#c)'>{shapes}</g><circle id='post' r='1'/>"));
    assert!(found.notes.iter().any(|note| note.contains("is left out: its clip path has too many points")));
    assert!(found.world.obstacle("post").is_some());
    assert!(
        found.world.obstacles.iter().flat_map(|o| o.placed()).all(|p| lies_in(&p.bounds(), [-1.0, 0.0, 20.0, 11.0]))
    );
}

/// Drawings whose cuts would take their reader minutes or gigabytes.
#[test]
fn cuts_of_cuts_take_bounded_time() {
    // each clip path has ten shapes, and each of them is cut by the clip path before it: 10^9 shapes in all
    let clip = |k: usize| {
        let cut = if k > 0 { format!("clip-path='url(#c{})'", k - 1) } else { String::new() };
        format!("<clipPath id='c{k}'>{}</clipPath>", format!("<rect width='19' height='9' {cut}/>").repeat(10))
    };
    let clips: String = (0..9).map(clip).collect();
    let found = drawn(&format!("{clips}<g id='g' clip-path='url(#c8)'>{BOX}</g><circle id='post' r='1'/>"));
    assert_eq!(names(&found.world), ["post"]);
    assert_eq!(found.notes, ["rect \"box\" is left out: its clip path has too many points"]);
    // a thousand viewports around thousands of shapes
    let open = "<svg width='20' height='10'>".repeat(900);
    let text = format!("{open}{}{}", "<rect width='1' height='1'/>".repeat(3_000), "</svg>".repeat(900));
    let error = motion_lab_import::svg("d.svg", &super::sheet(&text), "d", super::SvgOptions::default()).unwrap_err();
    assert!(error.to_string().contains("more than 1000000 cuts of shapes"), "{error}");
    // a wall that crosses a comb's teeth a million times
    let teeth: String = (0..1_500).map(|k| format!("{0}.{1:02} 2 {0}.{1:02} 8 ", k / 100, k % 100)).collect();
    let comb = format!("<clipPath id='c'><polygon points='{teeth} 15 9 0 9'/></clipPath>");
    let zigzag = "h15l0 .01h-15l0 .01".repeat(400);
    let wall = format!("<path id='wall' fill='none' stroke='red' clip-path='url(#c)' d='M0 3{zigzag}'/>");
    let found = drawn(&format!("{comb}{wall}<circle id='post' r='1'/>"));
    assert_eq!(names(&found.world), ["post"]);
    assert_eq!(found.notes, ["path \"wall\" is left out: its clip path has too many points"]);
}

#[test]
fn a_clip_of_many_corners_in_a_style_sheet_cuts() {
    // thirty teeth, 0.5 wide and 4 high: triangles of area 1
    let tooth = |k: u8| (15.0 - 0.5 * f64::from(k), 14.75 - 0.5 * f64::from(k));
    let teeth: String = (0..30).map(tooth).map(|(foot, tip)| format!("{foot}px 8px, {tip}px 4px, ")).collect();
    let style = format!("<style>#box{{clip-path:polygon({teeth}0px 8px)}}</style>");
    assert!(style.len() > 600);
    let found = drawn(&format!("{style}<rect id='box' width='20' height='10'/>"));
    assert!((area(&found.world, "box") - 30.0).abs() < 1e-6, "{:?} {}", found.notes, area(&found.world, "box"));
    assert_eq!(extent(&found.world, "box"), [0.0, 2.0, 15.0, 6.0]);
}

#[test]
fn what_repeats_long_attributes_is_refused() {
    let long = format!("<g id='u' transform='{}'>{BOX}</g>", "translate(0)".repeat(100_000));
    let text = super::sheet(&format!("{long}{}", "<use href='#u'/>".repeat(100)));
    let error = motion_lab_import::svg("d.svg", &text, "d", super::SvgOptions::default()).unwrap_err();
    assert!(error.to_string().contains("bytes of attributes"), "{error}");
    let rule = format!("<style>rect{{transform:{}}}</style>{BOX}", "translate(0)".repeat(1_000));
    let error = motion_lab_import::svg("d.svg", &super::sheet(&rule), "d", super::SvgOptions::default()).unwrap_err();
    assert!(error.to_string().contains("a `transform` of more than 10000 bytes in a style sheet"), "{error}");
}

#[test]
fn a_path_of_very_many_parts_is_read_in_time() {
    let columns: String = (0..20_000)
        .map(|k| format!("M{} {}h.05v.05h-.05z", f64::from(k % 199) * 0.1, f64::from(k / 199) * 0.09))
        .collect();
    let found = drawn(&format!("<path id='columns' d='{columns}'/>"));
    assert_eq!(found.world.obstacle("columns").unwrap().pieces.len(), 20_000);
}

#[test]
fn large_curves_of_many_clip_paths_take_bounded_memory() {
    // each circle is followed by 70,000 chords, under a thousand transforms
    let clip = "<clipPath id='c'><circle r='1000000'/></clipPath>";
    let cut = |k: i32| format!("<g transform='translate({}.5)' clip-path='url(#c)'><circle r='.1'/></g>", k % 19);
    let moved = |k: i32| cut(k).replace(".5)", &format!(".{k:04})"));
    let text: String = (0..1_000).map(moved).collect();
    let found = drawn(&format!("{clip}{text}<circle id='post' r='1'/>"));
    assert!(found.world.obstacle("post").is_some());
    assert!(found.notes.iter().any(|note| note.ends_with("the clip paths of the drawing are too large")));
}

#[test]
fn what_is_hidden_or_evenodd_is_so_for_clip_paths_and_shapes_by_the_same_words() {
    // whether a shape shows, by its own word and by that of the group around it
    for (around, own, shows) in [
        ("", "hidden", false),
        ("", "collapse", false),
        ("", "HIDDEN", false),
        ("", "no such word", true),
        ("hidden", "", false),
        ("hidden", "inherit", false),
        ("hidden", "unset", false),
        ("hidden", "no such word", false),
        ("collapse", "visible", true),
        ("hidden", "Visible", true),
        ("hidden", "initial", true),
    ] {
        let word = |word: &str| if word.is_empty() { String::new() } else { format!("visibility='{word}'") };
        let (around, own) = (word(around), word(own));
        let post = "<circle id='post' cx='15' cy='5' r='1'/>";
        let shape = format!("<g {around}>{}</g>", BOX.replace("/>", &format!(" {own}/>")));
        let drawn_one = drawn(&format!("{shape}{post}")).world;
        assert_eq!(drawn_one.obstacle("box").is_some(), shows, "{shape}");
        // a clip path whose shape does not show lets nothing through; of the groups around it the innermost with a word
        // counts
        let window = format!("<rect x='3' width='2' height='9' {own}/>");
        let clip = format!(
            "<g visibility='visible'><g {around}><g><clipPath id='c'>{window}</clipPath></g></g></g>\
             <g clip-path='url(#c)'>{BOX}</g>"
        );
        let cut = drawn(&format!("{clip}{post}")).world;
        assert_eq!(cut.obstacle("box").is_some(), shows, "{clip}");
        // what is used inherits from the `use`, not from the elements around it
        let used = format!("<g visibility='hidden'><rect id='w' x='3' width='2' height='9' {own}/></g>");
        let clip =
            format!("{used}<clipPath id='c'><use href='#w' {around}/></clipPath><g clip-path='url(#c)'>{BOX}</g>");
        assert_eq!(drawn(&format!("{clip}{post}")).world.obstacle("box").is_some(), shows, "{clip}");
        let twice = format!("{used}<g {around}><use id='u' href='#w'/></g>{post}");
        assert_eq!(drawn(&twice).world.obstacle("u").is_some(), shows, "{twice}");
    }
    // a frame of 9 x 9 around a hole of 2 x 1 in the box of 4 x 2
    for (around, own, open) in [
        ("", "evenodd", true),
        ("", "EvenOdd", true),
        ("", "no such word", false),
        ("evenodd", "", true),
        ("evenodd", "inherit", true),
        ("evenodd", "no such word", true),
        ("evenodd", "nonzero", false),
        ("evenodd", "initial", false),
    ] {
        let rule = |kind: &str, word: &str| {
            if word.is_empty() { String::new() } else { format!("{kind}-rule='{word}'") }
        };
        let frame = |kind: &str| format!("<path id='f' d='M1 1h9v9h-9zM3 2.5h2v1h-2z' {}/>", rule(kind, own));
        let shape = format!("<g {}>{}</g>", rule("fill", around), frame("fill"));
        assert_eq!(area(&drawn(&shape).world, "f"), if open { 79.0 } else { 81.0 }, "{shape}");
        let clip = |inner: &str| format!("<clipPath id='c' {}>{inner}</clipPath>", rule("clip", around));
        let target = frame("clip");
        for clip in [clip(&target), format!("<defs>{target}</defs>{}", clip("<use href='#f'/>"))] {
            let cut = drawn(&format!("{clip}<g clip-path='url(#c)'>{BOX}</g>")).world;
            assert_eq!(area(&cut, "box"), if open { 6.0 } else { 8.0 }, "{clip}");
        }
    }
}

#[test]
fn clip_paths_of_what_does_not_show_are_counted_like_others() {
    let post = "<circle id='post' r='1'/>";
    let cuts: String =
        (0..1_000).map(|k| format!("<g transform='translate(.{k:04})' clip-path='url(#c)'>{BOX}</g>")).collect();
    let hidden = "<rect display='none'/><g/><circle r='1' visibility='hidden'/>".repeat(100);
    let deep = format!("{}<clipPath id='c'/>{}", "<g>".repeat(900), "</g>".repeat(900));
    for clip in [format!("<clipPath id='c'>{hidden}</clipPath>"), deep] {
        let found = drawn(&format!("{clip}{cuts}{post}"));
        assert_eq!(names(&found.world), ["post"]);
        assert!(found.notes.iter().any(|note| note.ends_with("the clip paths of the drawing are too large")), "{clip}");
    }
}
