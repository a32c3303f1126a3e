//! `Formula`, a line of mathematics as a list of terms.

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
    /// The configuration of a robot of this kind, with or without a trailer, and its space. Empty for a kind that is
    /// not the lab's.
    pub fn space(kind: &str, trailer: bool) -> Self {
        let term = |text, role, level| Term { text, role, level };
        let base = |text| term(text, None, Level::Base);
        let q = term("q", Some(Role::Robot), Level::Base);
        let sub = |text| term(text, None, Level::Sub);
        let sup = |text| term(text, None, Level::Sup);
        Formula(match (kind, trailer) {
            ("rusty", _) => vec![q, base(" = (x, y) \u{2208} R"), sup("2")],
            ("reach", _) => {
                vec![q, base(" = (\u{3b8}"), sub("1"), base(", \u{3b8}"), sub("2"), base(") \u{2208} T"), sup("2")]
            }
            ("reach3", _) => vec![
                q,
                base(" = (\u{3b8}"),
                sub("1"),
                base(", \u{3b8}"),
                sub("2"),
                base(", \u{3b8}"),
                sub("3"),
                base(") \u{2208} T"),
                sup("3"),
            ],
            ("hitch", false) => vec![q, base(" = (x, y, \u{3b8}) \u{2208} SE(2)")],
            ("hitch", true) => vec![q, base(" = (x, y, \u{3b8}, \u{3c8}) \u{2208} SE(2) \u{d7} S"), sup("1")],
            _ => vec![],
        })
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

    /// The configuration in words, and why its space is that one. Empty for a kind that is not the lab's.
    pub fn spoken(kind: &str, trailer: bool) -> &'static str {
        match (kind, trailer) {
            ("rusty", _) => {
                "A point of the plane: a disc looks the same whichever way it faces. The simulator keeps the heading too."
            }
            ("reach", _) => "Two angles: a point of the torus, not the place of the tip.",
            ("reach3", _) => "Three angles for a tip with two coordinates: one to spare.",
            ("hitch", false) => "Position and heading: three numbers, though only two can be commanded.",
            ("hitch", true) => "Position and heading of the car, and the trailer's heading psi.",
            _ => "",
        }
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

    #[test]
    fn each_robot_has_the_space_of_its_type() {
        let written = |kind, trailer| Formula::space(kind, trailer).0.iter().map(|t| t.text).collect::<String>();
        assert_eq!(written("rusty", false), "q = (x, y) \u{2208} R2");
        assert_eq!(written("reach", false), "q = (\u{3b8}1, \u{3b8}2) \u{2208} T2");
        assert_eq!(written("hitch", false), "q = (x, y, \u{3b8}) \u{2208} SE(2)");
        assert!(written("hitch", true).ends_with("SE(2) \u{d7} S1"));
        assert_eq!(
            Formula::space("reach", false).mathml(),
            "<math><mi class=\"role-robot\" data-role=\"robot\">q</mi><mo>=</mo><mo>(</mo>\
             <msub><mi>\u{3b8}</mi><mrow><mn>1</mn></mrow></msub><mo>,</mo>\
             <msub><mi>\u{3b8}</mi><mrow><mn>2</mn></mrow></msub><mo>)</mo><mo>\u{2208}</mo>\
             <msup><mi>T</mi><mrow><mn>2</mn></mrow></msup></math>"
        );
        assert!(Formula::space("hitch", true).mathml().contains("<mi>SE</mi><mo>(</mo><mn>2</mn><mo>)</mo>"));
        assert!(Formula::space("tricycle", false).0.is_empty() && Formula::spoken("tricycle", false).is_empty());
    }
}
