//! Names that are nearly another one's: what somebody meant who wrote a name that there is not.

/// Largest number of names that are compared.
const MAX_COMPARED: usize = 10_000;
/// Longest name that is compared by its letters, characters; a longer one is found if only the case differs.
const MAX_LENGTH: usize = 64;

/// The known name nearest to `name`: the first that differs in the case of letters alone, else the one that the fewest
/// mistyped letters make of it, at most a third of them. `None` where none is near.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters: Vec<char> = name.to_lowercase().chars().collect();
    let mut best: Option<(usize, &str)> = None;
    for other in known.into_iter().take(MAX_COMPARED) {
        let others: Vec<char> = other.to_lowercase().chars().collect();
        if others == letters {
            return Some(other);
        }
        let allowed = letters.len().min(others.len()).max(3) / 3;
        if letters.len().max(others.len()) > MAX_LENGTH || letters.len().abs_diff(others.len()) > allowed {
            continue;
        }
        let mistakes = mistakes(&letters, &others);
        if mistakes <= allowed && best.is_none_or(|(least, _)| mistakes < least) {
            best = Some((mistakes, other));
        }
    }
    best.map(|(_, other)| other)
}

/// `Did you mean "Rusty"? `, or nothing where no known name is near.
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known).map_or(String::new(), |other| format!("Did you mean {other:?}? "))
}

/// `; did you mean "Rusty"?`, for the end of a sentence; nothing where no name is near.
pub fn hint(nearest: Option<&str>) -> String {
    nearest.map_or(String::new(), |other| format!("; did you mean {other:?}?"))
}

/// How many letters have to be put in, left out, replaced, or exchanged with the next one, to make one word the other
/// (the optimal string alignment distance).
fn mistakes(a: &[char], b: &[char]) -> usize {
    let (mut before, mut last): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..=b.len()).collect());
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_name_is_found_in_any_case_and_a_strange_one_is_not() {
        let worlds = ["apartment", "workbench", "lot"];
        for (name, found) in [
            ("Apartment", Some("apartment")),
            ("APARTMENT", Some("apartment")),
            ("aparment", Some("apartment")),
            ("aprtmnt", Some("apartment")),
            ("workbnech", Some("workbench")),
            ("Lott", Some("lot")),
            ("lit", Some("lot")),
            ("cat", None),
            ("warehouse", None),
            ("", None),
        ] {
            assert_eq!(nearest(name, worlds), found, "{name}");
        }
        // of two that are near, the nearer one; of two as near, the first
        assert_eq!(nearest("doorB", ["door A", "door B"]), Some("door B"));
        assert_eq!(nearest("door", ["door1", "door2"]), Some("door1"));
        assert_eq!(nearest(&"a".repeat(200), [&*"A".repeat(200)]), Some(&*"A".repeat(200)));
        assert_eq!(did_you_mean("Rusti", ["Rusty", "Reach"]), "Did you mean \"Rusty\"? ");
        assert_eq!(hint(nearest("Rusti", ["Rusty", "Reach"])), "; did you mean \"Rusty\"?");
        assert_eq!(hint(nearest("Lot", ["Rusty", "Reach"])), "");
    }

    #[test]
    fn mistakes_are_counted_as_by_hand() {
        let count = |a: &str, b: &str| mistakes(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        for (a, b, expected) in
            [("kitten", "sitting", 3), ("ab", "ba", 1), ("", "abc", 3), ("abc", "", 3), ("a", "a", 0)]
        {
            assert_eq!(count(a, b), expected, "{a} {b}");
        }
    }
}
