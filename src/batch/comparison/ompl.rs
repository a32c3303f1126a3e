//! The attempts of a comparison in the grammar of OMPL's benchmark logs, which its statistics script reads into a
//! database, and Planner Arena from there: <https://ompl.kavrakilab.org/benchmark.html>.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use motion_lab_core::configuration::Configuration as _;
use motion_lab_sim::plans::PlannerName;

use super::case::{AskedPath, PlanCase};
use super::compared::{ComparedAttempt, PlannerComparison};

/// The properties of a run, as OMPL names what it has too, in the order of their names, with their types.
const PROPERTIES: [&str; 10] = [
    "correct solution BOOLEAN",
    "edges asked INTEGER",
    "edges free INTEGER",
    "iterations INTEGER",
    "proven clearance REAL",
    "samples INTEGER",
    "seed INTEGER",
    "solution length REAL",
    "solved BOOLEAN",
    "time REAL",
];

impl PlannerComparison {
    /// A log for each problem that there is, by its number, from 1. `version` is that of the program.
    ///
    /// A run is solved where it has a path, and correct where that path is proven. What is the path's is empty without
    /// one. No run has a limit of time or of memory, and no log says when or on which machine it was made.
    pub fn ompl_logs(&self, attempts: &[ComparedAttempt], version: &str) -> Vec<(u64, String)> {
        let mut of_case: BTreeMap<u64, Vec<&ComparedAttempt>> = BTreeMap::new();
        for attempt in attempts.iter().filter(|attempt| attempt.case.asked.is_some()) {
            let number = attempt.case.known.as_ref().map_or(1, |known| known.number);
            of_case.entry(number).or_default().push(attempt);
        }
        of_case.into_iter().map(|(number, own)| (number, self.ompl_log(&own, version))).collect()
    }

    /// The log of the attempts at one problem, of which there is one.
    fn ompl_log(&self, own: &[&ComparedAttempt], version: &str) -> String {
        let case = &own[0].case;
        let seconds: f64 = own.iter().map(|attempt| attempt.seconds).sum();
        let of_planner = |planner: &PlannerName| own.iter().filter(|attempt| attempt.planner == *planner).count();
        let runs = self.planners.iter().map(of_planner).max().unwrap_or(0);
        let mut text = String::new();
        // writing to a string does not fail
        let _ = write!(
            text,
            "motion-lab version {version}\nExperiment {}\nRunning on unknown\nStarting at unknown\n<<<|\n{}|>>>\n",
            experiment(case),
            setup(case, self.unit())
        );
        let _ = write!(
            text,
            "{} is the random seed\ninf seconds per run\ninf MB per run\n{runs} runs per planner\n{seconds} seconds \
             spent to collect the data\n0 enum type\n{} planners\n",
            self.seeds.start,
            self.planners.len()
        );
        let proves = self.problems().checker.proves();
        for planner in &self.planners {
            planner_log(&mut text, *planner, own, proves);
        }
        text
    }
}

/// What came of one planner.
fn planner_log(text: &mut String, planner: PlannerName, attempts: &[&ComparedAttempt], proves: bool) {
    let runs: Vec<&&ComparedAttempt> = attempts.iter().filter(|attempt| attempt.planner == planner).collect();
    let _ = write!(text, "{}\n0 common properties\n{} properties for each run\n", planner.id(), PROPERTIES.len());
    PROPERTIES.iter().for_each(|property| *text += &format!("{property}\n"));
    let _ = writeln!(text, "{} runs", runs.len());
    for ComparedAttempt { seed, effort, seconds, path, .. } in runs {
        let solved = u8::from(path.is_ok()).to_string();
        let of_path = |number: Option<f64>| number.map_or_else(String::new, |x| x.to_string());
        let path = path.as_ref().ok();
        let values = [
            u8::from(path.is_some() && proves).to_string(),
            effort.edges.to_string(),
            effort.free.to_string(),
            effort.iterations.to_string(),
            of_path(path.filter(|_| proves).map(|path| path.clearance)),
            effort.samples.to_string(),
            seed.0.to_string(),
            of_path(path.map(|path| path.length)),
            solved,
            seconds.to_string(),
        ];
        values.iter().for_each(|value| *text += &format!("{value}; "));
        text.push('\n');
    }
    *text += ".\n";
}

/// The name of an experiment, one word: the reader takes the last of the line.
fn experiment(case: &PlanCase) -> String {
    let name = match (&case.known, &case.asked) {
        (Some(known), _) => format!("{} {}", known.set, known.number),
        (None, Some(asked)) => format!("{} in {}", asked.robot, asked.world),
        (None, None) => "problem".into(),
    };
    name.split_whitespace().collect::<Vec<_>>().join("_")
}

/// What the problem is.
fn setup(case: &PlanCase, unit: &str) -> String {
    let Some(AskedPath { robot, world, ends }) = &case.asked else { return "no problem\n".into() };
    let [start, goal] = ends.map(|q| q.coordinates().iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    // a name is one line, and no line of the text ends it
    format!("robot {robot}\nworld {world}\nstart {start}\ngoal {goal}\nlengths in {unit}\n")
}
