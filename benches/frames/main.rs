//! What the frames of a window take, and a paused window: `cargo bench --bench frames -- [WORLD|LOG] [FRAMES]`.
//!
//! The run plays for that number of frames, 300 by default, is then paused for some twenty seconds, and the window
//! closes.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout)]

mod measure;
mod processor;
mod times;

use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use measure::MeasurePlugin;
use motion_lab::app::{Opened, open_in_window};
use motion_lab::worlds::World;
use times::{FrameTimes, words};

fn main() {
    let (mut frames, mut what) = (300, Opened::Tour);
    // cargo says `--bench` by itself
    for argument in std::env::args().skip(1).filter(|argument| argument != "--bench") {
        match (argument.parse(), World::built_in(&argument)) {
            (Ok(count), _) => frames = count,
            (_, Some(world)) => what = Opened::World(Box::new(world)),
            _ if argument.ends_with(".ron") => {
                let text = std::fs::read_to_string(&argument).expect("a world file");
                what = Opened::World(Box::new(World::parse(&argument, &text).expect("a world")));
            }
            _ => what = Opened::Log(PathBuf::from(argument)),
        }
    }
    let times = Arc::new(Mutex::new(FrameTimes::default()));
    let plugin = MeasurePlugin { frames, times: Arc::clone(&times) };
    open_in_window(what, |app| _ = app.add_plugins(plugin)).expect("a window");
    println!("{}", words(&times.lock().expect("the window is closed")));
}
