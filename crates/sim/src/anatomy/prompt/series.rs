//! `PromptSeries`, the prompts in their order.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use super::{Prompt, PromptQuestion};
use crate::anatomy::{Anatomy, Tab, WorldSource};
use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::{AnyConfiguration, HitchCfg};
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::robots::{AnyRobot, HITCH, RUSTY};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

/// A series of prompts, asked one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PromptSeries {
    /// Distances and contacts, and the set that a car with its trailer covers.
    Queries,
    /// How many arms reach a tip.
    Tips,
}

impl PromptSeries {
    /// The number of its prompts.
    pub fn count(self) -> usize {
        self.prompts().len()
    }

    /// A prompt of it, by its number from 0; past the last comes the first again.
    pub fn prompt(self, number: usize) -> Prompt {
        let prompts = self.prompts();
        prompts[number % prompts.len()]()
    }

    fn prompts(self) -> &'static [fn() -> Prompt] {
        match self {
            PromptSeries::Queries => &[
                thick_links,
                touching,
                exercise_3,
                first_contact,
                rusty,
                || middle(0, 0),
                || middle(0, 1),
                || middle(0, 2),
                || middle(1, 0),
                || middle(1, 1),
                || middle(1, 2),
            ],
            PromptSeries::Tips => &[stretched, too_far, within, inner, hole],
        }
    }
}

fn thick_links() -> Prompt {
    let mut thick = Anatomy::default();
    thick.set_thick_links(true);
    Prompt {
        id: "thick links",
        question: "At q = (\u{3c0}/4, \u{3c0}/2) the links are given a radius of 3 cm. How far is the arm from the block then?",
        unit: "m",
        // four decimals, as the distance is shown
        tolerance: 0.5e-4,
        moral: "A radius is taken off the distance of the bare links, exactly.",
        asked: PromptQuestion::Distance,
        shown: thick.with_tab(Tab::Distance),
    }
}

/// The first half of exercise 3.
fn touching() -> Prompt {
    Prompt {
        id: "exercise 3, first",
        question: "A square of side 0.2 stands around (1, 1). How far from it is the bare arm at q = (0, \u{3c0}/2)?",
        unit: "m",
        // three decimals
        tolerance: 0.5e-3,
        moral: "The tip is in the middle of the square: the distance of what overlaps or touches is 0.",
        asked: PromptQuestion::Distance,
        shown: Anatomy::exercise_3().with_tab(Tab::Distance),
    }
}

/// The second half of exercise 3.
fn exercise_3() -> Prompt {
    let mut tilted = Anatomy::exercise_3();
    tilted.set_coordinate(1, FRAC_PI_2 + 0.3);
    Prompt {
        id: "exercise 3",
        question: "Joint 2 turns on by 0.3, to (0, \u{3c0}/2 + 0.3). How far from the square of side 0.2 around (1, 1) is link 2 then?",
        unit: "m",
        // three decimals
        tolerance: 0.5e-3,
        moral: "The nearest point is the square's corner (0.9, 0.9): 0.9 sin 0.3 \u{2212} 0.1 cos 0.3.",
        asked: PromptQuestion::Distance,
        shown: tilted.with_tab(Tab::Witness),
    }
}

fn first_contact() -> Prompt {
    let mut unbent = Anatomy::default();
    unbent.set_step(0, 0.0);
    unbent.set_step(1, -0.5);
    Prompt {
        id: "first contact",
        question: "At q = (\u{3c0}/4, \u{3c0}/2) joint 2 unbends. \
                   At which \u{3b8}\u{2082} does the arm first touch the block?",
        unit: "rad",
        tolerance: 0.5e-3,
        moral: "Link 2 then points from the elbow at the block's corner (0.5, 1).",
        asked: PromptQuestion::FirstContact,
        shown: unbent.with_tab(Tab::Swept),
    }
}

fn rusty() -> Prompt {
    let wall = Shape::Segment { a: Point2::new(3.0, 0.0), b: Point2::new(3.0, 3.0) };
    let mut world = World::empty("A wall", Aabb::new(Point2::new(1.0, -0.2), Point2::new(4.4, 3.2)));
    world.obstacles.push(Obstacle::new("the wall", ObstacleKind::Wall, vec![(Pose2::IDENTITY, wall)]));
    let checker = Checker::new(Scene::of_world(&world), AnyRobot::Rusty(RUSTY));
    let q = AnyConfiguration::Pose(Pose2::new(2.0, 1.0, 0.0));
    Prompt {
        id: "the rover",
        question: "Rusty's centre is at (2, 1), a wall goes from (3, 0) to (3, 3). How far is Rusty from it?",
        unit: "m",
        tolerance: 0.5e-3,
        moral: "A metre less its radius of 0.11 m: a disc is not a point.",
        asked: PromptQuestion::Distance,
        shown: Anatomy::of(world, WorldSource::Unsaved, checker, q, &[0.5]).with_tab(Tab::Witness),
    }
}

