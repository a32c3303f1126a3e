//! `PlotChart`, lines over axes, drawn as a picture in the pixels of its sheet.

use std::f64::consts::PI;

use super::marks::{AxisMark, angle_marks, marks};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::picture::{Anchor, Dash, Drawing, Face, Fill, Item, Line, Picture, Role};

/// A line of a chart.
pub(in crate::capture) struct PlotLine {
    /// Its name, in the legend.
    pub(in crate::capture) name: String,
    /// Its pieces, left to right: between two of them the line is broken.
    pub(in crate::capture) pieces: Vec<Vec<[f64; 2]>>,
    /// The stretches across in which its robot was in contact, left to right.
    pub(in crate::capture) contacts: Vec<[f64; 2]>,
}

/// What the axis of a chart that goes up shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::capture) enum PlotValues {
    /// The values, and 0.
    FromZero,
    /// The values alone.
    Alone,
    /// All angles in (-pi, pi].
    Angles,
}

pub(in crate::capture) struct PlotChart<'a> {
    /// What goes up, with its unit; it names the picture too.
    pub(in crate::capture) up: &'a str,
    /// What goes across, with its unit.
    pub(in crate::capture) across: &'a str,
    /// Both ends of the axis across.
    pub(in crate::capture) span: [f64; 2],
    /// The only value, which the middle of the axis across then stands for; `None` for an axis of many.
    pub(in crate::capture) only: Option<String>,
    /// What the axis that goes up shows.
    pub(in crate::capture) values: PlotValues,
    /// The lines, at most [`MAX_LINES`].
    pub(in crate::capture) lines: Vec<PlotLine>,
}

/// The look of the lines, which differ in colour, and neighbours in their dashes too.
const LOOKS: [(Role, Dash); 8] = [
    (Role::Robot, Dash::Solid),
    (Role::Witness, Dash::Dashed),
    (Role::Free, Dash::Dotted),
    (Role::Path, Dash::Solid),
    (Role::Sensor, Dash::Dashed),
    (Role::Obstacle, Dash::Dotted),
    (Role::Focus, Dash::Solid),
    (Role::Unknown, Dash::Dashed),
];

/// The role of contacts: behind all lines where any robot was in contact, and beneath the lines of those that were.
const CONTACT: Role = Role::Goal;
/// The name of contacts in the legend.
const IN_CONTACT: &str = "in contact";
/// The opacity of the shade of contacts.
const SHADE: f64 = 0.22;

/// Largest number of lines in a chart: more could not be told apart.
pub const MAX_LINES: usize = LOOKS.len();

/// The height of the small letters, pixels.
const SMALL: f64 = 11.0;
/// The distance between two lines of words, pixels.
const LEADING: f64 = 16.0;
/// The room for the figures of the axis that goes up, pixels.
const LEFT: f64 = 58.0;
/// The room for the figures and the name of the axis that goes across, pixels.
const BELOW: f64 = 38.0;
/// The room at the right, where a figure reaches out, pixels.
const RIGHT: f64 = 14.0;
/// The length of a tick of an axis, pixels.
const TICK: f64 = 4.0;
/// The length of a line's sample in the legend, pixels.
const SAMPLE: f64 = 24.0;

