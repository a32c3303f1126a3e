//! Routes in world files: read, printed, and refused by name and line.

use crate::worlds::{MAX_ITEMS, World};

/// A world whose third line holds the routes and whose fourth the robots.
fn yard(routes: &str, robots: &str) -> String {
    format!(
        "World(version: 1, name: \"yard\",\n  bounds: (min: (0, 0), max: (9, 9)),\nroutes: [{routes}],\nrobots: [{robots}],\n)"
    )
}

const ROUND: &str = "(name: \"round\", points: [(1, -0.0), (8, 0), (8, 5), (1, 5)], radius: 0.25, speed: 0.4)";
const ROVER: &str = "(name: \"Rusty\", kind: \"rusty\", start: [3, 1, 0], route: \"round\")";

#[test]
fn routes_are_read_and_printed_and_only_where_there_are_any() {
    let world = World::parse("yard.ron", &yard(ROUND, ROVER)).unwrap();
    assert_eq!(world.routes[0].points.len(), 4);
    assert_eq!((world.routes[0].radius, world.routes[0].speed), (0.25, 0.4));
    assert_eq!(world.robots[0].route.as_deref(), Some("round"));
    let text = world.to_ron();
    let printed = "    routes: [\n        (name: \"round\", points: [(1.0, 0.0), (8.0, 0.0), (8.0, 5.0), (1.0, 5.0)], radius: 0.25, speed: 0.4),\n    ],\n    places: [";
    assert!(text.contains(printed), "{text}");
    assert!(text.contains("kind: \"rusty\", start: [3.0, 1.0, 0.0], route: \"round\"),"), "{text}");
    assert!(World::parse("printed", &text).unwrap() == world);
    // one without has the text and the hash of a world from before there were any
    let without = World::parse("yard.ron", &yard("", &ROVER.replace(", route: \"round\"", ""))).unwrap();
    assert_eq!(
        without.to_ron(),
        "World(\n    version: 1,\n    name: \"yard\",\n    bounds: (min: (0.0, 0.0), max: (9.0, 9.0)),\n    walls: [\n    ],\n    \
         obstacles: [\n    ],\n    places: [\n    ],\n    marks: [\n    ],\n    robots: [\n        (name: \"Rusty\", \
         kind: \"rusty\", start: [3.0, 1.0, 0.0]),\n    ],\n)\n"
    );
    assert!(without.content_hash() != world.content_hash());
}

#[test]
fn what_is_no_route_is_refused_with_its_line() {
    let refusal = |routes: &str, robots: &str| World::parse("yard.ron", &yard(routes, robots)).unwrap_err().to_string();
    for (from, to, reason) in [
        ("radius: 0.25", "radius: 0", "radius 0: it must be from 0.001 to 1000"),
        ("speed: 0.4", "speed: 11", "speed 11: it must be from 0.001 to 10"),
        ("speed: 0.4", "speed: NaN", "speed NaN: it must be"),
        ("(8, 0), (8, 5), (1, 5)", "(8, 0)", "2 points: a route has 3 to 1000"),
        ("(1, 5)", "(8, 5)", "from points[2] on: length 0 m"),
        ("(1, 5)", "(1, 10001)", "point (1, 10001): coordinates must be finite"),
        ("(8, 5), (1, 5)", "(2, 0)", "points[0]: the route turns back on itself"),
        ("radius: 0.25", "radius: 4", "from points[0] on: a side of 7 m, but its corners of radius 4 m take"),
        ("\"round\"", "\" round\"", "name \" round\""),
    ] {
        let error = refusal(&ROUND.replace(from, to), ROVER);
        assert!(error.starts_with("yard.ron:3:10: routes[0] "), "{error}");
        assert!(error.contains(reason), "{reason}: {error}");
    }
    let twice = format!("{ROUND}, {ROUND}");
    assert!(refusal(&twice, ROVER).ends_with("the name is taken by routes[0] \"round\" in line 3"));
    let unknown = refusal(&ROUND.replace("radius", "radios"), ROVER);
    assert!(unknown.starts_with("yard.ron:3:") && unknown.contains("routes[0] \"round\": "), "{unknown}");
    // all routes together have as many corners as a world has shapes
    let many: Vec<String> = (0..MAX_ITEMS / 4 + 1).map(|i| ROUND.replace("round", &format!("r{i}"))).collect();
    let error = refusal(&many.join(",\n"), "");
    assert!(error.ends_with("routes[25000] \"r25000\": too many corners of routes: at most 100000"), "{error}");
}

#[test]
fn a_robot_that_cannot_follow_is_refused_with_its_line() {
    let refusal = |robot: &str| World::parse("yard.ron", &yard(ROUND, robot)).unwrap_err().to_string();
    let arm = "(name: \"arm\", kind: \"reach\", start: [0, 1], route: \"round\")";
    assert_eq!(refusal(arm), "yard.ron:4:10: robots[0] \"arm\": a reach does not drive: leave out `route`");
    let lost = ROVER.replace("\"round\")", "\"square\")");
    assert_eq!(refusal(&lost), "yard.ron:4:10: robots[0] \"Rusty\": there is no route \"square\"");
    // a wheelbase of 2.5 m and 0.6 rad of steering: 2.5 / tan 0.6 = 3.654 m
    let car = ROVER.replace("rusty", "hitch");
    let error = refusal(&car);
    assert!(
        error.starts_with("yard.ron:4:10: robots[0] \"Rusty\": its turning circle has a radius of 3.654"),
        "{error}"
    );
    assert!(error.ends_with("and the corners of the route \"round\" have 0.25 m"), "{error}");
    // by its own sizes: 0.1 / tan 0.4 = 0.2365 m, 0.12 / tan 0.4 = 0.284 m
    let small = |wheelbase: f64| {
        let sizes = format!("car: (wheelbase: {wheelbase}, length: 0.3, rear_overhang: 0.05, max_steer: 0.4), route");
        World::parse("yard.ron", &yard(ROUND, &car.replace("route", &sizes)))
    };
    assert!(small(0.1).is_ok() && small(0.12).is_err());
    assert!(World::parse("yard.ron", &yard(ROUND, &ROVER.replace("rusty", "x-own"))).is_ok());
}
