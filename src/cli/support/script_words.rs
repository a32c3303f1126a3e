//! How many changes of worlds a script has, in words and in JSON.

/// `, 2 changes of worlds`; nothing where there are none.
pub fn changes_in_words(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => ", 1 change of worlds".into(),
        n => format!(", {n} changes of worlds"),
    }
}

/// Whether there are none, so that JSON leaves them out.
pub fn none(count: &usize) -> bool {
    *count == 0
}
