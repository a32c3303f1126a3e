//! What a world file may say and a world still should not: residents that touch something, obstacles out of sight.

use motion_lab::collision::{Collision, Scene, Surroundings};
use motion_lab::geometry::{Footprint, Placed, Point2};
use motion_lab::robots::{AnyRobot, Robot};
use motion_lab::worlds::World;

/// So many things are told of one world at the most.
const MOST: usize = 10;

/// What is wrong with the world, each by name: residents that touch an obstacle or one another at their starts, obstacles of which
/// nothing lies within the bounds. Robots of a program's own kinds are not looked at.
pub fn problems(world: &World) -> Vec<String> {
    let scene = Scene::of_world(world);
    let mut residents: Vec<(&str, Footprint)> = Vec::new();
    for resident in &world.robots {
        if let Some((robot, q)) = AnyRobot::of_kind(&resident.kind, &resident.start) {
            residents.push((&resident.name, robot.footprint(&q)));
        }
    }
    let touched = residents.iter().filter_map(|(name, footprint)| {
        let witness = scene.witness(footprint).filter(|w| w.dist == 0.0)?;
        Some(format!("{name:?} starts in contact with {:?}", scene.obstacle_name(witness.obstacle)?))
    });
    touched.chain(neighbours(world, &residents)).chain(outside(world)).take(MOST).collect()
}

/// The residents that touch one another: those are compared whose boxes overlap, found along the axis on which they lie farther apart.
fn neighbours(world: &World, residents: &[(&str, Footprint)]) -> Vec<String> {
    let nothing = Scene::empty(world.bounds);
    let boxes: Vec<(Point2, Point2, usize)> = (0..residents.len())
        .filter_map(|i| around(residents[i].1.parts().iter().map(|p| p.placed())).map(|(low, high)| (low, high, i)))
        .collect();
    // a pair overlaps along both axes, so the axis along which fewer do is the one to go along
    let pairs = [0, 1].map(|axis| overlaps(&boxes, axis));
    let mut spans: Vec<(f64, f64, usize)> = {
        let axis = usize::from(pairs[1] < pairs[0]);
        boxes.iter().map(|(low, high, i)| (low[axis], high[axis], *i)).collect()
    };
    spans.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut found = Vec::new();
    for (k, (_, right, i)) in spans.iter().enumerate() {
        let others: Vec<Placed> = residents[*i].1.parts().iter().map(|p| p.placed().clone()).collect();
        let near = Surroundings { scene: &nothing, others: &others };
        for (_, _, j) in spans[k + 1..].iter().take_while(|(left, ..)| left <= right) {
            if near.intersects(&residents[*j].1) {
                let (first, second) = (residents[*i.min(j)].0, residents[*i.max(j)].0);
                found.push(format!("{first:?} and {second:?} touch at their starts"));
                if found.len() == MOST {
                    return found;
                }
            }
        }
    }
    found
}

/// How many pairs of boxes overlap along an axis, by their sorted ends.
fn overlaps(boxes: &[(Point2, Point2, usize)], axis: usize) -> u64 {
    let mut lows: Vec<f64> = boxes.iter().map(|b| b.0[axis]).collect();
    let mut highs: Vec<f64> = boxes.iter().map(|b| b.1[axis]).collect();
    lows.sort_by(f64::total_cmp);
    highs.sort_by(f64::total_cmp);
    // each box overlaps those that begin before it ends, less those that ended before it began
    let (mut ended, mut pairs) = (0, 0);
    for (begun, low) in lows.iter().enumerate() {
        while highs[ended] < *low {
            ended += 1;
        }
        pairs += (begun - ended) as u64;
    }
    pairs
}

/// The obstacles of which nothing lies within the bounds.
fn outside(world: &World) -> impl Iterator<Item = String> {
    let (min, max) = (world.bounds.min, world.bounds.max);
    world.obstacles.iter().filter_map(move |obstacle| {
        let placed: Vec<Placed> = obstacle.pieces.iter().map(|(pose, shape)| shape.place(pose)).collect();
        let (low, high) = around(placed.iter())?;
        let away = high.x < min.x || low.x > max.x || high.y < min.y || low.y > max.y;
        away.then(|| format!("{:?} lies outside the bounds", obstacle.name))
    })
}

/// The box around some shapes.
fn around<'a>(shapes: impl Iterator<Item = &'a Placed>) -> Option<(Point2, Point2)> {
    shapes.map(Placed::bounds).reduce(|(low, high), (l, h)| {
        let less = |a: f64, b: f64| if b < a { b } else { a };
        let more = |a: f64, b: f64| if b > a { b } else { a };
        (Point2::new(less(low.x, l.x), less(low.y, l.y)), Point2::new(more(high.x, h.x), more(high.y, h.y)))
    })
}
