//! A lens that stands still, as the light WebAssembly build exports it for a book's figures.

use serde_json::json;
use wasm_bindgen::prelude::*;

use super::link::{Link, LinkedAnatomy, ReadLink};
use super::query_value::query_value;
use motion_lab_core::picture::Theme;
use motion_lab_sim::anatomy::{Anatomy, Tab};
use motion_lab_sim::capture::{self, Paper};
use motion_lab_sim::lens::{Lens, LensPaper};
use motion_lab_sim::manifest::{Lesson, Widget};

/// Width of a figure's sheet, pixels.
const SHEET: u32 = 720;

/// The lens of an address, in a reader's hand. Points and sizes are pixels.
#[wasm_bindgen]
pub struct PageLens {
    lens: Lens,
    lesson: Option<Lesson>,
}

fn paper(is_space: bool) -> LensPaper {
    if is_space { LensPaper::Space } else { LensPaper::World }
}

#[wasm_bindgen]
impl PageLens {
    /// The lens that the query of an address shows. What it says of a run is passed over.
    ///
    /// # Errors
    /// What is no lens that stands still, or no place of its robot.
    #[wasm_bindgen(constructor)]
    pub fn new(query: &str) -> Result<Self, JsError> {
        let ReadLink { link, view, .. } = Link::read(query);
        view?;
        let widget = link.lesson.map(|lesson| lesson.widget).or(link.widget);
        let widget = widget.or(link.anatomy.tab.map(|_| Widget::Anatomy)).unwrap_or(Widget::Dashboard);
        let mut scene = link.lesson.map_or_else(Anatomy::default, |lesson| lesson.scene(None));
        link.anatomy.show_in(&mut scene).map_err(|why| JsError::new(&why))?;
        let refusal = || JsError::new(&format!("{} does not stand still", widget.id()));
        Ok(PageLens { lens: Lens::new(widget, scene).ok_or_else(refusal)?, lesson: link.lesson })
    }

    /// The lesson's id, if the address begins one.
    pub fn lesson(&self) -> Option<String> {
        self.lesson.map(Lesson::id)
    }

    /// Whether the lesson was done since this was asked last.
    pub fn take_done(&mut self) -> bool {
        let done = self.lens.take_done();
        self.lesson.is_some_and(|lesson| done.contains(&lesson.task))
    }

    /// Judges more cells of the configuration space; whether any remain.
    pub fn refine(&mut self, budget: u32) -> bool {
        self.lens.refine(budget)
    }

    /// A paper's height by its width; `None` where the lens has not this paper.
    pub fn aspect(&self, is_space: bool) -> Option<f64> {
        let bounds = self.lens.bounds(paper(is_space))?;
        Some((bounds.max.y - bounds.min.y) / (bounds.max.x - bounds.min.x))
    }

    /// What a paper shows below all that moves, as an SVG element.
    pub fn still(&self, is_space: bool, width: f64, height: f64) -> String {
        self.lens.still(paper(is_space), [width, height])
    }

    /// What a paper shows over it.
    pub fn moving(&self, is_space: bool, width: f64, height: f64) -> String {
        self.lens.moving(paper(is_space), [width, height])
    }

    /// What stands beside the pictures: [`LensWords`](motion_lab_sim::lens::LensWords) as JSON.
    ///
    /// # Errors
    /// None that can come.
    pub fn words(&self) -> Result<String, JsError> {
        Ok(serde_json::to_string(&self.lens.words())?)
    }

    /// The names of the roles of its colour key, which can be lit.
    pub fn roles(&self) -> Vec<String> {
        self.lens.widget().text().key.iter().map(|entry| entry.role().name().to_owned()).collect()
    }

    /// What a page hears of it: the widget and the query, as JSON.
    pub fn state(&self) -> String {
        json!({ "widget": self.lens.widget().id(), "query": query_value(self.lens.anatomy()) }).to_string()
    }

