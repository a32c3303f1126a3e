//! The peers of the table: parry in this program, and rivals in programs of their own.

use std::process::Command;
use std::sync::{Arc, Mutex};

use crate::measure::{Entrant, is_timed};
use crate::process::Process;
use crate::rivals::{Task, contenders};

/// The environment variable with the command line of more rivals, which `benches/peers/run` sets.
const MORE: &str = "MOTION_LAB_PEERS";

pub struct Peers(Vec<Arc<Mutex<Process>>>);

/// Builds `benches/rivals`, with Box2D where a C compiler can be had. `None` where it cannot be built.
fn rivals() -> Option<Command> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/rivals");
    let target = std::env::current_exe().ok()?.ancestors().nth(3)?.join("rivals");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let build = |features: &[&str]| {
        let mut build = Command::new(&cargo);
        build.args(["build", "--release", "--locked", "--quiet"]).args(features).current_dir(folder);
        build.arg("--target-dir").arg(&target).env_remove("RUSTFLAGS");
        build.status().is_ok_and(|status| status.success())
    };
    let built = build(&["--features", "box2d"]) || {
        println!("Box2D cannot be built here and is left out");
        build(&[])
    };
    built.then(|| Command::new(target.join("release/rivals")))
}

impl Peers {
    /// Starts the rivals, none where nothing is timed.
    pub fn start() -> Self {
        let mut peers = Vec::new();
        if is_timed() {
            match rivals() {
                Some(mut program) => peers.push(Process::start(&mut program)),
                None => println!("benches/rivals cannot be built here and is left out"),
            }
            if let Ok(line) = std::env::var(MORE) {
                let mut words = line.split_whitespace();
                if let Some(program) = words.next() {
                    peers.push(Process::start(Command::new(program).args(words)));
                }
            }
        }
        Peers(peers.into_iter().map(|process| Arc::new(Mutex::new(process))).collect())
    }

    /// The peers that can do a task, each after `agree` has seen its name and what it answers to every case.
    pub fn entrants(&mut self, task: &Task, agree: impl Fn(&str, &[Vec<f64>])) -> Vec<Entrant<'static>> {
        let cases = task.cases.len();
        let mut entrants: Vec<Entrant<'static>> = Vec::new();
        for process in &self.0 {
            let names = process.lock().expect("one at a time").load(task);
            for (way, name) in names.into_iter().enumerate() {
                agree(&name, &process.lock().expect("one at a time").answers(way, cases));
                entrants.push(Entrant::remote(name, process.clone(), way));
            }
        }
        for mut contender in contenders(task) {
            let name = format!("{}, deterministic", contender.name());
            agree(&name, &(0..cases).map(|case| contender.answers(case)).collect::<Vec<_>>());
            entrants.push(Entrant::new(name, cases, move |case| contender.work(case)));
        }
        entrants
    }
}
