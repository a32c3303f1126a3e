//! `Gait`, how a robot's wheels stand.

/// How a robot's wheels stand, for drawing. A footprint does not tell it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gait {
    /// How far a rover's wheels have rolled, left and right, radians.
    pub rolled: [f64; 2],
    /// The angle of a car's front wheels, radians, positive to the left.
    pub steering: f64,
}
