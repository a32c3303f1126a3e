//! The configuration space of an arm as the torus that it is: its square bent until opposite edges meet.

use bevy_egui::egui::{
    Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Sense, Shape, Stroke, TextStyle, Ui, Vec2, WidgetInfo,
    WidgetType, vec2,
};

use crate::window::ui::{FrameColours, UiState};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellMap, CellState};
use motion_lab_core::num::sin_cos;
use motion_lab_core::picture::Role;

/// Radius of the tube; that of the circle in its middle is 1.
const TUBE: f64 = 0.42;

/// Number of faces along a side of the square.
const SIDE: usize = 96;

/// Number of faces from one line of the hatch to the next: a part of a side's, so that lines meet at the seams.
const HATCH: usize = 6;

/// Cosine from which on a region faces the eye enough to bear its name.
const NAMED: f64 = 0.25;

/// Radians that a drag of one point turns it by.
const PER_POINT: f32 = 0.01;

/// Number of pieces in which a seam is drawn.
const PIECES: u32 = 96;

/// A point of the torus as the eye has it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    /// To the right and up, in radii of the circle in the tube's middle.
    at: [f64; 2],
    near: f64,
    /// Cosine of the angle between the surface's normal and the way to the eye; negative on the far side.
    facing: f64,
}

/// Where a point of the square of angles is seen: `th1` goes round the axis, `th2` round the tube.
fn seen([th1, th2]: [f64; 2], [about, tilt]: [f64; 2]) -> Seen {
    let ((s, c), (tube_up, tube_out), (st, ct)) = (sin_cos(th1 + about), sin_cos(th2), sin_cos(tilt));
    let out = 1.0 + TUBE * tube_out;
    // the axis is up; tilted by a quarter turn it points at the eye
    let bent = |across: f64, back: f64, up: f64| ([across, up * ct + back * st], up * st - back * ct);
    let (at, near) = bent(out * c, out * s, TUBE * tube_up);
    let (_, facing) = bent(tube_out * c, tube_out * s, tube_up);
    Seen { at, near, facing }
}

/// Shows the torus with the cells, the trace, the arms with this tip and the robot's point. A drag turns it.
pub fn torus(ui: &mut Ui, paper: Rect, look: &FrameColours, state: &mut UiState) {
    let Some(cells) = &state.cspace.cells else { return };
    let anatomy = &state.anatomy.anatomy;
    let response = ui.allocate_rect(paper, Sense::drag());
    let spoken = format!("configuration space as a torus. The robot is the point {}", anatomy.q());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &spoken));
    let turned = &mut state.cspace.turned;
    let by = response.drag_delta() * PER_POINT;
    *turned = [turned[0] + f64::from(by.x), (turned[1] + f64::from(by.y)).clamp(0.0, std::f64::consts::FRAC_PI_2)];
    let turned = *turned;
    let scale = f64::from(0.5 * paper.width().min(paper.height()) - 14.0) / (1.0 + TUBE);
    let on_paper = |[x, y]: [f64; 2]| paper.center() + vec2((x * scale) as f32, (-y * scale) as f32);
    let painter = ui.painter_at(paper);
    painter.add(surface(cells.map(), turned, look, &on_paper));
    let point = |q: &AnyConfiguration| seen(cells.map().slice().point(q), turned);
    for region in cells.regions() {
        let there = seen(region.at, turned);
        if there.facing > NAMED {
            name(&painter, &region.name, on_paper(there.at), TextStyle::Small.resolve(ui.style()), look);
        }
    }
    // the two circles at which the square was cut
    let pi = std::f64::consts::PI;
    for seam in [|a: f64| [a, std::f64::consts::PI], |a: f64| [std::f64::consts::PI, a]] {
        let round = (0..=PIECES).map(|i| seen(seam(pi * (2.0 * f64::from(i) / f64::from(PIECES) - 1.0)), turned));
        line(&painter, &round.collect::<Vec<_>>(), Stroke::new(1.0, look.colour(Role::Muted)), &on_paper);
    }
    let trace: Vec<Seen> = state.cspace.trace.iter().map(point).collect();
    line(&painter, &trace, Stroke::new(1.5, look.colour(Role::Path)), &on_paper);
    for other in anatomy.solutions() {
        let there = point(&other);
        let ink = if there.facing >= 0.0 { 1.0 } else { 0.4 };
        painter.circle_stroke(on_paper(there.at), 6.5, Stroke::new(2.5, look.tint(Role::Focus, ink)));
    }
    let (here, role) = (point(&anatomy.q()), if anatomy.intersects() { Role::Goal } else { Role::Robot });
    let ink = if here.facing >= 0.0 { 1.0 } else { 0.5 };
    painter.circle_filled(on_paper(here.at), 5.0, look.tint(role, ink));
    response.on_hover_text("Drag it to turn it");
}

