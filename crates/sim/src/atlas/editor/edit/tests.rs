//! The editor.

use super::*;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Footprint, Pose2};
use motion_lab_core::picture::Drawing;
use motion_lab_core::worlds::Resident;

fn p(x: f64, y: f64) -> Point2 {
    Point2::new(x, y)
}

fn name(name: &str) -> String {
    name.to_owned()
}

fn boxed(x0: f64, y0: f64, x1: f64, y1: f64) -> EditShape {
    EditShape::Box { min: p(x0, y0), max: p(x1, y1) }
}

#[test]
fn canonical_files_are_saved_as_they_were_opened() {
    for built_in in World::built_in_names() {
        let text = World::built_in(built_in).unwrap().to_ron();
        let mut editor = Editor::open("w.ron", &text).unwrap();
        assert!(editor.is_saved());
        assert_eq!(editor.text(), text, "{built_in}: open, save: the same bytes");
        // and an edit taken back leaves no trace
        let place = editor.world().places[0].name.clone();
        editor.apply(&Op::Move { name: place, by: Vector2::new(0.1, 0.0) }).unwrap();
        assert!(editor.text() != text && !editor.is_saved());
        assert!(editor.undo() && editor.is_saved());
        assert_eq!(editor.text(), text);
    }
}

#[test]
fn a_drawn_world_is_a_world_file() {
    let mut editor = Editor::new(World::workbench());
    let ops = [
        Op::Add { name: name("the fence"), shape: EditShape::Wall(vec![p(-2.0, -2.0), p(2.0, -2.0), p(2.0, -1.8)]) },
        Op::Add { name: name("the tree"), shape: EditShape::Disc { centre: p(-1.5, 1.5), radius: 0.2 } },
        Op::Add {
            name: name("the ell"),
            shape: EditShape::Polygon(vec![
                p(1.5, 0.0),
                p(2.1, 0.0),
                p(2.1, 0.2),
                p(1.7, 0.2),
                p(1.7, 0.9),
                p(1.5, 0.9),
            ]),
        },
        Op::Add {
            name: name("the log"),
            shape: EditShape::Rounded { points: vec![p(-2.0, 0.0), p(-1.8, 0.3)], radius: 0.05 },
        },
        Op::AddPlace { name: name("there"), pose: Pose2::new(1.0, 0.3, 7.0) },
        Op::Move { name: name("the post"), by: Vector2::new(-0.5, 0.25) },
        Op::Drag { name: name("the block"), handle: 2, to: p(1.2, 1.8) },
        Op::Drag { name: name("the fence"), handle: 2, to: p(2.0, -1.0) },
        Op::Drag { name: name("the tree"), handle: 1, to: p(-1.5, 1.9) },
        Op::Rename { name: name("the shelf"), to: name("the \"bar\"") },
        Op::Delete { name: name("the base") },
    ];
    for op in &ops {
        let seen = editor.preview(op).unwrap();
        editor.apply(op).unwrap();
        assert_eq!(*editor.world(), seen);
        assert_eq!(World::parse("w.ron", &editor.text()).unwrap(), seen, "{op:?}");
    }
    let world = editor.world();
    assert_eq!(EditShape::of(world.obstacle("the post").unwrap()), boxed(-0.7 - 0.5, 0.55, -0.5 - 0.5, 0.75));
    assert_eq!(EditShape::of(world.obstacle("the block").unwrap()), boxed(0.5, 1.0, 1.2, 1.8));
    let EditShape::Disc { radius, .. } = EditShape::of(world.obstacle("the tree").unwrap()) else { panic!("a disc") };
    assert!((radius - 0.4).abs() < 1e-12);
    assert!(world.obstacle("the \"bar\"").is_some() && world.places.iter().all(|p| p.name != "the base"));
    assert!(world.place("there").unwrap().pose.theta < 3.2, "an angle is wrapped, as in a file");
    // the concave polygon is one shape, in the file too: six corners and the middles of its edges
    assert_eq!(editor.handles("the ell").iter().filter(|h| !h.makes_corner).count(), 6);
    assert_eq!(editor.handles("the ell").len(), 12);
    let line = editor.text().lines().find(|l| l.contains("the ell")).unwrap().trim().to_owned();
    let points = "(1.5, 0.0), (2.1, 0.0), (2.1, 0.2), (1.7, 0.2), (1.7, 0.9), (1.5, 0.9)";
    assert_eq!(line, format!("(name: \"the ell\", shape: Polygon([{points}])),"));
    for _ in &ops {
        assert!(editor.undo());
    }
    assert!(!editor.undo());
    assert_eq!(*editor.world(), World::workbench());
    while editor.redo() {}
    assert!(editor.world().obstacle("the ell").is_some());
}

