//! Walks through a drawing and collects the shapes that it paints, in metres.

use std::collections::BTreeMap;
use std::rc::Rc;

use roxmltree::Node;

use super::check::{Labels, at, attribute};
use super::cuts::clips::{ClipRegion, ClipShape, ClipTable};
use super::lengths::{Along, LengthScale, ratio};
use super::measured::BoxTable;
use super::paint::{FONT_SIZE, Inherited, Painter};
use super::shapes::parts;
use super::style::StyleTable;
use super::transforms::{ReferenceBox, transform_list, transform_origin};
use super::uses::{Targets, href, is_drawn};
use super::viewport::{ViewRect, fit, view_box};
use crate::draft::WorldDraft;
use crate::planar::{Affine, CurvedPart, beyond, is_coarse};
use crate::{ImportError, ImportProblem};
use motion_lab_core::geometry::{Aabb, Point2};

/// A shape that shows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DrawnShape<'a> {
    /// The id of its element, or of the `use` that repeats it; empty if there is none.
    pub id: &'a str,
    pub element: Node<'a, 'a>,
    pub parts: Vec<CurvedPart>,
    pub filled: bool,
    pub stroked: bool,
    pub even_odd: bool,
    /// The regions that cut it.
    pub clips: Vec<usize>,
}

/// Where an element stands.
#[derive(Clone, Copy)]
pub(crate) struct WalkContext<'s> {
    /// From the element's units to metres.
    pub map: Affine,
    pub style: Inherited,
    pub viewport: (f64, f64),
    /// The id of the `use` that repeats the element.
    pub repeated_by: Option<&'s str>,
    /// Width and height that a `use` gives.
    pub size: [Option<f64>; 2],
}

/// Largest number of regions of all shapes together: regions may be nested as deeply as elements.
const MAX_CUTS: usize = 1_000_000;

/// Walks through a drawing: its elements as steps still to be done, the shapes found so far.
pub(crate) struct SvgWalk<'a, 'd> {
    pub styles: &'a StyleTable,
    pub targets: &'a Targets<'a>,
    pub painter: Rc<Painter<'a>>,
    pub labels: &'a Labels,
    pub tolerance: f64,
    pub draft: &'d mut WorldDraft,
    pub clips: ClipTable,
    pub shapes: Vec<DrawnShape<'a>>,
    steps: Vec<WalkStep<'a>>,
    cuts: usize,
    pub clips_read: BTreeMap<(usize, [u64; 6]), usize>,
    /// What the clip paths that were read have taken.
    pub clip_work: usize,
    /// Whether only the boxes around elements are asked for: what is painted and what is cut does not matter.
    pub is_measuring: bool,
    /// Whether the map leads to metres, so that shapes that lose digits are refused.
    pub is_placed: bool,
    pub boxes: BoxTable,
}

/// What cuts an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CutKind {
    ClipPath,
    Mask,
}

/// An element to cut.
pub struct CutElement<'a> {
    pub node: Node<'a, 'a>,
    /// Where it stands, its own transform included.
    pub around: WalkContext<'a>,
    /// Its first shape; all that follow are its own too.
    pub from: usize,
}

/// What is still to be done; the last comes first.
enum WalkStep<'a> {
    Element(Node<'a, 'a>, WalkContext<'a>),
    /// Cuts an element as the text of its clip path or its mask says.
    Cut(CutKind, CutElement<'a>, &'a str),
    /// Cuts the shapes from this one on at a region.
    Viewport {
        region: usize,
        from: usize,
    },
}

impl<'a, 'd> SvgWalk<'a, 'd> {
    pub fn new(
        styles: &'a StyleTable,
        targets: &'a Targets<'a>,
        labels: &'a Labels,
        tolerance: f64,
        painter: Rc<Painter<'a>>,
        draft: &'d mut WorldDraft,
    ) -> Self {
        SvgWalk {
            styles,
            targets,
            painter,
            labels,
            tolerance,
            draft,
            clips: ClipTable::default(),
            shapes: Vec::new(),
            steps: Vec::new(),
            cuts: 0,
            clips_read: BTreeMap::new(),
            clip_work: 0,
            is_measuring: false,
            is_placed: false,
            boxes: BoxTable::default(),
        }
    }

    /// Walks through a drawing from its root element. `map` leads from the units of its content to metres. The walk
    /// ends: the elements have been counted, with every `use` expanded.
    pub fn drawing(&mut self, root: Node<'a, 'a>, map: Affine, viewport: (f64, f64)) -> Result<(), ImportError> {
        let around = WalkContext { map, style: Inherited::default(), viewport, repeated_by: None, size: [None; 2] };
        self.steps.push(WalkStep::Element(root, around));
        self.run()
    }

