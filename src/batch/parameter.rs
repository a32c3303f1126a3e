//! `Parameter`, what an axis varies: its name, its unit, and how a run gets a value of it.

use super::values::AxisValue;
use motion_lab_core::configuration::{RobotKind, Sizes};
use motion_lab_core::names::{hint, nearest};
use motion_lab_core::worlds::{BeamModel, Resident, ResidentSensor, World};

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Parameter {
    /// Something of the whole run.
    Run(RunParameter),
    Robot {
        robot: String,
        /// The robot's kind in the world that is the first to have it.
        kind: String,
        of: RobotParameter,
    },
    /// Where the goal's robot should go.
    Goal {
        /// The robot's kind in the world that is the first to have it; empty in a study without a goal.
        kind: String,
    },
}

/// The name of the goal as a parameter.
const GOAL: &str = "goal";

/// A parameter of the whole run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunParameter {
    Seed,
    Ticks,
    Script,
    Planner,
    PlannerIterations,
    PlannerTube,
    PlannerClearance,
    /// Start and goal of the goal's robot.
    Problem,
    World,
    Rays,
    Range,
    WarehouseSeed,
    WarehouseRobots,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum RobotParameter {
    Start,
    /// A coordinate of its start.
    Coordinate(usize),
    /// A number of its sizes, as world files name it: `disc.radius`.
    Size(String),
    /// A number of the noise of the run's sensor.
    Noise(&'static str),
    Sensor {
        sensor: String,
        /// `rays`, `range`, `field_of_view`, or a number of its noise.
        number: &'static str,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ValueForm {
    /// Whole numbers, with a unit.
    Whole(&'static str),
    /// Numbers, with a unit.
    Number(&'static str),
    Name,
    Start,
    Goal,
    Problem,
}

impl ValueForm {
    pub fn in_words(self) -> &'static str {
        match self {
            ValueForm::Whole(_) => "Range(FROM, TO), or whole numbers in Values([...])",
            ValueForm::Number(_) => "Values([...]), Steps(FROM, TO, COUNT), Uniform(FROM, TO) or Range(FROM, TO)",
            ValueForm::Name => "Names([...])",
            ValueForm::Start => "Starts([[...], [...]])",
            ValueForm::Goal => "Goals([[...], [...]])",
            ValueForm::Problem => "Problems(\"FILE\")",
        }
    }
}

/// What a study has beside its worlds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sources {
    /// A range sensor of the run.
    pub sensor: bool,
    /// A generated world.
    pub warehouse: bool,
    /// A planner.
    pub planner: bool,
    /// A goal.
    pub goal: bool,
}

/// The parameters of a run by name.
const OF_RUN: [(&str, RunParameter, ValueForm); 13] = [
    ("seed", RunParameter::Seed, ValueForm::Whole("")),
    ("ticks", RunParameter::Ticks, ValueForm::Whole("ticks")),
    ("script", RunParameter::Script, ValueForm::Name),
    ("planner", RunParameter::Planner, ValueForm::Name),
    ("planner.iterations", RunParameter::PlannerIterations, ValueForm::Whole("")),
    ("planner.tube", RunParameter::PlannerTube, ValueForm::Number("m")),
    ("planner.clearance", RunParameter::PlannerClearance, ValueForm::Number("m")),
    ("problem", RunParameter::Problem, ValueForm::Problem),
    ("world", RunParameter::World, ValueForm::Name),
    ("sensor.rays", RunParameter::Rays, ValueForm::Whole("")),
    ("sensor.range", RunParameter::Range, ValueForm::Number("m")),
    ("warehouse.seed", RunParameter::WarehouseSeed, ValueForm::Whole("")),
    ("warehouse.robots", RunParameter::WarehouseRobots, ValueForm::Whole("")),
];

/// The numbers of a beam model with their units.
const NOISE: [(&str, &str); 6] =
    [("sigma_hit", "m"), ("z_short", ""), ("lambda_short", "per_m"), ("z_miss", ""), ("z_max", ""), ("z_rand", "")];

/// The numbers of a sensor of a robot's own beside its noise.
const SENSOR: [(&str, ValueForm); 3] =
    [("rays", ValueForm::Whole("")), ("range", ValueForm::Number("m")), ("field_of_view", ValueForm::Number("rad"))];

impl Parameter {
    /// The parameter of this name; else what there is, in words. `goal` is the name of the goal's robot.
    pub fn named(name: &str, worlds: &[&World], goal: Option<&str>) -> Result<Self, String> {
        if let Some((_, of, _)) = OF_RUN.iter().find(|(known, ..)| *known == name) {
            return Ok(Parameter::Run(*of));
        }
        let robots = || worlds.iter().flat_map(|world| &world.robots);
        if name == GOAL {
            let resident = robots().find(|known| Some(known.name.as_str()) == goal);
            return Ok(Parameter::Goal { kind: resident.map_or(String::new(), |resident| resident.kind.clone()) });
        }
        let of = |resident: &Resident| {
            let number = name.strip_prefix(resident.name.as_str())?.strip_prefix('.')?;
            let of = RobotParameter::named(number, resident)?;
            Some(Parameter::Robot { robot: resident.name.clone(), kind: resident.kind.clone(), of })
        };
        robots().find_map(of).ok_or_else(|| {
            let of_run: Vec<&str> = OF_RUN.iter().map(|(name, ..)| *name).chain([GOAL]).collect();
            let named = |r: &&Resident| name.strip_prefix(r.name.as_str()).is_some_and(|rest| rest.starts_with('.'));
            match robots().find(named) {
                Some(resident) => RobotParameter::in_words(resident),
                None => format!("{}, or a robot's, as ROBOT.start", of_run.join(", ")),
            }
        })
    }

    /// The parameter that is nearly called so.
    pub fn meant(name: &str, worlds: &[&World]) -> Option<String> {
        let of_robots = worlds.iter().flat_map(|world| &world.robots).flat_map(RobotParameter::names);
        let of_run = OF_RUN.iter().map(|(known, ..)| *known).chain([GOAL]).map(str::to_owned);
        let all: Vec<String> = of_run.chain(of_robots).collect();
        nearest(name, all.iter().map(String::as_str)).map(str::to_owned)
    }

    /// The kind of the robot whose configurations its values are; `None` where they are something else.
    pub fn configured(&self) -> Option<&'static RobotKind> {
        match self {
            Parameter::Robot { kind, of: RobotParameter::Start, .. } | Parameter::Goal { kind } => RobotKind::of(kind),
            _ => None,
        }
    }

    /// Its name: `Rusty.noise.sigma_hit`.
    pub fn name(&self) -> String {
        match self {
            Parameter::Run(of) => {
                OF_RUN.iter().find(|(_, known, _)| known == of).map_or("", |(name, ..)| name).to_owned()
            }
            Parameter::Goal { .. } => GOAL.to_owned(),
            Parameter::Robot { robot, kind, of } => match of {
                RobotParameter::Start => format!("{robot}.start"),
                RobotParameter::Coordinate(i) => {
                    let names = RobotKind::of(kind).map_or(&[][..], |kind| kind.coordinates);
                    format!("{robot}.start.{}", names.get(*i).copied().unwrap_or(""))
                }
                RobotParameter::Size(number) => format!("{robot}.{number}"),
                RobotParameter::Noise(number) => format!("{robot}.noise.{number}"),
                RobotParameter::Sensor { sensor, number } => format!("{robot}.sensors.{sensor}.{number}"),
            },
        }
    }

    /// Whether both vary the same, wholly or in part.
    pub fn overlaps(&self, other: &Parameter) -> bool {
        use RobotParameter::{Coordinate, Start};
        match (self, other) {
            (Parameter::Robot { robot, of, .. }, Parameter::Robot { robot: same, of: also, .. }) if robot == same => {
                of == also || matches!((of, also), (Start, Coordinate(_)) | (Coordinate(_), Start))
            }
            _ => self == other,
        }
    }

    /// Why it changes nothing in any run with these robots; `None` where it may.
    pub fn idle(&self, robots: &[&Resident], there: Sources) -> Option<String> {
        use RunParameter::{Planner, PlannerClearance, PlannerIterations, PlannerTube};
        let no_sensor = || "the study has no range sensor for the run".to_owned();
        match self {
            Parameter::Run(RunParameter::Rays | RunParameter::Range) if !there.sensor => Some(no_sensor()),
            Parameter::Run(RunParameter::Rays | RunParameter::Range) => {
                let is_carried = robots.iter().any(|robot| carries_run_sensor(robot));
                (!is_carried).then(|| "no robot carries the run's sensor".to_owned())
            }
            Parameter::Run(RunParameter::WarehouseSeed | RunParameter::WarehouseRobots) => {
                (!there.warehouse).then(|| "the study has no warehouse".to_owned())
            }
            Parameter::Run(Planner | PlannerIterations | PlannerTube | PlannerClearance) => {
                (!there.planner).then(|| "the study has no planner".to_owned())
            }
            Parameter::Run(RunParameter::Problem) if !there.goal => {
                Some("the study has no goal, which says whose problems they are".to_owned())
            }
            Parameter::Goal { .. } => {
                (!there.goal).then(|| "the study has no goal, which says whose goals they are".to_owned())
            }
            Parameter::Run(RunParameter::Script) if there.planner => Some("the planner makes the script".to_owned()),
            Parameter::Run(_) => None,
            Parameter::Robot { robot, kind, of } => {
                let mut named = robots.iter().filter(|known| known.name == *robot).peekable();
                match of {
                    _ if named.peek().is_none() => Some(format!("robots leaves {robot:?} out")),
                    RobotParameter::Noise(_) if !there.sensor => Some(no_sensor()),
                    RobotParameter::Noise(_) if !named.any(|known| carries_run_sensor(known)) => {
                        Some(format!("a {kind} does not carry the run's sensor"))
                    }
                    _ => None,
                }
            }
        }
    }

    /// The form of its values.
    pub fn form(&self) -> ValueForm {
        let noise =
            |number: &str| NOISE.iter().find(|(name, _)| *name == number).map(|(_, unit)| ValueForm::Number(unit));
        match self {
            Parameter::Run(of) => {
                OF_RUN.iter().find(|(_, known, _)| known == of).map_or(ValueForm::Name, |(_, _, form)| *form)
            }
            Parameter::Goal { .. } => ValueForm::Goal,
            Parameter::Robot { kind, of, .. } => match of {
                RobotParameter::Start => ValueForm::Start,
                RobotParameter::Coordinate(i) => {
                    ValueForm::Number(RobotKind::of(kind).map_or("", |kind| kind.unit_of(*i)))
                }
                RobotParameter::Size(number) => ValueForm::Number(Sizes::unit_of(number)),
                RobotParameter::Noise(number) => noise(number).unwrap_or(ValueForm::Number("")),
                RobotParameter::Sensor { number, .. } => {
                    let own = SENSOR.iter().find(|(name, _)| name == number).map(|(_, form)| *form);
                    own.or_else(|| noise(number)).unwrap_or(ValueForm::Number(""))
                }
            },
        }
    }
}

impl RobotParameter {
    /// The parameter of a robot that a world calls so.
    fn named(name: &str, resident: &Resident) -> Option<Self> {
        if name == "start" {
            return Some(RobotParameter::Start);
        }
        let noise = |number: &str| NOISE.iter().map(|(known, _)| *known).find(|known| *known == number);
        if let Some(number) = name.strip_prefix("noise.") {
            return noise(number).map(RobotParameter::Noise);
        }
        if let Some(coordinate) = name.strip_prefix("start.") {
            let names = RobotKind::of(&resident.kind)?.coordinates.get(..resident.start.len())?;
            return names.iter().position(|known| *known == coordinate).map(RobotParameter::Coordinate);
        }
        if let Some(number) = name.strip_prefix("sensors.") {
            return resident.sensors.iter().find_map(|sensor| {
                let number = number.strip_prefix(sensor.name.as_str())?.strip_prefix('.')?;
                let own = SENSOR.iter().map(|(known, _)| *known).find(|known| *known == number);
                Some(RobotParameter::Sensor { sensor: sensor.name.clone(), number: own.or_else(|| noise(number))? })
            });
        }
        let mut own = Sizes::of_kind(&resident.kind)?;
        set_size(&mut own, name, 1.0).then(|| RobotParameter::Size(name.to_owned()))
    }

    /// The names of a robot's parameters, but for those of its sizes.
    fn names(resident: &Resident) -> Vec<String> {
        let noise = || NOISE.iter().map(|(number, _)| *number);
        let coordinates = RobotKind::of(&resident.kind).map_or(&[][..], |kind| kind.coordinates);
        let starts = coordinates.iter().map(|coordinate| format!("start.{coordinate}"));
        let of_sensors = resident.sensors.iter().flat_map(|sensor| {
            let numbers = SENSOR.iter().map(|(number, _)| *number).chain(noise());
            numbers.map(|number| format!("sensors.{}.{number}", sensor.name))
        });
        let all =
            std::iter::once("start".to_owned()).chain(starts).chain(noise().map(|number| format!("noise.{number}")));
        all.chain(of_sensors).map(|name| format!("{}.{name}", resident.name)).collect()
    }

    fn in_words(resident: &Resident) -> String {
        let name = &resident.name;
        let coordinates = RobotKind::of(&resident.kind).map_or(&[][..], |kind| kind.coordinates);
        let starts: Vec<String> = coordinates.iter().map(|c| format!("{name}.start.{c}")).collect();
        let field = Sizes::of_kind(&resident.kind).map_or("disc", |sizes| sizes.field());
        format!(
            "{name}.start, {}, {name}.noise.NUMBER, {name}.sensors.SENSOR.NUMBER, or a number of {name}.{field}",
            starts.join(", ")
        )
    }

    /// Gives a robot a value of this parameter, which is checked; else the reason against it.
    pub fn apply(&self, resident: &mut Resident, value: &AxisValue) -> Result<(), String> {
        let number = match value {
            AxisValue::Number(x) => *x,
            AxisValue::Whole(n) => *n as f64,
            AxisValue::Configuration(_) | AxisValue::Name(_) | AxisValue::Problem(_) | AxisValue::Filed(_) => 0.0,
        };
        match self {
            RobotParameter::Start => {
                if let AxisValue::Configuration(start) = value {
                    resident.start.clone_from(start);
                }
                check_start(resident)
            }
            RobotParameter::Coordinate(i) => {
                *resident.start.get_mut(*i).ok_or("it starts with fewer coordinates")? = number;
                check_start(resident)
            }
            RobotParameter::Size(name) => {
                let own = Sizes::of_kind(&resident.kind).ok_or("its kind has no sizes")?;
                let sizes = resident.sizes.get_or_insert(own);
                if !set_size(sizes, name, number) {
                    return Err(format!("a {} has no {name}", resident.kind));
                }
                Ok(())
            }
            RobotParameter::Noise(name) => {
                if !carries_run_sensor(resident) {
                    return Err(format!("a {} does not carry the run's sensor", resident.kind));
                }
                let noise = with_noise(resident.sensor, name, number)?;
                resident.sensor = Some(noise);
                Ok(())
            }
            RobotParameter::Sensor { sensor, number: name } => {
                let all = resident.sensors.iter().map(|own| own.name.as_str());
                let meant = hint(nearest(sensor, all));
                let sensor = resident.sensors.iter_mut().find(|own| own.name == *sensor);
                let own: &mut ResidentSensor = sensor.ok_or_else(|| format!("it has no such sensor{meant}"))?;
                match *name {
                    "rays" => own.rays.sensor.n_rays = number as u32,
                    "range" => own.rays.sensor.max_range = number,
                    "field_of_view" => own.rays.field_of_view = number,
                    name => own.noise = Some(with_noise(own.noise, name, number)?),
                }
                // checked with the whole configuration, when all axes have their values
                Ok(())
            }
        }
    }
}

/// Whether the run's range sensor is given to a robot of this kind; a program's own kind may take it.
fn carries_run_sensor(resident: &Resident) -> bool {
    RobotKind::of(&resident.kind).is_none_or(|kind| kind.senses)
}

/// Checks the start and wraps its angles.
fn check_start(resident: &mut Resident) -> Result<(), String> {
    let Resident { name, kind, start, .. } = &*resident;
    let placed = Resident::try_new(name.clone(), kind.clone(), start.clone(), None);
    resident.start = placed.map_err(|problem| problem.to_string())?.start;
    Ok(())
}

fn with_noise(noise: Option<BeamModel>, name: &str, value: f64) -> Result<BeamModel, String> {
    let mut noise = noise.unwrap_or(BeamModel::EXACT);
    match name {
        "sigma_hit" => noise.sigma_hit = value,
        "z_short" => noise.z_short = value,
        "lambda_short" => noise.lambda_short = value,
        "z_miss" => noise.z_miss = value,
        "z_max" => noise.z_max = value,
        _ => noise.z_rand = value,
    }
    // several axes may vary the numbers of one model, so it is checked when all of them have their values
    Ok(noise)
}

/// Sets the number of this name. `false` if these sizes have no such number.
fn set_size(sizes: &mut Sizes, name: &str, value: f64) -> bool {
    if let (Sizes::Car(car), "car.trailer.jackknife") = (&mut *sizes, name) {
        // a hitch without a limit gets one
        car.trailer.jackknife = Some(value);
    }
    let found = sizes.numbers_mut().into_iter().find(|(known, _)| known == name);
    found.map(|(_, number)| *number = value).is_some()
}
