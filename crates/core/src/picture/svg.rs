//! The SVG writer: the same bytes for the same figure and palette, on every platform.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::figure::{FigureEntry, WIDTH};
use super::item::MIDDLE;
use super::{Anchor, Face, Figure, Fit, Line, Palette, Picture, Primitive, Role, ScreenPoint, Sheet, resolve};

impl Figure {
    /// The figure as an SVG file, the same bytes for the same figure and palette. Metres are fitted to the panels, and
    /// line widths are in pixels.
    pub fn svg(&self, palette: &Palette) -> String {
        self.svg_on(&Sheet { palette, width_px: WIDTH, notes: &[] })
    }

    /// As [`svg`](Self::svg), on a sheet of another width, with notes.
    pub fn svg_on(&self, sheet: &Sheet<'_>) -> String {
        let (entries, size) = self.lay_out(sheet.width_px);
        write(self, &entries, size, sheet)
    }
}

impl Picture {
    /// The picture as a part of a page with a style of its own: an SVG element of this size in pixels, with groups and
    /// classes as a figure's file has them, and no colours, paper, frame and ids. It lies as [`Fit::in_page`] says.
    pub fn svg_in_page(&self, size: [f64; 2]) -> String {
        let fit = Fit::in_page(&self.bounds, size);
        let mut out = Out { text: String::new(), ids: BTreeSet::new() };
        let _ = writeln!(out.text, "<svg viewBox=\"0 0 {} {}\">", number(size[0]), number(size[1]));
        for item in &self.items {
            let _ = writeln!(out.text, "<g class=\"{}\"><title>{}</title>", item.role.name(), escape(&item.name));
            out.primitives(&resolve(item, &fit));
            out.text.push_str("</g>\n");
        }
        out.text.push_str("</svg>\n");
        out.text
    }
}

/// Writes laid-out entries as a standalone SVG file of this size in pixels.
///
/// Every item is a group with its id, its role as class and its name as title. Colours stand in one stylesheet: in a
/// group of role r, class `f` is filled with the role's colour and `l` stroked with it.
fn write(figure: &Figure, entries: &[FigureEntry], size: [f64; 2], sheet: &Sheet<'_>) -> String {
    let mut out = Out { text: String::new(), ids: BTreeSet::new() };
    let (w, h) = (number(size[0]), number(size[1]));
    let _ = write!(
        out.text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
         aria-labelledby=\"title desc\">\n<title id=\"title\">{}</title>\n<desc id=\"desc\">{}</desc>\n",
        escape(&figure.title),
        escape(&figure.description),
    );
    out.ids.extend(["title".to_owned(), "desc".to_owned()]);
    if !sheet.notes.is_empty() {
        let notes = sheet.notes.iter().map(|(key, text)| format!("{key}: {text}")).collect::<Vec<_>>().join("; ");
        let _ = writeln!(out.text, "<metadata>{}</metadata>", escape(&notes));
    }
    out.stylesheet(sheet.palette);
    let _ = writeln!(out.text, "<rect class=\"paper f\" width=\"{w}\" height=\"{h}\"/>");
    for entry in entries {
        match entry {
            FigureEntry::Bare(primitive) => out.primitive(primitive),
            FigureEntry::Group { id, name, role, primitives } => {
                let id = out.unique(id);
                let _ = writeln!(out.text, "<g id=\"{id}\" class=\"{}\"><title>{}</title>", role.name(), escape(name));
                out.primitives(primitives);
                out.text.push_str("</g>\n");
            }
            FigureEntry::Clip(rect) => {
                let id = out.unique("clip");
                let [x, y] = rect.min.map(number);
                let [w, h] = rect.size.map(number);
                let _ = writeln!(
                    out.text,
                    "<clipPath id=\"{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
                     <g clip-path=\"url(#{id})\">"
                );
            }
            FigureEntry::Unclip => out.text.push_str("</g>\n"),
        }
    }
    out.text.push_str("</svg>\n");
    out.text
}

/// A number with two decimals at most, never `-0`.
fn number(value: f64) -> String {
    let rounded = format!("{value:.2}");
    let trimmed = rounded.trim_end_matches('0').trim_end_matches('.');
    if trimmed == "-0" { "0".to_owned() } else { trimmed.to_owned() }
}

/// Escapes text for XML. Control characters become blanks; U+FFFE and U+FFFF, which XML does not allow, are left out.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

struct Out {
    text: String,
    ids: BTreeSet<String>,
}

