//! The paces at which a planner works.

/// The paces to choose from: iterations a second.
pub const PACES: [(f64, &str); 7] = [
    (1.0, "1 a second"),
    (3.0, "3 a second"),
    (10.0, "10 a second"),
    (30.0, "30 a second"),
    (100.0, "100 a second"),
    (1000.0, "1,000 a second"),
    (f64::INFINITY, "as fast as possible"),
];

/// The fastest pace at which the last rejected motion is shown: what flashes does so at most three times a second.
pub const SHOWS_REJECTED: f64 = 3.0;
