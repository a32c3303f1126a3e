//! Whether a paint shows.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::lengths::ratio;
use super::style::{Inherited, StyleTable};
use super::uses::{Targets, href, url_target};

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

    /// Whether a shape's inside is painted.
    pub fn fills(&self, style: &Inherited) -> bool {
        style.fill_opacity > 0.0 && self.shows(style.fill, style.color)
    }

    /// Whether a shape's line is painted.
    pub fn strokes(&self, style: &Inherited) -> bool {
        style.stroke_opacity > 0.0 && style.stroke_width > 0.0 && self.shows(style.stroke, style.color)
    }

    fn shows(&self, paint: &str, color: &str) -> bool {
        let paint = paint.trim();
        let Some(id) = url_target(paint) else { return is_opaque(paint, color) };
        let fallback = paint.split_once(')').map_or("", |(_, after)| after.trim());
        if self.servers.contains_key(id) {
            return self.server_shows(id);
        }
        // as in browsers, what is not there paints nothing
        !fallback.is_empty() && is_opaque(fallback, color)
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
                && own("stop-color").is_none_or(|color| is_opaque(color, "black"))
        };
        let is_pattern = node.tag_name().name() == "pattern";
        let is_content = |child: Node| child.is_element() && (is_pattern || child.tag_name().name() == "stop");
        let is_empty = !node.children().any(is_content);
        let mut stops = node.children().filter(|child| child.tag_name().name() == "stop");
        let own = if is_pattern { !is_empty } else { stops.any(shows) };
        PaintServer { shows: (!is_empty).then_some(own), template: href(&node).and_then(|href| href.strip_prefix('#')) }
    }
}

/// Whether a colour is more than nothing. `color` is what `currentColor` stands for. A colour that is not understood
/// counts.
fn is_opaque(paint: &str, color: &str) -> bool {
    let paint = paint.trim().to_ascii_lowercase();
    match paint.as_str() {
        "none" | "transparent" | "context-fill" | "context-stroke" => return false,
        "currentcolor" => return color != "currentColor" && is_opaque(color, "black"),
        _ => {}
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