impl Out {
    fn stylesheet(&mut self, palette: &super::Palette) {
        self.text.push_str("<style>\n.l{fill:none;stroke-linejoin:round;stroke-linecap:round}\n");
        self.text.push_str(".sans{font-family:\"Noto Sans\",\"DejaVu Sans\",\"Helvetica Neue\",Arial,sans-serif}\n");
        self.text.push_str(".mono{font-family:\"Noto Sans Mono\",\"DejaVu Sans Mono\",Menlo,Consolas,monospace}\n");
        for role in Role::ALL {
            let (name, colour) = (role.name(), palette.colour(role));
            let _ = writeln!(self.text, ".{name}.f{{fill:{colour}}}.{name}.l{{stroke:{colour}}}");
        }
        self.text.push_str("</style>\n");
    }

    /// Makes an id valid and unique: characters other than letters, digits, `.` and `_` become `-`, an id that does not
    /// start with a letter gets an `i` before it, and a repeated id gets a number.
    fn unique(&mut self, id: &str) -> String {
        let allowed = |c: char| if c.is_ascii_alphanumeric() || c == '.' || c == '_' { c } else { '-' };
        let slug: String = id.chars().map(allowed).collect();
        // an XML name starts with a letter
        let slug = if slug.starts_with(|c: char| c.is_ascii_alphabetic()) { slug } else { format!("i{slug}") };
        let mut candidate = slug.clone();
        let mut count = 1;
        while !self.ids.insert(candidate.clone()) {
            count += 1;
            candidate = format!("{slug}-{count}");
        }
        candidate
    }

    /// Writes primitives. Consecutive areas of one kind become one path, so that shared edges leave no seam.
    fn primitives(&mut self, primitives: &[Primitive]) {
        let kind = |p: &Primitive| match p {
            Primitive::Area { role, opacity, .. } => Some((*role, opacity.to_bits())),
            _ => None,
        };
        for run in primitives.chunk_by(|a, b| kind(a).is_some() && kind(a) == kind(b)) {
            if kind(&run[0]).is_some() {
                self.areas(run);
            } else {
                run.iter().for_each(|p| self.primitive(p));
            }
        }
    }

    fn areas(&mut self, run: &[Primitive]) {
        let (mut d, mut class, mut opaque) = (String::new(), "", String::new());
        for primitive in run {
            if let Primitive::Area { corners, role, opacity } = primitive {
                subpath(&mut d, corners);
                d.push('Z');
                (class, opaque) = (role.name(), alpha("fill", *opacity));
            }
        }
        let _ = writeln!(self.text, "<path class=\"{class} f\"{opaque} d=\"{d}\"/>");
    }

    fn primitive(&mut self, primitive: &Primitive) {
        match primitive {
            Primitive::Area { .. } => self.areas(std::slice::from_ref(primitive)),
            Primitive::Dots { centres, radius, role, opacity } => {
                let (name, r) = (role.name(), number(*radius));
                let alpha = alpha("fill", *opacity);
                for c in centres {
                    let (x, y) = (number(c[0]), number(c[1]));
                    let _ = writeln!(self.text, "<circle class=\"{name} f\"{alpha} cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>");
                }
            }
            Primitive::Circle { centre, radius, role, line } => {
                let (x, y, r) = (number(centre[0]), number(centre[1]), number(*radius));
                let (name, line) = (role.name(), stroke(line));
                let _ = writeln!(self.text, "<circle class=\"{name} l\"{line} cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>");
            }
            Primitive::Lines { lines, role, line } => {
                let mut d = String::new();
                for points in lines {
                    match points.split_last() {
                        Some((last, rest)) if rest.len() > 2 && rest.first() == Some(last) => {
                            subpath(&mut d, rest);
                            d.push('Z');
                        }
                        _ => subpath(&mut d, points),
                    }
                }
                let _ = writeln!(self.text, "<path class=\"{} l\"{} d=\"{d}\"/>", role.name(), stroke(line));
            }
            Primitive::Text { at, anchor, text, face, size, role, plate } => {
                self.words(*at, *anchor, text, *face, *size, *role, *plate);
            }
        }
    }

