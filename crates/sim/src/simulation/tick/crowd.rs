//! `Crowd`, the robots of one world in a tick, and who may touch or see whom.

use smallvec::SmallVec;

use motion_lab_core::collision::{Index, distance};
use motion_lab_core::geometry::{Aabb, Footprint, Placed, Point2};
use motion_lab_core::num::lesser;

/// How far beyond a robot's reach in a tick its neighbours are still considered, metres. It is far above the clearances
/// at which motions are held, and above all rounding.
const APRON: f64 = 1e-3;

/// The robots of a world with more than one, by ascending id.
///
/// In a tick a robot considers only neighbours that it can reach. Any other is farther away, at every place of the
/// motion, than the rest of the motion is long. So no step of a proof fails because of it, and near a contact it is
/// never the nearest. Leaving it out changes no bit of a tick, as `tick/tests.rs` checks.
#[derive(Default)]
pub struct Crowd {
    /// The id of the first robot.
    first: u32,
    bodies: Vec<Option<CrowdBody>>,
    /// The boxes of all that the robots with a body may touch in the tick.
    reaches: Vec<Aabb>,
    /// The places in `bodies` of those robots.
    members: Vec<u32>,
    /// The places in `bodies` of the robots that count as in contact with everything: their numbers are not finite.
    everywhere: Vec<u32>,
    index: Option<Index>,
}

/// A robot in a tick.
struct CrowdBody {
    /// Its parts at the start of the tick; once it is settled, at the end.
    parts: SmallVec<[Placed; 3]>,
    /// The box around the parts at the start.
    start: Aabb,
    /// The box around all that it may touch in the tick, and an apron.
    reach: Aabb,
}

impl Crowd {
    /// The crowd of the robots with these ids, none of which has a body yet.
    pub fn new(ids: std::ops::Range<u32>) -> Self {
        Crowd { first: ids.start, bodies: ids.map(|_| None).collect(), ..Crowd::default() }
    }

    /// Begins a tick: no robot has a body.
    pub fn begin(&mut self) {
        self.reaches.clear();
        self.members.clear();
        self.everywhere.clear();
        self.index = None;
    }

    /// Gives a robot its body at the start of the tick, in which no point of it moves more than `bound` metres.
    pub fn put(&mut self, id: u32, footprint: &Footprint, bound: f64) {
        let place = id - self.first;
        let Some(body) = self.bodies.get_mut(place as usize) else { return };
        let body = body.get_or_insert_with(CrowdBody::nowhere);
        body.take(footprint);
        (body.start, body.reach) = (EVERYWHERE, EVERYWHERE);
        if !(bound.is_finite() && body.parts.iter().all(Placed::is_valid)) {
            self.everywhere.push(place);
        } else if let Some(start) = body.parts.iter().map(Placed::padded_bounds_of_valid).reduce(|a, b| a.merged(&b)) {
            (body.start, body.reach) = (start, start.grown(bound + APRON));
            self.reaches.push(body.reach);
            self.members.push(place);
        }
    }

    /// Makes the index of all bodies. Without it nobody is near anybody.
    pub fn index(&mut self) {
        self.index = Some(Index::new(&self.reaches));
    }

    /// Moves a robot's parts to where they are at the end of the tick.
    pub fn settle(&mut self, id: u32, footprint: &Footprint) {
        if let Some(Some(body)) = self.bodies.get_mut((id - self.first) as usize) {
            body.take(footprint);
        }
    }

    /// Calls `visit` with the place of every robot but this whose reach comes within `range` metres of a box.
    fn each_near(&self, id: u32, of: &Aabb, range: f64, mut visit: impl FnMut(u32, &CrowdBody)) {
        let own = id - self.first;
        let mut call = |place: u32| {
            if let Some(Some(body)) = self.bodies.get(place as usize).filter(|_| place != own) {
                visit(place, body);
            }
        };
        if *of == EVERYWHERE {
            self.members.iter().for_each(|&place| call(place));
        } else if let Some(index) = &self.index {
            index.each_near(of, range, |k| {
                self.members.get(k).into_iter().for_each(|&place| call(place));
                false
            });
        }
        self.everywhere.iter().for_each(|&place| call(place));
    }

