//! `Removal`, what can be taken out of a recipe.

use crate::run::Recipe;
use motion_lab_core::worlds::World;

/// A thing of a world of a recipe, by its index in the world's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum WorldRemoval {
    Robot(usize),
    /// A sensor of a robot.
    Sensor(usize, usize),
    /// The noise of a robot's sensor.
    SensorNoise(usize, usize),
    /// The noise of the run's sensor on a robot.
    RunSensorNoise(usize),
    /// A robot's sizes, which leaves it those of its kind.
    Sizes(usize),
    /// That a robot follows a route.
    Following(usize),
    Obstacle(usize),
    /// A shape of an obstacle, as written.
    Piece(usize, usize),
    Door(usize),
    Route(usize),
    Place(usize),
    Mark(usize),
}

/// What can be taken out of a recipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Removal {
    World(usize),
    /// The range sensor that the run gives its rovers.
    RunSensor,
    /// A thing of the world with this index.
    Of(usize, WorldRemoval),
    /// An input to a robot.
    Event(usize),
    /// A change of a world.
    Change(usize),
}

/// The removals that are tried together, in the order in which they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RemovalGroup {
    Worlds,
    Sensors,
    Robots,
    Inputs,
    Obstacles,
    Others,
    Pieces,
}

impl RemovalGroup {
    /// The groups, those that save most time first.
    pub(super) const ALL: [RemovalGroup; 7] = [
        RemovalGroup::Worlds,
        RemovalGroup::Sensors,
        RemovalGroup::Robots,
        RemovalGroup::Inputs,
        RemovalGroup::Obstacles,
        RemovalGroup::Others,
        RemovalGroup::Pieces,
    ];

    /// Whether the group leaves every world that stays as it is.
    pub(super) fn leaves_worlds(self) -> bool {
        matches!(self, RemovalGroup::Worlds | RemovalGroup::Inputs)
    }

    /// The group's removals for a recipe, in order.
    pub(super) fn removals(self, recipe: &Recipe) -> Vec<Removal> {
        let (config, script) = (&recipe.config, &recipe.script);
        match self {
            RemovalGroup::Worlds => (0..config.worlds.len()).map(Removal::World).collect(),
            RemovalGroup::Inputs => {
                let changes = (0..script.changes.len()).map(Removal::Change);
                changes.chain((0..script.events.len()).map(Removal::Event)).collect()
            }
            group => {
                let run = config.sensor.filter(|_| group == RemovalGroup::Sensors).map(|_| Removal::RunSensor);
                let of = |(w, world)| group.of_world(world).into_iter().map(move |removal| Removal::Of(w, removal));
                run.into_iter().chain(config.worlds.iter().enumerate().flat_map(of)).collect()
            }
        }
    }

    /// The group's removals for a world.
    fn of_world(self, world: &World) -> Vec<WorldRemoval> {
        let World { obstacles, doors, routes, places, marks, robots, .. } = world;
        match self {
            RemovalGroup::Worlds | RemovalGroup::Inputs => Vec::new(),
            RemovalGroup::Sensors => {
                let of = |(r, count)| (0..count).map(move |s| WorldRemoval::Sensor(r, s));
                robots.iter().map(|robot| robot.sensors.len()).enumerate().flat_map(of).collect()
            }
            RemovalGroup::Robots => (0..robots.len()).map(WorldRemoval::Robot).collect(),
            RemovalGroup::Obstacles => (0..obstacles.len())
                .map(WorldRemoval::Obstacle)
                .chain((0..doors.len()).map(WorldRemoval::Door))
                .collect(),
            RemovalGroup::Others => {
                let mut removals: Vec<WorldRemoval> = (0..routes.len()).map(WorldRemoval::Route).collect();
                removals.extend((0..places.len()).map(WorldRemoval::Place));
                removals.extend((0..marks.len()).map(WorldRemoval::Mark));
                for (r, robot) in robots.iter().enumerate() {
                    removals.extend(robot.route.as_ref().map(|_| WorldRemoval::Following(r)));
                    removals.extend(robot.sizes.as_ref().map(|_| WorldRemoval::Sizes(r)));
                    removals.extend(robot.sensor.as_ref().map(|_| WorldRemoval::RunSensorNoise(r)));
                    let noisy = robot.sensors.iter().enumerate().filter(|(_, sensor)| sensor.noise.is_some());
                    removals.extend(noisy.map(|(s, _)| WorldRemoval::SensorNoise(r, s)));
                }
                removals
            }
            RemovalGroup::Pieces => {
                let counts = obstacles.iter().map(|obstacle| obstacle.written().len());
                let of = |(o, count)| (0..count).map(move |p| WorldRemoval::Piece(o, p));
                // of a single piece the obstacle itself is tried
                counts.enumerate().filter(|(_, count)| *count > 1).flat_map(of).collect()
            }
        }
    }
}
