//! A path of a robot whose kind only the run of the program decides.

use super::{PlayError, PlayStage, PlayablePath, PlayedPath, arm, rover};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, Tn};
use motion_lab_core::geometry::Point2;
use motion_lab_core::planning::LinePath;
use motion_lab_core::robots::AnyRobot;

impl PlayablePath for LinePath<AnyRobot> {
    /// As the paths of the robots themselves: a rover along the path of its centre, an arm along its lines. A straight
    /// line of a car's chart is refused: no car drives sideways.
    fn play(&self, stage: &PlayStage<'_>) -> Result<PlayedPath, PlayError> {
        let corners = self.corners();
        match self.start() {
            AnyConfiguration::Pose(_) => rover::play(positions(&corners), stage),
            AnyConfiguration::T2(_) => arm::play_two(&turns(&corners), stage),
            AnyConfiguration::T3(_) => arm::play_three(&turns(&corners), stage),
            AnyConfiguration::Hitch(_) => Err(PlayError::Undriven),
        }
    }
}

fn positions(corners: &[AnyConfiguration]) -> Vec<Point2> {
    let position = |q: &AnyConfiguration| match q {
        AnyConfiguration::Pose(pose) => Some(pose.position()),
        _ => None,
    };
    corners.iter().filter_map(position).collect()
}

fn turns<const N: usize>(corners: &[AnyConfiguration]) -> Vec<Tn<N>> {
    corners.iter().filter_map(|q| Tn::from_coordinates(&q.coordinates())).collect()
}
