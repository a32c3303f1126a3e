//! `Rectangles`, many rectangles of which one asks which touch another.

use multiversion::multiversion;

use super::boundary::segments::LANES;
use super::narrow::pair::touch;
use crate::geometry::{Placed, Point2, Pose2, Shape, largest_coordinate};
use crate::num::greater;

/// Placed rectangles in structure-of-arrays order: which of them touch another is told for eight at a time.
///
/// The answers are exact for the placed rectangles, whose corners are rounded: separating axes decide where they plainly do, exact
/// predicates elsewhere. A rectangle that is not finite touches everything.
///
/// ```
/// use motion_lab::prelude::*;
/// use motion_lab::collision::Rectangles;
/// let square = |x: f64| (Pose2::new(x, 0.0, 0.0), Point2::new(-0.5, -0.5), Point2::new(0.5, 0.5));
/// let three = Rectangles::new([square(0.0), square(1.0), square(2.5)]);
/// let mut touched = Vec::new();
/// three.touched_by(square(0.0), &mut touched);
/// assert_eq!(touched, [true, true, false]); // sides that touch are contact
/// ```
#[derive(Clone, Debug)]
pub struct Rectangles {
    placed: Vec<Placed>,
    /// In whole eights, filled up with rectangles of no size.
    arrays: [Vec<f64>; 6],
    /// No coordinate is larger.
    size: f64,
}

/// The centre of a rectangle and the two vectors from it to the middles of its sides.
type Frame = [f64; 6];

fn frame(placed: &Placed) -> Frame {
    match placed.core() {
        [a, b, c, d] => {
            let (u, v) = ((b - a) * 0.5, (d - a) * 0.5);
            [0.5 * (a.x + c.x), 0.5 * (a.y + c.y), u.x, u.y, v.x, v.y]
        }
        _ => [f64::NAN; 6],
    }
}

fn place((pose, min, max): (Pose2, Point2, Point2)) -> Placed {
    Shape::Rectangle { min, max }.place(&pose)
}

impl Rectangles {
    /// Rectangles given by their frames and corners (least, greatest) in those frames, as [`Footprint::rects`](crate::geometry::Footprint::rects)
    /// takes them.
    pub fn new(rects: impl IntoIterator<Item = (Pose2, Point2, Point2)>) -> Self {
        let placed: Vec<Placed> = rects.into_iter().map(place).collect();
        let mut arrays: [Vec<f64>; 6] = Default::default();
        let frames: Vec<Frame> = placed.iter().map(frame).collect();
        for (k, array) in arrays.iter_mut().enumerate() {
            array.extend(frames.iter().map(|frame| frame[k]));
            array.resize(frames.len().next_multiple_of(LANES), 0.0);
        }
        let size = largest_coordinate(&placed);
        Rectangles { placed, arrays, size }
    }

    /// The number of rectangles.
    pub fn len(&self) -> usize {
        self.placed.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.placed.is_empty()
    }

    /// Writes for each rectangle, in order, whether it touches this one: `touched` is cleared first.
    pub fn touched_by(&self, rect: (Pose2, Point2, Point2), touched: &mut Vec<bool>) {
        let other = place(rect);
        // Corners are rounded to ulps of the largest coordinate; what is made of them here is off by some ulps more, and so is a
        // product with a side by as many times its length, itself no longer than four such coordinates.
        let size = greater(self.size, largest_coordinate([&other]));
        let doubt = 256.0 * f64::EPSILON * size * size;
        touched.clear();
        touched.resize(self.placed.len().next_multiple_of(LANES), false);
        let undecided = decide(self.arrays.each_ref().map(Vec::as_slice), &frame(&other), doubt, touched);
        touched.truncate(self.placed.len());
        if undecided {
            for (touched, placed) in touched.iter_mut().zip(&self.placed) {
                *touched = touch(placed, &other);
            }
        }
    }
}

