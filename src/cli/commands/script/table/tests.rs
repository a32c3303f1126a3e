use super::*;
use motion_lab_core::worlds::World;

fn script(text: &str, config: Option<&TourConfig>) -> Result<Script, ScriptTableError> {
    super::script(text, config).map(|(script, _)| script)
}

#[test]
fn a_table_becomes_the_script_it_describes() {
    let table = "\u{feff}tick,robot,input,first,second\n# a drive\n1,Rusty,Drive,64,-20\n\n 5 , Reach , MoveTo , 0.5 , \
                 -1e-6 \r\n7,\"a \"\"b\"\", c\",Teleport,2,,\n9,Hitch,SetTrailer,on\n9,Hitch,SetTrailer,off,,\n\
                 12,Rusty,Release,,";
    let made = script(table, None).unwrap();
    let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
    let expected = [
        event(1, "Rusty", RobotInput::Drive(64, -20)),
        event(5, "Reach", RobotInput::MoveTo(vec![Quantized(1 << 19), Quantized(-1)])),
        event(7, "a \"b\", c", RobotInput::Teleport(vec![Quantized(1 << 21)])),
        event(9, "Hitch", RobotInput::SetTrailer(true)),
        event(9, "Hitch", RobotInput::SetTrailer(false)),
        event(12, "Rusty", RobotInput::Release),
    ];
    assert_eq!(made.events, expected);
    assert_eq!(script("", None).unwrap(), Script::empty());
}

#[test]
fn rows_end_as_spreadsheets_end_them() {
    let plain = "tick,robot,input,values\n1,Hitch,Drive,128,-64\n9,Rusty,Teleport,2.25,6.25,0\n";
    let expected = script(plain, None).unwrap();
    assert_eq!(expected.events.len(), 2);
    for end in ["\r", "\r\n", "\u{2028}", "\u{2029}", "\u{85}", "\r\r\n", "\n\r", "\u{b}", "\u{c}", "\u{1e}"] {
        assert_eq!(script(&plain.replace('\n', end), None).as_ref(), Ok(&expected), "{end:?}");
        assert_eq!(script(&plain.replace("\n9", &format!("{end}9")), None).as_ref(), Ok(&expected), "{end:?}, mixed");
        let comment = format!("# made in a sheet{end}\"# for, us\"{end}{}", plain.replace('\n', end));
        assert_eq!(script(&comment, None).as_ref(), Ok(&expected), "{end:?}, after comments");
    }
    // lines are counted by any end
    for (end, line) in [("\r", 3), ("\r\n", 3), ("\u{2028}", 3), ("\n\n", 5)] {
        let error = script(&plain.replace('\n', end).replace("Teleport", "Fly"), None).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{line}:9: \"Fly\" is no input")), "{error}");
    }
}

#[test]
fn tables_with_semicolons_have_decimal_commas() {
    let plain = "1,Hitch,Drive,128,-64\n9,Rusty,Teleport,2.25,6.25,0\n20,Hitch,SetTrailer,on\n";
    let expected = script(plain, None).unwrap();
    for table in [
        "tick;robot;input;values\n1;Hitch;Drive;128;-64\n9;Rusty;Teleport;2,25;6,25;0\n20;Hitch;SetTrailer;TRUE\n",
        "1,0;Hitch;Drive;128,0;-64,0;;\n9;Rusty;Teleport;2,25;6.25;0,0;\n;;;;;\n20;\"Hitch\";SetTrailer;True;;\n",
        "sep=;\r\n1;Hitch;Drive;128;-64\r\n9;Rusty;Teleport;2,25;6,25;0\r\n20;Hitch;SetTrailer;on",
        "tick\trobot\n1\tHitch\tDrive\t128\t-64\n9\tRusty\tTeleport\t2,25\t6.25\t0\n20\tHitch\tSetTrailer\ton\t\t",
        "tick|robot|input|values\n1|Hitch|Drive|128|-64\n9|Rusty|Teleport|2.25|6,25|0\n20|Hitch|SetTrailer|on|\n",
    ] {
        assert_eq!(script(table, None).as_ref(), Ok(&expected), "{table}");
    }
    // a semicolon in the name of a table with commas is none between cells
    assert_eq!(script("4,a;b,Release", None).unwrap().events[0].robot, "a;b");
    assert_eq!(script("4,tick,Release", None).unwrap().events[0].robot, "tick");
}

