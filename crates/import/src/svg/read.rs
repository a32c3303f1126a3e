//! Reads SVG drawings: their shapes with all styles and transforms, in double precision from the text on.

use std::rc::Rc;

use roxmltree::{Document, Node, ParsingOptions};

use super::check::{Labels, TEXT_LEFT_OUT, check};
use super::obstacles::{MAX_COMPARISONS, MAX_LINE_POINTS, SvgObstacles};
use super::paint::{FONT_SIZE, Painter};
use super::scan::scan;
use super::style::StyleTable;
use super::uses::{Targets, check_uses, is_drawn, targets};
use super::viewport::{SheetSize, sheet_size, view_box};
use super::walk::SvgWalk;
use crate::error::wrong_value;
use crate::planar::{Affine, extent, micro};
use crate::{ImportError, ImportProblem, Imported, WorldDraft};
use motion_lab_core::geometry::{Aabb, MIN_FEATURE};

/// The least tolerance, metres: coordinates are rounded to it.
const MIN_TOLERANCE: f64 = 1e-6;

/// How a drawing is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvgOptions {
    /// The length of the drawing's own unit, metres: that of its view box, or a pixel if it has none. `None` gives a
    /// drawing with a physical size (`width="210mm"`) that size, and one without it 1 m for a pixel of its width and
    /// height, or else for a unit of its view box.
    pub metres_per_unit: Option<f64>,
    /// Greatest distance of a curve from its straight pieces, metres; at least a micrometre, to which coordinates are
    /// rounded.
    pub tolerance: f64,
}

impl Default for SvgOptions {
    fn default() -> Self {
        SvgOptions { metres_per_unit: None, tolerance: MIN_FEATURE }
    }
}

/// Reads a drawing. A filled shape becomes a solid obstacle: what its fill rule says is inside, of all its parts
/// together. A shape that is only stroked becomes a wall along the middle of the stroke. Left out are shapes whose
/// paint does not show, and a filled rectangle that covers the whole sheet, which is its paper; a stroke around the
/// paper is a wall. The sheet gives the world's bounds; its lower left corner is the origin, and y points up. `file` is
/// the drawing's name in errors.
///
/// Filled circles become discs. Other curves become chains of straight pieces within the tolerance. Coordinates are
/// read in double precision and rounded to micrometres. Points closer than [`MIN_FEATURE`] to the one before are left
/// out, and such points of crossing lines become one. Clip paths, masks of black and white, and the viewports of nested
/// drawings cut what they hold. Images and what cannot be cut are left out, with a note. An obstacle is named after its
/// element's id, or that of the `use` that repeats it, if there is one.
///
/// # Errors
/// [`ImportError`] names line and element: text that is not SVG; malformed numbers, or numbers that stand for more than
/// 10^9 m; shapes that lie out of a world where nothing cuts them, or anywhere more than 10^9 m from the origin; a
/// drawing without obstacles, or with more than a world holds. A drawing may have at most 50,000 elements, including
/// those repeated by `use`, nested at most 1,000 deep; 100 attributes an element and 200,000 in all; four megabytes of
/// paths; and a quarter of a megabyte of style sheets.
pub fn svg(file: &str, text: &str, name: &str, options: SvgOptions) -> Result<Imported, ImportError> {
    read(text, name, options).map_err(|error| error.of(file))
}

fn read(text: &str, name: &str, options: SvgOptions) -> Result<Imported, ImportError> {
    // written so that NaN is refused
    if let Some(metres) = options.metres_per_unit
        && !(metres > 0.0 && metres.is_finite())
    {
        return Err(ImportError::at(0, "metres per unit", wrong_value(metres, "finite and above 0")));
    }
    if !(options.tolerance >= MIN_TOLERANCE && options.tolerance.is_finite()) {
        return Err(ImportError::at(0, "tolerance", wrong_value(options.tolerance, "finite and at least 0.000001")));
    }
    scan(text)?;
    let parsing = ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = Document::parse_with_options(text, parsing)
        .map_err(|error| ImportError::at(error.pos().row as usize, "", ImportProblem::Syntax(error.to_string())))?;
    let mut draft = WorldDraft::default();
    check(&document)?.iter().for_each(|note| draft.note(note));
    let root = document.root_element();
    if !is_drawn(&root) || root.tag_name().name() != "svg" {
        return Err(ImportProblem::Syntax("no drawing: the root element is no svg element".into()).into());
    }
    let (targets, styles) = (targets(root), StyleTable::read(&document)?);
    check_uses(root, &targets)?;
    let labels = Labels::new(&document);
    let drawing = SvgDrawing { root, styles: &styles, targets: &targets, labels: &labels, options };
    let sheet = drawing.obstacles(&mut draft)?;
    if draft.world.is_empty() {
        let left_out = draft.first_left_out(TEXT_LEFT_OUT);
        return Err(left_out.map_or(ImportProblem::Nothing, |note| ImportProblem::NothingLeft(note.into())).into());
    }
    Ok(draft.finish(name, (0.0, 0.0), sheet).map_err(ImportProblem::from)?)
}

