//! A row of the table: a ratio with its interval, and the mark that it is held to.

use crate::interval::Interval;
use crate::measure::Timing;

/// What the ratio says, and what it must be.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    /// The ratio is ours to the other's, and small is good; otherwise the other's to ours.
    is_cost: bool,
    bound: Option<f64>,
    unit: &'static str,
}

impl Mark {
    /// How many times faster than the fastest peer, without a mark.
    pub const FASTER: Mark = Mark { is_cost: false, bound: None, unit: "x" };

    /// At least this many times faster than the fastest peer.
    pub const fn faster_by(bound: f64) -> Self {
        Mark { bound: Some(bound), ..Mark::FASTER }
    }

    /// The cost in units of what stands beside it, without a mark.
    pub const fn cost(unit: &'static str) -> Self {
        Mark { is_cost: true, bound: None, unit }
    }

    /// A cost of at most this.
    pub const fn at_most(bound: f64, unit: &'static str) -> Self {
        Mark { is_cost: true, bound: Some(bound), unit }
    }

    fn text(&self) -> String {
        let Some(bound) = self.bound else { return String::new() };
        format!("{} {bound}{}", if self.is_cost { "<=" } else { ">=" }, self.unit)
    }

    /// What a ratio with its interval is by this mark.
    pub fn verdict(&self, ratio: &Interval) -> Verdict {
        let Some(bound) = self.bound else { return Verdict::Unmarked };
        let (worst, best) = if self.is_cost { (-ratio.high, -ratio.low) } else { (ratio.low, ratio.high) };
        let bound = if self.is_cost { -bound } else { bound };
        if worst >= bound {
            Verdict::Met
        } else if best < bound {
            Verdict::Missed
        } else {
            Verdict::Crossed
        }
    }
}

/// How a ratio with its interval stands to its mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Unmarked,
    /// The whole interval is at the mark or better.
    Met,
    /// The mark lies within the interval.
    Crossed,
    /// The whole interval is worse than the mark.
    Missed,
}

/// A line of the table.
pub struct Row {
    pub work: String,
    pub ours: String,
    /// What the ratio is to: the fastest peer.
    pub beside: String,
    pub ratio: String,
    pub mark: String,
    /// The other peers.
    pub others: String,
    pub verdict: Verdict,
}

impl Row {
    /// A row of what was measured together. The first timing is ours; the ratio is to the fastest of the others.
    pub fn new(work: String, mark: Mark, ours: &Timing, peers: &[Timing]) -> Self {
        let mut peers: Vec<&Timing> = peers.iter().collect();
        peers.sort_by(|a, b| a.median.total_cmp(&b.median));
        let said = |peer: &Timing| format!("{} {}", peer.name, time(peer.median));
        let Some((fastest, others)) = peers.split_first() else { return Row::note(work, time(ours.median)) };
        let ratio = Interval::of(&work, &if mark.is_cost { ours.over(fastest) } else { fastest.over(ours) });
        let verdict = mark.verdict(&ratio);
        Row {
            ours: time(ours.median),
            beside: said(fastest),
            ratio: format!("{}{} ({} to {})", digits(ratio.median), mark.unit, digits(ratio.low), digits(ratio.high)),
            mark: marked(mark.text(), verdict),
            others: others.iter().map(|peer| said(peer)).collect::<Vec<_>>().join("; "),
            verdict,
            work,
        }
    }

    /// A row that only says how long something takes.
    pub fn note(work: String, ours: String) -> Self {
        let nothing = String::new;
        Row {
            work,
            ours,
            beside: nothing(),
            ratio: nothing(),
            mark: nothing(),
            others: nothing(),
            verdict: Verdict::Unmarked,
        }
    }

    /// The same row held to a mark of its own.
    #[must_use]
    pub fn held_to(mut self, mark: &str, verdict: Verdict) -> Self {
        self.mark = marked(mark.to_owned(), verdict);
        self.verdict = verdict;
        self
    }

    pub fn line(&self) -> String {
        let Row { work, ours, beside, ratio, mark, others, .. } = self;
        format!("| {work} | {ours} | {beside} | {ratio} | {mark} | {others} |")
    }
}

fn marked(mark: String, verdict: Verdict) -> String {
    match verdict {
        Verdict::Unmarked | Verdict::Met => mark,
        Verdict::Crossed => format!("{mark}, within the interval"),
        Verdict::Missed => format!("**{mark}, missed**"),
    }
}

/// A ratio with three digits.
fn digits(ratio: f64) -> String {
    let places = if ratio < 9.995 {
        2
    } else if ratio < 99.95 {
        1
    } else {
        0
    };
    format!("{ratio:.places$}")
}

/// A duration with three digits.
pub fn time(nanoseconds: f64) -> String {
    let (value, unit) = match nanoseconds {
        n if n < 999.5 => (n, "ns"),
        n if n < 999.5e3 => (n / 1e3, "us"),
        n => (n / 1e6, "ms"),
    };
    format!("{} {unit}", digits(value))
}
