//! A task as numbers and text: what the table hands to a rival in a program of its own.

use std::io::{self, BufRead, Write};

/// Work that is asked for case by case, in metres and radians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Task {
    /// What is asked: the name of a function of `contenders`.
    pub kind: String,
    /// Numbers that hold for all cases.
    pub settings: Vec<f64>,
    /// Placed shapes: a radius, then x and y of each vertex of the core.
    pub obstacles: Vec<Vec<f64>>,
    pub cases: Vec<Vec<f64>>,
}

fn numbers(line: &str) -> io::Result<Vec<f64>> {
    let number = |word: &str| word.parse().map_err(|_| io::Error::other(format!("no number: {word}")));
    line.split_whitespace().map(number).collect()
}

impl Task {
    /// Writes a head, a line of settings, and a line for each obstacle and case. Numbers are read back to the same
    /// bits.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        writeln!(to, "task {} {} {}", self.kind, self.obstacles.len(), self.cases.len())?;
        for line in std::iter::once(&self.settings).chain(&self.obstacles).chain(&self.cases) {
            let words: Vec<String> = line.iter().map(f64::to_string).collect();
            writeln!(to, "{}", words.join(" "))?;
        }
        to.flush()
    }

    /// Reads what follows the word `task` of a head, and the lines after it.
    pub fn read(head: &str, from: &mut impl BufRead) -> io::Result<Task> {
        let words: Vec<&str> = head.split_whitespace().collect();
        let [kind, obstacles, cases] = words[..] else { return Err(io::Error::other(format!("no task: {head}"))) };
        let count = |word: &str| word.parse::<usize>().map_err(io::Error::other);
        let (obstacles, cases) = (count(obstacles)?, count(cases)?);
        let mut lines = from.lines();
        let mut line = || numbers(&lines.next().unwrap_or_else(|| Err(io::ErrorKind::UnexpectedEof.into()))?);
        Ok(Task {
            kind: kind.into(),
            settings: line()?,
            obstacles: (0..obstacles).map(|_| line()).collect::<io::Result<_>>()?,
            cases: (0..cases).map(|_| line()).collect::<io::Result<_>>()?,
        })
    }
}
