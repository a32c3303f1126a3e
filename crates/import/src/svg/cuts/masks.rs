//! Reads masks while a drawing is walked through: those that let through all or nothing cut as clip paths do.

use roxmltree::Node;
use svgtypes::Color;

use super::clip_paths::{LeftOut, reading_work};
use super::clips::{ClipRegion, ClipShape};
use crate::planar::{Affine, CurvedPart};
use crate::svg::check::attribute;
use crate::svg::lengths::{Along, LengthScale, ratio};
use crate::svg::shapes::parts;
use crate::svg::style::StyleTable;
use crate::svg::uses::{href, is_drawn, url_target};
use crate::svg::walk::{CutElement, SvgWalk, scale_of};
use motion_lab_core::geometry::Point2;

/// Depth of the elements of a mask.
const MAX_MASK_DEPTH: usize = 50;

/// Largest number of times that a mask hides again what it has shown before.
const MAX_MASK_LAYERS: usize = 20;

/// What a mask's paint lets through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MaskPaint {
    /// Nothing is painted.
    None,
    /// All: white.
    All,
    /// Nothing: black.
    Nothing,
    /// A part of it, by its colour.
    Gray,
    /// A part of it, by its opacity, or what is not known.
    Some,
    /// As the element's `color`.
    CurrentColor,
}

/// Where an element of a mask stands.
#[derive(Clone, Copy)]
struct MaskContext {
    /// From the element's units to metres.
    map: Affine,
    scale: LengthScale,
    style: MaskStyle,
    depth: usize,
}

/// What an element of a mask inherits.
#[derive(Clone, Copy)]
struct MaskStyle {
    fill: MaskPaint,
    stroke: MaskPaint,
    color: MaskPaint,
    fill_opacity: f64,
    stroke_opacity: f64,
    is_hidden: bool,
    is_even_odd: bool,
    /// Whether the mask shows what is opaque, whatever its colour.
    is_of_alpha: bool,
}

/// What a mask lets through, as far as it is painted.
#[derive(Default)]
struct MaskLayers {
    shown: Vec<ClipShape>,
    count: usize,
}

