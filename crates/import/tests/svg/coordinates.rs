//! Coordinates keep their digits from the text to the micrometre.

use super::{drawn, extent, import, names};
use crate::corners;
use motion_lab_core::worlds::ObstacleKind;

#[test]
fn a_drawing_on_a_national_grid_is_the_one_near_the_origin() {
    let grid = import(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='2506744 5624642 18.46 7.86' width='18.46' height='7.86'>
        <polyline id='kerb' fill='none' stroke='black'
            points='2506746.10,5624643.20 2506749.35,5624643.20 2506749.35,5624646.45'/>
        <rect id='pillar' x='2506752.30' y='5624644.70' width='0.60' height='0.40'/>
        <path id='hut' d='M2506748.25 5624643.3h1.3v0.9h-1.3z'/>
        <circle id='post' cx='2506750.06' cy='5624645.04' r='0.06'/></svg>",
    );
    // by hand: x less 2506744, y from the lower edge at 5624649.86
    assert_eq!(corners(&grid.world, "kerb"), [(2.1, 6.66), (5.35, 6.66)]);
    assert_eq!(extent(&grid.world, "kerb"), [2.1, 3.41, 5.35, 6.66]);
    assert_eq!(extent(&grid.world, "pillar"), [8.3, 4.76, 8.9, 5.16]);
    assert_eq!(extent(&grid.world, "hut"), [4.25, 5.66, 5.55, 6.56]);
    let (pose, _) = &grid.world.obstacle("post").unwrap().pieces[0];
    assert_eq!((pose.x, pose.y), (6.06, 4.82));
    assert!(grid.notes.is_empty(), "{:?}", grid.notes);
}

#[test]
fn an_offset_that_groups_undo_costs_no_digits() {
    let rect = "<rect id='a' x='4649775.1' y='5624642.7' width='0.6' height='0.4'/>";
    let boxes = [
        format!("<g transform='translate(-4649770,-5624640)'>{rect}</g>"),
        format!("<g transform='translate(-4649000 -5624000)'><g transform='translate(-770 -640)'>{rect}</g></g>"),
        format!("<g style='transform: translate(-4649770px, -5624640px)'>{rect}</g>"),
        format!("<g transform='matrix(1 0 0 1 -4649770 -5624640)'>{rect}</g>"),
        format!("<defs>{rect}</defs><use id='a 1' href='#a' x='-4649770' y='-5624640'/>"),
        "<g transform='translate(-4649770,-5624640)'>\
         <path id='a' d='M4649775.1 5624642.7l.6 0l0 .4l-.6 0z'/></g>"
            .to_owned(),
    ];
    for text in boxes {
        let world = drawn(&text).world;
        // 10 - 2.7 - 0.4 = 6.9
        assert_eq!(extent(&world, names(&world)[0]), [5.1, 6.9, 5.7, 7.3], "{text}");
    }
    let halved = drawn(
        "<g transform='translate(-350000.5 -650000.5) scale(0.5)'>\
         <rect id='a' x='700011.26' y='1300006.42' width='1.22' height='0.86'/></g>",
    );
    assert_eq!(extent(&halved.world, "a"), [5.13, 6.86, 5.74, 7.29]);
}

#[test]
fn a_line_that_comes_back_to_its_beginning_is_closed() {
    // 1.3 + 0.1 + 0.2 + 0.3 - 0.6 is not 1.3 in binary
    for back in ["l0.1 0l0.2 0l0.3 0l0 1l-0.6 0l0 -1", "h.6v1h-.6z", "h.6v1h-.6v-1z", "h.6v1h-.6v-1"] {
        let world = drawn(&format!("<path id='ring' fill='none' stroke='red' d='M1.3 1.1{back}'/>")).world;
        let ring = world.obstacle("ring").unwrap();
        let last = ring.placed().last().unwrap();
        assert_eq!((ring.kind, ring.pieces.len() >= 4), (ObstacleKind::Wall, true));
        let first = corners(&world, "ring")[0];
        assert_eq!((last.core()[1].x, last.core()[1].y), first, "{back}");
        assert!(ring.placed().all(|piece| (piece.core()[0] - piece.core()[1]).norm() > 0.05), "{back}");
    }
    let open = drawn("<path id='ring' fill='none' stroke='red' d='M1 1h1v1h-1v-.9'/>").world;
    assert_eq!(open.obstacle("ring").unwrap().pieces.len(), 4, "0.1 m are open");
}

