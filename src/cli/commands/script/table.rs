//! A script as a table of comma-separated values.

use motion_lab::run::{Event, Quantized, RobotInput, Script, ScriptProblem};
use motion_lab::tour::TourConfig;

/// What is wrong with a table, and where. Prints as `7:12: "fast" is no whole number`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}:{column}: {reason}")]
pub struct ScriptTableError {
    /// The line, from 1.
    line: usize,
    /// The column in characters, from 1.
    column: usize,
    /// What is wrong.
    reason: String,
}

/// The largest number of cells in a row; empty ones at its end count, too.
const MAX_CELLS: usize = 1000;

/// A cell and the column where it begins, from 1.
type TableCell = (usize, String);

/// The script that a table describes, checked against a run's worlds and robots where they are given.
pub fn script(text: &str, config: Option<&TourConfig>) -> Result<Script, ScriptTableError> {
    let mut script = Script::new(Vec::new(), vec![]);
    // of each event the line, and the columns of its tick, its robot, its input and that input's first value
    let mut rows: Vec<(usize, [usize; 4])> = Vec::new();
    let text = text.trim_start_matches('\u{feff}'); // spreadsheets put a mark in front
    for (line, row) in (1..).zip(text.lines()) {
        if row.trim().is_empty() || row.starts_with('#') {
            continue;
        }
        let at = |(column, reason): (usize, String)| ScriptTableError { line, column, reason };
        let cells = cells(row).map_err(at)?;
        if rows.is_empty() && script.events.is_empty() && cells[0].1.eq_ignore_ascii_case("tick") {
            continue;
        }
        script.events.push(event(&cells, row.chars().count() + 1).map_err(at)?);
        rows.push((line, [0, 1, 2, 3].map(|i| cells.get(i).map_or(1, |cell: &TableCell| cell.0))));
    }
    // the script's own checks: ticks in order, sizes
    let checked = config.map_or_else(|| script.check(), |config| script.check_for(config));
    checked.map_err(|error| {
        let (line, [tick, robot, input, value]) = error.event.and_then(|i| rows.get(i)).copied().unwrap_or((1, [1; 4]));
        let column = match error.problem {
            ScriptProblem::Tick(_) | ScriptProblem::Order { .. } => tick,
            ScriptProblem::Robot(_) => robot,
            ScriptProblem::NotTaken(_) => input,
            _ => value,
        };
        ScriptTableError { line, column, reason: error.problem.to_string() }
    })?;
    Ok(script)
}

/// The event of a row that ends before column `end`.
fn event(cells: &[TableCell], end: usize) -> Result<Event, (usize, String)> {
    let cell = |i: usize, what: &str| match cells.get(i) {
        Some((column, text)) if text.is_empty() => Err((*column, format!("{what} is missing"))),
        Some((column, text)) => Ok((*column, text.as_str())),
        None => Err((end, format!("{what} is missing"))),
    };
    let whole = |(column, text): (usize, &str)| {
        text.parse::<i64>().map_err(|_| (column, format!("{text:?} is no whole number")))
    };
    let (column, text) = cell(0, "the tick")?;
    let tick = text.parse().map_err(|_| (column, format!("{text:?} is no tick: a whole number from 1 on")))?;
    let (_, robot) = cell(1, "the robot")?;
    let (column, input) = cell(2, "the input")?;
    let values = cells.get(3..).unwrap_or_default();
    let at_most = |n: usize| match values.get(n) {
        Some((column, _)) => Err((*column, format!("{input} has no more than {n} values"))),
        None => Ok(()),
    };
    let input = match input {
        "Drive" => {
            at_most(2)?;
            let channel = |i, what: &str| {
                let at = cell(i, what)?;
                i16::try_from(whole(at)?).map_err(|_| (at.0, format!("{what} {} is too large", at.1)))
            };
            RobotInput::Drive(channel(3, "the first channel")?, channel(4, "the second channel")?)
        }
        "MoveTo" => RobotInput::MoveTo(coordinates(values, end)?),
        "Teleport" => RobotInput::Teleport(coordinates(values, end)?),
        "SetTrailer" => {
            at_most(1)?;
            RobotInput::SetTrailer(match cell(3, "on or off")? {
                (_, "on" | "true") => true,
                (_, "off" | "false") => false,
                (column, text) => return Err((column, format!("{text:?} is neither on nor off"))),
            })
        }
        "Release" => {
            at_most(0)?;
            RobotInput::Release
        }
        _ => {
            let known = "Drive, MoveTo, Teleport, SetTrailer or Release";
            return Err((column, format!("{input:?} is no input: it must be {known}")));
        }
    };
    Ok(Event { tick, robot: robot.to_owned(), input })
}

