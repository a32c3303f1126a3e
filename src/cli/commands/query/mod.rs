//! `query`: the four questions, `edge` and `scan`, about one configuration or many.

mod answer;
mod certificate;
mod chosen;
mod dimensions;
mod line;
mod lines;
mod question;
mod shapes;

pub use question::Question;
use std::fs::Metadata;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use motion_lab_core::collision::{ParryScene, Scene};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::plans::CheckerName;
use serde::Serialize;

pub use answer::{EdgeAnswer, edge};
use answer::{QueryAnswer, ask, ask_scan};
use certificate::EdgeCertificate;
pub use chosen::Chosen;
pub use dimensions::Dimensions;
use line::{QuerySubject, parse_line};
use lines::Lines;
pub use shapes::ObstacleShapes;

use crate::cli::support::choices::{self, KINDS, NumberList, RobotsAndKinds, WorldNames};
use crate::cli::support::gate::read_stdin;
use crate::cli::support::input::{is_dash, open, shown};
use crate::cli::support::progress::{self, CommandProgress};
use crate::cli::support::target::Target;
use crate::cli::support::world_source::find_world;
use crate::cli::{Data, Failure, Outcome, say};

/// Largest number of wrong lines that get a message of their own.
const MESSAGES: u64 = 10;

/// Ask about a robot's configurations in a world
///
/// Every answer is one line of JSON with full precision: each number has the fewest digits that read back to the same
/// bits, and infinity is the text "inf".
///
///   intersects  {"intersects":false}
///   distance    {"distance":0.06066017177982128}, metres; 0 on contact, "inf" in an empty world
///   witness     {"witness":{"on_robot":[x,y],"on_obstacle":[x,y],"dist":d,"part":0,"obstacle":"the block"}}, or null
///   swept       {"swept":true}: whether the motion hits, each part in a straight line
///   edge        {"edge":"free","clearance":c}, {"edge":"hit","free_until":s,"contact_at":s,"part":0,"obstacle":".."}
///               or {"edge":"unresolved","free_until":s,"gap":g,"reason":"tolerance"}, s in [0, 1] along the chart line
///   scan        {"ranges":[..]}, metres, ray k at bearing 2 pi k / n from the heading; "inf" where nothing is in range
///
/// With --input each line is either a configuration, [x, y, theta], or {"q": [..], "to": [..]}; blank lines are passed
/// over. Each gets its answer in the same order. A wrong one gets {"error": ".."}, the others their answers, and the
/// exit code is 3.
///
/// With --checker parry the book's black box answers, and every answer ends with "checker":"parry","proven":false.
///
/// With --certificate the proof of `edge` goes to a file, as JSON: the world's shapes, the robot, the motion, and the
/// steps [from, to, clearance] in which it is free, for other programs to check. Of a motion that hits it proves what
/// comes before.
// the words are the command's help, where brackets are JSON
#[allow(rustdoc::broken_intra_doc_links)]
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab query distance --robot rusty 3,5.5
  motion-lab query edge --robot reach 2.0,0 3.1,0 --certificate edge.json
  motion-lab query witness --robot Rusty --world apartment
  motion-lab query scan 3,5.5,0 --rays 8
  motion-lab query intersects --robot hitch --input poses.jsonl"
)]
pub struct Query {
    /// The question.
    question: Question,
    /// The configuration: numbers joined by commas, in metres and radians. [default: a resident's start]
    #[arg(value_name = "NUMBERS", allow_hyphen_values = true, conflicts_with = "input")]
    q: Option<NumberList>,
    /// Where the motion of `swept` or `edge` ends.
    #[arg(value_name = "TO", allow_hyphen_values = true)]
    to: Option<NumberList>,
    /// The robot: a resident of the world by its name, with the sizes that the world says; else one of a kind: rusty
    /// (the disc of radius 0.11 m: x,y or x,y,theta), reach (the two-link arm with 3 cm capsule links: th1,th2), choset
    /// (the same arm without thickness), reach3 (the three-link arm: th1,th2,th3), hitch (the car: x,y,theta; with the
    /// trailer x,y,theta,psi). `scan` needs none, its configuration is where the sensor is: x,y or x,y,theta.
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    robot: Option<String>,
    /// A built-in world or the path of a world file; the robot's home when left out.
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    world: Option<String>,
    /// Who answers. With parry, the book's black box, each answer says that it is not proven; it has no verdict on an
    /// edge and no certificate.
    #[arg(long, value_name = "CHECKER", value_parser = choices::checker(), default_value = "exact")]
    checker: CheckerName,
    /// Read the configurations from this file, `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Write the proof of `edge` to this file, as JSON.
    #[arg(long, value_name = "FILE", conflicts_with = "input")]
    certificate: Option<PathBuf>,
    /// The scan's number of rays, 1 to 100000.
    #[arg(long, default_value_t = 360)]
    rays: u32,
    /// The scan's greatest range, metres, 0.001 to 10000.
    #[arg(long, default_value_t = 4.0)]
    range: f64,
}

