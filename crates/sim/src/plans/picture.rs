//! The pictures of a plan: in the workspace, and in a slice of the configuration space.

use super::drawn::{Drawn, DrawnBarrier};
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _};
use motion_lab_core::cspace::{BarrierCell, Slice, lines_through};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::wrap;
use motion_lab_core::picture::{
    self, Anchor, Dash, Drawing, Face, Fill, Gait, Glyph, Item, Line, RobotDrawing, Role, chains, footprint, outline,
    polygon_of, scan,
};
use motion_lab_core::planning::{LeavePoint, Sensed};
use motion_lab_core::robots::{AnyRobot, Robot};

/// The items of a plan over a world: the growth as the ways of the robot's [reference
/// point](AnyRobot::reference), the robot along the path, at the goal and at the start, what the last rejected motion
/// hits, for a robot that walks by its sensor where it is and what it reads there, and what a barrier rests on.
pub fn workspace_items(robot: &AnyRobot, drawn: &Drawn) -> Vec<Item> {
    let way = |motion: &Vec<AnyConfiguration>| motion.iter().map(|q| robot.reference(q)).collect::<Vec<Point2>>();
    let mut items = vec![growth(drawn.edges.iter().map(way).collect())];
    for (i, q) in drawn.places().iter().enumerate() {
        items.extend(footprint(&format!("on the way/{i}"), "on the way", &robot.footprint(q), Role::Path, 0.12));
    }
    items.extend(drawn.barrier.as_ref().map(in_the_way));
    let [start, goal] = drawn.ends;
    items.extend(footprint("goal", "the goal", &robot.footprint(&goal), Role::Goal, 0.4));
    items.extend(faced("start", "the start", robot, &start));
    items.extend(rivals(drawn, |path| vec![way(path)]));
    if !drawn.path.is_empty() {
        items.push(path(vec![way(&drawn.path)]));
    }
    if let Some(rejected) = &drawn.rejected {
        items.push(refused(vec![way(&rejected.way)]));
        items.extend(footprint("rejected", "where it hits", &robot.footprint(&rejected.at), Role::Goal, 0.25));
        let cross = rejected.witness.map(|w| Drawing::Mark { at: w.on_obstacle, glyph: Glyph::Cross, radius_px: 5.0 });
        items.extend(cross.map(|cross| Item::new("rejected/witness", "what it hits", Role::Goal, cross)));
    }
    if let Some(sensed) = &drawn.sensed {
        items.extend(sensed_items(robot, &drawn.ends[0], sensed));
    }
    items
}

/// The robot at a configuration, with its wheels or joints.
fn faced(id: &str, name: &str, robot: &AnyRobot, q: &AnyConfiguration) -> Vec<Item> {
    let mut items = picture::robot(&RobotDrawing {
        name: id,
        footprint: &robot.footprint(q),
        heading: robot.heading(q),
        model: Some(*robot),
        gait: Gait::default(),
        in_contact: false,
    });
    for item in &mut items {
        item.id = item.id.trim_start_matches("robot/").to_owned();
        item.name = name.to_owned();
    }
    items
}

/// The robot where it is, what its sensor reads there, and where it left boundaries.
fn sensed_items(robot: &AnyRobot, start: &AnyConfiguration, sensed: &Sensed) -> Vec<Item> {
    let Sensed { at, ranges, leave_points } = sensed;
    let mut items = vec![scan("readings", "what its sensor reads", &Pose2::new(at.x, at.y, 0.0), ranges)];
    items.extend(faced("present", "where it is", robot, &start.with(0, at.x).with(1, at.y)));
    for (i, point) in leave_points.iter().enumerate() {
        items.extend(leave_point_items(i + 1, point));
    }
    items
}

