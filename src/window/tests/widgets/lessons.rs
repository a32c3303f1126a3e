//! The lessons, walked through as a reader would who clicks at once: the clicks and drags that each takes, and the
//! seconds of the lab's clock until its task is ticked off.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::*;
use crate::window::ui::paint::canvas::fit;
use motion_lab_core::robots::Reach;

/// Longest time from the first click until a task is ticked off, seconds.
const LONGEST: f64 = 30.0;

/// A reader in a new lab.
pub struct Reader {
    pub harness: Harness<'static, Lab>,
    actions: u32,
}

impl Reader {
    pub fn new() -> Self {
        Reader { harness: lab(WIDE), actions: 0 }
    }

    /// Clicks the control of this name.
    pub fn click(&mut self, name: &str) {
        self.actions += 1;
        self.harness.get_by_label(name).click();
        self.harness.run_steps(3);
    }

    fn bring(&mut self, robot: &str) {
        self.actions += 1;
        bring(&mut self.harness, robot);
    }

    fn click_at(&mut self, at: Pos2) {
        self.actions += 1;
        click_at(&mut self.harness, at);
    }

    fn drag(&mut self, from: Pos2, to: Pos2) {
        self.actions += 1;
        pointer(&mut self.harness, from, Some(true));
        (1..=10).for_each(|i| pointer(&mut self.harness, from.lerp(to, i as f32 / 10.0), None));
        pointer(&mut self.harness, to, Some(false));
        self.harness.run_steps(2);
    }

    /// Types into the field of this name.
    fn enter(&mut self, name: &str, text: &str) {
        self.actions += 2;
        self.harness.get_by_label_contains(name).focus();
        self.harness.run_steps(2);
        self.harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        self.harness.step();
        self.harness.event(Event::Text(text.into()));
        self.harness.step();
        self.harness.key_press(Key::Enter);
        self.harness.run_steps(3);
    }

    /// The sheet whose description holds these words.
    fn sheet(&self, words: &str) -> egui::Rect {
        self.harness.get_by_label_contains(words).rect()
    }

    /// Where the tip of the chapter's arm at these angles is on the sheet of Query.
    fn tip(&self, th1: f64, th2: f64) -> Pos2 {
        let tip = Reach::<2>::choset().tip(&motion_lab_core::configuration::T2::new(th1, th2));
        let [x, y] = fit(interface(&self.harness).anatomy.backdrop(), self.sheet("Reach at T2")).screen_from_world(tip);
        pos2(x as f32, y as f32)
    }

    /// Where a point of the torus is on the sheet of Space.
    fn on_torus(&self, th1: f64, th2: f64) -> Pos2 {
        let anatomy = &interface(&self.harness).anatomy.anatomy;
        let slice = motion_lab_core::cspace::Slice::through(anatomy.checker(), &anatomy.q()).unwrap();
        let still = motion_lab_core::cspace::cspace_picture(
            &motion_lab_core::cspace::CellMap::new(slice, 1),
            &Default::default(),
        );
        let sheet = self.sheet("configuration space. The robot");
        let [x, y] = fit(&still, sheet).screen_from_world(motion_lab_core::geometry::Point2::new(th1, th2));
        pos2(x as f32, y as f32)
    }

    fn has_done(&self, task: &str) -> bool {
        interface(&self.harness).settings.done.iter().any(|done| done == task)
    }

    /// The clock of the lab, seconds.
    pub fn now(&self) -> f64 {
        self.harness.ctx.input(|i| i.time)
    }
}

/// A lesson: the id of its task, the widget it is in, how the reader makes that ready, and what the reader does then.
type Lesson = (&'static str, &'static str, fn(&mut Reader), fn(&mut Reader));

fn open_the_editor(reader: &mut Reader) {
    reader.click("Atlas");
    reader.click("Edit");
}

