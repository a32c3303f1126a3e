//! Paints the robots of a crowd as one mesh, each as small or as fine as it is on the screen.

use std::f64::consts::{PI, TAU};

use bevy_egui::egui::{Color32, Pos2, Rect, Vec2, pos2};

use super::values::{CrowdRobot, CrowdView};
use crate::window::ui::FrameColours;
use crate::window::ui::paint::polygons::Polygons;
use motion_lab_core::geometry::{Footprint, Placed, Point2, Shape};
use motion_lab_core::num::sin_cos;
use motion_lab_core::picture::{Fit, Role, chevron, nose};

/// Size on the screen below which a robot is a square, points.
const SMALL: f64 = 4.0;

/// Size on the screen from which on a robot shows its heading, points.
const SHOWS_HEADING: f64 = 9.0;

/// Least side of such a square, points.
const MIN_SIDE: f32 = 2.0;

/// Radius on the screen below which a link has no round ends, points.
const SQUARE: f32 = 1.0;

/// The opacity of a body, as of a robot that is drawn by itself.
const BODY: f64 = 0.85;

/// The robots that the paper shows, as polygons. `role` says by a robot's id and its state in which colour it is drawn;
/// `None` leaves it out.
pub fn robots(
    crowd: &CrowdView,
    paper: Rect,
    fit: &Fit,
    look: &FrameColours,
    mut role: impl FnMut(u32, &CrowdRobot) -> Option<Role>,
) -> Polygons {
    let mut out = Polygons::default();
    // most are squares; growing by and by copies megabytes in every frame
    out.0.reserve_vertices(4 * crowd.now.len());
    out.0.reserve_triangles(2 * crowd.now.len());
    let mut pen = Pen { fit, corners: Vec::new() };
    let scale = fit.px_per_metre();
    let (mut inks, mark) = (Inks { look, made: Vec::new() }, look.tint(Role::Paper, 0.9));
    for (place, (robot, id)) in crowd.now.iter().zip(crowd.first..).enumerate() {
        let Some(spot) = crowd.spot(place) else { continue };
        let centre = pen.at(spot.centre);
        if !paper.expand((spot.radius * scale) as f32).contains(centre) {
            continue;
        }
        let Some(role) = role(id, robot) else { continue };
        let [solid, body] = inks.of(role);
        let size = spot.size * scale;
        if size < SMALL {
            let middle = crowd.middle(place) * scale;
            let side = if size as f32 > MIN_SIDE { size as f32 } else { MIN_SIDE };
            let centre = centre + Vec2::new(middle.x as f32, -middle.y as f32);
            out.rect(Rect::from_center_size(centre, Vec2::splat(side)), solid);
            continue;
        }
        let Some((footprint, turned)) = crowd.drawn(place) else { continue };
        for part in footprint.parts() {
            pen.outline(part.placed());
            out.polygon(&pen.corners, body);
        }
        if size >= SHOWS_HEADING
            && let Some(corners) = heading(&footprint, turned)
        {
            out.polygon(&corners.map(|p| pen.at(p)), mark);
        }
    }
    out
}

/// The mark that shows a robot's heading: the pointer on a disc, the chevron on a rectangle.
fn heading(footprint: &Footprint, turned: Option<f64>) -> Option<[Point2; 3]> {
    let part = footprint.parts().first()?;
    match (part.shape(), turned) {
        (Shape::Rectangle { min, max }, _) => Some(chevron(part.pose(), *min, *max)),
        (_, Some(heading)) => Some(nose(part.pose().position(), part.placed().radius(), heading)),
        _ => None,
    }
}

/// The colours of roles, each made once: blending in linear light takes powers.
struct Inks<'a> {
    look: &'a FrameColours,
    made: Vec<(Role, [Color32; 2])>,
}

impl Inks<'_> {
    /// The colour of a dot, and that of a body.
    fn of(&mut self, role: Role) -> [Color32; 2] {
        if let Some((_, made)) = self.made.iter().find(|(known, _)| *known == role) {
            return *made;
        }
        let made = [self.look.colour(role), self.look.tint(role, BODY)];
        self.made.push((role, made));
        made
    }
}

/// Puts outlines on the screen.
struct Pen<'a> {
    fit: &'a Fit,
    /// The corners of the last outline.
    corners: Vec<Pos2>,
}

impl Pen<'_> {
    fn at(&self, p: Point2) -> Pos2 {
        let [x, y] = self.fit.screen_from_world(p);
        pos2(x as f32, y as f32)
    }

    /// The outline of a part: of a disc a polygon of as many corners as its size asks for, of a capsule two halves of
    /// one, of any other part its core's corners.
    fn outline(&mut self, part: &Placed) {
        self.corners.clear();
        for p in part.core() {
            let corner = self.at(*p);
            self.corners.push(corner);
        }
        let radius = (part.radius() * self.fit.px_per_metre()) as f32;
        // an arc strays from its circle by less than a tenth of a point
        let steps = (1.2 * radius.sqrt()).ceil().clamp(2.0, 24.0) as usize;
        match self.corners[..] {
            [centre] => {
                self.corners.clear();
                self.arc(centre, Vec2::new(radius, 0.0), TAU, 4 * steps);
            }
            [a, b] => {
                self.corners.clear();
                let along = (b - a).normalized() * if radius > 0.75 { radius } else { 0.75 };
                let right = Vec2::new(along.y, -along.x);
                if radius < SQUARE {
                    self.corners.extend([b + along - right, b + along + right, a - along + right, a - along - right]);
                    return;
                }
                self.arc(b, right, PI, 2 * steps);
                self.corners.push(b - right);
                self.arc(a, -right, PI, 2 * steps);
                self.corners.push(a + right);
            }
            _ => {}
        }
    }

    /// Adds this number of points of an arc about `centre`, from `arm` on; the point at its end is not one of them.
    fn arc(&mut self, centre: Pos2, mut arm: Vec2, angle: f64, points: usize) {
        let (s, c) = sin_cos(angle / points as f64);
        let (s, c) = (s as f32, c as f32);
        for _ in 0..points {
            self.corners.push(centre + arm);
            // each point is the one before, turned on
            arm = Vec2::new(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
        }
    }
}
