//! Assignments, RON.
//!
//! A wrong reader takes an assignment that cannot be graded, or that whoever does nothing passes.

use super::refusal;
use motion_lab::recording::{AssignmentFile, Submission};
use motion_lab::run::Script;
use motion_lab::worlds::World;

/// Most ticks of an assignment that is graded, over all its seeds.
const MAX_TICKS: u64 = 100;

/// Reads an assignment, and grades a script that does nothing.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    let file = match AssignmentFile::parse("exam.ron", text) {
        Ok(file) => file,
        Err(error) => {
            assert!(error.line > 0 && error.column > 0, "{error}");
            refusal::check(&error, "exam.ron");
            return false;
        }
    };
    refusal::check(&file.place_of("world"), "exam.ron");
    let world = World::built_in(file.world_name()).unwrap_or_else(World::lot);
    file.turns(&world).iter().for_each(|turn| refusal::check(turn, "exam.ron"));
    let assignment = match file.in_world(world) {
        Ok(assignment) => assignment,
        Err(error) => {
            refusal::check(&error, "exam.ron");
            return false;
        }
    };
    if assignment.limits().ticks.saturating_mul(assignment.seeds().len() as u64) > MAX_TICKS {
        return true;
    }
    let grade = assignment.grade(&Submission::Script(Script::empty()));
    assert_eq!((grade.refusal.as_ref(), grade.attempts.len()), (None, assignment.seeds().len()));
    assert!(grade.score.points >= 0.0 && grade.score.points <= grade.score.of, "{:?}", grade.score);
    assert_eq!(assignment.grade(&Submission::Script(Script::empty())), grade, "a grade is the same each time");
    true
}
