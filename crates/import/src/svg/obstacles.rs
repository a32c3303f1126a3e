//! `SvgObstacles`, which makes obstacles of drawn shapes.

use super::check::Labels;
use super::cuts::clips::{ClipLayers, ClipTable, is_in, meet};
use super::walk::DrawnShape;
use crate::draft::WorldDraft;
use crate::planar::{Arrangement, CurvedPart, PathOutline, Ring, beyond, disc, micro, outline, rounded};
use motion_lab_core::geometry::{Aabb, ConvexPolygon, MIN_FEATURE, Point2, ShapeError, orientation};
use motion_lab_core::num::{greater, hypot};
use motion_lab_core::worlds::{MAX_CONCAVE_VERTICES, MAX_ITEMS, ShapeText, WorldProblem, Xy};

/// Pairs of edges that may be compared for all shapes of a drawing that are cut or cross themselves.
pub(crate) const MAX_COMPARISONS: usize = 20_000_000;

/// Points of all lines together, before those that lie too close together are left out.
pub(crate) const MAX_LINE_POINTS: usize = 100 * MAX_ITEMS;

/// Makes obstacles of drawn shapes, one after the other.
pub(crate) struct SvgObstacles<'a> {
    pub draft: &'a mut WorldDraft,
    pub clips: &'a ClipTable,
    pub labels: &'a Labels,
    pub tolerance: f64,
    /// Width and height of the sheet, metres.
    pub sheet: Xy,
    /// Pairs of edges that may still be compared.
    pub comparisons: usize,
    /// Points of lines that may still be made.
    pub room: usize,
}

fn xy(p: &Point2) -> Xy {
    (p.x, p.y)
}

impl<'a> SvgObstacles<'a> {
    /// Adds the obstacle of a shape, or several: a solid for what is filled, walls for what is only stroked.
    ///
    /// # Errors
    /// [`WorldProblem`]: more than a world holds, or what reaches too far to be cut.
    pub fn add(&mut self, shape: &DrawnShape<'_>) -> Result<(), WorldProblem> {
        if let Some(p) = beyond(&shape.parts) {
            return Err(ShapeError::Coordinate(p.x, p.y).into());
        }
        let follow = |part: &CurvedPart| outline(part, self.tolerance, &mut self.room);
        let outlines: Option<Vec<PathOutline>> = shape.parts.iter().map(follow).collect();
        let outlines = outlines.ok_or(WorldProblem::TooMany { what: "straight pieces of its curves" })?;
        let points: Vec<Point2> = outlines.iter().flat_map(|outline| &outline.points).copied().collect();
        let work = shape.clips.iter().map(|clip| self.clips.size(*clip)).fold(0, usize::saturating_add);
        let Some(left) = self.comparisons.checked_sub(work.saturating_mul(1 + points.len())) else {
            self.note_uncut(shape);
            return Ok(());
        };
        self.comparisons = left;
        let cutting: Vec<usize> =
            shape.clips.iter().copied().filter(|&clip| !self.clips.holds(clip, &points)).collect();
        if shape.filled { self.solid(shape, &outlines, &cutting) } else { self.walls(shape, &outlines, &cutting) }
    }

    /// The name of a shape's obstacle.
    fn name(&mut self, id: &str, stem: &str) -> String {
        if id.is_empty() { self.draft.world.numbered(stem) } else { self.draft.world.claim(id) }
    }

    fn note_uncut(&mut self, shape: &DrawnShape<'_>) {
        let label = self.labels.of(shape.element);
        self.draft.note(format!("{label} is left out: its clip path has too many points"));
    }

    fn walls(
        &mut self,
        shape: &DrawnShape<'_>,
        outlines: &[PathOutline],
        cutting: &[usize],
    ) -> Result<(), WorldProblem> {
        for outline in outlines {
            if cutting.is_empty() {
                self.wall(shape, outline)?;
                continue;
            }
            let mut line = outline.points.clone();
            line.extend(line.first().copied().filter(|_| outline.closed));
            let (clips, left) = (self.clips, &mut self.comparisons);
            let mut cut = |lines: Vec<Vec<Point2>>, clip: &usize| {
                let cut_one = |line: &Vec<Point2>| clips.cut_line(*clip, line, left);
                Some(lines.iter().map(cut_one).collect::<Option<Vec<_>>>()?.concat())
            };
            let Some(pieces) = cutting.iter().try_fold(vec![line], &mut cut) else {
                self.note_uncut(shape);
                return Ok(());
            };
            for points in pieces {
                self.wall(shape, &PathOutline { points, closed: false })?;
            }
        }
        Ok(())
    }

    fn wall(&mut self, shape: &DrawnShape<'_>, outline: &PathOutline) -> Result<(), WorldProblem> {
        let (points, closed) = spaced(outline);
        if points.len() < 2 {
            self.draft.note("what is smaller than a millimetre is left out");
            return Ok(());
        }
        let name = self.name(shape.id, "wall");
        self.draft.world.wall(name, points.iter().map(xy).collect(), closed)
    }

