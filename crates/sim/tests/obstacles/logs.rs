//! Worlds with doors, scripts with changes and logs of both formats, as files.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_sim::recording::{Run, verify};
use motion_lab_sim::run::Digest;

use super::*;

#[test]
fn a_world_with_doors_is_read_printed_and_checked() {
    let file = |doors: &str| {
        format!("World(version: 1, name: \"hall\", bounds: (min: (0, 0), max: (4, 3)),\n  doors: [{doors}])")
    };
    let good =
        "(name: \"a\", hinge: (1, 0), end: (1, 2), open: true), (name: \"b\", hinge: (3, 0), end: (3, 2), open: false)";
    let world = World::parse("hall.ron", &file(good)).unwrap();
    assert_eq!(World::parse("hall.ron", &world.to_ron()).unwrap(), world);
    let at = |x| Scene::of_world(&world).distance(&Footprint::disc(Point2::new(x, 1.0), 0.5));
    assert_eq!((at(1.0), at(2.0)), (1.5, 0.5), "the open door is nothing, the closed one a wall");
    for (bad, why) in [
        ("(name: \"a\", hinge: (1, 0), end: (1, 0), open: true)", "hall.ron:2:11: doors[0] \"a\": length 0 m"),
        (
            "(name: \"a\", hinge: (1, 0), end: (1, 1e9), open: true)",
            "hall.ron:2:11: doors[0] \"a\": point (1, 1000000000): coordinates",
        ),
        ("(name: \"\", hinge: (1, 0), end: (1, 2), open: true)", "hall.ron:2:11: doors[0]: name"),
        ("(name: \"a\", hinge: (1, 0), end: (1, 2))", "hall.ron:2:"),
    ] {
        let error = World::parse("hall.ron", &file(bad)).unwrap_err().to_string();
        assert!(error.starts_with(why), "{error}");
    }
    let twice = file(&format!("{good}, (name: \"a\", hinge: (1, 0), end: (1, 2), open: true)"));
    assert!(World::parse("hall.ron", &twice).unwrap_err().to_string().contains("the name is taken by doors[0]"));
    // a world without doors does not mention them
    assert!(!World::lot().to_ron().contains("doors"));
}

#[test]
fn the_apartment_has_five_open_doors_in_its_gaps() {
    let world = World::apartment();
    assert_eq!(
        world.doors.iter().map(|d| d.name.as_str()).collect::<Vec<_>>(),
        ["door A", "door B", "door C", "door D", "door E"]
    );
    for door in &world.doors {
        assert!(door.open && (door.b - door.a).norm() == 0.875);
        // each end is the end of a wall, and the place of the same name lies in the middle
        let corner = |p: Point2| world.obstacles.iter().any(|o| o.placed().any(|s| s.core().contains(&p)));
        assert!(corner(door.a) && corner(door.b), "{}", door.name);
        let letter = &door.name[5..];
        let place = world.place(&format!("{letter}'s door")).unwrap().pose.position();
        assert_eq!(door.a + (door.b - door.a) * 0.5, place);
    }
    // closed, the rooms are closed off: nobody sees through
    let mut closed = world.clone();
    closed.doors.iter_mut().for_each(|d| d.open = false);
    let edge = |world: &World| {
        let checker = motion_lab_core::collision::Checker::new(Scene::of_world(world), RustyDisc::default());
        checker.edge_free(&R2(Point2::new(2.9375, 5.25)), &R2(Point2::new(2.9375, 4.25)))
    };
    assert!(edge(&world) && !edge(&closed));
}