/// Metres and radians.
fn coordinates(cells: &[TableCell], end: usize) -> Result<Vec<Quantized>, (usize, String)> {
    if cells.is_empty() {
        return Err((end, "the coordinates are missing".to_owned()));
    }
    let coordinate = |(column, text): &TableCell| {
        let number = text.parse::<f64>().map_err(|_| (*column, format!("{text:?} is no number")))?;
        Quantized::try_new(number).ok_or_else(|| (*column, format!("{text} is too large or not finite")))
    };
    cells.iter().map(coordinate).collect()
}

/// The cells of a row, at least one, without white space around them and without empty ones at its end. A cell may
/// stand in quotes, a quote in it doubled.
fn cells(row: &str) -> Result<Vec<TableCell>, (usize, String)> {
    let mut cells = Vec::new();
    let mut rest = row.chars().zip(1..).peekable();
    loop {
        while rest.next_if(|(c, _)| c.is_whitespace()).is_some() {}
        let column = rest.peek().map_or_else(|| row.chars().count() + 1, |(_, column)| *column);
        let mut text = String::new();
        if rest.next_if(|(c, _)| *c == '"').is_some() {
            loop {
                match rest.next() {
                    Some(('"', _)) if rest.next_if(|(c, _)| *c == '"').is_some() => text.push('"'),
                    Some(('"', _)) => break,
                    Some((c, _)) => text.push(c),
                    None => return Err((column, "the quote is not closed".to_owned())),
                }
            }
            while rest.next_if(|(c, _)| c.is_whitespace()).is_some() {}
            if let Some((c, column)) = rest.peek().filter(|(c, _)| *c != ',') {
                return Err((*column, format!("{c:?} after a quote: a comma belongs there")));
            }
        } else {
            while let Some((c, _)) = rest.next_if(|(c, _)| *c != ',') {
                text.push(c);
            }
            text.truncate(text.trim_end().len());
        }
        if cells.len() == MAX_CELLS {
            return Err((column, format!("more than {MAX_CELLS} cells in a row")));
        }
        cells.push((column, text));
        if rest.next().is_none() {
            break;
        }
    }
    while cells.len() > 1 && cells.last().is_some_and(|(_, text)| text.is_empty()) {
        cells.pop();
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_becomes_the_script_it_describes() {
        let table = "\u{feff}tick,robot,input,first,second\n# a drive\n1,Rusty,Drive,64,-20\n\n 5 , Reach , MoveTo , 0.5 , -1e-6 \r\n\
                     7,\"a \"\"b\"\", c\",Teleport,2,,\n9,Hitch,SetTrailer,on\n9,Hitch,SetTrailer,off,,\n12,Rusty,Release,,";
        let script = super::script(table, None).unwrap();
        let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
        let expected = [
            event(1, "Rusty", RobotInput::Drive(64, -20)),
            event(5, "Reach", RobotInput::MoveTo(vec![Quantized(1 << 19), Quantized(-1)])),
            event(7, "a \"b\", c", RobotInput::Teleport(vec![Quantized(1 << 21)])),
            event(9, "Hitch", RobotInput::SetTrailer(true)),
            event(9, "Hitch", RobotInput::SetTrailer(false)),
            event(12, "Rusty", RobotInput::Release),
        ];
        assert_eq!(script.events, expected);
        assert_eq!(super::script("", None).unwrap(), Script::empty());
    }

    /// Without the limit, each cell of a row of 36 MB of commas took 60 bytes and more.
    #[test]
    fn a_row_has_at_most_a_thousand_cells() {
        // the first value stands in column 16, and a further one two columns on
        let row =
            |values: usize| script(&format!("5,Reach,MoveTo{},x", ",1".repeat(values)), None).unwrap_err().to_string();
        assert_eq!(row(996), "1:2008: \"x\" is no number");
        assert_eq!(row(997), "1:2010: more than 1000 cells in a row");
        assert_eq!(row(1_000_000), "1:2010: more than 1000 cells in a row");
    }

    #[test]
    fn errors_name_line_column_and_reason() {
        for (table, error) in [
            ("x,Rusty,Release", "1:1: \"x\" is no tick: a whole number from 1 on"),
            ("tick\n\n0,Rusty,Release", "3:1: tick 0: it must be in 1 to 4294967296"),
            ("5,Rusty,Release\n4,Rusty,Release", "2:1: tick 4 comes after tick 5: ticks must ascend"),
            ("5", "1:2: the robot is missing"),
            ("5,,Release", "1:3: the robot is missing"),
            ("5,Rusty", "1:8: the input is missing"),
            (
                "5,Rusty,drive,1,2",
                "1:9: \"drive\" is no input: it must be Drive, MoveTo, Teleport, SetTrailer or Release",
            ),
            ("5,Rusty,Drive,1", "1:16: the second channel is missing"),
            ("5,Rusty,Drive,1,fast", "1:17: \"fast\" is no whole number"),
            ("5,Rusty,Drive,1,0.5", "1:17: \"0.5\" is no whole number"),
            ("5,Rusty,Drive,99999,0", "1:15: the first channel 99999 is too large"),
            ("5,Rusty,Drive,129,0", "1:15: channel 129: it must be in -128 to 128"),
            ("5,Rusty,Drive,1,2,3", "1:19: Drive has no more than 2 values"),
            ("5,Rusty,Release,3", "1:17: Release has no more than 0 values"),
            ("5,Reach,MoveTo", "1:15: the coordinates are missing"),
            ("5,Reach,MoveTo,1,,2", "1:18: \"\" is no number"),
            ("5,Reach,MoveTo,1,nan", "1:18: nan is too large or not finite"),
            ("5,Reach,MoveTo,1,1e300", "1:18: 1e300 is too large or not finite"),
            ("5,Hitch,SetTrailer,yes", "1:20: \"yes\" is neither on nor off"),
            ("5,\"Rusty,Release", "1:3: the quote is not closed"),
            ("5,\"Rusty\"x,Release", "1:10: 'x' after a quote: a comma belongs there"),
            (
                "5,R\u{e9}\u{e9},Fly",
                "1:7: \"Fly\" is no input: it must be Drive, MoveTo, Teleport, SetTrailer or Release",
            ),
        ] {
            assert_eq!(script(table, None).unwrap_err().to_string(), error, "{table}");
        }
    }

    #[test]
    fn a_table_is_checked_against_its_world_cell_by_cell() {
        let config = TourConfig::default();
        let refused =
            |row: &str| script(&format!("tick\n4,Rusty,Release\n{row}"), Some(&config)).unwrap_err().to_string();
        assert_eq!(refused("5,Anna,Release"), "3:3: there is no robot \"Anna\"");
        let car =
            "tick 5: robot \"Hitch\" is a hitch and takes no MoveTo: it takes Drive, Teleport, SetTrailer and Release";
        assert_eq!(refused("5,Hitch,MoveTo,1,2,3"), format!("3:9: {car}"));
        assert!(refused("5,Reach,MoveTo,1,2,3").starts_with("3:16: tick 5: MoveTo of robot \"Reach\" has 3"));
        assert!(script("5,Reach,MoveTo,1,2", Some(&config)).is_ok() && script("5,Anna,Release", None).is_ok());
    }
}
