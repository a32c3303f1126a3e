//! What is wrong with a RON text, in the words of its readers: without the names of this program's types.

use ron::Error;
use ron::error::SpannedError;

use crate::text_position::{Position, byte_at};

/// Where in its text an error begins.
pub fn begin_of(error: &SpannedError) -> Position {
    Position { line: error.span.start.line, column: error.span.start.col }
}

/// What a RON reader found wrong in a text, in words: ``the field `name` is missing``.
pub fn ron_in_words(text: &str, error: &SpannedError) -> String {
    let at = byte_at(text, begin_of(error));
    match &error.code {
        // the whole number in front of it was read
        Error::ExpectedComma if text[at..].starts_with('.') => "a whole number belongs here".into(),
        code => in_words(code),
    }
}

fn in_words(error: &Error) -> String {
    match error {
        Error::Eof => "the text ends too early: is a bracket or a quote left open?".into(),
        Error::ExpectedArray => "a list in `[` and `]` belongs here".into(),
        Error::ExpectedArrayEnd => "a comma or `]` belongs here".into(),
        Error::ExpectedBoolean => "true or false belongs here".into(),
        Error::ExpectedComma => "a comma or a closing bracket belongs here".into(),
        Error::ExpectedFloat | Error::FloatUnderscore => "a number belongs here".into(),
        Error::ExpectedInteger | Error::InvalidIntegerDigit { .. } | Error::UnderscoreAtBeginning => {
            "a whole number belongs here".into()
        }
        Error::ExpectedOption => "`Some(...)` or `None` belongs here".into(),
        Error::ExpectedOptionEnd | Error::ExpectedStructLikeEnd => "a comma or `)` belongs here".into(),
        Error::ExpectedMap => "`{` belongs here".into(),
        Error::ExpectedMapColon => "a colon belongs here, between a field's name and its value".into(),
        Error::ExpectedMapEnd => "a comma or `}` belongs here".into(),
        Error::ExpectedDifferentStructName { expected, found } => {
            format!("{found:?} stands where {} belongs", called(expected))
        }
        Error::ExpectedStructLike => "`(` belongs here".into(),
        Error::ExpectedNamedStructLike(name) => match called(name) {
            OTHER => format!("{OTHER} belongs here"),
            _ => format!("`{name}(` belongs here"),
        },
        Error::ExpectedString => "a text in quotes belongs here".into(),
        Error::ExpectedStringEnd => "a text's closing quote is missing".into(),
        Error::ExpectedIdentifier | Error::InvalidIdentifier(_) => "a name without quotes belongs here".into(),
        Error::SuggestRawIdentifier(found) => format!("{found:?} stands where a name belongs"),
        Error::InvalidEscape(_) => "no such escape: write \\\\ for a backslash, \\\" for a quote".into(),
        Error::IntegerOutOfBounds => "the number is too large or too small".into(),
        Error::NoSuchExtension(name) => format!("there is no extension {name:?}"),
        Error::ExpectedAttribute | Error::ExpectedAttributeEnd => {
            "`#` stands only in front of the file, as in #![enable(implicit_some)]".into()
        }
        Error::UnclosedBlockComment | Error::UnclosedLineComment => "a comment is not closed".into(),
        Error::UnexpectedChar(c) => format!("{c:?} does not belong here"),
        Error::TrailingCharacters => "the text goes on after its last bracket".into(),
        Error::ExpectedDifferentLength { expected, found } => {
            let values = if *found == 1 { "1 value".into() } else { format!("{found} values") };
            match expected.split(' ').find_map(|word| word.parse::<usize>().ok()) {
                Some(count) => format!("{values}: there must be {count}"),
                None => format!("{values}: their number is wrong"),
            }
        }
        // the lab's own readers say in words what they read
        Error::InvalidValueForType { expected, .. } if expected.starts_with("a list of ") => {
            format!("{expected} belongs here")
        }
        Error::InvalidValueForType { found, .. } => format!("{} does not belong here", value_in_words(found)),
        Error::NoSuchEnumVariant { expected, found, .. } => {
            format!("there is no `{found}` here: write {}", alternatives(expected))
        }
        Error::NoSuchStructField { expected, found, .. } => {
            format!("there is no field `{found}` here: the fields are {}", alternatives(expected))
        }
        Error::MissingStructField { field, .. } => format!("the field `{field}` is missing"),
        Error::DuplicateStructField { field, .. } => format!("the field `{field}` is there twice"),
        Error::ExceededRecursionLimit => "brackets in brackets, too many deep".into(),
        Error::ExpectedStructName(name) => format!("{} is missing here", called(name)),
        Error::Message(text) => text.clone(),
        _ => "it is not written as this format is".into(),
    }
}

