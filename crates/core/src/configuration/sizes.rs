//! `Sizes`, the numbers of a robot that a world file may say: how large it is, how it is built, how far it steers.

use crate::geometry::{MAX_COORDINATE, MIN_FEATURE, Point2};

/// Largest size of a robot, metres.
pub const MAX_SIZE: f64 = 1e3;
/// Smallest distance between a car's axles, and from its hitch to the trailer's axle, metres. With less, a tick turns
/// the trailer too far for its integration.
pub const MIN_AXLES: f64 = 0.1;
/// Largest steering limit, radians. Nearer to a right angle the turning circle vanishes.
pub const MAX_STEER: f64 = 1.5;
/// Largest jackknife limit, radians. A hitch that folds by half a turn has none.
pub const MAX_JACKKNIFE: f64 = 3.1;

/// How far a chassis may fall short of an axle by rounding, metres.
const ROUNDING: f64 = 1e-9;

/// What one robot of a kind is like. A resident without sizes has those of its kind, [`Sizes::of_kind`].
///
/// ```
/// use motion_lab_core::configuration::Sizes;
/// let Some(Sizes::Car(mut car)) = Sizes::of_kind("hitch") else { panic!("a car") };
/// assert_eq!((car.wheelbase, car.trailer.hitch_len), (2.5, 2.0));
/// car.wheelbase = 3.5;
/// let error = Sizes::Car(car).check().unwrap_err().to_string();
/// assert!(error.starts_with("car: a length of 3.9 m does not reach from 0.7 m behind one axle to the other"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// Of a disc on two wheels: `rusty`.
    Disc(DiscSizes),
    /// Of an arm: `reach` and `reach3`.
    Arm(ArmSizes),
    /// Of a car and its trailer: `hitch`.
    Car(CarSizes),
}

/// The numbers of a disc on two wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscSizes {
    /// Radius of the disc, metres.
    pub radius: f64,
    /// Distance between the two wheels, metres.
    pub track: f64,
    /// Radius of a wheel, metres.
    pub wheel_radius: f64,
}

impl DiscSizes {
    /// Rusty's.
    pub const RUSTY: DiscSizes = DiscSizes { radius: 0.11, track: 0.16, wheel_radius: 0.033 };
}

/// The numbers of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmSizes {
    /// The position of joint 1 in the world, metres.
    pub base: Point2,
    /// The lengths of the links, from the base on, metres: as many as the kind has joints.
    pub lengths: Vec<f64>,
    /// The radius of each link, metres; 0 for bare segments.
    pub radius: f64,
}

/// The numbers of a car.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarSizes {
    /// Distance from the rear to the front axle, metres.
    pub wheelbase: f64,
    /// Overall length of the chassis, metres.
    pub length: f64,
    /// Overall width of the chassis, metres.
    pub width: f64,
    /// How far the chassis reaches behind the rear axle, metres.
    pub rear_overhang: f64,
    /// Largest steering angle to either side, radians.
    pub max_steer: f64,
    /// The trailer that it may pull. The number of its start's coordinates says whether it does.
    pub trailer: TrailerSizes,
}

/// The numbers of a trailer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailerSizes {
    /// Distance from the hitch, at the car's rear axle, to the trailer's axle, metres.
    pub hitch_len: f64,
    /// Width of the box, metres.
    pub width: f64,
    /// How far the box reaches ahead of its axle, metres.
    pub front_overhang: f64,
    /// How far the box reaches behind its axle, metres.
    pub rear_overhang: f64,
    /// How far the hitch may fold to either side, radians; `None` for any angle, so that car and trailer may overlap.
    pub jackknife: Option<f64>,
}

/// Why sizes are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SizesError {
    /// A number out of range, or not finite.
    #[error("{number} {value}: it must be from {least} to {most}")]
    Range {
        /// The number, as world files name it.
        number: String,
        /// Its value.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The most that it may be.
        most: f64,
    },
    /// A chassis that does not reach over both axles.
    #[error(
        "car: a length of {length} m does not reach from {rear_overhang} m behind one axle to the other, {wheelbase} m on"
    )]
    Chassis {
        /// The chassis's length, metres.
        length: f64,
        /// How far it reaches behind the rear axle, metres.
        rear_overhang: f64,
        /// Distance between the axles, metres.
        wheelbase: f64,
    },
    /// A trailer's box without length.
    #[error("car.trailer: its overhangs are {0} m in all, and no feature is smaller than {MIN_FEATURE} m")]
    Box(f64),
    /// An arm with the wrong number of links.
    #[error("arm.lengths: {found} links, a {kind} has {expected}")]
    Links {
        /// The robot's kind.
        kind: String,
        /// How many lengths there are.
        found: usize,
        /// How many its kind has.
        expected: usize,
    },
    /// Sizes of another sort of robot.
    #[error("a {kind} has no `{found}`: its numbers are its `{expected}`")]
    Kind {
        /// The robot's kind.
        kind: String,
        /// The sort of sizes, as world files name it.
        found: &'static str,
        /// The sort that its kind has.
        expected: &'static str,
    },
    /// Sizes of a kind that is not the lab's.
    #[error("`{found}` is for the lab's kinds: what a {kind} is like, its program says")]
    OwnKind {
        /// The robot's kind.
        kind: String,
        /// The sort of sizes, as world files name it.
        found: &'static str,
    },
}

impl Sizes {
    pub(super) fn of_rusty() -> Sizes {
        Sizes::Disc(DiscSizes::RUSTY)
    }

    /// Those of an arm at the origin with links of these lengths and 3 cm radius.
    pub(super) fn of_arm<const N: usize>(lengths: [f64; N]) -> Sizes {
        Sizes::Arm(ArmSizes { base: Point2::new(0.0, 0.0), lengths: lengths.to_vec(), radius: 0.03 })
    }

