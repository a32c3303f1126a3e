//! `Checker`, a robot in a scene: queries about configurations, edges and motions.

use std::sync::Arc;

use super::motion::decide::{is_free, is_free_by_ladder, is_line_free, verdict};
use super::motion::lanes::rung::decide;
use super::{Certificate, Collision, EdgeVerdict, MarchOptions, Scene, Witness};
use crate::configuration::{Configuration, Coordinates};
use crate::geometry::{Footprint, Shape, Vector2};
use crate::robots::{ConfigurationError, Hitch, Motion, Reach, Robot, RustyDisc};

/// A robot in a scene. Cheap to clone: the scene is shared.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::collision::{ChainChecker, Scene};
/// let c = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
/// let (a, b) = (T2::new(2.0, 0.0), T2::new(3.1, 0.0));
/// assert!(c.is_free(&a) && c.is_free(&b));
/// assert!(!c.edge_free(&a, &b)); // the post stands between two free configurations
/// ```
///
/// A checker may hand its questions to a [black box](Self::with_black_box). Its proofs, the verdicts and certificates,
/// stay those of the exact scene.
#[derive(Clone)]
pub struct Checker<R> {
    scene: Arc<Scene>,
    robot: R,
    /// Who answers instead of the scene.
    black_box: Option<Arc<dyn Collision>>,
}

impl<R: std::fmt::Debug> std::fmt::Debug for Checker<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Checker")
            .field("scene", &self.scene)
            .field("robot", &self.robot)
            .field("black_box", &self.black_box.is_some())
            .finish()
    }
}

/// The checker of an arm with N links.
pub type ChainChecker<const N: usize> = Checker<Reach<N>>;

/// The checker of a disc. For a disc, collision is a point query: it is free exactly when the distance D of its centre
/// to the obstacles exceeds its radius r, its distance is D - r (0 when not free), and its witness is the centre moved
/// by r toward the nearest obstacle point. It also answers the four questions itself, for footprints made of discs; any
/// other footprint counts as contact.
pub type DiscChecker = Checker<RustyDisc>;

/// The checker of the car.
pub type CarChecker = Checker<Hitch>;

impl<R: Robot> Checker<R> {
    /// The robot in the scene.
    pub fn new(scene: impl Into<Arc<Scene>>, robot: R) -> Self {
        Checker { scene: scene.into(), robot, black_box: None }
    }

    /// The same robot in the same scene, whose questions a black box answers: [`is_free`](Self::is_free),
    /// [`distance`](Self::distance), [`witness`](Self::witness) and the gradients by the question of the same name,
    /// [`edge_free`](Self::edge_free) and [`motion_free`](Self::motion_free) by [`swept`](Collision::swept) from the
    /// motion's first footprint to its last. The black box must number its obstacles as the scene does.
    ///
    /// Nothing of that is proven. Verdicts, [`last_free`](Self::last_free) and certificates are proofs and stay those
    /// of the scene, whatever the black box says. What a planner finds by it is an
    /// [`UnprovenPath`](crate::planning::UnprovenPath).
    ///
    /// ```
    /// use motion_lab_core::collision::ParryScene;
    /// use motion_lab_core::prelude::*;
    /// let exact = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    /// let chapter = exact.clone().with_black_box(ParryScene::of_scene(exact.scene()));
    /// let (a, b) = (T2::new(2.2, 0.5), T2::new(2.9, 0.5));
    /// assert!(!exact.edge_free(&a, &b)); // the post stands between
    /// assert!(chapter.edge_free(&a, &b)); // a cast that does not turn goes past it
    /// ```
    #[must_use]
    pub fn with_black_box(self, black_box: impl Collision + 'static) -> Self {
        Checker { black_box: Some(Arc::new(black_box)), ..self }
    }

    /// The black box that answers instead of the scene, if there is one.
    pub fn black_box(&self) -> Option<&dyn Collision> {
        self.black_box.as_deref()
    }

