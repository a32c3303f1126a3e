//! Maps of other programs: ROS with its image, MovingAI with its scenarios, IR-SIM.
//!
//! The first byte says which: `r`, `m`, `s`, `i`. What follows is the file; of a ROS map, the yaml, a line `---`, and
//! the image. A wrong reader makes a world that its own file cannot hold, believes a head that promises more than
//! follows, or allocates what a head promises.

use super::{refusal, standing};
use motion_lab::worlds::import::{
    CellStyle, ImportError, Imported, IrsimOptions, OccupancyMap, RosMap, Scenario, ScenarioProblem, Unknown, irsim,
    is_ros_map, movingai,
};

/// Most cells of a map that is made a world: that of more takes longer than an input may.
const MAX_CELLS: u64 = 100_000;

/// What stands between the yaml of a ROS map and its image.
const BREAK: &[u8] = b"\n---\n";

/// Reads a map.
pub fn check(data: &[u8]) -> bool {
    let Some((kind, rest)) = data.split_first() else { return false };
    let text = std::str::from_utf8(rest);
    match (kind, text) {
        (b'r', _) => ros(rest),
        (b'm', Ok(text)) => is_read(movingai("yard.map", text, 1.0), "yard.map").is_some_and(|map| cells(&map)),
        (b's', Ok(text)) => scenario(text),
        (b'i', Ok(text)) => {
            let read = [false, true].map(|is_lenient| {
                let options = IrsimOptions { is_lenient, ..IrsimOptions::default() };
                world(irsim("garden.yaml", text, "garden", options), "garden.yaml")
            });
            assert!(read[1] || !read[0], "what is read is read with less left out");
            read[1]
        }
        _ => false,
    }
}

/// What was read; what was refused is a proper refusal.
fn is_read<T>(read: Result<T, ImportError>, file: &str) -> Option<T> {
    read.map_err(|error| refusal::check(&error, file)).ok()
}

fn ros(data: &[u8]) -> bool {
    let end = data.windows(BREAK.len()).position(|window| window == BREAK);
    let (yaml, image) = end.map_or((data, &[][..]), |end| (&data[..end], &data[end + BREAK.len()..]));
    let Ok(yaml) = std::str::from_utf8(yaml) else { return false };
    let Some(map) = is_read(RosMap::parse("room.yaml", yaml), "room.yaml") else { return false };
    assert!(is_ros_map(yaml), "{yaml}");
    let occupied = [Unknown::Free, Unknown::ByThresholds, Unknown::Occupied].map(|unknown| {
        let map = is_read(map.cells("room.pgm", image, unknown), "room.pgm")?;
        cells(&map);
        Some(
            (0..map.grid.rows())
                .map(|row| (0..map.grid.columns()).filter(|c| map.grid.is_occupied(*c, row)).count())
                .sum::<usize>(),
        )
    });
    assert!(occupied.is_sorted(), "fewer cells are occupied where the unknown are: {occupied:?}");
    occupied[0].is_some()
}

/// A map of cells becomes a world in both styles, or is refused.
fn cells(map: &OccupancyMap) -> bool {
    let is_small = u64::from(map.grid.columns()) * u64::from(map.grid.rows()) <= MAX_CELLS;
    is_small
        && [CellStyle::Solid, CellStyle::Hollow].into_iter().all(|style| world(map.world("map", "map", style), "map"))
}

fn world(imported: Result<Imported, ImportError>, file: &str) -> bool {
    let Some(imported) = is_read(imported, file) else { return false };
    imported.notes.iter().for_each(|note| refusal::check(note, ""));
    standing::check(&imported.world);
    true
}

fn scenario(text: &str) -> bool {
    let Some(scenario) = is_read(Scenario::parse("yard.scen", text), "yard.scen") else { return false };
    // the lines are those of another text
    let without_lines = |scenario: Scenario| Scenario {
        problems: scenario.problems.into_iter().map(|problem| ScenarioProblem { line: 0, ..problem }).collect(),
        ..scenario
    };
    let again = Scenario::parse("again", &scenario.to_text());
    assert_eq!(again.map(without_lines), Ok(without_lines(scenario)));
    true
}
