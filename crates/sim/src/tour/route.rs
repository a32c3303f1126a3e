//! The drive mode `route`: robots that follow the routes of their world, each behind its own reference.

use std::collections::BTreeMap;
use std::sync::Arc;

use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::num::{cos, greater, lesser, sin, wrap};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::{RouteError, RoutePath, World};

/// The least part of a route's speed that a seed chooses.
const SLOWEST: f64 = 0.9;

/// The part of its top speed that a robot's route may ask for.
const RESERVED: f64 = 0.9;

/// How fast a robot makes up for what it lies behind its reference, per second.
const CATCH_UP: f64 = 2.0;

/// Largest part of the error that one tick's steering removes. With more, a fast robot would overshoot.
const PER_TICK: f64 = 0.2;

/// What moves along a route: a reference that goes round and round at constant speed, and a robot that tracks it.
///
/// The reference is a pure function of the time, the seed and where the robot starts: at time 0 it is the point of the
/// route nearest the start. All references of a route move at the same speed, so they keep their distances along it for
/// ever. A robot that is driven elsewhere, and then let go, heads for its reference.
#[derive(Clone, Debug)]
pub struct RouteTour {
    path: Arc<RoutePath>,
    /// Metres per second.
    speed: f64,
    /// The route's own speed, metres per second; no seed chooses a higher one.
    fastest: f64,
    /// Arc length of the reference at time 0, metres.
    start: f64,
}

/// The speed and the turn rate that a robot needs to track its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracking {
    /// Forward speed, metres per second, at least 0.
    pub v: f64,
    /// Turn rate, radians per second, counter-clockwise positive.
    pub omega: f64,
}

/// A stretch of time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Where it begins, seconds.
    pub time: f64,
    /// How long it is, seconds.
    pub dt: f64,
}

impl Step {
    /// The step of tick number `tick` (from 1) of `dt` seconds each.
    pub fn of_tick(tick: u64, dt: f64) -> Self {
        Step { time: tick.saturating_sub(1) as f64 * dt, dt }
    }
}

impl RouteTour {
    /// The same reference for a robot that starts at `position`.
    #[must_use]
    pub fn starting_at(&self, position: Point2) -> Self {
        RouteTour { start: self.path.nearest(position), ..self.clone() }
    }

    /// The route's line.
    pub fn path(&self) -> &RoutePath {
        &self.path
    }

    /// The reference's speed, metres per second.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The route's own speed, metres per second: the highest that a seed chooses.
    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Whether a robot of this top speed, metres per second, can follow: it keeps a tenth of it to catch up.
    pub fn suits(&self, top_speed: f64) -> bool {
        self.fastest <= RESERVED * top_speed
    }

    /// The reference at `time` seconds.
    pub fn reference(&self, time: f64) -> Pose2 {
        self.path.at(self.start + self.speed * time)
    }

    /// The control for a step that a robot at `q` begins. `stiffness`, per metre, says on how short a way the robot
    /// returns to the line: an error falls by the factor e in about `1 / stiffness` metres.
    ///
    /// The tracking law of Kanayama, Kimura, Miyazaki and Noguchi, "A stable tracking control method for an autonomous
    /// mobile robot" (ICRA 1990): with the reference at `(x, y, theta)` in the robot's frame, moving at `v` and
    /// `omega`, the robot's speed is `v cos theta + K_x x` and its turn rate `omega + v (K_y y + K_theta sin theta)`.
    /// Here `K_theta = 2 sqrt(K_y)`, so that the robot swings into the line without overshoot; the speed is never
    /// negative; and `omega` is the reference's mean over the step, with which an exact robot stays on a line and on an
    /// arc.
    pub fn track(&self, q: &Pose2, step: Step, stiffness: f64) -> Tracking {
        let Step { time, dt } = step;
        let (now, next) = (self.reference(time), self.reference(time + dt));
        let off = Pose2 { theta: -q.theta, ..*q }.rotate(Vector2::new(now.x - q.x, now.y - q.y));
        let heading = wrap(now.theta - q.theta);
        let k = lesser(stiffness, PER_TICK / (self.speed * dt));
        let v = self.speed * cos(heading) + CATCH_UP * off.x;
        let omega = wrap(next.theta - now.theta) / dt + self.speed * (k * k * off.y + 2.0 * k * sin(heading));
        Tracking { v: greater(v, 0.0), omega }
    }
}

