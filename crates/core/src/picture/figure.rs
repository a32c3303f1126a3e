//! `Figure`, pictures side by side on a sheet of paper, as an SVG file shows them.

use super::item::MIDDLE;
use super::{Anchor, Face, Fit, Line, Palette, Picture, Primitive, Role, ScaleBar, ScreenRect, resolve};
use crate::num::{greater, lesser};

/// A figure: panels in rows of up to three, and a caption under them.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The title, in a few words, for readers who do not see the figure.
    pub title: String,
    /// What the figure shows, in a sentence or two, for the same readers.
    pub description: String,
    /// The panels.
    pub panels: Vec<Panel>,
    /// The lines of the caption.
    pub caption: Vec<String>,
}

/// One picture with its heading and readout under it.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The picture.
    pub picture: Picture,
    /// Its heading; empty for none.
    pub heading: String,
    /// The lines of its readout, in the fixed-width face.
    pub readout: Vec<String>,
}

/// The sheet of paper on which a figure is laid out.
#[derive(Clone, Copy, Debug)]
pub struct Sheet<'a> {
    /// The colours.
    pub palette: &'a Palette,
    /// Greatest width, pixels. A wide sheet has up to three panels side by side, a narrow one fewer.
    pub width_px: f64,
    /// Metadata of the file for programs, a keyword and a text each: the seed, the digest.
    pub notes: &'a [(&'static str, String)],
}

/// Something laid out on a sheet: a group with its name, a bare stroke or word of the sheet's own, or the start or end
/// of clipping at a panel's frame.
pub(super) enum FigureEntry {
    Bare(Primitive),
    Group { id: String, name: String, role: Role, primitives: Vec<Primitive> },
    Clip(ScreenRect),
    Unclip,
}

/// Free room at the sheet's border and between its panels, pixels.
const GAP: f64 = 20.0;
/// The greatest width of the sheet, pixels.
pub(super) const WIDTH: f64 = 1280.0;
/// The greatest height of a picture, pixels.
const TALLEST: f64 = 560.0;
/// Greatest ratio between the picture heights of two rows.
const HIGHER: f64 = 1.3;
/// The line height of a readout, pixels.
const LEADING: f64 = 16.0;
/// Free room inside a picture's frame, pixels.
const MARGIN: f64 = 8.0;

impl Figure {
    /// The figure of one picture alone.
    pub fn of(picture: Picture) -> Self {
        let title = picture.name.clone();
        let panels = vec![Panel { picture, heading: String::new(), readout: Vec::new() }];
        Figure { title, description: String::new(), panels, caption: Vec::new() }
    }

    /// The scale of every panel on a sheet of this width, pixels per metre. It serves to find room on a picture for
    /// things whose size on the sheet is fixed.
    pub fn px_per_metre(&self, width_px: f64) -> Vec<f64> {
        let tallest = self.tallest(width_px);
        let sizes = self.rows(width_px).flat_map(|row| frame_sizes(row, RowHeight { width: width_px, tallest }));
        let fit = |(panel, size): (&Panel, [f64; 2])| {
            Fit::new(&panel.picture.bounds, ScreenRect { min: [0.0; 2], size }, MARGIN).px_per_metre()
        };
        self.panels.iter().zip(sizes).map(fit).collect()
    }

    /// The panels row by row. A row has up to three panels, one for each 300 px of the width, and the rows are filled
    /// evenly.
    fn rows(&self, width: f64) -> std::slice::Chunks<'_, Panel> {
        let columns = ((width / 300.0) as usize).clamp(1, 3);
        let rows = std::cmp::max(self.panels.len().div_ceil(columns), 1);
        self.panels.chunks(std::cmp::max(self.panels.len().div_ceil(rows), 1))
    }

    /// Greatest height of a picture, pixels, such that none is much higher than those of another row.
    fn tallest(&self, width: f64) -> f64 {
        let heights = self
            .rows(width)
            .filter_map(|row| Some(frame_sizes(row, RowHeight { width, tallest: TALLEST }).first()?[1] - 2.0 * MARGIN));
        heights.fold(TALLEST, |tallest, height| lesser(tallest, HIGHER * height))
    }

    /// All strokes and words in painting order, and the size of the sheet.
    pub(super) fn lay_out(&self, width: f64) -> (Vec<FigureEntry>, [f64; 2]) {
        let mut entries = Vec::new();
        let (mut right, mut top) = (GAP, GAP);
        let tallest = self.tallest(width);
        for row in self.rows(width) {
            let [row_right, row_bottom] = lay_out_row(row, top, RowHeight { width, tallest }, &mut entries);
            right = greater(right, row_right);
            top = row_bottom + GAP;
        }
        let letters = ((width - 2.0 * GAP) / (13.0 * 0.52)) as usize;
        for line in self.caption.iter().flat_map(|line| wrapped(line, letters)) {
            let line = line.trim();
            entries.push(FigureEntry::Bare(text(GAP, top, line, Face::Sans, 13.0, Role::Text)));
            top += LEADING + 2.0;
        }
        (entries, [(right + GAP).ceil(), top.ceil()])
    }
}

