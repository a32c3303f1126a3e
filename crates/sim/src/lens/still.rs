//! `LensWords`, what stands beside the pictures of a lens.

use serde::Serialize;

use super::held::Lens;
use crate::anatomy::Tab;
use crate::capture::what_is_known;
use crate::manifest::Widget;
use motion_lab_core::configuration::Configuration;
use motion_lab_core::picture::{in_signs, readout, true_minus};

/// A slider of a lens.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LensSlider {
    /// The coordinate's name.
    pub name: String,
    /// The value, metres or radians.
    pub value: f64,
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub most: f64,
}

/// What stands beside the pictures of a lens.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LensWords {
    /// The widget's id.
    pub widget: &'static str,
    /// The question's name.
    pub tab: &'static str,
    /// The names of all questions; none for the configuration space.
    pub tabs: Vec<&'static str>,
    /// The question, in a sentence; empty for the configuration space.
    pub question: &'static str,
    /// What matters most of the answer.
    pub answer: String,
    /// The rest of it, line by line.
    pub details: Vec<String>,
    /// Whether the answer is a contact.
    pub touches: bool,
    /// The scene and its answer, for readers who do not see the picture.
    pub described: String,
    /// The coordinates.
    pub sliders: Vec<LensSlider>,
    /// The steps of the swept question's motion; empty for the others.
    pub steps: Vec<LensSlider>,
    /// The radius that the links of an arm have when they are thick, metres, and whether they are; `None` for others.
    pub thick: Option<(f64, bool)>,
    /// Whether the points that an arm's tip can reach are shown; `None` for others.
    pub annulus: Option<bool>,
}

impl Lens {
    /// What stands beside the pictures.
    pub fn words(&self) -> LensWords {
        let anatomy = self.anatomy();
        let is_space = self.widget() == Widget::Cspace;
        let (answer, details) = if is_space {
            let mut lines = vec![readout(&anatomy.q().to_string())];
            lines.extend(self.cells().iter().flat_map(|cells| what_is_known(cells.map())));
            (anatomy.clearance(), lines)
        } else {
            anatomy.answer()
        };
        let (q, is_swept) = (anatomy.q(), !is_space && anatomy.tab == Tab::Swept);
        let names = q.coordinate_names();
        let coordinates = q.coordinates();
        let slider = |(i, name): (usize, &String)| {
            let [least, most] = anatomy.range(i);
            LensSlider { name: in_signs(name), value: coordinates[i], least, most }
        };
        let step = |(i, name): (usize, &String)| {
            let most = anatomy.step_range(i);
            LensSlider { name: format!("step of {}", in_signs(name)), value: anatomy.step()[i], least: -most, most }
        };
        LensWords {
            widget: self.widget().id(),
            tab: anatomy.tab.name(),
            tabs: Tab::ALL.into_iter().filter(|_| !is_space).map(Tab::name).collect(),
            question: if is_space { "" } else { anatomy.question() },
            touches: anatomy.intersects() && !is_swept,
            described: anatomy.described(),
            answer: true_minus(&answer),
            details: details.iter().map(|line| true_minus(line)).collect(),
            sliders: names.iter().enumerate().map(slider).collect(),
            steps: names.iter().enumerate().filter(|_| is_swept).map(step).collect(),
            thick: anatomy.thickness().zip(anatomy.thick_links()),
            annulus: anatomy.checker().robot().annulus().map(|_| anatomy.show_annulus),
        }
    }
}
