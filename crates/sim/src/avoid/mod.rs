//! Why a contact came about: the last tick at which it could still be avoided, and how.
//!
//! A run is simulated again up to the contact. From the ticks before it the run branches: the robot gets other inputs,
//! and everything else goes on as it would. The simulator's own ticks judge each branch, so that a way out is one in
//! the run as well, and "too late" is exact over the [stated set](EvasionSet) of inputs.
//!
//! ```
//! use motion_lab_sim::avoid::{EvasionSet, LastChance, contact_episodes, explain};
//! use motion_lab_sim::run::{Event, Recipe, RobotInput, Script};
//! use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
//!
//! // Rusty is driven straight ahead until it meets a wall
//! let drive = Event { tick: 1, robot: "Rusty".into(), input: RobotInput::Drive(128, 0) };
//! let config = TourConfig { ticks: 400, ..TourConfig::default() };
//! let recipe = Recipe::new(config, (BOOK_SEED, Script::new(vec![drive], vec![])));
//! let episodes = contact_episodes(&recipe, |robot| robot == "Rusty")?;
//! let why = explain(&recipe, &episodes[0], &EvasionSet::default())?;
//! // it stops within a tick, and steers away only while there is room for its turn
//! let LastChance::At(stops) = &why.stopping else { panic!() };
//! assert_eq!(stops.tick, episodes[0].first);
//! let LastChance::At(steers) = &why.going_on else { panic!() };
//! assert!(steers.tick < stops.tick);
//! # Ok::<(), motion_lab_sim::avoid::AvoidError>(())
//! ```

mod approach;
mod branches;
mod episode;
mod error;
mod explaining;
mod explanation;
mod partner;
mod round;
mod search;
mod set;
mod simulated_again;
mod speed_channel;

pub use episode::{ContactEpisode, contact_episodes, contact_episodes_with};
pub use error::AvoidError;
pub use explaining::{Explaining, explain};
pub use explanation::{Evasion, EvasionMeans, Explanation, LastChance, NoEvasion, SearchExtent};
pub use partner::ContactPartner;
pub use set::{EvasionSet, EvasionSetError, EvasionSpeeds, MAX_BRANCHES, MAX_SWITCHES, MAX_WINDOW};
pub use simulated_again::AddKinds;
