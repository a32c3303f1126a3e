//! Draws the configuration space as a picture.

use std::f64::consts::{FRAC_PI_2, PI};

use super::rectangles::rectangles;
use super::{CellMap, CellState, Slice, wrapped_pieces};
use crate::configuration::AnyConfiguration;
use crate::geometry::{Aabb, Point2};
use crate::num::wrap;
use crate::picture::{Anchor, Dash, Drawing, Face, Fill, Glyph, Item, Line, Picture, Role, in_signs};

/// What is drawn over the cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// The robot's configuration.
    pub now: Option<AnyConfiguration>,
    /// Whether it is in contact there.
    pub in_contact: bool,
    /// Its past configurations, oldest first.
    pub trace: Vec<AnyConfiguration>,
    /// The chart line from one configuration to another: the swept tab's motion.
    pub line: Option<[AnyConfiguration; 2]>,
    /// Configurations to be compared: both arms that reach one tip.
    pub solutions: Vec<AnyConfiguration>,
}

/// The picture of a map: cells proven free are tinted, unknown ones dotted, those proven blocked hatched, with the
/// overlay on top. Its plane is the slice's: metres for positions, radians for angles.
pub fn cspace_picture(map: &CellMap, overlay: &Overlay) -> Picture {
    let slice = map.slice();
    let (min, max) = (slice.min(), slice.max());
    let size = [max[0] - min[0], max[1] - min[1]];
    // room for the names and figures at the axes
    let room = if slice.wraps() { [0.16 * size[0], 0.08 * size[1]] } else { [0.0, 0.0] };
    let top = if slice.wraps() { [0.03 * size[0], 0.03 * size[1]] } else { [0.0, 0.0] };
    let bounds = Aabb {
        min: Point2::new(min[0] - room[0], min[1] - room[1]),
        max: Point2::new(max[0] + top[0], max[1] + top[1]),
    };
    let name = format!("configuration space of {}", slice.checker().robot().title());
    let picture = Picture { in_metres: !slice.wraps(), ..Picture::new(name, bounds) };
    picture.with(cell_items(map)).with(frame_items(slice)).with(overlay_items(slice, overlay))
}

/// The cells, one item for each of the three states.
fn cell_items(map: &CellMap) -> Vec<Item> {
    let level = std::cmp::min(map.finest(), 9);
    let side = 1_u32 << level;
    let image = map.raster(level);
    let (min, max) = (map.slice().min(), map.slice().max());
    let at = |column: u32, row: u32| {
        let part = |k: u32, i: usize| min[i] + (max[i] - min[i]) * (f64::from(k) / f64::from(side));
        Point2::new(part(column, 0), part(row, 1))
    };
    let kinds = [
        ("free", "proven free", Role::Free, Fill::Tint(0.3), CellState::Free),
        ("blocked", "proven blocked", Role::Obstacle, Fill::Hatch, CellState::Blocked),
        ("unknown", "not known", Role::Unknown, Fill::Dots, CellState::Unknown),
    ];
    let kinds = kinds.into_iter().map(|(id, name, role, fill, state)| {
        let pieces = rectangles(&image, side, |s| *s == state)
            .into_iter()
            .map(|r| vec![at(r.left, r.low), at(r.right, r.low), at(r.right, r.high), at(r.left, r.high)]);
        let region = Drawing::Region { pieces: pieces.collect(), outline: Vec::new() };
        Item::new(format!("cells/{id}"), name, role, region).filled(fill)
    });
    kinds.collect()
}

