//! `Rehearsal`, a robot alone in its world, driven tick by tick while its script is written.

use super::{PlayError, PlayStage, PlayedPath};
use crate::run::{DT, Event, Quantized, RobotInput, Script};
use crate::simulation::robot::driven::InputTarget;
use crate::simulation::robot::spawn::{SpawnableRobot, routes, slip, tour};
use crate::simulation::tick::drive::Driver;
use crate::simulation::tick::settle::{cut_among, end_of, is_there};
use crate::simulation::{DriveMode, InputRefusal, SimulatedRobot};
use motion_lab_core::collision::{Checker, EdgeVerdict, Scene, Surroundings};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::Drivable;

/// The greatest number of ticks of a script that plays a path: an hour.
const MAX_TICKS: u64 = 72_000;

/// A robot alone in its world, driven by the functions that a tick of the simulator consists of. Every motion is
/// certified before it is made.
pub(super) struct Rehearsal<R: SimulatedRobot> {
    robot: R,
    name: String,
    checker: Checker<R>,
    tour: R::Tour,
    slip: Stream,
    driven: InputTarget<R>,
    tick: u64,
    tube: f64,
    events: Vec<Event>,
    clearance: f64,
    strayed: f64,
}

impl<R: SimulatedRobot> Rehearsal<R> {
    /// The robot at its start, of a kind with this model.
    pub(super) fn new(model: &R, kind: &'static str, stage: &PlayStage<'_>) -> Result<Self, PlayError> {
        let PlayStage { world, robot: name, seed, tube } = *stage;
        let Some(resident) = world.robots.iter().find(|r| r.name == name) else {
            return Err(PlayError::NoSuchRobot { robot: name.to_owned(), world: world.name.clone() });
        };
        if resident.kind != kind {
            let (robot, found) = (name.to_owned(), resident.kind.clone());
            return Err(PlayError::OtherKind { robot, kind: found, wanted: kind });
        }
        if let Some(other) = world.robots.iter().find(|r| r.name != name) {
            return Err(PlayError::Company { other: other.name.clone(), world: world.name.clone() });
        }
        let SpawnableRobot { robot, q, .. } = SpawnableRobot::new(model, resident, world)?;
        let routes = routes(world, seed).map_err(crate::simulation::SpawnError::from)?;
        Ok(Rehearsal {
            tour: tour(&robot, seed, (world, &routes), resident, &q)?,
            slip: slip(seed, name),
            driven: InputTarget { q, mode: DriveMode::default(), extra: robot.initial_extra() },
            checker: Checker::new(Scene::of_world(world), robot.clone()),
            robot,
            name: name.to_owned(),
            tick: 0,
            tube,
            events: Vec::new(),
            clearance: f64::INFINITY,
            strayed: 0.0,
        })
    }

    /// The robot, of its own sizes.
    pub(super) fn robot(&self) -> &R {
        &self.robot
    }

    pub(super) fn q(&self) -> R::Configuration {
        self.driven.q
    }

    /// The tick that is over.
    pub(super) fn tick(&self) -> u64 {
        self.tick
    }

    /// Writes an input for the next tick into the script, and applies it.
    pub(super) fn input(&mut self, input: RobotInput) -> Result<(), PlayError> {
        let kind = input.kind();
        let surroundings = || Surroundings { scene: self.checker.scene(), others: &[] };
        let (after, refused) = self.driven.clone().after(&self.robot, &self.tour, &input, surroundings);
        if let Some(why) = refused {
            let reason = InputRefusal::of(why, kind, &self.robot, &surroundings());
            let tick = self.tick + 1;
            return Err(if tick == 1 {
                PlayError::Start { input: kind, reason }
            } else {
                PlayError::Refused { tick, input: kind, reason }
            });
        }
        self.driven = after;
        self.events.push(Event { tick: self.tick + 1, robot: self.name.clone(), input });
        Ok(())
    }

    /// Puts the robot at these coordinates before its next tick.
    pub(super) fn teleport(&mut self, coordinates: &[f64]) -> Result<(), PlayError> {
        self.input(RobotInput::Teleport(quantized(coordinates)?))
    }

    /// Runs a tick. Its motion is proven free, and goes as far as it would without obstacles. Returns the motion.
    pub(super) fn step(&mut self) -> Result<R::Drive, PlayError> {
        self.tick += 1;
        let tick = self.tick;
        if tick > MAX_TICKS {
            return Err(PlayError::TooLong(MAX_TICKS));
        }
        let InputTarget { q, mode, extra } = &mut self.driven;
        let driver = Driver { robot: &self.robot, tour: &self.tour, mode, stands: false };
        self.slip.seek(tick);
        let control = driver.control(tick, q, extra, &mut self.slip);
        let fitted = self.robot.fitted(q);
        let motion = fitted.drive(q, &control, DT).map_err(|source| PlayError::Configuration { tick, source })?;
        match self.checker.motion_verdict(&motion) {
            EdgeVerdict::Free { clearance } => self.clearance = lesser(clearance, self.clearance),
            _ => return Err(PlayError::NotFree { tick }),
        }
        let cut = cut_among::<R>(self.checker.scene(), &[], &motion);
        if cut.contact || cut.until != 1.0 {
            return Err(PlayError::Held { tick });
        }
        if let Some(end) = end_of(&self.robot, &motion, 1.0) {
            *q = end;
        }
        if mode.target.is_some_and(|target| is_there(&target, q)) {
            mode.target = None;
        }
        Ok(motion)
    }

    /// Notes how far the robot has strayed from the path in the tick that is over.
    pub(super) fn stray(&mut self, strayed: f64) -> Result<(), PlayError> {
        self.strayed = greater(strayed, self.strayed);
        // a distance that is not a number is none within the tube
        if strayed <= self.tube {
            return Ok(());
        }
        Err(PlayError::LeavesTube { tick: self.tick, strayed, tube: self.tube })
    }

    /// How far any point of the robot is from its place at `planned`, at most, metres.
    pub(super) fn off(&self, planned: &R::Configuration) -> Result<f64, PlayError> {
        let q = self.driven.q;
        off(&self.robot.fitted(&q), planned, &q).map_err(|source| PlayError::Configuration { tick: self.tick, source })
    }

    /// The script, when the robot stands at the path's end, this far from its place there.
    pub(super) fn end(self, missed: f64) -> Result<PlayedPath, PlayError> {
        let script = Script::new(self.events, Vec::new());
        script.check()?;
        let Rehearsal { tick: ticks, clearance, strayed, .. } = self;
        Ok(PlayedPath { script, ticks, strayed, missed, clearance })
    }
}

/// How far any point of a robot moves from one configuration to another, at most, metres: the bound of the chart line.
fn off<R: Drivable>(
    robot: &R,
    from: &R::Configuration,
    to: &R::Configuration,
) -> Result<f64, motion_lab_core::robots::ConfigurationError> {
    if from == to {
        return Ok(0.0);
    }
    let rates = robot.edge_rates(&from.in_chart(), &to.in_chart())?;
    Ok(rates.iter().fold(0.0, |most, part| greater(part.speed, most)))
}

/// Coordinates as scripts hold them.
pub(super) fn quantized(coordinates: &[f64]) -> Result<Vec<Quantized>, PlayError> {
    coordinates.iter().map(|x| Quantized::try_new(*x).ok_or(PlayError::Coordinate(*x))).collect()
}