#[test]
fn grids_pictures_and_the_editor_know_doors() {
    let mut world = World::apartment();
    let cell = |world: &World| {
        let grid = motion_lab_core::worlds::Grid::rasterize(world, 0.125).unwrap();
        let (column, row) = grid.cell_at(Point2::new(3.0, 4.75)).unwrap();
        grid.is_occupied(column, row)
    };
    let ids = |world: &World| {
        let picture = motion_lab_core::picture::world(world);
        let doors = picture.items.iter().filter(|i| i.id.starts_with("door/"));
        doors.map(|i| i.id.clone()).collect::<Vec<_>>()
    };
    assert!(!cell(&world));
    assert_eq!(ids(&world)[..2], ["door/door A", "door/door A/leaf"], "an open one shows its leaf");
    world.doors[0].open = false;
    assert!(cell(&world));
    assert_eq!(ids(&world)[..2], ["door/door A", "door/door B"]);

    use motion_lab_core::geometry::Vector2;
    use motion_lab_sim::atlas::{Editor, Op};
    let mut editor = Editor::new(World::apartment());
    let by = Vector2::new(0.25, -0.5);
    editor.apply(&Op::Move { name: "door A".into(), by }).unwrap();
    editor.apply(&Op::Rename { name: "door A".into(), to: "the gate".into() }).unwrap();
    editor.apply(&Op::Delete { name: "door B".into() }).unwrap();
    let doors = &editor.world().doors;
    assert_eq!((doors[0].name.as_str(), doors.len()), ("the gate", 4));
    assert_eq!((doors[0].a, doors[0].b), (Point2::new(2.75, 4.25), Point2::new(3.625, 4.25)));
    let taken = editor.apply(&Op::Rename { name: "the gate".into(), to: "door C".into() });
    assert!(taken.unwrap_err().to_string().contains("taken"));
}

/// The whole way of a jackknife limit: from the file to the run.
#[test]
fn a_car_is_held_at_the_jackknife_limit_that_its_world_says() {
    let file = |limit: &str| {
        format!(
            "World(version: 1, name: \"yard\", bounds: (min: (-20, -20), max: (20, 20)), robots: [\n\
             (name: \"Lorry\", kind: \"hitch\", start: [0, 0, 0, 0], car: (trailer: ({limit})))])"
        )
    };
    let run = |limit: &str| {
        let world = World::parse("yard.ron", &file(limit)).unwrap();
        assert_eq!(World::parse("again", &world.to_ron()).unwrap(), world);
        let events = vec![crate::simulator::event(1, "Lorry", motion_lab_sim::run::RobotInput::Drive(-128, 128))];
        let script = Script::new(events, vec![]);
        Run::record(TourConfig { worlds: vec![world], ticks: 200, sensor: None }, (Seed(1), script)).unwrap()
    };
    let fold = |log: &Log| {
        let fold = |f: &Frame| {
            let q = &f.robots[0].configuration;
            motion_lab_core::num::wrap(q[3] - q[2]).abs()
        };
        log.frames().iter().map(fold).fold(0.0, |a, b| if b > a { b } else { a })
    };
    // backward with full lock the trailer folds, past a right angle
    let free = run("");
    assert!(fold(&free) > 1.6 && free.frames().iter().all(|f| f.robots[0].contacts == 0), "{}", fold(&free));
    let held = run("jackknife: 0.75");
    assert!((0.75 - 1e-3..=0.75).contains(&fold(&held)), "{}", fold(&held));
    assert_eq!(held.frames()[199].robots[0].contacts, 1);
    assert!(verify(&held, |_| {}).unwrap().difference.is_none());
    for (bad, why) in [("jackknife: 0", "car.trailer.jackknife 0"), ("jackknife: 3.2", "it must be from 0.001 to 3.1")]
    {
        let error = World::parse("yard.ron", &file(bad)).unwrap_err().to_string();
        assert!(error.starts_with("yard.ron:2:1: robots[0] \"Lorry\": ") && error.contains(why), "{error}");
    }
    let folded = file("jackknife: 0.75").replace("[0, 0, 0, 0]", "[0, 0, 0, 0.8]");
    let config = TourConfig { worlds: vec![World::parse("yard.ron", &folded).unwrap()], ticks: 1, sensor: None };
    assert!(Run::record(config, Seed(1)).unwrap_err().to_string().contains("is no configuration of a hitch"));
}

