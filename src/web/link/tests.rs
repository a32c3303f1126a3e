//! Links read back as written, whatever is in them; hostile ones are refused by name.

mod anatomy;
mod digits;
mod plan;

use percent_encoding::utf8_percent_encode;

use super::cited::requoted;
use super::limits::{ESCAPED, MAX_NAME};
use super::*;
use motion_lab_core::worlds::Resident;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::run::{Event, Quantized, RobotInput, WorldChange, WorldEvent};

fn driven() -> Script {
    let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
    let events = vec![
        event(1, "Rusty", RobotInput::Drive(128, -64)),
        event(9, "Reach", RobotInput::MoveTo(vec![Quantized(1 << 20), Quantized(-7)])),
        event(9, "Hitch", RobotInput::SetTrailer(true)),
        event(30, "Rusty", RobotInput::Release),
    ];
    Script::new(events, vec![])
}

fn built_in(names: &[&str]) -> Vec<World> {
    names.iter().map(|name| World::built_in(name).unwrap()).collect()
}

#[test]
fn a_link_reads_back_as_it_was_written() {
    let link = Link {
        seed: Seed(u64::MAX),
        worlds: built_in(&["lot", "workbench"]),
        sensor: TourConfig::default().sensor,
        tick: 600,
        widget: Some(Widget::Atlas),
        lesson: Some(Lesson::of("pick_wall").unwrap()),
        anatomy: LinkedAnatomy {
            tab: Some(Tab::Witness),
            q: vec![-0.5, 1e-9, 3.0],
            step: vec![0.1 + 0.2, -0.0],
            thick: true,
        },
        plan: Some(LinkedPlan { lies: true, ..LinkedPlan::in_world("apartment", "Rusty") }),
        theme: Some(ThemeChoice::Dark),
        script: driven(),
        digest: Some("0123456789abcdef0123456789abcdef".into()),
    };
    let query = link.query().unwrap();
    assert!(query.bytes().all(|b| b.is_ascii_graphic() && !b"\"<>[]{}|\\^`#".contains(&b)), "{query}");
    assert_eq!(Link::parse(&query).unwrap(), link);
    assert_eq!(Link::parse(&format!("?{query}&utm=mail&x")).unwrap(), link, "other fields are ignored");
    assert_eq!(Link::parse("").unwrap(), Link::default());
    assert_eq!(Link::parse(&Link::default().query().unwrap()).unwrap(), Link::default());
    assert_eq!(link.recipe().config.worlds.iter().map(|w| w.name.as_str()).collect::<Vec<_>>(), ["Lot", "Workbench"]);
}

#[test]
fn a_link_holds_the_doors_that_were_closed() {
    let change = WorldChange::Close("door A".into());
    let script = Script::new(vec![], vec![WorldEvent { tick: 3, world: "Apartment".into(), change }]);
    let link = Link { script: script.clone(), tick: 9, ..Link::default() };
    assert_eq!(Link::parse(&link.query().unwrap()).unwrap().script, script);
}

#[test]
fn a_run_becomes_the_link_that_runs_it_again() {
    let config = TourConfig { ticks: 77, ..TourConfig::default() };
    let recipe = Recipe::new(config.clone(), (Seed(3), driven()));
    let link = Link::of(&recipe).unwrap();
    assert_eq!(link.recipe(), recipe);
    let lot = Link { worlds: built_in(&["lot"]), tick: 5, ..Link::default() };
    assert_eq!(Link::of(&lot.recipe()).unwrap(), lot);
    let long = TourConfig { ticks: MAX_LINK_TICK + 1, ..config };
    assert!(matches!(Link::of(&Recipe::new(long, Seed(3))), Err(LinkError::Number { field: "tick", .. })));
}

