//! `Template`, a thing that can be added to a world.

use super::{EditShape, Op};
use motion_lab_core::configuration::{ArmSizes, RobotKind, Sizes, Space};
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::num::{atan2, greater, hypot, lesser};
use motion_lab_core::worlds::Resident;

/// A thing that can be added to a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Template {
    /// A wall of one segment.
    Wall,
    /// A square box.
    Box,
    /// A disc.
    Disc,
    /// A triangle, to which corners can be added.
    Polygon,
    /// A painted line.
    Mark,
    /// A closed door.
    Door,
    /// A place that faces along x.
    Place,
    /// A robot of one of the lab's kinds, in one of its spaces.
    Robot(&'static RobotKind, &'static Space),
}

impl Template {
    /// All but robots.
    pub const THINGS: [Template; 7] = [
        Template::Wall,
        Template::Box,
        Template::Disc,
        Template::Polygon,
        Template::Door,
        Template::Mark,
        Template::Place,
    ];

    /// The robots: one for each space of each of the lab's kinds.
    pub fn robots() -> impl Iterator<Item = Template> {
        RobotKind::ALL.into_iter().flat_map(|kind| kind.spaces.iter().map(move |space| Template::Robot(kind, space)))
    }

    /// The name of a new one while that is free: for robots that of their kind, with a capital letter.
    pub fn name(&self) -> String {
        let word = match self {
            Template::Wall => "wall",
            Template::Box => "box",
            Template::Disc => "disc",
            Template::Polygon => "polygon",
            Template::Mark => "mark",
            Template::Door => "door",
            Template::Place => "place",
            Template::Robot(kind, _) => {
                let mut letters = kind.name.chars();
                return letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
            }
        };
        word.to_owned()
    }

    /// What it is, in a list of all: its name, and that a car pulls a trailer.
    pub fn title(&self) -> String {
        let pulls = match self {
            Template::Robot(kind, space) => kind.spaces.first().is_some_and(|least| *least != **space),
            _ => false,
        };
        format!("{}{}", self.name(), if pulls { " with its trailer" } else { "" })
    }

    /// Adds one of this name with its middle at a point; a robot with its reference point there, an arm with its base.
    /// Things without a size of their own are as large as `unit` says, metres.
    pub fn op(&self, name: String, at: Point2, unit: f64) -> Op {
        let corner = |x: f64, y: f64| at + Vector2::new(x, y) * unit;
        let shape = match self {
            Template::Wall => EditShape::Wall(vec![corner(-2.0, 0.0), corner(2.0, 0.0)]),
            Template::Mark => EditShape::Mark(vec![corner(-2.0, 0.0), corner(2.0, 0.0)]),
            Template::Box => EditShape::Box { min: corner(-1.0, -1.0), max: corner(1.0, 1.0) },
            Template::Disc => EditShape::Disc { centre: at, radius: unit },
            Template::Polygon => EditShape::Polygon(vec![corner(-2.0, -1.0), corner(2.0, -1.0), corner(0.0, 2.0)]),
            Template::Door => return Op::AddDoor { name, ends: [corner(-1.0, 0.0), corner(1.0, 0.0)] },
            Template::Place => return Op::AddPlace { name, pose: Pose2 { x: at.x, y: at.y, theta: 0.0 } },
            Template::Robot(kind, space) => return Op::AddRobot(resident(kind, space, &name, at)),
        };
        Op::Add { name, shape }
    }

    /// Adds one of this name drawn from one point to another: what has two ends between them, a box with them as its
    /// opposite corners, a triangle with one side along the box's, a disc about the first and through the second. A
    /// place and a robot on wheels stand at the first and face the second; an arm has its base at the first.
    pub fn drawn(&self, name: String, [from, to]: [Point2; 2]) -> Op {
        let way = to - from;
        let theta = atan2(way.y, way.x);
        let shape = match self {
            Template::Wall => EditShape::Wall(vec![from, to]),
            Template::Mark => EditShape::Mark(vec![from, to]),
            Template::Box => {
                let (min, max) =
                    ([lesser(from.x, to.x), lesser(from.y, to.y)], [greater(from.x, to.x), greater(from.y, to.y)]);
                EditShape::Box { min: min.into(), max: max.into() }
            }
            Template::Disc => EditShape::Disc { centre: from, radius: hypot(way.x, way.y) },
            Template::Polygon => {
                let top = Point2::new(0.5 * (from.x + to.x), to.y);
                EditShape::Polygon(vec![from, Point2::new(to.x, from.y), top])
            }
            Template::Door => return Op::AddDoor { name, ends: [from, to] },
            Template::Place => return Op::AddPlace { name, pose: Pose2 { x: from.x, y: from.y, theta } },
            Template::Robot(kind, space) => {
                let mut robot = resident(kind, space, &name, from);
                if robot.sizes.is_none() {
                    robot.start.iter_mut().skip(2).for_each(|heading| *heading = theta);
                }
                return Op::AddRobot(robot);
            }
        };
        Op::Add { name, shape }
    }

    /// How large one is that is drawn from one point to another: its length and direction, its sides or its radius.
    pub fn measured(&self, [from, to]: [Point2; 2]) -> String {
        let way = to - from;
        let (length, degrees) = (hypot(way.x, way.y), atan2(way.y, way.x).to_degrees().round());
        match self {
            Template::Wall | Template::Mark | Template::Door => format!("{length:.2} m, {degrees}\u{b0}"),
            Template::Box | Template::Polygon => format!("{:.2} m \u{d7} {:.2} m", way.x.abs(), way.y.abs()),
            Template::Disc => format!("radius {length:.2} m"),
            Template::Place | Template::Robot(..) => format!("{degrees}\u{b0}"),
        }
    }
}

