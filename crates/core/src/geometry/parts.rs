//! `Part`, one rigid part of a footprint, and the list of them.

use super::{Placed, Point2, Pose2, Shape, SinCos};
use crate::num;

/// One rigid part of a footprint: a shape, the pose of its frame, and the shape placed there.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pose: Pose2,
    shape: Shape,
    placed: Placed,
}

impl Part {
    /// The part with this shape in the frame `pose`, whose heading is wrapped where it lies outside `(-pi, pi]`.
    #[inline]
    pub fn new(pose: Pose2, shape: Shape) -> Self {
        let pose = Pose2 { theta: num::in_range(pose.theta), ..pose };
        let placed = shape.place(&pose);
        Part { pose, shape, placed }
    }

    /// As [`new`](Self::new), given the sine and the cosine of the frame's angle.
    #[inline]
    pub(crate) fn new_by(pose: Pose2, sin_cos: SinCos, shape: Shape) -> Self {
        let placed = shape.place_by(&pose, sin_cos);
        Part { pose, shape, placed }
    }

    /// A disc about a point, in a frame that is not turned. It takes no sine and no copy of the whole part.
    #[inline]
    pub(super) fn disc(centre: Point2, radius: f64) -> Self {
        let pose = Pose2 { x: centre.x, y: centre.y, theta: 0.0 };
        // as the frame places its origin: a zero is positive there
        let placed = Placed::new([Point2::new(centre.x + 0.0, centre.y + 0.0)], radius);
        Part { pose, shape: Shape::Disc { radius }, placed }
    }

    /// A shape in world coordinates, with what it is there.
    pub(super) fn of_placed(shape: Shape, placed: Placed) -> Self {
        Part { pose: Pose2::IDENTITY, shape, placed }
    }

    /// The pose of the part's frame. A link's frame sits at its proximal end.
    pub fn pose(&self) -> &Pose2 {
        &self.pose
    }

    /// The shape in the part's frame.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The shape in the world.
    pub fn placed(&self) -> &Placed {
        &self.placed
    }
}

/// The parts of a footprint. Up to three lie in the footprint itself, which covers the lab's robots; each number of
/// them is a variant, so that what makes a footprint writes its parts in place.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "footprints live on the stack, and nothing holds many of them")]
pub(super) enum PartList {
    One([Part; 1]),
    Two([Part; 2]),
    Three([Part; 3]),
    /// None, or more than three.
    Others(Vec<Part>),
}

impl PartList {
    #[inline]
    pub(super) fn by_number(count: usize, part: impl Fn(usize) -> Part) -> Self {
        match count {
            1 => PartList::One([part(0)]),
            2 => PartList::Two([part(0), part(1)]),
            3 => PartList::Three([part(0), part(1), part(2)]),
            _ => PartList::Others((0..count).map(part).collect()),
        }
    }

    #[inline]
    pub(super) fn as_slice(&self) -> &[Part] {
        match self {
            PartList::One(parts) => parts,
            PartList::Two(parts) => parts,
            PartList::Three(parts) => parts,
            PartList::Others(parts) => parts,
        }
    }
}

impl Default for PartList {
    fn default() -> Self {
        PartList::Others(Vec::new())
    }
}

impl PartialEq for PartList {
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl FromIterator<Part> for PartList {
    #[inline]
    fn from_iter<I: IntoIterator<Item = Part>>(parts: I) -> Self {
        let mut parts = parts.into_iter();
        let Some(first) = parts.next() else { return PartList::default() };
        let Some(second) = parts.next() else { return PartList::One([first]) };
        let Some(third) = parts.next() else { return PartList::Two([first, second]) };
        let Some(fourth) = parts.next() else { return PartList::Three([first, second, third]) };
        PartList::Others([first, second, third, fourth].into_iter().chain(parts).collect())
    }
}