    #[allow(clippy::too_many_arguments)] // the fields of one primitive
    fn words(&mut self, at: ScreenPoint, anchor: Anchor, text: &str, face: Face, size: f64, role: Role, plate: bool) {
        // no font is available to measure words, so the width of a plate is an estimate
        let width = text.chars().count() as f64 * size * if face == Face::Mono { 0.61 } else { 0.55 };
        let (align, left, baseline) = match anchor {
            Anchor::Right => ("start", at[0], at[1] + MIDDLE * size),
            Anchor::Left => ("end", at[0] - width, at[1] + MIDDLE * size),
            Anchor::Centre => ("middle", at[0] - 0.5 * width, at[1] + MIDDLE * size),
            Anchor::Above => ("middle", at[0] - 0.5 * width, at[1]),
            Anchor::Below => ("middle", at[0] - 0.5 * width, at[1] + 0.8 * size),
        };
        if plate {
            let (x, y, w) = (number(left - 3.0), number(baseline - 0.95 * size), number(width + 6.0));
            let h = number(1.3 * size);
            let _ = writeln!(
                self.text,
                "<rect class=\"paper f\" fill-opacity=\"0.85\" x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" rx=\"2\"/>"
            );
        }
        let class = match face {
            Face::Sans => "sans",
            Face::Mono => "mono\" xml:space=\"preserve",
        };
        let (x, y, size) = (number(at[0]), number(baseline), number(size));
        let (role, text) = (role.name(), escape(text));
        let _ = writeln!(
            self.text,
            "<text class=\"{role} f {class}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{align}\">{text}</text>"
        );
    }
}

/// Writes `M x y L x y ..`, without points that round to the one before.
fn subpath(d: &mut String, points: &[ScreenPoint]) {
    let mut before = String::new();
    for (i, p) in points.iter().enumerate() {
        let here = format!("{} {}", number(p[0]), number(p[1]));
        // the last of two points is kept even where it rounds to the first: a dot of a line
        if here != before || (i == 1 && points.len() == 2) {
            let _ = write!(d, "{}{here}", if i == 0 { 'M' } else { 'L' });
        }
        before = here;
    }
}

fn alpha(what: &str, opacity: f64) -> String {
    if opacity >= 1.0 { String::new() } else { format!(" {what}-opacity=\"{}\"", number(opacity)) }
}

