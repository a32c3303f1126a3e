//! Scans of small scenes cast at the segments listed for a square, against the same scans cast at all of them.
//!
//! The variable `MOTION_LAB_POSES` multiplies the number of poses. At 1 about 90,000 scans are compared, at 10 more
//! than 100,000 in each test.

use std::f64::consts::{FRAC_PI_4, PI};

use super::{bits, random_segments, scanners};
use crate::collision::Scene;
use crate::geometry::{Placed, Point2, Pose2, Segment};
use crate::num;
use crate::random::{Seed, Stream};
use crate::sensors::Scanner;

/// More visits than a scene and a square need before the square's list is used.
const ENOUGH: usize = 64;

/// The segments that a scan from here is cast at, once it was visited often enough.
fn listed(scene: &Scene, p: Point2, reach: f64) -> Vec<Segment> {
    (0..ENOUGH).for_each(|_| _ = scene.boundary().seen_from(p, reach));
    let [ax, ay, bx, by] = scene.boundary().seen_from(p, reach);
    let ends = (0..ax.len()).map(|i| Segment::new(Point2::new(ax[i], ay[i]), Point2::new(bx[i], by[i])));
    ends.filter(|s| !s.a.x.is_nan()).collect()
}

fn times(poses: usize) -> usize {
    std::env::var("MOTION_LAB_POSES").ok().and_then(|n| n.parse().ok()).unwrap_or(1) * poses
}

/// A small scene with and without its lists.
struct Twins {
    listing: Scene,
    plain: Scene,
    scanners: Vec<Scanner>,
    /// How many scans were compared, and how many segments fewer they were cast at.
    scans: usize,
    fewer: usize,
}

impl Twins {
    fn new(listing: Scene, max_range: f64) -> Self {
        assert!(listing.boundary().cells().is_none(), "it has a grid");
        Twins { plain: listing.without_lists(), listing, scanners: scanners(360, max_range), scans: 0, fewer: 0 }
    }

    fn compare(&mut self, pose: Pose2) {
        let p = pose.position();
        if self.plain.holds(&Placed::new([p], 0.0)) {
            return;
        }
        let reach = self.scanners[0].sensor().max_range;
        let seen = listed(&self.listing, p, reach).len();
        self.scans += 1;
        self.fewer += self.plain.boundary().soup().segments().len() - seen;
        let count = self.scanners.len();
        let scanner = &mut self.scanners[self.scans % count];
        let (mut ours, mut theirs) = ([0.0; 360], [0.0; 360]);
        scanner.scan_into(&self.listing, &[], &pose, &mut ours);
        scanner.scan_into(&self.plain, &[], &pose, &mut theirs);
        if bits(&ours) != bits(&theirs) {
            let k = (0..360).find(|&k| ours[k].to_bits() != theirs[k].to_bits()).unwrap();
            panic!("{pose:?}: ray {k} reads {}, not {}", ours[k], theirs[k]);
        }
    }

    /// Poses at random, and such as give rays through the ends of segments and along them, and lie on the sides of
    /// squares.
    fn compare_many(&mut self, draws: &mut Stream, poses: usize) {
        let segments = self.plain.boundary().soup().segments().clone();
        let ends: Vec<Point2> = (0..segments.len()).map(|i| segments.segment(i)).flat_map(|s| [s.a, s.b]).collect();
        let least = ends.iter().fold(ends[0], |m, p| Point2::new(num::lesser(m.x, p.x), num::lesser(m.y, p.y)));
        let most = ends.iter().fold(ends[0], |m, p| Point2::new(num::greater(m.x, p.x), num::greater(m.y, p.y)));
        let any = |draws: &mut Stream| ends[draws.below(ends.len() as u64) as usize];
        for i in 0..times(poses) {
            let random = Point2::new(draws.uniform(least.x, most.x), draws.uniform(least.y, most.y));
            let (e, f) = (any(draws), any(draws));
            let side = |from: f64, x: f64, step: f64| from + ((x - from) / step).floor() * step;
            let p = match i % 8 {
                0 | 1 => random,
                // a corner of a square, or a hair beside it
                2 => Point2::new(side(least.x, random.x, 0.25), side(least.y, random.y, 0.25)),
                3 => Point2::new(side(least.x, random.x, 0.25) - 1e-15, random.y),
                // as far along as an end is, or on the line through two ends, or on a diagonal through one
                4 => Point2::new(e.x, random.y),
                5 => e + (f - e) * draws.uniform(-0.5, 1.5),
                6 => e + (Point2::new(1.0, 1.0) - Point2::origin()) * (draws.below(33) as f64 * 0.125 - 2.0),
                _ => Point2::new(side(0.0, random.x, 0.05), side(0.0, random.y, 0.05)),
            };
            let theta = match i / 8 % 4 {
                0 => FRAC_PI_4 * draws.below(8) as f64,
                1 => num::atan2(f.y - p.y, f.x - p.x),
                2 => num::atan2(e.y - p.y, e.x - p.x) + PI,
                _ => draws.uniform(-PI, PI),
            };
            self.compare(Pose2 { x: p.x, y: p.y, theta });
        }
    }
}

