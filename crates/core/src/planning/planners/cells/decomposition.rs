//! `CellDecomposition`, a planner that may prove that there is no path.

use crate::collision::{Checker, Problem};
use crate::configuration::{AnyConfiguration, Configuration};
use crate::cspace::{Barrier, CellMap, CellState, Slice};
use crate::planning::{CellSides, NoPath, Planner, Search};
use crate::robots::AnyRobot;

use super::states::CellStates;

/// The level of the finest cells: a 128th of the space's sides.
const FINEST: u32 = 7;

/// The number of cells of a plane that an iteration judges.
const CELLS: u32 = 256;

/// The same in a space of three dimensions, which has many more.
const CELLS_OF_SPACE: u32 = 2048;

/// Approximate cell decomposition (Brooks and Lozano-Perez, 1985): the cells of the configuration space are cut until
/// cells proven free join the start to the goal, or cells proven blocked part them.
///
/// The first gives a path through the middles of cells, the second a proof: [`NoPath::Unreachable`], whose
/// [`Barrier`] anybody can check. It is for spaces of two dimensions, a disc's positions within the scene's bounds and
/// an arm of two links, and of three, an arm of three links and a car. A car drives no straight lines, so that cells
/// never give it a path ([`NoPath::JoinedByCells`]); but what parts any motion of it parts every drive too. Of a car
/// with a trailer the cells are those of the car alone. Where the finest cells decide neither it ends with
/// [`NoPath::Undecided`].
///
/// An iteration judges 256 cells of a plane, and then what they join; in three dimensions 2,048, and what they join
/// each time that all cells of a size are judged.
#[derive(Clone, Debug)]
pub struct CellDecomposition {
    search: Search<AnyRobot>,
    cells: Option<JudgedCells>,
}

/// The cells of the robot's space.
#[derive(Clone, Debug)]
enum JudgedCells {
    Plane(CellMap),
    Space {
        map: CellMap<3>,
        /// The finest level of which is known what its cells join.
        joined: Option<u32>,
    },
}

impl CellDecomposition {
    /// The planner, with nothing known of any cell.
    pub fn new(problem: Problem<AnyRobot>) -> Self {
        let checker = problem.checker();
        // the start is a configuration of the robot, whose plane has nothing held where it is the whole space
        let plane = Slice::through(checker, &problem.start()).ok().filter(|plane| plane.held().is_empty());
        let cells = match (plane, Slice::space(checker)) {
            (Some(plane), _) => Some(JudgedCells::Plane(CellMap::new(plane, FINEST))),
            (None, Some(space)) => Some(JudgedCells::Space { map: CellMap::new(space, FINEST), joined: None }),
            (None, None) => None,
        };
        let mut search = Search::from_start(problem);
        search.end = cells.is_none().then_some(NoPath::Unsuited("cells are for spaces of two and three dimensions"));
        CellDecomposition { search, cells }
    }
}

impl CellDecomposition {
    fn barrier_of<'a, const N: usize>(&self, map: &'a CellMap<N>) -> Option<(Barrier, &'a Checker<AnyRobot>)> {
        let [start, goal] = ends(&self.search, map.slice());
        Some((Barrier::between(map, &start, &goal)?, map.slice().checker()))
    }
}

/// The ends of a problem in the space of a slice: of a car with a trailer those of the car alone.
fn ends<const N: usize>(search: &Search<AnyRobot>, slice: &Slice<N>) -> [AnyConfiguration; 2] {
    [search.problem.start(), search.problem.goal()].map(|q| slice.at(slice.point(&q.in_chart())))
}

/// What the cells of a level join: the path is taken where those that are free join the ends; the reason is why there
/// is none, and `None` where that is not known.
fn outcome<const N: usize>(search: &mut Search<AnyRobot>, map: &CellMap<N>, level: u32) -> Option<NoPath> {
    let raster = CellStates::of(map, level);
    // either end is free, so all cells at whose side it lies are open, and any of them will do
    let [start, goal] = ends(search, map.slice()).map(|q| raster.cell(map.slice().point(&q)));
    if raster.joins(start, goal, |state| state == CellState::Free) {
        let cells = raster.way(start, goal, |state| state == CellState::Free);
        if let AnyRobot::Hitch(_) = search.problem.checker().robot() {
            return Some(NoPath::JoinedByCells { cells: cells.len() });
        }
        // within one cell the straight way is free
        let cells = if cells.len() > 1 { &cells[..] } else { &[] };
        let middles: Vec<AnyConfiguration> = cells.iter().map(|cell| map.slice().at(raster.middle(*cell))).collect();
        let goal = search.problem.goal().in_chart();
        let end = middles.into_iter().chain([goal]).try_fold(0, |node, q| search.reach(node, q));
        let is_solved = end.is_some_and(|end| search.take_branch(end));
        let nodes = search.growth.nodes().len();
        return (!is_solved).then_some(NoPath::NoneInGraph { nodes });
    }
    if !raster.joins(start, goal, |state| state != CellState::Blocked) {
        // both ends lie within the cells, and so does every path between them
        return Some(NoPath::Unreachable { cells: map.progress().judged });
    }
    let sides = || raster.steps.into_iter().enumerate().map(|(i, side)| (side, map.slice().unit(i))).collect();
    map.progress().done.then(|| NoPath::Undecided { sides: CellSides(sides()) })
}

impl Planner<AnyRobot> for CellDecomposition {
    fn name(&self) -> &'static str {
        "cell-decomposition"
    }

    fn search(&self) -> &Search<AnyRobot> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<AnyRobot> {
        &mut self.search
    }

    fn advance(&mut self) {
        let search = &mut self.search;
        search.end = match &mut self.cells {
            None => return,
            Some(JudgedCells::Plane(map)) => {
                map.refine(CELLS);
                outcome(search, map, map.finest())
            }
            Some(JudgedCells::Space { map, joined }) => {
                map.refine(CELLS_OF_SPACE);
                let level = map.judged_level().filter(|level| Some(*level) > *joined);
                *joined = level.or(*joined);
                level.and_then(|level| outcome(search, map, level))
            }
        };
    }

    fn cells(&self) -> Option<&CellMap> {
        match &self.cells {
            Some(JudgedCells::Plane(map)) => Some(map),
            _ => None,
        }
    }

    fn barrier(&self) -> Option<(Barrier, &Checker<AnyRobot>)> {
        // asked before, cells that part nothing would be searched at every iteration
        let is_parted = matches!(self.search.end, Some(NoPath::Unreachable { .. }));
        match self.cells.as_ref().filter(|_| is_parted)? {
            JudgedCells::Plane(map) => self.barrier_of(map),
            JudgedCells::Space { map, .. } => self.barrier_of(map),
        }
    }
}
