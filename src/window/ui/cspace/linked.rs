//! The configuration beside the position: a robot of the dashboard as a point of its configuration space.

use std::f64::consts::PI;

use bevy_egui::egui::{
    Align2, CursorIcon, Id, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, WidgetType,
    pos2, vec2,
};

use super::linked_state::LinkedState;
use super::put_at::{put_at, to_come, turn_to};
use super::trail::trail;
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::paint::touch::pinched;
use crate::window::ui::{Cockpit, CockpitRobot, Command, FrameColours};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{Overlay, overlay_items};
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::num::{atan2, sin_cos, wrap};
use motion_lab_core::picture::{Drawing, Fit, Glyph, Item, Line, Picture, Role, true_minus};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::run::{Quantized, RobotInput};
use motion_lab_sim::simulation::{History, RobotCommand, TransportCommand};

/// Largest number of cells judged in a frame: fewer than in a widget of its own, for the run goes on beside it, and an
/// arm of three links has another slice at each tick.
const BUDGET: u32 = 400;

/// Radius of the dial of headings, points.
const DIAL: f32 = 24.0;

/// Width of a room from which on the dial stands beside the picture, points.
const WIDE: f32 = 280.0;

/// Diameter of the area that takes the pointer on the point, points.
const POINT_TARGET: f32 = 28.0;

/// One of the lab's robots in a cockpit at a tick.
pub struct Linked<'a> {
    cockpit: &'a Cockpit,
    robot: &'a CockpitRobot,
    /// Another configuration at its position, if one is shown.
    twin: Option<AnyConfiguration>,
    /// Whether the straight motion there is shown.
    is_way_shown: bool,
    /// Where it was in the last ten seconds, oldest first.
    trail: Vec<AnyConfiguration>,
    /// Whether it is drawn red.
    is_red: bool,
}

impl<'a> Linked<'a> {
    /// The linked view of a robot: its trail, its twin, its contact colour. `None` for a kind without a configuration
    /// space.
    pub fn new(
        cockpit: &'a Cockpit,
        robot: &'a CockpitRobot,
        twin: Option<AnyConfiguration>,
        is_way_shown: bool,
        is_red: bool,
        (history, tick): (&History, u64),
    ) -> Option<Self> {
        AnyRobot::of_kind(&robot.kind, &robot.coordinates)?;
        // in a pause the point is where the robot will be, which is free as far as anybody knows
        let is_red = is_red && !(cockpit.waiting && robot.target.is_some());
        Some(Linked { cockpit, robot, twin, is_way_shown, trail: trail(history, robot, tick), is_red })
    }

    /// The way of its reference point in these seconds: of an arm its tip.
    pub fn way(&self) -> Vec<Item> {
        let Some(model) = self.robot.model else { return Vec::new() };
        let points: Vec<Point2> = self.trail.iter().map(|q| model.reference(q)).collect();
        if points.len() < 2 {
            return Vec::new();
        }
        let line = Line::solid(1.5).at_opacity(0.7);
        let id = format!("trail/{}", self.robot.name);
        vec![Item::new(id, "the last ten seconds", Role::Path, Drawing::Polyline(points)).stroked(line)]
    }

    /// Shows the point in `room`, to be dragged, and behind it the cells that are proven, or the world for a car. Shows
    /// nothing of a robot that is not the lab's.
    pub fn show(
        &self,
        ui: &mut Ui,
        room: Rect,
        look: &FrameColours,
        state: &mut LinkedState,
        commands: &mut Vec<Command>,
    ) -> Option<()> {
        let q = AnyRobot::of_kind(&self.robot.kind, to_come(self.robot))?.1;
        let line = ui.text_style_height(&TextStyle::Small);
        let place = Rect::from_min_max(room.min + vec2(0.0, line + 4.0), room.max);
        // a dial beside the picture covers nothing of it
        let dial = if room.width() >= WIDE && !self.robot.is_arm { 2.0 * DIAL + 16.0 } else { 0.0 };
        let places = [place.with_max_x(place.right() - dial), place];
        let (paper, refused) = match q {
            AnyConfiguration::Hitch(_) => self.among_obstacles(ui, places, look, state, commands),
            _ => self.among_cells(ui, places, q, look, state, commands)?,
        };
        let refused = refused.map(|there| (self.robot.name.clone(), there));
        if state.refused != refused {
            // the world above shows it in the next frame
            state.refused = refused;
            ui.ctx().request_repaint();
        }
        let (words, at_length) = match q {
            AnyConfiguration::Hitch(_) => ("x, y, headings".to_owned(), "Its place, and beside it its headings."),
            AnyConfiguration::Pose(_) => {
                ("x, y".to_owned(), "Its centre as a point: obstacles are grown by its radius.")
            }
            AnyConfiguration::T2(_) => ("a torus".to_owned(), "Its two angles: opposite edges are one."),
            AnyConfiguration::T3(q) => {
                let [first, second, third] = ["\u{3b8}\u{2081}", "\u{3b8}\u{2082}", "\u{3b8}\u{2083}"];
                let slice = format!("torus of {second} and {third} at {first} = {:.2}", q.0[0]);
                (true_minus(&slice), "A plane of its three angles: opposite edges are one.")
            }
        };
        let font = TextStyle::Small.resolve(ui.style());
        let whose = match &self.cockpit.robots[..] {
            [_] => "Its configuration".to_owned(),
            _ => format!("{}'s configuration", self.robot.name),
        };
        let title = format!("{whose}: {words}");
        let ink = ui.painter().text(room.min, Align2::LEFT_TOP, title, font, look.colour(Role::Muted));
        ui.interact(ink, Id::new((&self.robot.name, "its space")), Sense::hover()).on_hover_text(at_length);
        let frame = Stroke::new(1.0, look.colour(Role::Hairline));
        ui.painter().rect_stroke(paper, 0.0, frame, StrokeKind::Inside);
        Some(())
    }

