//! The scan against its definition, ray by ray, to the last bit and on every instruction set of this processor.

mod sight;

use std::f64::consts::{PI, TAU};

use super::{FanSensor, Instructions, RangeSensor, Scanner};
use crate::collision::{Collision, Scene, Surroundings};
use crate::geometry::{Footprint, Part, Placed, Point2, Pose2, Segment, Shape, Vector2, orientation};
use crate::num::{self, sqrt};
use crate::random::{Seed, Stream};

/// The boundary of a shape, by other code than the scene's: the sides of its core, or, with a radius, those sides moved
/// outward by it (a segment's to both sides) and a circle about each vertex.
fn boundary(shape: &Placed, segments: &mut Vec<Segment>, circles: &mut Vec<(Point2, f64)>) {
    let (core, r) = (shape.core(), shape.radius());
    for (i, &a) in core.iter().enumerate().take(if core.len() == 2 { 1 } else { core.len() }) {
        let b = core[(i + 1) % core.len()];
        let (along, length) = (b - a, num::hypot(b.x - a.x, b.y - a.y));
        // a polygon lies to the left of its sides
        let right = Vector2::new(along.y, -along.x) * (r / length);
        match core.len() {
            1 => {}
            _ if r == 0.0 => segments.push(Segment::new(a, b)),
            2 => segments.extend([Segment::new(a + right, b + right), Segment::new(a - right, b - right)]),
            _ => segments.push(Segment::new(a + right, b + right)),
        }
    }
    if r > 0.0 {
        circles.extend(core.iter().map(|&vertex| (vertex, r)));
    }
}

/// Every ray against every segment and disc, with nothing left out: the kernel without its shortcuts.
fn by_definition(fan: &FanSensor, scene: &Scene, others: &[Placed], pose: &Pose2) -> Vec<f64> {
    let sensor = fan.sensor;
    let n = sensor.n_rays as usize;
    let inside = Footprint::new([Part::new(Pose2 { theta: 0.0, ..*pose }, Shape::Disc { radius: 0.0 })]);
    if (Surroundings { scene, others }).intersects(&inside) {
        return vec![0.0; n];
    }
    let (mut segments, mut circles) = (Vec::new(), Vec::new());
    for shape in scene.pieces().map(|(_, piece)| piece).chain(others) {
        boundary(shape, &mut segments, &mut circles);
    }
    let (s, c) = num::sin_cos(pose.theta);
    let mut inverse = vec![0.0; n];
    let mut raise = |k: usize, value: f64| {
        if value > inverse[k] {
            inverse[k] = value;
        }
    };
    let directions: Vec<(f64, f64)> =
        (0..sensor.n_rays).map(|k| fan.direction(k)).map(|(x, y)| (c * x - s * y, s * x + c * y)).collect();
    for segment in &segments {
        let (mut p, mut q) = (segment.a - pose.position(), segment.b - pose.position());
        let area = p.x * q.y - p.y * q.x;
        if area < 0.0 {
            (p, q) = (q, p);
        }
        let (a, b) = ((q.y - p.y) / area.abs(), (q.x - p.x) / area.abs());
        for (k, &(dx, dy)) in directions.iter().enumerate() {
            if area == 0.0 {
                let near = if p.norm_squared() <= q.norm_squared() { p } else { q };
                if near.x * dy - near.y * dx == 0.0 && near.x * dx + near.y * dy > 0.0 {
                    raise(k, 1.0 / sqrt(near.norm_squared()));
                }
            } else if p.x * dy - p.y * dx >= 0.0 && dx * q.y - dy * q.x >= 0.0 {
                raise(k, dx * a - dy * b);
            }
        }
    }
    for (centre, r) in circles {
        let centre = centre - pose.position();
        let outside = centre.x * centre.x + centre.y * centre.y - r * r;
        for (k, &(dx, dy)) in directions.iter().enumerate() {
            let (along, across) = (centre.x * dx + centre.y * dy, centre.x * dy - centre.y * dx);
            let half = r * r - across * across;
            if along > 0.0 && half >= 0.0 {
                raise(k, (along + sqrt(half)) / outside);
            }
        }
    }
    let most = sensor.max_range;
    let least = (1.0 - 4.0 * f64::EPSILON) / most;
    inverse.iter().map(|&i| if i >= least { (1.0 / i).clamp(0.0, most) } else { f64::INFINITY }).collect()
}

