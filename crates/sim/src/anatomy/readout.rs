//! The text beside the picture: the answers in words and figures.

use super::feature::Feature;
use super::words::{figure, metres, point};
use super::{Anatomy, NearestPair, SweptMotion, Tab};
use motion_lab_core::collision::{EdgeVerdict, HitBy, ObstacleId};
use motion_lab_core::geometry::Point2;
use motion_lab_core::robots::{AnyRobot, Reach};

impl Anatomy {
    /// The tab's question, in a sentence.
    pub fn question(&self) -> &'static str {
        match self.tab {
            Tab::Intersects => "Does the robot touch anything? Touching counts.",
            Tab::Distance => "How far is it to the nearest obstacle? Exactly 0 in contact.",
            Tab::Witness => "Which two points are the nearest, and what do they lie on?",
            Tab::Swept => "Is the whole motion free, and not only its two ends?",
        }
    }

    /// The answer on the tab, line by line.
    pub fn readout(&self) -> Vec<String> {
        match self.tab {
            Tab::Intersects => {
                let mut lines = vec![format!("intersects: {}", self.intersects())];
                lines.extend(self.nearest().first().filter(|p| p.witness.dist == 0.0).map(|p| {
                    format!("{} and {} meet at {}", self.part(p), self.obstacle(p), point(p.witness.on_obstacle))
                }));
                lines
            }
            Tab::Distance => {
                let d = self.distance();
                vec![format!("distance: {}", metres(d)), format!("in full: {d:?}")]
            }
            Tab::Witness => {
                let pairs = self.nearest();
                let mut lines: Vec<String> = pairs.iter().flat_map(|p| self.pair(p)).collect();
                match pairs.len() {
                    0 => lines.push("no witness: nothing is there".into()),
                    1 => {}
                    n => lines.insert(0, format!("a tie of {n}: each pair is as near")),
                }
                lines
            }
            Tab::Swept => match self.sweep() {
                Ok(sweep) => sweep.words(|id| self.name(id), self.checker().robot()),
                Err(error) => vec![error.to_string()],
            },
        }
    }

    /// The answer on the tab: what matters most in a line, and its details line by line.
    pub fn answer(&self) -> (String, Vec<String>) {
        if self.tab == Tab::Swept {
            return match self.sweep() {
                Ok(sweep) => self.answer_of(&sweep),
                Err(error) => (error.to_string(), vec![]),
            };
        }
        let mut lines = self.readout();
        let is_length = |line: &String| line.contains("| = ") || line.starts_with("in contact");
        let at = lines.iter().position(is_length).filter(|_| self.tab == Tab::Witness).unwrap_or(0);
        (lines.remove(at), lines)
    }

    fn answer_of(&self, sweep: &SweptMotion) -> (String, Vec<String>) {
        let mut lines = sweep.words(|id| self.name(id), self.checker().robot());
        let EdgeVerdict::Hit { contact_at, by, .. } = sweep.verdict else {
            // after what its ends are
            return (lines.remove(usize::from(lines.len() > 1)), lines);
        };
        let what = match by {
            HitBy::Obstacle(id) => format!("hits {}", self.name(id)),
            HitBy::Limit => "beyond its limit".to_owned(),
        };
        (format!("{what} at s = {}", figure(contact_at, 4)), lines)
    }

    /// Whether the robot is free, and how far from the nearest obstacle: `free, 0.0607 m`.
    pub fn clearance(&self) -> String {
        if self.intersects() { "in contact".to_owned() } else { format!("free, {}", metres(self.distance())) }
    }

    /// The scene and the answer in words, for readers who do not see the picture.
    pub fn described(&self) -> String {
        format!(
            "{} at {} in the world {}. {} {}.",
            self.checker().robot().title(),
            self.q(),
            self.world().name,
            self.question(),
            self.readout().join("; ")
        )
    }

    fn pair(&self, pair: &NearestPair) -> Vec<String> {
        let w = &pair.witness;
        if w.dist == 0.0 {
            return vec![format!("in contact at {}", point(w.on_robot)), self.on_obstacle(pair)];
        }
        vec![
            format!("a* = {} {}", point(w.on_robot), self.on_robot(pair)),
            format!("b* = {} {}", point(w.on_obstacle), self.on_obstacle(pair)),
            format!("|a* \u{2212} b*| = {}", metres(w.dist)),
        ]
    }

    /// The place on the robot in words: `on link 2`, `at the elbow`.
    fn on_robot(&self, pair: &NearestPair) -> String {
        let arm = self.checker().robot();
        let thin = matches!(arm, AnyRobot::Reach(Reach { link_radius: 0.0, .. }));
        let joint = |at: Point2| {
            let is = |p: Point2| (p - at).norm() <= 1e-9;
            if is(arm.reference(&self.q())) {
                "the tip"
            } else if arm.annulus().is_some_and(|(base, _)| is(base)) {
                "the base"
            } else {
                "the elbow"
            }
        };
        match pair.on_robot {
            Feature::End(at) if arm.annulus().is_some() => {
                format!("{} {}", if thin { "at" } else { "on the round end at" }, joint(at))
            }
            Feature::Corner(_) => format!("at a corner of {}", self.part(pair)),
            _ => format!("on {}", self.part(pair)),
        }
    }

    /// The place on the obstacle in words: `at a corner of the block`, `on an edge of the block`.
    fn on_obstacle(&self, pair: &NearestPair) -> String {
        let name = self.obstacle(pair);
        match pair.on_obstacle {
            Feature::Corner(_) => format!("at a corner of {name}"),
            Feature::End(_) => format!("at an end of {name}"),
            Feature::Edge(..) => format!("on an edge of {name}"),
            Feature::Rim => format!("on the rim of {name}"),
            Feature::Inside => format!("inside {name}"),
        }
    }

    fn part(&self, pair: &NearestPair) -> String {
        self.checker().robot().part_name(pair.witness.part)
    }

    fn obstacle(&self, pair: &NearestPair) -> String {
        self.name(pair.witness.obstacle)
    }

    pub(super) fn name(&self, obstacle: ObstacleId) -> String {
        self.checker().scene().obstacle_name(obstacle).unwrap_or("something").to_owned()
    }
}
