//! View boxes and how they are fitted into viewports; the size of a drawing.

use roxmltree::Node;
use svgtypes::{Align, AspectRatio};

use super::check::attribute;
use super::lengths::{Along, LengthScale, number_and_unit, physical};
use crate::planar::Affine;
use motion_lab_core::num::{greater, lesser};

/// A rectangle by its least corner, width and height, both above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ViewRect {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl ViewRect {
    /// The rectangle; `None` if it has no area.
    pub fn try_new(x: f64, y: f64, width: f64, height: f64) -> Option<Self> {
        // written so that NaN is refused
        (width > 0.0 && height > 0.0).then_some(ViewRect { x, y, width, height })
    }
}

/// The view box of an element; `None` if it has none, or a malformed or empty one.
pub(crate) fn view_box(node: Node) -> Option<ViewRect> {
    let text = attribute(node, "viewBox")?;
    let numbers = text.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty());
    let numbers: Vec<f64> =
        numbers.map(|part| part.parse().ok().filter(|x: &f64| x.is_finite())).collect::<Option<_>>()?;
    match numbers[..] {
        [x, y, width, height] => ViewRect::try_new(x, y, width, height),
        _ => None,
    }
}

/// The map from an element's view box into a viewport, as its `preserveAspectRatio` says.
pub(crate) fn fit(node: Node, view: ViewRect, viewport: ViewRect) -> Affine {
    let aspect: AspectRatio = attribute(node, "preserveAspectRatio")
        .and_then(|text| text.parse().ok())
        .unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
    let (sx, sy) = (viewport.width / view.width, viewport.height / view.height);
    if aspect.align == Align::None {
        let moved = Affine::translate(viewport.x - view.x * sx, viewport.y - view.y * sy);
        return moved.after(&Affine::scale(sx, sy));
    }
    let scale = if aspect.slice { greater(sx, sy) } else { lesser(sx, sy) };
    let (along_x, along_y) = alignment(aspect.align);
    let x = viewport.x - view.x * scale + along_x * (viewport.width - view.width * scale);
    let y = viewport.y - view.y * scale + along_y * (viewport.height - view.height * scale);
    Affine::translate(x, y).after(&Affine::scale(scale, scale))
}

/// Which part of the free room lies on the left and above.
fn alignment(align: Align) -> (f64, f64) {
    match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    }
}

/// The size of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SheetSize {
    /// Width and height, pixels; `None` if the drawing says neither, nor has a view box.
    pub pixels: Option<(f64, f64)>,
    /// The map from the drawing's own units to pixels of the sheet.
    pub to_pixels: Affine,
    /// Width and height as written, if one of them is in a physical unit.
    pub physical: Option<String>,
}

/// Reads the size of a drawing from its root element.
pub(crate) fn sheet_size(root: Node, font_size: f64) -> SheetSize {
    let view = view_box(root);
    let scale = LengthScale { viewport: (0.0, 0.0), font_size, root_font_size: font_size };
    let given = |name: &str, along: Along| {
        let text = attribute(root, name)?;
        let is_relative = number_and_unit(text).is_none_or(|(_, unit)| unit == "%");
        scale.length(text, along).filter(|x| *x > 0.0 && !is_relative)
    };
    let pixels = match (given("width", Along::X), given("height", Along::Y), view) {
        (Some(width), Some(height), _) => Some((width, height)),
        (Some(width), None, Some(view)) => Some((width, width * view.height / view.width)),
        (None, Some(height), Some(view)) => Some((height * view.width / view.height, height)),
        (None, None, Some(view)) => Some((view.width, view.height)),
        (_, _, None) => None,
    };
    let viewport = pixels.and_then(|(width, height)| ViewRect::try_new(0.0, 0.0, width, height));
    let to_pixels = match (view, viewport) {
        (Some(view), Some(viewport)) => fit(root, view, viewport),
        _ => Affine::IDENTITY,
    };
    let texts = ["width", "height"].map(|name| attribute(root, name).unwrap_or_default().trim());
    let has_physical = pixels.is_some() && texts.iter().any(|text| physical(text).is_some());
    let written = || texts.into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" x ");
    SheetSize { pixels, to_pixels, physical: has_physical.then(written) }
}