#[test]
fn a_run_of_worlds_and_a_sensor_of_its_own_fits_in_an_address() {
    let mut config = TourConfig { ticks: 77, ..TourConfig::default() };
    assert!(Link::of(&Recipe::new(config.clone(), Seed(3))).unwrap().query().unwrap().starts_with("v=1&seed=3&tick"));
    config.sensor = Some(RangeSensor { n_rays: 7, max_range: 0.1 + 0.2 });
    let seven = Link::of(&Recipe::new(config.clone(), Seed(3))).unwrap();
    assert_eq!(seven.query().unwrap(), "v=3&seed=3&sensor=7,0.30000000000000004&tick=77");
    // a path of the plan is played by a robot alone in its world, which sees nothing
    config.worlds[1].robots.clear();
    config.sensor = None;
    let recipe = Recipe::new(config, (Seed(3), driven()));
    let link = Link::of(&recipe).unwrap();
    let query = link.query().unwrap();
    assert!(query.starts_with("v=3&seed=3&file=World(%0A") && query.contains("&sensor=none&"), "{query}");
    for read in [Link::parse(&query).unwrap(), Link::parse(&format!("#{query}")).unwrap()] {
        assert_eq!(read.recipe(), recipe);
    }
    // a single world, and in another order than theirs
    let worlds = recipe.config.worlds.iter().rev().cloned().collect();
    let turned = Recipe::new(TourConfig { worlds, ..TourConfig::clone(&recipe.config) }, Seed(3));
    assert_eq!(Link::parse(&Link::of(&turned).unwrap().query().unwrap()).unwrap().recipe(), turned);
}

#[test]
fn a_name_in_a_link_is_too_short_for_a_sentence() {
    let named = |length: usize| {
        let mut world = World::built_in("lot").unwrap();
        world.obstacles[0].name = "x".repeat(length);
        world
    };
    let of = |world: World| Recipe::new(TourConfig { worlds: vec![world], ..TourConfig::default() }, Seed(1));
    let longest = Link::of(&Recipe {
        config: TourConfig { ticks: 1, ..TourConfig::clone(&of(named(MAX_NAME)).config) }.into(),
        ..of(named(MAX_NAME))
    })
    .unwrap();
    assert_eq!(Link::parse(&longest.query().unwrap()).unwrap(), longest);
    let said = "the name \"xxxxxxxxxxxx...\" has more than 32 characters, or marks of direction: it is one for a file";
    assert_eq!(Link::of(&of(named(MAX_NAME + 1))).unwrap_err().to_string(), said);
    let forged = utf8_percent_encode(&named(MAX_NAME + 1).to_ron(), ESCAPED).to_string();
    assert_eq!(Link::parse(&format!("v=3&file={forged}")).unwrap_err().to_string(), said);
}

#[test]
fn an_added_obstacle_and_marks_of_direction_are_names_too() {
    let change = |name: &str| {
        let points = vec![(Quantized(3 << 20), Quantized(4 << 20))];
        let change = WorldChange::Add { name: name.into(), points, radius: Quantized(104_858) };
        Script::new(vec![], vec![WorldEvent { tick: 1, world: "Lot".into(), change }])
    };
    let of = |name: &str| {
        let config = TourConfig { worlds: built_in(&["lot"]), ticks: 1, ..TourConfig::default() };
        Link::of(&Recipe::new(config, (Seed(1), change(name))))
    };
    assert!(of("a post").is_ok());
    for scam in ["Your session has expired, sign in at evil.example", "a \u{202e}post", "a\u{200b}post"] {
        assert!(matches!(of(scam), Err(LinkError::Name(_))), "{scam}");
        let query = format!("v=1&world=lot&script={}", utf8_percent_encode(&change(scam).to_line(), ESCAPED));
        assert!(matches!(Link::parse(&query), Err(LinkError::Name(_))), "{scam}");
    }
}

/// Whoever opens a link waits until its run has come to its tick.
#[test]
fn a_link_is_no_endless_work() {
    let said = |query: &str| Link::parse(query).unwrap_err().to_string();
    assert!(
        said("v=3&sensor=100000,10000&tick=72000").contains("too much work for a link, 72"),
        "an hour of 10^5 rays"
    );
    let mut lot = World::built_in("lot").unwrap();
    let rover = World::built_in("apartment").unwrap().robots[0].clone();
    lot.robots = (0..400).map(|i| Resident { name: format!("r{i}"), ..rover.clone() }).collect();
    let config = |worlds, ticks, n_rays| {
        let sensor = Some(RangeSensor { n_rays, max_range: 4.0 });
        Recipe::new(TourConfig { worlds, ticks, sensor }, Seed(1))
    };
    // at tick 0 it is played, which would be two seconds a tick
    assert!(matches!(Link::of(&config(vec![lot.clone()], 1, 99_000)), Err(LinkError::Work { .. })));
    // by hand: each of the 400 has 1,000 rays, the 400 robots and the Lot's six obstacles, in each of a minute's ticks
    let refused = Link::of(&config(vec![lot.clone()], 1, 1000)).err();
    assert_eq!(refused, Some(LinkError::Work { work: 400 * (1000 + 400 + 6) * 1200 }));
    assert!(Link::of(&config(vec![lot], 1, 100)).is_ok(), "a crowd that a browser can play");
    // the longest link of the tour is a tenth of what may be
    let usual = TourConfig::default();
    let hour = Recipe::new(TourConfig { ticks: MAX_LINK_TICK, ..usual }, Seed(1));
    assert!(Link::of(&hour).is_ok());
}

