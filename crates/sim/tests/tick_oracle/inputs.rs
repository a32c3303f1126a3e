//! The changes by the script before a tick, and the motion that the driver or the tour then asks for.

use std::f64::consts::TAU;

use libm::{atan2, cos, sin};
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Placed, Point2};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{HITCH, RUSTY};
use motion_lab_sim::run::{Event, RobotInput, RobotState};

use super::cases::Case;
use super::meetings::{Answer, Cut, clearance};
use super::robots::{Kind, Motion, shapes, wrap};
use oracle::short;

/// The length of a tick, seconds.
const DT: f64 = 0.05;

/// Applies an event to its robot, or counts it as refused.
pub fn apply(case: &Case, robots: &mut [RobotState], event: &Event) {
    let id = case.residents.iter().position(|a| a.name == event.robot).unwrap();
    let kind = case.residents[id].kind;
    let around = case.around(robots, id);
    let now = &mut robots[id];
    let put = |q: Option<Vec<f64>>| q.filter(|q| clearance(&shapes(kind, q), &around) > 0.0);
    let values = |q: &[motion_lab_sim::run::Quantized]| q.iter().map(|x| x.0 as f64 / 1_048_576.0).collect::<Vec<_>>();
    match &event.input {
        RobotInput::Drive(a, b) if !kind.is_arm() => {
            (now.manual, now.channels) = (true, [*a, *b]);
            now.target.clear();
        }
        RobotInput::MoveTo(to) if kind.is_arm() && to.len() == kind.links().len() => {
            now.manual = true;
            now.target = values(to).into_iter().map(wrap).collect();
        }
        RobotInput::Teleport(to) => match put(configuration_at(kind, &now.configuration, &values(to))) {
            Some(q) => put_at(now, &q),
            None => now.refusals += 1,
        },
        RobotInput::SetTrailer(on) if kind == Kind::Hitch => {
            if *on == (now.configuration.len() == 4) {
                now.manual = true; // nothing else changes
                return;
            }
            let mut q = now.configuration[..3].to_vec();
            q.extend(on.then_some(q[2]));
            match put(Some(q)) {
                Some(q) => put_at(now, &q),
                None => now.refusals += 1,
            }
        }
        RobotInput::Release => {
            if now.manual && kind == Kind::Rusty {
                now.extra[2] =
                    waypoint_to_resume(&case.arenas[case.residents[id].arena].tour, &now.configuration, &around) as f64;
            }
            (now.manual, now.channels) = (false, [0, 0]);
            now.target.clear();
        }
        _ => now.refusals += 1,
    }
}

/// Puts a robot at a configuration.
fn put_at(robot: &mut RobotState, q: &[f64]) {
    robot.manual = true;
    robot.target.clear();
    robot.configuration = Coordinates::from_slice(q);
}

/// The configuration with these coordinates, of a robot now at `now`. Three coordinates place a trailer straight behind
/// the car.
fn configuration_at(kind: Kind, now: &[f64], to: &[f64]) -> Option<Vec<f64>> {
    let mut q = to.to_vec();
    match kind {
        Kind::Reach | Kind::Reach3 => {
            q.iter_mut().for_each(|angle| *angle = wrap(*angle));
            return (q.len() == kind.links().len()).then_some(q);
        }
        Kind::Hitch if now.len() == 4 && to.len() == 3 => q.push(to[2]),
        _ => {}
    }
    q.iter_mut().skip(2).for_each(|angle| *angle = wrap(*angle));
    (q.len() == now.len()).then_some(q)
}

fn distance(q: &[f64], p: &Point2) -> f64 {
    let (x, y) = (p.x - q[0], p.y - q[1]);
    (x * x + y * y).sqrt()
}

/// The waypoint at which Rusty resumes its tour: the nearest that a straight line reaches, or else the nearest.
fn waypoint_to_resume(tour: &[Point2], q: &[f64], around: &[Placed]) -> usize {
    let mut order: Vec<usize> = (0..tour.len()).collect();
    order.sort_by(|a, b| distance(q, &tour[*a]).total_cmp(&distance(q, &tour[*b])));
    let reachable = |to: &&usize| Cut::new(&Motion::of_line(q, &tour[**to]), around, 1e-6).blocked == Answer::No;
    order.iter().find(reachable).or(order.first()).copied().unwrap_or(0)
}

