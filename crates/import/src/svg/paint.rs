//! Whether a paint shows, and what of an element's style its children inherit.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use roxmltree::Node;

use super::lengths::{Along, LengthScale, ratio};
use super::style::StyleTable;
use super::uses::{Targets, href, url_target};

/// What a paint leaves, found where it is declared: many elements may inherit it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Paint {
    Nothing,
    Something,
    /// What the element's `color` leaves.
    CurrentColor,
}

impl Paint {
    fn showing(shows: bool) -> Self {
        if shows { Paint::Something } else { Paint::Nothing }
    }

    /// What a colour leaves.
    pub fn of_color(text: &str) -> Self {
        let text = text.trim();
        if text.eq_ignore_ascii_case("currentcolor") { Paint::CurrentColor } else { Paint::showing(is_opaque(text)) }
    }

    /// Whether anything shows. `color` is what the element's `color` leaves.
    pub fn shows(self, color: Paint) -> bool {
        self == Paint::Something || (self == Paint::CurrentColor && color == Paint::Something)
    }
}

/// Whether a gradient or a pattern shows by what it holds itself, or else its template does.
struct PaintServer<'a> {
    /// `None` if it has no stops and no content of its own.
    shows: Option<bool>,
    template: Option<&'a str>,
}

/// Decides what is painted. Colours that show at all count, however pale.
pub(crate) struct Painter<'a> {
    servers: BTreeMap<&'a str, PaintServer<'a>>,
}

/// Largest number of templates of a gradient that are followed.
const MAX_TEMPLATES: usize = 10;

impl<'a> Painter<'a> {
    /// Looks at the gradients and patterns of a drawing.
    pub fn new(targets: &Targets<'a>, styles: &StyleTable) -> Self {
        let is_server = |node: &Node| matches!(node.tag_name().name(), "linearGradient" | "radialGradient" | "pattern");
        let servers = targets.iter().filter(|(_, node)| is_server(node));
        Painter { servers: servers.map(|(id, node)| (*id, PaintServer::new(*node, styles))).collect() }
    }

    /// What a `fill` or a `stroke` paints.
    pub fn paint(&self, text: &str) -> Paint {
        let text = text.trim();
        let Some(id) = url_target(text) else { return Paint::of_color(text) };
        if self.servers.contains_key(id) {
            return Paint::showing(self.server_shows(id));
        }
        // as in browsers, what is not there paints nothing
        let fallback = text.split_once(')').map_or("", |(_, after)| after.trim());
        if fallback.is_empty() { Paint::Nothing } else { Paint::of_color(fallback) }
    }

    fn server_shows(&self, id: &str) -> bool {
        let template = |server: &&PaintServer| server.template.and_then(|id| self.servers.get(id));
        let chain = std::iter::successors(self.servers.get(id), template).take(MAX_TEMPLATES);
        { chain }.find_map(|server| server.shows).unwrap_or(false)
    }
}

impl<'a> PaintServer<'a> {
    fn new(node: Node<'a, 'a>, styles: &StyleTable) -> Self {
        let shows = |stop: Node| {
            let own = |property: &str| styles.own(stop, property);
            own("stop-opacity").and_then(ratio).is_none_or(|opacity| opacity > 0.0)
                && own("stop-color").is_none_or(|color| Paint::of_color(color).shows(Paint::Something))
        };
        let is_pattern = node.tag_name().name() == "pattern";
        let is_content = |child: Node| child.is_element() && (is_pattern || child.tag_name().name() == "stop");
        let is_empty = !node.children().any(is_content);
        let mut stops = node.children().filter(|child| child.tag_name().name() == "stop");
        let own = if is_pattern { !is_empty } else { stops.any(shows) };
        PaintServer { shows: (!is_empty).then_some(own), template: href(&node).and_then(|href| href.strip_prefix('#')) }
    }
}

/// Whether a colour is more than nothing. A colour that is not understood counts.
fn is_opaque(paint: &str) -> bool {
    let paint = paint.to_ascii_lowercase();
    if matches!(paint.as_str(), "none" | "transparent" | "context-fill" | "context-stroke") {
        return false;
    }
    if let Some(digits) = paint.strip_prefix('#') {
        let alpha = match digits.len() {
            4 => &digits.as_bytes()[3..],
            8 => &digits.as_bytes()[6..],
            _ => return true,
        };
        return alpha.iter().any(|b| *b != b'0');
    }
    alpha_of(&paint).is_none_or(|alpha| alpha > 0.0)
}

