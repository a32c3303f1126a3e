//! Shrinking runs, and tests that say what a failing run comes down to.

mod planted;
pub mod witness;

use motion_lab_core::random::Seed;
use motion_lab_sim::run::Recipe;
use motion_lab_sim::tour::TourConfig;

use crate::simulator::wild_script;

#[test]
#[should_panic(expected = "it moved; of its run this is left, after")]
fn a_failing_test_says_what_its_run_comes_down_to() {
    let moves = |recipe: &Recipe| {
        let is_driven = !recipe.script.events.is_empty();
        if is_driven { Err("it moved".to_owned()) } else { Ok(()) }
    };
    let recipe = Recipe::new(TourConfig { ticks: 60, ..TourConfig::default() }, (Seed(5), wild_script(5, 60)));
    witness::assert_holds(&recipe, moves);
}