/// The speed and turn rate of a touring Rusty, which pursues waypoint number `next`.
fn toward_waypoint(tour: &[Point2], q: &[f64], next: &mut f64) -> (f64, f64) {
    if tour.is_empty() {
        *next = 0.0;
        return (0.0, 0.0);
    }
    if distance(q, &tour[*next as usize]) <= 0.12 {
        *next = if *next as usize + 1 == tour.len() { 0.0 } else { *next + 1.0 };
    }
    let goal = tour[*next as usize];
    if distance(q, &goal) <= 0.12 {
        return (0.0, 0.0);
    }
    let error = short(q[2], atan2(goal.y - q[1], goal.x - q[0]));
    let speed = if error.abs() > 0.6 { 0.0 } else { RUSTY.max_speed * cos(error) };
    (speed, (4.0 * error).clamp(-RUSTY.max_turn_rate, RUSTY.max_turn_rate))
}

/// The joint angles of a touring arm after this tick: each joint is on a sinusoid drawn once for the run, or on its way
/// there at 2 rad/s.
fn on_sinusoids(mut draws: Stream, start: &[f64], q: &[f64], tick: u64) -> Vec<f64> {
    let (base, time) = (draws.uniform(0.5, 0.8), tick as f64 * DT);
    let joint = |(k, (start, q)): (usize, (&f64, &f64))| {
        let amplitude = draws.uniform(0.8, 1.4);
        let frequency = base * ([2.0, 3.0, 5.0][k] / 2.0_f64).sqrt();
        let phase = draws.uniform(0.0, TAU);
        let goal = start + amplitude * (sin(frequency * time + phase) - sin(phase));
        wrap(q + short(*q, goal).clamp(-2.0 * DT, 2.0 * DT))
    };
    start.iter().zip(q).enumerate().map(joint).collect()
}

/// The speed and steering angle of a touring Hitch: six legs of ten seconds, backward and forward in turn.
fn reversing(mut draws: Stream, tick: u64) -> (f64, f64) {
    let legs: Vec<f64> = (0..6).map(|_| 0.9 * HITCH.max_steer * draws.uniform(-1.0, 1.0)).collect();
    let leg = ((tick - 1) / 200 % 6) as usize;
    (0.5 * HITCH.max_speed * [-1.0, 1.0][leg % 2], legs[leg])
}

/// The motion that the driver or the tour asks for. Rusty's wheels turn and slip even where the robot is then held. An
/// arm arrives at its target.
pub fn motion_of(case: &Case, id: usize, tick: u64, robot: &mut RobotState) -> Motion {
    let resident = &case.residents[id];
    let stream = |name: &str| Stream::new(case.seed, &format!("{}/{name}", resident.name));
    let q = robot.configuration.to_vec();
    let [a, b] = robot.channels.map(|channel| f64::from(channel) / 128.0);
    match resident.kind {
        Kind::Rusty => {
            let (speed, rate) = if robot.manual {
                (a * RUSTY.max_speed, b * RUSTY.max_turn_rate)
            } else {
                toward_waypoint(&case.arenas[resident.arena].tour, &q, &mut robot.extra[2])
            };
            let mut slips = stream("slip").at(tick);
            let mut ground = [0.0, 0.0];
            for (wheel, side) in [-1.0, 1.0].into_iter().enumerate() {
                let rolled = (speed + side * 0.5 * RUSTY.track * rate) * DT;
                robot.extra[wheel] += rolled / RUSTY.wheel_radius;
                ground[wheel] = rolled * (1.0 + RUSTY.max_slip * slips.uniform(-1.0, 1.0));
            }
            Motion::of_wheels(&q, ground[0], ground[1])
        }
        Kind::Hitch => {
            let (speed, steering) =
                if robot.manual { (a * HITCH.max_speed, b * HITCH.max_steer) } else { reversing(stream("tour"), tick) };
            Motion::of_car(&q, speed * DT, steering)
        }
        Kind::Reach | Kind::Reach3 => {
            let to = if !robot.manual {
                on_sinusoids(stream("tour"), &resident.start, &q, tick)
            } else if robot.target.is_empty() {
                q.clone()
            } else {
                robot.target.to_vec()
            };
            robot.target.clear();
            Motion::of_joints(resident.kind, &q, &to)
        }
    }
}
