//! The theme: roles to colours on light and on dark paper. A colour is named here and nowhere else.

use super::{Palette, Rgb};

/// Light or dark paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// Dark strokes on light paper.
    #[default]
    Light,
    /// Light strokes on dark paper.
    Dark,
}

/// An sRGB colour from its six hexadecimal digits.
const fn rgb(hex: u32) -> Rgb {
    Rgb([(hex >> 16) as u8, (hex >> 8) as u8, hex as u8])
}

// in the order of `Role::ALL`: paper, robot, obstacle, goal, path, sensor, witness, free, unknown, focus, text, muted,
// hairline
const LIGHT: Palette = Palette::new([
    rgb(0xfbfaf7),
    rgb(0x0b4caf),
    rgb(0x544b3e),
    rgb(0xbe2a12),
    rgb(0x7a6dd3),
    rgb(0x0a999e),
    rgb(0xd84b8c),
    rgb(0x4f7e53),
    rgb(0x474c57),
    rgb(0xae8506),
    rgb(0x23262b),
    rgb(0x62666d),
    rgb(0xd5d2ca),
]);

const DARK: Palette = Palette::new([
    rgb(0x15181c),
    rgb(0x2fa3f5),
    rgb(0xa8977e),
    rgb(0xf2492b),
    rgb(0xdcc2fa),
    rgb(0x1a83a6),
    rgb(0xa5606e),
    rgb(0x6be3ae),
    rgb(0x959da6),
    rgb(0xedc02b),
    rgb(0xe6e4df),
    rgb(0x9a9fa6),
    rgb(0x343a42),
]);

