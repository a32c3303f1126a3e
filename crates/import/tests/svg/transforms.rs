//! Transforms of attributes and of style sheets.

use super::{drawn, extent};

/// The box of a rectangle from (4, 4) to (6, 5), transformed.
fn moved(attributes: &str) -> [f64; 4] {
    let world = drawn(&format!(
        "<style>.m{{transform:translate(4px,2px)}}</style>\
                                <rect id='a' x='4' y='4' width='2' height='1' {attributes}/>"
    ));
    assert!(world.notes.is_empty(), "{attributes}: {:?}", world.notes);
    extent(&world.world, "a").map(|x| (x * 1e6).round() / 1e6)
}

#[test]
fn style_sheets_transform_with_units() {
    for (style, expected) in [
        ("translate(5px,3px)", [9.0, 2.0, 11.0, 3.0]),
        ("translate(5px, 3px)", [9.0, 2.0, 11.0, 3.0]),
        ("translate(5px)", [9.0, 5.0, 11.0, 6.0]),
        ("translateX(5px) translateY(1px)", [9.0, 4.0, 11.0, 5.0]),
        ("translate(10%, 20%)", [6.0, 3.0, 8.0, 4.0]),
        ("translate3d(5px, 3px, 0)", [9.0, 2.0, 11.0, 3.0]),
        ("scale(2)", [8.0, 0.0, 12.0, 2.0]),
        ("scale(200%, 1)", [8.0, 5.0, 12.0, 6.0]),
        ("scaleX(2)", [8.0, 5.0, 12.0, 6.0]),
        ("scaleY(.5)", [4.0, 7.5, 6.0, 8.0]),
        ("matrix(1, 0, 0, 1, 5, 3)", [9.0, 2.0, 11.0, 3.0]),
        ("translate(10px) rotate(90deg)", [5.0, 4.0, 6.0, 6.0]),
        ("translate(10px) rotate(.25turn)", [5.0, 4.0, 6.0, 6.0]),
        ("translate(10px) rotate(100grad)", [5.0, 4.0, 6.0, 6.0]),
        ("translate(10px) rotate(1.5707963267948966rad)", [5.0, 4.0, 6.0, 6.0]),
        ("skewX(45deg)", [8.0, 5.0, 11.0, 6.0]),
        ("translate(96px) translate(-1in)", [4.0, 5.0, 6.0, 6.0]),
        ("none", [4.0, 5.0, 6.0, 6.0]),
    ] {
        assert_eq!(moved(&format!("style='transform:{style}'")), expected, "{style}");
    }
    assert_eq!(moved("class='m'"), [8.0, 3.0, 10.0, 4.0]);
    assert_eq!(moved("class='m' transform='translate(9)'"), [8.0, 3.0, 10.0, 4.0], "a style counts more");
    assert_eq!(moved("transform='translate(5 3)'"), [9.0, 2.0, 11.0, 3.0]);
    assert_eq!(moved("transform='translate(5-3)scale(1,1),translate(0 6)'"), [9.0, 2.0, 11.0, 3.0]);
    assert_eq!(moved("transform='translate(5e0-3e0)'"), [9.0, 8.0, 11.0, 9.0]);
}

#[test]
fn transforms_are_about_their_origin() {
    let turn = "transform:rotate(90deg);";
    for (style, expected) in [
        ("transform-origin:4px 4px", [3.0, 4.0, 4.0, 6.0]),
        ("transform-origin:4px 4px 0", [3.0, 4.0, 4.0, 6.0]),
        ("transform-origin:20% 40%", [3.0, 4.0, 4.0, 6.0]),
        ("transform-box:fill-box;transform-origin:0 0", [3.0, 4.0, 4.0, 6.0]),
        ("transform-box:fill-box;transform-origin:left top", [3.0, 4.0, 4.0, 6.0]),
        ("transform-box:fill-box;transform-origin:center", [4.5, 4.5, 5.5, 6.5]),
        ("transform-box:fill-box;transform-origin:50% 50%", [4.5, 4.5, 5.5, 6.5]),
        ("transform-origin:5px 4.5px", [4.5, 4.5, 5.5, 6.5]),
    ] {
        assert_eq!(moved(&format!("style='{turn}{style}'")), expected, "{style}");
    }
    assert_eq!(moved("transform='rotate(90)' transform-origin='5 4.5'"), [4.5, 4.5, 5.5, 6.5]);
    assert_eq!(moved("transform='rotate(90 4 4)'"), [3.0, 4.0, 4.0, 6.0]);
}

#[test]
fn a_transform_that_is_not_understood_is_said() {
    for transform in ["rotate(90deg", "rotate(9px)", "translate(1vw)", "matrix(1 2 3)", "rotate3d(1,1,1,45deg)", "x"] {
        let found = drawn(&format!("<rect id='a' x='4' y='4' width='2' height='1' style='transform:{transform}'/>"));
        assert_eq!(extent(&found.world, "a"), [4.0, 5.0, 6.0, 6.0]);
        assert_eq!(found.notes, ["the transform of rect \"a\" is not understood or applied"], "{transform}");
    }
}
