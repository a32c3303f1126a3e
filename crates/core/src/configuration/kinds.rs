//! `Kinds`, what a program knows of the kinds of robots that worlds name.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use super::RobotKind;
use crate::geometry::Footprint;

/// The footprint of a robot of a kind at a configuration with these coordinates; `None` where there is none.
type FootprintOf = Arc<dyn Fn(&[f64]) -> Option<Footprint> + Send + Sync>;

/// What is known of a kind.
#[derive(Clone, Default)]
struct Known {
    about: Option<&'static RobotKind>,
    outline: Option<FootprintOf>,
}

impl PartialEq for Known {
    fn eq(&self, other: &Self) -> bool {
        let same_outline = match (&self.outline, &other.outline) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        self.about == other.about && same_outline
    }
}

/// What a program knows of the kinds of robots, by the names that worlds give them: the lab's, and those that it adds.
/// The simulator's plugins of an app give the app's own.
///
/// ```
/// use motion_lab_core::configuration::{Kinds, RobotKind};
/// use motion_lab_core::geometry::{Footprint, Point2};
/// static KART: RobotKind = RobotKind { name: "x-kart", ..RobotKind::RUSTY };
/// let kinds = Kinds::default()
///     .with("x-kart", &KART)
///     .with_footprint("x-kart", |q| Some(Footprint::disc(Point2::new(*q.first()?, *q.get(1)?), 0.4)));
/// assert!(kinds.of("x-kart").is_some_and(|kart| kart.drives) && kinds.of("hitch").is_some());
/// assert!(kinds.footprint("x-kart", &[1.0, 2.0, 0.0]).is_some());
/// assert!(Kinds::default().of("x-kart").is_none());
/// ```
#[derive(Clone, PartialEq)]
pub struct Kinds(BTreeMap<String, Known>);

impl Default for Kinds {
    fn default() -> Self {
        RobotKind::ALL.into_iter().fold(Kinds(BTreeMap::new()), |kinds, kind| kinds.with(kind.name, kind))
    }
}

impl fmt::Debug for Kinds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.keys()).finish()
    }
}

impl Kinds {
    /// The kinds with a description of the one that worlds name `kind`. It replaces an earlier one.
    #[must_use]
    pub fn with(mut self, kind: impl Into<String>, about: &'static RobotKind) -> Self {
        self.0.entry(kind.into()).or_default().about = Some(about);
        self
    }

    /// The kinds with footprints for the one that worlds name `kind`. `outline` gives a robot's footprint in the world,
    /// metres, at the configuration with these coordinates, and `None` for coordinates that are no configuration.
    #[must_use]
    pub fn with_footprint(
        mut self,
        kind: impl Into<String>,
        outline: impl Fn(&[f64]) -> Option<Footprint> + Send + Sync + 'static,
    ) -> Self {
        self.0.entry(kind.into()).or_default().outline = Some(Arc::new(outline));
        self
    }

    /// The description of a kind; `None` without one.
    pub fn of(&self, kind: &str) -> Option<&'static RobotKind> {
        self.0.get(kind)?.about
    }

    /// Whether the kind has footprints, which the lab's own have not here.
    pub fn has_footprints(&self, kind: &str) -> bool {
        self.0.get(kind).is_some_and(|known| known.outline.is_some())
    }

    /// The footprint of a robot of this kind at the configuration with these coordinates. `None` for a kind without
    /// footprints, which the lab's own are here, and for coordinates that are none of its configurations.
    pub fn footprint(&self, kind: &str, coordinates: &[f64]) -> Option<Footprint> {
        self.0.get(kind)?.outline.as_ref()?(coordinates)
    }
}