/// The alpha of a colour written as a function: after a slash, or its fourth argument.
fn alpha_of(paint: &str) -> Option<f64> {
    let (_, arguments) = paint.strip_suffix(')')?.split_once('(')?;
    let alpha = match arguments.split_once('/') {
        Some((_, alpha)) => alpha,
        None => arguments.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty()).nth(3)?,
    };
    match alpha.trim() {
        "none" => Some(0.0),
        alpha => ratio(alpha),
    }
}

/// What an element inherits from those around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inherited {
    fill: Paint,
    stroke: Paint,
    color: Paint,
    fill_opacity: f64,
    stroke_opacity: f64,
    /// The units of the element.
    stroke_width: f64,
    pub hidden: bool,
    pub even_odd: bool,
    pub font_size: f64,
}

/// Pixels, when nothing says otherwise.
pub(crate) const FONT_SIZE: f64 = 16.0;

impl Default for Inherited {
    fn default() -> Self {
        Inherited {
            fill: Paint::Something,
            stroke: Paint::Nothing,
            color: Paint::Something,
            fill_opacity: 1.0,
            stroke_opacity: 1.0,
            stroke_width: 1.0,
            hidden: false,
            even_odd: false,
            font_size: FONT_SIZE,
        }
    }
}

impl Inherited {
    /// What holds for an element, and is handed on to its children.
    pub fn at(&self, node: Node, styles: &StyleTable, painter: &Painter, scale: &LengthScale) -> Self {
        let own = |property: &str| styles.own(node, property);
        let mut new = *self;
        if let Some(size) = own("font-size") {
            new.font_size = font_size(size, self.font_size, scale).unwrap_or(self.font_size);
        }
        let scale = LengthScale { font_size: new.font_size, ..*scale };
        let usual = Inherited::default();
        new.fill =
            own("fill").map_or(self.fill, |text| if text == "initial" { usual.fill } else { painter.paint(text) });
        new.stroke = own("stroke")
            .map_or(self.stroke, |text| if text == "initial" { usual.stroke } else { painter.paint(text) });
        // a colour of the words `currentColor` is the parent's
        let color = own("color").map(Paint::of_color).filter(|color| *color != Paint::CurrentColor);
        new.color = color.unwrap_or(self.color);
        new.fill_opacity = own("fill-opacity").and_then(ratio).unwrap_or(self.fill_opacity);
        new.stroke_opacity = own("stroke-opacity").and_then(ratio).unwrap_or(self.stroke_opacity);
        let width = own("stroke-width").and_then(|text| scale.length(text, Along::Both));
        new.stroke_width = width.unwrap_or(self.stroke_width);
        new.hidden = styles.is_hidden(node, self.hidden);
        new.even_odd = styles.is_even_odd(node, "fill-rule", self.even_odd);
        new
    }

    /// Whether a shape's inside is painted.
    pub fn fills(&self) -> bool {
        self.fill_opacity > 0.0 && self.fill.shows(self.color)
    }

    /// Whether a shape's line is painted.
    pub fn strokes(&self) -> bool {
        self.stroke_opacity > 0.0 && self.stroke_width > 0.0 && self.stroke.shows(self.color)
    }
}

/// A font's size, the parent's being known.
fn font_size(text: &str, parent: f64, scale: &LengthScale) -> Option<f64> {
    const WORDS: [(&str, f64); 7] = [
        ("xx-small", 9.0),
        ("x-small", 10.0),
        ("small", 13.0),
        ("medium", 16.0),
        ("large", 18.0),
        ("x-large", 24.0),
        ("xx-large", 32.0),
    ];
    let word = WORDS.iter().find(|(word, _)| *word == text).map(|(_, size)| *size);
    let relative = LengthScale { viewport: (parent, parent), font_size: parent, ..*scale };
    let size = match text {
        "larger" => Some(parent * 1.2),
        "smaller" => Some(parent / 1.2),
        _ => word.or_else(|| relative.length(text, Along::X)),
    };
    size.filter(|size| size.partial_cmp(&0.0) != Some(Ordering::Less))
}
