//! `Remaining`, an estimate of the way that remains to a goal.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::collision::{Checker, Collision};
use crate::geometry::{Footprint, Point2, Pose2};
use crate::num::{greater, lesser};
use crate::planning::curves::reeds_shepp;
use crate::robots::Hitch;

/// The side of a cell, metres.
const CELL: f64 = 0.25;

/// The greatest number of cells to a side.
const MAX_CELLS_A_SIDE: f64 = 400.0;

/// An estimate of the way that remains to a goal: the longer of Reeds and Shepp's curve among no obstacles, and the way
/// of a disc about the rear axle among the obstacles, on a grid.
#[derive(Clone, Debug)]
pub(super) struct Remaining {
    goal: Pose2,
    radius: f64,
    min: Point2,
    cell: f64,
    columns: usize,
    /// The way from each cell to the goal's, metres; infinity where there is none.
    ways: Vec<f64>,
}

impl Remaining {
    pub(super) fn new(checker: &Checker<Hitch>, goal: &Pose2) -> Self {
        let (car, scene) = (checker.robot(), checker.scene());
        let (min, max) = (scene.bounds().min, scene.bounds().max);
        let cell = greater(CELL, greater(max.x - min.x, max.y - min.y) / MAX_CELLS_A_SIDE);
        let side = |length: f64| lesser((length / cell).ceil() + 1.0, MAX_CELLS_A_SIDE + 2.0) as usize;
        let (columns, rows) = (side(max.x - min.x), side(max.y - min.y));
        // the greatest disc about the rear axle within the chassis
        let body = car.body;
        let disc = lesser(0.5 * body.width, lesser(body.rear_overhang, body.length - body.rear_overhang));
        let at = |i: usize| Point2::new(min.x + (i % columns) as f64 * cell, min.y + (i / columns) as f64 * cell);
        let is_free = |i: usize| disc <= 0.0 || !scene.intersects(&Footprint::disc(at(i), disc));
        let free: Vec<bool> = (0..columns * rows).map(is_free).collect();
        let mut remaining = Remaining {
            goal: *goal,
            radius: car.tightest(),
            min,
            cell,
            columns,
            ways: vec![f64::INFINITY; free.len()],
        };
        remaining.spread(&free);
        remaining
    }

    /// Finds the ways from the goal's cell over the free cells, to the eight neighbours of each (Dijkstra, 1959).
    fn spread(&mut self, free: &[bool]) {
        let Some(root) = self.index(self.goal.position()) else { return };
        let (columns, rows) = (self.columns, self.ways.len() / self.columns);
        let mut open = BinaryHeap::from([Reverse((0_u64, root))]);
        self.ways[root] = 0.0;
        while let Some(Reverse((way, at))) = open.pop() {
            // the order of the bits of numbers that are not negative is theirs
            let way = f64::from_bits(way);
            if way > self.ways[at] {
                continue;
            }
            let (x, y) = (at % columns, at / columns);
            for (column, row) in
                [x.wrapping_sub(1), x, x + 1].into_iter().flat_map(|c| [y.wrapping_sub(1), y, y + 1].map(|r| (c, r)))
            {
                if column >= columns || row >= rows || !free[row * columns + column] {
                    continue;
                }
                let diagonal = column != x && row != y;
                let next = way + self.cell * if diagonal { std::f64::consts::SQRT_2 } else { 1.0 };
                let to = row * columns + column;
                if next < self.ways[to] {
                    self.ways[to] = next;
                    open.push(Reverse((next.to_bits(), to)));
                }
            }
        }
    }

    fn index(&self, p: Point2) -> Option<usize> {
        let (column, row) = (((p.x - self.min.x) / self.cell).round(), ((p.y - self.min.y) / self.cell).round());
        let rows = self.ways.len() / self.columns;
        let inside = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// The estimate, metres. Where the grid knows no way, it is the curve's length alone: the grid is coarse.
    pub(super) fn at(&self, pose: &Pose2) -> f64 {
        let curve = reeds_shepp(pose, &self.goal, self.radius).map_or(0.0, |curve| curve.length());
        let way = self.index(pose.position()).map_or(0.0, |i| self.ways[i]);
        if way.is_finite() { greater(curve, way) } else { curve }
    }
}
