//! Reads the maps of the MovingAI benchmarks.

use super::cells::{check_size, grid_of};
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem, OccupancyMap};
use motion_lab_core::geometry::{Point2, Pose2};

/// Reads a MovingAI map with cells of `resolution` metres: `.`, `G` and `S` are free; `@`, `O`, `T` and `W` are
/// occupied. The lower left corner of the map is the origin. `file` is the map's name in errors.
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
    let mut lines = (1..).zip(text.lines().map(str::trim_end));
    let mut head = |key: &'static str| {
        let (line, text) = lines.next().ok_or_else(|| ImportError::at(0, "", ImportProblem::Missing(key)))?;
        match text.split_once(' ').unwrap_or((text, "")) {
            (found, value) if found == key => Ok((line, value.trim())),
            _ => Err(ImportError::at(line, "", wrong_value(text, HEAD))),
        }
    };
    let (line, kind) = head("type")?;
    if kind != "octile" {
        return Err(ImportError::at(line, "type", wrong_value(kind, "octile")));
    }
    let mut size = |key| {
        let (line, value) = head(key)?;
        let size = value.parse::<u64>().ok().filter(|n| *n >= 1);
        size.ok_or_else(|| ImportError::at(line, key, wrong_value(value, "a whole number from 1 on")))
    };
    let (rows, columns) = (size("height")?, size("width")?);
    check_size(columns, rows)?;
    head("map")?;
    let cells = || {
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
                    '.' | 'G' | 'S' => false,
                    '@' | 'O' | 'T' | 'W' => true,
                    _ => {
                        let problem = wrong_value(format!("{sign:?}"), "one of . G S @ O T W");
                        return Err(ImportError::at(line, format!("column {column}"), problem));
                    }
                });
            }
        }
        if found != rows {
            return Err(ImportProblem::Count { what: "rows", found, expected: rows }.into());
        }
        Ok(cells)
    };
    let grid = grid_of(Point2::origin(), resolution, columns, rows, cells)?;
    Ok(OccupancyMap { grid, frame: Pose2::IDENTITY, notes: vec![] })
}

const HEAD: &str = "the head of a MovingAI map: lines `type octile`, `height H`, `width W` and `map`";
