use super::*;

const GOOD: &str = "// a drive\nScript(version: 1, events: [\n  (tick: 1, robot: \"Rusty\", input: Drive(128, -128)),\n\n  \
    // the arm\n  (tick: 1, robot: \"Reach\",\n   input: MoveTo([1048576, -5])),\n  (robot: \"a \\\"b\\\" \\u{e9}\\t\\\\\", \
    input: Teleport([0]), tick: 7), (tick: 7, robot: \"Hitch\", input: SetTrailer(true)),\n  \
    (tick: 4294967296, robot: \"Hitch\", input: Release)])";

fn refused(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    Script::parse("s.ron", &GOOD.replacen(from, to, 1)).unwrap_err().to_string()
}

#[test]
fn a_script_is_read_and_its_text_gives_it_back() {
    let script = Script::parse("s.ron", GOOD).unwrap();
    assert_eq!(script.events.len(), 5);
    let quantized = vec![Quantized(1 << 20), Quantized(-5)];
    assert_eq!(script.events[1], Event { tick: 1, robot: "Reach".into(), input: RobotInput::MoveTo(quantized) });
    assert_eq!(script.events[2].robot, "a \"b\" é\t\\");
    let text = script.to_ron();
    assert_eq!(Script::parse("again", &text).unwrap(), script);
    assert_eq!(Script::parse("again", &text).unwrap().to_ron(), text);
    assert_eq!(Script::parse("empty", &Script::empty().to_ron()).unwrap(), Script::empty());
    script.check().unwrap();
    // the derived form is read as well
    assert_eq!(Script::parse("serde", &ron::to_string(&script).unwrap()).unwrap(), script);
}

#[test]
fn names_of_every_sort_survive() {
    for name in ["", "\u{0}\u{1}\u{7f}", "\r\n", "'", "\u{301}e\u{202e}", "\u{10ffff}", "// no", "r#\"", "🤖"] {
        let event = Event { tick: 1, robot: name.into(), input: RobotInput::Release };
        let script = Script::new(vec![event], vec![]);
        assert_eq!(Script::parse("s", &script.to_ron()).as_ref(), Ok(&script), "{}", script.to_ron());
    }
}

#[test]
fn errors_name_file_line_event_and_reason() {
    assert_eq!(refused("-128", "-129"), "s.ron:3: events[0]: channel -129: it must be in -128 to 128");
    assert_eq!(refused("Drive(128", "Drive(129"), "s.ron:3: events[0]: channel 129: it must be in -128 to 128");
    assert!(refused("Drive(128", "Drive(32768").starts_with("s.ron:3: events[0]: "), "does not fit i16");
    assert!(refused("Drive(128", "Drive(-32768").ends_with("channel -32768: it must be in -128 to 128"));
    assert_eq!(refused("tick: 1,", "tick: 0,"), "s.ron:3: events[0]: tick 0: it must be in 1 to 4294967296");
    assert_eq!(refused("tick: 1,", "tick: 2,"), "s.ron:6: events[1]: tick 1 comes after tick 2: ticks must ascend");
    assert_eq!(
        refused("4294967296", "4294967297"),
        "s.ron:9: events[4]: tick 4294967297: it must be in 1 to 4294967296"
    );
    let most = 10_000_i64 << 20;
    assert!(Script::parse("s", &GOOD.replace("1048576", &(-most).to_string())).is_ok());
    assert_eq!(
        refused("1048576", &(-most - 1).to_string()),
        "s.ron:6: events[1]: coordinate -10485760001 (in units of 2^-20): its size must be at most 10000 m or rad"
    );
    assert!(refused("1048576", "-9223372036854775808").contains("coordinate -9223372036854775808"));
    assert_eq!(refused("[0]", "[]"), "s.ron:8: events[2]: 0 coordinates: there must be 1 to 64");
    assert!(refused("[0]", &format!("{:?}", [0; 65])).contains("65 coordinates"));
    assert!(refused("1048576", "0.5").starts_with("s.ron:7: events[1]: "), "the line within the event");
    assert!(refused("SetTrailer(true)", "SetTrailer(1)").starts_with("s.ron:8: events[3]: "));
    assert!(refused("Release", "Explode").starts_with("s.ron:9: events[4]: "));
    assert!(refused("tick: 7)", "tick: 7, mood: 1)").contains("mood"));
    assert!(refused("version: 1,", "version: 1, mood: 2,").contains("mood"));
    assert_eq!(refused("version: 1", "version: 3"), "s.ron:2: version 3: this program reads versions 1 and 2");
    assert!(refused("version: 1,", "").starts_with("s.ron:"), "no version");
    assert!(refused("events: [", "events: ").starts_with("s.ron:"));
    assert!(Script::parse("s.ron", "").is_err());
    assert!(Script::parse("s.ron", &"(".repeat(100_000)).is_err(), "deep nesting is an error, not a crash");
    assert!(Script::parse("s.ron", &GOOD.replace("[0]", &"[".repeat(100_000))).is_err());
}

#[test]
fn unknown_robots_are_named_with_their_event() {
    let script = Script::parse("s.ron", GOOD).unwrap();
    let all = ["Hitch", "Reach", "Rusty", "a \"b\" é\t\\"];
    assert_eq!(script.check_robots(&all), Ok(()));
    assert_eq!(script.check_robots(&all[1..]).unwrap_err().to_string(), "events[3]: there is no robot \"Hitch\"");
}

