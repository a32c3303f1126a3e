//! Where things are: pictures have their share of any window, no words are cut, nothing moves that nobody moved.

use super::*;
use crate::window::tests::safe::{read_whole, words};
use crate::window::ui::Settings;
use motion_lab_sim::manifest::Widget;

const LOW: [[f32; 2]; 2] = [[640.0, 400.0], [844.0, 390.0]];

/// Width of the rail and of the margins beside a picture, points.
const RAIL: f32 = 132.0;

/// A paused lab with a widget in front and its hints shown.
pub fn fresh(size: [f32; 2], widget: Widget) -> Harness<'static, Lab> {
    let mut harness = lab(size);
    pause(&mut harness);
    let state = interface_mut(&mut harness);
    (state.settings, state.widget) = (Settings::default(), widget);
    harness.run_steps(6);
    harness
}

/// The papers of a widget: the world, or both pictures.
fn papers(harness: &Harness<'_, Lab>, widget: Widget) -> Vec<egui::Rect> {
    let described: &[&str] = match widget {
        Widget::Dashboard => return vec![paper(harness, "Apartment")],
        Widget::Anatomy => &["Reach at T2"],
        Widget::Cspace => &["workspace. Reach", "configuration space. The robot"],
        Widget::Atlas => &["World Apartment"],
        Widget::Plan => &["workspace. RRT-Connect", "configuration space. "],
    };
    described.iter().map(|words| harness.get_by_label_contains(words).rect()).collect()
}

#[test]
fn in_a_low_window_the_picture_has_half_the_height() {
    for size in LOW {
        for widget in Widget::ALL {
            let harness = fresh(size, widget);
            for paper in papers(&harness, widget) {
                let window = egui::Rect::from_min_size(Pos2::ZERO, size.into());
                assert!(paper.height() >= 0.5 * size[1], "{widget:?} at {size:?}: {paper}");
                assert!(window.contains_rect(paper), "{widget:?} at {size:?}: {paper}");
            }
            // the way to all else
            harness.get_by_label("Menu");
            Widget::ALL.into_iter().for_each(|other| _ = harness.get_by_label(other.text().short()));
        }
        let harness = fresh(size, Widget::Dashboard);
        for name in ["Rusty", "Reach", "Hitch", "Pause", "Step", "More", "seed"] {
            let name = if name == "Pause" { "Play" } else { name };
            let rect = harness.get_by_label(name).rect();
            assert!(rect.right() <= size[0] && rect.bottom() <= size[1], "{name} at {size:?}: {rect}");
        }
        let time = words(&harness).into_iter().find(|(text, ..)| text.contains(" s  tick ")).expect("the time");
        assert!(time.2.expand(0.5).contains_rect(time.1), "{time:?} at {size:?}");
    }
}

#[test]
fn upright_the_picture_is_as_wide_as_the_window() {
    for (size, rail) in [(TABLET, RAIL), (PHONE, 40.0), ([360.0, 640.0], 40.0)] {
        let harness = fresh(size, Widget::Dashboard);
        let paper = paper(&harness, "Apartment");
        assert!(paper.width() >= size[0] - rail - 2.0, "{size:?}: {paper}");
    }
    let wide = TABLET[0] - RAIL;
    for widget in [Widget::Anatomy, Widget::Atlas] {
        let harness = fresh(TABLET, widget);
        let paper = papers(&harness, widget)[0];
        assert!(paper.width() >= wide - 2.0 && paper.height() < 0.7 * TABLET[1], "{widget:?}: {paper}");
    }
    for widget in [Widget::Cspace, Widget::Plan] {
        let harness = fresh(TABLET, widget);
        let papers = papers(&harness, widget);
        assert!(papers.iter().all(|paper| paper.width() >= 0.52 * wide), "{widget:?}: {papers:?}");
        assert!((papers[1].top() - papers[0].bottom()).abs() < 12.0, "no hole between them: {papers:?}");
    }
}