    /// Does what is still to be done.
    pub fn run(&mut self) -> Result<(), ImportError> {
        while let Some(step) = self.steps.pop() {
            match step {
                WalkStep::Element(node, around) => self.element(node, &around)?,
                WalkStep::Viewport { region, from } => self.cut(region, from),
                WalkStep::Cut(kind, element, text) => {
                    if self.shapes.len() > element.from
                        && let Err(why) = match kind {
                            CutKind::ClipPath => self.clip(&element, text),
                            CutKind::Mask => self.mask(&element, text),
                        }
                    {
                        self.shapes.truncate(element.from);
                        self.note(element.node, |label| format!("{label} is left out: {why}"));
                    }
                }
            }
        }
        match self.cuts {
            0..=MAX_CUTS => Ok(()),
            _ => Err(ImportProblem::Unsupported(format!(
                "more than {MAX_CUTS} cuts of shapes by clip paths and viewports"
            ))
            .into()),
        }
    }

    /// Cuts the shapes from this one on at a region.
    pub fn cut(&mut self, region: usize, from: usize) {
        self.cuts += self.shapes.len() - from;
        if self.cuts <= MAX_CUTS {
            self.shapes[from..].iter_mut().for_each(|shape| shape.clips.push(region));
        }
    }

    fn note(&mut self, node: Node, note: impl FnOnce(String) -> String) {
        self.draft.note(note(self.labels.of(node)));
    }

    fn element(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) -> Result<(), ImportError> {
        if self.is_measuring {
            self.boxes.take(node)?;
        }
        if !is_drawn(&node) || self.styles.own(node, "display") == Some("none") || !is_chosen(&node) {
            return Ok(());
        }
        match node.tag_name().name() {
            "image" | "foreignObject" => self.note(node, |label| format!("{label} is left out")),
            "svg" | "g" | "a" | "switch" | "use" | "path" | "rect" | "circle" | "ellipse" | "line" | "polyline"
            | "polygon" => return self.styled(node, around),
            _ => {}
        }
        Ok(())
    }

    /// An element with its style, its transform and what cuts it.
    fn styled(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) -> Result<(), ImportError> {
        let styles = self.styles;
        let own = |property: &str| styles.own(node, property);
        let mut inner =
            WalkContext { style: around.style.at(node, styles, &self.painter, &scale_of(around)), ..*around };
        if !self.is_measuring && own("opacity").and_then(ratio).is_some_and(|opacity| opacity <= 0.0) {
            self.draft.note("what is drawn invisibly is left out");
            return Ok(());
        }
        let scale = scale_of(&inner);
        let of_box = |walk: &mut Self| walk.fill_box(node, &inner);
        match own("transform").map(|text| self.transform(node, text, &scale, of_box)) {
            None => {}
            Some(Some(transform)) => inner.map = inner.map.after(&transform),
            // a box around what is not where it belongs is none
            Some(None) if self.is_measuring => {
                return Err(at(node, ImportProblem::Unsupported("a transform that is not understood".into())));
            }
            Some(None) => self.note(node, |label| format!("the transform of {label} is not understood or applied")),
        }
        const CUTS: [(&str, CutKind); 3] =
            [("clip-path", CutKind::ClipPath), ("mask", CutKind::Mask), ("mask-image", CutKind::Mask)];
        for (property, kind) in CUTS.into_iter().filter(|_| !self.is_measuring) {
            if let Some(text) = own(property).filter(|text| !matches!(*text, "none" | "initial")) {
                let element = CutElement { node, around: inner, from: self.shapes.len() };
                self.steps.push(WalkStep::Cut(kind, element, text));
            }
        }
        self.content(node, &inner)
    }

    /// What an element holds, without its own style and transform.
    pub fn content(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) -> Result<(), ImportError> {
        match node.tag_name().name() {
            "svg" if node.parent_element().is_some() => self.nested(node, around),
            "use" => self.repeated(node, around),
            "switch" => {
                let chosen = node.children().find(|child| is_drawn(child) && is_chosen(child));
                self.steps.extend(chosen.map(|child| WalkStep::Element(child, *around)));
            }
            "svg" | "g" | "a" => self.children(node, around),
            _ => return self.shape(node, around),
        }
        Ok(())
    }

    fn children(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) {
        let around = WalkContext { size: [None; 2], ..*around };
        let children = node.children().rev().filter(is_drawn);
        self.steps.extend(children.map(|child| WalkStep::Element(child, around)));
    }

    fn shape(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) -> Result<(), ImportError> {
        let (filled, stroked) = (around.style.fills(), around.style.strokes());
        let is_line = node.tag_name().name() == "line";
        if !self.is_measuring && (around.style.hidden || !(filled && !is_line || stroked)) {
            self.draft.note("what is drawn invisibly is left out");
            return Ok(());
        }
        let (parts, is_cut) = parts(node, &scale_of(around))?;
        if is_cut {
            self.note(node, |label| format!("{label} is drawn up to a mistake in its path"));
        }
        let images = mapped(&parts, &around.map);
        if self.is_placed && is_coarse(&parts, &around.map) && beyond(&images).is_none() {
            let problem = "numbers that stand for more than a million kilometres: too few digits are left of them";
            return Err(at(node, ImportProblem::Unsupported(problem.into())));
        }
        let id = around.repeated_by.or(attribute(node, "id")).unwrap_or_default();
        let (even_odd, clips) = (around.style.even_odd, Vec::new());
        let filled = filled && !is_line;
        self.shapes.push(DrawnShape { id, element: node, parts: images, filled, stroked, even_odd, clips });
        Ok(())
    }