/// A leave point, and where the boundary of its round truly comes nearest to the goal.
fn leave_point_items(round: usize, point: &LeavePoint) -> Vec<Item> {
    // the ring is larger, so that it is seen about a dot at the same place
    let mark = |at, glyph, radius_px| Drawing::Mark { at, glyph, radius_px };
    let label =
        |at, text: String, anchor| Drawing::Label { at, text, anchor, face: Face::Sans, size_px: 12.0, plate: true };
    let mut items = Vec::new();
    if let Some(nearest) = point.nearest {
        let words = format!("nearest to the goal in round {round}");
        items.push(
            Item::new(format!("nearest/{round}"), words, Role::Witness, mark(nearest, Glyph::Ring, 7.5))
                .filled(Fill::Tint(1.0)),
        );
        if point.is_too_far() {
            let off = Drawing::segment(point.at, nearest);
            let line = Line::solid(1.0).dashed(Dash::Dashed);
            items.push(Item::new(format!("misjudged/{round}"), "how far off", Role::Witness, off).stroked(line));
            let text = label(nearest, format!("nearest {round}"), Anchor::Above);
            items.push(Item::new(format!("nearest/{round}/label"), "", Role::Witness, text));
        }
    }
    items.push(Item::new(
        format!("left/{round}"),
        format!("round {round}: {point}"),
        Role::Path,
        mark(point.at, Glyph::Dot, 4.0),
    ));
    let text = label(point.at, format!("left {round}"), Anchor::Below);
    items.push(Item::new(format!("left/{round}/label"), "", Role::Path, text));
    items
}

/// The obstacles that the cells of a barrier name.
fn in_the_way(barrier: &DrawnBarrier) -> Item {
    let shapes = barrier.shapes.iter().map(polygon_of);
    let (lines, pieces): (Vec<_>, Vec<_>) = shapes.partition(|shape| shape.len() == 2);
    let lines: Vec<(Point2, Point2)> = lines.iter().map(|line| (line[0], line[1])).collect();
    let mut edges = chains(&lines);
    edges.extend(outline(&pieces));
    Item::new("barrier", "what is in the way", Role::Goal, Drawing::Region { pieces, outline: edges })
        .filled(Fill::Tint(0.25))
        .stroked(Line::solid(3.0))
}

/// The cells of a barrier that the slice meets, each where it does.
fn barrier_in(slice: &Slice, barrier: &DrawnBarrier) -> Item {
    let (axes, held) = (slice.axes(), slice.at([0.0; 2]).coordinates());
    let holds = |cell: &BarrierCell, i: usize| wrap(held[i] - cell.middle[i]).abs() <= cell.half[i];
    // beside the slice's own coordinates a cell has angles alone
    let meets = |cell: &&BarrierCell| (0..cell.middle.len()).all(|i| axes.contains(&i) || holds(cell, i));
    let square = |cell: &BarrierCell| {
        let at = |x: f64, y: f64| {
            let [x, y] = [(axes[0], x), (axes[1], y)].map(|(i, side)| cell.middle[i] + side * cell.half[i]);
            Point2::new(x, y)
        };
        vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
    };
    let pieces: Vec<Vec<Point2>> = barrier.cells.iter().filter(meets).map(square).collect();
    let edges = outline(&pieces);
    Item::new(
        "barrier",
        "cells that part the start from the goal",
        Role::Goal,
        Drawing::Region { pieces, outline: edges },
    )
    .filled(Fill::Tint(0.6))
    .stroked(Line::solid(1.5))
}

