//! Reads the maps of the MovingAI benchmarks.

use super::cells::{check_size, grid_of};
use super::lines::numbered_lines;
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem, OccupancyMap};
use motion_lab_core::geometry::{Point2, Pose2};

/// Reads a MovingAI map with cells of `resolution` metres: `.`, `G`, `S` and `E` are free; `@`, `O`, `T` and `W` are
/// occupied. `E` is of the warehouses of the League of Robot Runners: a place where robots deliver. The lower left
/// corner of the map is the origin, so cell (x, y), of which y counts from the top row, has its middle at `(x + 0.5,
/// height - y - 0.5)` cells. `file` is the map's name in errors.
///
/// # Errors
/// [`ImportError`] names line and column: a malformed head, too few or too many rows, a row of the wrong length, an
/// unknown sign.
///
/// ```
/// use motion_lab_import::{CellStyle, movingai};
/// let map = movingai("yard.map", "type octile\nheight 2\nwidth 3\nmap\n...\n.@.\n", 0.5)?;
/// let yard = map.world("yard.map", "Yard", CellStyle::Solid)?.world;
/// assert_eq!(yard.obstacles.len(), 1); // one box over one cell, from (0.5, 0) to (1, 0.5)
/// # Ok::<(), motion_lab_import::ImportError>(())
/// ```
pub fn movingai(file: &str, text: &str, resolution: f64) -> Result<OccupancyMap, ImportError> {
    read(text, resolution).map_err(|error| error.of(file))
}

fn read(text: &str, resolution: f64) -> Result<OccupancyMap, ImportError> {
    let mut lines = numbered_lines(text);
    let MapSize { columns, rows } = head(&mut lines)?;
    check_size(columns, rows)?;
    let grid = grid_of(Point2::origin(), resolution, columns, rows, || cells(lines, columns, rows))?;
    Ok(OccupancyMap { grid, frame: Pose2::IDENTITY, notes: vec![] })
}

/// The number of a map's cells.
struct MapSize {
    columns: u64,
    rows: u64,
}

/// Reads the head, up to and with the line `map`. Its lines may stand in any order, with blanks or tabs between key and
/// value; `type` may be missing, as some generators leave it out.
fn head<'a>(lines: &mut impl Iterator<Item = (usize, &'a str)>) -> Result<MapSize, ImportError> {
    let (mut height, mut width) = (None, None);
    for (line, text) in lines {
        let text = text.trim();
        let (key, value) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let value = value.trim();
        let size = |key: &str| {
            let size = value.parse::<u64>().ok().filter(|n| *n >= 1);
            size.ok_or_else(|| ImportError::at(line, key, wrong_value(value, "a whole number from 1 on")))
        };
        match key {
            "" => {}
            "type" if value == "octile" => {}
            "type" if !value.is_empty() => return Err(ImportError::at(line, "type", wrong_value(value, "octile"))),
            "height" if height.is_none() => height = Some(size("height")?),
            "width" if width.is_none() => width = Some(size("width")?),
            "map" if value.is_empty() => {
                let missing = |key| ImportError::at(line, "", ImportProblem::Missing(key));
                let rows = height.ok_or_else(|| missing("height"))?;
                return Ok(MapSize { columns: width.ok_or_else(|| missing("width"))?, rows });
            }
            _ => return Err(ImportError::at(line, "", wrong_value(text, HEAD))),
        }
    }
    let first = [("height", height), ("width", width)].into_iter().find(|(_, size)| size.is_none());
    Err(ImportError::at(0, "", ImportProblem::Missing(first.map_or("map", |(key, _)| key))))
}

/// Reads the rows of signs after the head.
fn cells<'a>(lines: impl Iterator<Item = (usize, &'a str)>, columns: u64, rows: u64) -> Result<Vec<bool>, ImportError> {
    let mut cells = Vec::new();
    let mut found = 0;
    for (line, row) in lines {
        if row.is_empty() && found == rows {
            continue; // blank lines at the end
        }
        found += 1;
        let length = row.chars().count() as u64;
        if length != columns {
            let problem = ImportProblem::Count { what: "signs", found: length, expected: columns };
            return Err(ImportError::at(line, "", problem));
        }
        for (column, sign) in (1..).zip(row.chars()) {
            cells.push(match sign {
                '.' | 'G' | 'S' | 'E' => false,
                '@' | 'O' | 'T' | 'W' => true,
                _ => {
                    let problem = wrong_value(format!("{sign:?}"), "one of . G S E @ O T W");
                    return Err(ImportError::at(line, format!("column {column}"), problem));
                }
            });
        }
    }
    if found != rows {
        return Err(ImportProblem::Count { what: "rows", found, expected: rows }.into());
    }
    Ok(cells)
}

const HEAD: &str =
    "the head of a MovingAI map, once each: lines `type octile`, `height H`, `width W` and at its end `map`";
