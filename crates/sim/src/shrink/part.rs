//! `Part`, what can be taken out of a recipe.

use crate::run::Recipe;
use motion_lab_core::worlds::World;

/// A thing of a world of a recipe, by its index in the world's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum WorldPart {
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
pub(super) enum Part {
    World(usize),
    /// The range sensor that the run gives its rovers.
    RunSensor,
    /// A thing of the world with this index.
    Of(usize, WorldPart),
    /// An input to a robot.
    Event(usize),
    /// A change of a world.
    Change(usize),
}

/// The parts that are tried together, in the order in which they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PartGroup {
    Worlds,
    Sensors,
    Robots,
    Inputs,
    Obstacles,
    Others,
    Pieces,
}

impl PartGroup {
    /// The groups, those whose removal saves most time first.
    pub(super) const ALL: [PartGroup; 7] = [
        PartGroup::Worlds,
        PartGroup::Sensors,
        PartGroup::Robots,
        PartGroup::Inputs,
        PartGroup::Obstacles,
        PartGroup::Others,
        PartGroup::Pieces,
    ];

    /// Whether the group's removal leaves every world that stays as it is.
    pub(super) fn leaves_worlds(self) -> bool {
        matches!(self, PartGroup::Worlds | PartGroup::Inputs)
    }

    /// The group's parts of a recipe, in order.
    pub(super) fn parts(self, recipe: &Recipe) -> Vec<Part> {
        let (config, script) = (&recipe.config, &recipe.script);
        match self {
            PartGroup::Worlds => (0..config.worlds.len()).map(Part::World).collect(),
            PartGroup::Inputs => {
                let changes = (0..script.changes.len()).map(Part::Change);
                changes.chain((0..script.events.len()).map(Part::Event)).collect()
            }
            group => {
                let run = config.sensor.filter(|_| group == PartGroup::Sensors).map(|_| Part::RunSensor);
                let of = |(w, world)| group.of_world(world).into_iter().map(move |part| Part::Of(w, part));
                run.into_iter().chain(config.worlds.iter().enumerate().flat_map(of)).collect()
            }
        }
    }

    /// The group's parts of a world.
    fn of_world(self, world: &World) -> Vec<WorldPart> {
        let World { obstacles, doors, routes, places, marks, robots, .. } = world;
        match self {
            PartGroup::Worlds | PartGroup::Inputs => Vec::new(),
            PartGroup::Sensors => {
                let of = |(r, count)| (0..count).map(move |s| WorldPart::Sensor(r, s));
                robots.iter().map(|robot| robot.sensors.len()).enumerate().flat_map(of).collect()
            }
            PartGroup::Robots => (0..robots.len()).map(WorldPart::Robot).collect(),
            PartGroup::Obstacles => {
                (0..obstacles.len()).map(WorldPart::Obstacle).chain((0..doors.len()).map(WorldPart::Door)).collect()
            }
            PartGroup::Others => {
                let mut parts: Vec<WorldPart> = (0..routes.len()).map(WorldPart::Route).collect();
                parts.extend((0..places.len()).map(WorldPart::Place));
                parts.extend((0..marks.len()).map(WorldPart::Mark));
                for (r, robot) in robots.iter().enumerate() {
                    parts.extend(robot.route.as_ref().map(|_| WorldPart::Following(r)));
                    parts.extend(robot.sizes.as_ref().map(|_| WorldPart::Sizes(r)));
                    parts.extend(robot.sensor.as_ref().map(|_| WorldPart::RunSensorNoise(r)));
                    let noisy = robot.sensors.iter().enumerate().filter(|(_, sensor)| sensor.noise.is_some());
                    parts.extend(noisy.map(|(s, _)| WorldPart::SensorNoise(r, s)));
                }
                parts
            }
            PartGroup::Pieces => {
                let counts = obstacles.iter().map(|obstacle| obstacle.written().len());
                let of = |(o, count)| (0..count).map(move |p| WorldPart::Piece(o, p));
                // of a single piece the obstacle itself is tried
                counts.enumerate().filter(|(_, count)| *count > 1).flat_map(of).collect()
            }
        }
    }
}
