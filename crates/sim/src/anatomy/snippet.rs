//! The question on the screen as code and as a command, to be copied.

use std::fmt::Write;

use super::{Anatomy, Tab, WorldSource};
use motion_lab_core::collision::Collision;
use motion_lab_core::configuration::{AnyConfiguration, Configuration, HitchCfg, Tn};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::robots::{AnyRobot, HITCH, Hitch, RUSTY, Reach};

impl Anatomy {
    /// A program that asks the tab's question, prints the answer, and panics if it differs from the answer shown. The
    /// numbers are the same to the last bit on every machine. The program compiles against this library as it is, and
    /// contains a world that is not built in.
    pub fn copy_as_rust(&self) -> String {
        let mut code =
            String::from("use motion_lab::collision::{Checker, Collision, Scene};\nuse motion_lab::prelude::*;\n");
        let scene = match self.source() {
            WorldSource::BuiltIn(name) => format!("Scene::{name}()"),
            _ => {
                code.push_str("use motion_lab::worlds::World;\n");
                "Scene::of_world(&World::parse(\"world.ron\", WORLD)?)".to_owned()
            }
        };
        // writing to a String never fails
        let _ = write!(
            code,
            "\nfn main() -> Result<(), Box<dyn std::error::Error>> {{\n    let checker = Checker::new({scene}, {});\n    \
             let q = {};\n",
            robot_code(self.checker().robot()),
            configuration_code(&self.q()),
        );
        code.push_str(&self.question_code());
        code.push_str("    Ok(())\n}\n");
        if !matches!(self.source(), WorldSource::BuiltIn(_)) {
            let _ = write!(code, "\nconst WORLD: &str = {};\n", raw_string(&self.world().to_ron()));
        }
        code
    }

    fn question_code(&self) -> String {
        const FOOTPRINT: &str = "    let footprint = checker.robot().footprint(&q);\n";
        match self.tab {
            Tab::Intersects => format!(
                "{FOOTPRINT}    let intersects = checker.scene().intersects(&footprint);\n    \
                 println!(\"intersects: {{intersects}}\");\n    assert!({}intersects);\n",
                if self.intersects() { "" } else { "!" }
            ),
            Tab::Distance => format!(
                "{FOOTPRINT}    let distance = checker.scene().distance(&footprint);\n    \
                 println!(\"distance: {{distance}} m\");\n    assert_eq!(distance, {});\n",
                number(self.distance())
            ),
            Tab::Witness => match self.checker().scene().witness(&self.footprint()) {
                None => format!(
                    "{FOOTPRINT}    let witness = checker.scene().witness(&footprint);\n    \
                     println!(\"witness: {{witness:?}}\");\n    assert_eq!(witness, None);\n"
                ),
                Some(w) => format!(
                    "{FOOTPRINT}    let w = checker.scene().witness(&footprint).ok_or(\"nothing is there\")?;\n    \
                     println!(\"a* = {{}} on part {{}}\", w.on_robot, w.part);\n    \
                     println!(\"b* = {{}} on {{:?}}\", w.on_obstacle, checker.scene().obstacle_name(w.obstacle));\n    \
                     println!(\"distance: {{}} m\", w.dist);\n    \
                     assert_eq!(w.on_robot, Point2::new({}, {}));\n    \
                     assert_eq!(w.on_obstacle, Point2::new({}, {}));\n    \
                     assert_eq!(w.dist, {});\n",
                    number(w.on_robot.x),
                    number(w.on_robot.y),
                    number(w.on_obstacle.x),
                    number(w.on_obstacle.y),
                    number(w.dist),
                ),
            },
            Tab::Swept => {
                let verdict = self.checker().edge(&self.q(), &self.second());
                let verdict = verdict.map_or_else(|error| error.to_string(), |v| format!("{v:?}"));
                format!(
                    "    let to = {};\n    let verdict = checker.edge(&q, &to)?;\n    println!(\"{{verdict:?}}\");\n    \
                     assert_eq!(\n        format!(\"{{verdict:?}}\"),\n        {verdict:?}\n    );\n    \
                     let (a, b) = (checker.robot().footprint(&q), checker.robot().footprint(&to));\n    \
                     println!(\"swept: {{}}\", checker.scene().swept(&a, &b));\n",
                    configuration_code(&self.second()),
                )
            }
        }
    }

    /// The command for the tab's question, with every digit; the swept tab's is `query edge`. `None` for an unsaved
    /// world, and for a robot that is neither the lab's nor a resident of the world, which no command can name.
    pub fn copy_as_command(&self) -> Option<String> {
        let resident = self.resident().map(|r| (quoted(&r.name), ""));
        let (robot, home) = match resident.or_else(|| self.named_by_kind())? {
            // a resident of a kind's name would be asked instead
            (robot, _) if self.world().robots.iter().any(|r| r.name == robot && !self.is_resident(r)) => return None,
            found => found,
        };
        let world = match self.source() {
            WorldSource::BuiltIn(name) if *name == home => String::new(),
            WorldSource::BuiltIn(name) => format!(" --world {name}"),
            WorldSource::File(path) => format!(" --world {}", quoted(path)),
            WorldSource::Unsaved => return None,
        };
        let question = if self.tab == Tab::Swept { "edge" } else { self.tab.name() };
        let to = if self.tab == Tab::Swept { format!(" {}", numbers(&self.second())) } else { String::new() };
        Some(format!("motion-lab query {question} --robot {robot}{world} {}{to}", numbers(&self.q())))
    }

