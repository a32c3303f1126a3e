//! Clip paths that are shapes of style sheets: `inset()`, `circle()`, `polygon()` and the like.

use super::clip_paths::LeftOut;
use super::clips::ClipShape;
use crate::planar::{Affine, CurvedPart};
use crate::svg::lengths::{Along, LengthScale, number_and_unit};
use crate::svg::shapes::{ellipse, path_parts, rectangle};
use crate::svg::transforms::{ReferenceBox, transform_origin};
use crate::svg::walk::{CutElement, SvgWalk, scale_of};
use motion_lab_core::geometry::{Aabb, Point2, Vector2};
use motion_lab_core::num::{greater, hypot, lesser};

/// What a shape lets through: closed lines in the units of the element, and their fill rule.
struct BasicShape {
    parts: Vec<CurvedPart>,
    even_odd: bool,
}

/// What a shape is measured by.
struct ShapeScale {
    scale: LengthScale,
    of: ReferenceBox,
}

impl<'a> SvgWalk<'a, '_> {
    /// Cuts an element at a shape of a style sheet.
    pub(super) fn clip_by_shape(&mut self, element: &CutElement<'a>, text: &str) -> Result<(), LeftOut> {
        let not_understood =
            || format!("its clip path, {}, is not understood", text.chars().take(60).collect::<String>());
        self.spend(text.len())?;
        let (function, of_box) = function_and_box(text).ok_or_else(not_understood)?;
        let is_stroked = self.shapes[element.from..].iter().any(|shape| shape.stroked);
        let scale = scale_of(&element.around);
        let of = match of_box {
            "view-box" => ReferenceBox { least: (0.0, 0.0), size: scale.viewport },
            // strokes have no width here
            "" | "border-box" | "margin-box" | "stroke-box" if is_stroked => {
                return Err("its clip path is measured by the box around its stroke".into());
            }
            _ => {
                let Aabb { min, max } = self.fill_box(element.node, &element.around).ok_or("it has no box to cut")?;
                ReferenceBox { least: (min.x, min.y), size: (max.x - min.x, max.y - min.y) }
            }
        };
        let shape = ShapeScale { scale, of }.read(function).ok_or_else(not_understood)?;
        let rings = self.rings(&shape.parts, &element.around.map, "its clip path")?;
        self.cut_at(vec![ClipShape::new(rings, shape.even_odd, Vec::new())], element.from);
        Ok(())
    }
}

/// A function with its arguments, and the box by which it is measured; either may be missing. `None` if there is more.
fn function_and_box(text: &str) -> Option<(Option<(&str, &str)>, &str)> {
    const BOXES: [&str; 7] =
        ["border-box", "padding-box", "content-box", "margin-box", "fill-box", "stroke-box", "view-box"];
    let (before, function, after) = match text.split_once('(') {
        None => (text, None, ""),
        Some((head, rest)) => {
            let (arguments, after) = rest.rsplit_once(')')?;
            let (before, name) = head.rsplit_once(char::is_whitespace).unwrap_or(("", head));
            (before, Some((name, arguments.trim())), after)
        }
    };
    let of_box = [before, after].map(str::trim);
    let of_box = match of_box {
        [one, ""] | ["", one] => one,
        _ => return None,
    };
    (of_box.is_empty() && function.is_some() || BOXES.contains(&of_box)).then_some((function, of_box))
}

impl ShapeScale {
    /// Reads a shape; without one, the box itself.
    fn read(&self, function: Option<(&str, &str)>) -> Option<BasicShape> {
        let Some((name, arguments)) = function else { return Some(self.rectangle([0.0, 0.0, 0.0, 0.0], 0.0)) };
        match name {
            "inset" => self.inset(arguments),
            "rect" => self.rect(arguments),
            "xywh" => self.xywh(arguments),
            "circle" => self.circle(arguments),
            "ellipse" => self.ellipse(arguments),
            "polygon" => self.polygon(arguments),
            "path" => self.path(arguments),
            _ => None,
        }
    }

    /// A length, or a part of the box's.
    fn length(&self, text: &str, along: Along) -> Option<f64> {
        let (width, height) = self.of.size;
        let whole = match along {
            Along::X => width,
            Along::Y => height,
            Along::Both => hypot(width, height) / std::f64::consts::SQRT_2,
        };
        match number_and_unit(text)? {
            (number, unit) if unit == "%" => Some(number * whole / 100.0),
            // style sheets have no lengths without a unit, but 0
            (number, unit) if unit.is_empty() && number != 0.0 => None,
            _ => self.scale.length(text, along),
        }
    }

    /// The rectangle this far within the box: at the top, right, bottom and left. Its corners have this radius.
    fn rectangle(&self, [top, right, bottom, left]: [f64; 4], radius: f64) -> BasicShape {
        let (width, height) = self.of.size;
        let least = Point2::new(self.of.least.0 + left, self.of.least.1 + top);
        let size = Vector2::new(width - left - right, height - top - bottom);
        let radius = lesser(radius, lesser(size.x, size.y) / 2.0);
        let part = rectangle(least, size, [Some(radius), Some(radius)]);
        BasicShape { parts: part.into_iter().collect(), even_odd: false }
    }