    /// Shows the cells of the robot's slice, and over them its trail, its point, and on wheels its heading.
    /// Returns the paper, and where the robot can't be if it is dragged there.
    fn among_cells(
        &self,
        ui: &mut Ui,
        [place, room]: [Rect; 2],
        q: AnyConfiguration,
        look: &FrameColours,
        state: &mut LinkedState,
        commands: &mut Vec<Command>,
    ) -> Option<(Rect, Option<Footprint>)> {
        let cells = state.cells_of(&self.cockpit.atlas, &self.robot.model?, &q)?;
        if cells.refine(BUDGET) {
            ui.ctx().request_repaint();
        }
        let still = cells.picture();
        let paper = canvas::proportioned(still, place);
        let fit = canvas::fit(still, paper);
        let slice = cells.map().slice();
        let overlay = Overlay {
            now: Some(q),
            in_contact: self.is_red,
            trace: self.trail.clone(),
            line: self.twin.filter(|_| self.is_way_shown).map(|twin| [q, twin]),
            solutions: self.twin.into_iter().collect(),
        };
        let over = Picture::new("configuration", still.bounds).with(overlay_items(slice, &overlay));
        let painter = ui.painter_at(paper);
        canvas::paint_cached(&painter, still, paper, &fit, look);
        canvas::paint(&painter, &over, &fit, look);
        let at = Point2::from(slice.point(&q));
        if self.robot.is_arm {
            self.handle(ui, at, &fit, state, commands);
            return Some((paper, None));
        }
        self.described(ui, paper);
        let refused = self.handle(ui, at, &fit, state, commands);
        Some((paper, self.dial(ui, [paper, room], look, state, commands).or(refused)))
    }