    /// Adds what is filled, closed even if the drawing left it open. What has no room inside is a wall.
    fn solid(
        &mut self,
        shape: &DrawnShape<'_>,
        outlines: &[PathOutline],
        cutting: &[usize],
    ) -> Result<(), WorldProblem> {
        let (mut rings, mut thin): (Vec<PlacedRing>, Vec<PathOutline>) = (Vec::new(), Vec::new());
        for (part, outline) in shape.parts.iter().zip(outlines) {
            let outline = PathOutline { closed: true, ..outline.clone() };
            let (points, _) = spaced(&outline);
            if let (Some(extent), true) = (Aabb::around(&points), points.len() > 2) {
                rings.push(PlacedRing { points, extent, disc: disc(part, self.tolerance) });
            } else if shape.stroked || has_area(&outline.points) {
                thin.push(outline);
            } else {
                self.draft.note("what is filled and has no area is left out");
            }
        }
        let mut members = Vec::new();
        let is_even_odd = shape.even_odd;
        for group in if cutting.is_empty() { groups(rings) } else { vec![rings] } {
            match self.members(&group, is_even_odd, cutting) {
                Ok(found) => members.extend(found),
                Err(why) => {
                    self.draft.note(match why {
                        Unfilled::Thin => "what is filled and thinner than a millimetre is drawn as its outline".into(),
                        Unfilled::Crossing => format!(
                            "{} is drawn as its outline: its lines cross too often",
                            self.labels.of(shape.element)
                        ),
                    });
                    thin.extend(group.into_iter().map(|ring| PathOutline { points: ring.points, closed: true }));
                }
            }
        }
        if self.is_paper(&members) {
            self.draft.note("a filled shape that covers the whole sheet is taken for its paper and left out");
            return if shape.stroked { self.walls(shape, outlines, cutting) } else { Ok(()) };
        }
        match self.add_members(shape, members) {
            // a part that no cut between its corners divides
            Err(WorldProblem::Outline(reason)) => {
                let label = self.labels.of(shape.element);
                self.draft.note(format!("{label} is drawn as its outline: {reason}"));
                return self.walls(shape, outlines, cutting);
            }
            added => added?,
        }
        self.walls(shape, &thin, cutting)
    }

    fn add_members(&mut self, shape: &DrawnShape<'_>, mut members: Vec<ShapeText>) -> Result<(), WorldProblem> {
        let stem = match &members[..] {
            [] => return Ok(()),
            [ShapeText::Box { .. }] => "box",
            [ShapeText::Disc { .. }] => "disc",
            _ => "polygon",
        };
        let text = if members.len() == 1 { members.remove(0) } else { ShapeText::Union(members) };
        let name = self.name(shape.id, stem);
        self.draft.world.solid(name, text)
    }

    /// Whether a solid is a rectangle that covers the whole sheet.
    fn is_paper(&self, members: &[ShapeText]) -> bool {
        let (width, height) = self.sheet;
        matches!(members, [ShapeText::Box { min, max }]
            if min.0 <= 0.0 && min.1 <= 0.0 && max.0 >= width && max.1 >= height)
    }

    /// The shapes that cover what rings enclose by the fill rule, within what cuts it.
    fn members(&mut self, rings: &[PlacedRing], even_odd: bool, cutting: &[usize]) -> Result<Vec<ShapeText>, Unfilled> {
        if let ([ring], []) = (rings, cutting)
            && let Some(shape) = ring.alone(&mut self.comparisons)
        {
            return Ok(vec![shape]);
        }
        let mut lines: Vec<Ring> = rings.iter().map(|ring| Ring { layer: 0, points: ring.points.clone() }).collect();
        let mut layers = ClipLayers::above_first();
        for clip in cutting {
            self.clips.layer(*clip, &mut layers, &mut lines).ok_or(Unfilled::Crossing)?;
        }
        let arrangement = Arrangement::try_new(&lines, &mut self.comparisons).map_err(|_| Unfilled::Crossing)?;
        let faces = arrangement.inside(|windings| {
            let winding = windings.first().copied().unwrap_or(0);
            is_in(winding, even_odd) && cutting.iter().all(|clip| self.clips.is_inside(*clip, &layers, windings))
        });
        if faces.is_empty() && cutting.is_empty() && !rings.is_empty() {
            return Err(Unfilled::Thin);
        }
        Ok(faces.into_iter().map(|face| box_of(&face).unwrap_or_else(|| polygon(&face))).collect())
    }
}

/// Why a filled shape is no solid.
enum Unfilled {
    Thin,
    Crossing,
}

/// A filled part of a shape.
struct PlacedRing {
    points: Vec<Point2>,
    extent: Aabb,
    disc: Option<(Point2, f64)>,
}