fn bits(ranges: &[f64]) -> Vec<u64> {
    ranges.iter().map(|r| r.to_bits()).collect()
}

/// Checks one scan on every instruction set. Returns how many rays hit.
fn check(scanners: &mut [Scanner], scene: &Scene, others: &[Placed], pose: &Pose2) -> usize {
    let sensor = *scanners[0].sensor();
    let sensor = FanSensor { sensor, field_of_view: scanners[0].field_of_view() };
    let expected = by_definition(&sensor, scene, others, pose);
    let mut ranges = vec![-1.0; sensor.sensor.n_rays as usize];
    for (scanner, set) in scanners.iter_mut().zip(Instructions::available()) {
        scanner.scan_into(scene, others, pose, &mut ranges);
        if bits(&ranges) != bits(&expected) {
            let differ = (0..ranges.len()).find(|&k| ranges[k].to_bits() != expected[k].to_bits());
            let k = differ.unwrap();
            panic!("{set:?} {sensor:?} {pose:?}: ray {k} reads {}, not {}", ranges[k], expected[k]);
        }
    }
    expected.iter().filter(|r| r.is_finite()).count()
}

fn scanners(n_rays: u32, max_range: f64) -> Vec<Scanner> {
    fans(n_rays, max_range, TAU)
}

fn fans(n_rays: u32, max_range: f64, field_of_view: f64) -> Vec<Scanner> {
    let sensor = FanSensor { sensor: RangeSensor { n_rays, max_range }, field_of_view };
    Instructions::available().into_iter().map(|set| Scanner::with_instructions(sensor, set)).collect()
}

fn random_walls(draws: &mut Stream, count: usize, size: f64) -> Scene {
    Scene::of_walls(&random_segments(draws, count, size, 0.5 * size))
}

fn random_segments(draws: &mut Stream, count: usize, size: f64, longest: f64) -> Vec<Segment> {
    (0..count)
        .map(|_| {
            let a = Point2::new(draws.uniform(0.0, size), draws.uniform(0.0, size));
            let (s, c) = num::sin_cos(draws.uniform(-PI, PI));
            let length = draws.uniform(0.05, longest);
            Segment::new(a, Point2::new(a.x + length * c, a.y + length * s))
        })
        .collect()
}

#[test]
fn random_walls_are_seen_as_defined_by_any_number_of_rays() {
    let mut draws = Stream::new(Seed(1), "scan");
    let mut hits = 0;
    for n in (1..=20).chain([33, 64, 179, 180, 359, 360, 361, 1000, 3001]) {
        let mut scanners = scanners(n, 4.0);
        for _ in 0..20 {
            let scene = random_walls(&mut draws, 12, 10.0);
            for heading in [0.0, draws.uniform(-PI, PI), draws.uniform(-20.0, 20.0)] {
                let pose = Pose2 { x: draws.uniform(0.0, 10.0), y: draws.uniform(0.0, 10.0), theta: heading };
                hits += check(&mut scanners, &scene, &[], &pose);
            }
        }
    }
    assert!(hits > 100_000, "{hits}");
}

#[test]
fn more_rays_than_sixteen_bits_count_in_eights_are_cast_as_defined() {
    let mut draws = Stream::new(Seed(7), "scan");
    let mut scanners = scanners(600_000, 20.0);
    let scene = random_walls(&mut draws, 12, 10.0);
    for _ in 0..2 {
        let pose = Pose2::new(draws.uniform(0.0, 10.0), draws.uniform(0.0, 10.0), draws.uniform(-PI, PI));
        assert!(check(&mut scanners, &scene, &[], &pose) > 100_000);
    }
}

