//! Checks the names of worlds and of their items.

use crate::worlds::WorldProblem;

/// Greatest length of a name, bytes.
pub(crate) const MAX_NAME: usize = 200;

/// Refuses a name that is empty or too long, has blanks at either end, or has control characters.
pub fn check_name(name: &str) -> Result<(), WorldProblem> {
    let good = !name.is_empty()
        && name.len() <= MAX_NAME
        && name.trim().len() == name.len()
        && !name.chars().any(char::is_control);
    if good { Ok(()) } else { Err(WorldProblem::Name(name.chars().take(MAX_NAME).collect())) }
}
