//! Paints the robots of a crowd as one mesh, each as small or as fine as it is on the screen.

use std::f64::consts::{PI, TAU};

use bevy_egui::egui::{Color32, Pos2, Rect, Vec2, pos2};

use super::values::{Crowd, CrowdRobot};
use crate::geometry::{Aabb, Part, Placed, Point2, Shape, Vector2};
use crate::num::sin_cos;
use crate::picture::{Fit, Role, chevron, nose};
use crate::ui::Look;
use crate::ui::dashboard::blend::{angle_between, pose_between};
use crate::ui::paint::polygons::Polygons;

/// Size on the screen below which a robot is a square, points.
const SMALL: f64 = 4.0;

/// Size on the screen from which on a robot shows its heading, points.
const SHOWS_HEADING: f64 = 9.0;

/// Least side of such a square, points.
const LEAST: f32 = 2.0;

/// Radius on the screen below which a link has no round ends, points.
const SQUARE: f32 = 1.0;

/// Farthest that a robot moves in a tick, metres. One that moved farther was put there.
const LEAP: f64 = 0.5;

/// The opacity of a body, as of a robot that is drawn by itself.
const BODY: f64 = 0.85;

/// The robots that the paper shows, as polygons. `role` says by a robot's id and its state in which colour it is drawn;
/// `None` leaves it out.
pub fn robots(
    crowd: &Crowd,
    paper: Rect,
    fit: &Fit,
    look: &Look,
    mut role: impl FnMut(u32, &CrowdRobot) -> Option<Role>,
) -> Polygons {
    let mut out = Polygons::default();
    let mut pen = Pen { fit, corners: Vec::new() };
    let (scale, s) = (fit.px_per_metre(), crowd.between);
    let (mut inks, mark) = (Inks { look, made: Vec::new() }, look.tint(Role::Paper, 0.9));
    for (place, (robot, id)) in crowd.now.robots().iter().zip(crowd.first..).enumerate() {
        let before = crowd.before.robots().get(place).filter(|_| s < 1.0);
        let back = before.map_or(Vector2::zeros(), |b| b.bounds.centre() - robot.bounds.centre());
        let back = if back.norm_squared() <= LEAP * LEAP { back * ((1.0 - s) * scale) } else { Vector2::zeros() };
        let shift = Vec2::new(back.x as f32, -back.y as f32);
        let on_screen = pen.rect(&robot.bounds).translate(shift);
        if !on_screen.intersects(paper) {
            continue;
        }
        let Some(role) = role(id, robot) else { continue };
        let [solid, body] = inks.of(role);
        let size = f64::from(on_screen.size().max_elem());
        if size < SMALL {
            let side = if on_screen.size().max_elem() > LEAST { on_screen.size().max_elem() } else { LEAST };
            let square = Rect::from_center_size(on_screen.center(), Vec2::splat(side));
            out.rect(square, solid);
            continue;
        }
        let parts = crowd.now.parts(place);
        let before = before.map(|b| (b, crowd.before.parts(place))).filter(|(_, from)| is_a_step(from, parts));
        for (i, part) in parts.iter().enumerate() {
            let from = before.and_then(|(_, from)| from.get(i)).map(Part::placed);
            pen.outline(part.placed(), from, s);
            out.polygon(&pen.corners, body);
        }
        if size >= SHOWS_HEADING
            && let Some(corners) = heading((robot, parts), before, s)
        {
            out.polygon(&corners.map(|p| pen.at(p)), mark);
        }
    }
    out
}

/// Whether a robot's parts moved from `a` to `b` in a tick: it was not put there, and has the parts that it had.
fn is_a_step(a: &[Part], b: &[Part]) -> bool {
    let is_near = |(a, b): (&Part, &Part)| {
        a.placed().core().len() == b.placed().core().len() && (b.pose().position() - a.pose().position()).norm() <= LEAP
    };
    a.len() == b.len() && a.iter().zip(b).all(is_near)
}

/// A robot and its parts.
type Seen<'a> = (&'a CrowdRobot, &'a [Part]);

/// The mark that shows a robot's heading: the pointer on a disc, the chevron on a rectangle.
fn heading((robot, parts): Seen, before: Option<Seen>, s: f64) -> Option<[Point2; 3]> {
    let (part, from) = (parts.first()?, before.and_then(|(_, parts)| parts.first()));
    let pose = from.map_or(*part.pose(), |from| pose_between(from.pose(), part.pose(), s));
    match (part.shape(), robot.heading) {
        (Shape::Rectangle { min, max }, _) => Some(chevron(&pose, *min, *max)),
        (_, Some(heading)) => {
            let heading = before.and_then(|(b, _)| b.heading).map_or(heading, |from| angle_between(from, heading, s));
            Some(nose(pose.position(), part.placed().radius(), heading))
        }
        _ => None,
    }
}

/// The colours of roles, each made once: blending in linear light takes powers.
struct Inks<'a> {
    look: &'a Look,
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

    fn rect(&self, bounds: &Aabb) -> Rect {
        Rect::from_two_pos(self.at(bounds.min), self.at(bounds.max))
    }

    /// The outline of a part a fraction `s` of the way from where it was: of a disc a polygon of as many corners as its
    /// size asks for, of a capsule two halves of one, of any other part its core's corners.
    fn outline(&mut self, now: &Placed, from: Option<&Placed>, s: f64) {
        self.corners.clear();
        let fit = self.fit;
        let core = now.core().iter().enumerate().map(|(i, p)| match from.and_then(|f| f.core().get(i)) {
            Some(from) => from + (p - from) * s,
            None => *p,
        });
        let screen = core.map(|p| {
            let [x, y] = fit.screen_from_world(p);
            pos2(x as f32, y as f32)
        });
        self.corners.extend(screen);
        let radius = (now.radius() * fit.px_per_metre()) as f32;
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
