//! `Removal`, what to move where there is no path: the least set of doors to open and obstacles to take away.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use motion_lab_core::collision::{ProblemError, Scene};
use motion_lab_core::planning::{Bounds, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::{ObstacleKind, World};

use super::named::PlannerName;
use super::task::Task;

/// Largest sets that are all tried, as far as they can help.
const MAX_EXACT: usize = 3;

/// Largest number of sets that are planned without.
const MAX_TRIED: usize = 1000;

/// What is in the way of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BlockerKind {
    /// A door that is closed: it is to be opened.
    Door,
    /// A solid obstacle.
    Obstacle,
    /// A wall.
    Wall,
}

/// A thing of the world without which a path appears, alone or with others.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Blocker {
    /// What it is.
    pub kind: BlockerKind,
    /// Its name.
    pub name: String,
}

/// A set of things without which a proven path appears, and each of which has to go for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Removal {
    /// The things, doors first; none where there is a path as it is.
    pub blockers: Vec<Blocker>,
    /// The fewest doors, up to three, that suffice to be opened, where `blockers` are not doors alone.
    pub doors: Option<Vec<Blocker>>,
    /// Whether it is proven that no fewer things will do.
    pub is_least: bool,
    /// The number of sets that were planned without.
    pub tried: usize,
}

impl Removal {
    /// What to do with these things, as after *if you*: `open "A's door" and take away "the post"`.
    pub fn to_do(things: &[Blocker]) -> String {
        let list = |verb: &str, is_door: bool| {
            let of_kind = things.iter().filter(|thing| (thing.kind == BlockerKind::Door) == is_door);
            let names: Vec<String> = of_kind.map(|thing| format!("{:?}", thing.name)).collect();
            (!names.is_empty()).then(|| format!("{verb} {}", names.join(", ")))
        };
        [list("open", true), list("take away", false)].into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }

    /// The doors that suffice to be opened: the things, where all are doors, or the doors named beside them.
    pub fn doors_alone(&self) -> Option<&[Blocker]> {
        let are_doors = self.blockers.iter().all(|thing| thing.kind == BlockerKind::Door);
        if are_doors { Some(&self.blockers[..]).filter(|doors| !doors.is_empty()) } else { self.doors.as_deref() }
    }
}

/// Why no set is named.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoRemoval {
    /// Whatever is taken away: cells that no obstacle blocks would have to go.
    #[error("nothing that could be taken away is in the way")]
    Nothing,
    /// Neither a path nor a proof that there is none.
    #[error(transparent)]
    Undecided(NoPath),
    /// There are too many sets to look at; this many were.
    #[error("after {0} sets of things were taken away it is still not known what to move")]
    TooMany(usize),
}

/// What comes of a problem without some things.
#[derive(Clone, Debug, PartialEq)]
enum Decision {
    /// There is a path.
    Path,
    /// There is none while all of these stand.
    Blocked(BTreeSet<Blocker>),
    /// It is not known.
    Undecided(NoPath),
}

impl Task {
    /// The least set of things whose removal makes a proven path appear: doors are opened, obstacles and walls taken
    /// away. Of several such sets one with the most doors, and then the most obstacles that are no walls.
    ///
    /// A barrier that stands after a removal stands before it too, so a set that helps has a thing of every barrier.
    /// All such sets of up to three things are tried ([`Removal::is_least`]). A larger set is one of which nothing can
    /// stay. Paths and barriers are those of [`PlannerName::CellDecomposition`], for the same tube and clearance; a
    /// car's paths are those of [`PlannerName::HybridAStar`], and its barriers those of the car without its trailer.
    ///
    /// # Errors
    /// [`NoRemoval`]: an end is wrong whatever is taken away, something stays undecided, or too many sets would have to
    /// be tried.
    pub fn what_blocks(&self) -> Result<Removal, NoRemoval> {
        self.what_blocks_within(MAX_TRIED)
    }

    /// As [`what_blocks`](Self::what_blocks), with at most this number of sets planned without.
    ///
    /// # Errors
    /// Those of `what_blocks`.
    pub fn what_blocks_within(&self, sets: usize) -> Result<Removal, NoRemoval> {
        Trials::new(sets, |gone| self.without(gone).decide()).least()
    }

    /// The same task in a world in which these doors are open, and other things of these are gone.
    pub fn without_blockers(&self, blockers: &[Blocker]) -> Task {
        self.without(&blockers.iter().cloned().collect())
    }

