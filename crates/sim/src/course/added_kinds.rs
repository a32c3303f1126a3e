//! `AddedKinds`, the kinds of robots that a program adds to what is graded.

use std::fmt;
use std::sync::Arc;

use bevy::app::App;

/// What adds a program's own kinds of robots to a run; `None` for the lab's kinds alone.
#[derive(Clone, Default)]
pub struct AddedKinds(Option<Arc<dyn Fn(&mut App) + Send + Sync>>);

impl AddedKinds {
    /// What `add` adds.
    pub fn by(add: impl Fn(&mut App) + Send + Sync + 'static) -> Self {
        AddedKinds(Some(Arc::new(add)))
    }

    /// Adds them to an app.
    pub fn add_to(&self, app: &mut App) {
        if let Some(add) = &self.0 {
            add(app);
        }
    }
}

/// They are equal where one is a copy of the other.
impl PartialEq for AddedKinds {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        }
    }
}

impl fmt::Debug for AddedKinds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "AddedKinds(..)" } else { "AddedKinds(none)" })
    }
}
