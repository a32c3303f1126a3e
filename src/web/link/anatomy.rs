//! `LinkedAnatomy`, what Query shows of its usual robot, as an address holds it.

use motion_lab_core::configuration::Configuration;
use motion_lab_sim::anatomy::{Anatomy, Tab};

/// What Query shows of its usual robot; the configuration space shares the robot. What an address leaves out stays as
/// it is, but links are bare where anything else is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkedAnatomy {
    /// The question.
    pub tab: Option<Tab>,
    /// The robot's chart coordinates, metres and radians; empty where it stays.
    pub q: Vec<f64>,
    /// The step of the swept question's motion in each coordinate; empty where it stays.
    pub step: Vec<f64>,
    /// Whether the links are thick.
    pub thick: bool,
}

impl LinkedAnatomy {
    /// What this scene shows.
    pub fn of(scene: &Anatomy) -> Self {
        let step = if scene.tab == Tab::Swept { scene.step().to_vec() } else { Vec::new() };
        let (q, thick) = (scene.q().coordinates().to_vec(), scene.thick_links() == Some(true));
        LinkedAnatomy { tab: Some(scene.tab), q, step, thick }
    }

    /// Shows it in a scene. What is refused changes nothing, and all else is shown.
    ///
    /// # Errors
    /// The first field that its robot does not take, and why.
    pub fn show_in(&self, scene: &mut Anatomy) -> Result<(), String> {
        scene.tab = self.tab.unwrap_or(scene.tab);
        if *self != LinkedAnatomy::default() {
            // links are bare where an address says no other
            scene.set_thick_links(self.thick);
        }
        let count = scene.q().coordinates().len();
        let placed = if self.q.is_empty() { Ok(()) } else { Self::put(scene, &self.q) };
        let placed = placed.map_err(|why| format!("q: {why}"));
        if !self.step.is_empty() && self.step.len() != count {
            return placed.and(Err(format!("step: {}", count_of(count))));
        }
        self.step.iter().enumerate().for_each(|(i, step)| scene.set_step(i, *step));
        placed
    }

    /// Puts a scene's robot at chart coordinates.
    ///
    /// # Errors
    /// Why it has no such place.
    pub fn put(scene: &mut Anatomy, coordinates: &[f64]) -> Result<(), String> {
        let q = scene.q();
        let q = q.with_coordinates(coordinates).ok_or_else(|| count_of(q.coordinates().len()))?;
        scene.set_q(q).map_err(|error| error.to_string())
    }
}

fn count_of(coordinates: usize) -> String {
    format!("the robot has {coordinates} coordinates")
}
