//! `StandingParts`, the parts of the robots that stand in a world, for many obstacles to be put among them.

use bevy::prelude::*;

use crate::simulation::{Residents, ResidesIn, RobotId, RobotOps};
use motion_lab_core::collision::touch;
use motion_lab_core::geometry::{Aabb, Placed};
use motion_lab_core::num::greater;

/// The parts of the robots that stand in a world, by the left sides of boxes around them.
pub(super) struct StandingParts {
    parts: Vec<StandingPart>,
    /// The greatest width of a box, metres.
    widest: f64,
}

struct StandingPart {
    robot: (RobotId, Entity),
    extent: Aabb,
    placed: Placed,
}

impl StandingParts {
    /// The parts of the robots in the world of this entity, where they are now.
    pub(super) fn of(world: &World, of_world: Entity) -> Self {
        let residents = world.get::<Residents>(of_world).into_iter().flat_map(Residents::iter);
        let here = residents.filter(|robot| world.get::<ResidesIn>(*robot).is_some_and(|of| of.0 == of_world));
        let mut parts = Vec::new();
        for robot in here {
            let footprint = world.get::<RobotOps>(robot).and_then(|ops| (ops.footprint)(world, robot));
            let Some((&id, footprint)) = world.get::<RobotId>(robot).zip(footprint) else { continue };
            parts.extend(footprint.parts().iter().map(|part| {
                let placed = part.placed().clone();
                StandingPart { robot: (id, robot), extent: placed.padded_bounds(), placed }
            }));
        }
        StandingParts::new(parts)
    }

    fn new(mut parts: Vec<StandingPart>) -> Self {
        parts.sort_by(|a, b| a.extent.min.x.total_cmp(&b.extent.min.x));
        let width = |part: &StandingPart| (part.extent.max.x - part.extent.min.x).next_up();
        let widest = parts.iter().map(width).fold(0.0, greater);
        StandingParts { parts, widest }
    }

    /// The first robot, by id, of which a part touches one of these pieces.
    pub(super) fn first_touching(&self, pieces: impl Iterator<Item = Placed>) -> Option<Entity> {
        let mut first: Option<(RobotId, Entity)> = None;
        for piece in pieces {
            let extent = piece.padded_bounds();
            // boxes farther left cannot reach, also where the difference is rounded
            let left = (extent.min.x - self.widest).next_down();
            let from = self.parts.partition_point(|part| part.extent.min.x < left);
            let near = self.parts[from..].iter().take_while(|part| part.extent.min.x <= extent.max.x);
            for part in near.filter(|part| !part.extent.is_apart(&extent)) {
                if first.is_none_or(|first| part.robot < first) && touch(&part.placed, &piece) {
                    first = Some(part.robot);
                }
            }
        }
        first.map(|(_, robot)| robot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::{Pose2, Shape};
    use motion_lab_core::random::{Seed, Stream};

    fn part(id: u32, placed: Placed) -> StandingPart {
        StandingPart {
            robot: (RobotId(id), Entity::from_raw_u32(id + 1).unwrap()),
            extent: placed.padded_bounds(),
            placed,
        }
    }

    /// The same by asking every part.
    fn by_all(parts: &[(u32, Placed)], piece: &Placed) -> Option<u32> {
        parts.iter().filter(|(_, placed)| touch(placed, piece)).map(|(id, _)| *id).min()
    }

    #[test]
    fn the_first_robot_that_touches_is_that_of_asking_every_part() {
        let mut s = Stream::new(Seed(4), "parts");
        let mut drawn = |most: f64| {
            let radius = s.uniform(0.01, most);
            Shape::Disc { radius }.place(&Pose2::new(s.uniform(-3.0, 3.0), s.uniform(-3.0, 3.0), 0.0))
        };
        let (mut hits, mut misses) = (0, 0);
        for _ in 0..40 {
            let mut parts: Vec<(u32, Placed)> = (0..60).map(|k| (k / 2, drawn(0.3))).collect();
            parts.reverse();
            let standing = StandingParts::new(parts.iter().map(|(id, placed)| part(*id, placed.clone())).collect());
            for _ in 0..60 {
                let piece = drawn(0.4);
                let found =
                    standing.first_touching(std::iter::once(piece.clone())).map(|entity| entity.index_u32() - 1);
                let expected = by_all(&parts, &piece);
                assert_eq!(found, expected);
                if expected.is_some() { hits += 1 } else { misses += 1 }
            }
        }
        assert!(hits > 300 && misses > 300, "{hits} hits, {misses} misses");
    }

    #[test]
    fn what_touches_at_a_point_counts_and_so_does_what_is_not_valid() {
        let disc = |x: f64, radius: f64| Shape::Disc { radius }.place(&Pose2::new(x, 0.0, 0.0));
        let standing = || StandingParts::new(vec![part(3, disc(2.0, 0.5)), part(1, disc(-2.0, 0.25))]);
        let found = |piece: Placed| standing().first_touching(std::iter::once(piece)).map(|e| e.index_u32() - 1);
        assert_eq!(found(disc(1.0, 0.5)), Some(3), "they touch at (1.5, 0)");
        assert_eq!(found(disc(1.0, 0.499_999_999)), None);
        assert_eq!(found(disc(0.0, 9.0)), Some(1), "the first by id");
        assert_eq!(found(disc(f64::NAN, 0.1)), Some(1));
        assert_eq!(StandingParts::new(Vec::new()).first_touching(std::iter::once(disc(0.0, 9.0))), None);
    }
}
