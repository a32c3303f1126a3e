//! `Formula`, a line of mathematics as a list of terms, and the chapter's formulas, read from `assets/formulas.ron`.

use std::sync::LazyLock;

use serde::Deserialize;

use motion_lab_core::configuration::Space;
use motion_lab_core::picture::Role;

/// The position of a term relative to the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Base,
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

/// A formula of the chapter with what it says in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChapterFormula {
    at: Vec<String>,
    /// The formula.
    pub formula: Formula,
    /// What it says, in words.
    pub spoken: String,
    /// The library's function that computes it, as in `Reach::tip`.
    pub code: &'static str,
}

/// A formula as it is written in the manifest.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FormulaText {
    at: Vec<String>,
    formula: &'static str,
    spoken: String,
    code: &'static str,
}

static FORMULAS: LazyLock<Vec<ChapterFormula>> = LazyLock::new(|| {
    let written: Vec<FormulaText> = ron::from_str(include_str!("../../assets/formulas.ron")).unwrap_or_default();
    let entry = |FormulaText { at, formula, spoken, code }| ChapterFormula {
        at,
        formula: Formula::parse(formula),
        spoken,
        code,
    };
    written.into_iter().map(entry).collect()
});

impl ChapterFormula {
    /// The formulas of this name, in order: of a tab of the query anatomy, of a kind of robot as in `hitch.4`, with the
    /// number of its coordinates, or of the `annulus`. None for any other name.
    pub fn of(name: &str) -> impl Iterator<Item = &'static ChapterFormula> {
        FORMULAS.iter().filter(move |entry| entry.at.iter().any(|at| at == name))
    }

    /// All formulas.
    pub fn all() -> &'static [ChapterFormula] {
        &FORMULAS
    }

    /// The names that it stands at.
    pub fn at(&self) -> &[String] {
        &self.at
    }
}