impl Query {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let desk = self.desk()?;
        let usage = |reason: String| Failure::usage(reason, "See `motion-lab query --help`.");
        let values = |numbers: &NumberList| match &desk.robot {
            Some(robot) => robot.values(numbers),
            // where the sensor of a scan is
            None => numbers.values(2),
        };
        let start = || desk.robot.as_ref().and_then(|robot| robot.start.clone());
        let q = match &self.q {
            Some(q) => Some(values(q).map_err(usage)?),
            None if self.input.is_some() => None,
            None => start(),
        };
        match (q, &self.input) {
            (Some(q), _) => {
                let to = self.to.as_ref().map(values).transpose().map_err(usage)?;
                let asked = QuerySubject { q, to };
                if let Some(path) = &self.certificate {
                    let target = Target::of(path)?;
                    let certificate = desk.certify(&asked).map_err(usage)?;
                    certificate.write(target, data)?;
                    data.json(&certificate.verdict)?;
                } else {
                    data.json(&desk.answer(&asked).map_err(usage)?)?;
                }
                Ok(Outcome::Done)
            }
            (None, Some(path)) if is_dash(path) => {
                read_stdin()?;
                desk.answer_all(&shown(path), io::stdin(), None, data)
            }
            (None, Some(path)) => {
                let file = open(path)?;
                let length = file.metadata().ok().filter(Metadata::is_file).map(|about| about.len());
                desk.answer_all(&shown(path), file, length, data)
            }
            (None, None) => Err(Failure::usage("no configuration", "Give its numbers, or --input FILE.")),
        }
    }

    fn desk(&self) -> Result<QuerySetup, Failure> {
        if self.robot.is_none() && self.question != Question::Scan {
            return Err(Failure::usage("no robot is named", format!("Add --robot with one of {}.", KINDS.join(", "))));
        }
        if self.certificate.is_some() && self.question != Question::Edge {
            return Err(Failure::usage(
                "only an edge has a certificate",
                "Ask `query edge`, or leave --certificate out.",
            ));
        }
        if self.question == Question::Edge && !self.checker.proves() {
            let reason = format!("the verdict on an edge is a proof, and {} proves nothing", self.checker.id());
            return Err(Failure::usage(reason, "Ask `query swept`, or leave --checker out."));
        }
        let sensor = RangeSensor::try_new(self.rays, self.range)
            .map_err(|error| Failure::usage(error, "Change --rays or --range."))?;
        let world = self.world.as_deref();
        let (robot, world) = match &self.robot {
            Some(name) => Chosen::in_world(name, world).map(|(robot, world)| (Some(robot), world))?,
            None => (None, find_world(world.unwrap_or("apartment"))?),
        };
        let scene = Arc::new(Scene::of_world(&world));
        let black_box = (!self.checker.proves()).then(|| Arc::new(ParryScene::of_scene(&scene)));
        let (question, checker) = (self.question, self.checker);
        Ok(QuerySetup { question, world: world.name, scene, checker, black_box, robot, sensor })
    }
}