/// The prompts of exercise 2: the poses of the two rectangles that the car with its trailer covers.
const MIDDLES: [[(&str, &str, &str); 3]; 2] = [
    [
        (
            "the car, x",
            "Hitch's rear axle is at (5, 5), it faces \u{3c0}/2 and its trailer \u{3c0}/6. The car's rectangle is 3.9 m long and \
             reaches 0.7 m behind the rear axle. At which x is the rectangle's middle?",
            "The middle is half the length less the overhang ahead of the axle: x + (3.9/2 \u{2212} 0.7) cos \u{3b8}.",
        ),
        ("the car, y", "And at which y is the middle of the car's rectangle?", "y + (3.9/2 \u{2212} 0.7) sin \u{3b8}."),
        (
            "the car, heading",
            "And which way does the car's rectangle face?",
            "As the car does: \u{3b8}. The trailer's heading is not in it, nor is the steering angle.",
        ),
    ],
    [
        (
            "the trailer, x",
            "The trailer hangs at the rear axle, (5, 5), and faces \u{3c0}/6. Its axle is d_h = 2 m behind the hitch, and its \
             rectangle reaches 1 m ahead of that axle and 0.8 m behind it. At which x is the rectangle's middle?",
            "The middle is 0.1 m ahead of the axle: x \u{2212} (d_h \u{2212} (1 \u{2212} 0.8)/2) cos \u{3c8}.",
        ),
        (
            "the trailer, y",
            "And at which y is the middle of the trailer's rectangle?",
            "y \u{2212} (d_h \u{2212} (1 \u{2212} 0.8)/2) sin \u{3c8}.",
        ),
        (
            "the trailer, heading",
            "And which way does the trailer's rectangle face?",
            "\u{3c8}, an angle of the world, not one with the car.",
        ),
    ],
];

fn middle(part: usize, number: usize) -> Prompt {
    let (id, question, moral) = MIDDLES[part][number];
    let world = World::empty("A yard", Aabb::new(Point2::new(1.0, 2.0), Point2::new(9.0, 10.0)));
    let checker = Checker::new(Scene::of_world(&world), AnyRobot::Hitch(HITCH.with_trailer()));
    let q = HitchCfg { body: Pose2::new(5.0, 5.0, FRAC_PI_2), trailer: Some(FRAC_PI_6) };
    let shown = Anatomy::of(world, WorldSource::Unsaved, checker, AnyConfiguration::Hitch(q), &[0.5]);
    Prompt {
        id,
        question,
        unit: if number == 2 { "rad" } else { "m" },
        tolerance: 0.5e-3,
        moral,
        asked: PromptQuestion::Middle { part, number },
        shown: shown.with_tab(Tab::Intersects),
    }
}

/// A prompt for the number of arms that reach a tip this far to the right of the base, with a first link of 1 m and a
/// second one of this length.
fn arms(id: &'static str, question: &'static str, (second, far): (f64, f64), moral: &'static str) -> Prompt {
    let mut shown = Anatomy::default();
    shown.set_length(1, second);
    shown.drag(Point2::new(far, 0.0));
    shown.show_annulus = true;
    Prompt { id, question, unit: "", tolerance: 0.0, moral, asked: PromptQuestion::Arms(Point2::new(far, 0.0)), shown }
}

fn stretched() -> Prompt {
    arms(
        "stretched",
        "Both links are 1 m long. How many configurations have the tip 2 m from the base, at one point?",
        (1.0, 2.0),
        "On the circle around the annulus the arm is straight: the two elbows are one.",
    )
}

fn too_far() -> Prompt {
    arms("too far", "And 2.5 m from the base?", (1.0, 2.5), "Outside of the annulus no arm ends.")
}

fn within() -> Prompt {
    arms("within", "And 1 m from the base?", (1.0, 1.0), "Within the annulus there are two: elbow down and elbow up.")
}

fn inner() -> Prompt {
    arms(
        "the inner circle",
        "Now link 2 is 0.4 m long. How many configurations have the tip 0.6 m from the base, at one point?",
        (0.4, 0.6),
        "On the circle of radius |L\u{2081} \u{2212} L\u{2082}| the arm is folded: the two elbows are one again.",
    )
}