#[test]
fn what_is_said_of_the_robot_in_front_is_read_whole() {
    let mut harness = fresh(WIDE, Widget::Dashboard);
    harness.run_steps(4);
    for plots in [false, true] {
        interface_mut(&mut harness).settings.plots = plots;
        interface_mut(&mut harness).settings.world = 0;
        harness.run_steps(6);
        for said in ["Rusty \u{b7} Apartment", "clearance: ", "scan", "nearest points", "doors", "d\u{3b8}/dt"] {
            read_whole(&harness, said);
        }
        bring(&mut harness, "Hitch");
        harness.run_steps(6);
        let links = ["One place, two headings", "contacts: ", "reversals", "put a trailer on", "dx/dt"];
        links.into_iter().for_each(|said| _ = read_whole(&harness, said));
        click(&mut harness, "One place, two headings");
        harness.run_steps(6);
        links.into_iter().for_each(|said| _ = read_whole(&harness, said));
        click(&mut harness, "put a trailer on");
        click(&mut harness, "Step");
        harness.run_steps(6);
        let links =
            ["take the trailer off", "resume tour", "goal: one metre to the left", "trailer: Some", "d\u{3c8}/dt"];
        links.into_iter().for_each(|said| _ = read_whole(&harness, said));
        read_whole(&harness, "Its configuration: x, y");
        click(&mut harness, "take the trailer off");
        click(&mut harness, "Step");
        click(&mut harness, "One place, two headings");
        bring(&mut harness, "Reach");
        harness.run_steps(6);
        let links = ["three links", "One tip, two elbows", "tip: ("];
        links.into_iter().for_each(|said| _ = read_whole(&harness, said));
        // beside a small world and over the plots the words have all the room
        if !plots {
            read_whole(&harness, "Its configuration: a torus");
        }
    }
}

#[test]
fn ticking_off_a_hint_moves_nothing() {
    for width in [820.0, 1000.0, 1280.0, 1920.0] {
        for widget in Widget::ALL {
            let mut harness = fresh([width, 800.0], widget);
            let before = papers(&harness, widget);
            let hints = &widget.text().hints;
            for turned in 0..hints.len() {
                for count in 1..=hints.len() {
                    let done = hints.iter().cycle().skip(turned).take(count);
                    interface_mut(&mut harness).settings.done = done.map(|hint| hint.task.id().to_owned()).collect();
                    harness.run_steps(2);
                    assert_eq!(papers(&harness, widget), before, "{widget:?} at {width}: {count} from {turned}");
                    // the sentence is that of the first that is left, and of none the misconception
                    let is_done = |id: String| interface(&harness).settings.done.contains(&id);
                    let left = hints.iter().find(|hint| !is_done(hint.task.id().to_owned()));
                    let said = left.map_or(&widget.text().misconception, |hint| &hint.text);
                    let ink = harness.get_by_label(said).rect();
                    assert!(ink.top() > before[0].bottom() && ink.width() > 100.0, "{widget:?}: {ink}");
                }
            }
        }
    }
}

#[test]
fn the_papers_of_a_plan_are_equally_high_or_equally_wide() {
    let harness = fresh(WIDE, Widget::Plan);
    let [left, right] = papers(&harness, Widget::Plan)[..] else { panic!("two papers") };
    assert!((left.height() - right.height()).abs() < 1.0 && left.top() == right.top(), "{left} {right}");
    // the figures at the axes of the other take of the width
    assert!(left.height() > 420.0, "{left}");
    let harness = fresh(PHONE, Widget::Plan);
    let [above, below] = papers(&harness, Widget::Plan)[..] else { panic!("two papers") };
    assert!((above.width() - below.width()).abs() < 1.0, "{above} {below}");
    assert!((above.center().x - 0.5 * PHONE[0]).abs() < 2.0, "in the middle: {above}");
}

#[test]
fn the_lanes_of_a_phone_have_their_names_in_whole() {
    let shown = words(&fresh(PHONE, Widget::Dashboard));
    for name in ["Rusty", "Reach", "Hitch"] {
        // beside its lane, and above the picture where it is brought to the front
        assert_eq!(shown.iter().filter(|(text, ..)| text == name).count(), 2, "{name}");
    }
}

#[test]
fn numbers_of_the_space_stay_with_their_names() {
    for size in [WIDE, TABLET, PHONE] {
        let harness = fresh(size, Widget::Cspace);
        for said in ["proven free ", "proven blocked ", "not known "] {
            let ink = read_whole(&harness, said);
            assert!(ink.height() < 14.0 && ink.width() < 160.0, "{said} at {size:?}: {ink}");
        }
    }
    for size in [WIDE, TABLET] {
        let harness = fresh(size, Widget::Cspace);
        let last = harness.get_by_label("as a torus").rect();
        assert!(last.bottom() <= size[1], "the last row ends in the window of {size:?}: {last}");
    }
    let mut harness = fresh(WIDE, Widget::Cspace);
    click(&mut harness, "Guess first");
    let field = harness.get_by_label("length of link 1").rect();
    let is_named =
        |(text, ink, _): &(String, egui::Rect, egui::Rect)| text.starts_with("L1") && field.contains_rect(*ink);
    assert!(words(&harness).iter().any(is_named), "a field has its name in it");
    let right = papers(&harness, Widget::Cspace)[1];
    let question = read_whole(&harness, "How many configurations");
    assert!(right.x_range().contains(question.left()) && question.right() <= right.right(), "{question} under {right}");
}

