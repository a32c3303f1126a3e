//! `why`: until when each contact of a run could have been avoided, and how.

mod args;
mod report;
mod words;

use motion_lab_core::names::did_you_mean;
use motion_lab_sim::avoid::{ContactEpisode, Evasion, EvasionSet, Explaining, Explanation, contact_episodes_with};
use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::tour::TourConfig;

pub use args::WhyArgs;

use crate::cli::commands::record::{Ended, StopRule, write_run};
use crate::cli::support::input::shown;
use crate::cli::support::interrupt;
use crate::cli::support::log_source::{LogSource, read_log, say_damage};
use crate::cli::support::output::write_file;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::refused;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

impl WhyArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let set = self.set()?;
        let LogSource { log, damage, .. } = read_log(&self.file)?;
        say_damage(damage.as_ref(), "explained");
        let recorded = TourConfig { ticks: log.ticks(), ..TourConfig::clone(&log.recipe.config) };
        let recipe = Recipe { config: recorded.into(), ..log.recipe };
        let log_target = self.output.as_deref().map(Target::log).transpose()?;
        let script = self.script.as_deref().map(Target::of).transpose()?;
        self.check_robots(&recipe)?;
        interrupt::listen();
        let asked = ContactSearch { recipe: &recipe, set: &set };
        let outcome = if damage.is_some() { Outcome::Recovered } else { Outcome::Done };
        let Some(episodes) = asked.episodes(|robot| self.wants(robot))? else { return Ok(Outcome::Stopped) };
        let chosen: Vec<&ContactEpisode> = episodes.iter().filter(|episode| self.wants_number(episode)).collect();
        if chosen.is_empty() {
            if log_target.is_some() || script.is_some() || self.contact.is_some() {
                return Err(self.none_of(&episodes));
            }
            say(format!("{}: no contact in {} ticks", shown(&self.file), recipe.config.ticks));
            return Ok(outcome);
        }
        if (log_target.is_some() || script.is_some()) && chosen.len() > 1 {
            return Err(Failure::usage(
                format!("{} contacts: -o and --script are for one", chosen.len()),
                "Name it: --robot NAME --contact N.",
            ));
        }
        let (mut way_out, count) = (None, chosen.len());
        let progress = CommandProgress::of(count as u64, "contacts");
        for (done, episode) in chosen.into_iter().enumerate() {
            let Some(why) = asked.explain(episode)? else {
                say(format!("stopped after {done} of {count} contacts"));
                return Ok(Outcome::Stopped);
            };
            progress.step();
            if self.json {
                data.json(&report::ContactReport::of(&why))?;
            } else {
                words::lines(&why, &set).into_iter().try_for_each(|line| data.line(line))?;
            }
            way_out = why.going_on.evasion().or_else(|| why.stopping.evasion()).cloned();
        }
        drop(progress);
        match write(&recipe, way_out, log_target, script, data)? {
            Outcome::Done => Ok(outcome),
            other => Ok(other),
        }
    }

    /// Refuses a robot that the run does not have.
    fn check_robots(&self, recipe: &Recipe) -> Result<(), Failure> {
        let Some(name) = &self.robot else { return Ok(()) };
        let there: Vec<&str> = recipe.config.robot_names().collect();
        if there.contains(&name.as_str()) {
            return Ok(());
        }
        let meant = did_you_mean(name, there.iter().copied());
        let have = if there.is_empty() { "none".to_owned() } else { there.join(", ") };
        Err(Failure::usage(format!("--robot {name}: no such robot is in this run"), format!("{meant}It has {have}.")))
    }

    fn none_of(&self, episodes: &[ContactEpisode]) -> Failure {
        let have = match (episodes.len(), &self.robot) {
            (0, Some(robot)) => format!("{robot} has no contact in this run"),
            (0, None) => "the run has no contact".into(),
            _ => {
                let mut all: Vec<String> = episodes.iter().map(|e| format!("{} {}", e.robot, e.number)).collect();
                let rest = all.len().saturating_sub(12);
                all.truncate(12);
                let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
                format!("it has {}{more}", all.join(", "))
            }
        };
        let asked = self.contact.map_or_else(|| "-o, --script".into(), |number| format!("--contact {number}"));
        Failure::usage(format!("{asked}: there is no such contact"), format!("{}.", capitalized(&have)))
    }
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A run, and the inputs by which its contacts may be avoided.
struct ContactSearch<'a> {
    recipe: &'a Recipe,
    set: &'a EvasionSet,
}

impl ContactSearch<'_> {
    /// The contacts; `None` where somebody asked to stop.
    fn episodes(&self, wants: impl Fn(&str) -> bool) -> Result<Option<Vec<ContactEpisode>>, Failure> {
        let progress = CommandProgress::of(self.recipe.config.ticks, "ticks");
        let go_on = |tick| {
            progress.at(tick);
            !interrupt::asked_to_stop()
        };
        contact_episodes_with(self.recipe, None, wants, go_on).map_err(|error| refused(&error))
    }

    /// What is known of a contact; `None` where somebody asked to stop.
    fn explain(&self, episode: &ContactEpisode) -> Result<Option<Explanation>, Failure> {
        let mut work =
            Explaining::new(self.recipe, (&episode.robot, episode.first), self.set).map_err(Failure::internal)?;
        while !interrupt::asked_to_stop() {
            if let Some(explanation) = work.step().map_err(Failure::internal)? {
                return Ok(Some(explanation));
            }
        }
        Ok(None)
    }
}

/// Writes the way out as a log and as a script. Says where there is none.
fn write(
    recipe: &Recipe,
    way_out: Option<Evasion>,
    log: Option<Target>,
    script: Option<Target>,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    if log.is_none() && script.is_none() {
        return Ok(Outcome::Done);
    }
    let Some(Evasion { script: inputs, free_until, .. }) = way_out else {
        say("there is no way out, so -o and --script have nothing to write");
        return Ok(Outcome::NoPath);
    };
    if let Some(target) = script {
        write_file(&target, inputs.to_ron().as_bytes())?;
        target.finish(data)?;
    }
    if let Some(target) = log {
        let config = TourConfig { ticks: free_until, ..TourConfig::clone(&recipe.config) };
        let run = Recipe { config: config.into(), script: inputs, ..recipe.clone() };
        match write_run(&run, LogKind::Frames, None, StopRule::default(), &target)? {
            Ended::Whole { .. } => target.wrote(),
            Ended::Stopped(tick) => {
                say(format!("stopped at tick {tick} of {free_until}: the way out is not whole"));
                return Ok(Outcome::Stopped);
            }
            // it is compared with nothing
            Ended::Differs(_) => {}
        }
    }
    Ok(Outcome::Done)
}