fn hole() -> Prompt {
    arms(
        "the hole",
        "And 0.5 m from the base?",
        (0.4, 0.5),
        "Nearer than |L\u{2081} \u{2212} L\u{2082}| no arm ends: the annulus has a hole.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{Guess, NoGuess};
    use motion_lab_core::num::{cos, sin, sqrt};
    use motion_lab_core::robots::CarBody;

    /// The prompt of this name.
    fn prompt(id: &str) -> Prompt {
        let all = [PromptSeries::Queries, PromptSeries::Tips]
            .map(|series| (0..series.count()).map(move |n| series.prompt(n)));
        all.into_iter().flatten().find(|prompt| prompt.id == id).unwrap()
    }

    #[test]
    fn the_chapters_numbers_are_right_and_their_neighbours_are_not() {
        let [thick, exercise] = ["thick links", "exercise 3"].map(prompt);
        assert!((thick.answer() - (1.5 / sqrt(2.0) - 1.03)).abs() < 1e-9);
        assert!((exercise.answer() - (0.9 * sin(0.3) - 0.1 * cos(0.3))).abs() < 1e-9);
        for (id, right, wrong) in [
            ("thick links", "0.0307", "0.0308"),
            ("thick links", " 0.03066 m ", "0.0607"),
            ("exercise 3, first", "0", "0.1"),
            ("exercise 3", "0.1704", "0.171"),
            ("first contact", "1.4009 rad", "1.4846"),
            ("the rover", "0.89", "1"),
            ("stretched", "1", "2"),
            ("too far", "0", "1"),
            ("within", "2", "3"),
        ] {
            let prompt = prompt(id);
            assert!(matches!(prompt.check_text(right), Ok(Guess::Right { .. })), "{right}");
            let off = prompt.check_text(wrong);
            assert!(matches!(off, Ok(Guess::Off { by, .. }) if by > 0.0), "{wrong} {off:?}");
        }
        assert!(matches!(exercise.check(0.0), Guess::Off { by, .. } if by < 0.0), "touching is what it was before");
        let questions = ["exercise 3, first", "exercise 3"].map(|id| prompt(id).question);
        assert!(!questions[0].contains("touch") && !questions[1].contains("touch"), "neither gives the first away");
        for text in ["", "much", "inf", "NaN", "1e999"] {
            assert_eq!(thick.check_text(text), Err(NoGuess(text.into())));
        }
    }

    #[test]
    fn the_set_of_car_and_trailer_is_two_rectangles_with_these_poses() {
        // by hand: 1.25 m ahead of the axle at (5, 5), and 1.9 m behind it along the trailer's heading
        let (cos, sin) = (sqrt(3.0) / 2.0, 0.5);
        let expected = [5.0, 6.25, FRAC_PI_2, 5.0 - 1.9 * cos, 5.0 - 1.9 * sin, FRAC_PI_6];
        let asked: Vec<Prompt> = (5..11).map(|n| PromptSeries::Queries.prompt(n)).collect();
        for (prompt, expected) in asked.iter().zip(expected) {
            assert!((prompt.answer() - expected).abs() < 1e-12, "{}: {}", prompt.id, prompt.answer());
        }
        let CarBody { length, rear_overhang, .. } = HITCH.body;
        let (hitch, trailer) = (HITCH.with_trailer().hitch_len, HITCH.trailer_body);
        let sizes = (length, rear_overhang, hitch, trailer.front_overhang, trailer.rear_overhang);
        assert_eq!(sizes, (3.9, 0.7, Some(2.0), 1.0, 0.8), "as the questions say");
        assert_eq!(["the inner circle", "the hole"].map(|id| prompt(id).answer()), [1.0, 0.0]);
    }

    #[test]
    fn the_other_answers_are_the_specifications() {
        assert!((prompt("first contact").answer() - 1.400_877_9).abs() < 1e-6);
        assert!((prompt("the rover").answer() - 0.89).abs() < 1e-12);
        assert_eq!(["stretched", "too far", "within"].map(|id| prompt(id).answer()), [1.0, 0.0, 2.0]);
        let (far, near) = (prompt("too far"), prompt("the rover"));
        assert_eq!(far.words(far.check(2.0)), "Off by +2: it is 0. Outside of the annulus no arm ends.");
        assert!(near.words(near.check(0.89)).starts_with("Right: 0.890000 m. "));
        assert_eq!(PromptSeries::Tips.prompt(5).id, "stretched", "they begin anew");
    }
}