#[test]
fn a_wrong_field_of_what_to_show_costs_no_run_and_a_wrong_run_not_what_to_show() {
    let ReadLink { link, run, view } = Link::read("seed=11&widget=moon&tab=swept&theme=pink&lesson=pick_wall&q=1;2");
    assert_eq!((run, link.seed), (Ok(()), Seed(11)));
    assert_eq!(view.unwrap_err().to_string().split(": ").next(), Some("widget"), "the first that is wrong");
    let anatomy = LinkedAnatomy { tab: Some(Tab::Swept), ..LinkedAnatomy::default() };
    assert_eq!((link.widget, link.anatomy, link.theme), (None, anatomy, None));
    assert_eq!(link.lesson, Lesson::of("pick_wall"));
    // half a run would be another one
    let ReadLink { link, run, view } = Link::read("seed=11&tick=9x&widget=atlas&theme=dark");
    assert_eq!((link.seed, link.tick, view), (BOOK_SEED, 0, Ok(())));
    assert!(run.unwrap_err().to_string().starts_with("tick: "));
    assert_eq!((link.widget, link.theme), (Some(Widget::Atlas), Some(ThemeChoice::Dark)));
}

#[test]
fn long_links_hold_a_thousand_inputs_and_short_ones_are_read_by_every_version() {
    let drive = |tick: u64| RobotInput::Drive((tick % 257) as i16 - 128, 128 - (tick * 31 % 257) as i16);
    let events = (1..=1000).map(|tick| Event { tick, robot: "Rusty".into(), input: drive(tick) });
    let change = WorldChange::Close("door A".into());
    let changes = vec![WorldEvent { tick: 3, world: "Apartment".into(), change }];
    let driven = Link { script: Script::new(events.collect(), changes), tick: 1000, ..Link::default() };
    let query = driven.query().unwrap();
    assert!(query.starts_with("v=2&") && query.len() < 8000, "{} bytes, which servers take", query.len());
    assert_eq!(Link::parse(&query).unwrap(), driven);
    // an arm that is dragged about, at every tick for fifty seconds
    let at = |tick: u64| vec![Quantized((tick * tick * 1999 % 3_000_017) as i64), Quantized(-(tick as i64) * 40_000)];
    let events = (1..=1000).map(|tick| Event { tick, robot: "Reach".into(), input: RobotInput::MoveTo(at(tick)) });
    let dragged = Link { script: Script::new(events.collect(), vec![]), tick: 1000, ..Link::default() };
    assert_eq!(Link::parse(&format!("#{}", dragged.query().unwrap())).unwrap(), dragged);
    let few = Link { script: self::driven(), ..Link::default() };
    assert!(few.query().unwrap().starts_with("v=1&") && few.query().unwrap().contains("script=Script(version:1"));
}