#[test]
fn each_widget_has_a_scroll_position_of_its_own() {
    let mut harness = lab([390.0, 520.0]);
    let marks = [("Query", "Copy as Rust"), ("Space", "the tip's reach"), ("Plan", "Save path")];
    let top = |harness: &mut Harness<'_, Lab>, (widget, mark): (&str, &str)| {
        front(harness, widget);
        harness.get_by_label(mark).rect().top()
    };
    let mut before = marks.map(|mark| top(&mut harness, mark));
    for (i, scrolled) in marks.into_iter().enumerate() {
        top(&mut harness, scrolled);
        harness.get_by_label(scrolled.1).scroll_to_me();
        harness.run_steps(20);
        let now = harness.get_by_label(scrolled.1).rect().top();
        assert!(now < before[i] - 20.0, "{scrolled:?} scrolls: {} to {now}", before[i]);
        before[i] = now;
        assert_eq!(marks.map(|mark| top(&mut harness, mark)), before, "{scrolled:?} alone");
    }
}

#[test]
fn words_at_the_pointer_go_once_the_robot_was_dragged() {
    let hint = "Drag the robot: an arm by its tip";
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    let paper = harness.get_by_label_contains("Reach at T2").rect();
    let says = |harness: &mut Harness<'_, Lab>, at: Pos2| {
        pointer(harness, at, None);
        harness.run_steps(60);
        words(harness).iter().any(|(text, ..)| text == hint)
    };
    assert!(says(&mut harness, paper.center()));
    pointer(&mut harness, paper.center(), Some(true));
    (1..=5).for_each(|i| pointer(&mut harness, paper.center() + egui::vec2(9.0 * i as f32, 0.0), None));
    pointer(&mut harness, paper.center() + egui::vec2(45.0, 0.0), Some(false));
    assert!(!says(&mut harness, paper.center() + egui::vec2(45.0, 30.0)), "it is known now");
    front(&mut harness, "Plan");
    front(&mut harness, "Query");
    assert!(!says(&mut harness, paper.center()));
}

#[test]
fn the_lists_of_keys_are_aligned_and_say_what_the_pointer_does() {
    let mut harness = lab(WIDE);
    interface_mut(&mut harness).help = true;
    harness.run_steps(4);
    let words = ["play or pause", "turn or steer left", "leave the handle", "show the whole of it", "redo"];
    let left = words.map(|words| harness.get_all_by_label(words).next().unwrap().rect().left());
    assert!(left.iter().all(|x| *x == left[0]), "{left:?}");
}

#[test]
fn no_word_of_a_widget_is_cut_off_at_its_right_where_320_points_are_all_the_width() {
    for widget in Widget::ALL {
        let harness = fresh([320.0, 1400.0], widget);
        for (text, ink, seen) in words(&harness) {
            // what scrolls below is not drawn
            let is_cut = seen.height() > 0.0 && seen.right() < ink.right() - 0.5;
            assert!(!is_cut, "{widget:?}: {text:?} at {ink} ends at {}", seen.right());
        }
    }
}

#[test]
fn on_a_phone_the_configuration_stands_below_the_world_and_both_take_near_half_the_height() {
    for (world, robot) in [(0, "Rusty"), (2, "Hitch")] {
        let mut harness = lab(PHONE);
        interface_mut(&mut harness).settings.world = world;
        harness.run_steps(6);
        let paper = paper(&harness, ["Apartment", "Workbench", "Lot"][world as usize]);
        let space = harness.get_by_label_contains(&format!("Configuration of {robot}")).rect();
        assert!(space.top() > paper.bottom() && space.width() > 150.0, "{robot}: {paper} {space}");
        assert!(space.bottom() - paper.top() >= 0.45 * PHONE[1], "{robot}: {paper} {space}");
    }
}

#[test]
fn on_a_phone_the_picture_stands_under_the_name_of_its_widget_alone() {
    for widget in [Widget::Anatomy, Widget::Cspace, Widget::Atlas, Widget::Plan] {
        let harness = fresh(PHONE, widget);
        let text = widget.text();
        let top = papers(&harness, widget)[0].top();
        // the rail is 44 points high and the row of name and menu too, with 4 to 8 points about each
        assert!(top <= 2.0 * 44.0 + 40.0, "{widget:?}: {top}");
        let said = words(&harness);
        let misconception = said.iter().find(|(words, ..)| *words == text.misconception);
        assert!(misconception.is_none_or(|(_, ink, _)| ink.top() > top), "{widget:?}: {misconception:?}");
        assert!(harness.query_by_label(&text.misconception).is_some(), "{widget:?}: it is under the picture");
    }
}

