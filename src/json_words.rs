//! What a reader of JSON found wrong, in words for those who wrote it.

/// The words for what serde_json says, without its line and column.
pub fn in_words(error: &str) -> String {
    let reason = error.split(" at line ").next().unwrap_or(error);
    let named = |before: &str| reason.strip_prefix(before)?.split('`').next();
    if let Some(field) = named("missing field `") {
        return format!("the field `{field}` is missing");
    }
    if let Some(field) = named("unknown field `") {
        return format!("there is no field `{field}`");
    }
    if let Some(field) = named("duplicate field `") {
        return format!("the field `{field}` is there twice");
    }
    // of fields of which one has to be there
    if reason.starts_with("no variant of enum ") {
        return "what it is to do is missing".to_owned();
    }
    if let Some(variant) = named("unknown variant `") {
        return format!("there is no `{variant}`");
    }
    for wrong in ["invalid type: ", "invalid value: ", "invalid length "] {
        if let Some((found, wanted)) = reason.strip_prefix(wrong).and_then(|rest| rest.rsplit_once(", expected ")) {
            return format!("{} does not belong here{}", value(found), kind(wanted));
        }
    }
    match reason {
        "expected value" | "expected ident" => "no value of JSON".to_owned(),
        "trailing characters" => "the line goes on after its last bracket".to_owned(),
        reason if reason.starts_with("EOF") => "the line ends too early".to_owned(),
        reason if reason.starts_with("expected ") => format!("{} belongs here", &reason["expected ".len()..]),
        reason => reason.to_owned(),
    }
}

/// What serde calls a value that it found.
fn value(found: &str) -> String {
    const WORDS: [(&str, &str); 6] = [
        ("string ", "the text "),
        ("integer ", "the number "),
        ("floating point ", "the number "),
        ("boolean ", ""),
        ("sequence", "a list"),
        ("map", "an object"),
    ];
    match WORDS.iter().find_map(|(theirs, ours)| Some((ours, found.strip_prefix(theirs)?))) {
        Some((ours, rest)) => format!("{ours}{rest}"),
        None if found.bytes().all(|byte| byte.is_ascii_digit()) => format!("a list of {found}"),
        None => found.to_owned(),
    }
}

/// What serde calls the kind of value that belongs there; nothing of the names of types.
fn kind(wanted: &str) -> &'static str {
    match wanted {
        "f64" | "f32" => ", a number does",
        "u8" | "u16" | "u32" | "u64" | "usize" | "i8" | "i16" | "i32" | "i64" => {
            ", a whole number does, of the size it may have"
        }
        "a string" | "string" => ", a text does",
        "a boolean" => ", true or false does",
        "a sequence" => ", a list does",
        "a tuple of size 2" | "an array of length 2" => ", a list of two does",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader's words for a text.
    fn words<'a, T: serde::Deserialize<'a>>(text: &'a str) -> String {
        in_words(&serde_json::from_str::<T>(text).map(|_| ()).unwrap_err().to_string())
    }

    #[test]
    fn no_name_of_a_type_is_among_the_words() {
        assert_eq!(
            words::<u64>(r#""5""#),
            r#"the text "5" does not belong here, a whole number does, of the size it may have"#
        );
        assert_eq!(
            words::<u32>("-1"),
            "the number `-1` does not belong here, a whole number does, of the size it may have"
        );
        assert_eq!(words::<f64>("true"), "`true` does not belong here, a number does");
        assert_eq!(words::<bool>("1.5"), "the number `1.5` does not belong here, true or false does");
        assert_eq!(words::<String>("[1]"), "a list does not belong here, a text does");
        assert_eq!(words::<Vec<f64>>("{}"), "an object does not belong here, a list does");
        assert_eq!(words::<(i16, i16)>("[1]"), "a list of 1 does not belong here, a list of two does");
        assert_eq!(words::<Vec<f64>>("[1, null]"), "null does not belong here, a number does");
    }
}
