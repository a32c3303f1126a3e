//! The runs that every build of the lab has to give to the last bit, and their digests, by which
//! `tests/all/determinism` compares builds.
//!
//! | arguments | what comes of it |
//! |---|---|
//! | `runs SEEDS [NAME]` | a line for each run: name, ticks, digest of the run, digest of all ticks; what was met, as an error where it was too seldom |
//! | `ticks SEEDS NAME` | the digest of each tick of one run |
//! | `parts SEEDS [NAME]` | a line for each run: name and parts as JSON, for builds that have no program |
//! | `digests` | `runs` of the lines that `parts` prints, from standard input |
//! | `logs SEEDS FOLDER` | the log of each run, with a digest of each second |
//! | `shrink SEEDS NAME FILE COMMAND` | the smallest run that COMMAND, which is given a line of `parts`, ends in another digest than this build; its log goes to FILE |
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod catalogue;
mod feature;
mod inputs;
// the inputs of these are fixed, and right
#[allow(clippy::unwrap_used, clippy::expect_used)]
#[path = "../../../crates/sim/tests/pins/recipes.rs"]
mod recipes;
mod shrinking;
mod survey;
mod swarm;

use std::error::Error;
use std::fs::File;
use std::io::{BufRead, Write, stdin, stdout};
use std::path::Path;

use catalogue::{NamedRun, catalogue, named};
use motion_lab_sim::recording::{Run, RunParts, TickDigests};
use motion_lab_sim::run::{Frame, LogKind, Recipe};
use survey::Survey;

type Done = Result<(), Box<dyn Error>>;

fn main() -> Done {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["runs", seeds] => runs(catalogue(seeds.parse()?)),
        ["runs", seeds, name] => runs([found(seeds, name)?].into_iter()),
        ["ticks", seeds, name] => ticks(&found(seeds, name)?.recipe),
        ["parts", seeds] => catalogue(seeds.parse()?).try_for_each(|run| parts(&run)),
        ["parts", seeds, name] => parts(&found(seeds, name)?),
        ["digests"] => digests(),
        ["logs", seeds, folder] => catalogue(seeds.parse()?).try_for_each(|run| log(&run, Path::new(folder))),
        ["shrink", seeds, name, file, command] => {
            shrinking::shrunk(&found(seeds, name)?, Path::new(file), command)
        }
        _ => Err("runs SEEDS [NAME], ticks SEEDS NAME, parts SEEDS [NAME], digests, logs SEEDS FOLDER, or shrink SEEDS NAME \
                  FILE COMMAND"
            .into()),
    }
}

fn found(seeds: &str, name: &str) -> Result<NamedRun, Box<dyn Error>> {
    named(name, seeds.parse()?).ok_or_else(|| format!("no run of {seeds} seeds is named {name}").into())
}

/// Prints the line of each run, then what the generated ones have met.
fn runs(all: impl Iterator<Item = NamedRun>) -> Done {
    let mut survey = Survey::default();
    for NamedRun { name, recipe } in all {
        let mut digests = TickDigests::of(&recipe).map_err(|error| format!("{name}: {error}"))?;
        let start = digests.recorder().frame().clone();
        let mut is_coupled = false;
        line(&name, &mut digests, |frame| is_coupled |= survey::is_coupled_otherwise(&start, frame))?;
        if survey::generated(&name).is_some() {
            survey.see(&recipe, is_coupled, digests.recorder());
        }
    }
    eprintln!("{}", survey.words());
    match survey.seldom()[..] {
        [] => Ok(()),
        ref few => Err(format!("met too seldom: {}", few.join(", ")).into()),
    }
}

/// Prints the line of a run: name, ticks, digest of the run, digest of all ticks.
/// Prints the line of a run, and shows each of its frames.
fn line(name: &str, digests: &mut TickDigests, mut each: impl FnMut(&Frame)) -> Done {
    let mut frames = 0;
    while digests.next().is_some() {
        each(digests.recorder().frame());
        frames += 1;
    }
    writeln!(stdout(), "{name} {} {} {}", frames - 1, digests.run(), digests.digest())?;
    Ok(())
}

fn ticks(recipe: &Recipe) -> Done {
    TickDigests::of(recipe)?.try_for_each(|digest| Ok(writeln!(stdout(), "{digest}")?))
}

fn parts(NamedRun { name, recipe }: &NamedRun) -> Done {
    Ok(writeln!(stdout(), "{name}\t{}", serde_json::to_string(&RunParts::of(recipe))?)?)
}

fn digests() -> Done {
    for text in stdin().lock().lines() {
        let text = text?;
        let (name, parts) = text.split_once('\t').ok_or("a line is a name, a tabulator and the parts of a run")?;
        let parts: RunParts = serde_json::from_str(parts)?;
        line(name, &mut TickDigests::of(&parts.recipe()?)?, |_| ())?;
    }
    Ok(())
}

fn log(run: &NamedRun, folder: &Path) -> Done {
    let log = Run::record_recipe(run.recipe.clone(), LogKind::Digests, |_| {})?;
    Ok(log.write_mcap(File::create(folder.join(format!("{}.mcap", run.name)))?)?)
}