    /// What a `use` repeats.
    fn repeated(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) {
        let Some(target) = href(&node).and_then(|href| self.targets.get(href.strip_prefix('#')?)).copied() else {
            return;
        };
        let scale = scale_of(around);
        let length = |name: &str, along: Along| attribute(node, name).and_then(|text| scale.length(text, along));
        let (x, y) = (length("x", Along::X).unwrap_or(0.0), length("y", Along::Y).unwrap_or(0.0));
        let id = attribute(node, "id").filter(|id| !id.is_empty());
        let inner = WalkContext {
            map: around.map.after(&Affine::translate(x, y)),
            repeated_by: around.repeated_by.or(id).or(Some("")),
            size: [length("width", Along::X), length("height", Along::Y)],
            ..*around
        };
        if target.tag_name().name() == "symbol" && is_drawn(&target) {
            let style = inner.style.at(target, self.styles, &self.painter, &scale);
            return self.viewport(target, &WalkContext { style, ..inner }, (0.0, 0.0));
        }
        self.steps.push(WalkStep::Element(target, inner));
    }

    fn nested(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>) {
        let scale = scale_of(around);
        let length = |name: &str, along: Along| attribute(node, name).and_then(|text| scale.length(text, along));
        self.viewport(node, around, (length("x", Along::X).unwrap_or(0.0), length("y", Along::Y).unwrap_or(0.0)));
    }

    /// What an element with a viewport of its own holds, cut at the viewport unless it overflows.
    fn viewport(&mut self, node: Node<'a, 'a>, around: &WalkContext<'a>, (x, y): (f64, f64)) {
        let scale = scale_of(around);
        let own = |name: &str, along: Along| {
            let text = attribute(node, name).filter(|text| text.trim() != "auto");
            text.and_then(|text| scale.length(text, along))
        };
        let width = around.size[0].or(own("width", Along::X)).unwrap_or(around.viewport.0);
        let height = around.size[1].or(own("height", Along::Y)).unwrap_or(around.viewport.1);
        // nothing is drawn in a viewport without area
        let Some(port) = ViewRect::try_new(x, y, width, height) else { return };
        let view = view_box(node);
        let into = view.map_or_else(|| Affine::translate(x, y), |view| fit(node, view, port));
        let viewport = view.map_or((width, height), |view| (view.width, view.height));
        let inner = WalkContext { map: around.map.after(&into), viewport, size: [None; 2], ..*around };
        if !self.is_measuring && !matches!(self.styles.own(node, "overflow"), Some("visible" | "auto")) {
            let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
            let ring = corners.map(|(x, y)| around.map.point(Point2::new(x, y))).to_vec();
            if beyond(&[CurvedPart::ring(&ring)]).is_some() {
                return self.note(node, |label| format!("{label} is left out: its viewport reaches too far"));
            }
            let shape = ClipShape::new(vec![ring], false, Vec::new());
            let region = self.clips.add(ClipRegion { shapes: vec![shape], ..ClipRegion::default() });
            self.steps.push(WalkStep::Viewport { region, from: self.shapes.len() });
        }
        self.children(node, &inner);
    }

    /// Reads an element's transform, about its origin. `of_box` finds the box around what the element holds, in its own
    /// units. `None` if it is not understood.
    pub fn transform(
        &mut self,
        node: Node<'a, 'a>,
        text: &str,
        scale: &LengthScale,
        of_box: impl FnOnce(&mut Self) -> Option<Aabb>,
    ) -> Option<Affine> {
        let map = transform_list(text, scale)?;
        let styles = self.styles;
        let (least, size) = match styles.own(node, "transform-box") {
            Some("fill-box" | "content-box") => {
                let Aabb { min, max } = of_box(self)?;
                ((min.x, min.y), (max.x - min.x, max.y - min.y))
            }
            // strokes have no width here
            Some("stroke-box" | "border-box") => return None,
            _ => ((0.0, 0.0), scale.viewport),
        };
        let origin = styles.own(node, "transform-origin").unwrap_or("0 0");
        let (x, y) = transform_origin(origin, scale, ReferenceBox { least, size })?;
        Some(Affine::translate(x, y).after(&map).after(&Affine::translate(-x, -y)))
    }
}

/// The images of parts.
pub(crate) fn mapped(parts: &[CurvedPart], map: &Affine) -> Vec<CurvedPart> {
    parts.iter().map(|part| part.mapped(map)).collect()
}

pub(crate) fn scale_of(around: &WalkContext) -> LengthScale {
    LengthScale { viewport: around.viewport, font_size: around.style.font_size, root_font_size: FONT_SIZE }
}

/// Whether an element's conditions hold: it asks for no extension, and for English or no language.
fn is_chosen(node: &Node) -> bool {
    let speaks = |list: &str| list.split(',').any(|tag| tag.trim().to_ascii_lowercase().starts_with("en"));
    attribute(*node, "requiredExtensions").is_none() && attribute(*node, "systemLanguage").is_none_or(speaks)
}
