use super::*;

#[test]
fn what_falls_together_is_counted_together() {
    // bins of three points: 0 to 3, 3 to 6, and so on; the end of the line is in the last
    assert_eq!(binned([7.0, 0.0, 2.9, 3.0, 8.9, 11.9].into_iter(), 11.0), [2, 1, 2, 1]);
    assert_eq!(binned([12.5, -1.0].into_iter(), 11.0), [1, 0, 0, 1]);
    assert_eq!(binned(std::iter::empty(), 2.0), [0]);
}

#[test]
fn a_lane_has_what_happened_to_its_robot() {
    let mark = |tick, robot, what| TickMark { tick, robot, what, at: Default::default() };
    use Happening::{Contact, Takeover};
    let marks = [mark(3, 0, Contact), mark(5, 1, Contact), mark(5, 0, Takeover), mark(9, 0, Contact)];
    let of = |robot, what| Lane { robot, name: "" }.of(&marks, what).collect::<Vec<u64>>();
    assert_eq!((of(Some(0), Contact), of(Some(0), Takeover), of(Some(1), Takeover)), (vec![3, 9], vec![5], vec![]));
    assert_eq!(of(None, Contact), [3, 5, 9]);
}

#[test]
fn a_long_name_ends_within_its_room() {
    use bevy_egui::egui::{Context, RawInput};
    let room = Rect::from_min_max(pos2(20.0, 40.0), pos2(72.0, 52.0));
    for (words, is_elided) in [("Rusty", false), ("the forklift at the northern gate", true)] {
        let mut output = Context::default().run_ui(RawInput::default(), |ui| {
            name(ui, words, room, &FrameColours::from(motion_lab_core::picture::Theme::Light));
        });
        output.textures_delta.clear();
        let painted = output.shapes.iter().find_map(|clipped| match &clipped.shape {
            Shape::Text(text) => Some((text.galley.elided, text.galley.mesh_bounds.translate(text.pos.to_vec2()))),
            _ => None,
        });
        let (elided, ink) = painted.expect("the name");
        assert_eq!(elided, is_elided, "{words}");
        // the edges of letters are soft
        assert!(
            room.expand(1.0).x_range().contains(ink.left()) && ink.right() <= room.right() + 1.0,
            "{words} at {ink} in {room}"
        );
    }
}

#[test]
fn the_axis_has_labels_apart_at_round_seconds() {
    // a minute over 1,200 points: 64 points are 3.2 s, so every 5 s
    assert_eq!(step_of(60.0, 1200.0), 5.0);
    assert_eq!(step_of(60.0, 300.0), 15.0);
    assert_eq!(step_of(0.05, 1200.0), 0.05);
    assert_eq!(step_of(3600.0, 600.0), 600.0);
    assert_eq!([0.05, 0.1, 5.0, 60.0, 1800.0].map(shortest), ["0.05", "0.1", "5", "60", "1800"]);
}

#[test]
fn a_place_on_the_line_is_the_tick_that_is_drawn_there() {
    let lanes = Rect::from_min_max(pos2(100.0, 0.0), pos2(1300.0, 27.0));
    let scale = Scale { lanes, span: TickSpan { from: 0, to: 1200 } };
    assert_eq!([0, 600, 1200].map(|tick| scale.x(tick)), [100.0, 700.0, 1300.0]);
    assert_eq!([0.0, 100.0, 701.0, 1300.0, 2000.0].map(|x| scale.tick(x)), [0, 0, 601, 1200, 1200]);
    let unstarted = Scale { lanes, span: TickSpan { from: 0, to: 0 } };
    assert_eq!((unstarted.x(0), unstarted.tick(900.0)), (100.0, 0));
    let near = Scale { lanes, span: TickSpan { from: 600, to: 900 } };
    assert_eq!([600, 750, 900].map(|tick| near.x(tick)), [100.0, 700.0, 1300.0]);
    assert_eq!([0.0, 104.0, 700.0, 2000.0].map(|x| near.tick(x)), [600, 601, 750, 900]);
}
