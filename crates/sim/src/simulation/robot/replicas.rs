//! `Replicas`, many runs of one robot, each alone in its copy of a world, stepped together.

use crate::run::{DT, Frame, ObstacleStates, RobotInput, RobotScan};
use crate::simulation::robot::driven::InputTarget;
use crate::simulation::robot::ops::state_of;
use crate::simulation::robot::spawn::{SpawnableRobot, routes, slip, tour};
use crate::simulation::sensors::scanners::{ScanMemory, Scanners};
use crate::simulation::sensors::start::beam;
use crate::simulation::tick::drive::Driver;
use crate::simulation::tick::parallel::each;
use crate::simulation::tick::settle::{cut_among, end_of, is_there};
use crate::simulation::{Contacts, DriveMode, OwnState, RobotId, SimulatedRobot, SpawnError};
use motion_lab_core::collision::{Scene, Surroundings};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::{FanSensor, RangeSensor};
use motion_lab_core::worlds::{BeamModel, Resident, World};

/// Many runs of one robot, each alone in its own copy of a world, with a seed and a tick of its own. They are stepped
/// together, by the functions that a tick of the schedule consists of, and each gives the frames of a recorded run of
/// its seed bit for bit. For learning and for statistics: there is no app and no entity behind a replica.
///
/// A step divides the replicas among threads, which changes no bit. The world's other residents are left out, and so
/// are the sensors that the resident itself names; the sensor given here is the run's own.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::robots::RUSTY;
/// use motion_lab_sim::run::RobotInput;
/// use motion_lab_core::sensors::RangeSensor;
/// use motion_lab_sim::simulation::Replicas;
/// use motion_lab_core::worlds::World;
///
/// let world = World::apartment();
/// let sensor = RangeSensor { n_rays: 36, max_range: 4.0 };
/// let mut replicas = Replicas::new(&RUSTY, &world, &world.robots[0], Some(sensor), (0..8).map(Seed))?;
/// // half of them are driven ahead, the others tour
/// for i in 0..4 {
///     assert!(replicas.input(i, &RobotInput::Drive(128, 0)));
/// }
/// (0..10).for_each(|_| replicas.step());
/// let start = &world.robots[0].start;
/// assert!((replicas.configuration(0).x - start[0]).abs() > 0.2 && replicas.tick(0) == 10);
/// assert_eq!(replicas.ranges(0).len(), 36);
/// replicas.reset(0, Seed(99))?;
/// assert_eq!((replicas.tick(0), replicas.tick(1)), (0, 10));
/// # Ok::<(), motion_lab_sim::simulation::SpawnError>(())
/// ```
pub struct Replicas<R: SimulatedRobot> {
    stage: SharedStage<R>,
    replicas: Vec<Replica<R>>,
    /// The ranges of all replicas, one after the other.
    ranges: Vec<f64>,
    scanners: Scanners,
}

struct SharedStage<R: SimulatedRobot> {
    robot: R,
    resident: Resident,
    start: R::Configuration,
    world: World,
    scene: Scene,
    rays: Option<FanSensor>,
    noise: Option<BeamModel>,
}

struct Replica<R: SimulatedRobot> {
    tick: u64,
    tour: R::Tour,
    slip: Stream,
    beam: Stream,
    robot: InputTarget<R>,
    contacts: Contacts<R>,
}

impl<R: SimulatedRobot> Replicas<R> {
    /// A run at tick 0 for each seed, of a resident of a world, whose kind has this model. A sensor is left out where
    /// the kind has no place for one.
    ///
    /// # Errors
    /// [`SpawnError`] where no run would start.
    pub fn new(
        model: &R,
        world: &World,
        resident: &Resident,
        sensor: Option<RangeSensor>,
        seeds: impl IntoIterator<Item = Seed>,
    ) -> Result<Self, SpawnError> {
        let SpawnableRobot { robot, q, noise } = SpawnableRobot::new(model, resident, world)?;
        let rays = sensor.filter(|_| robot.sensor_pose(&q).is_some()).map(FanSensor::from);
        let (world, scene) = (world.clone(), Scene::of_world(world));
        let stage = SharedStage { robot, resident: resident.clone(), start: q, world, scene, rays, noise };
        let replicas: Vec<Replica<R>> =
            seeds.into_iter().map(|seed| stage.replica(seed)).collect::<Result<_, SpawnError>>()?;
        let ranges = vec![0.0; stage.n_rays() * replicas.len()];
        let mut all = Replicas { stage, replicas, ranges, scanners: Scanners::default() };
        all.each(SharedStage::sense);
        Ok(all)
    }