    /// Lets the point be dragged: the robot follows, one on wheels only where it is free. Returns where it can't be.
    fn handle(
        &self,
        ui: &mut Ui,
        at: Point2,
        fit: &Fit,
        linked: &LinkedState,
        commands: &mut Vec<Command>,
    ) -> Option<Footprint> {
        let [x, y] = fit.screen_from_world(at);
        let hit = Rect::from_center_size(pos2(x as f32, y as f32), Vec2::splat(POINT_TARGET));
        let response = ui.interact(hit, Id::new((&self.robot.name, "configuration")), Sense::DRAG);
        let words = format!("{}: its configuration as a point, to be dragged", self.robot.name);
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &words));
        if response.drag_started() {
            commands.push(Command::from(TransportCommand::Checkpoint));
        }
        let pointer = response.interact_pointer_pos().filter(|_| response.dragged() && !pinched(ui));
        response.on_hover_cursor(CursorIcon::Grab).on_hover_text("Drag it: the robot follows");
        if let Some(pointer) = pointer {
            let to = fit.world_from_screen([f64::from(pointer.x), f64::from(pointer.y)]);
            if !self.robot.is_arm {
                return put_at(self.cockpit, self.robot, to, linked, commands);
            }
            let mut angles = to_come(self.robot).clone();
            // the plane is that of the last two angles
            let first = angles.len().saturating_sub(2);
            for (angle, to) in angles.iter_mut().skip(first).zip([to.x, to.y]) {
                *angle = wrap(to);
            }
            let target: Option<Vec<Quantized>> = angles.iter().map(|angle| Quantized::try_new(*angle)).collect();
            let moved = target.map(RobotInput::MoveTo);
            let robot = || self.robot.name.clone();
            commands.extend(moved.map(|input| Command::from(RobotCommand { robot: robot(), input })));
        }
        None
    }

    fn described(&self, ui: &mut Ui, paper: Rect) {
        let response = ui.allocate_rect(paper, Sense::hover());
        let words = format!("Configuration of {}: {}", self.robot.name, self.robot.readout);
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Label, true, &words));
    }

    /// Shows a car's place in its world with its trail, and its headings on a dial. Returns what
    /// [`among_cells`](Self::among_cells) returns.
    fn among_obstacles(
        &self,
        ui: &mut Ui,
        [place, room]: [Rect; 2],
        look: &FrameColours,
        linked: &LinkedState,
        commands: &mut Vec<Command>,
    ) -> (Rect, Option<Footprint>) {
        let world = &self.cockpit.world;
        let paper = canvas::proportioned(world, place);
        let fit = canvas::fit(world, paper);
        let painter = ui.painter_at(paper);
        canvas::paint_cached(&painter, world, paper, &fit, look);
        let mut items = self.way();
        if let [x, y, ..] = to_come(self.robot)[..] {
            let role = if self.is_red { Role::Goal } else { Role::Robot };
            let dot = Drawing::Mark { at: Point2::new(x, y), glyph: Glyph::Handle, radius_px: 5.0 };
            items.push(Item::new("now", self.robot.readout.as_str(), role, dot));
        }
        canvas::paint(&painter, &Picture::new("configuration", world.bounds).with(items), &fit, look);
        self.described(ui, paper);
        let refused = match to_come(self.robot)[..] {
            [x, y, ..] => self.handle(ui, Point2::new(x, y), &fit, linked, commands),
            _ => None,
        };
        (paper, self.dial(ui, [paper, room], look, linked, commands).or(refused))
    }

    /// Shows the heading and a trailer's as needles, and how far the hitch may fold. The robot's own is dragged, and it
    /// turns where it is free. Returns where it can't be.
    fn dial(
        &self,
        ui: &mut Ui,
        [paper, room]: [Rect; 2],
        look: &FrameColours,
        linked: &LinkedState,
        commands: &mut Vec<Command>,
    ) -> Option<Footprint> {
        // beside the picture, or without room there in its corner
        let off = if room.right() - paper.right() >= 2.0 * DIAL + 10.0 { DIAL + 8.0 } else { -DIAL - 10.0 };
        let centre = paper.right_top() + vec2(off, DIAL + 10.0);
        let painter = ui.painter_at(paper.union(room));
        let round = Rect::from_center_size(centre, Vec2::splat(2.0 * DIAL));
        let response = ui.interact(round, Id::new((&self.robot.name, "heading")), Sense::DRAG);
        let words = format!("{}: its heading on a dial, to be dragged", self.robot.name);
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &words));
        if response.drag_started() {
            commands.push(Command::from(TransportCommand::Checkpoint));
        }
        // in the middle there is no direction
        let to = response
            .interact_pointer_pos()
            .filter(|to| response.dragged() && !pinched(ui) && (*to - centre).length() > 0.2 * DIAL);
        let refused = to.and_then(|to| {
            let heading = atan2(f64::from(centre.y - to.y), f64::from(to.x - centre.x));
            turn_to(self.cockpit, self.robot, heading, linked, commands)
        });
        response.on_hover_cursor(CursorIcon::Grab).on_hover_text("Drag it: the robot turns");
        painter.circle(centre, DIAL, look.theme.colour(Role::Paper), Stroke::new(1.0, look.colour(Role::Muted)));
        let at = |angle: f64, radius: f32| {
            let (s, c) = sin_cos(angle);
            centre + radius * vec2(c as f32, -s as f32)
        };
        for quarter in 0..4 {
            let angle = f64::from(quarter) * std::f64::consts::FRAC_PI_2;
            let line = [at(angle, DIAL - 3.0), at(angle, DIAL)];
            painter.line_segment(line, Stroke::new(1.0, look.colour(Role::Muted)));
        }
        let Some(theta) = to_come(self.robot).get(2).copied() else { return refused };
        if let Some(psi) = to_come(self.robot).get(3).copied() {
            if let Some(AnyRobot::Hitch(car)) = self.robot.model
                && let Some(limit) = car.jackknife
            {
                let arc: Vec<Pos2> =
                    (0..=24).map(|k| at(theta + limit * (f64::from(k) / 12.0 - 1.0), DIAL - 1.5)).collect();
                painter.add(Shape::line(arc, Stroke::new(3.0, look.tint(Role::Free, 0.8))));
            }
            painter.line_segment([centre, at(psi, DIAL - 5.0)], Stroke::new(1.5, look.colour(Role::Path)));
            painter.circle_filled(at(psi, DIAL - 5.0), 2.5, look.colour(Role::Path));
        }
        if self.twin.is_some() {
            painter.line_segment([centre, at(theta + PI, DIAL - 4.0)], Stroke::new(2.5, look.tint(Role::Robot, 0.3)));
        }
        painter.line_segment([centre, at(theta, DIAL - 4.0)], Stroke::new(2.5, look.colour(Role::Robot)));
        painter.circle_filled(centre, 2.5, look.colour(Role::Robot));
        refused
    }
}
