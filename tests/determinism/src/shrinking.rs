//! A run on which two builds differ, made smaller.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use motion_lab_sim::recording::{Run, RunParts, TickDigests};
use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::shrink::{ShrinkOptions, shrink};

use crate::Done;
use crate::catalogue::NamedRun;

/// The most runs that are tried: in another build each takes a process.
const TRIES: u64 = 1000;

/// Shrinks a run to the smallest on which this build and another differ, writes its log and prints its script.
pub fn shrunk(run: &NamedRun, file: &Path, command: &str) -> Done {
    let differs = |recipe: &Recipe| match (own(recipe), other(recipe, command)) {
        (Some(own), Some(other)) => own != other,
        _ => false,
    };
    if !differs(&run.recipe) {
        return Err(format!("{}: the builds do not differ on it", run.name).into());
    }
    let options = ShrinkOptions { max_tries: TRIES, ..ShrinkOptions::default() };
    let small = shrink(&run.recipe, &options, differs, || true);
    let log = Run::record_recipe(small.recipe.clone(), LogKind::Frames, |_| {})?;
    log.write_mcap(File::create(file)?)?;
    let (before, after) = (small.before, small.after);
    println!("{} shrunk by {} tries, from {before:?} to {after:?}", run.name, small.tries);
    println!("{}", small.recipe.script.to_ron());
    Ok(())
}

/// The digest of all ticks by this build.
fn own(recipe: &Recipe) -> Option<String> {
    let mut digests = TickDigests::of(recipe).ok()?;
    digests.by_ref().for_each(drop);
    Some(digests.digest().to_string())
}

/// The same by another: the last word that the command prints.
fn other(recipe: &Recipe, command: &str) -> Option<String> {
    let parts = serde_json::to_string(&RunParts::of(recipe)).ok()?;
    let mut shell = Command::new("sh");
    shell.args(["-c", command]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = shell.spawn().ok()?;
    child.stdin.take()?.write_all(format!("candidate\t{parts}\n").as_bytes()).ok()?;
    let output = child.wait_with_output().ok()?;
    String::from_utf8(output.stdout).ok()?.split_whitespace().last().map(str::to_owned)
}
