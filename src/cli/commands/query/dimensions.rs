//! `Dimensions`, a robot's kind and measures as JSON.

use motion_lab_core::robots::{AnyRobot, Hitch, Reach};
use motion_lab_sim::export::JsonNumber;
use serde::Serialize;

use super::answer::point;

/// What a program needs to compute a robot's footprint at a configuration, metres.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Dimensions {
    /// A disc about (x, y), which its heading does not move.
    Rusty { radius: JsonNumber },
    /// Links from the base on, each all points within the radius of a segment; link k has the heading th1 + .. + thk.
    Reach { base: [JsonNumber; 2], lengths: Vec<JsonNumber>, radius: JsonNumber },
    /// Rectangles, half the width to either side of the x axis of their frames: the body in the frame (x, y, theta),
    /// the trailer in the frame (x, y, psi).
    Hitch { body: Chassis, trailer: Option<Trailer> },
}

/// The chassis: along its x axis from `-rear_overhang` to `length - rear_overhang`.
#[derive(Debug, Serialize)]
pub struct Chassis {
    length: JsonNumber,
    width: JsonNumber,
    rear_overhang: JsonNumber,
}

/// The trailer's box: along its x axis from `-hitch_len - rear_overhang` to `-hitch_len + front_overhang`.
#[derive(Debug, Serialize)]
pub struct Trailer {
    hitch_len: JsonNumber,
    front_overhang: JsonNumber,
    rear_overhang: JsonNumber,
    width: JsonNumber,
}

impl Dimensions {
    /// The robot's kind and dimensions.
    pub fn of(robot: &AnyRobot) -> Dimensions {
        match robot {
            AnyRobot::Rusty(rover) => Dimensions::Rusty { radius: JsonNumber(rover.body_radius) },
            AnyRobot::Reach(arm) => Dimensions::of_arm(arm),
            AnyRobot::Reach3(arm) => Dimensions::of_arm(arm),
            AnyRobot::Hitch(car) => Dimensions::of_car(car),
        }
    }

    fn of_arm<const N: usize>(arm: &Reach<N>) -> Dimensions {
        Dimensions::Reach {
            base: point(arm.base),
            lengths: arm.lengths.map(JsonNumber).to_vec(),
            radius: JsonNumber(arm.link_radius),
        }
    }

    fn of_car(car: &Hitch) -> Dimensions {
        let (body, towed) = (car.body, car.trailer_body);
        Dimensions::Hitch {
            body: Chassis {
                length: JsonNumber(body.length),
                width: JsonNumber(body.width),
                rear_overhang: JsonNumber(body.rear_overhang),
            },
            trailer: car.hitch_len.map(|hitch_len| Trailer {
                hitch_len: JsonNumber(hitch_len),
                front_overhang: JsonNumber(towed.front_overhang),
                rear_overhang: JsonNumber(towed.rear_overhang),
                width: JsonNumber(towed.width),
            }),
        }
    }
}