#[test]
fn hostile_values_are_refused_by_name() {
    let said = |query: &str| Link::parse(query).unwrap_err().to_string();
    assert_eq!(said("v=4&seed=x"), "v: this lab reads links of versions 1 to 3, not \"4\"");
    for wrong in ["7", "7,x", "-1,4", "7,4,4", "None", ""] {
        assert!(
            said(&format!("sensor={wrong}")).starts_with("sensor: it must be none, or a number of rays"),
            "{wrong}"
        );
    }
    assert!(said("file=World(").starts_with("file: line:1:"), "{}", said("file=World("));
    assert!(said("seed=-1").starts_with("seed: it must be a whole number up to 1844"));
    assert!(said("seed=18446744073709551616").ends_with("not \"184467440737...\""));
    assert_eq!(said("tick=72001"), "tick: it must be a whole number up to 72000, not \"72001\"");
    assert_eq!(said("tick=%2B1"), "tick: it must be a whole number up to 72000, not \"+1\"");
    assert_eq!(said("world=moon"), "world: it must be one of apartment, workbench, lot, not \"moon\"");
    assert!(said("world=lot,lot").contains("one of"), "a world comes once");
    assert!(said("widget=%3Cscript%3E").starts_with("widget: it must be one of dashboard"));
    assert_eq!(said("lesson=Near"), "lesson: no lesson has the id \"Near\"");
    assert_eq!(said("theme=pink"), "theme: it must be one of system, light, dark, not \"pink\"");
    assert_eq!(said("digest=12"), "digest: it must be 32 hexadecimal digits, not \"12\"");
    assert_eq!(said("script=%FF"), "script: not valid UTF-8");
    assert_eq!(Link::parse("other=%FF").unwrap(), Link::default(), "a page's own field");
    assert_eq!(said("inputs=%21"), "inputs: they make no sense at byte 0");
    assert_eq!(said("inputs=AQFSAQc"), "inputs: they make no sense at byte 5");
    let script = "Script(version:1,events:[(tick:1,robot:\"Rusty\",input:Drive(129,0))])";
    let query = format!("script={}", utf8_percent_encode(script, ESCAPED));
    assert_eq!(said(&query), "script: line:1: events[0]: channel 129: it must be in -128 to 128");
    let drive = Event { tick: 1, robot: "Rusty".into(), input: RobotInput::Drive(129, 0) };
    let query = format!("v=2&inputs={}", inputs::encode(&[drive]).unwrap());
    assert_eq!(said(&query), "script: line:1: events[0]: channel 129: it must be in -128 to 128");
    assert!(matches!(Link::parse(&"x".repeat(MAX_LINK + 1)), Err(LinkError::TooLong(_))));
    let events = (1..12_000).map(|tick| Event { tick, robot: "Rusty".into(), input: RobotInput::Release });
    let long = Link { script: Script::new(events.collect(), vec![]), ..Link::default() };
    assert!(long.query().unwrap_err().to_string().ends_with("save the run as a file instead"));
}

/// A link is written by whoever wants to be believed.
#[test]
fn a_refusal_says_nothing_in_the_words_of_the_link() {
    let scam = "Your session has expired, sign in at evil.example";
    for field in
        ["v", "seed", "tick", "world", "file", "sensor", "widget", "lesson", "theme", "script", "inputs", "digest"]
    {
        let query = format!("{field}={}", utf8_percent_encode(scam, ESCAPED));
        let said = Link::parse(&query).unwrap_err().to_string();
        assert!(said.starts_with(&format!("{field}: ")), "{said}");
        assert!(!said.contains("expired") && said.chars().count() < 140, "{said}");
    }
    let script = format!(
        "Script(version:1,events:[(tick:1,robot:\"Rusty\",input:MoveTo([])),(tick:0,robot:{scam:?},input:Release)])"
    );
    let said = Link::parse(&format!("script={}", utf8_percent_encode(&script, ESCAPED))).unwrap_err().to_string();
    assert!(said.starts_with("script: line:1: ") && !said.contains("expired"), "{said}");
    assert_eq!(requoted(&format!("robot {scam:?} and \"Reach\"")), "robot \"Your session...\" and \"Reach\"");
    let quoted = format!("robot {:?} and `{scam}` and \"open {scam}", format!("x\" {scam} \"y"));
    assert_eq!(requoted(&quoted), "robot \"x\\\" Your ses...\" and `Your session...` and \"open Your se...");
    let rows = format!("v={}", utf8_percent_encode("a\nb\u{202e}c", ESCAPED));
    assert!(Link::parse(&rows).unwrap_err().to_string().ends_with(r#"not "a\nb\u{202e}c""#));
    let long = format!("script={}", "Your(session)".repeat(99));
    assert!(Link::parse(&long).unwrap_err().to_string().chars().count() < 140);
}

#[test]
fn a_link_may_ask_query_and_names_what_it_can_not() {
    let link = Link::parse("tab=swept&q=0,-1.5").unwrap();
    assert_eq!((link.anatomy.tab, link.anatomy.q), (Some(Tab::Swept), vec![0.0, -1.5]));
    for text in ["", "1,", "one", "inf,0", "NaN", "1;2", &["0"; 17].join(",")] {
        let refused = Link::parse(&format!("q={text}")).unwrap_err().to_string();
        assert!(refused.starts_with("q: it must be up to 16 numbers"), "{refused}");
    }
    let refused = Link::parse("tab=nearest").unwrap_err().to_string();
    assert_eq!(refused, "tab: it must be one of intersects, distance, witness, swept, not \"nearest\"");
    assert_eq!(Link::parse(&format!("q={}", ["0"; 16].join(","))).unwrap().anatomy.q.len(), 16);
}
