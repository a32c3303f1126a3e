//! Robots put by a click: asked for, refused, offered the nearest free place.

use crate::window::ui::AtlasState;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::Point2;
use motion_lab_sim::atlas::TeleportRefusal;

impl AtlasState {
    /// Forgets where a robot that is not yet put was wanted.
    pub fn forget_wanted(&mut self) {
        self.wanted = None;
    }

    /// Puts the robot of this name at `q`, to be put on by clicks from there; where it has no room there it stays.
    pub fn stand(&mut self, name: &str, q: AnyConfiguration) {
        if let Some(index) = self.atlas.robots().iter().position(|robot| robot.name == name) {
            _ = self.atlas.teleport(index, q);
            self.robot = index;
            (self.labels, self.refused) = (None, None);
        }
    }

    /// Why the robot was not put where it was wanted, and whether a free place is offered.
    pub fn refusal(&self) -> Option<String> {
        let (_, refusal) = self.refused.as_ref()?;
        let offer = match refusal {
            TeleportRefusal::Overlap { nearest: Some(_), .. } => "; click the ring for the nearest free place",
            _ => "",
        };
        Some(format!("{refusal}{offer}"))
    }

    /// Asks for the robot at a point, with this heading or its present one. Puts it there only when `done`.
    pub fn ask(&mut self, at: Point2, heading: Option<f64>, done: bool) {
        self.refused = None;
        self.wanted = None;
        match self.atlas.target(self.robot, at, heading) {
            Some(Ok(q)) => self.ask_for(q, done),
            Some(Err(refusal)) => {
                let here = self.atlas.robots().get(self.robot).map(|r| r.q);
                self.refused = here.map(|q| (q, refusal));
            }
            None => {}
        }
    }

    /// Asks for the robot at a configuration. Puts it there only when `done`.
    pub fn ask_for(&mut self, q: AnyConfiguration, done: bool) {
        self.refused = None;
        self.wanted = (!done).then_some(q);
        if done {
            if let Some(Err(refusal)) = self.atlas.teleport(self.robot, q) {
                self.refused = Some((q, refusal));
            }
            self.labels = None;
        }
    }

    /// Takes the offered place if the point is within `reach` metres of it. Returns whether the robot was put there.
    pub fn take_offer(&mut self, at: Point2, reach: f64) -> bool {
        let Some((_, TeleportRefusal::Overlap { nearest: Some(offer), .. })) = &self.refused else { return false };
        let (q, Some(robot)) = (offer.q, self.atlas.robots().get(self.robot)) else { return false };
        if (robot.robot.reference(&q) - at).norm() > reach {
            return false;
        }
        self.refused = None;
        self.labels = None;
        matches!(self.atlas.teleport(self.robot, q), Some(Ok(())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::worlds::World;

    #[test]
    fn a_robot_is_put_refused_and_offered_the_nearest_place() {
        let mut atlas = AtlasState::of(World::lot());
        let before = atlas.atlas().robots()[0].q;
        // on the west pillar
        atlas.ask(Point2::new(5.5, 5.0), Some(1.2), true);
        assert_eq!(atlas.atlas().robots()[0].q, before);
        assert!(atlas.refusal().unwrap().starts_with("would overlap the west pillar"), "{:?}", atlas.refusal());
        let Some((_, TeleportRefusal::Overlap { nearest: Some(offer), .. })) = atlas.refused.clone() else {
            panic!("an offer")
        };
        let at = atlas.atlas().robots()[0].robot.reference(&offer.q);
        assert!(!atlas.take_offer(at + nalgebra::Vector2::new(1.0, 0.0), 0.1));
        let name = atlas.atlas().robots()[0].name.clone();
        let label = |a: &mut AtlasState| a.labels(60.0).iter().find(|item| item.name == name).cloned();
        let label_before = label(&mut atlas);
        assert!(label_before.is_some());
        assert!(atlas.take_offer(at, 0.1));
        assert_eq!(atlas.atlas().robots()[0].q, offer.q);
        assert_ne!(label(&mut atlas), label_before, "its name goes with it");
        // while it is only dragged nothing is put
        atlas.ask(Point2::new(8.0, 2.5), None, false);
        assert_eq!(atlas.atlas().robots()[0].q, offer.q);
        atlas.ask(Point2::new(8.0, 2.5), None, true);
        assert_eq!(atlas.atlas().robots()[0].robot.reference(&atlas.atlas().robots()[0].q), Point2::new(8.0, 2.5));
    }
}
