//! What residents are: read, completed, refused by file, line and reason, and printed.

use crate::configuration::{ArmSizes, CarSizes, DiscSizes, RobotKind, Sizes, TrailerSizes};
use crate::geometry::Point2;
use crate::worlds::{Resident, World};

/// A file with this robot in its third line.
fn file(robot: &str) -> String {
    format!("World(version: 1, name: \"yard\",\n  bounds: (min: (0, 0), max: (4, 3)), robots: [\n  ({robot}),\n])")
}

/// The robot's sizes as read; the printed world reads back as the same world and the same text.
fn read(robot: &str) -> Option<Sizes> {
    let world = World::parse("yard.ron", &file(robot)).unwrap();
    let printed = world.to_ron();
    let again = World::parse("printed", &printed).unwrap();
    assert_eq!((&again, again.to_ron()), (&world, printed), "{robot}");
    world.robots[0].sizes.clone()
}

/// Why the robot is refused; the place is its own.
fn refusal(robot: &str) -> String {
    let error = World::parse("yard.ron", &file(robot)).unwrap_err().to_string();
    error.strip_prefix("yard.ron:3:3: robots[0] \"r\": ").unwrap_or_else(|| panic!("{error}")).to_owned()
}

const RUSTY: &str = "name: \"r\", kind: \"rusty\", start: [1, 2, 0]";
const REACH: &str = "name: \"r\", kind: \"reach\", start: [0.1, 0.2]";
const HITCH: &str = "name: \"r\", kind: \"hitch\", start: [1, 2, 0]";

#[test]
fn numbers_given_are_the_robots_and_the_others_its_kinds() {
    let disc = |radius, track, wheel_radius| Some(Sizes::Disc(DiscSizes { radius, track, wheel_radius }));
    assert_eq!(read(RUSTY), None);
    assert_eq!(read(&format!("{RUSTY}, disc: ()")), disc(0.11, 0.16, 0.033));
    assert_eq!(read(&format!("{RUSTY}, disc: (radius: 0.2, track: 0.3)")), disc(0.2, 0.3, 0.033));
    assert_eq!(read(&format!("{RUSTY}, sensor: (), disc: (wheel_radius: 0.05)")), disc(0.11, 0.16, 0.05));
    let arm = |x, y, lengths: &[f64], radius| {
        Some(Sizes::Arm(ArmSizes { base: Point2::new(x, y), lengths: lengths.to_vec(), radius }))
    };
    let text = format!("{REACH}, arm: (base: (-0.0, 2), lengths: [0.5, 0.4], radius: 0)");
    assert_eq!(read(&text), arm(0.0, 2.0, &[0.5, 0.4], 0.0));
    assert_eq!(read(&format!("{REACH}, arm: (base: (1, 2))")), arm(1.0, 2.0, &[1.0, 1.0], 0.03));
    let three = "name: \"r\", kind: \"reach3\", start: [0, 0, 0], arm: (lengths: [3, 2, 1])";
    assert_eq!(read(three), arm(0.0, 0.0, &[3.0, 2.0, 1.0], 0.03));
    let trailer = TrailerSizes { hitch_len: 3.0, width: 1.5, front_overhang: 1.0, rear_overhang: 0.0, jackknife: None };
    let car = CarSizes { wheelbase: 2.0, length: 3.9, width: 1.7, rear_overhang: 0.5, max_steer: 0.4, trailer };
    let given = "wheelbase: 2, rear_overhang: 0.5, max_steer: 0.4, trailer: (hitch_len: 3, rear_overhang: -0.0)";
    assert_eq!(read(&format!("{HITCH}, car: ({given})")), Some(Sizes::Car(car)));
}

#[test]
fn the_print_says_every_number_and_nothing_for_none() {
    let line = |robot: &str| {
        let printed = World::parse("yard.ron", &file(robot)).unwrap().to_ron();
        printed.lines().find(|l| l.contains("kind:")).unwrap().trim().to_owned()
    };
    // as it was before worlds could say sizes
    assert_eq!(line(RUSTY), "(name: \"r\", kind: \"rusty\", start: [1.0, 2.0, 0.0]),");
    assert_eq!(
        line(&format!("{RUSTY}, disc: (radius: 0.2), sensor: (z_miss: 0.5)")),
        "(name: \"r\", kind: \"rusty\", start: [1.0, 2.0, 0.0], disc: (radius: 0.2, track: 0.16, wheel_radius: 0.033), \
         sensor: (sigma_hit: 0.0, z_short: 0.0, lambda_short: 1.0, z_miss: 0.5, z_max: 0.0, z_rand: 0.0)),"
    );
    assert_eq!(
        line(&format!("{REACH}, arm: (base: (-0.0, 1), lengths: [0.5, 0.4])")),
        "(name: \"r\", kind: \"reach\", start: [0.1, 0.2], arm: (base: (0.0, 1.0), lengths: [0.5, 0.4], radius: 0.03)),"
    );
    assert_eq!(
        line(&format!("{HITCH}, car: (trailer: (width: 1))")),
        "(name: \"r\", kind: \"hitch\", start: [1.0, 2.0, 0.0], car: (wheelbase: 2.5, length: 3.9, width: 1.7, \
         rear_overhang: 0.7, max_steer: 0.6, trailer: (hitch_len: 2.0, width: 1.0, front_overhang: 1.0, \
         rear_overhang: 0.8))),"
    );
    let hash = |robot: &str| World::parse("yard.ron", &file(robot)).unwrap().content_hash();
    assert_ne!(hash(&format!("{RUSTY}, disc: (radius: 0.2)")), hash(&format!("{RUSTY}, disc: (radius: 0.21)")));
    // a world assembled by hand prints no negative zero either
    let sizes = ArmSizes { base: Point2::new(-0.0, 0.0), lengths: vec![1.0, 1.0], radius: -0.0 };
    let resident = Resident::new("r", "reach", [0.0, 0.0]).try_with_sizes(Sizes::Arm(sizes)).unwrap();
    let world = World { robots: vec![resident], ..World::workbench() };
    assert!(world.to_ron().contains("arm: (base: (0.0, 0.0), lengths: [1.0, 1.0], radius: 0.0)"));
}

