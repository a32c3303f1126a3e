//! `shrink`, the search for the smallest recipe that still shows something.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering};

use super::first::first_holding;
use super::recordable::is_recordable;
use super::removal::{Removal, RemovalGroup};
use super::round::{DECIMALS, Rounded, roundable, rounded};
use super::size::RecipeSize;
use super::without::{up_to, without};
use crate::run::Recipe;

/// How to shrink.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShrinkOptions {
    /// How many candidates are tried at once. It changes nothing of what comes out.
    pub jobs: usize,
    /// Largest number of candidates. Those that are tried at once and turn out not to be needed do not count.
    pub max_tries: u64,
    /// Whether every world that is left stays as it is, and so does the run's sensor. Whole worlds, inputs, their
    /// digits and time are taken away even so.
    pub keeps_worlds: bool,
}

impl Default for ShrinkOptions {
    fn default() -> Self {
        ShrinkOptions { jobs: 1, max_tries: 10_000, keeps_worlds: false }
    }
}

/// Why shrinking ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShrinkEnd {
    /// Nothing more can be taken away alone.
    Minimal,
    /// All candidates allowed were tried.
    TriesSpent,
    /// It was not to go on.
    Stopped,
}

/// What came of shrinking.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Shrunk {
    /// The smallest recipe found. It holds, if the one to shrink does.
    pub recipe: Recipe,
    /// The number of candidates tried, in the order in which one job tries them.
    pub tries: u64,
    /// How much there was.
    pub before: RecipeSize,
    /// How much is left.
    pub after: RecipeSize,
    /// Why it ended.
    pub end: ShrinkEnd,
}

impl Shrunk {
    /// Whether the recipe is 1-minimal: without any single thing of it, or a tick shorter, or with one thing's numbers
    /// rounded further as long as all else stays needed, it does not hold. What refers to a thing goes with it, and
    /// worlds that are kept as they are count as one thing each.
    pub fn is_minimal(&self) -> bool {
        self.end == ShrinkEnd::Minimal
    }
}

/// Makes a recipe for which `holds` is true smaller, as long as it stays true: fewer worlds, sensors, robots, inputs,
/// obstacles and their pieces, fewer ticks. Each of these is tried in chunks, from all of them down to one, and all
/// again until nothing more succeeds: delta debugging (Zeller and Hildebrandt). Then numbers get fewer digits, as far
/// as everything that is left stays needed, so that a start is not rounded into an obstacle.
///
/// `holds` must depend on the recipe alone. A recipe that cannot run is tried too: it has to be false there. One that
/// no log can hold is not, nor one with a robot outside its world that was not outside: what is left can be recorded.
/// With `holds` the result depends on the recipe and the options but [`jobs`](ShrinkOptions::jobs) alone, unless
/// `go_on`, asked before each candidate, stops the search.
pub fn shrink(
    recipe: &Recipe,
    options: &ShrinkOptions,
    holds: impl Fn(&Recipe) -> bool + Sync,
    go_on: impl Fn() -> bool + Sync,
) -> Shrunk {
    let mut shrinking = Shrinking { best: recipe.clone(), tries: 0, end: None, options, holds, go_on };
    loop {
        while shrinking.remove() {}
        if !shrinking.round() {
            break;
        }
    }
    let Shrinking { best, tries, end, .. } = shrinking;
    let (before, after) = (RecipeSize::of(recipe), RecipeSize::of(&best));
    Shrunk { recipe: best, tries, before, after, end: end.unwrap_or(ShrinkEnd::Minimal) }
}

/// A search under way.
struct Shrinking<'a, H, G> {
    best: Recipe,
    tries: u64,
    end: Option<ShrinkEnd>,
    options: &'a ShrinkOptions,
    holds: H,
    go_on: G,
}

