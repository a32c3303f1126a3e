//! The collision checker: four questions about a footprint in a scene, and edges proven free.

mod batch;
mod boundary;
mod broad;
mod change;
mod checker;
mod counted;
mod forward;
mod layers;
mod motion;
mod narrow;
mod parry;
mod problem;
mod queries;
mod question;
mod resident;
mod rows;
mod scene;
mod surroundings;
mod ties;
mod witness;

pub(crate) use boundary::grid::{Cells, GridCell};
pub(crate) use boundary::segments::{Circle, LANES, SegmentSoup};
#[doc(hidden)]
pub use broad::index::Index;
pub use checker::{CarChecker, ChainChecker, Checker, DiscChecker};
pub use counted::{Counted, QueryCounts};
pub use motion::certificate::{Certificate, CertificateError, ProvenStep};
pub use motion::conservative_advancement::{BRACKET, march};
#[doc(hidden)]
pub use motion::keeps::{UnkeptMargin, is_free_among, keeps};
pub use motion::verdict::{EdgeVerdict, MarchOptions, UnresolvedReason};
pub use motion::verifier::verify_certificate;
pub use narrow::pair::{distance, footprint_distance, touch};
pub use parry::black_box::ParryScene;
pub use problem::{GoalRegion, Problem, ProblemError};
pub use question::Collision;
pub use rows::{Rows, RowsError};
pub use scene::Scene;
pub use surroundings::Surroundings;
pub use witness::{HitBy, ObstacleId, Overlap, Witness};
