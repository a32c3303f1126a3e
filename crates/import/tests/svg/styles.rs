//! Style sheets whose few selectors take long to match. They are refused by what matching them takes.

use super::sheet;
use motion_lab_import::{SvgOptions, svg};

/// What a drawing with a style sheet, with this inside and a post becomes: its number of obstacles, or why it is
/// refused.
fn styled(rules: &str, inside: &str) -> Result<usize, String> {
    let text = sheet(&format!("<style>{rules}</style>{inside}<circle id='post' r='1'/>"));
    let read = svg("d.svg", &text, "d", SvgOptions::default());
    read.map(|read| read.world.obstacles.len()).map_err(|error| error.to_string())
}

fn refused(selectors: usize, elements: usize) -> Result<usize, String> {
    Err(format!("d.svg: not supported: style sheets of {selectors} selectors for {elements} elements"))
}

/// Elements in `groups` groups, one in the other.
fn nested(groups: usize, inside: &str) -> String {
    format!("{}{inside}{}", "<g>".repeat(groups), "</g>".repeat(groups))
}

#[test]
fn selectors_that_name_ancestors_are_weighed_by_the_depth_of_the_drawing() {
    // 21 bytes for going to an element and asking whether it is a `g`, and each of the 300 groups around an element
    // asks those around itself: 21 * 301 * 302 / 2 = 954,471 for each of the elements, and 94,500,000 for all groups
    let rule = "x g g{fill:red}";
    assert_eq!(styled(rule, &nested(300, &"<g/>".repeat(225))), refused(1, 300 + 225 + 3));
    // a tenth of the depth takes a hundredth of the time, and one group a fraction of it
    assert_eq!(styled(rule, &nested(30, &"<g/>".repeat(2_250))), Ok(1));
    assert_eq!(styled(rule, &nested(1, &"<g/>".repeat(40_000))), Ok(1));
    // children and neighbours ask one element each
    assert_eq!(styled("x > g > g, x + g + g{fill:red}", &nested(300, &"<g/>".repeat(9_600))), Ok(1));
}

#[test]
fn selectors_for_long_classes_are_weighed_by_their_length() {
    // 500,000 words of a class, asked for by each selector
    let words = format!("<g class='{}'/>", "x ".repeat(500_000));
    assert_eq!(styled(&".a{fill:red}".repeat(80), &words), refused(80, 4));
    assert_eq!(styled(&".a{fill:red}".repeat(8), &words), Ok(1));
}

#[test]
fn selectors_of_ten_parts_are_read_and_weighed_like_others() {
    let rule = |parts: usize| format!("x{} {{fill:none}}", " g".repeat(parts - 1));
    // each part may be any of the groups around the one before it: ways beyond all counting
    assert_eq!(styled(&rule(10), &nested(300, &"<g/>".repeat(225))), refused(1, 300 + 225 + 3));
    let room = "<g class='room'><g><g><g><rect id='r' width='2' height='2'/></g></g></g></g>";
    assert_eq!(styled("svg > .room > g > g g #r{fill:none}", room), Ok(1));
    assert_eq!(styled("svg > .room > g > g > #r{fill:none}", room), Ok(2), "no such element");
}