/// The side of the surface that faces the eye, what is farther below what is nearer. The more it faces the eye, the
/// stronger its colour.
fn surface(map: &CellMap, turned: [f64; 2], look: &FrameColours, on_paper: &dyn Fn([f64; 2]) -> Pos2) -> Shape {
    let angle = |k: f64| std::f64::consts::PI * (2.0 * k / SIDE as f64 - 1.0);
    let corners: Vec<Seen> = (0..=SIDE)
        .flat_map(|row| (0..=SIDE).map(move |column| [column, row]))
        .map(|at| seen(at.map(|k| angle(k as f64)), turned))
        .collect();
    let face = |i: usize| {
        let (column, row) = (i % SIDE, i / SIDE);
        let corner = |right: usize, up: usize| corners[(row + up) * (SIDE + 1) + column + right];
        let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let mean = |of: fn(&Seen) -> f64| corners.iter().map(of).sum::<f64>() / 4.0;
        let facing = mean(|c| c.facing);
        let state = map.state([column, row].map(|k| angle(k as f64 + 0.5)));
        let colour = ink(facing, state, (column + row).is_multiple_of(HATCH), look);
        (facing > -0.1).then(|| (mean(|c| c.near), colour, corners.map(|c| on_paper(c.at))))
    };
    let mut faces: Vec<(f64, Color32, [Pos2; 4])> = (0..SIDE * SIDE).filter_map(face).collect();
    faces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut mesh = Mesh::default();
    for (_, colour, corners) in faces {
        let first = mesh.vertices.len() as u32;
        corners.into_iter().for_each(|corner| mesh.colored_vertex(corner, colour));
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    Shape::mesh(mesh)
}

/// The colour of a face; what is blocked is hatched, as on the square.
fn ink(facing: f64, state: CellState, is_hatch: bool, look: &FrameColours) -> Color32 {
    let lit = facing.clamp(0.0, 1.0) as f32;
    let (role, share) = match state {
        CellState::Free => (Role::Free, 0.2 + 0.4 * lit),
        CellState::Blocked if is_hatch => (Role::Obstacle, 0.8 + 0.2 * lit),
        CellState::Blocked => (Role::Obstacle, 0.1 + 0.15 * lit),
        CellState::Unknown => (Role::Unknown, 0.3 + 0.4 * lit),
    };
    look.colour(Role::Paper).lerp_to_gamma(look.colour(role), share)
}

/// Writes the name of a region on a plate.
fn name(painter: &Painter, name: &str, at: Pos2, font: FontId, look: &FrameColours) {
    let galley = painter.layout_no_wrap(name.to_owned(), font, look.colour(Role::Text));
    let rect = Align2::CENTER_CENTER.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(3.0, 1.0)), 0.0, look.tint(Role::Paper, 0.85));
    painter.galley(rect.min, galley, Color32::PLACEHOLDER);
}

