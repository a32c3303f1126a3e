//! The contest of the table's scans: the lab and its peers scan the same world from the same poses, natively and in
//! WebAssembly.

use motion_lab::collision::Scene;
use motion_lab::geometry::{Placed, Pose2};
use motion_lab::num;
use motion_lab::sensors::{Instructions, RangeSensor, Scanner};

use crate::rivals::Task;
use crate::worlds::{CASES, free_points, pieces, walls};

/// A world of walls, and the range of the sensor in it.
#[derive(Clone, Copy)]
pub struct Case {
    pub count: usize,
    pub side: f64,
    pub longest: f64,
    pub range: f64,
    /// The ratios that the best instructions must reach, and any others.
    pub must: Option<[f64; 2]>,
}

const fn case(count: usize, side: f64, longest: f64, range: f64, must: Option<[f64; 2]>) -> Case {
    Case { count, side, longest, range, must }
}

/// A hall; crowded yards with six things per square metre; and the same number of things spread out.
pub const WORLDS: [Case; 4] = [
    case(40, 8.0, 2.0, 4.0, Some([40.0, 25.0])),
    case(1_000, 12.6, 1.0, 12.0, Some([45.0, 28.0])),
    case(10_000, 40.0, 1.0, 12.0, Some([50.0, 33.0])),
    case(1_000, 40.0, 1.0, 12.0, None),
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

/// The same as a task for the peers.
pub fn task(case: &Case) -> Task {
    let scene = case.scene();
    let sensor = RangeSensor { n_rays: 360, max_range: case.range };
    let rays = |p: &Pose2| {
        let (s, c) = num::sin_cos(p.theta);
        let directions = (0..sensor.n_rays).map(|k| sensor.direction(k));
        let turned = directions.flat_map(|(x, y)| [c * x - s * y, s * x + c * y]);
        [p.x, p.y].into_iter().chain(turned).collect()
    };
    Task {
        kind: "scan".into(),
        settings: vec![case.range],
        obstacles: pieces(&scene).map(numbers).collect(),
        cases: case.poses(&scene).iter().map(rays).collect(),
    }
}

/// A placed shape as a task's obstacle.
pub fn numbers(placed: &Placed) -> Vec<f64> {
    std::iter::once(placed.radius()).chain(placed.core().iter().flat_map(|p| [p.x, p.y])).collect()
}

/// A scene's shapes by their sides, each a task's obstacle.
pub fn sides(scene: &Scene) -> Vec<Vec<f64>> {
    let sides = pieces(scene).flat_map(|piece| {
        let core = piece.core();
        let sides = if core.len() > 2 { core.len() } else { 1 };
        let side = move |k: usize| [core[k], core[(k + 1) % core.len()]];
        (0..sides).map(move |k| numbers(&Placed::new(side(k), piece.radius())))
    });
    sides.collect()
}

/// Checks that a peer agrees before the race: to 1e-9 m but for two rays of a scan, or to a millimetre but for eight
/// where the peer has single precision. Simulators choose other bearings for their rays: of nine scans in ten their
/// least range is ours to 5 cm.
pub fn agree(ours: &mut Ours, name: &str, answers: &[Vec<f64>]) {
    assert!(answers.iter().all(|ranges| ranges.len() == 360), "{name}");
    if matches!(name, "ir-sim" | "navground") {
        let differ = answers.iter().enumerate().filter(|(i, theirs)| {
            let mine = ours.scan(*i).to_vec();
            (least_of(&mine) - least_of(theirs)).abs() > 0.05
        });
        let differ = differ.count();
        assert!(10 * differ <= answers.len(), "{name}: {differ} scans differ");
        return;
    }
    let (near, most) = if name.starts_with("parry") { (1e-9, 2) } else { (1e-3, 8) };
    for (i, theirs) in answers.iter().enumerate() {
        let differ = ours.scan(i).iter().zip(theirs).filter(|(a, b)| a != b && (*a - *b).abs() > near).count();
        assert!(differ <= most, "{differ} rays differ from those of {name} in scan {i}");
    }
}

/// The least of some ranges; a simulator says its greatest range where a ray meets nothing.
fn least_of(ranges: &[f64]) -> f64 {
    ranges.iter().copied().fold(f64::INFINITY, num::lesser)
}
