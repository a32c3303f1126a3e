//! `Prompt`, a question whose answer is guessed before it is shown.

use super::{Anatomy, Tab};

/// A question whose answer is a length, first guessed, then shown.
#[derive(Clone, Debug)]
pub struct Prompt {
    /// A stable name.
    pub id: &'static str,
    /// The question.
    pub question: &'static str,
    /// Largest error of a right guess, metres.
    pub tolerance: f64,
    /// The explanation to show with the answer.
    pub moral: &'static str,
    shown: Anatomy,
}

/// The result of a guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guess {
    /// Within the tolerance.
    Right {
        /// The answer in full, metres.
        answer: f64,
    },
    /// Outside the tolerance.
    Off {
        /// The answer in full, metres.
        answer: f64,
        /// The guess less the answer, metres.
        by: f64,
    },
}

/// Why a text is no guess.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no length in metres; write it as 0.05")]
pub struct NoGuess(pub String);

impl Prompt {
    /// The two prompts: the distance with 3 cm links, and exercise 3.
    pub fn all() -> [Prompt; 2] {
        let mut thick = Anatomy::default();
        thick.set_thick_links(true);
        let mut tilted = Anatomy::exercise_3();
        tilted.set_coordinate(1, std::f64::consts::FRAC_PI_2 + 0.3);
        [
            Prompt {
                id: "thick links",
                question: "At q = (\u{3c0}/4, \u{3c0}/2) the links are given a radius of 3 cm. How far is the arm from the block then?",
                // four decimals, as the distance is shown
                tolerance: 0.5e-4,
                moral: "A radius is taken off the distance of the bare links, exactly.",
                shown: thick.with_tab(Tab::Distance),
            },
            Prompt {
                id: "exercise 3",
                question: "At q = (0, \u{3c0}/2) link 2 touches the square. How far from it is link 2 at (0, \u{3c0}/2 + 0.3)?",
                // three decimals
                tolerance: 0.5e-3,
                moral: "The nearest point is the square's corner (0.9, 0.9): 0.9 sin 0.3 \u{2212} 0.1 cos 0.3.",
                shown: tilted.with_tab(Tab::Witness),
            },
        ]
    }

    /// The answer, metres, from the checker.
    pub fn answer(&self) -> f64 {
        self.shown.distance()
    }

    /// The anatomy shown with the answer.
    pub fn shown(&self) -> &Anatomy {
        &self.shown
    }

    /// Compares a guess, metres, with the answer. A guess that is not finite is off.
    pub fn check(&self, guess: f64) -> Guess {
        let answer = self.answer();
        let by = guess - answer;
        if by.abs() <= self.tolerance { Guess::Right { answer } } else { Guess::Off { answer, by } }
    }

    /// As [`check`](Self::check), for a guess as typed: a number, with or without ` m` after it.
    ///
    /// # Errors
    /// [`NoGuess`] when the text is no finite number.
    pub fn check_text(&self, text: &str) -> Result<Guess, NoGuess> {
        let typed = text.trim().trim_end_matches('m').trim_end().replace('\u{2212}', "-");
        match typed.parse::<f64>() {
            Ok(guess) if guess.is_finite() => Ok(self.check(guess)),
            _ => Err(NoGuess(text.to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{cos, sin, sqrt};

    #[test]
    fn the_chapters_numbers_are_right_and_their_neighbours_are_not() {
        let [thick, exercise] = Prompt::all();
        assert!((thick.answer() - (1.5 / sqrt(2.0) - 1.03)).abs() < 1e-9);
        assert!((exercise.answer() - (0.9 * sin(0.3) - 0.1 * cos(0.3))).abs() < 1e-9);
        for (prompt, right, wrong) in
            [(&thick, "0.0307", "0.0308"), (&thick, " 0.03066 m ", "0.0607"), (&exercise, "0.1704", "0.171")]
        {
            assert!(matches!(prompt.check_text(right), Ok(Guess::Right { .. })), "{right}");
            let off = prompt.check_text(wrong);
            assert!(matches!(off, Ok(Guess::Off { by, .. }) if by > 0.0), "{wrong} {off:?}");
        }
        assert!(matches!(exercise.check(0.0), Guess::Off { by, .. } if by < 0.0), "touching is what it was before");
        for text in ["", "much", "inf", "NaN", "1e999"] {
            assert_eq!(thick.check_text(text), Err(NoGuess(text.into())));
        }
    }
}
