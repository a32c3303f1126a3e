//! Reads clip paths while a drawing is walked through.

use roxmltree::Node;

use super::check::attribute;
use super::clips::{ClipRegion, ClipShape, Extent2};
use super::lengths::{Along, LengthScale};
use super::shapes::parts;
use super::uses::{href, is_drawn, url_target};
use super::walk::{SvgWalk, WalkContext, scale_of};
use crate::planar::{Affine, CurvedPart, outline};
use motion_lab_core::worlds::MAX_ITEMS;

/// Bytes of the attributes of all clip paths together, a hundred for each of their shapes and of the pieces whose box
/// is asked for, and eight for each point of their lines. A clip path is read for each transform under which it is
/// used.
const MAX_CLIP_WORK: usize = 8 << 20;

/// Depth of clip paths that are cut themselves.
const MAX_CLIP_DEPTH: usize = 10;

/// Why an element is left out.
type LeftOut = String;

impl<'a> SvgWalk<'a, '_> {
    /// Cuts the shapes from `before` on as a property says.
    pub fn clip(&mut self, text: &str, around: &WalkContext<'a>, before: usize) -> Result<(), LeftOut> {
        let Some(id) = url_target(text) else { return Err("its clip path is not of the drawing".into()) };
        // as in browsers, one that is not there cuts nothing
        let Some(target) = self.targets.get(id).copied().filter(|t| t.tag_name().name() == "clipPath") else {
            return Ok(());
        };
        let mut map = around.map;
        if attribute(target, "clipPathUnits") == Some("objectBoundingBox") {
            let back = map.inverse().ok_or("its transform flattens it")?;
            let parts: Vec<CurvedPart> =
                self.shapes[before..].iter().flat_map(|shape| &shape.parts).map(|part| part.mapped(&back)).collect();
            self.spend(parts.iter().map(|part| 100 * (1 + part.pieces.len())).sum())?;
            let Extent2 { min, max } = self.extent(&parts).ok_or("it has no box to cut")?;
            let size = max - min;
            map = map.after(&Affine([size.x, 0.0, 0.0, size.y, min.x, min.y]));
        }
        let region = self.clip_region(target, map, &scale_of(around), 0)?;
        self.cut(region, before);
        Ok(())
    }

    /// Counts work, by the measure of [`MAX_CLIP_WORK`].
    fn spend(&mut self, work: usize) -> Result<(), LeftOut> {
        self.clip_work = self.clip_work.saturating_add(work);
        if self.clip_work > MAX_CLIP_WORK {
            return Err("the clip paths of the drawing are too large".into());
        }
        Ok(())
    }

    /// Reads a clip path under a map from its units to metres.
    fn clip_region(
        &mut self,
        node: Node<'a, 'a>,
        map: Affine,
        scale: &LengthScale,
        depth: usize,
    ) -> Result<usize, LeftOut> {
        let key = (node.id().get_usize(), map.0.map(f64::to_bits));
        if let Some(known) = self.clips_read.get(&key) {
            return Ok(*known);
        }
        if depth > MAX_CLIP_DEPTH {
            return Err("its clip paths are nested too deeply".into());
        }
        let map = match self.styles.own(node, "transform").map(|text| self.transform(node, text, scale)) {
            Some(own) => map.after(&own.ok_or("the transform of its clip path is not understood")?),
            None => map,
        };
        let mut region = ClipRegion { clips: self.clips_of(node, map, scale, depth)?, ..ClipRegion::default() };
        for child in node.children().filter(is_drawn) {
            region.shapes.extend(self.clip_shape(child, map, scale, depth)?);
        }
        let index = self.clips.add(region);
        self.clips_read.insert(key, index);
        Ok(index)
    }

    /// The regions that cut an element of a clip path, or the clip path itself.
    fn clips_of(
        &mut self,
        node: Node<'a, 'a>,
        map: Affine,
        scale: &LengthScale,
        depth: usize,
    ) -> Result<Vec<usize>, LeftOut> {
        let target = self.styles.own(node, "clip-path").and_then(url_target).and_then(|id| self.targets.get(id));
        let Some(target) = target.copied().filter(|target| target.tag_name().name() == "clipPath") else {
            return Ok(Vec::new());
        };
        if attribute(target, "clipPathUnits") == Some("objectBoundingBox") {
            return Err("its clip path is cut by the box around another shape".into());
        }
        Ok(vec![self.clip_region(target, map, scale, depth + 1)?])
    }

    /// Reads one shape of a clip path; `None` if it does not show.
    fn clip_shape(
        &mut self,
        node: Node<'a, 'a>,
        map: Affine,
        scale: &LengthScale,
        depth: usize,
    ) -> Result<Option<ClipShape>, LeftOut> {
        let own = |node: Node, property: &str| self.styles.own(node, property).map(str::to_owned);
        let is_hidden = node.ancestors().find_map(|n| own(n, "visibility")).is_some_and(|word| word != "visible");
        if own(node, "display").as_deref() == Some("none") || is_hidden || depth > MAX_CLIP_DEPTH {
            return Ok(None);
        }
        let map = match own(node, "transform").map(|text| self.transform(node, &text, scale)) {
            Some(own) => map.after(&own.ok_or("a transform in its clip path is not understood")?),
            None => map,
        };
        let clips = self.clips_of(node, map, scale, depth)?;
        match node.tag_name().name() {
            "use" => {
                let target = href(&node).and_then(|href| self.targets.get(href.strip_prefix('#')?)).copied();
                let length =
                    |name: &str, along: Along| attribute(node, name).and_then(|text| scale.length(text, along));
                let map = map.after(&Affine::translate(
                    length("x", Along::X).unwrap_or(0.0),
                    length("y", Along::Y).unwrap_or(0.0),
                ));
                let shape = target.map(|target| self.clip_shape(target, map, scale, depth + 1)).transpose()?.flatten();
                Ok(shape.map(|mut shape| {
                    shape.clips.extend(clips);
                    shape
                }))
            }
            "path" | "rect" | "circle" | "ellipse" | "polyline" | "polygon" => {
                self.spend(100 + node.attributes().map(|a| a.value().len()).sum::<usize>())?;
                let parts = parts(node, scale).map_err(|error| format!("its clip path has {}", error.problem))?.0;
                let mut room = MAX_ITEMS;
                let ring = |part: &CurvedPart| Some(outline(&part.mapped(&map), self.tolerance, &mut room)?.points);
                let rings: Option<Vec<_>> = parts.iter().map(ring).collect();
                let even_odd = node.ancestors().find_map(|n| own(n, "clip-rule")).is_some_and(|rule| rule == "evenodd");
                let rings = rings.ok_or("the curves of its clip path are too large")?;
                self.spend(8 * rings.iter().map(Vec::len).sum::<usize>())?;
                Ok(Some(ClipShape::new(rings, even_odd, clips)))
            }
            "text" => Err("its clip path is a text".into()),
            _ => Ok(None),
        }
    }
}
