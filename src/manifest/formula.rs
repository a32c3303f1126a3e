//! `Formula`, a line of mathematics as a list of terms.

use crate::configuration::Space;
use crate::picture::Role;

/// The position of a term relative to the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// On the line.
    Base,
    /// A subscript.
    Sub,
    /// A superscript.
    Sup,
}

/// A term of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// Its text.
    pub text: &'static str,
    /// The role whose colour it has in a picture, if the picture draws it.
    pub role: Option<Role>,
    /// Its position relative to the line.
    pub level: Level,
}

/// A line of mathematics.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Formula(pub Vec<Term>);

impl Formula {
    /// The configuration of a robot and its space, as [`Space::formula`] writes them. The first `q` has the role of
    /// the robot.
    pub fn of(space: &Space) -> Self {
        let term = |text, role, level| Term { text, role, level };
        let mut terms = Vec::new();
        let (mut rest, mut level) = (space.formula, Level::Base);
        while !rest.is_empty() {
            // a script is one letter or digit, a piece of the line goes up to the next one
            let first = rest.chars().next().map_or(0, char::len_utf8);
            let end = if level == Level::Base { rest.find(['_', '^']).unwrap_or(rest.len()) } else { first };
            let (text, after) = rest.split_at(end);
            match text.strip_prefix('q').filter(|_| terms.is_empty()) {
                Some(more) => {
                    terms.push(term("q", Some(Role::Robot), Level::Base));
                    terms.push(term(more, None, level));
                }
                None => terms.push(term(text, None, level)),
            }
            (level, rest) = match after.chars().next() {
                Some('_') => (Level::Sub, &after[1..]),
                Some('^') => (Level::Sup, &after[1..]),
                _ => (Level::Base, after),
            };
        }
        terms.retain(|term| !term.text.is_empty());
        Formula(terms)
    }

    /// The formula as a MathML element. A term's role is its class, `role-robot` for instance, and its attribute
    /// `data-role`.
    ///
    /// Text is split letter by letter: runs of Latin letters and single Greek letters are identifiers, digits are
    /// numbers, the rest are operators. A subscript or superscript belongs to the piece before it.
    pub fn mathml(&self) -> String {
        let mut pieces: Vec<String> = Vec::new();
        for term in &self.0 {
            let marks = term.role.map_or(String::new(), |r| format!(" class=\"role-{0}\" data-role=\"{0}\"", r.name()));
            let row = tokens(term.text, &marks);
            let scripted = |tag, base| format!("<{tag}>{base}<mrow>{}</mrow></{tag}>", row.concat());
            match (term.level, pieces.pop()) {
                (Level::Sub, Some(base)) => pieces.push(scripted("msub", base)),
                (Level::Sup, Some(base)) => pieces.push(scripted("msup", base)),
                (_, before) => pieces.extend(before.into_iter().chain(row)),
            }
        }
        format!("<math>{}</math>", pieces.concat())
    }
}

/// The tokens of a text, each an element of MathML with these attributes.
fn tokens(text: &str, marks: &str) -> Vec<String> {
    let kind = |c: char| match c {
        'a'..='z' | 'A'..='Z' => 'w',
        _ if c.is_alphabetic() => 'g',
        '0'..='9' => 'n',
        _ => 'o',
    };
    let mut pieces: Vec<(char, String)> = Vec::new();
    for c in text.chars().filter(|c| !c.is_whitespace()) {
        match pieces.last_mut() {
            Some((last, piece)) if *last == kind(c) && matches!(last, 'w' | 'n') => piece.push(c),
            _ => pieces.push((kind(c), c.to_string())),
        }
    }
    let tag = |kind| match kind {
        'n' => "mn",
        'o' => "mo",
        _ => "mi",
    };
    pieces.iter().map(|(k, p)| format!("<{0}{marks}>{p}</{0}>", tag(*k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::RobotKind;

    #[test]
    fn each_robot_has_the_space_of_its_type() {
        let space = |kind: &RobotKind, coordinates| Formula::of(kind.space(coordinates).unwrap());
        let written = |kind, coordinates| space(kind, coordinates).0.iter().map(|t| t.text).collect::<String>();
        assert_eq!(written(&RobotKind::RUSTY, 3), "q = (x, y) \u{2208} R2");
        assert_eq!(written(&RobotKind::REACH, 2), "q = (\u{3b8}1, \u{3b8}2) \u{2208} T2");
        assert_eq!(written(&RobotKind::HITCH, 3), "q = (x, y, \u{3b8}) \u{2208} SE(2)");
        assert!(written(&RobotKind::HITCH, 4).ends_with("SE(2) \u{d7} S1"));
        assert_eq!(
            space(&RobotKind::REACH, 2).mathml(),
            "<math><mi class=\"role-robot\" data-role=\"robot\">q</mi><mo>=</mo><mo>(</mo>\
             <msub><mi>\u{3b8}</mi><mrow><mn>1</mn></mrow></msub><mo>,</mo>\
             <msub><mi>\u{3b8}</mi><mrow><mn>2</mn></mrow></msub><mo>)</mo><mo>\u{2208}</mo>\
             <msup><mi>T</mi><mrow><mn>2</mn></mrow></msup></math>"
        );
        assert!(space(&RobotKind::HITCH, 4).mathml().contains("<mi>SE</mi><mo>(</mo><mn>2</mn><mo>)</mo>"));
    }
}