const LESSONS: [Lesson; 11] = [
    (
        "TwoElbows",
        "Drive",
        |reader| {
            reader.bring("Reach");
        },
        |reader| {
            reader.click("One tip, two elbows");
        },
    ),
    (
        "TwoHeadings",
        "Drive",
        |reader| {
            reader.bring("Hitch");
        },
        |reader| {
            reader.click("One place, two headings");
        },
    ),
    (
        "Held",
        "Drive",
        |_| (),
        |reader| {
            let at = paper(&reader.harness, "Apartment").left_top() + egui::vec2(20.0, 60.0);
            reader.click_at(at);
            reader.actions += 1;
            reader.harness.key_down(Key::ArrowUp);
        },
    ),
    (
        "Guess",
        "Query",
        |reader| {
            // as *Next* of the task before it does: its question is open then
            reader.actions += 1;
            ui(&mut reader.harness, |ui| ui.begin(motion_lab_sim::manifest::Lesson::of("guess").unwrap()));
            reader.harness.run_steps(3);
        },
        |reader| {
            reader.enter("the links are given a radius of 3 cm", "0.05");
        },
    ),
    (
        "Near",
        "Query",
        |reader| {
            reader.click("Query");
            reader.click("witness");
        },
        |reader| {
            // towards the block, and not as far as it
            let (from, to) = (reader.tip(FRAC_PI_4, FRAC_PI_2), reader.tip(FRAC_PI_4, 1.43));
            reader.drag(from, to);
        },
    ),
    (
        "FreeEnds",
        "Query",
        |reader| {
            reader.click("Query");
            reader.click("swept");
        },
        |reader| {
            let slider = reader.harness.get_by_role_and_label(egui::accesskit::Role::Slider, "step of θ₁").rect();
            reader.click_at(slider.left_center() + egui::vec2(0.27 * 180.0, 0.0));
        },
    ),
    (
        "TwoPoints",
        "Space",
        |reader| {
            reader.click("Space");
        },
        |reader| {
            let [here, other] =
                [(FRAC_PI_4, FRAC_PI_2), (2.3562, -FRAC_PI_2)].map(|(th1, th2)| reader.on_torus(th1, th2));
            reader.drag(here, here);
            reader.click_at(other);
        },
    ),
    (
        "OverEdge",
        "Space",
        |reader| {
            reader.click("Space");
        },
        |reader| {
            let (here, edge) = (reader.on_torus(FRAC_PI_4, FRAC_PI_2), reader.on_torus(PI, FRAC_PI_2));
            reader.drag(here, edge + egui::vec2(12.0, 0.0));
        },
    ),
    (
        "UnequalLinks",
        "Space",
        |reader| {
            reader.click("Space");
        },
        |reader| {
            reader.enter("length of link 2", "0.5");
        },
    ),
    ("PickWall", "Atlas", open_the_editor, |reader| {
        let wall = at(&reader.harness, [4.0, 6.0]);
        reader.click_at(wall);
    }),
    ("EditWorld", "Atlas", open_the_editor, |reader| {
        let wall = at(&reader.harness, [4.0, 6.0]);
        reader.click_at(wall);
        reader.click("Delete");
        reader.click("Run this world");
    }),
];

#[test]
fn the_lesson_of_the_time_line_begins_with_something_to_drag_back_over() {
    let begun = |ticks: usize, to: u64| {
        let mut harness = lab(WIDE);
        harness.run_steps(ticks);
        pause(&mut harness);
        harness.state_mut().app.world_mut().write_message(motion_lab_sim::simulation::RunCommand::from(if to == 0 {
            motion_lab_sim::simulation::TransportCommand::Seek(0)
        } else {
            motion_lab_sim::simulation::TransportCommand::Reset
        }));
        harness.run_steps(3);
        interface_mut(&mut harness).begin(motion_lab_sim::manifest::Lesson::of("drive_on").unwrap());
        harness.run_steps(4);
        harness.state().transport()
    };
    let played = begun(200, 0);
    assert!(played.frontier > 40 && played.tick == played.frontier, "at its end: {played:?}");
    assert_eq!(begun(200, 1).playback, Playback::Playing, "a run that has not begun plays");
}