    /// The number of replicas.
    pub fn len(&self) -> usize {
        self.replicas.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.replicas.is_empty()
    }

    /// Runs a tick of every replica.
    pub fn step(&mut self) {
        self.each(|stage, replica, ranges, desk| {
            stage.advance(replica);
            stage.sense(replica, ranges, desk);
        });
    }

    /// Applies an input to a replica's robot before its next tick. Returns whether it was accepted; a refusal is
    /// counted, as in a run with a script.
    ///
    /// # Panics
    /// Without such a replica.
    pub fn input(&mut self, replica: usize, input: &RobotInput) -> bool {
        self.stage.apply(&mut self.replicas[replica], input)
    }

    /// Begins a replica anew at tick 0 with this seed; the others stay as they are.
    ///
    /// # Errors
    /// [`SpawnError`] where no run of this seed would start; the replica then stays as it is.
    ///
    /// # Panics
    /// Without such a replica.
    pub fn reset(&mut self, replica: usize, seed: Seed) -> Result<(), SpawnError> {
        self.begin(replica, seed, &[]).map(|_| ())
    }

    /// Begins a replica anew with this seed and applies these inputs before its tick 1, such as a teleport to a start
    /// of its own. Then it is at tick 0 where they put it, and its sensor has read there; a recorded run whose script
    /// has these inputs first, at tick 1, has its frames from tick 1 on. Returns whether all of them were accepted.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// use motion_lab_core::robots::RUSTY;
    /// use motion_lab_core::worlds::World;
    /// use motion_lab_sim::run::{Quantized, RobotInput};
    /// use motion_lab_sim::simulation::Replicas;
    ///
    /// let world = World::apartment();
    /// let mut replicas = Replicas::new(&RUSTY, &world, &world.robots[0], None, [Seed(1)])?;
    /// let start = [3.0, 5.5, 0.5].map(|x| Quantized::try_new(x).unwrap());
    /// assert!(replicas.begin(0, Seed(2), &[RobotInput::Teleport(start.to_vec())])?);
    /// assert_eq!(*replicas.configuration(0), Pose2::new(3.0, 5.5, 0.5));
    /// # Ok::<(), motion_lab_sim::simulation::SpawnError>(())
    /// ```
    ///
    /// # Errors
    /// As of [`reset`](Self::reset).
    ///
    /// # Panics
    /// Without such a replica.
    pub fn begin(&mut self, replica: usize, seed: Seed, inputs: &[RobotInput]) -> Result<bool, SpawnError> {
        let n = self.stage.n_rays();
        let mut anew = self.stage.replica(seed)?;
        let refused = inputs.iter().filter(|input| !self.stage.apply(&mut anew, input)).count();
        let ranges = &mut self.ranges[replica * n..(replica + 1) * n];
        self.replicas[replica] = anew;
        self.stage.sense(&mut self.replicas[replica], ranges, &mut self.scanners.desk().desk);
        Ok(refused == 0)
    }

    /// The tick at which a replica stands.
    ///
    /// # Panics
    /// Without such a replica, as all questions about one.
    pub fn tick(&self, replica: usize) -> u64 {
        self.replicas[replica].tick
    }

    /// The configuration of a replica's robot.
    pub fn configuration(&self, replica: usize) -> &R::Configuration {
        &self.replicas[replica].robot.q
    }

    /// The contacts of a replica's robot.
    pub fn contacts(&self, replica: usize) -> &Contacts<R> {
        &self.replicas[replica].contacts
    }

    /// The ranges that a replica's sensor read at the end of its last tick, metres; none without a sensor.
    pub fn ranges(&self, replica: usize) -> &[f64] {
        let n = self.stage.n_rays();
        &self.ranges[replica * n..(replica + 1) * n]
    }

