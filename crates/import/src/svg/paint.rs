//! Whether a paint shows.

use roxmltree::Node;

use super::lengths::ratio;
use super::style::{Inherited, StyleTable};
use super::uses::{Targets, href, url_target};

/// Decides what is painted. Colours that show at all count, however pale.
pub(crate) struct Painter<'a> {
    pub styles: &'a StyleTable,
    pub targets: &'a Targets<'a>,
}

impl Painter<'_> {
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
        match self.targets.get(id) {
            Some(server) if self.paints(*server, 0) => true,
            Some(server) if is_server(server) => false,
            // as in browsers, what is not there paints nothing
            _ => !fallback.is_empty() && is_opaque(fallback, color),
        }
    }

    /// Whether a gradient or a pattern shows anywhere.
    fn paints(&self, server: Node, depth: usize) -> bool {
        const DEEPEST_TEMPLATE: usize = 10;
        if !is_server(&server) {
            return false;
        }
        let stops = server.children().filter(|node| node.tag_name().name() == "stop");
        let shows = |stop: Node| {
            let own = |property: &str| self.styles.own(stop, property);
            own("stop-opacity").and_then(ratio).is_none_or(|opacity| opacity > 0.0)
                && own("stop-color").is_none_or(|color| is_opaque(color, "black"))
        };
        if server.tag_name().name() == "pattern" && server.children().any(|node| node.is_element()) {
            return true;
        }
        if stops.clone().next().is_some() {
            return { stops }.any(shows);
        }
        let template = href(&server).and_then(|href| self.targets.get(href.strip_prefix('#')?));
        depth < DEEPEST_TEMPLATE && template.is_some_and(|template| self.paints(*template, depth + 1))
    }
}

fn is_server(node: &Node) -> bool {
    matches!(node.tag_name().name(), "linearGradient" | "radialGradient" | "pattern")
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
