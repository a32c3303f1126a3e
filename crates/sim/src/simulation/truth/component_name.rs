//! The name of a component in messages.

use bevy::utils::prelude::ShortName;

/// The name of a type without its path, as `Configuration<Rusty>`.
pub(crate) fn name_of<C>() -> String {
    ShortName::of::<C>().to_string()
}
