//! Separation tests for what moving parts sweep over: they prove most free motions without a distance query.

use smallvec::SmallVec;

use super::place::{At, Ends};
use crate::collision::narrow::convex::edges;
use crate::collision::{Collision, Scene};
use crate::geometry::{Aabb, Placed, Point2, Vector2};
use crate::num::{greater, lesser};
use crate::robots::Motion;

/// A conservative separation test: true only if every part of a motion with these ends keeps more than `margin`
/// metres from everything. `false` is inconclusive. What it proves, one step of the
/// [march](super::conservative_advancement::march) proves too.
pub(crate) fn is_separated<M: Motion>(collision: &dyn Collision, motion: &M, margin: f64, ends: Ends) -> bool {
    let mut parts = ends.start.parts().iter().zip(ends.end.parts()).enumerate();
    parts.all(|(k, (from, to))| collision.clears(from.placed(), to.placed(), margin + motion.sagitta(k, 0.0, 1.0)))
}

/// The parts of a motion in a scene that the separation test does not prove clear of everything.
pub(crate) fn open_parts<M: Motion>(scene: &Scene, motion: &M, ends: Ends) -> Parts {
    let halving = Halving { scene, motion, halvings: 0 };
    let parts = (0..ends.start.parts().len()).collect();
    halving.open(parts, At::new(0.0, ends.start), At::new(1.0, ends.end))
}

/// Whether a motion between two free ends is free, by halving every stretch that the separation test does not prove;
/// all parts but those in `open` are proven clear. Both answers are proven: `Some(false)` means that a contact was
/// found. `None` where `halvings` halvings do not decide.
pub(crate) fn halve<M: Motion>(scene: &Scene, motion: &M, ends: Ends, open: &[usize], halvings: u32) -> Option<bool> {
    let mut halving = Halving { scene, motion, halvings };
    halving.halves(At::new(0.0, ends.start), At::new(1.0, ends.end), open)
}

/// Parts, by their numbers.
pub(crate) type Parts = SmallVec<[usize; 4]>;

/// A motion under repeated halving.
struct Halving<'a, M> {
    scene: &'a Scene,
    motion: &'a M,
    /// The number of halvings left.
    halvings: u32,
}

impl<M: Motion> Halving<'_, M> {
    /// Those of the parts that the separation test does not prove clear of everything between two places.
    fn open(&self, mut parts: Parts, from: At, to: At) -> Parts {
        parts.retain(|k| {
            let [a, b] = [from, to].map(|place| place.footprint.parts()[*k].placed());
            !self.scene.clears(a, b, self.motion.sagitta(*k, from.s, to.s))
        });
        parts
    }

    /// As [`halve`], between two free places, where all parts but those in `open` are proven clear of everything.
    fn halves(&mut self, from: At, to: At, open: &[usize]) -> Option<bool> {
        self.halvings = self.halvings.checked_sub(1)?;
        let middle = 0.5 * (from.s + to.s);
        let footprint = self.motion.footprint_at(middle);
        if self.scene.intersects(&footprint) {
            return Some(false);
        }
        let at = At::new(middle, &footprint);
        for (from, to) in [(from, at), (at, to)] {
            let open = self.open(open.into(), from, to);
            if !open.is_empty() && !self.halves(from, to, &open)? {
                return Some(false);
            }
        }
        Some(true)
    }
}

/// The swept hull of a part whose vertices move in straight lines from one placed shape to another. The hull is never
/// computed.
pub(crate) struct SweptHull<'a> {
    from: &'a Placed,
    to: &'a Placed,
    radius: f64,
    /// An upper bound on the size of the coordinates, metres.
    size: f64,
    bounds: Aabb,
}

impl<'a> SweptHull<'a> {
    /// The swept hull between two placed shapes of a part; `None` where one of them is not valid.
    pub(crate) fn new(from: &'a Placed, to: &'a Placed) -> Option<Self> {
        if !(from.is_valid() && to.is_valid()) {
            return None;
        }
        let radius = greater(from.radius(), to.radius());
        let infinity = Point2::new(f64::INFINITY, f64::INFINITY);
        let mut bounds = Aabb { min: infinity, max: -infinity };
        for p in from.core().iter().chain(to.core()) {
            bounds.min = Point2::new(lesser(bounds.min.x, p.x), lesser(bounds.min.y, p.y));
            bounds.max = Point2::new(greater(bounds.max.x, p.x), greater(bounds.max.y, p.y));
        }
        Some(SweptHull { from, to, radius, size: bounds.size() + radius, bounds })
    }

    /// A conservative separation test: true only if all pieces of the scene are valid and farther off than `reach`
    /// metres. `false` is inconclusive.
    pub(crate) fn clears(&self, scene: &Scene, reach: f64) -> bool {
        let Some(range) = self.range(reach, scene.size) else { return false };
        let mut near = false;
        scene.index.each_near(&self.bounds, range, |piece| {
            near = !self.passes(&scene.pieces[piece], reach, scene.size);
            near
        });
        !near
    }

