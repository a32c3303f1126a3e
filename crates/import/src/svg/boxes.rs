//! The boxes around elements in their own units, painted or not: what transforms and clip paths are measured by.

use std::rc::Rc;

use roxmltree::Node;

use super::measured::MAX_BOX_DEPTH;
use super::walk::{SvgWalk, WalkContext, scale_of};
use crate::draft::WorldDraft;
use crate::planar::{Affine, extent};
use motion_lab_core::geometry::Aabb;

impl<'a> SvgWalk<'a, '_> {
    /// The box around what an element holds, in its own units, whether it is painted or cut or not: the least one, as
    /// SVG 2 has it; Chromium takes a larger one around what is turned within. `None` if it holds nothing, or if
    /// measuring it takes too much.
    pub fn fill_box(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) -> Option<Aabb> {
        let scale = scale_of(around);
        let [width, height] = around.size.map(|side| side.unwrap_or(f64::NAN));
        let lengths = [scale.viewport.0, scale.viewport.1, scale.font_size, width, height];
        let key = (node.id().get_usize(), lengths.map(f64::to_bits));
        if let Some(known) = self.boxes.known.get(&key) {
            return *known;
        }
        if self.boxes.depth == MAX_BOX_DEPTH {
            return None;
        }
        let mut draft = WorldDraft::default();
        let painter = Rc::clone(&self.painter);
        let mut walk = SvgWalk::new(self.styles, self.targets, self.labels, self.tolerance, painter, &mut draft);
        walk.is_measuring = true;
        walk.boxes = std::mem::take(&mut self.boxes);
        walk.boxes.depth += 1;
        let inner = WalkContext { map: Affine::IDENTITY, ..*around };
        let walked = walk.content(node, &inner).and_then(|()| walk.run());
        let parts = walk.shapes.iter().flat_map(|shape| &shape.parts);
        let found = walked.ok().and_then(|()| extent(parts));
        self.boxes = walk.boxes;
        self.boxes.depth -= 1;
        self.boxes.known.insert(key, found);
        found
    }
}