impl<H: Fn(&Recipe) -> bool + Sync, G: Fn() -> bool + Sync> Shrinking<'_, H, G> {
    /// The groups of removals that are allowed.
    fn groups(&self) -> impl Iterator<Item = RemovalGroup> + use<H, G> {
        let keeps_worlds = self.options.keeps_worlds;
        RemovalGroup::ALL.into_iter().filter(move |group| !keeps_worlds || group.leaves_worlds())
    }

    /// Tries to take away everything once. Returns whether anything was, and more is to be tried.
    fn remove(&mut self) -> bool {
        let mut is_smaller = false;
        for group in self.groups() {
            is_smaller |= self.reduce(group.removals(&self.best), without, |_, _| true);
            // shorter runs make all that follows quicker
            if group.leaves_worlds() {
                is_smaller |= self.shorten();
            }
        }
        is_smaller && self.end.is_none()
    }

    /// Tries to round every number once. Returns whether any was, and more is to be tried.
    fn round(&mut self) -> bool {
        let mut is_smaller = false;
        for decimals in DECIMALS {
            let things = roundable(&self.best, decimals, self.options.keeps_worlds);
            let change = |recipe: &Recipe, things: &BTreeSet<Rounded>| rounded(recipe, things, decimals);
            is_smaller |= self.reduce(things, change, Self::needs_all);
        }
        is_smaller |= self.shorten();
        is_smaller && self.end.is_none()
    }

    /// Whether a recipe that holds does so no longer after any single removal.
    fn needs_all(&mut self, recipe: &Recipe) -> bool {
        let removals: Vec<Removal> = self.groups().flat_map(|group| group.removals(recipe)).collect();
        let candidate = |i: usize| without(recipe, &BTreeSet::from([*removals.get(i)?]));
        self.first(removals.len(), candidate).is_none() && self.end.is_none()
    }

    /// Applies `change` to as many of these things as it can: to all, to halves of them, down to each. A recipe that
    /// holds also has to be `allowed`. Returns whether it could to any.
    fn reduce<T: Ord + Copy + Sync>(
        &mut self,
        mut things: Vec<T>,
        change: impl Fn(&Recipe, &BTreeSet<T>) -> Option<Recipe> + Sync,
        allowed: impl Fn(&mut Self, &Recipe) -> bool,
    ) -> bool {
        let whole = self.best.clone();
        let mut changed = BTreeSet::new();
        let mut size = things.len();
        while size > 0 && self.end.is_none() {
            let mut at = 0;
            while at < things.len() {
                let chunk = |i: usize| at + i * size..things.len().min(at + (i + 1) * size);
                let best = self.best.clone();
                let candidate = |i: usize| {
                    let further = things[chunk(i)].iter().copied();
                    let candidate = change(&whole, &changed.iter().copied().chain(further).collect());
                    candidate.filter(|candidate| *candidate != best)
                };
                let Some((i, smaller)) = self.first((things.len() - at).div_ceil(size), candidate) else { break };
                let range = chunk(i);
                if allowed(self, &smaller) {
                    self.best = smaller;
                    at = range.start;
                    changed.extend(things.drain(range));
                } else {
                    at = range.end;
                }
            }
            size = if size == 1 { 0 } else { size.div_ceil(2) };
        }
        !changed.is_empty()
    }

    /// Takes as many ticks from the run's end as it can, first all, then half of them, down to one. Returns whether it
    /// could.
    fn shorten(&mut self) -> bool {
        let before = self.best.config.ticks;
        let mut step = before;
        loop {
            let (recipe, ticks) = (self.best.clone(), self.best.config.ticks);
            let halves = std::iter::successors(Some(step.min(ticks)), |step| Some(step / 2));
            let steps: Vec<u64> = halves.take_while(|step| *step > 0).collect();
            let candidate = |i: usize| Some(up_to(&recipe, ticks - steps.get(i)?));
            let Some((i, shorter)) = self.first(steps.len(), candidate) else { break };
            (step, self.best) = (steps[i], shorter);
        }
        self.best.config.ticks < before
    }

    /// The first of `count` candidates that holds, with its index.
    fn first(&mut self, count: usize, candidate: impl Fn(usize) -> Option<Recipe> + Sync) -> Option<(usize, Recipe)> {
        let Shrinking { holds, go_on, options, best, .. } = self;
        let left = options.max_tries.saturating_sub(self.tries);
        let allowed = usize::try_from(left).unwrap_or(usize::MAX).min(count);
        // fewer than are allowed are begun where it is not to go on
        let begun = AtomicU64::new(0);
        let tried = |i: usize| {
            begun.fetch_add(1, Ordering::Relaxed);
            candidate(i).is_some_and(|recipe| is_recordable(&recipe, best) && holds(&recipe))
        };
        let found = first_holding(options.jobs, allowed, tried, &*go_on);
        self.tries += found.map_or(begun.into_inner(), |i| i as u64 + 1);
        match found {
            Some(i) => return candidate(i).map(|recipe| (i, recipe)),
            None if !go_on() => self.end = Some(ShrinkEnd::Stopped),
            None if allowed < count => self.end = Some(ShrinkEnd::TriesSpent),
            None => {}
        }
        None
    }
}

#[cfg(test)]
mod tests;
