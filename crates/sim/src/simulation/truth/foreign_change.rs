//! `ForeignChange`, a change of the run's entities by somebody else.

use std::fmt;

use bevy::prelude::Entity;

/// A change of one of the run's entities past its commands, in a run under way. It was put back.
///
/// Prints as `robot "Rusty" (entity 31v0): Configuration<Rusty> was changed past the run's commands, and is put back`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignChange {
    /// The entity that was changed. One that was despawned is back as another entity.
    pub entity: Entity,
    /// What it is and its name: `robot "Rusty"`.
    pub thing: String,
    /// The name of the component's type, as `Configuration<Rusty>`; empty for an entity that was despawned.
    pub component: String,
    /// Whether the entity was the run's. One that was not has lost its components of the run, and stays.
    pub is_of_run: bool,
}

impl fmt::Display for ForeignChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ForeignChange { entity, thing, component, is_of_run } = self;
        write!(f, "{thing} (entity {entity}): ")?;
        match (is_of_run, component.as_str()) {
            (true, "") => f.write_str("it was despawned past the run's commands, and is back as another entity"),
            (true, component) => write!(f, "{component} was changed past the run's commands, and is put back"),
            (false, component) => {
                write!(f, "it came after tick 0, when a run's entities are fixed: its {component} is taken off")
            }
        }
    }
}