/// The slice's edges; on a torus also ticks, their angles and the names of the axes.
fn frame_items(slice: &Slice) -> Vec<Item> {
    let (min, max) = (slice.min(), slice.max());
    let p = |x: f64, y: f64| Point2::new(x, y);
    let corners = vec![p(min[0], min[1]), p(max[0], min[1]), p(max[0], max[1]), p(min[0], max[1]), p(min[0], min[1])];
    let edge = Item::new("frame", "the edges", Role::Muted, Drawing::Polyline(corners)).stroked(Line::solid(1.0));
    let mut items = vec![edge];
    if !slice.wraps() {
        return items;
    }
    let label = |id: String, at: Point2, text: &str, anchor: Anchor| {
        let drawing = Drawing::Label { at, text: text.into(), anchor, face: Face::Sans, size_px: 11.0, plate: false };
        Item::new(id, text, Role::Muted, drawing)
    };
    for (k, text) in [
        (-PI, "\u{2212}\u{3c0}"),
        (-FRAC_PI_2, "\u{2212}\u{3c0}/2"),
        (0.0, "0"),
        (FRAC_PI_2, "\u{3c0}/2"),
        (PI, "\u{3c0}"),
    ] {
        items.push(label(format!("axis/across/{text}"), p(k, -PI), text, Anchor::Below));
        items.push(label(format!("axis/up/{text}"), p(-PI - 0.06, k), text, Anchor::Left));
        for (way, from, to) in [("across", p(k, -PI), p(k, -PI - 0.06)), ("up", p(-PI, k), p(-PI - 0.06, k))] {
            let tick = Drawing::segment(from, to);
            items.push(Item::new(format!("tick/{way}/{text}"), text, Role::Muted, tick).stroked(Line::solid(1.0)));
        }
    }
    let names = slice.names().map(|name| in_signs(&name));
    items.push(label("axis/across/name".into(), p(0.25 * PI, -PI), &names[0], Anchor::Below));
    items.push(label("axis/up/name".into(), p(-PI - 0.06, 0.25 * PI), &names[1], Anchor::Left));
    items
}

/// The items over the cells. They change with the robot, the cells do not.
pub fn overlay_items(slice: &Slice, overlay: &Overlay) -> Vec<Item> {
    let mut items = Vec::new();
    if let Some(lines) = lines_through(slice, &overlay.trace) {
        let region = Drawing::Region { pieces: Vec::new(), outline: lines };
        items.push(Item::new("trace", "where it was", Role::Path, region).stroked(Line::solid(1.5).at_opacity(0.9)));
    }
    if let Some([from, to]) = &overlay.line {
        let region = Drawing::Region { pieces: Vec::new(), outline: line(slice, from, to) };
        items.push(
            Item::new("line", "the chart line", Role::Witness, region).stroked(Line::solid(2.0).dashed(Dash::Dashed)),
        );
        let end = Drawing::Mark { at: point(slice, to), glyph: Glyph::Ring, radius_px: 4.5 };
        items.push(Item::new("line/end", "where the chart line ends", Role::Witness, end));
    }
    for (number, q) in (1..).zip(&overlay.solutions) {
        let ring = Drawing::Mark { at: point(slice, q), glyph: Glyph::Ring, radius_px: 6.5 };
        items.push(Item::new(format!("solution/{number}"), format!("solution {number}: {q}"), Role::Focus, ring));
    }
    if let Some(q) = &overlay.now {
        let role = if overlay.in_contact { Role::Goal } else { Role::Robot };
        let dot = Drawing::Mark { at: point(slice, q), glyph: Glyph::Handle, radius_px: 5.0 };
        items.push(Item::new("now", q.to_string(), role, dot));
    }
    items
}

fn point(slice: &Slice, q: &AnyConfiguration) -> Point2 {
    Point2::from(slice.point(q))
}

/// The chart line between two configurations, in as many pieces as it takes.
fn line(slice: &Slice, from: &AnyConfiguration, to: &AnyConfiguration) -> Vec<Vec<Point2>> {
    let (a, b) = (slice.point(from), slice.point(to));
    if !slice.wraps() {
        return vec![vec![Point2::from(a), Point2::from(b)]];
    }
    let step = [wrap(b[0] - a[0]), wrap(b[1] - a[1])];
    wrapped_pieces(a, step).into_iter().map(|piece| piece.map(Point2::from).to_vec()).collect()
}