/// Everything that stays the same from one configuration to the next.
struct QuerySetup {
    question: Question,
    /// The world's name.
    world: String,
    scene: Arc<Scene>,
    checker: CheckerName,
    /// Who answers instead of the scene.
    black_box: Option<Arc<ParryScene>>,
    robot: Option<Chosen>,
    sensor: RangeSensor,
}

#[derive(Serialize)]
struct WrongLine {
    error: String,
}

impl QuerySetup {
    fn answer(&self, asked: &QuerySubject) -> Result<QueryAnswer, String> {
        self.check(asked)?;
        let answer = match (self.question, &self.robot) {
            (Question::Scan, _) => ask_scan(&self.scene, self.black_box.as_deref(), &self.sensor, &asked.q),
            (question, Some(robot)) => {
                let (checker, q, to) = robot.checker(&self.scene, asked)?;
                let checker = match &self.black_box {
                    Some(black_box) => checker.with_black_box(Arc::clone(black_box)),
                    None => checker,
                };
                ask(&checker, question, &q, to.as_ref())
            }
            (_, None) => Err("no robot is named".into()),
        }?;
        Ok(QueryAnswer::new(answer, self.checker))
    }

    fn certify(&self, asked: &QuerySubject) -> Result<EdgeCertificate, String> {
        self.check(asked)?;
        let robot = self.robot.as_ref().ok_or("no robot is named")?;
        let (checker, q, to) = robot.checker(&self.scene, asked)?;
        EdgeCertificate::new(&self.world, &checker, &q, &to.ok_or("`to`, where the motion ends, is missing")?)
    }

    /// Checks that a motion's end is given to a question about a motion, and to no other.
    fn check(&self, asked: &QuerySubject) -> Result<(), String> {
        match (&asked.to, self.question.is_of_motion()) {
            (None, true) => Err("this question is about a motion and needs `to`, where it ends".into()),
            (Some(_), false) => Err("this question is about one configuration and takes no `to`".into()),
            _ => Ok(()),
        }
    }

    /// Answers every line of `reader`, whose `length` is in bytes; `None` where it is not known.
    fn answer_all(
        &self,
        name: &str,
        reader: impl io::Read,
        length: Option<u64>,
        data: &mut Data,
    ) -> Result<Outcome, Failure> {
        let progress = length.map_or_else(|| CommandProgress::uncounted("lines"), CommandProgress::of_bytes);
        let nothing = CommandProgress::none();
        let mut lines = Lines::new(progress::Read(reader, if length.is_some() { &progress } else { &nothing }));
        let mut wrong = 0_u64;
        while !data.is_closed() {
            // the other side may wait for the answers so far before it asks on
            if lines.would_wait() {
                data.flush()?;
            }
            let Some(line) = lines.next_line().map_err(|e| Failure::input(format!("{name}: {e}"), "Try again."))?
            else {
                break;
            };
            if length.is_none() {
                progress.step();
            }
            let answer = line.text.and_then(|text| match text.trim() {
                "" => Ok(None),
                text => self.answer(&parse_line(text)?).map(Some),
            });
            match answer {
                Ok(None) => {}
                Ok(Some(answer)) => data.json(&answer)?,
                Err(error) => {
                    wrong += 1;
                    if wrong <= MESSAGES {
                        say(format!("{name}:{}: {error}", line.number));
                    }
                    data.json(&WrongLine { error: format!("line {}: {error}", line.number) })?;
                }
            }
        }
        if wrong > MESSAGES {
            say(format!("{name}: {wrong} wrong lines in all"));
        }
        Ok(if wrong == 0 { Outcome::Done } else { Outcome::BadInput })
    }
}