/// What a form is called that has no name in files.
const OTHER: &str = "a list of fields in `(` and `)`";

/// What a form is called by those who write files. The names of all others are this program's own.
fn called(name: &str) -> &str {
    match name {
        "World" => "`World`",
        "Script" => "`Script`",
        "Assignment" => "`Assignment`",
        "Sweep" => "`Sweep`",
        _ => OTHER,
    }
}

/// A value that was found, without the words of the language this program is written in.
fn value_in_words(found: &str) -> &str {
    let known = [
        "the boolean ",
        "the unsigned integer ",
        "the signed integer ",
        "the floating point number ",
        "the UTF-8 character ",
        "the string ",
    ];
    let plain = known.iter().find_map(|words| found.strip_prefix(words));
    plain.unwrap_or("this")
}

/// `a, b or c`.
fn alternatives(names: &[&str]) -> String {
    match names {
        [] => "nothing".into(),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use crate::worlds::World;

    /// What is said of a world file, without its file and place.
    fn said(text: &str) -> String {
        World::parse("w", text).unwrap_err().problem.to_string()
    }

    fn with(rest: &str) -> String {
        said(&format!("World(version: 1, name: \"a\", bounds: (min: (0, 0), max: (4, 3)){rest}"))
    }

    #[test]
    fn what_is_wrong_is_said_in_a_readers_words() {
        let robot = |fields: &str| with(&format!(", robots: [({fields})])"));
        let shape = |shape: &str| with(&format!(", obstacles: [(name: \"x\", shape: {shape})])"));
        let fields = "there is no field `title` here: the fields are name, kind, start, disc, arm, car, sensor, sensors or route";
        let cases = [
            (said("(3"), "\"3\" stands where a name belongs"),
            (said(""), "`World(` belongs here"),
            (said("hello"), "\"hello\" stands where `World` belongs"),
            (said("Script(version: 1)"), "\"Script\" stands where `World` belongs"),
            (said("World(version: 1)"), "the field `name` is missing"),
            (said("World(version: 1.5)"), "a whole number belongs here"),
            (said("World(version: 1 5)"), "a comma or a closing bracket belongs here"),
            (said("World(version: 1, name: \"a\", bounds: (min: (0), max: (4, 3)))"), "1 value: there must be 2"),
            (said("World(version: x)"), "a whole number belongs here"),
            (said("World(version: 1, name: a)"), "a text in quotes belongs here"),
            (said("World(version: 1, name: \"a)"), "a text's closing quote is missing"),
            (said("World(version: 1, name: \"a\", name: \"b\")"), "the field `name` is there twice"),
            (with(") x"), "the text goes on after its last bracket"),
            (with(""), "a comma or a closing bracket belongs here"),
            (robot("title: 3"), fields),
            (shape("Foo(2)"), "there is no `Foo` here: write Disc, Box, Polygon, Rounded or Union"),
            (shape("Disc(center: (2, 2), radius: \"a\")"), "a number belongs here"),
        ];
        for (said, expected) in &cases {
            assert_eq!(said, expected);
        }
    }
}