#[test]
fn numbers_out_of_range_are_named() {
    let range = "it must be from 0.001 to 1000";
    for (robot, bad, least) in [
        (RUSTY, "disc: (radius: {})", range),
        (RUSTY, "disc: (track: {})", range),
        (RUSTY, "disc: (wheel_radius: {})", range),
        (REACH, "arm: (radius: {})", range),
        (HITCH, "car: (wheelbase: {})", "it must be from 0.1 to 1000"),
        (HITCH, "car: (length: {})", range),
        (HITCH, "car: (width: {})", range),
        (HITCH, "car: (rear_overhang: {})", "it must be from 0 to 1000"),
        (HITCH, "car: (max_steer: {})", "it must be from 0.001 to 1.5"),
        (HITCH, "car: (trailer: (hitch_len: {}))", "it must be from 0.1 to 1000"),
        (HITCH, "car: (trailer: (width: {}))", range),
        (HITCH, "car: (trailer: (front_overhang: {}))", "it must be from 0 to 1000"),
        (HITCH, "car: (trailer: (rear_overhang: {}))", "it must be from 0 to 1000"),
    ] {
        let path = bad.replace(": ((", ".").replace(": (", ".").split(": {}").next().unwrap().to_owned();
        for (written, shown) in [("NaN", "NaN"), ("inf", "inf"), ("-1", "-1"), ("1000.1", "1000.1"), ("1e999", "inf")] {
            let error = refusal(&format!("{robot}, {}", bad.replace("{}", written)));
            assert_eq!(error, format!("{path} {shown}: {least}"), "{bad} {written}");
        }
    }
    for (bad, reason) in [
        ("arm: (lengths: [0.5, 0])", "arm.lengths[1] 0: it must be from 0.001 to 1000"),
        ("arm: (lengths: [NaN, 1])", "arm.lengths[0] NaN: it must be from 0.001 to 1000"),
        ("arm: (radius: 0.0009)", "arm.radius 0.0009: it must be from 0.001 to 1000"),
        ("arm: (base: (0, 10000.1))", "arm.base.1 10000.1: it must be from -10000 to 10000"),
        ("arm: (base: (-inf, 0))", "arm.base.0 -inf: it must be from -10000 to 10000"),
        ("arm: (lengths: [1])", "arm.lengths: 1 links, a reach has 2"),
        ("arm: (lengths: [1, 1, 1])", "arm.lengths: 3 links, a reach has 2"),
    ] {
        assert_eq!(refusal(&format!("{REACH}, {bad}")), reason);
    }
    let limits = "disc: (radius: 0.001, track: 1000, wheel_radius: 1e3)";
    assert!(read(&format!("{RUSTY}, {limits}")).is_some(), "the ends of a range belong to it");
    assert!(read(&format!("{HITCH}, car: (max_steer: 1.5, wheelbase: 0.1, rear_overhang: 0)")).is_some());
}

#[test]
fn numbers_that_do_not_fit_together() {
    assert_eq!(
        refusal(&format!("{HITCH}, car: (wheelbase: 3.5)")),
        "car: a length of 3.9 m does not reach from 0.7 m behind one axle to the other, 3.5 m on"
    );
    assert!(read(&format!("{HITCH}, car: (wheelbase: 3.5, length: 4.2)")).is_some(), "to the axle itself");
    assert_eq!(
        refusal(&format!("{HITCH}, car: (trailer: (front_overhang: 0, rear_overhang: 0.0005))")),
        "car.trailer: its overhangs are 0.0005 m in all, and no feature is smaller than 0.001 m"
    );
}

#[test]
fn sizes_of_another_sort_of_robot() {
    let x = "name: \"r\", kind: \"x-puck\", start: [0]";
    for (robot, field, reason) in [
        (RUSTY, "arm", "a rusty has no `arm`: its numbers are its `disc`"),
        (RUSTY, "car", "a rusty has no `car`: its numbers are its `disc`"),
        (REACH, "disc", "a reach has no `disc`: its numbers are its `arm`"),
        (HITCH, "arm", "a hitch has no `arm`: its numbers are its `car`"),
        (x, "disc", "`disc` is for the lab's kinds: what a x-puck is like, its program says"),
    ] {
        assert_eq!(refusal(&format!("{robot}, {field}: ()")), reason);
    }
    assert_eq!(refusal(&format!("{RUSTY}, disc: (), car: ()")), "a rusty has no `car`: its numbers are its `disc`");
    let unknown = World::parse("yard.ron", &file(&format!("{RUSTY}, disc: (weight: 3)"))).unwrap_err();
    assert!(unknown.to_string().starts_with("yard.ron:3:") && unknown.to_string().contains("weight"), "{unknown}");
    let resident = Resident::new("r", RobotKind::REACH3.name, [0.0; 3]);
    let two = Sizes::of_kind(RobotKind::REACH.name).unwrap();
    assert_eq!(resident.try_with_sizes(two).unwrap_err().to_string(), "arm.lengths: 2 links, a reach3 has 3");
}
