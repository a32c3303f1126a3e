//! The names of worlds and of what is in them.

use crate::worlds::WorldProblem;

/// A name's greatest length, bytes.
pub(crate) const MAX_NAME: usize = 200;

/// Refuses an empty name, a long one, one with blanks at either end and one with control characters.
pub(crate) fn check_name(name: &str) -> Result<(), WorldProblem> {
    let good = !name.is_empty()
        && name.len() <= MAX_NAME
        && name.trim().len() == name.len()
        && !name.chars().any(char::is_control);
    if good { Ok(()) } else { Err(WorldProblem::Name(name.chars().take(MAX_NAME).collect())) }
}