#[test]
fn lists_change_no_bit_of_a_scan_of_the_worlds() {
    let mut draws = Stream::new(Seed(1), "sight");
    for (scene, range) in [(Scene::apartment(), 4.0), (Scene::workbench(), 1.0), (Scene::lot(), 12.0)] {
        let mut twins = Twins::new(scene, range);
        twins.compare_many(&mut draws, 16_000);
        assert!(twins.scans > 3000, "{}", twins.scans);
        if range == 4.0 {
            // of 62 segments
            assert!(twins.fewer > 38 * twins.scans, "{} of {}", twins.fewer, twins.scans);
        }
    }
}

#[test]
fn lists_change_no_bit_of_a_scan_among_random_walls() {
    let mut draws = Stream::new(Seed(2), "sight");
    let (mut scans, mut fewer) = (0, 0);
    for size in [1.0, 3.0, 6.0, 12.0, 40.0] {
        for count in [12, 40, 120] {
            let walls = random_segments(&mut draws, count, size, 0.6 * size);
            let mut twins = Twins::new(Scene::of_walls(&walls), 1.5 * size);
            twins.compare_many(&mut draws, 1200);
            (scans, fewer) = (scans + twins.scans, fewer + twins.fewer);
        }
    }
    assert!(fewer > 10 * scans, "{fewer} of {scans}");
}

/// Walls that share corners, cross, touch and overlap: a ray through a corner that two share may count as beside both.
#[test]
fn lists_change_no_bit_of_a_scan_among_walls_that_touch() {
    let mut draws = Stream::new(Seed(3), "sight");
    let (mut scans, mut fewer) = (0, 0);
    for round in 0..30 {
        let point = |draws: &mut Stream| Point2::new(draws.below(13) as f64 * 0.5, draws.below(13) as f64 * 0.5);
        let mut corner = point(&mut draws);
        let walls: Vec<Segment> = (0..60)
            .map(|_| {
                let mut next = point(&mut draws);
                if round % 3 == 0 {
                    // along the axes, so that many lie on one line
                    next =
                        if draws.below(2) == 0 { Point2::new(corner.x, next.y) } else { Point2::new(next.x, corner.y) };
                }
                let wall = Segment::new(corner, corner + (next - corner) * if round % 3 == 1 { 0.4 } else { 1.0 });
                corner = wall.b;
                wall
            })
            .collect();
        let mut twins = Twins::new(Scene::of_walls(&walls), 9.0);
        twins.compare_many(&mut draws, 800);
        (scans, fewer) = (scans + twins.scans, fewer + twins.fewer);
    }
    assert!(fewer > 30 * scans, "{fewer} of {scans}");
}

