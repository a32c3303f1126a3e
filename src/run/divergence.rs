//! `Divergence`, the first difference between two runs.

use std::fmt;

use super::Frame;
use super::field::{Field, Value};

/// The first value in which two runs differ. A replay that diverges is data, not a panic.
///
/// Prints as `tick 17, robot 0, configuration[2]: expected 1.5 (0x3ff8000000000000), found 1.5000000000000002
/// (0x3ff8000000000001), 1 ulp apart`.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// The tick of the frame that differs.
    pub tick: u64,
    /// The robot's id; `None` for a value that belongs to no robot.
    pub robot: Option<u32>,
    /// The value's name, in the order of [`Frame::encode`]: `configuration[2]`, `contacts`, `ranges.len`; `frames.len`
    /// when one run is the beginning of the other.
    pub field: String,
    /// The value in the first run.
    pub expected: Value,
    /// The value in the second run.
    pub found: Value,
}

impl Divergence {
    /// The distance of the two values in representable numbers; `None` unless both are floats and neither is NaN.
    pub fn ulps(&self) -> Option<u64> {
        match (self.expected, self.found) {
            (Value::Float(a), Value::Float(b)) if !a.is_nan() && !b.is_nan() => {
                Some(u64::try_from((rank(a) - rank(b)).unsigned_abs()).unwrap_or(u64::MAX))
            }
            _ => None,
        }
    }
}

/// The rank of a number among all `f64` in ascending order, counted from +0.0; -0.0 comes just before it.
fn rank(x: f64) -> i128 {
    let magnitude = i128::from(x.abs().to_bits());
    if x.is_sign_negative() { -magnitude - 1 } else { magnitude }
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}, ", self.tick)?;
        if let Some(robot) = self.robot {
            write!(f, "robot {robot}, ")?;
        }
        let Divergence { field, expected, found, .. } = self;
        write!(f, "{field}: expected {expected} ({:#018x}), found {found} ({:#018x})", expected.bits(), found.bits())?;
        match self.ulps() {
            Some(1) => write!(f, ", 1 ulp apart"),
            Some(n) => write!(f, ", {n} ulps apart"),
            None => Ok(()),
        }
    }
}

/// The first value, in order of ticks and then of [`Frame::encode`], in which two runs' frames differ in a bit. `None`
/// if they agree in every bit of every frame.
pub fn first_divergence(expected: &[Frame], found: &[Frame]) -> Option<Divergence> {
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for (one, other) in expected.iter().zip(found) {
        a.clear();
        b.clear();
        one.encode(&mut a);
        other.encode(&mut b);
        if a != b {
            return differing_value(one, other);
        }
    }
    let common = expected.len().min(found.len());
    let beyond = expected.get(common).or(found.get(common))?;
    Some(Divergence {
        tick: beyond.tick,
        robot: None,
        field: "frames.len".into(),
        expected: Value::of_len(expected.len()),
        found: Value::of_len(found.len()),
    })
}

fn differing_value(expected: &Frame, found: &Frame) -> Option<Divergence> {
    let values = |frame: &Frame| {
        let mut values: Vec<(Option<u32>, Field, Value)> = Vec::new();
        frame.visit(&mut |robot: Option<u32>, field: Field, value: Value| values.push((robot, field, value)));
        values
    };
    let (a, b) = (values(expected), values(found));
    let ((robot, field, expected_value), (_, _, found_value)) =
        a.into_iter().zip(b).find(|((_, _, x), (_, _, y))| x.bits() != y.bits())?;
    Some(Divergence {
        tick: expected.tick,
        robot,
        field: field.to_string(),
        expected: expected_value,
        found: found_value,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::fixture;

    #[test]
    fn every_field_is_compared_and_named() {
        type Change = fn(&mut Frame);
        let changes: [(&str, Change); 18] = [
            ("tick", |f| f.tick += 1),
            ("robots.len", |f| f.robots.truncate(1)),
            ("id", |f| f.robots[1].id = 8),
            ("configuration.len", |f| f.robots[1].configuration.push(0.0)),
            ("configuration[1]", |f| f.robots[1].configuration[1] = -0.0),
            ("extra.len", |f| f.robots[1].extra.push(0.0)),
            ("extra[0]", |f| f.robots[0].extra[0] += 1.0),
            ("channels[0]", |f| f.robots[1].channels[0] = -1),
            ("channels[1]", |f| f.robots[1].channels[1] = -1),
            ("target.len", |f| f.robots[1].target.clear()),
            ("target[0]", |f| f.robots[1].target[0] = 7.0),
            ("manual", |f| f.robots[1].manual ^= true),
            ("in_contact", |f| f.robots[1].in_contact ^= true),
            ("contacts", |f| f.robots[1].contacts += 1),
            ("flash", |f| f.robots[1].flash += 1),
            ("refusals", |f| f.robots[1].refusals += 1),
            ("scans.len", |f| f.scans.clear()),
            ("ranges[2]", |f| f.scans[0].ranges[2] = 1.0),
        ];
        let frames: Vec<Frame> = (1..=3).map(fixture::frame).collect();
        assert_eq!(first_divergence(&frames, &frames), None);
        for (field, change) in changes {
            let mut other = frames.clone();
            change(&mut other[1]);
            change(&mut other[2]); // the first one is reported
            let found = first_divergence(&frames, &other).expect(field);
            assert_eq!((found.field.as_str(), found.tick), (field, 2), "{found}");
            assert_ne!(found.expected.bits(), found.found.bits());
            let robot = match field {
                "extra[0]" | "ranges[2]" => Some(0),
                "tick" | "robots.len" | "scans.len" => None,
                _ => Some(1),
            };
            assert_eq!(found.robot, robot, "{field}");
        }
    }

    #[test]
    fn a_run_that_ends_early_diverges_where_it_ends() {
        let frames: Vec<Frame> = (1..=3).map(fixture::frame).collect();
        for (a, b) in [(&frames[..], &frames[..2]), (&frames[..2], &frames[..])] {
            let found = first_divergence(a, b).unwrap();
            assert_eq!((found.tick, found.field.as_str(), found.robot), (3, "frames.len", None));
            assert_eq!((found.expected, found.found), (Value::of_len(a.len()), Value::of_len(b.len())));
        }
        assert_eq!(first_divergence(&[], &[]), None);
    }

    #[test]
    fn it_prints_both_values_both_bit_patterns_and_the_ulps_between() {
        let at = |expected, found| Divergence {
            tick: 17,
            robot: Some(0),
            field: "configuration[2]".into(),
            expected,
            found,
        };
        assert_eq!(
            at(Value::Float(1.5), Value::Float(1.500_000_000_000_000_2)).to_string(),
            "tick 17, robot 0, configuration[2]: expected 1.5 (0x3ff8000000000000), found 1.5000000000000002 \
             (0x3ff8000000000001), 1 ulp apart"
        );
        let next = f64::from_bits(1);
        for (a, b, ulps) in [
            (0.0, -0.0, Some(1)),
            (next, -0.0, Some(2)),
            (-next, 0.0, Some(2)),
            (f64::MAX, f64::INFINITY, Some(1)),
            (1.0, 2.0, Some(1 << 52)),
            (f64::NAN, 1.0, None),
        ] {
            assert_eq!(at(Value::Float(a), Value::Float(b)).ulps(), ulps, "{a:?} {b:?}");
        }
        assert_eq!(at(Value::Count(1), Value::Count(2)).ulps(), None);
    }
}
