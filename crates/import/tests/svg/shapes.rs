//! Clip paths that are shapes of style sheets, and transforms about the box of what a group holds.

use super::{area, drawn, extent, names};
use crate::is_hit;

const BOX: &str = "<rect id='box' x='2' y='2' width='4' height='2'/>";
const POST: &str = "<circle id='post' cx='15' cy='5' r='1'/>";

/// The area that a clip path leaves of a box from (2, 2) to (6, 4), 0 for none. No note may say anything.
#[track_caller]
fn left(clip: &str) -> f64 {
    let found = drawn(&format!("<g style=\"clip-path:{clip}\">{BOX}</g>{POST}"));
    assert!(found.notes.is_empty(), "{clip}: {:?}", found.notes);
    if found.world.obstacle("box").is_some() { area(&found.world, "box") } else { 0.0 }
}

#[test]
fn shapes_of_style_sheets_cut_in_the_box_around_the_element() {
    for (clip, expected) in [
        ("inset(0)", 8.0),
        ("inset(0 25%)", 4.0),
        ("inset(.5px 1px 0 0)", 3.0 * 1.5),
        ("inset(0 1px 1px)", 2.0),
        ("inset(1px 3px)", 0.0),
        ("rect(0 2px 1px 1px)", 1.0),
        ("rect(auto auto auto 1px)", 6.0),
        ("xywh(1px 0 50% 1px)", 2.0),
        ("polygon(0 0, 100% 0, 0 100%)", 4.0),
        ("polygon(evenodd, 0 0, 4px 0, 4px 2px, 0 2px, 0 0, 1px 0, 1px 1px, 0 1px, 0 0)", 7.0),
        ("path('M0 0h2v1h-2z')", 2.0),
        ("path(evenodd, 'M0 0h4v2h-4zM1 0h2v1h-2z')", 6.0),
        // by the origin of the drawing, not the box's
        ("polygon(0 0, 3px 0, 3px 10px, 0 10px) view-box", 2.0),
        ("view-box inset(0 80% 0 0)", 4.0),
        ("fill-box", 8.0),
        // a circle around the box
        ("circle(9px)", 8.0),
    ] {
        let found = left(clip);
        assert!((found - expected).abs() < 1e-9, "{clip}: {found}");
    }
    // half of width and height, the ellipse's area is pi 2 x 1; a circle of 1 m; a quarter of an ellipse of 4 x 2
    for (clip, expected) in [
        ("ellipse()", std::f64::consts::TAU),
        ("circle()", std::f64::consts::PI),
        ("circle(closest-side at 3px 1px)", std::f64::consts::PI),
        // of radius 2 in a strip of 2: the triangles 2 sqrt(3) and two sectors of a sixth
        ("circle(farthest-side)", 12.0_f64.sqrt() + 4.0 * std::f64::consts::PI / 3.0),
        // half an ellipse of 3 x 1, and of its other half what lies within 1: sqrt(8) / 3 + 3 asin(1 / 3)
        ("ellipse(farthest-side closest-side at 1px 1px)", 6.674_709),
        ("ellipse(4px 2px at left top)", std::f64::consts::TAU),
        // sqrt((16 + 4) / 2) of 10 %
        ("circle(10%)", std::f64::consts::PI * 0.1),
        // four corners of 1 m less than a square's: 8 - (4 - pi)
        ("inset(0 round 1px)", 4.0 + std::f64::consts::PI),
    ] {
        let found = left(clip);
        assert!((found - expected).abs() < 0.02 && found < expected, "{clip}: {found}, {expected}");
    }
    // as an attribute, and of a wall by a box that is no stroke's
    let wall = "<path id='wall' fill='none' stroke='red' d='M1 5h18M1 6h18'/>";
    let cut = drawn(&format!("<g clip-path='inset(0 50% 0 0) fill-box'>{wall}</g>")).world;
    assert_eq!(extent(&cut, "wall"), [1.0, 5.0, 10.0, 5.0]);
}

