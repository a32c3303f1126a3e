//! Paint that does not show is nothing.

use super::{drawn, extent, names};
use motion_lab_core::worlds::ObstacleKind;

const RECT: &str = "x='2' y='2' width='6' height='4'";

#[test]
fn a_shape_filled_invisibly_is_what_its_stroke_is() {
    for style in [
        "style='fill:#ffffff;fill-opacity:0;stroke:#000000;stroke-width:0.1'",
        "style='fill:#fff;fill-opacity:0%;stroke:black'",
        "fill='transparent' stroke='black'",
        "fill='rgba(0,0,0,0)' stroke='black'",
        "fill='rgb(0 0 0 / 0%)' stroke='black'",
        "fill='#ffffff00' stroke='black'",
        "fill='#fff0' stroke='black'",
        "fill='hsla(0, 0%, 0%, 0)' stroke='black'",
        "fill='currentColor' color='transparent' stroke='black'",
        "fill='TRANSPARENT' stroke='black'",
        "fill='rgba( 10 , 20 , 30 , 0.0 )' stroke='black'",
        "fill='rgba(0,0,0,0%)' stroke='black'",
        "fill='rgb(0 0 0/0)' stroke='black'",
        "fill='hsl(120deg 50% 50% / 0)' stroke='black'",
        "fill='color(srgb 1 0 0 / 0)' stroke='black'",
        "fill='url(#nowhere)' stroke='black'",
        "fill='url(#nowhere) none' stroke='black'",
        "fill='url(#clear)' stroke='url(#dark)'",
    ] {
        let gradients = "<linearGradient id='clear'><stop stop-opacity='0'/><stop style='stop-color:#0000'/>\
                         </linearGradient><radialGradient id='dark'><stop stop-color='red'/></radialGradient>";
        let world = drawn(&format!("{gradients}<rect id='room' {RECT} {style}/>")).world;
        let room = world.obstacle("room").unwrap();
        assert_eq!((room.kind, room.pieces.len()), (ObstacleKind::Wall, 4), "{style}");
        assert_eq!(extent(&world, "room"), [2.0, 4.0, 8.0, 8.0]);
    }
}

#[test]
fn what_shows_nowhere_is_nothing_and_a_note_says_so() {
    let ghost = |attributes: &str| format!("<rect {RECT} {attributes}/>");
    for text in [
        ghost("fill='none' stroke='black' stroke-opacity='0'"),
        ghost("fill='none' stroke='#0000'"),
        ghost("fill='none' stroke='black' stroke-width='0'"),
        ghost("style='opacity:0'"),
        ghost("opacity='0%'"),
        ghost("visibility='collapse'"),
        format!("<g style='opacity:0'>{}</g>", ghost("")),
        format!("<g fill-opacity='0'>{}</g>", ghost("")),
        format!("<defs>{}</defs><use href='#u' opacity='0'/>", ghost("id='u'")),
        format!("<style>.ghost{{opacity:0}}</style><g class='ghost'><g>{}</g></g>", ghost("")),
        format!("<svg opacity='0'>{}</svg>", ghost("")),
    ] {
        let drawn = drawn(&format!("{text}<rect id='t' x='10' y='1' width='1' height='1'/>"));
        assert_eq!(names(&drawn.world), ["t"], "{text}");
        assert_eq!(drawn.notes, ["what is drawn invisibly is left out"], "{text}");
    }
}

#[test]
fn what_shows_a_little_is_there() {
    for style in [
        "fill-opacity='0.01'",
        "opacity='0.1'",
        "fill='#0001'",
        "fill='#00000001'",
        "fill='#000'",
        "fill='rgb(0,0,0)'",
        "fill='rgba(0,0,0,.1)'",
        "fill='hsl(0 0% 0%)'",
        "fill='url(#p)'",
        "fill='url(#nowhere) red'",
    ] {
        let pattern = "<pattern id='p'><rect width='1' height='1'/></pattern>";
        let world = drawn(&format!("{pattern}<rect id='room' {RECT} {style}/>")).world;
        assert_eq!(world.obstacle("room").unwrap().kind, ObstacleKind::Solid, "{style}");
    }
    // a child shows itself again in a hidden group, but not in one without opacity
    let world = drawn(&format!("<g visibility='hidden'><rect id='room' {RECT} visibility='visible'/></g>")).world;
    assert_eq!(names(&world), ["room"]);
}

