//! Masks that let through all or nothing cut as clip paths do; others leave out what they hide, by name.

use super::{area, drawn, extent, names};
use motion_lab_import::Imported;

const BOX: &str = "<rect id='box' x='2' y='2' width='4' height='2'/>";
const POST: &str = "<circle id='post' cx='15' cy='5' r='1'/>";

/// What a box of 4 x 2 becomes under a mask of this content, with these attributes of its own.
fn masked(attributes: &str, content: &str) -> Imported {
    drawn(&format!("<mask id='m' {attributes}>{content}</mask><g id='g' mask='url(#m)'>{BOX}</g>{POST}"))
}

/// The area that is left of the box, 0 for none. No note may say anything.
#[track_caller]
fn left(attributes: &str, content: &str) -> f64 {
    let found = masked(attributes, content);
    assert!(found.notes.is_empty(), "{content}: {:?}", found.notes);
    if found.world.obstacle("box").is_some() { area(&found.world, "box") } else { 0.0 }
}

#[test]
fn a_mask_that_hides_nothing_changes_nothing() {
    let plain = drawn(&format!("{BOX}{POST}")).world;
    let user = "maskUnits='userSpaceOnUse' x='0' y='0' width='20' height='10'";
    for (attributes, content) in [
        ("", "<rect width='20' height='10' fill='white'/>"),
        ("", "<g fill='#FFFFFF'><path d='M0 0h20v10h-20z'/></g>"),
        ("fill='#fff'", "<use href='#r'/><defs><rect id='r' width='20' height='10'/></defs>"),
        ("style='mask-type:alpha'", "<rect width='20' height='10' fill='teal'/>"),
        ("style='mask-type:alpha' maskContentUnits='objectBoundingBox'", "<rect width='1' height='1'/>"),
        (user, "<rect width='20' height='10' fill='rgb(100%, 100%, 100%)'/><circle cx='18' cy='8' r='1'/>"),
        ("x='0' y='0' width='1' height='1'", "<rect width='20' height='10' fill='white'/>"),
        ("x='0%' y='0%' width='100%' height='100%'", "<rect width='20' height='10' fill='white' stroke='none'/>"),
    ] {
        let found = masked(attributes, content);
        assert_eq!(found.world.obstacles, plain.obstacles, "{attributes} {content}");
        assert!(found.notes.is_empty(), "{:?}", found.notes);
    }
    assert_eq!(
        drawn(&format!("<g mask='none'><g mask='url(#none)'>{BOX}</g></g>{POST}")).world.obstacles,
        plain.obstacles
    );
}

#[test]
fn a_mask_of_black_and_white_cuts_like_a_clip_path() {
    let white = "<rect width='20' height='10' fill='white'/>";
    // white over the left half; nothing at all; what is not painted, or black, hides as what is not there
    assert_eq!(left("", "<rect width='4' height='10' fill='white'/>"), 4.0);
    assert_eq!(left("", ""), 0.0);
    assert_eq!(left("", "<rect width='20' height='10'/>"), 0.0);
    assert_eq!(left("", "<rect width='20' height='10' fill='none'/>"), 0.0);
    assert_eq!(left("", "<rect width='20' height='10' fill='white' fill-opacity='0'/>"), 0.0);
    assert_eq!(left("", "<g opacity='0'><rect width='20' height='10' fill='white'/></g>"), 0.0);
    // black hides what was white before it, and white shows it again: 8 less 2 x 1, plus 1 x 1
    assert_eq!(left("", &format!("{white}<rect x='3' y='2' width='2' height='1'/>")), 6.0);
    let again =
        "<rect x='3' y='2' width='2' height='1' fill='black'/><rect x='3' y='2' width='1' height='1' fill='#fff'/>";
    assert_eq!(left("", &format!("{white}{again}")), 7.0);
    assert_eq!(left("", &format!("{white}{again}<rect x='2' y='3' width='4' height='1'/>")), 3.0);
    // by its own rule: the hole of a frame, 2 x 1, stays
    let frame = "M1 1h9v9h-9zM3 2.5h2v1h-2z";
    assert_eq!(left("", &format!("{white}<path d='{frame}' fill-rule='evenodd'/>")), 2.0);
    assert_eq!(left("", &format!("<path d='{frame}' fill='white' fill-rule='evenodd'/>")), 6.0);
    // the colour of the element, and that of an element around the mask
    assert_eq!(left("color='white'", "<rect width='4' height='10' fill='currentColor'/>"), 4.0);
    let around = drawn(&format!(
        "<g fill='white'><mask id='m'><rect width='4' height='10'/></mask></g><g mask='url(#m)'>{BOX}</g>{POST}"
    ));
    assert_eq!(area(&around.world, "box"), 4.0);
    // of alpha: black shows too, and does not hide
    assert_eq!(left("mask-type='alpha'", "<rect width='4' height='10'/><rect x='3' width='2' height='10'/>"), 6.0);
    // under the transforms of what is masked and of the mask's own
    let moved = drawn(&format!(
        "<mask id='m'><g transform='scale(2)'><rect width='1' height='9' fill='white'/></g></mask>\
         <g transform='translate(-1 0)' mask='url(#m)'>{BOX}<rect id='two' width='4' height='2'/></g>{POST}"
    ));
    assert_eq!((names(&moved.world), extent(&moved.world, "two")), (vec!["two", "post"], [-1.0, 8.0, 1.0, 10.0]));
}

