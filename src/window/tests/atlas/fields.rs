//! The number fields of the editor, and the other fields that text is typed into.

use egui::accesskit::Role::TextInput;

use super::*;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};
use motion_lab_sim::atlas::{EditShape, Editor, Op};

/// The lab with the editor in front, and a thing of the Apartment selected in it.
fn editing(name: Option<&str>) -> Harness<'static, Lab> {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    interface_mut(&mut harness).atlas.select(name);
    harness.run_steps(2);
    harness
}

/// Types a text into a field in place of what stands there, and stays in it.
fn type_into(harness: &mut Harness<'_, Lab>, field: &str, text: &str) {
    harness.get_by_label(field).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.step();
    harness.event(Event::Text(text.into()));
    harness.run_steps(2);
}

/// What a field shows.
fn shown(harness: &Harness<'_, Lab>, field: &str) -> String {
    harness.get_by_label(field).value().expect("a value")
}

fn world(harness: &Harness<'_, Lab>) -> World {
    atlas(harness).world().clone()
}

fn selected(harness: &Harness<'_, Lab>) -> Option<String> {
    atlas(harness).selected
}

/// The box around an obstacle.
fn around(harness: &Harness<'_, Lab>, name: &str) -> Aabb {
    let placed = world(harness).obstacle(name).expect(name).placed().next().expect("a shape");
    placed.bounds()
}

/// Asserts that nothing of a change is shown that was not made.
fn assert_shows_its_world(harness: &Harness<'_, Lab>) {
    let atlas = atlas(harness);
    assert_eq!(atlas.seen().world(), atlas.world());
    assert_eq!(*atlas.still, motion_lab_core::picture::world(atlas.world()));
}

#[test]
fn a_number_is_entered_by_a_press_elsewhere_for_its_own_thing() {
    let starts = World::apartment();
    let mut harness = editing(Some("A's bed"));
    type_into(&mut harness, "A's bed: height", "0.75");
    assert_eq!(world(&harness), starts, "not while it is typed");
    let on_other = at(&harness, [11.25, 7.0]);
    pointer(&mut harness, on_other, Some(true));
    assert_eq!(around(&harness, "A's bed").max, Point2::new(1.25, 6.75));
    assert_eq!(selected(&harness).as_deref(), Some("A's bed"), "the press enters, the release selects");
    pointer(&mut harness, on_other, Some(false));
    harness.run_steps(3);
    assert_eq!(selected(&harness).as_deref(), Some("C's bed"));
    assert_eq!(world(&harness).obstacle("C's bed"), starts.obstacle("C's bed"));
    assert_eq!(around(&harness, "A's bed").max, Point2::new(1.25, 6.75));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(world(&harness), starts, "one change, one undo");
    // pressed and released within a frame
    type_into(&mut harness, "C's bed: height", "0.5");
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    let on_table = at(&harness, [6.0, 6.75]);
    harness.event(Event::PointerMoved(on_table));
    for pressed in [true, false] {
        harness.event(Event::PointerButton { pos: on_table, button, pressed, modifiers });
    }
    harness.run_steps(3);
    assert_eq!(around(&harness, "C's bed").max, Point2::new(11.75, 6.5));
    assert_eq!(selected(&harness).as_deref(), Some("B's round table"));
    // on bare paper, whose own field is the world's; a drag of another thing; and the other modes
    let floor = at(&harness, [5.0, 4.375]);
    type_into(&mut harness, "B's round table: radius", "0.25");
    click_at(&mut harness, floor);
    assert_eq!((selected(&harness), around(&harness, "B's round table").max.y), (None, 7.0));
    type_into(&mut harness, "Apartment: width", "13");
    drag_on(&mut harness, [0.75, 6.25], [0.75, 6.5]);
    assert_eq!(world(&harness).bounds.max.x, 13.0);
    let moved = around(&harness, "A's bed");
    assert!(moved.min.y > 6.1 && selected(&harness).as_deref() == Some("A's bed"), "{moved:?}");
    type_into(&mut harness, "A's bed: height", "1");
    click(&mut harness, "Measure");
    assert_eq!(around(&harness, "A's bed").max.y, moved.min.y + 1.0);
}

#[test]
fn a_number_that_is_refused_when_it_is_left_says_why() {
    let mut harness = editing(Some("B's round table"));
    for (text, why) in [("0", "radius 0 m"), ("much", "\u{201c}much\u{201d} is no number")] {
        interface_mut(&mut harness).atlas.select(Some("B's round table"));
        harness.run_steps(2);
        type_into(&mut harness, "B's round table: radius", text);
        let bed = at(&harness, [0.75, 7.0]);
        click_at(&mut harness, bed);
        assert_eq!(selected(&harness).as_deref(), Some("A's bed"));
        harness.get_by_label_contains(why);
        assert_eq!(world(&harness), World::apartment());
        let floor = at(&harness, [6.0, 4.0]);
        click_at(&mut harness, floor);
        assert!(harness.query_by_label_contains(why).is_none(), "until the next press");
    }
}

