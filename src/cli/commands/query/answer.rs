//! Answers as JSON.

use motion_lab_core::collision::{Checker, EdgeVerdict, HitBy, ObstacleId, ParryScene, Scene, Witness};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::plans::CheckerName;
use serde::Serialize;

use super::line::check_place;
use super::question::Question;
use crate::cli::support::words::counted;

/// An answer; each kind is a JSON object of its own.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Answer {
    Intersects { intersects: bool },
    Distance { distance: JsonNumber },
    Witness { witness: Option<WitnessAnswer> },
    Swept { swept: bool },
    Edge(EdgeAnswer),
    Scan { ranges: Vec<JsonNumber> },
}

/// A pair of nearest points.
#[derive(Debug, Serialize)]
pub struct WitnessAnswer {
    on_robot: [JsonNumber; 2],
    on_obstacle: [JsonNumber; 2],
    dist: JsonNumber,
    part: usize,
    obstacle: String,
}

/// A verdict on an edge.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "edge", rename_all = "lowercase")]
pub enum EdgeAnswer {
    Free {
        clearance: JsonNumber,
    },
    Hit {
        free_until: JsonNumber,
        contact_at: JsonNumber,
        part: usize,
        /// The obstacle's name; null for the robot's own limit.
        obstacle: Option<String>,
        /// `jackknife` where the robot's own limit is hit; not printed otherwise.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<&'static str>,
    },
    Unresolved {
        free_until: JsonNumber,
        gap: JsonNumber,
        reason: &'static str,
    },
}

/// An answer as it is printed. That of a black box says that it is not proven.
#[derive(Debug, Serialize)]
pub struct QueryAnswer {
    #[serde(flatten)]
    answer: Answer,
    #[serde(skip_serializing_if = "Option::is_none")]
    checker: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    proven: Option<bool>,
}

impl QueryAnswer {
    /// The answer of this checker.
    pub fn new(answer: Answer, by: CheckerName) -> Self {
        QueryAnswer { answer, checker: (!by.proves()).then(|| by.id()), proven: (!by.proves()).then_some(false) }
    }
}

/// The answer about a robot at `q`, moving to `to` where the question is about a motion.
pub fn ask(
    checker: &Checker<AnyRobot>,
    question: Question,
    q: &AnyConfiguration,
    to: Option<&AnyConfiguration>,
) -> Result<Answer, String> {
    let (scene, robot) = (checker.scene(), checker.robot());
    let asked = checker.black_box().unwrap_or(scene);
    // a configuration that is not this robot's would count as contact; here it is an error
    for q in [Some(q), to].into_iter().flatten() {
        robot.check(q).map_err(|error| error.to_string())?;
    }
    let at = || robot.footprint(q);
    let to = || to.ok_or("`to`, where the motion ends, is missing");
    Ok(match question {
        Question::Intersects => Answer::Intersects { intersects: asked.intersects(&at()) },
        Question::Distance => Answer::Distance { distance: JsonNumber(asked.distance(&at())) },
        Question::Witness => Answer::Witness { witness: asked.witness(&at()).map(|w| witness(scene, &w)) },
        Question::Swept => Answer::Swept { swept: asked.swept(&at(), &robot.footprint(to()?)) },
        Question::Edge => Answer::Edge(edge(scene, checker.edge(q, to()?).map_err(|error| error.to_string())?)),
        Question::Scan => return Err("a scan is not asked of a robot".into()),
    })
}

/// The ranges of the sensor at x, y and, if given, with the heading theta; by parry's rays if there is a black box.
pub fn ask_scan(
    scene: &Scene,
    black_box: Option<&ParryScene>,
    sensor: &RangeSensor,
    q: &[f64],
) -> Result<Answer, String> {
    let pose = match *q {
        [x, y] => Pose2::new(x, y, 0.0),
        [x, y, theta] => Pose2::new(x, y, theta),
        _ => return Err(format!("{}: a scan is from x, y or x, y, theta", counted(q.len(), "number"))),
    };
    check_place(q)?;
    let ranges = match black_box {
        None => sensor.scan_from(scene, &[], &pose),
        Some(parry) => {
            let range =
                |(x, y): (f64, f64)| parry.range(pose.position(), pose.rotate(Vector2::new(x, y)), sensor.max_range);
            (0..sensor.n_rays).map(|k| range(sensor.direction(k))).collect()
        }
    };
    Ok(Answer::Scan { ranges: ranges.into_iter().map(JsonNumber).collect() })
}

fn witness(scene: &Scene, w: &Witness) -> WitnessAnswer {
    WitnessAnswer {
        on_robot: point(w.on_robot),
        on_obstacle: point(w.on_obstacle),
        dist: JsonNumber(w.dist),
        part: w.part,
        obstacle: name(scene, w.obstacle).unwrap_or_default(),
    }
}

/// A verdict with the names of its obstacles.
pub fn edge(scene: &Scene, verdict: EdgeVerdict) -> EdgeAnswer {
    match verdict {
        EdgeVerdict::Free { clearance } => EdgeAnswer::Free { clearance: JsonNumber(clearance) },
        EdgeVerdict::Hit { free_until, contact_at, part, by } => EdgeAnswer::Hit {
            free_until: JsonNumber(free_until),
            contact_at: JsonNumber(contact_at),
            part,
            obstacle: by.obstacle().and_then(|id| name(scene, id)),
            limit: (by == HitBy::Limit).then_some("jackknife"),
        },
        EdgeVerdict::Unresolved { free_until, gap, reason } => {
            EdgeAnswer::Unresolved { free_until: JsonNumber(free_until), gap: JsonNumber(gap), reason: reason.name() }
        }
    }
}

/// An obstacle's name.
pub fn name(scene: &Scene, obstacle: ObstacleId) -> Option<String> {
    scene.obstacle_name(obstacle).map(str::to_owned)
}

/// A point as a pair of numbers.
pub fn point(p: Point2) -> [JsonNumber; 2] {
    [JsonNumber(p.x), JsonNumber(p.y)]
}