impl Theme {
    /// The colour of every role.
    pub const fn palette(self) -> &'static Palette {
        match self {
            Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::num::{atan2, cos, exp, hypot, ln, sin, sqrt};
    use crate::picture::Role;
    use crate::picture::resolve::{HATCH_OPACITY, TINT};

    /// Roles that carry meaning in a drawing.
    const GRAPHICS: [Role; 9] = [
        Role::Robot,
        Role::Obstacle,
        Role::Goal,
        Role::Path,
        Role::Sensor,
        Role::Witness,
        Role::Free,
        Role::Unknown,
        Role::Focus,
    ];

    /// Any two of them are at least this far apart (CIEDE2000), for any kind of sight.
    const MIN_DIFFERENCE: f64 = 12.0;

    fn linear(Rgb(channels): Rgb) -> [f64; 3] {
        channels.map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { exp(2.4 * ln((c + 0.055) / 1.055)) }
        })
    }

    fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// Contrast ratio of WCAG 2.
    fn contrast(a: Rgb, b: Rgb) -> f64 {
        let luminance = |c| {
            let [r, g, b] = linear(c);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        if a > b { a / b } else { b / a }
    }

    /// Machado, Oliveira and Fernandes (2009), severity 1: protanopia, deuteranopia, tritanopia; before them, no
    /// deficiency.
    const SIGHTS: [(&str, [[f64; 3]; 3]); 4] = [
        ("full", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ("protan", [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
        ("deutan", [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
        ("tritan", [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
    ];

    /// CIE L*a*b* under D65 of a linear colour, cut to the gamut.
    fn lab(linear: [f64; 3]) -> [f64; 3] {
        let m =
            [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];
        let [x, y, z] = times(&m, linear.map(|c| c.clamp(0.0, 1.0)));
        let f = |t: f64| if t > 216.0 / 24389.0 { exp(ln(t) / 3.0) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 };
        let (fx, fy, fz) = (f(x / 0.95047), f(y), f(z / 1.08883));
        [116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)]
    }

    /// CIEDE2000 with unit weights, after Sharma, Wu and Dalal (2005). Angles in radians.
    fn ciede2000([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
        let deg = PI / 180.0;
        let seventh = |c: f64| {
            let c7 = c * c * c * c * c * c * c;
            sqrt(c7 / (c7 + 6_103_515_625.0)) // 25^7
        };
        let g = 0.5 * (1.0 - seventh(0.5 * (hypot(a1, b1) + hypot(a2, b2))));
        let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
        let (c1, c2) = (hypot(a1, b1), hypot(a2, b2));
        let hue = |a, b| if a == 0.0 && b == 0.0 { 0.0 } else { (atan2(b, a) + TAU) % TAU };
        let (h1, h2) = (hue(a1, b1), hue(a2, b2));
        let grey = c1 * c2 == 0.0;
        let dh = match h2 - h1 {
            _ if grey => 0.0,
            d if d > PI => d - TAU,
            d if d < -PI => d + TAU,
            d => d,
        };
        let (dl, dc, dhh) = (l2 - l1, c2 - c1, 2.0 * sqrt(c1 * c2) * sin(0.5 * dh));
        let (lm, cm) = (0.5 * (l1 + l2), 0.5 * (c1 + c2));
        let hm = match h1 + h2 {
            s if grey => s,
            s if (h1 - h2).abs() <= PI => 0.5 * s,
            s if s < TAU => 0.5 * (s + TAU),
            s => 0.5 * (s - TAU),
        };
        let t = 1.0 - 0.17 * cos(hm - 30.0 * deg) + 0.24 * cos(2.0 * hm) + 0.32 * cos(3.0 * hm + 6.0 * deg)
            - 0.20 * cos(4.0 * hm - 63.0 * deg);
        let bell = (hm / deg - 275.0) / 25.0;
        let rotation = -2.0 * seventh(cm) * sin(60.0 * deg * exp(-bell * bell));
        let l50 = (lm - 50.0) * (lm - 50.0);
        let (sl, sc, sh) = (1.0 + 0.015 * l50 / sqrt(20.0 + l50), 1.0 + 0.045 * cm, 1.0 + 0.015 * cm * t);
        let (x, y, z) = (dl / sl, dc / sc, dhh / sh);
        sqrt(x * x + y * y + z * z + rotation * y * z)
    }

    #[test]
    fn the_difference_formula_gives_its_authors_test_values() {
        // rows 1, 7, 17, 19 and 25 of table 1 of Sharma, Wu and Dalal (2005)
        let rows = [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [56.0, -27.0, -3.0], 31.9030),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
        ];
        for (a, b, expected) in rows {
            assert!((ciede2000(a, b) - expected).abs() < 1e-4, "{a:?} {b:?} {}", ciede2000(a, b));
        }
    }

    #[test]
    fn graphics_and_words_stand_out_from_the_paper() {
        for theme in [Theme::Light, Theme::Dark] {
            let palette = theme.palette();
            let on_paper = |role| contrast(palette.colour(role), palette.colour(Role::Paper));
            for role in GRAPHICS {
                assert!(on_paper(role) >= 3.0, "{theme:?} {role:?} {}", on_paper(role));
            }
            for role in [Role::Text, Role::Muted] {
                assert!(on_paper(role) >= 4.5, "{theme:?} {role:?} {}", on_paper(role));
            }
        }
    }

    #[test]
    fn a_hatch_stands_out_from_its_ground() {
        for theme in [Theme::Light, Theme::Dark] {
            let palette = theme.palette();
            let Rgb(ink) = palette.colour(Role::Obstacle);
            let over = |Rgb(under): Rgb, opacity: f64| {
                let (under, ink) = (under.map(f64::from), ink.map(f64::from));
                Rgb([0, 1, 2].map(|i| (under[i] + opacity * (ink[i] - under[i])).round() as u8))
            };
            let ground = over(palette.colour(Role::Paper), TINT);
            let found = contrast(over(ground, HATCH_OPACITY), ground);
            // what WCAG 2 asks of graphics that carry meaning
            assert!(found >= 3.0, "{theme:?} {found:.2}");
        }
    }

    #[test]
    fn any_two_roles_stay_apart_for_every_kind_of_sight() {
        for theme in [Theme::Light, Theme::Dark] {
            for (sight, matrix) in &SIGHTS {
                let seen = |role| lab(times(matrix, linear(theme.palette().colour(role))));
                for (i, &a) in GRAPHICS.iter().enumerate() {
                    for &b in &GRAPHICS[..i] {
                        let difference = ciede2000(seen(a), seen(b));
                        assert!(difference >= MIN_DIFFERENCE, "{theme:?} {sight} {a:?} {b:?} {difference:.1}");
                    }
                }
            }
        }
    }
}
