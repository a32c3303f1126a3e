//! What is wrong with a RON text, in the words of its readers: without the names of this program's types.

use ron::Error;

/// What a RON reader found wrong, in words: ``the field `name` is missing``.
pub(crate) fn ron_in_words(error: &Error) -> String {
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
            format!("{found:?} stands where `{}` belongs", readers_name(expected))
        }
        Error::ExpectedStructLike => "`(` belongs here".into(),
        Error::ExpectedNamedStructLike(name) if readers_name(name) == OTHER => format!("a {OTHER} belongs here"),
        Error::ExpectedNamedStructLike(name) => format!("`{name}(` belongs here"),
        Error::ExpectedString => "a text in quotes belongs here".into(),
        Error::ExpectedStringEnd => "a text's closing quote is missing".into(),
        Error::ExpectedIdentifier | Error::InvalidIdentifier(_) => "a name belongs here".into(),
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
        Error::ExpectedDifferentLength { found, .. } => format!("{found} values: their number is wrong"),
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
        Error::ExpectedStructName(name) => format!("`{}` is missing here", readers_name(name)),
        Error::Message(text) => text.clone(),
        _ => "it is not written as this format is".into(),
    }
}

/// What stands for the name of a form that has none in files.
const OTHER: &str = "list of fields in `(` and `)`";

/// The name of a form as files have it. The others, which end in `Text`, are this program's own.
fn readers_name(name: &str) -> &str {
    match name {
        "World" | "Script" | "Assignment" | "Sweep" => name,
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

    /// Words that are RON's, serde's or the names of this program's types, and that no reader of a world file knows.
    const NOT_OURS: [&str; 15] = [
        "identifier",
        "Identifier",
        "std",
        "xpected",
        "issing field",
        "enum",
        "struct",
        "Text",
        "variant",
        "RawValue",
        "ron::",
        "serde",
        "integer",
        "float",
        "Non-whitespace",
    ];

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
            (said("World(version: 1.5)"), "a comma or a closing bracket belongs here"),
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

    /// Every text that the file becomes by cutting it off, or by leaving out or replacing one character.
    #[test]
    fn no_message_has_the_words_of_the_language_this_program_is_written_in() {
        let whole = World::built_in("lot").unwrap().to_ron();
        let mut refused = 0;
        let places = (0..whole.len()).filter(|i| whole.is_char_boundary(*i)).step_by(3);
        for i in places {
            let (before, after) = whole.split_at(i);
            let rest: String = after.chars().skip(1).collect();
            let texts = [
                before.to_owned(),
                format!("{before}{rest}"),
                format!("{before}?{rest}"),
                format!("{before}(3 {after}"),
            ];
            for text in texts {
                let Err(error) = World::parse("w", &text) else { continue };
                refused += 1;
                let problem = error.problem.to_string();
                let leak = NOT_OURS.iter().find(|word| problem.contains(*word));
                assert!(leak.is_none(), "{leak:?} in {problem:?}");
            }
        }
        assert!(refused > 1000, "{refused}");
    }
}
