//! `CheckerName`, who answers a planner's questions, by name.

use std::sync::Arc;

use motion_lab_core::collision::{Checker, Collision, ParryScene, Scene};
use motion_lab_core::robots::Robot;

/// Who answers a planner's questions, by name.
#[derive(Clone, Copy, Debug)]
pub struct CheckerName {
    id: &'static str,
    words: &'static str,
    /// Makes the black box of a scene; `None` where the scene itself answers. A program that names no black box does
    /// not contain one.
    black_box: Option<fn(&Scene) -> Arc<dyn Collision>>,
}

impl CheckerName {
    /// The lab's exact scene, which proves what it calls free.
    pub const EXACT: CheckerName =
        CheckerName { id: "exact", words: "The lab's own: exact, and what it calls free is proven", black_box: None };

    /// The chapter's black box, which proves nothing.
    pub const PARRY: CheckerName = CheckerName {
        id: "parry",
        words: "parry2d-f64's rounded queries, the book's black box: nothing is proven",
        black_box: Some(|scene| Arc::new(ParryScene::of_scene(scene))),
    };

    /// All of them, in the order of the lists.
    pub const ALL: [CheckerName; 2] = [CheckerName::EXACT, CheckerName::PARRY];

    /// The name by which the command line names it.
    pub const fn id(self) -> &'static str {
        self.id
    }

    /// What it is, in a line.
    pub const fn words(self) -> &'static str {
        self.words
    }

    /// Whether what it calls free is proven.
    pub const fn proves(self) -> bool {
        self.black_box.is_none()
    }

    /// The checker of a robot in a scene whose questions this one answers.
    pub fn checker<R: Robot>(self, scene: &Arc<Scene>, robot: R) -> Checker<R> {
        let exact = Checker::new(Arc::clone(scene), robot);
        match self.black_box {
            None => exact,
            Some(of_scene) => exact.with_black_box(of_scene(scene)),
        }
    }
}
