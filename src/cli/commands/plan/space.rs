//! `Space`, the configuration space of a task as a panel.

use std::f64::consts::PI;
use std::sync::Arc;

use motion_lab::collision::Checker;
use motion_lab::configuration::{AnyConfiguration, Configuration, Coordinates};
use motion_lab::cspace::{CellMap, Overlay, Slice, cspace_picture, wrapped_pieces};
use motion_lab::geometry::{Aabb, Point2};
use motion_lab::num::wrap;
use motion_lab::picture::{Dash, Drawing, Glyph, Item, Line, Panel, Picture, Role};

use super::attempt::{Attempt, Rejected};
use super::task::Task;

/// The level of the cells in the background.
const FINEST: u32 = 7;

/// The configuration space of a task, or two of its coordinates.
pub struct Space {
    /// The coordinates across and up.
    axes: [usize; 2],
    names: [String; 2],
    is_angle: [bool; 2],
    bounds: Aabb,
    /// What is known of the cells; `None` where a plane is not the whole space.
    map: Option<CellMap>,
}

impl Space {
    /// The space of a task: a rover's positions, an arm's two angles; of larger spaces an arm's last two angles, and a
    /// car's x and heading.
    pub fn of(task: &Task) -> Self {
        let robot = task.planned();
        let start = &task.start;
        let slice = Slice::through(&Checker::new(Arc::clone(&task.scene), robot), start).ok();
        let slice = slice.filter(|slice| slice.held().is_empty());
        let axes = match start {
            AnyConfiguration::T3(_) => [1, 2],
            AnyConfiguration::Hitch(_) => [0, 2],
            _ => [0, 1],
        };
        let is_angle = axes.map(|i| start.is_angle(i));
        let all = start.coordinate_names();
        let names = axes.map(|i| all.get(i).map_or_else(String::new, |name| name.replace("th", "\u{3b8}")));
        let scene = task.scene.bounds();
        let range = |i: usize| match (is_angle[i], i) {
            (true, _) => [-PI, PI],
            (false, 0) => [scene.min.x, scene.max.x],
            (false, _) => [scene.min.y, scene.max.y],
        };
        let [across, up] = [range(0), range(1)];
        let bounds = Aabb { min: Point2::new(across[0], up[0]), max: Point2::new(across[1], up[1]) };
        let map = slice.map(|slice| {
            let mut map = CellMap::new(slice, FINEST);
            map.refine(u32::MAX);
            map
        });
        Space { axes, names, is_angle, bounds, map }
    }

    /// The space with what the planner has grown, its path, and an edge that it has just rejected.
    pub fn panel(&self, attempt: &dyn Attempt, rejected: Option<&Rejected>) -> Panel {
        let lines = |lines: &[Vec<Coordinates>]| -> Drawing {
            Drawing::Region { pieces: Vec::new(), outline: lines.iter().flat_map(|line| self.pieces(line)).collect() }
        };
        let grown = lines(&attempt.lines());
        let mut items =
            vec![Item::new("growth", "what the planner has grown", Role::Muted, grown).stroked(Line::solid(0.8))];
        if let Some(rejected) = rejected {
            let line = lines(std::slice::from_ref(&rejected.line));
            let dashed = Line::solid(1.2).dashed(Dash::Dashed);
            items.push(Item::new("rejected", "a rejected edge", Role::Goal, line).stroked(dashed));
        }
        let path = lines(std::slice::from_ref(&attempt.line()));
        items.push(Item::new("path", "the path", Role::Path, path).stroked(Line::solid(2.0)));
        let ends = attempt.end_coordinates();
        for (id, name, role, q) in
            [("goal", "the goal", Role::Goal, &ends[1]), ("start", "the start", Role::Robot, &ends[0])]
        {
            let mark = Drawing::Mark { at: Point2::from(self.point(q)), glyph: Glyph::Handle, radius_px: 4.5 };
            items.push(Item::new(id, name, role, mark));
        }
        let picture = match attempt.cells().or(self.map.as_ref()) {
            Some(map) => cspace_picture(map, &Overlay::default()),
            None => self.bare(),
        };
        let [across, up] = &self.names;
        let readout = match attempt.cells() {
            Some(map) => {
                let known = map.progress();
                let share = |part: f64| format!("{:.1} %", 100.0 * part);
                format!("proven free {}, proven blocked {}", share(known.free), share(known.blocked))
            }
            None => format!("{} nodes", attempt.growth().0.len()),
        };
        let heading = format!("configuration space, {across} and {up}");
        Panel { heading, readout: vec![readout, String::new()], picture: picture.with(items) }
    }

    fn point(&self, q: &Coordinates) -> [f64; 2] {
        self.axes.map(|i| q.get(i).copied().unwrap_or(0.0))
    }

    /// The pieces of a line, which angles may take over an edge.
    fn pieces(&self, line: &[Coordinates]) -> Vec<Vec<Point2>> {
        let mut pieces: Vec<Vec<Point2>> = Vec::new();
        for pair in line.windows(2) {
            let (a, b) = (self.point(&pair[0]), self.point(&pair[1]));
            let step = [0, 1].map(|i| if self.is_angle[i] { wrap(b[i] - a[i]) } else { b[i] - a[i] });
            if self.is_angle == [true; 2] {
                pieces.extend(wrapped_pieces(a, step).into_iter().map(|piece| piece.map(Point2::from).to_vec()));
            } else {
                // a line over the edge of an angle is cut there, short pieces as they are
                let is_over = (0..2).any(|i| (a[i] + step[i] - b[i]).abs() > PI);
                let to = if is_over { a } else { b };
                pieces.push(vec![Point2::from(a), Point2::from(to)]);
            }
        }
        pieces
    }

    /// The plane without cells.
    fn bare(&self) -> Picture {
        let Aabb { min, max } = self.bounds;
        let p = Point2::new;
        let corners = vec![min, p(max.x, min.y), max, p(min.x, max.y), min];
        let edge = Item::new("frame", "the edges", Role::Muted, Drawing::Polyline(corners)).stroked(Line::solid(1.0));
        Picture { in_metres: false, ..Picture::new("configuration space", self.bounds) }.with([edge])
    }
}