/// The room for a row, pixels.
#[derive(Clone, Copy)]
struct RowHeight {
    /// The width of the sheet.
    width: f64,
    /// The greatest height of a picture within its frame.
    tallest: f64,
}

/// The sizes of a row's frames, all of one height: as large as the width allows, at most `tallest` inside.
fn frame_sizes(row: &[Panel], RowHeight { width, tallest }: RowHeight) -> Vec<[f64; 2]> {
    let aspect = |panel: &Panel| {
        let bounds = &panel.picture.bounds;
        // the panels of very wide and very high worlds are limited to these ratios
        ((bounds.max.x - bounds.min.x) / (bounds.max.y - bounds.min.y)).clamp(0.5, 3.0)
    };
    let aspects: f64 = row.iter().map(aspect).sum();
    let room = width - GAP * (row.len() as f64 + 1.0) - 2.0 * MARGIN * row.len() as f64;
    let inner = lesser(room / aspects, tallest);
    row.iter().map(|panel| [inner * aspect(panel) + 2.0 * MARGIN, inner + 2.0 * MARGIN]).collect()
}

/// Lays a row out below `top`; returns how far it reaches to the right and down.
fn lay_out_row(row: &[Panel], top: f64, room: RowHeight, entries: &mut Vec<FigureEntry>) -> [f64; 2] {
    let mut left = GAP;
    let mut bottom = top;
    for (panel, size) in row.iter().zip(frame_sizes(row, room)) {
        let rect = ScreenRect { min: [left, top], size };
        let below = lay_out_panel(panel, rect, entries);
        bottom = greater(bottom, below);
        left += rect.size[0] + GAP;
    }
    [left - GAP, bottom]
}

fn lay_out_panel(panel: &Panel, rect: ScreenRect, entries: &mut Vec<FigureEntry>) -> f64 {
    let fit = Fit::new(&panel.picture.bounds, rect, MARGIN);
    let items: Vec<_> = panel.picture.items.iter().map(|item| (item, resolve(item, &fit))).collect();
    let cut = items.iter().any(|(_, primitives)| primitives.iter().any(|p| reaches_out(p, &rect)));
    entries.extend(cut.then_some(FigureEntry::Clip(rect)));
    for (item, primitives) in items {
        let id = format!("{}/{}", panel.picture.name, item.id);
        entries.push(FigureEntry::Group { id, name: item.name.clone(), role: item.role, primitives });
    }
    entries.extend(cut.then_some(FigureEntry::Unclip));
    let [x, y] = rect.min;
    let (right, bottom) = (x + rect.size[0], y + rect.size[1]);
    let frame = vec![vec![[x, y], [right, y], [right, bottom], [x, bottom], [x, y]]];
    entries.push(FigureEntry::Bare(Primitive::Lines { lines: frame, role: Role::Hairline, line: Line::solid(1.0) }));
    let (heading, mut baseline) = (bottom + LEADING + 2.0, bottom + LEADING + 2.0);
    if panel.picture.in_metres {
        let bar = ScaleBar::new(fit.px_per_metre(), 80.0);
        let beside = estimated_width(&panel.heading, 14.0) + estimated_width(&bar.label, 11.0) + bar.length_px + 12.0;
        // under the heading where the two do not fit side by side
        baseline += if beside > rect.size[0] && !panel.heading.is_empty() { LEADING } else { 0.0 };
        entries.extend(scale_bar(bar, right, baseline));
    }
    if !panel.heading.is_empty() {
        entries.push(FigureEntry::Bare(text(x, heading, &panel.heading, Face::Sans, 14.0, Role::Text)));
    }
    let columns = (rect.size[0] / (11.0 * 0.61)) as usize;
    for line in panel.readout.iter().flat_map(|line| wrapped(line, columns)) {
        baseline += LEADING;
        entries.push(FigureEntry::Bare(text(x, baseline, &line, Face::Mono, 11.0, Role::Muted)));
    }
    baseline + 4.0
}

/// Width of a line of text, as wide letters of a sans face make it, pixels.
fn estimated_width(line: &str, size: f64) -> f64 {
    0.6 * size * line.chars().count() as f64
}

