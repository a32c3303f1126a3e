//! Rectangles by parry's test of two cuboids, on poses that were prepared.
//!
//! <https://docs.rs/parry2d-f64/0.31.1/parry2d_f64/query/details/fn.intersection_test_cuboid_cuboid.html>

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::details::intersection_test_cuboid_cuboid;
use parry2d_f64::shape::Cuboid;

use super::{Contender, Task};

struct Rectangles(Vec<(Pose, Cuboid)>);

impl Rectangles {
    fn touch(&self, a: usize, b: usize) -> bool {
        let ((at, one), (there, other)) = (&self.0[a], &self.0[b]);
        intersection_test_cuboid_cuboid(&at.inv_mul(there), one, other)
    }
}

impl Contender for Rectangles {
    fn name(&self) -> &'static str {
        "parry"
    }

    fn work(&mut self, case: usize) -> f64 {
        (0..self.0.len()).filter(|&i| self.touch(case, i)).count() as f64
    }

    fn answers(&mut self, case: usize) -> Vec<f64> {
        (0..self.0.len()).map(|i| f64::from(u8::from(self.touch(case, i)))).collect()
    }
}

/// A case: x, y and heading of a rectangle's middle, and its half sides. Each is tested against all.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    let cuboid = |c: &Vec<f64>| (Pose::new(Vector::new(c[0], c[1]), c[2]), Cuboid::new(Vector::new(c[3], c[4])));
    vec![Box::new(Rectangles(task.cases.iter().map(cuboid).collect()))]
}
