//! `Cockpit` and `Dashboard`: what the dashboard shows, as plain values.

use std::sync::Arc;

use bevy::prelude::Resource;

use crate::window::ui::CrowdView;
use motion_lab_core::configuration::{Coordinates, RobotKind};
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::picture::{Gait, Item, Picture, RobotDrawing, robot};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::atlas::Atlas;
use motion_lab_sim::simulation::SensorView;

/// A distance from the nearest obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownClearance {
    /// The distance, metres: 0 on contact, and only then.
    pub metres: f64,
    /// The name of the obstacle that the robot is held before, which its next step would touch.
    pub held_before: Option<String>,
}

impl ShownClearance {
    /// What is said of a disc of this radius, metres.
    pub fn words(&self, radius: f64) -> String {
        match &self.held_before {
            Some(name) => format!("held {} before {name}", length(self.metres)),
            None => format!("clearance: {}, of its centre {}", length(self.metres), length(self.metres + radius)),
        }
    }
}

/// A length, metres. One of less than a millimetre has a unit in which it is not 0.
fn length(metres: f64) -> String {
    match metres {
        0.0 => "0\u{a0}m".to_owned(),
        1e-3.. => format!("{metres:.4}\u{a0}m"),
        5e-6.. => format!("{:.2}\u{a0}mm", 1e3 * metres),
        _ => "less than 0.01\u{a0}mm".to_owned(),
    }
}

/// One robot in its cockpit.
#[derive(Clone, Debug, PartialEq)]
pub struct CockpitRobot {
    /// Its id.
    pub id: u32,
    /// Its unique name.
    pub name: String,
    /// Its configuration as its type prints it.
    pub readout: String,
    /// Its footprint as drawn: between two ticks, a blend of both.
    pub footprint: Footprint,
    /// Its heading, radians, for a robot of one part that is no arm; otherwise `None`.
    pub heading: Option<f64>,
    /// How its wheels stand.
    pub gait: Gait,
    /// Whether its contact flash is on.
    pub flash: bool,
    /// Contact episodes since the start.
    pub contacts: u32,
    /// Its distance from the nearest obstacle; `None` where it is not known.
    pub clearance: Option<ShownClearance>,
    /// Whether inputs drive it, a person's or those of a path that is played.
    pub manual: bool,
    /// Whether these are of a path that is played and nothing else.
    pub along_path: bool,
    /// Whether it can be driven by channels.
    pub drivable: bool,
    /// Its kind, as worlds name it.
    pub kind: String,
    /// Its kind's description, if it has one.
    pub about: Option<&'static RobotKind>,
    /// The robot with its own sizes, if it is one of the lab's.
    pub model: Option<AnyRobot>,
    /// Whether it is an arm, moved by its joints.
    pub is_arm: bool,
    /// The coordinates of its configuration at the last tick.
    pub coordinates: Coordinates,
    /// Its configuration with every digit.
    pub in_full: String,
    /// The coordinates that an input asks for by the next tick.
    pub target: Option<Coordinates>,
    /// Its range sensors with what they read, in the order of their names.
    pub sees: Vec<SensorView>,
    /// The tip of an arm, metres; `None` for other robots.
    pub tip: Option<Point2>,
    /// The reason why no trailer can be put on here; `None` where one can be or is on, and for other robots.
    pub no_room: Option<String>,
    /// The tick by which an input put it somewhere last, as far back as its trail goes; 0 without one.
    pub put: u64,
    /// Whether an input has put it somewhere since its exercise began.
    pub put_since_goal: bool,
    /// The number of its changes between forward and backward.
    pub reversals: u32,
    /// Whether a trailer is on; `None` for a robot that can't have one.
    pub trailer: Option<bool>,
}

/// One pane: a world with its robots.
#[derive(Clone, Debug, PartialEq)]
pub struct Cockpit {
    /// The world.
    pub world: Arc<Picture>,
    /// The world with its names, shown on demand.
    pub atlas: Arc<Atlas>,
    /// The world as it stands, with its residents as they start.
    pub standing: Arc<World>,
    /// Its robots; in a world with a crowd, the one that is picked.
    pub robots: Vec<CockpitRobot>,
    /// All its robots, where they are many.
    pub crowd: Option<CrowdView>,
    /// The doors that open, `true`, or close with the next tick of a paused run.
    pub doors: Vec<(String, bool)>,
    /// Whether the run is paused with a change of the world or an input to a robot that comes with the next tick.
    pub waiting: bool,
}

/// The values of the dashboard in this frame.
#[derive(Resource)]
pub struct ShownDashboard(pub Dashboard);