impl Formula {
    /// Reads a formula. In `{role:term}` the term has that role; after `_` the next letter is a subscript, after `^` a
    /// superscript. What has no such role stays without one.
    pub fn parse(text: &'static str) -> Self {
        let mut terms = Vec::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            add_terms(&mut terms, before, None);
            let (inner, behind) = after.split_once('}').unwrap_or((after, ""));
            let (role, term) = inner.split_once(':').unwrap_or(("", inner));
            add_terms(&mut terms, term, Role::ALL.into_iter().find(|known| known.name() == role));
            rest = behind;
        }
        add_terms(&mut terms, rest, None);
        Formula(terms)
    }

    /// The configuration of a robot and its space, as [`Space::formula`] writes them. The first `q` has the role of
    /// the robot.
    pub fn of(space: &Space) -> Self {
        let mut terms = Vec::new();
        let mut rest = space.formula;
        if let Some(after) = rest.strip_prefix('q') {
            terms.push(Term { text: "q", role: Some(Role::Robot), level: Level::Base });
            rest = after;
        }
        add_terms(&mut terms, rest, None);
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

/// Adds the terms of a text without roles of its own: pieces of the line, and scripts of one letter or digit.
fn add_terms(terms: &mut Vec<Term>, text: &'static str, role: Option<Role>) {
    let (mut rest, mut level) = (text, Level::Base);
    while !rest.is_empty() {
        // a script is one letter or digit, a piece of the line goes up to the next one
        let first = rest.chars().next().map_or(0, char::len_utf8);
        let end = if level == Level::Base { rest.find(['_', '^']).unwrap_or(rest.len()) } else { first };
        let (text, after) = rest.split_at(end);
        if !text.is_empty() {
            terms.push(Term { text, role, level });
        }
        (level, rest) = match after.chars().next() {
            Some('_') => (Level::Sub, &after[1..]),
            Some('^') => (Level::Sup, &after[1..]),
            _ => (Level::Base, after),
        };
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
    let mut spaced = false;
    for c in text.chars() {
        if c.is_whitespace() {
            spaced = true;
            continue;
        }
        let now = kind(c);
        // a space beside a word is seen; operators have their own
        let beside_a_word = match pieces.last() {
            Some((last, _)) => *last != 'o' && now != 'o',
            None => now == 'w',
        };
        if spaced && beside_a_word {
            pieces.push((' ', String::new()));
        }
        match pieces.last_mut() {
            Some((last, piece)) if *last == now && matches!(now, 'w' | 'n') => piece.push(c),
            _ => pieces.push((now, c.to_string())),
        }
        spaced = false;
    }
    if spaced && pieces.last().is_some_and(|(last, _)| *last == 'w') {
        pieces.push((' ', String::new()));
    }
    let tag = |kind| match kind {
        'n' => "mn",
        'o' => "mo",
        _ => "mi",
    };
    let element = |(kind, piece): &(char, String)| match kind {
        ' ' => "<mspace width=\"0.2em\"/>".to_owned(),
        kind => format!("<{0}{marks}>{piece}</{0}>", tag(*kind)),
    };
    pieces.iter().map(element).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::collision::{Checker, Collision, Scene};
    use motion_lab_core::configuration::RobotKind;
    use motion_lab_core::robots::{AnyRobot, Drivable, Hitch, Reach, Rusty};
    use motion_lab_core::sensors::RangeSensor;

    #[test]
    fn a_product_and_a_functions_argument_stand_apart_in_mathml() {
        let space = "<mspace width=\"0.2em\"/>";
        let words = Formula::parse("2 = v cos ω").mathml();
        assert_eq!(words, format!("<math><mn>2</mn><mo>=</mo><mi>v</mi>{space}<mi>cos</mi>{space}<mi>ω</mi></math>"));
        let scripts = Formula::parse("L_1 cos {robot:x_2}").mathml();
        let robot = " class=\"role-robot\" data-role=\"robot\"";
        let first = "<msub><mi>L</mi><mrow><mn>1</mn></mrow></msub>";
        let last = format!("<msub><mi{robot}>x</mi><mrow><mn{robot}>2</mn></mrow></msub>");
        assert_eq!(scripts, format!("<math>{first}{space}<mi>cos</mi>{space}{last}</math>"));
    }

    #[test]
    fn the_chapters_formulas_are_whole_and_stand_at_tabs_and_robots_that_there_are() {
        let text = include_str!("../../assets/formulas.ron");
        let parsed: Vec<FormulaText> = ron::from_str(text).unwrap();
        assert_eq!(parsed.len(), ChapterFormula::all().len());
        let tabs = crate::anatomy::Tab::ALL.map(|tab| tab.name().to_owned());
        let kinds = RobotKind::ALL.into_iter().flat_map(|kind| {
            kind.spaces.iter().map(|space| format!("{}.{}", kind.name, space.coordinates)).collect::<Vec<_>>()
        });
        let places: Vec<String> = tabs.into_iter().chain(kinds).chain(["annulus".to_owned()]).collect();
        for place in &places {
            assert!(ChapterFormula::of(place).next().is_some(), "nothing is said of {place}");
        }
        for (entry, FormulaText { formula, .. }) in ChapterFormula::all().iter().zip(&parsed) {
            assert!(entry.at().iter().all(|at| places.contains(at)) && entry.spoken.ends_with('.'), "{:?}", entry.at());
            // every role is one: as many terms with a role as braces, or more by their scripts
            let roles = entry.formula.0.iter().filter(|term| term.role.is_some()).count();
            assert!(roles > 0 && roles >= formula.matches('{').count(), "{formula}");
            assert!(entry.formula.0.iter().all(|term| !term.text.contains(['{', '}', '_', '^', ':'])), "{formula}");
        }
        assert_eq!(ChapterFormula::of("hitch.4").count(), 2);
        assert!(ChapterFormula::of("a cat").next().is_none());
    }

    /// Whether a formula writes an angle otherwise than θ, or a joint's otherwise than θ with a subscript.
    fn misspells_an_angle(formula: &str) -> bool {
        let follows = |c: char| c.is_numeric() || ('\u{2080}'..='\u{2089}').contains(&c);
        let letters: Vec<char> = formula.chars().collect();
        letters.contains(&'\u{3d1}')
            || formula.contains("theta")
            || letters.windows(2).any(|pair| pair[0] == '\u{3b8}' && follows(pair[1]))
    }

    #[test]
    fn an_angle_has_one_spelling() {
        assert!(["\u{3d1}_1", "\u{3b8}1", "\u{3b8}\u{2081}", "theta_1"].into_iter().all(misspells_an_angle));
        let written: Vec<FormulaText> = ron::from_str(include_str!("../../assets/formulas.ron")).unwrap();
        let spaces = RobotKind::ALL.into_iter().flat_map(|kind| kind.spaces.iter().map(|space| space.formula));
        let formulas: Vec<&str> = written.iter().map(|written| written.formula).chain(spaces).collect();
        assert!(formulas.iter().filter(|formula| formula.contains('\u{3b8}')).count() >= 8, "there are angles");
        for formula in formulas {
            assert!(!misspells_an_angle(formula), "{formula}");
        }
        // words are read aloud: the letter has its name there
        let words = include_str!("../../assets/widgets.ron");
        let spoken = written.iter().map(|written| written.spoken.as_str());
        assert!(spoken.chain([words]).all(|words| !words.contains(['\u{3b8}', '\u{3d1}'])));
    }

    #[test]
    fn the_code_of_a_formula_is_there() {
        fn name_of<T>(_: T) -> &'static str {
            std::any::type_name::<T>()
        }
        let functions = [
            ("Scene::intersects", name_of(<Scene as Collision>::intersects)),
            ("Scene::distance", name_of(<Scene as Collision>::distance)),
            ("Scene::witness", name_of(<Scene as Collision>::witness)),
            ("Checker::edge", name_of(Checker::<Reach<2>>::edge)),
            ("Rusty::drive", name_of(<Rusty as Drivable>::drive)),
            ("Reach::tip", name_of(Reach::<2>::tip)),
            ("Reach::fk", name_of(Reach::<2>::fk)),
            ("Reach::ik", name_of(Reach::<2>::ik)),
            ("RangeSensor::scan", name_of(RangeSensor::scan)),
            ("AnyRobot::annulus", name_of(AnyRobot::annulus)),
            ("Hitch::step", name_of(Hitch::step)),
        ];
        for (code, function) in functions {
            let (of, name) = code.split_once("::").unwrap();
            assert!(function.contains(of) && function.ends_with(&format!("::{name}")), "{code} is {function}");
            assert!(ChapterFormula::all().iter().any(|entry| entry.code == code), "{code} computes no formula");
        }
        assert!(ChapterFormula::all().iter().all(|entry| functions.iter().any(|(code, _)| *code == entry.code)));
    }

    #[test]
    fn a_term_has_its_role_with_its_scripts() {
        let term = |text, role, level| Term { text, role, level };
        let witness = Some(Role::Witness);
        let expected = [
            term("|", None, Level::Base),
            term("a", witness, Level::Base),
            term("*", witness, Level::Sup),
            term(" - L", None, Level::Base),
            term("1", None, Level::Sub),
            term("2", None, Level::Sup),
            term("|", None, Level::Base),
        ];
        assert_eq!(Formula::parse("|{witness:a^*} - L_1^2|").0, expected);
        // a role that there is not is none
        assert_eq!(Formula::parse("{cat:x}").0, [term("x", None, Level::Base)]);
    }

    #[test]
    fn each_robot_has_the_space_of_its_type() {
        let space = |kind: &RobotKind, coordinates| Formula::of(kind.space(coordinates).unwrap());
        let written = |kind, coordinates| space(kind, coordinates).0.iter().map(|t| t.text).collect::<String>();
        // over a Pose2 stands its space
        assert_eq!(written(&RobotKind::RUSTY, 3), "q = (x, y, \u{3b8}) \u{2208} SE(2)");
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
