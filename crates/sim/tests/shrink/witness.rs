//! A test's failure, with the smallest run that still shows it.

use motion_lab_sim::run::Recipe;
use motion_lab_sim::shrink::{ShrinkOptions, shrink};

/// Number of runs that a failing test may take to find a smaller one.
const TRIES: u64 = 400;

/// Fails if `check` refuses a recipe, and prints the smallest recipe that it still refuses, with what it says of that.
/// The check must accept a recipe that cannot run.
#[track_caller]
pub fn assert_holds(recipe: &Recipe, check: impl Fn(&Recipe) -> Result<(), String> + Sync) {
    assert_holds_with(recipe, &ShrinkOptions::default(), check);
}

/// [`assert_holds`] of a check that only scripts and lengths may be taken from.
#[track_caller]
pub fn assert_holds_in_worlds(recipe: &Recipe, check: impl Fn(&Recipe) -> Result<(), String> + Sync) {
    assert_holds_with(recipe, &ShrinkOptions { keeps_worlds: true, ..ShrinkOptions::default() }, check);
}

#[track_caller]
fn assert_holds_with(recipe: &Recipe, how: &ShrinkOptions, check: impl Fn(&Recipe) -> Result<(), String> + Sync) {
    let Err(first) = check(recipe) else { return };
    let options = ShrinkOptions { jobs: 2, max_tries: TRIES, ..*how };
    let shrunk = shrink(recipe, &options, |recipe| check(recipe).is_err(), || true);
    let Recipe { seed, config, script } = &shrunk.recipe;
    let reason = check(&shrunk.recipe).err().unwrap_or_default();
    let mut text = format!("{first}; of its run this is left, after {} tries", shrunk.tries);
    text += if shrunk.is_minimal() { ":\n" } else { ", and less may do:\n" };
    text += &format!("{reason}\nseed {seed}, {} ticks, sensor {:?}\n{}", config.ticks, config.sensor, script.to_ron());
    for world in &config.worlds {
        text += &if how.keeps_worlds { format!("world {:?}\n", world.name) } else { world.to_ron() };
    }
    panic!("{text}");
}