/// A fence of walls end to end with another behind it: only whole walls of the first hide anything, since a ray through
/// a joint may be won by the fence behind.
#[test]
fn lists_change_no_bit_of_a_scan_through_the_joints_of_a_fence() {
    let mut draws = Stream::new(Seed(4), "sight");
    for shift in [0.0, 1e-9, 1e-6, 1e-4, 1e-2, 0.3] {
        let wall = |k: u32, x: f64, long: f64| {
            let y = |k: u32| (f64::from(k) - 10.0) * long;
            Segment::new(Point2::new(x, y(k)), Point2::new(x + 0.1, y(k + 1)))
        };
        let walls: Vec<Segment> = (0..20).flat_map(|k| [wall(k, 2.0, 0.3), wall(k, 2.0 + shift, 0.5)]).collect();
        let mut twins = Twins::new(Scene::of_walls(&walls), 20.0);
        let joints: Vec<Point2> = walls.iter().flat_map(|s| [s.a, s.b]).collect();
        for _ in 0..times(3000) {
            // within the box around the fence, on a line through one of its joints
            let p = Point2::new(draws.uniform(2.0, 2.4), draws.uniform(-4.0, 4.0));
            let joint = joints[draws.below(joints.len() as u64) as usize];
            let theta = num::atan2(joint.y - p.y, joint.x - p.x);
            twins.compare(Pose2 { x: p.x, y: p.y, theta });
        }
        assert!(twins.scans > 1000);
    }
}

/// Each ray of a dense sample of a square is won by a segment of the square's list.
#[test]
fn what_wins_a_ray_is_listed_and_little_else() {
    let scene = Scene::apartment();
    let all: Vec<Segment> = (0..62).map(|i| scene.boundary().soup().segments().segment(i)).collect();
    let (mut squares, mut kept, mut seen) = (0, 0, 0);
    for number in 0..48 * 32 {
        let (column, row) = (f64::from(number % 48), f64::from(number / 48));
        let at = |fx: f64, fy: f64| Point2::new(0.25 * (column + fx), 0.25 * (row + fy));
        if number % 7 != 0 || scene.holds(&Placed::new([at(0.5, 0.5)], 0.0)) {
            continue;
        }
        let list = listed(&scene, at(0.5, 0.5), 1e9);
        let mut winners = vec![false; all.len()];
        for place in 0..16 {
            let share = |i: i32| [1e-9, 0.3, 0.7, 1.0 - 1e-9][i as usize];
            let o = at(share(place % 4), share(place / 4));
            for ray in 0..180 {
                let (s, c) = num::sin_cos(PI / 90.0 * (f64::from(ray) + 0.07 * f64::from(place)));
                let inverse = |segment: &Segment| {
                    let (p, q) = (segment.a - o, segment.b - o);
                    let (area, p, q) = (p.x * q.y - p.y * q.x, p, q);
                    let inside = (p.x * s - p.y * c) * area >= 0.0 && (c * q.y - s * q.x) * area >= 0.0;
                    if inside { (c * (q.y - p.y) - s * (q.x - p.x)) / area } else { 0.0 }
                };
                let found: Vec<f64> = all.iter().map(inverse).collect();
                let best = found.iter().fold(0.0, |m, &i| num::greater(i, m));
                (0..all.len()).filter(|&i| best > 0.0 && found[i] == best).for_each(|i| winners[i] = true);
            }
        }
        for (i, segment) in all.iter().enumerate().filter(|(i, _)| winners[*i]) {
            assert!(list.contains(segment), "square {column} {row}: segment {i} wins a ray");
        }
        squares += 1;
        kept += list.len();
        seen += winners.iter().filter(|won| **won).count();
    }
    let mean = |count: usize| count as f64 / f64::from(squares);
    println!("{squares} squares: {} listed, {} seen", mean(kept), mean(seen));
    assert!(squares > 100 && kept < 23 * squares as usize && kept < 2 * seen, "{} {}", mean(kept), mean(seen));
}

#[test]
fn scans_of_many_threads_at_once_are_those_of_one() {
    let sensor = *scanners(360, 4.0)[0].sensor();
    let mut draws = Stream::new(Seed(5), "sight");
    let mut pose = || Pose2::new(draws.uniform(5.0, 7.0), draws.uniform(3.0, 5.0), draws.uniform(-PI, PI));
    let poses: Vec<Pose2> = (0..3000).map(|_| pose()).collect();
    let scene = Scene::apartment();
    let many = sensor.scans(&scene, &poses);
    let copy = scene.clone();
    assert!(copy.boundary().seen_from(poses[0].position(), 9.0)[0].len() < 62, "a copy shares the lists");
    assert_eq!(bits(&many), bits(&sensor.scans(&scene.without_lists(), &poses)));
}