/// Decides by separating axes which rectangles touch the other; true where for one they do not decide.
///
/// Along the half-side `u` of one the centres are `|d . u|` apart, and the two reach `u . u` and the sum of `|u . w|` over the half-sides w of
/// the other.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn decide(arrays: [&[f64]; 6], other: &Frame, doubt: f64, touched: &mut [bool]) -> bool {
    let [cx, cy, ux, uy, vx, vy] = arrays.map(|array| array.as_chunks::<LANES>().0);
    let [ox, oy, px, py, qx, qy] = *other;
    let (pp, qq) = (px * px + py * py, qx * qx + qy * qy);
    let mut undecided = [false; LANES];
    let blocks = cx.iter().zip(cy).zip(ux.iter().zip(uy)).zip(vx.iter().zip(vy));
    for ((((cx, cy), (ux, uy)), (vx, vy)), touched) in blocks.zip(touched.as_chunks_mut::<LANES>().0) {
        let mut gaps = [0.0; LANES];
        for i in 0..LANES {
            let (dx, dy) = (cx[i] - ox, cy[i] - oy);
            let (ux, uy, vx, vy) = (ux[i], uy[i], vx[i], vy[i]);
            let (up, uq) = ((ux * px + uy * py).abs(), (ux * qx + uy * qy).abs());
            let (vp, vq) = ((vx * px + vy * py).abs(), (vx * qx + vy * qy).abs());
            let along_u = (dx * ux + dy * uy).abs() - (ux * ux + uy * uy) - (up + uq);
            let along_v = (dx * vx + dy * vy).abs() - (vx * vx + vy * vy) - (vp + vq);
            let along_p = (dx * px + dy * py).abs() - pp - (up + vp);
            let along_q = (dx * qx + dy * qy).abs() - qq - (uq + vq);
            gaps[i] = greater(greater(along_u, along_v), greater(along_p, along_q));
        }
        for i in 0..LANES {
            touched[i] = gaps[i] < -doubt;
            // what is no number is not decided either
            let decided = gaps[i].abs() > doubt;
            undecided[i] |= !decided;
        }
    }
    undecided.contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{Collision, Scene};
    use crate::geometry::Footprint;
    use crate::random::{Seed, Stream};

    type Rect = (Pose2, Point2, Point2);

    /// What the scene of one rectangle says of another.
    fn by_scene(a: Rect, b: Rect) -> bool {
        let bounds = crate::worlds::Bounds { min: Point2::origin(), max: Point2::origin() };
        let shape = Shape::Rectangle { min: a.1, max: a.2 };
        Scene::empty(bounds).with_obstacle_at("rectangle", a.0, shape).intersects(&Footprint::rects([b]))
    }

    #[test]
    fn rectangles_that_touch_or_not_are_told_as_by_a_scene() {
        let mut draws = Stream::new(Seed(8), "rectangles");
        let (mut touching, mut all) = (0, 0);
        for round in 0..60 {
            let mut rect = || {
                // every other round on a lattice, where sides and corners touch exactly
                let lattice = round % 2 == 0;
                let mut x = || if lattice { draws.below(9) as f64 } else { draws.uniform(0.0, 9.0) };
                let (x, y, w, h) = (x(), x(), x(), x());
                let theta = if lattice { 0.0 } else { draws.uniform(-3.0, 3.0) };
                (Pose2::new(x, y, theta), Point2::new(-0.25 - 0.125 * w, -0.5), Point2::new(0.25, 0.125 + 0.125 * h))
            };
            let rects: Vec<Rect> = (0..30).map(|_| rect()).collect();
            let many = Rectangles::new(rects.iter().copied());
            assert_eq!((many.len(), many.is_empty()), (30, false));
            let mut touched = vec![true; 99];
            for _ in 0..10 {
                let other = rect();
                many.touched_by(other, &mut touched);
                let expected: Vec<bool> = rects.iter().map(|r| by_scene(*r, other)).collect();
                assert_eq!(touched, expected, "{other:?}");
                touching += touched.iter().filter(|t| **t).count();
                all += touched.len();
            }
        }
        assert!(touching > all / 50 && touching < all / 2, "{touching} of {all}");
    }

    #[test]
    fn what_is_not_finite_touches_everything() {
        let square = |x: f64| (Pose2::new(x, 0.0, 0.0), Point2::new(-0.5, -0.5), Point2::new(0.5, 0.5));
        let many = Rectangles::new([square(0.0), square(f64::NAN), square(9.0)]);
        let mut touched = Vec::new();
        many.touched_by(square(0.0), &mut touched);
        assert_eq!(touched, [true, true, false]);
        many.touched_by(square(f64::INFINITY), &mut touched);
        assert_eq!(touched, [true, true, true]);
    }
}