impl<'a> SvgWalk<'a, '_> {
    /// Cuts an element as a mask says.
    pub fn mask(&mut self, element: &CutElement<'a>, text: &str) -> Result<(), LeftOut> {
        let id = url_target(text).ok_or("its mask is not of the drawing")?;
        if !text.trim().ends_with(')') || text.matches("url(").count() > 1 {
            return Err("its mask is more than one element".into());
        }
        // as in browsers, one that is not there hides nothing
        let Some(mask) = self.targets.get(id).copied() else { return Ok(()) };
        if mask.tag_name().name() != "mask" {
            return Err("its mask is no mask element".into());
        }
        let of_box = |name: &str, usual: bool| match attribute(mask, name) {
            Some("objectBoundingBox") => true,
            Some("userSpaceOnUse") => false,
            _ => usual,
        };
        if let Some(ring) = self.mask_bounds(mask, element, of_box("maskUnits", true))? {
            let rings = self.rings(&[CurvedPart::ring(&ring.0)], &ring.1, "its mask")?;
            self.cut_at(vec![ClipShape::new(rings, false, Vec::new())], element.from);
        }
        let mut map = element.around.map;
        if of_box("maskContentUnits", false) {
            map = self.box_map(element)?;
        }
        let key = (mask.id().get_usize(), map.0.map(f64::to_bits));
        if let Some(known) = self.clips_read.get(&key) {
            self.cut(*known, element.from);
            return Ok(());
        }
        let shown =
            self.mask_content(mask, MaskContext { map, ..MaskContext::outermost(scale_of(&element.around)) })?;
        let region = self.cut_at(shown, element.from);
        self.clips_read.insert(key, region);
        Ok(())
    }

    /// Cuts the shapes from this one on at these shapes; returns the region that they are.
    pub(super) fn cut_at(&mut self, shapes: Vec<ClipShape>, from: usize) -> usize {
        let region = self.clips.add(ClipRegion { shapes, ..ClipRegion::default() });
        self.cut(region, from);
        region
    }

    /// The corners of a mask's rectangle and the map from their units to metres; `None` if it is the usual one, which
    /// is larger than what is masked.
    fn mask_bounds(
        &mut self,
        mask: Node,
        element: &CutElement<'a>,
        is_of_box: bool,
    ) -> Result<Option<([Point2; 4], Affine)>, LeftOut> {
        const SIDES: [&str; 4] = ["x", "y", "width", "height"];
        const USUAL: [f64; 4] = [-0.1, -0.1, 1.2, 1.2];
        if is_of_box && SIDES.iter().all(|name| attribute(mask, name).is_none()) {
            return Ok(None);
        }
        let around = &element.around;
        let (scale, (width, height)) = (scale_of(around), around.viewport);
        let wholes = [width, height, width, height];
        let side = |i: usize| match attribute(mask, SIDES[i]) {
            None => Some(if is_of_box { USUAL[i] } else { USUAL[i] * wholes[i] }),
            Some(text) if is_of_box => ratio(text),
            Some(text) => scale.length(text, if i.is_multiple_of(2) { Along::X } else { Along::Y }),
        };
        let [Some(x), Some(y), Some(width), Some(height)] = [0, 1, 2, 3].map(side) else {
            return Err("the rectangle of its mask is not understood".into());
        };
        let (width, height) = if width > 0.0 && height > 0.0 { (width, height) } else { (0.0, 0.0) };
        let map = if is_of_box { self.box_map(element)? } else { around.map };
        let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
        Ok(Some((corners.map(|(x, y)| Point2::new(x, y)), map)))
    }

    /// What a mask lets through.
    fn mask_content(&mut self, mask: Node<'a, 'a>, outermost: MaskContext) -> Result<Vec<ClipShape>, LeftOut> {
        let ancestors: Vec<Node> = mask.ancestors().skip(1).collect();
        self.spend(reading_work(mask) + 10 * ancestors.len())?;
        // a mask inherits from the elements around it, not from what it hides
        let style = { ancestors }.iter().rev().fold(outermost.style, |style, node| style.at(*node, self.styles));
        let is_of_alpha = self.styles.own(mask, "mask-type") == Some("alpha");
        let around = MaskContext { style: MaskStyle { is_of_alpha, ..style }, ..outermost };
        self.refuse_effects(mask)?;
        let inner = MaskContext { style: around.style.at(mask, self.styles), ..around };
        let mut layers = MaskLayers::default();
        self.mask_children(mask, &inner, &mut layers)?;
        Ok(layers.shown)
    }

    fn mask_children(&mut self, node: Node<'a, 'a>, around: &MaskContext, to: &mut MaskLayers) -> Result<(), LeftOut> {
        node.children().filter(is_drawn).try_for_each(|child| self.mask_element(child, around, to))
    }

    /// Refuses what makes of an element more than its fill: it would let through a part of what it covers.
    fn refuse_effects(&self, node: Node) -> Result<(), LeftOut> {
        let has =
            |property: &str| self.styles.own(node, property).is_some_and(|text| !matches!(text, "none" | "initial"));
        for (property, what) in
            [("mask", "a mask"), ("mask-image", "a mask"), ("filter", "a filter"), ("clip-path", "a clip path")]
        {
            if has(property) {
                return Err(format!("its mask has {what} itself"));
            }
        }
        Ok(())
    }

    /// Adds what an element of a mask shows or hides.
    fn mask_element(&mut self, node: Node<'a, 'a>, around: &MaskContext, to: &mut MaskLayers) -> Result<(), LeftOut> {
        self.spend(reading_work(node))?;
        let opacity = self.styles.own(node, "opacity").and_then(ratio).unwrap_or(1.0);
        if self.styles.own(node, "display") == Some("none") || opacity <= 0.0 {
            return Ok(());
        }
        if around.depth > MAX_MASK_DEPTH {
            return Err("its mask is nested too deeply".into());
        }
        let name = node.tag_name().name();
        if !matches!(name, "g" | "a" | "use" | "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon")
        {
            let is_painted = matches!(name, "text" | "image" | "foreignObject" | "svg" | "switch");
            let article = if name == "image" { "an" } else { "a" };
            return if is_painted { Err(format!("its mask holds {article} {name}")) } else { Ok(()) };
        }
        self.refuse_effects(node)?;
        if opacity < 1.0 {
            return Err("its mask is opaque in part".into());
        }
        let own = self.own_map(node, &around.scale).ok_or("a transform in its mask is not understood")?;
        let style = around.style.at(node, self.styles);
        let inner = MaskContext { map: around.map.after(&own), style, depth: around.depth + 1, ..*around };
        match name {
            "g" | "a" => self.mask_children(node, &inner, to),
            "use" => self.mask_use(node, &inner, to),
            _ => self.mask_shape(node, &inner, to),
        }
    }

    fn mask_use(&mut self, node: Node<'a, 'a>, around: &MaskContext, to: &mut MaskLayers) -> Result<(), LeftOut> {
        let target = href(&node).and_then(|href| self.targets.get(href.strip_prefix('#')?)).copied();
        let Some(target) = target.filter(is_drawn) else { return Ok(()) };
        if target.tag_name().name() == "symbol" {
            return Err("its mask holds a symbol".into());
        }
        let length = |name: &str, along: Along| attribute(node, name).and_then(|text| around.scale.length(text, along));
        let moved = Affine::translate(length("x", Along::X).unwrap_or(0.0), length("y", Along::Y).unwrap_or(0.0));
        self.mask_element(target, &MaskContext { map: around.map.after(&moved), ..*around }, to)
    }

    fn mask_shape(&mut self, node: Node<'a, 'a>, around: &MaskContext, to: &mut MaskLayers) -> Result<(), LeftOut> {
        let style = around.style;
        if style.is_hidden {
            return Ok(());
        }
        if style.paint(style.stroke, style.stroke_opacity) != MaskPaint::None {
            return Err("its mask has lines".into());
        }
        let paint = style.paint(style.fill, style.fill_opacity);
        let is_line = node.tag_name().name() == "line";
        if is_line || paint == MaskPaint::None {
            return Ok(());
        }
        let parts = parts(node, &around.scale).map_err(|error| format!("its mask has {}", error.problem))?.0;
        let rings = self.rings(&parts, &around.map, "its mask")?;
        let shape = ClipShape::new(rings, style.is_even_odd, Vec::new());
        match paint {
            MaskPaint::All => to.shown.push(shape),
            MaskPaint::Nothing => self.hide(shape, to)?,
            _ => return Err("its mask lets through a part of the paint".into()),
        }
        Ok(())
    }

    /// Takes a shape off what has been shown so far.
    fn hide(&mut self, shape: ClipShape, layers: &mut MaskLayers) -> Result<(), LeftOut> {
        if layers.shown.is_empty() {
            return Ok(());
        }
        layers.count += 1;
        if layers.count > MAX_MASK_LAYERS {
            return Err(format!("its mask hides more than {MAX_MASK_LAYERS} times what it has shown"));
        }
        let outside = self.clips.add(ClipRegion { shapes: vec![shape.inverted()], ..ClipRegion::default() });
        let shapes = std::mem::take(&mut layers.shown);
        let left = self.clips.add(ClipRegion { shapes, clips: vec![outside], ..ClipRegion::default() });
        layers.shown = vec![ClipShape::of_region(left)];
        Ok(())
    }
}