#[test]
fn scripts_with_changes_have_one_text_and_errors_with_a_line() {
    let text = "Script(version: 2, events: [(tick: 3, robot: \"Rusty\", input: Release)], changes: [\n\
        (tick: 1, world: \"Apartment\", change: Close(\"door A\")),\n\
        (tick: 1, world: \"Apartment\", change: Add(name: \"post\", points: [(1048576, 0), (0, 5)], radius: 1049)),\n\
        (tick: 4, world: \"Apartment\", change: Move(name: \"post\", to: (1, -2, 3))),\n\
        (tick: 5, world: \"Apartment\", change: Remove(\"post\")),\n\
        (tick: 9, world: \"Apartment\", change: Open(\"door A\")),\n])";
    let script = Script::parse("s.ron", text).unwrap();
    assert_eq!((script.version, script.changes.len()), (2, 5));
    for text in [script.to_ron(), script.to_line()] {
        assert_eq!(Script::parse("again", &text).unwrap(), script);
    }
    assert!(!script.to_line().replace("door A", "").contains(' '));
    script.check().unwrap();
    script.check_worlds(&[World::apartment(), World::lot()]).unwrap();
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from));
        Script::parse("s.ron", &text.replacen(from, to, 1)).unwrap_err().to_string()
    };
    assert_eq!(refused("version: 2", "version: 1"), "s.ron:1: changes need version 2");
    assert_eq!(refused("version: 2", "version: 3"), "s.ron:1: version 3: this program reads versions 1 and 2");
    assert_eq!(refused("tick: 9", "tick: 2"), "s.ron:6: changes[4]: tick 2 comes after tick 5: ticks must ascend");
    assert_eq!(refused("tick: 1,", "tick: 0,"), "s.ron:2: changes[0]: tick 0: it must be in 1 to 4294967296");
    assert!(refused("radius: 1049", "radius: 1").starts_with("s.ron:3: changes[1]: no shape: radius"));
    assert!(refused("(0, 5)", "(1048576, 5)").starts_with("s.ron:3: changes[1]: no shape: length"));
    assert!(refused("[(1048576, 0), (0, 5)]", "[]").contains("0 coordinates"));
    assert!(refused("name: \"post\", p", "name: \" post\", p").contains("name \" post\""));
    assert!(refused("to: (1", "to: (99999999999999").contains("coordinate 99999999999999"));
    assert!(refused("Close(", "Slam(").starts_with("s.ron:2: changes[0]: "));
    // an empty list of changes is a script of version 1
    let none = Script::parse("s.ron", "Script(version: 2, events: [])").unwrap();
    assert_eq!((none.version, none.to_ron()), (1, Script::empty().to_ron()));
    let mut wrong = script.clone();
    wrong.version = 1;
    assert_eq!(wrong.check().unwrap_err().to_string(), "version 1: this program reads versions 1 and 2");
}

#[test]
fn changes_that_fit_no_world_are_refused_with_their_number() {
    let check = |of: &[(u64, WorldChange)], worlds: &[World]| {
        let problem = changes(of).check_worlds(worlds);
        problem.map_err(|e| e.to_string()).err().unwrap_or_default()
    };
    let worlds = [World::apartment(), World::workbench()];
    let bed = || WorldChange::Remove("A's bed".into());
    assert_eq!(check(&[(1, bed()), (2, bed()), (3, close())], &worlds), "");
    assert_eq!(check(&[(1, bed())], &worlds[1..]), "changes[0]: there is no world \"Apartment\"");
    let twins = [World::apartment(), World::apartment()];
    assert!(check(&[(1, bed())], &twins).starts_with("changes[0]: two worlds are named \"Apartment\""));
    let problem = check(&[(1, bed()), (1, WorldChange::Open("A's bed".into()))], &worlds);
    assert_eq!(problem, "changes[1]: there is no door \"A's bed\" in world \"Apartment\"");
    let problem = check(&[(1, WorldChange::Remove(DOOR.into()))], &worlds);
    assert_eq!(problem, "changes[0]: there is no obstacle \"door A\" in world \"Apartment\"");
    for taken in ["A's bed", DOOR, "room A", "tour", "Rusty"] {
        let points = vec![(quantized(1.0), quantized(1.0))];
        let add = WorldChange::Add { name: taken.into(), points, radius: quantized(0.1) };
        assert!(check(&[(1, add)], &worlds).contains("is taken"), "{taken}");
    }
    let refused = Run::record(apartment(5), (Seed(1), changes(&[(1, WorldChange::Open("no".into()))])));
    assert!(refused.unwrap_err().to_string().contains("there is no door \"no\""));
}