    /// Who answers the questions about a configuration.
    pub(super) fn asked(&self) -> &dyn Collision {
        self.black_box.as_deref().unwrap_or(&*self.scene)
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene, to be shared with another checker.
    pub fn shared_scene(&self) -> Arc<Scene> {
        Arc::clone(&self.scene)
    }

    /// The robot.
    pub fn robot(&self) -> &R {
        &self.robot
    }

    /// Whether the robot touches nothing at `q`, which lies within the robot's own limits. False for a configuration
    /// that is not this robot's.
    pub fn is_free(&self, q: &R::Configuration) -> bool {
        self.robot.check(q).is_ok()
            && self.robot.is_within_limits(q)
            && !self.asked().intersects(&self.robot.footprint(q))
    }

    /// The clearance at `q`, metres: 0 in contact, and for a configuration that is not this robot's. The robot's own
    /// limits don't matter here.
    pub fn distance(&self, q: &R::Configuration) -> f64 {
        if self.robot.check(q).is_err() { 0.0 } else { self.asked().distance(&self.robot.footprint(q)) }
    }

    /// The nearest points at `q`; `None` in an empty scene.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this robot.
    pub fn witness(&self, q: &R::Configuration) -> Result<Option<Witness>, ConfigurationError> {
        self.robot.check(q)?;
        Ok(self.asked().witness(&self.robot.footprint(q)))
    }

    /// The verdict on the straight line of the configuration chart from `a` to `b`, angles the short way round.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of this robot.
    pub fn edge(&self, a: &R::Configuration, b: &R::Configuration) -> Result<EdgeVerdict, ConfigurationError> {
        Ok(self.motion_verdict(&self.robot.edge(a, b)?))
    }

    /// The last configuration along the edge up to which the edge is proven free. This is `b`, its angles in
    /// `(-pi, pi]`, when the whole edge is free; `None` when `a` is in contact.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of this robot.
    pub fn last_free(
        &self,
        a: &R::Configuration,
        b: &R::Configuration,
    ) -> Result<Option<R::Configuration>, ConfigurationError> {
        let edge = self.robot.edge(a, b)?;
        Ok(match self.motion_verdict(&edge) {
            EdgeVerdict::Free { .. } => Some(edge.at(1.0)),
            EdgeVerdict::Hit { free_until, contact_at, .. } if free_until < contact_at => Some(edge.at(free_until)),
            EdgeVerdict::Hit { .. } => None,
            EdgeVerdict::Unresolved { free_until, .. } => Some(edge.at(free_until)),
        })
    }

    /// The clearance at `q`, metres, and the gradient of the distance: the unit vector in the workspace from the
    /// witness point b* on the obstacle to the point a* on the robot. Moving the nearest part in this direction
    /// increases the clearance. No direction in contact or in an empty scene.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this robot.
    pub fn clearance_gradient(&self, q: &R::Configuration) -> Result<(f64, Option<Vector2>), ConfigurationError> {
        Ok(match self.witness(q)? {
            None => (self.distance(q), None),
            Some(w) if w.dist == 0.0 => (0.0, None),
            Some(w) => {
                let away = w.on_robot - w.on_obstacle;
                let length = crate::num::hypot(away.x, away.y);
                (w.dist, (length > 0.0).then(|| away / length))
            }
        })
    }

    /// The clearance at `q`, metres, and its gradient in the chart: by how much it grows per unit of each coordinate,
    /// metres per metre and per radian. It is the transposed Jacobian of the nearest point times
    /// [`clearance_gradient`](Self::clearance_gradient). No gradient in contact, in an empty scene, or for a robot
    /// without [`Robot::jacobian`]. Where several points are nearest, it is that of one of them.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this robot.
    pub fn chart_gradient(&self, q: &R::Configuration) -> Result<(f64, Option<Coordinates>), ConfigurationError> {
        let (clearance, away) = self.clearance_gradient(q)?;
        let nearest = if away.is_some() { self.witness(q)? } else { None };
        let columns = nearest.and_then(|w| self.robot.jacobian(q, w.part, w.on_robot));
        let gradient =
            away.zip(columns).map(|(away, columns)| columns.iter().map(|column| column.dot(&away)).collect());
        Ok((clearance, gradient))
    }

    /// Whether the edge is proven free: true wherever [`edge`](Self::edge) says `Free`, false wherever it says `Hit`.
    /// Several times as fast, because it computes neither the clearance along the edge nor the first contact. With a
    /// black box, whether that calls it free.
    pub fn edge_free(&self, a: &R::Configuration, b: &R::Configuration) -> bool {
        if self.black_box.is_some() {
            return self.robot.edge(a, b).is_ok_and(|edge| self.motion_free(&edge));
        }
        self.sure_edge_free(a, b)
            .unwrap_or_else(|| self.robot.edge(a, b).is_ok_and(|edge| is_free_by_ladder(&self.scene, &edge)))
    }

    /// As [`edge_free`](Self::edge_free), where it is sure without what an edge holds besides its ends.
    #[inline]
    fn sure_edge_free(&self, a: &R::Configuration, b: &R::Configuration) -> Option<bool> {
        let is_own = |q| self.robot.check(q).is_ok();
        let (from, to) = (is_own(a) && is_own(b)).then(|| (a.in_chart(), b.in_chart()))?;
        if self.robot.edge_leaves(&from, &to).is_some() {
            return None;
        }
        match self.robot.disc_line(&from, &to) {
            Some((way, radius)) => is_line_free(&self.scene, way, radius),
            None => decide(&self.scene, &self.robot.edge_linkage(&from, &to)?),
        }
    }

    /// As [`edge`](Self::edge), and fills `certificate` with the steps that prove it as far as it is free.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either end is not a configuration of this robot.
    pub fn edge_certified(
        &self,
        a: &R::Configuration,
        b: &R::Configuration,
        certificate: &mut Certificate,
    ) -> Result<EdgeVerdict, ConfigurationError> {
        Ok(self.motion_certified(&self.robot.edge(a, b)?, certificate))
    }

    /// Whether any motion of this robot is proven free, an edge or the arc of a drive: true wherever
    /// [`motion_verdict`](Self::motion_verdict) says `Free`, false wherever it says `Hit`. Faster than the verdict,
    /// because it computes neither the clearance nor the first contact. With a black box, whether that calls the motion
    /// free.
    pub fn motion_free(&self, motion: &impl Motion<Configuration = R::Configuration>) -> bool {
        if let Some(black_box) = self.black_box() {
            let hits = || black_box.swept(&motion.footprint_at(0.0), &motion.footprint_at(1.0));
            return motion.leaves_limits().is_none() && !hits();
        }
        is_free(&self.scene, motion)
    }

    /// As [`motion_verdict`](Self::motion_verdict), and fills `certificate` with the steps that prove the motion as far
    /// as it is free.
    pub fn motion_certified(
        &self,
        motion: &impl Motion<Configuration = R::Configuration>,
        certificate: &mut Certificate,
    ) -> EdgeVerdict {
        verdict(&self.scene, motion, MarchOptions::default().budget, Some(certificate))
    }

    /// The verdict on any motion of this robot: an edge, or the arc of a drive.
    pub fn motion_verdict(&self, motion: &impl Motion<Configuration = R::Configuration>) -> EdgeVerdict {
        verdict(&self.scene, motion, MarchOptions::default().budget, None)
    }
}

impl DiscChecker {
    fn all_discs(footprint: &Footprint) -> bool {
        footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }))
    }
}

impl Collision for DiscChecker {
    fn intersects(&self, footprint: &Footprint) -> bool {
        !Self::all_discs(footprint) || self.scene.intersects(footprint)
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        if Self::all_discs(footprint) { self.scene.distance(footprint) } else { 0.0 }
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        if Self::all_discs(footprint) { self.scene.witness(footprint) } else { None }
    }

    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        !Self::all_discs(a) || self.scene.swept(a, b)
    }
}