/// The items of a plan over the cells of a slice: each configuration is its point. Of a barrier of more dimensions what
/// the slice meets.
pub fn space_items(slice: &Slice, drawn: &Drawn) -> Vec<Item> {
    let lines = |motion: &Vec<AnyConfiguration>| lines_through(slice, motion).unwrap_or_default();
    let mut items: Vec<Item> = drawn.barrier.iter().map(|barrier| barrier_in(slice, barrier)).collect();
    items.push(growth(drawn.edges.iter().flat_map(lines).collect()));
    items.extend(rivals(drawn, lines));
    if !drawn.path.is_empty() {
        items.push(path(lines(&drawn.path)));
    }
    if let Some(rejected) = &drawn.rejected {
        items.push(refused(lines(&rejected.way)));
        let cross = Drawing::Mark { at: point(slice, &rejected.at), glyph: Glyph::Cross, radius_px: 5.0 };
        items.push(Item::new("rejected/at", "where it hits", Role::Goal, cross));
    }
    let ends = [("goal", "the goal", Role::Goal), ("start", "the start", Role::Robot)];
    for ((id, name, role), q) in ends.into_iter().zip([&drawn.ends[1], &drawn.ends[0]]) {
        let dot = Drawing::Mark { at: point(slice, q), glyph: Glyph::Handle, radius_px: 5.5 };
        items.push(Item::new(id, format!("{name}: {q}"), role, dot));
    }
    items
}

fn point(slice: &Slice, q: &AnyConfiguration) -> Point2 {
    Point2::from(slice.point(q))
}

fn growth(lines: Vec<Vec<Point2>>) -> Item {
    let drawing = Drawing::Region { pieces: Vec::new(), outline: lines };
    Item::new("growth", "what the planner has grown", Role::Muted, drawing).stroked(Line::solid(0.8))
}

fn path(lines: Vec<Vec<Point2>>) -> Item {
    let drawing = Drawing::Region { pieces: Vec::new(), outline: lines };
    Item::new("path", "the path", Role::Path, drawing).stroked(Line::solid(2.5))
}

/// The paths of the other planners of a race: of the first of them dashed, of the others dotted, whoever has one yet.
fn rivals(drawn: &Drawn, lines: impl Fn(&Vec<AnyConfiguration>) -> Vec<Vec<Point2>>) -> Vec<Item> {
    let item = |(i, path): (usize, &Vec<AnyConfiguration>)| {
        let drawing = Drawing::Region { pieces: Vec::new(), outline: lines(path) };
        let line = Line::solid(1.8).dashed(if i == 0 { Dash::Dashed } else { Dash::Dotted });
        Item::new(format!("rival/{i}"), "the path of another planner", Role::Path, drawing).stroked(line)
    };
    drawn.rivals.iter().enumerate().filter(|(_, path)| !path.is_empty()).map(item).collect()
}

fn refused(lines: Vec<Vec<Point2>>) -> Item {
    let drawing = Drawing::Region { pieces: Vec::new(), outline: lines };
    Item::new("rejected/way", "a motion that is not free", Role::Goal, drawing)
        .stroked(Line::solid(1.5).dashed(Dash::Dashed))
}

#[cfg(test)]
mod tests {
    use super::super::{PlannerName, Task};
    use super::*;
    use motion_lab_core::collision::{Checker, Scene};
    use motion_lab_core::planning::Bounds;
    use motion_lab_core::random::Seed;
    use motion_lab_core::robots::AnyRobot;
    use motion_lab_core::worlds::World;

    #[test]
    fn a_path_is_over_the_cells_where_there_is_one() {
        let at = |q: [f64; 2]| AnyRobot::of_kind("reach", &q).unwrap();
        let (arm, start) = at([0.0, 0.0]);
        let goal = at([1.0, 0.5]).1;
        let slice = Slice::through(&Checker::new(Scene::workbench(), arm), &start).unwrap();
        for way in [vec![], vec![start, goal]] {
            let (path, corners) = (way.clone(), way.clone());
            let drawn = Drawn { path, corners, ..Drawn::of_ends([start, goal]) };
            let items = space_items(&slice, &drawn);
            let outlines = items.iter().filter(|item| item.id == "path").map(|item| match &item.drawing {
                Drawing::Region { outline, .. } => outline.clone(),
                other => panic!("{other:?}"),
            });
            let line = vec![vec![Point2::new(0.0, 0.0), Point2::new(1.0, 0.5)]];
            assert_eq!(outlines.collect::<Vec<_>>(), if way.is_empty() { vec![] } else { vec![line] });
        }
    }