#[test]
fn escape_leaves_a_field_as_it_was_and_the_selection_too() {
    let mut harness = editing(Some("A's bed"));
    let before = shown(&harness, "A's bed: height");
    type_into(&mut harness, "A's bed: height", "0.75");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(world(&harness), World::apartment());
    assert_eq!((selected(&harness).as_deref(), atlas(&harness).can_undo()), (Some("A's bed"), [false; 2]));
    assert_eq!(shown(&harness, "A's bed: height"), before);
    assert!(!harness.get_by_label("A's bed: height").is_focused());
    // what is looked for is cleared
    let find = |h: &Harness<'_, Lab>| h.get_by_role_and_label(TextInput, "find a thing").is_focused();
    harness.get_by_role_and_label(TextInput, "find a thing").focus();
    harness.run_steps(2);
    harness.event(Event::Text("bed".into()));
    harness.run_steps(2);
    assert!(find(&harness) && atlas(&harness).search == "bed");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!find(&harness) && atlas(&harness).search.is_empty());
    assert_eq!(selected(&harness).as_deref(), Some("A's bed"));
    // a name is the present one again
    harness.get_by_role_and_label(TextInput, "name").focus();
    harness.run_steps(2);
    harness.event(Event::Text("2".into()));
    harness.run_steps(2);
    assert_ne!(atlas(&harness).name_text, "A's bed");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(atlas(&harness).name_text, "A's bed");
    assert_eq!(selected(&harness).as_deref(), Some("A's bed"));
    // with no field in hand it selects nothing, as before
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!((selected(&harness), world(&harness)), (None, World::apartment()));
}

#[test]
fn a_field_that_is_left_untouched_changes_nothing() {
    // its heading has more digits than a field shows
    let mut harness = editing(Some("room B"));
    let field = "room B: heading";
    let assert_unchanged = |h: &Harness<'_, Lab>, how: &str| {
        assert_eq!(world(h), World::apartment(), "{how}");
        assert_eq!(atlas(h).can_undo(), [false; 2], "{how}");
    };
    assert_ne!(shown(&harness, field).trim_end_matches(" rad").parse(), Ok(std::f64::consts::FRAC_PI_2));
    for key in [Key::Enter, Key::Tab, Key::Escape] {
        harness.get_by_label(field).focus();
        harness.run_steps(3);
        press(&mut harness, Modifiers::NONE, key);
        assert_unchanged(&harness, key.name());
    }
    let (on_field, elsewhere) = (harness.get_by_label(field).rect().center(), at(&harness, [6.0, 4.0]));
    click_at(&mut harness, on_field);
    assert!(harness.get_by_label(field).is_focused());
    click_at(&mut harness, elsewhere);
    assert_unchanged(&harness, "left by a click");
    // nor one whose text is brought back to what it was
    interface_mut(&mut harness).atlas.select(Some("room B"));
    harness.run_steps(2);
    harness.get_by_label(field).focus();
    harness.run_steps(3);
    press(&mut harness, Modifiers::NONE, Key::End);
    harness.event(Event::Text("5".into()));
    harness.run_steps(2);
    press(&mut harness, Modifiers::NONE, Key::Backspace);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert_unchanged(&harness, "typed and taken back");
    // a world that was changed by a field alone has one change
    type_into(&mut harness, field, "1.5");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert_eq!(world(&harness).place("room B").unwrap().pose.theta, 1.5);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!((world(&harness), atlas(&harness).can_undo()), (World::apartment(), [false, true]));
}

