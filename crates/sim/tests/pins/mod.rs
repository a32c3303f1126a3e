//! Pinned runs: six runs that between them use everything, each pinned by two digests.
//!
//! **The frames' digest** covers every bit of every frame and nothing else. It may change only when robots, sensors,
//! tours or the simulator are meant to move differently, or when a frame holds something new. Then every recorded run
//! of every user stops verifying. So the change needs a reason in the issue that asks for it, and a line in
//! DIGESTS.md, beside this file, that names the run, the new digest and why.
//!
//! **The run digest** ([`motion_lab_sim::run::RunDigest`]) covers the frames, and the seed, the configuration, the
//! worlds' content and the script's text with them. It may change without the frames' digest only when the data hashed
//! before the frames changes: the print of a world or a script, or the header. Logs recorded before then still replay
//! to the same frames, but their digests, links and saved pages no longer compare. This needs the same line in
//! DIGESTS.md.
//!
//! No digest here may be replaced to make a test pass.

mod app;
pub mod recipes;

use bevy::app::App;
use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Digest, Frame, Log, LogKind, Recipe, RobotInput};
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, RobotCommand, RunCommand, SimulationPlugin, TransportCommand, start_run,
};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
use xxhash_rust::xxh3::xxh3_128;

use crate::simulator::quantized;

/// A run with its name, the digest of its frames, and the run digest.
type Pin = (&'static str, fn() -> Log, &'static str, &'static str);

const PINS: [Pin; 6] = [
    ("the tour", tour, "ce8eaab6a9369423c3ea2a39f78dad74", "f745674b9949ddd86153036592511806"),
    ("driving.ron", driving, "346ae589d05834b2831a9593787616b5", "79a1486a47c698e1eb8180aeb24a7be0"),
    ("eight robots", eight, "f4ee9937a5dd444ef5649e55b2a1473d", "cd5024290592d15c84eb14ab41dc5ec1"),
    ("a noisy sensor", noisy, "ae4c4bd8de84489f396d788e4545016e", "a41803eeac3db6423bdafe97c56aecd6"),
    ("trailer and teleport", trailer, "bad81011272189615eceab02d8f38587", "e666c13ff444e7c43f692fb6b98ea608"),
    ("branched at tick 100", branched, "d2e58f96dbea9ef5996eb0cb70c6e5d4", "dc4f780846f1c187aae6465571f64912"),
];

/// The digest of the frames alone, the initial one first: xxh3-128 of their canonical encodings one after the other.
fn frames_digest(log: &Log) -> Digest {
    let mut bytes = Vec::new();
    for frame in std::iter::once(log.initial().unwrap()).chain(log.frames()) {
        frame.encode(&mut bytes);
    }
    Digest(xxh3_128(&bytes))
}

/// The log of a recipe's run.
fn recorded(recipe: Recipe) -> Log {
    Run::record_recipe(recipe, LogKind::Frames, |_| {}).unwrap()
}

fn tour() -> Log {
    recorded(recipes::tour())
}

fn driving() -> Log {
    recorded(recipes::driving())
}

fn eight() -> Log {
    recorded(recipes::eight())
}

fn noisy() -> Log {
    recorded(recipes::noisy())
}

fn trailer() -> Log {
    recorded(recipes::trailer())
}

/// A run driven live to tick 160, taken back to tick 100 and driven otherwise from there to tick 220.
fn branched() -> Log {
    let config = TourConfig { ticks: 220, ..TourConfig::default() };
    let mut app = App::new();
    app.add_plugins((bevy::prelude::MinimalPlugins, SimulationPlugin));
    start_run(app.world_mut(), config.clone(), Seed(100)).unwrap();
    app.insert_resource(bevy::time::TimeUpdateStrategy::ManualDuration(std::time::Duration::ZERO));
    let frame = |app: &App| app.world().resource::<LatestFrame>().frame().clone();
    let initial = frame(&app);
    let drive = |app: &mut App, robot: &str, input| {
        app.world_mut().write_message(RunCommand::from(RobotCommand { robot: robot.into(), input }));
    };
    let mut frames = Vec::new();
    let steps = |app: &mut App, frames: &mut Vec<Frame>, to: usize| {
        while frames.len() < to {
            app.world_mut().write_message(RunCommand::from(TransportCommand::Step));
            app.update();
            frames.push(frame(app));
        }
    };
    steps(&mut app, &mut frames, 40);
    drive(&mut app, "Rusty", RobotInput::Drive(128, 30));
    drive(&mut app, "Hitch", RobotInput::SetTrailer(true));
    steps(&mut app, &mut frames, 90);
    drive(&mut app, "Hitch", RobotInput::Drive(-90, 40));
    steps(&mut app, &mut frames, 120);
    drive(&mut app, "Reach", RobotInput::MoveTo(quantized(&[2.0, 0.0])));
    steps(&mut app, &mut frames, 160);
    let abandoned = frames.split_off(100);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Seek(100)));
    app.update();
    assert_eq!(frame(&app), frames[99], "what is restored is what was");
    drive(&mut app, "Rusty", RobotInput::Drive(-128, 5));
    drive(&mut app, "Hitch", RobotInput::Drive(128, -64));
    steps(&mut app, &mut frames, 220);
    assert_ne!(frames[159], abandoned[59], "the branch goes elsewhere");
    let script = app.world().resource::<PendingInput>().script().clone();
    Log::with_frames(Recipe::new(config, (Seed(100), script)), initial, frames)
}

