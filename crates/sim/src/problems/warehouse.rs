//! `WarehouseTrip`, a way through a warehouse.

use super::error::{GeneratorError, within};
use super::generated::GeneratedProblem;
use super::site::ProblemSite;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::{Resident, WAREHOUSE_ROBOTS, Warehouse};
use serde::{Deserialize, Serialize};

/// A [warehouse](Warehouse) for each problem. The robot stands where one of its rovers or cars does, and goes to where
/// another one does; nobody else is there. Whether there is a path is not known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WarehouseTrip {
    /// The kind of robot: `rusty` or `hitch`.
    pub robot: String,
    /// The number of robots that the warehouse is made for, which says how large it is: with 80 it has one bay.
    pub robots: u32,
    /// Whether the cars pull trailers.
    pub trailers: bool,
}

impl Default for WarehouseTrip {
    fn default() -> Self {
        WarehouseTrip { robot: RobotKind::RUSTY.name.into(), robots: 80, trailers: false }
    }
}

impl WarehouseTrip {
    fn kind(&self) -> Result<&'static RobotKind, GeneratorError> {
        let known = [&RobotKind::RUSTY, &RobotKind::HITCH].into_iter().find(|kind| kind.name == self.robot);
        known.ok_or_else(|| GeneratorError::Robot { found: self.robot.clone(), expected: "rusty and hitch" })
    }

    pub(super) fn check(&self) -> Result<(), GeneratorError> {
        self.kind()?;
        let [least, most] = WAREHOUSE_ROBOTS.map(|robots| robots as f64);
        within("robots", f64::from(self.robots), [least, most])
    }

    pub(super) fn problem(&self, draws: &mut Stream, name: String) -> Result<GeneratedProblem, GeneratorError> {
        let kind = self.kind()?;
        let warehouse = Warehouse { seed: Seed(draws.bits()), robots: self.robots as usize, trailers: self.trailers };
        let mut world = warehouse.world()?;
        world.name = name;
        let mut places: Vec<Resident> = world.robots.iter().filter(|known| known.kind == kind.name).cloned().collect();
        if places.len() < 2 {
            return Err(GeneratorError::Few { kind: kind.name, found: places.len() });
        }
        let sizes = places.first().and_then(|first| first.sizes.clone());
        let site = ProblemSite::with_sizes(kind, sizes, world);
        // each place once: the goal is another than the start
        let mut place = |draws: &mut Stream| match places.len() {
            0 => Vec::new(),
            left => places.remove(draws.below(left as u64) as usize).start,
        };
        let start = site.free("start", draws, &mut place)?;
        let goal = site.free("goal", draws, &mut place)?;
        Ok(GeneratedProblem { task: site.task([start, goal])?, has_path: None })
    }
}