fn stroke(line: &Line) -> String {
    let mut out = format!(" stroke-width=\"{}\"{}", number(line.width_px), alpha("stroke", line.opacity));
    if let Some((on, off)) = line.dash.pattern_px() {
        let _ = write!(out, " stroke-dasharray=\"{} {}\" stroke-linecap=\"butt\"", number(on), number(off));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::Point2;
    use crate::picture::{Dash, Drawing, Fill, Item, Palette, Panel, Picture, Rgb};

    fn figure() -> Figure {
        let p = Point2::new;
        let bounds = Aabb { min: p(0.0, 0.0), max: p(10.0, 10.0) };
        let items = [
            Item::new(
                "a/<b>",
                "a \"name\" & more",
                Role::Obstacle,
                Drawing::Polygon(vec![p(1.0, 1.0), p(9.0, 1.0), p(9.0, 9.0)]),
            )
            .filled(Fill::Hatch)
            .stroked(Line::solid(1.5)),
            Item::new("a/(b)", "again", Role::Path, Drawing::segment(p(0.0, 0.0), p(10.0, 10.0)))
                .stroked(Line::solid(2.0).dashed(Dash::Dashed)),
        ];
        let picture = Picture::new("test", bounds).with(items);
        let panel = Panel { picture, heading: "Head\u{7}ing".into(), readout: vec!["T2 { th1: 0.1 }".into()] };
        Figure {
            title: "T < U".into(),
            description: "D".into(),
            panels: vec![panel],
            caption: vec!["seed 2005".into()],
        }
    }

    fn palette() -> Palette {
        let mut i = 0;
        Palette::new(Role::ALL.map(|_| {
            i += 1;
            Rgb([i, 2 * i, 3 * i])
        }))
    }

    /// Reads well-formed markup and returns all ids. Panics if a tag is left open or closed twice.
    fn ids_of_well_formed(xml: &str) -> Vec<String> {
        let (mut open, mut ids) = (Vec::new(), Vec::new());
        for tag in xml.split('<').skip(1) {
            let (inside, after) = tag.split_once('>').expect("every tag ends");
            assert!(!after.contains('>') || after.contains("&gt;"), "stray bracket in {after}");
            if let Some(name) = inside.strip_prefix('/') {
                assert_eq!(open.pop().as_deref(), Some(name));
                continue;
            }
            assert_eq!(inside.matches('"').count() % 2, 0, "quotes are paired in {inside}");
            ids.extend(inside.split_once(" id=\"").map(|(_, v)| v.split('"').next().unwrap().to_owned()));
            if !inside.ends_with('/') {
                open.push(inside.split(' ').next().unwrap().to_owned());
            }
        }
        assert!(open.is_empty(), "left open: {open:?}");
        ids
    }

    #[test]
    fn an_svg_is_well_formed_with_unique_ids_and_no_control_characters() {
        let svg = figure().svg(&palette());
        let ids = ids_of_well_formed(&svg);
        assert_eq!(ids, ["title", "desc", "test-a--b-", "test-a--b--2"]);
        assert!(svg.contains("<title>a &quot;name&quot; &amp; more</title>") && svg.contains("T &lt; U"));
        assert!(!svg.contains('\u{7}') && svg.contains("Head ing"));
    }

    #[test]
    fn a_part_of_a_page_has_roles_and_names_and_neither_colours_nor_ids() {
        let svg = figure().panels[0].picture.svg_in_page([116.0, 116.0]);
        assert!(ids_of_well_formed(&svg).is_empty());
        assert!(svg.starts_with("<svg viewBox=\"0 0 116 116\">") && !svg.contains('#') && !svg.contains("<style"));
        assert!(svg.contains("<g class=\"obstacle\"><title>a &quot;name&quot; &amp; more</title>"));
        // eight pixels are free around ten metres in a hundred pixels, and y is up
        assert!(svg.contains("d=\"M8 108L108 8\""), "{svg}");
    }

    #[test]
    fn the_bytes_depend_on_figure_and_palette_alone() {
        assert_eq!(figure().svg(&palette()), figure().svg(&palette()));
        let mut moved = figure();
        moved.panels[0].picture.items.pop();
        assert_ne!(moved.svg(&palette()), figure().svg(&palette()));
    }

    #[test]
    fn colours_come_from_the_palette_and_y_is_up() {
        let svg = figure().svg(&palette());
        let obstacle = palette().colour(Role::Obstacle);
        assert!(svg.contains(&format!(".obstacle.l{{stroke:{obstacle}}}")));
        assert_eq!(svg.matches('#').count(), 2 * Role::ALL.len(), "no colour outside the stylesheet");
        // the diagonal of the square world runs from the lower left to the upper right
        let d = svg.split("stroke-dasharray").nth(1).and_then(|s| s.split("d=\"").nth(1)).unwrap();
        let points: Vec<f64> =
            d.split('"').next().unwrap().split(['M', 'L', ' ']).filter_map(|n| n.parse().ok()).collect();
        assert!(points[2] > points[0] && points[3] < points[1], "{points:?}");
    }

    #[test]
    fn shared_edges_leave_no_seam_and_what_reaches_out_is_cut_off() {
        let p = Point2::new;
        let bounds = Aabb { min: p(0.0, 0.0), max: p(10.0, 10.0) };
        let square = |x: f64| vec![p(x, 1.0), p(x + 2.0, 1.0), p(x + 2.0, 3.0), p(x, 3.0)];
        let region = |x| Drawing::Region { pieces: vec![square(x), square(x + 2.0)], outline: vec![] };
        let item = |x| Item::new("r", "r", Role::Free, region(x)).filled(Fill::Tint(0.5));
        let inside = Figure::of(Picture::new("t", bounds).with([item(1.0)])).svg(&palette());
        assert_eq!(inside.matches("fill-opacity=\"0.5\"").count(), 1, "two pieces, one path");
        assert!(!inside.contains("clip"));
        let outside = Figure::of(Picture::new("t", bounds).with([item(8.0)])).svg(&palette());
        assert!(outside.contains("<clipPath id=\"clip\">") && outside.contains("url(#clip)"));
        ids_of_well_formed(&outside);
    }

    #[test]
    fn notes_are_metadata_and_a_narrow_sheet_stacks_its_panels() {
        let mut figure = figure();
        figure.panels = vec![figure.panels[0].clone(), figure.panels[0].clone()];
        let notes = [("Seed", "2005".to_owned()), ("By", "<me>".to_owned())];
        let width = |width_px: f64| {
            let svg = figure.svg_on(&Sheet { palette: &palette(), width_px, notes: &notes });
            ids_of_well_formed(&svg);
            assert!(svg.contains("<metadata>Seed: 2005; By: &lt;me&gt;</metadata>"));
            svg.split(" width=\"").nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap()
        };
        assert!(width(420.0) <= 420.0 && width(700.0) > 600.0 && width(700.0) <= 700.0);
        assert!(!figure.svg(&palette()).contains("metadata"));
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        for (value, text) in [(1.0, "1"), (-0.001, "0"), (0.125, "0.12"), (100.0, "100"), (-2.5, "-2.5")] {
            assert_eq!(number(value), text);
        }
    }
}