#[test]
fn a_check_against_a_world_names_line_event_tick_robot_and_kind() {
    let config = crate::tour::TourConfig::default();
    let check = |input: &str| {
        let text =
            format!("Script(version: 1, events: [\n  (tick: 4, robot: \"Rusty\", input: Release),\n\n  {input}\n])");
        let script = Script::parse("s.ron", &text).unwrap();
        script.check_for(&config).map_err(|error| error.located("s.ron", &text).to_string())
    };
    for (input, refused) in [
        (
            "(tick: 7, robot: \"Rusty\", input: MoveTo([0, 0, 0])),",
            "\"Rusty\" is a rusty and takes no MoveTo: it takes Drive, Teleport and Release",
        ),
        (
            "(tick: 7, robot: \"Rusty\", input: SetTrailer(true)),",
            "\"Rusty\" is a rusty and takes no SetTrailer: it takes Drive, Teleport and Release",
        ),
        (
            "(tick: 7, robot: \"Hitch\", input: MoveTo([0, 0, 0])),",
            "\"Hitch\" is a hitch and takes no MoveTo: it takes Drive, Teleport, SetTrailer and Release",
        ),
        (
            "(tick: 7, robot: \"Reach\", input: Drive(1, 1)),",
            "\"Reach\" is a reach and takes no Drive: it takes MoveTo, Teleport and Release",
        ),
        (
            "(tick: 7, robot: \"Reach\", input: SetTrailer(false)),",
            "\"Reach\" is a reach and takes no SetTrailer: it takes MoveTo, Teleport and Release",
        ),
    ] {
        assert_eq!(check(input), Err(format!("s.ron:4: events[1]: tick 7: robot {refused}")));
    }
    for (robot, input, refused) in [
        ("Reach", "MoveTo([0, 0, 0])", "MoveTo of robot \"Reach\" has 3 coordinates: a reach has 2"),
        ("Rusty", "Teleport([0, 0])", "Teleport of robot \"Rusty\" has 2 coordinates: a rusty has 3"),
        ("Hitch", "Teleport([0, 0])", "Teleport of robot \"Hitch\" has 2 coordinates: a hitch has 3 or 4"),
    ] {
        let event = format!("(tick: 9, robot: \"{robot}\", input: {input}),");
        assert_eq!(check(&event), Err(format!("s.ron:4: events[1]: tick 9: {refused}")));
    }
    for (robot, input) in [
        ("Rusty", "Drive(1, 1)"),
        ("Rusty", "Teleport([0, 0, 0])"),
        ("Reach", "MoveTo([0, 0])"),
        ("Reach", "Release"),
        ("Hitch", "SetTrailer(true)"),
        ("Hitch", "Teleport([0, 0, 0, 0])"),
    ] {
        assert_eq!(check(&format!("(tick: 9, robot: \"{robot}\", input: {input}),")), Ok(()), "{robot} {input}");
    }
    let unknown = check("(tick: 9, robot: \"Anna\", input: Release),").unwrap_err();
    assert_eq!(unknown, "s.ron:4: events[1]: there is no robot \"Anna\"");
}

/// Pairwise this would take ten thousand million comparisons.
#[test]
fn a_hundred_thousand_names_are_looked_up_not_compared_with_one_another() {
    let names: Vec<String> = (0..100_000).map(|i| format!("a robot with the number {i:06}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let event = |name: &&str| Event { tick: 1, robot: (*name).into(), input: RobotInput::Release };
    let mut script = Script::new(names.iter().rev().map(event).collect(), vec![]);
    assert_eq!(script.check_robots(&names), Ok(()));
    script.events[77_777].robot.push('!');
    let error = script.check_robots(&names).unwrap_err();
    assert!(error.to_string().starts_with("events[77777]: there is no robot"), "{error}");
}

#[test]
fn a_script_made_by_a_program_gets_the_same_checks() {
    let event = |tick, input| Event { tick, robot: "r".into(), input };
    let check = |events| Script::new(events, vec![]).check().map_err(|e| e.to_string());
    assert_eq!(check(vec![event(2, RobotInput::Release), event(2, RobotInput::Release)]), Ok(()));
    assert!(check(vec![event(2, RobotInput::Release), event(1, RobotInput::Release)]).is_err());
    assert_eq!(
        check(vec![event(1, RobotInput::Drive(0, i16::MIN))]),
        Err("events[0]: channel -32768: it must be in -128 to 128".into())
    );
    let other = Script { version: 9, ..Script::empty() };
    assert_eq!(other.check().unwrap_err().problem, ScriptProblem::Version(9));
    let many = Script::new(vec![event(1, RobotInput::Release); MAX_EVENTS + 1], vec![]);
    assert_eq!(many.check().unwrap_err().problem, ScriptProblem::TooMany(MAX_EVENTS + 1));
}

#[test]
fn a_refusal_is_one_short_line_whatever_stands_in_the_file() {
    let long = "long_".repeat(100_000);
    for (from, to) in
        [("Release", long.clone()), ("tick: 7", format!("{long}: 7")), ("version: 1", format!("{long}: 1"))]
    {
        let refused = refused(from, &to);
        assert!(refused.contains("long_") && refused.len() < 1000 && refused.ends_with("..."), "{refused:.200}");
    }
    let event = Event { tick: 1, robot: long, input: RobotInput::Release };
    let refused = Script::new(vec![event], vec![]).check_robots(&[]).unwrap_err().to_string();
    assert!(refused.starts_with("events[0]: there is no robot") && refused.len() < 1000, "{refused:.200}");
}
