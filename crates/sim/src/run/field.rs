//! `FrameField` and `Value`, the named leaves of a frame.

use std::fmt;

/// The name of a value of a frame: `contacts`, `configuration[2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FrameField {
    name: &'static str,
    index: Option<usize>,
}

impl FrameField {
    /// A value that is not in a list.
    pub const fn one(name: &'static str) -> Self {
        FrameField { name, index: None }
    }

    /// An item of a list.
    pub const fn item(name: &'static str, index: usize) -> Self {
        FrameField { name, index: Some(index) }
    }
}

impl fmt::Display for FrameField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.index {
            Some(index) => write!(f, "{}[{index}]", self.name),
            None => f.write_str(self.name),
        }
    }
}

/// A value of a frame. Prints in full precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A floating-point number, metres or radians.
    Float(f64),
    /// A whole number that may be negative.
    Integer(i64),
    /// A count, a tick or an id.
    Count(u64),
    /// Yes or no.
    Flag(bool),
}

impl Value {
    pub(super) fn of_len(len: usize) -> Self {
        Value::Count(len as u64)
    }

    /// The 64 bits that stand for the value in the canonical encoding.
    pub fn bits(&self) -> u64 {
        match *self {
            Value::Float(x) => x.to_bits(),
            Value::Integer(i) => i.cast_unsigned(),
            Value::Count(n) => n,
            Value::Flag(yes) => u64::from(yes),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Float(x) => write!(f, "{x:?}"),
            Value::Integer(i) => write!(f, "{i}"),
            Value::Count(n) => write!(f, "{n}"),
            Value::Flag(yes) => write!(f, "{yes}"),
        }
    }
}