/// A line on the torus, in pieces: what is on its far side is left out, and so is a piece from edge to edge.
fn line(painter: &Painter, points: &[Seen], stroke: Stroke, on_paper: &dyn Fn([f64; 2]) -> Pos2) {
    let is_shown = |pair: &&[Seen]| pair.iter().all(|p| p.facing > 0.0);
    for pair in points.windows(2).filter(is_shown) {
        let [from, to] = [pair[0], pair[1]].map(|p| on_paper(p.at));
        if (to - from) != Vec2::ZERO {
            painter.line_segment([from, to], stroke);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use bevy_egui::egui::pos2;

    use super::*;
    use crate::window::ui::CspaceState;

    #[test]
    fn what_is_blocked_is_hatched_three_to_one_and_the_hatch_meets_at_the_seams() {
        use motion_lab_core::picture::Theme;
        assert_eq!(SIDE % HATCH, 0);
        // the relative luminance of WCAG 2
        let luminance = |colour: Color32| {
            let [r, g, b, _] = colour.to_array().map(|byte| {
                let c = f64::from(byte) / 255.0;
                if c <= 0.04045 {
                    c / 12.92
                } else {
                    motion_lab_core::num::exp(2.4 * motion_lab_core::num::ln((c + 0.055) / 1.055))
                }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for look in [Theme::Light, Theme::Dark].map(FrameColours::from) {
            for facing in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let [line, ground] =
                    [true, false].map(|is| luminance(ink(facing, CellState::Blocked, is, &look)) + 0.05);
                let contrast = if line > ground { line / ground } else { ground / line };
                assert!(contrast >= 3.0, "{:?} at {facing}: {contrast:.2}", look.theme);
                assert_eq!(ink(facing, CellState::Free, true, &look), ink(facing, CellState::Free, false, &look));
            }
        }
    }

    fn is_near(seen: Seen, at: [f64; 2], near: f64, facing: f64) -> bool {
        let off = [seen.at[0] - at[0], seen.at[1] - at[1], seen.near - near, seen.facing - facing];
        off.into_iter().all(|d| d.abs() < 1e-12)
    }

    #[test]
    fn opposite_edges_of_the_square_are_one_and_the_eye_sees_it_from_where_it_is_turned_to() {
        for turned in [[0.0, 0.0], CspaceState::default().turned, [2.0, 1.2]] {
            for angle in [-2.0, 0.3, 3.0] {
                let (left, right) = (seen([-PI, angle], turned), seen([PI, angle], turned));
                assert!(is_near(left, right.at, right.near, right.facing), "{turned:?} {angle}");
                let (low, high) = (seen([angle, -PI], turned), seen([angle, PI], turned));
                assert!(is_near(low, high.at, high.near, high.facing), "{turned:?} {angle}");
            }
        }
        // from the side: th1 = 0 is outermost to the right, seen edge-on, and a quarter turn back it is the nearest
        assert!(is_near(seen([0.0, 0.0], [0.0, 0.0]), [1.0 + TUBE, 0.0], 0.0, 0.0));
        assert!(is_near(seen([0.0, 0.0], [-FRAC_PI_2, 0.0]), [0.0, 0.0], 1.0 + TUBE, 1.0));
        assert!(is_near(seen([0.0, PI], [-FRAC_PI_2, 0.0]), [0.0, 0.0], 1.0 - TUBE, -1.0), "the hole's side");
        // from above: the top of the tube faces the eye
        assert!(is_near(seen([0.0, FRAC_PI_2], [0.0, FRAC_PI_2]), [1.0, 0.0], TUBE, 1.0));
        assert!(is_near(seen([FRAC_PI_2, 0.0], [0.0, FRAC_PI_2]), [0.0, 1.0 + TUBE], 0.0, 0.0), "th1 goes left round");
    }

    #[test]
    fn each_cell_that_faces_the_eye_is_a_face_in_its_colour() {
        use motion_lab_core::collision::{Checker, Scene};
        use motion_lab_core::cspace::Slice;
        use motion_lab_core::picture::Theme;
        let (arm, q) = motion_lab_core::robots::AnyRobot::of_kind("reach", &[0.8, 1.5]).unwrap();
        let slice = Slice::through(&Checker::new(Scene::workbench(), arm), &q).unwrap();
        let mut map = CellMap::new(slice.clone(), 8);
        map.refine(u32::MAX);
        let look = FrameColours::from(Theme::Light);
        let Shape::Mesh(mesh) = surface(&map, [0.0, FRAC_PI_2], &look, &|[x, y]| pos2(x as f32, y as f32)) else {
            panic!("a mesh")
        };
        // from above the upper half of the tube is seen, and a little beyond its edge
        let faces = mesh.vertices.len() / 4;
        let half = SIDE * SIDE / 2;
        assert!((half..=half + half / 8).contains(&faces), "{faces}");
        assert_eq!(mesh.indices.len(), 6 * faces);
        let role_of = |colour: Color32| {
            let [r, g, b, _] = colour.to_array().map(i32::from);
            if g > r && g > b { Role::Free } else { Role::Obstacle }
        };
        let free = mesh.vertices.chunks(4).filter(|face| role_of(face[0].color) == Role::Free).count() as f64;
        // what the checker says of the upper half, at points of its own
        let points = (0..50 * 50).map(|i| [(i % 50) as f64 + 0.5, (i / 50) as f64 + 0.5]);
        let upper = points.map(|[u, v]| slice.at([PI * (u / 25.0 - 1.0), PI * v / 50.0]));
        let wanted = upper.filter(|q| slice.checker().is_free(q)).count() as f64 / 2500.0;
        assert!((free / faces as f64 - wanted).abs() < 0.05, "{free} of {faces}, {wanted}");
    }
}
