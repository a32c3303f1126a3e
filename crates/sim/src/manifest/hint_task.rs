//! `HintTask`, what a hint asks for.

use serde::Deserialize;

/// What a hint asks for. Once it has been done the hint is ticked off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum HintTask {
    /// A robot was driven by hand.
    Drive,
    /// An arm was moved.
    MoveArm,
    /// A robot was driven on from an earlier tick.
    DriveOn,
    /// An arm's other elbow was reached, or what blocks the straight way to it was seen.
    TwoElbows,
    /// A car's other heading was seen.
    TwoHeadings,
    /// A robot that was driven by hand was held by what it touches.
    Held,
    /// The run was begun anew.
    Reset,
    /// Query's robot touched something.
    Touch,
    /// A guess was checked.
    Guess,
    /// Query's motion hit something.
    Hit,
    /// Query's motion hit something though both its ends are free.
    FreeEnds,
    /// Query's robot was brought near something without touching it.
    Near,
    /// An arm was given links of unequal lengths.
    UnequalLinks,
    /// The configuration space's point was moved.
    MovePoint,
    /// Two of its points with one tip were visited.
    TwoPoints,
    /// The configuration space's point was dragged over an edge of the torus's square.
    OverEdge,
    /// The atlas's robot was put somewhere.
    Put,
    /// The atlas's grid was made coarser.
    Coarsen,
    /// A wall of the atlas's world was looked up: a list of points.
    PickWall,
    /// A wall of the atlas's world was taken away, and the world was run.
    EditWorld,
    /// The planner found a path.
    FindPath,
    /// The planner took a single step.
    StepPlanner,
    /// The plan's goal was moved.
    MoveGoal,
    /// The plan's path was played.
    PlayPath,
}

impl HintTask {
    /// The id by which settings keep it.
    pub fn id(self) -> String {
        format!("{self:?}")
    }
}
