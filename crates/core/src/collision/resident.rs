//! A world's resident as a robot that can be asked about.

use crate::configuration::AnyConfiguration;
use crate::robots::AnyRobot;
use crate::worlds::Resident;

impl AnyRobot {
    /// A world's resident with its own sizes, and the configuration in which it starts. `None` for a resident of a
    /// kind that is not the lab's, and for a start or sizes that are not its kind's. Everything that asks about a
    /// resident outside a run asks about this robot.
    pub fn of_resident(resident: &Resident) -> Option<(AnyRobot, AnyConfiguration)> {
        AnyRobot::sized(&resident.kind, &resident.start, resident.sizes.as_ref())
    }
}
