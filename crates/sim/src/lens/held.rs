//! `Lens`, a lens that stands still, in a reader's hand.

use std::f64::consts::PI;
use std::mem::take;

use super::cells::SpaceCells;
use super::done::{done_between, have_one_tip};
use crate::anatomy::{Anatomy, twin_items};
use crate::manifest::{HintTask, Widget};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::cspace::overlay_items;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::picture::{Fit, Picture};

/// Level of the finest cells: a 128th of the sides.
const FINEST: u32 = 7;

/// Radius of the robot's point with its ring, pixels.
const POINT: f64 = 6.0;

/// Largest number of configurations in a trace.
const TRACE: usize = 2000;

/// Adds a configuration to a trace, unless it is the last of it; the oldest go where it would have more than 2,000.
pub fn remember_in(trace: &mut Vec<AnyConfiguration>, q: AnyConfiguration) {
    if trace.last() != Some(&q) {
        trace.push(q);
        let spare = trace.len().saturating_sub(TRACE);
        trace.drain(..spare);
    }
}

/// A picture of a lens that a hand can reach into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LensPaper {
    /// The world with the robot.
    World,
    /// The configuration space with the robot's point.
    Space,
}

/// A lens that stands still, in a reader's hand: the query anatomy, or the configuration space beside the workspace.
#[derive(Clone, Debug)]
pub struct Lens {
    widget: Widget,
    anatomy: Anatomy,
    cells: Option<SpaceCells>,
    trace: Vec<AnyConfiguration>,
    /// The scene as the hand took it.
    taken: Option<Anatomy>,
    done: Vec<HintTask>,
}

impl Lens {
    /// A lens on this scene; `None` for a widget that does not stand still.
    pub fn new(widget: Widget, anatomy: Anatomy) -> Option<Self> {
        let cells = match widget {
            Widget::Anatomy => None,
            Widget::Cspace => Some(SpaceCells::through(anatomy.checker(), &anatomy.q(), FINEST)?),
            Widget::Dashboard | Widget::Atlas | Widget::Plan => return None,
        };
        Some(Lens { widget, anatomy, cells, trace: Vec::new(), taken: None, done: Vec::new() })
    }

    /// The widget.
    pub fn widget(&self) -> Widget {
        self.widget
    }

    /// The scene.
    pub fn anatomy(&self) -> &Anatomy {
        &self.anatomy
    }

    /// The cells of the configuration space; `None` for the anatomy.
    pub fn cells(&self) -> Option<&SpaceCells> {
        self.cells.as_ref()
    }

    /// The configurations that it has been at, oldest first.
    pub fn trace(&self) -> &[AnyConfiguration] {
        &self.trace
    }

    /// Judges `budget` more cells of the configuration space, anew for another robot, and names the regions once all
    /// are known. Returns whether any remain.
    pub fn refine(&mut self, budget: u32) -> bool {
        let Some(cells) = &mut self.cells else { return false };
        let slice = cells.map().slice();
        if slice.checker().robot() != self.anatomy.checker().robot() || !slice.holds(&self.anatomy.q()) {
            let Some(other) = SpaceCells::through(self.anatomy.checker(), &self.anatomy.q(), FINEST) else {
                return false;
            };
            *cells = other;
            self.trace.clear();
        }
        let more = cells.refine(budget);
        cells.name();
        more
    }

    /// Sets what is so, by no hand: nothing is done by it, and a hand that holds something lets go of it.
    pub fn set(&mut self, set: impl FnOnce(&mut Anatomy)) {
        self.taken = None;
        set(&mut self.anatomy);
        if self.widget == Widget::Cspace {
            remember_in(&mut self.trace, self.anatomy.q());
        }
    }

    /// Changes the scene by hand. What comes of it is [done](Self::take_done) once the hand [lets go](Self::let_go).
    pub fn change(&mut self, change: impl FnOnce(&mut Anatomy)) {
        _ = self.taken.get_or_insert_with(|| self.anatomy.clone());
        change(&mut self.anatomy);
        self.see();
    }

    /// Moves a coordinate by hand, by so much.
    pub fn nudge(&mut self, index: usize, by: f64) {
        let to = self.anatomy.q().coordinates().get(index).map(|now| now + by);
        let Some(to) = to else { return };
        self.change(|anatomy| anatomy.set_coordinate(index, to));
        if self.widget == Widget::Cspace {
            let is_over_edge = (self.anatomy.q().coordinates()[index] - to).abs() > PI;
            self.moved(is_over_edge);
        }
    }

    /// The configuration space's point was moved.
    fn moved(&mut self, is_over_edge: bool) {
        self.done.push(HintTask::MovePoint);
        self.done.extend(is_over_edge.then_some(HintTask::OverEdge));
    }

