//! What became of many runs by what was varied in them: a box or a strip for each value, as a figure.

use super::quartiles::Quartiles;
use crate::capture::captured::{Captured, Note};
use crate::capture::chart::{Area, label};
use crate::capture::marks::{AxisMark, marks};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::picture::{Anchor, Drawing, Figure, Fill, Item, Line, Panel, Picture, Role};

/// A quantity in many runs, by the value that was varied in them.
#[derive(Clone, Debug, PartialEq)]
pub struct ByValue {
    /// What it is, with its unit.
    pub name: String,
    /// Each value in words, with the quantity in its runs. Numbers that are not finite are left out.
    pub groups: Vec<(String, Vec<f64>)>,
}

/// The greatest number of runs whose numbers are dots; of more there is a box.
const MAX_DOTS: usize = 5;

/// The width of a panel, pixels.
const WIDTH: f64 = 400.0;
/// The height of a value's row, pixels.
const ROW: f64 = 20.0;
/// The height of a box, pixels.
const BOX: f64 = 11.0;
/// The room for the figures and the name of the axis, pixels.
const BELOW: f64 = 38.0;
/// The room above, for the parameter's name, pixels.
const ABOVE: f64 = 22.0;
/// The width of a small letter, pixels.
const LETTER: f64 = 6.0;
/// The most letters of a value's words that are shown.
const MAX_LETTERS: usize = 22;

/// What became of runs by the values of a parameter, a panel for each quantity that any of them has. A box goes from
/// the lower quartile to the upper, with a line at the median; its whiskers end at the least and the greatest. Up to
/// five runs are dots.
pub fn boxes(title: &str, parameter: &str, results: &[ByValue], notes: Vec<Note>) -> Captured {
    let (mut panels, mut sentences) = (Vec::new(), Vec::new());
    for result in results {
        let found: Vec<Option<Quartiles>> =
            result.groups.iter().map(|(_, numbers)| Quartiles::of(numbers.iter().copied())).collect();
        let Some(span) = span(&found) else { continue };
        let words = result.groups.iter().zip(&found).map(|((value, _), found)| words(value, found.as_ref()));
        sentences.push(format!("{} by {parameter}: {}.", result.name, words.collect::<Vec<_>>().join("; ")));
        let picture = picture(parameter, result, (&found, span));
        panels.push(Panel { picture, heading: result.name.clone(), readout: Vec::new() });
    }
    let (title, description) = (title.to_owned(), sentences.join(" "));
    Captured { figure: Figure { title, description, panels, caption: Vec::new() }, notes }
}

/// What became of the runs of a value, in words.
fn words(value: &str, found: Option<&Quartiles>) -> String {
    match found {
        None => format!("{value} in no run"),
        Some(Quartiles { count: 1, median, .. }) => format!("{value} {median:.3} in one run"),
        Some(Quartiles { count, lower, median, upper, .. }) => {
            format!("{value} {median:.3}, {lower:.3} to {upper:.3}, in {count} runs")
        }
    }
}

/// Both ends of the axis: the least and the greatest of all, and a little room; `None` without any number.
fn span(found: &[Option<Quartiles>]) -> Option<[f64; 2]> {
    let ends = found.iter().flatten().map(|q| [q.least, q.greatest]);
    let [low, high] = ends.reduce(|[low, high], [least, most]| [lesser(low, least), greater(high, most)])?;
    let room = greater(0.04 * (high - low), 1e-9 * greater(high.abs(), 1.0));
    Some(if low == high {
        [low - 0.5 * greater(low.abs(), 1.0), high + 0.5 * greater(high.abs(), 1.0)]
    } else {
        [low - room, high + room]
    })
}

/// The first letters of a value's words.
fn shortened(words: &str) -> String {
    if words.chars().count() <= MAX_LETTERS {
        return words.to_owned();
    }
    words.chars().take(MAX_LETTERS - 1).chain(['\u{2026}']).collect()
}