/// A drawing that has been checked.
struct SvgDrawing<'a> {
    root: Node<'a, 'a>,
    styles: &'a StyleTable,
    targets: &'a Targets<'a>,
    labels: &'a Labels,
    options: SvgOptions,
}

impl<'a> SvgDrawing<'a> {
    fn walk<'d>(&self, draft: &'d mut WorldDraft) -> SvgWalk<'a, 'd> {
        let painter = Rc::new(Painter::new(self.targets, self.styles));
        SvgWalk::new(self.styles, self.targets, self.labels, self.options.tolerance, painter, draft)
    }

    /// Adds the drawing's obstacles; returns the width and height of its sheet, metres.
    fn obstacles(&self, draft: &mut WorldDraft) -> Result<(f64, f64), ImportError> {
        let size = sheet_size(self.root, FONT_SIZE);
        let scale = self.metres_per_pixel(&size, draft);
        let pixels = size.pixels.map_or_else(|| self.extent(), Ok)?;
        // y points down in a drawing and up in a world
        let up = Affine([scale, 0.0, 0.0, -scale, 0.0, scale * pixels.1]);
        let viewport = view_box(self.root).map_or(pixels, |view| (view.width, view.height));
        let mut walk = self.walk(draft);
        walk.is_placed = true;
        walk.drawing(self.root, up.after(&size.to_pixels), viewport)?;
        let (shapes, clips) = (walk.shapes, walk.clips);
        let sheet = (micro(pixels.0 * scale), micro(pixels.1 * scale));
        let (labels, tolerance) = (self.labels, self.options.tolerance);
        let mut obstacles = SvgObstacles {
            draft,
            clips: &clips,
            labels,
            tolerance,
            sheet,
            comparisons: MAX_COMPARISONS,
            room: MAX_LINE_POINTS,
        };
        for shape in &shapes {
            obstacles.add(shape).map_err(|problem| ImportError::at(0, shape.id, problem))?;
        }
        Ok(sheet)
    }

    /// The size of a drawing that says none, pixels: all that it shows right of and below its origin.
    fn extent(&self) -> Result<(f64, f64), ImportError> {
        const UNKNOWN: (f64, f64) = (100.0, 100.0);
        let mut draft = WorldDraft::default();
        let mut walk = self.walk(&mut draft);
        walk.drawing(self.root, Affine::IDENTITY, UNKNOWN)?;
        let parts = walk.shapes.iter().flat_map(|shape| &shape.parts);
        Ok(extent(parts).map_or(UNKNOWN, |Aabb { max, .. }| (max.x, max.y)))
    }

    /// The length of a pixel of the sheet, metres. A note says what a unit of the drawing is, or the draft that it
    /// is assumed.
    fn metres_per_pixel(&self, size: &SheetSize, draft: &mut WorldDraft) -> f64 {
        let [a, b, ..] = size.to_pixels.0;
        let pixels_per_unit = motion_lab_core::num::hypot(a, b);
        if let Some(metres) = self.options.metres_per_unit {
            if let Some(written) = &size.physical {
                draft.note(format!(
                    "the drawing says that it is {written}; a unit of it was taken for {metres} m instead"
                ));
            }
            return metres / pixels_per_unit;
        }
        let physical = super::lengths::METRES_PER_PIXEL;
        let scale = if size.physical.is_some() { physical } else { 1.0 };
        match &size.physical {
            Some(written) => {
                let unit = rounded(scale * pixels_per_unit);
                draft.note(format!(
                    "the drawing says that it is {written}, so a unit of it is {unit} m; --metres-per-unit changes it"
                ));
            }
            None => draft.assumed_unit = Some(rounded(scale * pixels_per_unit)),
        }
        scale
    }
}

/// A length with six digits after the first one.
fn rounded(x: f64) -> f64 {
    format!("{x:.6e}").parse().unwrap_or(x)
}