#[test]
fn groups_nested_hundreds_deep_are_read() {
    let deep = |n: usize| {
        let moved = "<g transform='translate(.001)'>";
        format!("{}<rect id='a' x='1' y='1' width='2' height='3'/>{}", moved.repeat(n), "</g>".repeat(n))
    };
    assert_eq!(extent(&drawn(&deep(600)).world, "a"), [1.6, 6.0, 3.6, 9.0]);
    let text = super::sheet(&deep(1_000));
    let refused = motion_lab_import::svg("d.svg", &text, "d", super::SvgOptions::default()).unwrap_err();
    assert!(refused.to_string().contains("elements nested deeper than 1000"), "{refused}");
}

/// Numbers are judged in metres: a grid in millimetres is one in metres.
#[test]
fn a_national_grid_in_millimetres_keeps_its_micrometres() {
    let shapes = "<rect id='pillar' x='2506752300' y='5624644700' width='600' height='400'/>\
                  <path id='hut' d='M2506748250 5624643300h1300v900h-1300z'/>\
                  <polygon id='kerb' points='2506746100,5624643200 2506749350,5624643200 2506749350,5624646450'/>\
                  <circle id='post' cx='2506750060' cy='5624645040' r='60'/>\
                  <path id='wall' fill='none' stroke='red' d='M2506745e3 5624648e3l1e3 0'/>";
    let sheet = |inside: &str| {
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='18.46' height='7.86' \
             viewBox='2506744000 5624642000 18460 7860'>{inside}</svg>"
        )
    };
    let undone = format!(
        "<g transform='translate(2506744000 5624642000)'>\
         <g transform='translate(-2506744000,-5624642000)'>{shapes}</g></g>"
    );
    let clipped = format!(
        "<clipPath id='c'><rect x='2506744000' y='5624642000' width='18460' height='7860'/></clipPath>\
         <g clip-path='url(#c)'>{shapes}</g>"
    );
    for inside in [shapes.to_owned(), undone, clipped] {
        let world = import(&sheet(&inside)).world;
        assert_eq!(extent(&world, "kerb"), [2.1, 3.41, 5.35, 6.66]);
        assert_eq!(extent(&world, "pillar"), [8.3, 4.76, 8.9, 5.16]);
        assert_eq!(extent(&world, "hut"), [4.25, 5.66, 5.55, 6.56]);
        assert_eq!(extent(&world, "wall"), [1.0, 1.86, 2.0, 1.86]);
        let (pose, _) = &world.obstacle("post").unwrap().pieces[0];
        assert_eq!((pose.x, pose.y), (6.06, 4.82));
    }
}

#[test]
fn numbers_of_too_few_digits_are_refused_though_they_come_back() {
    // doubles near 10^12 are 1.2e-4 apart, those near 10^9 1.2e-7
    for (offset, is_read) in [("999999900", true), ("1000000000000", false), ("1e300", false)] {
        let text = super::sheet(&format!(
            "<g transform='translate(-{offset})'><g transform='translate(.25)'>\
             <rect id='a' x='{offset}' y='2' width='4' height='2'/></g></g>"
        ));
        let read = motion_lab_import::svg("d.svg", &text, "d", super::SvgOptions::default());
        if is_read {
            assert_eq!(extent(&read.unwrap().world, "a"), [0.25, 6.0, 4.25, 8.0]);
        } else {
            let error = read.unwrap_err().to_string();
            assert!(error.starts_with("d.svg:2: rect \"a\": not supported: numbers that stand for more"), "{error}");
        }
    }
}