    /// The reach of a robot with a body.
    fn reach(&self, id: u32) -> Option<&Aabb> {
        Some(&self.bodies.get((id - self.first) as usize)?.as_ref()?.reach)
    }

    /// Writes the parts of the other robots that this one may touch in the tick where they stood at its start.
    pub fn others(&self, id: u32, room: &mut NeighbourMemory) {
        room.clear();
        let Some(reach) = self.reach(id) else { return };
        self.each_near(id, reach, 0.0, |place, body| {
            if !body.start.is_apart(reach) {
                room.places.push(place);
            }
        });
        self.take_parts(room);
    }

    /// The parts, as they are now, of all other robots that come within `range` metres of a point, and perhaps of some
    /// that do not. `room` holds their places.
    pub fn seen<'a>(
        &'a self,
        id: u32,
        from: Point2,
        range: f64,
        room: &'a mut NeighbourMemory,
    ) -> impl Iterator<Item = &'a Placed> + Clone {
        room.places.clear();
        let point = Aabb { min: from, max: from };
        self.each_near(id, &point, range * (1.0 + 1e-5) + APRON, |place, _| room.places.push(place));
        let bodies = room.places.iter().filter_map(|&place| self.bodies.get(place as usize)?.as_ref());
        bodies.flat_map(|body| &body.parts)
    }

    /// Copies the parts of the robots at the places, by ascending id.
    fn take_parts(&self, room: &mut NeighbourMemory) {
        room.places.sort_unstable();
        for &place in &room.places {
            let body = self.bodies.get(place as usize).into_iter().flatten();
            room.parts.extend(body.flat_map(|body| body.parts.iter().cloned()));
        }
    }

    /// Writes the ids of the robots with a lower one that this robot may meet in the tick.
    pub fn lower(&self, id: u32, room: &mut NeighbourMemory) {
        room.places.clear();
        let Some(reach) = self.reach(id) else { return };
        self.each_near(id, reach, 0.0, |place, _| {
            if place + self.first < id {
                room.places.push(place + self.first);
            }
        });
        room.places.sort_unstable();
    }

    /// The distance between two robots before either is settled, metres; 0 when one has no body.
    pub fn distance(&self, a: u32, b: u32) -> f64 {
        let parts = |id: u32| Some(&self.bodies.get((id - self.first) as usize)?.as_ref()?.parts);
        let (Some(a), Some(b)) = (parts(a), parts(b)) else { return 0.0 };
        let pairs = a.iter().flat_map(|a| b.iter().map(move |b| distance(a, b)));
        pairs.fold(f64::INFINITY, |least, d| lesser(d, least))
    }

    /// The ids of the robots.
    pub fn ids(&self) -> std::ops::Range<u32> {
        self.first..self.first + self.bodies.len() as u32
    }
}

/// The box of what is in contact with everything.
const EVERYWHERE: Aabb =
    Aabb { min: Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY), max: Point2::new(f64::INFINITY, f64::INFINITY) };

impl CrowdBody {
    fn nowhere() -> Self {
        CrowdBody { parts: SmallVec::new(), start: EVERYWHERE, reach: EVERYWHERE }
    }

    fn take(&mut self, footprint: &Footprint) {
        self.parts.clear();
        self.parts.extend(footprint.parts().iter().map(|part| part.placed().clone()));
    }
}

/// Working memory for one robot's neighbours.
#[derive(Debug, Default)]
pub struct NeighbourMemory {
    /// The neighbours' parts, by ascending id.
    pub parts: Vec<Placed>,
    /// The neighbours.
    pub places: Vec<u32>,
}

impl NeighbourMemory {
    /// Forgets the neighbours.
    pub fn clear(&mut self) {
        self.parts.clear();
        self.places.clear();
    }
}
