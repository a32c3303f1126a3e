//! The last lines of a run: where each robot ended, and how often it was in contact.

use crate::configuration::{Configuration, HitchCfg, R2, T2, Tn};
use crate::geometry::Pose2;
use crate::run::Log;

/// One line per robot by ascending id, three decimals: `Reach  T2 { th1: 0.186, th2: 1.324 }  contacts: 9`.
///
/// Rusty prints its position, Hitch without a trailer its body's pose, every other robot its configuration as its type prints.
pub fn final_lines(log: &Log) -> Vec<String> {
    let residents = log.config.worlds.iter().flat_map(|w| &w.robots);
    let last = log.frames.last().unwrap_or(&log.initial);
    residents
        .zip(&last.robots)
        .map(|(resident, state)| {
            format!(
                "{}  {}  contacts: {}",
                resident.name,
                printed_configuration(&resident.kind, &state.configuration),
                state.contacts
            )
        })
        .collect()
}

/// The configuration of a robot of this kind as a run's last lines show it.
pub fn printed_configuration(kind: &str, coordinates: &[f64]) -> String {
    let q = coordinates;
    let text = match kind {
        "rusty" => Pose2::from_coordinates(q).map(|p| R2::new(p.x, p.y).to_string().replacen("R2", "Pose2", 1)),
        "reach" => T2::from_coordinates(q).map(|q| q.to_string()),
        "reach3" => Tn::<3>::from_coordinates(q).map(|q| q.to_string()),
        "hitch" => HitchCfg::from_coordinates(q).map(|q| match q.trailer {
            None => q.body.to_string(),
            Some(_) => q.to_string(),
        }),
        _ => None,
    };
    text.unwrap_or_else(|| {
        let numbers: Vec<String> = q.iter().map(|x| format!("{x:.3}")).collect();
        format!("[{}]", numbers.join(", "))
    })
}