/// Fields of view from the smallest to nearly a full turn, with the borders of their fans in every quarter.
const FIELDS: [f64; 11] = [1e-3, 0.01, 0.1, 0.5, 1.0, 0.5 * PI, 2.0, PI, 4.0, 6.0, TAU - 1e-4];

#[test]
fn a_fan_of_any_width_sees_random_walls_as_defined() {
    let mut draws = Stream::new(Seed(11), "scan");
    let mut hits = 0;
    for n in [1, 2, 3, 7, 8, 9, 16, 17, 31, 64, 90, 181, 512, 513, 1000, 5000] {
        for wide in FIELDS {
            let mut scanners = fans(n, 6.0, wide);
            for _ in 0..6 {
                let scene = random_walls(&mut draws, 12, 10.0);
                for heading in [0.0, draws.uniform(-PI, PI), draws.uniform(-20.0, 20.0), 3e6] {
                    let pose = Pose2 { x: draws.uniform(0.0, 10.0), y: draws.uniform(0.0, 10.0), theta: heading };
                    let disc = Pose2::new(draws.uniform(0.0, 10.0), draws.uniform(0.0, 10.0), 0.0);
                    let others = [Shape::Disc { radius: draws.uniform(0.01, 2.0) }.place(&disc)];
                    hits += check(&mut scanners, &scene, &others, &pose);
                }
            }
        }
    }
    assert!(hits > 500_000, "{hits}");
}

#[test]
fn a_fan_sees_large_worlds_as_defined() {
    let mut draws = Stream::new(Seed(12), "scan");
    let mut hits = 0;
    for (count, size, longest) in [(300, 10.0, 6.0), (1000, 30.0, 1.0), (2000, 12.0, 0.3)] {
        let mut scene = Scene::of_walls(&random_segments(&mut draws, count, size, longest));
        for i in 0..20 {
            let at = Pose2::new(draws.uniform(0.0, size), draws.uniform(0.0, size), 0.0);
            let disc = Shape::Disc { radius: draws.uniform(0.01, 0.03 * size) };
            scene = scene.with_obstacle_at(&format!("disc {i}"), at, disc);
        }
        assert!(scene.boundary().cells().is_some());
        for (n, range) in [(5, 100.0), (90, 4.0), (505, 9.0), (1300, 2.0)] {
            for wide in FIELDS {
                let mut scanners = fans(n, range, wide);
                for k in 0..8 {
                    let margin = if k == 0 { 2.0 * size } else { 0.0 };
                    let mut x = || draws.uniform(-margin, size + margin);
                    let (x, y) = (x(), x());
                    hits += check(&mut scanners, &scene, &[], &Pose2 { x, y, theta: draws.uniform(-7.0, 7.0) });
                }
            }
        }
    }
    assert!(hits > 200_000, "{hits}");
}

/// The wall passes through the borders of the fan, so that the first and the last ray meet its ends.
#[test]
fn the_borders_of_a_fan_are_its_first_and_its_last_ray() {
    let mut draws = Stream::new(Seed(13), "scan");
    for n in [2, 8, 9, 64, 65, 4000] {
        for wide in FIELDS {
            let mut scanners = fans(n, 9.0, wide);
            for _ in 0..4 {
                let pose = Pose2::new(draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0), draws.uniform(-PI, PI));
                let at = |bearing: f64, range: f64| {
                    let (s, c) = num::sin_cos(pose.theta + bearing);
                    pose.position() + Vector2::new(c, s) * range
                };
                // to either side of each border, a wall that ends a hair within the fan and one a hair beyond it
                for (border, sign) in [(-0.5 * wide, -1.0), (0.5 * wide, 1.0)] {
                    for hair in [-1e-5, -1e-9, 1e-9, 1e-5] {
                        let (inner, outer) = (border + sign * hair, border + sign * (hair + 1e-4));
                        let scene = Scene::of_walls(&[Segment::new(at(inner, 2.0), at(outer, 2.0))]);
                        let hits = check(&mut scanners, &scene, &[], &pose);
                        let other = wide > 6.0; // the fan's other border may be as near
                        assert!(other || (hits > 0) == (hair < 0.0), "{n} rays over {wide}: {hits} at {hair}");
                    }
                }
            }
        }
    }
}

