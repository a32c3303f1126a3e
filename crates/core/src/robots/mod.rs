//! Robots: the footprint at each configuration, and bounds on how far a motion moves it.
//!
//! The lab's robots in numbers:
//!
//! | robot | number | value |
//! |---|---|---|
//! | Rusty, [`RUSTY`] | radius of the disc | 0.11 m |
//! | | distance between the wheels, radius of a wheel | 0.16 m, 0.033 m |
//! | | encoder counts a turn, greatest slip of a wheel | 360, 5 % |
//! | | greatest speed, greatest turn rate | 0.6 m/s, 2.5 rad/s |
//! | Reach, [`workbench`](Reach::workbench) | base | at the origin |
//! | | lengths and radius of the two links | 1 m and 1 m, 0.03 m |
//! | | joint limits, greatest joint speed | none |
//! | Reach with bare links, [`choset`](Reach::choset) | lengths and radius | 1 m and 1 m, 0 |
//! | Reach with three links, [`redundant`](Reach::redundant) | lengths and radius | 0.6, 0.5 and 0.4 m, 0.03 m |
//! | Hitch, [`HITCH`] | length and width of the chassis | 3.9 m, 1.7 m |
//! | | distance between the axles, overhang at either end | 2.5 m, 0.7 m |
//! | | greatest speed, greatest steering angle | 1.5 m/s, 0.6 rad |
//! | | least radius of the rear axle's path | 3.654 m |
//! | its trailer, [`with_trailer`](Hitch::with_trailer) | length and width of the box | 1.8 m, 1.5 m |
//! | | the box ahead of its axle, and behind | 1 m, 0.8 m |
//! | | from the hitch, at the car's rear axle, to the trailer's axle | 2 m |
//!
//! Speeds, rates and steering angles are limits either way. An arm is where its command puts it; its tour turns no
//! joint faster than 2 rad/s.
//!
//! ```
//! use motion_lab_core::robots::{HITCH, RUSTY, Reach};
//! // the numbers are public
//! assert_eq!((RUSTY.body_radius, RUSTY.track, RUSTY.wheel_radius), (0.11, 0.16, 0.033));
//! let (arm, longer, towing) = (Reach::<2>::workbench(), Reach::<3>::redundant(), HITCH.with_trailer());
//! assert_eq!((arm.lengths, arm.link_radius, longer.lengths), ([1.0, 1.0], 0.03, [0.6, 0.5, 0.4]));
//! assert_eq!((towing.body.length, towing.body.width, towing.wheelbase), (3.9, 1.7, 2.5));
//! assert_eq!((towing.trailer_body.width, towing.hitch_len), (1.5, Some(2.0)));
//! assert!((1.0 / towing.curvature(towing.max_steer) - 3.654).abs() < 5e-4);
//! ```

mod any;
mod check_rates;
mod hitch;
mod hitch_arc;
mod jackknife;
mod linkage;
mod motion;
mod reach;
mod robot;
mod rusty;
mod sizes;
mod within;

pub use any::AnyRobot;
pub use check_rates::{MotionBound, RatesError, RatesUse, check_drive_rates, check_rates};
pub use hitch::{CarBody, CarCmd, HITCH, Hitch, TrailerBody};
pub use hitch_arc::HitchArc;
#[doc(hidden)]
pub use linkage::{Linkage, TurningPart};
#[doc(hidden)]
pub use motion::Beginning;
pub use motion::{Leaving, Motion, Rates};
pub use reach::{JointPoints, Reach, ReachError};
pub use robot::{CHANNEL_UNITS, ChartLine, ConfigurationError, Drivable, PartRates, PointJacobian, Robot, TICK};
pub use rusty::{EncoderCounts, RUSTY, Rusty, RustyArc, RustyCmd, RustyDisc, WheelSlip, WheelTurns};
pub(crate) use within::{nearest_side, stays_within, to_sides};
