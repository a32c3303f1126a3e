//! Reads conditions from text.

use std::str::FromStr;

use super::condition::{Compared, Condition, Relation, Requirement};
use super::condition_error::{ConditionError, ConditionProblem};
use crate::run::StatsColumn;
use motion_lab_core::names::nearest;

impl Condition {
    /// Reads a condition: `Hitch.contacts > 0 && Rusty.path_m <= 2.5 || digest != DIGEST`. A robot's name with one of
    /// the characters `<>=!&|"` stands between quotes: `"a|b".contacts > 0`; a quote or a backslash in it has a
    /// backslash before it.
    ///
    /// # Errors
    /// [`ConditionError`], with the character at which it goes wrong.
    pub fn parse(text: &str) -> Result<Self, ConditionError> {
        let mut reader = ConditionReader { text, at: 0 };
        let mut any = vec![Vec::new()];
        loop {
            let requirement = reader.requirement()?;
            if let Some(all) = any.last_mut() {
                all.push(requirement);
            }
            reader.skip_blanks();
            if reader.rest().is_empty() {
                return Ok(Condition { any });
            }
            if reader.take("||") {
                any.push(Vec::new());
            } else if !reader.take("&&") {
                return Err(reader.error(ConditionProblem::Join));
            }
        }
    }
}

impl FromStr for Condition {
    type Err = ConditionError;

    fn from_str(text: &str) -> Result<Self, ConditionError> {
        Condition::parse(text)
    }
}

/// A text that is read from the byte `at` on.
struct ConditionReader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> ConditionReader<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The character at which the reader is, from 1.
    fn character(&self) -> usize {
        self.text.get(..self.at).unwrap_or_default().chars().count() + 1
    }

    fn error(&self, problem: ConditionProblem) -> ConditionError {
        problem.at(self.character())
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn take(&mut self, word: &str) -> bool {
        let is_there = self.rest().starts_with(word);
        self.at += if is_there { word.len() } else { 0 };
        is_there
    }

    /// Reads up to one of these characters, without blanks at the end.
    fn up_to(&mut self, ends: &[char]) -> &'a str {
        let rest = self.rest();
        let end = rest.find(ends).unwrap_or(rest.len());
        self.at += end;
        rest.get(..end).unwrap_or_default().trim_end()
    }

    fn requirement(&mut self) -> Result<Requirement, ConditionError> {
        self.skip_blanks();
        let at = self.character();
        let quoted = if self.rest().starts_with('"') { Some(self.quoted()?) } else { None };
        let written = self.up_to(&['<', '>', '=', '!', '&', '|']);
        if quoted.is_none() && written.is_empty() {
            return Err(ConditionProblem::Missing.at(at));
        }
        let relation = Relation::WRITTEN.into_iter().find(|(written, _)| self.take(written));
        let (_, relation) = relation.ok_or_else(|| self.error(ConditionProblem::Relation))?;
        self.skip_blanks();
        let value_at = self.character();
        let value = self.up_to(&['&', '|']);
        if quoted.is_none() && written == "digest" {
            let digest = value.parse().map_err(|error| ConditionProblem::Digest(error).at(value_at))?;
            let is_equal = match relation {
                Relation::Equal => true,
                Relation::Unequal => false,
                _ => return Err(ConditionProblem::DigestRelation.at(at)),
            };
            return Ok(Requirement { at, of: Compared::Digest { is_equal, digest } });
        }
        // the name of a robot may have points of its own
        let split = match quoted {
            Some(name) => written.trim_start().strip_prefix('.').map(|column| (name, column)),
            None => written.rsplit_once('.').map(|(name, column)| (name.trim_end().to_owned(), column)),
        };
        let (name, column) = split.ok_or_else(|| ConditionProblem::Name(written.to_owned()).at(at))?;
        let column = column.trim();
        let column = StatsColumn::named(column).ok_or_else(|| {
            let meant = nearest(column, StatsColumn::ALL.map(|known| known.name)).map(str::to_owned);
            ConditionProblem::Column { name: column.to_owned(), meant }.at(at)
        })?;
        let number = value.parse().ok().filter(|number: &f64| number.is_finite());
        let number = number.ok_or_else(|| ConditionProblem::Number(value.to_owned()).at(value_at))?;
        Ok(Requirement { at, of: Compared::Robot { name, column, relation, number } })
    }

    /// Reads a name between quotes.
    fn quoted(&mut self) -> Result<String, ConditionError> {
        let (mut name, mut is_escaped) = (String::new(), false);
        for (i, c) in self.rest().char_indices().skip(1) {
            match c {
                '\\' if !is_escaped => is_escaped = true,
                '"' if !is_escaped => {
                    self.at += i + 1;
                    return Ok(name);
                }
                c => {
                    name.push(c);
                    is_escaped = false;
                }
            }
        }
        Err(self.error(ConditionProblem::Quote))
    }
}