#[test]
fn on_a_phone_each_lane_of_time_has_its_name() {
    let harness = fresh(PHONE, Widget::Dashboard);
    let said = words(&harness);
    let line = harness.get_by_label_contains("time line").rect();
    for name in ["Rusty", "Reach", "Hitch"] {
        // three lanes of 12 points stand on the line, whose handle keeps off its left end
        let lanes = egui::Rect::from_x_y_ranges(8.0..=line.left() + 18.0, line.top() - 42.0..=line.top() + 2.0);
        let is_lane = |ink: egui::Rect| lanes.contains_rect(ink);
        assert!(said.iter().any(|(text, ink, _)| text == name && is_lane(*ink)), "{name} in {lanes}: {said:?}");
    }
}

#[test]
fn beside_an_arm_of_three_links_the_caption_says_where_its_plane_lies() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    click(&mut harness, "three links");
    harness.run_steps(4);
    let q = harness.state().robot(1).coordinates;
    let caption = format!("\u{3b8}\u{2082} and \u{3b8}\u{2083} at \u{3b8}\u{2081} = {:.2}", q[0]);
    let said = words(&harness);
    let is_there = said.iter().any(|(text, ..)| text.replace('\u{2212}', "-").contains(&caption));
    assert!(is_there, "{caption} of {said:?}");
}

#[test]
fn in_a_small_window_both_pictures_stand_side_by_side_where_they_are_larger_so() {
    for widget in [Widget::Cspace, Widget::Plan] {
        let harness = fresh([600.0, 500.0], widget);
        let [left, right] = papers(&harness, widget)[..] else { panic!("two papers") };
        assert!(left.height() > 160.0 && right.height() > 160.0, "{widget:?}: {left} {right}");
        assert!(left.right() < right.left() && right.right() <= 600.0, "{widget:?}: {left} {right}");
    }
}

#[test]
fn plots_that_come_and_go_move_no_button_above_them() {
    for size in [WIDE, [800.0, 600.0]] {
        let mut harness = fresh(size, Widget::Dashboard);
        let places = |h: &Harness<'_, Lab>| ["Plots", "Undo", "Menu"].map(|name| h.get_by_label(name).rect());
        let before = places(&harness);
        for are_open in [true, false] {
            click_at(&mut harness, before[0].center());
            harness.run_steps(4);
            assert_eq!(interface(&harness).settings.plots, are_open, "{size:?}");
            assert_eq!(places(&harness), before, "{size:?}: the next click on it finds it");
        }
    }
}

#[test]
fn the_entries_of_the_menu_have_their_keys_at_their_right_and_the_last_is_scrolled_to() {
    let mut harness = lab([600.0, 500.0]);
    pause(&mut harness);
    harness.get_by_label("Menu").click();
    harness.run_steps(4);
    let said = words(&harness);
    for (name, keys) in [("Open", "Ctrl+O"), ("Redo", "Ctrl+Shift+Z"), ("Plots", "P"), ("Names", "T")] {
        let entry = harness.get_by_label(name).rect();
        let here = said.iter().filter(|(text, ink, _)| text == keys && entry.contains_rect(*ink));
        let key = here.map(|(_, ink, _)| ink.center().x).next().unwrap_or_else(|| panic!("{keys} in {name}: {entry}"));
        assert!(key > entry.center().x, "{keys} at {key} in {entry}");
    }
    assert!(harness.get_by_label("Dark theme").rect().bottom() > 500.0, "there are more than fit");
    harness.get_by_label("Dark theme").scroll_to_me();
    harness.run_steps(20);
    assert!(harness.get_by_label("Dark theme").rect().bottom() < 500.0);
    // opened again, it begins at its top
    harness.get_by_label("Menu").click();
    harness.run_steps(4);
    harness.get_by_label("Menu").click();
    harness.run_steps(4);
    assert!(harness.get_by_label("Open").rect().top() > harness.get_by_label("Menu").rect().bottom());
    harness.get_by_label("Dark theme").scroll_to_me();
    harness.run_steps(20);
    click(&mut harness, "Dark theme");
    assert_eq!(interface(&harness).settings.theme, motion_lab_sim::manifest::ThemeChoice::Dark);
    // where there is room for all of it, nothing is scrolled to
    let mut harness = lab(WIDE);
    harness.get_by_label("Menu").click();
    harness.run_steps(4);
    read_whole(&harness, "Dark theme");
}
