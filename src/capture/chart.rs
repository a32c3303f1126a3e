//! `Chart`, lines over axes, drawn as a picture in the pixels of its sheet.

use std::f64::consts::PI;

use crate::geometry::{Aabb, Point2};
use crate::num::{greater, lesser};
use crate::picture::{Anchor, Dash, Drawing, Face, Item, Line, Picture, Role};

/// A line of a chart.
pub(super) struct ChartLine {
    /// Its name, in the legend.
    pub(super) name: String,
    /// Its pieces, left to right: between two of them the line is broken.
    pub(super) pieces: Vec<Vec<[f64; 2]>>,
}

/// Lines over axes.
pub(super) struct Chart<'a> {
    /// What goes up, with its unit; it names the picture too.
    pub(super) up: &'a str,
    /// What goes across, with its unit.
    pub(super) across: &'a str,
    /// Both ends of the axis across.
    pub(super) span: [f64; 2],
    /// Whether the values are angles in (-pi, pi]; the axis then shows them all.
    pub(super) angles: bool,
    /// The lines, at most [`MOST_LINES`].
    pub(super) lines: Vec<ChartLine>,
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

/// Largest number of lines in a chart: more could not be told apart.
pub const MOST_LINES: usize = LOOKS.len();

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

/// A mark of an axis, with its figure.
#[derive(Clone, Debug, PartialEq)]
struct Mark {
    at: f64,
    text: String,
}

impl Chart<'_> {
    /// The picture of the chart, `width` pixels wide on its sheet. Its plane is in pixels, x right, y up.
    pub(super) fn picture(&self, width: f64) -> Picture {
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
        picture.with(self.axes(&area)).with(self.curves(&area)).with(self.words(&area, height, &legend))
    }

    /// Both ends of the axis that goes up: the values and 0, and a little room.
    fn range(&self) -> [f64; 2] {
        if self.angles {
            return [-PI, PI];
        }
        let values = self.lines.iter().flat_map(|line| line.pieces.iter().flatten()).map(|p| p[1]);
        let [low, high] = values.fold([0.0, 0.0], |[low, high], y| [lesser(low, y), greater(high, y)]);
        if low == high {
            [-1.0, 1.0]
        } else {
            [low - 0.04 * (high - low) * f64::from(low < 0.0), high + 0.04 * (high - low)]
        }
    }

    /// The frame, the marks and their figures.
    fn axes(&self, area: &Area) -> Vec<Item> {
        let corner = |x: f64, y: f64| Point2::new(x, y);
        let Area { left, right, bottom, top, .. } = *area;
        let frame = vec![corner(left, top), corner(left, bottom), corner(right, bottom)];
        let mut items =
            vec![Item::new("axes", "the axes", Role::Muted, Drawing::Polyline(frame)).stroked(Line::solid(1.0))];
        let up = if self.angles { angle_marks() } else { marks(area.up, ((top - bottom) / 40.0) as usize) };
        for Mark { at, text } in up {
            let y = area.at([self.span[0], at]).y;
            let line = Drawing::segment(corner(left, y), corner(right, y));
            items.push(Item::new(format!("grid/{text}"), &text, Role::Hairline, line).stroked(Line::solid(1.0)));
            items.push(label(format!("up/{text}"), corner(left, y), &text, Anchor::Left));
        }
        for Mark { at, text } in marks(self.span, ((right - left) / 70.0) as usize) {
            let x = area.at([at, 0.0]).x;
            let line = Drawing::segment(corner(x, bottom), corner(x, bottom - TICK));
            items.push(Item::new(format!("tick/{text}"), &text, Role::Muted, line).stroked(Line::solid(1.0)));
            items.push(label(format!("across/{text}"), corner(x, bottom), &text, Anchor::Below));
        }
        items
    }

    /// The lines, thinned to what the pixels show.
    fn curves(&self, area: &Area) -> Vec<Item> {
        let lines = self.lines.iter().zip(LOOKS).map(|(ChartLine { name, pieces }, (role, dash))| {
            let drawn = pieces.iter().map(|piece| {
                let points: Vec<Point2> = piece.iter().map(|p| area.at(*p)).collect();
                let thin = thinned(&points);
                // a value alone is drawn as a dot
                if let [only] = thin[..] { vec![only, only] } else { thin }
            });
            let region = Drawing::Region { pieces: Vec::new(), outline: drawn.collect() };
            Item::new(format!("line/{name}"), name, role, region).stroked(Line::solid(1.5).dashed(dash))
        });
        lines.collect()
    }

    /// The names of the axes and the legend.
    fn words(&self, area: &Area, height: f64, legend: &[Entry]) -> Vec<Item> {
        let mut items = vec![
            label("up/name".into(), Point2::new(-6.0, height - 0.5 * LEADING), self.up, Anchor::Right),
            label("across/name".into(), Point2::new(area.right + 6.0, 0.5 * LEADING - 3.0), self.across, Anchor::Left),
        ];
        for ((line, (role, dash)), Entry { row, left }) in self.lines.iter().zip(LOOKS).zip(legend) {
            let y = height - LEADING * (*row as f64 + 1.5);
            let sample = Drawing::segment(Point2::new(*left, y), Point2::new(left + SAMPLE, y));
            items.push(
                Item::new(format!("legend/{}", line.name), &line.name, role, sample)
                    .stroked(Line::solid(1.5).dashed(dash)),
            );
            let at = Point2::new(left + SAMPLE, y);
            items.push(label(format!("legend/{}/name", line.name), at, &line.name, Anchor::Right));
        }
        items
    }

    /// Where each line's entry in the legend stands: as many in a row as have room.
    fn legend(&self, width: f64) -> Vec<Entry> {
        let (mut row, mut left) = (0, 0.0);
        let entries = self.lines.iter().map(|line| {
            let room = SAMPLE + 24.0 + 0.55 * SMALL * line.name.chars().count() as f64;
            if left > 0.0 && left + room > width {
                (row, left) = (row + 1, 0.0);
            }
            let entry = Entry { row, left };
            left += room;
            entry
        });
        entries.collect()
    }
}