impl PlotChart<'_> {
    /// The picture of the chart, `width` pixels wide on its sheet. Its plane is in pixels, x right, y up.
    pub(in crate::capture) fn picture(&self, width: f64) -> Picture {
        let legend = self.legend(width);
        let head = LEADING * (1.0 + legend.iter().map(|entry| entry.row + 1).max().unwrap_or(0) as f64);
        let height = lesser(540.0, greater(0.4 * width, 120.0) + head + BELOW);
        let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(width, height) };
        let area = Area {
            left: LEFT,
            right: width - RIGHT,
            bottom: BELOW,
            top: height - head - 10.0,
            across: self.span,
            up: self.range(),
        };
        let picture = Picture { in_metres: false, ..Picture::new(self.up, bounds) };
        let (axes, shade) = (self.axes(&area), self.shade(&area));
        picture.with(shade).with(axes).with(self.curves(&area)).with(self.words(&area, height, &legend))
    }

    /// Both ends of the axis that goes up, with a little room.
    fn range(&self) -> [f64; 2] {
        let mut values = self.lines.iter().flat_map(|line| line.pieces.iter().flatten()).map(|p| p[1]).peekable();
        let first = match self.values {
            PlotValues::Angles => return [-PI, PI],
            PlotValues::FromZero => 0.0,
            PlotValues::Alone => values.peek().copied().unwrap_or(0.0),
        };
        let [low, high] = values.fold([first, first], |[low, high], y| [lesser(low, y), greater(high, y)]);
        if low == high {
            [low - 1.0, high + 1.0]
        } else {
            let below = f64::from(low != 0.0);
            [low - 0.04 * (high - low) * below, high + 0.04 * (high - low)]
        }
    }

    /// The frame, the marks and their figures.
    fn axes(&self, area: &Area) -> Vec<Item> {
        let corner = |x: f64, y: f64| Point2::new(x, y);
        let Area { left, right, bottom, top, .. } = *area;
        let frame = vec![corner(left, top), corner(left, bottom), corner(right, bottom)];
        let mut items =
            vec![Item::new("axes", "the axes", Role::Muted, Drawing::Polyline(frame)).stroked(Line::solid(1.0))];
        let is_angle = self.values == PlotValues::Angles;
        let up = if is_angle { angle_marks() } else { marks(area.up, ((top - bottom) / 40.0) as usize) };
        for AxisMark { at, text } in up {
            let y = area.at([self.span[0], at]).y;
            let line = Drawing::segment(corner(left, y), corner(right, y));
            items.push(Item::new(format!("grid/{text}"), &text, Role::Hairline, line).stroked(Line::solid(1.0)));
            items.push(label(format!("up/{text}"), corner(left, y), &text, Anchor::Left));
        }
        let across = match &self.only {
            Some(text) => vec![AxisMark { at: 0.5 * (self.span[0] + self.span[1]), text: text.clone() }],
            None => marks(self.span, ((right - left) / 70.0) as usize),
        };
        for AxisMark { at, text } in across {
            let x = area.at([at, 0.0]).x;
            let line = Drawing::segment(corner(x, bottom), corner(x, bottom - TICK));
            items.push(Item::new(format!("tick/{text}"), &text, Role::Muted, line).stroked(Line::solid(1.0)));
            items.push(label(format!("across/{text}"), corner(x, bottom), &text, Anchor::Below));
        }
        items
    }

    /// The lines, each above a broad one where its robot was in contact.
    fn curves(&self, area: &Area) -> Vec<Item> {
        let contacts = self.lines.iter().filter(|line| !line.contacts.is_empty()).map(|line| {
            let name = format!("{}, {IN_CONTACT}", line.name);
            let within = area.drawn(&line.within_contacts());
            Item::new(format!("contact/{}", line.name), name, CONTACT, within).stroked(Line::solid(6.0).at_opacity(0.5))
        });
        let lines = self.lines.iter().zip(LOOKS).map(|(PlotLine { name, pieces, .. }, (role, dash))| {
            Item::new(format!("line/{name}"), name, role, area.drawn(pieces)).stroked(Line::solid(1.5).dashed(dash))
        });
        contacts.chain(lines).collect()
    }

    /// The stretches in which any robot was in contact, from the bottom to the top.
    fn shade(&self, area: &Area) -> Option<Item> {
        let mut stretches: Vec<[f64; 2]> = self.lines.iter().flat_map(|line| &line.contacts).copied().collect();
        stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut drawn: Vec<[f64; 2]> = Vec::new();
        for [from, to] in stretches {
            let [left, right] = [from, to].map(|x| lesser(area.at([x, 0.0]).x, area.right));
            // the shortest contact is seen too
            let left = lesser(left, area.right - 1.0);
            let right = greater(right, left + 1.0);
            match drawn.last_mut().filter(|last| last[1] >= left) {
                Some(last) => last[1] = greater(last[1], right),
                None => drawn.push([left, right]),
            }
        }
        let column = |[left, right]: [f64; 2]| area.column(left, right);
        let pieces: Vec<Vec<Point2>> = drawn.into_iter().map(column).collect();
        let region = Drawing::Region { pieces, outline: Vec::new() };
        self.touches().then(|| Item::new("contacts", IN_CONTACT, CONTACT, region).filled(Fill::Tint(SHADE)))
    }

    /// Whether any robot was in contact.
    fn touches(&self) -> bool {
        self.lines.iter().any(|line| !line.contacts.is_empty())
    }

    /// The lines in the legend: none where the only one is called as the axis that goes up.
    fn listed(&self) -> &[PlotLine] {
        if matches!(&self.lines[..], [only] if only.name == self.up) { &[] } else { &self.lines }
    }

    /// The names in the legend: those of the lines, and what the shade is.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.listed().iter().map(|line| line.name.as_str()).chain(self.touches().then_some(IN_CONTACT))
    }

    /// The names of the axes and the legend.
    fn words(&self, area: &Area, height: f64, legend: &[LegendEntry]) -> Vec<Item> {
        let mut items = vec![
            label("up/name".into(), Point2::new(-6.0, height - 0.5 * LEADING), self.up, Anchor::Right),
            label("across/name".into(), Point2::new(area.right + 6.0, 0.5 * LEADING - 3.0), self.across, Anchor::Left),
        ];
        for ((line, (role, dash)), LegendEntry { row, left }) in self.listed().iter().zip(LOOKS).zip(legend) {
            let y = height - LEADING * (*row as f64 + 1.5);
            let sample = Drawing::segment(Point2::new(*left, y), Point2::new(left + SAMPLE, y));
            items.push(
                Item::new(format!("legend/{}", line.name), &line.name, role, sample)
                    .stroked(Line::solid(1.5).dashed(dash)),
            );
        }
        if let Some(LegendEntry { row, left }) = legend.get(self.listed().len()) {
            let y = height - LEADING * (*row as f64 + 1.5);
            let corners = [[*left, y - 5.0], [left + SAMPLE, y - 5.0], [left + SAMPLE, y + 5.0], [*left, y + 5.0]];
            let sample = Drawing::Polygon(corners.map(|[x, y]| Point2::new(x, y)).into());
            items.push(Item::new("legend/contacts", IN_CONTACT, CONTACT, sample).filled(Fill::Tint(SHADE)));
        }
        for (name, LegendEntry { row, left }) in self.names().zip(legend) {
            let at = Point2::new(left + SAMPLE, height - LEADING * (*row as f64 + 1.5));
            items.push(label(format!("legend/{name}/name"), at, name, Anchor::Right));
        }
        items
    }

    /// Where each entry of the legend stands: as many in a row as have room.
    fn legend(&self, width: f64) -> Vec<LegendEntry> {
        let (mut row, mut left) = (0, 0.0);
        let entries = self.names().map(|name| {
            let room = SAMPLE + 24.0 + 0.55 * SMALL * name.chars().count() as f64;
            if left > 0.0 && left + room > width {
                (row, left) = (row + 1, 0.0);
            }
            let entry = LegendEntry { row, left };
            left += room;
            entry
        });
        entries.collect()
    }
}