#[test]
fn what_a_file_would_be_refused_for_is_refused_and_changes_nothing() {
    let mut editor = Editor::new(World::workbench());
    let bow = EditShape::Polygon(vec![p(0.0, 0.0), p(1.0, 1.0), p(1.0, 0.0), p(0.0, 1.0)]);
    let refused = [
        (Op::Add { name: name("the block"), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "the name is taken"),
        (Op::Add { name: name(""), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "it must be 1 to 200 bytes"),
        (Op::Add { name: name("dust"), shape: EditShape::Disc { centre: p(0.0, 0.0), radius: 0.0 } }, "radius 0 m"),
        (Op::Add { name: name("nan"), shape: EditShape::Disc { centre: p(f64::NAN, 0.0), radius: 1.0 } }, ""),
        (Op::Add { name: name("bow"), shape: bow }, "polygon: "),
        (Op::Add { name: name("dot"), shape: EditShape::Wall(vec![p(0.0, 0.0)]) }, ""),
        (Op::Drag { name: name("the block"), handle: 2, to: p(0.5, 1.0) }, "the smallest feature"),
        (Op::Rename { name: name("the block"), to: name("the post") }, "the name is taken"),
        (Op::Delete { name: name("nobody") }, "nothing here is called \"nobody\""),
        (Op::Reshape { name: name("the base"), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "has no shape"),
        (Op::SetPose { name: name("Reach"), pose: Pose2::IDENTITY }, "has no shape"),
    ];
    for (op, reason) in refused {
        let error = editor.apply(&op).unwrap_err().to_string();
        assert!(error.contains(reason), "{op:?}: {error}");
        assert_eq!(*editor.world(), World::workbench());
    }
    assert!(!editor.undo(), "nothing was done");
}

#[test]
fn closed_walls_stay_closed_and_names_stay_free() {
    let mut editor = Editor::new(World::lot());
    let square = vec![p(1.0, 1.0), p(2.0, 1.0), p(2.0, 2.0), p(1.0, 1.0)];
    editor.apply(&Op::Add { name: editor.free_name("wall"), shape: EditShape::Wall(square) }).unwrap();
    assert_eq!(editor.handles("wall").len(), 6, "three corners, three edges");
    editor.apply(&Op::Drag { name: name("wall"), handle: 0, to: p(0.5, 0.5) }).unwrap();
    let EditShape::Wall(points) = EditShape::of(editor.world().obstacle("wall").unwrap()) else { panic!("a wall") };
    assert_eq!((points[0], points[3]), (p(0.5, 0.5), p(0.5, 0.5)));
    assert_eq!(editor.free_name("wall"), "wall 2");
}

#[test]
fn painted_marks_are_added_moved_reshaped_renamed_and_deleted() {
    let mut editor = Editor::new(World::workbench());
    let line = |editor: &Editor, name: &str| editor.world().marks.iter().find(|m| m.name == name).cloned();
    let shape = EditShape::Mark(vec![p(0.0, 0.0), p(1.0, 0.0)]);
    for (op, expected) in [
        (Op::Add { name: name("stripe"), shape }, vec![p(0.0, 0.0), p(1.0, 0.0)]),
        (Op::Move { name: name("stripe"), by: Vector2::new(0.0, 0.5) }, vec![p(0.0, 0.5), p(1.0, 0.5)]),
        (Op::Drag { name: name("stripe"), handle: 0, to: p(-1.0, 0.5) }, vec![p(-1.0, 0.5), p(1.0, 0.5)]),
        // the middle of its one edge becomes a corner, which goes away when dragged onto its neighbour
        (Op::Drag { name: name("stripe"), handle: 2, to: p(0.0, 1.0) }, vec![p(-1.0, 0.5), p(0.0, 1.0), p(1.0, 0.5)]),
        (Op::Drag { name: name("stripe"), handle: 1, to: p(1.0, 0.5) }, vec![p(-1.0, 0.5), p(1.0, 0.5)]),
        (
            Op::Reshape { name: name("stripe"), shape: EditShape::Mark(vec![p(0.0, 0.0), p(0.0, 2.0)]) },
            vec![p(0.0, 0.0), p(0.0, 2.0)],
        ),
    ] {
        editor.apply(&op).unwrap();
        assert_eq!(line(&editor, "stripe").unwrap().points, expected, "{op:?}");
    }
    assert_eq!(editor.selected_items("stripe").len(), 4, "its line and three handles");
    editor.apply(&Op::Rename { name: name("stripe"), to: name("the stripe") }).unwrap();
    assert!(line(&editor, "the stripe").is_some() && line(&editor, "stripe").is_none());
    // a mark is no obstacle, and an obstacle no mark
    let refused = [
        Op::Reshape { name: name("the stripe"), shape: boxed(0.0, 0.0, 1.0, 1.0) },
        Op::Reshape { name: name("the block"), shape: EditShape::Mark(vec![p(0.0, 0.0), p(1.0, 0.0)]) },
    ];
    for op in refused {
        assert!(matches!(editor.apply(&op), Err(EditError::NoShape(_))), "{op:?}");
    }
    editor.apply(&Op::Delete { name: name("the stripe") }).unwrap();
    assert_eq!(editor.world().marks, World::workbench().marks);
}

#[test]
fn corners_are_made_and_go_away_and_places_turn() {
    let mut editor = Editor::new(World::lot());
    editor.apply(&Op::Add { name: name("wall"), shape: EditShape::Wall(vec![p(1.0, 4.0), p(2.0, 4.0)]) }).unwrap();
    let corners = |editor: &Editor| editor.handles("wall").iter().filter(|h| !h.makes_corner).count();
    editor.apply(&Op::Drag { name: name("wall"), handle: 2, to: p(1.5, 4.5) }).unwrap();
    assert_eq!((corners(&editor), editor.handles("wall").len()), (3, 5));
    assert_eq!(editor.shape("wall").unwrap().neighbours(1), [p(1.0, 4.0), p(2.0, 4.0)]);
    editor.apply(&Op::Drag { name: name("wall"), handle: 0, to: p(1.5, 4.5) }).unwrap();
    assert_eq!(editor.shape("wall"), Some(EditShape::Wall(vec![p(1.5, 4.5), p(2.0, 4.0)])));
    // a wall keeps two corners: dragging one onto the other is refused as a piece without length
    assert!(editor.apply(&Op::Drag { name: name("wall"), handle: 0, to: p(2.0, 4.0) }).is_err());
    // a new corner makes a convex polygon concave
    let triangle = EditShape::Polygon(vec![p(4.0, 3.0), p(6.0, 3.0), p(5.0, 5.0)]);
    editor.apply(&Op::Add { name: name("dart"), shape: triangle }).unwrap();
    editor.apply(&Op::Drag { name: name("dart"), handle: 3, to: p(5.0, 4.0) }).unwrap();
    let dart = editor.world().obstacle("dart").unwrap();
    assert_eq!((dart.pieces.len(), dart.outlines.len()), (2, 1));
    editor.apply(&Op::Drag { name: name("dart"), handle: 1, to: p(6.0, 3.0) }).unwrap();
    assert_eq!(editor.world().obstacle("dart").unwrap().pieces.len(), 1, "convex again");
    let place = editor.world().places[0].name.clone();
    editor.apply(&Op::Drag { name: place.clone(), handle: 0, to: p(3.0, 3.0) }).unwrap();
    editor.apply(&Op::Drag { name: place.clone(), handle: 1, to: p(3.0, 9.0) }).unwrap();
    let pose = editor.world().place(&place).unwrap().pose;
    assert_eq!((pose.x, pose.y, pose.theta), (3.0, 3.0, std::f64::consts::FRAC_PI_2));
    assert!((editor.handles(&place)[1].at - p(3.0, 3.5)).norm() < 1e-12, "half a metre of ten");
}

#[test]
fn what_is_moved_stays_readable() {
    let mut editor = Editor::new(World::lot());
    let triangle = EditShape::Polygon(vec![p(7.0, 4.5), p(9.0, 4.5), p(8.0, 6.0)]);
    editor.apply(&Op::Add { name: name("island"), shape: triangle }).unwrap();
    editor.apply(&Op::Move { name: name("island"), by: Vector2::new(5.45, -2.75) }).unwrap();
    let line = editor.text().lines().find(|l| l.contains("island")).unwrap().trim().to_owned();
    assert_eq!(line, "(name: \"island\", shape: Polygon([(12.45, 1.75), (14.45, 1.75), (13.45, 3.25)])),");
}

#[test]
fn comments_are_counted_before_they_are_dropped() {
    let text = World::workbench().to_ron();
    let noted = format!("// mine\n{text}");
    let mut editor = Editor::open("w.ron", &noted).unwrap();
    assert_eq!((editor.comments(), editor.is_saved()), (1, false));
    assert_eq!(editor.text(), text);
    editor.mark_saved();
    assert_eq!(editor.comments(), 0);
    assert_eq!(Editor::open("w.ron", &text).unwrap().comments(), 0);
}

#[test]
fn starts_in_contact_are_reported() {
    let mut editor = Editor::new(World::lot());
    assert!(editor.warnings().is_empty());
    editor.apply(&Op::Move { name: name("the west pillar"), by: Vector2::new(1.0, -2.4) }).unwrap();
    assert_eq!(editor.warnings(), ["Hitch would overlap the west pillar at its start"]);
}

#[test]
fn points_snap_to_corners_first_and_then_to_the_grid() {
    let corners = [p(1.0, 1.0), p(1.06, 1.0)];
    assert_eq!(snap(p(1.04, 1.01), &corners, 0.1, 0.25), corners[1]);
    assert_eq!(snap(p(1.19, 12.44), &[], 0.0, 0.05), p(1.2, 12.45), "as it is written");
    let on_grid = snap(p(1.30, 0.88), &corners, 0.1, 0.25);
    assert_eq!(on_grid, p(1.25, 1.0));
    assert_eq!(snap(p(1.3, 0.9), &corners, 0.1, 0.0), p(1.3, 0.9));
}

/// A sled that stands anywhere but beyond x = 9: a box 1 m long and 0.6 m wide, its middle at x, y.
fn sleds() -> Kinds {
    static SLED: RobotKind = RobotKind { name: "x-sled", coordinates: &["x", "y", "wear"], ..RobotKind::REACH };
    static CLAW: RobotKind = RobotKind { name: "x-claw", coordinates: &["grip"], ..RobotKind::REACH };
    Kinds::default().with("x-sled", &SLED).with("x-claw", &CLAW).with_footprint("x-sled", |q| {
        let &[x, y, _] = q else { return None };
        let corner = |side: f64| p(side * 0.5, side * 0.3);
        (x <= 9.0).then(|| Footprint::rects([(Pose2::new(x, y, 0.0), corner(-1.0), corner(1.0))]))
    })
}

/// The Lot with a sled and a claw.
fn yard() -> World {
    let mut world = World::lot();
    world.robots.push(Resident::new("Sled", "x-sled", [3.0, 2.5, 0.7]));
    world.robots.push(Resident::new("Claw", "x-claw", [1.0]));
    world
}

#[test]
fn robots_of_kinds_that_the_editor_knows_are_moved() {
    let start = |editor: &Editor| editor.world().robots[1].start.clone();
    let by = |x, y| Op::Move { name: name("Sled"), by: Vector2::new(x, y) };
    // who does not know the kind can't say what its coordinates are
    let mut stranger = Editor::new(yard());
    assert!(matches!(stranger.apply(&by(1.0, 0.0)), Err(EditError::NoShape(name)) if name == "Sled"));
    let mut editor = stranger.knowing(sleds());
    editor.apply(&by(1.1, -0.2)).unwrap();
    assert_eq!(start(&editor), [4.1, 2.3, 0.7], "the place moves, and nothing else");
    assert_eq!(World::parse("w.ron", &editor.text()).unwrap(), *editor.world());
    assert_eq!(editor.handles("Sled").iter().map(|h| h.at).collect::<Vec<_>>(), [p(4.1, 2.3)], "a place, no heading");
    assert!(editor.handles("Claw").is_empty() && editor.holds("Claw"));
    // to where no run would start it, it is not moved
    let refused = editor.apply(&by(5.0, 0.0)).unwrap_err();
    assert!(matches!(&refused, EditError::NoConfiguration(name) if name == "Sled"), "{refused:?}");
    assert_eq!(refused.to_string(), "\"Sled\" can't start there");
    assert_eq!(start(&editor), [4.1, 2.3, 0.7]);
    editor.apply(&by(4.9, 0.0)).unwrap();
    assert_eq!(start(&editor), [9.0, 2.3, 0.7]);
    // a kind without a place has no shape to move
    let claw = Op::Move { name: name("Claw"), by: Vector2::new(0.1, 0.0) };
    assert!(matches!(editor.apply(&claw), Err(EditError::NoShape(name)) if name == "Claw"));
    // the lab's robots move as ever
    editor.apply(&Op::Move { name: name("Hitch"), by: Vector2::new(0.25, 0.0) }).unwrap();
    assert!(editor.undo() && editor.undo() && editor.undo() && !editor.undo());
    assert_eq!(start(&editor), [3.0, 2.5, 0.7]);
    // opened from a file it is the same
    let mut opened = Editor::open("yard.ron", &yard().to_ron()).unwrap().knowing(sleds());
    opened.apply(&by(1.1, -0.2)).unwrap();
    assert_eq!(start(&opened), [4.1, 2.3, 0.7]);
}

#[test]
fn starts_of_kinds_that_the_editor_knows_are_warned_of() {
    let warned = |start: [f64; 3], kinds: Kinds| {
        let mut world = yard();
        world.robots[1].start = start.to_vec();
        Editor::new(world).knowing(kinds).warnings()
    };
    let none: [&str; 0] = [];
    assert_eq!(warned([3.0, 2.5, 0.7], sleds()), none);
    // its middle 0.49 m from the west curb's face, and its end 0.01 m in it
    assert_eq!(warned([0.49, 5.0, 0.0], sleds()), ["Sled would overlap the west curb at its start"]);
    assert_eq!(warned([0.51, 5.0, 0.0], sleds()), none);
    assert_eq!(warned([9.5, 5.0, 0.0], sleds()), ["Sled: its start is no configuration of the kind \"x-sled\""]);
    assert_eq!(warned([0.49, 5.0, 0.0], Kinds::default()), none, "nobody knows its footprint");
    // in the car it is in the way of both
    let Resident { start, .. } = &World::lot().robots[0];
    let both = warned([start[0], start[1], 0.0], sleds());
    assert_eq!(both, ["Hitch would overlap Sled at its start", "Sled would overlap Hitch at its start"]);
}

#[test]
fn a_door_is_moved_by_itself_and_by_its_ends() {
    let mut editor = Editor::new(World::apartment());
    let door = |editor: &Editor| editor.world().door("door B").unwrap().clone();
    let handles = |editor: &Editor| editor.handles("door B").iter().map(|h| (h.index, h.at)).collect::<Vec<_>>();
    // the gap of door B
    assert_eq!(handles(&editor), [(0, p(5.5625, 4.75)), (1, p(6.4375, 4.75))]);
    assert!(editor.handles("door B").iter().all(|h| !h.makes_corner));
    editor.apply(&Op::Move { name: name("door B"), by: Vector2::new(0.0, 0.25) }).unwrap();
    editor.apply(&Op::Drag { name: name("door B"), handle: 1, to: p(6.5, 5.5) }).unwrap();
    assert_eq!(handles(&editor), [(0, p(5.5625, 5.0)), (1, p(6.5, 5.5))]);
    editor.apply(&Op::Drag { name: name("door B"), handle: 0, to: p(5.5, 5.25) }).unwrap();
    editor.apply(&Op::Drag { name: name("door B"), handle: 2, to: p(1.0, 1.0) }).unwrap();
    assert_eq!((door(&editor).a, door(&editor).b, door(&editor).open), (p(5.5, 5.25), p(6.5, 5.5), true));
    // a door without a length is no door, and it has no other shape
    let before = editor.world().clone();
    assert!(editor.apply(&Op::Drag { name: name("door B"), handle: 1, to: p(5.5, 5.25) }).is_err());
    assert!(editor.apply(&Op::Reshape { name: name("door B"), shape: boxed(0.0, 0.0, 1.0, 1.0) }).is_err());
    assert_eq!(*editor.world(), before);
    // what is selected is its gap, open or not, with a handle at each end
    let items = editor.selected_items("door B");
    assert_eq!(items.iter().map(|i| i.id.as_str()).collect::<Vec<_>>(), ["selected", "handle/0", "handle/1"]);
    let Drawing::Region { outline, .. } = &items[0].drawing else { panic!("a region") };
    assert_eq!(*outline, [vec![p(5.5, 5.25), p(6.5, 5.5)]]);
    (0..3).for_each(|_| assert!(editor.undo()));
    assert_eq!(*editor.world(), World::apartment());
}