#[test]
fn each_lesson_is_done_within_half_a_minute_and_a_few_clicks() {
    let page = include_str!("../../../../docs/window.md");
    for (task, widget, make_ready, act) in LESSONS {
        let mut reader = Reader::new();
        let start = reader.now();
        assert!(!reader.has_done(task));
        make_ready(&mut reader);
        act(&mut reader);
        while !reader.has_done(task) {
            reader.harness.step();
            let late = reader.now() - start > LONGEST;
            assert!(!late, "{task}: {:?} after {} actions", interface(&reader.harness).settings.done, reader.actions);
        }
        println!("{task}: {:.1} s", reader.now() - start);
        let end = format!(" | {} |", lesson_of(task).learnt());
        let row =
            page.lines().find(|line| line.ends_with(&end)).unwrap_or_else(|| panic!("no row of {task} on the page"));
        assert!(row.contains(&format!(" | {widget} | {} | ", reader.actions)), "{} actions: {row}", reader.actions);
        assert!(reader.actions <= 5, "{task}");
    }
}

/// The lesson of the manifest that asks for this.
fn lesson_of(task: &str) -> motion_lab_sim::manifest::Lesson {
    motion_lab_sim::manifest::Lesson::all().find(|lesson| lesson.task.id() == task).expect("each has a hint")
}

pub fn ui(harness: &mut Harness<'_, Lab>, change: impl FnOnce(&mut crate::window::ui::UiState)) {
    change(&mut harness.state_mut().app.world_mut().resource_mut::<crate::window::Interface>().0);
}

/// The lesson under way.
pub fn under_way(harness: &Harness<'_, Lab>) -> crate::window::ui::LessonState {
    interface(harness).lesson.clone().unwrap()
}

#[test]
fn a_lesson_that_is_begun_by_its_id_needs_nothing_made_ready_and_says_when_it_is_done() {
    for (task, ..) in LESSONS {
        let lesson = lesson_of(task);
        let mut reader = Reader::new();
        // the reader was elsewhere, and has done it before
        reader.click("Plan");
        ui(&mut reader.harness, |ui| {
            ui.settings.tick_off(lesson.task);
            ui.settings.world = 1;
            ui.begin(lesson);
        });
        reader.harness.run_steps(3);
        assert_eq!(under_way(&reader.harness).took, None, "{task}");
        let start = reader.now();
        LESSONS.iter().find(|known| known.0 == task).unwrap().3(&mut reader);
        while under_way(&reader.harness).took.is_none() {
            reader.harness.step();
            assert!(reader.now() - start < LONGEST, "{task}: not done after {} actions", reader.actions);
        }
        reader.harness.run_steps(2);
        let said = format!("Done in {:.0} s", under_way(&reader.harness).took.unwrap());
        assert!(reader.harness.query_by_label(&said).is_some(), "{task}: {said}");
        let learnt = under_way(&reader.harness).learnt;
        let own = ["TwoElbows", "TwoHeadings", "Held"].contains(&task);
        assert_eq!(learnt != lesson.learnt(), own, "{task}: {learnt}");
        let ends = |harness: &Harness<'_, Lab>| harness.query_all_by_label(&learnt).count();
        assert_eq!(ends(&reader.harness), 1, "{task}: {learnt}");
        assert!(reader.harness.query_by_label(lesson.text()).is_none(), "{task}: the task gives way to it");
        // and goes on to the next
        reader.click("Next");
        reader.harness.run_steps(3);
        assert_eq!((under_way(&reader.harness).lesson, ends(&reader.harness)), (lesson.next().unwrap(), 0));
    }
}

