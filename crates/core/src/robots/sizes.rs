//! The lab's robots with the sizes that a world gives them.

use super::{AnyRobot, CarBody, HITCH, Hitch, RUSTY, Reach, Rusty, TrailerBody};
use crate::configuration::{AnyConfiguration, ArmSizes, CarSizes, DiscSizes, Sizes, TrailerSizes};

impl Rusty {
    /// The same rover with these sizes; `None` for those of another sort of robot. The numbers are not checked.
    pub fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        let Sizes::Disc(disc) = sizes else { return None };
        Some(Rusty { body_radius: disc.radius, track: disc.track, wheel_radius: disc.wheel_radius, ..*self })
    }

    /// Its sizes: with them [`with_sizes`](Self::with_sizes) gives this rover from one that differs in nothing else.
    pub fn sizes(&self) -> Sizes {
        Sizes::Disc(DiscSizes { radius: self.body_radius, track: self.track, wheel_radius: self.wheel_radius })
    }
}

impl<const N: usize> Reach<N> {
    /// The same arm with these sizes; `None` for those of another sort of robot, or of another number of links. The
    /// numbers are not checked.
    pub fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        let Sizes::Arm(ArmSizes { base, lengths, radius }) = sizes else { return None };
        let lengths = lengths.as_slice().try_into().ok()?;
        Some(Reach { base: *base, lengths, link_radius: *radius })
    }

    /// Its sizes, which are all that an arm is.
    pub fn sizes(&self) -> Sizes {
        Sizes::Arm(ArmSizes { base: self.base, lengths: self.lengths.to_vec(), radius: self.link_radius })
    }
}

impl Hitch {
    /// The same car with these sizes, its own trailer attached; `None` for those of another sort of robot. The numbers
    /// are not checked.
    pub fn with_sizes(&self, sizes: &Sizes) -> Option<Self> {
        let Sizes::Car(CarSizes { wheelbase, length, width, rear_overhang, max_steer, trailer }) = *sizes else {
            return None;
        };
        Some(Hitch {
            wheelbase,
            max_steer,
            body: CarBody { length, width, rear_overhang },
            trailer_body: TrailerBody {
                front_overhang: trailer.front_overhang,
                rear_overhang: trailer.rear_overhang,
                width: trailer.width,
            },
            hitch_len: Some(trailer.hitch_len),
            jackknife: trailer.jackknife,
            ..*self
        })
    }

    /// Its sizes, a trailer's among them: a car without a hitch has those of the trailer that
    /// [`with_trailer`](Self::with_trailer) attaches.
    pub fn sizes(&self) -> Sizes {
        let Hitch { wheelbase, max_steer, body, trailer_body, .. } = *self;
        let trailer = TrailerSizes {
            hitch_len: self.hitch_len.unwrap_or(CarSizes::HITCH.trailer.hitch_len),
            width: trailer_body.width,
            front_overhang: trailer_body.front_overhang,
            rear_overhang: trailer_body.rear_overhang,
            jackknife: self.jackknife,
        };
        let CarBody { length, width, rear_overhang } = body;
        Sizes::Car(CarSizes { wheelbase, length, width, rear_overhang, max_steer, trailer })
    }
}

impl AnyRobot {
    /// The model of this kind, as worlds name it, with these sizes, or with its kind's own for `None`. A car given
    /// sizes has its own trailer attached; [`fitted`](Self::fitted) takes it off. `None` for a kind that is not the
    /// lab's, or sizes that are not its kind's.
    pub fn model(kind: &str, sizes: Option<&Sizes>) -> Option<AnyRobot> {
        let own = match Sizes::of_kind(kind)? {
            Sizes::Disc(_) => AnyRobot::Rusty(RUSTY),
            Sizes::Arm(arm) if arm.lengths.len() == 2 => AnyRobot::Reach(Reach::workbench()),
            Sizes::Arm(_) => AnyRobot::Reach3(Reach::redundant()),
            Sizes::Car(_) => AnyRobot::Hitch(HITCH),
        };
        let Some(sizes) = sizes else { return Some(own) };
        Some(match own {
            AnyRobot::Rusty(rover) => AnyRobot::Rusty(rover.with_sizes(sizes)?),
            AnyRobot::Reach(arm) => AnyRobot::Reach(arm.with_sizes(sizes)?),
            AnyRobot::Reach3(arm) => AnyRobot::Reach3(arm.with_sizes(sizes)?),
            AnyRobot::Hitch(car) => AnyRobot::Hitch(car.with_sizes(sizes)?),
        })
    }