/// Where an entry of the legend stands: its row from the top, and its left end, pixels.
struct LegendEntry {
    row: usize,
    left: f64,
}

/// The part of the picture that the axes span, pixels, and the values at its edges.
pub(in crate::capture) struct Area {
    pub(in crate::capture) left: f64,
    pub(in crate::capture) right: f64,
    pub(in crate::capture) bottom: f64,
    pub(in crate::capture) top: f64,
    pub(in crate::capture) across: [f64; 2],
    pub(in crate::capture) up: [f64; 2],
}

impl Area {
    pub(in crate::capture) fn at(&self, [x, y]: [f64; 2]) -> Point2 {
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        Point2::new(
            self.left + part(x, self.across) * (self.right - self.left),
            self.bottom + part(y, self.up) * (self.top - self.bottom),
        )
    }

    /// Lines through these values, thinned to what the pixels show.
    fn drawn(&self, pieces: &[Vec<[f64; 2]>]) -> Drawing {
        let drawn = pieces.iter().map(|piece| {
            let points: Vec<Point2> = piece.iter().map(|p| self.at(*p)).collect();
            let thin = thinned(&points);
            // a value alone is drawn as a dot
            if let [only] = thin[..] { vec![only, only] } else { thin }
        });
        Drawing::Region { pieces: Vec::new(), outline: drawn.collect() }
    }

    /// The corners of a column between two places across, pixels.
    fn column(&self, left: f64, right: f64) -> Vec<Point2> {
        let (bottom, top) = (self.bottom, self.top);
        [[left, bottom], [right, bottom], [right, top], [left, top]].map(|[x, y]| Point2::new(x, y)).into()
    }
}

impl PlotLine {
    /// The parts of its pieces in which its robot was in contact.
    fn within_contacts(&self) -> Vec<Vec<[f64; 2]>> {
        let mut contacts = self.contacts.iter().copied().peekable();
        let mut parts = Vec::new();
        for piece in &self.pieces {
            // by the number of the contact that holds each value: values and contacts both ascend
            let mut part: Vec<[f64; 2]> = Vec::new();
            for &value in piece {
                while contacts.next_if(|[_, to]| *to <= value[0]).is_some() {
                    parts.push(std::mem::take(&mut part));
                }
                if contacts.peek().is_some_and(|[from, _]| *from <= value[0]) {
                    part.push(value);
                }
            }
            parts.push(part);
        }
        parts.retain(|part| !part.is_empty());
        parts
    }
}

pub(in crate::capture) fn label(id: String, at: Point2, text: &str, anchor: Anchor) -> Item {
    let text = text.to_owned();
    let drawing = Drawing::Label { at, text: text.clone(), anchor, face: Face::Sans, size_px: SMALL, plate: false };
    Item::new(id, text, Role::Muted, drawing)
}

/// Of the points in each column of pixels the first, the lowest, the highest and the last: what is drawn stays the same
/// to a pixel.
fn thinned(points: &[Point2]) -> Vec<Point2> {
    let mut thin = Vec::new();
    for column in points.chunk_by(|a, b| a.x.floor() == b.x.floor()) {
        let by_height = |best: usize, i: usize, higher: bool| {
            if (column[i].y > column[best].y) == higher && column[i].y != column[best].y { i } else { best }
        };
        let lowest = (0..column.len()).fold(0, |best, i| by_height(best, i, false));
        let highest = (0..column.len()).fold(0, |best, i| by_height(best, i, true));
        let mut kept = [0, lowest, highest, column.len() - 1];
        kept.sort_unstable();
        thin.extend(kept.iter().enumerate().filter(|(k, i)| *k == 0 || kept[k - 1] != **i).map(|(_, i)| column[*i]));
    }
    thin
}

#[cfg(test)]
mod tests;