impl PlacedRing {
    /// What the ring is if nothing cuts it: a disc, a box or a simple polygon; `None` if it is none of these.
    /// `allowance` counts the pairs of edges that may still be compared.
    fn alone(&self, allowance: &mut usize) -> Option<ShapeText> {
        if let Some((center, radius)) = self.disc.filter(|(_, radius)| micro(*radius) >= MIN_FEATURE) {
            return Some(ShapeText::Disc { center: (micro(center.x), micro(center.y)), radius: micro(radius) });
        }
        if let Some(found) = box_of(&self.points) {
            return Some(found);
        }
        let fits = self.points.len() <= MAX_CONCAVE_VERTICES || ConvexPolygon::try_new(&self.points).is_ok();
        (fits && Arrangement::is_simple(&self.points, allowance)).then(|| polygon(&self.points))
    }
}

fn polygon(points: &[Point2]) -> ShapeText {
    ShapeText::Polygon(points.iter().map(xy).collect())
}

/// The box with these corners, if vertical and horizontal sides alternate.
fn box_of(points: &[Point2]) -> Option<ShapeText> {
    let upright = |i: usize| points[i].x == points[(i + 1) % 4].x;
    let level = |i: usize| points[i].y == points[(i + 1) % 4].y;
    let is_box = points.len() == 4 && (0..4).all(|i| upright(i) != level(i) && upright(i) != upright((i + 1) % 4));
    let Aabb { min, max } = Aabb::around(points).filter(|_| is_box)?;
    Some(ShapeText::Box { min: xy(&min), max: xy(&max) })
}

/// Largest number of rings that are compared in pairs.
const MAX_COMPARED: usize = 1_000;

/// Sorts rings into groups whose boxes are apart. Where very many lie entangled, several groups may stay one.
fn groups(rings: Vec<PlacedRing>) -> Vec<Vec<PlacedRing>> {
    let mut parts = vec![rings];
    for along_x in [true, false, true, false] {
        parts = parts.into_iter().flat_map(|part| strips(part, along_x)).collect();
    }
    let exact = |part: Vec<PlacedRing>| if part.len() > MAX_COMPARED { vec![part] } else { joined(part) };
    parts.into_iter().flat_map(exact).collect()
}

/// Splits rings where a straight line along an axis keeps off all of them.
fn strips(mut rings: Vec<PlacedRing>, along_x: bool) -> Vec<Vec<PlacedRing>> {
    let span = |ring: &PlacedRing| {
        let Aabb { min, max } = ring.extent;
        if along_x { (min.x, max.x) } else { (min.y, max.y) }
    };
    rings.sort_by(|a, b| span(a).0.partial_cmp(&span(b).0).unwrap_or(std::cmp::Ordering::Equal));
    let (mut strips, mut end): (Vec<Vec<PlacedRing>>, f64) = (Vec::new(), f64::NEG_INFINITY);
    for ring in rings {
        let (from, to) = span(&ring);
        match strips.last_mut() {
            // the same room as between boxes that are apart
            Some(strip) if from <= end + MIN_FEATURE => strip.push(ring),
            _ => strips.push(vec![ring]),
        }
        end = greater(end, to);
    }
    strips
}

/// Joins rings whose boxes meet, or meet the box of a group.
fn joined(rings: Vec<PlacedRing>) -> Vec<Vec<PlacedRing>> {
    let mut groups: Vec<(Aabb, Vec<PlacedRing>)> = Vec::new();
    for ring in rings {
        let mut joined = (ring.extent, vec![ring]);
        // what the growing box meets joins, until nothing more does
        while let Some(i) = groups.iter().position(|(extent, _)| meet(extent, &joined.0)) {
            let (extent, mut members) = groups.remove(i);
            joined.0 = extent.merged(&joined.0);
            members.append(&mut joined.1);
            joined.1 = members;
        }
        groups.push(joined);
    }
    groups.into_iter().map(|(_, members)| members).collect()
}

/// Whether a line encloses anything: it is not all on one straight line.
fn has_area(points: &[Point2]) -> bool {
    let Some((&first, rest)) = points.split_first() else { return false };
    let far = rest.iter().copied().find(|p| *p != first);
    far.is_some_and(|far| rest.iter().any(|p| orientation(first, far, *p) != 0.0))
}

/// Rounds the points of an outline and drops those closer than the smallest feature to the one before. Also returns
/// whether the outline is closed, and has enough points left for it.
fn spaced(outline: &PathOutline) -> (Vec<Point2>, bool) {
    let near = |a: Point2, b: Point2| hypot(a.x - b.x, a.y - b.y) < MIN_FEATURE;
    let mut points: Vec<Point2> = Vec::new();
    for p in outline.points.iter().map(|p| rounded(*p)) {
        if points.last().is_none_or(|&last| !near(last, p)) {
            points.push(p);
        }
    }
    // a line that comes back to its first micrometre is closed, even if the drawing does not say so
    let closed = outline.closed || (points.len() > 3 && points.first() == points.last());
    while closed && points.len() > 1 && near(points[0], points[points.len() - 1]) {
        points.pop();
    }
    let closed = closed && points.len() >= 3;
    (points, closed)
}