#[test]
fn lattice_walls_are_seen_as_defined_from_lattice_points_and_beside_them() {
    let mut draws = Stream::new(Seed(2), "scan");
    let mut scanners = scanners(360, 7.0);
    for _ in 0..400 {
        let point = |draws: &mut Stream| Point2::new(draws.below(9) as f64, draws.below(9) as f64);
        let walls: Vec<Segment> = (0..8).map(|_| Segment::new(point(&mut draws), point(&mut draws))).collect();
        let (scene, p) = (Scene::of_walls(&walls), point(&mut draws));
        let eighth = PI / 4.0 * draws.below(8) as f64;
        for theta in [0.0, eighth, 1e-9] {
            check(&mut scanners, &scene, &[], &Pose2 { x: p.x, y: p.y, theta });
            check(&mut scanners, &scene, &[], &Pose2 { x: p.x + 0.25, y: p.y - 1e-3, theta });
        }
    }
}

#[test]
fn the_worlds_and_other_robots_in_them_are_seen_as_defined() {
    let mut draws = Stream::new(Seed(3), "scan");
    for (scene, range) in [(Scene::apartment(), 4.0), (Scene::workbench(), 1.0), (Scene::lot(), 12.0)] {
        let mut scanners = scanners(360, range);
        let (min, max) = (scene.bounds().min, scene.bounds().max);
        for _ in 0..60 {
            let mut pose =
                || Pose2::new(draws.uniform(min.x, max.x), draws.uniform(min.y, max.y), draws.uniform(-PI, PI));
            let capsule =
                Shape::Capsule { a: Point2::new(0.0, 0.0), b: Point2::new(0.5, 0.1), radius: 0.05 }.place(&pose());
            let others =
                [capsule, Shape::Disc { radius: 0.3 }.place(&pose()), Shape::Disc { radius: 1.5 }.place(&pose())];
            check(&mut scanners, &scene, &others, &pose());
        }
    }
}

#[test]
fn large_worlds_are_seen_as_defined_from_inside_and_outside() {
    let mut draws = Stream::new(Seed(6), "scan");
    for (count, size, longest) in [(200, 10.0, 8.0), (1000, 30.0, 1.0), (3000, 12.0, 0.3), (150, 3.0, 3.0)] {
        let mut scene = Scene::of_walls(&random_segments(&mut draws, count, size, longest));
        for i in 0..20 {
            let at = Pose2::new(draws.uniform(0.0, size), draws.uniform(0.0, size), 0.0);
            let disc = Shape::Disc { radius: draws.uniform(0.01, 0.03 * size) };
            scene = scene.with_obstacle_at(&format!("disc {i}"), at, disc);
        }
        assert!(scene.boundary().cells().is_some());
        for (n, range) in [(360, 4.0), (7, 100.0), (701, 0.7)] {
            let mut scanners = scanners(n, range);
            for k in 0..40 {
                let margin = if k % 8 == 0 { 2.0 * size } else { 0.0 };
                let mut x = || draws.uniform(-margin, size + margin);
                let (x, y) = (x(), x());
                check(&mut scanners, &scene, &[], &Pose2 { x, y, theta: draws.uniform(-7.0, 7.0) });
            }
        }
    }
}

#[test]
fn a_ray_that_hits_beyond_the_cells_visited_is_not_done() {
    // long walls, close together: those listed in the cells visited reach far beyond these cells, where nearer walls
    // begin
    let mut draws = Stream::new(Seed(8), "scan");
    let mut scanners = scanners(360, 4.0);
    for _ in 0..4 {
        let scene = Scene::of_walls(&random_segments(&mut draws, 300, 6.0, 1.5));
        for _ in 0..150 {
            let pose = Pose2::new(draws.uniform(0.0, 6.0), draws.uniform(0.0, 6.0), draws.uniform(-PI, PI));
            check(&mut scanners, &scene, &[], &pose);
        }
    }
}