/// Where an entry of the legend stands: its row from the top, and its left end, pixels.
struct Entry {
    row: usize,
    left: f64,
}

/// The part of the picture that the axes span, pixels, and the values at its edges.
struct Area {
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    across: [f64; 2],
    up: [f64; 2],
}

impl Area {
    /// Where a value is.
    fn at(&self, [x, y]: [f64; 2]) -> Point2 {
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        Point2::new(
            self.left + part(x, self.across) * (self.right - self.left),
            self.bottom + part(y, self.up) * (self.top - self.bottom),
        )
    }
}

fn label(id: String, at: Point2, text: &str, anchor: Anchor) -> Item {
    let text = text.to_owned();
    let drawing = Drawing::Label { at, text: text.clone(), anchor, face: Face::Sans, size_px: SMALL, plate: false };
    Item::new(id, text, Role::Muted, drawing)
}

/// Round marks between both ends, about `most` of them and at least two where there is room for two: multiples of 1, 2
/// or 5 times a power of ten.
fn marks([low, high]: [f64; 2], most: usize) -> Vec<Mark> {
    const DECADES: [(f64, usize); 16] = [
        (1e-6, 6),
        (1e-5, 5),
        (1e-4, 4),
        (1e-3, 3),
        (1e-2, 2),
        (1e-1, 1),
        (1.0, 0),
        (1e1, 0),
        (1e2, 0),
        (1e3, 0),
        (1e4, 0),
        (1e5, 0),
        (1e6, 0),
        (1e7, 0),
        (1e8, 0),
        (1e9, 0),
    ];
    let steps = DECADES.into_iter().flat_map(|(decade, places)| [1.0, 2.0, 5.0].map(|digit| (digit * decade, places)));
    let fits = |step: f64| (high - low) / step <= std::cmp::max(most, 2) as f64;
    let Some((step, places)) = steps.into_iter().find(|(step, _)| fits(*step)) else { return Vec::new() };
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let mark = |k: i64| {
        let at = k as f64 * step;
        Mark { at, text: format!("{at:.places$}").replace('-', "\u{2212}") }
    };
    (first..=last).map(mark).collect()
}

