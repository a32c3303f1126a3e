//! A run's tour as a figure: each robot's path, its start and end, and its contacts.

use crate::run::Digest;
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::picture::{
    Drawing, Figure, Gait, Glyph, Item, Panel, RobotDrawing, Role, footprint, robot, trace, world,
};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;

/// One world of a run with its robots.
#[derive(Clone, Debug)]
pub struct TourPanel<'a> {
    /// The world.
    pub world: &'a World,
    /// Its robots.
    pub robots: Vec<RobotTour>,
}

/// The tour of one robot.
#[derive(Clone, Debug)]
pub struct RobotTour {
    /// Its unique name.
    pub name: String,
    /// The path of its reference point (Rusty's centre, Reach's tip, Hitch's rear axle), tick by tick, the start first.
    pub trace: Vec<Point2>,
    /// The footprint at the start.
    pub start: Footprint,
    /// The footprint at the end.
    pub end: Footprint,
    /// The heading at the end, radians, where the footprint does not show it (a disc).
    pub end_heading: Option<f64>,
    /// The robot with its own sizes, if it is one of the lab's.
    pub model: Option<AnyRobot>,
    /// How its wheels stand at the end.
    pub gait: Gait,
    /// The reference point at the first tick of each contact.
    pub contacts: Vec<Point2>,
    /// Its final configuration as it prints.
    pub readout: String,
}

/// The figure of a run, its worlds side by side. `tick` is the number of ticks run, `ticks` that of the whole run.
pub fn tour_figure(seed: Seed, tick: u64, ticks: u64, digest: Digest, panels: &[TourPanel<'_>]) -> Figure {
    let seconds = crate::run::DT * tick as f64;
    let so_far = if tick == ticks { format!("{ticks} ticks") } else { format!("tick {tick} of {ticks}") };
    Figure {
        title: format!("A run of {seconds:.0} s at seed {}", seed.0),
        description: description(panels),
        panels: panels.iter().map(panel).collect(),
        caption: vec![
            format!("Seed {}, {so_far} ({seconds:.2} s). Outlines: start. Crosses: contacts.", seed.0),
            format!("Digest {digest}"),
        ],
    }
}

fn panel(tour: &TourPanel<'_>) -> Panel {
    let mut picture = world(tour.world);
    for robot in &tour.robots {
        picture =
            picture.with([trace(&format!("path/{}", robot.name), &format!("the way of {}", robot.name), &robot.trace)]);
    }
    for robot in &tour.robots {
        picture = picture.with(stations(robot));
    }
    let readout = tour.robots.iter().flat_map(|r| {
        let head = if tour.robots.len() == 1 { String::new() } else { format!("{}  ", r.name) };
        [format!("{head}{}", r.readout), format!("{head}contacts: {}", r.contacts.len())]
    });
    let heading = match &tour.robots[..] {
        [one] => format!("{} \u{b7} {}", one.name, tour.world.name),
        _ => tour.world.name.clone(),
    };
    Panel { heading, readout: readout.collect(), picture }
}

fn stations(tour: &RobotTour) -> Vec<Item> {
    let name = &tour.name;
    let mut items = footprint(&format!("start/{name}"), &format!("the start of {name}"), &tour.start, Role::Robot, 0.0);
    let RobotTour { end, end_heading, model, gait, .. } = tour;
    items.extend(robot(&RobotDrawing {
        name,
        footprint: end,
        heading: *end_heading,
        model: *model,
        gait: *gait,
        in_contact: false,
    }));
    items.extend(tour.contacts.iter().enumerate().map(|(i, &at)| {
        let mark = Drawing::Mark { at, glyph: Glyph::Cross, radius_px: 3.5 };
        Item::new(format!("contact/{name}/{}", i + 1), format!("contact {} of {name}", i + 1), Role::Goal, mark)
    }));
    items
}

fn description(panels: &[TourPanel<'_>]) -> String {
    let mut sentences = Vec::new();
    for panel in panels {
        for robot in &panel.robots {
            let times = match robot.contacts.len() {
                0 => "nothing".to_owned(),
                1 => "something once".to_owned(),
                n => format!("something {n} times"),
            };
            sentences.push(format!(
                "In the world {1}, {0} touches {times} and ends at {2}.",
                robot.name, panel.world.name, robot.readout
            ));
        }
    }
    sentences.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::Aabb;

    #[test]
    fn the_figure_tells_seed_digest_contacts_and_ends() {
        let p = Point2::new;
        let yard = World {
            name: "Yard".into(),
            bounds: Aabb { min: p(0.0, 0.0), max: p(4.0, 4.0) },
            obstacles: vec![],
            doors: vec![],
            routes: vec![],
            places: vec![],
            marks: vec![],
            robots: vec![],
        };
        let robot = RobotTour {
            name: "Rusty".into(),
            trace: vec![p(1.0, 1.0), p(2.0, 2.0), p(3.0, 1.0)],
            start: Footprint::disc(p(1.0, 1.0), 0.11),
            end: Footprint::disc(p(3.0, 1.0), 0.11),
            end_heading: Some(0.5),
            model: None,
            gait: Gait::default(),
            contacts: vec![p(2.0, 2.0)],
            readout: "Pose2 { x: 3.000, y: 1.000, theta: 0.500 }".into(),
        };
        let figure =
            tour_figure(Seed(7), 1200, 1200, Digest(0xabc), &[TourPanel { world: &yard, robots: vec![robot] }]);
        assert!(figure.caption[0].contains("Seed 7, 1200 ticks (60.00 s)"), "{}", figure.caption[0]);
        let half = tour_figure(Seed(7), 600, 1200, Digest(0xabc), &[]);
        assert!(half.caption[0].contains("Seed 7, tick 600 of 1200 (30.00 s)"), "{}", half.caption[0]);
        assert_eq!(figure.panels[0].heading, "Rusty \u{b7} Yard");
        assert_eq!(figure.panels[0].readout[1], "contacts: 1");
        assert!(figure.caption.join(" ").contains(&format!("{:032x}", 0xabc)));
        assert!(figure.description.contains("touches something once"));
        let crosses: Vec<&Item> = figure.panels[0].picture.items.iter().filter(|i| i.role == Role::Goal).collect();
        assert_eq!(crosses.len(), 1, "red for the one contact and nothing else");
        assert_eq!(crosses[0].id, "contact/Rusty/1");
    }
}
