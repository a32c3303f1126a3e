//! How the lengths of planners' paths fell over their iterations, as a figure.

use super::chart::{MAX_LINES, PlotChart, PlotLine, PlotValues};
use super::plot::BORDERS;
use super::{Captured, Note};
use motion_lab_core::picture::Figure;

/// How the length of a planner's path fell.
#[derive(Clone, Debug, PartialEq)]
pub struct CostCurve {
    /// The planner's name in books.
    pub planner: String,
    /// The iterations after which it was seen to be another, and the length from there on.
    pub steps: Vec<(u64, f64)>,
    /// The iterations after which it worked no more.
    pub end: u64,
}

/// The lines of a figure of lengths, and what they are of.
#[derive(Clone, Debug, PartialEq)]
pub struct CostFigure {
    /// The lines; those beyond [`MAX_LINES`] are left out.
    pub lines: Vec<CostCurve>,
    /// The number of attempts that each is the median of.
    pub attempts: usize,
    /// The unit of the lengths.
    pub unit: &'static str,
    /// The name of the problem: its robot and its world.
    pub problem: String,
}

/// The figure for a sheet of this width, pixels: each line falls in steps, begins where more than half of the attempts
/// have a path, and goes on level where its planner works no more.
pub fn costs(sheet: &CostFigure, width_px: f64) -> Captured {
    let CostFigure { lines, attempts, unit, problem } = sheet;
    let drawn = &lines[..lines.len().min(MAX_LINES)];
    let end = drawn.iter().map(|line| line.end).max().unwrap_or(0).max(1);
    let up = format!("length of the path, {unit}");
    let chart = PlotChart {
        up: &up,
        across: "iterations",
        span: [0.0, end as f64],
        only: None,
        values: PlotValues::Alone,
        lines: drawn.iter().map(|line| stepped(line, end)).collect(),
    };
    let mut figure = Figure::of(chart.picture(width_px - BORDERS));
    figure.title = format!("How the lengths of paths fell: {problem}");
    figure.description = drawn.iter().map(|line| sentence(line, unit)).collect::<Vec<_>>().join(" ");
    let over = if *attempts == 1 { "One attempt".to_owned() } else { format!("Medians over {attempts} attempts") };
    let left_out = match lines.len() - drawn.len() {
        0 => String::new(),
        more => format!(" {more} more planners are left out."),
    };
    figure.caption = vec![format!("{over}, from where more than half of them have a path.{left_out}")];
    let notes: Vec<Note> = vec![("Problem", problem.clone()), ("Attempts", attempts.to_string())];
    Captured { figure, notes }
}

/// The line in steps: level up to where the length is another, and up to the end.
fn stepped(line: &CostCurve, end: u64) -> PlotLine {
    let mut piece: Vec<[f64; 2]> = Vec::new();
    for &(iterations, length) in &line.steps {
        if let Some(&[_, before]) = piece.last() {
            piece.push([iterations as f64, before]);
        }
        piece.push([iterations as f64, length]);
    }
    if let Some(&[_, last]) = piece.last() {
        piece.push([end as f64, last]);
    }
    let pieces = if piece.is_empty() { Vec::new() } else { vec![piece] };
    PlotLine { name: line.planner.clone(), pieces, contacts: Vec::new() }
}

/// The line for readers who do not see the figure.
fn sentence(line: &CostCurve, unit: &str) -> String {
    match &line.steps[..] {
        [] => format!("{} has a path in at most half of the attempts.", line.planner),
        [(at, length)] => format!("{} has {length:.3} {unit} from iteration {at} on.", line.planner),
        [(at, first), .., (by, last)] => {
            format!("{} has {first:.3} {unit} at iteration {at}, and {last:.3} {unit} from {by} on.", line.planner)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::picture::Drawing;

    fn line(planner: &str, steps: &[(u64, f64)]) -> CostCurve {
        CostCurve { planner: planner.into(), steps: steps.to_vec(), end: 400 }
    }

    #[test]
    fn lines_fall_in_steps_between_the_lengths_that_there_are() {
        let b = CostCurve { end: 60, ..line("B", &[(40, 8.5)]) };
        let lines = vec![line("A", &[(100, 9.0), (300, 8.0)]), b, line("C", &[])];
        let sheet = CostFigure { lines, attempts: 3, unit: "m", problem: "R in end".into() };
        let captured = costs(&sheet, 640.0);
        let picture = &captured.figure.panels[0].picture;
        let outline = |id: &str| match &picture.items.iter().find(|item| item.id == id).unwrap().drawing {
            Drawing::Region { outline, .. } => outline.clone(),
            _ => panic!("lines"),
        };
        let a = &outline("line/A")[0];
        assert_eq!(a.len(), 4, "{a:?}");
        assert!(a[0].y == a[1].y && a[1].x == a[2].x && a[2].y == a[3].y && a[2].y < a[0].y, "{a:?}");
        // 100, 300 and 400 of 400 iterations
        let share = (a[1].x - a[0].x) / (a[3].x - a[0].x);
        assert!((share - 2.0 / 3.0).abs() < 1e-9, "{share}");
        let b = &outline("line/B")[0];
        assert!((b[0].y - 0.5 * (a[0].y + a[2].y)).abs() < 1e-9 && b[1].x == a[3].x, "{b:?}");
        // no axis from 0 would flatten the lines: 8 to 9 m are 100 of its 108 parts
        let Drawing::Polyline(axes) = &picture.items.iter().find(|item| item.id == "axes").unwrap().drawing else {
            panic!("a line")
        };
        assert!(((a[0].y - a[2].y) / (axes[0].y - axes[1].y) - 100.0 / 108.0).abs() < 1e-9, "{a:?} {axes:?}");
        assert!(outline("line/C").is_empty());
        assert_eq!(
            captured.figure.caption,
            ["Medians over 3 attempts, from where more than half of them have a path."]
        );
        let many = CostFigure { lines: vec![sheet.lines[0].clone(); MAX_LINES + 2], ..sheet };
        assert!(costs(&many, 640.0).figure.caption[0].ends_with(" 2 more planners are left out."));
        assert!(captured.figure.description.contains("A has 9.000 m at iteration 100, and 8.000 m from 300 on."));
        assert!(captured.figure.description.contains("C has a path in at most half of the attempts."));
    }
}
