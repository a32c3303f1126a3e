//! The table's work by parry2d-f64, in its own types. Three programs are built from these files: the table, the
//! WebAssembly bench, and `benches/rivals`, which has parry as its users build it. Obstacles, and the questions about
//! them that the black box of the core asks too, are the core's own file on them.

mod arms;
mod cars;
mod discs;
mod distances;
mod obstacles;
#[allow(dead_code)]
#[path = "../../../crates/core/src/collision/parry/pieces.rs"]
mod pieces;
mod rectangles;
mod samples;
mod scans;
mod task;

pub use samples::bisected;
pub use task::Task;

/// A way to do a task's work.
pub trait Contender {
    /// What it is called in the table.
    fn name(&self) -> &'static str;

    /// Does one case. The number keeps the compiler from leaving the work out.
    fn work(&mut self, case: usize) -> f64;

    /// What came out of a case, to be compared before the race.
    fn answers(&mut self, case: usize) -> Vec<f64> {
        vec![self.work(case)]
    }
}

/// A contender that is a function of the case.
pub struct By<F> {
    pub name: &'static str,
    pub ask: F,
}

impl<F: FnMut(usize) -> f64> Contender for By<F> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn work(&mut self, case: usize) -> f64 {
        (self.ask)(case)
    }
}

/// Parry's ways to do a task, none for what it cannot do.
pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    match task.kind.as_str() {
        "scan" => scans::contenders(task),
        "distance" => distances::contenders(task),
        "rectangles" => rectangles::contenders(task),
        "disc_free" => discs::free(task),
        "disc_hit" => discs::hit(task),
        "arm_free" | "arm_hit" => arms::contenders(task),
        "car_free" | "car_hit" => cars::contenders(task),
        _ => Vec::new(),
    }
}

/// Does all cases once, and returns the time of one, nanoseconds. The last few are done before that, so that nobody
/// begins with what another left in the caches.
pub fn lap(cases: usize, mut work: impl FnMut(usize)) -> f64 {
    (cases - cases / 16..cases).for_each(&mut work);
    let start = std::time::Instant::now();
    (0..cases).for_each(work);
    start.elapsed().as_secs_f64() * 1e9 / cases as f64
}
