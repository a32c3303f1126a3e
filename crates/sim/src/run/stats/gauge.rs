//! `Gauge`, which measures the robots of a run frame by frame: where they are, how far they went, how near things are.

use std::collections::BTreeMap;

use super::standing::StandingScenes;
use crate::run::{Frame, Quantized, RobotInput, RobotState, Script};
use crate::tour::TourConfig;
use motion_lab_core::collision::Collision;
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _, Kinds, RobotKind};
use motion_lab_core::geometry::{Footprint, Point2, Pose2};
use motion_lab_core::num::hypot;
use motion_lab_core::robots::{AnyRobot, Robot, WheelTurns};
use motion_lab_core::worlds::Resident;

/// What is measured of a robot at a frame.
#[derive(Clone, Debug)]
pub(super) struct GaugeReading {
    /// Distance from its footprint to the nearest obstacle of its world, metres; 0 in contact, infinity without any.
    /// `None` for a robot without a known footprint.
    pub(super) clearance: Option<f64>,
    /// Signed length of its path since the frame before, metres, negative for backward; `None` for a robot without a
    /// known path, at the first frame, and where it was put somewhere.
    pub(super) step: Option<f64>,
    /// Distance by its wheels' encoders since the start, metres; `None` without encoders.
    pub(super) encoders: Option<f64>,
}

/// A robot of the run.
struct GaugedRobot {
    resident: Resident,
    world: usize,
    about: Option<&'static RobotKind>,
    /// Where it was at the last frame.
    before: Option<PathPosition>,
    refusals: u32,
}

/// Where a robot is, as its path counts.
#[derive(Clone, Copy)]
enum PathPosition {
    /// The pose of a body that drives.
    Body(Pose2),
    /// An arm's tip, or where another robot's first part is.
    Point(Point2),
}

impl PathPosition {
    /// The signed length of the path from here to `to`, metres: of a body the arc of a constant twist, of a point the
    /// straight line.
    fn step(self, to: PathPosition) -> Option<f64> {
        match (self, to) {
            (PathPosition::Body(from), PathPosition::Body(to)) => {
                let twist = to.boxminus(&from);
                let length = hypot(twist.dx, twist.dy);
                Some(if twist.dx < 0.0 { -length } else { length })
            }
            (PathPosition::Point(from), PathPosition::Point(to)) => Some(hypot(to.x - from.x, to.y - from.y)),
            _ => None,
        }
    }

    /// The distance to another place, metres.
    fn distance(self, to: PathPosition) -> f64 {
        let [a, b] = [self, to].map(|place| match place {
            PathPosition::Body(pose) => pose.position(),
            PathPosition::Point(point) => point,
        });
        hypot(b.x - a.x, b.y - a.y)
    }
}

/// Measures the robots of a run frame by frame.
pub(super) struct Gauge<'a> {
    script: &'a Script,
    kinds: &'a Kinds,
    standing: StandingScenes,
    robots: Vec<GaugedRobot>,
    /// Whether clearances are measured, which takes most of the time.
    measures_clearance: bool,
}

impl<'a> Gauge<'a> {
    /// A gauge of the runs of this configuration and script, with these kinds of robots.
    pub(super) fn new(config: &TourConfig, script: &'a Script, kinds: &'a Kinds, measures_clearance: bool) -> Self {
        let residents = config.worlds.iter().enumerate().flat_map(|(i, w)| w.robots.iter().map(move |r| (i, r)));
        let robots = residents.map(|(world, resident)| GaugedRobot {
            resident: resident.clone(),
            world,
            about: kinds.of(&resident.kind),
            before: None,
            refusals: 0,
        });
        let robots = robots.collect();
        Gauge { script, kinds, standing: StandingScenes::new(config, script), robots, measures_clearance }
    }

    /// The same, which measures no clearances.
    pub(super) fn without_clearance(self) -> Self {
        Gauge { measures_clearance: false, ..self }
    }

    /// Measures the robots at the next frame, in the order of their ids.
    pub(super) fn read(&mut self, frame: &Frame) -> Vec<GaugeReading> {
        let Gauge { script, kinds, standing, robots, measures_clearance } = self;
        standing.follow(frame);
        let from = script.events.partition_point(|e| e.tick < frame.tick);
        let due = script.events[from..].iter().take_while(|e| e.tick == frame.tick);
        let mut teleports: BTreeMap<&str, Vec<&[Quantized]>> = BTreeMap::new();
        for event in due {
            if let RobotInput::Teleport(to) = &event.input {
                teleports.entry(&event.robot).or_default().push(to);
            }
        }
        let read = |(measured, state): (&mut GaugedRobot, &RobotState)| {
            let GaugedRobot { resident, world, about, before, refusals } = measured;
            let lab = AnyRobot::sized(&resident.kind, &state.configuration, resident.sizes.as_ref());
            let footprint = match &lab {
                Some((robot, q)) => Some(robot.footprint(q)),
                None => kinds.footprint(&resident.kind, &state.configuration),
            };
            let now = place(*about, lab.as_ref(), footprint.as_ref(), &state.configuration);
            // a tick in which the robot was put somewhere is no part of its path; where it refused some of the tick's
            // inputs, it was put if it is nearer to where it should have been put than to where it was
            let all_taken = state.refusals == *refusals;
            let was_put = |before: PathPosition, now: PathPosition| {
                let is_near = |to: &&[Quantized]| {
                    let to: Vec<f64> = to.iter().map(|c| c.value()).collect();
                    let lab = AnyRobot::sized(&resident.kind, &to, resident.sizes.as_ref());
                    let to = place(*about, lab.as_ref(), kinds.footprint(&resident.kind, &to).as_ref(), &to);
                    to.is_some_and(|to| now.distance(to) < now.distance(before))
                };
                teleports.get(resident.name.as_str()).is_some_and(|to| all_taken || to.iter().any(is_near))
            };
            let both = before.zip(now).filter(|(before, now)| !was_put(*before, *now));
            let step = both.and_then(|(before, now)| before.step(now));
            (*before, *refusals) = (now, state.refusals);
            let scene = standing.scene(*world).filter(|_| *measures_clearance);
            let clearance = scene.zip(footprint).map(|(scene, footprint)| scene.distance(&footprint));
            GaugeReading { clearance, step, encoders: lab.and_then(|(robot, _)| encoders(&robot, state)) }
        };
        robots.iter_mut().zip(&frame.robots).map(read).collect()
    }
}

fn place(
    about: Option<&RobotKind>,
    lab: Option<&(AnyRobot, AnyConfiguration)>,
    footprint: Option<&Footprint>,
    coordinates: &[f64],
) -> Option<PathPosition> {
    if about.is_some_and(|kind| kind.drives) {
        return Pose2::from_coordinates(coordinates.get(..3)?).map(PathPosition::Body);
    }
    match lab {
        Some((robot, q)) => Some(PathPosition::Point(robot.reference(q))),
        None => Some(PathPosition::Point(footprint?.parts().first()?.pose().position())),
    }
}

/// The distance by the encoders of a rover's wheels, metres.
fn encoders(robot: &AnyRobot, state: &RobotState) -> Option<f64> {
    let (AnyRobot::Rusty(rover), [left, right, ..]) = (robot, &state.extra[..]) else { return None };
    Some(rover.travelled(&rover.counts(&WheelTurns { left: *left, right: *right })))
}
