//! `SetupDifference`, a difference between two runs before their first frame.

use super::Recipe;
use motion_lab_core::sensors::RangeSensor;

/// A setting of a run that differs between two runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SetupDifference {
    /// The setting's name: `seed`, `ticks`, `sensor`, `worlds`, `world 0, line 7`, `script, line 3`.
    pub item: String,
    /// Its value in the first run.
    pub first: String,
    /// Its value in the second run.
    pub second: String,
}

impl Recipe {
    /// Returns the settings in which two runs differ: seed, ticks, sensor, worlds and script. For each world and for
    /// the script it gives the first line that differs in their canonical texts. Empty if they are one run.
    pub fn differences(&self, other: &Recipe) -> Vec<SetupDifference> {
        let mut found = Vec::new();
        let mut compare = |item: &str, first: String, second: String| {
            if first != second {
                found.push(SetupDifference { item: item.to_owned(), first, second });
            }
        };
        compare("seed", self.seed.to_string(), other.seed.to_string());
        compare("ticks", self.config.ticks.to_string(), other.config.ticks.to_string());
        compare("sensor", sensor(self.config.sensor), sensor(other.config.sensor));
        let (a, b) = (&self.config.worlds, &other.config.worlds);
        compare("worlds", a.len().to_string(), b.len().to_string());
        for (i, (a, b)) in a.iter().zip(b).enumerate() {
            if a.content_hash() != b.content_hash() {
                found.extend(first_line(&format!("world {i}"), &a.to_ron(), &b.to_ron()));
            }
        }
        found.extend(first_line("script", &self.script.to_ron(), &other.script.to_ron()));
        found
    }
}

fn sensor(sensor: Option<RangeSensor>) -> String {
    match sensor {
        Some(RangeSensor { n_rays, max_range }) => format!("{n_rays} rays, {max_range:?} m"),
        None => "none".to_owned(),
    }
}

/// The first line in which two texts differ.
fn first_line(item: &str, first: &str, second: &str) -> Option<SetupDifference> {
    let (mut a, mut b) = (first.lines(), second.lines());
    let said = |line: Option<&str>| line.map_or("nothing more".to_owned(), |l| l.trim().to_owned());
    (1..).find_map(|number| match (a.next(), b.next()) {
        (None, None) => Some(None),
        (one, other) if one == other => None,
        (one, other) => Some(Some(SetupDifference {
            item: format!("{item}, line {number}"),
            first: said(one),
            second: said(other),
        })),
    })?
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use crate::run::{Event, RobotInput, fixture};
    use crate::tour::TourConfig;

    fn config_of(recipe: &mut Recipe) -> &mut TourConfig {
        Arc::make_mut(&mut recipe.config)
    }
    use motion_lab_core::random::Seed;

    #[test]
    fn everything_that_determines_a_run_is_compared_and_named() {
        type Change = fn(&mut Recipe);
        let changes: [(&str, &str, Change); 8] = [
            ("seed", "7", |r| r.seed = Seed(7)),
            ("ticks", "4", |r| config_of(r).ticks += 1),
            ("sensor", "none", |r| config_of(r).sensor = None),
            ("sensor", "3 rays, 4.000000000000001 m", |r| {
                config_of(r).sensor = Some(RangeSensor { n_rays: 3, max_range: 4.000_000_000_000_001 });
            }),
            ("worlds", "0", |r| config_of(r).worlds.clear()),
            ("world 0, line 3", "name: \"Garden\",", |r| config_of(r).worlds[0].name = "Garden".into()),
            ("script, line 4", "(tick: 1, robot: \"Car\", input: Drive(-128, 127)),", |r| {
                r.script.events[0].input = RobotInput::Drive(-128, 127);
            }),
            ("script, line 7", "(tick: 3, robot: \"Arm\", input: Release),", |r| {
                r.script.events.push(Event { tick: 3, robot: "Arm".into(), input: RobotInput::Release });
            }),
        ];
        let recipe = fixture::log().recipe;
        assert_eq!(recipe.differences(&recipe), []);
        for (item, value, change) in changes {
            let mut other = recipe.clone();
            change(&mut other);
            let found = recipe.differences(&other);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!((found[0].item.as_str(), found[0].second.as_str()), (item, value));
            let back = other.differences(&recipe);
            assert_eq!((back[0].first.as_str(), &back[0].second), (value, &found[0].first));
        }
    }
}
