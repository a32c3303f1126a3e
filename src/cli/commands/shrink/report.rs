//! What is left of a run.

use crate::web::Link;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::run::{Log, Recorded, seconds};
use motion_lab_sim::shrink::{RecipeSize, Shrunk};
use serde::Serialize;

use crate::cli::support::console::note;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure};

/// What came of shrinking, as JSON.
#[derive(Serialize)]
pub struct ShrinkReport {
    before: SizeRow,
    after: SizeRow,
    tries: u64,
    #[serde(rename = "minimal")]
    is_minimal: bool,
    digest: String,
    #[serde(skip)]
    keeps_worlds: bool,
    /// The address of the run; null where it fits in none.
    link: Option<String>,
    /// Why it fits in none.
    #[serde(skip)]
    no_link: Option<String>,
}

/// How much a run holds, as JSON.
#[derive(Serialize)]
struct SizeRow {
    worlds: usize,
    robots: usize,
    sensors: usize,
    obstacles: usize,
    others: usize,
    events: usize,
    changes: usize,
    seconds: JsonNumber,
}

impl SizeRow {
    fn new(size: &RecipeSize) -> Self {
        let RecipeSize { worlds, robots, sensors, obstacles, others, events, changes, ticks, .. } = *size;
        SizeRow { worlds, robots, sensors, obstacles, others, events, changes, seconds: JsonNumber(seconds(ticks)) }
    }

    /// The numbers with what they count.
    fn rows(&self) -> [(&'static str, String); 8] {
        [
            ("worlds", self.worlds.to_string()),
            ("robots", self.robots.to_string()),
            ("sensors", self.sensors.to_string()),
            ("obstacles, doors", self.obstacles.to_string()),
            ("routes, places, marks", self.others.to_string()),
            ("events", self.events.to_string()),
            ("changes of worlds", self.changes.to_string()),
            ("seconds", format!("{:.2}", self.seconds.0)),
        ]
    }
}

impl ShrinkReport {
    /// The report of a shrunk run with its log, for the page at this address.
    pub fn new(shrunk: &Shrunk, log: &Log, keeps_worlds: bool, site: &str) -> Self {
        let digest = match &log.recorded {
            Recorded::Digests(digests) => digests.whole,
            Recorded::Frames { .. } => log.digest(),
        };
        let digest = digest.map(|digest| digest.to_string()).unwrap_or_default();
        let with_digest = |link| Link { digest: Some(digest.clone()), ..link };
        let (link, no_link) = match Link::of(&log.recipe).and_then(|link| with_digest(link).address(site)) {
            Ok(link) => (Some(link), None),
            Err(error) => (None, Some(error.to_string())),
        };
        let (before, after) = (SizeRow::new(&shrunk.before), SizeRow::new(&shrunk.after));
        let (tries, is_minimal) = (shrunk.tries, shrunk.is_minimal());
        ShrinkReport { before, after, tries, is_minimal, keeps_worlds, digest, link, no_link }
    }

    /// Prints a table of what there was and what is left, then the digest and the link.
    pub fn print(&self, data: &mut Data) -> Result<(), Failure> {
        data.line(format!("{:21}  {:>8}  {:>8}", "", "before", "after"))?;
        for ((what, before), (_, after)) in self.before.rows().iter().zip(self.after.rows()) {
            data.line(format!("{what:21}  {before:>8}  {after:>8}"))?;
        }
        let tried = counted(self.tries, "run");
        if self.is_minimal {
            let parts = if self.keeps_worlds { "one of its worlds, events and changes" } else { "any one of these" };
            data.line(format!("1-minimal, after {tried}: without {parts}, or a tick shorter, it is not shown"))?;
        }
        data.line(format!("digest {}", self.digest))?;
        if let Some(reason) = &self.no_link {
            note(format!("it has no link: {reason}"));
        }
        self.link.iter().try_for_each(|link| data.line(link))
    }
}