#[test]
fn shapes_that_are_not_understood_leave_out_their_elements_by_name() {
    for clip in [
        "shape(from 0 0, hline to 3px)",
        "inset(1)",
        "inset(0 0 0 0 0)",
        "inset(0 round 10%)",
        "inset(calc(1px + 2%))",
        "circle(3px at right 1px top 2px)",
        "circle(-1px)",
        "polygon(0 0, 1px)",
        "polygon(0 0, 5 5, 0 5)",
        "path('M0 0h2v1h-2z oops')",
        "path(M0 0h2v1h-2z)",
        "circle(3px) fill-box fill-box",
        "circle(3px) no-box",
        "url(other.svg#c)",
    ] {
        let found = drawn(&format!("<g id='g' style=\"clip-path:{clip}\">{BOX}</g>{POST}"));
        assert_eq!(names(&found.world), ["post"], "{clip}");
        let note = format!("g \"g\" is left out: its clip path, {clip}, is not understood");
        assert_eq!(found.notes, [note]);
    }
    let stroked = drawn(&format!("<g id='g' stroke='red' style='clip-path:inset(1px)'>{BOX}</g>{POST}"));
    assert_eq!(stroked.notes, ["g \"g\" is left out: its clip path is measured by the box around its stroke"]);
    let cut_clip = format!(
        "<clipPath id='c'><rect width='9' height='9' style='clip-path:circle(1px)'/></clipPath>\
         <g id='g' clip-path='url(#c)'>{BOX}</g>{POST}"
    );
    let note = "g \"g\" is left out: its clip path is cut by a shape of a style sheet";
    assert_eq!(drawn(&cut_clip).notes, [note]);
}

#[test]
fn a_group_turns_about_the_box_of_what_it_holds_painted_or_not() {
    let turned = |style: &str, inside: &str| {
        drawn(&format!("<g style='transform:rotate(90deg);transform-box:fill-box;{style}'>{inside}</g>{POST}")).world
    };
    // 4 x 2 about (4, 3) of the drawing, which is (4, 7) of the world
    let middle = "transform-origin:center";
    assert_eq!(extent(&turned(middle, BOX), "box"), [3.0, 5.0, 5.0, 9.0]);
    // about its upper left corner, which is the origin where nothing says another
    assert_eq!(extent(&turned("transform-origin:0 0", BOX), "box"), [0.0, 4.0, 2.0, 8.0]);
    assert_eq!(extent(&turned("", BOX), "box"), [0.0, 4.0, 2.0, 8.0]);
    // what is not painted, repeated, moved or nested counts: 0 to 8 each way, about (4, 4)
    for more in [
        "<rect width='8' height='8' fill='none'/>",
        "<g visibility='hidden'><rect width='8' height='8'/></g>",
        "<g transform='translate(8 8)'><rect x='-8' y='-8' width='8' height='8' opacity='0'/></g>",
        "<defs><rect id='r' width='8' height='8'/></defs><use href='#r' opacity='0'/>",
        "<g style='transform:rotate(90deg);transform-box:fill-box;transform-origin:center'>\
         <rect width='8' height='8' fill='none'/></g>",
    ] {
        let world = turned(middle, &format!("{BOX}{more}"));
        assert_eq!(extent(&world, "box"), [4.0, 4.0, 6.0, 8.0], "{more}");
    }
    // what is not drawn at all does not
    let hidden = format!("{BOX}<rect width='8' height='8' display='none'/>");
    assert_eq!(extent(&turned(middle, &hidden), "box"), [3.0, 5.0, 5.0, 9.0]);
    // a box that cannot be found turns nothing, and a note says so
    let odd = drawn(&format!(
        "<g id='g' style='transform:rotate(90deg);transform-box:fill-box'>{BOX}\
         <g id='odd' style='transform:spin(1deg)'><rect width='8' height='8' fill='none'/></g></g>"
    ));
    assert_eq!(extent(&odd.world, "box"), [2.0, 6.0, 6.0, 8.0]);
    assert!(odd.notes.contains(&"the transform of g \"g\" is not understood or applied".into()), "{:?}", odd.notes);
    let stroke = drawn(&format!("<g style='transform:rotate(90deg);transform-box:stroke-box'>{BOX}</g>"));
    assert_eq!(stroke.notes, ["the transform of the g in line 2 is not understood or applied"]);
}

#[test]
fn groups_about_boxes_of_groups_take_bounded_time() {
    let turn = "<g style='transform:rotate(90deg);transform-box:fill-box;transform-origin:center'>";
    // 20 deep they turn, five whole turns
    let deep = |n: usize| format!("{}{BOX}{}{POST}", turn.repeat(n), "</g>".repeat(n));
    let found = drawn(&deep(20));
    assert!(found.notes.is_empty() && is_hit(&found.world, 4.0, 7.0), "{:?}", found.notes);
    assert_eq!(extent(&found.world, "box"), [2.0, 6.0, 6.0, 8.0]);
    let found = drawn(&deep(900));
    assert!(found.notes.iter().any(|note| note.contains("is not understood or applied")), "{:?}", found.notes);
    let wide = format!("{turn}{}</g>", format!("{turn}{}</g>", "<path d='M0 0h1v1'/>".repeat(40)).repeat(800));
    assert!(drawn(&format!("{wide}{POST}")).world.obstacle("post").is_some());
}
