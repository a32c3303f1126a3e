//! Conditions: how they are written, and when they are met.

use super::*;
use motion_lab_core::random::Seed;

fn recipe() -> Recipe {
    Recipe::new(TourConfig { ticks: 20, ..TourConfig::default() }, Seed(7))
}

fn refused(text: &str) -> String {
    Condition::parse(text).expect_err(text).to_string()
}

#[test]
fn names_may_hold_anything_and_and_binds_closer_than_or() {
    let read = |text: &str| Condition::parse(text).unwrap();
    let robots = |text: &str| -> Vec<Vec<String>> {
        let name = |requirement: &Requirement| match &requirement.of {
            Compared::Robot { name, column, .. } => format!("{name}/{}", column.name),
            Compared::Digest { digest, .. } => digest.to_string(),
        };
        read(text).any.iter().map(|all| all.iter().map(name).collect()).collect()
    };
    assert_eq!(robots("a.contacts>0&&b.path_m<1||c.refusals!=2"), [vec!["a/contacts", "b/path_m"], vec!["c/refusals"]]);
    assert_eq!(robots(" the big. one .contact_s  >=  -1.5e-3 "), [["the big. one/contact_s"]]);
    assert_eq!(robots(r#""a|b \"x\" \\" . contacts == 1"#), [[r#"a|b "x" \/contacts"#]]);
    assert_eq!(robots(&format!("digest == {:032x}", 10)), [[format!("{:032x}", 10)]]);
    // a robot may be called digest
    assert_eq!(robots("digest.contacts == 1"), [["digest/contacts"]]);
    for (written, relation) in Relation::WRITTEN {
        let found = read(&format!("a.contacts {written} 2")).any.remove(0).remove(0).of;
        assert!(matches!(found, Compared::Robot { relation: found, number: 2.0, .. } if found == relation));
        let held = [1.0, 2.0, 3.0].map(|x| relation.holds(x, 2.0));
        let expected = match written {
            "<" => [true, false, false],
            "<=" => [true, true, false],
            "==" => [false, true, false],
            "!=" => [true, false, true],
            ">=" => [false, true, true],
            _ => [false, false, true],
        };
        assert_eq!(held, expected, "{written}");
    }
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    for (text, reason) in [
        ("", "character 1: a comparison is missing"),
        ("a.contacts > 0 && ", "character 19: a comparison is missing"),
        ("é.contacts", "character 11: a relation is missing"),
        ("a.contacts = 0", "character 12: a relation is missing"),
        ("a.contacts > 0 & b.contacts > 0", "character 16: comparisons are joined by && or ||"),
        ("contacts > 0", "character 1: \"contacts\" is no number of a run: write ROBOT.COLUMN, or digest"),
        ("a.contacts > 0 || b.contcts > 0", "character 19: no column \"contcts\"; did you mean \"contacts\"?"),
        ("a.speed > 0", "character 1: no column \"speed\"; the columns are contacts, contact_ticks, contact_s, path_m"),
        ("é.contacts > o", "character 14: \"o\" is no number"),
        ("a.contacts > inf", "character 14: \"inf\" is no number"),
        ("a.contacts > 1 2", "character 14: \"1 2\" is no number"),
        ("digest == 12", "character 11: a digest has 32 hexadecimal digits"),
        ("\"a.contacts > 0", "character 1: the quote is not closed"),
    ] {
        assert!(refused(text).starts_with(reason), "{text}: {}", refused(text));
    }
    assert!(refused(&format!("digest > {:032x}", 1)).starts_with("character 1: digests are compared by == or !="));
    let config = TourConfig::default();
    let check = |text: &str| Condition::parse(text).unwrap().check_for(&config);
    assert_eq!(check("Rusty.contacts > 0 && Hitch.contacts > 0"), Ok(()));
    assert_eq!(
        check("Rusty.contacts > 0 && hitch.contacts > 0").unwrap_err().to_string(),
        "character 23: the run has no robot \"hitch\"; did you mean \"Hitch\"?"
    );
}

#[test]
fn a_run_is_read_as_far_as_it_is_asked_for() {
    let recipe = recipe();
    let log = crate::recording::Run::record_recipe(recipe.clone(), crate::run::LogKind::Frames, |_| {}).unwrap();
    let stats = crate::run::RunStats::of(&log);
    let read = |text: &str| Condition::parse(text).unwrap().read(&recipe, || true).unwrap().unwrap();
    let all = read("Rusty.least_clearance_m > 0 && digest == 00000000000000000000000000000000");
    assert_eq!((&all.stats, all.digest), (&stats, log.digest()));
    let some = read("Rusty.path_m > 0");
    assert!(some.digest.is_none() && some.stats.robots.iter().all(|robot| robot.least_clearance.is_none()));
    assert_eq!(some.stats.robots[0].path_length, stats.robots[0].path_length);
    let mut asked = 0;
    let stopped = Condition::parse("Rusty.path_m > 0").unwrap().read(&recipe, || {
        asked += 1;
        asked < 5
    });
    assert_eq!((stopped, asked), (Ok(None), 5));
}

#[test]
fn what_is_not_met_is_said_with_what_was_found() {
    let recipe = recipe();
    let condition = Condition::parse("Hitch.contacts > 0 || Robby.path_m < 1 && Rusty.contacts >= 0").unwrap();
    let reading = condition.read(&recipe, || true).unwrap().unwrap();
    assert!(!condition.is_met(&reading));
    assert_eq!(condition.unmet(&reading), ["Hitch.contacts is 0", "there is no robot \"Robby\""]);
    let empty = |config: &mut TourConfig| config.worlds.clear();
    let mut none = recipe.clone();
    empty(std::sync::Arc::make_mut(&mut none.config));
    assert!(!Condition::parse("Rusty.contacts == 0").unwrap().holds(&none), "it cannot start");
    let digest = Condition::parse("digest == 00000000000000000000000000000000").unwrap();
    let reading = digest.read(&recipe, || true).unwrap().unwrap();
    assert_eq!(digest.unmet(&reading), [format!("the digest is {}", reading.digest.unwrap())]);
    let other = Condition::parse("digest != 00000000000000000000000000000000").unwrap();
    assert!(other.is_met(&reading));
}
