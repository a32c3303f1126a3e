//! Transforms, as SVG's attribute and as style sheets write them.

use super::lengths::{Along, LengthScale, degrees, ratio};
use crate::planar::Affine;
use motion_lab_core::num;

/// Reads a list of transforms; style sheets' units are taken in attributes too. `None` if it is malformed, or turns the
/// drawing out of its plane.
pub(crate) fn transform_list(text: &str, scale: &LengthScale) -> Option<Affine> {
    let mut all = Affine::IDENTITY;
    let mut rest = text.trim();
    if rest == "none" {
        return Some(all);
    }
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (arguments, after) = after.split_once(')')?;
        let arguments = split_arguments(arguments);
        all = all.after(&one_transform(name.trim(), &arguments, scale)?);
        rest = after.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
    }
    all.0.iter().all(|x| x.is_finite()).then_some(all)
}

/// Splits at commas and blanks, and before a sign that begins a number.
fn split_arguments(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    for part in text.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty()) {
        let mut start = 0;
        for (i, c) in part.char_indices().skip(1) {
            if matches!(c, '-' | '+') && !matches!(part.as_bytes()[i - 1], b'e' | b'E') {
                parts.push(&part[start..i]);
                start = i;
            }
        }
        parts.push(&part[start..]);
    }
    parts
}

fn one_transform(name: &str, arguments: &[&str], scale: &LengthScale) -> Option<Affine> {
    let x = |text: &&str| scale.length(text, Along::X);
    let y = |text: &&str| scale.length(text, Along::Y);
    match (name, arguments) {
        ("matrix", numbers) => matrix(numbers, [0, 1, 2, 3, 4, 5], 6),
        // the part in the plane
        ("matrix3d", numbers) => matrix(numbers, [0, 1, 4, 5, 12, 13], 16),
        ("translate" | "translateX", [tx]) => Some(Affine::translate(x(tx)?, 0.0)),
        ("translate" | "translate3d", [tx, ty, ..]) => Some(Affine::translate(x(tx)?, y(ty)?)),
        ("translateY", [ty]) => Some(Affine::translate(0.0, y(ty)?)),
        ("translateZ", [_]) => Some(Affine::IDENTITY),
        ("scale", [s]) => Some(Affine::scale(ratio(s)?, ratio(s)?)),
        ("scale" | "scale3d", [sx, sy, ..]) => Some(Affine::scale(ratio(sx)?, ratio(sy)?)),
        ("scaleX", [s]) => Some(Affine::scale(ratio(s)?, 1.0)),
        ("scaleY", [s]) => Some(Affine::scale(1.0, ratio(s)?)),
        ("scaleZ", [_]) => Some(Affine::IDENTITY),
        ("rotate" | "rotateZ", [angle]) => Some(Affine::rotate(degrees(angle)?)),
        ("rotate", [angle, cx, cy]) => {
            let (cx, cy) = (x(cx)?, y(cy)?);
            let turn = Affine::rotate(degrees(angle)?).after(&Affine::translate(-cx, -cy));
            Some(Affine::translate(cx, cy).after(&turn))
        }
        ("skewX" | "skew", [angle]) => Some(Affine([1.0, 0.0, slope(angle)?, 1.0, 0.0, 0.0])),
        ("skewY", [angle]) => Some(Affine([1.0, slope(angle)?, 0.0, 1.0, 0.0, 0.0])),
        ("skew", [ax, ay]) => Some(Affine([1.0, slope(ay)?, slope(ax)?, 1.0, 0.0, 0.0])),
        _ => None,
    }
}

fn matrix(numbers: &[&str], used: [usize; 6], count: usize) -> Option<Affine> {
    let numbers: Vec<f64> = numbers.iter().map(|text| ratio(text)).collect::<Option<_>>()?;
    (numbers.len() == count).then(|| Affine(used.map(|i| numbers[i])))
}

fn slope(angle: &str) -> Option<f64> {
    Some(num::tan(degrees(angle)?.to_radians()))
}

/// A box in the units of an element: its least corner, width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ReferenceBox {
    pub least: (f64, f64),
    pub size: (f64, f64),
}

/// Reads the point about which an element is transformed. Percentages and words are of the reference box. `None` if it
/// is malformed.
pub(crate) fn transform_origin(text: &str, scale: &LengthScale, of: ReferenceBox) -> Option<(f64, f64)> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (x, y) = match words[..] {
        [y @ ("top" | "bottom")] => ("center", y),
        [x] => (x, "center"),
        [y @ ("top" | "bottom"), x, ..] | [y, x @ ("left" | "right"), ..] => (x, y),
        [x, y, ..] => (x, y),
        [] => return None,
    };
    let part = |word: &str| match word {
        "left" | "top" => Some(0.0),
        "center" => Some(50.0),
        "right" | "bottom" => Some(100.0),
        percent => percent.strip_suffix('%')?.trim().parse().ok().filter(|x: &f64| x.is_finite()),
    };
    let place = |word: &str, along: Along, least: f64, size: f64| match part(word) {
        Some(percent) => Some(least + size * percent / 100.0),
        None => Some(least + scale.length(word, along)?),
    };
    Some((place(x, Along::X, of.least.0, of.size.0)?, place(y, Along::Y, of.least.1, of.size.1)?))
}
