//! The table's worlds as JSON, for programs in other languages.

use motion_lab::collision::Scene;
use motion_lab::geometry::Footprint;
use motion_lab::prelude::*;

use crate::crowd::warehouse;
use crate::queries::arm_scenes;
use crate::worlds::{CASES, draws, free_points, pieces, walls};

fn list<T>(items: impl IntoIterator<Item = T>, text: impl Fn(T) -> String) -> String {
    let items: Vec<String> = items.into_iter().map(text).collect();
    format!("[{}]", items.join(","))
}

fn ends(core: &[Point2]) -> String {
    format!("[{},{},{},{}]", core[0].x, core[0].y, core[1].x, core[1].y)
}

/// A crowd's shelves by their sides, and its robots at their starts.
fn crowd(robots: usize) -> String {
    let world = warehouse(robots);
    let scene = Scene::of_world(&world);
    let sides = pieces(&scene).flat_map(|piece| {
        let core = piece.core();
        (0..core.len()).map(|i| ends(&[core[i], core[(i + 1) % core.len()]]))
    });
    let segments = list(sides, |side| side);
    let robots_at = list(&world.robots, |r| format!("[{},{},{}]", r.start[0], r.start[1], r.start[2]));
    format!("\"{robots}\":{{\"range\":4,\"segments\":{segments},\"robots\":{robots_at}}}")
}

/// Walls and the poses of scans in them; boxes and arms among them.
pub fn print() {
    let scans = [(40, 8.0, 2.0, 4.0), (1_000, 12.6, 1.0, 12.0), (10_000, 40.0, 1.0, 12.0)].map(
        |(count, side, longest, range)| {
            let scene = walls(count, side, longest);
            let poses = free_points(&scene, 0.3 * side, 0.7 * side);
            let poses = list(poses, |p| format!("[{},{},{}]", p.x, p.y, p.theta));
            let segments = list(pieces(&scene), |piece| ends(piece.core()));
            format!("\"{count}\":{{\"range\":{range},\"segments\":{segments},\"poses\":{poses}}}")
        },
    );
    let arms = arm_scenes().into_iter().map(|(count, scene)| {
        let boxes = list(pieces(&scene), |piece| list(piece.core(), |p| format!("[{},{}]", p.x, p.y)));
        let (mut s, arm) = (draws("arm"), Reach::<2>::workbench());
        let arms: Vec<Footprint> =
            (0..CASES).map(|_| arm.footprint(&arm.sample(Point2::origin(), Point2::origin(), &mut s))).collect();
        let arms = list(&arms, |arm| list(arm.parts(), |part| ends(part.placed().core())));
        format!("\"{count}\":{{\"boxes\":{boxes},\"arms\":{arms}}}")
    });
    let arms: Vec<String> = arms.collect();
    let crowds: Vec<String> = [10, 100, 1000].map(crowd).into();
    println!(
        "{{\"scans\":{{{}}},\"arms\":{{{}}},\"crowds\":{{{}}}}}",
        scans.join(","),
        arms.join(","),
        crowds.join(",")
    );
}
