//! `Number`, one of the numbers of a thing in a world, which the editor shows and changes.

use super::EditShape;
use super::outline::tidy;
use motion_lab_core::configuration::{Kinds, RobotKind, Sizes};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::worlds::{Door, Resident};

/// A number of a thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// What it is: `width`, `x 2`, `heading`.
    pub name: String,
    /// Its value, metres or radians.
    pub value: f64,
    /// The unit: `m`, `rad`, or nothing for a coordinate of a kind that nobody has described.
    pub unit: &'static str,
}

/// What is done with each number of a thing: its name, its unit, and itself.
pub(super) type NumberVisitor<'a> = dyn FnMut(&str, &'static str, &mut f64) + 'a;

/// The numbers that `all` visits.
pub(super) fn listed(all: impl FnOnce(&mut NumberVisitor<'_>)) -> Vec<Number> {
    let mut numbers = Vec::new();
    all(&mut |name, unit, value| numbers.push(Number { name: name.to_owned(), value: *value, unit }));
    numbers
}

/// Sets the number with this index of those that `all` visits, and says whether there is one.
pub(super) fn setting(number: usize, to: f64, all: impl FnOnce(&mut NumberVisitor<'_>)) -> bool {
    let mut count = 0;
    all(&mut |_, _, value| {
        if count == number {
            *value = to;
        }
        count += 1;
    });
    number < count
}

impl EditShape {
    /// The numbers of the shape: coordinates of its corners, and sizes.
    pub fn numbers(&self) -> Vec<Number> {
        listed(|visit| of_shape(&mut self.clone(), visit))
    }

    /// The shape with one of its [numbers](Self::numbers) set; `None` when it has fewer.
    #[must_use]
    pub fn with_number(&self, number: usize, to: f64) -> Option<EditShape> {
        let mut shape = self.clone();
        setting(number, to, |visit| of_shape(&mut shape, visit)).then_some(shape)
    }
}

const METRES: &str = "m";
const RADIANS: &str = "rad";

/// Visits a point's coordinates, named with this behind them.
fn point(p: &mut Point2, which: &str, visit: &mut NumberVisitor<'_>) {
    visit(&format!("x{which}"), METRES, &mut p.x);
    visit(&format!("y{which}"), METRES, &mut p.y);
}

/// Visits the numbers of a pose.
pub(super) fn pose(pose: &mut Pose2, visit: &mut NumberVisitor<'_>) {
    visit("x", METRES, &mut pose.x);
    visit("y", METRES, &mut pose.y);
    visit("heading", RADIANS, &mut pose.theta);
}

/// Visits the ends of a door.
pub(super) fn of_door(door: &mut Door, visit: &mut NumberVisitor<'_>) {
    point(&mut door.a, " of the hinge", visit);
    point(&mut door.b, " of the end", visit);
}

/// Visits a corner and the way from it to the opposite one, so that a box that is moved keeps its size.
pub(super) fn sides(min: &mut Point2, max: &mut Point2, visit: &mut NumberVisitor<'_>) {
    let was = [min.x, min.y, tidy(max.x - min.x), tidy(max.y - min.y)];
    let mut now = was;
    for (name, value) in ["x", "y", "width", "height"].into_iter().zip(&mut now) {
        visit(name, METRES, value);
    }
    for axis in 0..2 {
        let (position, size) = (axis, axis + 2);
        if now[position] != was[position] || now[size] != was[size] {
            (min[axis], max[axis]) = (now[position], tidy(now[position] + now[size]));
        }
    }
}

/// Visits the numbers of a shape.
pub(super) fn of_shape(shape: &mut EditShape, visit: &mut NumberVisitor<'_>) {
    match shape {
        EditShape::Wall(points) | EditShape::Mark(points) => {
            let closed = points.len() > 2 && points.first() == points.last();
            let corners = points.len() - usize::from(closed);
            of_points(&mut points[..corners], visit);
            if closed {
                points[corners] = points[0];
            }
        }
        EditShape::Polygon(points) => of_points(points, visit),
        EditShape::Disc { centre, radius } => {
            point(centre, "", visit);
            visit("radius", METRES, radius);
        }
        EditShape::Box { min, max } => sides(min, max, visit),
        EditShape::Rounded { points, radius } => {
            visit("radius", METRES, radius);
            of_points(points, visit);
        }
        EditShape::Union(members) => members.iter_mut().for_each(|member| of_shape(member, visit)),
    }
}

fn of_points(points: &mut [Point2], visit: &mut NumberVisitor<'_>) {
    for (i, p) in points.iter_mut().enumerate() {
        point(p, &format!(" {}", i + 1), visit);
    }
}

/// Visits the coordinates of a robot's start and its sizes. A robot of which a size is changed has its own after that.
pub(super) fn of_robot(robot: &mut Resident, kinds: &Kinds, visit: &mut NumberVisitor<'_>) {
    let about = kinds.of(&robot.kind);
    for (i, q) in robot.start.iter_mut().enumerate() {
        let name = about.and_then(|about: &RobotKind| about.coordinates.get(i).copied());
        let unit = about.map_or("", |about| about.unit_of(i));
        visit(&name.map_or_else(|| format!("q{}", i + 1), str::to_owned), unit, q);
    }
    let Some(was) = robot.sizes.clone().or_else(|| Sizes::of_kind(&robot.kind)) else { return };
    let mut sizes = was.clone();
    let pulls = robot.start.len() > 3;
    for (name, number) in sizes.numbers_mut() {
        // the field is the same for all, and a trailer that is not there has no numbers
        let own = name.split_once('.').map_or(name.as_str(), |(_, own)| own);
        if pulls || !own.starts_with("trailer.") {
            let link = own.strip_prefix("lengths.").and_then(|i| i.parse::<usize>().ok());
            let words = link.map_or_else(|| own.replace(['.', '_'], " "), |i| format!("link {}", i + 1));
            visit(&words, Sizes::unit_of(&name), number);
        }
    }
    if sizes != was {
        robot.sizes = Some(sizes);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Editor, Op};
    use motion_lab_core::configuration::{CarSizes, Sizes};
    use motion_lab_core::geometry::{Aabb, Point2};
    use motion_lab_core::worlds::{Resident, World};

    fn named(editor: &Editor, name: &str) -> Vec<(String, f64)> {
        editor.numbers(name).into_iter().map(|number| (number.name, number.value)).collect()
    }

    fn set(editor: &mut Editor, name: &str, number: &str, to: f64) {
        let index = editor.numbers(name).iter().position(|known| known.name == number).expect(number);
        editor.apply(&Op::SetNumber { name: name.to_owned(), number: index, to }).unwrap();
        assert_eq!(editor.numbers(name)[index].value, to, "{name}: {number}");
    }

    fn pairs(numbers: &[(&str, f64)]) -> Vec<(String, f64)> {
        numbers.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    }

    #[test]
    fn a_box_that_is_moved_keeps_its_size_and_one_that_grows_its_corner() {
        // the block is Box(min: (0.5, 1), max: (1, 1.5)) in the world's file
        let mut editor = Editor::new(World::workbench());
        let block = |editor: &Editor| {
            let placed = editor.world().obstacle("the block").unwrap().placed().next().unwrap();
            Aabb::around(placed.core()).unwrap()
        };
        assert_eq!(named(&editor, "the block"), pairs(&[("x", 0.5), ("y", 1.0), ("width", 0.5), ("height", 0.5)]));
        set(&mut editor, "the block", "x", 0.1);
        set(&mut editor, "the block", "height", 0.3);
        assert_eq!(block(&editor), Aabb::new(Point2::new(0.1, 1.0), Point2::new(0.6, 1.3)));
        set(&mut editor, "the block", "y", -0.2);
        set(&mut editor, "the block", "width", 0.7);
        assert_eq!(block(&editor), Aabb::new(Point2::new(0.1, -0.2), Point2::new(0.8, 0.1)));
        // a box without a width is refused, and one number too many
        let refused = |editor: &mut Editor, number, to| {
            editor.apply(&Op::SetNumber { name: "the block".into(), number, to }).unwrap_err().to_string()
        };
        assert!(refused(&mut editor, 2, 0.0).contains("the smallest feature"));
        assert_eq!(refused(&mut editor, 4, 1.0), "\"the block\" has no number 4");
        assert_eq!(block(&editor), Aabb::new(Point2::new(0.1, -0.2), Point2::new(0.8, 0.1)));
    }

    #[test]
    fn discs_doors_places_and_closed_walls_have_their_numbers() {
        let mut editor = Editor::new(World::apartment());
        let table = "B's round table";
        assert_eq!(named(&editor, table), pairs(&[("x", 6.0), ("y", 6.75), ("radius", 0.5)]));
        set(&mut editor, table, "radius", 0.75);
        let door =
            [("x of the hinge", 5.5625), ("y of the hinge", 4.75), ("x of the end", 6.4375), ("y of the end", 4.75)];
        assert_eq!(named(&editor, "door B"), pairs(&door));
        set(&mut editor, "door B", "y of the end", 5.0);
        assert_eq!(editor.world().door("door B").unwrap().b, Point2::new(6.4375, 5.0));
        // the last corner of a closed wall is its first one
        set(&mut editor, "the outer wall", "y 1", -1.0);
        let wall: Vec<Point2> =
            editor.world().obstacle("the outer wall").unwrap().placed().flat_map(|p| p.core().to_vec()).collect();
        assert_eq!((wall.len(), wall[0], wall[7]), (8, Point2::new(0.0, -1.0), Point2::new(0.0, -1.0)));
        assert_eq!(editor.numbers("the outer wall").len(), 8, "four corners");
        let place = editor.world().places[0].name.clone();
        set(&mut editor, &place, "heading", 0.5);
        assert_eq!(editor.world().places[0].pose.theta, 0.5);
        assert!(editor.numbers("nobody").is_empty());
    }

    #[test]
    fn a_robot_has_its_start_and_its_sizes_which_become_its_own_when_one_is_set() {
        let mut world = World::lot();
        world.robots = vec![
            Resident::new("Hitch", "hitch", [6.5, 2.5, 0.2]),
            Resident::new("Puller", "hitch", [3.0, 2.5, 0.2, 0.5]),
        ];
        let mut editor = Editor::new(world);
        let names = |name: &str| editor.numbers(name).into_iter().map(|n| n.name).collect::<Vec<_>>();
        let car = ["x", "y", "theta", "wheelbase", "length", "width", "rear overhang", "max steer"];
        assert_eq!(names("Hitch"), car);
        assert_eq!(names("Puller").len(), 4 + 5 + 4, "a trailer has four numbers, and psi");
        let units: Vec<&str> = editor.numbers("Hitch").iter().map(|n| n.unit).collect();
        assert_eq!(units, ["m", "m", "rad", "m", "m", "m", "m", "rad"]);
        set(&mut editor, "Hitch", "theta", 0.25);
        assert_eq!(editor.world().robots[0].sizes, None, "its start only");
        set(&mut editor, "Hitch", "width", 1.8);
        let Some(Sizes::Car(CarSizes { width, length, wheelbase, .. })) = editor.world().robots[0].sizes else {
            panic!("a car")
        };
        assert_eq!((width, length, wheelbase), (1.8, 3.9, 2.5));
        assert_eq!(editor.world().robots[1].sizes, None, "nobody else's");
        let refused = editor.apply(&Op::SetNumber { name: "Puller".into(), number: 5, to: 3.0 }).unwrap_err();
        assert!(refused.to_string().contains("a length of 3 m does not reach"), "{refused}");
        let reach = Editor::new(World::workbench()).numbers("Reach").into_iter().map(|n| n.name);
        assert_eq!(reach.collect::<Vec<_>>(), ["theta1", "theta2", "base x", "base y", "link 1", "link 2", "radius"]);
    }

    #[test]
    fn the_world_has_bounds_and_a_name_and_doors_open() {
        let mut editor = Editor::new(World::apartment());
        let values: Vec<f64> = editor.bounds().iter().map(|n| n.value).collect();
        assert_eq!(values, [0.0, 0.0, 12.0, 8.0]);
        editor.apply(&Op::SetBounds { number: 2, to: 14.0 }).unwrap();
        editor.apply(&Op::SetBounds { number: 1, to: -1.0 }).unwrap();
        assert_eq!(editor.world().bounds, Aabb::new(Point2::new(0.0, -1.0), Point2::new(14.0, 7.0)));
        assert!(editor.apply(&Op::SetBounds { number: 4, to: 1.0 }).is_err());
        assert!(editor.apply(&Op::SetBounds { number: 3, to: -2.0 }).is_err(), "no plane to show");
        editor.apply(&Op::RenameWorld("Flat".into())).unwrap();
        assert_eq!(editor.world().name, "Flat");
        for open in [false, true] {
            editor.apply(&Op::SetOpen { name: "door B".into(), open }).unwrap();
            assert_eq!(editor.world().door("door B").unwrap().open, open);
        }
        let refused = editor.apply(&Op::SetOpen { name: "A's bed".into(), open: true }).unwrap_err();
        assert_eq!(refused.to_string(), "\"A's bed\" is no door");
    }
}
