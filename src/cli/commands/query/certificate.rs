//! `EdgeCertificate`, the proof of an edge as JSON.

use motion_lab_core::collision::{Certificate, Checker};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::robots::{AnyRobot, ConfigurationError, Motion, Robot};
use motion_lab_sim::export::JsonNumber;
use serde::Serialize;

use super::answer::{EdgeAnswer, edge};
use super::dimensions::Dimensions;
use super::shapes::ObstacleShapes;
use crate::cli::support::output::write_file;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure};

/// The version of the format. Readers refuse versions that they don't know.
const VERSION: u32 = 1;

/// The proof of how far an edge is free, with all that another program needs to check it by its own geometry, as
/// `tests/peers/certificate.py` does.
///
/// From `from` to `to` of each step every part of the robot keeps at least `clearance` metres from every shape of the
/// world, and `clearance` is above the margin. The steps join, from 0 to `proven_until`.
#[derive(Debug, Serialize)]
pub struct EdgeCertificate {
    version: u32,
    program: &'static str,
    world: ObstacleShapes,
    robot: Dimensions,
    motion: ChartLine,
    margin: JsonNumber,
    /// The answer to the question `edge`.
    pub verdict: EdgeAnswer,
    proven_until: JsonNumber,
    /// `[from, to, clearance]`
    steps: Vec<[JsonNumber; 3]>,
}

/// The motion along the straight line of the configuration chart, its parameter s from 0 to 1.
///
/// Angles lie in `(-pi, pi]` and go the short way round. A difference of half a turn, as `f64` has it, goes the
/// positive way.
#[derive(Debug, Serialize)]
struct ChartLine {
    kind: &'static str,
    from: Vec<JsonNumber>,
    to: Vec<JsonNumber>,
}

impl EdgeCertificate {
    /// Writes the certificate to its target, as one line of JSON, and says what it proves.
    pub fn write(&self, target: Target, data: &mut Data) -> Result<(), Failure> {
        let mut text = serde_json::to_string(self).map_err(Failure::internal)?;
        text.push('\n');
        write_file(&target, text.as_bytes())?;
        let proven = match self.steps.len() {
            0 => "no step; nothing is proven".to_owned(),
            1 => format!("1 step, free to s = {}", self.proven_until.0),
            n => format!("{n} steps, free to s = {}", self.proven_until.0),
        };
        target.finish_with(&format!(": {proven}"), data)
    }
}

impl EdgeCertificate {
    /// The certificate of the edge from `q` to `to`, in the world of this name. The error says what is wrong with them.
    pub fn new(
        world: &str,
        checker: &Checker<AnyRobot>,
        q: &AnyConfiguration,
        to: &AnyConfiguration,
    ) -> Result<EdgeCertificate, String> {
        let (scene, robot) = (checker.scene(), checker.robot());
        let reason = |error: ConfigurationError| error.to_string();
        let line = robot.edge(q, to).map_err(reason)?;
        let mut proof = Certificate::new();
        let verdict = checker.edge_certified(q, to, &mut proof).map_err(reason)?;
        Ok(EdgeCertificate {
            version: VERSION,
            program: concat!("motion-lab ", env!("CARGO_PKG_VERSION")),
            world: ObstacleShapes::all(world, scene),
            robot: Dimensions::of(robot),
            motion: ChartLine { kind: "chart line", from: numbers(&line.at(0.0)), to: numbers(&line.at(1.0)) },
            margin: JsonNumber(proof.margin()),
            verdict: edge(scene, verdict),
            proven_until: JsonNumber(proof.proven_until()),
            steps: proof.steps().iter().map(|step| [step.from, step.to, step.clearance].map(JsonNumber)).collect(),
        })
    }
}

fn numbers(q: &impl Configuration) -> Vec<JsonNumber> {
    q.coordinates().into_iter().map(JsonNumber).collect()
}