/// A robot of this kind whose angles are all 0.
fn resident(kind: &RobotKind, space: &Space, name: &str, at: Point2) -> Resident {
    let mut robot = Resident::new(name, kind.name, vec![0.0; space.coordinates]);
    match (Sizes::of_kind(kind.name), &mut robot.start[..]) {
        (Some(Sizes::Arm(arm)), _) => robot.sizes = Some(Sizes::Arm(ArmSizes { base: at, ..arm })),
        (_, [x, y, ..]) => (*x, *y) = (at.x, at.y),
        _ => {}
    }
    robot
}

#[cfg(test)]
mod tests {
    use super::super::Editor;
    use super::*;
    use motion_lab_core::geometry::Aabb;
    use motion_lab_core::robots::AnyRobot;
    use motion_lab_core::worlds::World;

    #[test]
    fn what_is_drawn_goes_from_one_point_to_the_other() {
        let ends = [Point2::new(3.0, 2.0), Point2::new(6.0, 6.0)];
        let empty = World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0)));
        let mut editor = Editor::new(empty);
        for template in Template::THINGS.into_iter().chain(Template::robots()) {
            let name = editor.free_name(&template.name());
            editor.apply(&template.drawn(name.clone(), ends)).unwrap();
            let numbers = editor.numbers(&name);
            let of = |wanted: &str| numbers.iter().find(|n| n.name == wanted).map(|n| n.value);
            // by hand: 3 and 4 are the sides of a right triangle with 5, whose angle is 0.9273
            let known: &[(&str, f64)] = match template {
                Template::Wall | Template::Mark => &[("x 1", 3.0), ("y 1", 2.0), ("x 2", 6.0), ("y 2", 6.0)],
                Template::Box => &[("x", 3.0), ("y", 2.0), ("width", 3.0), ("height", 4.0)],
                Template::Disc => &[("x", 3.0), ("y", 2.0), ("radius", 5.0)],
                Template::Polygon => &[("x 2", 6.0), ("y 2", 2.0), ("x 3", 4.5), ("y 3", 6.0)],
                Template::Door => &[("x of the hinge", 3.0), ("y of the hinge", 2.0)],
                Template::Place => &[("x", 3.0), ("heading", 0.9273)],
                Template::Robot(..) => &[],
            };
            for (number, value) in known {
                let is = of(number).unwrap_or_else(|| panic!("{template:?}: {number} of {numbers:?}"));
                assert!((is - value).abs() < 1e-4, "{template:?}: {number} {is}");
            }
        }
        for robot in &editor.world().robots {
            let (model, q) = AnyRobot::of_resident(robot).unwrap();
            match model.annulus() {
                Some((base, _)) => assert_eq!(base, ends[0]),
                None => assert!(robot.start[2..].iter().all(|theta| (theta - 0.9273).abs() < 1e-4), "{q}"),
            }
        }
        let door = &editor.world().doors[0];
        assert_eq!([door.a, door.b], ends);
        // the other way round a box is the same
        let back = [ends[1], ends[0]];
        assert_eq!(Template::Box.drawn("box".into(), back), Template::Box.drawn("box".into(), ends));
        assert_eq!(Template::Wall.measured(ends), "5.00 m, 53\u{b0}");
        assert_eq!(Template::Box.measured(back), "3.00 m \u{d7} 4.00 m");
        assert_eq!(Template::Disc.measured(ends), "radius 5.00 m");
    }

    #[test]
    fn everything_is_added_where_it_is_asked_for() {
        let at = Point2::new(3.0, 2.0);
        let empty = World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0)));
        let mut editor = Editor::new(empty);
        for template in Template::THINGS.into_iter().chain(Template::robots()) {
            let name = editor.free_name(&template.name());
            editor.apply(&template.op(name.clone(), at, 0.5)).unwrap();
            assert!(editor.holds(&name), "{template:?}");
            let numbers = editor.numbers(&name);
            let of = |wanted: &str| numbers.iter().find(|n| n.name == wanted).map(|n| n.value);
            if let Template::Robot(..) = template {
                let (robot, q) = AnyRobot::of_resident(editor.world().robots.last().unwrap()).unwrap();
                let stands = robot.annulus().map_or_else(|| robot.reference(&q), |(base, _)| base);
                assert_eq!(stands, at, "{template:?}");
            } else {
                // two units to either side, one, a radius of one unit, or the point itself
                let x = match template {
                    Template::Wall | Template::Mark | Template::Polygon => (of("x 1"), Some(2.0)),
                    Template::Box => (of("x"), Some(2.5)),
                    Template::Door => (of("x of the hinge"), Some(2.5)),
                    _ => (of("x"), Some(3.0)),
                };
                assert_eq!(x.0, x.1, "{template:?}");
            }
        }
        let world = editor.world();
        assert!(!world.doors[0].open, "a new door is closed");
        let titles: Vec<String> = Template::robots().map(|t| t.title()).collect();
        assert_eq!(titles, ["Rusty", "Reach", "Reach3", "Hitch", "Hitch with its trailer"]);
        let names: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(names, ["Rusty", "Reach", "Reach3", "Hitch", "Hitch 2"]);
        let kinds: Vec<&str> = editor.things().iter().map(|(kind, _)| *kind).collect();
        let things = ["wall", "obstacle", "obstacle", "obstacle", "door", "place", "mark"];
        assert_eq!(kinds, [&things[..], &["robot"; 5]].concat());
    }
}