/// The chart lines through these configurations, cut at the edges of a torus; `None` when there is nothing to join.
pub fn lines_through(slice: &Slice, trace: &[AnyConfiguration]) -> Option<Vec<Vec<Point2>>> {
    let mut lines: Vec<Vec<Point2>> = Vec::new();
    for pair in trace.windows(2) {
        for piece in line(slice, &pair[0], &pair[1]) {
            match lines.last_mut() {
                Some(last) if last.last() == piece.first() => last.extend(piece.into_iter().skip(1)),
                _ => lines.push(piece),
            }
        }
    }
    (!lines.is_empty()).then_some(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Collision;
    use crate::configuration::T2;
    use crate::cspace::tests::arm;
    use crate::picture::{Fit, Primitive, ScreenRect, resolve};
    use crate::robots::Robot;

    #[test]
    fn on_a_small_paper_the_figures_at_the_axes_stand_within_its_frame() {
        let (checker, q) = arm(false);
        let picture = cspace_picture(&CellMap::new(Slice::through(&checker, &q).unwrap(), 1), &Overlay::default());
        // the paper in a window of 600 by 500 points, where the widest figure measures 23 points
        let fit = Fit::new(&picture.bounds, ScreenRect { min: [0.0; 2], size: [206.0; 2] }, 8.0);
        let figures: Vec<&Item> = picture.items.iter().filter(|item| item.id.starts_with("axis/up/")).collect();
        assert_eq!(figures.len(), 6, "five figures and a name");
        for figure in figures {
            let [Primitive::Text { at, .. }] = &resolve(figure, &fit)[..] else { panic!("words") };
            assert!(at[0] - 23.0 >= 2.0, "{} ends at {}", figure.name, at[0]);
        }
    }

    #[test]
    fn ticks_of_a_torus_lead_from_its_lower_and_left_edge_outward() {
        let (checker, q) = arm(false);
        let picture = cspace_picture(&CellMap::new(Slice::through(&checker, &q).unwrap(), 1), &Overlay::default());
        let ticks = |way: &str| -> Vec<[[f64; 2]; 2]> {
            let ends = |item: &Item| {
                let Drawing::Polyline(ends) = &item.drawing else { panic!("{} is no line", item.id) };
                [[ends[0].x, ends[0].y], [ends[1].x, ends[1].y]]
            };
            picture.items.iter().filter(|item| item.id.starts_with(&format!("tick/{way}/"))).map(ends).collect()
        };
        let angles = [-PI, -FRAC_PI_2, 0.0, FRAC_PI_2, PI];
        assert_eq!(ticks("across"), angles.map(|k| [[k, -PI], [k, -PI - 0.06]]));
        assert_eq!(ticks("up"), angles.map(|k| [[-PI, k], [-PI - 0.06, k]]));
    }

    #[test]
    fn cells_line_and_solutions_are_where_they_belong() {
        let (checker, q) = arm(false);
        let slice = Slice::through(&checker, &q).unwrap();
        let mut map = CellMap::new(slice, 5);
        map.refine(u32::MAX);
        let at = |th1: f64, th2: f64| AnyConfiguration::T2(T2::new(th1, th2));
        let overlay = Overlay {
            now: Some(q),
            line: Some([at(3.0, 0.0), at(-3.0, 0.1)]),
            solutions: vec![at(0.1, 0.2), at(0.3, -0.2)],
            trace: vec![at(0.0, 0.0), at(0.1, 0.1), at(0.2, 0.1)],
            ..Overlay::default()
        };
        let picture = cspace_picture(&map, &overlay);
        assert!(!picture.in_metres, "radians");
        let find = |id: &str| picture.items.iter().find(|i| i.id == id).unwrap_or_else(|| panic!("{id}"));
        let areas: Vec<f64> = ["cells/free", "cells/blocked", "cells/unknown"]
            .map(|id| {
                let Drawing::Region { pieces, .. } = &find(id).drawing else { panic!("a region") };
                pieces.iter().map(|p| (p[2].x - p[0].x) * (p[2].y - p[0].y) / (4.0 * PI * PI)).sum()
            })
            .to_vec();
        let progress = map.progress();
        for (drawn, counted) in areas.iter().zip([progress.free, progress.blocked, progress.unknown]) {
            assert!((drawn - counted).abs() < 1e-9, "{areas:?} {progress:?}");
        }
        // what is proven free or blocked is so in the middle of each piece
        for (id, is_blocked) in [("cells/free", false), ("cells/blocked", true)] {
            let Drawing::Region { pieces, .. } = &find(id).drawing else { panic!("a region") };
            assert!(pieces.len() > 3);
            for piece in pieces {
                let middle = at(0.5 * (piece[0].x + piece[2].x), 0.5 * (piece[0].y + piece[2].y));
                let footprint = checker.robot().footprint(&middle);
                assert_eq!(checker.scene().intersects(&footprint), is_blocked, "{id} at {middle}");
            }
        }
        let Drawing::Region { outline, .. } = &find("line").drawing else { panic!("lines") };
        assert_eq!(outline.len(), 2, "the short way, over the edge");
        let Drawing::Region { outline, .. } = &find("trace").drawing else { panic!("lines") };
        assert_eq!(outline[0].len(), 3, "one line with a corner");
        assert_eq!((find("solution/2").role, find("now").role), (Role::Focus, Role::Robot));
    }
}