    /// Whether a press at a point of a paper of this size, pixels, takes hold: among the figures at the axes of the
    /// configuration space it means no point.
    pub fn takes(&self, paper: LensPaper, size: [f64; 2], at: [f64; 2]) -> bool {
        match (paper, &self.cells, self.bounds(paper)) {
            (LensPaper::World, ..) => true,
            (LensPaper::Space, Some(cells), Some(bounds)) => {
                let fit = Fit::in_page(&bounds, size);
                cells.is_on_chart(fit.world_from_screen(at), POINT / fit.px_per_metre())
            }
            (LensPaper::Space, ..) => false,
        }
    }

    /// Drags what is held on a paper to a point of it, metres or the units of its axes: the robot by the point that
    /// stands for it, or its configuration.
    pub fn drag(&mut self, paper: LensPaper, to: Point2) {
        match (paper, &self.cells) {
            (LensPaper::World, _) => self.change(|anatomy| anatomy.drag(to)),
            (LensPaper::Space, None) => {}
            (LensPaper::Space, Some(cells)) => {
                let (q, is_over_edge) = cells.configuration_at(to);
                // a point of the slice is a configuration of the robot
                self.change(|anatomy| _ = anatomy.set_q(q));
                self.moved(is_over_edge);
            }
        }
    }

    fn see(&mut self) {
        if self.widget == Widget::Cspace {
            remember_in(&mut self.trace, self.anatomy.q());
            self.done.extend(have_one_tip(&self.anatomy, &self.trace).then_some(HintTask::TwoPoints));
        }
    }

    /// The hand lets go.
    pub fn let_go(&mut self) {
        let Some(before) = self.taken.take() else { return };
        if self.widget == Widget::Anatomy {
            self.done.extend(done_between(&before, &self.anatomy));
        }
    }

    /// What was done since this was asked last.
    pub fn take_done(&mut self) -> Vec<HintTask> {
        take(&mut self.done)
    }

    /// The piece of the plane that a paper shows; `None` for a paper that the lens has not.
    pub fn bounds(&self, paper: LensPaper) -> Option<Aabb> {
        match paper {
            LensPaper::World => Some(self.anatomy.world().bounds),
            LensPaper::Space => self.cells.as_ref().map(|cells| cells.picture().bounds),
        }
    }

    /// The point of a paper of this size, pixels, at a point of the screen in it.
    pub fn point(&self, paper: LensPaper, size: [f64; 2], at: [f64; 2]) -> Option<Point2> {
        Some(Fit::in_page(&self.bounds(paper)?, size).world_from_screen(at))
    }

    /// Where the hand takes hold on a paper of this size, pixels: the point that stands for the robot, or its
    /// configuration's.
    pub fn handle(&self, paper: LensPaper, size: [f64; 2]) -> Option<[f64; 2]> {
        let q = self.anatomy.q();
        let at = match paper {
            LensPaper::World => self.anatomy.checker().robot().reference(&q),
            LensPaper::Space => Point2::from(self.cells.as_ref()?.map().slice().point(&q)),
        };
        Some(Fit::in_page(&self.bounds(paper)?, size).screen_from_world(at))
    }

    /// What a paper shows below all that moves, as a part of a page; see
    /// [`svg_in_page`](motion_lab_core::picture::Picture::svg_in_page).
    pub fn still(&self, paper: LensPaper, size: [f64; 2]) -> String {
        match (paper, &self.cells) {
            (LensPaper::World, _) => self.anatomy.backdrop().svg_in_page(size),
            (LensPaper::Space, Some(cells)) => cells.picture().svg_in_page(size),
            (LensPaper::Space, None) => String::new(),
        }
    }

    /// What a paper shows over it, which moves with the robot, likewise.
    pub fn moving(&self, paper: LensPaper, size: [f64; 2]) -> String {
        let q = self.anatomy.q();
        match (paper, &self.cells) {
            (LensPaper::World, None) => self.anatomy.overlay().svg_in_page(size),
            (LensPaper::World, Some(_)) => {
                self.anatomy.overlay().with(twin_items(self.anatomy.checker().robot(), &q)).svg_in_page(size)
            }
            (LensPaper::Space, Some(cells)) => {
                let (slice, still) = (cells.map().slice(), cells.picture());
                let fit = Fit::in_page(&still.bounds, size);
                let names = cells.names_off(Point2::from(slice.point(&q)), &fit);
                let over = overlay_items(slice, &self.anatomy.in_space(self.trace.clone()));
                Picture::new(still.name.clone(), still.bounds).with(names).with(over).svg_in_page(size)
            }
            (LensPaper::Space, None) => String::new(),
        }
    }
}
