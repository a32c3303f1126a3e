//! `CheckerName`, who answers a planner's questions, by name.

use std::sync::Arc;

use motion_lab_core::collision::{Checker, ParryScene, Scene};
use motion_lab_core::robots::Robot;

/// Who answers a planner's questions, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CheckerName {
    /// The lab's exact scene, which proves what it calls free.
    #[default]
    Exact,
    /// The chapter's black box, which proves nothing.
    Parry,
}

impl CheckerName {
    /// All of them, in the order of the lists.
    pub const ALL: [CheckerName; 2] = [CheckerName::Exact, CheckerName::Parry];

    /// The name by which the command line names it.
    pub const fn id(self) -> &'static str {
        match self {
            CheckerName::Exact => "exact",
            CheckerName::Parry => "parry",
        }
    }

    /// What it is, in a line.
    pub const fn words(self) -> &'static str {
        match self {
            CheckerName::Exact => "The lab's own: exact, and what it calls free is proven",
            CheckerName::Parry => "parry2d-f64's rounded queries, the book's black box: nothing is proven",
        }
    }

    /// Whether what it calls free is proven.
    pub const fn proves(self) -> bool {
        matches!(self, CheckerName::Exact)
    }

    /// The checker of a robot in a scene whose questions this one answers.
    pub fn checker<R: Robot>(self, scene: &Arc<Scene>, robot: R) -> Checker<R> {
        let exact = Checker::new(Arc::clone(scene), robot);
        match self {
            CheckerName::Exact => exact,
            CheckerName::Parry => exact.with_black_box(ParryScene::of_scene(scene)),
        }
    }
}
