//! Scans: 360 rays in small and large worlds.

use motion_lab::collision::Scene;
use motion_lab::geometry::Pose2;
use motion_lab::num;
use motion_lab::sensors::{Instructions, RangeSensor, Scanner};

use crate::Table;
use crate::measure::{Contender, Timing, race};
use crate::peer::Peer;
use crate::worlds::{CASES, free_points, pieces, walls};

fn against(sensor: RangeSensor, scene: &Scene, poses: &[Pose2], sets: &[Instructions]) -> Vec<Timing> {
    let peer = Peer::new(pieces(scene));
    let n = sensor.n_rays as usize;
    let directions: Vec<Vec<(f64, f64)>> = poses
        .iter()
        .map(|p| {
            let (s, c) = num::sin_cos(p.theta);
            (0..sensor.n_rays).map(|k| sensor.direction(k)).map(|(x, y)| (c * x - s * y, s * x + c * y)).collect()
        })
        .collect();
    let (mut ours, mut theirs) = (vec![0.0; n], vec![0.0; n]);
    let mut scanner = Scanner::new(sensor);
    // they must agree before they race
    for (pose, directions) in poses.iter().zip(&directions) {
        scanner.scan_into(scene, &[], pose, &mut ours);
        peer.scan((pose.x, pose.y), directions, sensor.max_range, &mut theirs);
        let differ = ours.iter().zip(&theirs).filter(|(a, b)| a != b && (*a - *b).abs() > 1e-9).count();
        assert!(differ <= 2, "{differ} rays differ from parry's at {pose}");
    }
    let mut parry_ranges = vec![0.0; n];
    let mut contenders = Vec::new();
    for &set in sets {
        let mut scanner = Scanner::with_instructions(sensor, set);
        let mut ranges = vec![0.0; n];
        contenders.push(Contender::new("", move |i| {
            scanner.scan_into(scene, &[], &poses[i % CASES], &mut ranges);
            ranges[0]
        }));
    }
    contenders.insert(
        1,
        Contender::new("parry", |i| {
            let i = i % CASES;
            peer.scan((poses[i].x, poses[i].y), &directions[i], sensor.max_range, &mut parry_ranges);
            parry_ranges[0]
        }),
    );
    race(contenders)
}

pub fn rows(table: &mut Table) {
    let best = Instructions::best();
    // a hall; crowded yards, six things to the square metre; the same number of things spread out
    let cases = [
        (40, 8.0, 2.0, 4.0, ">= 30x"),
        (1_000, 12.6, 1.0, 12.0, ">= 25x"),
        (10_000, 40.0, 1.0, 12.0, ">= 20x"),
        (1_000, 40.0, 1.0, 12.0, ""),
    ];
    for (count, side, longest, range, must) in cases {
        let sensor = RangeSensor { n_rays: 360, max_range: range };
        let work = format!("scan, 360 rays, {count} segments in {side} m x {side} m, R {range} m");
        let scene = walls(count, side, longest);
        let poses = free_points(&scene, 0.3 * side, 0.7 * side);
        table.row(&format!("{work} ({best:?})"), must, || against(sensor, &scene, &poses, &[best]));
        for set in Instructions::available() {
            if set != best {
                table.row(&format!("{work} ({set:?})"), ">= 15x", || against(sensor, &scene, &poses, &[set]));
            }
        }
    }
}