    /// The frame of a replica: that of a run of its seed in the same world with this robot alone.
    pub fn frame(&self, replica: usize) -> Frame {
        let Replica { tick, robot: InputTarget { q, mode, extra }, contacts, .. } = &self.replicas[replica];
        let state = state_of(RobotId(0), q, &OwnState::new(extra.clone()), mode, contacts);
        let scan = self.stage.rays.map(|_| RobotScan { robot: 0, ranges: self.ranges(replica).into() });
        Frame { tick: *tick, robots: vec![state], scans: scan.into_iter().collect(), obstacles: ObstacleStates::new() }
    }

    /// Does work for every replica, with its ranges.
    fn each(&mut self, work: impl Fn(&SharedStage<R>, &mut Replica<R>, &mut [f64], &mut ScanMemory) + Send + Sync) {
        let Replicas { stage, replicas, ranges, scanners } = self;
        let (stage, n) = (&*stage, stage.n_rays());
        if n == 0 {
            each(replicas.iter_mut(), ScanMemory::default, |desk, replica| work(stage, replica, &mut [], desk));
        } else {
            let items = replicas.iter_mut().zip(ranges.chunks_mut(n));
            each(
                items,
                || scanners.desk(),
                |borrowed, (replica, ranges)| {
                    work(stage, replica, ranges, &mut borrowed.desk);
                },
            );
        }
    }
}

impl<R: SimulatedRobot> SharedStage<R> {
    fn n_rays(&self) -> usize {
        self.rays.map_or(0, |rays| rays.sensor.n_rays as usize)
    }

    /// The run of a seed at tick 0.
    fn replica(&self, seed: Seed) -> Result<Replica<R>, SpawnError> {
        let SharedStage { robot, resident, start, world, .. } = self;
        let routes = routes(world, seed)?;
        Ok(Replica {
            tick: 0,
            tour: tour(robot, seed, (world, &routes), resident, start)?,
            slip: slip(seed, &resident.name),
            beam: Stream::new(seed, &beam(&resident.name)),
            robot: InputTarget { q: *start, mode: DriveMode::default(), extra: robot.initial_extra() },
            contacts: Contacts::default(),
        })
    }

    /// Applies an input; returns whether it was accepted.
    fn apply(&self, replica: &mut Replica<R>, input: &RobotInput) -> bool {
        let surroundings = || Surroundings { scene: &self.scene, others: &[] };
        let (robot, refused) = replica.robot.clone().after(&self.robot, &replica.tour, input, surroundings);
        replica.robot = robot;
        refused.is_none()
    }

    /// A tick up to its scan: the phases of the schedule, for a robot without others.
    fn advance(&self, replica: &mut Replica<R>) {
        let Replica { tick, tour, slip, robot: InputTarget { q, mode, extra }, contacts, .. } = replica;
        *tick += 1;
        slip.seek(*tick);
        let control = Driver { robot: &self.robot, tour, mode, stands: false }.control(*tick, q, extra, slip);
        let motion = self.robot.fitted(q).drive(q, &control, DT).ok();
        let cut = motion.as_ref().map(|motion| cut_among::<R>(&self.scene, &[], motion));
        if let (Some(motion), Some(cut)) = (&motion, &cut)
            && let Some(end) = end_of(&self.robot, motion, cut.until)
        {
            *q = end;
        }
        *contacts = contacts.after(cut.is_some_and(|cut| cut.contact));
        if mode.target.is_some_and(|target| is_there(&target, q)) {
            mode.target = None;
        }
    }

    /// The scan at the end of a tick.
    fn sense(&self, replica: &mut Replica<R>, ranges: &mut [f64], desk: &mut ScanMemory) {
        if let Some(rays) = self.rays {
            let pose = self.robot.mount_pose(&replica.robot.q);
            desk.at(0, rays).0.scan_into(&self.scene, &[], &pose, ranges);
            if let Some(noise) = &self.noise {
                noise.apply_to(&rays.sensor, ranges, &replica.beam, replica.tick);
            }
        }
    }
}
