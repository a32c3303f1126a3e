//! Scans: each ray through the tree, with the best so far as its limit.
//!
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/partitioning/struct.Bvh.html#method.cast_ray>

use std::rc::Rc;

use parry2d_f64::math::Vector;
use parry2d_f64::query::{Ray, RayCast};

use super::obstacles::Obstacles;
use super::{Contender, Task};

struct Scan {
    obstacles: Rc<Obstacles>,
    range: f64,
    /// The rays of each case.
    fans: Vec<Vec<Ray>>,
    ranges: Vec<f64>,
}

impl Contender for Scan {
    fn name(&self) -> &'static str {
        "parry"
    }

    fn work(&mut self, case: usize) -> f64 {
        let Obstacles { segments, pieces } = &*self.obstacles;
        for (ray, range) in self.fans[case].iter().zip(&mut self.ranges) {
            let hit =
                pieces.tree.cast_ray(ray, self.range, |i, best| segments[i as usize].cast_local_ray(ray, best, true));
            *range = hit.map_or(f64::INFINITY, |(_, range)| range);
        }
        self.ranges[0]
    }

    fn answers(&mut self, case: usize) -> Vec<f64> {
        self.work(case);
        self.ranges.clone()
    }
}

/// Settings: the range. A case: the place, then the direction of each ray.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    let fan = |case: &Vec<f64>| -> Vec<Ray> {
        let from = Vector::new(case[0], case[1]);
        case[2..].chunks(2).map(|d| Ray::new(from, Vector::new(d[0], d[1]))).collect()
    };
    let fans: Vec<Vec<Ray>> = task.cases.iter().map(fan).collect();
    let ranges = vec![0.0; fans[0].len()];
    vec![Box::new(Scan { obstacles: Rc::new(Obstacles::new(task)), range: task.settings[0], fans, ranges })]
}