/// The tour's digest from before there were doors: a world without any is hashed as it was.
#[test]
fn without_its_doors_the_apartment_gives_the_runs_of_before() {
    let mut config = TourConfig::default();
    config.worlds[0].doors.clear();
    let log = Run::record(config, Seed(2005)).unwrap();
    assert_eq!(log.digest().unwrap().to_string(), "0bb02527c35c8209705687d8b4b8dc5d");
}

/// The words of the encoding, by its documentation.
#[test]
fn a_frame_with_a_closed_door_says_so_behind_its_scans() {
    let log = Run::record(apartment(2), (Seed(1), changes(&[(2, close())]))).unwrap();
    let words = |frame: &Frame| {
        let mut bytes = Vec::new();
        frame.encode(&mut bytes);
        bytes.as_chunks::<8>().0.iter().map(|c| u64::from_le_bytes(*c)).collect::<Vec<_>>()
    };
    let (open, closed) = (words(&log.frames()[0]), words(&log.frames()[1]));
    assert_eq!(closed.len(), open.len() + 7);
    let number = World::apartment().obstacles.len() as u64;
    assert_eq!(closed[open.len()..], [(1 << 63) + 1, 0, number, 1, 0, 0, 0]);
    let mut other = log.frames()[1].clone();
    other.obstacles.clear();
    let difference = motion_lab_sim::run::first_divergence(&[log.frames()[1].clone()], &[other]).unwrap();
    assert_eq!(difference.field, "obstacles.len");
}

/// A log of each format, kept as files of before logs sealed their digest: both are read, and give the run again.
#[test]
fn logs_of_both_formats_are_read() {
    let kept: [(&str, &[u8], &str); 2] = [
        ("1", include_bytes!("../../../../tests/samples/format_1.mcap"), "9ab7b3944e9569d692ddfd19084a7073"),
        ("2", include_bytes!("../../../../tests/samples/format_2.mcap"), "b35e9308ac36b5165806ac0b317ebd7a"),
    ];
    for (format, file, digest) in kept {
        let read = Log::read_mcap(file).unwrap();
        assert_eq!(verify(&read.log, |_| {}).unwrap().identical, read.log.recipe.config.ticks, "format {format}");
        let Digest(found) = read.log.digest().unwrap();
        assert_eq!(format!("{found:032x}"), digest, "format {format}");
        let mut again = Vec::new();
        read.log.write_mcap(&mut again).unwrap();
        let text = String::from_utf8_lossy(file);
        assert!(text.contains(&format!("format\u{1}\0\0\0{format}")));
        // all but the end is written as it was, byte for byte: there 0x82, a length and the digest come before 0x0f
        let same = again.iter().zip(file).take_while(|(a, b)| a == b).count();
        let record = [&[0x82][..], &16_u64.to_le_bytes(), &found.to_le_bytes()].concat();
        assert!(file[same..].starts_with(&[0x0f, 4, 0, 0, 0, 0, 0, 0, 0]), "format {format}");
        assert!(again[same..].starts_with(&record), "format {format}");
        assert_eq!((read.sealed, Log::read_mcap(&again).unwrap().sealed), (None, Some(Digest(found))));
    }
}