#[test]
fn a_sensor_a_hair_from_a_wall_or_from_its_line_leaks_no_ray() {
    // from inside the closed room every ray hits, wherever the sensor touches no wall
    let corners = [(0.1, 0.2), (5.3, 0.7), (4.9, 6.1), (-0.3, 5.5), (0.1, 0.2)].map(|(x, y)| Point2::new(x, y));
    let room = Scene::of_walls(&corners.windows(2).map(|w| Segment::new(w[0], w[1])).collect::<Vec<_>>());
    let mut draws = Stream::new(Seed(4), "scan");
    let mut scanner = Scanner::new(RangeSensor { n_rays: 360, max_range: 20.0 });
    let (mut ranges, mut seen) = ([0.0; 360], 0);
    for _ in 0..2000 {
        let i = draws.below(4) as usize;
        let (a, b) = (corners[i], corners[i + 1]);
        let inward = Point2::new(2.5, 3.0) - a;
        let hair = num::exp(draws.uniform(-39.0, -5.0));
        let p = a + (b - a) * draws.uniform(0.0, 1.0) + inward * hair;
        if corners.windows(2).any(|w| orientation(w[0], w[1], p) <= 0.0) {
            continue; // rounded onto the wall or through it
        }
        seen += 1;
        scanner.scan_into(&room, &[], &Pose2 { x: p.x, y: p.y, theta: draws.uniform(-PI, PI) }, &mut ranges);
        assert!(ranges.iter().all(|r| r.is_finite()), "{p} {hair}");
    }
    assert!(seen > 1000, "{seen}");
}

#[test]
fn a_wall_on_the_sensors_line_is_seen_no_nearer_and_no_farther_than_it_is() {
    // a thin wedge, where p x q is mostly rounding: from the origin, a wall along the ray at bearing 1/360 turn
    let mut draws = Stream::new(Seed(5), "scan");
    let sensor = RangeSensor { n_rays: 360, max_range: 20.0 };
    let mut scanner = Scanner::new(sensor);
    let mut ranges = [0.0; 360];
    let mut seen = 0;
    for _ in 0..3000 {
        let k = draws.below(360) as usize;
        let (x, y) = sensor.direction(k as u32);
        let (near, far) = (draws.uniform(0.5, 5.0), draws.uniform(6.0, 15.0));
        let off = draws.uniform(-3e-15, 3e-15);
        let wall = Segment::new(Point2::new(near * x, near * y), Point2::new(far * x - off * y, far * y + off * x));
        scanner.scan_into(&Scene::of_walls(&[wall]), &[], &Pose2::IDENTITY, &mut ranges);
        assert!(ranges.iter().enumerate().all(|(i, r)| i == k || r.is_infinite()));
        if ranges[k].is_finite() {
            seen += 1;
            assert!(ranges[k] > near - 1e-12 && ranges[k] < far + 1e-12, "{} of {near} to {far}", ranges[k]);
        }
    }
    assert!(seen > 300, "{seen}");
}

#[test]
fn a_short_buffer_takes_as_many_rays_as_fit_and_a_long_one_keeps_its_rest() {
    let scene = Scene::apartment();
    let sensor = RangeSensor { n_rays: 20, max_range: 4.0 };
    let pose = Pose2::new(6.0, 4.0, 0.3);
    let all = sensor.scan_from(&scene, &[], &pose);
    let mut scanner = Scanner::new(sensor);
    for n in [0, 1, 8, 13, 20, 30] {
        let mut ranges = vec![-1.0; n];
        scanner.scan_into(&scene, &[], &pose, &mut ranges);
        let m = n.min(20);
        assert_eq!(ranges[..m], all[..m]);
        assert!(ranges[m..].iter().all(|&r| r == -1.0));
    }
}
