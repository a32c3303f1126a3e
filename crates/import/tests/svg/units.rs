//! How large a drawing is: by its physical size, by its pixels, or as the caller says.

use super::extent;
use motion_lab_import::{Imported, SvgOptions, svg};

/// A drawing of this head with a square from (25, 25) to (75, 75).
fn square(head: &str, metres_per_unit: Option<f64>) -> Imported {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' {head}><rect id='a' width='50' height='50' x='25' y='25'/></svg>"
    );
    svg("d.svg", &text, "d", SvgOptions { metres_per_unit, ..SvgOptions::default() }).unwrap()
}

#[test]
fn a_drawing_with_a_physical_size_has_that_size() {
    for (size, metres) in [
        ("width='100mm' height='100mm'", 0.1),
        ("width='10cm' height='10cm'", 0.1),
        ("width='10in' height='10in'", 0.254),
        ("width='72pt' height='72pt'", 0.0254),
        ("width='6pc' height='6pc'", 0.0254),
        ("width='400Q' height='400Q'", 0.1),
        ("width='100mm'", 0.1),
        ("height='2.5cm'", 0.025),
    ] {
        let found = square(&format!("{size} viewBox='0 0 100 100'"), None);
        let round = |x: f64| (x * 1e6).round() / 1e6;
        assert_eq!(found.world.bounds.max.x, metres, "{size}");
        assert_eq!(found.world.bounds.max.y, metres, "{size}");
        assert_eq!(extent(&found.world, "a")[0], round(0.25 * metres), "{size}");
        assert!(found.notes[0].starts_with("the drawing says that it is "), "{:?}", found.notes);
    }
    let said = square("width='100mm' height='100mm' viewBox='0 0 100 100'", None);
    assert_eq!(
        said.notes,
        ["the drawing says that it is 100mm x 100mm, so a unit of it is 0.001 m; --metres-per-unit changes it"]
    );
    // without a view box a unit is a pixel, of which an inch has 96
    let pixels = square("width='1in' height='1in'", None);
    assert_eq!(extent(&pixels.world, "a")[0], 0.006_615);
}

#[test]
fn metres_per_unit_are_of_the_drawings_own_unit() {
    for head in [
        "width='100mm' height='100mm' viewBox='0 0 100 100'",
        "width='4in' height='4in' viewBox='0 0 100 100'",
        "width='100%' height='100%' viewBox='0 0 100 100'",
        "width='600' height='600' viewBox='0 0 100 100'",
        "width='10px' height='10px' viewBox='0 0 100 100'",
        "viewBox='0 0 100 100'",
        "width='100' height='100'",
    ] {
        for metres in [1.0, 0.02, 0.001] {
            let found = square(head, Some(metres));
            let expected = [25.0, 25.0, 75.0, 75.0].map(|x| (x * metres * 1e6).round() / 1e6);
            assert_eq!(extent(&found.world, "a"), expected, "{head} {metres}");
            assert_eq!(found.world.bounds.max.x, 100.0 * metres, "{head} {metres}");
        }
    }
    let said = square("width='100mm' height='100mm' viewBox='0 0 100 100'", Some(0.02));
    assert_eq!(said.notes, ["the drawing says that it is 100mm x 100mm; a unit of it was taken for 0.02 m instead"]);
}

#[test]
fn a_pixel_is_a_metre_where_nothing_else_is_said() {
    let plain = square("width='100' height='100' viewBox='0 0 100 100'", None);
    assert_eq!((extent(&plain.world, "a"), plain.notes.len()), ([25.0, 25.0, 75.0, 75.0], 0));
    assert_eq!(plain.assumed_unit, Some(1.0));
    let scaled = square("width='200' height='200' viewBox='0 0 100 100'", None);
    assert_eq!(extent(&scaled.world, "a"), [50.0, 50.0, 150.0, 150.0]);
    assert_eq!((scaled.assumed_unit, scaled.notes.len()), (Some(2.0), 0));
    // a drawing without any size reaches as far as what it shows
    let bare = square("", None);
    assert_eq!((bare.world.bounds.max.x, extent(&bare.world, "a")), (75.0, [25.0, 0.0, 75.0, 50.0]));
    assert_eq!(bare.assumed_unit, Some(1.0));
    let percent = square("width='100%' height='100%' viewBox='0 0 100 100'", None);
    assert_eq!(percent.assumed_unit, Some(1.0));
    // whoever says a size, in the drawing or beside it, is not second-guessed
    for (head, said) in [
        ("width='100mm' height='100mm'", None),
        ("height='1in' viewBox='0 0 9 9'", None),
        ("viewBox='0 0 9 9'", Some(0.5)),
    ] {
        assert_eq!(square(head, said).assumed_unit, None, "{head}");
    }
}