    #[test]
    fn a_rival_keeps_its_line_whoever_has_a_path() {
        let at = |q: [f64; 2]| AnyRobot::of_kind("reach", &q).unwrap();
        let (arm, start) = at([0.0, 0.0]);
        let way = vec![start, at([1.0, 0.5]).1];
        let slice = Slice::through(&Checker::new(Scene::workbench(), arm), &start).unwrap();
        for (have, dashes) in [
            ([true, true], vec![Dash::Dashed, Dash::Dotted]),
            ([true, false], vec![Dash::Dashed]),
            ([false, true], vec![Dash::Dotted]),
            ([false, false], vec![]),
        ] {
            let rivals = have.map(|has| if has { way.clone() } else { vec![] }).into();
            let drawn = Drawn { rivals, ..Drawn::of_ends([start, way[1]]) };
            for items in [workspace_items(&arm, &drawn), space_items(&slice, &drawn)] {
                let drawn = items.iter().filter(|item| item.id.starts_with("rival/"));
                let drawn: Vec<Dash> = drawn.filter_map(|item| item.line.map(|line| line.dash)).collect();
                assert_eq!(drawn, dashes, "{have:?}");
            }
        }
    }

    /// The corners of the pieces of a picture's barrier.
    fn barrier_of(items: &[Item]) -> Vec<Vec<Point2>> {
        let lit = items.iter().filter(|item| item.id == "barrier").map(|item| match &item.drawing {
            Drawing::Region { pieces, .. } => pieces.clone(),
            other => panic!("{other:?}"),
        });
        lit.flatten().collect()
    }

    #[test]
    fn a_barrier_is_lit_where_the_slice_meets_it_with_the_shapes_that_it_rests_on() {
        let world = "World(version: 1, name: \"hall\", bounds: (min: (0, 0), max: (24, 4)), obstacles: [
            (name: \"block\", shape: Box(min: (7, -3), max: (17, 7))),
            (name: \"aside\", shape: Disc(center: (2, 3.9), radius: 0.05))])";
        let world = World::parse("hall.ron", world).unwrap();
        let ends = [3.0, 20.0].map(|x| AnyRobot::of_kind("hitch", &[x, 2.0, 0.0]).unwrap());
        let (car, [start, goal]) = (ends[0].0, ends.map(|(_, q)| q));
        let task = Task::new("Hitch", car, world, [start, goal]);
        let mut attempt = task.attempt(PlannerName::CellDecomposition, Seed(1)).unwrap();
        assert!(attempt.drawn().barrier.is_none(), "nothing is proven yet");
        assert!(attempt.solve(&Bounds::default()).is_err());
        let drawn = attempt.drawn();
        let block = barrier_of(&workspace_items(&car, &drawn));
        assert_eq!(block.len(), 1, "the disc is not in the way");
        assert!(block[0].iter().all(|p| [7.0, 17.0].contains(&p.x) && [-3.0, 7.0].contains(&p.y)), "{block:?}");
        // at each heading the cells go from side to side of the world, and lie where the car is in the block
        let all = &drawn.barrier.as_ref().unwrap().cells;
        for heading in [0.1, 1.0, 3.1] {
            let slice =
                Slice::through(&Checker::new(Scene::of_world(&task.world), car), &start.with(2, heading)).unwrap();
            let cells = barrier_of(&space_items(&slice, &drawn));
            let meets = |cell: &&BarrierCell| (heading - cell.middle[2]).abs() < cell.half[2];
            assert_eq!(cells.len(), all.iter().filter(meets).count(), "at {heading}");
            let tall: f64 = cells.iter().map(|cell| cell[2].y - cell[0].y).sum();
            assert!(
                (tall - 4.0).abs() < 1e-9 && cells.iter().all(|cell| cell[0].x > 3.0 && cell[1].x < 21.0),
                "{cells:?}"
            );
        }
    }
}
