//! Which shard to run, as the command line or a cluster's engine says.

use std::str::FromStr;

use crate::batch::{Shard, ShardError};

use crate::cli::Failure;

/// A shard as the command line says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShardChoice {
    /// This one.
    This(Shard),
    /// The one that a cluster's engine asks for, of this number if it is said.
    Engine(Option<u64>),
}

impl FromStr for ShardChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let count = match text.strip_prefix("auto") {
            None => return text.parse().map(ShardChoice::This).map_err(|error: ShardError| error.to_string()),
            Some("") => None,
            Some(count) => Some(count.strip_prefix('/').and_then(|n| n.parse().ok()).filter(|n| *n > 0)),
        };
        match count {
            Some(None) => Err(format!("{text:?}: write auto, or auto/N with the number of shards")),
            count => Ok(ShardChoice::Engine(count.flatten())),
        }
    }
}

impl ShardChoice {
    /// The shard; the whole sweep where none was asked for.
    pub fn shard(choice: Option<ShardChoice>) -> Result<Shard, Failure> {
        match choice {
            None => Ok(Shard::WHOLE),
            Some(ShardChoice::This(shard)) => Ok(shard),
            Some(ShardChoice::Engine(count)) => Shard::of_engine(count, |name| std::env::var(name).ok())
                .map_err(|error| Failure::usage(format!("--shard auto: {error}"), "See `motion-lab sweep --help`.")),
        }
    }
}
