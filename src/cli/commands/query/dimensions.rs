//! `Dimensions`, a robot's kind and measures as JSON.

use motion_lab::export::JsonNumber;
use motion_lab::robots::{Hitch, Reach, Robot, Rusty};
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
    Hitch { body: Body, trailer: Option<Trailer> },
}

/// The chassis: along its x axis from `-rear_overhang` to `length - rear_overhang`.
#[derive(Debug, Serialize)]
pub struct Body {
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

/// A robot with known dimensions.
pub trait Measured: Robot {
    /// The robot's kind and dimensions.
    fn dimensions(&self) -> Dimensions;
}

impl Measured for Rusty {
    fn dimensions(&self) -> Dimensions {
        Dimensions::Rusty { radius: JsonNumber(self.body_radius) }
    }
}

impl<const N: usize> Measured for Reach<N> {
    fn dimensions(&self) -> Dimensions {
        Dimensions::Reach {
            base: point(self.base),
            lengths: self.lengths.map(JsonNumber).to_vec(),
            radius: JsonNumber(self.link_radius),
        }
    }
}

impl Measured for Hitch {
    fn dimensions(&self) -> Dimensions {
        let (body, towed) = (self.body, self.trailer_body);
        Dimensions::Hitch {
            body: Body {
                length: JsonNumber(body.length),
                width: JsonNumber(body.width),
                rear_overhang: JsonNumber(body.rear_overhang),
            },
            trailer: self.hitch_len.map(|hitch_len| Trailer {
                hitch_len: JsonNumber(hitch_len),
                front_overhang: JsonNumber(towed.front_overhang),
                rear_overhang: JsonNumber(towed.rear_overhang),
                width: JsonNumber(towed.width),
            }),
        }
    }
}