#[test]
fn a_hint_begins_its_lesson_and_all_tasks_ends_it() {
    let mut reader = Reader::new();
    let held = motion_lab_sim::manifest::Lesson::of("held").unwrap();
    ui(&mut reader.harness, |ui| {
        ui.settings.world = 2;
        ui.settings.show_hints(motion_lab_sim::manifest::Widget::Dashboard);
    });
    reader.harness.run_steps(2);
    reader.click(motion_lab_sim::manifest::Lesson::of("two_elbows").unwrap().text());
    assert_eq!(
        (under_way(&reader.harness).lesson.id().as_str(), interface(&reader.harness).settings.world),
        ("two_elbows", 1)
    );
    assert!(reader.harness.get_by_label(held.text()).rect().width() < 30.0, "the other tasks are dots");
    reader.click("One tip, two elbows");
    let start = reader.now();
    while under_way(&reader.harness).took.is_none() {
        reader.harness.step();
        assert!(reader.now() - start < LONGEST);
    }
    reader.harness.run_steps(2);
    reader.click("Again");
    assert_eq!(under_way(&reader.harness).took, None);
    reader.click("All tasks");
    assert!(interface(&reader.harness).lesson.is_none() && reader.harness.query_by_label(held.text()).is_some());
}

#[test]
fn on_a_phone_the_task_stands_under_the_picture_in_every_widget() {
    for lesson in ["two_headings", "near", "over_edge", "pick_wall", "find_path"] {
        let lesson = motion_lab_sim::manifest::Lesson::of(lesson).unwrap();
        let mut harness = lab(PHONE);
        ui(&mut harness, |ui| ui.begin(lesson));
        harness.run_steps(3);
        let text = match lesson.id().as_str() {
            "pick_wall" => "Which wall is a list? Edit: tap one, and read its points.",
            _ => lesson.text(),
        };
        let place = harness.get_by_label(text).rect();
        assert!(place.top() > 0.55 * PHONE[1] && place.bottom() < PHONE[1] && place.right() <= PHONE[0], "{place:?}");
        // once it is done, what it removes stands among the words, once
        ui(&mut harness, |ui| ui.lesson.as_mut().unwrap().took = Some(3.0));
        harness.run_steps(3);
        let removed = &lesson.widget.text().misconception;
        assert_eq!(harness.query_all_by_label(removed).count(), 1, "{removed}");
    }
}

#[test]
fn a_lesson_leaves_no_edit_of_a_world_behind() {
    let mut reader = Reader::new();
    reader.click("Atlas");
    reader.click("Edit");
    let wall = at(&reader.harness, [4.0, 6.0]);
    reader.click_at(wall);
    reader.click("Delete");
    let edited = interface(&reader.harness).atlas.world().clone();
    ui(&mut reader.harness, |ui| ui.begin(motion_lab_sim::manifest::Lesson::of("edit_world").unwrap()));
    reader.harness.run_steps(3);
    let state = interface(&reader.harness);
    assert_eq!(
        (state.atlas.world(), under_way(&reader.harness).took),
        (&motion_lab_core::worlds::World::apartment(), None)
    );
    assert!(state.shelf.iter().any(|kept| *kept.world() == edited), "what was edited is on the shelf");
}

#[test]
fn a_task_of_the_rover_is_not_done_by_the_car() {
    let mut harness = lab(WIDE);
    harness.key_press(Key::Num3);
    harness.run_steps(3);
    harness.key_down(Key::ArrowUp);
    let is_held = |harness: &Harness<'_, Lab>| {
        let car = &harness.state().app.world().resource::<ShownDashboard>().0.cockpits[2].robots[0];
        car.manual && car.flash
    };
    let is_seen = (0..60).any(|_| {
        harness.run_steps(20);
        is_held(&harness)
    });
    harness.run_steps(5);
    assert!(is_seen, "it drove into something");
    assert!(!interface(&harness).settings.done.iter().any(|task| task == "Held"));
}
