//! Tasks for learning: what is observed and earned, by hand; episodes and the runs that they are.

mod episodes;
mod fleet;
mod pins;
mod values;