    /// The same task in a world without these things.
    fn without(&self, gone: &BTreeSet<Blocker>) -> Task {
        let is_gone = |name: &str| gone.iter().any(|blocker| blocker.name == name);
        let mut world = World::clone(&self.world);
        world.obstacles.retain(|obstacle| !is_gone(&obstacle.name));
        world.doors.iter_mut().filter(|door| is_gone(&door.name)).for_each(|door| door.open = true);
        Task { scene: Arc::new(Scene::of_world(&world)), world: Arc::new(world), ..self.clone() }
    }

    fn decide(&self) -> Decision {
        let by_cells = PlannerName::CellDecomposition;
        // the planner draws no samples: every seed is the same
        let mut attempt = match self.attempt(by_cells, Seed(0)) {
            Ok(attempt) => attempt,
            Err(reason) => return self.without_problem(reason),
        };
        match attempt.solve(&Bounds::of_iterations(by_cells.iterations())) {
            Ok(()) => Decision::Path,
            Err(reason @ NoPath::Unreachable { .. }) => {
                let Some((barrier, checker)) = attempt.barrier() else { return Decision::Undecided(reason) };
                let scene = checker.scene();
                let names = barrier.cells.iter().filter_map(|cell| scene.obstacle_name(cell.blocking.obstacle));
                Decision::Blocked(names.filter_map(|name| blocker(&self.world, name)).collect())
            }
            Err(NoPath::JoinedByCells { .. }) => self.drive(),
            Err(reason) => Decision::Undecided(reason),
        }
    }

    /// Whether a car finds a path where nothing is proven to be in its way.
    fn drive(&self) -> Decision {
        let driver = PlannerName::default_for(&self.robot);
        let attempt = self.attempt(driver, Seed(0));
        match attempt.and_then(|mut attempt| attempt.solve(&Bounds::of_iterations(driver.iterations()))) {
            Ok(()) => Decision::Path,
            Err(reason) => Decision::Undecided(reason),
        }
    }

    /// What stands where an end is to be is in the way of every path.
    fn without_problem(&self, reason: NoPath) -> Decision {
        let at_an_end = match &reason {
            NoPath::Problem(ProblemError::Overlap { obstacle, .. } | ProblemError::Clearance { obstacle, .. }) => {
                blocker(&self.world, obstacle)
            }
            _ => None,
        };
        at_an_end.map_or(Decision::Undecided(reason), |blocker| Decision::Blocked(BTreeSet::from([blocker])))
    }
}

/// The thing of this name in a world.
fn blocker(world: &World, name: &str) -> Option<Blocker> {
    let of_door = world.doors.iter().find(|door| door.name == name).map(|_| BlockerKind::Door);
    let of_obstacle = || world.obstacles.iter().find(|obstacle| obstacle.name == name);
    let kind = of_door.or_else(|| {
        let is_wall = of_obstacle()?.kind == ObstacleKind::Wall;
        Some(if is_wall { BlockerKind::Wall } else { BlockerKind::Obstacle })
    })?;
    Some(Blocker { kind, name: name.to_owned() })
}

/// The sets that were tried, and the barriers that were found: every set that helps has a thing of each.
struct Trials<D> {
    decide: D,
    /// The greatest number of sets that are planned without.
    max_sets: usize,
    decided: BTreeMap<BTreeSet<Blocker>, Decision>,
    undecided: Option<NoPath>,
}

/// How many things a set may have, and how many of them may be no doors and how many walls.
#[derive(Clone, Copy)]
struct SetLimits {
    things: usize,
    not_doors: usize,
    walls: usize,
}

impl SetLimits {
    /// From nothing on: few things before many, doors before obstacles, obstacles before walls.
    fn up_to(most: usize) -> impl Iterator<Item = SetLimits> {
        let of = |things: usize| {
            (0..=things).flat_map(move |not_doors| (0..=not_doors).map(move |walls| (not_doors, walls)))
        };
        (0..=most)
            .flat_map(move |things| of(things).map(move |(not_doors, walls)| SetLimits { things, not_doors, walls }))
    }
}

impl<D: FnMut(&BTreeSet<Blocker>) -> Decision> Trials<D> {
    fn new(max_sets: usize, decide: D) -> Self {
        Trials { decide, max_sets, decided: BTreeMap::new(), undecided: None }
    }

