//! `Boxes`, the boxes around many shapes in structure-of-arrays order.

use super::segments::LANES;
use crate::geometry::Point2;

type Lanes = [f64; LANES];

/// Axis-parallel boxes in eights; empty places hold boxes that hold nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes {
    eights: Vec<Eight>,
}

#[derive(Clone, Copy, Debug)]
struct Eight {
    least: [Lanes; 2],
    greatest: [Lanes; 2],
}

impl Boxes {
    /// The boxes with these least and greatest corners.
    pub(super) fn new(corners: impl Iterator<Item = (Point2, Point2)>) -> Self {
        let mut eights: Vec<Eight> = Vec::new();
        for (i, (min, max)) in corners.enumerate() {
            let k = i % LANES;
            if k == 0 {
                eights.push(Eight { least: [[f64::INFINITY; LANES]; 2], greatest: [[f64::NEG_INFINITY; LANES]; 2] });
            }
            if let Some(eight) = eights.last_mut() {
                for axis in 0..2 {
                    (eight.least[axis][k], eight.greatest[axis][k]) = (min[axis], max[axis]);
                }
            }
        }
        Boxes { eights }
    }

    /// The numbers of the boxes that hold the point.
    pub(super) fn around(&self, p: Point2) -> impl Iterator<Item = usize> {
        self.eights.iter().enumerate().flat_map(move |(i, eight)| {
            let mut holds = 0_u32;
            for k in 0..LANES {
                let inside = (eight.least[0][k] <= p.x)
                    & (p.x <= eight.greatest[0][k])
                    & (eight.least[1][k] <= p.y)
                    & (p.y <= eight.greatest[1][k]);
                holds |= u32::from(inside) << k;
            }
            (0..LANES).filter(move |k| holds >> k & 1 == 1).map(move |k| LANES * i + k)
        })
    }
}
