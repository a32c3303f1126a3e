//! `Polygons`, a mesh of many convex polygons.

use bevy_egui::egui::{Color32, Mesh, Pos2, Rect, Vec2, vec2};

/// A mesh of convex polygons, each of one colour. Their edges fade over one point, half inside and half outside, as
/// those of egui's painter do; a thousand of them are one shape of the frame.
#[derive(Default)]
pub struct Polygons(pub Mesh);

/// Half the width of the fade at an edge, points.
const HALF: f32 = 0.5;

impl Polygons {
    /// Adds a rectangle whose edges do not fade.
    pub fn rect(&mut self, rect: Rect, colour: Color32) {
        self.0.add_colored_rect(rect, colour);
    }

    /// Adds a convex polygon, its corners in either order. Fewer than three corners, or corners on a line, add nothing.
    pub fn polygon(&mut self, corners: &[Pos2], colour: Color32) {
        let n = corners.len();
        let next = |i: usize| if i + 1 == n { 0 } else { i + 1 };
        let cross = |a: Pos2, b: Pos2| a.x * b.y - a.y * b.x;
        let twice_area: f32 = (0..n).map(|i| cross(corners[i], corners[next(i)])).sum();
        if n < 3 || twice_area == 0.0 || !twice_area.is_finite() {
            return;
        }
        let outward = twice_area.signum();
        let normal = |i: usize| {
            let along = (corners[next(i)] - corners[i]).normalized();
            vec2(along.y, -along.x) * outward
        };
        let first = self.0.vertices.len() as u32;
        let mut before = normal(n - 1);
        for (i, corner) in corners.iter().enumerate() {
            let after = normal(i);
            let miter = miter(before, after) * HALF;
            self.0.colored_vertex(*corner - miter, colour);
            self.0.colored_vertex(*corner + miter, Color32::TRANSPARENT);
            before = after;
        }
        let inner = |i: usize| first + 2 * i as u32;
        for i in 0..n {
            let j = next(i);
            self.0.add_triangle(inner(i), inner(i) + 1, inner(j) + 1);
            self.0.add_triangle(inner(i), inner(j) + 1, inner(j));
            if i > 1 {
                self.0.add_triangle(inner(0), inner(i - 1), inner(i));
            }
        }
    }
}

/// The vector from a corner between two edges with these unit normals to the corner of the edges moved out by 1, no
/// longer than 3.
fn miter(before: Vec2, after: Vec2) -> Vec2 {
    let sum = before + after;
    // |sum| = 2 cos(half the turn), and the miter is 1 / cos long
    let length_sq = sum.length_sq();
    if length_sq > 0.45 { sum * (2.0 / length_sq) } else { after }
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::pos2;

    use crate::window::ui::paint::style::ScreenTheme;

    use super::*;
    use motion_lab_core::picture::{Role, Theme};

    fn ink() -> Color32 {
        Theme::Light.colour(Role::Robot)
    }

    /// The area of the triangles, each times the mean opacity of its corners, whatever their order.
    fn weight(mesh: &Mesh) -> f32 {
        let corner = |i: u32| mesh.vertices[i as usize];
        let triangles = mesh.indices.chunks(3).map(|t| {
            let [a, b, c] = [corner(t[0]), corner(t[1]), corner(t[2])];
            let (u, v) = (b.pos - a.pos, c.pos - a.pos);
            let opacity: f32 = [a, b, c].iter().map(|v| f32::from(v.color.a()) / 255.0).sum();
            0.5 * (u.x * v.y - u.y * v.x).abs() * opacity / 3.0
        });
        triangles.sum()
    }

    #[test]
    fn a_polygon_covers_its_area_and_fades_half_a_point_to_each_side() {
        let square = [pos2(1.0, 1.0), pos2(11.0, 1.0), pos2(11.0, 11.0), pos2(1.0, 11.0)];
        let mut back = square;
        back.reverse();
        for corners in [square, back] {
            let mut polygons = Polygons::default();
            polygons.polygon(&corners, ink());
            let bounds = polygons.0.calc_bounds();
            assert_eq!(bounds, Rect::from_min_max(pos2(0.5, 0.5), pos2(11.5, 11.5)));
            // 9 x 9 in full; on each side a triangle over 11 with one full corner of three, and one over 9 with two
            let found = weight(&polygons.0);
            assert!((found - (81.0 + 4.0 * (5.5 / 3.0 + 4.5 * 2.0 / 3.0))).abs() < 1e-3, "{found}");
        }
    }

    #[test]
    fn what_has_no_area_adds_nothing() {
        let mut polygons = Polygons::default();
        polygons.polygon(&[pos2(0.0, 0.0), pos2(1.0, 0.0)], ink());
        polygons.polygon(&[pos2(0.0, 0.0), pos2(1.0, 1.0), pos2(2.0, 2.0)], ink());
        polygons.polygon(&[pos2(f32::NAN, 0.0), pos2(1.0, 0.0), pos2(0.0, 1.0)], ink());
        assert!(polygons.0.vertices.is_empty());
    }
}
