//! `Footprint`, the set of workspace points a robot occupies at a configuration, R(q).

use super::parts::{Part, PartList};
use super::{Aabb, Placed, Point2, Pose2, Segment, Shape, ShapeError};
use crate::num;

/// A footprint R(q): a list of rigid parts. Up to three parts are stored without a heap allocation, which covers the
/// lab's three robots.
///
/// A footprint with a number that is not finite is allowed and fails safe in every query: it is in contact.
///
/// ```
/// use motion_lab_core::geometry::{Footprint, Point2};
/// let rusty = Footprint::disc(Point2::new(2.0, 1.0), 0.11);
/// assert_eq!(rusty.parts().len(), 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Footprint {
    parts: PartList,
}

impl Footprint {
    /// The footprint made of these parts, numbered from 0 in this order.
    #[inline]
    pub fn new(parts: impl IntoIterator<Item = Part>) -> Self {
        Footprint { parts: parts.into_iter().collect() }
    }

    /// The footprint of this many parts, made in place from their numbers.
    #[inline]
    pub(crate) fn by_number(count: usize, part: impl Fn(usize) -> Part) -> Self {
        Footprint { parts: PartList::by_number(count, part) }
    }

    /// The footprint of one part: this hull, which is in world coordinates.
    pub(crate) fn of_hull(hull: Placed) -> Self {
        let shape = Shape::Hull { vertices: hull.core().into(), radius: hull.radius() };
        Footprint { parts: PartList::One([Part::of_placed(shape, hull)]) }
    }

    /// One disc, such as Rusty.
    #[inline]
    pub fn disc(centre: Point2, radius: f64) -> Self {
        Footprint { parts: PartList::One([Part::disc(centre, radius)]) }
    }

    /// One capsule per segment, each with its frame at the segment's first end and its x axis along the segment. The
    /// far end is placed by the frame's angle and the length, so it may differ from `b` in the last bits; robots that
    /// know their angles build their parts from them.
    pub fn capsules(segments: impl IntoIterator<Item = Segment>, radius: f64) -> Self {
        Self::new(segments.into_iter().map(|s| {
            let d = s.direction();
            let pose = Pose2 { x: s.a.x, y: s.a.y, theta: num::atan2(d.y, d.x) };
            Part::new(pose, Shape::Capsule { a: Point2::origin(), b: Point2::new(s.length(), 0.0), radius })
        }))
    }

    /// One rectangle per item, given by its frame and its corners (least, greatest) in that frame.
    pub fn rects(rects: impl IntoIterator<Item = (Pose2, Point2, Point2)>) -> Self {
        Self::new(rects.into_iter().map(|(pose, min, max)| Part::new(pose, Shape::Rectangle { min, max })))
    }

    /// The smallest box around all parts, metres; `None` without parts.
    pub fn bounds(&self) -> Option<Aabb> {
        self.parts().iter().map(|part| part.placed().bounds()).reduce(|a, b| a.merged(&b))
    }

    /// As [`disc`](Self::disc), checked.
    ///
    /// # Errors
    /// [`ShapeError`] when the centre is not finite or too far out, or the radius out of range.
    pub fn try_disc(centre: Point2, radius: f64) -> Result<Self, ShapeError> {
        Shape::try_disc(radius)?;
        Shape::check_point(centre)?;
        Ok(Self::disc(centre, radius))
    }

    /// As [`capsules`](Self::capsules), checked.
    ///
    /// # Errors
    /// [`ShapeError`] for the first segment that is too short, not finite or too far out, or for the radius.
    pub fn try_capsules(segments: &[Segment], radius: f64) -> Result<Self, ShapeError> {
        for s in segments {
            Shape::try_capsule(s.a, s.b, radius)?;
        }
        Ok(Self::capsules(segments.iter().copied(), radius))
    }

    /// As [`rects`](Self::rects), checked.
    ///
    /// # Errors
    /// [`ShapeError`] for the first rectangle that is too small, or a frame or corner that is not finite or too far
    /// out.
    pub fn try_rects(rects: &[(Pose2, Point2, Point2)]) -> Result<Self, ShapeError> {
        for (pose, min, max) in rects {
            Shape::check_point(pose.position())?;
            Shape::check_point(Point2::new(pose.theta, 0.0))?;
            Shape::try_rectangle(*min, *max)?;
        }
        Ok(Self::rects(rects.iter().copied()))
    }

    /// The parts, lowest number first.
    #[inline]
    pub fn parts(&self) -> &[Part] {
        self.parts.as_slice()
    }

    /// Whether every part is finite and well formed; only then do the queries use its geometry.
    pub fn is_valid(&self) -> bool {
        self.parts().iter().all(|p| p.pose().is_finite() && p.placed().is_valid())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn footprints_of_any_number_of_parts_have_them_all_in_their_order() {
        let part = |k: usize| Part::new(Pose2::new(k as f64, 1.0, 0.5), Shape::Disc { radius: 0.1 });
        for count in 0..7 {
            let (listed, numbered) = (Footprint::new((0..count).map(part)), Footprint::by_number(count, part));
            assert!(listed == numbered && listed.clone() == listed && listed.parts().len() == count);
            assert!(listed.parts().iter().enumerate().all(|(k, there)| *there == part(k)), "{count}");
            assert_ne!(listed, Footprint::new((0..=count).map(part)));
        }
        assert_ne!(Footprint::new([part(0), part(1)]), Footprint::new([part(1), part(0)]));
    }

    #[test]
    fn a_disc_is_the_part_that_its_frame_and_its_shape_make_to_the_last_bit() {
        for (x, y) in [(1.5, -2.25), (0.0, 0.0), (-0.0, 3.0), (3.0, -0.0), (-0.0, -0.0), (f64::INFINITY, 1e-300)] {
            let disc = Footprint::disc(Point2::new(x, y), 0.11);
            let made = Part::new(Pose2 { x, y, theta: 0.0 }, Shape::Disc { radius: 0.11 });
            assert_eq!(disc.parts(), std::slice::from_ref(&made));
            let bits = |part: &Part| {
                let (pose, at) = (part.pose(), part.placed().core()[0]);
                [pose.x, pose.y, pose.theta, at.x, at.y, part.placed().radius()].map(f64::to_bits)
            };
            assert_eq!(bits(&disc.parts()[0]), bits(&made), "({x}, {y})");
        }
    }

    #[test]
    fn checked_constructors_refuse_and_unchecked_ones_fail_safe() {
        let (o, nan) = (Point2::origin(), Point2::new(f64::NAN, 0.0));
        assert!(Footprint::try_disc(nan, 0.1).is_err() && Footprint::try_disc(o, f64::INFINITY).is_err());
        assert!(Footprint::try_disc(o, 0.1).is_ok_and(|f| f.is_valid()));
        assert!(!Footprint::disc(nan, 0.1).is_valid() && !Footprint::disc(o, f64::NAN).is_valid());
        assert!(Footprint::try_capsules(&[Segment::new(o, nan)], 0.1).is_err());
        assert!(Footprint::try_capsules(&[Segment::new(o, o)], 0.1).is_err(), "shorter than the smallest feature");
        let turned = Pose2 { x: 0.0, y: 0.0, theta: f64::NAN };
        assert!(Footprint::try_rects(&[(turned, o, Point2::new(1.0, 1.0))]).is_err());
        assert!(!Footprint::rects([(turned, o, Point2::new(1.0, 1.0))]).is_valid());
    }
}