fn picture(parameter: &str, result: &ByValue, (found, span): (&[Option<Quartiles>], [f64; 2])) -> Picture {
    let named: Vec<String> = result.groups.iter().map(|(value, _)| shortened(value)).collect();
    let longest = named.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let height = ABOVE + BELOW + ROW * named.len() as f64;
    let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(WIDTH, height) };
    let rows = named.len() as f64;
    let area = Area {
        left: 12.0 + LETTER * longest as f64,
        right: WIDTH - 14.0,
        bottom: BELOW,
        top: height - ABOVE,
        across: span,
        up: [rows, 0.0],
    };
    let mut items = axes(&area, parameter, &result.name);
    for (row, ((name, (value, numbers)), found)) in named.iter().zip(&result.groups).zip(found).enumerate() {
        let y = area.at([span[0], row as f64 + 0.5]).y;
        items.push(label(format!("value/{row}"), Point2::new(area.left, y), name, Anchor::Left));
        items.extend(found.iter().flat_map(|q| drawn(&area, row, (y, &words(value, Some(q))), (q, numbers))));
    }
    Picture { in_metres: false, ..Picture::new(&result.name, bounds) }.with(items)
}

/// The frame, the marks across with their figures, and both names.
fn axes(area: &Area, parameter: &str, name: &str) -> Vec<Item> {
    let Area { left, right, bottom, top, .. } = *area;
    let frame = [[left, top], [left, bottom], [right, bottom]].map(|[x, y]| Point2::new(x, y)).to_vec();
    let mut items =
        vec![Item::new("axes", "the axes", Role::Muted, Drawing::Polyline(frame)).stroked(Line::solid(1.0))];
    for AxisMark { at, text } in marks(area.across, ((right - left) / 70.0) as usize) {
        let x = area.at([at, 0.0]).x;
        let line = Drawing::segment(Point2::new(x, bottom), Point2::new(x, top));
        items.push(Item::new(format!("grid/{text}"), &text, Role::Hairline, line).stroked(Line::solid(1.0)));
        items.push(label(format!("across/{text}"), Point2::new(x, bottom), &text, Anchor::Below));
    }
    items.push(label("across/name".into(), Point2::new(right + 6.0, 5.0), name, Anchor::Left));
    items.push(label("up/name".into(), Point2::new(-6.0, top + 0.5 * ABOVE), parameter, Anchor::Right));
    items
}

/// The dots or the box of a value's runs.
fn drawn(area: &Area, row: usize, (y, name): (f64, &str), (found, numbers): (&Quartiles, &[f64])) -> Vec<Item> {
    let at = |x: f64, dy: f64| Point2::new(area.at([x, 0.0]).x, y + dy);
    if found.count <= MAX_DOTS {
        let dots = numbers.iter().filter(|x| x.is_finite()).map(|x| vec![at(*x, 0.0); 2]).collect();
        let dots = Drawing::Region { pieces: Vec::new(), outline: dots };
        return vec![
            Item::new(format!("dots/{row}"), name, Role::Robot, dots).stroked(Line::solid(6.0).at_opacity(0.8)),
        ];
    }
    let Quartiles { least, lower, median, upper, greatest, .. } = *found;
    let half = 0.5 * BOX;
    let corners = [at(lower, -half), at(upper, -half), at(upper, half), at(lower, half)].to_vec();
    let whiskers = vec![
        vec![at(least, 0.0), at(lower, 0.0)],
        vec![at(upper, 0.0), at(greatest, 0.0)],
        vec![at(least, -0.5 * half), at(least, 0.5 * half)],
        vec![at(greatest, -0.5 * half), at(greatest, 0.5 * half)],
    ];
    let whiskers = Drawing::Region { pieces: Vec::new(), outline: whiskers };
    vec![
        Item::new(format!("whiskers/{row}"), name, Role::Robot, whiskers).stroked(Line::solid(1.2)),
        Item::new(format!("box/{row}"), name, Role::Robot, Drawing::Polygon(corners))
            .filled(Fill::Tint(0.25))
            .stroked(Line::solid(1.2)),
        Item::new(format!("median/{row}"), name, Role::Robot, Drawing::segment(at(median, -half), at(median, half)))
            .stroked(Line::solid(2.5)),
    ]
}

#[cfg(test)]
mod tests;
