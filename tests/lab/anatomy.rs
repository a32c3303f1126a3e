//! The anatomy from outside: its snippets of code are compiled and run here, and its commands are run.

use std::path::Path;

use motion_lab::anatomy::{Anatomy, Tab, WorldSource};
use motion_lab::collision::Collision;
use motion_lab::configuration::Sizes;
use motion_lab::num::sqrt;
use motion_lab::robots::AnyRobot;
use motion_lab::worlds::{Resident, World};

/// Each snippet is a program of its own, checked in as the anatomy copies it. Its `main` fails on numbers other than
/// those shown.
macro_rules! snippets {
    ($($name:ident),*) => {
        $(#[allow(clippy::approx_constant, clippy::excessive_precision, clippy::unreadable_literal)]
        mod $name {
            include!(concat!("../snippets/", stringify!($name), ".rs"));

            pub fn run() {
                main().unwrap();
            }
        })*

        const SNIPPETS: &[(&str, &str, fn())] =
            &[$((stringify!($name), include_str!(concat!("../snippets/", stringify!($name), ".rs")), $name::run)),*];
    };
}
snippets!(
    intersects,
    distance,
    witness,
    swept,
    thick_distance,
    car_swept,
    own_world_witness,
    disc_witness,
    own_car_swept
);

/// The anatomy from which a snippet is copied.
fn source_of(name: &str) -> Anatomy {
    let of = |world: &str| {
        let at = World::built_in_names().into_iter().find(|n| *n == world).unwrap();
        Anatomy::of_world(World::built_in(world).unwrap(), WorldSource::BuiltIn(at)).unwrap()
    };
    let mut anatomy = Anatomy::default();
    match name {
        "intersects" => anatomy.with_tab(Tab::Intersects),
        "distance" => anatomy.with_tab(Tab::Distance),
        "witness" => anatomy.with_tab(Tab::Witness),
        "swept" => anatomy.with_tab(Tab::Swept),
        "thick_distance" => {
            anatomy.set_thick_links(true);
            anatomy.with_tab(Tab::Distance)
        }
        "car_swept" => of("lot").with_tab(Tab::Swept),
        "own_world_witness" => {
            let mut world = World::lot();
            world.obstacles[4].name = "a \"#quoted\"# pillar".into();
            let (car, q) = AnyRobot::of_kind("hitch", &[6.5, 2.5, 0.25, -0.5]).unwrap();
            Anatomy::new(world, WorldSource::Unsaved, car, q).unwrap().with_tab(Tab::Witness)
        }
        "disc_witness" => of("apartment").with_tab(Tab::Witness),
        "own_car_swept" => {
            let mut world = World::lot();
            let Some(Sizes::Car(mut car)) = Sizes::of_kind("hitch") else { panic!("a car") };
            (car.width, car.max_steer, car.trailer.hitch_len) = (1.25, 0.5, 2.75);
            world.robots[0] = Resident::new("Hitch", "hitch", [6.5, 2.5, 0.25, -0.5]).with_sizes(Sizes::Car(car));
            Anatomy::of_world(world, WorldSource::Unsaved).unwrap().with_tab(Tab::Swept)
        }
        other => panic!("no source for {other}"),
    }
}

#[test]
fn copied_code_compiles_runs_and_finds_the_numbers_shown() {
    for (name, checked_in, run) in SNIPPETS {
        let copied = source_of(name).copy_as_rust();
        if std::env::var_os("MOTION_LAB_WRITE_SNIPPETS").is_some() {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/snippets/{name}.rs"));
            std::fs::write(path, &copied).unwrap();
            continue;
        }
        assert_eq!(&copied, checked_in, "{name}: MOTION_LAB_WRITE_SNIPPETS=1 writes them anew; then run this again");
        run();
    }
    // the snippets hold the numbers shown, and these are the chapter's
    let (_, text, _) = SNIPPETS.iter().find(|(name, ..)| *name == "distance").unwrap();
    let claimed = text.split("assert_eq!(distance, ").nth(1).unwrap().split(')').next().unwrap();
    assert!((claimed.parse::<f64>().unwrap() - (1.5 / sqrt(2.0) - 1.0)).abs() < 1e-9, "{claimed}");
}

#[test]
fn copied_commands_print_the_numbers_shown() {
    for tab in Tab::ALL {
        let anatomy = Anatomy::default().with_tab(tab);
        let command = anatomy.copy_as_command().unwrap();
        let words: Vec<&str> = command.split(' ').skip(1).collect();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_motion-lab")).args(&words).output().unwrap();
        assert!(output.status.success(), "{command}");
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        match tab {
            Tab::Intersects => assert_eq!(answer["intersects"].as_bool(), Some(anatomy.intersects())),
            Tab::Distance => assert_eq!(answer["distance"].as_f64(), Some(anatomy.distance())),
            Tab::Witness => {
                let shown = anatomy.checker().scene().witness(&anatomy.footprint()).unwrap();
                assert_eq!(answer["witness"]["dist"].as_f64(), Some(shown.dist));
                assert_eq!(answer["witness"]["on_robot"][0].as_f64(), Some(shown.on_robot.x));
            }
            Tab::Swept => {
                assert_eq!(answer["edge"].as_str(), Some("hit"));
                assert_eq!(answer["obstacle"].as_str(), Some("the block"));
            }
        }
    }
}