#[test]
fn six_runs_give_the_pinned_digests() {
    let mut wrong = Vec::new();
    for (name, run, frames, whole) in PINS {
        let log = run();
        let found = (frames_digest(&log).to_string(), log.digest().unwrap().to_string());
        if (found.0.as_str(), found.1.as_str()) != (frames, whole) {
            wrong.push(format!("{name}: frames {}, run {}", found.0, found.1));
        }
    }
    assert!(wrong.is_empty(), "not as pinned; read the head of tests/pins/mod.rs first:\n{}", wrong.join("\n"));
}

#[test]
fn every_pinned_digest_has_its_line() {
    let digests = include_str!("DIGESTS.md");
    for (name, _, frames, whole) in PINS {
        let line = digests.lines().find(|l| l.contains(name)).unwrap_or_else(|| panic!("no line for {name}"));
        assert!(line.contains(frames) && line.contains(whole), "{name}: {line}");
    }
}

/// Checks that the events the runs are pinned for happen in them.
#[test]
fn between_them_the_six_runs_use_everything() {
    let [tour, driving, eight, noisy, trailer, branched] = PINS.map(|(_, run, ..)| run());
    let any = |log: &Log, happens: fn(&motion_lab_sim::run::RobotState) -> bool| {
        log.frames().iter().flat_map(|f| &f.robots).any(happens)
    };
    assert!(!any(&tour, |r| r.manual) && any(&tour, |r| r.in_contact) && any(&tour, |r| r.flash > 0));
    assert!(any(&driving, |r| r.manual) && any(&driving, |r| r.refusals > 0) && any(&driving, |r| r.in_contact));
    let released = |i: usize| driving.frames().windows(2).any(|w| w[0].robots[i].manual && !w[1].robots[i].manual);
    assert!((0..3).any(released), "somebody is given back");

    let last = eight.frames().last().unwrap();
    assert_eq!((last.robots.len(), last.scans.len()), (8, 4), "every rover scans");
    for (resident, (before, after)) in
        eight.recipe.config.worlds[0].robots.iter().zip(eight.initial().unwrap().robots.iter().zip(&last.robots))
    {
        assert_ne!(before.configuration, after.configuration, "{} moves", resident.name);
        assert!(after.contacts > 0 || resident.kind == "rusty", "{} meets something", resident.name);
    }
    assert!(last.robots.iter().filter(|r| r.contacts > 0).count() >= 6, "nearly everybody meets something");

    let ranges = |f: &Frame| f.scans[0].ranges.clone();
    let exact = Run::record(
        TourConfig { worlds: vec![World::apartment()], ..TourConfig::clone(&noisy.recipe.config) },
        noisy.recipe.seed,
    )
    .unwrap();
    assert!(noisy.frames().iter().zip(exact.frames()).all(|(n, e)| n.robots == e.robots && ranges(n) != ranges(e)));

    let hitch = |f: &Frame| f.robots[2].configuration.len();
    assert_eq!([4, 5, 139, 140].map(|tick: usize| hitch(&trailer.frames()[tick - 1])), [3, 4, 4, 3]);
    let jump = |robot: usize| {
        let [a, b] = [98, 99].map(|i| trailer.frames()[i].robots[robot].configuration.clone());
        a.iter().zip(&b).any(|(a, b)| (a - b).abs() > 0.3)
    };
    assert!((0..3).all(jump), "all three are put elsewhere at tick 100");
    assert!(trailer.frames().last().unwrap().robots.iter().all(|r| r.refusals == 0));

    // the branch is the run of its script, and so is a run continued from its frame at tick 100
    let input = (branched.recipe.seed, branched.recipe.script.clone());
    assert_eq!(Run::record(branched.recipe.config.clone(), input.clone()).unwrap(), branched);
    let mut run = Recorder::new(branched.recipe.config.clone(), input).unwrap();
    run.seek(160).unwrap();
    run.restore(&branched.frames()[99]).unwrap();
    assert!(branched.frames()[100..].iter().all(|f| run.step() == f));
    assert!(
        branched.recipe.script.events.iter().all(|e| [41, 91, 101].contains(&e.tick)),
        "{:?}",
        branched.recipe.script
    );
}

/// Both digests change with one unit in the last place, and with the sign of a zero, anywhere in a run.
#[test]
fn a_change_of_one_bit_anywhere_changes_both_digests() {
    let log = Run::record(TourConfig { ticks: 3, ..TourConfig::default() }, BOOK_SEED).unwrap();
    let (frames, whole) = (frames_digest(&log), log.digest());
    let mut tried = 0;
    for tick in 0..3 {
        for robot in 0..3 {
            for i in 0..log.frames()[tick].robots[robot].configuration.len() {
                let mut changed = log.clone();
                let x = &mut changed.frames_mut()[tick].robots[robot].configuration[i];
                *x = if *x == 0.0 { -0.0 } else { f64::from_bits(x.to_bits() + 1) };
                assert!(frames_digest(&changed) != frames && changed.digest() != whole, "{tick} {robot} {i}");
                tried += 1;
            }
        }
        let mut changed = log.clone();
        let range = &mut changed.frames_mut()[tick].scans[0].ranges_mut()[17];
        *range = f64::from_bits(range.to_bits() - 1);
        assert!(frames_digest(&changed) != frames && changed.digest() != whole, "a ray at {tick}");
    }
    assert_eq!(tried, 3 * (3 + 2 + 3));
}