    /// As [`clears`](Self::clears), of these pieces alone, given with the boxes around them.
    pub(crate) fn clears_of<'b>(
        &self,
        pieces: impl IntoIterator<Item = (&'b Aabb, &'b Placed)>,
        reach: f64,
        size: f64,
    ) -> bool {
        let Some(range) = self.range(reach, size) else { return false };
        let is_far = |(extent, piece): (&Aabb, &Placed)| {
            self.bounds.squared_distance(extent) > range * range || self.passes(piece, reach, size)
        };
        pieces.into_iter().all(is_far)
    }

    /// What is farther than this from the box around the two cores is farther than `reach` from the hull, metres.
    /// `None` where `reach` is NaN, or a piece is not valid and counts as contact everywhere.
    fn range(&self, reach: f64, size: f64) -> Option<f64> {
        let range = self.radius + reach + self.rounding_bound(size);
        range.is_finite().then_some(range)
    }

    /// A conservative separation test for one valid piece whose coordinates are at most `size`: true only if some line
    /// separates the two by more than `reach` metres. `false` is inconclusive.
    pub(crate) fn passes(&self, piece: &Placed, reach: f64, size: f64) -> bool {
        let reach = reach + self.radius + piece.radius() + self.rounding_bound(size);
        let parts = |ahead: Vector2| {
            let along = |points: &[Point2]| {
                let heights = points.iter().map(|p| p.coords.dot(&ahead));
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), h| (lesser(h, lo), greater(h, hi)))
            };
            let ((a, b), (c, d), (e, f)) = (along(self.from.core()), along(self.to.core()), along(piece.core()));
            let gap = greater(e - greater(b, d), lesser(a, c) - f);
            gap > 0.0 && gap * gap > reach * reach * ahead.norm_squared()
        };
        // normals to try: from one middle to the other, then across the sides that either has and across the vertices'
        // chords
        let middle = |core: &[Point2]| core[0] + (core[core.len() / 2] - core[0]) * 0.5;
        let sides = |core: &[Point2]| match core {
            [_] => false,
            // beside a segment, or beyond an end
            [p, q] => parts(across(*p, *q)) || parts(q - p),
            _ => edges(core).any(|edge| parts(across(edge.a, edge.b))),
        };
        parts(middle(piece.core()) - middle(self.from.core()))
            || sides(piece.core())
            || sides(self.from.core())
            || sides(self.to.core())
            || self.from.core().iter().zip(self.to.core()).any(|(p, q)| parts(across(*p, *q)))
    }

    /// An upper bound on the rounding of all distances here, and on what a step of the march subtracts for rounding,
    /// metres.
    fn rounding_bound(&self, size: f64) -> f64 {
        1e-12 * (self.size + size)
    }
}