impl MaskContext {
    fn outermost(scale: LengthScale) -> Self {
        let style = MaskStyle {
            fill: MaskPaint::Nothing,
            stroke: MaskPaint::None,
            color: MaskPaint::Nothing,
            fill_opacity: 1.0,
            stroke_opacity: 1.0,
            is_hidden: false,
            is_even_odd: false,
            is_of_alpha: false,
        };
        MaskContext { map: Affine::IDENTITY, scale, style, depth: 0 }
    }
}

impl MaskStyle {
    fn at(&self, node: Node, styles: &StyleTable) -> Self {
        let own = |property: &str| styles.own(node, property);
        let color = own("color").map(MaskPaint::of).filter(|color| *color != MaskPaint::CurrentColor);
        let initial = |text: &str, paint: MaskPaint| if text == "initial" { paint } else { MaskPaint::of(text) };
        MaskStyle {
            fill: own("fill").map_or(self.fill, |text| initial(text, MaskPaint::Nothing)),
            stroke: own("stroke").map_or(self.stroke, |text| initial(text, MaskPaint::None)),
            color: color.unwrap_or(self.color),
            fill_opacity: own("fill-opacity").and_then(ratio).unwrap_or(self.fill_opacity),
            stroke_opacity: own("stroke-opacity").and_then(ratio).unwrap_or(self.stroke_opacity),
            is_hidden: styles.is_hidden(node, self.is_hidden),
            is_even_odd: styles.is_even_odd(node, "fill-rule", self.is_even_odd),
            is_of_alpha: self.is_of_alpha,
        }
    }

    /// What a paint of this opacity lets through.
    fn paint(&self, paint: MaskPaint, opacity: f64) -> MaskPaint {
        let paint = if paint == MaskPaint::CurrentColor { self.color } else { paint };
        match paint {
            _ if opacity <= 0.0 => MaskPaint::None,
            MaskPaint::None => MaskPaint::None,
            _ if opacity < 1.0 => MaskPaint::Some,
            MaskPaint::Nothing | MaskPaint::Gray if self.is_of_alpha => MaskPaint::All,
            paint => paint,
        }
    }
}

impl MaskPaint {
    /// What a colour lets through: its luminance, if it is opaque.
    fn of(text: &str) -> Self {
        let text = text.trim();
        if text.eq_ignore_ascii_case("currentcolor") {
            return MaskPaint::CurrentColor;
        }
        if text == "none" || text == "transparent" {
            return MaskPaint::None;
        }
        match text.parse::<Color>() {
            Ok(Color { alpha: 0, .. }) => MaskPaint::None,
            Ok(Color { red: 255, green: 255, blue: 255, alpha: 255 }) => MaskPaint::All,
            Ok(Color { red: 0, green: 0, blue: 0, alpha: 255 }) => MaskPaint::Nothing,
            Ok(Color { alpha: 255, .. }) => MaskPaint::Gray,
            _ => MaskPaint::Some,
        }
    }
}
