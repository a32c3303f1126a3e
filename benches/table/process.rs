//! A rival in a program of its own: it reads tasks and says how long it took, by its own clock.
//!
//! Each line of its input is a request. `task ...` gives a task (`rivals/task.rs`) and is answered by the names of its
//! ways to do it, with `|` between them; `answers WAY` by a line for each case; `round WAY` does all cases once and is
//! answered by the time of one, nanoseconds.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use crate::rivals::Task;

pub struct Process {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

impl Process {
    /// Starts a program, in this one's process group.
    pub fn start(command: &mut Command) -> Self {
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the rival starts");
        let output = BufReader::new(child.stdout.take().expect("a pipe"));
        Process { input: child.stdin.take(), output, child }
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.output.read_line(&mut line).expect("the rival answers");
        assert!(line.ends_with('\n'), "the rival ended: {line:?}");
        line.trim_end().to_owned()
    }

    fn ask(&mut self, request: &str) -> String {
        writeln!(self.input.as_mut().expect("open"), "{request}").expect("the rival listens");
        self.line()
    }

    /// Gives it a task. Returns the names of its ways to do it.
    pub fn load(&mut self, task: &Task) -> Vec<String> {
        task.write(self.input.as_mut().expect("open")).expect("the rival listens");
        self.line().split('|').filter(|name| !name.is_empty()).map(str::to_owned).collect()
    }

    /// What came out of each case.
    pub fn answers(&mut self, way: usize, cases: usize) -> Vec<Vec<f64>> {
        let number = |word: &str| word.parse().expect("a number");
        let first = self.ask(&format!("answers {way}"));
        let rest = (1..cases).map(|_| self.line()).collect::<Vec<_>>();
        std::iter::once(first).chain(rest).map(|line| line.split_whitespace().map(number).collect()).collect()
    }

    /// Does all cases once. Returns the time of one, nanoseconds.
    pub fn round(&mut self, way: usize) -> f64 {
        self.ask(&format!("round {way}")).parse().expect("a time")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        drop(self.input.take()); // at the end of its input it ends
        _ = self.child.wait();
    }
}