/// The marks of an axis of angles.
fn angle_marks() -> Vec<Mark> {
    let marks = [
        (-PI, "\u{2212}\u{3c0}"),
        (-0.5 * PI, "\u{2212}\u{3c0}/2"),
        (0.0, "0"),
        (0.5 * PI, "\u{3c0}/2"),
        (PI, "\u{3c0}"),
    ];
    marks.map(|(at, text)| Mark { at, text: text.into() }).into()
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
mod tests {
    use super::*;

    fn texts(marks: &[Mark]) -> Vec<&str> {
        marks.iter().map(|mark| mark.text.as_str()).collect()
    }

    #[test]
    fn marks_are_round_and_few() {
        assert_eq!(texts(&marks([0.0, 60.0], 6)), ["0", "10", "20", "30", "40", "50", "60"]);
        assert_eq!(texts(&marks([-0.31, 0.52], 5)), ["\u{2212}0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(texts(&marks([0.0, 0.0007], 4)), ["0.0000", "0.0002", "0.0004", "0.0006"]);
        assert_eq!(texts(&marks([0.0, 1e12], 4)), [""; 0], "beyond all axes");
    }

    #[test]
    fn a_dip_of_one_tick_is_drawn_among_a_million() {
        let mut points: Vec<Point2> =
            (0..1_000_000).map(|i| Point2::new(f64::from(i) / 2000.0, 100.0 + f64::from(i % 7))).collect();
        points[400_001].y = 3.0;
        points[700_003].y = 300.0;
        let thin = thinned(&points);
        assert!(thin.len() <= 4 * 500, "{}", thin.len());
        let has = |i: usize| thin.contains(&points[i]);
        assert!(has(0) && has(400_001) && has(700_003) && has(999_999));
        assert!(thin.windows(2).all(|pair| pair[0].x <= pair[1].x));
        assert_eq!(thinned(&points[..1]), points[..1]);
    }

    #[test]
    fn a_chart_is_drawn_pixel_for_pixel_with_its_values_where_the_axes_say() {
        let line = |name: &str, pieces: &[&[[f64; 2]]]| ChartLine {
            name: name.into(),
            pieces: pieces.iter().map(|piece| piece.to_vec()).collect(),
        };
        let lines = vec![line("a", &[&[[0.0, 0.0], [5.0, 10.0]], &[[10.0, 5.0]]]), line("b", &[])];
        let chart = Chart { up: "height, m", across: "time, s", span: [0.0, 10.0], angles: false, lines };
        for width in [200.0, 640.0, 1280.0] {
            let picture = chart.picture(width - 56.0);
            assert_eq!(crate::picture::Figure::of(picture.clone()).px_per_metre(width), [1.0], "{width}");
            let find = |id: &str| &picture.items.iter().find(|i| i.id == id).unwrap().drawing;
            let Drawing::Region { outline, .. } = find("line/a") else { panic!("lines") };
            let Drawing::Polyline(axes) = find("axes") else { panic!("a line") };
            let (origin, right) = (axes[1], axes[2].x);
            assert_eq!(outline[0][0], origin, "0 at 0 s is the corner");
            assert!((outline[0][1].x - 0.5 * (origin.x + right)).abs() < 1e-9, "5 s is the middle of 10 s");
            let top = picture.bounds.max.y;
            assert!(outline[0][1].y > origin.y + 0.8 * (0.4 * width - 60.0) && outline[0][1].y < top, "up is up");
            assert_eq!(outline[1].len(), 2, "a value alone is a dot");
            assert!((outline[1][0].y - origin.y - 0.5 * (outline[0][1].y - origin.y)).abs() < 1e-9);
            let low = picture.items.iter().filter(|i| i.id.starts_with("grid/")).count();
            assert!(low >= 2, "{low} marks");
        }
    }
}