#[test]
fn the_corner_whose_number_is_edited_stays_the_one_that_is_edited() {
    let points = |corners: [[f64; 2]; 3]| corners.map(|[x, y]| Point2::new(x, y)).to_vec();
    let hull = EditShape::Rounded { points: points([[2.0, 3.0], [4.0, 3.0], [3.0, 4.5]]), radius: 0.1 };
    let wedge = EditShape::Polygon(points([[6.0, 3.0], [8.0, 3.0], [7.0, 4.5]]));
    let mut editor = Editor::new(World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0))));
    for (name, shape) in [("the hull", hull), ("the wedge", wedge)] {
        editor.apply(&Op::Add { name: name.into(), shape }).unwrap();
    }
    let mut harness = editing(None);
    interface_mut(&mut harness).open_world(AtlasState::edited(editor));
    let corners = |h: &Harness<'_, Lab>, name: &str| {
        let field = |axis: &str, i: usize| {
            shown(h, &format!("{name}: {axis} {i}")).trim_end_matches(" m").parse::<f64>().expect("a number")
        };
        (1..=3).map(|i| [field("x", i), field("y", i)]).collect::<Vec<_>>()
    };
    // each corner crosses the line of the others, so that the ring turns over, and becomes the leftmost
    for name in ["the hull", "the wedge"] {
        interface_mut(&mut harness).atlas.select(Some(name));
        harness.run_steps(2);
        let mut expected = corners(&harness, name);
        for (i, axis, to) in [(2, 1, 1.0), (2, 0, 0.5), (1, 1, 0.25), (0, 0, 9.0)] {
            type_into(&mut harness, &format!("{name}: {} {}", ["x", "y"][axis], i + 1), &to.to_string());
            press(&mut harness, Modifiers::NONE, Key::Enter);
            expected[i][axis] = to;
            assert_eq!(corners(&harness, name), expected, "{name}: corner {} to {to}", i + 1);
        }
    }
    for _ in 0..8 {
        press(&mut harness, Modifiers::COMMAND, Key::Z);
    }
    // dragged to the left of all others, it is the same one all the way
    interface_mut(&mut harness).atlas.select(Some("the hull"));
    harness.run_steps(2);
    let before = corners(&harness, "the hull");
    let field = harness.get_by_label("the hull: x 3").rect().center();
    pointer(&mut harness, field, Some(true));
    for step in 1..=30 {
        pointer(&mut harness, field - egui::vec2(8.0 * step as f32, 0.0), None);
        let now = corners(&harness, "the hull");
        assert!(now[..2] == before[..2] && now[2][1] == before[2][1], "{now:?}");
    }
    harness.run_steps(2);
    let dragged = corners(&harness, "the hull");
    assert!(dragged[2][0] < 1.0, "{dragged:?}");
    pointer(&mut harness, field - egui::vec2(240.0, 0.0), Some(false));
    harness.run_steps(3);
    assert_eq!(corners(&harness, "the hull"), dragged);
}

#[test]
fn a_drag_ends_where_its_field_goes_or_the_widget_does() {
    let mut fenced = World::apartment();
    let line = [[2.0, 2.0], [3.0, 2.0], [3.0, 3.0], [2.2, 2.0]].map(|[x, y]| Point2::new(x, y));
    let sides = line.windows(2).map(|w| (Pose2::IDENTITY, Shape::Segment { a: w[0], b: w[1] }));
    fenced.obstacles.push(Obstacle::new("the fence", ObstacleKind::Wall, sides.collect()));
    let mut harness = editing(None);
    interface_mut(&mut harness).open_world(AtlasState::of(fenced.clone()));
    interface_mut(&mut harness).atlas.select(Some("the fence"));
    harness.run_steps(2);
    // its last corner comes onto the first one: a closed line has no fourth
    let field = harness.get_by_label("the fence: x 4").rect().center();
    pointer(&mut harness, field, Some(true));
    let mut is_closed = false;
    for step in 1..=40 {
        pointer(&mut harness, field - egui::vec2(step as f32, 0.0), None);
        is_closed |= harness.query_by_label("the fence: x 4").is_none();
    }
    assert!(is_closed, "the field was never gone");
    assert_shows_its_world(&harness);
    pointer(&mut harness, field - egui::vec2(40.0, 0.0), Some(false));
    harness.run_steps(3);
    assert_eq!((world(&harness), atlas(&harness).can_undo()), (fenced.clone(), [false; 2]));
    // another widget comes in front, by its key
    for on_paper in [false, true] {
        let field = harness.get_by_label("the fence: x 2").rect().center();
        let from = if on_paper { at(&harness, [2.5, 2.0]) } else { field };
        pointer(&mut harness, from, Some(true));
        for step in 1..=5 {
            pointer(&mut harness, from + egui::vec2(5.0 * step as f32, 0.0), None);
        }
        assert_ne!(*atlas(&harness).seen().world(), fenced, "it is dragged");
        press(&mut harness, Modifiers::COMMAND, Key::Num1);
        assert_shows_its_world(&harness);
        press(&mut harness, Modifiers::COMMAND, Key::Num4);
        pointer(&mut harness, from + egui::vec2(30.0, 0.0), None);
        assert_shows_its_world(&harness);
        pointer(&mut harness, from + egui::vec2(30.0, 0.0), Some(false));
        harness.run_steps(3);
        assert_eq!((world(&harness), atlas(&harness).can_undo()), (fenced.clone(), [false; 2]));
        assert_eq!(selected(&harness).as_deref(), Some("the fence"));
    }
}

