//! `Rectangles`, a list of rectangles with the query which of them touch another.

use multiversion::multiversion;

use motion_lab::collision::touch;
use motion_lab::geometry::{Placed, Point2, Pose2, Shape, largest_coordinate};
use motion_lab::num::greater;

/// The number of rectangles decided at once.
const LANES: usize = 8;

/// Placed rectangles in structure-of-arrays order, compared with another eight at a time.
///
/// The answers are exact for the placed rectangles, whose corners are rounded. Separating axes decide wherever the gaps
/// exceed the rounding. If any does not, exact predicates decide them all. A rectangle that is not finite touches
/// everything.
#[derive(Clone, Debug)]
pub struct Rectangles {
    placed: Vec<Placed>,
    /// The numbers of the rectangles' frames, an array for each, padded to a multiple of eight with rectangles of
    /// size 0.
    arrays: [Vec<f64>; 6],
    /// An upper bound on the size of the coordinates, metres.
    size: f64,
    decide: Decide,
}

/// [`decide`] for some instructions.
type Decide = fn([&[f64]; 6], &Frame, f64, &mut [bool]) -> bool;

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
    /// Rectangles given by their frames and corners (least, greatest) in those frames, as `Footprint::rects` takes
    /// them.
    pub fn new(rects: impl IntoIterator<Item = (Pose2, Point2, Point2)>) -> Self {
        let placed: Vec<Placed> = rects.into_iter().map(place).collect();
        let mut arrays: [Vec<f64>; 6] = Default::default();
        let frames: Vec<Frame> = placed.iter().map(frame).collect();
        for (k, array) in arrays.iter_mut().enumerate() {
            array.extend(frames.iter().map(|frame| frame[k]));
            array.resize(frames.len().next_multiple_of(LANES), 0.0);
        }
        let size = largest_coordinate(&placed);
        Rectangles { placed, arrays, size, decide: decide_widely }
    }

    /// The same for the instructions that Rust compiles for by default.
    pub fn with_baseline(rects: impl IntoIterator<Item = (Pose2, Point2, Point2)>) -> Self {
        Rectangles { decide, ..Self::new(rects) }
    }

    /// Writes whether each rectangle touches `rect`, in order; `touched` is cleared first.
    pub fn touched_by(&self, rect: (Pose2, Point2, Point2), touched: &mut Vec<bool>) {
        let other = place(rect);
        // Corners are rounded to ulps of the largest coordinate. What is computed from them here is off by some ulps
        // more, and a product with a side by as many times the side's length, which is at most four such coordinates.
        let size = greater(self.size, largest_coordinate([&other]));
        let doubt = 256.0 * f64::EPSILON * size * size;
        touched.clear();
        touched.resize(self.placed.len().next_multiple_of(LANES), false);
        let undecided = (self.decide)(self.arrays.each_ref().map(Vec::as_slice), &frame(&other), doubt, touched);
        touched.truncate(self.placed.len());
        if undecided {
            for (touched, placed) in touched.iter_mut().zip(&self.placed) {
                *touched = touch(placed, &other);
            }
        }
    }
}

/// Decides by separating axes which rectangles touch the other. Returns whether any rectangle stays undecided.
///
/// Projected on a half-side `u` of one rectangle, with `d` from centre to centre: the centres are `|d . u|` apart, that
/// rectangle reaches `u . u`, and the other the sum of `|u . w|` over its half-sides w.
#[inline(always)]
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
            // NaN counts as undecided
            let decided = gaps[i].abs() > doubt;
            undecided[i] |= !decided;
        }
    }
    undecided.contains(&true)
}

/// [`decide`] with the widest instructions of the processor.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn decide_widely(arrays: [&[f64]; 6], other: &Frame, doubt: f64, touched: &mut [bool]) -> bool {
    decide(arrays, other, doubt, touched)
}