#[test]
fn the_rectangle_of_a_mask_cuts_in_its_own_units() {
    let white = "<rect width='20' height='10' fill='white'/>";
    assert_eq!(left("maskUnits='userSpaceOnUse' x='3' y='0' width='10%' height='10'", white), 4.0);
    // in parts of the box around what is masked, painted or not: 2 to 6 and 2 to 4, and with the frame 0 to 8
    assert_eq!(left("x='.5' y='0' width='1' height='1'", white), 4.0);
    let frame = "<rect width='8' height='8' fill='none'/>";
    let found = drawn(&format!(
        "<mask id='m' x='.5' y='0' width='1' height='1'>{white}</mask><g mask='url(#m)'>{BOX}{frame}</g>{POST}"
    ));
    assert_eq!(extent(&found.world, "box"), [4.0, 6.0, 6.0, 8.0]);
    assert_eq!(left("x='0' y='0' width='0' height='1'", white), 0.0);
}

#[test]
fn a_mask_cuts_walls_and_with_clip_paths() {
    let wall = "<path id='wall' fill='none' stroke='red' d='M1 5h18'/>";
    let mask = "<mask id='m' maskUnits='userSpaceOnUse' x='0' y='0' width='20' height='10'>\
                <rect width='20' height='10' fill='white'/><rect x='5' width='3' height='10'/></mask>";
    let cut = drawn(&format!("{mask}<g mask='url(#m)'>{wall}</g>")).world;
    assert_eq!(names(&cut), ["wall", "wall 2"]);
    assert_eq!((extent(&cut, "wall"), extent(&cut, "wall 2")), ([1.0, 5.0, 5.0, 5.0], [8.0, 5.0, 19.0, 5.0]));
    let both = format!(
        "<clipPath id='c'><rect x='3' width='10' height='3'/></clipPath>{mask}\
         <g mask='url(#m)' clip-path='url(#c)'>{BOX}</g>"
    );
    assert_eq!(extent(&drawn(&both).world, "box"), [3.0, 7.0, 5.0, 8.0]);
}

#[test]
fn a_mask_that_cannot_be_read_leaves_out_what_it_hides_by_name() {
    let white = "<rect width='20' height='10' fill='white'";
    for (content, why) in [
        (format!("{white} opacity='.5'/>"), "its mask is opaque in part"),
        (format!("{white} fill-opacity='.5'/>"), "its mask lets through a part of the paint"),
        (format!("{white} style='fill:gray'/>"), "its mask lets through a part of the paint"),
        (
            format!("{white} style='fill:url(#l)'/><linearGradient id='l'/>"),
            "its mask lets through a part of the paint",
        ),
        (format!("{white} stroke='black'/>"), "its mask has lines"),
        (format!("{white} filter='url(#f)'/>"), "its mask has a filter itself"),
        (format!("{white} mask='url(#m)'/>"), "its mask has a mask itself"),
        (format!("<g clip-path='url(#c)'>{white}/></g>"), "its mask has a clip path itself"),
        ("<text fill='white'>a</text>".into(), "its mask holds a text"),
        ("<image width='20' height='10'/>".into(), "its mask holds an image"),
        ("<g id='x' fill='white'><use href='#x'/></g>".into(), "its mask is nested too deeply"),
        (format!("{white} transform='spin(3)'/>"), "a transform in its mask is not understood"),
        (
            format!("{white}/><rect width='20' height='10'/>").repeat(21),
            "its mask hides more than 20 times what it has shown",
        ),
    ] {
        let found = masked("", &content);
        assert_eq!(names(&found.world), ["post"], "{content}");
        let note = format!("g \"g\" is left out: {why}");
        assert!(found.notes.contains(&note), "{content}: {:?}", found.notes);
    }
    for (mask, why) in [
        ("url(pattern.png)", "its mask is not of the drawing"),
        ("linear-gradient(black, white)", "its mask is not of the drawing"),
        ("url(#m) no-repeat", "its mask is more than one element"),
        ("url(#m), url(#m)", "its mask is more than one element"),
        ("url(#post)", "its mask is no mask element"),
    ] {
        for property in ["mask", "mask-image"] {
            let all = format!("<mask id='m'>{white}/></mask><g id='g' style='{property}:{mask}'>{BOX}</g>{POST}");
            let found = drawn(&all);
            assert_eq!(names(&found.world), ["post"], "{mask}");
            assert_eq!(found.notes, [format!("g \"g\" is left out: {why}")]);
        }
    }
}

#[test]
fn masks_of_very_much_take_bounded_time() {
    // each group repeats itself twice: 2^50 shapes without a bound
    let twice =
        "<mask id='m'><g id='x'><rect width='20' height='10' fill='white'/><use href='#x'/><use href='#x'/></g></mask>";
    let cuts: String =
        (0..1_000).map(|k| format!("<g transform='translate(.{k:04})' mask='url(#m)'>{BOX}</g>")).collect();
    let large = format!("<mask id='m'>{}</mask>", "<rect width='20' height='10' fill='white'/>".repeat(300));
    let unseen = format!("<mask id='m'>{}</mask>", "<rect display='none'/><circle r='1' fill='none'/>".repeat(150));
    // 2^24 times what is not shown
    let doubled: String =
        (1..24).map(|k| format!("<g id='u{k}'>{}</g>", format!("<use href='#u{}'/>", k - 1).repeat(2))).collect();
    let doubled =
        format!("<mask id='m'><g display='none'><g id='u0' display='none'/>{doubled}</g><use href='#u23'/></mask>");
    for mask in [twice.to_owned(), large, unseen, doubled] {
        let found = drawn(&format!("{mask}{cuts}{POST}"));
        assert!(found.world.obstacle("post").is_some());
        let why = ["its mask is nested too deeply", "the clip paths of the drawing are too large"];
        assert!(found.notes.iter().any(|note| why.iter().any(|why| note.ends_with(why))), "{:?}", found.notes);
    }
}
