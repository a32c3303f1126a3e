//! SVG drawings as other programs write them: each kind of thing by small drawings with known answers.

mod clips;
mod coordinates;
mod fills;
mod masks;
mod paint;
mod reach;
mod round;
mod shapes;
mod styles;
mod transforms;
mod units;

use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::worlds::World;
use motion_lab_import::{Imported, SvgOptions};

/// A drawing of 20 x 10 units that holds this.
fn sheet(inside: &str) -> String {
    format!("<svg xmlns='http://www.w3.org/2000/svg' width='20' height='10' viewBox='0 0 20 10'>\n{inside}\n</svg>")
}

fn import(text: &str) -> Imported {
    motion_lab_import::svg("d.svg", text, "d", SvgOptions::default()).unwrap()
}

/// What a drawing of 20 x 10 units becomes.
fn drawn(inside: &str) -> Imported {
    import(&sheet(inside))
}

/// The box around an obstacle: least and greatest x and y, to the last bit.
#[track_caller]
fn extent(world: &World, name: &str) -> [f64; 4] {
    let obstacle = world.obstacle(name).unwrap_or_else(|| panic!("no {name}: {:?}", names(world)));
    let boxes = obstacle.placed().map(|placed| placed.core().to_vec()).collect::<Vec<_>>().concat();
    let least = |of: fn(&Point2) -> f64| boxes.iter().map(of).fold(f64::INFINITY, motion_lab_core::num::lesser);
    let most = |of: fn(&Point2) -> f64| boxes.iter().map(of).fold(f64::NEG_INFINITY, motion_lab_core::num::greater);
    [least(|p| p.x), least(|p| p.y), most(|p| p.x), most(|p| p.y)]
}

fn names(world: &World) -> Vec<&str> {
    world.obstacles.iter().map(|obstacle| obstacle.name.as_str()).collect()
}

/// The area of an obstacle's polygons, by the shoelace formula.
fn area(world: &World, name: &str) -> f64 {
    let ring_area = |ring: &[Point2]| -> f64 {
        let n = ring.len();
        (0..n).map(|i| (ring[i], ring[(i + 1) % n])).map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum()
    };
    world.obstacle(name).unwrap().placed().map(|placed| ring_area(placed.core())).sum()
}

/// Whether a box lies within another, for tests that ask no more.
fn lies_in(inner: &Aabb, outer: [f64; 4]) -> bool {
    inner.min.x >= outer[0] && inner.min.y >= outer[1] && inner.max.x <= outer[2] && inner.max.y <= outer[3]
}