    /// What stands before the radius of a rectangle's corners, and that radius, one for all. In percent it would be
    /// another one along each axis.
    fn rounded<'t>(&self, arguments: &'t str) -> Option<(Vec<&'t str>, f64)> {
        let (sides, radius) = arguments.split_once("round").unwrap_or((arguments, "0"));
        let radius = self.length(radius, Along::X).filter(|length| *length >= 0.0 && !radius.contains('%'))?;
        Some((sides.split_whitespace().collect(), radius))
    }

    fn inset(&self, arguments: &str) -> Option<BasicShape> {
        let (sides, radius) = self.rounded(arguments)?;
        let [top, right, bottom, left] = match sides[..] {
            [all] => [all; 4],
            [y, x] => [y, x, y, x],
            [top, x, bottom] => [top, x, bottom, x],
            [top, right, bottom, left] => [top, right, bottom, left],
            _ => return None,
        };
        let (x, y) = (|text| self.length(text, Along::X), |text| self.length(text, Along::Y));
        Some(self.rectangle([y(top)?, x(right)?, y(bottom)?, x(left)?], radius))
    }

    fn rect(&self, arguments: &str) -> Option<BasicShape> {
        let (sides, radius) = self.rounded(arguments)?;
        let [top, right, bottom, left] = sides[..] else { return None };
        let (width, height) = self.of.size;
        let at = |text: &str, along: Along, auto: f64| {
            if text == "auto" { Some(auto) } else { self.length(text, along) }
        };
        let (top, left) = (at(top, Along::Y, 0.0)?, at(left, Along::X, 0.0)?);
        let (right, bottom) = (greater(at(right, Along::X, width)?, left), greater(at(bottom, Along::Y, height)?, top));
        Some(self.rectangle([top, width - right, height - bottom, left], radius))
    }

    fn xywh(&self, arguments: &str) -> Option<BasicShape> {
        let (sides, radius) = self.rounded(arguments)?;
        let [x, y, w, h] = sides[..] else { return None };
        let (left, top) = (self.length(x, Along::X)?, self.length(y, Along::Y)?);
        let (width, height) = self.of.size;
        let (w, h) = (self.length(w, Along::X)?, self.length(h, Along::Y)?);
        Some(self.rectangle([top, width - left - w, height - top - h, left], radius))
    }

    /// The words before `at`, and the point after it: by itself the middle.
    fn radii_and_centre<'t>(&self, arguments: &'t str) -> Option<(Vec<&'t str>, Point2)> {
        let words: Vec<&str> = arguments.split_whitespace().collect();
        let at = words.iter().position(|word| *word == "at");
        let place = at.map_or(&["center"][..], |at| &words[at + 1..]);
        if place.len() > 2 {
            return None;
        }
        let (x, y) = transform_origin(&place.join(" "), &self.scale, self.of)?;
        Some((words[..at.unwrap_or(words.len())].to_vec(), Point2::new(x, y)))
    }

    /// The distances of a point from the box's sides: left and right, top and bottom.
    fn sides(&self, p: Point2) -> [[f64; 2]; 2] {
        let ((x, y), (width, height)) = (self.of.least, self.of.size);
        [[(p.x - x).abs(), (x + width - p.x).abs()], [(p.y - y).abs(), (y + height - p.y).abs()]]
    }

    fn circle(&self, arguments: &str) -> Option<BasicShape> {
        let (radii, centre) = self.radii_and_centre(arguments)?;
        let sides = self.sides(centre).concat();
        let radius = match radii[..] {
            [] | ["closest-side"] => sides.into_iter().fold(f64::INFINITY, lesser),
            ["farthest-side"] => sides.into_iter().fold(0.0, greater),
            [radius] => self.length(radius, Along::Both)?,
            _ => return None,
        };
        (radius >= 0.0).then(|| self.round(centre, [radius, radius]))
    }

    fn ellipse(&self, arguments: &str) -> Option<BasicShape> {
        let (radii, centre) = self.radii_and_centre(arguments)?;
        let radii = match radii[..] {
            [] => ["closest-side"; 2],
            [x, y] => [x, y],
            _ => return None,
        };
        let [along_x, along_y] = self.sides(centre);
        let radius = |text: &str, [one, other]: [f64; 2], along: Along| match text {
            "closest-side" => Some(lesser(one, other)),
            "farthest-side" => Some(greater(one, other)),
            text => self.length(text, along).filter(|radius| *radius >= 0.0),
        };
        Some(self.round(centre, [radius(radii[0], along_x, Along::X)?, radius(radii[1], along_y, Along::Y)?]))
    }

    fn round(&self, centre: Point2, [rx, ry]: [f64; 2]) -> BasicShape {
        BasicShape { parts: ellipse(centre, rx, ry).into_iter().collect(), even_odd: false }
    }

    fn polygon(&self, arguments: &str) -> Option<BasicShape> {
        let (even_odd, arguments) = fill_rule(arguments);
        let point = |text: &str| {
            let [x, y] = text.split_whitespace().collect::<Vec<_>>()[..] else { return None };
            let (least_x, least_y) = self.of.least;
            Some(Point2::new(least_x + self.length(x, Along::X)?, least_y + self.length(y, Along::Y)?))
        };
        let points: Vec<Point2> = arguments.split(',').map(point).collect::<Option<_>>()?;
        Some(BasicShape { parts: vec![CurvedPart::ring(&points)], even_odd })
    }

    fn path(&self, arguments: &str) -> Option<BasicShape> {
        let (even_odd, arguments) = fill_rule(arguments);
        let quote = arguments.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let text = arguments.strip_prefix(quote)?.strip_suffix(quote)?;
        let (parts, is_cut) = path_parts(text)?;
        let moved = Affine::translate(self.of.least.0, self.of.least.1);
        (!is_cut).then(|| BasicShape { parts: parts.iter().map(|part| part.mapped(&moved)).collect(), even_odd })
    }
}

/// Whether a shape's fill rule is `evenodd`, and what stands behind it.
fn fill_rule(arguments: &str) -> (bool, &str) {
    match arguments.split_once(',') {
        Some((rule, rest)) if matches!(rule.trim(), "evenodd" | "nonzero") => (rule.trim() == "evenodd", rest.trim()),
        _ => (false, arguments),
    }
}