/// A normal of the line through two points, as long as they are apart.
fn across(p: Point2, q: Point2) -> Vector2 {
    let u = q - p;
    Vector2::new(u.y, -u.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::motion::conservative_advancement::march;
    use crate::collision::{Checker, MarchOptions};
    use crate::configuration::{HitchCfg, R2, T2, Tn};
    use crate::geometry::{Pose2, Shape, Vertices, convex_hull};
    use crate::random::{Seed, Stream};
    use crate::robots::{HITCH, Reach, Robot, RustyDisc};

    /// A point, a segment or a polygon, every other one with corners on a lattice.
    fn shape(draws: &mut Stream, at: f64) -> Placed {
        let (count, lattice) = ([1, 2, 4, 5][draws.below(4) as usize], draws.below(2) == 0);
        let mut x = || if lattice { draws.below(5) as f64 } else { draws.uniform(0.0, 4.0) };
        let points: Vec<Point2> = (0..count).map(|_| Point2::new(at + x(), x())).collect();
        Placed::new(convex_hull(&points), [0.0, 0.5][draws.below(2) as usize])
    }

    #[test]
    fn what_is_plain_is_so_and_most_that_is_so_is_plain() {
        let mut draws = Stream::new(Seed(8), "ways");
        let bounds = Aabb { min: Point2::origin(), max: Point2::new(9.0, 4.0) };
        let (mut apart, mut plain) = (0, 0);
        for i in 0..4000 {
            let (from, piece) = (shape(&mut draws, 0.0), shape(&mut draws, [2.0, 4.0, 5.0][i % 3]));
            let by = Vector2::new(draws.below(3) as f64 - 1.0, draws.uniform(-1.0, 1.0));
            let turned = |p: &Point2| if i % 2 == 0 { p + by } else { Point2::new(-p.y, p.x) + by };
            let to = Placed::new(from.core().iter().map(turned).collect::<Vertices>(), from.radius());
            let hull = Shape::Hull { vertices: piece.core().into(), radius: piece.radius() };
            let scene = Scene::empty(bounds).with_obstacle("piece", hull);
            let exact = scene.distance_of_hull(from.hull_with(&to));
            for reach in [exact, 1.1 * exact, exact + 1e-9, 0.0] {
                assert!(
                    !scene.clears(&from, &to, reach) || reach < exact,
                    "{from:?} {to:?} {piece:?} {reach} of {exact}"
                );
            }
            if exact > 0.0 {
                apart += 1;
                plain += usize::from(scene.clears(&from, &to, 0.95 * exact));
            }
        }
        assert!(apart > 1000 && 100 * plain > 95 * apart, "{plain} of {apart}");
    }

    #[test]
    fn what_is_no_valid_shape_is_never_plain() {
        let bounds = Aabb { min: Point2::origin(), max: Point2::new(9.0, 4.0) };
        let disc = |x: f64, radius: f64| Placed::new([Point2::new(x, 0.0)], radius);
        let scene = Scene::empty(bounds);
        assert!(scene.clears(&disc(0.0, 0.1), &disc(1.0, 0.1), 1.0), "there is nothing");
        assert!(!scene.clears(&disc(0.0, 0.1), &disc(f64::NAN, 0.1), 1.0));
        assert!(!scene.clears(&disc(0.0, f64::NAN), &disc(1.0, 0.1), 1.0));
        let post = scene.clone().with_obstacle("post", Shape::Disc { radius: 0.1 });
        assert!(!post.clears(&disc(5.0, 0.1), &disc(6.0, 0.1), f64::NAN), "a bound that is no number");
        let scene = scene.with_obstacle("nothing that is", Shape::Disc { radius: f64::NAN });
        assert!(!scene.clears(&disc(50.0, 0.1), &disc(60.0, 0.1), 1.0));
    }

    /// Whether an edge is free, by four ways that must agree: `edge_free`, the verdict, the march, and contact at many
    /// places.
    fn agree<R: Robot>(checker: &Checker<R>, a: &R::Configuration, b: &R::Configuration) -> bool {
        let (free, edge) = (checker.edge_free(a, b), checker.robot().edge(a, b).unwrap());
        assert_eq!(free, checker.edge(a, b).unwrap().is_free(), "{a} to {b}");
        assert_eq!(free, march(checker.scene(), &edge, MarchOptions::default(), None).is_free(), "{a} to {b}");
        let touches = |i: u32| checker.scene().intersects(&edge.footprint_at(f64::from(i) / 200.0));
        assert!(!free || !(0..=200).any(touches), "{a} to {b}");
        free
    }

    #[test]
    fn an_edge_is_free_exactly_where_its_verdict_says_so() {
        let mut draws = Stream::new(Seed(9), "edges");
        let (arm, arm3) = (
            Checker::new(Scene::workbench(), Reach::<2>::workbench()),
            Checker::new(Scene::workbench(), Reach::<3>::redundant()),
        );
        let (car, towing) = (Checker::new(Scene::lot(), HITCH), Checker::new(Scene::lot(), HITCH.with_trailer()));
        let disc = Checker::new(Scene::apartment(), RustyDisc::default());
        let (mut free, mut hit) = ([0; 5], [0; 5]);
        let mut count = |robot: usize, is: bool| if is { free[robot] += 1 } else { hit[robot] += 1 };
        for _ in 0..400 {
            let mut u = |size: f64| draws.uniform(-size, size);
            let (a, b) = ([u(3.0), u(3.0), u(3.0)], [u(1.0), u(1.0), u(1.0)]);
            count(0, agree(&arm, &T2::new(a[0], a[1]), &T2::new(a[0] + b[0], a[1] + b[1])));
            count(1, agree(&arm3, &Tn(a), &Tn([a[0] + b[0], a[1] + b[1], a[2] + b[2]])));
            let pose = Pose2::new(7.0 + 2.0 * a[0], 5.0 + a[1], a[2]);
            let then = Pose2::new(pose.x + b[0], pose.y + b[1], pose.theta + b[2]);
            let at = |body: Pose2, trailer| HitchCfg { body, trailer };
            count(2, agree(&car, &at(pose, None), &at(then, None)));
            let from = R2::new(6.0 + 2.0 * a[0], 4.0 + a[1]);
            count(4, agree(&disc, &from, &R2::new(from.0.x + b[0], from.0.y + b[1])));
            count(3, agree(&towing, &at(pose, Some(a[2])), &at(then, Some(a[2] + b[0]))));
        }
        assert!(free.iter().chain(&hit).all(|n| *n > 40), "{free:?} free, {hit:?} not");
    }
}
