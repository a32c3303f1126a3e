//! Reads SVG drawings with the crate `usvg`, which resolves styles, groups and transforms.

use usvg::roxmltree::{self, Document};
use usvg::{Group, Node, Options, Path, Tree};

use super::check::check;
use super::clean::clean;
use super::curves::{PathOutline, outlines};
use super::scan::scan;
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem, Imported, WorldDraft};
use motion_lab_core::geometry::{MIN_FEATURE, Point2};
use motion_lab_core::worlds::{ShapeText, WorldProblem, Xy};

/// The least tolerance, metres: coordinates are rounded to it.
const MIN_TOLERANCE: f64 = 1e-6;

/// How a drawing is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvgOptions {
    /// The length of the drawing's unit, metres. The unit is a pixel of the drawing's width and height; without these
    /// it is the unit of its viewBox.
    pub metres_per_unit: f64,
    /// Greatest distance of a curve from its straight pieces, metres; at least a micrometre, to which coordinates are
    /// rounded.
    pub tolerance: f64,
}

impl Default for SvgOptions {
    fn default() -> Self {
        SvgOptions { metres_per_unit: 1.0, tolerance: MIN_FEATURE }
    }
}

/// Reads a drawing. A filled shape becomes a solid obstacle; a shape that is only stroked becomes a wall along the
/// middle of the stroke. Two things are left out: invisible shapes, and a filled rectangle that covers the whole sheet,
/// which is its paper. The sheet gives the world's bounds; its lower left corner is the origin, and y points up. `file`
/// is the drawing's name in errors.
///
/// Filled circles become discs. Other curves become chains of straight pieces within the tolerance. Coordinates are
/// rounded to micrometres, and points closer than [`MIN_FEATURE`] to the one before are left out. An outline that is
/// not a simple polygon, or has several parts, becomes walls. An obstacle is named after its element's id, if there is
/// one.
///
/// # Errors
/// [`ImportError`] names line and element: text that is not SVG; an image, embedded HTML, a clip or a mask; malformed
/// numbers, or numbers above 10^7; a drawing without obstacles, or with more than a world holds. A drawing may have at
/// most 10,000 elements, including those repeated by `use`; 100 attributes an element and 200,000 in all; a megabyte of
/// paths; and a quarter of a megabyte of style sheets.
pub fn svg(file: &str, text: &str, name: &str, options: SvgOptions) -> Result<Imported, ImportError> {
    read(text, name, options).map_err(|error| error.of(file))
}

fn read(text: &str, name: &str, options: SvgOptions) -> Result<Imported, ImportError> {
    // written so that NaN is refused
    if !(options.metres_per_unit > 0.0 && options.metres_per_unit.is_finite()) {
        return Err(ImportError::at(0, "metres per unit", wrong_value(options.metres_per_unit, "finite and above 0")));
    }
    if !(options.tolerance >= MIN_TOLERANCE && options.tolerance.is_finite()) {
        return Err(ImportError::at(0, "tolerance", wrong_value(options.tolerance, "finite and at least 0.000001")));
    }
    let mut draft = WorldDraft::default();
    let tree = tree(text, &mut draft)?;
    let scale = options.metres_per_unit;
    let (width, height) = (f64::from(tree.size().width()), f64::from(tree.size().height()));
    let mut drawing = SvgDrawing { draft, height, options, sheet: (micro(width * scale), micro(height * scale)) };
    drawing.group(tree.root())?;
    if drawing.draft.world.is_empty() {
        return Err(ImportProblem::Nothing.into());
    }
    Ok(drawing.draft.finish(name, (0.0, 0.0), drawing.sheet).map_err(ImportProblem::from)?)
}

/// Parses a drawing within the limits of an import, and resolves its styles, groups and transforms.
fn tree(text: &str, draft: &mut WorldDraft) -> Result<Tree, ImportError> {
    scan(text)?;
    let plain = {
        let parsing = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        let document = Document::parse_with_options(text, parsing)
            .map_err(|error| ImportError::at(error.pos().row as usize, "", ImportProblem::Syntax(error.to_string())))?;
        check(&document)?.iter().for_each(|note| draft.note(note));
        clean(&document)?
    };
    let no_drawing = |error: &dyn std::fmt::Display| ImportProblem::Syntax(format!("no drawing: {error}"));
    let document = Document::parse(&plain).map_err(|error| no_drawing(&error))?;
    Ok(Tree::from_xmltree(&document, &Options::default()).map_err(|error| no_drawing(&error))?)
}

/// Rounds a length in metres to micrometres. A drawing's numbers have single precision: further digits are noise.
fn micro(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}

/// A drawing while it is converted to a world.
struct SvgDrawing {
    draft: WorldDraft,
    height: f64,
    options: SvgOptions,
    sheet: Xy,
}

