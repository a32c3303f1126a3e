//! What to do where there is no path.

use motion_lab_core::collision::ProblemError;
use motion_lab_core::planning::NoPath;

/// What to do where a bound by cells proves that there is none.
pub(super) const NO_CELLS: &str = "--what-blocks says what to move; or choose another --to, or a smaller --clearance.";

/// What to do where tangents and arcs prove that there is none.
pub(super) const NO_TANGENTS: &str = "Choose another --to, or a smaller --tube or --clearance.";

/// What to do where there is no path.
pub(super) fn next(reason: &NoPath) -> &'static str {
    match reason {
        NoPath::Problem(ProblemError::Clearance { .. }) => "Choose another --from or --to, or a smaller --clearance.",
        NoPath::Problem(_) => "Choose another --from or --to; `motion-lab query witness` says what is in the way.",
        NoPath::Exhausted { .. } => "There may be one: allow more --iterations, or try another --seed or --planner.",
        NoPath::NoneInGraph { .. }
        | NoPath::Undecided { .. }
        | NoPath::JoinedByCells { .. }
        | NoPath::LocalMinimum { .. }
        | NoPath::Enclosed { .. }
        | NoPath::GaveUp(_) => "There may be one: try another --planner.",
        NoPath::Unsuited(_) => "Try another --planner.",
        NoPath::Unreachable { .. } => {
            "--what-blocks says what to move, and --barrier FILE writes the proof; or choose another --to, or a smaller \
             --tube or --clearance."
        }
        _ => "Choose another --to.",
    }
}

/// Why there is no path, or why that is undecided, in a sentence that says so.
pub(super) fn in_words(reason: &str) -> String {
    if reason.starts_with("no path") || reason.starts_with("undecided") {
        reason.to_owned()
    } else {
        format!("no path: {reason}")
    }
}