    /// The name by which commands know a robot of its kind's own sizes, and the built-in world it lives in.
    fn named_by_kind(&self) -> Option<(String, &'static str)> {
        let (robot, q) = (self.checker().robot(), self.q());
        let about = robot.about();
        let own = AnyRobot::model(about.name, None)?.fitted(&q);
        let bare = AnyRobot::Reach(Reach::choset());
        let name = if *robot == bare { Some("choset") } else { (*robot == own).then_some(about.name) };
        Some((name?.to_owned(), about.home?))
    }
}

/// An `f64` as code: the fewest digits that give the same bits back.
fn number(x: f64) -> String {
    if x == f64::INFINITY { "f64::INFINITY".into() } else { format!("{x:?}") }
}

/// A configuration's coordinates joined by commas.
fn numbers(q: &AnyConfiguration) -> String {
    q.coordinates().iter().map(|x| number(*x)).collect::<Vec<_>>().join(",")
}

fn robot_code(robot: &AnyRobot) -> String {
    let arm = |base: motion_lab_core::geometry::Point2, lengths: &[f64], radius: f64| {
        let lengths = lengths.iter().map(|l| number(*l)).collect::<Vec<_>>().join(", ");
        let (x, y) = (number(base.x), number(base.y));
        format!("Reach {{ base: Point2::new({x}, {y}), lengths: [{lengths}], link_radius: {} }}", number(radius))
    };
    match robot {
        AnyRobot::Rusty(rusty) if *rusty == RUSTY => "RUSTY".into(),
        AnyRobot::Rusty(rusty) => format!(
            "Rusty {{ body_radius: {}, track: {}, wheel_radius: {}, ..RUSTY }}",
            number(rusty.body_radius),
            number(rusty.track),
            number(rusty.wheel_radius)
        ),
        AnyRobot::Reach(r) if *r == Reach::choset() => "Reach::<2>::choset()".into(),
        AnyRobot::Reach(r) if *r == Reach::workbench() => "Reach::<2>::workbench()".into(),
        AnyRobot::Reach(r) => arm(r.base, &r.lengths, r.link_radius),
        AnyRobot::Reach3(r) if *r == Reach::redundant() => "Reach::<3>::redundant()".into(),
        AnyRobot::Reach3(r) => arm(r.base, &r.lengths, r.link_radius),
        AnyRobot::Hitch(car) if *car == HITCH.with_trailer() => "HITCH.with_trailer()".into(),
        AnyRobot::Hitch(car) if *car == HITCH => "HITCH".into(),
        AnyRobot::Hitch(car) => car_code(car),
    }
}

fn car_code(car: &Hitch) -> String {
    let (body, towed) = (car.body, car.trailer_body);
    let jackknife =
        car.jackknife.map_or(String::new(), |limit| format!("\n        jackknife: Some({}),", number(limit)));
    let hitch_len = car.hitch_len.map_or("None".into(), |length| format!("Some({})", number(length)));
    format!(
        "Hitch {{\n        wheelbase: {},\n        max_steer: {},\n        \
         body: motion_lab::robots::CarBody {{ length: {}, width: {}, rear_overhang: {} }},\n        \
         trailer_body: motion_lab::robots::TrailerBody {{ front_overhang: {}, rear_overhang: {}, width: {} }},\n        \
         hitch_len: {hitch_len},{jackknife}\n        ..HITCH\n    }}",
        number(car.wheelbase),
        number(car.max_steer),
        number(body.length),
        number(body.width),
        number(body.rear_overhang),
        number(towed.front_overhang),
        number(towed.rear_overhang),
        number(towed.width),
    )
}

fn configuration_code(q: &AnyConfiguration) -> String {
    let pose = |p: &Pose2| format!("Pose2 {{ x: {}, y: {}, theta: {} }}", number(p.x), number(p.y), number(p.theta));
    match q {
        AnyConfiguration::Pose(p) => pose(p),
        AnyConfiguration::T2(Tn([a, b])) => format!("T2::new({}, {})", number(*a), number(*b)),
        AnyConfiguration::T3(Tn([a, b, c])) => format!("Tn([{}, {}, {}])", number(*a), number(*b), number(*c)),
        AnyConfiguration::Hitch(HitchCfg { body, trailer }) => {
            let trailer = trailer.map_or("None".into(), |psi| format!("Some({})", number(psi)));
            format!("HitchCfg {{ body: {}, trailer: {trailer} }}", pose(body))
        }
    }
}

/// A text as a raw string of Rust, with as many `#` as it needs.
fn raw_string(text: &str) -> String {
    let mut fence = "#".to_owned();
    while text.contains(&format!("\"{fence}")) {
        fence.push('#');
    }
    format!("r{fence}\"{text}\"{fence}")
}

/// A path as one word of a shell.
fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '/' | '.' | '_' | '-');
    if !path.is_empty() && !path.starts_with('-') && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_and_paths_stay_whole() {
        assert_eq!(raw_string("a"), "r#\"a\"#");
        assert_eq!(raw_string("say \"#no\"#"), "r##\"say \"#no\"#\"##");
        assert_eq!(quoted("maps/a.ron"), "maps/a.ron");
        assert_eq!(quoted("my map's.ron"), r"'my map'\''s.ron'");
        assert_eq!(quoted("-x"), "'-x'");
    }

    #[test]
    fn commands_name_robot_and_world() {
        let mut anatomy = Anatomy::default().with_tab(Tab::Swept);
        let command = anatomy.copy_as_command().unwrap();
        let expected = "motion-lab query edge --robot choset 0.7853981633974483,1.5707963267948966 \
                        -0.7853981633974483,1.5707963267948966";
        assert_eq!(command, expected);
        anatomy.set_thick_links(true);
        assert!(anatomy.with_tab(Tab::Distance).copy_as_command().unwrap().contains("query distance --robot reach "));
        assert_eq!(Anatomy::exercise_3().copy_as_command(), None, "its world is in no file");
    }
}