/// Whether a stroke or area goes beyond a rectangle.
fn reaches_out(primitive: &Primitive, rect: &ScreenRect) -> bool {
    let out = |p: &[f64; 2], by: f64| (0..2).any(|i| p[i] - by < rect.min[i] || p[i] + by > rect.min[i] + rect.size[i]);
    match primitive {
        Primitive::Area { corners, .. } => corners.iter().any(|p| out(p, 0.0)),
        Primitive::Dots { centres, radius, .. } => centres.iter().any(|p| out(p, *radius)),
        Primitive::Circle { centre, radius, .. } => out(centre, *radius),
        Primitive::Lines { lines, .. } => lines.iter().flatten().any(|p| out(p, 0.0)),
        Primitive::Text { at, .. } => out(at, 0.0),
    }
}

/// Breaks a line at spaces where it is longer than `columns`. Continuation lines are indented by two.
fn wrapped(line: &str, columns: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in line.split_inclusive(' ') {
        let used = lines.last().map_or(0, |l| l.chars().count());
        let fits = used + word.trim_end().chars().count() <= columns;
        match lines.last_mut() {
            Some(last) if fits || last.trim().is_empty() => last.push_str(word),
            _ => lines.push(format!("  {word}")),
        }
    }
    lines
}

/// A scale bar that ends at `right`.
fn scale_bar(bar: ScaleBar, right: f64, baseline: f64) -> [FigureEntry; 2] {
    let (left, y) = (right - bar.length_px, baseline - 4.0);
    let lines = vec![
        vec![[left, y], [right, y]],
        vec![[left, y - 3.0], [left, y + 3.0]],
        vec![[right, y - 3.0], [right, y + 3.0]],
    ];
    let label = Primitive::Text {
        at: Anchor::Left.moved([left, baseline - MIDDLE * 11.0]),
        anchor: Anchor::Left,
        text: bar.label,
        face: Face::Sans,
        size: 11.0,
        role: Role::Muted,
        plate: false,
    };
    [FigureEntry::Bare(Primitive::Lines { lines, role: Role::Muted, line: Line::solid(1.0) }), FigureEntry::Bare(label)]
}

fn text(left: f64, baseline: f64, text: &str, face: Face, size: f64, role: Role) -> Primitive {
    let at = [left, baseline - MIDDLE * size];
    Primitive::Text { at, anchor: Anchor::Right, text: text.into(), face, size, role, plate: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_and_a_scale_bar_stand_apart() {
        let picture = Picture::new("p", crate::worlds::World::workbench().bounds);
        let [wide, narrow] = [300.0, 150.0].map(|width| {
            let panel = Panel { picture: picture.clone(), heading: "Reach · Workbench".into(), readout: vec![] };
            let mut entries = vec![];
            let rect = ScreenRect { min: [0.0, 0.0], size: [width, width] };
            lay_out_panel(&panel, rect, &mut entries);
            let height = |wanted: &str| {
                let of = |entry: &FigureEntry| match entry {
                    FigureEntry::Bare(Primitive::Text { at, text, .. }) if text.ends_with(wanted) => Some(at[1]),
                    _ => None,
                };
                entries.iter().find_map(of).unwrap()
            };
            height(" m") - height("Workbench")
        });
        // the two sizes of letters have their middles apart on one baseline
        assert!(wide.abs() < 2.0, "{wide}");
        assert!(narrow > 10.0, "{narrow}: one line lower");
    }

    #[test]
    fn a_panel_alone_in_its_row_is_not_much_higher_than_the_others() {
        let panel = |x: f64, y: f64| {
            let bounds = crate::geometry::Aabb { min: [0.0, 0.0].into(), max: [x, y].into() };
            Panel { picture: Picture::new("p", bounds), heading: String::new(), readout: Vec::new() }
        };
        let figure = |panels: Vec<Panel>| Figure { panels, ..Figure::of(panel(1.0, 1.0).picture) };
        let three = figure(vec![panel(12.0, 8.0), panel(4.8, 4.8), panel(16.0, 10.0)]).px_per_metre(640.0);
        let heights = [8.0 * three[0], 4.8 * three[1], 10.0 * three[2]];
        assert!(
            (heights[0] - heights[1]).abs() < 1e-9 && (heights[2] / heights[0] - HIGHER).abs() < 1e-9,
            "{heights:?}"
        );
        let alone = figure(vec![panel(16.0, 10.0)]).px_per_metre(640.0);
        assert!(
            (16.0 * alone[0] - (640.0 - 2.0 * GAP - 2.0 * MARGIN)).abs() < 1e-9,
            "alone it is as wide as the sheet"
        );
    }

    #[test]
    fn long_readouts_break_at_spaces() {
        assert_eq!(wrapped("Pose2 { x: 1 }", 40), ["Pose2 { x: 1 }"]);
        let lines = wrapped("HitchCfg { body: Pose2 { x: 1 }, trailer: None }", 33);
        assert_eq!(lines, ["HitchCfg { body: Pose2 { x: 1 }, ", "  trailer: None }"]);
        assert_eq!(wrapped("unbreakable", 3), ["unbreakable"], "a word is never cut");
    }
}
