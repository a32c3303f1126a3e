//! `Prompt`, a question whose answer is guessed before it is shown.

mod series;

use super::{Anatomy, SweptMotion};
use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::configuration::Configuration;
use motion_lab_core::geometry::{Part, Point2};
use motion_lab_core::robots::AnyRobot;
pub use series::PromptSeries;

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
    /// A number of the pose of the middle of a part: x, y or the heading.
    Middle {
        part: usize,
        number: usize,
    },
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
#[error("{}", if .0.trim().is_empty() { "write a number, such as 0.05".to_owned() } else { format!("{:?} is no number; write it as 0.05", .0) })]
pub struct NoGuess(pub String);

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
            PromptQuestion::Middle { part, number } => {
                self.shown.footprint().parts().get(part).map_or(f64::NAN, |part| pose_of_middle(part)[number])
            }
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

/// The pose of the middle of a rectangle: x, y and heading.
fn pose_of_middle(part: &Part) -> [f64; 3] {
    let corners = part.placed().core().to_vec();
    let mean = |of: fn(&Point2) -> f64| corners.iter().map(of).sum::<f64>() / corners.len() as f64;
    [mean(|p| p.x), mean(|p| p.y), part.pose().theta]
}

/// The angle of joint 2 at a motion's first contact.
fn angle_of_contact(sweep: &SweptMotion) -> f64 {
    match sweep.verdict {
        EdgeVerdict::Hit { contact_at, .. } => sweep.at(contact_at).coordinates().get(1).copied().unwrap_or(f64::NAN),
        _ => f64::NAN,
    }
}
