//! What the atlas shows: its two layers, names, distances, what is said of them, and its figure.

use std::sync::Arc;

use super::state::Mode;
use crate::window::ui::AtlasState;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::{Drawing, Item, Picture, Role, footprint, readout};
use motion_lab_core::robots::Robot;
use motion_lab_sim::atlas::{Atlas, Editor, GridLayer, names};
use motion_lab_sim::capture::{self, AtlasSheet, Captured};
use motion_lab_sim::recording::printed_as;

/// Largest number of robots whose configurations are described in words.
const NAMED_OF_CROWD: usize = 12;

impl AtlasState {
    /// The world with its robots as shown: while it is edited where they start, else where they were put.
    pub fn shown(&self) -> &Atlas {
        if self.mode == Mode::Edit { &self.starts } else { &self.atlas }
    }

    /// The world as shown: with the change that is tried out, if there is one.
    pub(crate) fn seen(&self) -> &Editor {
        self.preview.as_ref().unwrap_or(&self.editor)
    }

    /// The lower layer: the world, in measure mode on its grid.
    pub fn still(&mut self) -> Arc<Picture> {
        if self.mode != Mode::Measure {
            return Arc::clone(&self.still);
        }
        if self.grid.is_none()
            && let Ok(layer) = GridLayer::new(self.world(), self.resolution)
        {
            let picture = layer.picture().with(self.still.items.iter().cloned());
            self.grid = Some((layer, Arc::new(picture)));
        }
        self.grid.as_ref().map_or_else(|| Arc::clone(&self.still), |(_, picture)| Arc::clone(picture))
    }

    /// The upper layer: robots, a refusal or the place wanted, and the selection.
    pub fn over(&self) -> Picture {
        let picture = self.shown().picture();
        let ours = self.still.items.len();
        let mut over = Picture::new(picture.name.clone(), picture.bounds);
        // the atlas draws the world first, which the lower layer shows already
        over.items.extend(picture.items.into_iter().skip(ours));
        let put = self.mode == Mode::Put;
        if let Some((q, refusal)) = self.refused.as_ref().filter(|_| put) {
            // its words stand on a plate, which no edge cuts
            let items = self.atlas.refusal_items(self.robot, q, refusal);
            over.items.extend(items.into_iter().filter(|item| !matches!(item.drawing, Drawing::Label { .. })));
        } else if let Some((q, robot)) = self.wanted.as_ref().filter(|_| put).zip(self.atlas.robots().get(self.robot)) {
            let ghost = footprint("wanted", "where it would be", &robot.robot.footprint(q), Role::Robot, 0.3);
            over.items.extend(ghost);
        }
        if let Some(name) = self.selected.as_ref().filter(|_| self.mode == Mode::Edit) {
            over.items.extend(self.seen().selected_items(name));
        }
        over
    }

    /// The name labels of everything, for a picture of this scale.
    pub fn labels(&mut self, px_per_metre: f64) -> &[Item] {
        let wanted = (px_per_metre, self.mode == Mode::Edit);
        if self.labels.as_ref().is_none_or(|(placed, _)| *placed != wanted) {
            self.labels = Some((wanted, names(self.shown(), px_per_metre)));
        }
        self.labels.as_ref().map_or(&[], |(_, items)| items)
    }

    /// The items that show the distances at a point; none outside measure mode.
    pub fn probe_items(&self, at: Option<Point2>) -> Vec<Item> {
        let layer = self.grid.as_ref().filter(|_| self.mode == Mode::Measure);
        layer.zip(at).map_or_else(Vec::new, |((layer, _), at)| layer.probe_items(at))
    }

    /// The distances at the point that the arrow keys have brought the probe to, in words, and that point.
    pub fn measured(&self) -> Option<String> {
        let at = self.probe.filter(|_| self.mode == Mode::Measure)?;
        let items = self.probe_items(Some(at));
        let words = items.iter().find(|item| item.id == "probe/words").map_or("beyond the grid", |item| &item.name);
        Some(format!("At x {:.2}, y {:.2} m: {words}", at.x, at.y))
    }

    /// The figure of the atlas, for a sheet of this width, pixels. `names` adds the name labels, but not to a refusal.
    pub fn captured(&self, names: bool, width_px: f64) -> Captured {
        let refused = self.refused.as_ref().filter(|_| self.mode == Mode::Put);
        let over = refused.map_or_else(Vec::new, |(q, refusal)| self.atlas.refusal_items(self.robot, q, refusal));
        let robots = self.shown().robots().iter().map(|r| readout(&r.q.to_string()));
        let mut readout: Vec<String> = robots.collect();
        readout.extend(refused.map(|(_, refusal)| refusal.to_string()));
        let grid = self.grid.as_ref().map(|(layer, _)| layer).filter(|_| self.mode == Mode::Measure);
        // a refusal has labels of its own where names would be
        let names = names && refused.is_none();
        capture::atlas(&[AtlasSheet { atlas: self.shown(), grid, over, readout, names }], width_px)
    }

    /// The widget in words, for screen readers.
    pub fn described(&self) -> String {
        let lab = self.shown().robots();
        let others = self.world().robots.iter().filter(|robot| lab.iter().all(|r| r.name != robot.name));
        let others = others.filter_map(|robot| {
            let about = self.atlas.kinds().of(&robot.kind)?;
            Some(format!("{}: {}", robot.name, printed_as(Some(about), &robot.start)))
        });
        let lines = lab.iter().map(|r| format!("{}: {}", r.name, r.q)).chain(others);
        let mut robots: Vec<String> = lines.take(NAMED_OF_CROWD).collect();
        let more = self.world().robots.len() - robots.len();
        if robots.len() == NAMED_OF_CROWD && more > 0 {
            robots.push(format!("and {more} more"));
        }
        let refusal = self.refusal().map_or_else(String::new, |r| format!(" {r}."));
        let measured = self.measured().map_or_else(String::new, |words| format!(" {words}."));
        let selected = self.selected.as_ref().filter(|_| self.mode == Mode::Edit);
        let selected = selected.map_or_else(String::new, |name| format!(" {name} is selected."));
        format!("World {}. {}.{refusal}{measured}{selected}", self.world().name, robots.join("; "))
    }

    /// What was refused on the paper in this mode, in words, and where: a robot that was to be put, or an edit.
    pub fn refused_on_paper(&self) -> Option<(String, Option<Point2>)> {
        match self.mode {
            Mode::Put => {
                let robot = self.atlas.robots().get(self.robot);
                let at = self.refused.as_ref().zip(robot).map(|((q, _), robot)| robot.robot.reference(q));
                Some((self.refusal()?, at))
            }
            Mode::Edit => Some((self.message.clone()?, None)),
            Mode::Measure => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::worlds::{Resident, World};

    #[test]
    fn a_crowd_is_told_by_its_first_robots_and_its_number() {
        let with = |robots: usize| {
            let mut world = World::lot();
            world.robots = (1..=robots).map(|i| Resident::new(format!("Car {i}"), "hitch", [6.5, 2.5, 0.0])).collect();
            AtlasState::of(world).described()
        };
        let words = with(12);
        assert!(words.contains("Car 12: ") && !words.contains("more"), "{words}");
        let words = with(40);
        assert!(
            words.contains("Car 12: ") && !words.contains("Car 13") && words.ends_with("; and 28 more."),
            "{words}"
        );
    }
}
