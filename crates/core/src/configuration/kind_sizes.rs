//! The sizes that robots of the lab's kinds have.

use super::{RobotKind, Sizes, SizesError};

impl Sizes {
    /// The numbers that every robot of a kind has if its world says nothing else. `None` for a kind that is not the
    /// lab's.
    pub fn of_kind(kind: &str) -> Option<Sizes> {
        RobotKind::of(kind)?.sizes.map(|sizes| sizes())
    }

    /// Checks the numbers of a robot of this kind, which must be one of the lab's.
    ///
    /// # Errors
    /// [`SizesError`]: as [`check`](Self::check); or the kind has other numbers, or another number of links.
    pub fn check_for(&self, kind: &str) -> Result<(), SizesError> {
        let found = self.field();
        let Some(own) = Sizes::of_kind(kind) else {
            return Err(SizesError::OwnKind { kind: kind.to_owned(), found });
        };
        match (self, &own) {
            (Sizes::Arm(arm), Sizes::Arm(own)) if arm.lengths.len() != own.lengths.len() => {
                let (found, expected) = (arm.lengths.len(), own.lengths.len());
                return Err(SizesError::Links { kind: kind.to_owned(), found, expected });
            }
            _ if found != own.field() => {
                return Err(SizesError::Kind { kind: kind.to_owned(), found, expected: own.field() });
            }
            _ => {}
        }
        self.check()
    }
}