/// The routes of a world in a run, by name, with the speeds that the seed chooses.
#[derive(Clone, Debug, Default)]
pub struct RouteTours {
    tours: BTreeMap<String, RouteTour>,
}

impl RouteTours {
    /// The routes of `world`. The seed chooses each one's speed, between nine tenths of its route's and the whole, from
    /// the stream `<route>/route`.
    ///
    /// # Errors
    /// The name of the first route that is refused, and why. World files are checked for this.
    pub fn of_world(world: &World, seed: Seed) -> Result<Self, (String, RouteError)> {
        let tour = |route: &motion_lab_core::worlds::Route| {
            let path = route.path().map_err(|source| (route.name.clone(), source))?;
            let part = Stream::new(seed, &format!("{}/route", route.name)).uniform(SLOWEST, 1.0);
            Ok((
                route.name.clone(),
                RouteTour { path: Arc::new(path), speed: part * route.speed, fastest: route.speed, start: 0.0 },
            ))
        };
        Ok(RouteTours { tours: world.routes.iter().map(tour).collect::<Result<_, _>>()? })
    }

    /// The route of this name, its reference at the beginning of its line.
    pub fn get(&self, name: &str) -> Option<&RouteTour> {
        self.tours.get(name)
    }
}

/// What a robot does when nobody drives it.
#[derive(Clone, Debug)]
pub enum Touring<T> {
    /// Its kind's own tour.
    Own(T),
    /// The route that its world gives it.
    Route(RouteTour),
}

impl<T> From<T> for Touring<T> {
    fn from(own: T) -> Self {
        Touring::Own(own)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use motion_lab_core::geometry::{Aabb, Tangent2};
    use motion_lab_core::worlds::Route;

    /// A world with one route: the square of side 4 about (2, 2), counter-clockwise, with corners of radius 1.
    fn square(speed: f64) -> World {
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Point2::new(x, y));
        let route = Route { name: "round".into(), points: corners.to_vec(), radius: 1.0, speed };
        World { routes: vec![route], ..World::empty("w", Aabb { min: corners[0], max: corners[2] }) }
    }

    fn tour(seed: u64, speed: f64, start: (f64, f64)) -> RouteTour {
        let tours = RouteTours::of_world(&square(speed), Seed(seed)).unwrap();
        assert!(tours.get("square").is_none());
        tours.get("round").unwrap().starting_at(Point2::new(start.0, start.1))
    }

    #[test]
    fn the_reference_of_a_square_is_its_closed_form() {
        // nearest to (2, -0.5) is the middle of the south side; the way from there is 1 m, a quarter turn, 2 m, ..
        let tour = tour(7, 0.5, (2.0, -0.5));
        let at = |way: f64| tour.reference(way / tour.speed());
        let quarter = 0.25 * TAU;
        for (way, x, y, theta) in [
            (0.0, 2.0, 0.0, 0.0),
            (0.75, 2.75, 0.0, 0.0),
            (1.0 + 0.5 * quarter, 3.0 + eighth(), 1.0 - eighth(), 0.5 * quarter),
            (2.0 + quarter, 4.0, 2.0, quarter),
            (4.0 + 2.0 * quarter, 2.0, 4.0, 2.0 * quarter),
            (6.0 + 3.0 * quarter, 0.0, 2.0, -quarter),
            (8.0 + TAU + 0.5, 2.5, 0.0, 0.0),
            (1000.0 * (8.0 + TAU) - 0.5, 1.5, 0.0, 0.0),
        ] {
            let found = at(way);
            let off = [found.x - x, found.y - y, wrap(found.theta - theta)];
            assert!(off.iter().all(|d| d.abs() < 1e-9), "after {way} m: {found}, not ({x}, {y}, {theta})");
        }
    }

