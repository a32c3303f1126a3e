//! The pinned runs in a Bevy app of one's own: played live in the fixed loop, by commands, to the same digests.

use std::time::Duration;

use bevy::app::App;
use bevy::time::TimeUpdateStrategy;
use motion_lab_sim::run::{Event, Frame, Log, Recipe, RobotInput};
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, RobotCommand, RunCommand, Transport, TransportCommand, headless_app, start_run,
};

use super::{PINS, frames_digest, quantized};

/// A pinned run under way in an app: its script arrives tick by tick, as if somebody drove.
struct Played<'a> {
    app: App,
    log: &'a Log,
    /// The number of the script's events that have been sent.
    sent: usize,
    frames: Vec<Frame>,
}

impl<'a> Played<'a> {
    fn new(log: &'a Log) -> Self {
        let mut app = headless_app();
        start_run(app.world_mut(), log.recipe.config.clone(), log.recipe.seed).unwrap();
        // an update lasts as long as a tick
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
        Played { app, log, sent: 0, frames: Vec::new() }
    }

    fn tick(&self) -> u64 {
        self.app.world().resource::<Transport>().tick()
    }

    fn frame(&self) -> Frame {
        self.app.world().resource::<LatestFrame>().frame().clone()
    }

    fn send(&mut self, command: impl Into<RunCommand>) {
        self.app.world_mut().write_message(command.into());
    }

    /// Plays up to a tick, and sends the events up to `driven` before the updates that run their ticks.
    fn play(&mut self, to: u64, driven: u64) {
        self.send(TransportCommand::Play);
        while self.tick() < to {
            let next = self.tick() + 1;
            let log = self.log;
            while let Some(event) =
                log.recipe.script.events.get(self.sent).filter(|e| e.tick <= next && e.tick <= driven)
            {
                let Event { robot, input, .. } = event.clone();
                self.send(RobotCommand { robot, input });
                self.sent += 1;
            }
            self.app.update();
            assert!(self.tick() <= next, "an update runs one tick");
            if self.tick() == next {
                self.frames.push(self.frame());
            }
        }
    }

    /// Goes back to a tick, which is as it was.
    fn go_back(&mut self, to: u64) {
        self.send(TransportCommand::Pause);
        self.send(TransportCommand::Seek(to));
        self.app.update();
        self.frames.truncate(to as usize);
        assert_eq!(self.frames.last(), Some(&self.frame()), "what is restored is what was");
    }
}

/// Every run is played to two thirds, taken back to one third and played on. The branched one is driven elsewhere
/// first, from the tick to which it goes back.
#[test]
fn the_six_runs_in_a_bevy_app_give_the_pinned_digests() {
    let (mut inputs, mut branches) = (0, 0);
    for (name, run, frames, whole) in PINS {
        let log = run();
        let end = log.recipe.config.ticks;
        let mut played = Played::new(&log);
        let initial = played.frame();
        if name.starts_with("branched") {
            played.play(120, 100);
            let input = RobotInput::MoveTo(quantized(&[2.0, 0.0]));
            played.send(RobotCommand { robot: "Reach".into(), input });
            played.play(160, 100);
            assert_ne!(played.frames[159], log.frames()[159], "the branch goes elsewhere");
            played.go_back(100);
            branches += 1;
        } else {
            played.play(2 * end / 3, u64::MAX);
            played.go_back(end / 3);
        }
        played.play(end, u64::MAX);
        inputs += played.sent;
        let script = played.app.world().resource::<PendingInput>().script().clone();
        assert_eq!(script, log.recipe.script, "{name}");
        for (frame, recorded) in played.frames.iter().zip(log.frames()) {
            assert_eq!(frame.digest(), recorded.digest(), "{name}, tick {}", frame.tick);
        }
        let live = Log::with_frames(Recipe { script, ..log.recipe.clone() }, initial, played.frames);
        assert_eq!(frames_digest(&live).to_string(), frames, "{name}");
        assert_eq!(live.digest().unwrap().to_string(), whole, "{name}");
    }
    assert!(inputs > 30 && branches == 1, "{inputs} inputs");
}
