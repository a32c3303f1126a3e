//! Pages and their templates.

use std::sync::Arc;

use base64::prelude::{BASE64_STANDARD, Engine};

use super::*;
use crate::capture::run_svg;
use crate::recording::{Run, verify};
use crate::run::{Event, Log, LogKind, Recipe, Recorded, RobotInput, Script};
use crate::tour::TourConfig;
use motion_lab_core::picture::Theme;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;

/// The bytes of an empty module.
const MODULE: &[u8] = b"\0asm\x01\0\0\0";

/// A text with a place for every value, the value's own number in it.
fn text() -> String {
    let place = |(number, value): (usize, PageValue)| format!("{}%{number}%{} < 6 \" ", value.before(), value.end());
    format!("<!doctype html>{}</html>\n", PageValue::ALL.into_iter().enumerate().map(place).collect::<String>())
}

fn template() -> PageTemplate {
    PageTemplate::of(text(), MODULE).unwrap()
}

/// The page of a run.
fn page_of(template: &PageTemplate, recipe: &Recipe) -> String {
    UnfinishedPage::of_run(template, recipe.clone()).unwrap().page().unwrap()
}

fn recipe(seed: u64, ticks: u64) -> Recipe {
    Recipe::new(TourConfig { ticks, ..TourConfig::default() }, Seed(seed))
}

/// What stands in the places of a page, and the page without it.
fn held(page: &str) -> (Vec<&str>, String) {
    let (mut values, mut rest, mut left) = (Vec::new(), page, String::new());
    for value in PageValue::ALL {
        let (before, behind) = rest.split_once(value.before()).unwrap();
        let (held, behind) = behind.split_once(value.end()).unwrap();
        values.push(held);
        left += before;
        rest = behind;
    }
    (values, left + rest)
}

#[test]
fn a_page_holds_its_run_which_verifies_and_nothing_else_of_the_template_changes() {
    let recipe = recipe(7, 30);
    let template = template();
    let mut unfinished = UnfinishedPage::of_run(&template, recipe.clone()).unwrap();
    for tick in 0..30 {
        assert!(unfinished.tick() == tick && unfinished.go_on().unwrap());
    }
    assert!(!unfinished.go_on().unwrap() && unfinished.tick() == 30, "it ends with the run");
    let page = unfinished.page().unwrap();
    let recorded = Run::record(Arc::clone(&recipe.config), recipe.seed).unwrap();
    let (values, left) = held(&page);
    assert_eq!(values[0], "%0%", "the simulator's print is the template's");
    assert_eq!(values[1..4], ["7", "30", &recorded.digest().unwrap().to_string()]);
    for (figure, theme) in [(values[4], Theme::Dark), (values[5], Theme::Light)] {
        let svg = String::from_utf8(BASE64_STANDARD.decode(figure).unwrap()).unwrap();
        let [own, other] = [theme, if theme == Theme::Dark { Theme::Light } else { Theme::Dark }]
            .map(|theme| run_svg(&recorded, 30, theme, |_| {}).unwrap());
        // of the run itself: a picture of its recorded frames differs by how the car's wheels are turned
        let common = |figure: &str| svg.lines().filter(|line| figure.lines().any(|l| l == *line)).count();
        assert!(svg.contains(values[3]) && common(&own) > svg.lines().count() - 5 && common(&own) > common(&other));
    }
    assert_eq!(left, held(&text()).1);
    let log = Log::read_mcap(page.as_bytes()).unwrap().log;
    assert_eq!((log.kind(), &log.recipe, log.ticks()), (LogKind::Digests, &recipe, 30));
    assert_eq!(verify(&log, |_| {}).unwrap().difference, None);
}

#[test]
fn a_page_that_was_written_is_a_template_itself() {
    let first = page_of(&template(), &recipe(7, 5));
    let again = PageTemplate::read(first.as_bytes()).unwrap();
    assert_eq!(page_of(&again, &recipe(7, 5)), first);
    let other = page_of(&template(), &recipe(8, 6));
    assert!(other != first && page_of(&again, &recipe(8, 6)) == other);
    // as the site's build writes it
    let file = [text().as_bytes(), MODULE].concat();
    assert_eq!(page_of(&PageTemplate::read(&file).unwrap(), &recipe(7, 5)), first);
}

