//! `ProblemGenerator`, which problems are made.

use super::circles::CircleField;
use super::error::GeneratorError;
use super::generated::GeneratedProblem;
use super::maze::Maze;
use super::parking::ParkingLot;
use super::passage::NarrowPassage;
use super::warehouse::WarehouseTrip;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::{Seed, Stream};
use serde::{Deserialize, Serialize};

/// Which problems are made, with what they are like. Serialised it is called as the variant is, and by its
/// [name](Self::name) too.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ProblemGenerator {
    /// Among circles.
    #[serde(alias = "circles")]
    Circles(CircleField),
    /// Through mazes.
    #[serde(alias = "maze")]
    Maze(Maze),
    /// Through gaps.
    #[serde(alias = "passage")]
    Passage(NarrowPassage),
    /// Into a bay.
    #[serde(alias = "parking")]
    Parking(ParkingLot),
    /// Through warehouses.
    #[serde(alias = "warehouse")]
    Warehouse(WarehouseTrip),
}

impl ProblemGenerator {
    /// The [names](Self::name) of all generators, in their order.
    pub const NAMES: [&str; 5] = ["circles", "maze", "passage", "parking", "warehouse"];

    /// The name in files and messages.
    pub const fn name(&self) -> &'static str {
        match self {
            ProblemGenerator::Circles(_) => "circles",
            ProblemGenerator::Maze(_) => "maze",
            ProblemGenerator::Passage(_) => "passage",
            ProblemGenerator::Parking(_) => "parking",
            ProblemGenerator::Warehouse(_) => "warehouse",
        }
    }

    /// The name of the robot's kind, as worlds have it.
    pub fn kind(&self) -> &str {
        match self {
            ProblemGenerator::Circles(CircleField { robot, .. })
            | ProblemGenerator::Passage(NarrowPassage { robot, .. })
            | ProblemGenerator::Warehouse(WarehouseTrip { robot, .. }) => robot,
            ProblemGenerator::Maze(_) => RobotKind::RUSTY.name,
            ProblemGenerator::Parking(_) => RobotKind::HITCH.name,
        }
    }

    /// Checks what all its problems are like.
    ///
    /// # Errors
    /// [`GeneratorError`] names the setting that is out of range.
    pub fn check(&self) -> Result<(), GeneratorError> {
        match self {
            ProblemGenerator::Circles(field) => field.check(),
            ProblemGenerator::Maze(maze) => maze.check(),
            ProblemGenerator::Passage(passage) => passage.check(),
            ProblemGenerator::Parking(lot) => lot.check(),
            ProblemGenerator::Warehouse(trip) => trip.check(),
        }
    }

    /// The problem with this number, from 0, of a seed: a function of all three alone.
    ///
    /// # Errors
    /// [`GeneratorError`]: there is none with these settings, or, of one that is too crowded, with this number.
    pub fn problem(&self, seed: Seed, number: u64) -> Result<GeneratedProblem, GeneratorError> {
        self.check()?;
        let name = self.name();
        let draws = &mut Stream::new(seed, &format!("problems/{name}/{number}"));
        let world = format!("{name} {} of seed {seed}", number.saturating_add(1));
        match self {
            ProblemGenerator::Circles(field) => field.problem(draws, world),
            ProblemGenerator::Maze(maze) => maze.problem(draws, world),
            ProblemGenerator::Passage(passage) => passage.problem(draws, world),
            ProblemGenerator::Parking(lot) => lot.problem(draws, world),
            ProblemGenerator::Warehouse(trip) => trip.problem(draws, world),
        }
    }
}
