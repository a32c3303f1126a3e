//! The contest of the table's scans: the lab and parry scan the same world from the same poses, natively and in
//! WebAssembly.

use motion_lab::collision::Scene;
use motion_lab::geometry::Pose2;
use motion_lab::num;
use motion_lab::sensors::{Instructions, RangeSensor, Scanner};

use crate::peer::Peer;
use crate::worlds::{CASES, free_points, pieces, walls};

/// A world of walls, and the range of the sensor in it.
#[derive(Clone, Copy)]
pub struct Case {
    pub count: usize,
    pub side: f64,
    pub longest: f64,
    pub range: f64,
    /// The ratio that the best instructions must reach.
    pub must: &'static str,
}

const fn case(count: usize, side: f64, longest: f64, range: f64, must: &'static str) -> Case {
    Case { count, side, longest, range, must }
}

/// A hall; crowded yards with six things per square metre; and the same number of things spread out.
pub const WORLDS: [Case; 4] = [
    case(40, 8.0, 2.0, 4.0, ">= 30x"),
    case(1_000, 12.6, 1.0, 12.0, ">= 25x"),
    case(10_000, 40.0, 1.0, 12.0, ">= 20x"),
    case(1_000, 40.0, 1.0, 12.0, ""),
];

impl Case {
    pub fn work(&self) -> String {
        let Case { count, side, range, .. } = self;
        format!("scan, 360 rays, {count} segments in {side} m x {side} m, R {range} m")
    }

    pub fn scene(&self) -> Scene {
        walls(self.count, self.side, self.longest)
    }

    pub fn poses(&self, scene: &Scene) -> Vec<Pose2> {
        free_points(scene, 0.3 * self.side, 0.7 * self.side)
    }
}

/// The lab's scan of a world with some instructions.
pub struct Ours {
    scene: Scene,
    poses: Vec<Pose2>,
    scanner: Scanner,
    ranges: Vec<f64>,
}

impl Ours {
    pub fn new(case: &Case, set: Instructions) -> Self {
        let scene = case.scene();
        let poses = case.poses(&scene);
        let sensor = RangeSensor { n_rays: 360, max_range: case.range };
        Ours { scene, poses, scanner: Scanner::with_instructions(sensor, set), ranges: vec![0.0; 360] }
    }

    pub fn scan(&mut self, i: usize) -> &[f64] {
        self.scanner.scan_into(&self.scene, &[], &self.poses[i % CASES], &mut self.ranges);
        &self.ranges
    }

    /// A hash of every bit of every scan.
    pub fn digest(&mut self) -> u64 {
        let fold = |hash: u64, range: &f64| (hash.rotate_left(5) ^ range.to_bits()).wrapping_mul(0x517c_c1b7_2722_0a95);
        (0..CASES).fold(0, |hash, i| self.scan(i).iter().fold(hash, fold))
    }
}

/// The same by parry.
pub struct Parry {
    peer: Peer,
    places: Vec<(f64, f64)>,
    directions: Vec<Vec<(f64, f64)>>,
    range: f64,
    ranges: Vec<f64>,
}

impl Parry {
    pub fn new(case: &Case) -> Self {
        let scene = case.scene();
        let sensor = RangeSensor { n_rays: 360, max_range: case.range };
        let poses = case.poses(&scene);
        let directions = |p: &Pose2| {
            let (s, c) = num::sin_cos(p.theta);
            (0..sensor.n_rays).map(|k| sensor.direction(k)).map(|(x, y)| (c * x - s * y, s * x + c * y)).collect()
        };
        Parry {
            peer: Peer::new(pieces(&scene)),
            places: poses.iter().map(|p| (p.x, p.y)).collect(),
            directions: poses.iter().map(directions).collect(),
            range: case.range,
            ranges: vec![0.0; 360],
        }
    }

    pub fn scan(&mut self, i: usize) -> &[f64] {
        let i = i % CASES;
        self.peer.scan(self.places[i], &self.directions[i], self.range, &mut self.ranges);
        &self.ranges
    }
}

/// Checks that the two agree before they race.
pub fn agree(ours: &mut Ours, parry: &mut Parry) {
    for i in 0..CASES {
        let pairs = ours.scan(i).iter().zip(parry.scan(i));
        let differ = pairs.filter(|(a, b)| a != b && (*a - *b).abs() > 1e-9).count();
        assert!(differ <= 2, "{differ} rays differ from parry's in scan {i}");
    }
}