    /// The sine and the cosine of an eighth of a turn.
    fn eighth() -> f64 {
        motion_lab_core::num::sqrt(0.5)
    }

    #[test]
    fn a_seed_chooses_a_speed_and_all_of_a_route_share_it() {
        let speeds: Vec<f64> = (0..50).map(|seed| tour(seed, 0.5, (2.0, 0.0)).speed()).collect();
        assert!(speeds.iter().all(|v| (0.45..=0.5).contains(v)), "{speeds:?}");
        let (slowest, fastest) = (speeds.iter().copied().fold(1.0, lesser), speeds.iter().copied().fold(0.0, greater));
        assert!(fastest - slowest > 0.04, "{slowest} to {fastest}");
        let (a, b) = (tour(3, 0.5, (2.0, 0.0)), tour(3, 0.5, (4.0, 2.0)));
        // at a tenth of a second and after a day they are as far apart as at first
        for time in [0.0, 0.1, 86_400.0] {
            let [a, b] = [&a, &b].map(|tour| tour.path().nearest(tour.reference(time).position()));
            assert!((apart(a, b, 8.0 + TAU) - (2.0 + 0.25 * TAU)).abs() < 1e-6, "{time}: {a} {b}");
        }
        assert!(a.suits(0.6) && !a.suits(0.55), "nine tenths of 0.55 are less than 0.5");
    }

    /// How far apart two places of a closed line are.
    fn apart(a: f64, b: f64, round: f64) -> f64 {
        let way = (b - a).abs();
        lesser(way, round - way)
    }

    /// The distances from its reference of a robot without slip that starts at `q`, tick by tick.
    fn driven(tour: &RouteTour, mut q: Pose2, stiffness: f64, ticks: u64) -> Vec<f64> {
        let dt = 0.05;
        let mut off = Vec::new();
        for tick in 1..=ticks {
            let Tracking { v, omega } = tour.track(&q, Step::of_tick(tick, dt), stiffness);
            q = q.boxplus(&Tangent2::new(v * dt, 0.0, omega * dt));
            off.push((q.position() - tour.reference(tick as f64 * dt).position()).norm());
        }
        off
    }

    #[test]
    fn an_exact_robot_stays_on_its_reference() {
        for speed in [0.1, 0.5, 2.0] {
            let tour = tour(1, speed, (2.0, 0.0));
            let off = driven(&tour, Pose2::new(2.0, 0.0, 0.0), 4.0, 4000);
            // where a line meets an arc within a tick, the mean turn rate errs by (v dt)^2 / (8 R) or less
            let step = tour.speed() * 0.05;
            assert!(off.iter().all(|d| *d <= step * step / 4.0 + 1e-9), "{speed}: {off:?}");
        }
    }

    #[test]
    fn a_robot_off_its_line_returns_as_fast_as_its_stiffness_says() {
        let tour = tour(1, 0.5, (2.0, 0.0));
        for (stiffness, metres) in [(4.0, 2.0), (0.8, 10.0)] {
            for q in [Pose2::new(2.0, 0.2, 0.0), Pose2::new(1.8, -0.2, 0.5), Pose2::new(2.2, 0.0, -0.5)] {
                let off = driven(&tour, q, stiffness, 2000);
                // (1 + k s) e^(-k s) of the offset is left after s metres: 0.3 % after 8 / k
                let by = (metres / tour.speed() / 0.05) as usize;
                assert!(off[by..].iter().all(|d| *d < 0.01), "{stiffness} {q}: {:?}", off[by]);
                assert!(off[by / 20] > 0.03, "{stiffness} {q}: at first it is off, {}", off[by / 20]);
            }
        }
        // one that stands far ahead waits, and one that is far behind catches up
        let ahead = tour.track(&Pose2::new(3.0, 0.0, 0.0), Step::of_tick(1, 0.05), 4.0);
        assert!(ahead.v == 0.0);
        let behind = tour.track(&Pose2::new(1.0, 0.0, 0.0), Step::of_tick(1, 0.05), 4.0);
        assert!(behind.v > 2.0);
    }
}
