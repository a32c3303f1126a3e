//! What the numbers of a robot are called in an export: by its kind's coordinates, with units.

use crate::run::{Log, RobotState};
use motion_lab_core::configuration::{InputKind, Kinds, RobotKind};
use motion_lab_core::worlds::Resident;

/// A rover's own state: how far its wheels have turned since tick 0, and the number of the way point it heads for.
const ROVER: [&str; 3] = ["left_wheel_rad", "right_wheel_rad", "waypoint"];

/// One of the lists of numbers of a [`RobotState`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateList {
    Configuration,
    /// The robot's own state beside it.
    Extra,
    /// The configuration a manual move heads for.
    Target,
}

impl StateList {
    /// The name of a number without one of its own, before its place in the list.
    fn plain(self) -> &'static str {
        match self {
            StateList::Configuration => "configuration",
            StateList::Extra => "extra",
            StateList::Target => "target",
        }
    }

    /// The list of a state.
    pub fn of(self, state: &RobotState) -> &[f64] {
        match self {
            StateList::Configuration => &state.configuration,
            StateList::Extra => &state.extra,
            StateList::Target => &state.target,
        }
    }

    /// The name of number `i` where its kind has none for it: its list and its place.
    pub fn numbered(self, i: usize) -> String {
        format!("{}{i}", self.plain())
    }

    /// The names that the numbers of a kind with this description have whatever the run: columns in CSV, keys in JSON.
    /// A heading that is not there, as a trailer's, has one too.
    pub fn named(self, about: Option<&RobotKind>) -> Vec<String> {
        let Some(kind) = about else { return Vec::new() };
        let coordinates = kind.coordinates.iter().enumerate();
        let coordinates = coordinates.map(|(i, name)| format!("{name}_{}", if i < kind.lengths { "m" } else { "rad" }));
        match self {
            StateList::Configuration => coordinates.collect(),
            // what a program's own robots keep beside their configurations, nobody described
            StateList::Extra if *kind == RobotKind::RUSTY => ROVER.map(str::to_owned).into(),
            StateList::Target if kind.takes.contains(&InputKind::MoveTo) => {
                coordinates.map(|name| format!("target_{name}")).collect()
            }
            StateList::Extra | StateList::Target => Vec::new(),
        }
    }
}

/// The columns of one list in a table of all robots.
pub struct Columns {
    list: StateList,
    /// Their names, each once.
    pub names: Vec<String>,
    /// For each robot and column, the place of the robot's number in its list.
    places: Vec<Vec<Option<usize>>>,
}

impl Columns {
    /// The columns of a log with these kinds of robots. `widths` are the largest numbers of items of each robot's list
    /// in it.
    pub fn new(list: StateList, log: &Log, kinds: &Kinds, widths: &[usize]) -> Self {
        let there: Vec<Option<&RobotKind>> = residents(log).map(|resident| kinds.of(&resident.kind)).collect();
        // the lab's kinds come first, in their order, whatever the order of the robots
        let lab = RobotKind::ALL.into_iter().map(Some).filter(|kind| there.contains(kind));
        let own = lab.chain(there.iter().copied()).flat_map(|about| list.named(about));
        let mut names: Vec<String> = Vec::new();
        let mut add = |name: String| {
            if !names.contains(&name) {
                names.push(name);
            }
        };
        own.for_each(&mut add);
        let mut by_place: Vec<Vec<String>> = Vec::with_capacity(there.len());
        for (about, &width) in there.iter().zip(widths) {
            let named = list.named(*about);
            let rest = (named.len()..width).map(|i| list.numbered(i));
            by_place.push(named.iter().cloned().chain(rest).collect());
        }
        let largest = by_place.iter().map(Vec::len).fold(0, usize::max);
        let plain = |i: usize| list.numbered(i);
        (0..largest).filter(|i| by_place.iter().any(|all| all.get(*i) == Some(&plain(*i)))).map(plain).for_each(add);
        let place = |all: &Vec<String>| names.iter().map(|name| all.iter().position(|own| own == name)).collect();
        let places = by_place.iter().map(place).collect();
        Columns { list, names, places }
    }

    /// Whether robot number `robot` has a number in the column of this name; `None` where no column is called so.
    pub fn has(&self, robot: usize, name: &str) -> Option<bool> {
        let column = self.names.iter().position(|own| own == name)?;
        Some(self.places.get(robot)?.get(column)?.is_some())
    }

    /// The numbers of robot number `robot` in a state, one for each column.
    pub fn numbers<'a>(&'a self, robot: usize, state: &'a RobotState) -> impl Iterator<Item = Option<f64>> + 'a {
        let numbers = self.list.of(state);
        let places = self.places.get(robot).map_or(&[][..], Vec::as_slice);
        places.iter().map(move |place| place.and_then(|place| numbers.get(place)).copied())
    }
}

/// The robots of a log, by ascending id.
pub fn residents(log: &Log) -> impl Iterator<Item = &Resident> {
    log.recipe.config.worlds.iter().flat_map(|world| &world.robots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_the_lab_s_kinds_has_a_name_with_its_unit() {
        let of = |about| {
            [StateList::Configuration, StateList::Extra, StateList::Target].map(|list| list.named(about).join(" "))
        };
        let all = |kind| of(RobotKind::of(kind));
        assert_eq!(all("rusty"), ["x_m y_m theta_rad", "left_wheel_rad right_wheel_rad waypoint", ""]);
        assert_eq!(all("reach"), ["theta1_rad theta2_rad", "", "target_theta1_rad target_theta2_rad"]);
        assert_eq!(all("hitch"), ["x_m y_m theta_rad psi_rad", "", ""]);
        assert_eq!(all("reach3")[0], "theta1_rad theta2_rad theta3_rad");
        assert_eq!(all("x-train"), ["", "", ""]);
        assert_eq!(StateList::Extra.numbered(1), "extra1");
        // a program's own kind: its coordinates are described, what its robots keep beside them is not
        let sled = RobotKind { name: "x-sled", coordinates: &["x", "y", "tilt"], ..RobotKind::RUSTY };
        assert_eq!(of(Some(&sled)), ["x_m y_m tilt_rad", "", ""]);
        let crane = RobotKind { name: "x-crane", coordinates: &["trolley", "boom"], lengths: 1, ..RobotKind::REACH };
        assert_eq!(of(Some(&crane)), ["trolley_m boom_rad", "", "target_trolley_m target_boom_rad"]);
    }
}