#[test]
fn undo_during_a_drag_ends_it() {
    let mut harness = editing(Some("A's bed"));
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    let moved = world(&harness);
    assert_ne!(moved, World::apartment());
    for on_paper in [false, true] {
        let field = harness.get_by_label("A's bed: width").rect().center();
        let from = if on_paper { at(&harness, [0.8, 7.0]) } else { field };
        pointer(&mut harness, from, Some(true));
        for step in 1..=5 {
            pointer(&mut harness, from + egui::vec2(5.0 * step as f32, 0.0), None);
        }
        assert_ne!(*atlas(&harness).seen().world(), moved, "it is dragged");
        press(&mut harness, Modifiers::COMMAND, Key::Z);
        assert_shows_its_world(&harness);
        for step in 6..=9 {
            pointer(&mut harness, from + egui::vec2(5.0 * step as f32, 0.0), None);
            assert_shows_its_world(&harness);
        }
        pointer(&mut harness, from + egui::vec2(45.0, 0.0), Some(false));
        harness.run_steps(3);
        assert_eq!(world(&harness), moved, "the drag alone was undone");
        assert_eq!(atlas(&harness).can_undo(), [true, false]);
    }
    // an arrow key is a change too
    let from = at(&harness, [0.8, 7.0]);
    pointer(&mut harness, from, Some(true));
    for step in 1..=5 {
        pointer(&mut harness, from + egui::vec2(5.0 * step as f32, 0.0), None);
    }
    press(&mut harness, Modifiers::NONE, Key::ArrowLeft);
    assert_shows_its_world(&harness);
    assert_eq!(world(&harness), World::apartment());
    pointer(&mut harness, from + egui::vec2(45.0, 0.0), None);
    assert_shows_its_world(&harness);
    pointer(&mut harness, from + egui::vec2(45.0, 0.0), Some(false));
}

#[test]
fn a_name_is_entered_by_a_press_elsewhere_and_a_refused_one_says_why() {
    let mut harness = editing(Some("A's bed"));
    let rename = |harness: &mut Harness<'_, Lab>, field: &str, text: &str| {
        harness.get_by_role_and_label(TextInput, field).focus();
        harness.run_steps(2);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        harness.step();
        harness.event(Event::Text(text.into()));
        harness.run_steps(2);
    };
    rename(&mut harness, "name", "A's couch");
    let [table, floor] = [[6.0, 6.75], [5.0, 4.375]].map(|place| at(&harness, place));
    click_at(&mut harness, table);
    let has = |h: &Harness<'_, Lab>, name: &str| world(h).obstacle(name).is_some();
    assert!(has(&harness, "A's couch") && !has(&harness, "A's bed"));
    assert_eq!(selected(&harness).as_deref(), Some("B's round table"));
    rename(&mut harness, "name", "C's bed");
    click_at(&mut harness, floor);
    assert!(has(&harness, "B's round table"));
    assert!(atlas(&harness).message.is_some_and(|why| why.contains("C's bed")));
    rename(&mut harness, "name of the world", "Flat");
    click(&mut harness, "Measure");
    assert_eq!(world(&harness).name, "Flat");
    // by Enter, the same thing stays selected
    click(&mut harness, "Edit");
    click_at(&mut harness, table);
    rename(&mut harness, "name", "the table");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(has(&harness, "the table") && selected(&harness).as_deref() == Some("the table"));
}

#[test]
fn what_is_looked_for_can_be_cleared_in_a_world_of_few_things() {
    let mut harness = editing(None);
    let mut yard = World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0)));
    for i in 1..=12 {
        let pieces = vec![(Pose2::new(f64::from(i) * 0.9, 4.0, 0.0), Shape::Disc { radius: 0.25 })];
        yard.obstacles.push(Obstacle::new(format!("disc {i}"), ObstacleKind::Solid, pieces));
    }
    interface_mut(&mut harness).open_world(AtlasState::of(yard));
    harness.run_steps(2);
    harness.get_by_role_and_label(TextInput, "find a thing").focus();
    harness.run_steps(2);
    harness.event(Event::Text("disc 7".into()));
    harness.run_steps(2);
    click(&mut harness, "disc 7 \u{b7} obstacle");
    press(&mut harness, Modifiers::NONE, Key::Delete);
    harness.get_by_label("Nothing of that name.");
    harness.get_by_role_and_label(TextInput, "find a thing").focus();
    harness.run_steps(2);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    harness.get_by_label("disc 8 \u{b7} obstacle");
}