/// The whole dashboard.
#[derive(Clone, Debug, PartialEq)]
pub struct Dashboard {
    /// The panes, left to right.
    pub cockpits: Vec<Cockpit>,
    /// The run's seed.
    pub seed: Seed,
    /// The last tick done.
    pub tick: u64,
    /// The last tick that the run has reached, even where it stands at an earlier one now.
    pub frontier: u64,
    /// Simulated seconds per second of the clock.
    pub speed: f64,
    /// Whether it plays.
    pub playing: bool,
    /// Whether it plays in a loop.
    pub looping: bool,
    /// A note on the speed reached, where the run falls behind its speed or plays as fast as possible.
    pub behind: Option<String>,
    /// The tick of the next contact known.
    pub next_contact: Option<u64>,
    /// Whether a contact is known that can be asked about.
    pub has_contact: bool,
    /// Whether something can be undone.
    pub can_undo: bool,
    /// Whether something can be redone.
    pub can_redo: bool,
}

impl Dashboard {
    /// The robot with this name, with its cockpit.
    pub fn robot(&self, name: &str) -> Option<(&Cockpit, &CockpitRobot)> {
        let mut all = self.cockpits.iter().flat_map(|c| c.robots.iter().map(move |robot| (c, robot)));
        all.find(|(_, robot)| robot.name == name)
    }

    /// The name of the robot with this id, if it is shown.
    pub fn name_of(&self, id: u32) -> Option<&str> {
        self.cockpits.iter().find_map(|cockpit| match &cockpit.crowd {
            Some(crowd) => crowd.name(id),
            None => cockpit.robots.iter().find(|r| r.id == id).map(|r| r.name.as_str()),
        })
    }
}

impl Cockpit {
    /// Whether a robot of this name lives in it.
    pub fn has(&self, robot: &str) -> bool {
        match &self.crowd {
            Some(crowd) => crowd.names.iter().any(|name| name == robot),
            None => self.robots.iter().any(|r| r.name == robot),
        }
    }

    /// The heading over the readout: the robots and their world.
    pub fn heading(&self) -> String {
        if let Some(crowd) = &self.crowd {
            return format!("{} robots \u{b7} {}", thousands(crowd.names.len() as u64), self.world.name);
        }
        let names: Vec<&str> = self.robots.iter().map(|r| r.name.as_str()).collect();
        match names.len() {
            0 => self.world.name.clone(),
            _ => format!("{} \u{b7} {}", names.join(", "), self.world.name),
        }
    }

    /// The short name on a tab.
    pub fn tab(&self) -> &str {
        match &self.robots[..] {
            [one] if self.crowd.is_none() => &one.name,
            _ => &self.world.name,
        }
    }

    /// The robots as items over the world, each red or not as `red` says.
    pub fn robots_picture(&self, mut red: impl FnMut(&CockpitRobot) -> bool) -> Vec<Item> {
        let drawn = |r: &CockpitRobot| {
            let in_contact = red(r);
            robot(&RobotDrawing {
                name: &r.name,
                footprint: &r.footprint,
                heading: r.heading,
                model: r.model,
                gait: r.gait,
                in_contact,
            })
        };
        self.robots.iter().flat_map(drawn).collect()
    }

    /// The pane in words, for screen readers.
    pub fn described(&self) -> String {
        if let Some(crowd) = &self.crowd {
            return format!("{} robots in {}", thousands(crowd.names.len() as u64), self.world.name);
        }
        let robots: Vec<String> =
            self.robots.iter().map(|r| format!("{}: {}, contacts: {}", r.name, r.readout, r.contacts)).collect();
        format!("{}. {}", self.world.name, robots.join("; "))
    }
}

/// A number with a comma between its thousands: `10,000`.
pub fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|group| std::str::from_utf8(group).ok()).collect();
    groups.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_distance_reads_zero_on_contact_alone() {
        let said = |metres, held: Option<&str>| {
            ShownClearance { metres, held_before: held.map(str::to_owned) }.words(0.11).replace('\u{a0}', " ")
        };
        assert_eq!(said(0.23451, None), "clearance: 0.2345 m, of its centre 0.3445 m");
        assert_eq!(said(0.0, None), "clearance: 0 m, of its centre 0.1100 m");
        assert_eq!(said(4e-5, None), "clearance: 0.04 mm, of its centre 0.1100 m");
        assert_eq!(said(1e-7, None), "clearance: less than 0.01 mm, of its centre 0.1100 m");
        assert_eq!(said(4e-5, Some("C's bed")), "held 0.04 mm before C's bed");
        let digits = |said: &str| said.chars().filter(char::is_ascii_digit).any(|digit| digit != '0');
        for tiny in [1e-3, 9.9999e-4, 9.99e-5, 5e-6, 4.9e-6, f64::MIN_POSITIVE] {
            assert!(digits(&length(tiny)), "{tiny}: {}", length(tiny));
        }
    }

    #[test]
    fn thousands_are_parted_by_commas() {
        let said = [0, 999, 1_000, 10_000, 100_000, 1_234_567].map(thousands);
        assert_eq!(said, ["0", "999", "1,000", "10,000", "100,000", "1,234,567"]);
    }
}
