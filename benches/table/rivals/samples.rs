//! Ways to decide an edge of a robot whose parts turn.
//!
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/query/fn.cast_shapes_nonlinear.html> for motions that turn, and
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/query/fn.intersection_test.html> for samples.

use std::rc::Rc;

use parry2d_f64::bounding_volume::BoundingVolume;
use parry2d_f64::math::Pose;
use parry2d_f64::query::{self, NonlinearRigidMotion};
use parry2d_f64::shape::Shape;

use super::obstacles::Obstacles;
use super::pieces::ParryShape;
use super::{By, Contender};

/// The least number of a sample that meets something, of 0 to `last`; `None` if none does. Samples are visited by
/// bisection, ends first, so that contacts are found early. With `any`, the first one found ends the search.
pub fn bisected(last: usize, any: bool, mut meets: impl FnMut(usize) -> bool) -> Option<usize> {
    if meets(0) {
        return Some(0);
    }
    let mut first = meets(last).then_some(last);
    let mut stride = last.next_power_of_two();
    while stride > 1 && !(any && first.is_some()) {
        for i in (stride / 2..first.unwrap_or(last)).step_by(stride) {
            if meets(i) {
                first = Some(i);
                break;
            }
        }
        stride /= 2;
    }
    first
}

/// The time of the first contact of a shape within a motion from 0 to `limit`; with `any`, of some contact.
pub fn first_contact(
    obstacles: &Obstacles,
    shape: &dyn Shape,
    motion: &NonlinearRigidMotion,
    limit: f64,
    any: bool,
) -> Option<f64> {
    let (begin, end): (Pose, Pose) = (motion.start, motion.position_at_time(limit));
    // a point's way lies within the sagitta of its arc from the two places
    let reach =
        shape.compute_local_aabb().vertices().iter().map(|v| v.distance(motion.local_center)).fold(0.0, f64::max);
    let sagitta = 0.125 * reach * (motion.angvel * limit) * (motion.angvel * limit);
    let around = shape.compute_aabb(&begin).merged(&shape.compute_aabb(&end)).loosened(sagitta);
    let mut first = None;
    for i in obstacles.pieces.tree.intersect_aabb(&around) {
        let ParryShape { pose: at, shape: obstacle } = &obstacles.pieces.shapes[i as usize];
        let still = NonlinearRigidMotion::constant_position(*at);
        let until = first.unwrap_or(limit);
        let hit = query::cast_shapes_nonlinear(motion, shape, &still, &**obstacle, 0.0, until, true);
        if let Ok(Some(hit)) = hit {
            first = Some(hit.time_of_impact);
            if any {
                break;
            }
        }
    }
    first
}

/// A robot, its obstacles, and its ways to decide an edge.
pub trait Mover {
    /// An edge as the robot takes it.
    type Edge;

    /// The number of the last sample of an edge.
    fn samples(edge: &Self::Edge) -> usize;

    /// Whether the robot meets something at a parameter of an edge.
    fn meets(&self, edge: &Self::Edge, s: f64) -> bool;

    /// The parameter of the first contact by casts; with `any`, of some contact.
    fn cast(&self, edge: &Self::Edge, any: bool) -> Option<f64>;
}

/// Both ways to decide the edges of a robot.
pub fn contenders_of<M: Mover + 'static>(mover: M, edges: Vec<M::Edge>, any: bool) -> Vec<Box<dyn Contender>> {
    let sampled = Rc::new((mover, edges));
    let cast = Rc::clone(&sampled);
    vec![
        Box::new(By {
            name: "parry, 2 mm samples",
            ask: move |case: usize| {
                let (mover, edge) = (&sampled.0, &sampled.1[case]);
                let last = M::samples(edge);
                let first = bisected(last, any, |i| mover.meets(edge, i as f64 / last as f64));
                first.map_or(f64::INFINITY, |i| i as f64 / last as f64)
            },
        }),
        Box::new(By {
            name: "parry, nonlinear cast",
            ask: move |case: usize| cast.0.cast(&cast.1[case], any).unwrap_or(f64::INFINITY),
        }),
    ]
}