    /// An arm of two or three links as one of the lab's robots; `None` for another number.
    pub fn arm<const N: usize>(arm: &Reach<N>) -> Option<AnyRobot> {
        let Reach { base, lengths, link_radius } = *arm;
        let two =
            <[f64; 2]>::try_from(&lengths[..]).map(|lengths| AnyRobot::Reach(Reach { base, lengths, link_radius }));
        let three =
            || <[f64; 3]>::try_from(&lengths[..]).map(|lengths| AnyRobot::Reach3(Reach { base, lengths, link_radius }));
        two.or_else(|_| three()).ok()
    }

    /// The robot that `q` is a configuration of: a car with its trailer if `q` has its heading, else without.
    #[must_use]
    pub fn fitted(&self, q: &AnyConfiguration) -> AnyRobot {
        match (self, q) {
            (AnyRobot::Hitch(car), AnyConfiguration::Hitch(q)) => {
                AnyRobot::Hitch(if q.trailer.is_some() { car.with_trailer() } else { car.without_trailer() })
            }
            _ => *self,
        }
    }

    /// Its sizes.
    pub fn sizes(&self) -> Sizes {
        match self {
            AnyRobot::Rusty(rover) => rover.sizes(),
            AnyRobot::Reach(arm) => arm.sizes(),
            AnyRobot::Reach3(arm) => arm.sizes(),
            AnyRobot::Hitch(car) => car.sizes(),
        }
    }

    /// As [`of_kind`](Self::of_kind), of a robot with these sizes, or with its kind's own for `None`.
    ///
    /// ```
    /// use motion_lab_core::configuration::{DiscSizes, Sizes};
    /// use motion_lab_core::robots::{AnyRobot, Robot};
    /// let big = Sizes::Disc(DiscSizes { radius: 0.25, track: 0.4, wheel_radius: 0.05 });
    /// let (rover, q) = AnyRobot::sized("rusty", &[1.0, 2.0, 0.0], Some(&big)).unwrap();
    /// assert_eq!(rover.footprint(&q).parts()[0].placed().radius(), 0.25);
    /// assert!(AnyRobot::sized("reach", &[1.0, 2.0], Some(&big)).is_none());
    /// ```
    pub fn sized(kind: &str, coordinates: &[f64], sizes: Option<&Sizes>) -> Option<(AnyRobot, AnyConfiguration)> {
        let (own, q) = Self::of_kind(kind, coordinates)?;
        let robot = if sizes.is_some() { Self::model(kind, sizes)?.fitted(&q) } else { own };
        Some((robot, q))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::RobotKind;

    #[test]
    fn a_kinds_own_sizes_are_its_robots() {
        for kind in RobotKind::ALL {
            let own = Sizes::of_kind(kind.name).unwrap();
            assert_eq!(own.check_for(kind.name), Ok(()));
            let (model, sized) = (AnyRobot::model(kind.name, None), AnyRobot::model(kind.name, Some(&own)));
            let towing = |robot: AnyRobot| match robot {
                AnyRobot::Hitch(car) => AnyRobot::Hitch(car.with_trailer()),
                robot => robot,
            };
            assert_eq!(model.map(towing), sized, "{}", kind.name);
            assert_eq!(model.map(|robot| robot.sizes()), Some(own.clone()), "{}", kind.name);
            for space in kind.spaces {
                let start: Vec<f64> = (0..space.coordinates).map(|i| 0.25 * i as f64).collect();
                let plain = AnyRobot::of_kind(kind.name, &start).unwrap();
                assert_eq!(AnyRobot::sized(kind.name, &start, Some(&own)), Some(plain), "{start:?}");
                assert_eq!(AnyRobot::sized(kind.name, &start, None), Some(plain));
            }
        }
        assert!(Sizes::of_kind("x-puck").is_none() && AnyRobot::model("x-puck", None).is_none());
    }
}
