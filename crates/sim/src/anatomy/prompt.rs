//! `Prompt`, a question whose answer is guessed before it is shown.

use std::f64::consts::FRAC_PI_2;

use super::{Anatomy, SweptMotion, Tab, WorldSource};
use motion_lab_core::collision::{Checker, EdgeVerdict, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::robots::{AnyRobot, RUSTY};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

/// A question whose answer is a number, first guessed, then shown.
#[derive(Clone, Debug)]
pub struct Prompt {
    /// A stable name.
    pub id: &'static str,
    /// The question.
    pub question: &'static str,
    /// The unit of the answer, such as `m`.
    pub unit: &'static str,
    /// Largest error of a right guess, in the unit.
    pub tolerance: f64,
    /// The explanation to show with the answer.
    pub moral: &'static str,
    asked: PromptQuestion,
    shown: Anatomy,
}

/// What a prompt asks about the anatomy that it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum PromptQuestion {
    Distance,
    /// The angle of joint 2 at its first contact on the swept tab's motion, radians.
    FirstContact,
    /// The number of configurations whose tip is there.
    Arms(Point2),
}

/// A series of prompts, asked one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PromptSeries {
    /// Distances and contacts.
    Queries,
    /// How many arms reach a tip.
    Tips,
}

/// The result of a guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guess {
    /// Within the tolerance.
    Right {
        /// The answer in full, in the prompt's unit.
        answer: f64,
    },
    /// Outside the tolerance.
    Off {
        /// The answer in full, in the prompt's unit.
        answer: f64,
        /// The guess less the answer.
        by: f64,
    },
}

/// Why a text is no guess.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no number; write it as 0.05")]
pub struct NoGuess(pub String);

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
            PromptSeries::Queries => &[thick_links, touching, exercise_3, first_contact, rusty],
            PromptSeries::Tips => &[stretched, too_far, within],
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

/// A prompt for the number of arms with links of 1 m that reach a tip this far to the right of the base.
fn arms(id: &'static str, question: &'static str, far: f64, moral: &'static str) -> Prompt {
    let mut shown = Anatomy::default();
    shown.drag(Point2::new(far, 0.0));
    shown.show_annulus = true;
    Prompt { id, question, unit: "", tolerance: 0.0, moral, asked: PromptQuestion::Arms(Point2::new(far, 0.0)), shown }
}

fn stretched() -> Prompt {
    arms(
        "stretched",
        "Both links are 1 m long. How many configurations have the tip 2 m from the base, at one point?",
        2.0,
        "On the circle around the annulus the arm is straight: the two elbows are one.",
    )
}

fn too_far() -> Prompt {
    arms("too far", "And 2.5 m from the base?", 2.5, "Outside of the annulus no arm ends.")
}

fn within() -> Prompt {
    arms("within", "And 1 m from the base?", 1.0, "Within the annulus there are two: elbow down and elbow up.")
}

impl Prompt {
    /// The answer, in the prompt's unit, from the checker and the arm; not a number if there is none.
    pub fn answer(&self) -> f64 {
        match self.asked {
            PromptQuestion::Distance => self.shown.distance(),
            PromptQuestion::FirstContact => self.shown.sweep().map_or(f64::NAN, |sweep| angle_of_contact(&sweep)),
            PromptQuestion::Arms(tip) => match self.shown.checker().robot() {
                AnyRobot::Reach(arm) => arm.ik(tip).iter().flatten().count() as f64,
                _ => f64::NAN,
            },
        }
    }

    /// The anatomy shown with the answer.
    pub fn shown(&self) -> &Anatomy {
        &self.shown
    }

    /// Compares a guess with the answer. A guess that is not finite is off.
    pub fn check(&self, guess: f64) -> Guess {
        let answer = self.answer();
        let by = guess - answer;
        if by.abs() <= self.tolerance { Guess::Right { answer } } else { Guess::Off { answer, by } }
    }

    /// As [`check`](Self::check), for a guess as typed: a number, with or without its unit after it.
    ///
    /// # Errors
    /// [`NoGuess`] when the text is no finite number.
    pub fn check_text(&self, text: &str) -> Result<Guess, NoGuess> {
        let typed = text.trim().trim_end_matches(char::is_alphabetic).trim_end().replace('\u{2212}', "-");
        match typed.parse::<f64>() {
            Ok(guess) if guess.is_finite() => Ok(self.check(guess)),
            _ => Err(NoGuess(text.to_owned())),
        }
    }

    /// What comes of a guess, in words: whether it is right, the answer, the moral.
    pub fn words(&self, guess: Guess) -> String {
        let unit = self.unit;
        let signed = |by: String| by.replace('-', "\u{2212}");
        let (before, answer) = match guess {
            Guess::Right { answer } => ("Right: ".to_owned(), answer),
            Guess::Off { answer, by } if unit.is_empty() => (signed(format!("Off by {by:+}: it is ")), answer),
            Guess::Off { answer, by } => (signed(format!("Off by {by:+.4} {unit}: it is ")), answer),
        };
        let answer = match unit {
            "" => answer.to_string(),
            // the bracket about a first contact is a micrometre wide
            "rad" => format!("{answer:.4} {unit}"),
            _ => format!("{answer:.6} {unit}"),
        };
        format!("{before}{answer}. {}", self.moral)
    }
}

/// The angle of joint 2 at a motion's first contact.
fn angle_of_contact(sweep: &SweptMotion) -> f64 {
    match sweep.verdict {
        EdgeVerdict::Hit { contact_at, .. } => sweep.at(contact_at).coordinates().get(1).copied().unwrap_or(f64::NAN),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::num::{cos, sin, sqrt};

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
    fn the_other_answers_are_the_specifications() {
        assert!((prompt("first contact").answer() - 1.400_877_9).abs() < 1e-6);
        assert!((prompt("the rover").answer() - 0.89).abs() < 1e-12);
        assert_eq!(["stretched", "too far", "within"].map(|id| prompt(id).answer()), [1.0, 0.0, 2.0]);
        let (far, near) = (prompt("too far"), prompt("the rover"));
        assert_eq!(far.words(far.check(2.0)), "Off by +2: it is 0. Outside of the annulus no arm ends.");
        assert!(near.words(near.check(0.89)).starts_with("Right: 0.890000 m. "));
        assert_eq!(PromptSeries::Tips.prompt(3).id, "stretched", "they begin anew");
    }
}
