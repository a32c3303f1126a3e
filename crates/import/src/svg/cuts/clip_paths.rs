//! Reads clip paths while a drawing is walked through.

use roxmltree::Node;

use super::clips::{ClipRegion, ClipShape};
use crate::planar::{Affine, CurvedPart, beyond, extent, is_coarse, outline};
use crate::svg::check::attribute;
use crate::svg::lengths::{Along, LengthScale};
use crate::svg::shapes::parts;
use crate::svg::style::StyleTable;
use crate::svg::uses::{href, is_drawn, url_target};
use crate::svg::walk::{CutElement, SvgWalk, mapped, scale_of};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::worlds::MAX_ITEMS;

/// Bytes of the attributes of all clip paths together, a hundred for each of their elements and of the pieces whose box
/// is asked for, ten for each element around them, and eight for each point of their lines. A clip path is read for
/// each transform under which it is used.
const MAX_CLIP_WORK: usize = 8 << 20;

/// Depth of clip paths that are cut themselves.
pub(super) const MAX_CLIP_DEPTH: usize = 10;

/// Why an element is left out.
pub(super) type LeftOut = String;

impl<'a> SvgWalk<'a, '_> {
    /// Cuts an element as a clip path says.
    pub fn clip(&mut self, element: &CutElement<'a>, text: &str) -> Result<(), LeftOut> {
        let Some(id) = url_target(text) else { return self.clip_by_shape(element, text) };
        // as in browsers, one that is not there cuts nothing
        let Some(target) = self.targets.get(id).copied().filter(|t| t.tag_name().name() == "clipPath") else {
            return Ok(());
        };
        let mut map = element.around.map;
        if attribute(target, "clipPathUnits") == Some("objectBoundingBox") {
            map = self.box_map(element)?;
        }
        let style = ClipStyle::USUAL;
        let region =
            self.clip_region(target, &ClipContext { map, scale: scale_of(&element.around), style, depth: 0 })?;
        self.cut(region, element.from);
        Ok(())
    }

    /// The map to metres from parts of the box around an element.
    pub(super) fn box_map(&mut self, element: &CutElement<'a>) -> Result<Affine, LeftOut> {
        let Aabb { min, max } = self.fill_box(element.node, &element.around).ok_or("it has no box to cut")?;
        let size = max - min;
        Ok(element.around.map.after(&Affine([size.x, 0.0, 0.0, size.y, min.x, min.y])))
    }

    /// Counts work, by the measure of [`MAX_CLIP_WORK`].
    pub(super) fn spend(&mut self, work: usize) -> Result<(), LeftOut> {
        self.clip_work = self.clip_work.saturating_add(work);
        if self.clip_work > MAX_CLIP_WORK {
            return Err("the clip paths of the drawing are too large".into());
        }
        Ok(())
    }

    /// Reads a clip path under a map from its units to metres.
    fn clip_region(&mut self, node: Node<'a, 'a>, around: &ClipContext) -> Result<usize, LeftOut> {
        let key = (node.id().get_usize(), around.map.0.map(f64::to_bits));
        if let Some(known) = self.clips_read.get(&key) {
            return Ok(*known);
        }
        if around.depth > MAX_CLIP_DEPTH {
            return Err("its clip paths are nested too deeply".into());
        }
        let ancestors: Vec<Node> = node.ancestors().skip(1).collect();
        self.spend(reading_work(node) + 10 * ancestors.len())?;
        // a clip path inherits from the elements around it, not from what it cuts
        let style = ancestors.iter().rev().fold(ClipStyle::USUAL, |style, node| style.at(*node, self.styles));
        let inner = ClipContext { style, ..*around };
        let inner = self.clip_context(node, &inner).ok_or("the transform of its clip path is not understood")?;
        let mut region = ClipRegion { clips: self.clips_of(node, &inner)?, ..ClipRegion::default() };
        for child in node.children().filter(is_drawn) {
            region.shapes.extend(self.clip_shape(child, &inner)?);
        }
        let index = self.clips.add(region);
        self.clips_read.insert(key, index);
        Ok(index)
    }

    /// Where an element stands within, with its style and its transform; `None` if that is not understood.
    fn clip_context(&mut self, node: Node<'a, 'a>, around: &ClipContext) -> Option<ClipContext> {
        let map = around.map.after(&self.own_map(node, &around.scale)?);
        Some(ClipContext { map, style: around.style.at(node, self.styles), ..*around })
    }

    /// The transform of an element of a clip path or a mask; `None` if it is not understood.
    pub(super) fn own_map(&mut self, node: Node<'a, 'a>, scale: &LengthScale) -> Option<Affine> {
        let styles = self.styles;
        let Some(text) = styles.own(node, "transform") else { return Some(Affine::IDENTITY) };
        self.transform(node, text, scale, |_| extent(&parts(node, scale).ok()?.0))
    }

    /// The regions that cut an element of a clip path, or the clip path itself.
    fn clips_of(&mut self, node: Node<'a, 'a>, around: &ClipContext) -> Result<Vec<usize>, LeftOut> {
        let text = self.styles.own(node, "clip-path").filter(|text| !matches!(*text, "none" | "initial"));
        if text.is_some_and(|text| url_target(text).is_none()) {
            return Err("its clip path is cut by a shape of a style sheet".into());
        }
        let target = text.and_then(url_target).and_then(|id| self.targets.get(id));
        let Some(target) = target.copied().filter(|target| target.tag_name().name() == "clipPath") else {
            return Ok(Vec::new());
        };
        if attribute(target, "clipPathUnits") == Some("objectBoundingBox") {
            return Err("its clip path is cut by the box around another shape".into());
        }
        Ok(vec![self.clip_region(target, &around.deeper())?])
    }

    /// The closed lines of what cuts, metres. Errors call it `what`.
    pub(super) fn rings(
        &mut self,
        parts: &[CurvedPart],
        map: &Affine,
        what: &str,
    ) -> Result<Vec<Vec<Point2>>, LeftOut> {
        let is_coarse = is_coarse(parts, map);
        let parts = mapped(parts, map);
        if is_coarse || beyond(&parts).is_some() {
            return Err(format!("{what} reaches too far"));
        }
        let mut room = MAX_ITEMS;
        let ring = |part: &CurvedPart| Some(outline(part, self.tolerance, &mut room)?.points);
        let rings: Option<Vec<_>> = parts.iter().map(ring).collect();
        let rings = rings.ok_or_else(|| format!("the curves of {what} are too large"))?;
        self.spend(8 * rings.iter().map(Vec::len).sum::<usize>())?;
        Ok(rings)
    }

    /// Reads one shape of a clip path; `None` if it does not show.
    fn clip_shape(&mut self, node: Node<'a, 'a>, around: &ClipContext) -> Result<Option<ClipShape>, LeftOut> {
        self.spend(reading_work(node))?;
        if self.styles.own(node, "display") == Some("none") || around.depth > MAX_CLIP_DEPTH {
            return Ok(None);
        }
        let inner = self.clip_context(node, around).ok_or("a transform in its clip path is not understood")?;
        match node.tag_name().name() {
            "use" => {
                let clips = self.clips_of(node, &inner)?;
                let target = href(&node).and_then(|href| self.targets.get(href.strip_prefix('#')?)).copied();
                let length = |name: &str, along: Along| {
                    attribute(node, name).and_then(|text| around.scale.length(text, along)).unwrap_or(0.0)
                };
                let map = inner.map.after(&Affine::translate(length("x", Along::X), length("y", Along::Y)));
                let inner = ClipContext { map, ..inner.deeper() };
                let shape = target.map(|target| self.clip_shape(target, &inner)).transpose()?.flatten();
                Ok(shape.map(|mut shape| {
                    shape.clips.extend(clips);
                    shape
                }))
            }
            "path" | "rect" | "circle" | "ellipse" | "polyline" | "polygon" if !inner.style.is_hidden => {
                let clips = self.clips_of(node, &inner)?;
                let parts =
                    parts(node, &around.scale).map_err(|error| format!("its clip path has {}", error.problem))?;
                let rings = self.rings(&parts.0, &inner.map, "its clip path")?;
                Ok(Some(ClipShape::new(rings, inner.style.is_even_odd, clips)))
            }
            "text" if !inner.style.is_hidden => Err("its clip path is a text".into()),
            _ => Ok(None),
        }
    }
}

/// Where an element of a clip path stands.
#[derive(Clone, Copy)]
struct ClipContext {
    /// From the element's units to metres.
    map: Affine,
    scale: LengthScale,
    style: ClipStyle,
    /// The number of clip paths and of `use` around it.
    depth: usize,
}

impl ClipContext {
    fn deeper(&self) -> Self {
        ClipContext { depth: self.depth + 1, ..*self }
    }
}

/// What a shape of a clip path inherits from the elements around it.
#[derive(Clone, Copy)]
struct ClipStyle {
    is_hidden: bool,
    is_even_odd: bool,
}

impl ClipStyle {
    const USUAL: ClipStyle = ClipStyle { is_hidden: false, is_even_odd: false };

    fn at(&self, node: Node, styles: &StyleTable) -> Self {
        ClipStyle {
            is_hidden: styles.is_hidden(node, self.is_hidden),
            is_even_odd: styles.is_even_odd(node, "clip-rule", self.is_even_odd),
        }
    }
}

/// What it takes to read an element, by the measure of [`MAX_CLIP_WORK`].
pub(super) fn reading_work(node: Node) -> usize {
    100 + node.attributes().map(|attribute| attribute.value().len()).sum::<usize>()
}
