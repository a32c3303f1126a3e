//! `BoxTable`, the boxes around elements that were measured, and what may still be measured.

use std::collections::BTreeMap;

use roxmltree::Node;

use crate::{ImportError, ImportProblem};
use motion_lab_core::geometry::Aabb;

/// Bytes of the attributes of all elements that are measured, a hundred for each of them: an element is measured once
/// for each element around it whose box is asked for.
const MAX_MEASURED: usize = 1 << 26;

/// Depth of elements that are transformed about their boxes.
pub(crate) const MAX_BOX_DEPTH: usize = 20;

/// An element, and the bits of what its lengths are measured by.
type BoxKey = (usize, [u64; 5]);

/// The boxes found so far, and what may still be measured.
pub(crate) struct BoxTable {
    pub known: BTreeMap<BoxKey, Option<Aabb>>,
    room: usize,
    pub depth: usize,
}

impl Default for BoxTable {
    fn default() -> Self {
        BoxTable { known: BTreeMap::new(), room: MAX_MEASURED, depth: 0 }
    }
}

impl BoxTable {
    /// Counts an element that is measured.
    pub fn take(&mut self, node: Node) -> Result<(), ImportError> {
        let work = 100 + node.attributes().map(|attribute| attribute.value().len()).sum::<usize>();
        let left = self.room.checked_sub(work);
        self.room = left.ok_or_else(|| ImportProblem::Unsupported("boxes around very many elements".into()))?;
        Ok(())
    }
}
