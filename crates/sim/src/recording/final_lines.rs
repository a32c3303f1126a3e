//! The last lines of a run: each robot's final configuration and its contact episodes.

use crate::run::Log;
use motion_lab_core::configuration::{Kinds, RobotKind};

/// One line per robot by ascending id, three decimals: `Reach  T2 { th1: 0.186, th2: 1.324 }  contacts: 9`.
///
/// Rusty prints its position, Hitch without a trailer its body's pose, the arms and a car with a trailer their
/// configuration as its type prints. A kind that a program registered prints its coordinates; with its description,
/// [`final_lines_with`] prints it as that says.
pub fn final_lines(log: &Log) -> Vec<String> {
    final_lines_with(log, &Kinds::default())
}

/// [`final_lines`] of a run with kinds of robots that a program added.
pub fn final_lines_with(log: &Log, kinds: &Kinds) -> Vec<String> {
    let residents = log.recipe.config.worlds.iter().flat_map(|w| &w.robots);
    let last = log.frames().last().or(log.initial());
    residents
        .zip(last.iter().flat_map(|frame| &frame.robots))
        .map(|(resident, state)| {
            format!(
                "{}  {}  contacts: {}",
                resident.name,
                printed_as(kinds.of(&resident.kind), &state.configuration),
                state.contacts
            )
        })
        .collect()
}

/// The configuration of a robot of this kind as a run's last lines show it.
pub fn printed_configuration(kind: &str, coordinates: &[f64]) -> String {
    printed_as(RobotKind::of(kind), coordinates)
}

/// The configuration of a robot as its kind's description prints it; its coordinates without a description.
pub fn printed_as(about: Option<&RobotKind>, coordinates: &[f64]) -> String {
    let q = coordinates;
    let text = about.and_then(|known| (known.printed)(q));
    text.unwrap_or_else(|| {
        let numbers: Vec<String> = q.iter().map(|x| format!("{x:.3}")).collect();
        format!("[{}]", numbers.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn configurations_print_as_the_book_prints_them() {
        for (kind, q, printed) in [
            ("rusty", &[6.2124, 4.4656, 0.1][..], "Pose2 { x: 6.212, y: 4.466 }"),
            ("reach", &[0.7856, 1.5714], "T2 { th1: 0.786, th2: 1.571 }"),
            ("reach3", &[0.1, 0.2, 0.3], "Tn<3> { th1: 0.100, th2: 0.200, th3: 0.300 }"),
            ("hitch", &[1.0, 2.0, 0.5], "Pose2 { x: 1.000, y: 2.000, theta: 0.500 }"),
            (
                "hitch",
                &[1.0, 2.0, 0.5, 0.1],
                "HitchCfg { body: Pose2 { x: 1.000, y: 2.000, theta: 0.500 }, trailer: Some(0.100) }",
            ),
            ("x-crane", &[1.0, 2.5], "[1.000, 2.500]"),
        ] {
            assert_eq!(printed_configuration(kind, q), printed);
        }
    }
}