    pub(super) fn of_hitch() -> Sizes {
        Sizes::Car(CarSizes::HITCH)
    }

    /// The field of a world file that holds such numbers: `disc`, `arm` or `car`.
    pub const fn field(&self) -> &'static str {
        match self {
            Sizes::Disc(_) => "disc",
            Sizes::Arm(_) => "arm",
            Sizes::Car(_) => "car",
        }
    }

    /// All numbers with their names: the field, then the place in it as sweeps name it, as in `car.trailer.width` and
    /// `arm.lengths.0`. A limit of the hitch that isn't set is left out.
    pub fn numbers_mut(&mut self) -> Vec<(String, &mut f64)> {
        let named = |name: &str| name.to_owned();
        match self {
            Sizes::Disc(DiscSizes { radius, track, wheel_radius }) => vec![
                (named("disc.radius"), radius),
                (named("disc.track"), track),
                (named("disc.wheel_radius"), wheel_radius),
            ],
            Sizes::Arm(ArmSizes { base, lengths, radius }) => {
                let [[x, y]] = &mut base.coords.data.0;
                let base = [(named("arm.base.x"), x), (named("arm.base.y"), y)];
                let links = lengths.iter_mut().enumerate().map(|(i, length)| (format!("arm.lengths.{i}"), length));
                base.into_iter().chain(links).chain([(named("arm.radius"), radius)]).collect()
            }
            Sizes::Car(CarSizes { wheelbase, length, width, rear_overhang, max_steer, trailer }) => {
                let mut numbers = vec![
                    (named("car.wheelbase"), wheelbase),
                    (named("car.length"), length),
                    (named("car.width"), width),
                    (named("car.rear_overhang"), rear_overhang),
                    (named("car.max_steer"), max_steer),
                    (named("car.trailer.hitch_len"), &mut trailer.hitch_len),
                    (named("car.trailer.width"), &mut trailer.width),
                    (named("car.trailer.front_overhang"), &mut trailer.front_overhang),
                    (named("car.trailer.rear_overhang"), &mut trailer.rear_overhang),
                ];
                numbers.extend(trailer.jackknife.as_mut().map(|limit| (named("car.trailer.jackknife"), limit)));
                numbers
            }
        }
    }

    /// The unit of the number of this name: `rad` for angles, else `m`.
    pub fn unit_of(number: &str) -> &'static str {
        if ["car.max_steer", "car.trailer.jackknife"].contains(&number) { "rad" } else { "m" }
    }

    /// Checks the numbers. The number of an arm's links is its kind's business: [`check_for`](Self::check_for).
    ///
    /// # Errors
    /// [`SizesError`] names the number that is out of range, or those that do not fit together.
    pub fn check(&self) -> Result<(), SizesError> {
        match self {
            Sizes::Disc(DiscSizes { radius, track, wheel_radius }) => {
                let sizes = [("disc.radius", radius), ("disc.track", track), ("disc.wheel_radius", wheel_radius)];
                sizes.into_iter().try_for_each(|(number, value)| size(number, *value))
            }
            Sizes::Arm(ArmSizes { base, lengths, radius }) => {
                for (number, value) in [("arm.base.0", base.x), ("arm.base.1", base.y)] {
                    within(number, value, [-MAX_COORDINATE, MAX_COORDINATE])?;
                }
                lengths.iter().enumerate().try_for_each(|(i, l)| size(&format!("arm.lengths[{i}]"), *l))?;
                if *radius == 0.0 { Ok(()) } else { size("arm.radius", *radius) }
            }
            Sizes::Car(car) => car.check(),
        }
    }
}

impl CarSizes {
    /// Hitch's.
    pub const HITCH: CarSizes = CarSizes {
        wheelbase: 2.5,
        length: 3.9,
        width: 1.7,
        rear_overhang: 0.7,
        max_steer: 0.6,
        trailer: TrailerSizes { hitch_len: 2.0, width: 1.5, front_overhang: 1.0, rear_overhang: 0.8, jackknife: None },
    };

    fn check(&self) -> Result<(), SizesError> {
        let CarSizes { wheelbase, length, width, rear_overhang, max_steer, trailer } = *self;
        within("car.wheelbase", wheelbase, [MIN_AXLES, MAX_SIZE])?;
        size("car.length", length)?;
        size("car.width", width)?;
        within("car.rear_overhang", rear_overhang, [0.0, MAX_SIZE])?;
        within("car.max_steer", max_steer, [MIN_FEATURE, MAX_STEER])?;
        if length + ROUNDING < rear_overhang + wheelbase {
            return Err(SizesError::Chassis { length, rear_overhang, wheelbase });
        }
        within("car.trailer.hitch_len", trailer.hitch_len, [MIN_AXLES, MAX_SIZE])?;
        size("car.trailer.width", trailer.width)?;
        within("car.trailer.front_overhang", trailer.front_overhang, [0.0, MAX_SIZE])?;
        within("car.trailer.rear_overhang", trailer.rear_overhang, [0.0, MAX_SIZE])?;
        if let Some(limit) = trailer.jackknife {
            within("car.trailer.jackknife", limit, [MIN_FEATURE, MAX_JACKKNIFE])?;
        }
        let reach = trailer.front_overhang + trailer.rear_overhang;
        if reach < MIN_FEATURE { Err(SizesError::Box(reach)) } else { Ok(()) }
    }
}

fn size(number: &str, value: f64) -> Result<(), SizesError> {
    within(number, value, [MIN_FEATURE, MAX_SIZE])
}

fn within(number: &str, value: f64, [least, most]: [f64; 2]) -> Result<(), SizesError> {
    // NaN lies in no range
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(SizesError::Range { number: number.to_owned(), value, least, most })
}