#[test]
fn of_all_that_is_said_of_a_paint_the_strongest_counts() {
    let rules = "rect{fill:none} .a{fill:red} #one{fill:none!important}";
    let world = drawn(&format!(
        "<style>{rules}</style><g stroke='black'><rect id='one' class='a' {RECT} style='fill:red'/>\
         <rect id='two' class='a' {RECT}/><rect id='three' fill='red' {RECT}/>\
         <rect id='four' {RECT} style='fill:blue'/></g>"
    ))
    .world;
    let kinds: Vec<_> = world.obstacles.iter().map(|o| (o.name.as_str(), o.kind)).collect();
    use ObstacleKind::{Solid, Wall};
    assert_eq!(kinds, [("one", Wall), ("three", Wall), ("two", Solid), ("four", Solid)]);
}

#[test]
fn the_paper_goes_and_its_stroke_stays() {
    let room = "width='20' height='10' fill='white'";
    let framed = drawn(&format!("<rect id='room' {room} stroke='black'/><circle r='1' cx='5' cy='5'/>"));
    assert_eq!(names(&framed.world), ["room", "disc 1"]);
    assert_eq!(framed.world.obstacle("room").unwrap().kind, ObstacleKind::Wall);
    assert_eq!(extent(&framed.world, "room"), [0.0, 0.0, 20.0, 10.0]);
    assert!(framed.notes[0].contains("taken for its paper"), "{:?}", framed.notes);
    for plain in ["", "stroke='none'", "stroke='black' stroke-opacity='0'", "stroke='black' stroke-width='0'"] {
        let drawn = drawn(&format!("<rect id='room' {room} {plain}/><circle r='1' cx='5' cy='5'/>"));
        assert_eq!(names(&drawn.world), ["disc 1"], "{plain}");
    }
}

#[test]
fn the_current_colour_is_that_of_the_element_that_inherits_the_word() {
    for (around, own, shows) in [
        ("fill='currentColor' color='red'", "color='transparent'", false),
        ("fill='currentColor' color='transparent'", "color='red'", true),
        ("fill='currentcolor' color='#0000'", "", false),
        ("fill='currentColor' color='#0000'", "color='currentColor'", false),
        ("fill='currentColor' color='red'", "color='currentColor'", true),
        ("fill='url(#nowhere) currentColor' color='red'", "color='transparent'", false),
        ("fill='url(#nowhere) currentColor'", "", true),
        ("fill='url(#there) currentColor' color='transparent'", "", true),
        ("fill='currentColor' color='transparent'", "fill='initial'", true),
        ("fill='none' color='red'", "fill='inherit'", false),
    ] {
        let there = "<pattern id='there'><rect width='1' height='1'/></pattern><circle id='post' r='1'/>";
        let world = drawn(&format!("{there}<g {around}><rect id='room' {RECT} {own}/></g>")).world;
        assert_eq!(world.obstacle("room").is_some(), shows, "{around} {own}");
    }
}

/// Drawings whose shapes took time, and memory, in proportion to what they inherit.
#[test]
fn long_texts_that_very_many_shapes_inherit_are_read_once() {
    let shapes = "<rect width='1' height='1'/>".repeat(20_000);
    let long = "x".repeat(4_000_000);
    for inherited in
        [format!("fill='{long}'"), format!("fill='#f0f' stroke='url(#{long}) red'"), format!("color='{long}'")]
    {
        assert_eq!(drawn(&format!("<g {inherited}>{shapes}</g>")).world.obstacles.len(), 20_000);
    }
    let used = drawn(&format!("<defs><g id='g'>{shapes}</g></defs><use id='{long}' href='#g'/>")).world;
    let last = &used.obstacles[19_999].name;
    assert!(last.starts_with("xxx") && last.ends_with("x 20000") && last.len() <= 200, "{last}");
}