    /// The address that shows it.
    ///
    /// # Errors
    /// None that can come.
    pub fn link(&self) -> Result<String, JsError> {
        let (widget, anatomy) = (self.lens.widget(), self.lens.anatomy());
        let mut shown = LinkedAnatomy::of(anatomy);
        shown.tab = shown.tab.filter(|_| widget == Widget::Anatomy);
        // a lesson has a question of its own
        let lesson = self.lesson.filter(|lesson| shown.tab.is_none() || shown.tab == Some(lesson.scene(None).tab));
        Ok(Link { widget: Some(widget), lesson, anatomy: shown, ..Link::default() }.query()?)
    }

    /// The figure of it, as an SVG file.
    pub fn figure(&self, is_dark: bool) -> String {
        let captured = match self.lens.cells() {
            Some(cells) => capture::cspace(self.lens.anatomy(), cells.map(), self.lens.trace().to_vec()),
            None => capture::anatomy(self.lens.anatomy(), &[self.lens.anatomy().tab]),
        };
        let theme = if is_dark { Theme::Dark } else { Theme::Light };
        captured.svg(&Paper { palette: theme.palette(), width: SHEET, scale: 1.0 })
    }

    /// Where the hand takes hold on a paper of this size; empty where the lens has not this paper.
    pub fn handle(&self, is_space: bool, width: f64, height: f64) -> Vec<f64> {
        self.lens.handle(paper(is_space), [width, height]).map_or_else(Vec::new, Vec::from)
    }

    /// Whether a press at a point of a paper of this size takes hold.
    pub fn takes(&self, is_space: bool, width: f64, height: f64, x: f64, y: f64) -> bool {
        self.lens.takes(paper(is_space), [width, height], [x, y])
    }

    /// Moves a coordinate by so much.
    pub fn nudge(&mut self, index: usize, by: f64) {
        self.lens.nudge(index, by);
    }

    /// Drags what is held on a paper of this size to a point of it.
    pub fn drag(&mut self, is_space: bool, width: f64, height: f64, x: f64, y: f64) {
        let paper = paper(is_space);
        if let Some(to) = self.lens.point(paper, [width, height], [x, y]) {
            self.lens.drag(paper, to);
        }
    }

    /// The hand lets go.
    pub fn let_go(&mut self) {
        self.lens.let_go();
    }

    /// Sets a coordinate by its number.
    pub fn set_coordinate(&mut self, index: usize, value: f64) {
        self.lens.change(|anatomy| anatomy.set_coordinate(index, value));
    }

    /// Sets the swept question's step in a coordinate.
    pub fn set_step(&mut self, index: usize, step: f64) {
        self.lens.change(|anatomy| anatomy.set_step(index, step));
    }

    /// Puts the robot at coordinates.
    ///
    /// # Errors
    /// The reason, where it has no such place.
    pub fn put(&mut self, coordinates: &[f64]) -> Result<(), JsError> {
        let mut scene = self.lens.anatomy().clone();
        LinkedAnatomy::put(&mut scene, coordinates).map_err(|why| JsError::new(&why))?;
        self.lens.set(|anatomy| *anatomy = scene);
        Ok(())
    }

    /// Asks another question.
    ///
    /// # Errors
    /// The id, where it is none of a question.
    pub fn ask(&mut self, id: &str) -> Result<(), JsError> {
        let tab = Tab::ALL.into_iter().find(|tab| tab.name() == id);
        let tab = tab.ok_or_else(|| JsError::new(&format!("{id}: no question of Query")))?;
        self.lens.set(|anatomy| anatomy.tab = tab);
        Ok(())
    }

    /// Makes an arm's links thick, or bare.
    pub fn set_thick(&mut self, is_thick: bool) {
        self.lens.set(|anatomy| anatomy.set_thick_links(is_thick));
    }

    /// Shows what an arm's tip can reach, or not.
    pub fn show_annulus(&mut self, is_shown: bool) {
        self.lens.set(|anatomy| anatomy.show_annulus = is_shown);
    }
}