impl SvgDrawing {
    fn group(&mut self, group: &Group) -> Result<(), ImportError> {
        group.children().iter().try_for_each(|node| match node {
            Node::Group(group) => self.group(group),
            Node::Path(path) => self.path(path),
            // `clean` has removed both
            Node::Image(_) | Node::Text(_) => Ok(()),
        })
    }

    fn path(&mut self, path: &Path) -> Result<(), ImportError> {
        if !path.is_visible() {
            self.draft.note("what is drawn invisibly is left out");
            return Ok(());
        }
        let t = path.abs_transform();
        let [sx, kx, ky, sy, tx, ty] = [t.sx, t.kx, t.ky, t.sy, t.tx, t.ty].map(f64::from);
        let (scale, height) = (self.options.metres_per_unit, self.height);
        let place = |x: f32, y: f32| {
            let (x, y) = (f64::from(x), f64::from(y));
            Point2::new((sx * x + kx * y + tx) * scale, (height - (ky * x + sy * y + ty)) * scale)
        };
        let id = path.id();
        let mut parts = outlines(path.data(), place, self.options.tolerance)
            .ok_or_else(|| ImportError::at(0, id, WorldProblem::TooMany { what: "straight pieces of its curves" }))?;
        let added = match (path.fill(), parts.len()) {
            (None, _) => parts.into_iter().try_for_each(|part| self.wall(id, part)),
            (Some(_), 1) => self.solid(id, parts.remove(0)),
            (Some(_), _) => {
                self.draft.note("a filled shape of several parts is drawn as the outlines of its parts");
                parts.into_iter().try_for_each(|part| self.wall(id, PathOutline { closed: true, ..part }))
            }
        };
        added.map_err(|problem| ImportError::at(0, id, problem))
    }

    /// The name of an element's obstacle.
    fn name(&mut self, id: &str, stem: &str) -> String {
        if id.is_empty() { self.draft.world.numbered(stem) } else { self.draft.world.claim(id) }
    }

    fn wall(&mut self, id: &str, outline: PathOutline) -> Result<(), WorldProblem> {
        let (points, closed) = spaced(&outline);
        if points.len() < 2 {
            self.draft.note("what is smaller than a millimetre is left out");
            return Ok(());
        }
        let name = self.name(id, "wall");
        self.draft.world.wall(name, points, closed && outline.closed)
    }

    /// Adds a filled outline, closed even if the drawing left it open.
    fn solid(&mut self, id: &str, outline: PathOutline) -> Result<(), WorldProblem> {
        if let Some((center, radius)) = outline.disc(self.options.tolerance) {
            let name = self.name(id, "disc");
            let center = (micro(center.x), micro(center.y));
            return self.draft.world.solid(name, ShapeText::Disc { center, radius: micro(radius) });
        }
        let (points, _) = spaced(&outline);
        let (mut min, mut max) = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        for &(x, y) in &points {
            min = (motion_lab_core::num::lesser(x, min.0), motion_lab_core::num::lesser(y, min.1));
            max = (motion_lab_core::num::greater(x, max.0), motion_lab_core::num::greater(y, max.1));
        }
        // vertical and horizontal sides alternate
        let upright = |i: usize| points[i].0 == points[(i + 1) % 4].0;
        let level = |i: usize| points[i].1 == points[(i + 1) % 4].1;
        let is_box = points.len() == 4 && (0..4).all(|i| upright(i) != level(i) && upright(i) != upright((i + 1) % 4));
        if is_box && min.0 <= 0.0 && min.1 <= 0.0 && max.0 >= self.sheet.0 && max.1 >= self.sheet.1 {
            self.draft.note("a filled shape that covers the whole sheet is taken for its paper and left out");
            return Ok(());
        }
        if points.len() < 3 {
            return self.wall(id, outline);
        }
        let (stem, shape) =
            if is_box { ("box", ShapeText::Box { min, max }) } else { ("polygon", ShapeText::Polygon(points.clone())) };
        let name = self.name(id, stem);
        match self.draft.world.solid(name.clone(), shape) {
            Err(WorldProblem::Outline(reason)) => {
                self.draft.note(format!("{name} is drawn as its outline: {reason}"));
                self.draft.world.wall(name, points, true)
            }
            done => done,
        }
    }
}

/// Rounds the points of an outline and drops those closer than the smallest feature to the one before. Also returns
/// whether enough are left to close the outline.
fn spaced(outline: &PathOutline) -> (Vec<Xy>, bool) {
    let near = |a: Xy, b: Xy| motion_lab_core::num::hypot(a.0 - b.0, a.1 - b.1) < MIN_FEATURE;
    let mut points: Vec<Xy> = Vec::new();
    for p in outline.points.iter().map(|p| (micro(p.x), micro(p.y))) {
        if points.last().is_none_or(|&last| !near(last, p)) {
            points.push(p);
        }
    }
    while outline.closed && points.len() > 1 && near(points[0], points[points.len() - 1]) {
        points.pop();
    }
    let enough = points.len() >= 3;
    (points, enough)
}