#[test]
fn a_log_s_page_holds_what_is_recorded_and_is_none_where_the_run_is_another() {
    let template = template();
    let mut log = Run::record(recipe(7, 30).config, Seed(7)).unwrap();
    // an input beyond the recorded ticks is none of the page's run
    let late = Event { tick: 25, robot: "Rusty".to_owned(), input: RobotInput::Release };
    log.recipe.script = Script::new(vec![late], Vec::new());
    let Recorded::Frames { frames, .. } = &mut log.recorded else { panic!("frames") };
    frames.truncate(20);
    let page = UnfinishedPage::of_log(&template, &log).unwrap().page().unwrap();
    assert_eq!(page, page_of(&template, &recipe(7, 20)));
    let Recorded::Frames { frames, .. } = &mut log.recorded else { panic!("frames") };
    frames[11].robots[0].contacts += 1;
    let refused = UnfinishedPage::of_log(&template, &log).unwrap().page().unwrap_err().to_string();
    assert!(refused.starts_with("the run is another when it is simulated again: tick 12, "), "{refused}");
}

#[test]
fn no_name_of_a_run_is_read_as_markup() {
    let name = "</script><!--\"'&amp;%LOG%<script>alert(1)</script>";
    let mut world = World::workbench();
    world.obstacles[0].name = name.to_owned();
    world.robots[0].name = format!("{name}{}", world.robots[0].name);
    let robot = world.robots[0].name.clone();
    let script = Script::new(vec![Event { tick: 1, robot, input: RobotInput::Release }], Vec::new());
    let config = TourConfig { worlds: vec![world], ticks: 3, ..TourConfig::default() };
    let recipe = Recipe::new(config, (Seed(1), script));
    let page = page_of(&template(), &recipe);
    let (values, left) = held(&page);
    assert_eq!(left, held(&text()).1, "the page around its values is as it was");
    let signs = |c: char| c.is_ascii_alphanumeric() || "+/=".contains(c);
    assert!(values[1..].iter().all(|value| value.chars().all(signs)), "{values:.40?}");
    assert_eq!(Log::read_mcap(page.as_bytes()).unwrap().log.recipe, recipe);
}

#[test]
fn what_is_no_template_is_refused_with_the_reason() {
    let of = |text: &str| PageTemplate::of(text.to_owned(), MODULE).unwrap_err();
    let whole = text();
    for value in PageValue::ALL {
        assert_eq!(of(&whole.replace(value.before(), "")), TemplateError::Missing(value));
        assert_eq!(of(&format!("{whole}{}{}", value.before(), value.end())), TemplateError::Twice(value));
        assert_eq!(of(&format!("{}{}", value.before(), whole)), TemplateError::Twice(value));
    }
    let cut = whole.find(PageValue::Log.before()).unwrap() + PageValue::Log.before().len();
    assert_eq!(of(&whole[..cut]), TemplateError::Missing(PageValue::Log), "it does not end");
    let [seed, ticks] = [PageValue::Seed, PageValue::Ticks].map(PageValue::before);
    let turned = whole.replace(seed, "@").replace(ticks, seed).replace('@', ticks);
    assert_eq!(of(&turned), TemplateError::Missing(PageValue::Ticks), "the order of the places is the page's");
    let read = |file: &[u8]| PageTemplate::read(file).unwrap_err();
    assert_eq!(read(whole.as_bytes()), TemplateError::NoSimulator);
    assert_eq!(PageTemplate::of(whole.clone(), b"no module").unwrap_err(), TemplateError::NoSimulator);
    assert_eq!(read(b"\x89MCAP0\r\n"), TemplateError::NotText(0));
    assert_eq!(read(MODULE), TemplateError::Missing(PageValue::Print));
    assert_eq!(read(b""), TemplateError::Missing(PageValue::Print));
    let said = of("<html>").to_string();
    assert_eq!(said, "it is no template of a run's page: it has no place for the simulator's print");
}

#[test]
fn a_template_with_another_simulator_is_refused_and_both_are_named() {
    let own = simulator_print().unwrap();
    let with = |print: &str| PageTemplate::of(text().replace("%0%", print), MODULE).unwrap();
    with(&own).check_simulator().unwrap();
    let older = own.replace(env!("CARGO_PKG_VERSION"), "0.0.9");
    let changed = format!("{}{}", &own[..own.len() - 1], if own.ends_with('0') { '1' } else { '0' });
    for print in [older.as_str(), changed.as_str(), "", &format!("{own}\u{1b}[31m\n")] {
        let error = with(print).check_simulator().unwrap_err().to_string();
        assert!(error.contains(&own) && error.contains("it holds another simulator"), "{error}");
        assert!(!error.contains(['\u{1b}', '\n']), "{error:?}");
    }
}

#[test]
fn the_print_names_the_version_the_format_and_a_run() {
    let print = simulator_print().unwrap();
    let (named, digest) = print.rsplit_once(' ').unwrap();
    assert_eq!(named, format!("motion-lab {}, log format digest 1,", env!("CARGO_PKG_VERSION")));
    assert!(digest.len() == 32 && digest.bytes().all(|b| b.is_ascii_hexdigit()), "{digest}");
    assert_eq!(simulator_print().unwrap(), print);
}