#[test]
fn numbers_and_words_may_be_those_of_data_frames() {
    let plain = script("1,Hitch,Drive,128,-64\n20,Hitch,SetTrailer,on\n21,Hitch,SetTrailer,off", None).unwrap();
    for table in [
        "1.0,Hitch,Drive,128.0,-64.0\n2e1,Hitch,SetTrailer,TRUE\n21,Hitch,SetTrailer,FALSE",
        ",tick,robot\n0,1,Hitch,Drive,128,-64.0\n1,20,Hitch,SetTrailer,True,\n2,21,Hitch,SetTrailer,False,",
        "Unnamed: 0,Tick\n0,1,Hitch,Drive,128,-64\n1,20,Hitch,SetTrailer,true\n,,,,\n2,21,Hitch,SetTrailer,Off",
    ] {
        assert_eq!(script(table, None).as_ref(), Ok(&plain), "{table}");
    }
    let refused = |table: &str| script(table, None).unwrap_err().to_string();
    assert_eq!(
        refused(",tick\n0,1,Hitch,Fly"),
        "2:11: \"Fly\" is no input: it must be Drive, MoveTo, Teleport, SetTrailer or Release"
    );
    assert_eq!(refused("1.5,Hitch,Release"), "1:1: \"1.5\" is no tick: a whole number from 1 on");
    assert_eq!(refused("1e300,Hitch,Release"), "1:1: \"1e300\" is no tick: a whole number from 1 on");
}

/// Without the limit, each cell of a row of 36 MB of commas took 60 bytes and more.
#[test]
fn a_row_has_at_most_a_thousand_cells() {
    // the first value stands in column 16, and a further one two columns on
    let row =
        |values: usize| script(&format!("5,Reach,MoveTo{},x", ",1".repeat(values)), None).unwrap_err().to_string();
    assert_eq!(row(996), "1:2008: \"x\" is no number");
    assert_eq!(row(997), "1:2010: more than 1000 cells in a row");
    assert_eq!(row(1_000_000), "1:2010: more than 1000 cells in a row");
}

#[test]
fn errors_name_line_column_and_reason() {
    for (table, error) in [
        ("x,Rusty,Release", "1:1: \"x\" is no tick: a whole number from 1 on"),
        ("tick\n\n0,Rusty,Release", "3:1: tick 0: it must be in 1 to 4294967296"),
        ("5,Rusty,Release\n4,Rusty,Release", "2:1: tick 4 comes after tick 5: ticks must ascend"),
        ("5", "1:2: the robot is missing"),
        ("5,,Release", "1:3: the robot is missing"),
        ("5\t\tRelease", "1:3: the robot is missing"),
        ("5,Rusty", "1:8: the input is missing"),
        ("5,Rusty,drive,1,2", "1:9: \"drive\" is no input: it must be Drive, MoveTo, Teleport, SetTrailer or Release"),
        ("5,Rusty,Drive,1", "1:16: the second channel is missing"),
        ("5.5,Rusty,Release", "1:1: \"5.5\" is no tick: a whole number from 1 on"),
        ("-5,Rusty,Release", "1:1: -5 is no tick: a whole number from 1 on"),
        ("5;Rusty;Drive;1;0,5", "1:17: \"0,5\" is no whole number"),
        ("5;Rusty;Teleport;1.000,5", "1:18: \"1.000,5\" is no number"),
        ("5,Rusty,Teleport,\"0,5\"", "1:18: \"0,5\" is no number"),
        ("5;\"Rusty\",Release", "1:10: ',' after a quote: ';' belongs there"),
        ("5,Rusty,Drive,1,fast", "1:17: \"fast\" is no whole number"),
        ("5,Rusty,Drive,1,0.5", "1:17: \"0.5\" is no whole number"),
        ("5,Rusty,Drive,99999,0", "1:15: the first channel 99999 is too large"),
        ("5,Rusty,Drive,129,0", "1:15: channel 129: it must be in -128 to 128"),
        ("5,Rusty,Drive,1,2,3", "1:19: Drive has no more than 2 values"),
        ("5,Rusty,Release,3", "1:17: Release has no more than 0 values"),
        ("5,Reach,MoveTo", "1:15: the coordinates are missing"),
        ("5,Reach,MoveTo,1,,2", "1:18: \"\" is no number"),
        ("5,Reach,MoveTo,1,nan", "1:18: nan is too large or not finite"),
        ("5,Reach,MoveTo,1,1e300", "1:18: 1e300 is too large or not finite"),
        ("5,Hitch,SetTrailer,yes", "1:20: \"yes\" is neither on nor off"),
        ("5,\"Rusty,Release", "1:3: the quote is not closed"),
        ("5,\"Rusty\"x,Release", "1:10: 'x' after a quote: a comma belongs there"),
        ("5,R\u{e9}\u{e9},Fly", "1:7: \"Fly\" is no input: it must be Drive, MoveTo, Teleport, SetTrailer or Release"),
    ] {
        assert_eq!(script(table, None).unwrap_err().to_string(), error, "{table}");
    }
}