    fn least(mut self) -> Result<Removal, NoRemoval> {
        let (blockers, is_least) = match self.first(SetLimits::up_to(MAX_EXACT))? {
            Some(found) => (found, self.undecided.is_none()),
            None => {
                let all = self.all_in_the_way()?;
                (self.minimal(all)?, false)
            }
        };
        let mut doors = None;
        if blockers.iter().any(|blocker| blocker.kind != BlockerKind::Door) {
            let all = SetLimits::up_to(MAX_EXACT);
            doors = match self.first(all.filter(|limits| limits.not_doors == 0)) {
                Ok(doors) => doors.map(|doors| doors.into_iter().collect()),
                // what is found without them stays
                Err(NoRemoval::TooMany(_)) => None,
                Err(reason) => return Err(reason),
            };
        }
        Ok(Removal { blockers: blockers.into_iter().collect(), doors, is_least, tried: self.decided.len() })
    }

    /// The first set that suffices, within limits that come in the order of preference.
    fn first(&mut self, limits: impl Iterator<Item = SetLimits>) -> Result<Option<BTreeSet<Blocker>>, NoRemoval> {
        for limits in limits {
            let found = self.within(&BTreeSet::new(), limits)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// What comes of the problem without these, asked once.
    fn of(&mut self, gone: &BTreeSet<Blocker>) -> Result<Decision, NoRemoval> {
        if let Some(decision) = self.decided.get(gone) {
            return Ok(decision.clone());
        }
        if self.decided.len() == self.max_sets {
            return Err(NoRemoval::TooMany(self.max_sets));
        }
        let decision = (self.decide)(gone);
        if let Decision::Undecided(reason) = &decision {
            if gone.is_empty() {
                return Err(NoRemoval::Undecided(reason.clone()));
            }
            self.undecided.get_or_insert_with(|| reason.clone());
        }
        self.decided.insert(gone.clone(), decision.clone());
        Ok(decision)
    }

    /// A set that suffices, with these and within the limits: whatever it is, it has a thing of a barrier that stands.
    fn within(&mut self, gone: &BTreeSet<Blocker>, limits: SetLimits) -> Result<Option<BTreeSet<Blocker>>, NoRemoval> {
        let barrier = match self.standing(gone) {
            Some(barrier) => barrier,
            None => match self.of(gone)? {
                Decision::Path => return Ok(Some(gone.clone())),
                Decision::Undecided(_) => return Ok(None),
                Decision::Blocked(barrier) if barrier.is_empty() => return Err(NoRemoval::Nothing),
                Decision::Blocked(barrier) => barrier,
            },
        };
        for blocker in barrier {
            let mut more = gone.clone();
            more.insert(blocker);
            let not_doors = more.iter().filter(|blocker| blocker.kind != BlockerKind::Door).count();
            let walls = more.iter().filter(|blocker| blocker.kind == BlockerKind::Wall).count();
            if more.len() <= limits.things && not_doors <= limits.not_doors && walls <= limits.walls {
                let found = self.within(&more, limits)?;
                if found.is_some() {
                    return Ok(found);
                }
            }
        }
        Ok(None)
    }

    /// A barrier that was found and stands without these.
    fn standing(&self, gone: &BTreeSet<Blocker>) -> Option<BTreeSet<Blocker>> {
        let barriers = self.decided.values().filter_map(|decision| match decision {
            Decision::Blocked(barrier) => Some(barrier),
            _ => None,
        });
        barriers.filter(|barrier| barrier.is_disjoint(gone)).min_by_key(|barrier| barrier.len()).cloned()
    }

    /// All of every barrier that is met, until a path appears.
    fn all_in_the_way(&mut self) -> Result<BTreeSet<Blocker>, NoRemoval> {
        let mut gone = BTreeSet::new();
        loop {
            match self.of(&gone)? {
                Decision::Path => return Ok(gone),
                Decision::Undecided(reason) => return Err(NoRemoval::Undecided(reason)),
                Decision::Blocked(barrier) if barrier.is_empty() => return Err(NoRemoval::Nothing),
                Decision::Blocked(barrier) => gone.extend(barrier),
            }
        }
    }

    /// The set less what can stand, walls first.
    fn minimal(&mut self, all: BTreeSet<Blocker>) -> Result<BTreeSet<Blocker>, NoRemoval> {
        let mut kept = all.clone();
        for blocker in all.iter().rev() {
            let mut fewer = kept.clone();
            fewer.remove(blocker);
            if self.of(&fewer)? == Decision::Path {
                kept = fewer;
            }
        }
        Ok(kept)
    }
}

#[cfg(test)]
mod tests;