#[test]
fn a_table_is_checked_against_its_world_cell_by_cell() {
    let config = TourConfig::default();
    let refused = |row: &str| script(&format!("tick\n4,Rusty,Release\n{row}"), Some(&config)).unwrap_err().to_string();
    assert_eq!(refused("5,Anna,Release"), "3:3: there is no robot \"Anna\"");
    let car =
        "tick 5: robot \"Hitch\" is a hitch and takes no MoveTo: it takes Drive, Teleport, SetTrailer and Release";
    assert_eq!(refused("5,Hitch,MoveTo,1,2,3"), format!("3:9: {car}"));
    assert!(refused("5,Reach,MoveTo,1,2,3").starts_with("3:16: tick 5: MoveTo of robot \"Reach\" has 3"));
    assert!(script("5,Reach,MoveTo,1,2", Some(&config)).is_ok() && script("5,Anna,Release", None).is_ok());
}

#[test]
fn angles_may_be_in_degrees_and_more_than_a_turn_is_noted() {
    let config = TourConfig { worlds: vec![World::apartment(), World::workbench()], ..TourConfig::default() };
    let plain = script(
        "5,Reach,MoveTo,0.7853981633974483,-1.5707963267948966\n7,Rusty,Teleport,2.25,6.25,3.141592653589793",
        None,
    );
    for table in [
        "5,Reach,MoveTo,45deg,-90deg\n7,Rusty,Teleport,2.25,6.25,180deg",
        "5;Reach;MoveTo;45,0deg;-90 deg\n7;Rusty;Teleport;2,25;6,25;180.0deg",
    ] {
        for known in [None, Some(&config)] {
            assert_eq!(super::script(table, known).unwrap(), (plain.clone().unwrap(), vec![]), "{table}");
        }
    }
    let length = "7,Rusty,Teleport,2.25,6deg,0";
    assert_eq!(
        script(length, Some(&config)).unwrap_err().to_string(),
        "1:23: coordinate 1 is a length in metres, and 6deg is an angle"
    );
    assert_eq!(script("5,Reach,MoveTo,deg,0", None).unwrap_err().to_string(), "1:16: \"deg\" is no number");
    // 90 and 30 over 2 pi are 14.32 and 4.77; 10 m are no angle
    let turned = super::script("5,Reach,MoveTo,90,0\n7,Rusty,Teleport,10,6.25,30", None).unwrap().1;
    let says =
        |at: &str, n: u32, turns: &str| format!("{at}: {n} rad is {turns} turns; angles are radians; write {n}deg");
    assert_eq!(turned, [says("1:16", 90, "14.3"), says("2:26", 30, "4.8")]);
    assert_eq!(super::script("8,Reach,Teleport,90,0", Some(&config)).unwrap().1, [says("1:18", 90, "14.3")]);
}

#[test]
fn a_teleport_outside_the_world_is_refused_where_the_world_is_known() {
    let config = TourConfig { worlds: vec![World::apartment()], ..TourConfig::default() };
    let table = "tick,robot,input\n7,Rusty,Teleport,90,5,0";
    assert!(script(table, None).is_ok());
    let bounds = World::apartment().bounds;
    let sides = format!("from ({}, {}) to ({}, {})", bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y);
    assert_eq!(
        script(table, Some(&config)).unwrap_err().to_string(),
        format!(
            "2:18: tick 7: Teleport of robot \"Rusty\": the target (90, 5) lies outside the world, which reaches {sides}"
        )
    );
}

#[test]
fn a_refusal_is_one_short_line_whatever_stands_in_the_table() {
    let config = TourConfig { worlds: vec![World::apartment()], ..TourConfig::default() };
    let long = "\u{7f}\u{301}".repeat(10_000);
    for (row, begins) in [
        (format!("1,{long},Release"), "2:3: there is no robot \""),
        (format!("1,Rusty,{long}"), "2:9: \""),
        (format!("{long},Rusty,Release"), "2:1: \""),
        (format!("1,Rusty,MoveTo,{long}"), "2:16: \""),
        (format!("1,Hitch,SetTrailer,{long}"), "2:20: \""),
    ] {
        let refused = script(&format!("tick,robot,input,values\n{row}\n"), Some(&config)).unwrap_err().to_string();
        assert!(refused.starts_with(begins) && refused.chars().count() < 1000, "{refused:.200}");
    }
}
